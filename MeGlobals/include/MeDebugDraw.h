/** @file MeDebugDraw.h
 *  Line drawing for debugging. A viewer or a program sets its own function here.
 */
#ifndef MEDEBUGDRAW_H
#define MEDEBUGDRAW_H

#include "MePrecision.h"

ME_BEGIN_C

/** Draws a line between two points in the world frame, with a colour of red, green, blue (each 0 to 1). It must not
 *  create, destroy or step anything of Karma: such calls are refused, with a warning (docs/simulation.md,
 *  "Callbacks"). */
typedef void(MEAPI *MeDebugLineFuncPtr)(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b);

/** The functions in use. */
typedef struct MeDebugDrawAPIStruct {
    MeDebugLineFuncPtr line; /**< Never null. The default draws nothing. */
} MeDebugDrawAPIStruct;

extern MEPUBLIC MeDebugDrawAPIStruct MeDebugDrawAPI; /**< Set it before the world is stepped. */

ME_END_C

#endif
