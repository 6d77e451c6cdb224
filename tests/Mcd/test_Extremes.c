/* Queries with any numbers, huge, tiny, infinite and none, against every geometry kind, alone and as parts of
 * aggregates: no crash, no NaN in a result, and an answer or a message. */
#include "shapes.h"
#include <float.h>

#ifdef TEST_IS_SLOW
enum { ROUNDS = 60 };
#else
enum { ROUNDS = 600 };
#endif
enum { LIST = SOLIDS, FIELD, PLANE, KINDS, FIELD_SIDE = 5, CONTACTS = 8 };

static MeReal height[FIELD_SIDE * FIELD_SIDE];
static MeVector3 corner[3] = {{-1, -1, 0}, {1, -1, .1}, {0, 1, 0}};

static int MEAPI listTriangles(McdModelPair *p, McdUserTriangle *t, MeVector3 pos, MeReal radius, int max) {
    (void)p, (void)max;
    ck_assert(!isnan(pos[0]) && !isnan(pos[1]) && !isnan(pos[2]) && !isnan(radius));
    memset(t, 0, sizeof *t);
    for (int i = 0; i < 3; i++)
        t->vertices[i] = &corner[i];
    t->flags = kMcdTriangleStandard;
    return 1;
}

typedef struct Place {
    McdFrameworkID frame;
    McdSpaceID space;
    McdModelID alone[KINDS], part[KINDS];
    MeMatrix4 tm[2][KINDS];
} Place;

static McdGeometryID geometryOf(McdFrameworkID f, int kind) {
    MeVector3 low = {-2, -2, -2}, high = {2, 2, 2};
    if (kind == LIST)
        return McdTriangleListCreate(f, low, high, 4, listTriangles);
    if (kind == FIELD)
        return McdRGHeightFieldCreate(f, height, FIELD_SIDE, FIELD_SIDE, .5, .5, -1, -1);
    return kind == PLANE ? McdPlaneCreate(f) : solid(f, kind, 1);
}

/* As a part of a part, turned and moved. */
static McdGeometryID wrapped(McdFrameworkID f, McdGeometryID g, MeReal far) {
    McdGeometryID outer = McdAggregateCreate(f, 1);
    for (int level = 0; level < 2; level++) {
        MeMatrix4 tm;
        randomPlace(tm, .1);
        tm[3][level] += far;
        McdAggregateAddElement(outer, g, tm);
        g = outer;
        outer = level ? 0 : McdAggregateCreate(f, 1);
    }
    return g;
}

static McdModelID put(Place *p, McdGeometryID g, MeMatrix4 tm, double spread) {
    const McdModelID m = McdModelCreate(g);
    randomPlace(tm, spread);
    McdModelSetTransformPtr(m, tm);
    McdModelUpdate(m);
    McdSpaceInsertModel(p->space, m);
    return m;
}

static void setUp(Place *p, MeReal far) {
    p->frame = McdInit(0, 100, 100, 1);
    McdAllRegisterTypes(p->frame);
    McdAllRegisterInteractions(p->frame);
    McdTriangleListLineSegmentRegisterInteraction(p->frame);
    p->space = McdSpaceAxisSortCreate(p->frame, McdAllAxes, 100, 1000);
    for (int i = 0; i < FIELD_SIDE * FIELD_SIDE; i++)
        height[i] = (MeReal)uniform(-.2, .2);
    for (int kind = 0; kind < KINDS; kind++) {
        const McdGeometryID g = geometryOf(p->frame, kind);
        p->alone[kind] = put(p, g, p->tm[0][kind], 1);
        p->part[kind] = put(p, wrapped(p->frame, g, far), p->tm[1][kind], 1);
    }
    McdSpaceUpdateAll(p->space);
}

static void tearDown(Place *p) {
    McdSpaceDestroy(p->space);
    McdFrameworkDestroyAllModelsAndGeometries(p->frame);
    McdTerm(p->frame);
}

/* ---- any number -------------------------------------------------------------------------------------------------- */

static MeReal anyNumber(void) {
    const MeReal sign = uniform(0, 1) < .5 ? -1 : 1;
    switch ((int)uniform(0, 12)) {
    case 0:
        return 0;
    case 1:
        return sign * (MeReal)FLT_MIN / 4; /* no normal number in single precision */
    case 2:
        return sign * (MeReal)1e-30;
    case 3:
        return sign * (MeReal)1e15;
    case 4:
        return sign * (MeReal)1e30;
    case 5:
        return sign * (MeReal)FLT_MAX;
    case 6:
        return sign * MEINFINITY;
    case 7:
        return uniform(0, 1) < .2 ? (MeReal)NAN : sign;
    case 8:
        return uniform(0, 1) < .2 ? sign * (MeReal)INFINITY : sign;
    case 9: /* of any size */
        return sign * (MeReal)pow(10, uniform(-37, 37));
    default:
        return (MeReal)uniform(-2, 2);
    }
}

static void anyVector(MeVector3 v) {
    for (int k = 0; k < 3; k++)
        v[k] = anyNumber();
}

/* A turn, at any place; or a transform of any numbers at all. */
static void anyPlace(MeMatrix4 tm) {
    randomPlace(tm, 1);
    if (uniform(0, 1) < .7)
        anyVector(tm[3]);
    for (int row = 0; row < 3 && uniform(0, 1) < .1; row++)
        anyVector(tm[row]);
}

static void checkVector(const char *what, const MeReal *v) {
    ck_assert_msg(isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]), "%s: %g %g %g", what, v[0], v[1], v[2]);
}

static void checkNumber(const char *what, MeReal x) {
    ck_assert_msg(isfinite(x), "%s: %g", what, x);
}

/* ---- queries ----------------------------------------------------------------------------------------------------- */

static void checkHit(const McdLineSegIntersectResult *hit) {
    checkVector("hit", hit->position);
    checkVector("hit's normal", hit->normal);
    checkNumber("hit's distance", hit->distance);
}

static void askSegments(Place *p) {
    McdLineSegIntersectResult hit[4];
    McdCastResult cast;
    MeVector3 from, to;
    anyVector(from);
    anyVector(to);
    for (int kind = 0; kind < KINDS; kind++) {
        if (McdLineSegIntersect(p->alone[kind], from, to, hit))
            checkHit(hit);
        if (McdLineSegIntersect(p->part[kind], from, to, hit))
            checkHit(hit);
    }
    const int count = McdSpaceGetLineSegIntersections(p->space, from, to, hit, 4);
    for (int i = 0; i < count; i++)
        checkHit(&hit[i]);
    if (McdSpaceGetLineSegFirstIntersection(p->space, from, to, hit))
        checkHit(hit);
    if (McdSpaceCastRay(p->space, from, to, 0, 0, &cast)) {
        checkVector("ray", cast.position);
        checkNumber("ray's fraction", cast.fraction);
    }
}

static void askGeometry(Place *p, McdGeometryID g) {
    McdModelID list[4];
    McdClosestResult closest;
    McdCastResult cast;
    MeMatrix4 tm;
    MeVector3 by;
    anyPlace(tm);
    anyVector(by);
    McdSpaceOverlapBox(p->space, tm[3], by, 0, 0, list, 4);
    McdSpaceOverlapGeometry(p->space, g, (const MeVector4 *)tm, 0, 0, list, 4);
    if (McdSpaceGetClosest(p->space, g, (const MeVector4 *)tm, anyNumber(), 0, 0, &closest)) {
        checkVector("closest", closest.position1);
        checkVector("closest", closest.position2);
        checkVector("closest normal", closest.normal);
        checkNumber("closest distance", closest.distance);
    }
    if (McdSpaceCastGeometry(p->space, g, (const MeVector4 *)tm, by, 0, 0, &cast)) {
        checkVector("cast", cast.position);
        checkVector("cast's normal", cast.normal);
        checkNumber("cast's fraction", cast.fraction);
    }
}

static void askGeometries(Place *p) {
    for (int kind = 0; kind < SOLIDS; kind++)
        askGeometry(p, McdModelGetGeometry(p->alone[kind]));
}

/* A model anywhere, at any speed, and each of the others. */
static void meet(McdModelID a, McdModelID b) {
    McdContact contact[CONTACTS];
    McdIntersectResult result;
    McdSafeTimeResult time;
    McdDistanceResult distance;
    McdModelPair pair;
    memset(&pair, 0, sizeof pair);
    memset(&result, 0, sizeof result);
    pair.model1 = a;
    pair.model2 = b;
    result.contacts = contact;
    result.contactMaxCount = CONTACTS;
    if ((McdIntersect)(&pair, &result))
        for (int i = 0; i < result.contactCount; i++) {
            checkVector("contact", contact[i].position);
            assert_near(MeVector3Magnitude(contact[i].normal), 1, 1e-3);
            checkNumber("separation", contact[i].separation);
        }
    if (McdIntersectAt(&pair, &result, anyNumber()))
        for (int i = 0; i < result.contactCount; i++)
            checkVector("contact then", contact[i].position);
    if (McdSafeTime(&pair, uniform(0, 1), &time))
        checkNumber("time", time.time);
    if (McdDistance(&pair, &distance)) {
        checkVector("position 1", distance.position1);
        checkVector("position 2", distance.position2);
        checkNumber("distance", distance.distance);
    }
}

static void askPairs(Place *p, int kind) {
    MeMatrix4 tm;
    MeVector3 linear, angular;
    const McdModelID m = McdModelCreate(McdModelGetGeometry(uniform(0, 1) < .5 ? p->alone[kind] : p->part[kind]));
    anyPlace(tm);
    anyVector(linear);
    anyVector(angular);
    McdModelSetTransformPtr(m, tm);
    McdModelSetLinearVelocityPtr(m, linear);
    McdModelSetAngularVelocityPtr(m, angular);
    McdModelUpdate(m);
    for (int other = 0; other < KINDS; other++) {
        meet(m, p->alone[other]);
        meet(p->part[other], m);
    }
    McdModelUpdatePath(m, anyNumber());
    McdModelDestroy(m);
}

static void askHeight(Place *p) {
    MeReal z;
    MeVector3 n;
    if (McdRGHeightFieldGetHeightAt(McdModelGetGeometry(p->alone[FIELD]), anyNumber(), anyNumber(), &z, n)) {
        checkNumber("height", z);
        checkVector("height's normal", n);
    }
}

static void askEverything(Place *p) {
    for (int round = 0; round < ROUNDS; round++) {
        askSegments(p);
        askHeight(p);
        if (round % 4 == 0)
            askGeometries(p);
        if (round % 4 == 1)
            askPairs(p, round / 4 % KINDS);
        ck_assert_msg(caught.fatal == 0, "%d fatal errors: %s", caught.fatal, caught.last);
    }
    messages_forget();
}

TEST(any_numbers_against_any_geometry) {
    Place p;
    setUp(&p, 0);
    askEverything(&p);
    tearDown(&p);
}

/* Where the sum of the transforms is no number. */
TEST(any_numbers_against_parts_out_of_reach) {
    Place p;
    setUp(&p, MEINFINITY);
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 3; k++)
            p.tm[1][kind][3][k] = MEINFINITY;
    for (int kind = 0; kind < KINDS; kind++)
        McdModelUpdate(p.part[kind]);
    askEverything(&p);
    tearDown(&p);
}

/* Flat transforms, of which shapes have no sides, touch nothing; a scale that is left in one is no reason to fail. */
TEST(flat_transforms_touch_nothing_and_are_told) {
    McdContact contact[CONTACTS];
    MeMatrix4 flat = {{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 0, 1}}, tm;
    McdFrameworkID f = McdInit(0, 10, 10, 1);
    McdPrimitivesRegisterTypes(f);
    McdPrimitivesRegisterInteractions(f);
    MeMatrix4TMMakeIdentity(tm);
    for (int kind = 0; kind < PLANE + 1; kind++) {
        McdGeometryID g = kind == LIST || kind == FIELD ? 0 : geometryOf(f, kind);
        if (!g) /* not of the primitives */
            continue;
        caught.warnings = 0;
        McdGeometryID box = McdBoxCreate(f, 1, 1, 1);
        McdModelID m = McdModelCreate(g), other = McdModelCreate(box);
        McdModelSetTransformPtr(m, flat);
        McdModelSetTransformPtr(other, tm);
        McdModelPairID pair = McdModelPairCreate(other, m);
        McdIntersectResult result = {.contacts = contact, .contactMaxCount = CONTACTS};
        McdDistanceResult d;
        McdHello(pair);
        McdIntersect(pair, &result);
        ck_assert_int_eq(result.contactCount, 0);
        assert_warned("flat");
        ck_assert(!McdDistance(pair, &d));
        assert_warned("flat");
        McdGoodbye(pair);
        McdModelPairDestroy(pair);
        McdModelDestroy(m);
        McdModelDestroy(other);
        McdGeometryDestroy(g);
        McdGeometryDestroy(box);
    }
    McdTerm(f);
}

/* The functions of one pair of types, by a program's own result. */
TEST(a_result_without_room_is_refused) {
    MeMatrix4 tm;
    McdFrameworkID f = McdInit(0, 10, 10, 1);
    McdPrimitivesRegisterTypes(f);
    McdRGHeightFieldRegisterType(f);
    MeMatrix4TMMakeIdentity(tm);
    McdGeometryID g[3] = {McdBoxCreate(f, 1, 1, 1), McdPlaneCreate(f), geometryOf(f, FIELD)};
    McdModelID m[3];
    for (int i = 0; i < 3; i++) {
        m[i] = McdModelCreate(g[i]);
        McdModelSetTransformPtr(m[i], tm);
    }
    McdModelPairID pair = McdModelPairCreate(m[0], m[1]), rough = McdModelPairCreate(m[0], m[2]);
    McdIntersectResult result = {.contactMaxCount = CONTACTS};
    ck_assert_int_eq(McdPlaneIntersect(pair, &result), 0);
    assert_warned("McdPlaneIntersect: the result has no place for contacts");
    ck_assert_int_eq(McdBoxRGHeightFieldIntersect(rough, &result), 0);
    assert_warned("McdBoxRGHeightFieldIntersect: the result has no place for contacts");
    McdModelPairDestroy(pair);
    McdModelPairDestroy(rough);
    for (int i = 0; i < 3; i++) {
        McdModelDestroy(m[i]);
        McdGeometryDestroy(g[i]);
    }
    McdTerm(f);
}

/* The field is a part, and the model's place plus the part's is more than there is: its cells had the index
 * (int)NaN. */
TEST(a_segment_against_a_height_field_in_an_aggregate) {
    McdLineSegIntersectResult hit;
    MeVector3 from = {0, 0, 5}, to = {0, 0, -5};
    MeMatrix4 near, tm;
    McdFrameworkID f = McdInit(0, 10, 10, 1);
    McdAllRegisterTypes(f);
    McdAllRegisterInteractions(f);
    memset(height, 0, sizeof height);
    const McdGeometryID field = geometryOf(f, FIELD), whole = McdAggregateCreate(f, 1);
    MeMatrix4TMMakeIdentity(near);
    MeMatrix4TMMakeIdentity(tm);
    near[3][2] = 1;
    McdAggregateAddElement(whole, field, near);
    const McdModelID m = McdModelCreate(whole);
    McdModelSetTransformPtr(m, tm);
    ck_assert_int_eq(McdLineSegIntersect(m, from, to, &hit), 1); /* never updated: the query places its parts */
    McdModelUpdate(m);
    ck_assert_int_eq(McdLineSegIntersect(m, from, to, &hit), 1);
    assert_near(hit.distance, 4, 1e-6);
    for (int k = 0; k < 3; k++) {
        McdAggregateGetElementTransformPtr(whole, 0)[3][k] = MEINFINITY;
        tm[3][k] = MEINFINITY;
    }
    McdModelUpdate(m);
    ck_assert_int_eq(McdLineSegIntersect(m, from, to, &hit), 0);
    McdModelDestroy(m);
    McdGeometryDestroy(whole);
    McdGeometryDestroy(field);
    McdTerm(f);
    messages_forget();
}
