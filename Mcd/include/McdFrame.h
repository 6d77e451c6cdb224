/** @file McdFrame.h
 *  The collision framework: registry of geometry types and of interactions between them.
 *
 *  Only what is registered is linked: each Mcd*RegisterType and Mcd*RegisterInteraction function adds one type or
 *  pair, those of McdPrimitives.h several. A pair of types without an interaction never touches; McdHello warns once
 *  per pair of types.
 *
 *  Programs need to include only this header for collision: at its end it includes Mcd.h.
 */
#ifndef MCDFRAME_H
#define MCDFRAME_H

#include "McdGeometryTypes.h"
#include "MeMemory.h"

ME_BEGIN_C

/**
 * Creates a framework.
 * @param geoTypeMaxCount the maximum number of the program's own geometry types, 0 or more.
 * @param modelCount      the maximum number of models, 1 or more, or MeNoLimit.
 * @param instanceCount   the maximum number of children of all aggregates' models together, 0 or more, or MeNoLimit.
 * @param lengthScale     the length of a medium-sized object; the default contact tolerance is .01 of it.
 * @return null, with a warning, if an argument is out of range. McdTerm destroys it.
 *
 * Karma 1.1 had three arguments; McdInit(types, models, instances) uses a length scale of 1.
 */
MEPUBLIC McdFrameworkID MEAPI McdInit(int geoTypeMaxCount, int modelCount, int instanceCount, MeReal lengthScale);
/** The form with three arguments. */
MEPUBLIC McdFrameworkID MEAPI McdInitUnscaled(int geoTypeMaxCount, int modelCount, int instanceCount);
#ifdef __cplusplus
ME_END_C
inline McdFrameworkID McdInit(int types, int models, int instances) {
    return McdInitUnscaled(types, models, instances);
}
ME_BEGIN_C
#else
#define MCD_FIFTH(a, b, c, d, e, ...) e
#define McdInitWith3(t, m, i)         McdInitUnscaled((t), (m), (i))
#define McdInitWith4(t, m, i, s)      (McdInit)((t), (m), (i), (s))
#define McdInit(...)                                                                                                   \
    MCD_FIFTH(__VA_ARGS__, McdInitWith4, McdInitWith3, McdInit_takes_3_or_4_arguments, McdInit_takes_3_or_4_arguments, \
              0)                                                                                                       \
    (__VA_ARGS__)
#endif
/**
 * Destroys a framework: runs the term actions, then destroys the remaining models and geometries, with a warning that
 * gives their numbers. Its spaces must be destroyed before.
 */
MEPUBLIC void MEAPI McdTerm(McdFrameworkID frame);
/** Destroys all models and geometries; models are first removed from their spaces, inside or outside of a change
 *  block. */
MEPUBLIC void MEAPI McdFrameworkDestroyAllModelsAndGeometries(McdFrameworkID frame);
/** Registers an action for McdTerm; actions are called in reverse order of registration (docs/simulation.md,
 *  "Callbacks"). */
MEPUBLIC void MEAPI McdFrameworkRegisterTermAction(McdFrameworkID frame, McdTermAction action);
/** The number of models. */
MEPUBLIC int MEAPI McdFrameworkGetModelCount(McdFrameworkID frame);
/** The number of geometries. */
MEPUBLIC int MEAPI McdFrameworkGetGeometryCount(McdFrameworkID frame);

/** @name Geometry types
 *  @{ */
/**
 * Registers a geometry type. typeId is a built-in number, or a program's: kMcdGeometryFirstUserType and up, at most
 * McdInit's geoTypeMaxCount of them. Registering a type again changes nothing. Functions may be null: the type does not
 * support them. What they may do: docs/simulation.md, "Callbacks".
 */
MEPUBLIC void MEAPI McdFrameworkRegisterGeometryType(McdFrameworkID frame, McdGeometryType typeId, char *typeName,
                                                     McdGeometryDestroyFnPtr destroy, McdGeometryGetAABBFnPtr getAABB,
                                                     McdGeometryGetBSphereFnPtr getBSphere,
                                                     McdGeometryMaximumPointFnPtr maximumPoint,
                                                     McdGeometryGetMassPropertiesFnPtr getMassProperties,
                                                     McdGeometryDebugDrawFnPtr debugDraw);
/** The number of registered types. */
MEPUBLIC MeI16 MEAPI McdFrameworkGetRegisteredTypeCount(McdFrameworkID frame);
/** Whether the type is registered; 0 for numbers out of range. */
MEPUBLIC MeBool MEAPI McdFrameworkTypeIsRegistered(McdFrameworkID frame, int typeId);
/** Whether the number is in the range of types of this framework. */
MEPUBLIC MeBool MEAPI McdFrameworkTypeIsValid(McdFrameworkID frame, int typeId);
/** The name of a type; "(not registered)" if it is not. */
MEPUBLIC const char *MEAPI McdFrameworkGetTypeName(McdFrameworkID frame, int typeId);
/** Prints the registered types by MeInfo. */
MEPUBLIC void MEAPI McdFrameworkShowTypes(McdFrameworkID frame);
/** @} */

/** @name Interactions
 *  @{ */
/**
 * Sets the interaction of pairs whose first model has geoType1 and whose second has geoType2; copied; null: none. A
 * pair in the other order is tested with its models swapped, and its contacts are swapped back, unless that order has
 * an interaction of its own. What the functions may do: docs/simulation.md, "Callbacks".
 */
MEPUBLIC void MEAPI McdFrameworkSetInteractions(McdFramework *frame, int geoType1, int geoType2,
                                                McdInteractions *interactions);
/** The interaction for exactly this order, or null. */
MEPUBLIC McdInteractions *MEAPI McdFrameworkGetInteractions(McdFramework *frame, int geoType1, int geoType2);
/** The number of times that McdHello found no interaction for these types. */
MEPUBLIC int MEAPI McdFrameworkGetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2);
/** Sets that count. McdHello warns only when it is 0: setting it to 0 re-arms the warning, another value silences
 *  it. */
MEPUBLIC void MEAPI McdFrameworkSetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2, int count);
/** Sets the function that intersects line segments with models of a type; null: none. */
MEPUBLIC void MEAPI McdFrameworkSetLineSegInteraction(McdFramework *frame, int geoType,
                                                      McdLineSegIntersectFnPtr intersect);
/** The function that intersects line segments with models of a type, or null. */
MEPUBLIC McdLineSegIntersectFnPtr MEAPI McdFrameworkGetLineSegInteraction(McdFramework *frame, int geoType);
/** Prints by MeInfo which pairs of types interact. */
MEPUBLIC void MEAPI McdFrameworkPrintInteractionTable(McdFramework *frame);
/** @} */

/** @name Defaults
 *  @{ */
/** Sets the request of pairs without their own; kept by pointer. Null restores the built-in one. */
MEPUBLIC void MEAPI McdFrameworkSetDefaultRequestPtr(McdFrameworkID frame, McdRequest *request);
/** The request of pairs without their own. */
MEPUBLIC McdRequest *MEAPI McdFrameworkGetDefaultRequestPtr(McdFrameworkID frame);
/** Sets the contact tolerance of models that are created later: >= 0, m. See McdModelSetContactTolerance. */
MEPUBLIC void MEAPI McdFrameworkSetDefaultContactTolerance(McdFrameworkID frame, MeReal tolerance);
/** The contact tolerance of models that are created later; initially .01 of McdInit's length scale. */
MEPUBLIC MeReal MEAPI McdFrameworkGetDefaultContactTolerance(McdFrameworkID frame);
/** The length scale given to McdInit. */
MEPUBLIC MeReal MEAPI McdFrameworkGetLengthScale(McdFrameworkID frame);
/** @} */

ME_END_C

/* After the declarations, since Mcd.h's headers need them. */
#include "Mcd.h"

#endif
