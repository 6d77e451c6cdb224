/** @file RMark.h
 *  Lines, points, triangles and texts at places of the world, laid over the picture: seen through bodies. For what
 *  explains a picture, as contacts and axes do. An addition to the 1.2 interface.
 *
 *  The context's function is called for every picture; the other functions draw, and may be called by it only (else a
 *  warning). Places are in the world frame, widths in pixels of a window of 960x600, colours red, green, blue and
 *  opacity. What is behind the camera, or not finite, is not drawn.
 */
#ifndef RMARK_H
#define RMARK_H

#include "MeViewerTypes.h"

ME_BEGIN_C

typedef void(MEAPI *RMarkCallBack)(RRender *rc, void *userdata);

/** @name Marks
 *  @{ */
/** Who draws marks; null: nobody. It takes the place of the one before. It may not destroy the context or end the
 *  program. */
MEPUBLIC void MEAPI RRenderSetMarkCallBack(RRender *rc, RMarkCallBack func, void *userdata);
MEPUBLIC void MEAPI RMarkLine(RRender *rc, const MeVector3 a, const MeVector3 b, const float color[4], AcmeReal width);
MEPUBLIC void MEAPI RMarkPoint(RRender *rc, const MeVector3 p, const float color[4], AcmeReal width);
/** Not drawn unless all of it is in front of the camera. */
MEPUBLIC void MEAPI RMarkTriangle(RRender *rc, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                                  const float color[4]);
/** UTF-8, its left end beside the place. */
MEPUBLIC void MEAPI RMarkText(RRender *rc, const MeVector3 p, const char *text, const float color[4]);
/** @} */

ME_END_C

#endif
