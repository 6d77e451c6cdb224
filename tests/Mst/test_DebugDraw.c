/* What is drawn of a simulation, recorded: each layer against what the simulation says of itself. */
#include "universe.h"
#include "MeDebugDraw.h"

enum { MAX = 4096 };
typedef struct {
    int kind; /* 1 point, 2 line, 3 triangle, 4 text */
    double p[3][3];
    float color[4];
    char text[64];
} Mark;

static Mark marks[MAX];
static int count;
static MeMatrix4 ground;

static Mark *mark(int kind, const float color[4]) {
    ck_assert_int_lt(count, MAX);
    Mark *m = &marks[count++];
    m->kind = kind;
    memcpy(m->color, color, sizeof m->color);
    return m;
}

static void put(double to[3], const MeVector3 from) {
    for (int i = 0; i < 3; i++) {
        ck_assert(MeRealIsValid(from[i]));
        to[i] = (double)from[i];
    }
}

static void MEAPI onLine(void *userdata, const MeVector3 a, const MeVector3 b, const float color[4]) {
    ck_assert_ptr_eq(userdata, marks);
    Mark *m = mark(2, color);
    put(m->p[0], a);
    put(m->p[1], b);
}

static void MEAPI onPoint(void *userdata, const MeVector3 p, const float color[4]) {
    ck_assert_ptr_eq(userdata, marks);
    put(mark(1, color)->p[0], p);
}

static void MEAPI onTriangle(void *userdata, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                             const float color[4]) {
    ck_assert_ptr_eq(userdata, marks);
    Mark *m = mark(3, color);
    put(m->p[0], a);
    put(m->p[1], b);
    put(m->p[2], c);
}

static void MEAPI onText(void *userdata, const MeVector3 p, const char *text, const float color[4]) {
    ck_assert_ptr_eq(userdata, marks);
    Mark *m = mark(4, color);
    put(m->p[0], p);
    snprintf(m->text, sizeof m->text, "%s", text);
}

static const MstDebugDraw table = {
    .line = onLine, .point = onPoint, .triangle = onTriangle, .text = onText, .userdata = marks};

static int draw(unsigned int layers) {
    count = 0;
    MstDebugDrawUniverse(u, layers, &table);
    return count;
}

static int countOf(int kind) {
    int n = 0;
    for (int i = 0; i < count; i++)
        n += marks[i].kind == kind;
    return n;
}

static double away(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void setUp(void) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MeMatrix4TMMakeIdentity(ground);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0.5, 0);
}

TEST_FIXTURE(setUp, NULL)

static McdModelID box(double x, double y, double z) {
    McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 1, 1, 1), 2);
    McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

static void floorUnder(void) {
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground);
}

static void run(int steps) {
    universe_step(steps);
}

TEST(contacts_and_their_forces) {
    floorUnder();
    box(0, 0, 0.5);
    run(5);
    draw(MstDebugContacts);
    ck_assert_int_eq(countOf(1), 4);
    ck_assert_int_eq(countOf(2), 4);
    for (int i = 0; i < count; i++) {
        const Mark *m = &marks[i];
        assert_near(fabs(m->p[0][0]), 0.5, 1e-4); /* The corners. */
        assert_near(fabs(m->p[0][1]), 0.5, 1e-4);
        assert_near(m->p[0][2], 0, 1e-4);
        if (m->kind == 2)
            assert_near(fabs(m->p[1][2]), 0.2, 1e-4);
    }
    draw(MstDebugForces);
    double sum = 0;
    for (int i = 0; i < count; i += 3) /* An arrow is three lines, its shaft first. */
        sum += marks[i].p[1][2] - marks[i].p[0][2];
    assert_near(sum, 0.1 * 9.81, TOL(1e-4, 1e-6));
}

/* With a length of 1 N, a body of any mass has arrows as long as its weight says. */
TEST(forces_have_a_scale) {
    static const double lengths[] = {0.001, 0.5};
    MstDebugDraw scaled = table;
    floorUnder();
    box(0, 0, 0.5);
    run(5);
    for (int k = 0; k < 2; k++) {
        double sum = 0;
        scaled.forceLength = (MeReal)lengths[k];
        count = 0;
        MstDebugDrawUniverse(u, MstDebugForces, &scaled);
        for (int i = 0; i < count; i += 3)
            sum += marks[i].p[1][2] - marks[i].p[0][2];
        assert_near(sum / lengths[k], 2 * 9.81, TOL(1e-3, 1e-5));
    }
    scaled.forceLength = -1;
    MstDebugDrawUniverse(u, MstDebugForces, &scaled);
    assert_warned("MstDebugDrawUniverse: forceLength");
}

/* The two barbs of an arrow are of its size, also of aslant forces. */
TEST(heads_of_arrows_are_in_proportion) {
    MstDebugDraw scaled = table;
    floorUnder();
    MdtWorldSetGravity(u->world, 4, 2, -9);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 1, 0);
    MdtBodySetMass(McdModelGetBody(box(0, 0, 0.5)), 100);
    run(5);
    scaled.forceLength = (MeReal).01;
    count = 0;
    MstDebugDrawUniverse(u, MstDebugForces, &scaled);
    ck_assert_int_gt(count, 3);
    for (int i = 0; i < count; i += 3)
        for (int barb = 1; barb < 3; barb++)
            assert_near(away(marks[i + barb].p[0], marks[i + barb].p[1]) / away(marks[i].p[0], marks[i].p[1]),
                        sqrt(.05), TOL(1e-4, 1e-12));
}

/* Of one body, each layer draws what it draws of all bodies, without that of the others. */
TEST(one_body_alone) {
    enum { LAYERS = 12 };
    MstDebugDraw alone = table;
    floorUnder();
    alone.only = McdModelGetBody(box(0, 0, 0.5));
    const MdtHingeID hinge = MdtHingeCreate(u->world);
    MdtHingeSetBodies(hinge, alone.only, 0);
    MdtHingeSetAxis(hinge, 0, 0, 1);
    MdtHingeEnable(hinge);
    const McdModelID other = box(9, 0, 0.5);
    MdtBodySetAngularVelocity(McdModelGetBody(other), 0, 0, 1);
    MdtBodySetAngularVelocity(alone.only, 0, 0, 1);
    MdtWorldEnableReport(u->world);
    run(5);
    for (int i = 0; i < LAYERS; i++) {
        const int all = draw(1u << i);
        count = 0;
        MstDebugDrawUniverse(u, 1u << i, &alone);
        ck_assert_int_gt(count, i == 5 ? -1 : 0); /* The hinge has no limits. */
        ck_assert(count < all || i == 4 || i == 5);
        for (int k = 0; k < count; k++)
            assert_below(marks[k].p[0][0], 5);
    }
}

TEST(boxes_and_shapes) {
    floorUnder();
    box(3, 0, 5);
    run(1);
    MeVector3 low, high;
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(u->space, &it);
    while (McdSpaceGetModel(u->space, &it, &m))
        if (McdModelGetBody(m))
            McdModelGetAABB(m, low, high);
    draw(MstDebugShapes);
    int near = 0;
    for (int i = 0; i < count; i++)
        near += fabs(marks[i].p[0][0] - 3) < 0.51 && marks[i].p[0][2] > 4;
    ck_assert_int_eq(near, 12);
    draw(MstDebugBoxes);
    near = 0;
    for (int i = 0; i < count; i++) {
        if (marks[i].p[0][2] < 4 || marks[i].p[0][2] > 6)
            continue;
        near++;
        for (int k = 0; k < 3; k++)
            ck_assert(marks[i].p[0][k] == (double)low[k] || marks[i].p[0][k] == (double)high[k]);
    }
    ck_assert_int_eq(near, 12);
}

static MdtHingeID hinge(MdtBodyID b1, MdtBodyID b2) {
    MdtHingeID h = MdtHingeCreate(u->world);
    MdtHingeSetBodies(h, b1, b2);
    MdtHingeSetPosition(h, 0, 0, 2);
    MdtHingeSetAxis(h, 0, 1, 0);
    MdtLimitID limit = MdtHingeGetLimit(h);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), -0.5);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), 1.2);
    MdtLimitActivateLimits(limit, METRUE);
    MdtHingeEnable(h);
    return h;
}

/* The sector stands still in the world, whichever body is the world and however far the other one turns; the needle is
 * as far from its edge as the joint from its stop. */
TEST(a_hinges_sector_is_where_its_stops_are) {
    for (int first = 0; first < 2; first++) {
        double edges[2][2][3];
        const McdModelID m = box(0, 0, 2);
        const MdtBodyID b = McdModelGetBody(m);
        const MdtHingeID h = first ? hinge(0, b) : hinge(b, 0);
        MdtWorldSetGravity(u->world, 0, 0, 0);
        for (int later = 0; later < 2; later++) {
            run(1);
            draw(MstDebugLimits);
            ck_assert_int_eq(countOf(3), 16);
            ck_assert_int_eq(countOf(4), 1);
            const Mark *needle = &marks[0];
            int begin = 0, end = 0;
            for (int i = count - 1; i >= 0; i--)
                begin = marks[i].kind == 3 ? i : begin;
            for (int i = 0; i < count; i++)
                end = marks[i].kind == 3 ? i : end;
            memcpy(edges[later][0], marks[begin].p[1], sizeof edges[0][0]);
            memcpy(edges[later][1], marks[end].p[2], sizeof edges[0][0]);
            const double angle = MdtLimitGetPosition(MdtHingeGetLimit(h));
            /* The chord of the angle from the lower stop. */
            assert_near(away(needle->p[1], edges[later][0]), 2 * 0.4 * sin((angle + 0.5) / 2), 1e-4);
            assert_near(away(needle->p[1], edges[later][1]), 2 * 0.4 * sin((1.2 - angle) / 2), 1e-4);
            ck_assert_int_lt(abs((int)lround(atof(marks[1].text) - angle * 57.29578)), 1);
            if (!later)
                MdtBodySetAngularVelocity(b, 0, first ? (MeReal)-2 : 2, 0);
            run(later ? 0 : 20);
            ck_assert(later || (double)MdtLimitGetPosition(MdtHingeGetLimit(h)) > 0.5);
        }
        for (int k = 0; k < 2; k++)
            assert_near(away(edges[0][k], edges[1][k]), 0, 1e-4);
        MdtHingeDestroy(h);
        MstModelAndBodyDestroy(m);
    }
}

TEST(joints_have_axes_and_lead_to_their_bodies) {
    const MdtBodyID b = McdModelGetBody(box(1, 0, 2));
    hinge(b, 0);
    draw(MstDebugJoints);
    ck_assert_int_eq(count, 4 + 12 + 2); /* To the only body, the axis, the strokes of its head; the sense. */
    assert_near(away(marks[0].p[0], (double[3]){1, 0, 2}), 0, 1e-6);
    assert_near(away(marks[0].p[1], (double[3]){0, 0, 2}), 0, 1e-6);
    assert_near(away(marks[1].p[1], (double[3]){0, 0.4, 2}), 0, 1e-6);
    MdtPrismaticID slider = MdtPrismaticCreate(u->world);
    MdtPrismaticSetBodies(slider, McdModelGetBody(box(5, 0, 0)), 0);
    MdtPrismaticSetAxis(slider, 1, 0, 0);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(MdtPrismaticGetLimit(slider)), -1);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(MdtPrismaticGetLimit(slider)), 2);
    MdtLimitActivateLimits(MdtPrismaticGetLimit(slider), METRUE);
    MdtPrismaticEnable(slider);
    draw(MstDebugLimits);
    ck_assert_int_eq(countOf(1), 2); /* The ends of the track. */
    for (int i = 0, end = 0; i < count; i++)
        if (marks[i].kind == 1)
            assert_near(marks[i].p[0][0], end++ ? 7 : 4, 1e-5);
    MdtConeLimitID cone = MdtConeLimitCreate(u->world);
    MdtConeLimitSetBodies(cone, b, 0);
    MdtConeLimitSetAxis(cone, 0, 0, 1);
    MdtConeLimitSetConeHalfAngle(cone, 0.6);
    MdtConeLimitEnable(cone);
    draw(MstDebugLimits);
    int sides = 0;
    for (int i = 0; i < count; i++) {
        const double *at = marks[i].p[0], *end = marks[i].p[2];
        if (marks[i].kind != 3 || fabs(at[0] - 1) > 1e-5)
            continue;
        sides++;
        assert_near(end[2] - at[2], 0.4 * cos(0.6), 1e-5);
    }
    ck_assert_int_eq(sides, 16);
}

/* A rope goes from its ends to the wheels, and between them. */
TEST(ropes) {
    MdtPulleyID pulley = MdtPulleyCreate(u->world);
    MdtPulleySetBodies(pulley, McdModelGetBody(box(0, 1, 0)), McdModelGetBody(box(2, 1, 0)));
    MdtPulleySetWheel(pulley, 0, 0, 4, 0);
    MdtPulleySetWheel(pulley, 1, 2, 5, 0);
    MdtPulleyEnable(pulley);
    draw(MstDebugLimits);
    ck_assert_int_eq(countOf(1), 2);
    double length = 0;
    for (int i = 0; i < count; i++)
        length += marks[i].kind == 2 ? away(marks[i].p[0], marks[i].p[1]) : 0;
    assert_near(length, 3 + 4 + sqrt(5), 1e-5);
}

/* The direction of the last line of an arrow's shaft; `from` is its first point. */
static void lastStroke(int first, int strokes, double way[3]) {
    for (int k = 0; k < 3; k++)
        way[k] = marks[first + strokes - 1].p[1][k] - marks[first].p[0][k];
}

/* The arrow of a hinge shows where a point of the moving body goes as the angle grows, the one of a slider where the
 * body goes, whichever body is the world. The arrows of the limits begin at zero and end where the joint is. */
TEST(the_sense_of_a_coordinate_is_seen) {
    MdtWorldSetGravity(u->world, 0, 0, 0);
    for (int first = 0; first < 2; first++) {
        const McdModelID m = box(0, 0, 2);
        const MdtBodyID b = McdModelGetBody(m);
        const MdtHingeID h = first ? hinge(0, b) : hinge(b, 0);
        double way[3], half[3];
        draw(MstDebugJoints);
        lastStroke(4, 12, way); /* After the line to the body and the axis. */
        double start[3];
        for (int k = 0; k < 3; k++) { /* From the axis, which is along y, to where the arc begins. */
            half[k] = marks[4].p[0][k] - (k == 2 ? 2 : k == 1 ? 0.2 : 0);
            start[k] = half[k];
        }
        assert_near(sqrt(start[0] * start[0] + start[2] * start[2]), 0.15, 1e-6);
        MdtBodySetAngularVelocity(b, 0, first ? -1 : 1, 0);
        run(15);
        const double angle = MdtLimitGetPosition(MdtHingeGetLimit(h));
        assert_near(angle, 0.25, 1e-3);
        /* omega x r, of the motion that made the angle positive. */
        const double spin = first ? -1 : 1, moved[3] = {spin * start[2], 0, -spin * start[0]};
        ck_assert(way[0] * moved[0] + way[2] * moved[2] > 0.01);
        draw(MstDebugLimits);
        int arc = -1;
        for (int i = 0; i < count && arc < 0;
             i++) /* The first line in orange is where zero is, the next one the arc. */
            arc = marks[i].kind == 2 && marks[i].color[1] < 0.7f && marks[i].color[0] > 0.9f ? i + 1 : -1;
        ck_assert_int_gt(arc, 0);
        const double *needle = marks[0].p[1], *end = marks[arc + 11].p[1];
        const double hub[3] = {0, 0, 2};
        for (int k = 0; k < 3; k++)
            assert_near(end[k] - hub[k], 0.75 * (needle[k] - hub[k]), TOL(1e-5, 1e-12));
        assert_near(away(marks[arc].p[0], end), 2 * 0.3 * sin(angle / 2), TOL(1e-5, 1e-12));
        MdtHingeDestroy(h);
        MdtPrismaticID slider = MdtPrismaticCreate(u->world);
        MdtPrismaticSetBodies(slider, first ? 0 : b, first ? b : 0);
        MdtPrismaticSetAxis(slider, 1, 0, 0);
        MdtLimitCalculatePosition(MdtPrismaticGetLimit(slider), METRUE);
        MdtPrismaticEnable(slider);
        draw(MstDebugJoints);
        MdtBodySetAngularVelocity(b, 0, 0, 0);
        MdtBodySetLinearVelocity(b, first ? -1 : 1, 0, 0);
        ck_assert((marks[4].p[1][0] - marks[4].p[0][0]) * (first ? -1 : 1) > 0.29);
        run(15);
        assert_near(MdtLimitGetPosition(MdtPrismaticGetLimit(slider)), 0.25, TOL(1e-5, 1e-9));
        draw(MstDebugLimits);
        ck_assert_int_eq(countOf(2), 3);
        assert_near(marks[1].p[1][0] - marks[1].p[0][0], first ? -0.25 : 0.25, TOL(1e-5, 1e-9));
        MdtPrismaticDestroy(slider);
        MstModelAndBodyDestroy(m);
    }
}

TEST(bodies_have_centres_and_velocities) {
    const McdModelID m = box(1, 2, 3);
    MdtBodySetLinearVelocity(McdModelGetBody(m), 5, 0, 0);
    MdtBodySetAngularVelocity(McdModelGetBody(m), 0, 0, 3);
    draw(MstDebugCentresOfMass);
    ck_assert_int_eq(countOf(1), 1);
    ck_assert_int_eq(countOf(2), 3);
    assert_near(away(marks[0].p[0], (double[3]){1, 2, 3}), 0, 1e-6);
    draw(MstDebugVelocities);
    ck_assert_int_eq(countOf(2), 6);
    assert_near(away(marks[0].p[1], (double[3]){1.5, 2, 3}), 0, 1e-5);
    assert_near(away(marks[3].p[1], (double[3]){1, 2, 3.3}), 0, 1e-5);
}

/* The colour of the outline of the model that is nearest to a place. */
static const float *colorAt(unsigned int layers, double x) {
    draw(layers);
    for (int i = 0; i < count; i++)
        if (fabs(marks[i].p[0][0] - x) < 0.6 && marks[i].p[0][2] < 3)
            return marks[i].color;
    ck_abort_msg("nothing is drawn there");
    return 0;
}

static int sameColor(const float a[4], const float b[4]) {
    return memcmp(a, b, 4 * sizeof *a) == 0;
}

TEST(outlines_tell_of_partitions_sleep_and_solver) {
    float a[4], b[4], c[4];
    box(-5, 0, 0.5);
    box(5, 0, 0.5);
    box(5, 0, 1.5);
    floorUnder();
    MdtWorldEnableReport(u->world);
    run(1);
    memcpy(a, colorAt(MstDebugPartitions, -5), sizeof a);
    memcpy(b, colorAt(MstDebugPartitions, 5), sizeof b);
    ck_assert(!sameColor(a, b));
    memcpy(a, colorAt(MstDebugSleep, 5), sizeof a);
    memcpy(c, colorAt(MstDebugSolver, 5), sizeof c);
    MdtReport r;
    ck_assert(MdtWorldGetReport(u->world, &r) && r.rows > 0);
    run(120);
    ck_assert_int_eq(MdtWorldGetEnabledBodies(u->world), 0);
    memcpy(b, colorAt(MstDebugSleep, 5), sizeof b);
    ck_assert(!sameColor(a, b));
    ck_assert(!sameColor(c, colorAt(MstDebugSolver, 5))); /* It was solved, and is not any more. */
}

TEST(names) {
    floorUnder();
    hinge(McdModelGetBody(box(1, 0, 2)), 0);
    run(1);
    draw(MstDebugNames);
    int boxes = 0, hinges = 0;
    for (int i = 0; i < count; i++) {
        ck_assert_int_eq(marks[i].kind, 4);
        boxes += strncmp(marks[i].text, "Box", 3) == 0 || strncmp(marks[i].text, "box", 3) == 0;
        hinges += strcmp(marks[i].text, "hinge") == 0;
    }
    ck_assert_int_eq(boxes, 1);
    ck_assert_int_eq(hinges, 1);
}

/* Drawn or not, the same bits; what others draw with is put back; a table of one function is enough. */
TEST(drawing_changes_nothing) {
    static const MstDebugDraw onlyLines = {.line = onLine, .userdata = marks};
    MeVector3 p[2];
    for (int drawn = 0; drawn < 2; drawn++) {
        universe_begin(&MstUniverseGrowingSizes);
        MdtWorldSetGravity(u->world, 0, 0, -9.81);
        floorUnder();
        const McdModelID m = box(0, 0, 1);
        box(0.3, 0.2, 2.1);
        hinge(McdModelGetBody(m), 0);
        const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
        for (int i = 0; i < 60; i++) {
            run(1);
            if (drawn)
                ck_assert_int_gt(draw(MstDebugAll & ~(unsigned int)MstDebugSolver), 20);
            count = 0;
            if (drawn)
                MstDebugDrawParts(u->world, u->space, 1, MstDebugAll, &onlyLines);
            ck_assert_int_eq(countOf(2), count);
        }
        ck_assert(MeDebugDrawAPI.line == before);
        McdModelDynamicsGetPosition(m, p[drawn]);
    }
    ck_assert_int_eq(memcmp(p[0], p[1], sizeof p[0]), 0);
}

TEST(bad_input) {
    MstDebugDrawUniverse(0, MstDebugShapes, &table);
    assert_warned("null");
    MstDebugDrawUniverse(u, MstDebugShapes, 0);
    assert_warned("draw is null");
    MstDebugDrawUniverse(u, 4096, &table);
    assert_warned("layers");
    MstDebugDrawParts(u->world, u->space, 0, MstDebugShapes, &table);
    assert_warned("lengthScale");
    MstDebugDrawParts(0, 0, 1, MstDebugAll, &table); /* Nothing, silently. */
}
