/* Inside Mcd: definitions that the files of the geometry types share. */
#ifndef MCD_GEOMETRY_I_H
#define MCD_GEOMETRY_I_H

#include "geometry/mcd_local_i.h"

#define MCD_DEFINE_DESTROY(Type)                                                                                       \
    void MEAPI Mcd##Type##Destroy(McdGeometryID g) {                                                                   \
        mcd_geometryDestroyAs(g, kMcdGeometryType##Type, "Mcd" #Type "Destroy");                                       \
    }

/* Defines the functions of McdGeometryDeclare.h that follow from the file's static `kind` (mcd_kind_i.h) and
 * `support`; the type's own file has the others. */
#define MCD_DEFINE_GEOMETRY_TYPE(Type)                                                                                 \
    MCD_DEFINE_DESTROY(Type)                                                                                           \
    void MEAPI Mcd##Type##RegisterType(McdFramework *frame) {                                                          \
        mcd_kindRegister(frame, &kind, "Mcd" #Type "RegisterType");                                                    \
    }                                                                                                                  \
    MeI16 MEAPI Mcd##Type##GetTypeId(void) {                                                                           \
        return kMcdGeometryType##Type;                                                                                 \
    }                                                                                                                  \
    char *MEAPI Mcd##Type##GetTypeName(const McdGeometryID g) {                                                        \
        static char name[] = #Type;                                                                                    \
        (void)g;                                                                                                       \
        return name;                                                                                                   \
    }                                                                                                                  \
    void MEAPI Mcd##Type##MaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {       \
        if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))                                                        \
            return;                                                                                                    \
        MeVector3Set(outPoint, 0, 0, 0);                                                                               \
        if (mcd_instanceIs(ins, kMcdGeometryType##Type, "Mcd" #Type "MaximumPoint"))                                   \
            mcd_localMaximumPoint(ins, inDir, outPoint, support);                                                      \
    }                                                                                                                  \
    void MEAPI Mcd##Type##UpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {            \
        (void)tight;                                                                                                   \
        if (mcd_instanceIs(ins, kMcdGeometryType##Type, "Mcd" #Type "UpdateAABB"))                                     \
            mcd_localUpdateAABB(ins, finalTM, support);                                                                \
    }

/* Defines the line segment's functions from the file's static `clip`. */
#define MCD_DEFINE_LINE_SEGMENT(Type)                                                                                  \
    static int MEAPI lineSegment(const McdModelID cm, MeReal *const inOrig, MeReal *const inDest,                      \
                                 McdLineSegIntersectResult *outOverlap) {                                              \
        return mcd_localLineSegment(cm, inOrig, inDest, outOverlap, clip);                                             \
    }                                                                                                                  \
    void MEAPI Mcd##Type##LineSegmentRegisterInteraction(McdFramework *frame) {                                        \
        if (mcd_frameCheck(frame, "Mcd" #Type "LineSegmentRegisterInteraction"))                                       \
            McdFrameworkSetLineSegInteraction(frame, kMcdGeometryType##Type, lineSegment);                             \
    }

#endif
