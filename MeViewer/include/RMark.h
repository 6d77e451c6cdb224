/** @file RMark.h
 *  Marks: lines, points, triangles and texts at positions in the world, drawn over the picture and not hidden by
 *  bodies. For annotations such as contacts and axes. An addition to the 1.2 interface.
 *
 *  The context's callback is called for every picture; only it may call the other functions, which draw (otherwise they
 *  warn). Positions are in the world frame, widths in pixels of a window of 960x600, colours are red, green, blue and
 *  opacity. Marks behind the camera, or not finite, are not drawn.
 */
#ifndef RMARK_H
#define RMARK_H

#include "MeViewerTypes.h"

ME_BEGIN_C

typedef void(MEAPI *RMarkCallBack)(RRender *rc, void *userdata);

/** @name Marks
 *  @{ */
/** Sets the callback that draws marks, instead of the previous one; null: none. It must not destroy the context or end
 *  the program. */
MEPUBLIC void MEAPI RRenderSetMarkCallBack(RRender *rc, RMarkCallBack func, void *userdata);
/** World frame; @a width in pixels. Only within the callback. */
MEPUBLIC void MEAPI RMarkLine(RRender *rc, const MeVector3 a, const MeVector3 b, const float color[4], AcmeReal width);
/** World frame; @a width in pixels. Only within the callback. */
MEPUBLIC void MEAPI RMarkPoint(RRender *rc, const MeVector3 p, const float color[4], AcmeReal width);
/** Drawn only if all of it is in front of the camera. */
MEPUBLIC void MEAPI RMarkTriangle(RRender *rc, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                                  const float color[4]);
/** A UTF-8 text that begins beside the position. */
MEPUBLIC void MEAPI RMarkText(RRender *rc, const MeVector3 p, const char *text, const float color[4]);
/** @} */

ME_END_C

#endif
