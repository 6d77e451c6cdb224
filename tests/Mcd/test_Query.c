/* Overlaps, nearest models and casts in a space, against every model one by one: balls, whose answers are closed forms,
 * and boxes. */
#include "McdModel.h"
#include "McdPrimitives.h"
#include "McdQuery.h"
#include "karma_test.h"
#include "random_numbers.h"

enum { BALLS = 150, QUERIES = 1000 };

static McdFrameworkID frame;
static McdSpaceID space;
static McdGeometryID probe; /* a ball of radius .5 */
static const double probeRadius = .5;
static McdModelID ball[BALLS], ground;
static double radius[BALLS];
static MeMatrix4 tm[BALLS], groundTM, at;
static void setUp(void) {
    state = 5;
    frame = McdInit(0, BALLS + 10, 0, 1);
    McdPrimitivesRegisterTypes(frame);
    McdPrimitivesRegisterInteractions(frame);
    space = McdSpaceAxisSortCreate(frame, McdAllAxes, BALLS + 10, 5000);
    probe = McdSphereCreate(frame, probeRadius);
    MeMatrix4TMMakeIdentity(at);
    for (int i = 0; i < BALLS; i++) {
        radius[i] = (double)(MeReal)(.1 + uniform(0, 1));
        MeMatrix4TMMakeIdentity(tm[i]);
        MeMatrix4TMSetPosition(tm[i], uniform(0, 12), uniform(0, 12), (1.5 + uniform(0, 12)));
        ball[i] = McdModelCreate(McdSphereCreate(frame, radius[i]));
        McdModelSetTransformPtr(ball[i], tm[i]);
        McdSpaceInsertModel(space, ball[i]);
    }
    MeMatrix4TMMakeIdentity(groundTM);
    ground = McdModelCreate(McdPlaneCreate(frame));
    McdModelSetTransformPtr(ground, groundTM);
    McdSpaceInsertModel(space, ground);
    McdSpaceUpdateAll(space);
    McdSpaceEndChanges(space);
}

static void tearDown(void) {
    McdSpaceDestroy(space);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

static void placeProbe(double low) {
    MeMatrix4TMSetPosition(at, (uniform(0, 14) - 1), (uniform(0, 14) - 1), (low + uniform(0, 14)));
}

/* Between the probe, moved along by, and ball i, or the ground for i = BALLS. */
static double gapTo(int i, const double by[3]) {
    double sum = 0;
    if (i == BALLS)
        return (double)at[3][2] + by[2] - probeRadius;
    for (int k = 0; k < 3; k++)
        sum += pow((double)at[3][k] + by[k] - (double)tm[i][3][k], 2);
    return sqrt(sum) - radius[i] - probeRadius;
}

static int MEAPI noGround(McdModelID m, void *data) {
    ck_assert_ptr_eq(data, &state);
    return m != ground;
}

TEST(overlaps) {
    static const double still[3] = {0, 0, 0};
    McdModelID list[BALLS + 1], model[BALLS + 1];
    int total = 0, short_;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        int expected = 0;
        placeProbe(0);
        for (int i = 0; i <= BALLS; i++)
            if (gapTo(i, still) <= 0)
                model[expected++] = i < BALLS ? ball[i] : ground;
        const int count = McdSpaceOverlapGeometry(space, probe, at, 0, 0, list, BALLS + 1);
        ck_assert_int_eq(count, expected);
        for (int i = 0; i < count; i++)
            ck_assert_ptr_eq(list[i], model[i]);
        short_ = McdSpaceOverlapGeometry(space, probe, at, 0, 0, list, 1);
        ck_assert_int_eq(short_, expected > 0);
        ck_assert(!short_ || list[0] == model[0]);
        const int isOnGround = expected && model[expected - 1] == ground;
        ck_assert_int_eq(McdSpaceOverlapGeometry(space, probe, at, noGround, &state, list, BALLS + 1),
                         expected - isOnGround);
        total += expected;
    }
    ck_assert_int_gt(total, 200);
    for (int i = 0; i < BALLS; i++) { /* a model meets those that meet it */
        const int count = McdSpaceOverlapModel(space, ball[i], 0, 0, list, BALLS + 1);
        for (int k = 0; k < count; k++) {
            ck_assert_ptr_ne(list[k], ball[i]);
            ck_assert(list[k] == ground || McdSpaceOverlapModel(space, list[k], 0, 0, model, BALLS + 1) > 0);
        }
    }
    tearDown();
}

TEST(boxes) {
    McdModelID list[BALLS + 1];
    int total = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        MeVector3 low, high;
        int expected = 0;
        for (int k = 0; k < 3; k++) {
            low[k] = (MeReal)(uniform(0, 14) - 1);
            high[k] = low[k] + (MeReal)uniform(0, n % 3 ? 1 : 8);
        }
        for (int i = 0; i <= BALLS; i++) {
            MeVector3 min, max;
            McdModelGetAABB(i < BALLS ? ball[i] : ground, min, max);
            int isIn = 1;
            for (int k = 0; k < 3; k++)
                isIn = isIn && min[k] <= high[k] && low[k] <= max[k];
            if (isIn) {
                ck_assert_int_gt(McdSpaceOverlapBox(space, low, high, 0, 0, list, BALLS + 1), expected);
                ck_assert_ptr_eq(list[expected], i < BALLS ? ball[i] : ground);
            }
            expected += isIn;
        }
        ck_assert_int_eq(McdSpaceOverlapBox(space, low, high, 0, 0, list, BALLS + 1), expected);
        total += expected;
    }
    ck_assert_int_gt(total, 500);
    tearDown();
}

TEST(the_nearest) {
    static const double still[3] = {0, 0, 0};
    int found = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        McdClosestResult result;
        int nearest = 0;
        placeProbe(n % 10 ? 0 : 40);
        for (int i = 1; i <= BALLS; i++)
            if (gapTo(i, still) < gapTo(nearest, still))
                nearest = i;
        const double gap = gapTo(nearest, still), max = n % 7 ? 1e6 : .2;
        const int isFound = McdSpaceGetClosest(space, probe, at, max, 0, 0, &result);
        found += isFound;
        ck_assert_int_eq(isFound, gap <= max);
        if (!isFound)
            continue;
        ck_assert_ptr_eq(result.model, nearest < BALLS ? ball[nearest] : ground);
        assert_near(result.distance, gap, TOL(1e-5, 4e-14));
        double along = 0;
        for (int k = 0; k < 3; k++)
            along += ((double)result.position1[k] - (double)result.position2[k]) * (double)result.normal[k];
        assert_near(along, gap, TOL(2e-5, 2e-13));
    }
    ck_assert_int_gt(found, QUERIES / 2);
    tearDown();
}

/* The fraction at which the probe meets ball i, or the ground: the roots of a quadratic; above 1 if it does not. */
static double meets(int i, const MeVector3 by) {
    double a = 0, b = 0, c = -pow(radius[i < BALLS ? i : 0] + probeRadius, 2);
    if (i == BALLS) {
        const double height = (double)at[3][2] - probeRadius;
        return height < 0 ? 0 : by[2] < 0 ? height / -(double)by[2] : 2;
    }
    for (int k = 0; k < 3; k++) {
        const double from = (double)at[3][k] - (double)tm[i][3][k];
        a += (double)by[k] * (double)by[k];
        b += (double)by[k] * from;
        c += from * from;
    }
    if (c < 0)
        return 0;
    return b < 0 && b * b >= a * c ? (-b - sqrt(b * b - a * c)) / a : 2;
}

TEST(casts) {
    int hits = 0;
    setUp();
    for (int n = 0; n < QUERIES; n++) {
        McdCastResult result;
        MeVector3 by;
        double first = 2;
        placeProbe(0);
        for (int k = 0; k < 3; k++)
            by[k] = n % 4 == k ? 0 : (MeReal)(uniform(0, n % 2 ? 3 : 20) - (n % 2 ? 1.5 : 10));
        for (int i = 0; i <= BALLS; i++)
            first = fmin(first, meets(i, by));
        const int isHit = McdSpaceCastGeometry(space, probe, at, by, 0, 0, &result);
        ck_assert_int_eq(isHit, first <= 1);
        if (!isHit)
            continue;
        hits++;
        const double moved[3] = {first * (double)by[0], first * (double)by[1], first * (double)by[2]};
        assert_near(result.fraction, first, TOL(2e-5, 2e-6));
        int i = 0;
        while (i < BALLS && ball[i] != result.model)
            i++;
        assert_below(fmin(gapTo(i, moved), meets(i, by)), TOL(1e-5, 1e-6));
        double toward = 0;
        for (int k = 0; k < 3; k++)
            toward += (double)result.normal[k] * (double)by[k];
        ck_assert(first == 0 || toward < 0);
    }
    ck_assert_int_gt(hits, 100);
    tearDown();
}

TEST(boxes_are_cast_onto_faces) {
    McdCastResult result;
    MeMatrix4 start;
    const MeVector3 down = {0, 0, -10}, along = {5, 0, 0};
    setUp();
    const McdGeometryID box = McdBoxCreate(frame, 2, 2, 2);
    MeMatrix4TMMakeIdentity(start);
    MeMatrix4TMSetPosition(start, 50, 50, 6);
    ck_assert_int_eq(McdSpaceCastGeometry(space, box, start, down, 0, 0, &result), 1);
    ck_assert_ptr_eq(result.model, ground);
    assert_near(result.fraction, .5, TOL(3e-7, 5e-16));
    assert_vec3_near(result.normal, 0, 0, 1, TOL(5e-7, 9e-16));
    MeMatrix4TMSetPosition(start, 50, 50, 1); /* standing on it: it slides, and is held from below */
    ck_assert_int_eq(McdSpaceCastGeometry(space, box, start, along, 0, 0, &result), 0);
    ck_assert_int_eq(McdSpaceCastGeometry(space, box, start, down, 0, 0, &result), 1);
    ck_assert(result.fraction == 0);
    tearDown();
}

TEST(rays) {
    McdCastResult result;
    const MeVector3 from = {50, 50, 8}, down = {0, 0, -16};
    setUp();
    ck_assert_int_eq(McdSpaceCastRay(space, from, down, 0, 0, &result), 1);
    ck_assert_ptr_eq(result.model, ground);
    assert_near(result.fraction, .5, TOL(3e-7, 5e-16));
    assert_vec3_near(result.position, 50, 50, 0, TOL(1e-5, 5e-14));
    assert_vec3_near(result.normal, 0, 0, 1, TOL(5e-7, 9e-16));
    ck_assert_int_eq(McdSpaceCastRay(space, from, down, noGround, &state, &result), 0);
    tearDown();
}

TEST(bad_input) {
    McdModelID list[4];
    McdCastResult cast;
    McdClosestResult closest;
    MeMatrix4 wrong;
    const MeVector3 zero = {0, 0, 0}, nan = {0, 0, NAN};
    setUp();
    MeMatrix4TMMakeIdentity(wrong);
    wrong[1][1] = (MeReal)NAN;
    ck_assert_int_eq(McdSpaceOverlapGeometry(space, probe, wrong, 0, 0, list, 4), 0);
    assert_warned("finite");
    ck_assert_int_eq(McdSpaceOverlapGeometry(space, McdModelGetGeometry(ground), at, 0, 0, list, 4), 0);
    assert_warned("convex");
    assert_none(McdSpaceOverlapGeometry, space, 0, at, 0, 0, list, 4);
    ck_assert_int_eq(McdSpaceOverlapBox(space, zero, nan, 0, 0, list, 4), 0);
    assert_warned("corner");
    ck_assert_int_eq(McdSpaceOverlapBox(space, zero, zero, 0, 0, list, 0), 0);
    assert_warned("results");
    ck_assert_int_eq(McdSpaceGetClosest(space, probe, at, -1, 0, 0, &closest), 0);
    assert_warned("maxDistance");
    ck_assert_int_eq(McdSpaceCastGeometry(space, probe, at, nan, 0, 0, &cast), 0);
    assert_warned("displacement");
    ck_assert_int_eq(McdSpaceCastRay(space, nan, zero, 0, 0, &cast), 0);
    assert_warned("start");
    ck_assert_int_eq(McdSpaceCastGeometry(space, probe, at, zero, 0, 0, &cast), 1); /* it is in the ground */
    ck_assert(cast.fraction == 0);
    McdSpaceBeginChanges(space);
    assert_silent();
    ck_assert_int_eq(McdSpaceCastRay(space, zero, zero, 0, 0, &cast), 0);
    assert_warned("outside");
    tearDown();
}
