/** @file Mdt.h
 *  Karma Dynamics: everything that a program needs to simulate rigid bodies (Dynamics guide), with the constraint
 *  library and the parts of MeGlobals for programs. */
#ifndef MDT_H
#define MDT_H

#include "MdtAngular3.h"
#include "MdtBSJoint.h"
#include "MdtBcl.h"
#include "MdtBody.h"
#include "MdtCarWheel.h"
#include "MdtConeLimit.h"
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtContactParams.h"
#include "MdtDefaults.h"
#include "MdtFPFOJoint.h"
#include "MdtFixedPath.h"
#include "MdtHinge.h"
#include "MdtLimit.h"
#include "MdtLinear1.h"
#include "MdtLinear2.h"
#include "MdtMainLoop.h"
#include "MdtPartition.h"
#include "MdtPrismatic.h"
#include "MdtRPROJoint.h"
#include "MdtReport.h"
#include "MdtSkeletal.h"
#include "MdtSpring.h"
#include "MdtSpring6.h"
#include "MdtTypes.h"
#include "MdtUniversal.h"
#include "MdtUserConstraint.h"
#include "MdtUtilities.h"
#include "MdtWorld.h"
#include "MeChunk.h"
#include "MeMath.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MePool.h"

#endif
