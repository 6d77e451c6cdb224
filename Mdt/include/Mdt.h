/** @file Mdt.h
 *  Karma Dynamics: everything a program needs to simulate rigid bodies (Dynamics guide). */
#ifndef MDT_H
#define MDT_H

#include "MdtBSJoint.h"
#include "MdtBody.h"
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactParams.h"
#include "MdtDefaults.h"
#include "MdtHinge.h"
#include "MdtLimit.h"
#include "MdtTypes.h"
#include "MdtUtilities.h"
#include "MdtWorld.h"

#endif
