/** @file MstUniverse.h
 *  Universes: collision and dynamics in one (User Guide ch. 5, "Creating a Universe"). Includes all of Mst.h.
 */
#ifndef MSTUNIVERSE_H
#define MSTUNIVERSE_H

#include "MstTypes.h"

ME_BEGIN_C

/**
 * Creates a world, a framework with all geometry types and interactions, a space and a bridge, of the given sizes; null
 * means MstUniverseDefaultSizes, and MstUniverseGrowingSizes has no limits. Returns null, with a warning, if a size is
 * out of range. Models of disabled bodies are frozen (MstSetWorldHandlers). Between steps the space is inside a change
 * block.
 *
 * The world's epsilon follows from the scales: 7.2e-12 lengthScale / massScale [1/kg]. At 60 Hz and 10 m/s², a load of
 * a million times the mass scale makes joints and contacts sag by 1e-7 of the length scale (epsilon F h² / gamma); a
 * body of up to 10 000 times the mass scale sags under its own weight by no more than 1e-9 of it. MdtWorldSetEpsilon on
 * the universe's world replaces this value by an absolute one; the softer joints and contacts of the Dynamics guide
 * have MDTWORLD_DEFAULT_EPSILON / massScale.
 */
MEPUBLIC MstUniverseID MEAPI MstUniverseCreate(const MstUniverseSizes *const sizes);
/** Destroys a universe with all bodies, constraints, models and geometries in it. Null does nothing. */
MEPUBLIC void MEAPI MstUniverseDestroy(const MstUniverseID u);
/** Advances the universe by a step (s): McdSpaceUpdateAll, MstBridgeUpdateContacts, MdtWorldStep and
 *  MstBridgeUpdateEvents, which a program may also call itself. Swept models (McdModelSetSwept) move continuously: they
 *  stop at their time of impact and continue from there. The world's minimum safe time is 1e-9 s. A step so long that a
 *  body in free fall, from rest, falls farther than the length scale gets a warning, once. */
MEPUBLIC void MEAPI MstUniverseStep(const MstUniverseID u, const MeReal step);
MEPUBLIC MdtWorldID MEAPI MstUniverseGetWorld(const MstUniverseID u);
MEPUBLIC McdFrameworkID MEAPI MstUniverseGetFramework(const MstUniverseID u);
MEPUBLIC McdSpaceID MEAPI MstUniverseGetSpace(const MstUniverseID u);
MEPUBLIC MstBridgeID MEAPI MstUniverseGetBridge(const MstUniverseID u);

ME_END_C

#include "Mst.h"

#endif
