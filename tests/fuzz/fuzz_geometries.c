/* Fuzzer of geometries: two shapes at two places, and every query about them.
 *
 * A line is "Pair <shape> <place> <shape> <place> <line>": a shape is its type and four numbers, a place the 16 numbers
 * of its transform, and the line the six of both ends of a segment. Contacts, distance, line of sight, safe time, casts
 * and overlaps must be finite, with unit normals where both places are rigid, and the same in both orders. */
#define _DEFAULT_SOURCE /* strtok_r */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

#include "Mcd.h"
#include "McdQuery.h"
#include "Mst.h"

enum { CONTACTS = 64, NUMBERS = 4, POINTS = 24 };

typedef struct Shape {
    int type;
    MeReal number[NUMBERS];
    MeMatrix4 tm;
} Shape;

static MstUniverseID universe;
static McdFrameworkID frame;
static McdSpaceID space;

/* ---- shapes ---- */

/* What is made of several numbers is made by a seed, as large, and as wild, as the shape's numbers say. */
static MeReal wild(FuzzRandom *random, const Shape *s) {
    return (MeReal)(fuzzIsNasty(random) ? fuzzReal(random) : fuzzUniform(random, -1, 1)) * s->number[1];
}

static FuzzRandom seedOf(const Shape *s) {
    const int nasty = s->number[2] > 0 && s->number[2] < 100 ? (int)s->number[2] : 0;
    const double seed = fmod(fabs(s->number[0]), 1e6);
    return (FuzzRandom){seed >= 0 ? (uint64_t)(1e3 * seed) : 0, nasty, 0};
}

static McdGeometryID makeHull(const Shape *s) {
    MeVector3 point[POINTS];
    FuzzRandom random = seedOf(s);
    const int count = 1 + fuzzBelow(&random, POINTS);
    const MeBool isFlat = fuzzChance(&random, 20), repeats = fuzzChance(&random, 20);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            point[i][k] = repeats && i % 2 ? point[i - 1][k] : isFlat && k == 2 ? 0 : wild(&random, s);
    return McdConvexMeshCreateHull(frame, point, count, MeFabs(s->number[3]) < 1 ? s->number[3] : 0);
}

static McdGeometryID makeHeights(const Shape *s) {
    static MeReal heights[64];
    FuzzRandom random = seedOf(s);
    for (int i = 0; i < 64; i++)
        heights[i] = wild(&random, s);
    const int x = 2 + fuzzBelow(&random, 7), y = 2 + fuzzBelow(&random, 7);
    return McdRGHeightFieldCreate(frame, heights, x, y, s->number[1], s->number[1], s->number[3], s->number[3]);
}

static MeVector3 corner[POINTS][3];

static int MEAPI giveTriangles(McdModelPair *p, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    (void)p, (void)pos, (void)radius;
    int count = 0;
    for (; count < POINTS && count < max; count++) {
        for (int k = 0; k < 3; k++)
            triangle[count].vertices[k] = &corner[count][k];
        triangle[count].normal = NULL;
        triangle[count].flags = (McdTriangleFlags)(count % 8);
    }
    return count;
}

static McdGeometryID makeTriangles(const Shape *s) {
    FuzzRandom random = seedOf(s);
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                corner[i][k][axis] = wild(&random, s);
    MeVector3 low = {-s->number[1], -s->number[1], -s->number[1]}, high = {s->number[1], s->number[1], s->number[1]};
    return McdTriangleListCreate(frame, low, high, POINTS, giveTriangles);
}

static McdGeometryID makeParts(const Shape *s) {
    FuzzRandom random = seedOf(s);
    const McdGeometryID parts[2] = {McdBoxCreate(frame, s->number[1], s->number[3], s->number[1]),
                                    McdSphereCreate(frame, s->number[1])};
    const McdGeometryID whole = McdAggregateCreate(frame, 4);
    for (int i = 0; i < 3; i++) {
        MeMatrix4 tm;
        fuzzMatrix(&random, &tm[0][0]);
        if (whole && parts[i % 2])
            McdAggregateAddElement(whole, parts[i % 2], tm);
    }
    return whole;
}

/* A program's own: an ellipsoid, a box with a rounding, and one whose function is not that of a convex shape. */
static void MEAPI ownSupport(const void *data, const double direction[3], double point[3]) {
    const double *x = data;
    double length = 0;
    for (int i = 0; i < 3; i++)
        length += x[i] * direction[i] * x[i] * direction[i];
    length = sqrt(length);
    for (int i = 0; i < 3; i++)
        if (x[3] < 1)
            point[i] = length > 0 ? x[i] * x[i] * direction[i] / length : 0;
        else
            point[i] = x[3] < 2 ? copysign(x[i], direction[i]) : x[i] * sin(1e3 * direction[(i + 1) % 3]);
}

static double MEAPI ownRounding(const void *data) {
    return fabs(((const double *)data)[4]);
}

static McdGeometryID makeOwn(const Shape *s) {
    static const McdConvexFunctions functions = {.support = ownSupport, .rounding = ownRounding};
    const double data[5] = {(double)s->number[0], (double)s->number[1], (double)s->number[2], s->type - 10,
                            s->type == 11 ? (double)s->number[3] : 0};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Own", sizeof data, &functions), data);
}

enum { TYPES = 13 };

static McdGeometryID make(const Shape *s) {
    const MeReal *x = s->number;
    switch (s->type) {
    case 0:
        return McdSphereCreate(frame, x[0]);
    case 1:
        return McdBoxCreate(frame, x[0], x[1], x[2]);
    case 2:
        return McdCylinderCreate(frame, x[0], x[1]);
    case 3:
        return McdSphylCreate(frame, x[0], x[1]);
    case 4:
        return McdConeCreate(frame, x[0], x[1]);
    case 5:
        return McdPlaneCreate(frame);
    case 6:
        return makeHull(s);
    case 7:
        return makeHeights(s);
    case 8:
        return makeTriangles(s);
    case 9:
        return makeParts(s);
    default:
        return makeOwn(s);
    }
}

/* ---- what must hold ---- */

static MeBool isRigid;

static void checkVector(const MeReal v[3], const char *what) {
    for (int i = 0; i < 3; i++)
        if (!isfinite(v[i]))
            fuzzFail("%s is not finite", what);
}

static void checkNormal(const MeReal n[3], const char *what) {
    checkVector(n, what);
    if (isRigid && fabs((double)MeVector3Magnitude(n) - 1) > 1e-3)
        fuzzFail("%s has not length 1", what);
}

static void checkNumber(MeReal x, const char *what) {
    if (isnan(x))
        fuzzFail("%s is NaN", what);
}

static void intersect(McdModelPairID pair) {
    static McdContact contacts[CONTACTS];
    McdIntersectResult result;
    memset(&result, 0, sizeof result);
    result.contacts = contacts;
    result.contactMaxCount = CONTACTS;
    McdIntersect(pair, &result);
    if (result.contactCount < 0 || result.contactCount > CONTACTS)
        fuzzFail("McdIntersect: %d contacts", result.contactCount);
    for (int i = 0; i < result.contactCount; i++) {
        checkVector(contacts[i].position, "the position of a contact");
        checkNormal(contacts[i].normal, "the normal of a contact");
        checkNumber(contacts[i].separation, "the separation of a contact");
    }
}

static void measure(McdModelPairID pair) {
    McdDistanceResult d;
    if (!McdDistance(pair, &d))
        return;
    checkNumber(d.distance, "McdDistance");
    checkVector(d.position1, "the point of McdDistance");
    checkVector(d.position2, "the point of McdDistance");
    checkNormal(d.normal, "the normal of McdDistance");
}

static void move(McdModelPairID pair) {
    McdSafeTimeResult t;
    memset(&t, 0, sizeof t);
    if (!McdSafeTime(pair, 1, &t))
        return;
    if (!(t.time >= 0 && t.time <= 1))
        fuzzFail("McdSafeTime: %g", (double)t.time);
    if (t.time < 1)
        checkVector(t.normal, "the normal of McdSafeTime");
}

static void look(McdModelID m, MeReal from[3], MeReal to[3]) {
    McdLineSegIntersectResult hit;
    if (!McdLineSegIntersect(m, from, to, &hit))
        return;
    checkVector(hit.position, "the point of McdLineSegIntersect");
    checkNumber(hit.distance, "McdLineSegIntersect's distance");
    if (hit.distance > 0) /* it does not begin inside */
        checkNormal(hit.normal, "the normal of McdLineSegIntersect");
}

static void ask(McdGeometryID g, const MeMatrix4 tm, const MeReal from[3], const MeReal by[3]) {
    McdModelID list[4];
    McdCastResult cast;
    McdClosestResult closest;
    McdSpaceOverlapGeometry(space, g, tm, NULL, NULL, list, 4);
    if (McdSpaceGetClosest(space, g, tm, 10, NULL, NULL, &closest)) {
        checkNumber(closest.distance, "McdSpaceGetClosest");
        checkVector(closest.position2, "the point of McdSpaceGetClosest");
    }
    if (McdSpaceCastGeometry(space, g, tm, by, NULL, NULL, &cast) && !(cast.fraction >= 0 && cast.fraction <= 1))
        fuzzFail("McdSpaceCastGeometry: %g", (double)cast.fraction);
    if (McdSpaceCastRay(space, from, by, NULL, NULL, &cast) && !(cast.fraction >= 0 && cast.fraction <= 1))
        fuzzFail("McdSpaceCastRay: %g", (double)cast.fraction);
}

/* ---- a line ---- */

static McdModelID place(McdGeometryID g, Shape *s) {
    const McdModelID m = g ? McdModelCreate(g) : NULL;
    if (!m)
        return NULL;
    McdModelSetTransformPtr(m, s->tm);
    McdSpaceInsertModel(space, m);
    return m;
}

static void compare(McdModelID m1, McdModelID m2) {
    const McdModelPairID pair = McdModelPairCreate(m1, m2);
    if (!pair)
        return;
    McdHello(pair);
    intersect(pair);
    measure(pair);
    move(pair);
    McdGoodbye(pair);
    McdModelPairDestroy(pair);
}

static void run(Shape s[2], MeReal from[3], MeReal to[3]) {
    McdGeometryID g[2];
    McdModelID m[2];
    for (int i = 0; i < 2; i++) {
        g[i] = make(&s[i]);
        m[i] = place(g[i], &s[i]);
        if (m[i])
            McdModelSetLinearVelocityPtr(m[i], i ? to : from);
    }
    isRigid = MeMatrix4IsTM(s[0].tm, 1e-4) && MeMatrix4IsTM(s[1].tm, 1e-4);
    McdSpaceUpdateAll(space);
    if (m[0] && m[1]) {
        compare(m[0], m[1]);
        compare(m[1], m[0]);
    }
    for (int i = 0; i < 2; i++) {
        if (m[i])
            look(m[i], from, to);
        if (g[i])
            ask(g[i], s[1 - i].tm, from, to);
    }
    for (int i = 0; i < 2; i++)
        if (m[i])
            McdModelDestroy(m[i]);
    for (int i = 0; i < 2; i++)
        if (g[i])
            McdGeometryDestroy(g[i]);
}

static MeBool readNumbers(char **rest, MeReal x[], int count) {
    for (int i = 0; i < count; i++) {
        const char *word = strtok_r(NULL, " ", rest);
        if (!word)
            return MEFALSE;
        x[i] = (MeReal)strtod(word, NULL);
    }
    return METRUE;
}

static void execute(char *line) {
    static Shape s[2];
    MeReal ends[6];
    char *rest;
    const char *word = strtok_r(line, " ", &rest);
    for (int i = 0; word && i < 2; i++) {
        const char *type = strtok_r(NULL, " ", &rest);
        s[i].type = type ? abs(atoi(type)) % TYPES : 0;
        if (!type || !readNumbers(&rest, s[i].number, NUMBERS) || !readNumbers(&rest, &s[i].tm[0][0], 16))
            return;
    }
    if (word && readNumbers(&rest, ends, 6))
        run(s, ends, ends + 3);
}

static void writeNumber(FuzzLine *line, double x) {
    fuzzWrite(line, " ");
    fuzzWriteReal(line, (double)(MeReal)x);
}

/* Sizes are mostly such as shapes have; every type meets every other. */
static void generate(FuzzRandom *random, int index, FuzzLine *line) {
    const int number = random->run * 13 + index;
    fuzzWrite(line, "Pair");
    for (int i = 0; i < 2; i++) {
        MeMatrix4 tm;
        fuzzMatrix(random, &tm[0][0]);
        fuzzWrite(line, " %d", (i ? number / TYPES : number) % TYPES);
        for (int k = 0; k < NUMBERS; k++)
            writeNumber(line, fuzzIsNasty(random) ? fuzzReal(random) : fuzzUniform(random, 0, 2));
        for (int k = 0; k < 16; k++)
            writeNumber(line, (double)tm[k / 4][k % 4]);
    }
    for (int k = 0; k < 6; k++)
        writeNumber(line, fuzzReal(random));
}

static void begin(void) {
    universe = MstUniverseCreate(&MstUniverseGrowingSizes);
    frame = MstUniverseGetFramework(universe);
    space = MstUniverseGetSpace(universe);
}

static void end(void) {
    MstUniverseDestroy(universe);
}

int main(int argc, char **argv) {
    static const FuzzTarget target = {"geometries", 100, 5, begin, generate, execute, end};
    return fuzzMain(argc, argv, &target);
}
