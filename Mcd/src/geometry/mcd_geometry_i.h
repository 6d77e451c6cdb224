/* Inside Mcd: definitions that the files of the geometry types share. */
#ifndef MCD_GEOMETRY_I_H
#define MCD_GEOMETRY_I_H

#include "geometry/mcd_local_i.h"

/* Defines the functions of McdGeometryDeclare.h except MaximumPoint, UpdateAABB and the line segment's. They check
 * their arguments and call static functions of the file:
 *     MeReal boundingRadius(const McdGeometry *g, MeVector3 center): of the bounding sphere; may set the centre from 0
 *     void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3])
 *     void addMass(const McdGeometry *g, McdMass *sum): the macro's argument; or mcd_addNoMass
 * `kind` is the type's table (mcd_kind_i.h). */
#define MCD_DEFINE_TYPE(Type, addMass)                                                                                 \
    void MEAPI Mcd##Type##Destroy(McdGeometryID g) {                                                                   \
        mcd_geometryDestroyAs(g, kMcdGeometryType##Type, __func__);                                                    \
    }                                                                                                                  \
    void MEAPI Mcd##Type##RegisterType(McdFramework *frame) {                                                          \
        mcd_kindRegister(frame, &kind, __func__);                                                                      \
    }                                                                                                                  \
    MeI16 MEAPI Mcd##Type##GetTypeId(void) {                                                                           \
        return kMcdGeometryType##Type;                                                                                 \
    }                                                                                                                  \
    char *MEAPI Mcd##Type##GetTypeName(const McdGeometryID g) {                                                        \
        static char name[] = #Type;                                                                                    \
        (void)g;                                                                                                       \
        return name;                                                                                                   \
    }                                                                                                                  \
    void MEAPI Mcd##Type##GetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {                        \
        if (!mcd_areGiven(__func__, center, radius, radius))                                                           \
            return;                                                                                                    \
        MeVector3Set(center, 0, 0, 0);                                                                                 \
        *radius = mcd_geometryIs(g, kMcdGeometryType##Type, __func__) ? boundingRadius(g, center) : 0;                 \
    }                                                                                                                  \
    MeI16 MEAPI Mcd##Type##GetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 inertia, MeReal *volume) {    \
        McdMass sum = {.volume = 0};                                                                                   \
        if (!mcd_areGiven(__func__, relTM, inertia, volume) || !mcd_geometryIs(g, kMcdGeometryType##Type, __func__))   \
            return 0;                                                                                                  \
        addMass(g, &sum);                                                                                              \
        return mcd_massStore(&sum, relTM, inertia, volume);                                                            \
    }                                                                                                                  \
    void MEAPI Mcd##Type##DebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {               \
        if (mcd_areGiven(__func__, tm, colour, colour) && mcd_geometryIs(g, kMcdGeometryType##Type, __func__))         \
            draw(g, tm, colour);                                                                                       \
    }

/* MCD_DEFINE_TYPE, and MaximumPoint and UpdateAABB by the file's static `support` (McdLocalSupportFn). */
#define MCD_DEFINE_GEOMETRY_TYPE(Type, addMass)                                                                        \
    MCD_DEFINE_TYPE(Type, addMass)                                                                                     \
    void MEAPI Mcd##Type##MaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {       \
        if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))                                                        \
            return;                                                                                                    \
        MeVector3Set(outPoint, 0, 0, 0);                                                                               \
        if (mcd_instanceIs(ins, kMcdGeometryType##Type, __func__))                                                     \
            mcd_localMaximumPoint(ins, inDir, outPoint, support);                                                      \
    }                                                                                                                  \
    void MEAPI Mcd##Type##UpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {            \
        (void)tight;                                                                                                   \
        if (mcd_instanceIs(ins, kMcdGeometryType##Type, __func__))                                                     \
            mcd_localUpdateAABB(ins, finalTM, support);                                                                \
    }

/* Defines the line segment's functions from the file's static `clip`. */
#define MCD_DEFINE_LINE_SEGMENT(Type)                                                                                  \
    static int MEAPI lineSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,                      \
                                 McdLineSegIntersectResult *outOverlap) {                                              \
        return mcd_localLineSegment(cm, inOrig, inDest, outOverlap, clip);                                             \
    }                                                                                                                  \
    void MEAPI Mcd##Type##LineSegmentRegisterInteraction(McdFramework *frame) {                                        \
        if (mcd_frameCheck(frame, __func__))                                                                           \
            McdFrameworkSetLineSegInteraction(frame, kMcdGeometryType##Type, lineSegment);                             \
    }

#endif
