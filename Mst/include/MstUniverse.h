/** @file MstUniverse.h
 *  Universes: collision and dynamics in one (User Guide ch. 5, "Creating a Universe").
 */
#ifndef MSTUNIVERSE_H
#define MSTUNIVERSE_H

#include "MstTypes.h"

ME_BEGIN_C

/**
 * Creates a world, a framework with all geometry types and interactions, a space and a bridge, of the given sizes; null
 * means MstUniverseDefaultSizes. Returns null, with a warning, if a size is out of range. Bodies that are disabled have
 * their models frozen (MstSetWorldHandlers). The space is inside a change block between steps.
 */
MEPUBLIC MstUniverseID MEAPI MstUniverseCreate(const MstUniverseSizes *const sizes);
/** Destroys a universe with all bodies, constraints, models and geometries in it. Null does nothing. */
MEPUBLIC void MEAPI MstUniverseDestroy(const MstUniverseID u);
/** The next step (s): McdSpaceUpdateAll, MstBridgeUpdateContacts, MdtWorldStep and MstBridgeUpdateEvents, which a program
 *  may also call; swept models (McdModelSetSwept) are moved continuously, up to what they meet and on from there. Its
 *  world's least safe time is 1e-9 s. */
MEPUBLIC void MEAPI MstUniverseStep(const MstUniverseID u, const MeReal step);
MEPUBLIC MdtWorldID MEAPI MstUniverseGetWorld(const MstUniverseID u);
MEPUBLIC McdFrameworkID MEAPI MstUniverseGetFramework(const MstUniverseID u);
MEPUBLIC McdSpaceID MEAPI MstUniverseGetSpace(const MstUniverseID u);
MEPUBLIC MstBridgeID MEAPI MstUniverseGetBridge(const MstUniverseID u);

ME_END_C

#endif
