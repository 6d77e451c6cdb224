/* Continuous collision: McdSafeTime against closed forms, and against small steps along random motions; distances. */
#include "Mcd.h"
#include "karma_test.h"

static McdFrameworkID frame;
static McdModelID model[2];
static McdModelPairID pair;
static MeMatrix4 place[2];
static MeVector3 velocity[2], spin[2];

static void setUp(void) {
    frame = McdInit(0, 2, 8, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMMakeIdentity(place[i]);
        MeVector3Set(velocity[i], 0, 0, 0);
        MeVector3Set(spin[i], 0, 0, 0);
        model[i] = 0;
    }
    pair = 0;
}

static void drop(void) {
    if (pair) {
        McdGoodbye(pair);
        McdModelPairDestroy(pair);
    }
    pair = 0;
    McdFrameworkDestroyAllModelsAndGeometries(frame);
}

static void tearDown(void) {
    drop();
    McdTerm(frame);
}
TEST_FIXTURE(setUp, tearDown)

static void makePair(McdGeometryID a, McdGeometryID b) {
    McdGeometryID g[2];
    g[0] = a;
    g[1] = b;
    for (int i = 0; i < 2; i++) {
        model[i] = McdModelCreate(g[i]);
        McdModelSetTransformPtr(model[i], place[i]);
        McdModelSetLinearVelocityPtr(model[i], velocity[i]);
        McdModelSetAngularVelocityPtr(model[i], spin[i]);
        McdModelUpdate(model[i]);
    }
    pair = McdModelPairCreate(model[0], model[1]);
    McdHello(pair);
}

static McdSafeTimeResult safeTime(double maxTime) {
    McdSafeTimeResult result;
    memset(&result, 0, sizeof result);
    ck_assert(McdSafeTime(pair, maxTime, &result));
    ck_assert_ptr_eq(result.pair, pair);
    return result;
}

/* ---- closed forms ------------------------------------------------------------------------------------------------ */

TEST(two_balls_meet_when_they_should) {
    makePair(McdSphereCreate(frame, 1), McdSphereCreate(frame, 0.5));
    MeMatrix4TMSetPosition(place[1], 6, 0, 0);
    MeVector3Set(velocity[0], 3, 0, 0);
    MeVector3Set(velocity[1], -6, 0, 0);
    McdSafeTimeResult r = safeTime(2);
    assert_near(r.time, .5, TOL(3e-7, 5e-16));
    ck_assert((double)r.time <= .5 + 1e-6);
    assert_vec3_near(r.normal, -1, 0, 0, TOL(5e-7, 9e-16));
    assert_vec3_near(r.position, 2.5, 0, 0, TOL(2e-6, 3e-15));
    ck_assert(safeTime(.25).time == (MeReal)0.25);
    MeVector3Set(velocity[1], 6, 0, 0); /* they part */
    r = safeTime(2);
    ck_assert(r.time == 2 && r.normal[0] == 0 && r.normal[1] == 0 && r.normal[2] == 0);
}

TEST(a_ball_falls_onto_a_plane) {
    makePair(McdSphereCreate(frame, 0.5), McdPlaneCreate(frame));
    MeMatrix4TMSetPosition(place[0], 0, 0, 10);
    MeVector3Set(velocity[0], 7, 0, -19);
    const McdSafeTimeResult r = safeTime(3);
    assert_near(r.time, .5, TOL(3e-7, 5e-16));
    assert_vec3_near(r.normal, 0, 0, 1, TOL(5e-7, 9e-16));
    assert_near(r.position[0], 3.5, TOL(2e-6, 4e-15));
}

static double uniform(double low, double high) {
    return low + (high - low) * rand() / RAND_MAX;
}

static void turnAnyWay(MeMatrix4 tm) {
    MeMatrix3 r;
    MeMatrix3FromEulerAngles(r, uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
    MeMatrix4TMSetRotation(tm, (const MeVector3 *)r);
}

static double along(const MeReal *v, const MeReal *n) {
    return (double)v[0] * (double)n[0] + (double)v[1] * (double)n[1] + (double)v[2] * (double)n[2];
}

/* Both lie and move any way, without turning: the box's lowest corner, half its sides' share of the normal below its
 * middle, meets the plane when their speeds along the normal have used up its height. */
TEST(a_box_falls_onto_a_plane_that_lies_any_way) {
    const double side[3] = {1, 2, 3};
    makePair(McdBoxCreate(frame, 1, 2, 3), McdPlaneCreate(frame));
    const MeReal *const n = place[1][2];
    int met = 0;
    srand(2);
    for (int i = 0; i < 300; i++) {
        McdDistanceResult d;
        for (int k = 0; k < 2; k++) {
            turnAnyWay(place[k]);
            MeVector3Set(velocity[k], uniform(-9, 9), uniform(-9, 9), uniform(-9, 9));
            MeMatrix4TMSetPosition(place[k], uniform(-4, 4), uniform(-4, 4), uniform(-4, 4));
        }
        double height = along(place[0][3], n) - along(place[1][3], n);
        for (int k = 0; k < 3; k++)
            height -= .5 * side[k] * fabs(along(place[0][k], n));
        for (int k = 0; k < 2; k++)
            McdModelUpdate(model[k]);
        ck_assert(McdDistance(pair, &d));
        assert_near(d.distance, height, TOL(5e-6, 1e-14));
        if (height < .1)
            continue;
        const double closing = along(velocity[1], n) - along(velocity[0], n);
        const double expected = closing * 1 > height ? height / closing : 1;
        const McdSafeTimeResult r = safeTime(1);
        assert_near(r.time, expected, TOL(5e-7, 1e-14));
        met += expected < 1;
    }
    ck_assert_int_gt(met, 20);
}

/* A rod of 2 m turns about its middle until its end meets a block: the corner (1, -.05) at distance r, angle -a, gets
 * to y = .7. */
TEST(a_turning_rod_meets_a_block) {
    makePair(McdBoxCreate(frame, 2, 0.1, 0.1), McdBoxCreate(frame, 4, 0.2, 1));
    MeMatrix4TMSetPosition(place[1], 0, 0.8, 0);
    MeVector3Set(spin[0], 0, 0, 60);
    const double expected = (asin(.7 / hypot(1, .05)) - atan(.05)) / 60;
    const McdSafeTimeResult r = safeTime(1. / 60);
    assert_near(r.time, expected, 1e-5);
    assert_vec3_near(r.normal, 0, -1, 0, TOL(5e-7, 2e-15));
}

TEST(models_that_touch_have_no_time) {
    makePair(McdSphereCreate(frame, 1), McdBoxCreate(frame, 1, 1, 1));
    MeVector3Set(velocity[0], 1, 0, 0);
    ck_assert(safeTime(1).time == 0);
}

/* Case: a ball of 5 cm at 50 to 1500 m/s against a wall of 2 cm, a frame of 1/60 s: aimed anywhere, it never is found
 * behind the wall, and the time is that of the closed form: when its lowest point is at the wall's face. */
TEST(no_ball_gets_through_a_wall) {
    makePair(McdSphereCreate(frame, 0.05), McdBoxCreate(frame, 20, 20, 0.02));
    srand(1);
    for (int i = 0; i < 1000; i++) {
        const double speed = 50 + 1450. * rand() / RAND_MAX, from = .1 + .4 * speed / 60 * rand() / RAND_MAX;
        const double slant = .6 * (2. * rand() / RAND_MAX - 1), around = 6.283 * rand() / RAND_MAX;
        MeMatrix4TMSetPosition(place[0], 0, 0, from);
        MeVector3Set(velocity[0], speed * sin(slant) * cos(around), speed * sin(slant) * sin(around),
                     -speed * cos(slant));
        const double expected = (from - .06) / (speed * cos(slant));
        const McdSafeTimeResult r = safeTime(1. / 60);
        assert_near((double)r.time * speed, expected * speed, TOL(9e-6, 3e-14)); /* m */
    }
}

TEST(bad_times_are_refused) {
    McdSafeTimeResult r;
    makePair(McdSphereCreate(frame, 1), McdSphereCreate(frame, 1));
    MeMatrix4TMSetPosition(place[0], 5, 0, 0);
    ck_assert(!McdSafeTime(pair, -1, &r) && r.time == 0);
    assert_warned("maxTime");
    ck_assert(!McdSafeTime(pair, NAN, &r) && r.time == 0);
    assert_warned("maxTime");
    place[0][3][0] = (MeReal)NAN;
    ck_assert(!McdSafeTime(pair, 1, &r));
    assert_warned("not finite");
}

/* ---- random motions ---------------------------------------------------------------------------------------------- */

static McdGeometryID randomGeometry(int kind) {
    const MeReal a = uniform(.2, 1), b = (MeReal)uniform(.2, 1), c = (MeReal)uniform(.2, 1);
    MeVector3 points[12];
    switch (kind) {
    case 0:
        return McdSphereCreate(frame, a / 2);
    case 1:
        return McdBoxCreate(frame, a, b, c);
    case 2:
        return McdCylinderCreate(frame, a / 2, b);
    case 3:
        return McdSphylCreate(frame, a / 3, b);
    case 4:
        return McdConeCreate(frame, a, b / 2);
    default:
        for (int i = 0; i < 12; i++)
            for (int k = 0; k < 3; k++)
                points[i][k] = (MeReal)uniform(-.5, .5);
        return McdConvexMeshCreateHull(frame, (const MeVector3 *)points, 12, 0);
    }
}

static void randomMotion(int i) {
    MeMatrix3 R;
    MeMatrix4 turned;
    for (int k = 0; k < 3; k++) {
        place[i][3][k] = (MeReal)uniform(-2, 2);
        velocity[i][k] = (MeReal)(-3 * (double)place[i][3][k] + uniform(-2, 2)); /* they all pass near the origin */
        spin[i][k] = (MeReal)uniform(-6, 6);
    }
    MeMatrix3MakeRotationX(R, uniform(-3, 3));
    MeMatrix4TMMakeFromRotationAndPosition(turned, R, 0, 0, 0);
    MeMatrix3MakeRotationZ(R, uniform(-3, 3));
    MeMatrix4 more;
    MeMatrix4TMMakeFromRotationAndPosition(more, R, place[i][3][0], place[i][3][1], place[i][3][2]);
    MeMatrix4TMCompound(place[i], (const MeVector4 *)turned, (const MeVector4 *)more);
}

/* The distance at a time of the motion. */
static double distanceAt(double time) {
    MeMatrix4 then[2];
    McdDistanceResult result;
    for (int i = 0; i < 2; i++) {
        MeMatrix4TMUpdateFromVelocities(then[i], 0, time, velocity[i], spin[i], (const MeVector4 *)place[i]);
        McdModelSetTransformPtr(model[i], then[i]);
        McdModelUpdate(model[i]);
    }
    ck_assert(McdDistance(pair, &result));
    for (int i = 0; i < 2; i++)
        McdModelSetTransformPtr(model[i], place[i]);
    return (double)result.distance;
}

/* Before the safe time they are apart, at it they touch or the time is up. */
TEST(the_safe_time_is_safe_and_not_too_early) {
    srand(2);
    int touches = 0;
    for (int n = 0; n < 300; n++) {
        makePair(randomGeometry(rand() % 6), randomGeometry(rand() % 6));
        do {
            randomMotion(0);
            randomMotion(1);
        } while (distanceAt(0) < .01);
        const double time = safeTime(1).time;
        for (int i = 1; i < 50; i++)
            ck_assert_msg(distanceAt(time * i / 50) > 0, "motion %d: they touch before %g", n, time);
        ck_assert_msg(time == 1 || distanceAt(time) < 5e-4, "motion %d: at %g they are %g apart", n, time,
                      distanceAt(time));
        touches += time < 1;
        drop();
    }
    ck_assert_int_gt(touches, 100);
    ck_assert_int_lt(touches, 290);
}

/* A path's box holds the model all the way. */
TEST(a_path_covers_turning) {
    srand(3);
    for (int n = 0; n < 100; n++) {
        MeVector3 low, high, l, h;
        makePair(randomGeometry(rand() % 6), randomGeometry(0));
        randomMotion(0);
        McdModelUpdatePath(model[0], 1);
        McdModelGetAABB(model[0], low, high);
        for (int i = 0; i <= 100; i++) {
            MeMatrix4 then;
            MeMatrix4TMUpdateFromVelocities(then, 0, (MeReal)i / 100, velocity[0], spin[0],
                                            (const MeVector4 *)place[0]);
            McdGeometryGetAABB(McdModelGetGeometry(model[0]), (const MeVector4 *)then, l, h);
            for (int k = 0; k < 3; k++)
                ck_assert((double)l[k] >= (double)low[k] - TOL(1e-5, 1e-12) &&
                          (double)h[k] <= (double)high[k] + TOL(1e-5, 1e-12));
        }
        drop();
    }
}

/* ---- distances --------------------------------------------------------------------------------------------------- */

TEST(distances_of_simple_pairs) {
    McdDistanceResult d;
    makePair(McdSphereCreate(frame, 1), McdBoxCreate(frame, 2, 2, 2));
    MeMatrix4TMSetPosition(place[0], 4, 0, 0);
    McdModelUpdate(model[0]);
    ck_assert(McdDistance(pair, &d));
    assert_near(d.distance, 2, TOL(1e-6, 2e-15));
    assert_vec3_near(d.position1, 3, 0, 0, TOL(2e-6, 3e-15));
    assert_near(d.position2[0], 1, TOL(5e-7, 9e-16));
    assert_vec3_near(d.normal, 1, 0, 0, TOL(5e-7, 9e-16));
    drop();
    makePair(McdPlaneCreate(frame), McdSphereCreate(frame, 1));
    MeMatrix4TMSetPosition(place[0], 0, 0, 0);
    MeMatrix4TMSetPosition(place[1], 1, 2, 0.5);
    ck_assert(McdDistance(pair, &d));
    assert_near(d.distance, -.5, TOL(3e-7, 5e-16));
    assert_vec3_near(d.position1, 1, 2, 0, TOL(1e-6, 2e-15));
    assert_vec3_near(d.position2, 1, 2, -.5, TOL(1e-6, 2e-15));
    assert_vec3_near(d.normal, 0, 0, -1, TOL(5e-7, 9e-16));
}
