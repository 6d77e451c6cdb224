/* The interactions of convex geometries with each other and with planes. */
#include "McdConvexInteractions.h"
#include "McdPlaneIntersect.h"
#include "convex/mcd_kind_i.h"
#include "model/mcd_motion_i.h"
#include "convex/mcd_vector_i.h"
#include "pair/mcd_pair_i.h"
#include <string.h>

static MeBool checkTypes(const McdModelPair *p, int type1, int type2, const char *function) {
    if (mcd_record(p->model1)->instance.geometry->type == type1 &&
        mcd_record(p->model2)->instance.geometry->type == type2)
        return METRUE;
    MeWarning(1, "%s: the models' geometries are of other types, or in the other order", function);
    return MEFALSE;
}

static MeBool checkArguments(McdModelPair *p, McdIntersectResult *result, int type1, int type2, const char *function) {
    if (!p || !result) {
        MeWarning(1, "%s: no %s", function, p ? "result" : "pair");
        return MEFALSE;
    }
    mcd_resultBegin(result, p);
    if (!mcd_resultHasRoom(result, function))
        return MEFALSE;
    const McdModelRecord *m1 = mcd_modelCheck(p->model1, function), *m2 = mcd_modelCheck(p->model2, function);
    return m1 && m2 && checkTypes(p, type1, type2, function);
}

static int convexIntersect(McdModelPair *p, McdIntersectResult *result, int type1, int type2, const char *function) {
    return checkArguments(p, result, type1, type2, function) ? mcd_convexContacts(p, result, function) : 0;
}

static void addManifold(const McdShape *a, const McdShape *b, const double origin[3], McdGeometryInstance *ins1,
                        McdGeometryInstance *ins2, McdReach reach, McdIntersectResult *result) {
    McdManifold m;
    if (mcd_convexManifold(a, b, reach, &m))
        mcd_resultAdd(result, &m, origin, ins1, ins2);
    result->apart = (MeReal)m.minGap;
}

MeBool mcd_convexInstances(McdGeometryInstance *ins1, McdGeometryInstance *ins2, McdReach reach,
                           McdIntersectResult *result) {
    double origin[3];
    McdShape a, b;
    if (!mcd_shapesOf(ins1, ins2, origin, &a, &b))
        return MEFALSE;
    addManifold(&a, &b, origin, ins1, ins2, reach, result);
    return METRUE;
}

MeBool mcd_convexModels(McdModelRecord *m1, McdModelRecord *m2, McdReach reach, McdIntersectResult *result) {
    double origin[3];
    McdShape a, b;
    mcd_pairOrigin(&m1->instance, &m2->instance, origin);
    if (!mcd_shapeInRound(m1, origin, &a) || !mcd_shapeInRound(m2, origin, &b))
        return MEFALSE;
    addManifold(&a, &b, origin, &m1->instance, &m2->instance, reach, result);
    return METRUE;
}

int mcd_convexContacts(McdModelPair *p, McdIntersectResult *result, const char *function) {
    McdGeometryInstance *ins1 = &mcd_record(p->model1)->instance, *ins2 = &mcd_record(p->model2)->instance;
    return mcd_convexInstances(ins1, ins2, mcd_pairReach(p), result) ? mcd_resultEnd(result)
                                                                     : mcd_warnNotPlaced(function);
}

/* mcd_halfSpaceAt with a unit normal; false if the transform is invalid. */
static MeBool unitHalfSpaceAt(const MeMatrix4Ptr tm, const double origin[3], double normal[3], double *offset) {
    if (!tm)
        return MEFALSE;
    mcd_halfSpaceAt(mcd_const(tm), origin, normal, offset);
    const double square = mcd_dot(normal, normal);
    if (!(isfinite(*offset) && isfinite(square) && square > 0))
        return MEFALSE;
    if (fabs(square - 1) > 1e-3) { /* a scaled transform: the plane is the same */
        mcd_scale(normal, normal, 1 / sqrt(square));
        *offset /= sqrt(square);
    }
    return METRUE;
}

static int planeIntersect(McdModelPair *p, McdIntersectResult *result, int type1, int type2, const char *function) {
    return checkArguments(p, result, type1, type2, function) ? mcd_planeContacts(p, result, function) : 0;
}

int mcd_planeContacts(McdModelPair *p, McdIntersectResult *result, const char *function) {
    McdGeometryInstance *ins1 = &mcd_record(p->model1)->instance, *ins2 = &mcd_record(p->model2)->instance;
    const MeBool isSwapped = mcd_isHalfSpace(ins1);
    double origin[3], normal[3], offset;
    McdShape a;
    McdManifold m;
    mcd_pairOrigin(ins1, ins2, origin);
    if (!mcd_shapeOf(isSwapped ? ins2 : ins1, origin, &a) ||
        !unitHalfSpaceAt(mcd_instanceTM(isSwapped ? ins1 : ins2), origin, normal, &offset))
        return mcd_warnNotPlaced(function);
    const McdReach reach = mcd_pairReach(p);
    if (mcd_planeManifold(&a, normal, offset, isSwapped ? mcd_reachSwap(reach) : reach, &m)) {
        if (isSwapped)
            mcd_manifoldSwap(&m);
        mcd_resultAdd(result, &m, origin, ins1, ins2);
    }
    return mcd_resultEnd(result);
}

/* ---- a plane with any convex type -------------------------------------------------------------------------------- */

static int typeOfModel(McdModelID m, const char *function) {
    const McdModelRecord *record = mcd_modelCheck(m, function);
    return record ? record->instance.geometry->type : -1;
}

static int intersectPlaneWithAny(McdModelPair *p, McdIntersectResult *result, const char *function) {
    if (!p || !result)
        return checkArguments(p, result, 0, 0, function);
    const int type1 = typeOfModel(p->model1, function), type2 = typeOfModel(p->model2, function);
    if ((type1 == kMcdGeometryTypePlane) != (type2 == kMcdGeometryTypePlane))
        return planeIntersect(p, result, type1, type2, function);
    mcd_resultBegin(result, p);
    if (type1 >= 0 && type2 >= 0)
        MeWarning(1, "%s: one of the two models must be a plane", function);
    return 0;
}

int MEAPI McdPlaneIntersect(McdModelPair *p, McdIntersectResult *result) {
    return intersectPlaneWithAny(p, result, "McdPlaneIntersect");
}

int MEAPI McdPlaneIntersectTest(McdModelID modplane, McdModelID mod, McdIntersectResult *result) {
    McdModelPair p;
    memset(&p, 0, sizeof p);
    p.model1 = modplane;
    p.model2 = mod;
    const char *const before = MeMessagesAs(__func__); /* so that only the first warning is given */
    if (typeOfModel(modplane, "McdPlaneIntersectTest") != kMcdGeometryTypePlane)
        MeWarning(1, "McdPlaneIntersectTest: the first model must be a plane");
    const int answer = intersectPlaneWithAny(&p, result, "McdPlaneIntersectTest");
    MeMessagesAs(before);
    if (result)
        result->pair = NULL;
    return answer;
}

static int safeTimeOfTypes(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result, int type1, int type2,
                           McdSafeTimeFn safeTime, const char *function) {
    return mcd_safeTimeBegin(p, maxTime, result, function) && checkTypes(p, type1, type2, function) &&
           mcd_safeTimeInputsAreValid(p, function) && safeTime(p, maxTime, result);
}

static MeBool registerPair(McdFramework *frame, int type1, int type2, McdIntersectFn intersect, McdSafeTimeFn safeTime,
                           const char *function) {
    McdInteractions interactions = {.intersectFn = intersect, .safeTimeFn = safeTime};
    if (!mcd_frameCheck(frame, function))
        return MEFALSE;
    return mcd_interactionRegister(frame, type1, type2, &interactions);
}

/* Defines the three functions of a pair of types. */
#define DEFINE_PAIR(X, Y, intersect, safeTime)                                                                         \
    int MEAPI Mcd##X##Y##Intersect(McdModelPair *p, McdIntersectResult *result) {                                      \
        return intersect(p, result, kMcdGeometryType##X, kMcdGeometryType##Y, "Mcd" #X #Y "Intersect");                \
    }                                                                                                                  \
    int MEAPI Mcd##X##Y##SafeTime(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result) {                        \
        return safeTimeOfTypes(p, maxTime, result, kMcdGeometryType##X, kMcdGeometryType##Y, safeTime,                 \
                               "Mcd" #X #Y "SafeTime");                                                                \
    }                                                                                                                  \
    MeBool MEAPI Mcd##X##Y##RegisterInteraction(McdFramework *frame) {                                                 \
        return registerPair(frame, kMcdGeometryType##X, kMcdGeometryType##Y, Mcd##X##Y##Intersect,                     \
                            Mcd##X##Y##SafeTime, "Mcd" #X #Y "RegisterInteraction");                                   \
    }
#define DEFINE_CONVEX(X, Y) DEFINE_PAIR(X, Y, convexIntersect, mcd_safeTimeConvex)
#define DEFINE_PLANE(X, Y)  DEFINE_PAIR(X, Y, planeIntersect, mcd_safeTimePlane)

DEFINE_CONVEX(Sphere, Sphere)
DEFINE_CONVEX(Box, Sphere)
DEFINE_CONVEX(Box, Box)
DEFINE_CONVEX(Box, Cylinder)
DEFINE_CONVEX(Cylinder, Sphere)
DEFINE_CONVEX(Cylinder, Cylinder)
DEFINE_CONVEX(Sphyl, Sphere)
DEFINE_CONVEX(Sphyl, Box)
DEFINE_CONVEX(Sphyl, Cylinder)
DEFINE_CONVEX(Sphyl, Sphyl)
DEFINE_CONVEX(Cone, Sphere)
DEFINE_CONVEX(Cone, Box)
DEFINE_CONVEX(Cone, Cylinder)
DEFINE_CONVEX(Cone, Sphyl)
DEFINE_CONVEX(Cone, Cone)
DEFINE_CONVEX(Cone, ConvexMesh)
DEFINE_CONVEX(Sphere, ConvexMesh)
DEFINE_CONVEX(Box, ConvexMesh)
DEFINE_CONVEX(Cylinder, ConvexMesh)
DEFINE_CONVEX(Sphyl, ConvexMesh)
DEFINE_CONVEX(ConvexMesh, ConvexMesh)
DEFINE_PLANE(Sphere, Plane)
DEFINE_PLANE(Box, Plane)
DEFINE_PLANE(Cylinder, Plane)
DEFINE_PLANE(Sphyl, Plane)
DEFINE_PLANE(Cone, Plane)
DEFINE_PLANE(ConvexMesh, Plane)
DEFINE_PLANE(Plane, ConvexMesh)

MeBool MEAPI McdConvexMeshRegisterBoxAndSphereFns(McdFramework *frame) {
    ME_RETURN_UNDER_OWN_NAME(MeBool, McdSphereConvexMeshRegisterInteraction(frame) &&
                                         McdBoxConvexMeshRegisterInteraction(frame));
}

MeBool MEAPI McdConePrimitivesRegisterInteractions(McdFramework *frame) {
    ME_RETURN_UNDER_OWN_NAME(MeBool,
                             McdConeSphereRegisterInteraction(frame) && McdConeBoxRegisterInteraction(frame) &&
                                 McdConeCylinderRegisterInteraction(frame) && McdConeSphylRegisterInteraction(frame) &&
                                 McdConePlaneRegisterInteraction(frame) && McdConeConeRegisterInteraction(frame));
}
