/** @file Mst.h
 *  All of the Simulation Toolkit, dynamics and collision.
 */
#ifndef MST_H
#define MST_H

#include "Mcd.h"
#include "Mdt.h"
#include "MstAdvise.h"
#include "MstBridge.h"
#include "MstDebugDraw.h"
#include "MstEvents.h"
#include "MstModelDynamics.h"
#include "MstMover.h"
#include "MstTypes.h"
#include "MstUniverse.h"
#include "MstUtils.h"
#include "MstVehicle.h"

#endif
