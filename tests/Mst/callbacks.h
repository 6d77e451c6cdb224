/* A universe in which the library calls every kind of function that a program can set: a test says which one is to act,
 * and what it does. */
#ifndef CALLBACKS_H
#define CALLBACKS_H

#include "../Mcd/blob.h"
#include "MeDebugDraw.h"
#include "Mst.h"
#include "karma_test.h"

/* The functions, and by which function the program sets each. */
#define CALLBACKS(X)                                                                                                   \
    X(INTERSECT, "MstBridgeSetIntersectCB")                                                                            \
    X(PER_CONTACT, "MstBridgeSetPerContactCB")                                                                         \
    X(PER_PAIR, "MstBridgeSetPerPairCB")                                                                               \
    X(TOUCH, "MstBridgeSetTouchCB")                                                                                    \
    X(MODEL_UPDATE, "McdModelSetUpdateCallback")                                                                       \
    X(SPACE_BOX, "McdSpaceSetAABBFn")                                                                                  \
    X(MODEL_INTERSECT, "McdModelSetIntersectCallback")                                                                 \
    X(PAIR_POOL, "McdSpaceSetPoolFullHandler")                                                                         \
    X(HELLO, "McdFrameworkSetInteractions")                                                                            \
    X(GOODBYE, "McdFrameworkSetInteractions")                                                                          \
    X(OWN_INTERSECT, "McdFrameworkSetInteractions")                                                                    \
    X(OWN_SAFE_TIME, "McdFrameworkSetInteractions")                                                                    \
    X(OWN_BOX, "McdFrameworkRegisterGeometryType")                                                                     \
    X(OWN_SPHERE, "McdFrameworkRegisterGeometryType")                                                                  \
    X(OWN_FARTHEST, "McdFrameworkRegisterGeometryType")                                                                \
    X(OWN_MASS, "McdFrameworkRegisterGeometryType")                                                                    \
    X(OWN_DRAW, "McdFrameworkRegisterGeometryType")                                                                    \
    X(OWN_DESTROY, "McdFrameworkRegisterGeometryType")                                                                 \
    X(OWN_SEGMENT, "McdFrameworkRegisterGeometryType")                                                                 \
    X(OWN_SUPPORT, "McdFrameworkRegisterConvexType")                                                                   \
    X(TRIANGLES, "McdTriangleListSetGenerator")                                                                        \
    X(TRIANGLES_OF_QUERY, "McdTriangleListSetGenerator")                                                               \
    X(OVERLAP_BOX, "McdSpaceOverlapBox")                                                                               \
    X(OVERLAP_GEOMETRY, "McdSpaceOverlapGeometry")                                                                     \
    X(OVERLAP_MODEL, "McdSpaceOverlapModel")                                                                           \
    X(CLOSEST, "McdSpaceGetClosest")                                                                                   \
    X(CAST_GEOMETRY, "McdSpaceCastGeometry")                                                                           \
    X(CAST_RAY, "McdSpaceCastRay")                                                                                     \
    X(SEGMENT, "McdSpaceGetLineSegFirstEnabledIntersection")                                                           \
    X(MANAGER_FULL, "McdModelPairManagerSetPoolFullHandler")                                                           \
    X(PARTITION, "MdtWorldSetPartitionCB")                                                                             \
    X(SOLVER, "MdtWorldSetSolverCB")                                                                                   \
    X(ENABLED, "MdtWorldSetBodyHandlers")                                                                              \
    X(DISABLED, "MdtWorldSetBodyHandlers")                                                                             \
    X(IMPORTANCE, "MdtWorldSetContactImportanceCB")                                                                    \
    X(USER_ROWS, "MdtUserConstraintSetFunction")                                                                       \
    X(BREAK, "MdtWorldSetBreakCB")                                                                                     \
    X(FOR_ALL_OF_WORLD, "MdtWorldForAllConstraints")                                                                   \
    X(FOR_ALL_OF_BODY, "MdtBodyForAllConstraints")                                                                     \
    X(UPDATE_PARTITIONS, "MdtUpdatePartitions")                                                                        \
    X(ENQUEUE, "MdtWorldSetTaskCallbacks")                                                                             \
    X(FINISH, "MdtWorldSetTaskCallbacks")                                                                              \
    X(WARNING_HANDLER, "MeSetWarningHandler")                                                                          \
    X(WARNING_SHOW, "MeSetWarningShow")                                                                                \
    X(FATAL_HANDLER, "MeSetFatalErrorHandler")                                                                         \
    X(CREATE, "MeMemoryAPI.create")                                                                                    \
    X(CREATE_ALIGNED, "MeMemoryAPI.createAligned")                                                                     \
    X(DESTROY, "MeMemoryAPI.destroy")                                                                                  \
    X(DEBUG_LINE, "MeDebugDrawAPI.line")                                                                               \
    X(DRAW_LINE, "MstDebugDrawUniverse")                                                                               \
    X(TERM, "McdFrameworkRegisterTermAction")

#define CB_NAME(id, set) CB_##id,
enum { CALLBACKS(CB_NAME) CB_COUNT };
#undef CB_NAME

typedef struct CallbackKind {
    const char *name, *setBy;
} CallbackKind;
#define CB_KIND(id, set) {#id, set},
static const CallbackKind callbackKind[] = {CALLBACKS(CB_KIND)};
#undef CB_KIND

enum { STACK = 3, MAX_MODELS = 160 };
#define CB_H (MeReal)(1. / 60)

/* What the scene is made of, and what the function that acts was called with, or may as well act on. */
static struct {
    int acting, calls; /* which function acts; how often it has */
    int max;           /* so often it is to */
    MeBool isArmed, isInside;
    void (*act)(void);

    MstUniverseID u;
    MdtWorldID w;
    McdFrameworkID f;
    McdSpaceID s;
    MstBridgeID b;
    McdModelID floor, mesh, list, blob, wall, aggregate, stack[STACK], ball, bullet, witness, loose;
    MdtBodyID hung, held, sleeper;
    MdtHingeID hinge;
    MdtUserConstraintID user;
    McdGeometryID unit, spare;
    McdModelPairManagerID manager;
    MeMatrix4 floorTM, meshTM, blobTM, wallTM, looseTM;
    MeVector3 corner[4];

    McdModelID model; /* the objects of the call */
    MdtBodyID body;
    MdtConstraintID joint;
    MdtContactGroupID group;
    MdtContactID contact;
} cb;

static inline void cb_call(int which) {
    if (which != cb.acting || !cb.isArmed || cb.isInside || cb.calls >= cb.max)
        return;
    cb.isInside = METRUE;
    cb.calls++;
    cb.act();
    cb.isInside = MEFALSE;
}

/* ---- the program's functions ------------------------------------------------------------------------------------- */

static inline void MEAPI cb_intersect(McdIntersectResult *r) {
    (void)r;
    cb_call(CB_INTERSECT);
}
static inline MeBool MEAPI cb_perContact(McdIntersectResult *r, McdContact *c, MdtContactID d) {
    (void)r, (void)c;
    if (cb.acting == CB_PER_CONTACT)
        cb.contact = d;
    cb_call(CB_PER_CONTACT);
    return METRUE;
}
static inline MeBool MEAPI cb_perPair(McdIntersectResult *r, MdtContactGroupID g) {
    (void)r;
    if (cb.acting == CB_PER_PAIR)
        cb.group = g;
    cb_call(CB_PER_PAIR);
    return METRUE;
}
static inline void MEAPI cb_touch(const MstEvent *e) {
    (void)e;
    cb_call(CB_TOUCH);
}
static inline void MEAPI cb_update(McdModelID m) {
    (void)m;
    cb_call(CB_MODEL_UPDATE);
}
static inline void MEAPI cb_spaceBox(McdModelID m, MeReal duration) {
    McdModelUpdatePath(m, duration);
    cb_call(CB_SPACE_BOX);
}
static inline void MEAPI cb_modelIntersect(McdModelID m, McdIntersectResult *r) {
    (void)m, (void)r;
    cb_call(CB_MODEL_INTERSECT);
}
static inline void MEAPI cb_pairPool(McdModelID m1, McdModelID m2) {
    (void)m1, (void)m2;
    cb_call(CB_PAIR_POOL);
}
static inline MeBool MEAPI cb_hello(McdModelPair *p) {
    p->m_cachedData = p;
    cb_call(CB_HELLO);
    return METRUE;
}
static inline void MEAPI cb_goodbye(McdModelPair *p) {
    (void)p;
    cb_call(CB_GOODBYE);
}
static inline int MEAPI cb_ownIntersect(McdModelPair *p, McdIntersectResult *r) {
    cb_call(CB_OWN_INTERSECT);
    return blobIntersect(p, r);
}
static inline int MEAPI cb_noContacts(McdModelPair *p, McdIntersectResult *r) {
    (void)p, (void)r;
    return 0;
}
static inline int MEAPI cb_ownSafeTime(McdModelPair *p, MeReal max, McdSafeTimeResult *r) {
    (void)p;
    cb_call(CB_OWN_SAFE_TIME);
    r->time = max;
    return 1;
}
static inline void MEAPI cb_ownBox(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    cb_call(CB_OWN_BOX);
    blobAABB(ins, finalTM, tight);
}
static inline void MEAPI cb_ownSphere(const McdGeometryID g, MeVector3 centre, MeReal *radius) {
    cb_call(CB_OWN_SPHERE);
    blobBSphere(g, centre, radius);
}
static inline void MEAPI cb_ownFarthest(McdGeometryInstanceID ins, MeReal *const d, MeReal *const point) {
    cb_call(CB_OWN_FARTHEST);
    MeVector3Copy(point, McdGeometryInstanceGetTransformPtr(ins)[3]);
    (void)d;
}
static inline MeI16 MEAPI cb_ownMass(McdGeometryID g, MeMatrix4 tm, MeMatrix3 inertia, MeReal *volume) {
    (void)g;
    cb_call(CB_OWN_MASS);
    MeMatrix4TMMakeIdentity(tm);
    for (int i = 0; i < 3; i++)
        inertia[i][i] = (MeReal).1;
    *volume = 1;
    return 1;
}
static inline void MEAPI cb_ownDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]) {
    (void)g, (void)tm, (void)colour;
    cb_call(CB_OWN_DRAW);
}
static inline void MEAPI cb_ownDestroy(McdGeometryID g) {
    cb_call(CB_OWN_DESTROY);
    MeMemoryAPI.destroy(g);
}
static inline int MEAPI cb_ownSegment(const McdModelID m, MeReal *const from, MeReal *const to,
                                      McdLineSegIntersectResult *r) {
    (void)m, (void)from, (void)to, (void)r;
    cb_call(CB_OWN_SEGMENT);
    return 0;
}
static inline void MEAPI cb_ownSupport(const void *data, const double direction[3], double point[3]) {
    (void)data;
    cb_call(CB_OWN_SUPPORT);
    for (int i = 0; i < 3; i++)
        point[i] = direction[i] * .3;
}
static inline int MEAPI cb_triangles(McdModelPair *p, McdUserTriangle *t, MeVector3 at, MeReal radius, int max) {
    static const int of[2][3] = {{0, 1, 2}, {0, 2, 3}};
    (void)p, (void)at, (void)radius;
    cb_call(CB_TRIANGLES);
    cb_call(CB_TRIANGLES_OF_QUERY);
    for (int n = 0; n < 2 && n < max; n++) {
        memset(&t[n], 0, sizeof t[n]);
        for (int k = 0; k < 3; k++)
            t[n].vertices[k] = &cb.corner[of[n][k]];
        t[n].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleTwoSided);
    }
    return 2;
}
static inline int MEAPI cb_filter(McdModelID m, void *data) {
    (void)m, (void)data;
    if (cb.acting >= CB_OVERLAP_BOX && cb.acting <= CB_SEGMENT)
        cb_call(cb.acting);
    return 1;
}
static inline void MEAPI cb_managerFull(McdModelID m1, McdModelID m2) {
    (void)m1, (void)m2;
    cb_call(CB_MANAGER_FULL);
}
static inline void MEAPI cb_partition(MdtPartitionOutput *po, void *data) {
    (void)data;
    if (cb.acting == CB_PARTITION)
        cb.body = po->bodies[po->info[po->numPartitions - 1].firstBody];
    cb_call(CB_PARTITION);
    cb_call(CB_UPDATE_PARTITIONS);
}
static inline MdtSolver MEAPI cb_solver(MdtBodyID const bodies[], int count, void *data) {
    (void)bodies, (void)count, (void)data;
    cb_call(CB_SOLVER);
    return MdtSolverAuto;
}
static inline void MEAPI cb_enabled(const MdtBodyID b) {
    if (cb.acting == CB_ENABLED && cb.isArmed && !cb.isInside)
        cb.body = b;
    cb_call(CB_ENABLED);
}
static inline void MEAPI cb_disabled(const MdtBodyID b) {
    if (cb.acting == CB_DISABLED && cb.isArmed && !cb.isInside)
        cb.body = b;
    cb_call(CB_DISABLED);
}
static inline MeReal MEAPI cb_importance(const MdtContactID c) {
    if (cb.acting == CB_IMPORTANCE)
        cb.contact = c;
    cb_call(CB_IMPORTANCE);
    return 1;
}
static inline void MEAPI cb_rows(MdtKeaConstraints *const list, void *const constraint,
                                 const MdtKeaTransformation *const pose, MdtKeaBody *const body[],
                                 const void *const parameters) {
    (void)constraint, (void)pose, (void)body, (void)parameters;
    cb_call(CB_USER_ROWS);
    MdtKeaRow *row = MdtBclAddRow(list);
    if (row)
        row->J[0].lin[0] = 1;
}
static inline void MEAPI cb_break(const MdtConstraintID c) {
    if (cb.acting == CB_BREAK)
        cb.joint = c;
    cb_call(CB_BREAK);
}
static inline void MEAPI cb_each(const MdtConstraintID c, void *which) {
    if (MdtConstraintDCastHinge(c))
        cb.joint = c;
    cb_call(*(int *)which);
}
static inline void *MEAPI cb_enqueue(MeTaskCB task, void *context, void *data) {
    static struct {
        MeTaskCB task;
        void *context;
    } given;
    (void)data;
    given.task = task;
    given.context = context;
    cb_call(CB_ENQUEUE);
    return &given;
}
static inline void MEAPI cb_finish(void *given, void *data) {
    const struct {
        MeTaskCB task;
        void *context;
    } *job = given;
    (void)data;
    cb_call(CB_FINISH);
    job->task(job->context);
}
static inline void MEAPI cb_line(MeVector3 a, MeVector3 b, MeReal r, MeReal g, MeReal bl) {
    (void)a, (void)b, (void)r, (void)g, (void)bl;
    cb_call(CB_DEBUG_LINE);
}
static inline void MEAPI cb_drawLine(void *data, const MeVector3 a, const MeVector3 b, const float color[4]) {
    (void)data, (void)a, (void)b, (void)color;
    cb_call(CB_DRAW_LINE);
}
static inline void MEAPI cb_term(McdFrameworkID f) {
    (void)f;
    cb_call(CB_TERM);
}

/* ---- memory ------------------------------------------------------------------------------------------------------ */

static MeMemoryAPIStruct cb_standard;
static MeBool cb_isFailing;

static inline void *MEAPI cb_create(size_t bytes) {
    cb_call(CB_CREATE);
    if (!cb_isFailing)
        return cb_standard.create(bytes);
    cb_isFailing = MEFALSE;
    return 0;
}
static inline void *MEAPI cb_createAligned(size_t bytes, unsigned int alignment) {
    cb_call(CB_CREATE_ALIGNED);
    return cb_standard.createAligned(bytes, alignment);
}
static inline void MEAPI cb_destroy(void *const block) {
    cb_call(CB_DESTROY);
    cb_standard.destroy(block);
}

/* ---- the scene --------------------------------------------------------------------------------------------------- */

static inline McdModelID cb_add(McdGeometryID g, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(cb.u, g, 100);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static inline McdModelID cb_addFixed(McdGeometryID g, MeMatrix4 tm, double x, double y, double z) {
    MeMatrix4TMMakeIdentity(tm);
    tm[3][0] = (MeReal)x, tm[3][1] = (MeReal)y, tm[3][2] = (MeReal)z;
    return MstFixedModelCreate(cb.u, g, tm);
}

static inline void cb_makeOwnType(void) {
    static char name[] = "own";
    McdInteractions own = {cb_hello, cb_goodbye, cb_ownIntersect, cb_ownSafeTime};
    McdInteractions none = {0, 0, cb_noContacts, 0};
    McdFrameworkRegisterGeometryType(cb.f, BLOB, name, cb_ownDestroy, cb_ownBox, cb_ownSphere, cb_ownFarthest,
                                     cb_ownMass, cb_ownDraw);
    McdFrameworkSetLineSegInteraction(cb.f, BLOB, cb_ownSegment);
    for (int type = 0; type < BLOB; type++)
        McdFrameworkSetInteractions(cb.f, BLOB, type, &none);
    McdFrameworkSetInteractions(cb.f, BLOB, BLOB, &own);
    cb_addFixed(blobCreate(cb.f, BLOB, .5, 0), cb.blobTM, -5, 0, 1);
    cb.blob = cb_add(blobCreate(cb.f, BLOB, .5, 0), -5, 0, 1.95);
    McdModelSetSwept(cb.blob, METRUE);
    if (cb.acting == CB_OWN_SAFE_TIME) {
        McdModelDynamicsSetPosition(cb.blob, -5, 0, 3);
        McdModelDynamicsSetLinearVelocity(cb.blob, 0, 0, -100);
    }
    cb.spare = blobCreate(cb.f, BLOB, .5, 0);
}

static inline void cb_makeMesh(void) {
    static const int of[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    MeVector3 low = {-2, -2, -.1}, high = {2, 2, .1};
    for (int i = 0; i < 4; i++)
        MeVector3Set(cb.corner[i], (MeReal)(2 * of[i][0]), (MeReal)(2 * of[i][1]), 0);
    McdTriangleListLineSegmentRegisterInteraction(cb.f);
    const McdGeometryID list = McdTriangleListCreate(cb.f, low, high, 4, cb_triangles);
    cb.mesh = cb_addFixed(list, cb.meshTM, 5, 0, 1);
    cb.ball = cb_add(McdSphereCreate(cb.f, .5), 5, 0, 1.5);
}

static inline void cb_makeJoints(void) {
    cb.hung = McdModelGetBody(cb_add(cb.unit, 0, 6, 3));
    cb.held = McdModelGetBody(cb_add(cb.unit, 0, 7.1, 3));
    cb.hinge = MdtHingeCreate(cb.w);
    MdtHingeSetBodies(cb.hinge, cb.hung, cb.held);
    MdtHingeSetPosition(cb.hinge, 0, 6.55, 3);
    MdtHingeEnable(cb.hinge);
    MdtConstraintSetBreakLimits(MdtHingeQuaConstraint(cb.hinge), 1, 1);
    const MdtBSJointID nail = MdtBSJointCreate(cb.w);
    MdtBSJointSetBodies(nail, cb.hung, 0);
    MdtBSJointSetPosition(nail, 0, 6, 3);
    MdtBSJointEnable(nail);
    if (cb.acting == CB_ENQUEUE || cb.acting == CB_FINISH) /* with one there are no workers */
        return;
    cb.user = MdtUserConstraintCreate(cb.w);
    MdtUserConstraintSetBodies(cb.user, cb.hung, 0);
    MdtUserConstraintSetFunction(cb.user, cb_rows);
    if (cb.acting == CB_USER_ROWS)
        MdtUserConstraintEnable(cb.user);
}

static inline void cb_makeParts(void) {
    const McdAggregateID parts = McdAggregateCreate(cb.f, 2);
    McdAggregateAddElement(parts, cb.unit, 0);
    cb.aggregate = cb_add(parts, -5, -5, .5);
    cb.wall = cb_addFixed(McdBoxCreate(cb.f, 4, .1, 4), cb.wallTM, 12, 15, 1);
    cb.bullet = cb_add(McdSphereCreate(cb.f, .1), 12, 8, 1);
    McdModelSetSwept(cb.bullet, METRUE);
    McdModelDynamicsSetLinearVelocity(cb.bullet, 0, 100, 0);
    cb.witness = cb_add(cb.unit, 9, -9, .5);
    cb.sleeper = McdModelGetBody(cb_add(cb.unit, -9, 9, .5));
}

static inline void cb_setMst(void) {
    if (cb.acting == CB_INTERSECT)
        MstBridgeSetIntersectCB(cb.b, 0, 0, cb_intersect);
    if (cb.acting == CB_PER_CONTACT)
        MstBridgeSetPerContactCB(cb.b, 0, 0, cb_perContact);
    if (cb.acting == CB_PER_PAIR)
        MstBridgeSetPerPairCB(cb.b, 0, 0, cb_perPair);
    if (cb.acting == CB_TOUCH)
        MstBridgeSetTouchCB(cb.b, 0, 0, cb_touch);
}

static inline void cb_addOwnConvex(void) {
    static const McdConvexFunctions functions = {.support = cb_ownSupport};
    const int type = McdFrameworkRegisterConvexType(cb.f, "convex", 0, &functions);
    MdtBodyEnable(McdModelGetBody(cb_add(McdConvexCreate(cb.f, type, 0), -5, 5, .29)));
}

static inline void cb_setMcd(void) {
    if (cb.acting == CB_OWN_SUPPORT)
        cb_addOwnConvex();
    if (cb.acting == CB_MODEL_UPDATE)
        for (int i = 0; i < STACK; i++)
            McdModelSetUpdateCallback(cb.stack[i], cb_update);
    if (cb.acting == CB_MODEL_INTERSECT)
        McdModelSetIntersectCallback(cb.stack[1], cb_modelIntersect);
    if (cb.acting == CB_SPACE_BOX) {
        McdSpaceEndChanges(cb.s);
        McdSpaceSetAABBFn(cb.s, cb_spaceBox);
        McdSpaceBeginChanges(cb.s);
    }
    if (cb.acting == CB_PAIR_POOL)
        McdSpaceSetPoolFullHandler(cb.s, cb_pairPool);
    if (cb.acting == CB_TERM)
        McdFrameworkRegisterTermAction(cb.f, cb_term);
}

static inline void cb_setMdt(void) {
    if (cb.acting == CB_PARTITION)
        MdtWorldSetPartitionCB(cb.w, cb_partition, 0);
    if (cb.acting == CB_SOLVER)
        MdtWorldSetSolverCB(cb.w, cb_solver, 0);
    if (cb.acting == CB_ENABLED || cb.acting == CB_DISABLED)
        MdtWorldSetBodyHandlers(cb.w, cb_enabled, cb_disabled);
    if (cb.acting == CB_IMPORTANCE) {
        MdtWorldSetMaxMatrixSize(cb.w, 3);
        MdtWorldSetContactImportanceCB(cb.w, cb_importance);
    }
    if (cb.acting == CB_BREAK)
        MdtWorldSetBreakCB(cb.w, cb_break);
    if (cb.acting == CB_ENQUEUE || cb.acting == CB_FINISH) {
        const McdGeometryID small = McdSphereCreate(cb.f, .2);
        for (int i = 0; i < 100; i++)
            cb_add(small, -9 + i % 10, -9 + .5 * (i / 10), .2);
        MdtWorldSetTaskCallbacks(cb.w, 2, cb_enqueue, cb_finish, 0);
    }
    if (cb.acting == CB_DEBUG_LINE) {
        MeDebugDrawAPI.line = cb_line;
        MdtWorldSetDebugDrawing(cb.w, MdtDebugDrawContacts);
    }
}

/* Something to warn of, in the update of boxes and as contacts are made. */
static inline void cb_makeMistakes(void) {
    if (cb.acting != CB_WARNING_HANDLER && cb.acting != CB_WARNING_SHOW)
        return;
    const McdModelID lost = McdModelCreate(cb.unit);
    McdSpaceInsertModel(cb.s, lost);
    static int material = 77; /* another text each time: the standard handler shows none often */
    McdModelSetMaterial(cb.stack[2], material++);
}

static inline void cb_begin(int acting, void (*act)(void), int max) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    memset(&cb, 0, sizeof cb);
    cb.acting = acting;
    cb.act = act;
    cb.max = max;
    sizes.collisionUserGeometryTypesMaxCount = 2;
    if (acting == CB_PAIR_POOL)
        sizes.collisionPairsMaxCount = 4;
    cb.u = MstUniverseCreate(&sizes);
    cb.w = cb.u->world, cb.f = cb.u->frame, cb.s = cb.u->space, cb.b = cb.u->bridge;
    MdtWorldSetGravity(cb.w, 0, 0, -9.8);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(cb.b, 0, 0), .5, 0);
    cb.unit = McdBoxCreate(cb.f, 1, 1, 1);
    cb.floor = cb_addFixed(McdBoxCreate(cb.f, 40, 40, 2), cb.floorTM, 0, 0, -1);
    for (int i = 0; i < STACK; i++)
        cb.stack[i] = cb_add(cb.unit, 0, 0, .5 + i);
    cb_makeMesh();
    cb_makeOwnType();
    cb_makeJoints();
    cb_makeParts();
    MeMatrix4TMMakeIdentity(cb.looseTM);
    cb.looseTM[3][2] = 30;
    cb.loose = McdModelCreate(cb.unit);
    McdModelSetTransformPtr(cb.loose, cb.looseTM);
    cb.model = cb.stack[1];
    cb.body = McdModelGetBody(cb.stack[1]);
    cb.joint = MdtHingeQuaConstraint(cb.hinge);
    cb.manager = McdModelPairManagerCreate(1);
    McdModelPairManagerSetPoolFullHandler(cb.manager, cb_managerFull);
    McdModelPairManagerActivate(cb.manager, cb.stack[0], cb.stack[1]);
    cb_setMst();
    cb_setMcd();
    cb_setMdt();
    cb_makeMistakes();
}

/* ---- calls outside of a step ------------------------------------------------------------------------------------- */

static inline void cb_query(void) {
    MeVector3 from = {-20, 0, 1.5}, by = {40, 0, 0}, to = {20, 0, 1.5}, low = {-9, -9, 0}, high = {9, 9, 9};
    MeMatrix4 tm;
    McdModelID found[8];
    McdClosestResult closest;
    McdCastResult cast;
    McdLineSegIntersectResult hit;
    MeMatrix4TMMakeIdentity(tm);
    tm[3][2] = (MeReal)1.5;
    McdSpaceEndChanges(cb.s);
    if (cb.acting == CB_OVERLAP_BOX)
        McdSpaceOverlapBox(cb.s, low, high, cb_filter, 0, found, 8);
    if (cb.acting == CB_OVERLAP_GEOMETRY)
        McdSpaceOverlapGeometry(cb.s, cb.unit, tm, cb_filter, 0, found, 8);
    if (cb.acting == CB_OVERLAP_MODEL)
        McdSpaceOverlapModel(cb.s, cb.stack[1], cb_filter, 0, found, 8);
    if (cb.acting == CB_CLOSEST)
        McdSpaceGetClosest(cb.s, cb.unit, tm, 10, cb_filter, 0, &closest);
    if (cb.acting == CB_TRIANGLES_OF_QUERY || cb.acting == CB_CAST_GEOMETRY)
        McdSpaceCastGeometry(cb.s, cb.unit, tm, by, cb_filter, 0, &cast);
    if (cb.acting == CB_CAST_RAY || cb.acting == CB_OWN_SEGMENT)
        McdSpaceCastRay(cb.s, from, by, cb_filter, 0, &cast);
    if (cb.acting == CB_SEGMENT)
        McdSpaceGetLineSegFirstEnabledIntersection(cb.s, from, to, cb_filter, 0, &hit);
    if (cb.s && McdSpaceIsChanging(cb.s) == 0)
        McdSpaceBeginChanges(cb.s);
}

static inline int MEAPI cb_compare(const void *a, const void *b) {
    return *(const int *)a - *(const int *)b;
}

static inline void cb_partitions(void) {
    MeDict list;
    MeDictNode node;
    MdtPartitionOutput po;
    int key = 1;
    MeDictInit(&list, 1, cb_compare);
    MeDictNodeInit(&node, cb.body);
    MeDictInsert(&list, &node, &key);
    MdtUpdatePartitions(&list, &po, cb_partition, 0);
}

/* Whatever calls the function outside of a step. */
static inline void cb_callOutside(void) {
    static const MstDebugDraw draw = {.line = cb_drawLine};
    static const MeReal white[3] = {1, 1, 1};
    MeVector3 centre;
    MeReal radius;
    if (cb.acting >= CB_OWN_SEGMENT && cb.acting <= CB_SEGMENT && cb.acting != CB_TRIANGLES)
        cb_query();
    if (cb.acting == CB_FOR_ALL_OF_WORLD)
        MdtWorldForAllConstraints(cb.w, cb_each, &cb.acting);
    if (cb.acting == CB_FOR_ALL_OF_BODY)
        MdtBodyForAllConstraints(cb.hung, cb_each, &cb.acting);
    if (cb.acting == CB_UPDATE_PARTITIONS)
        cb_partitions();
    if (cb.acting == CB_DRAW_LINE)
        MstDebugDrawUniverse(cb.u, MstDebugAll, &draw);
    if (cb.acting == CB_OWN_DRAW)
        McduDebugDrawModel(cb.blob, kMcduDebugDrawDetail, white);
    if (cb.acting == CB_OWN_SPHERE)
        McdModelGetBSphere(cb.blob, centre, &radius);
    if (cb.acting == CB_OWN_MASS)
        MstAutoSetInertialTensor(cb.blob);
    if (cb.acting == CB_OWN_DESTROY && cb.spare)
        McdGeometryDestroy(cb.spare), cb.spare = 0;
    if (cb.acting == CB_MANAGER_FULL)
        McdModelPairManagerActivate(cb.manager, cb.stack[1], cb.stack[2]);
    if (cb.acting == CB_ENABLED || cb.acting == CB_DISABLED) {
        MdtBodyDisable(cb.sleeper);
        if (MdtBodyIsValid(cb.sleeper))
            MdtBodyEnable(cb.sleeper);
    }
    if (cb.acting == CB_GOODBYE && McdModelIsValid(cb.blob)) { /* far away: its pair says goodbye in the next step */
        McdModelDynamicsSetPosition(cb.blob, -5, 0, 15);
    }
}

#endif
