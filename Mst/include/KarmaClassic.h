/** @file KarmaClassic.h
 *  The calls of Karma 1.0 and 1.1, which had no frameworks: compiles programs that were written for them unchanged.
 *
 *  @code
 *      cc -include KarmaClassic.h program.c ...
 *  @endcode
 *
 *  All of these calls share one framework in the process. McdInit with two arguments creates it, McdTerm() destroys it,
 *  and everything that is created without a framework in between belongs to it. The newer forms remain available: the
 *  number of arguments selects the form or, where that is the same, their types. Calls that fit neither form do not
 *  compile.
 *
 *  @verbatim
 *      McdInit(types, models)                     McdTerm()                          McdGetDefaultRequestPtr()
 *      Mcd...RegisterType(), ...RegisterTypes(), ...RegisterInteractions(), Mcd...TriangleListRegisterInteraction()
 *      McdNullCreate()         McdPlaneCreate()   McdSphereCreate(r)                 McdBoxCreate(x, y, z)
 *      McdCylinderCreate(r, h) McdSphylCreate(r, h)   McdConeCreate(h, r)            McdAggregateCreate(n)
 *      McdConvexMeshCreateHull(vertices, n, fatness)  McdTriangleListCreate(min, max, n, f)
 *      McdSpaceAxisSortCreate(axes, models, pairs, 1) MstBridgeCreate(materials)
 *      MdtFPFOJointSetPosition(joint, bodyindex, x, y, z)
 *  @endverbatim
 *
 *  Before McdInit and after McdTerm() the functions warn that there is no framework, and do nothing or return null.
 *  They are not thread-safe.
 */
#ifndef KARMACLASSIC_H
#define KARMACLASSIC_H

#include "McdAggregate.h"
#include "McdConvexInteractions.h"
#include "McdTriangleList.h"
#include "Mst.h"

ME_BEGIN_C

/** McdInit(types, models): creates the framework, with room for as many children of aggregates as models, and a length
 *  scale of 1. If there is one already, warns and returns it. Null, with a warning, for bad numbers. */
MEPUBLIC McdFrameworkID MEAPI MstClassicInit(int geoTypeMaxCount, int modelCount);
/** McdPrimitivesRegisterTypes; for the process' framework cones are included, as in the classic interface. */
MEPUBLIC void MEAPI MstClassicPrimitivesRegisterTypes(McdFrameworkID frame);
/** McdPrimitivesRegisterInteractions; for the process' framework cones are included. */
MEPUBLIC MeBool MEAPI MstClassicPrimitivesRegisterInteractions(McdFrameworkID frame);
/** McdTerm for the process' framework or another one. */
MEPUBLIC void MEAPI MstClassicTerm(McdFrameworkID frame);
/** The framework; null before McdInit and after McdTerm(). */
MEPUBLIC McdFrameworkID MEAPI MstClassicFramework(void);
/** McdSpaceAxisSortCreate(axes, models, pairs, 1); the last argument is ignored. */
MEPUBLIC McdSpaceID MEAPI MstClassicSpaceAxisSortCreate(int axes, int objectCount, int pairCount, int last);

ME_END_C

#ifdef __cplusplus

inline McdFrameworkID McdInit(int geoTypeMaxCount, int modelCount) {
    return MstClassicInit(geoTypeMaxCount, modelCount);
}
inline void McdTerm() {
    MstClassicTerm(MstClassicFramework());
}
inline McdRequest *McdGetDefaultRequestPtr() {
    return McdFrameworkGetDefaultRequestPtr(MstClassicFramework());
}

#define KARMA_CLASSIC(Result, function)                                                                                \
    inline Result function() {                                                                                         \
        return function(MstClassicFramework());                                                                        \
    }
inline void McdPrimitivesRegisterTypes() {
    MstClassicPrimitivesRegisterTypes(MstClassicFramework());
}
inline MeBool McdPrimitivesRegisterInteractions() {
    return MstClassicPrimitivesRegisterInteractions(MstClassicFramework());
}
KARMA_CLASSIC(void, McdSphereBoxPlaneRegisterTypes)
KARMA_CLASSIC(void, McdSphereBoxPlaneRegisterInteractions)
KARMA_CLASSIC(void, McdNullRegisterType)
KARMA_CLASSIC(void, McdSphereRegisterType)
KARMA_CLASSIC(void, McdBoxRegisterType)
KARMA_CLASSIC(void, McdPlaneRegisterType)
KARMA_CLASSIC(void, McdCylinderRegisterType)
KARMA_CLASSIC(void, McdSphylRegisterType)
KARMA_CLASSIC(void, McdConeRegisterType)
KARMA_CLASSIC(void, McdConvexMeshRegisterType)
KARMA_CLASSIC(void, McdTriangleListRegisterType)
KARMA_CLASSIC(void, McdAggregateRegisterType)
KARMA_CLASSIC(void, McdAggregateRegisterInteractions)
KARMA_CLASSIC(MeBool, McdAggregateGenericRegisterInteractions)
KARMA_CLASSIC(MeBool, McdConvexMeshPrimitivesRegisterInteractions)
KARMA_CLASSIC(MeBool, McdConePrimitivesRegisterInteractions)
KARMA_CLASSIC(MeBool, McdConvexMeshRegisterBoxAndSphereFns)
KARMA_CLASSIC(MeBool, McdSphereTriangleListRegisterInteraction)
KARMA_CLASSIC(MeBool, McdBoxTriangleListRegisterInteraction)
KARMA_CLASSIC(MeBool, McdCylinderTriangleListRegisterInteraction)
KARMA_CLASSIC(MeBool, McdSphylTriangleListRegisterInteraction)
KARMA_CLASSIC(MeBool, McdConvexMeshTriangleListRegisterInteraction)
KARMA_CLASSIC(MeBool, McdConeTriangleListRegisterInteraction)
KARMA_CLASSIC(McdNullID, McdNullCreate)
KARMA_CLASSIC(McdPlaneID, McdPlaneCreate)
#undef KARMA_CLASSIC

inline McdSphereID McdSphereCreate(MeReal r) {
    return McdSphereCreate(MstClassicFramework(), r);
}
inline McdBoxID McdBoxCreate(MeReal dx, MeReal dy, MeReal dz) {
    return McdBoxCreate(MstClassicFramework(), dx, dy, dz);
}
inline McdCylinderID McdCylinderCreate(MeReal r, MeReal h) {
    return McdCylinderCreate(MstClassicFramework(), r, h);
}
inline McdSphylID McdSphylCreate(MeReal r, MeReal h) {
    return McdSphylCreate(MstClassicFramework(), r, h);
}
inline McdConeID McdConeCreate(MeReal length, MeReal lowerRadius) {
    return McdConeCreate(MstClassicFramework(), length, lowerRadius);
}
inline McdAggregateID McdAggregateCreate(int maxChildren) {
    return McdAggregateCreate(MstClassicFramework(), maxChildren);
}
inline McdConvexMeshID McdConvexMeshCreateHull(const MeVector3 *vertices, int vertexCount, MeReal fatnessRadius) {
    return McdConvexMeshCreateHull(MstClassicFramework(), vertices, vertexCount, fatnessRadius);
}
inline McdTriangleListID McdTriangleListCreate(MeVector3 min, MeVector3 max, int triangleMaxCount,
                                               McdTriangleListFnPtr f) {
    return McdTriangleListCreate(MstClassicFramework(), min, max, triangleMaxCount, f);
}
inline McdSpaceID McdSpaceAxisSortCreate(int axes, int objectCount, int pairCount, int last) {
    return MstClassicSpaceAxisSortCreate(axes, objectCount, pairCount, last);
}
inline MstBridgeID MstBridgeCreate(unsigned int maxMaterials) {
    return MstBridgeCreate(MstClassicFramework(), maxMaterials);
}
inline void MdtFPFOJointSetPosition(MdtFPFOJointID j, unsigned int bodyindex, MeReal x, MeReal y, MeReal z) {
    MdtConstraintBodySetPosition(MdtFPFOJointQuaConstraint(j), bodyindex, x, y, z);
}

#else

#undef McdInit
#undef McdSpaceAxisSortCreate

/* The last element of a list of the process' framework and the arguments: the argument or, if there is none, the
 * process' framework. */
#define KARMA_FRAMES(...) ((McdFrameworkID[]){__VA_ARGS__})
#define KARMA_FRAME(...)                                                                                               \
    (KARMA_FRAMES(MstClassicFramework(), __VA_ARGS__)[sizeof KARMA_FRAMES(0, __VA_ARGS__) / sizeof(McdFrameworkID) - 1])
/* The n-th argument: which one that is depends on the number of arguments before it, and so selects the form of a
 * call. */
#define KARMA_THIRD(a, b, c, ...)          c
#define KARMA_FOURTH(a, b, c, d, ...)      d
#define KARMA_FIFTH(a, b, c, d, e, ...)    e
#define KARMA_SIXTH(a, b, c, d, e, f, ...) f

#define KarmaInit2(t, m)       MstClassicInit((t), (m))
#define KarmaInit3(t, m, i)    McdInitUnscaled((t), (m), (i))
#define KarmaInit4(t, m, i, s) (McdInit)((t), (m), (i), (s))
#define McdInit(...)                                                                                                   \
    KARMA_FIFTH(__VA_ARGS__, KarmaInit4, KarmaInit3, KarmaInit2, McdInit_takes_2_to_4_arguments, 0)(__VA_ARGS__)
#define McdTerm(...)              MstClassicTerm(KARMA_FRAME(__VA_ARGS__))
#define McdGetDefaultRequestPtr() McdFrameworkGetDefaultRequestPtr(MstClassicFramework())

#define McdPrimitivesRegisterTypes(...)              MstClassicPrimitivesRegisterTypes(KARMA_FRAME(__VA_ARGS__))
#define McdSphereBoxPlaneRegisterTypes(...)          (McdSphereBoxPlaneRegisterTypes)(KARMA_FRAME(__VA_ARGS__))
#define McdSphereBoxPlaneRegisterInteractions(...)   (McdSphereBoxPlaneRegisterInteractions)(KARMA_FRAME(__VA_ARGS__))
#define McdNullRegisterType(...)                     (McdNullRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdSphereRegisterType(...)                   (McdSphereRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdBoxRegisterType(...)                      (McdBoxRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdPlaneRegisterType(...)                    (McdPlaneRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdCylinderRegisterType(...)                 (McdCylinderRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdSphylRegisterType(...)                    (McdSphylRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdConeRegisterType(...)                     (McdConeRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdConvexMeshRegisterType(...)               (McdConvexMeshRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdTriangleListRegisterType(...)             (McdTriangleListRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdAggregateRegisterType(...)                (McdAggregateRegisterType)(KARMA_FRAME(__VA_ARGS__))
#define McdAggregateRegisterInteractions(...)        (McdAggregateRegisterInteractions)(KARMA_FRAME(__VA_ARGS__))
#define McdAggregateGenericRegisterInteractions(...) (McdAggregateGenericRegisterInteractions)(KARMA_FRAME(__VA_ARGS__))
#define McdPrimitivesRegisterInteractions(...)       MstClassicPrimitivesRegisterInteractions(KARMA_FRAME(__VA_ARGS__))
#define McdConvexMeshPrimitivesRegisterInteractions(...)                                                               \
    (McdConvexMeshPrimitivesRegisterInteractions)(KARMA_FRAME(__VA_ARGS__))
#define McdConePrimitivesRegisterInteractions(...) (McdConePrimitivesRegisterInteractions)(KARMA_FRAME(__VA_ARGS__))
#define McdConvexMeshRegisterBoxAndSphereFns(...)  (McdConvexMeshRegisterBoxAndSphereFns)(KARMA_FRAME(__VA_ARGS__))
#define McdSphereTriangleListRegisterInteraction(...)                                                                  \
    (McdSphereTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdBoxTriangleListRegisterInteraction(...) (McdBoxTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdCylinderTriangleListRegisterInteraction(...)                                                                \
    (McdCylinderTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdSphylTriangleListRegisterInteraction(...) (McdSphylTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdConvexMeshTriangleListRegisterInteraction(...)                                                              \
    (McdConvexMeshTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdConeTriangleListRegisterInteraction(...) (McdConeTriangleListRegisterInteraction)(KARMA_FRAME(__VA_ARGS__))
#define McdNullCreate(...)                          (McdNullCreate)(KARMA_FRAME(__VA_ARGS__))
#define McdPlaneCreate(...)                         (McdPlaneCreate)(KARMA_FRAME(__VA_ARGS__))

#define KarmaSphereCreateClassic(r)    (McdSphereCreate)(MstClassicFramework(), (r))
#define KarmaSphereCreateNow(frame, r) (McdSphereCreate)((frame), (r))

#define McdSphereCreate(...) KARMA_THIRD(__VA_ARGS__, KarmaSphereCreateNow, KarmaSphereCreateClassic, 0)(__VA_ARGS__)

#define KarmaAggregateCreateClassic(n)    (McdAggregateCreate)(MstClassicFramework(), (n))
#define KarmaAggregateCreateNow(frame, n) (McdAggregateCreate)((frame), (n))
#define McdAggregateCreate(...)                                                                                        \
    KARMA_THIRD(__VA_ARGS__, KarmaAggregateCreateNow, KarmaAggregateCreateClassic, 0)(__VA_ARGS__)
#define KarmaCylinderCreateClassic(r, h)    (McdCylinderCreate)(MstClassicFramework(), (r), (h))
#define KarmaCylinderCreateNow(frame, r, h) (McdCylinderCreate)((frame), (r), (h))
#define McdCylinderCreate(...)                                                                                         \
    KARMA_FOURTH(__VA_ARGS__, KarmaCylinderCreateNow, KarmaCylinderCreateClassic,                                      \
                 McdCylinderCreate_takes_2_or_3_arguments, 0)                                                          \
    (__VA_ARGS__)
#define KarmaSphylCreateClassic(r, h)    (McdSphylCreate)(MstClassicFramework(), (r), (h))
#define KarmaSphylCreateNow(frame, r, h) (McdSphylCreate)((frame), (r), (h))
#define McdSphylCreate(...)                                                                                            \
    KARMA_FOURTH(__VA_ARGS__, KarmaSphylCreateNow, KarmaSphylCreateClassic, McdSphylCreate_takes_2_or_3_arguments, 0)  \
    (__VA_ARGS__)
#define KarmaConeCreateClassic(h, r)    (McdConeCreate)(MstClassicFramework(), (h), (r))
#define KarmaConeCreateNow(frame, h, r) (McdConeCreate)((frame), (h), (r))
#define McdConeCreate(...)                                                                                             \
    KARMA_FOURTH(__VA_ARGS__, KarmaConeCreateNow, KarmaConeCreateClassic, McdConeCreate_takes_2_or_3_arguments, 0)     \
    (__VA_ARGS__)
#define KarmaBoxCreateClassic(x, y, z)    (McdBoxCreate)(MstClassicFramework(), (x), (y), (z))
#define KarmaBoxCreateNow(frame, x, y, z) (McdBoxCreate)((frame), (x), (y), (z))
#define McdBoxCreate(...)                                                                                              \
    KARMA_FIFTH(__VA_ARGS__, KarmaBoxCreateNow, KarmaBoxCreateClassic, McdBoxCreate_takes_3_or_4_arguments,            \
                McdBoxCreate_takes_3_or_4_arguments, 0)                                                                \
    (__VA_ARGS__)
#define KarmaConvexMeshCreateHullClassic(v, n, fat)    (McdConvexMeshCreateHull)(MstClassicFramework(), (v), (n), (fat))
#define KarmaConvexMeshCreateHullNow(frame, v, n, fat) (McdConvexMeshCreateHull)((frame), (v), (n), (fat))
#define McdConvexMeshCreateHull(...)                                                                                   \
    KARMA_FIFTH(__VA_ARGS__, KarmaConvexMeshCreateHullNow, KarmaConvexMeshCreateHullClassic,                           \
                McdConvexMeshCreateHull_takes_3_or_4_arguments, McdConvexMeshCreateHull_takes_3_or_4_arguments, 0)     \
    (__VA_ARGS__)
#define KarmaTriangleListCreateClassic(min, max, n, f)                                                                 \
    (McdTriangleListCreate)(MstClassicFramework(), (min), (max), (n), (f))
#define KarmaTriangleListCreateNow(frame, min, max, n, f) (McdTriangleListCreate)((frame), (min), (max), (n), (f))
#define McdTriangleListCreate(...)                                                                                     \
    KARMA_SIXTH(__VA_ARGS__, KarmaTriangleListCreateNow, KarmaTriangleListCreateClassic,                               \
                McdTriangleListCreate_takes_4_or_5_arguments, McdTriangleListCreate_takes_4_or_5_arguments,            \
                McdTriangleListCreate_takes_4_or_5_arguments, 0)                                                       \
    (__VA_ARGS__)

/* Four arguments: the newer form begins with a framework, the classic one with axes. */
#define KarmaSpace4(a, b, c, d)                                                                                        \
    _Generic((a), McdFrameworkID                                                                                       \
             : (McdSpaceAxisSortCreate), default                                                                       \
             : MstClassicSpaceAxisSortCreate)((a), (b), (c), (d))
#define KarmaSpace5(f, a, o, p, last) ((void)(last), (McdSpaceAxisSortCreate)((f), (a), (o), (p)))
#define McdSpaceAxisSortCreate(...)                                                                                    \
    KARMA_SIXTH(__VA_ARGS__, KarmaSpace5, KarmaSpace4, McdSpaceAxisSortCreate_takes_4_or_5_arguments,                  \
                McdSpaceAxisSortCreate_takes_4_or_5_arguments, McdSpaceAxisSortCreate_takes_4_or_5_arguments, 0)       \
    (__VA_ARGS__)
#define KarmaBridgeCreateClassic(n)    (MstBridgeCreate)(MstClassicFramework(), (n))
#define KarmaBridgeCreateNow(frame, n) (MstBridgeCreate)((frame), (n))

#define MstBridgeCreate(...) KARMA_THIRD(__VA_ARGS__, KarmaBridgeCreateNow, KarmaBridgeCreateClassic, 0)(__VA_ARGS__)

#define KarmaFPFOJointSetPosition4(j, x, y, z) (MdtFPFOJointSetPosition)((j), (x), (y), (z))
#define KarmaFPFOJointSetPosition5(j, k, x, y, z)                                                                      \
    MdtConstraintBodySetPosition(MdtFPFOJointQuaConstraint(j), (k), (x), (y), (z))
#define MdtFPFOJointSetPosition(...)                                                                                   \
    KARMA_SIXTH(__VA_ARGS__, KarmaFPFOJointSetPosition5, KarmaFPFOJointSetPosition4,                                   \
                MdtFPFOJointSetPosition_takes_4_or_5_arguments, MdtFPFOJointSetPosition_takes_4_or_5_arguments,        \
                MdtFPFOJointSetPosition_takes_4_or_5_arguments, 0)                                                     \
    (__VA_ARGS__)

#endif

#endif
