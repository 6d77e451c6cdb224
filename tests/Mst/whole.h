/* A universe with one of everything in it: all geometries, most joints, materials with callbacks, events, a sensor, a
 * fast ball, sleep, a report, rays, and things that are destroyed on the way. Nothing in it minds nulls, so that it can
 * be run with memory that fails. */
#ifndef WHOLE_H
#define WHOLE_H

#include "Mst.h"
#include "karma_test.h"

enum { WHOLE_MODELS = 24, WHOLE_HEIGHTS = 8 };

typedef struct Whole {
    MstUniverseID u;
    McdModelID model[WHOLE_MODELS];
    int count;
    MeMatrix4 groundTM, fieldTM, listTM, sensorTM, partTM[2]; /* kept by pointer */
    MeReal height[WHOLE_HEIGHTS * WHOLE_HEIGHTS];
    MeVector3 corner[4];
    MeMatrix4 meshTM;
    McdCullingTable *culling;
    int touches, broken;
} Whole;

static inline MeBool whole_seesContact(McdIntersectResult *result, McdContact *c, MdtContactID d) {
    (void)result, (void)c, (void)d;
    return METRUE;
}

static inline void whole_touch(const MstEvent *event) {
    (void)event;
}

/* Two triangles that are one square. */
static inline int MEAPI whole_triangles(McdModelPair *p, McdUserTriangle *t, MeVector3 p0, MeReal radius, int max) {
    MeVector3 *corner = McdTriangleListGetUserData(McdModelGetGeometry(p->model2));
    static const int of[2][3] = {{0, 1, 2}, {0, 2, 3}};
    int n = 0;
    (void)p0, (void)radius;
    for (; corner && n < 2 && n < max; n++) {
        memset(&t[n], 0, sizeof t[n]);
        for (int k = 0; k < 3; k++)
            t[n].vertices[k] = &corner[of[n][k]];
        t[n].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleTwoSided);
    }
    return n;
}

static inline McdModelID whole_add(Whole *s, McdGeometryID g, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(s->u, g, 1000);
    MeMatrix4 relative;
    MeMatrix3 inertia;
    MeReal volume;
    if (!m)
        return 0;
    McdGeometryGetMassProperties(g, relative, inertia, &volume);
    MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(m), relative[3]);
    MdtBodySetPosition(McdModelGetBody(m), x, y, z);
    s->model[s->count++] = m;
    return m;
}

static inline McdModelID whole_fixed(Whole *s, McdGeometryID g, MeMatrix4Ptr tm, double x, double y, double z) {
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, x, y, z);
    return MstFixedModelCreate(s->u, g, tm);
}

static inline McdGeometryID whole_hull(McdFrameworkID f) {
    MeVector3 v[12];
    for (int i = 0; i < 12; i++)
        MeVector3Set(v[i], .3 * cos(i * .9), .3 * sin(i * .9), .05 * (i % 5) - .1);
    return McdConvexMeshCreateHull(f, (const MeVector3 *)v, 12, .02);
}

static inline McdGeometryID whole_dumbbell(Whole *s, McdFrameworkID f) {
    const McdGeometryID a = McdAggregateCreate(f, 2);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(s->partTM[i]);
        MeMatrix4TMSetPosition(s->partTM[i], i ? .3 : -.3, 0, 0);
    }
    McdAggregateAddElement(a, McdSphereCreate(f, .2), s->partTM[0]);
    McdAggregateAddElement(a, McdBoxCreate(f, .3, .3, .3), s->partTM[1]);
    return a;
}

static inline void whole_grounds(Whole *s, McdFrameworkID f) {
    MeVector3 low = {-6, -2, -.1}, high = {-2, 2, .1};
    for (int i = 0; i < WHOLE_HEIGHTS * WHOLE_HEIGHTS; i++)
        s->height[i] = (MeReal)(.03 * sin(i));
    for (int i = 0; i < 4; i++)
        MeVector3Set(s->corner[i], i == 1 || i == 2 ? -2 : -6, i > 1 ? 2 : -2, 0);
    whole_fixed(s, McdPlaneCreate(f), s->groundTM, 0, 0, -1);
    whole_fixed(s, McdRGHeightFieldCreate(f, s->height, WHOLE_HEIGHTS, WHOLE_HEIGHTS, 1, 1, 2, -3), s->fieldTM, 0, 0,
                0);
    const McdTriangleListID list = McdTriangleListCreate(f, low, high, 8, whole_triangles);
    McdTriangleListSetUserData(list, s->corner);
    whole_fixed(s, list, s->listTM, 0, 0, 0);
    static const int index[6] = {0, 1, 2, 0, 2, 3};
    static const MeU32 materials[2] = {0, 0};
    whole_fixed(s, McdMeshCreate(f, (const MeVector3 *)s->corner, 4, index, 2, materials), s->meshTM, 8, 0, 0);
    const McdModelID sensor = whole_fixed(s, McdBoxCreate(f, 1, 1, 1), s->sensorTM, 0, 0, 0);
    McdModelSetSensor(sensor, METRUE);
}

static inline void whole_shapes(Whole *s, McdFrameworkID f) {
    for (int i = 0; i < 2; i++) { /* over the triangles, over the field; two of each overlap a little */
        const double x = i ? 4 : -4, z = .25;
        whole_add(s, McdSphereCreate(f, .25), x, 0, z);
        whole_add(s, McdBoxCreate(f, .5, .5, .5), x + .45, 0, z);
        whole_add(s, McdCylinderCreate(f, .2, .5), x, .5, z);
        whole_add(s, McdSphylCreate(f, .2, .4), x + .5, .6, z);
        whole_add(s, McdConeCreate(f, .5, .25), x + 1, 0, z);
        whole_add(s, i ? McdConvexMeshCreateSphyl(f, .2, .2) : whole_hull(f), x, -.6, z);
        whole_add(s, whole_dumbbell(s, f), x + .6, -.6, z);
    }
    const McdModelID fast = whole_add(s, McdSphereCreate(f, .05), 0, 2, 1);
    McdModelSetSwept(fast, METRUE);
    McdModelDynamicsSetLinearVelocity(fast, 0, 0, -200);
    whole_add(s, McdBoxCreate(f, .4, .4, .4), 0, 0, .4); /* in the sensor */
}

static inline void MEAPI whole_userRows(MdtKeaConstraints *const kea, void *const constraint,
                                        const MdtKeaTransformation *const tlist, MdtKeaBody *const blist[],
                                        const void *const params) {
    MdtKeaRow *row = MdtBclAddRow(kea);
    (void)constraint, (void)tlist, (void)blist, (void)params;
    if (row)
        row->J[0].lin[2] = 1;
}

/* A body for each joint, hung up far above everything. */
static inline MdtBodyID whole_hung(Whole *s, int i) {
    const MdtBodyID b = MdtBodyCreate(s->u->world);
    if (b) {
        MdtBodySetPosition(b, (MeReal)i, 0, 20);
        MdtBodyEnable(b);
    }
    return b;
}

#define WHOLE_JOINT(Joint, i)                                                                                          \
    do {                                                                                                               \
        const MdtBodyID b = whole_hung(s, i);                                                                          \
        const Mdt##Joint##ID j = b ? Mdt##Joint##Create(s->u->world) : 0;                                              \
        if (j) {                                                                                                       \
            Mdt##Joint##SetBodies(j, b, 0);                                                                            \
            MdtConstraintSetPosition(Mdt##Joint##QuaConstraint(j), (MeReal)(i) - (MeReal).5, 0, 20);                   \
            Mdt##Joint##Enable(j);                                                                                     \
        }                                                                                                              \
    } while (0)

static inline void whole_joints(Whole *s) {
    WHOLE_JOINT(Hinge, 0);
    WHOLE_JOINT(BSJoint, 1);
    WHOLE_JOINT(Prismatic, 2);
    WHOLE_JOINT(Universal, 3);
    WHOLE_JOINT(CarWheel, 4);
    WHOLE_JOINT(FixedPath, 5);
    WHOLE_JOINT(RPROJoint, 6);
    WHOLE_JOINT(Skeletal, 7);
    WHOLE_JOINT(Angular3, 8);
    WHOLE_JOINT(Linear1, 9);
    WHOLE_JOINT(Linear2, 10);
    WHOLE_JOINT(Spring6, 11);
    WHOLE_JOINT(ConeLimit, 12);
    const MdtBodyID hung = whole_hung(s, 13);
    const MdtSpringID spring = hung ? MdtSpringCreate(s->u->world) : 0;
    if (spring) {
        MdtSpringSetBodies(spring, hung, 0);
        MdtSpringSetPosition(spring, 1, 13, 0, 21);
        MdtSpringEnable(spring);
    }
    const MdtBodyID b = whole_hung(s, 14);
    const MdtUserConstraintID user = b ? MdtUserConstraintCreate(s->u->world) : 0;
    if (user) {
        MdtUserConstraintSetFunction(user, whole_userRows);
        MdtUserConstraintSetBodies(user, b, 0);
        MdtUserConstraintEnable(user);
    }
    const MdtBodyID links[2] = {whole_hung(s, 15), whole_hung(s, 16)};
    const MdtHingeID weak = links[0] && links[1] ? MdtHingeCreate(s->u->world) : 0;
    if (weak) {
        MdtHingeSetBodies(weak, links[0], links[1]);
        MdtConstraintSetBreakLimits(MdtHingeQuaConstraint(weak), 1, 1);
        MdtHingeEnable(weak);
        MdtBodyAddForce(links[0], 1000, 0, 0);
    }
}

static inline void whole_materials(Whole *s) {
    const MstBridgeID b = s->u->bridge;
    const MstMaterialID rough = MstBridgeGetNewMaterial(b), smooth = MstBridgeGetNewMaterial(b);
    const MdtContactParamsID p = MstBridgeGetContactParams(b, rough, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, .6);
    MstBridgeSetPerContactCB(b, rough, 0, whole_seesContact);
    MstBridgeSetTouchCB(b, 0, 0, whole_touch);
    for (int i = 0; i < s->count; i++)
        McdModelSetMaterial(s->model[i], (int)(i % 2 ? rough : smooth));
    MstBridgeSetContactBufferSize(b, 60);
    MstBridgeSetModelPairBufferSize(b, 200);
}

/* What programs do by hand beside stepping. */
static inline void whole_byHand(Whole *s) {
    MeVector3 from = {-4, 0, 3}, to = {-4, 0, -3};
    McdLineSegIntersectResult hit;
    McdContact contact[8];
    memset(contact, 0, sizeof contact);
    for (int i = 0; i < 8; i++)
        contact[i].position[0] = (MeReal)i;
    MstBridgeUpdateTransitions(s->u->bridge, s->u->space, s->u->world);
    McdSpaceEndChanges(s->u->space);
    McdSpaceGetLineSegFirstIntersection(s->u->space, from, to, &hit);
    McdSpaceBeginChanges(s->u->space);
    McdContactSimplify(0, contact, 8, contact, 4, 0, 1);
    McduRequestTableInit(4, 0);
    McduRequestTableTerm();
    McdBatchContextDestroy(McdBatchContextCreate(s->u->frame));
    if (s->count > 1) {
        const McdModelPairID pair = McdModelPairCreate(s->model[0], s->model[1]);
        if (pair) {
            McdHello(pair);
            McdGoodbye(pair);
        }
        McdModelPairDestroy(pair);
        s->culling = McdCullingTableCreate(8);
        if (s->culling)
            McdSpaceSetModelCullingParameters(s->u->space, s->model[0], s->culling, 1, 1);
        McdSpaceDisablePair(s->model[0], s->model[1]);
    }
}

static inline McdModelID whole_relative(Whole *s) {
    MeMatrix4 aside;
    const McdModelID m = s->count > 3 ? s->model[3] : 0;
    if (m) {
        MeMatrix4TMMakeIdentity(aside);
        MeMatrix4TMSetPosition(aside, .1, 0, 0);
        McdModelSetRelativeTransform(m, aside);
    }
    return m;
}

/* Half of them: some asleep, some awake, some with joints. */
static inline void whole_destroySome(Whole *s) {
    for (int i = 0; i < s->count; i += 2) {
        MstModelAndBodyDestroy(s->model[i]);
        s->model[i] = s->model[s->count - 1];
        s->count--;
    }
}

static inline void whole_step(Whole *s, int steps) {
    for (int i = 0; i < steps; i++)
        MstUniverseStep(s->u, 1. / 60);
}

/* False: there was no memory for the universe. */
static inline MeBool whole_begin(Whole *s, const MstUniverseSizes *sizes) {
    memset(s, 0, sizeof *s);
    s->u = MstUniverseCreate(sizes);
    if (!s->u)
        return MEFALSE;
    MdtWorldSetGravity(s->u->world, 0, 0, -9.8);
    MdtWorldEnableReport(s->u->world);
    return METRUE;
}

static inline void whole_run(Whole *s, int steps) {
    whole_grounds(s, s->u->frame);
    whole_shapes(s, s->u->frame);
    whole_joints(s);
    whole_materials(s);
    whole_step(s, steps);
    whole_byHand(s);
    whole_relative(s);
    whole_step(s, steps);
    if (s->count > 2) /* asleep while others go on */
        MdtBodyDisable(McdModelGetBody(s->model[2]));
    whole_step(s, steps);
    whole_destroySome(s);
    whole_step(s, steps);
}

static inline void whole_end(Whole *s) {
    MstUniverseDestroy(s->u);
    if (s->culling)
        McdCullingTableDestroy(s->culling);
}

#endif
