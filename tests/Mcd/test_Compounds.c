/* Contacts of compounds are on the surface of the whole: none at faces between parts that abut or overlap, nothing else
 * is lost. */
#include "terrain.h"

static McdFrameworkID frame;
static Probe probe, solid;
static Terrain ground;

static void begin(void) {
    frame = frame_make(0, 20, 100, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
}

static void place(MeMatrix4 tm, const double angle[3], double x, double y, double z) {
    MeMatrix4TMFromEulerAnglesAndPosition(tm, angle[0], angle[1], angle[2], x, y, z);
}

static McdGeometryID boxOf(double x, double y, double z) {
    return McdBoxCreate(frame, x, y, z);
}

static void add(McdAggregateID whole, McdGeometryID part, double x, double y, double z) {
    static const double none[3] = {0, 0, 0};
    MeMatrix4 tm;
    place(tm, none, x, y, z);
    ck_assert_int_ge(McdAggregateAddElement(whole, part, tm), 0);
}

/* A box cut across x into so many. */
static McdAggregateID boxInParts(int parts, double x, double y, double z) {
    const McdAggregateID whole = McdAggregateCreate(frame, parts);
    const McdGeometryID part = boxOf(x / parts, y, z);
    for (int i = 0; i < parts; i++)
        add(whole, part, x * ((i + .5) / parts - .5), 0, 0);
    return whole;
}

/* How far the normal that leans most is from vertical: its part that is level. */
static double leanOf(const Probe *p) {
    double max = 0;
    for (int i = 0; i < p->result.contactCount; i++)
        max = fmax(max, hypot(p->contact[i].normal[0], p->contact[i].normal[1]));
    return max;
}

/* Contacts; without them McdIntersect tells that there are none. */
static int test(Probe *p) {
    McdModelUpdate(p->model);
    McdModelUpdate(p->ground);
    return McdIntersect(p->pair, &p->result) ? p->result.contactCount : 0;
}

static double minSeparation(const Probe *p) {
    double min = HUGE_VAL;
    for (int i = 0; i < p->result.contactCount; i++)
        min = fmin(min, p->contact[i].separation);
    return min;
}

/* Both at the same place: contacts, vertical but for the tilt, and the deepest one is that of the solid shapes. */
static void compareWithSolid(const double angle[3], double x, double y, double z) {
    place(probe.tm, angle, x, y, z);
    memcpy(solid.tm, probe.tm, sizeof solid.tm);
    ck_assert_int_gt(test(&probe), 0);
    ck_assert_int_gt(test(&solid), 0);
    /* What leans by less than 1e-6 is straight. Up to 8 degrees are let pass where nearly parallel faces have a sliver
     * in common, between edges that cross: dropped, it would not support what it lies on. */
    const MeBool isTilted = angle[0] != 0 || angle[1] != 0;
    const double lean = leanOf(&probe), max = isTilted ? .1411 : 1e-6;
    ck_assert_msg(lean <= max, "at %g %g %g, tilted by %g %g %g: a normal leans by %g", x, y, z, angle[0], angle[1],
                  angle[2], lean);
    assert_near(minSeparation(&probe), minSeparation(&solid), 4e-7); /* hulls: 2e-7 of their size */
}

static const double tilts[][3] = {{0, 0, 0},     {1e-4, 0, 0}, {-1e-4, 0, 0},       {0, 1e-4, 0},
                                  {0, -1e-4, 0}, {0, 0, 1e-3}, {5e-4, -3e-4, 2e-2}, {2e-6, 3e-6, -1e-6}};
enum { TILTS = sizeof tilts / sizeof *tilts };
static const double offs[] = {0, 1e-7, -1e-7, 1e-5, -1e-5, 1e-3, -1e-3, 8e-3, -8e-3};
enum { OFFS = sizeof offs / sizeof *offs };

TEST(halves_on_halves_touch_at_outer_faces) {
    static const double depths[] = {1e-3, 1e-5, 0, -1e-6, -1e-3};
    begin();
    const McdAggregateID cube = boxInParts(2, 1, 1, 1);
    probe_init(&probe, cube, cube);
    probe_init(&solid, boxOf(1, 1, 1), boxOf(1, 1, 1));
    for (int t = 0; t < TILTS; t++)
        for (int o = 0; o < OFFS; o++)
            for (int d = 0; d < 5; d++)
                compareWithSolid(tilts[t], offs[o], 0, 1 - depths[d]);
}

/* Shapes of all kinds, over each place of a floor's joint. */
TEST(what_slides_over_parts_touches_their_top) {
    begin();
    MeVector3 corner[8];
    for (int i = 0; i < 8; i++)
        MeVector3Set(corner[i], i & 1 ? .25 : -.25, i & 2 ? .25 : -.25, i & 4 ? .25 : -.25);
    const McdGeometryID shape[] = {boxOf(.5, .5, .5),
                                   McdSphereCreate(frame, .25),
                                   McdSphylCreate(frame, .1, .3),
                                   McdCylinderCreate(frame, .25, .5),
                                   McdConvexMeshCreateHull(frame, (const MeVector3 *)corner, 8, 0),
                                   boxInParts(3, .5, .5, .5)};
    const McdGeometryID parts = boxInParts(4, 8, 2, 1), whole = boxOf(8, 2, 1);
    for (int s = 0; s < 6; s++) {
        probe_init(&probe, shape[s], parts);
        probe_init(&solid, shape[s], whole);
        for (int t = 0; t < TILTS; t++)
            for (int o = 0; o < OFFS; o++)
                for (int i = -2; i <= 2; i++)
                    for (int d = 0; d < 3; d++)
                        compareWithSolid(tilts[t], .25 * i + offs[o], 0, .75 - (d - 1) * 1e-3);
        probe_term(&probe);
        probe_term(&solid);
    }
}

/* The same halves, on a plane and on triangles, and as parts of parts. */
TEST(halves_stand_on_anything) {
    begin();
    memset(&ground, 0, sizeof ground);
    terrain_grid(&ground, 30, .31, 0, kMcdTriangleStandard);
    const McdAggregateID nested = McdAggregateCreate(frame, 2), cube = boxInParts(2, 1, 1, 1);
    add(nested, cube, -.5, 0, 0);
    add(nested, cube, .5, 0, 0);
    const McdGeometryID floors[] = {McdPlaneCreate(frame), terrain_list(frame, &ground), boxInParts(4, 8, 2, 1)};
    for (int f = 0; f < 3; f++) {
        probe_init(&probe, nested, floors[f]);
        probe_init(&solid, boxOf(2, 1, 1), floors[f]);
        for (int t = 0; t < TILTS; t++)
            for (int o = 0; o < OFFS; o++)
                compareWithSolid(tilts[t], offs[o], 0, (f == 2 ? 1 : .5) - 1e-3);
        probe_term(&probe);
        probe_term(&solid);
    }
}

/* ---- how exactly parts abut -------------------------------------------------------------------------------------- */

/* Two boxes, the second one higher and away from the first; a box of extent .433 on the first one, 1e-4 over the edge.
 * Returns how far the normal leans. */
static double leanAtEdge(double step, double gap) {
    const McdAggregateID whole = McdAggregateCreate(frame, 2);
    add(whole, boxOf(2, 2, 1), -1, 0, 0);
    add(whole, boxOf(2, 2, 1), 1 + gap, 0, step);
    probe_init(&probe, boxOf(.5, .5, .5), whole);
    ck_assert_int_gt(probe_at(&probe, -.25 + gap + 1e-4, 0, .75 - 1e-3), 0);
    const double lean = leanOf(&probe);
    probe_term(&probe);
    return lean;
}

/* A step of less than 1e-4 of the smaller size is none; nor is a gap of less than a quarter of the width of the shape
 * above it. */
TEST(parts_abut_to_within_a_part_of_their_size) {
    begin();
    assert_near(leanAtEdge(0, 0), 0, TOL(1e-6, 1e-15));
    assert_near(leanAtEdge(.433 * .8e-4, 0), 0, TOL(1e-6, 1e-15));
    assert_near(leanAtEdge(0, .433 * .8e-4), 0, TOL(1e-6, 1e-15));
    assert_near(leanAtEdge(0, .124), 0, TOL(1e-6, 1e-15));
    assert_near(leanAtEdge(.433 * 1.2e-4, 0), 1, TOL(1e-6, 1e-15));
    assert_near(leanAtEdge(0, .126), 1, TOL(1e-6, 1e-15));
}

/* Above the floor and before an edge, at the same distance at 10 degrees: no contact at the edge. */
TEST(no_normal_leans_over_an_edge_between_flush_faces) {
    begin();
    probe_init(&probe, boxOf(.5, .5, .5), boxInParts(2, 4, 2, 1));
    ck_assert_int_gt(probe_at(&probe, -.25 - 1e-3 * tan(.1745), 0, .75 + 1e-3), 0);
    assert_near(leanOf(&probe), 0, TOL(1e-6, 1e-15));
}

/* ---- corners of the whole ---------------------------------------------------------------------------------------- */

/* Of the contacts with one part: how many, and the deepest. */
static int countWith(int element, double *deepest, const MeReal **normal) {
    int count = 0;
    *deepest = HUGE_VAL;
    for (int i = 0; i < probe.result.contactCount; i++) {
        const McdContact *c = &probe.contact[i];
        if (c->instance2 != McdGeometryInstanceGetChild(McdModelGetGeometryInstance(probe.ground), element))
            continue;
        count++;
        if ((double)c->separation < *deepest) {
            *deepest = (double)c->separation;
            *normal = c->normal;
        }
    }
    return count;
}

/* A wedge whose edge is y, through its origin, from -.5 to .5; its sides are at two angles over x, rad. */
static McdGeometryID wedgeOf(double low, double high) {
    MeVector3 corner[6];
    for (int i = 0; i < 6; i++) {
        const double angle = i < 4 ? low : high, far = i < 2 ? 0 : 1;
        MeVector3Set(corner[i], far * cos(angle), i % 2 ? .5 : -.5, far * sin(angle));
    }
    return McdConvexMeshCreateHull(frame, (const MeVector3 *)corner, 6, 0);
}

/* A floor, and a wall that stands in it or beside it; a box upright in the corner, and a wedge that touches both with
 * its edge, which is inside of either. */
TEST(the_foot_of_a_wall_is_floor) {
    static const double upright[3] = {0, 0, 0};
    static const double inside[] = {0, 1e-6, 1e-3, 1e-2};
    double depth;
    const MeReal *n = 0;
    begin();
    for (int isInIt = 0; isInIt < 2; isInIt++) {
        const McdAggregateID whole = McdAggregateCreate(frame, 2);
        add(whole, boxOf(4, 2, 1), isInIt ? 1 : 2, 0, -.5); /* from x = -1, or 0 */
        add(whole, boxOf(1, 2, 4), -.5, 0, 1);              /* from z = -1 */
        probe_init(&probe, boxOf(1, 1, 1), whole);
        for (int i = 0; i < 4; i++) {
            place(probe.tm, upright, .5 - inside[i], 0, .5 - inside[i]);
            test(&probe);
            ck_assert_int_eq(countWith(0, &depth, &n), 4);
            assert_vec3_near(n, 0, 0, 1, TOL(1e-6, 1e-15));
            ck_assert_int_eq(countWith(1, &depth, &n), 4);
            assert_vec3_near(n, 1, 0, 0, TOL(1e-6, 1e-15));
        }
        probe_term(&probe);
        probe_init(&probe, wedgeOf(.35, 1.2), whole);
        for (int i = 1; i < 4; i++) { /* that it is deep makes the normal unique */
            ck_assert_int_gt(probe_at(&probe, -inside[i], 0, -inside[i]), 0);
            ck_assert_int_ge(countWith(0, &depth, &n), 1);
            if (!isInIt) /* it is beyond the edge of the floor, which is internal */
                continue;
            assert_vec3_near(n, 0, 0, 1, TOL(1e-6, 1e-12));
            assert_near(depth, -inside[i], TOL(4e-7, 1e-12));
            ck_assert_int_eq(countWith(1, &depth, &n), 2);
            assert_vec3_near(n, 1, 0, 0, TOL(1e-6, 1e-12));
            assert_near(depth, -inside[i], TOL(4e-7, 1e-12));
        }
        probe_term(&probe);
    }
}

static void turnAboutY(MeMatrix4 tm, double angle, double x, double y, double z) {
    const double angles[3] = {0, angle, 0};
    place(tm, angles, x, y, z);
}

/* A wall that leans over the floor by 30 degrees, and a wedge of 20 degrees whose edge is 1 cm deep in both: it is out
 * of both by 2 cm, and by far more along any other normal. */
TEST(both_sides_of_a_sharp_corner_push) {
    double depth;
    const MeReal *n = 0;
    begin();
    const McdAggregateID whole = McdAggregateCreate(frame, 2);
    MeMatrix4 tm;
    add(whole, boxOf(4, 2, 1), 0, 0, -.5);
    const double lean = .5236, c = cos(lean), s = sin(lean);
    turnAboutY(tm, lean, -.5 * c + s, 0, .5 * s + c); /* its right face goes up from the origin, to the right */
    McdAggregateAddElement(whole, boxOf(1, 2, 4), tm);
    probe_init(&probe, wedgeOf(.3491, .6981), whole); /* the wall is at 1.047 */
    /* off both planes by -.01: z = -.01, and x c - z s = -.01 */
    probe_at(&probe, (-.01 - .01 * s) / c, 0, -.01);
    ck_assert_int_eq(countWith(0, &depth, &n), 2);
    assert_vec3_near(n, 0, 0, 1, TOL(1e-6, 1e-12));
    assert_near(depth, -.01, TOL(1e-6, 1e-12));
    ck_assert_int_eq(countWith(1, &depth, &n), 2);
    assert_vec3_near(n, c, 0, -s, TOL(1e-6, 1e-12));
}

/* Along y, of the contacts with a part: from where to where. */
static void extentWith(int element, double extent[2]) {
    extent[0] = HUGE_VAL;
    extent[1] = -HUGE_VAL;
    for (int i = 0; i < probe.result.contactCount; i++) {
        const McdContact *c = &probe.contact[i];
        if (c->instance2 != McdGeometryInstanceGetChild(McdModelGetGeometryInstance(probe.ground), element))
            continue;
        extent[0] = fmin(extent[0], c->position[1]);
        extent[1] = fmax(extent[1], c->position[1]);
    }
}

/* The floor's second half would hold up what stands on both, but not where the first half does: at the foot of a wall
 * on that half alone. */
TEST(the_foot_of_a_wall_supports) {
    double extent[2];
    begin();
    const McdAggregateID whole = McdAggregateCreate(frame, 3);
    add(whole, boxOf(4, 1, 1), 0, -.5, -.5);
    add(whole, boxOf(4, 1, 1), 0, .5, -.5);
    add(whole, boxOf(1, 1, 3), -.5, -.5, 1.5);
    probe_init(&probe, wedgeOf(.35, 1.2), whole);
    ck_assert_int_gt(probe_at(&probe, 0, 0, -1e-5), 0);
    extentWith(0, extent);
    assert_near(extent[0], -.5, 2e-6); /* as exact as clipping is: 2e-7 of the size */
    assert_near(extent[1], 0, 2e-6);
    extentWith(1, extent);
    assert_near(extent[1], .5, 2e-6);
}

/* A plate on two rails, which it touches all along; the first rail has a post at either end of the plate. */
TEST(a_rail_between_posts_supports) {
    double extent[2];
    MeMatrix4 tm;
    begin();
    const McdAggregateID whole = McdAggregateCreate(frame, 4);
    const McdGeometryID rail = McdCylinderCreate(frame, .1, 2);
    for (int i = 0; i < 2; i++) {
        turnAboutY(tm, 1.5707963267949, 0, i ? .4 : -.4, -.1);
        McdAggregateAddElement(whole, rail, tm);
    }
    add(whole, boxOf(.5, .2, 1), -.75, -.4, 0);
    add(whole, boxOf(.5, .2, 1), .75, -.4, 0);
    probe_init(&probe, boxOf(1, 1, .1), whole);
    ck_assert_int_gt(probe_at(&probe, 0, 0, .05 - 1e-4), 0);
    extentWith(0, extent);
    assert_near(extent[0], -.4, TOL(1e-6, 1e-12));
    extentWith(1, extent);
    assert_near(extent[0], .4, TOL(1e-6, 1e-12));
}

/* ---- deep in between --------------------------------------------------------------------------------------------- */

/* A small shape below the joint of two boxes is nearer to the one's inner face, and to the other's, than to the top. */
TEST(what_is_deep_between_parts_is_pushed_out) {
    static const double turns[][3] = {{0, 0, 0}, {.1, 0, 0}, {0, .1, 0}, {0, 0, .3}, {.1, .2, .3}};
    begin();
    const McdGeometryID shape[] = {boxOf(.2, .2, .2), McdSphereCreate(frame, .1), McdCylinderCreate(frame, .1, .2)};
    for (int s = 0; s < 3; s++) {
        probe_init(&probe, shape[s], boxInParts(4, 8, 2, 1));
        for (int t = 0; t < 5; t++)
            for (int o = 0; o < OFFS; o++) {
                MeVector3 low, high;
                place(probe.tm, turns[t], offs[o], 0, .45);
                ck_assert_int_gt(test(&probe), 0);
                McdModelGetAABB(probe.model, low, high);
                const double lean = leanOf(&probe), max = hypot(turns[t][0], turns[t][1]);
                ck_assert_msg(lean <= max + TOL(1e-6, 1e-12), "%g of %g", lean, max); /* of its own face */
                for (int i = 0; i < probe.result.contactCount; i++)
                    ck_assert((double)probe.contact[i].normal[2] > .9);
                assert_below(minSeparation(&probe), ((double)low[2] - .5) * .9);
                if (s == 1 && fabs(offs[o]) >= 1e-3) /* the ball's middle is below one of them */
                    ck_assert_int_eq(probe.result.contactCount, 1);
            }
        probe_term(&probe);
    }
}

/* Two cylinders with one axis: a ball near their joint comes out through the side. */
TEST(what_is_deep_between_round_parts_is_pushed_out) {
    begin();
    const McdAggregateID whole = McdAggregateCreate(frame, 2);
    const McdGeometryID half = McdCylinderCreate(frame, .5, 2);
    add(whole, half, 0, 0, -1);
    add(whole, half, 0, 0, 1);
    probe_init(&probe, McdSphereCreate(frame, .05), whole);
    ck_assert_int_eq(probe_at(&probe, .21, .28, 1e-3), 1);
    assert_vec3_near(probe.contact[0].normal, .6, .8, 0, TOL(1e-6, 1e-12));
    assert_near(probe.contact[0].separation, -.2, TOL(1e-6, 1e-12));
}

/* ---- nothing is lost --------------------------------------------------------------------------------------------- */

enum { PARTS = 4 };
typedef struct Box {
    double half[3], at[3]; /* in its compound, to which it is parallel */
} Box;
typedef struct Compound {
    Box box[PARTS];
    McdAggregateID geometry;
    Probe *probe;
} Compound;

static unsigned int seed;
static double randomFrom(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / (1 << 24);
}

/* On a grid of .25, so that many of them abut. */
static void makeCompound(Compound *c) {
    c->geometry = McdAggregateCreate(frame, PARTS);
    for (int i = 0; i < PARTS; i++) {
        Box *b = &c->box[i];
        for (int k = 0; k < 3; k++) {
            b->half[k] = .25 * floor(randomFrom(1, 4)) / 2;
            b->at[k] = .25 * floor(randomFrom(-2, 3)) / 2;
        }
        add(c->geometry, boxOf(2 * b->half[0], 2 * b->half[1], 2 * b->half[2]), b->at[0], b->at[1], b->at[2]);
    }
}

/* Of a point, in the compound's frame, to the box: the largest distance from a face's plane; negative: inside. */
static double heightOver(const Box *b, const double x[3]) {
    double max = -HUGE_VAL;
    for (int k = 0; k < 3; k++)
        max = fmax(max, fabs(x[k] - b->at[k]) - b->half[k]);
    return max;
}

static void toFrame(const MeMatrix4 tm, const double world[3], double own[3]) {
    for (int k = 0; k < 3; k++) {
        own[k] = 0;
        for (int i = 0; i < 3; i++)
            own[k] += (double)tm[k][i] * (world[i] - (double)tm[3][i]);
    }
}

/* The highest point of a box along a direction, in the world. */
static double topAlong(const Box *b, const MeMatrix4 tm, const double n[3]) {
    double top = 0;
    for (int i = 0; i < 3; i++)
        top += n[i] * (double)tm[3][i];
    for (int k = 0; k < 3; k++) {
        const double along = (double)tm[k][0] * n[0] + (double)tm[k][1] * n[1] + (double)tm[k][2] * n[2];
        top += b->at[k] * along + b->half[k] * fabs(along);
    }
    return top;
}

/* A quarter of the smallest width of a box. */
static double gapOf(const Box *b) {
    return fmin(fmin(b->half[0], b->half[1]), b->half[2]) / 2;
}

/* Whether the point, moved outward by .2 mm to 1 cm, or by the gap that the other model's part slides over, is as far
 * from all other parts: then their faces are not above it, nor flush with an edge over which the normal leans. */
static MeBool isOutside(const Compound *c, int part, const MeMatrix4 tm, const McdContact *contact, double side,
                        double gap) {
    const double heights[] = {2e-4, 1e-3, 1e-2, gap};
    for (int h = 0; h < 4; h++) {
        double x[3], own[3];
        for (int i = 0; i < 3; i++)
            x[i] = (double)contact->position[i] -
                   side * ((double)contact->separation / 2 - heights[h]) * (double)contact->normal[i];
        toFrame(tm, x, own);
        for (int i = 0; i < PARTS; i++)
            if (i != part && heightOver(&c->box[i], own) < heights[h] - 1e-6)
                return MEFALSE;
    }
    return METRUE;
}

static int elementOf(McdGeometryInstanceID part, McdModelID model) {
    for (int i = 0; i < PARTS; i++)
        if (McdGeometryInstanceGetChild(McdModelGetGeometryInstance(model), i) == part)
            return i;
    ck_abort_msg("no part of the model");
    return -1;
}

static MeBool hasContactAt(const McdContact *wanted) {
    for (int i = 0; i < probe.result.contactCount; i++) {
        const McdContact *c = &probe.contact[i];
        if ((double)MeVector3Distance(c->position, wanted->position) < 1e-5 &&
            (double)MeVector3Dot(c->normal, wanted->normal) > 1 - 1e-5)
            return METRUE;
    }
    return MEFALSE;
}

/* The gap between two boxes along a direction; negative: they overlap. */
static double gapAlong(const Compound c[2], int part1, int part2, const double n[3]) {
    const double back[3] = {-n[0], -n[1], -n[2]};
    return -topAlong(&c[0].box[part1], probe.tm, back) - topAlong(&c[1].box[part2], probe.groundTM, n);
}

/* The same along a contact's normal, or, if that is better, a face's within 8 degrees of it. */
static double gapAlongContact(const Compound c[2], int part1, int part2, const McdContact *contact) {
    const double n[3] = {(double)contact->normal[0], (double)contact->normal[1], (double)contact->normal[2]};
    double gap = gapAlong(c, part1, part2, n);
    for (int k = 0; k < 12; k++) {
        const MeReal *axis = k < 6 ? probe.tm[k / 2] : probe.groundTM[k / 2 - 3];
        const double side = k % 2 ? 1 : -1;
        const double face[3] = {side * (double)axis[0], side * (double)axis[1], side * (double)axis[2]};
        if (face[0] * n[0] + face[1] * n[1] + face[2] * n[2] > .99)
            gap = fmax(gap, gapAlong(c, part1, part2, face));
    }
    return gap;
}

/* Do two parts no longer overlap when they have moved apart as far as a contact of one of them says? */
static MeBool isLeft(const Compound c[2], int part1, int part2) {
    for (int i = 0; i < probe.result.contactCount; i++) {
        const McdContact *k = &probe.contact[i];
        if ((elementOf(k->instance1, probe.model) == part1 || elementOf(k->instance2, probe.ground) == part2) &&
            gapAlongContact(c, part1, part2, k) >= (double)k->separation - 1e-4)
            return METRUE;
    }
    return MEFALSE;
}

static const McdContact *deepestOf(const Probe *p) {
    const McdContact *deepest = 0;
    for (int i = 0; i < p->result.contactCount; i++)
        if (!deepest || p->contact[i].separation < deepest->separation)
            deepest = &p->contact[i];
    return deepest;
}

/* Each pair of parts by itself: its deepest contact, if it is on both surfaces, is found, and, whatever was dropped,
 * what is found separates the two. */
TEST(nothing_on_the_surface_is_lost) {
    static McdRequest all = {TERRAIN_CONTACTS, MEFALSE};
    int outer = 0, inner = 0;
    begin();
    seed = 3;
    for (int scene = 0; scene < 220; scene++) {
        Compound c[2];
        makeCompound(&c[0]);
        makeCompound(&c[1]);
        probe_init(&probe, c[0].geometry, c[1].geometry);
        McdModelPairSetRequestPtr(probe.pair, &all);
        double angle[3], at[3];
        for (int i = 0; i < 3; i++) {
            angle[i] = randomFrom(-3, 3);
            at[i] = i < 2 ? randomFrom(-.6, .6) : randomFrom(.4, 1);
        }
        place(probe.tm, angle, at[0], at[1], at[2]);
        test(&probe);
        for (int i = 0; i < PARTS; i++)
            for (int k = 0; k < PARTS; k++) {
                const Box *a = &c[0].box[i], *b = &c[1].box[k];
                MeMatrix4 relative;
                static const double none[3] = {0, 0, 0};
                probe_init(&solid, boxOf(2 * a->half[0], 2 * a->half[1], 2 * a->half[2]),
                           boxOf(2 * b->half[0], 2 * b->half[1], 2 * b->half[2]));
                place(relative, none, a->at[0], a->at[1], a->at[2]);
                MeMatrix4TMCompound(solid.tm, (const MeVector4 *)relative, (const MeVector4 *)probe.tm);
                place(solid.groundTM, none, b->at[0], b->at[1], b->at[2]);
                if (test(&solid) > 0 && minSeparation(&solid) < 0)
                    ck_assert_msg(isLeft(c, i, k), "scene %d, parts %d and %d", scene, i, k);
                const McdContact *deepest = deepestOf(&solid);
                if (deepest && isOutside(&c[0], i, probe.tm, deepest, -1, gapOf(b)) &&
                    isOutside(&c[1], k, probe.groundTM, deepest, 1, gapOf(a))) {
                    outer++;
                    ck_assert_msg(hasContactAt(deepest), "scene %d, parts %d and %d", scene, i, k);
                } else {
                    inner += deepest && !hasContactAt(deepest);
                }
                probe_term(&solid);
            }
        probe_term(&probe);
    }
    ck_assert_int_gt(outer, 200);
    ck_assert_int_gt(inner, 200);
}
