/** @file RKey.h
 *  State of keys: whether a key is down now, for pedals, steering wheels and the like. Callbacks (MeViewer.h,
 *  "Controls") report only when a key is pressed. An addition to the 1.2 interface.
 */
#ifndef RKEY_H
#define RKEY_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * The number of frames that a key has been down, 1 in the frame in which it was pressed; 0 while it is up, first in the
 * frame of its release. @a name is as in the option -key: "Up", "Space", "Enter", "F7", "a"; case-insensitive. Keys
 * that a panel uses, such as for typing a number, are up. `-key Up@10-70` holds a key down in frames 10 to 70 of a run.
 * 0, with a warning, for a null context or an unknown key.
 */
MEPUBLIC int MEAPI RRenderGetKeyFrames(RRender *rc, const char *name);

ME_END_C

#endif
