/** @file McdFrame.h
 *  The collision framework: which geometry types there are and how pairs of them interact (User Guide ch. 4, "Register
 *  Types of Geometries to be Used").
 *
 *  Only what is registered is linked and run: the Mcd*RegisterType and Mcd*RegisterInteraction functions bring in one
 *  type or pair each, those of McdPrimitives.h many. A pair without an interaction never touches; asking for it gets
 *  one warning per pair of types.
 *
 *  Programs include this header for all of collision: at its end it brings Mcd.h.
 */
#ifndef MCDFRAME_H
#define MCDFRAME_H

#include "McdGeometryTypes.h"
#include "MeMemory.h"

ME_BEGIN_C

/**
 * Creates a framework.
 * @param geoTypeMaxCount how many types of its own the program will register, 0 or more.
 * @param modelCount      how many models there may be, 1 or more, or MeNoLimit.
 * @param instanceCount   how many children all aggregate models may have together, 0 or more, or MeNoLimit.
 * @param lengthScale     the length of a medium-sized object; the default contact tolerance is .01 of it.
 * @return null, with a warning, if an argument is out of range. McdTerm destroys it.
 *
 * Karma 1.1 had three arguments; McdInit(types, models, instances) means a length scale of 1.
 */
MEPUBLIC McdFrameworkID MEAPI McdInit(int geoTypeMaxCount, int modelCount, int instanceCount, MeReal lengthScale);
/** What the form with three arguments stands for. */
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
 * Destroys a framework: runs the term actions, then destroys the models and geometries that are left, with a warning
 * that says how many. Spaces of the framework are destroyed before.
 */
MEPUBLIC void MEAPI McdTerm(McdFrameworkID frame);
/** Destroys all models and geometries; the models leave their spaces first, whether in a change block or not. */
MEPUBLIC void MEAPI McdFrameworkDestroyAllModelsAndGeometries(McdFrameworkID frame);
/** Has McdTerm call @a action, the one registered last first (docs/simulation.md, "Callbacks"). */
MEPUBLIC void MEAPI McdFrameworkRegisterTermAction(McdFrameworkID frame, McdTermAction action);
/** How many models there are. */
MEPUBLIC int MEAPI McdFrameworkGetModelCount(McdFrameworkID frame);
/** How many geometries there are. */
MEPUBLIC int MEAPI McdFrameworkGetGeometryCount(McdFrameworkID frame);

/** @name Geometry types
 *  @{ */
/**
 * Registers a geometry type. typeId is a built-in number, or a program's: kMcdGeometryFirstUserType and up, fewer than
 * McdInit was told. Registering a type again changes nothing. Functions may be null: the type then has no such thing.
 * What they may do: docs/simulation.md, "Callbacks".
 */
MEPUBLIC void MEAPI McdFrameworkRegisterGeometryType(McdFrameworkID frame, McdGeometryType typeId, char *typeName,
                                                     McdGeometryDestroyFnPtr destroy, McdGeometryGetAABBFnPtr getAABB,
                                                     McdGeometryGetBSphereFnPtr getBSphere,
                                                     McdGeometryMaximumPointFnPtr maximumPoint,
                                                     McdGeometryGetMassPropertiesFnPtr getMassProperties,
                                                     McdGeometryDebugDrawFnPtr debugDraw);
/** How many types are registered. */
MEPUBLIC MeI16 MEAPI McdFrameworkGetRegisteredTypeCount(McdFrameworkID frame);
/** Is there such a type, and is it registered? */
MEPUBLIC MeBool MEAPI McdFrameworkTypeIsRegistered(McdFrameworkID frame, int typeId);
/** May there be such a type? */
MEPUBLIC MeBool MEAPI McdFrameworkTypeIsValid(McdFrameworkID frame, int typeId);
/** The name of a type, "(not registered)" if it is not. */
MEPUBLIC const char *MEAPI McdFrameworkGetTypeName(McdFrameworkID frame, int typeId);
/** Writes the registered types by MeInfo. */
MEPUBLIC void MEAPI McdFrameworkShowTypes(McdFrameworkID frame);
/** @} */

/** @name Interactions
 *  @{ */
/**
 * Says how pairs whose first model has geoType1 and whose second has geoType2 interact; copied. A pair in the other
 * order is turned round, tested, and its contacts turned back, unless that order has an interaction of its own. What
 * its functions may do: docs/simulation.md, "Callbacks".
 */
MEPUBLIC void MEAPI McdFrameworkSetInteractions(McdFramework *frame, int geoType1, int geoType2,
                                                McdInteractions *interactions);
/** The interaction of that very order, or null. */
MEPUBLIC McdInteractions *MEAPI McdFrameworkGetInteractions(McdFramework *frame, int geoType1, int geoType2);
/** How many times McdHello has met two models of these types without an interaction. */
MEPUBLIC int MEAPI McdFrameworkGetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2);
/** Sets that count; the next warning comes when it is 0. */
MEPUBLIC void MEAPI McdFrameworkSetInteractionsWarned(McdFramework *framework, int geoType1, int geoType2, int count);
/** Says how a line segment meets models of a type. */
MEPUBLIC void MEAPI McdFrameworkSetLineSegInteraction(McdFramework *frame, int geoType,
                                                      McdLineSegIntersectFnPtr intersect);
/** That function, or null. */
MEPUBLIC McdLineSegIntersectFnPtr MEAPI McdFrameworkGetLineSegInteraction(McdFramework *frame, int geoType);
/** Writes by MeInfo which pairs of types interact. */
MEPUBLIC void MEAPI McdFrameworkPrintInteractionTable(McdFramework *frame);
/** @} */

/** @name Defaults
 *  @{ */
/** The request of pairs that have none of their own; kept by pointer. Null sets the built-in one again. */
MEPUBLIC void MEAPI McdFrameworkSetDefaultRequestPtr(McdFrameworkID frame, McdRequest *request);
/** That request. */
MEPUBLIC McdRequest *MEAPI McdFrameworkGetDefaultRequestPtr(McdFrameworkID frame);
/** The contact tolerance of models made from now on: >= 0, m. See McdModelSetContactTolerance. */
MEPUBLIC void MEAPI McdFrameworkSetDefaultContactTolerance(McdFrameworkID frame, MeReal tolerance);
/** That tolerance; at first .01 of McdInit's length scale. */
MEPUBLIC MeReal MEAPI McdFrameworkGetDefaultContactTolerance(McdFrameworkID frame);
/** The length scale given to McdInit. */
MEPUBLIC MeReal MEAPI McdFrameworkGetLengthScale(McdFrameworkID frame);
/** @} */

ME_END_C

/* After the declarations, since its headers need them. */
#include "Mcd.h"

#endif
