/* Bodies that the program moves (kinematic), and models without a body that it moves by their transform: lifts,
 * platforms, carousels, belts, doors, a drum, supports of joints. Each by either solver. */
#include "McdMesh.h"
#include "MstEvents.h"
#include "universe.h"

#define STEP (1. / 60)
static const double gravity = 9.8;

enum { SOLVERS = 3 };

static void begin(int solver, double friction, double restitution) {
    universe_begin(0);
    MdtWorldSetSolver(u->world, (MdtSolver)solver);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, (MeReal)restitution);
}

static McdModelID addBox(double lx, double ly, double lz, double x, double y, double z) {
    const McdGeometryID g = McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz);
    const McdModelID m = MstModelAndBodyCreate(u, g, 1000);
    MdtBodySetPosition(McdModelGetBody(m), (MeReal)x, (MeReal)y, (MeReal)z);
    return m;
}

static MdtBodyID box(double size, double x, double y, double z) {
    return McdModelGetBody(addBox(size, size, size, x, y, z));
}

/* A box that the program moves. */
static MdtBodyID mover(double lx, double ly, double lz, double x, double y, double z) {
    const MdtBodyID b = McdModelGetBody(addBox(lx, ly, lz, x, y, z));
    MdtBodySetKinematic(b, METRUE);
    return b;
}

static double at(MdtBodyID b, int k) {
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    return (double)x[k];
}

static double speedAlong(MdtBodyID b, int k) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    return (double)v[k];
}

/* To a place, turned about z. */
static void moveTo(MdtBodyID b, double x, double y, double z, double angle) {
    const MeVector3 position = {(MeReal)x, (MeReal)y, (MeReal)z};
    const MeVector4 quaternion = {(MeReal)cos(angle / 2), 0, 0, (MeReal)sin(angle / 2)};
    MdtBodyMoveTo(b, position, quaternion);
}

/* ---- lifts ---- */

LOOP_TEST(a_lift_carries_ten_boxes_and_stops, 0, SOLVERS) {
    static const double speeds[] = {.5, 5, -1};
    for (int k = 0; k < 3; k++) {
        const double v = speeds[k], thrown = v > 0 ? v * v / (2 * gravity) : 0;
        MdtBodyID load[10];
        double top = 0, high = 0;
        begin(_i, .5, 0);
        const MdtBodyID lift = mover(4, 4, .5, 0, 0, -.25);
        for (int i = 0; i < 10; i++)
            load[i] = box(.5, -1.5 + .6 * (i % 5), -1 + .6 * (i / 5), .25);
        universe_step(30);
        for (int i = 0; i < 60; i++) {
            top += v * STEP;
            moveTo(lift, 0, 0, top - .25, 0);
            universe_step(1);
            assert_near(at(lift, 2), top - .25, TOL(1e-6, 1e-14));
            for (int j = 0; j < 10 && (v > 0 || i > 20); j++) /* down, they fall for a while */
                assert_near(at(load[j], 2), top + .25, TOL(1e-5, 1e-5));
        }
        for (int i = 0; i < 90; i++) {
            universe_step(1);
            for (int j = 0; j < 10; j++) {
                high = fmax(high, at(load[j], 2) - .25 - top);
                ck_assert_double_gt(at(load[j], 2) - .25 - top, -1e-5);
            }
        }
        assert_near(high, thrown, 1e-3 * thrown + 1e-5); /* a step samples the parabola's top to g h²/8 */
        assert_near(at(load[0], 0), -1.5, TOL(1e-5, 1e-5));
    }
}

/* ---- what joints take along ---- */

/* A hand that two fingers slide on, each pressed inwards by a motor with `factor` times the force that the load
 * needs. */
static MdtBodyID makeGripper(double size, double factor, double acceleration, MdtBodyID load) {
    const double mu = .2, force = MdtBodyGetMass(load) * (gravity + acceleration) / (2 * mu) * factor;
    const MdtBodyID hand = mover(3 * size, size, .2 * size, 0, 0, 2 * size);
    for (int side = -1; side <= 1; side += 2) {
        const MdtBodyID finger = McdModelGetBody(addBox(.2 * size, size, 2 * size, .6 * side * size, 0, .5 * size));
        const MdtPrismaticID slide = MdtPrismaticCreate(u->world);
        MdtPrismaticSetBodies(slide, finger, hand);
        MdtPrismaticSetAxis(slide, 1, 0, 0);
        MdtPrismaticEnable(slide);
        MdtLimitSetLimitedForceMotor(MdtPrismaticGetLimit(slide), (MeReal)(-side * size), (MeReal)force);
    }
    return hand;
}

/* m: how far the load has slipped after a second. */
static double slipInHand(int solver, double size, double factor, double acceleration, double h, MeBool isRound) {
    begin(solver, .2, 0);
    const McdGeometryID g = isRound ? McdSphereCreate(u->frame, (MeReal)(size / 2))
                                    : McdBoxCreate(u->frame, (MeReal)size, (MeReal)size, (MeReal)size);
    const MdtBodyID load = McdModelGetBody(MstModelAndBodyCreate(u, g, 1000));
    const MdtBodyID hand = makeGripper(size, factor, acceleration, load);
    double z = 0, v = 0;
    for (int i = 0; i < 1 / h; i++) {
        z += v * h + acceleration * h * h / 2;
        v += acceleration * h;
        moveTo(hand, 0, 0, 2 * size + z, 0);
        MstUniverseStep(u, (MeReal)h);
    }
    return fabs(at(load, 2) - z);
}

/* Had lagged by half a step's gain of speed, a h t / 2: .08 m at 1 g and 60 Hz. */
LOOP_TEST(a_hand_that_accelerates_keeps_its_load, 0, SOLVERS) {
    static const double sizes[] = {.05, .3, 2}, factors[] = {1.05, 1.2, 1.5, 3}, steps[] = {1. / 60, 1. / 240};
    for (int i = 0; i < 3; i++)
        for (int f = 0; f < 4; f++)
            for (int k = 0; k < 4; k++) {
                const double g = k < 2 ? .3 * gravity : gravity;
                const double slip = slipInHand(_i, sizes[i], factors[f], g, steps[k % 2], (MeBool)(f % 2));
                ck_assert_msg(slip < 1e-4 * sizes[i] + 1e-5, "%g m, %g times, %g m/s², step %g: slips by %g", sizes[i],
                              factors[f], g, steps[k % 2], slip);
            }
}

/* ---- friction ---- */

/* m: the farthest that a box at (x, y) of a platform comes from its place in `steps` of a path that the platform
 * follows: a circle of a radius (0: a straight line), with a speed that grows to `fast` and goes back to 0. */
static double slipOnPath(double radius, double fast, double size, double x, double y, int layers) {
    const MdtBodyID platform = mover(4, 4, .5, 0, 0, -.25);
    MdtBodyID load[3];
    double way = 0, v = 0, worst = 0;
    for (int i = 0; i < layers; i++)
        load[i] = box(size, x, y, (i + .5) * size);
    universe_step(30);
    for (int i = 0; i < 240; i++) {
        v = i < 150 ? fmin(fast, v + 3 * STEP) : fmax(0, v - 3 * STEP);
        way += v * STEP;
        const double angle = radius > 0 ? way / radius : 0;
        moveTo(platform, radius > 0 ? radius * sin(angle) : way, radius > 0 ? radius * (1 - cos(angle)) : 0, -.25,
               angle);
        universe_step(1);
        for (int j = 0; j < layers; j++)
            worst = fmax(worst, hypot(at(load[j], 0) - at(platform, 0) - x * cos(angle) + y * sin(angle),
                                      at(load[j], 1) - at(platform, 1) - x * sin(angle) - y * cos(angle)));
    }
    return worst;
}

LOOP_TEST(what_stands_on_a_platform_moves_with_it, 0, SOLVERS) {
    begin(_i, 1, 0);
    assert_below(slipOnPath(0, 3, .4, 1, .5, 1), 1e-5); /* half a step behind it would be .025 */
    begin(_i, 1, 0);
    assert_below(slipOnPath(0, 1, .1, 0, 0, 3), 2e-5);
    begin(_i, 1, 0);
    assert_below(slipOnPath(6, 3, .4, 1, .5, 1), 7e-4); /* of second order in w h */
}

/* m: how far a box slips in 5 s on a carousel of this speed. */
static double slipOnCarousel(double w, double radius, double friction, int solver) {
    double worst = 0;
    begin(solver, friction, 0);
    const MdtBodyID carousel = mover(8, 8, .5, 0, 0, -.25), load = box(.5, radius, 0, .25);
    universe_step(30);
    MdtBodySetAngularVelocity(carousel, 0, 0, (MeReal)w);
    MdtBodySetAngularVelocity(load, 0, 0, (MeReal)w);
    MdtBodySetLinearVelocity(load, 0, (MeReal)(w * radius), 0);
    for (int i = 1; i <= 300; i++) {
        universe_step(1);
        worst = fmax(worst, hypot(at(load, 0) - radius * cos(w * i * STEP), at(load, 1) - radius * sin(w * i * STEP)));
    }
    return worst;
}

/* A ship's deck in waves: friction suffices, so that nothing slides, though the deck begins each step with its new
 * velocity. With the deck's way along the waves, and with a quarter of a wave between both. */
LOOP_TEST(what_stands_on_a_deck_that_heaves_stays_there, 0, SOLVERS) {
    static const double rates[] = {30, 60, 240};
    for (int i = 0; i < 6; i++) {
        begin(_i, .6, 0);
        const double rate = rates[i / 2], phase = i % 2 * 1.57;
        MdtBodyID deck = mover(20, 10, 1, sin(phase), 0, -.5), crate = box(1, sin(phase), 0, .5);
        const double start = at(crate, 0) - at(deck, 0);
        for (int n = 1; n <= 20 * rate; n++) {
            const double t = n / rate;
            moveTo(deck, sin(1.5 * t + phase), 0, -.5 + 2 * sin(1.5 * t), 0);
            MstUniverseStep(u, (MeReal)(1 / rate));
        }
        ck_assert_msg(fabs(at(crate, 0) - at(deck, 0) - start) < 5e-3, "%g Hz, phase %g: drifts by %g m", rate, phase,
                      at(crate, 0) - at(deck, 0) - start);
        ck_assert_double_lt(fabs(at(crate, 2) - at(deck, 2) - 1), TOL(1e-3, 1e-3));
    }
}

LOOP_TEST(a_carousel_carries_up_to_the_speed_that_friction_holds, 0, SOLVERS) {
    assert_below(slipOnCarousel(1, 3, .5, _i), 3e-5); /* w² r = 3 < mu g = 4.9 */
    assert_below(slipOnCarousel(2.1, 1, .5, _i), 3e-5);
    ck_assert(slipOnCarousel(1.4, 3, .5, _i) > 1);
}

LOOP_TEST(a_belt_carries_in_the_same_direction_whichever_body_is_older, 0, SOLVERS) {
    const double v = 1, friction = .5, stop = v / (friction * gravity);
    for (int isLoadFirst = 0; isLoadFirst < 2; isLoadFirst++)
        for (int slides = 0; slides < 2; slides++) { /* by its motion; by its surface's */
            begin(_i, friction, 0);
            MdtBodyID load = isLoadFirst ? box(.5, 0, 0, .25) : 0;
            const MdtBodyID belt = mover(40, 2, .5, 0, 0, -.25);
            load = load ? load : box(.5, 0, 0, .25);
            universe_step(30);
            if (slides) {
                MdtContactParamsSetPrimarySlide(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)v);
                universe_step(60);
                ck_assert(fabs(speedAlong(load, 0)) + fabs(speedAlong(load, 1)) > .9);
                static double first[2][2];
                first[isLoadFirst][0] = speedAlong(load, 0);
                first[isLoadFirst][1] = speedAlong(load, 1);
                for (int k = 0; k < 2 && isLoadFirst; k++)
                    assert_near(first[1][k], first[0][k], 1e-3);
                continue;
            }
            MdtBodySetLinearVelocity(belt, (MeReal)v, 0, 0);
            universe_step(120);
            assert_near(at(belt, 0), 2 * v, TOL(1e-5, 1e-13));
            assert_near(at(load, 0), v * (2 - stop / 2), 2e-4);
            assert_near(speedAlong(load, 0), v, 1e-4);
        }
}

/* ---- pushing ---- */

LOOP_TEST(doors_that_close_push_a_box_without_entering_it, 0, SOLVERS) {
    static const double sizes[] = {.05, .5, 3}, speeds[] = {.3, 1, 4};
    for (int k = 0; k < 3; k++) {
        const double size = sizes[k], v = speeds[k] * sqrt(size), wall = 2 * size, half = .6 * size;
        double force = 0;
        begin(_i, .5, 0);
        universe_addFloor();
        const MdtBodyID left = mover(.2 * size, wall, wall, -wall, 0, size + .01),
                        right = mover(.2 * size, wall, wall, wall, 0, size + .01),
                        load = box(size, .3 * size, 0, size / 2);
        universe_step(30);
        for (double x = wall; x > half;) {
            x = fmax(half, x - v * STEP); /* in the end the box is held between them */
            moveTo(left, -x, 0, size + .01, 0);
            moveTo(right, x, 0, size + .01, 0);
            universe_step(1);
            ck_assert(at(load, 0) - at(left, 0) > (.6 - 1e-3) * size &&
                      at(right, 0) - at(load, 0) > (.6 - 1e-3) * size);
            for (MdtContactID c = MdtBodyGetFirstContact(load); c; c = MdtBodyGetNextContact(load, c)) {
                MeVector3 f;
                MdtConstraintGetForce(MdtContactQuaConstraint(c), 0, f);
                force = fmax(force, fabs((double)f[0]));
            }
        }
        universe_step(30);
        assert_near(at(load, 0), 0, 1e-3 * size);
        ck_assert(force > .1 * 1000 * size * size * size * gravity / 4); /* a point carries its share of friction */
    }
}

LOOP_TEST(a_mover_hits_as_an_infinite_mass, 0, SOLVERS) {
    static const double restitution[] = {0, .5, 1}, speed[] = {1, 3, 1};
    for (int k = 0; k < 3; k++) {
        begin(_i, 0, restitution[k]);
        MdtWorldSetGravity(u->world, 0, 0, 0);
        const MdtBodyID ram = mover(1, 1, 1, -2, 0, 0);
        const MdtBodyID ball = McdModelGetBody(MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal).2), 1000));
        MdtBodySetLinearVelocity(ram, (MeReal)speed[k], 0, 0);
        universe_step(150);
        assert_near(speedAlong(ball, 0), speed[k] * (1 + restitution[k]), 1e-5);
        assert_near(speedAlong(ram, 0), speed[k], TOL(1e-6, 1e-14));
    }
}

TEST(nothing_passes_a_mover_that_is_swept) {
    static const double cases[][4] = {{50, 0, 1, 0}, {5, 100, 0, 1}, {-5, 100, 0, 1}, {100, 0, 1, 1}};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 5; i++) {
            begin(0, .3, 0);
            MdtWorldSetGravity(u->world, 0, 0, 0);
            const McdModelID wall = addBox(.05, 4, 4, -3 - .013 * i, 0, 0);
            const McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal).1), 1000);
            MdtBodySetKinematic(McdModelGetBody(wall), METRUE);
            McdModelSetSwept(wall, cases[k][2] > 0);
            McdModelSetSwept(ball, cases[k][3] > 0);
            MdtBodySetLinearVelocity(McdModelGetBody(wall), (MeReal)cases[k][0], 0, 0);
            MdtBodySetLinearVelocity(McdModelGetBody(ball), (MeReal)-cases[k][1], (MeReal).1, 0);
            for (int n = 0; n < 20; n++) {
                universe_step(1);
                ck_assert(at(McdModelGetBody(ball), 0) - at(McdModelGetBody(wall), 0) > .125 - 1e-3);
            }
        }
}

/* ---- the old way: a fixed model's transform ---- */

static McdModelID fixedBox(MeMatrix4 tm, double lx, double ly, double lz, double x, double y, double z) {
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, (MeReal)x, (MeReal)y, (MeReal)z);
    return MstFixedModelCreate(u, McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz), tm);
}

LOOP_TEST(a_fixed_model_that_is_moved_lifts_and_pushes, 0, 2 * SOLVERS) {
    static const double speeds[] = {.2, 1, 6}, sizes[] = {.1, .5, 2};
    static MeMatrix4 lift, ram;
    const MeBool isAsleep = _i >= SOLVERS;
    for (int k = 0; k < 3; k++) {
        const double v = speeds[k], size = sizes[k];
        begin(_i % SOLVERS, .5, 0);
        universe_addFloor();
        const McdModelID m1 = fixedBox(lift, 4 * size, 4 * size, size, 20, 0, size / 2),
                         m2 = fixedBox(ram, size, size, .8 * size, -2 * size, 0, .42 * size);
        const MdtBodyID load = box(size, 20, 0, 1.5 * size), pushed = box(size, 0, 0, .5 * size);
        for (int i = 0; i < 600 && MdtBodyIsEnabled(load); i++)
            universe_step(1);
        if (!isAsleep)
            MdtBodyEnable(load), MdtBodyEnable(pushed), MdtWorldSetAutoDisable(u->world, MEFALSE);
        McdSpaceUnfreezeModel(m1);
        McdSpaceUnfreezeModel(m2);
        for (int i = 0; i < 60; i++) {
            lift[3][2] += (MeReal)(v * STEP);
            ram[3][0] += (MeReal)(v * STEP);
            universe_step(1);
            assert_near(at(load, 2), (double)lift[3][2] + size, TOL(1e-4, 1e-4) * size + TOL(4e-6, 1e-9));
            ck_assert(at(pushed, 0) - (double)ram[3][0] > (1 - 1e-3) * size);
        }
        ck_assert(!McdModelGetBody(m1) && McdModelGetTransformPtr(m1) == lift);
        ck_assert(MdtBodyIsEnabled(load));
        for (MdtContactID c = MdtBodyGetFirstContact(load); c; c = MdtBodyGetNextContact(load, c))
            ck_assert(!MdtContactGetBody(c, 1));
    }
}

TEST(a_fixed_model_that_is_moved_carries_and_may_jump) {
    static MeMatrix4 tm;
    begin(0, .8, 0);
    const McdModelID platform = fixedBox(tm, 4, 4, 1, 0, 0, -.5);
    const MdtBodyID load = box(.5, 1, 0, .25);
    universe_step(10);
    McdSpaceUnfreezeModel(platform);
    for (int i = 1; i <= 120; i++) {
        tm[3][0] = (MeReal)(i < 60 ? .5 * i * i * STEP * STEP : .5 + (i - 60) * STEP);
        universe_step(1);
        assert_near(at(load, 0) - (double)tm[3][0], 1, 1e-3);
    }
    tm[3][0] += 50; /* farther than its size: it is elsewhere now, without a velocity */
    universe_step(30);
    assert_below(at(load, 2), -.5);
    assert_below(fabs(speedAlong(load, 0)), 1.1);
    MstFixedModelDestroy(platform);
    universe_step(2);
}

/* The body that moves a fixed model is none of the program's: a stale handle that happens to be its address is as one
 * of any other body that is destroyed. */
TEST(the_body_of_a_fixed_model_that_is_moved_is_refused) {
    static MeMatrix4 tm;
    begin(0, .8, 0);
    const McdModelID platform = fixedBox(tm, 4, 4, 1, 0, 0, -.5);
    const MdtBodyID load = box(.5, 1, 0, .25);
    universe_step(2);
    McdSpaceUnfreezeModel(platform);
    tm[3][0] = (MeReal).01;
    universe_step(1);
    const MdtBodyID stale = McdModelGetBodyData(platform);
    ck_assert(stale && !MdtBodyIsValid(stale));
    messages_forget();
    McdModelSetBody(MdtBodyGetModel(load), stale);
    MdtBodySetUserData(stale, 0);
    MdtBodySetKinematic(stale, MEFALSE);
    MdtBodyDisable(stale);
    MdtBodyReset(stale);
    MdtBodyDestroy(stale);
    ck_assert_int_eq(caught.warnings, 6);
    ck_assert_str_eq(caught.last, "MdtBodyDestroy: the body has been destroyed, or never was one");
    messages_forget();
    ck_assert_ptr_eq(McdModelGetBody(MdtBodyGetModel(load)), load);
    tm[3][0] = (MeReal).02;
    universe_step(1);
    ck_assert(speedAlong(load, 0) > .1); /* it is moved still */
}

/* ---- joints ---- */

/* A pendulum of 1 m, whose support is moved along a curve and turned, after 2 s in n steps of 1/60 s each. */
static void swing(int solver, int n, double place[3]) {
    const double w = 3;
    begin(solver, 0, 0);
    MdtWorldSetEpsilon(u->world, 0);
    const MdtBodyID support = mover(.2, .2, .2, 0, 0, 0), bob = box(.1, 0, 0, -1);
    const MdtBSJointID joint = MdtBSJointCreate(u->world);
    MdtBSJointSetBodies(joint, bob, support);
    MdtBSJointSetPosition(joint, 0, 0, 0);
    MdtBSJointEnable(joint);
    for (int i = 1; i <= 120 * n; i++) {
        const double t = i * STEP / n;
        moveTo(support, .3 * sin(w * t), 0, .1 * sin(2 * w * t), .5 * sin(w * t));
        MstUniverseStep(u, (MeReal)(STEP / n));
        const double dx = at(bob, 0) - at(support, 0), dz = at(bob, 2) - at(support, 2);
        assert_near(hypot(dx, dz), 1, TOL(5e-6, 1e-6));
    }
    for (int k = 0; k < 3; k++)
        place[k] = at(bob, k);
}

LOOP_TEST(a_pendulum_follows_its_support, 1, SOLVERS) {
    double coarse[3], fine[3], finest[3];
    swing(_i, 1, coarse);
    swing(_i, 4, fine);
    swing(_i, 8, finest);
    for (int k = 0; k < 3; k += 2) {
        const double limit = (4 * finest[k] - fine[k]) / 3; /* it converges with the second order */
        assert_near(coarse[k], limit, 2e-3);
        assert_near(fine[k], limit, 2e-3 / 16 + TOL(1e-5, 1e-6));
    }
}

/* ---- sleep, partitions, life ---- */

TEST(what_lies_on_a_mover_sleeps_while_that_stands_still) {
    begin(0, .5, 0);
    const MdtBodyID platform = mover(4, 4, .5, 0, 0, -.25), load = box(.5, 0, 0, .25), other = box(.5, 1, 0, .25);
    for (int i = 0; i < 200 && MdtBodyIsEnabled(load); i++)
        universe_step(1);
    ck_assert(!MdtBodyIsEnabled(load) && !MdtBodyIsEnabled(other) && MdtBodyIsEnabled(platform));
    MdtBodySetLinearVelocity(platform, (MeReal).01, 0, 0);
    universe_step(1);
    ck_assert(MdtBodyIsEnabled(load));
    ck_assert(MdtBodyGetPartition(load) != MdtBodyGetPartition(other) && MdtBodyGetPartition(platform) == -1);
    universe_step(299);
    ck_assert(MdtBodyIsEnabled(load));
    assert_near(at(load, 0), .05, TOL(1e-5, 1e-6));
    MdtBodySetLinearVelocity(platform, 0, 0, 0);
    universe_step(120);
    ck_assert(!MdtBodyIsEnabled(load));
    MdtBodySetKinematic(platform, MEFALSE);
    ck_assert(!MdtBodyIsKinematic(platform));
    universe_step(30);
    assert_near(at(platform, 2) + .25, -gravity / 8, 1e-4);
    assert_near(at(load, 2) - .25, -gravity / 8, 1e-4);
}

TEST(a_mover_is_seen_by_sensors_and_stands_still_while_it_is_disabled) {
    int entered = 0;
    begin(0, .5, 0);
    const MdtBodyID cart = mover(1, 1, 1, 0, 0, 0);
    const McdModelID sensor = addBox(1, 1, 1, 3, 0, 0);
    MdtBodyDisable(McdModelGetBody(sensor));
    McdModelSetSensor(sensor, METRUE);
    MdtBodySetLinearVelocity(cart, 1, 0, 0);
    for (int i = 0; i < 150; i++) {
        int n;
        universe_step(1);
        const MstEvent *e = MstUniverseGetEvents(u, &n);
        for (int k = 0; k < n; k++)
            entered += e[k].isSensor != 0;
    }
    ck_assert_int_ge(entered, 1);
    MdtBodyDisable(cart);
    universe_step(10);
    assert_near(at(cart, 0), 2.5, TOL(1e-5, 1e-12));
    MdtBodyEnable(cart);
    universe_step(6);
    assert_near(at(cart, 0), 2.6, TOL(1e-5, 1e-12));
}

TEST(a_mover_waits_for_targets_and_turns_the_shorter_way) {
    begin(0, .5, 0);
    const MdtBodyID b = mover(1, 1, 1, 0, 0, 0);
    MeVector3 w;
    moveTo(b, .1, 0, 0, 6);
    universe_step(1);
    MdtBodyGetAngularVelocity(b, w);
    assert_near(w[2], (6 - 2 * ME_PI) * 60, TOL(1e-4, 1e-10));
    assert_near(speedAlong(b, 0), 6, TOL(1e-5, 1e-12));
    universe_step(1);
    assert_near(at(b, 0), .1, TOL(1e-7, 1e-16));
    assert_near(speedAlong(b, 0), 0, 0);
    MdtBodySetLinearVelocity(b, 1, 0, 0); /* velocities stay */
    MdtBodyAddForce(b, 0, 0, 1000);
    universe_step(60);
    assert_near(at(b, 0), 1.1, TOL(1e-5, 1e-12));
    assert_near(at(b, 2), 0, 0);
}

TEST(bad_targets_are_refused) {
    begin(0, .5, 0);
    const MdtBodyID b = mover(1, 1, 1, 0, 0, 0), loose = box(1, 9, 0, 0);
    const MeVector3 place = {1, 0, 0}, nowhere = {(MeReal)NAN, 0, 0}, far = {MEINFINITY, 0, 0};
    const MeVector4 turn = {2, 0, 0, 0}, none = {0, 0, 0, 0}, bad = {1, (MeReal)NAN, 0, 0};
    assert_refused(MdtBodyMoveTo, b, nowhere, turn);
    assert_refused(MdtBodyMoveTo, b, far, turn);
    assert_refused(MdtBodyMoveTo, b, place, none);
    assert_refused(MdtBodyMoveTo, b, place, bad);
    assert_refused(MdtBodyMoveTo, b, 0, turn);
    assert_refused(MdtBodyMoveTo, b, place, 0);
    assert_refused(MdtBodyMoveTo, loose, place, turn);
    assert_refused(MdtBodyMoveTo, 0, place, turn);
    assert_refused(MdtBodySetKinematic, 0, METRUE);
    assert_none(MdtBodyIsKinematic, 0);
    universe_step(1);
    assert_near(at(b, 0), 0, 0);
    MdtBodyMoveTo(b, place, turn); /* of length 2: it is normalized */
    universe_step(1);
    assert_near(at(b, 0), 1, 0);
}

static MdtBodyID toChange;

static MeBool MEAPI change(McdIntersectResult *result, McdContact *c, MdtContactID d) {
    (void)result, (void)c, (void)d;
    MdtBodySetKinematic(toChange, !MdtBodyIsKinematic(toChange));
    return METRUE;
}

TEST(a_callback_may_make_a_body_a_mover) {
    begin(0, .5, 0);
    universe_addFloor();
    toChange = box(.5, 0, 0, .25);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, change);
    for (int i = 0; i < 20; i++)
        universe_step(1);
    MstBridgeSetPerContactCB(u->bridge, 0, 0, 0);
    MdtBodySetKinematic(toChange, MEFALSE);
    universe_step(60);
    assert_near(at(toChange, 2), .25, 1e-3);
}

/* ---- drums ------------------------------------------------------------------------------------------------------- */

enum { SIDES = 32 };

/* A drum about y, of 32 flat faces, open at its ends, that turns at a rate. */
static MdtBodyID makeDrum(double radius, double rate) {
    MeVector3 corner[2 * SIDES];
    int side[2 * SIDES][3];
    for (int i = 0; i < 2 * SIDES; i++) {
        const double angle = 2 * (double)ME_PI * (double)(i / 2) / SIDES;
        MeVector3Set(corner[i], (MeReal)(radius * cos(angle)), (MeReal)((i % 2 - .5) * radius),
                     (MeReal)(radius * sin(angle)));
        const int next = (i / 2 + 1) % SIDES * 2, here = i / 2 * 2;
        const int first[3] = {here, next, here + 1}, second[3] = {next, next + 1, here + 1}; /* inwards */
        memcpy(side[i], i % 2 ? second : first, sizeof side[i]);
    }
    const McdModelID m = addBox(1, 1, 1, 0, 0, 0);
    McdModelSetGeometry(m, McdMeshCreate(u->frame, corner, 2 * SIDES, &side[0][0], 2 * SIDES, 0));
    MdtBodySetKinematic(McdModelGetBody(m), METRUE);
    MdtBodySetAngularVelocity(McdModelGetBody(m), 0, (MeReal)rate, 0);
    return McdModelGetBody(m);
}

/* A box, or a ball, on the middle of a face, with the drum's motion. */
static MdtBodyID putInDrum(double radius, double rate, double size, MeBool isBall) {
    const double angle = ME_PI / SIDES, r = radius * cos(angle) - size / 2;
    const McdGeometryID g = isBall ? McdSphereCreate(u->frame, (MeReal)(size / 2))
                                   : McdBoxCreate(u->frame, (MeReal)size, (MeReal)size, (MeReal)size);
    const MdtBodyID b = McdModelGetBody(MstModelAndBodyCreate(u, g, 1000));
    MdtBodySetPosition(b, (MeReal)(r * cos(angle)), 0, (MeReal)(r * sin(angle)));
    MdtBodySetQuaternion(b, (MeReal)cos(angle / 2), 0, (MeReal)-sin(angle / 2), 0);
    MdtBodySetLinearVelocity(b, (MeReal)(rate * r * sin(angle)), 0, (MeReal)(-rate * r * cos(angle)));
    MdtBodySetAngularVelocity(b, 0, (MeReal)rate, 0);
    return b;
}

/* m: the overlap of a ball, or of a box with its face, by the distance from the face below its centre. */
static double overlapInDrum(MdtBodyID b, double radius, double turned, double size) {
    const double phase = fmod(atan2(at(b, 2), at(b, 0)) + turned + 100 * ME_PI, 2 * ME_PI / SIDES) - ME_PI / SIDES;
    return hypot(at(b, 0), at(b, 2)) * cos(phase) + size / 2 - radius * cos(ME_PI / SIDES);
}

/* The face below a body turns by h w in a step: the body follows it, and is not driven on. */
LOOP_TEST(a_drum_carries_what_lies_at_its_wall, 0, SOLVERS) {
    static const struct {
        double radius, rate, size, h;
    } drums[] = {{2, 8, .3, STEP}, {2, 4, .3, STEP}, {.5, 8, .08, STEP}, {20, 2, 3, 1. / 30}, {2, 12, .3, 1. / 120}};
    for (int i = 0; i < 10; i++) {
        const double radius = drums[i / 2].radius, rate = drums[i / 2].rate, size = drums[i / 2].size;
        const double h = drums[i / 2].h;
        double deepest = 0, fastest = 0;
        begin(_i, .5, 0);
        MdtWorldSetGravity(u->world, 0, 0, 0);
        makeDrum(radius, rate);
        const MdtBodyID b = putInDrum(radius, rate, size, i % 2);
        for (int n = 1; n <= 120; n++) {
            MstUniverseStep(u, (MeReal)h);
            deepest = fmax(deepest, overlapInDrum(b, radius, rate * n * h, size));
            fastest = fmax(fastest, hypot(speedAlong(b, 0), speedAlong(b, 2)));
        }
        ck_assert_msg(deepest < 5e-3 * size && fastest < 1.01 * rate * radius, "%d: %g of its size deep, %g of the rim",
                      i, deepest / size, fastest / (rate * radius));
    }
}
