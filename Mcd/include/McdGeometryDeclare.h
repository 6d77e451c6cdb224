/** @file McdGeometryDeclare.h
 *  The functions that every built-in geometry type has (User Guide ch. 4, "Geometrical Types and Their Interactions").
 *  Each type's header declares them by these macros; programs seldom call any but the first.
 *
 *  @verbatim
 *  Mcd...RegisterType          Registers the type with a framework; again: nothing. Before its first geometry is made.
 *  Mcd...GetTypeId             Its number in McdGeometryTypes.h.
 *  Mcd...GetTypeName           Its name, a constant; the argument does not matter.
 *  @endverbatim
 *  The others are what McdGeometry.h and McdGeometryInstance.h call for any type: use those instead. A geometry of
 *  another type, or an instance of one, gets a warning, and results are 0.
 *  @verbatim
 *  Mcd...Destroy               McdGeometryDestroy for a geometry of that type. What has gone already is left alone.
 *  Mcd...GetBSphere            A sphere around the geometry, in its own frame.
 *  Mcd...GetMassProperties     As McdGeometryGetMassProperties, which sets everything to 0 before.
 *  Mcd...MaximumPoint          The instance's point (world) that is farthest in a direction (world, any length).
 *  Mcd...UpdateAABB            Sets the instance's box: around where it is and, unless finalTM is null, around where
 *                              finalTM puts it. Never too small by rounding. Exact whether tight or not.
 *  Mcd...DebugDraw             Draws by MeDebugDrawAPI.
 *  Mcd...LineSegmentRegisterInteraction  Has McdLineSegIntersect, and spaces, intersect line segments with models of
 *                              that type. Where a segment begins inside: distance 0, normal (0, 0, 0).
 *  @endverbatim
 */
#ifndef MCDGEOMETRYDECLARE_H
#define MCDGEOMETRYDECLARE_H

#include "McdGeometryTypes.h"

/** All but Destroy, GetMassProperties and the line segment's. */
#define MCD_DECLARE_GEOMETRY_QUERIES(Type)                                                                             \
    MEPUBLIC void MEAPI Mcd##Type##RegisterType(McdFramework *frame);                                                  \
    MEPUBLIC MeI16 MEAPI Mcd##Type##GetTypeId(void);                                                                   \
    MEPUBLIC char *MEAPI Mcd##Type##GetTypeName(const McdGeometryID g);                                                \
    MEPUBLIC void MEAPI Mcd##Type##GetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);                \
    MEPUBLIC void MEAPI Mcd##Type##MaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir,                        \
                                                MeReal *const outPoint);                                               \
    MEPUBLIC void MEAPI Mcd##Type##UpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);    \
    MEPUBLIC void MEAPI Mcd##Type##DebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3])

/** All but the line segment's. */
#define MCD_DECLARE_GEOMETRY_TYPE(Type)                                                                                \
    MCD_DECLARE_GEOMETRY_QUERIES(Type);                                                                                \
    MEPUBLIC void MEAPI Mcd##Type##Destroy(McdGeometryID g);                                                           \
    MEPUBLIC MeI16 MEAPI Mcd##Type##GetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia,             \
                                                      MeReal *volume)

/** The line segment's. */
#define MCD_DECLARE_LINE_SEGMENT(Type)                                                                                 \
    MEPUBLIC void MEAPI Mcd##Type##LineSegmentRegisterInteraction(McdFramework *frame)

/* After the macros: it brings the headers of all primitives, which use them. */
#include "McdFrame.h"

#endif
