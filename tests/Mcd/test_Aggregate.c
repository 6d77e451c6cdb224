/* Aggregates: parts, nested and shared; mass; contacts of parts with everything; materials; limits. */
#include "terrain.h"

static McdFrameworkID frame;
static Probe probe, other;
static Terrain ground;

static void begin(int instances) {
    frame = frame_make(1, 20, instances, 1);
    McdPrimitivesRegisterTypes(frame);
    McdPrimitivesRegisterInteractions(frame);
    McdTriangleListRegisterType(frame);
    McdBoxTriangleListRegisterInteraction(frame);
    McdCylinderTriangleListRegisterInteraction(frame);
    McdAggregateRegisterType(frame);
    McdAggregateRegisterInteractions(frame);
}

static void place(MeMatrix4 tm, double ax, double ay, double az, double x, double y, double z) {
    MeMatrix4TMFromEulerAnglesAndPosition(tm, ax, ay, az, x, y, z);
}

/* The guide's stool. */
static MeMatrix4 stoolTM[5];
static McdAggregateID makeStool(void) {
    static const double at[5][3] = {{0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
    McdGeometryID seat = McdBoxCreate(frame, 2.2, 2.2, .1);
    McdGeometryID leg = McdCylinderCreate(frame, .1, 2);
    McdAggregateID a = McdAggregateCreate(frame, 5);
    for (int i = 0; i < 5; i++) {
        place(stoolTM[i], 0, 0, 0, at[i][0], at[i][1], at[i][2]);
        ck_assert_int_eq(McdAggregateAddElement(a, i ? leg : seat, stoolTM[i]), i);
    }
    ck_assert_int_eq(McdGeometryGetReferenceCount(leg), 4);
    return a;
}

TEST(the_stool_of_the_guide) {
    const double pi = 3.14159265358979, seat = 2.2 * 2.2 * .1, leg = pi * .01 * 2, all = seat + 4 * leg;
    const double middle = seat / all, up = 1 - middle;
    MeMatrix4 tm;
    MeMatrix3 inertia;
    MeReal volume, radius;
    MeVector3 centre, low, high;
    begin(5);
    McdAggregateID stool = makeStool();
    ck_assert_int_eq(McdGeometryGetMassProperties(stool, tm, inertia, &volume), 1);
    assert_near(volume, all, TOL(1e-6, 2e-15));
    assert_vec3_near(tm[3], 0, 0, middle, TOL(5e-7, 2e-15));
    const double x = seat * ((2.2 * 2.2 + .01) / 12 + up * up) + 4 * leg * ((3 * .01 + 4) / 12 + 1 + middle * middle);
    const double z = seat * (2 * 2.2 * 2.2) / 12 + 4 * leg * (.01 / 2 + 2);
    assert_near(inertia[0][0], x, TOL(1e-6, 4e-15));
    assert_near(inertia[1][1], x, TOL(1e-6, 4e-15));
    assert_near(inertia[2][2], z, TOL(1e-6, 7e-15));
    assert_near(inertia[0][1], 0, TOL(1e-7, 1e-15));
    McdGeometryGetBSphere(stool, centre, &radius);
    assert_near(radius, sqrt(1.1 * 1.1 * 2 + 1.025 * 1.025), TOL(2e-6, 4e-14)); /* around the box */

    probe_init(&probe, stool, McdPlaneCreate(frame));
    McdGeometryInstanceID whole = McdModelGetGeometryInstance(probe.model);
    ck_assert_int_eq(McdGeometryInstanceGetChildCount(whole), 5);
    McdGeometryInstanceID leg2 = McdGeometryInstanceGetChild(whole, 2);
    MeMatrix4 legTM;
    McdGeometryInstanceSetTransformPtr(leg2, legTM);
    McdModelSetMaterial(probe.model, 3);
    McdGeometryInstanceSetMaterial(leg2, 7);
    place(probe.tm, 0, 0, .5, 2, 3, .999);
    ck_assert_int_eq(probe_test(&probe), 16);
    assert_near(legTM[3][0], 2 + cos(.5) + sin(.5), TOL(1e-6, 3e-15));
    int legs[5] = {0, 0, 0, 0, 0};
    for (int i = 0; i < 16; i++) {
        const McdContact *c = &probe.contact[i];
        assert_near(c->separation, -.001, TOL(2e-7, 6e-16));
        assert_vec3_near(c->normal, 0, 0, 1, TOL(5e-7, 9e-16));
        ck_assert_ptr_eq(McdGeometryInstanceGetParent(c->instance1), whole);
        ck_assert_ptr_eq(McdGeometryInstanceGetModel(c->instance1), probe.model);
        ck_assert_ptr_eq(c->instance2, McdModelGetGeometryInstance(probe.ground));
        ck_assert_uint_eq(McdGeometryInstanceGetMaterial(c->instance1), c->instance1 == leg2 ? 7 : 3);
        for (int k = 1; k < 5; k++)
            legs[k] += c->instance1 == McdGeometryInstanceGetChild(whole, k);
        for (int k = 0; k < i; k++)
            ck_assert_uint_ne(probe.contact[k].feature, c->feature);
    }
    for (int k = 1; k < 5; k++)
        ck_assert_int_eq(legs[k], 4);
    McdModelGetAABB(probe.model, low, high);
    assert_near(low[2], -.001, TOL(2e-7, 3e-14));
    assert_near(high[2], 2.049, TOL(3e-6, 2e-14));
}

TEST(few_contacts_of_many_are_spread_out) {
    begin(5);
    probe_init(&probe, makeStool(), McdPlaneCreate(frame));
    McdRequest four = {4, MEFALSE};
    McdModelPairSetRequestPtr(probe.pair, &four);
    ck_assert_int_eq(probe_at(&probe, 0, 0, .999), 4);
    for (int i = 0; i < 4; i++) /* one on each leg, on its outer half */
        for (int k = 0; k < i; k++) {
            const MeReal *a = probe.contact[i].position, *b = probe.contact[k].position;
            ck_assert_ptr_ne(probe.contact[i].instance1, probe.contact[k].instance1);
            ck_assert((double)MeVector3Distance(a, b) > 1.9);
        }
}

TEST(it_stands_on_triangles_and_is_hit_by_lines) {
    MeReal from[3] = {.2, .1, 5}, to[3] = {.2, .1, -5};
    McdLineSegIntersectResult hit;
    begin(5);
    memset(&ground, 0, sizeof ground);
    terrain_grid(&ground, 30, .31, 0, kMcdTriangleStandard);
    probe_init(&probe, makeStool(), terrain_list(frame, &ground));
    ck_assert_int_eq(probe_at(&probe, .1, .2, .999), 16);
    for (int i = 0; i < 16; i++) {
        assert_near(probe.contact[i].separation, -.001, TOL(2e-7, 9e-18));
        ck_assert(terrain_owns(&ground, probe.contact[i].element2.ptr));
    }
    ck_assert_uint_eq(McdLineSegIntersect(probe.model, from, to, &hit), 1);
    assert_near(hit.distance, 5 - 2.049, TOL(1e-6, 5e-15));
    ck_assert_ptr_eq(hit.model, probe.model);
    from[0] = to[0] = (MeReal)1.1; /* through a leg, and the seat above it */
    from[1] = to[1] = (MeReal)1.2;
    ck_assert_uint_eq(McdLineSegIntersect(probe.model, to, from, &hit), 1);
    assert_near(hit.distance, 5 - .001, TOL(3e-6, 5e-15));
    from[0] = to[0] = 3;
    ck_assert_uint_eq(McdLineSegIntersect(probe.model, from, to, &hit), 0);
}

/* ---- nested and flat --------------------------------------------------------------------------------------------- */

static MeMatrix4 inner[3], outer[2];

/* Two of a group of three parts, one turned; and the same six parts, less one, without groups. */
static void makeNestedAndFlat(McdAggregateID *nested, McdAggregateID *flat) {
    McdGeometryID part[3] = {McdBoxCreate(frame, 1, .5, .3), McdSphereCreate(frame, .4), McdSphylCreate(frame, .2, .7)};
    McdAggregateID group = McdAggregateCreate(frame, 3), all = McdAggregateCreate(frame, 6);
    static MeMatrix4 both[6];
    place(inner[0], .3, .2, .1, .5, 0, 0);
    place(inner[1], 0, 0, 0, -.5, .2, .1);
    place(inner[2], 1, 2, 3, 0, -.6, .3);
    place(outer[0], .5, -.2, 1.1, 1, .2, 0);
    place(outer[1], 2, .4, .3, -1, -.3, .4);
    *nested = McdAggregateCreate(frame, 2);
    for (int i = 0; i < 3; i++)
        McdAggregateAddElement(group, part[i], inner[i]);
    for (int o = 0; o < 2; o++) {
        McdAggregateAddElement(*nested, group, outer[o]);
        for (int i = 0; i < 3; i++) {
            MeMatrix4TMCompound(both[3 * o + i], (const MeVector4 *)inner[i], (const MeVector4 *)outer[o]);
            McdAggregateAddElement(all, part[i], both[3 * o + i]);
        }
    }
    *flat = all;
}

TEST(nested_is_flat) {
    McdAggregateID nested, flat;
    MeMatrix4 tm[2];
    MeMatrix3 inertia[2];
    MeReal volume[2];
    int touching = 0;
    begin(100);
    makeNestedAndFlat(&nested, &flat);
    ck_assert_int_eq(McdGeometryGetMassProperties(nested, tm[0], inertia[0], &volume[0]), 1);
    ck_assert_int_eq(McdGeometryGetMassProperties(flat, tm[1], inertia[1], &volume[1]), 1);
    assert_near(volume[0], volume[1], TOL(1e-6, 1e-15));
    for (int i = 0; i < 3; i++) {
        assert_near(tm[0][3][i], tm[1][3][i], TOL(4e-7, 2e-15));
        for (int k = 0; k < 3; k++)
            assert_near(inertia[0][i][k], inertia[1][i][k], TOL(2e-6, 5e-15));
    }
    McdAggregateID target = makeStool();
    probe_init(&probe, nested, target);
    probe_init(&other, flat, target);
    for (int i = 0; i < 60; i++) {
        MeVector3 low[2], high[2], far[2];
        MeReal up[3] = {.3, -.5, 1};
        place(probe.tm, .3 * i, .5 * i, .7 * i, .03 * i, -.02 * i, 1.6 - .02 * i);
        memcpy(other.tm, probe.tm, sizeof other.tm);
        ck_assert_int_eq(probe_test(&probe), probe_test(&other));
        touching += probe.result.contactCount > 0;
        for (int k = 0; k < probe.result.contactCount; k++) {
            const McdContact *a = &probe.contact[k], *b = &other.contact[k];
            if (probe.result.contactCount < 20)
                for (int c = 0; c < 3; c++)
                    assert_near(a->normal[c], b->normal[c], TOL(6e-5, 9e-11));
            ck_assert_ptr_eq(McdGeometryInstanceGetModel(a->instance1), probe.model);
            ck_assert_ptr_eq(McdGeometryInstanceGetParent(McdGeometryInstanceGetParent(a->instance1)),
                             McdModelGetGeometryInstance(probe.model));
        }
        McdModelGetAABB(probe.model, low[0], high[0]);
        McdModelGetAABB(other.model, low[1], high[1]);
        McdGeometryMaximumPoint(nested, (const MeVector4 *)probe.tm, up, far[0]);
        McdGeometryInstanceMaximumPoint(McdModelGetGeometryInstance(other.model), up, far[1]);
        for (int c = 0; c < 3; c++) {
            assert_near(low[0][c], low[1][c], TOL(2e-6, 5e-15));
            assert_near(high[0][c], high[1][c], TOL(2e-6, 5e-15));
            assert_near(far[0][c], far[1][c], TOL(3e-6, 9e-15));
        }
        McdGeometryGetAABB(nested, (const MeVector4 *)probe.tm, low[1], high[1]);
        assert_near(low[0][2], low[1][2], TOL(8e-7, 2e-15));
    }
    ck_assert_int_gt(touching, 20);
}

TEST(two_aggregates_either_way_round) {
    McdAggregateID nested, flat;
    begin(100);
    makeNestedAndFlat(&nested, &flat);
    probe_init(&probe, nested, makeStool());
    const int count = probe_at(&probe, 0, 0, 1.2);
    ck_assert_int_gt(count, 0);
    McdContact contacts[TERRAIN_CONTACTS];
    McdIntersectResult result = {0};
    result.contacts = contacts;
    result.contactMaxCount = TERRAIN_CONTACTS;
    McdModelPairID turned = McdModelPairCreate(probe.ground, probe.model);
    ck_assert(McdIntersect(turned, &result));
    ck_assert_int_eq(result.contactCount, count);
    double sum[2][3] = {{0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            sum[0][k] += (double)probe.contact[i].normal[k];
            sum[1][k] -= (double)contacts[i].normal[k];
        }
    assert_vec3_near(sum[0], sum[1][0], sum[1][1], sum[1][2], TOL(2e-6, 3e-15));
    McdModelPairDestroy(turned);
}

TEST(a_moving_one_is_safe_until_a_part_touches) {
    McdSafeTimeResult result;
    MeVector3 velocity = {0, 0, -2};
    begin(5);
    probe_init(&probe, makeStool(), McdPlaneCreate(frame));
    place(probe.tm, 0, 0, 0, 0, 0, 4);
    McdModelSetLinearVelocityPtr(probe.model, velocity);
    McdModelUpdate(probe.model);
    McdModelUpdate(probe.ground);
    ck_assert(McdSafeTime(probe.pair, 5, &result));
    assert_near(result.time, 1.5, TOL(8e-7, 2e-15)); /* the legs' ends are 3 m up */
    assert_near(result.normal[2], 1, TOL(5e-7, 9e-16));
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

TEST(references_cycles_and_limits) {
    MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    begin(7);
    ck_assert_ptr_null(McdAggregateCreate(frame, 0));
    assert_warned("maxChildren");
    McdGeometryID ball = McdSphereCreate(frame, 1);
    McdAggregateID a = McdAggregateCreate(frame, 2), b = McdAggregateCreate(frame, 2), c = McdAggregateCreate(frame, 2);
    ck_assert_int_eq(McdAggregateAddElement(a, b, tm), 0);
    ck_assert_int_eq(McdAggregateAddElement(b, c, tm), 0);
    ck_assert_int_eq(McdAggregateAddElement(c, ball, 0), 0);
    ck_assert_int_eq(McdAggregateAddElement(c, a, tm), -1);
    assert_warned("contain itself");
    ck_assert_int_eq(McdAggregateAddElement(c, c, tm), -1);
    assert_warned("contain itself");
    ck_assert_int_eq(McdAggregateAddElement(c, 0, tm), -1);
    assert_warned("McdAggregateAddElement");
    ck_assert_int_eq(McdAggregateAddElement(c, ball, tm), 1);
    ck_assert_int_eq(McdAggregateAddElement(c, ball, tm), -1);
    assert_warned("maxChildren");
    ck_assert_int_eq(McdAggregateAddElement(ball, c, tm), -1);
    assert_warned("Sphere");
    ck_assert_int_eq(McdAggregateGetElementCount(c), 2);
    ck_assert_int_eq(McdAggregateGetElementCountMax(c), 2);
    ck_assert_ptr_eq(McdAggregateGetElementGeometry(b, 0), c);
    const MeMatrix4Ptr copy = McdAggregateGetElementTransformPtr(b, 0);
    ck_assert_ptr_ne(copy, tm);
    ck_assert_int_eq(memcmp(copy, tm, sizeof(MeMatrix4)), 0);
    ck_assert(McdAggregateGetElementTransformPtr(c, 0)[2][2] == 1 &&
              McdAggregateGetElementTransformPtr(c, 0)[3][0] == 0);
    assert_silent();
    ck_assert_ptr_null(McdAggregateGetElementGeometry(b, 1));
    assert_warned("no element 1");
    assert_refused(McdAggregateRemoveElement, c, 1);
    McdGeometryDestroy(ball);
    assert_warned("still use");

    McdModelID first = McdModelCreate(a); /* b, c, ball, ball */
    ck_assert_ptr_nonnull(first);
    ck_assert_ptr_null(McdModelCreate(a));
    assert_warned("instanceCount");
    McdModelDestroy(first);
    McdModelID second = McdModelCreate(a);
    ck_assert_ptr_nonnull(second);
    McdModelDestroy(second);

    McdAggregateRemoveElement(a, 0);
    ck_assert_int_eq(McdGeometryGetReferenceCount(b), 0);
    McdGeometryDestroy(b);
    McdAggregateRemoveElement(c, 0);
    ck_assert_int_eq(McdAggregateGetElementCount(c), 1);
    ck_assert_int_eq(memcmp(McdAggregateGetElementTransformPtr(c, 0), tm, sizeof(MeMatrix4)),
                     0); /* that of element 1 */
    McdGeometryDestroy(c);
    McdGeometryDestroy(ball);
    ck_assert_int_eq(McdFrameworkGetGeometryCount(frame), 1);
}

TEST(an_empty_one_is_nowhere) {
    MeMatrix4 tm;
    MeMatrix3 inertia;
    MeReal volume;
    MeVector3 low, high;
    begin(2);
    McdAggregateID empty = McdAggregateCreate(frame, 1);
    probe_init(&probe, empty, McdPlaneCreate(frame));
    ck_assert_int_eq(probe_at(&probe, 1, 2, -3), 0);
    McdModelGetAABB(probe.model, low, high);
    assert_vec3_near(low, 1, 2, -3, TOL(2e-6, 3e-15));
    ck_assert_int_eq(McdGeometryGetMassProperties(empty, tm, inertia, &volume), 0);
    static MeMatrix4 at;
    MeMatrix4TMMakeIdentity(at);
    McdAggregateAddElement(empty, McdSphereCreate(frame, 1), at); /* for models made later */
    ck_assert_int_eq(probe_at(&probe, 1, 2, -3), 0);
    probe_init(&other, empty, McdPlaneCreate(frame));
    ck_assert_int_gt(probe_at(&other, 0, 0, .9), 0);
}

/* -1 stands for the material of the whole, which has one of its own always. */
TEST(parts_inherit_materials) {
    begin(5);
    const McdModelID model = McdModelCreate(makeStool());
    const McdGeometryInstanceID whole = McdModelGetGeometryInstance(model);
    const McdGeometryInstanceID part = McdGeometryInstanceGetChild(whole, 1);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(part), 0);
    McdGeometryInstanceSetMaterial(whole, 5);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(part), 5);
    McdGeometryInstanceSetMaterial(part, 0);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(part), 0);
    McdGeometryInstanceSetMaterial(part, -1);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(part), 5);
    McdGeometryInstanceSetMaterial(whole, 0);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(part), 0);
    assert_silent();
    assert_refused(McdGeometryInstanceSetMaterial, part, -2);
    assert_refused(McdGeometryInstanceSetMaterial, whole, -1);
    ck_assert_uint_eq(McdGeometryInstanceGetMaterial(whole), 0);
}
