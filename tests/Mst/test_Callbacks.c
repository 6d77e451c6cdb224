/* What a program does inside of functions that the library calls: all of them times all that there is to do. Nothing
 * crashes; each call works, at once or when the stage ends, or is refused by a message that names it and the function
 * that it was called from; and the scene goes on. */
#include "callbacks.h"

/* ---- what is done ------------------------------------------------------------------------------------------------ */

static MdtBodyID bodyOf(McdModelID m) {
    return m && McdModelIsValid(m) ? McdModelGetBody(m) : 0;
}

static MdtContactGroupID groupOf(MdtBodyID b) {
    MdtConstraintID c = b && MdtBodyIsValid(b) ? MdtBodyGetFirstConstraint(b) : 0;
    while (c && !MdtConstraintDCastContactGroup(c))
        c = MdtBodyGetNextConstraint(b, c);
    return c ? MdtConstraintDCastContactGroup(c) : 0;
}

static MdtContactID contactOf(MdtBodyID b) {
    return b && MdtBodyIsValid(b) ? MdtBodyGetFirstContact(b) : 0;
}

static MdtContactGroupID aGroup(void) {
    return cb.group ? cb.group : groupOf(cb.body);
}

static MdtContactID aContact(void) {
    return cb.contact ? cb.contact : contactOf(cb.body);
}

static McdModelID lastMade;
static MdtBodyID lastBody;
static MdtBSJointID lastJoint;
static MeMatrix4 madeTM;

static void destroyModelAndBody(void) {
    MstModelAndBodyDestroy(cb.model);
}
static void destroyAllModels(void) {
    for (int i = 0; i < STACK; i++)
        MstModelAndBodyDestroy(cb.stack[i]);
    MstModelAndBodyDestroy(cb.ball);
    MstModelAndBodyDestroy(cb.blob);
    MstFixedModelDestroy(cb.mesh);
}
static void destroyModel(void) {
    McdModelDestroy(cb.model);
}
static void destroyFixed(void) {
    MstFixedModelDestroy(cb.mesh);
}
static void destroyLoose(void) {
    McdModelDestroy(cb.loose);
}
static void destroyBody(void) {
    MdtBodyDestroy(cb.body);
}
static void destroyBodyThenModel(void) {
    MdtBodyDestroy(bodyOf(cb.stack[1]));
    McdModelDestroy(cb.stack[1]);
}
static void destroyAndCreate(void) {
    MstModelAndBodyDestroy(cb.model);
    cb.model = MstModelAndBodyCreate(cb.u, cb.unit, 100);
    if (cb.model)
        McdModelDynamicsSetPosition(cb.model, 3, 3, 3);
}
static void resetModel(void) {
    McdModelReset(cb.model);
}
static void removeModel(void) {
    const MeBool isOpen = McdSpaceIsChanging(cb.s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(cb.s);
    if (McdModelGetSpace(cb.model))
        McdSpaceRemoveModel(cb.model);
    if (!isOpen)
        McdSpaceEndChanges(cb.s);
}
static void insertModel(void) {
    const MeBool isOpen = McdSpaceIsChanging(cb.s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(cb.s);
    if (McdModelIsValid(cb.loose) && !McdModelGetSpace(cb.loose))
        McdSpaceInsertModel(cb.s, cb.loose);
    if (!isOpen)
        McdSpaceEndChanges(cb.s);
}
static void disablePair(void) {
    const MeBool isOpen = McdSpaceIsChanging(cb.s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(cb.s);
    McdSpaceDisablePair(cb.stack[0], cb.stack[2]);
    McdSpaceUpdateModel(cb.stack[0]);
    if (!isOpen)
        McdSpaceEndChanges(cb.s);
}
static void endBlock(void) {
    McdSpaceEndChanges(cb.s);
}
static void beginBlock(void) {
    McdSpaceBeginChanges(cb.s);
}
static void updateSpace(void) {
    McdSpaceUpdateAll(cb.s);
}
static void getPairs(void) {
    McdModelPair *array[8];
    McdModelPairContainer pairs;
    McdSpacePairIterator it;
    if (McdSpaceIsChanging(cb.s))
        return;
    McdModelPairContainerInit(&pairs, array, 8);
    McdSpacePairIteratorBegin(cb.s, &it);
    while (McdSpaceGetPairs(cb.s, &it, &pairs))
        ;
}
static void freeze(void) {
    McdSpaceFreezeModel(cb.model);
    McdSpaceUnfreezeModel(cb.model);
}
static void buildSpace(void) {
    McdSpaceBuild(cb.s);
}
static void destroySpace(void) {
    McdSpaceDestroy(cb.s);
}
static void endFramework(void) {
    McdTerm(cb.f);
}
static void emptyFramework(void) {
    McdFrameworkDestroyAllModelsAndGeometries(cb.f);
}
static void noTransform(void) {
    McdModelSetTransformPtr(cb.floor, cb.floorTM);
    McdModelSetTransformPtr(cb.blob, 0);
    if (bodyOf(cb.blob))
        McdModelSetTransformPtr(cb.blob, MdtBodyGetTransformPtr(bodyOf(cb.blob)));
}
static void otherGeometry(void) {
    McdModelSetGeometry(cb.loose, cb.unit);
    McdGeometryInstanceSetGeometry(McdModelGetGeometryInstance(cb.ball), McdModelGetGeometry(cb.ball));
}
static void otherBody(void) {
    McdModelSetBody(cb.loose, cb.held);
    McdModelSetBody(cb.loose, 0);
    if (McdModelIsValid(cb.loose))
        McdModelSetTransformPtr(cb.loose, cb.looseTM);
}
static void partModel(void) {
    McdModelSetBody(cb.model, 0);
}
static void changeModel(void) {
    McdModelSetMaterial(cb.model, 0);
    McdModelSetContactTolerance(cb.model, .02);
    McdModelSetSwept(cb.model, METRUE);
    McdModelSetSensor(cb.model, MEFALSE);
    McdModelSetFilter(cb.model, 1, 0xffffffffu);
    McdModelUpdate(cb.model);
}
static void changeShapes(void) {
    McdBoxSetDimensions(cb.unit, 1, 1, 1);
    McdTriangleListSetMaxTriangles(McdModelIsValid(cb.mesh) ? McdModelGetGeometry(cb.mesh) : 0, 16);
}
static void createGeometry(void) {
    const McdGeometryID g = McdSphereCreate(cb.f, 1);
    if (g)
        McdGeometryDestroy(g);
}
static void destroyGeometry(void) {
    if (cb.spare)
        McdGeometryDestroy(cb.spare);
    cb.spare = 0;
}
static void createModel(void) {
    lastMade = MstModelAndBodyCreate(cb.u, cb.unit, 100);
    if (lastMade)
        McdModelDynamicsSetPosition(lastMade, -3, 3, 3);
}
static void createFixed(void) {
    MeMatrix4TMMakeIdentity(madeTM);
    madeTM[3][0] = madeTM[3][1] = -15;
    lastMade = MstFixedModelCreate(cb.u, cb.unit, madeTM);
}
static void createBody(void) {
    lastBody = MdtBodyCreate(cb.w);
    if (lastBody)
        MdtBodySetPosition(lastBody, 0, -15, 2);
    if (lastBody)
        MdtBodyEnable(lastBody);
}
static void createJoint(void) {
    lastJoint = MdtBSJointCreate(cb.w);
    if (!lastJoint || !MdtBodyIsValid(cb.held))
        return;
    MdtBSJointSetBodies(lastJoint, cb.held, 0);
    MdtBSJointSetPosition(lastJoint, 0, 8, 3);
    MdtBSJointEnable(lastJoint);
}
static void destroyJoint(void) {
    MdtConstraintDestroy(cb.joint);
}
static void disableJoint(void) {
    MdtConstraintDisable(cb.joint);
    MdtConstraintEnable(cb.joint);
}
static void attachJoint(void) {
    MdtHingeDisable(cb.hinge);
    MdtHingeSetBodies(cb.hinge, cb.held, cb.hung);
    MdtHingeEnable(cb.hinge);
}
static void changeJoint(void) {
    MdtHingeSetAxis(cb.hinge, 0, 0, 1);
    MdtHingeReset(cb.hinge);
    MdtLimitActivateLimits(MdtHingeGetLimit(cb.hinge), METRUE);
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(cb.hinge), 1, 1);
    MdtUserConstraintSetFunction(cb.user, cb_rows);
    MdtConstraintSetSortKey(cb.joint, 3);
}
static void destroyUserConstraint(void) {
    MdtUserConstraintDestroy(cb.user);
}
static void destroyContact(void) {
    if (aContact())
        MdtContactDestroy(aContact());
}
static void destroyGroup(void) {
    if (aGroup())
        MdtContactGroupDestroy(aGroup());
}
static void resetGroup(void) {
    if (aGroup())
        MdtContactGroupReset(aGroup());
}
static void attachGroup(void) {
    if (aGroup() && MdtBodyIsValid(cb.held))
        MdtContactGroupSetBodies(aGroup(), cb.held, 0);
}
static void growGroup(void) {
    const MdtContactID c = aGroup() ? MdtContactGroupCreateContact(aGroup()) : 0;
    const MdtContactID alone = MdtContactCreate(cb.w);
    if (c)
        MdtContactSetNormal(c, 0, 0, 1);
    if (c)
        MdtContactGroupRemoveContact(aGroup(), c);
    if (alone)
        MdtContactDestroy(alone);
}
static void destroyConstraints(void) {
    MdtBodyDestroyConstraints(cb.body);
}
static void destroyContacts(void) {
    MdtBodyDestroyContacts(cb.body);
}
static void disableConstraints(void) {
    MdtBodyDisableConstraints(cb.body);
}
static void disableBody(void) {
    MdtBodyDisable(cb.body);
}
static void enableBody(void) {
    MdtBodyDisable(cb.body);
    MdtBodyEnable(cb.body);
}
static void resetBody(void) {
    MdtBodyReset(cb.body);
}
static void moveBody(void) {
    MdtBodySetPosition(cb.body, 3, -3, 4);
    MdtBodySetQuaternion(cb.body, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(cb.body, 0, 0, 1);
    MdtBodySetAngularVelocity(cb.body, 0, 0, 1);
    MdtBodyAddForce(cb.body, 1, 0, 0);
}
static void changeBody(void) {
    const MeVector3 centre = {0, 0, .01};
    MdtBodySetMass(cb.body, 50);
    MdtBodySetSphericalInertiaTensor(cb.body, 5);
    MdtBodySetCenterOfMassRelativePosition(cb.body, centre);
    MdtBodySetLinearVelocityDamping(cb.body, .1);
    MdtBodySetSortKey(cb.body, 2);
    MdtBodySetSafeTime(cb.body, .1);
}
static void copyBody(void) {
    lastBody = MdtBodyCopy(cb.body, cb.w);
    if (lastBody)
        MdtBodySetPosition(lastBody, 15, -15, 5);
}
static void stepWorld(void) {
    MdtWorldStep(cb.w, CB_H);
    MdtWorldStepSafeTime(cb.w, CB_H);
    MdtWorldStepRest(cb.w);
}
static void stepUniverse(void) {
    MstUniverseStep(cb.u, CB_H);
}
static void resetWorld(void) {
    MdtWorldReset(cb.w);
}
static void recreateWorld(void) {
    MdtWorldReCreate(cb.w);
}
static void destroyWorld(void) {
    MdtWorldDestroy(cb.w);
}
static void changeWorld(void) {
    MdtWorldSetGravity(cb.w, 0, 0, -9.8);
    MdtWorldSetSubSteps(cb.w, 2);
    MdtWorldSetSolver(cb.w, MdtSolverAuto);
    MdtWorldEnableReport(cb.w);
    MdtWorldSetMaxMatrixSize(cb.w, 1000);
    MdtWorldResetForces(cb.w);
}
static void otherWorkers(void) {
    MdtWorldSetTaskCallbacks(cb.w, 2, cb_enqueue, cb_finish, 0);
}
static void noCallbacks(void) {
    MdtWorldSetPartitionCB(cb.w, 0, 0);
    MdtWorldSetSolverCB(cb.w, 0, 0);
    MdtWorldSetContactImportanceCB(cb.w, 0);
    MdtWorldSetBreakCB(cb.w, 0);
    MstSetWorldHandlers(cb.w);
    MdtUserConstraintSetFunction(cb.user, 0);
    MstBridgeSetIntersectCB(cb.b, 0, 0, 0);
    MstBridgeSetPerContactCB(cb.b, 0, 0, 0);
    MstBridgeSetPerPairCB(cb.b, 0, 0, 0);
    MstBridgeSetTouchCB(cb.b, 0, 0, 0);
    McdSpaceSetPoolFullHandler(cb.s, 0);
    McdModelSetIntersectCallback(cb.stack[1], 0);
    for (int i = 0; i < STACK; i++)
        McdModelSetUpdateCallback(cb.stack[i], 0);
}
static void updatePartitions(void) {
    cb_partitions();
}
static void forAll(void) {
    static int none = -1;
    MdtWorldForAllConstraints(cb.w, cb_each, &none);
    MdtBodyForAllConstraints(cb.hung, cb_each, &none);
}
static void destroyUniverse(void) {
    MstUniverseDestroy(cb.u);
}
static void destroyBridge(void) {
    MstBridgeDestroy(cb.b);
}
static void updateContacts(void) {
    MstBridgeUpdateContacts(cb.b, cb.s, cb.w);
    MstBridgeUpdateTransitions(cb.b, cb.s, cb.w);
}
static void handleCollisions(void) {
    McdModelPair *array[8];
    McdModelPairContainer pairs;
    McdModelPairContainerInit(&pairs, array, 8);
    MstHandleTransitions(&pairs, cb.s, cb.w, cb.b);
    MstHandleCollisions(&pairs, cb.s, cb.w, cb.b);
}
static void updateEvents(void) {
    int count;
    MstBridgeUpdateEvents(cb.b, cb.w);
    MstUniverseGetEvents(cb.u, &count);
}
static void resizeContacts(void) {
    MstBridgeSetContactBufferSize(cb.b, 60);
}
static void resizePairs(void) {
    MstBridgeSetModelPairBufferSize(cb.b, 8);
}
static void newMaterial(void) {
    MstBridgeGetNewMaterial(cb.b);
    MstBridgeSetContactReuse(cb.b, 0);
}
static void query(void) {
    MeVector3 from = {-20, 0, .5}, by = {40, 0, 0};
    McdCastResult hit;
    if (!McdSpaceIsChanging(cb.s))
        McdSpaceCastRay(cb.s, from, by, 0, 0, &hit);
}
static void changeManager(void) {
    if (!cb.manager)
        return;
    McdModelPairManagerFlush(cb.manager);
    McdModelPairManagerDeactivate(cb.manager, cb.stack[0], cb.stack[1]);
}
static int refusals(void);
static MeBool isHandler(int callback);
static void destroyManager(void) {
    const int before = refusals();
    if (cb.manager)
        McdModelPairManagerDestroy(cb.manager);
    if (refusals() == before && !isHandler(cb.acting))
        cb.manager = 0;
}

/* ---- what must have come of it ----------------------------------------------------------------------------------- */

/* As it was when the function was called. */
static struct {
    McdModelID model;
    MdtBodyID body, modelsBody;
    MdtConstraintID joint;
    MdtContactGroupID group;
    MdtContactID contact;
    MeU64 serial;
    MeBool isDone;
} was;

static MeBool isModelGone(void) {
    return McdModelGetSerial(was.model) != was.serial;
}
static MeBool areModelAndBodyGone(void) {
    return isModelGone() && !MdtBodyIsValid(was.modelsBody);
}
static MeBool isBodyGone(void) {
    return !MdtBodyIsValid(was.body);
}
static MeBool isMeshGone(void) {
    return !McdModelIsValid(cb.mesh);
}
static MeBool isLooseGone(void) {
    return !McdModelIsValid(cb.loose);
}
static MeBool isJointGone(void) {
    return !MdtConstraintIsValid(was.joint);
}
static MeBool isUserGone(void) {
    return !MdtConstraintIsValid(MdtUserConstraintQuaConstraint(cb.user));
}
static MeBool isGroupGone(void) {
    return !was.group || !MdtConstraintIsValid(MdtContactGroupQuaConstraint(was.group));
}
static MeBool isOut(void) {
    return !McdModelIsValid(was.model) || !McdModelGetSpace(was.model);
}
static MeBool isIn(void) {
    return McdModelIsValid(cb.loose) && McdModelGetSpace(cb.loose) == cb.s;
}
static MeBool isMade(void) {
    return lastMade && McdModelIsValid(lastMade) && McdModelGetSpace(lastMade) == cb.s;
}
static MeBool isBodyMade(void) {
    return lastBody && MdtBodyIsValid(lastBody) && MdtBodyIsEnabled(lastBody);
}
static MeBool isJointMade(void) {
    return lastJoint && MdtBSJointIsEnabled(lastJoint);
}
static MeBool isNeverDone(void) {
    return MEFALSE;
}

/* done: null, where there is nothing to see. */
typedef struct Action {
    const char *name;
    void (*act)(void);
    MeBool (*isDone)(void);
} Action;

static const Action actions[] = {
    {"destroyModelAndBody", destroyModelAndBody, areModelAndBodyGone},
    {"destroyAllModels", destroyAllModels, isMeshGone},
    {"destroyModel", destroyModel, isModelGone},
    {"destroyFixed", destroyFixed, isMeshGone},
    {"destroyLoose", destroyLoose, isLooseGone},
    {"destroyBody", destroyBody, isBodyGone},
    {"destroyBodyThenModel", destroyBodyThenModel, 0},
    {"destroyAndCreate", destroyAndCreate, areModelAndBodyGone},
    {"resetModel", resetModel, 0},
    {"removeModel", removeModel, isOut},
    {"insertModel", insertModel, isIn},
    {"disablePair", disablePair, 0},
    {"endBlock", endBlock, 0},
    {"beginBlock", beginBlock, 0},
    {"updateSpace", updateSpace, 0},
    {"getPairs", getPairs, 0},
    {"freeze", freeze, 0},
    {"buildSpace", buildSpace, 0},
    {"destroySpace", destroySpace, isNeverDone},
    {"endFramework", endFramework, isNeverDone},
    {"emptyFramework", emptyFramework, 0},
    {"noTransform", noTransform, 0},
    {"otherGeometry", otherGeometry, 0},
    {"otherBody", otherBody, 0},
    {"partModel", partModel, 0},
    {"changeModel", changeModel, 0},
    {"changeShapes", changeShapes, 0},
    {"createGeometry", createGeometry, 0},
    {"destroyGeometry", destroyGeometry, 0},
    {"createModel", createModel, isMade},
    {"createFixed", createFixed, isMade},
    {"createBody", createBody, isBodyMade},
    {"createJoint", createJoint, isJointMade},
    {"destroyJoint", destroyJoint, isJointGone},
    {"disableJoint", disableJoint, 0},
    {"attachJoint", attachJoint, 0},
    {"changeJoint", changeJoint, 0},
    {"destroyUserConstraint", destroyUserConstraint, isUserGone},
    {"destroyContact", destroyContact, 0},
    {"destroyGroup", destroyGroup, isGroupGone},
    {"resetGroup", resetGroup, 0},
    {"attachGroup", attachGroup, 0},
    {"growGroup", growGroup, 0},
    {"destroyConstraints", destroyConstraints, 0},
    {"destroyContacts", destroyContacts, 0},
    {"disableConstraints", disableConstraints, 0},
    {"disableBody", disableBody, 0},
    {"enableBody", enableBody, 0},
    {"resetBody", resetBody, 0},
    {"moveBody", moveBody, 0},
    {"changeBody", changeBody, 0},
    {"copyBody", copyBody, 0},
    {"stepWorld", stepWorld, 0},
    {"stepUniverse", stepUniverse, 0},
    {"resetWorld", resetWorld, 0},
    {"recreateWorld", recreateWorld, 0},
    {"destroyWorld", destroyWorld, isNeverDone},
    {"changeWorld", changeWorld, 0},
    {"otherWorkers", otherWorkers, 0},
    {"noCallbacks", noCallbacks, 0},
    {"updatePartitions", updatePartitions, 0},
    {"forAll", forAll, 0},
    {"destroyUniverse", destroyUniverse, isNeverDone},
    {"destroyBridge", destroyBridge, isNeverDone},
    {"updateContacts", updateContacts, 0},
    {"handleCollisions", handleCollisions, 0},
    {"updateEvents", updateEvents, 0},
    {"resizeContacts", resizeContacts, 0},
    {"resizePairs", resizePairs, 0},
    {"newMaterial", newMaterial, 0},
    {"query", query, 0},
    {"changeManager", changeManager, 0},
    {"destroyManager", destroyManager, 0},
};
enum { ACTIONS = sizeof actions / sizeof *actions };

/* ---- what was said ----------------------------------------------------------------------------------------------- */

static struct {
    int count, refused, others;
    char last[512], other[512];
    MeBool namesCaller; /* each refusal did */
} said;

/* What may be said of a second call with the same objects, of an order that is none, and of what the scene does. */
static const char *const expected[] = {
    "has been destroyed",
    "legal only",
    "in a space already",
    "is in a space",
    "is in no space",
    "still use",
    "disable it before",
    "made by a bridge",
    "attached to no body",
    "is not set",
    "there is no material",
    "more pairs",
    "is null",
    "null is no",
    "lives in its group",
    "are left",
    "no room for",
    "has no body",
    "no memory",
    "none was",
    "one space",
    "not in this group",
    "unfinished tasks",
    "is enabled; disable",
    "could not be solved",
    "no transform",
    "is frozen",
    "were left",
};

static int refusals(void) {
    return said.refused;
}

static void note(const char *text) {
    said.count++;
    snprintf(said.last, sizeof said.last, "%s", text);
    if (strstr(text, "not from the function of")) {
        said.refused++;
        said.namesCaller = said.namesCaller && strstr(text, callbackKind[cb.acting].setBy) != 0;
        return;
    }
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (strstr(text, expected[i]))
            return;
    said.others++;
    snprintf(said.other, sizeof said.other, "%s", text);
}

static void MEAPI onWarning(const int level, const char *const format, va_list ap) {
    char text[512];
    (void)level;
    vsnprintf(text, sizeof text, format, ap);
    note(text);
    cb_call(CB_WARNING_HANDLER);
}

static void MEAPI onShow(const int level, const char *const text) {
    (void)level;
    note(text);
    cb_call(CB_WARNING_SHOW);
}

static void MEAPI onFatal(const int level, const char *const format, va_list ap) {
    (void)level, (void)format, (void)ap;
    cb_call(CB_FATAL_HANDLER);
}

/* ---- one of each ------------------------------------------------------------------------------------------------- */

static const Action *action;
static MeBool isOver; /* what is not refused may end the scene */

/* They do not see that what they call is refused: messages of their own go past them. */
static MeBool isHandler(int callback) {
    return callback == CB_WARNING_HANDLER || callback == CB_WARNING_SHOW;
}

static void act(void) {
    if (cb.calls == 1) {
        was.model = cb.model;
        was.serial = McdModelGetSerial(cb.model);
        was.modelsBody = bodyOf(cb.model);
        was.body = cb.body;
        was.joint = cb.joint;
        was.group = aGroup();
        was.contact = aContact();
        was.isDone = action->isDone && action->isDone();
    }
    const int refused = said.refused;
    action->act();
    if (action->isDone == isNeverDone && said.refused == refused && !isHandler(cb.acting))
        isOver = METRUE;
}

static MeBool isFine(MdtBodyID b) {
    MeVector3 p, v;
    MdtBodyGetPosition(b, p);
    MdtBodyGetLinearVelocity(b, v);
    for (int i = 0; i < 3; i++)
        if (!(MeFabs(p[i]) < 1000) || !(MeFabs(v[i]) < 500))
            return MEFALSE;
    return METRUE;
}

/* All that is in the world knows what it belongs to, and is somewhere. */
static void checkWorld(const char *callback) {
    int bodies = 0;
    for (MdtBodyID b = MdtBodyGetFirst(cb.w); b; b = MdtBodyGetNext(b), bodies++) {
        const McdModelID m = MdtBodyGetModel(b);
        ck_assert_msg(MdtBodyIsValid(b) && MdtBodyGetWorld(b) == cb.w && isFine(b), "%s, %s: a body is lost", callback,
                      action->name);
        ck_assert_msg(!m || (McdModelIsValid(m) && McdModelGetBody(m) == b), "%s, %s: a body has another's model",
                      callback, action->name);
        for (MdtConstraintID c = MdtBodyGetFirstConstraint(b); c; c = MdtBodyGetNextConstraint(b, c))
            ck_assert_msg(MdtConstraintIsValid(c), "%s, %s: a body has a dead constraint", callback, action->name);
    }
    ck_assert_msg(bodies == MdtWorldGetTotalBodies(cb.w), "%s, %s: %d of %d bodies", callback, action->name, bodies,
                  MdtWorldGetTotalBodies(cb.w));
}

static void listen(void) {
    memset(&said, 0, sizeof said);
    said.namesCaller = METRUE;
    MeSetWarningHandler(cb.acting == CB_WARNING_SHOW ? 0 : onWarning);
    MeSetWarningShow(onShow);
    MeSetFatalErrorHandler(onFatal);
}

static void frame(void) {
    MstUniverseStep(cb.u, CB_H);
    cb_callOutside();
}

/* With the program's memory functions in place of the standard ones. */
static void useMemory(void) {
    cb_standard = MeMemoryAPI;
    cb_isFailing = MEFALSE;
    MeMemoryAPI.create = cb_create;
    MeMemoryAPI.createAligned = cb_createAligned;
    MeMemoryAPI.destroy = cb_destroy;
}

/* More of everything, so that pools grow in the step that follows. */
static void needMemory(void) {
    static MeMatrix4 tm[64];
    for (int i = 0; i < 64 && (cb.acting == CB_CREATE_ALIGNED || cb.acting == CB_CREATE || cb.acting == CB_DESTROY ||
                               cb.acting == CB_FATAL_HANDLER);
         i++)
        cb_addFixed(cb.unit, tm[i], .9 * (i % 8) - 3, .9 * (i / 8) - 3, .4);
}

static MeBool isCalledAtOnce(int callback) {
    return callback == CB_HELLO || callback == CB_BREAK || callback == CB_WARNING_HANDLER ||
           callback == CB_WARNING_SHOW || callback == CB_ENQUEUE || callback == CB_FINISH || callback == CB_GOODBYE ||
           callback == CB_OWN_SAFE_TIME || callback == CB_OWN_DESTROY;
}

static MeBool isSeen(int callback, MeBool isDone) {
    return isHandler(callback) ? !action->isDone || !isDone || was.isDone : isDone || said.refused > 0;
}

static void runOne(int callback) {
    const char *const name = callbackKind[callback].name;
    useMemory();
    isOver = MEFALSE;
    lastMade = 0, lastBody = 0, lastJoint = 0;
    cb_begin(callback, act, 2);
    listen();
    cb.isArmed = isCalledAtOnce(callback);
    frame();
    frame();
    needMemory();
    cb_isFailing = callback == CB_FATAL_HANDLER;
    cb.isArmed = METRUE;
    for (int i = 0; i < 6 && !isOver && (i < 2 || cb.calls < cb.max); i++)
        frame();
    cb_isFailing = MEFALSE;
    if (callback != CB_TERM) {
        ck_assert_msg(cb.calls > 0, "%s was not called", name);
        const MeBool isDone = isOver || !action->isDone || action->isDone();
        ck_assert_msg(isSeen(callback, isDone), "%s, %s: not done, and not refused: %s", name, action->name, said.last);
    }
    ck_assert_msg(said.namesCaller, "%s, %s: '%s' does not name who called", name, action->name, said.last);
    ck_assert_msg(said.others == 0, "%s, %s: %s", name, action->name, said.other);
    cb.isArmed = callback == CB_TERM;
    for (int i = 0; i < 3 && !isOver; i++)
        MstUniverseStep(cb.u, CB_H);
    if (!isOver)
        checkWorld(name);
    if (!isOver || action->act != destroyUniverse)
        MstUniverseDestroy(cb.u);
    if (cb.manager)
        McdModelPairManagerDestroy(cb.manager);
    MeMemoryAPI = cb_standard;
}

/* KARMA_CALLBACKS=CALLBACK[.action]: only that one, and say so. */
static MeBool isWanted(int callback, const Action *a) {
    const char *const wanted = getenv("KARMA_CALLBACKS");
    char name[128];
    if (!wanted)
        return METRUE;
    snprintf(name, sizeof name, "%s.%s", callbackKind[callback].name, a->name);
    if (strncmp(name, wanted, strlen(wanted)) != 0)
        return MEFALSE;
    fprintf(stderr, "%s\n", name);
    return METRUE;
}

LOOP_TEST(every_action_works_or_is_refused_in_every_callback, 0, CB_COUNT) {
    for (int i = 0; i < ACTIONS; i++) {
        action = &actions[i];
        if (isWanted(_i, action))
            runOne(_i);
    }
    MeSetWarningHandler(0);
    MeSetWarningShow(0);
    MeSetFatalErrorHandler(0);
}
