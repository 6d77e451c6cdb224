/* Pairs in batches, requests by table, and the choice of contacts. */
#include "terrain.h"

enum { PAIRS = 7 };
static McdFrameworkID frame;
static McdModelPair pairs[PAIRS], *array[PAIRS];
static MeMatrix4 tm[PAIRS], groundTM;
static McdModelPairContainer container;

/* Boxes on a plane, four contacts each; the third one is high above it. */
static void begin(void) {
    frame = frame_make(0, PAIRS + 1, 0, 1);
    McdPrimitivesRegisterTypes(frame);
    McdPrimitivesRegisterInteractions(frame);
    McdModelID plane = McdModelCreate(McdPlaneCreate(frame));
    McdGeometryID box = McdBoxCreate(frame, 1, 1, 1);
    MeMatrix4TMMakeIdentity(groundTM);
    McdModelSetTransformPtr(plane, groundTM);
    McdModelUpdate(plane);
    memset(pairs, 0, sizeof pairs);
    for (int i = 0; i < PAIRS; i++) {
        McdModelID m = McdModelCreate(box);
        MeMatrix4TMMakeIdentity(tm[i]);
        MeMatrix4TMSetPosition(tm[i], 2. * i, 0, i == 3 ? 9 : (MeReal).5);
        McdModelSetTransformPtr(m, tm[i]);
        McdModelUpdate(m);
        pairs[i].model1 = m;
        pairs[i].model2 = plane;
        array[i] = &pairs[i];
        McdHello(&pairs[i]);
    }
    const McdModelPairContainer c = {array, PAIRS, 0, 0, 0, 2, 2, PAIRS};
    container = c;
}

TEST(all_pairs_come_once) {
    McdIntersectResult result[PAIRS];
    McdContact contact[100];
    int results, contacts, calls = 0, met = 0;
    begin();
    McdBatchContext *context = McdBatchContextCreate(frame);
    ck_assert(!McdBatchIntersectEach(context, &container, result, &results, PAIRS, contact, &contacts, 200));
    for (int round = 0; round < 2; round++) { /* three results, or 45 contacts, at a time */
        MeBool isMore;
        met = calls = 0;
        do {
            isMore = McdBatchIntersectEach(context, &container, result, &results, 3, contact, &contacts, 45);
            int used = 0;
            for (int i = 0; i < results; i++, met++) {
                ck_assert_ptr_eq(result[i].pair, &pairs[met]);
                ck_assert_ptr_eq(result[i].contacts, contact + used);
                ck_assert_int_eq(result[i].contactCount, met == 3 ? 0 : 4);
                used += result[i].contactCount;
            }
            ck_assert_int_eq(contacts, used);
            calls++;
        } while (isMore && calls < 20);
        ck_assert_int_eq(met, PAIRS);
        ck_assert_int_eq(calls, 3);
    }
    McdBatchIntersectEach(context, &container, result, &results, 3, contact, &contacts, 100);
    McdBatchContextReset(context);
    McdBatchIntersectEach(context, &container, result, &results, 3, contact, &contacts, 100);
    ck_assert_ptr_eq(result[0].pair, &pairs[0]);
    McdBatchContextRelease(context);
    McdBatchContextDestroy(context);
    McdBatchContextDestroy(0);
    assert_silent();
    assert_none(McdBatchIntersectEach, 0, &container, result, &results, 3, contact, &contacts, 100);
    assert_none(McdBatchContextCreate, 0);
}

TEST(requests_by_table) {
    McdRequest few = {2, MEFALSE}, many = {50, MEFALSE}, got = {0, MEFALSE};
    begin();
    ck_assert_ptr_null(McduRequestTableGetRequestPtr(0, 0));
    assert_warned("McduRequestTableInit");
    ck_assert(!McduRequestTableInit(0, 0));
    assert_warned("idMaxCount");
    ck_assert(McduRequestTableInit(3, &many));
    McduRequestTableSetRequest(2, 1, &few);
    ck_assert_int_eq(McduRequestTableGetRequestPtr(1, 2)->contactMaxCount, 2);
    ck_assert_int_eq(McduRequestTableGetRequestPtr(2, 2)->contactMaxCount, 50);
    McdModelSetRequestID(pairs[0].model1, 1);
    McdModelSetRequestID(pairs[0].model2, 2);
    McduRequestTableGetRequest(&pairs[0], &got);
    ck_assert_int_eq(got.contactMaxCount, 2);
    McduHelloRequestTableCB(&pairs[0]);
    McdContact contact[10];
    McdIntersectResult result = {0};
    result.contacts = contact;
    result.contactMaxCount = 10;
    ck_assert(McdIntersect(&pairs[0], &result));
    ck_assert_int_eq(result.contactCount, 2);
    assert_silent();
    McduRequestTableSetRequest(3, 0, &few);
    assert_warned("request ids");
    ck_assert_int_eq(McduRequestTableGetRequestPtr(-1, 0)->contactMaxCount, 50);
    assert_warned("request ids");
    McduRequestTableSetRequest(1, 2, 0);
    ck_assert_int_eq(McduRequestTableGetRequestPtr(2, 1)->contactMaxCount, 50);
    McduRequestTableTerm();
    McduRequestTableTerm();
}

/* ---- the choice of contacts -------------------------------------------------------------------------------------- */

static void contactAt(McdContact *c, double x, double y, double separation, double nx) {
    memset(c, 0, sizeof *c);
    MeVector3Set(c->position, x, y, 0);
    MeVector3Set(c->normal, nx, 0, sqrt(1 - nx * nx));
    c->separation = (MeReal)separation;
}

static int has(const McdContact *c, int count, double x, double y) {
    for (int i = 0; i < count; i++)
        if (fabs((double)c[i].position[0] - x) + fabs((double)c[i].position[1] - y) < 1e-6)
            return 1;
    return 0;
}

TEST(corners_of_a_slab_stay) {
    McdContact all[101 * 3], few[101 * 3];
    for (int i = 0; i <= 100; i++)
        for (int j = 0; j < 3; j++)
            contactAt(&all[3 * i + j], .5 * i, .5 * j, -.01, 0);
    ck_assert_int_eq(McdContactSimplify(0, all, 303, few, 4, 0, 1), 4);
    ck_assert(has(few, 4, 0, 0) && has(few, 4, 50, 0) && has(few, 4, 0, 1) && has(few, 4, 50, 1));
    all[151].separation = (MeReal)-1; /* deep in the middle */
    ck_assert_int_eq(McdContactSimplify(0, all, 303, few, 4, 0, 1), 4);
    ck_assert(has(few, 4, 25, .5));
    ck_assert_int_eq(McdContactSimplify(0, all, 303, few, 10, 0, 1), 5); /* these support the others */
    ck_assert(has(few, 5, 25, .5) && has(few, 5, 50, 1));
    ck_assert_int_eq(McdContactSimplify(0, all, 303, all, 4, 0, 1), 4); /* in place */
    ck_assert(has(all, 4, 25, .5));
}

TEST(points_lines_and_normals) {
    McdContact all[20], few[20];
    const MeReal up[3] = {0, 0, 1};
    for (int i = 0; i < 10; i++)
        contactAt(&all[i], 1, 2, -.01, 0);
    ck_assert_int_eq(McdContactSimplify(0, all, 10, few, 4, 0, 1), 1);
    for (int i = 0; i < 10; i++)
        contactAt(&all[i], i, 2. * i, -.01, 0);
    ck_assert_int_eq(McdContactSimplify(0, all, 10, few, 4, 0, 1), 2);
    ck_assert(has(few, 2, 0, 0) && has(few, 2, 9, 18));
    for (int i = 10; i < 14; i++)
        contactAt(&all[i], 5, i, -.02, .6);
    const int count = McdContactSimplify(up, all, 14, few, 3, 1, 1);
    ck_assert_int_eq(count, 3); /* both ends of the faces' line, then one of the others */
    ck_assert(has(few, 3, 0, 0) && has(few, 3, 9, 18));
    assert_near(few[2].normal[0], .6, TOL(3e-7, 6e-16));
    ck_assert_int_eq(McdContactSimplify(up, all, 14, few, 3, 0, 1), 3);
    ck_assert(fabs((double)few[1].separation + .02) < 1e-6 || fabs((double)few[2].separation + .02) < 1e-6);
    ck_assert_int_eq(McdContactSimplify(up, all, 0, few, 3, 0, 1), 0);
    ck_assert_int_eq(McdContactSimplify(up, all, 3, few, 0, 0, 1), 0);
    assert_silent();
    assert_none(McdContactSimplify, up, 0, 3, few, 3, 0, 1);
}

/* m: how far a contact that was left out overlaps, where bodies tilt by (x, y) rad and a chosen one touches. */
static double leftOutDepth(const McdContact *all, int count, const McdContact *few, int fewCount, double x, double y) {
    double lowest[2] = {INFINITY, INFINITY};
    for (int i = 0; i < count + fewCount; i++) {
        const McdContact *c = i < count ? &all[i] : &few[i - count];
        const double s = (double)c->separation + x * (double)c->position[0] + y * (double)c->position[1];
        lowest[i >= count] = fmin(lowest[i >= count], s);
    }
    return lowest[1] - lowest[0];
}

/* Contacts over bumps, all of which touch if the bodies tilt by .1 rad. */
TEST(chosen_contacts_support_the_others) {
    enum { COUNT = 60 };
    McdContact all[COUNT], few[COUNT];
    for (int seed = 0; seed < 200; seed++) {
        for (int i = 0; i < COUNT; i++)
            contactAt(&all[i], sin(seed + 3.7 * i), sin(seed + 5.3 * i), .05 + .05 * sin(2 * seed + 7.9 * i), 0);
        const int count = McdContactSimplify(0, all, COUNT, few, COUNT, 0, 1);
        ck_assert_int_lt(count, COUNT / 2);
        for (int k = 0; k < 320; k++) {
            const double angle = k * (double)ME_PI / 32, tilt = .0175 * (k / 64);
            assert_near(leftOutDepth(all, COUNT, few, count, tilt * cos(angle), tilt * sin(angle)), 0, TOL(2e-5, 2e-5));
        }
    }
}

/* Four contacts with rough ground whose normals differ by a degree: along one of them the second is outside of the
 * triangle of the others, along another one within it. */
TEST(no_contact_is_chosen_twice) {
    static const double place[4][3] = {{-.580181386, .245767697, -.553434778},
                                       {.0124767198, .444516393, -.558699237},
                                       {.0528001579, .459326035, -.562798965},
                                       {-.194878981, .37316476, -.551470736}};
    static const double normal[2][3] = {{.139694378, -.263394525, .954520196}, {.145450817, -.280703644, .948709399}};
    McdContact all[4], few[4];
    for (int i = 0; i < 4; i++) {
        contactAt(&all[i], 0, 0, -.03 - .001 * i, 0);
        for (int k = 0; k < 3; k++) {
            all[i].position[k] = (MeReal)place[i][k];
            all[i].normal[k] = (MeReal)normal[i > 0][k];
        }
    }
    const int count = McdContactSimplify(0, all, 4, few, 4, 0, 1);
    ck_assert_int_ge(count, 2);
    for (int i = 1; i < count; i++) /* in the order in which they came */
        ck_assert(few[i].separation < few[i - 1].separation);
}
