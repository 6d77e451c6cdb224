/* The rest certificate: what is at rest, and in which nothing changes, costs no solve; whatever changes is seen at
 * once, and what creeps goes on creeping. */
#include "Mst.h"
#include "measure.h"

/* ---- a pyramid of boxes, with contacts by Mcd, through the bridge ---- */

enum { CALM = 60 }; /* steps, in which gamma, 0.2, relaxes what there is */
enum { LARGE = 10, SMALL = 4, MAX = LARGE * (LARGE + 1) / 2, SETTLING = 200 }; /* rows, boxes, steps */
#define MASS 1000.0
#define G    9.81

typedef struct Pyramid {
    MstUniverseID universe;
    MdtWorldID world;
    McdGeometryID cube;
    MeMatrix4 floorTM;
    int boxes;
    MdtBodyID box[MAX]; /* the last one is the top */
    MdtHingeID hinge;   /* between the top and the world; free until it is given a motor */
} Pyramid;

static McdModelID addBox(Pyramid *s, double x, double y) {
    const McdModelID m = MstModelAndBodyCreate(s->universe, s->cube, MASS);
    MdtBodySetPosition(McdModelGetBody(m), x, y, 0);
    return m;
}

static void build(Pyramid *s, int rows) {
    static const MeMatrix4 level = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    memset(s, 0, sizeof *s);
    sizes.dynamicConstraintsMaxCount = 2000;
    s->universe = MstUniverseCreate(&sizes);
    s->world = MstUniverseGetWorld(s->universe);
    s->cube = McdBoxCreate(MstUniverseGetFramework(s->universe), 1, 1, 1);
    memcpy(s->floorTM, level, sizeof level);
    MstFixedModelCreate(s->universe, McdPlaneCreate(MstUniverseGetFramework(s->universe)), s->floorTM);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(MstUniverseGetBridge(s->universe), 0, 0), .5, 0);
    MdtWorldSetGravity(s->world, 0, -G, 0);
    MdtWorldSetAutoDisable(s->world, 0);
    MdtWorldEnableReport(s->world);
    for (int row = 0; row < rows; row++)
        for (int i = 0; i < rows - row; i++)
            s->box[s->boxes++] = McdModelGetBody(addBox(s, 1.1 * (i + .5 * row), .5 + row));
}

static MdtReport stepOnce(Pyramid *s) {
    MdtReport r;
    MstUniverseStep(s->universe, FRAME);
    ck_assert(MdtWorldGetReport(s->world, &r));
    return r;
}

/* The same, in a world in which no certificate holds: a parameter that the pyramid does not mind is another one each
 * time. */
static void stepUncertified(Pyramid *s) {
    MdtWorldSetTimedContacts(s->world, 1 - MdtWorldGetTimedContacts(s->world) % 2);
    ck_assert_int_eq(stepOnce(s).rested, 0);
}

static void settle(Pyramid *s) {
    for (int i = 0; i < SETTLING; i++)
        stepOnce(s);
}

typedef struct State {
    MeMatrix4 pose;
    MeVector3 velocity[2], force;
} State;

static State stateOf(MdtBodyID b) {
    State s;
    memset(&s, 0, sizeof s);
    memcpy(s.pose, MdtBodyGetTransformPtr(b), sizeof s.pose);
    MdtBodyGetLinearVelocity(b, s.velocity[0]);
    MdtBodyGetAngularVelocity(b, s.velocity[1]);
    for (MdtConstraintID c = MdtBodyGetFirstConstraint(b); c; c = MdtBodyGetNextConstraint(b, c)) {
        MeVector3 f;
        const unsigned int side = MdtConstraintGetBody(c, 0) == b ? 0 : 1;
        if (MdtConstraintDCastContactGroup(c)) /* has its contacts' forces */
            continue;
        MdtConstraintGetForce(c, side, f);
        for (int i = 0; i < 3; i++)
            s.force[i] += f[i];
    }
    return s;
}

static void checkCost(const MdtReport *r) {
    ck_assert_int_eq(r->way, MdtReportWayRest);
    ck_assert_int_eq(r->rested, 1);
    ck_assert_int_eq(r->rows + r->passes + r->factorizations + r->iterations, 0);
}

/* Where they are, how they move and what holds them, to the last bit. */
static void checkStates(const Pyramid *s, const State before[], int step) {
    for (int i = 0; i < s->boxes; i++) {
        const State now = stateOf(s->box[i]);
        ck_assert_msg(memcmp(&now, &before[i], sizeof now) == 0, "box %d has changed in step %d", i, step);
    }
}

/* The fast solver works in single precision, and rests when velocities are below a thousandth of g h. */
static const struct {
    int rows, steps;
    MdtSolver solver;
    double tolerance; /* of forces, of a weight */
} resting[] = {{LARGE, 1000, MdtSolverExact, 1e-6},
               {SMALL, 36000 /* 600 s */, MdtSolverExact, 1e-6},
               {LARGE, 1000, MdtSolverFast, 1e-4}};

#ifdef TEST_IS_SLOW
enum { PYRAMIDS = 1 };
#else
enum { PYRAMIDS = 3 };
#endif
LOOP_TEST(a_pyramid_at_rest_is_looked_at_and_not_solved, 0, PYRAMIDS) {
    Pyramid s;
    State before[MAX];
    build(&s, resting[_i].rows);
    MdtWorldSetSolver(s.world, resting[_i].solver);
    settle(&s);
    for (int i = 0; i < s.boxes; i++) {
        before[i] = stateOf(s.box[i]);
        assert_near(before[i].force[1], MASS * G, resting[_i].tolerance * MASS * G);
        assert_near(before[i].force[0], 0, resting[_i].tolerance * MASS * G);
    }
    for (int step = 0; step < resting[_i].steps; step++) {
        const MdtReport r = stepOnce(&s);
        checkCost(&r);
        if (step < 1000)
            checkStates(&s, before, step);
    }
    checkStates(&s, before, resting[_i].steps);
    MstUniverseDestroy(s.universe);
}

/* ---- what ends it ---- */

static MdtBodyID top(Pyramid *s) {
    return s->box[s->boxes - 1];
}

static MdtContactID someContact(Pyramid *s) {
    return MdtBodyGetFirstContact(top(s));
}

static void addForce(Pyramid *s) {
    MdtBodyAddForce(top(s), 1, 0, 0);
}

static void addTorque(Pyramid *s) {
    MdtBodyAddTorque(top(s), 0, 1, 0);
}

static void addImpulse(Pyramid *s) {
    MdtBodyAddImpulse(top(s), .1 * MASS, 0, 0);
}

static void changeGravity(Pyramid *s) {
    MdtWorldSetGravity(s->world, .5, -G, 0);
}

static void changeEpsilon(Pyramid *s) {
    MdtWorldSetEpsilon(s->world, 2 * MdtWorldGetEpsilon(s->world));
}

static void moveBody(Pyramid *s) {
    MeVector3 p;
    MdtBodyGetPosition(top(s), p);
    MdtBodySetPosition(top(s), p[0] + (MeReal).05, p[1] + (MeReal).05, p[2]);
}

static void writeVelocity(Pyramid *s) {
    MdtBodyGetLinearVelocityPtr(top(s))[0] = (MeReal).2;
}

static void turnBody(Pyramid *s) {
    MdtBodySetAngularVelocity(top(s), 0, 1, 0);
}

static void changeMass(Pyramid *s) {
    MdtBodySetMass(top(s), 2 * MASS);
}

static void damp(Pyramid *s) {
    MdtBodySetLinearVelocityDamping(top(s), 1);
}

static void createTouching(Pyramid *s) {
    const McdModelID m = addBox(s, -.46, 1.505); /* on the end of the first row */
    MdtBodyEnable(McdModelGetBody(m));
}

static void destroyNeighbour(Pyramid *s) {
    MstModelAndBodyDestroy(MdtBodyGetModel(s->box[0]));
    s->box[0] = 0;
}

static void disableAndEnable(Pyramid *s) {
    MdtBodyDisable(s->box[3]);
    MdtBodyEnable(s->box[3]);
}

static void changeMaterial(Pyramid *s) {
    MdtContactParamsSetPrimarySlide(MstBridgeGetContactParams(MstUniverseGetBridge(s->universe), 0, 0), .1);
}

static void destroyContacts(Pyramid *s) {
    MdtBodyDestroyContacts(top(s));
}

static void destroyContact(Pyramid *s) {
    const MdtContactID c = someContact(s);
    MdtContactGroupDestroyContact(MdtContactGetContactGroup(c), c);
}

static void tie(Pyramid *s) {
    s->hinge = scene_hinge(s->world, top(s), s->box[s->boxes - 2], 5, 9, 0, 0, 0, 1);
}

static void (*const disturbances[])(Pyramid *) = {
    addForce,       addTorque,      addImpulse,     changeGravity, changeEpsilon,  moveBody,         writeVelocity,
    turnBody,       changeMass,     damp,           tie,           createTouching, destroyNeighbour, disableAndEnable,
    changeMaterial, destroyContact, destroyContacts};
enum { DISTURBANCES = sizeof disturbances / sizeof *disturbances };

/* In the very next step, with the result of a world that solves every step; by the exact solver: some of them make
 * bodies meet, which the fast one solves in single precision. Boxes on four points share their loads in many ways; that
 * of the world that solves every step changes by rounding, and so does the path of a box that slides as it turns on its
 * corners, by 1e-4 m. */
LOOP_TEST(a_disturbance_ends_it_at_once, 0, DISTURBANCES) {
    Pyramid s, other;
    build(&s, SMALL);
    build(&other, SMALL);
    MdtWorldSetSolver(s.world, MdtSolverExact);
    MdtWorldSetSolver(other.world, MdtSolverExact);
    settle(&s);
    for (int i = 0; i < SETTLING; i++)
        stepUncertified(&other);
    ck_assert_int_eq(stepOnce(&s).rested, 1);
    disturbances[_i](&s);
    disturbances[_i](&other);
    const MdtReport r = stepOnce(&s);
    ck_assert_msg(r.rows > 0 && r.rested < r.parts, "disturbance %d was not seen", _i);
    stepUncertified(&other);
    for (int i = 0; i < 30; i++) {
        stepOnce(&s);
        stepUncertified(&other);
    }
    for (int i = 0; i < s.boxes; i++) {
        MeVector3 p, q;
        if (!s.box[i])
            continue;
        MdtBodyGetPosition(s.box[i], p);
        MdtBodyGetPosition(other.box[i], q);
        assert_vec3_near(p, q[0], q[1], q[2], disturbances[_i] == turnBody ? 2e-4 : TOL(2e-5, 5e-7));
    }
    MstUniverseDestroy(s.universe);
    MstUniverseDestroy(other.universe);
}

/* A force that is given anew in every step is the same load, and that it stops is a change. */
TEST(equal_loads_are_no_change) {
    Pyramid s;
    build(&s, SMALL);
    for (int i = 0; i < 2 * SETTLING; i++) {
        MdtBodyAddForce(top(&s), 0, -100, 0);
        stepOnce(&s);
    }
    MdtBodyAddForce(top(&s), 0, -100, 0);
    ck_assert_int_eq(stepOnce(&s).rested, 1);
    assert_near(stateOf(top(&s)).force[1], MASS * G + 100, 1e-6 * MASS * G);
    ck_assert_int_eq(stepOnce(&s).rested, 0);
    assert_near(stateOf(top(&s)).force[1], MASS * G, 1e-6 * MASS * G);
    MstUniverseDestroy(s.universe);
}

TEST(bodies_age_and_fall_asleep_as_ever) {
    Pyramid s, other;
    int asleep[2] = {0, 0};
    build(&s, SMALL);
    build(&other, SMALL);
    for (int i = 1; i < 2 * SETTLING; i++) {
        if (i == 2) {
            MdtWorldSetAutoDisable(s.world, 1);
            MdtWorldSetAutoDisable(other.world, 1);
            MdtWorldSetAutoDisableAliveWindow(s.world, SETTLING + SETTLING / 2);
            MdtWorldSetAutoDisableAliveWindow(other.world, SETTLING + SETTLING / 2);
        }
        stepOnce(&s);
        stepUncertified(&other);
        asleep[0] += !MdtBodyIsEnabled(top(&s));
        asleep[1] += !MdtBodyIsEnabled(top(&other));
    }
    ck_assert_int_gt(asleep[0], 0);
    ck_assert_int_eq(asleep[0], asleep[1]);
    MstUniverseDestroy(s.universe);
    MstUniverseDestroy(other.universe);
}

/* ---- a bar that is held by a lock, and its parameters, which programs write through pointers ---- */

/* Under load Kea keeps answers by which a joint is off by 1e-10 m, so that its bodies are never quite still. */
static HingedBar heldBar(double gravity) {
    HingedBar s = scene_hingedBar(gravity);
    MdtLimitSetLock(s.limit, 0, 100);
    MdtWorldEnableReport(s.world);
    steps(s.world, 2 * CALM, FRAME);
    return s;
}

static int restedIn(MdtWorldID w) {
    MdtReport r;
    MdtWorldStep(w, FRAME);
    ck_assert(MdtWorldGetReport(w, &r));
    return r.rested;
}

static void setLock(HingedBar *s) {
    s->limit->lock = (MeReal).01;
}

static void setLockForce(HingedBar *s) {
    MdtLimitSetLock(s->limit, 0, 1);
}

static void setMotor(HingedBar *s) {
    MdtLimitActivateLock(s->limit, 0);
    MdtLimitSetLimitedForceMotor(s->limit, 1, 100);
}

static void setStops(HingedBar *s) { /* which it does not reach */
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(s->limit), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(s->limit), 1);
    MdtLimitActivateLimits(s->limit, 1);
}

static void setAxis(HingedBar *s) {
    MdtHingeSetAxis(s->hinge, 0, .1, 1);
}

static void setPosition(HingedBar *s) {
    MdtHingeSetPosition(s->hinge, .1, 0, 0);
}

static void setWorldVelocity(HingedBar *s) {
    MdtConstraintSetWorldLinearVelocity(MdtHingeQuaConstraint(s->hinge), .1, 0, 0);
}

static void disable(HingedBar *s) {
    MdtHingeDisable(s->hinge);
}

static void (*const parameters[])(HingedBar *) = {setLock, setLockForce, setMotor,         setStops,
                                                  setAxis, setPosition,  setWorldVelocity, disable};
enum { PARAMETERS = sizeof parameters / sizeof *parameters };

LOOP_TEST(a_joint_whose_parameters_change_is_solved_again, 0, PARAMETERS) {
    HingedBar s = heldBar(0);
    ck_assert_int_eq(restedIn(s.world), 1);
    assert_near(s.limit->position, 0, 1e-6);
    ck_assert_int_eq(restedIn(s.world), 1);
    parameters[_i](&s);
    ck_assert_int_eq(restedIn(s.world), 0);
}

/* ---- a box on four contacts that stay as they are; whatever changes it or them ---- */

typedef struct Resting {
    MdtWorldID world;
    MdtBodyID box;
    MdtContactID contact[4];
    MdtContactGroupID group; /* of one more contact, like the first */
} Resting;

static void setUnder(MdtContactID c, int corner) {
    MdtBclContactParams params;
    MdtContactSetPosition(c, corner & 1 ? .5 : -.5, 0, corner & 2 ? .5 : -.5);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactParamsReset(&params);
    MdtContactParamsSetSurface(&params, .5, 0);
    MdtContactSetParams(c, &params);
}

static Resting restingBox(void) {
    const double edge[3] = {1, 1, 1};
    Resting s = {.world = scene_world(2, 8, 10)};
    MdtWorldSetEpsilon(s.world, 0); /* else it sinks: the contacts do not know of it */
    MdtWorldEnableReport(s.world);
    s.box = scene_box(s.world, 1, edge, 0, .5, 0);
    for (int i = 0; i < 4; i++) {
        s.contact[i] = MdtContactCreate(s.world, s.box, 0);
        setUnder(s.contact[i], i);
        MdtContactEnable(s.contact[i]);
    }
    s.group = MdtContactGroupCreate(s.world);
    MdtContactGroupSetBodies(s.group, s.box, 0);
    setUnder(MdtContactGroupCreateContact(s.group), 0);
    MdtContactGroupEnable(s.group);
    return s;
}

static Resting settledBox(void) {
    Resting s = restingBox();
    steps(s.world, CALM, FRAME);
    ck_assert_int_eq(restedIn(s.world), 1);
    return s;
}

/* Each sets something to another value, or, with 0, to the value that it has. */
static void contactPosition(Resting *s, int isOther) {
    MdtContactSetPosition(s->contact[0], -.5 + .1 * isOther, 0, -.5);
}

static void contactNormal(Resting *s, int isOther) {
    MdtContactSetNormal(s->contact[0], .1 * isOther, 1, 0);
}

static void contactPenetration(Resting *s, int isOther) {
    MdtContactSetPenetration(s->contact[0], .001 * isOther);
}

/* It takes in what the body's shown transform has lost by rounding, so that the box comes to rest anew. */
static void contactExact(Resting *s, int isOther) {
    const double position[3] = {-.5, 0, -.5 + .1 * isOther};
    for (int i = 0; i < CALM && !isOther; i++) {
        MdtContactSetExact(s->contact[0], position, 0);
        MdtWorldStep(s->world, FRAME);
    }
    MdtContactSetExact(s->contact[0], position, 0);
}

static void contactRadius(Resting *s, int isOther) {
    MdtContactSetRadius(s->contact[0], 0, (MeReal)isOther);
}

static void contactDirection(Resting *s, int isOther) {
    MeVector3 d;
    MdtContactGetDirection(s->contact[0], d);
    MdtContactSetDirection(s->contact[0], d[0] + (MeReal)isOther, 0, d[2] + (MeReal)(.5 * isOther));
}

static void contactParams(Resting *s, int isOther) {
    MdtBclContactParams params;
    MdtContactParamsReset(&params);
    MdtContactParamsSetSurface(&params, .5 + .1 * isOther, 0);
    MdtContactSetParams(s->contact[0], &params);
}

static void contactParamsByPointer(Resting *s, int isOther) {
    static MdtContactParamsID kept;
    if (!isOther) {
        kept = MdtContactGetParams(s->contact[0]);
        steps(s->world, CALM, FRAME); /* from now on it is looked at, and may rest again */
    } else {
        MdtContactParamsSetRestitution(kept, .5);
    }
}

static void contactWorldVelocity(Resting *s, int isOther) {
    MdtContactSetWorldVelocity(s->contact[0], 0, 0, (MeReal)isOther);
}

static void bodyMass(Resting *s, int isOther) {
    MdtBodySetMass(s->box, 1. + isOther);
}

static void bodyDamping(Resting *s, int isOther) {
    MdtBodySetLinearVelocityDamping(s->box, (MeReal)isOther);
    MdtBodySetAngularVelocityDamping(s->box, (MeReal)isOther);
}

static void bodyCoriolis(Resting *s, int isOther) {
    if (isOther)
        MdtBodyDisableCoriolisForce(s->box);
    else
        MdtBodyEnableCoriolisForce(s->box);
}

static void worldStepParameters(Resting *s, int isOther) {
    MdtWorldSetSubSteps(s->world, 1 + isOther);
}

static void worldGamma(Resting *s, int isOther) {
    MdtWorldSetGamma(s->world, MdtWorldGetGamma(s->world) + (MeReal)(.1 * isOther));
}

static void bodyVelocityPointers(Resting *s, int isOther) {
    MdtBodyGetAngularVelocityPtr(s->box)[1] += (MeReal)isOther;
}

static void nothingButReading(Resting *s, int isOther) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(s->box, v);
    MdtContactGetRelativeVelocity(s->contact[0], v);
    if (isOther)
        MdtBodySetQuaternion(s->box, 1, 0, 0, 0); /* placed: its forces are no guess any more */
}

static void bodyCentre(Resting *s, int isOther) {
    MeVector3 centre = {.1 * isOther, 0, 0};
    if (isOther)
        MdtBodySetCenterOfMassRelativePosition(s->box, centre);
}

static void bodyCentrePosition(Resting *s, int isOther) {
    MeVector3 p = {.1 * isOther, .5, 0};
    if (isOther)
        MdtBodySetCenterOfMassPosition(s->box, p);
}

static void bodyInertia(Resting *s, int isOther) {
    if (isOther)
        MdtBodySetSphericalInertiaTensor(s->box, 3);
}

static void bodyReset(Resting *s, int isOther) {
    if (isOther)
        MdtBodyReset(s->box);
}

static void contactRemoved(Resting *s, int isOther) {
    if (isOther)
        MdtContactGroupRemoveContact(s->group, MdtContactGroupGetFirstContact(s->group));
}

static void contactCreated(Resting *s, int isOther) {
    if (isOther)
        MdtContactGroupCreateContact(s->group);
}

static void groupDisabled(Resting *s, int isOther) {
    if (isOther)
        MdtContactGroupDisable(s->group);
    else
        MdtContactGroupEnable(s->group);
}

static void contactReset(Resting *s, int isOther) {
    if (isOther)
        MdtContactReset(s->contact[0]);
}

static void contactDisabled(Resting *s, int isOther) {
    if (isOther)
        MdtContactDisable(s->contact[0]);
    else
        MdtContactEnable(s->contact[0]);
}

static void contactEnabled(Resting *s, int isOther) {
    if (!isOther)
        return;
    MdtContactDisable(s->contact[0]); /* the group's contact takes its place */
    steps(s->world, 2 * CALM, FRAME);
    ck_assert_int_eq(restedIn(s->world), 1);
    MdtContactEnable(s->contact[0]);
}

static void (*const setters[])(Resting *, int) = {contactPosition,
                                                  contactNormal,
                                                  contactPenetration,
                                                  contactExact,
                                                  contactRadius,
                                                  contactDirection,
                                                  contactParams,
                                                  contactWorldVelocity,
                                                  contactParamsByPointer,
                                                  bodyMass,
                                                  bodyDamping,
                                                  bodyCoriolis,
                                                  worldStepParameters,
                                                  worldGamma,
                                                  bodyVelocityPointers,
                                                  nothingButReading,
                                                  bodyCentre,
                                                  bodyCentrePosition,
                                                  bodyInertia,
                                                  bodyReset,
                                                  contactReset,
                                                  contactRemoved,
                                                  contactCreated,
                                                  groupDisabled,
                                                  contactDisabled,
                                                  contactEnabled};
enum { SETTERS = sizeof setters / sizeof *setters };

LOOP_TEST(a_setter_is_a_change_if_the_value_is_another, 0, SETTERS) {
    Resting s = settledBox();
    setters[_i](&s, 0);
    ck_assert_msg(restedIn(s.world) == 1, "setter %d: the same value was taken for a change", _i);
    setters[_i](&s, 1);
    ck_assert_msg(restedIn(s.world) == 0, "setter %d: the change was not seen", _i);
}

static void MEAPI noRows(MdtKeaConstraints *const rows, void *const c, const MdtKeaTransformation *const poses,
                         MdtKeaBody *const bodies[], const void *const params) {
    (void)rows, (void)c, (void)poses, (void)bodies, (void)params;
}

TEST(rows_by_a_function_of_the_program_are_never_certified) {
    Resting s = settledBox();
    MdtUserConstraintID c = MdtUserConstraintCreate(s.world);
    MdtUserConstraintSetFunction(c, noRows);
    MdtUserConstraintSetBodies(c, s.box, 0);
    MdtUserConstraintEnable(c);
    for (int i = 0; i < 2 * CALM; i++)
        ck_assert_int_eq(restedIn(s.world), 0);
}

TEST(another_step_size_is_a_change) {
    MdtReport r;
    Resting s = settledBox();
    MdtWorldStep(s.world, FRAME / 2);
    ck_assert(MdtWorldGetReport(s.world, &r));
    ck_assert_int_eq(r.rested, 0);
}

/* ---- what creeps ---- */

#define CREEP 1e-6 /* m/s, rad/s */

static double placeAfter(Resting s, int count, int axis, double force) {
    MeVector3 before, after;
    MdtBodyGetPosition(s.box, before);
    for (int i = 0; i < count; i++) {
        MdtBodyAddForce(s.box, 0, 0, force);
        MdtWorldStep(s.world, FRAME);
    }
    MdtBodyGetPosition(s.box, after);
    return (double)after[axis] - (double)before[axis];
}

/* A conveyor: the contacts want this velocity along x. */
TEST(a_slow_slide_goes_on) {
    Resting s = settledBox();
    MdtContactGroupDisable(s.group);
    for (int i = 0; i < 4; i++) {
        MdtContactSetDirection(s.contact[i], 1, 0, 0);
        MdtContactParamsSetPrimarySlide(MdtContactGetParams(s.contact[i]), CREEP);
    }
    assert_near(fabs(placeAfter(s, 600, 0, 0)), 10 * CREEP, 1e-2 * 10 * CREEP);
}

/* Each contact slips at slip times its force, a quarter of 1 N. */
TEST(a_slow_slip_goes_on) {
    Resting s = settledBox();
    MdtContactGroupDisable(s.group);
    for (int i = 0; i < 4; i++)
        MdtContactParamsSetSlip(MdtContactGetParams(s.contact[i]), 4 * CREEP);
    assert_near(placeAfter(s, 600, 2, 1), 10 * CREEP, 1e-2 * 10 * CREEP);
}

TEST(a_slow_motor_goes_on) {
    HingedBar s = heldBar(10);
    MdtLimitActivateLock(s.limit, 0);
    MdtLimitSetLimitedForceMotor(s.limit, CREEP, 100);
    const double before = MdtLimitGetPosition(s.limit);
    steps(s.world, 600, FRAME);
    assert_near(MdtLimitGetPosition(s.limit) - before, 10 * CREEP, 1e-2 * 10 * CREEP);
}

/* It never stops coming nearer to where it balances the load. */
TEST(a_damped_spring_comes_to_where_it_rests) {
    Resting s = restingBox();
    MdtSpringID spring = MdtSpringCreate(s.world);
    MeVector3 p;
    for (int i = 0; i < 4; i++)
        MdtContactDisable(s.contact[i]);
    MdtContactGroupDisable(s.group);
    MdtSpringSetBodies(spring, s.box, 0);
    MdtSpringSetPosition(spring, 0, 0, .5, 0);
    MdtSpringSetPosition(spring, 1, 0, 1.5, 0);
    MdtSpringSetNaturalLength(spring, 1);
    MdtSpringSetStiffness(spring, 100);
    MdtSpringSetDamping(spring, 100); /* overdamped: 1 s to a third of the way */
    MdtSpringEnable(spring);
    for (int i = 0; i < 3000; i++)
        ck_assert(restedIn(s.world) == 0 || i > 2000);
    MdtBodyGetPosition(s.box, p);
    assert_near(p[1], .5 - 10 / 100., TOL(1e-7, 1e-10));
}

/* At its turning points a pendulum has no velocity, but it is accelerated. It starts at one. */
TEST(a_pendulum_does_not_stop_where_it_turns) {
    HingedBar s = scene_hingedBar(10);
    MdtWorldEnableReport(s.world);
    for (int i = 0; i < 600; i++)
        ck_assert_int_eq(restedIn(s.world), 0);
}
