/* What wakes a sleeper: every change that would move it (docs/simulation.md, "Sleep"). */
#include "universe.h"

static MdtWorldID w;
static McdFrameworkID frame;
static MeMatrix4 places[16];
static int placeCount;
static McdModelID support, sleeper;

static McdModelID makeFixed(McdGeometryID g, double x, double y, double z) {
    MeReal(*tm)[4] = places[placeCount++];
    MeMatrix4TMMakeIdentity(tm);
    tm[3][0] = (MeReal)x, tm[3][1] = (MeReal)y, tm[3][2] = (MeReal)z;
    return MstFixedModelCreate(u, g, tm);
}

static McdModelID makeBox(double edge, double x, double z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(frame, edge, edge, edge), 1000);
    McdModelDynamicsSetPosition(m, x, 0, z);
    return m;
}

static void step(int n) {
    universe_step(n);
}

static double height(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[2];
}

static MeBool isAwake(McdModelID m) {
    return McdModelDynamicsIsEnabled(m) != 0;
}

static void makeWorld(void) {
    placeCount = 0;
    universe_begin(&MstUniverseGrowingSizes);
    w = MstUniverseGetWorld(u);
    frame = MstUniverseGetFramework(u);
    MdtWorldSetGravity(w, 0, 0, -9.8);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(MstUniverseGetBridge(u), 0, 0), .5, 0);
}

static void fallAsleep(void) {
    for (int i = 0; i < 600 && isAwake(sleeper); i++)
        step(1);
    ck_assert(!isAwake(sleeper));
}

/* A box that sleeps on a fixed one, whose top is at z = 0. */
static void setUp(void) {
    makeWorld();
    support = makeFixed(McdBoxCreate(frame, 4, 4, 1), 0, 0, -.5);
    sleeper = makeBox(.5, 0, .25);
    fallAsleep();
}

/* ---- what holds it up goes --------------------------------------------------------------------------------------- */

static void destroySupport(void) {
    MstFixedModelDestroy(support);
}
static void removeSupport(void) {
    McdSpaceRemoveModel(support);
}
static void filterSupport(void) {
    McdModelSetFilter(support, 2, 0);
}
static void groupSupport(void) {
    McdModelSetFilterGroup(support, -1), McdModelSetFilterGroup(sleeper, -1);
}
static void senseSupport(void) {
    McdModelSetSensor(support, METRUE);
}
static void disablePair(void) {
    McdSpaceDisablePair(support, sleeper);
}
static void shrinkSupport(void) {
    McdModelSetGeometry(support, McdBoxCreate(frame, .1, 4, .2));
}
static void flattenSupport(void) {
    McdBoxSetDimensions(McdModelGetGeometry(support), 4, 4, .2);
}
static void shrinkSleeper(void) {
    McdBoxSetDimensions(McdModelGetGeometry(sleeper), .5, .5, .1);
}
static void moveSupportAway(void) {
    McdSpaceUnfreezeModel(support), places[0][3][2] -= 2;
}
static void moveFrozenSupport(void) {
    places[0][3][2] -= 2;
}
static void lowerFrozenSupport(void) {
    places[0][3][2] -= (MeReal).1;
}
static void senseSleeper(void) {
    McdModelSetSensor(sleeper, METRUE);
}

TEST(what_loses_its_support_falls) {
    static void (*const changes[])(void) = {destroySupport, removeSupport,   filterSupport,     groupSupport,
                                            senseSupport,   disablePair,     shrinkSupport,     flattenSupport,
                                            shrinkSleeper,  moveSupportAway, moveFrozenSupport, lowerFrozenSupport,
                                            senseSleeper};
    for (int i = 0; i < (int)(sizeof changes / sizeof *changes); i++) {
        setUp();
        changes[i]();
        step(60);
        ck_assert_msg(height(sleeper) < .25 - .05, "change %d: at %g", i, height(sleeper));
        if (changes[i] == moveFrozenSupport || changes[i] == lowerFrozenSupport)
            assert_warned("McdSpaceUnfreezeModel");
        assert_silent();
    }
}

/* ---- what pushes it comes ---------------------------------------------------------------------------------------- */

static void growSleeper(void) {
    McdBoxSetDimensions(McdModelGetGeometry(sleeper), 1, 1, 1);
}
static void growSupport(void) {
    McdBoxSetDimensions(McdModelGetGeometry(support), 4, 4, 2);
}
static void tiltGravity(void) {
    MdtWorldSetGravity(w, 30, 0, -5);
}
static void push(void) {
    McdModelDynamicsAddForce(sleeper, 0, 0, 5000);
}
static void hit(void) {
    MdtBodyAddImpulse(McdModelGetBody(sleeper), 500, 0, 0);
}
static void twist(void) {
    MdtBodyAddTorque(McdModelGetBody(sleeper), 0, 0, 5000);
}
static void pointAt(void) {
    MdtBodyGetLinearVelocityPtr(McdModelGetBody(sleeper))[0] = 3;
}
static void lift(void) {
    McdModelDynamicsSetPosition(sleeper, 0, 0, 2);
}
static void dropOnto(void) {
    makeBox(.5, 0, 1.5);
}
static void slip(void) { /* a surface that moves */
    MdtContactParamsID p = MstBridgeGetContactParams(MstUniverseGetBridge(u), 0, 0);
    MdtContactParamsSetPrimarySlide(p, 1);
}
static void pull(void) {
    MdtSpringID s = MdtSpringCreate(w);
    MdtSpringSetBodies(s, McdModelGetBody(sleeper), 0);
    MdtSpringSetPosition(s, 0, 0, 0, .25);
    MdtSpringSetPosition(s, 1, 0, 0, 3);
    MdtSpringSetNaturalLength(s, .5);
    MdtSpringSetStiffness(s, 5000);
    MdtSpringSetDamping(s, 100);
    MdtSpringEnable(s);
}
static void anchor(void) {
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointSetBodies(j, McdModelGetBody(sleeper), 0);
    MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 0, 0, 0, .25);
    MdtConstraintBodySetPosition(MdtBSJointQuaConstraint(j), 1, 0, 0, 2);
    MdtBSJointEnable(j);
}
static void drive(void) {
    MdtPrismaticID j = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(j, McdModelGetBody(sleeper), 0);
    MdtPrismaticSetAxis(j, 0, 0, 1);
    MdtPrismaticEnable(j);
    MdtLimitSetLimitedForceMotor(MdtPrismaticGetLimit(j), 1, 100000);
}

TEST(what_is_pushed_moves) {
    static void (*const changes[])(void) = {growSleeper, growSupport, tiltGravity, push, hit,    twist, pointAt,
                                            lift,        dropOnto,    slip,        pull, anchor, drive};
    for (int i = 0; i < (int)(sizeof changes / sizeof *changes); i++) {
        setUp();
        MeVector4 q, p, p0, q0;
        McdModelDynamicsGetPosition(sleeper, p0);
        McdModelDynamicsGetQuaternion(sleeper, q0);
        changes[i]();
        double max = 0;
        for (int k = 0; k < 30; k++) {
            step(1);
            McdModelDynamicsGetPosition(sleeper, p);
            McdModelDynamicsGetQuaternion(sleeper, q);
            for (int c = 0; c < 3; c++)
                max = fmax(max, fabs((double)p[c] - (double)p0[c]) + fabs((double)q[c + 1] - (double)q0[c + 1]));
            max = changes[i] == dropOnto && isAwake(sleeper) ? 1 : max;
        }
        ck_assert_msg(max > .01, "change %d: moved by %g", i, max);
    }
}

/* ---- joints ------------------------------------------------------------------------------------------------------ */

static MdtHingeID hinge;

/* A bar that hangs from a hinge at its upper end, and sleeps. */
static void hang(void) {
    makeWorld();
    sleeper = makeBox(.5, 0, 3);
    hinge = MdtHingeCreate(w);
    MdtHingeSetBodies(hinge, McdModelGetBody(sleeper), 0);
    MdtHingeSetPosition(hinge, 0, 0, 3.5);
    MdtHingeSetAxis(hinge, 0, 1, 0);
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), 0, 100);
    MdtHingeEnable(hinge);
    fallAsleep();
}

static void destroyHinge(void) {
    MdtHingeDestroy(hinge);
}
static void disableHinge(void) {
    MdtHingeDisable(hinge);
}
static void setMotor(void) {
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), 1, 5000);
}
static void setStop(void) {
    MdtLimitID l = MdtHingeGetLimit(hinge);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(l), .5);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(l), 1);
    MdtLimitActivateLimits(l, METRUE);
}
static void setLock(void) {
    MdtLimitSetLock(MdtHingeGetLimit(hinge), .5, 10000);
}
static void moveWorldEnd(void) {
    MdtConstraintBodySetPosition(MdtHingeQuaConstraint(hinge), 1, 1, 0, 3.5);
}
static void moveBodyEnd(void) {
    MdtConstraintBodySetPosition(MdtHingeQuaConstraint(hinge), 0, .4, 0, 3);
}
static void moveWorld(void) {
    MdtConstraintSetWorldLinearVelocity(MdtHingeQuaConstraint(hinge), 1, 0, 0);
}
static void moveCentre(void) {
    const MeVector3 c = {.2, 0, 0};
    MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(sleeper), c);
}
static void hingeBeside(void) {
    MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, McdModelGetBody(sleeper), 0);
    MdtConstraintBodySetPosition(MdtHingeQuaConstraint(j), 0, 0, 0, 2.5);
    MdtConstraintBodySetPosition(MdtHingeQuaConstraint(j), 1, .3, 0, 2.5);
    MdtHingeEnable(j);
}

TEST(a_joint_that_changes_moves_its_body) {
    static void (*const changes[])(void) = {destroyHinge, disableHinge, setMotor,  setStop,    setLock,
                                            moveWorldEnd, moveBodyEnd,  moveWorld, moveCentre, hingeBeside};
    for (int i = 0; i < (int)(sizeof changes / sizeof *changes); i++) {
        hang();
        MeVector3 p, p0;
        MeVector4 q;
        McdModelDynamicsGetPosition(sleeper, p0);
        changes[i]();
        McdModelDynamicsGetPosition(sleeper, p0);
        step(40);
        McdModelDynamicsGetPosition(sleeper, p);
        McdModelDynamicsGetQuaternion(sleeper, q);
        ck_assert_msg(fabs((double)p[0] - (double)p0[0]) + fabs((double)p[2] - (double)p0[2]) + fabs(q[2]) > .05,
                      "change %d", i);
    }
}

/* Where there was no pair: from 1.5 m by its side, into it. */
TEST(what_grows_into_a_sleeper_wakes_it) {
    setUp();
    const McdModelID wall = makeFixed(McdBoxCreate(frame, 1, 1, 1), 2.25, 0, .5);
    step(30);
    ck_assert(!isAwake(sleeper));
    McdBoxSetDimensions(McdModelGetGeometry(wall), 4.2, 1, 1);
    step(2);
    ck_assert(isAwake(sleeper) && McdSpaceModelIsFrozen(wall));
}

/* What is set to the value that it has is no change, nor is what is only read. */
TEST(what_changes_nothing_wakes_nobody) {
    hang();
    for (int i = 0; i < 30; i++) {
        MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(hinge), 0, 100);
        MdtLimitGetPosition(MdtHingeGetLimit(hinge));
        MdtWorldSetGravity(w, 0, 0, -9.8);
        MdtBodySetMass(McdModelGetBody(sleeper), MdtBodyGetMass(McdModelGetBody(sleeper)));
        step(1);
        ck_assert(!isAwake(sleeper));
    }
}

/* A sleeper by the side of one whose inputs change. */
TEST(a_change_elsewhere_wakes_nobody) {
    setUp();
    McdModelID other = makeBox(.5, 50, .25);
    makeFixed(McdBoxCreate(frame, 4, 4, 1), 50, 0, -.5);
    const McdModelID sign = makeFixed(McdBoxCreate(frame, 1, 1, 1), 0, 50, 0);
    for (int i = 0; i < 60; i++) {
        McdBoxSetDimensions(McdModelGetGeometry(other), .5, .5, .5 - .002 * i);
        McdModelSetSensor(sign, i % 2);
        McdModelSetMaterial(sign, 0);
        step(1);
        ck_assert(!isAwake(sleeper));
    }
    ck_assert(McdSpaceModelIsFrozen(support) && isAwake(other));
}

/* ---- models that programs move ----------------------------------------------------------------------------------- */

/* A fixed model that is moved as the manual says pushes what it touches, asleep or awake, and does not go through. */
TEST(what_is_moved_pushes_sleepers) {
    const double speeds[] = {.05, 1, 5};
    for (int up = 0; up < 2; up++)
        for (int k = 0; k < 3; k++) {
            setUp();
            const double v = speeds[k], h = 1. / 60;
            const McdModelID mover = up ? support : makeFixed(McdBoxCreate(frame, 1, 1, .4), -.85, 0, .21);
            MeReal(*tm)[4] = places[up ? 0 : 1];
            McdSpaceUnfreezeModel(mover);
            for (int i = 0; i < 60; i++) {
                MeVector3 p;
                tm[3][up ? 2 : 0] += (MeReal)(v * h);
                step(1);
                McdModelDynamicsGetPosition(sleeper, p);
                const double gap =
                    up ? (double)p[2] - .25 - ((double)tm[3][2] + .5) : (double)p[0] - .25 - ((double)tm[3][0] + .5);
                ck_assert_msg(gap > -1e-5, "%s at %g m/s, step %d: overlaps by %g", up ? "up" : "along", v, i, -gap);
                ck_assert_msg(i < 30 || !up || fabs(gap) < v * h + .002, "up at %g m/s, step %d: gap %g", v, i, gap);
            }
            step(60); /* it stops: no velocity is left over */
            ck_assert(fabs(height(sleeper) - .25 - (up ? (double)tm[3][2] + .5 : 0)) < .02 || v > 2);
        }
}

/* Moved sideways it carries what stands on it, which slides by v² / (2 mu g) until it has the speed. */
TEST(what_is_moved_aside_carries) {
    setUp();
    MeVector3 p;
    McdSpaceUnfreezeModel(support);
    for (int i = 0; i < 60; i++) {
        places[0][3][0] += (MeReal).01;
        step(1);
    }
    McdModelDynamicsGetPosition(sleeper, p);
    assert_near(p[0], .6 - .6 * .6 / (2 * .5 * 9.8), 1e-3);
    assert_near(p[2], .25, 1e-3);
}

/* ---- the program hears of it ------------------------------------------------------------------------------------- */

static int woken, slept;

static void MEAPI hearWoken(MdtBodyID b) {
    ck_assert(MdtBodyIsEnabled(b));
    woken++;
}

static void MEAPI hearSlept(MdtBodyID b) {
    ck_assert(!MdtBodyIsEnabled(b) && McdSpaceModelIsFrozen(MdtBodyGetModel(b)));
    slept++;
}

/* A universe freezes models by handlers of its own: those of the program are called besides, and may go. */
TEST(handlers_of_the_program_are_called_beside_the_universes) {
    makeWorld();
    woken = slept = 0;
    MdtWorldSetBodyHandlers(w, hearWoken, hearSlept);
    support = makeFixed(McdBoxCreate(frame, 4, 4, 1), 0, 0, -.5);
    sleeper = makeBox(.5, 0, .25);
    ck_assert_int_eq(woken, 1);
    fallAsleep();
    ck_assert(slept == 1 && woken == 1 && McdSpaceModelIsFrozen(sleeper));
    MstFixedModelDestroy(support);
    step(1);
    ck_assert(woken == 2 && slept == 1 && !McdSpaceModelIsFrozen(sleeper));
    MdtWorldSetBodyHandlers(w, 0, 0);
    McdModelDynamicsDisable(sleeper);
    ck_assert(woken == 2 && slept == 1 && McdSpaceModelIsFrozen(sleeper));
}

/* ---- sleepers are destroyed -------------------------------------------------------------------------------------- */

enum { TOWER = 3 };
static McdModelID tower[TOWER];
static MdtBodyID towerBody[TOWER];
static int wakesOf[TOWER], sleepsOf[TOWER], victim, trigger;
static void (*destroyIt)(McdModelID);

static int indexOf(MdtBodyID b) {
    int i = 0;
    while (i < TOWER && towerBody[i] != b)
        i++;
    return i;
}

static void MEAPI countWake(MdtBodyID b) {
    const int i = indexOf(b);
    if (i < TOWER)
        wakesOf[i]++;
}

static void destroyVictim(void) {
    McdModelID m = tower[victim];
    tower[victim] = 0;
    if (m)
        destroyIt(m);
}

static void MEAPI countSleep(MdtBodyID b) {
    const int i = indexOf(b);
    if (i < TOWER)
        sleepsOf[i]++;
    if (i == trigger && sleepsOf[i] == 1)
        destroyVictim();
}

static void destroyModelAndBody(McdModelID m) {
    MstModelAndBodyDestroy(m);
}
static void destroyBodyFirst(McdModelID m) {
    MdtBodyDestroy(McdModelGetBody(m));
    McdModelDestroy(m);
}

/* Boxes upon each other that fall asleep together. */
static void buildTower(double edge) {
    makeWorld();
    MdtWorldSetBodyHandlers(w, countWake, countSleep);
    memset(towerBody, 0, sizeof towerBody);
    support = makeFixed(McdBoxCreate(frame, 8, 8, 1), 0, 0, -.5);
    for (int i = 0; i < TOWER; i++) {
        tower[i] = makeBox(edge, 0, (i + .5) * edge);
        towerBody[i] = McdModelGetBody(tower[i]);
        wakesOf[i] = sleepsOf[i] = 0;
    }
}

static void runTower(double h) {
    for (double t = 0; t < 4; t += h)
        MstUniverseStep(u, (MeReal)h);
}

/* The victim was told as asleep and is told nothing more; those above it wake, fall and sleep again. */
static void checkTower(const char *when) {
    for (int i = 0; i < TOWER; i++) {
        const int wakes = i == victim ? 0 : wakesOf[i];
        ck_assert_msg(wakesOf[i] == wakes && sleepsOf[i] == wakes + 1, "%s, victim %d, trigger %d: body %d: %d, %d",
                      when, victim, trigger, i, wakesOf[i], sleepsOf[i]);
        ck_assert_msg(i <= victim || wakesOf[i] >= 1, "%s, victim %d, trigger %d: body %d was not woken", when, victim,
                      trigger, i);
    }
    ck_assert_int_eq(MdtWorldGetEnabledBodies(w), 0);
    assert_silent();
}

TEST(handlers_are_not_called_again_for_a_sleeper_that_is_destroyed) {
    static void (*const ways[])(McdModelID) = {destroyModelAndBody, destroyBodyFirst};
    static const double edges[] = {.1, 1}, steps[] = {1. / 30, 1. / 120};
    for (int k = 0; k < 2 * TOWER; k++) {
        destroyIt = ways[k / TOWER], victim = k % TOWER, trigger = TOWER;
        buildTower(edges[k % 2]);
        runTower(steps[k / TOWER]);
        destroyVictim();
        runTower(steps[k / TOWER]);
        checkTower("destroyed by the program");
    }
    for (int k = 0; k < 2 * TOWER * TOWER; k++) {
        destroyIt = ways[k / (TOWER * TOWER)], victim = k % TOWER, trigger = k / TOWER % TOWER;
        buildTower(edges[k % 2]);
        runTower(steps[k / TOWER % 2]);
        checkTower("destroyed by a handler");
    }
}
