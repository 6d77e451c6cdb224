/** @file MstUniverse.h
 *  Universes: collision and dynamics in one. Includes all of Mst.h.
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
 * a million times the mass scale makes joints and contacts yield by 1e-7 of the length scale (epsilon F h² / gamma); a
 * body of up to 10 000 times the mass scale sinks under its own weight by no more than 1e-9 of it. MdtWorldSetEpsilon
 * on the universe's world replaces this value by an absolute one; the softer joints and contacts of the Dynamics guide
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
/** Its parts, which the universe owns. Null, with a warning, if @a u is no universe. */
MEPUBLIC MdtWorldID MEAPI MstUniverseGetWorld(const MstUniverseID u);
/** For its geometries, such as McdBoxCreate. */
MEPUBLIC McdFrameworkID MEAPI MstUniverseGetFramework(const MstUniverseID u);
/** For queries. Between steps it is inside a change block. */
MEPUBLIC McdSpaceID MEAPI MstUniverseGetSpace(const MstUniverseID u);
/** For materials, callbacks and events. */
MEPUBLIC MstBridgeID MEAPI MstUniverseGetBridge(const MstUniverseID u);
/**
 * Moves the origin to the point @a shift, between steps: all coordinates lose it, those of bodies, models, joints,
 * contacts, boxes, vehicles and movers, with what the universe keeps of them, so that contacts, warm starts and
 * touches go on, and sleepers sleep on. Matrices that the program has given to models without a body, or as references
 * of relative ones, are written to, each once. It is for worlds that are so large that coordinates have no digits
 * left. Coordinates that are shifted without rounding move on bit for bit as without the shift. Events of the last
 * step keep the old coordinates. A shift that is not finite, or that takes a body or mover beyond its bound, gets a
 * warning, and changes nothing. Beyond Karma.
 */
MEPUBLIC void MEAPI MstUniverseShiftOrigin(const MstUniverseID u, const MeVector3 shift);

/**
 * Pushes the universe's bodies away from a point, between steps. A body's impulse acts on its centre of mass, along
 * the line from the point to it. For each of its models it is
 *
 *     impulse A (1 - d / radius)^falloff,   0 for d >= radius
 *
 * with d the distance of the point from the box of the model's geometry, along the geometry's own axes, and A the area
 * of that box's shadow along the line. It acts as MdtBodyAddImpulse does, in the next step, and wakes sleepers. Fixed
 * models, kinematic bodies, disabled bodies, sensors, and a body whose centre is at the point get none. Beyond Karma.
 * @param position   m
 * @param radius     m, > 0
 * @param impulse    N s/m², of a surface at the point; negative: pulls
 * @param falloff    >= 0; 0: the same everywhere within the radius, 1: linear
 * @param isShielded whether a fixed model or a kinematic body shields those whose centre of mass is behind it, or all,
 *                   if the point is within it. If so, the space ends its change block and begins another
 * @return the number of models whose body is pushed. Bad input: 0, with a warning
 */
MEPUBLIC int MEAPI MstUniverseExplode(const MstUniverseID u, const MeVector3 position, const MeReal radius,
                                      const MeReal impulse, const MeReal falloff, const MeBool isShielded);

ME_END_C

#include "Mst.h"

#endif
