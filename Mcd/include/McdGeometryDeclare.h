/** @file McdGeometryDeclare.h
 *  The functions that every built-in geometry type has. Each type's header declares them by these macros; programs
 *  usually call only the first.
 *
 *  @verbatim
 *  Mcd...RegisterType          Registers the type with a framework, before its first geometry is created; repeated
 *                              calls have no effect.
 *  Mcd...GetTypeId             The type's number in McdGeometryTypes.h.
 *  Mcd...GetTypeName           The type's name, a constant; the argument is ignored.
 *  @endverbatim
 *  McdGeometry.h and McdGeometryInstance.h call the other functions for any type: use those instead. For a geometry
 *  or instance of another type: a warning, and results are 0.
 *  @verbatim
 *  Mcd...Destroy               McdGeometryDestroy for a geometry of that type. Destroyed geometries are ignored.
 *  Mcd...GetBSphere            A bounding sphere of the geometry, in its own frame.
 *  Mcd...GetMassProperties     As McdGeometryGetMassProperties, which sets everything to 0 before.
 *  Mcd...MaximumPoint          The instance's point (world) that is farthest in a direction (world, any length).
 *  Mcd...UpdateAABB            Sets the instance's box: around the instance at its transform and, unless finalTM is
 *                              null, at finalTM. Rounded outward. Exact whether tight or not.
 *  Mcd...DebugDraw             Draws by MeDebugDrawAPI.
 *  Mcd...LineSegmentRegisterInteraction
 *                              Registers the intersection of line segments with models of that type, for
 *                              McdLineSegIntersect and spaces. A segment that begins inside: distance 0, normal 0.
 *  @endverbatim
 */
#ifndef MCDGEOMETRYDECLARE_H
#define MCDGEOMETRYDECLARE_H

#include "McdGeometryTypes.h"

/** Declares all functions but Destroy, GetMassProperties and LineSegmentRegisterInteraction. */
#define MCD_DECLARE_GEOMETRY_QUERIES(Type)                                                                             \
    MEPUBLIC void MEAPI Mcd##Type##RegisterType(McdFramework *frame);                                                  \
    MEPUBLIC MeI16 MEAPI Mcd##Type##GetTypeId(void);                                                                   \
    MEPUBLIC char *MEAPI Mcd##Type##GetTypeName(const McdGeometryID g);                                                \
    MEPUBLIC void MEAPI Mcd##Type##GetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);                \
    MEPUBLIC void MEAPI Mcd##Type##MaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir,                        \
                                                MeReal *const outPoint);                                               \
    MEPUBLIC void MEAPI Mcd##Type##UpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);    \
    MEPUBLIC void MEAPI Mcd##Type##DebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3])

/** Declares all functions but LineSegmentRegisterInteraction. */
#define MCD_DECLARE_GEOMETRY_TYPE(Type)                                                                                \
    MCD_DECLARE_GEOMETRY_QUERIES(Type);                                                                                \
    MEPUBLIC void MEAPI Mcd##Type##Destroy(McdGeometryID g);                                                           \
    MEPUBLIC MeI16 MEAPI Mcd##Type##GetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia,             \
                                                      MeReal *volume)

/** Declares LineSegmentRegisterInteraction. */
#define MCD_DECLARE_LINE_SEGMENT(Type)                                                                                 \
    MEPUBLIC void MEAPI Mcd##Type##LineSegmentRegisterInteraction(McdFramework *frame)

/* After the macros: McdFrame.h includes the headers of all types, which use them. */
#include "McdFrame.h"

#endif
