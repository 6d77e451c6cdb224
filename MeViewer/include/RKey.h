/** @file RKey.h
 *  Keys that are held and released. Callbacks (MeViewer.h, "Controls") tell when a key goes down; this tells whether it
 *  is down now, for pedals, steering wheels and the like. An addition to the 1.2 interface.
 */
#ifndef RKEY_H
#define RKEY_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/**
 * For how many frames a key has been down, 1 in the frame in which it was pressed; 0 while it is up, so that the frame
 * in which it comes back to 0 is that of its release. @a name is as in the option -key: "Up", "Space", "Enter", "F7",
 * "a"; upper and lower case are the same. Keys that a panel takes, as while a number is typed into it, are up. `-key
 * Up@10-70` holds a key in frames 10 to 70 of a run. 0, with a warning, for a null context or a key that there is not.
 */
MEPUBLIC int MEAPI RRenderGetKeyFrames(RRender *rc, const char *name);

ME_END_C

#endif
