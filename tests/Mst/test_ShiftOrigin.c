/* Moving the origin (MstUniverseShiftOrigin): everything goes on as it would have, and what sleeps sleeps on. */
#include "MstEvents.h"
#include "MstMover.h"
#include "universe.h"

#define STEP (1. / 64) /* exact, as gravity is: free motion has no rounding */

enum { SOLVERS = 3, BODIES = 8 };

static MeMatrix4 floorPlace, wallPlace;
static McdModelID model[BODIES], floorModel, wall[2];
static int count;

static void begin(int solver) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetSolver(u->world, (MdtSolver)solver);
    MdtWorldSetGravity(u->world, 0, 0, -8);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).5, 0);
    count = 0;
}

static McdModelID addBox(double size, double x, double y, double z) {
    const McdModelID m =
        MstModelAndBodyCreate(u, McdBoxCreate(u->frame, (MeReal)size, (MeReal)size, (MeReal)size), 500);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    return model[count++] = m;
}

static void addGround(void) {
    MeMatrix4TMMakeIdentity(floorPlace);
    MeMatrix4TMMakeIdentity(wallPlace);
    floorPlace[3][2] = -.5;
    wallPlace[3][0] = 6;
    floorModel = MstFixedModelCreate(u, McdBoxCreate(u->frame, 40, 40, 1), floorPlace);
    for (int i = 0; i < 2; i++) /* of the same matrix */
        wall[i] = MstFixedModelCreate(u, McdBoxCreate(u->frame, 1, i ? 2 : 4, i ? 6 : 4), wallPlace);
}

/* A tower, a box that slides, one on a spring of the world, and a lift. */
static void addScene(void) {
    addGround();
    for (int i = 0; i < 3; i++)
        addBox(1, 0, 0, .5 + i);
    addBox(1, -3, 3, .5);
    McdModelDynamicsSetLinearVelocity(model[3], 4, 0, 0);
    addBox(.5, 3, -3, 3);
    MdtBSJointID j = MdtBSJointCreate(u->world);
    MdtBSJointSetBodies(j, McdModelGetBody(model[4]), 0);
    MdtBSJointSetPosition(j, 3, -2, 3);
    MdtBSJointEnable(j);
    addBox(1, -5, -5, .5);
    MdtBodySetKinematic(McdModelGetBody(model[5]), METRUE);
    MdtBodySetLinearVelocity(McdModelGetBody(model[5]), 0, 0, (MeReal).5);
    addBox(.5, -5, -5, 1.25);
}

static void step(int n) {
    while (n--)
        MstUniverseStep(u, (MeReal)STEP);
}

static void shiftBy(double x, double y, double z) {
    const MeVector3 shift = {(MeReal)x, (MeReal)y, (MeReal)z};
    MstUniverseShiftOrigin(u, shift);
}

static int countOf(MstEventKind kind) {
    int number, sum = 0;
    const MstEvent *events = MstUniverseGetEvents(u, &number);
    for (int i = 0; i < number; i++)
        sum += events[i].kind == kind;
    return sum;
}

static double place(McdModelID m, int k) {
    return (double)McdModelGetTransformPtr(m)[3][k];
}

/* Where all bodies are after some steps, the origin being moved before step `when` (negative: never). */
static void run(int solver, int steps, int when, double result[BODIES][3]) {
    static const double shift[3] = {64, -32, 16};
    begin(solver);
    addScene();
    for (int i = 0; i < steps; i++) {
        if (i == when)
            shiftBy(shift[0], shift[1], shift[2]);
        step(1);
        ck_assert(i != when || (countOf(MstEventEnd) == 0 && countOf(MstEventBegin) == 0));
    }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            result[i][k] = place(model[i], k) + (when < 0 ? 0 : shift[k]);
}

LOOP_TEST(everything_goes_on_as_it_would_have, 0, SOLVERS) {
    double still[BODIES][3], shifted[BODIES][3];
    run(_i, 90, -1, still);
    run(_i, 90, 40, shifted);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            assert_near(shifted[i][k], still[i][k], TOL(1e-3, 1e-9));
}

/* Flight of which every number is exact. */
LOOP_TEST(exact_motion_goes_on_bit_for_bit, 0, SOLVERS) {
    MeVector3 v, x[2];
    for (int isShifted = 0; isShifted < 2; isShifted++) {
        begin(_i);
        addGround();
        const McdModelID m = addBox(1, 1, 2, 8);
        McdModelDynamicsSetLinearVelocity(m, 2, -1, 3);
        McdModelSetSwept(m, METRUE);
        step(20);
        if (isShifted)
            shiftBy(4, -8, 2);
        step(30);
        McdModelDynamicsGetPosition(m, x[isShifted]);
        McdModelDynamicsGetLinearVelocity(m, v);
        ck_assert(v[0] == 2 && v[1] == -1 && v[2] == (MeReal)(3 - 50. / 8));
    }
    ck_assert(x[0][0] == x[1][0] + 4 && x[0][1] == x[1][1] - 8 && x[0][2] == x[1][2] + 2);
}

/* The transforms move by the shift alone, and nobody wakes, also as nothing happens for long. */
LOOP_TEST(sleepers_sleep_on, 0, SOLVERS) {
    double before[3];
    begin(_i);
    addGround();
    for (int i = 0; i < 3; i++)
        addBox(1, 0, 0, .5 + i);
    step(300);
    for (int i = 0; i < 3; i++) {
        ck_assert(!McdModelDynamicsIsEnabled(model[i]));
        before[i] = place(model[i], 2);
    }
    shiftBy(-1024, 512, -256);
    for (int i = 0; i < 3; i++)
        assert_near(place(model[i], 2), before[i] + 256, TOL(2e-5, 1e-13));
    for (int k = 0; k < 60; k++) {
        step(1);
        for (int i = 0; i < 3; i++)
            ck_assert(!McdModelDynamicsIsEnabled(model[i]) && McdSpaceModelIsFrozen(model[i]));
        ck_assert_int_eq(countOf(MstEventEnd) + countOf(MstEventBegin), 0);
    }
    const McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal).5), 5000); /* it is there */
    McdModelDynamicsSetPosition(ball, 1024, -512, 256 + 5);
    step(120);
    ck_assert(place(ball, 2) > 256 + 3);
}

/* ---- characters ---- */

enum { WALK = 90, JUMP = 30 };

/* One that walks over the floor, or on a deck that turns and rises; it jumps. `result`: where it is after each step,
 * its velocity, and that of its ground, the origin being moved before step `when`. The deck has its target then. */
static void walk(MeBool isOnDeck, int when, double result[WALK][9]) {
    static const double shift[3] = {64, -32, 16};
    const MeVector3 start = {1, 0, isOnDeck ? 1 : 0};
    MstMoverParams params;
    MstMoverResult at = {.flags = 0};
    double by[3] = {0, 0, 0};
    begin(0);
    addGround();
    const McdModelID deck = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 8, 8, 1), 1);
    MdtBodySetKinematic(McdModelGetBody(deck), METRUE);
    McdModelDynamicsSetPosition(deck, isOnDeck ? 0 : -20, 0, .5);
    step(1);
    MstMoverSetDefaults(&params, u);
    const MstMoverID mover = MstMoverCreate(u, &params, start);
    for (int i = 0; i < WALK; i++) {
        const double angle = .01 * i, height = .5 + .01 * i;
        const MeVector3 to = {(MeReal)((isOnDeck ? 0 : -20) - by[0]), (MeReal)-by[1], (MeReal)(height - by[2])};
        const MeVector4 q = {(MeReal)cos(angle / 2), 0, 0, (MeReal)sin(angle / 2)};
        const MeReal up = i == JUMP ? 4 : at.flags & kMstMoverOnGround ? 0 : at.velocity[2] - (MeReal)(8 * STEP);
        const MeVector3 want = {1, .5, up};
        MdtBodyMoveTo(McdModelGetBody(deck), to, q);
        if (i == when) {
            shiftBy(shift[0], shift[1], shift[2]);
            memcpy(by, shift, sizeof by);
        }
        MstMoverMove(mover, want, (MeReal)STEP, &at);
        step(1);
        for (int k = 0; k < 3; k++) {
            result[i][k] = (double)at.position[k] + by[k];
            result[i][3 + k] = (double)at.velocity[k];
            result[i][6 + k] = (double)at.groundVelocity[k];
        }
    }
    MstMoverDestroy(mover);
}

LOOP_TEST(characters_go_on_as_they_would_have, 0, 2) {
    static const int whens[] = {JUMP - 15, JUMP - 1, JUMP, JUMP + 1, JUMP + 10, WALK - 5};
    static double still[WALK][9], shifted[WALK][9];
    walk(_i, -1, still);
    ck_assert(still[JUMP + 10][2] > still[JUMP - 1][2] + .3);
    for (int w = 0; w < 6; w++) {
        walk(_i, whens[w], shifted);
        for (int i = 0; i < WALK; i++)
            for (int k = 0; k < 9; k++)
                assert_near(shifted[i][k], still[i][k], k < 3 ? TOL(1e-4, 2e-14) : TOL(1e-3, 5e-12));
    }
}

TEST(a_shift_may_not_take_a_character_out_of_bounds) {
    const MeVector3 start = {(MeReal)16e6, 0, 0};
    const MeVector3 shift = {(MeReal)-2e6, 0, 0};
    MstMoverParams params;
    MeVector3 place;
    begin(0);
    addGround();
    MstMoverSetDefaults(&params, u);
    const MstMoverID mover = MstMoverCreate(u, &params, start), other = MstMoverCreate(u, &params, start);
    assert_refused(MstUniverseShiftOrigin, u, shift);
    MstMoverGetPosition(mover, place);
    ck_assert(place[0] == start[0] && floorPlace[3][0] == 0);
    MstMoverDestroy(mover);
    assert_refused(MstUniverseShiftOrigin, u, shift);
    MstMoverDestroy(other);
    MstUniverseShiftOrigin(u, shift);
    ck_assert(floorPlace[3][0] == -shift[0]);
}

TEST(characters_may_outlive_their_universe) {
    const MeVector3 start = {0, 0, 0};
    MstMoverParams params;
    begin(0);
    MstMoverSetDefaults(&params, u);
    const MstMoverID mover = MstMoverCreate(u, &params, start);
    universe_end(NULL);
    assert_refused(MstMoverMove, mover, start, 1, NULL);
    MstMoverDestroy(mover);
}

/* Matrices of the program: each once, and models that it moves go on. */
TEST(the_program_s_matrices_are_shifted_once) {
    begin(0);
    addGround();
    const McdModelID load = addBox(.5, 6, 0, 3.25);
    McdModelID child = McdModelCreate(McdSphereCreate(u->frame, 1));
    MeMatrix4 relative;
    MeMatrix4TMMakeIdentity(relative);
    relative[3][1] = 9;
    McdModelSetTransformPtr(child, wallPlace);
    McdModelSetRelativeTransform(child, relative);
    McdSpaceUnfreezeModel(wall[1]);
    McdSpaceUnfreezeModel(wall[0]);
    for (int i = 0; i < 64; i++) {
        wallPlace[3][2] += (MeReal)(1. / 64);
        step(1);
        if (i == 30) {
            shiftBy(8, 0, 0);
            assert_near(wallPlace[3][0], -2, 0);
            assert_near(floorPlace[3][0], -8, 0);
            assert_near(place(child, 0), -2, 0);
            assert_near(place(child, 1), 9, 0);
        }
    }
    assert_near(place(load, 0), -2, 1e-3);
    assert_near(place(load, 2), 1 + 3.25, 2e-3);
    McdModelDestroy(child);
}

/* A far scene comes back to its digits: queries find it there. */
TEST(queries_find_what_was_shifted) {
    McdCastResult hit;
    const MeVector3 from = {0, 0, 9}, by = {0, 0, -20};
    begin(0);
    addGround();
    const McdModelID m = addBox(1, 2, 0, 3.5);
    MdtBodySetGravityFactor(McdModelGetBody(m), 0);
    step(5);
    shiftBy(2, 0, 0);
    step(1);
    McdSpaceEndChanges(u->space);
    ck_assert(McdSpaceCastRay(u->space, from, by, 0, 0, &hit) && hit.model == m);
    assert_near(hit.position[2], 4, TOL(1e-5, 1e-12));
    McdSpaceBeginChanges(u->space);
    shiftBy(-2, 0, 0);
    McdSpaceEndChanges(u->space);
    ck_assert(McdSpaceCastRay(u->space, from, by, 0, 0, &hit) && hit.model == floorModel);
    McdSpaceBeginChanges(u->space);
}

TEST(bad_shifts_change_nothing) {
    static const MeVector3 wrong = {0, NAN, 0}, far = {0, 0, (MeReal)1e30};
    begin(0);
    addGround();
    assert_refused(MstUniverseShiftOrigin, u, NULL);
    assert_refused(MstUniverseShiftOrigin, u, wrong);
    assert_refused(MstUniverseShiftOrigin, u, far);
    assert_refused(MstUniverseShiftOrigin, NULL, wrong);
    assert_near(floorPlace[3][2], -.5, 0);
}
