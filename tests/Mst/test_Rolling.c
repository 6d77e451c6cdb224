/* Rolling and spinning friction: bodies come to rest where the bounds of the torques say, by either solver. */
#include "Mst.h"
#include "karma_test.h"

static const double gravity = 9.81;

static MstUniverseID u;
static MdtContactParamsID surface;
static MeMatrix4 ground;

static void tearDown(void) {
    MstUniverseDestroy(u);
}

/* A plane with the slope `angle` down towards x. */
static void begin(MdtSolver solver, double friction, double rolling, double spinning, double angle) {
    tearDown();
    u = MstUniverseCreate(0);
    MdtWorldSetSolver(u->world, solver);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldSetGravity(u->world, (MeReal)(gravity * sin(angle)), 0, (MeReal)(-gravity * cos(angle)));
    surface = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetSurface(surface, (MeReal)friction, 0);
    MdtContactParamsSetRollingFriction(surface, (MeReal)rolling);
    MdtContactParamsSetSpinningFriction(surface, (MeReal)spinning);
    MeMatrix4TMMakeIdentity(ground);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
}

static void setUp(void) {
    u = MstUniverseCreate(0);
}
TEST_FIXTURE(setUp, tearDown)

static MdtBodyID add(McdGeometryID geometry, double height) {
    const MdtBodyID body = McdModelGetBody(MstModelAndBodyCreate(u, geometry, 1000));
    MdtBodySetPosition(body, 0, 0, (MeReal)height);
    return body;
}

static double placeOf(MdtBodyID body) {
    MeVector3 x;
    MdtBodyGetPosition(body, x);
    return (double)x[0];
}

static double speedOf(MdtBodyID body) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(body, v);
    return (double)v[0];
}

static double spinOf(MdtBodyID body, int axis) {
    MeVector3 w;
    MdtBodyGetAngularVelocity(body, w);
    return (double)w[axis];
}

static void run(double seconds, double step) {
    for (int i = 0; i < (int)(seconds / step + .5); i++)
        MstUniverseStep(u, (MeReal)step);
}

static const MdtSolver solvers[] = {MdtSolverExact, MdtSolverFast};

/* ---- coming to rest ---------------------------------------------------------------------------------------------- */

/* The way of a body of radius R, with the moment k m R², that rolls with v: the torque about the contact is m g r, the
 * angular momentum (1 + k) m R v. */
static double wayOf(double k, double R, double v, double r) {
    return (1 + k) * v * v * R / (2 * r * gravity);
}

TEST(a_ball_and_a_wheel_come_to_rest_where_the_bound_says) {
    static const char *const names[] = {"ball", "wheel"};
    static const double cases[][4] = {
        {.5, 2, .02, 60}, {.05, .3, 5e-4, 120}, {3, 10, .3, 30}, {.5, 1, .1, 240}, {.1, 5, .01, 60}};
    for (int i = 0; i < 20; i++) {
        const double *c = cases[i % 5], R = c[0], v = c[1], r = c[2], step = 1 / c[3];
        const MeBool isWheel = i >= 10;
        begin(solvers[i / 5 % 2], 1, r, 0, 0);
        MdtBodyID body;
        if (isWheel) {
            MeMatrix4 tm;
            body = add(McdCylinderCreate(u->frame, (MeReal)R, (MeReal)R), R);
            MeMatrix4TMMakeIdentity(tm);
            MeVector3Set(tm[1], 0, 0, 1);
            MeVector3Set(tm[2], 0, -1, 0);
            MeVector3Set(tm[3], 0, 0, (MeReal)R);
            MdtBodySetTransform(body, tm);
        } else {
            body = add(McdSphereCreate(u->frame, (MeReal)R), R);
        }
        MdtBodySetLinearVelocity(body, (MeReal)v, 0, 0);
        MdtBodySetAngularVelocity(body, 0, (MeReal)(v / R), 0);
        const double way = wayOf(isWheel ? .5 : .4, R, v, r), time = 2 * way / v;
        run(1.1 * time, step);
        const double end = placeOf(body);
        ck_assert_msg(fabs(end / way - 1) < 2e-5, "%s of %g m, %g m/s, bound of %g m: rolls %g m, not %g",
                      names[isWheel], R, v, r, end, way);
        run(1, step);
        assert_near(placeOf(body), end, 1e-9);
    }
}

TEST(a_ball_on_a_slope_rolls_or_stays) {
    static const double R = .5, step = 1. / 60;
    for (int i = 0; i < 2; i++)
        for (double r = .01; r < .2; r *= 2) {
            const double still = atan(.95 * r / R), steep = atan(2 * r / R);
            begin(solvers[i], 1, r, 0, still);
            MdtBodyID body = add(McdSphereCreate(u->frame, (MeReal)R), R);
            run(5, step);
            assert_near(placeOf(body), 0, 1e-8);
            assert_near(speedOf(body), 0, 1e-7);
            begin(solvers[i], 1, r, 0, steep);
            body = add(McdSphereCreate(u->frame, (MeReal)R), R);
            run(2, step);
            const double a = gravity * (sin(steep) - r / R * cos(steep)) / 1.4;
            assert_near(speedOf(body) / (2 * a), 1, 1e-6);
        }
}

TEST(a_spinning_ball_comes_to_rest_and_stays_where_it_is) {
    static const double R = .5, step = 1. / 60, spin = 20;
    for (int i = 0; i < 4; i++) {
        const double r = i / 2 ? .1 : .02;
        begin(solvers[i % 2], .5, 0, r, 0);
        MdtBodyID body = add(McdSphereCreate(u->frame, (MeReal)R), R);
        MdtBodySetAngularVelocity(body, 0, 0, (MeReal)spin);
        const double time = .4 * R * R * spin / (r * gravity);
        run(time / 2, step);
        const double steps = floor(time / 2 / step + .5);
        assert_near(spinOf(body, 2), spin * (1 - steps * step / time), 1e-5 * spin);
        run(time, step);
        assert_near(spinOf(body, 2), 0, 1e-9);
        assert_near(placeOf(body), 0, 1e-9);
    }
}

/* ---- between bodies ---------------------------------------------------------------------------------------------- */

TEST(a_ball_that_comes_to_rest_on_a_plank_takes_it_along) {
    static const double R = .3, step = 1. / 60;
    for (int i = 0; i < 2; i++) {
        begin(solvers[i], 0, .01, .01, 0);
        const McdModelID plank = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 20, 2, (MeReal).2), 100);
        const MdtBodyID board = McdModelGetBody(plank);
        MdtBodySetPosition(board, 0, 0, (MeReal).1);
        const MstMaterialID rough = MstBridgeGetNewMaterial(u->bridge);
        const MdtContactParamsID both = MstBridgeGetContactParams(u->bridge, 0, rough);
        MdtContactParamsSetSurface(both, 1, 0);
        MdtContactParamsSetRollingFriction(both, (MeReal).02);
        const McdModelID model = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal)R), 1000);
        McdModelSetMaterial(model, (int)rough);
        const MdtBodyID ball = McdModelGetBody(model);
        MdtBodySetPosition(ball, -3, 0, (MeReal)(.2 + R));
        MdtBodySetLinearVelocity(ball, 1, 0, 0);
        MdtBodySetAngularVelocity(ball, 0, (MeReal)(1 / R), 0);
        const double momentum = MdtBodyGetMass(ball), whole = momentum + MdtBodyGetMass(board);
        run(6, step);
        assert_near(whole * speedOf(ball) / momentum, 1, 5e-6); /* the fast solver has floats */
        assert_near(whole * speedOf(board) / momentum, 1, 5e-6);
        assert_near(spinOf(ball, 1), 0, 1e-7);
    }
}

/* ---- without other friction, and bad input ----------------------------------------------------------------------- */

TEST(rolling_friction_acts_without_other_friction) {
    static const double R = .5, spin = 10, step = 1. / 60, r = .02;
    for (int i = 0; i < 2; i++) {
        begin(solvers[i], 0, r, 0, 0);
        MdtBodyID body = add(McdSphereCreate(u->frame, (MeReal)R), R);
        MdtBodySetLinearVelocity(body, 1, 0, 0);
        MdtBodySetAngularVelocity(body, 0, (MeReal)spin, 0);
        run(1, step);
        assert_near(spinOf(body, 1), spin - r * gravity / (.4 * R * R), 1e-5 * spin);
        assert_near(speedOf(body), 1, 1e-7);
    }
}

TEST(what_is_no_length_is_refused) {
    begin(MdtSolverExact, 1, .25, .5, 0);
    MdtContactParamsSetRollingFriction(surface, -1);
    assert_warned("MdtContactParamsSetRollingFriction");
    MdtContactParamsSetSpinningFriction(surface, (MeReal)NAN);
    assert_warned("MdtContactParamsSetSpinningFriction");
    ck_assert(MdtContactParamsGetRollingFriction(surface) == (MeReal).25);
    ck_assert(MdtContactParamsGetSpinningFriction(surface) == (MeReal).5);
}
