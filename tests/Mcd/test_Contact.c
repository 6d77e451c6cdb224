/* What a contact knows beyond its place: how round the surfaces are that meet there, and its separation in double. */
#include "McdInternal.h"
#include "shapes.h"

enum { MAX = 8, ROUND = kMcdGeometryFirstUserType };

typedef struct Probe {
    McdFrameworkID frame;
    McdModelID model[2];
    MeMatrix4 tm[2];
    McdContact contact[MAX];
    McdIntersectResult result;
} Probe;

static void setUp(Probe *p) {
    p->frame = McdInit(1, 10, 10, 1);
    McdAllRegisterTypes(p->frame);
    McdAllRegisterInteractions(p->frame);
}

static void place(Probe *p, int which, McdGeometryID g, MeReal x, MeReal y, MeReal z) {
    p->model[which] = McdModelCreate(g);
    MeMatrix4TMMakeIdentity(p->tm[which]);
    MeVector3Set(p->tm[which][3], x, y, z);
    McdModelSetTransformPtr(p->model[which], p->tm[which]);
}

/* The cylinder's axis, z, to the world's x. */
static void layDown(Probe *p, int which) {
    static const MeReal lying[3][3] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    for (int i = 0; i < 3; i++)
        MeVector3Copy(p->tm[which][i], lying[i]);
}

static const McdContact *meet(Probe *p) {
    McdModelPair pair;
    memset(&pair, 0, sizeof pair);
    memset(p->contact, 0x55, sizeof p->contact); /* what nobody writes is seen */
    for (int i = 0; i < 2; i++)
        McdModelUpdate(p->model[i]);
    pair.model1 = p->model[0];
    pair.model2 = p->model[1];
    memset(&p->result, 0, sizeof p->result);
    p->result.contacts = p->contact;
    p->result.contactMaxCount = MAX;
    ck_assert((McdIntersect)(&pair, &p->result));
    ck_assert_int_gt(p->result.contactCount, 0);
    return p->contact;
}

static void swapModels(Probe *p) {
    const McdModelID first = p->model[0];
    p->model[0] = p->model[1];
    p->model[1] = first;
}

static void clear(Probe *p) {
    for (int i = 0; i < 2; i++) {
        const McdGeometryID g = McdModelGetGeometry(p->model[i]);
        McdModelDestroy(p->model[i]);
        McdGeometryDestroy(g);
    }
}

static void expectExact(const McdContact *c) {
    McdExactContact exact;
    double position[3], axis[3];
    McdContactGetExact(c, &exact);
    McdContactGetPosition(c, position);
    ck_assert(memcmp(position, exact.position, sizeof position) == 0);
    ck_assert(exact.separation == McdContactGetSeparation(c));
    for (int k = 0; k < 2; k++) {
        ck_assert(exact.radius[k] == McdContactGetRadius(c, k) && exact.rim[k] == McdContactGetRim(c, k, axis) &&
                  exact.isVertex[k] == McdContactIsVertex(c, k));
        ck_assert(!(exact.rim[k] > 0) || memcmp(axis, exact.axis[k], sizeof axis) == 0);
    }
}

/* Also after a program has written another place, or another separation. */
static void expectExactOf(const McdContact *c) {
    McdContact written = *c;
    expectExact(c);
    written.position[0] += 1;
    expectExact(&written);
    written.separation -= 1;
    expectExact(&written);
}

/* All contacts of the pair, in both orders. */
static void expectRadii(Probe *p, double first, double second) {
    for (int turned = 0; turned < 2; turned++) {
        const McdContact *c = meet(p);
        for (int i = 0; i < p->result.contactCount; i++) {
            assert_near(McdContactGetRadius(&c[i], turned), first, TOL(1e-7, 1e-12));
            assert_near(McdContactGetRadius(&c[i], !turned), second, TOL(1e-7, 1e-12));
            expectExactOf(&c[i]);
        }
        swapModels(p);
    }
    clear(p);
}

static const MeReal thin = .01;

TEST(round_surfaces_have_their_radius) {
    Probe p;
    setUp(&p);
    place(&p, 0, McdSphereCreate(p.frame, .5), 0, 0, .5);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    expectRadii(&p, .5, 0);
    place(&p, 0, McdSphereCreate(p.frame, .5), 0, 0, .5);
    place(&p, 1, McdSphereCreate(p.frame, .25), 0, 0, -.25);
    expectRadii(&p, .5, .25);
    place(&p, 0, McdSphereCreate(p.frame, .5), 0, 0, (MeReal).5 + thin);
    place(&p, 1, McdBoxCreate(p.frame, 1, 1, 1), 0, 0, -.5);
    expectRadii(&p, .5, 0);
    place(&p, 0, McdSphylCreate(p.frame, .2, 1), 0, 0, .2);
    layDown(&p, 0);
    place(&p, 1, McdBoxCreate(p.frame, 3, 1, 1), 0, 0, -.5);
    expectRadii(&p, .2, 0);
    place(&p, 0, boxMesh(p.frame, fatSize, 1, fat), 0, 0, .55);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    expectRadii(&p, .25, 0);
    McdTerm(p.frame);
}

TEST(cylinders_are_round_on_their_side_only) {
    Probe p;
    setUp(&p);
    for (int lying = 0; lying < 2; lying++) {
        place(&p, 0, McdCylinderCreate(p.frame, .3, 1), 0, 0, lying ? (MeReal).3 : (MeReal).5);
        if (lying)
            layDown(&p, 0);
        place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
        expectRadii(&p, lying ? .3 : 0, 0);
    }
    /* on its rim, tilted by a tenth of a turn: no ball is rolling there */
    place(&p, 0, McdCylinderCreate(p.frame, .3, 1), 0, 0, .52);
    MeMatrix4TMSetRotationFromQuaternion(p.tm[0], (MeVector4){.951057, .309017, 0, 0});
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    expectRadii(&p, 0, 0);
    McdTerm(p.frame);
}

/* r / cos(half angle) where it touches: between both ends of the line. */
TEST(cones_are_as_round_as_they_are_wide_there) {
    Probe p;
    const double length = 1, low = .4, high = .2, slant = hypot(length, low - high), cosine = length / slant;
    setUp(&p);
    place(&p, 0, cutCone(p.frame, length, low, high), 0, 0, 0);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    const double turn = acos(0) + asin((low - high) / slant); /* its side down */
    MeMatrix4TMSetRotationFromQuaternion(p.tm[0], (MeVector4){cos(turn / 2), sin(turn / 2), 0, 0});
    MeVector3 down = {0, 0, -1}, lowest;
    McdGeometryMaximumPoint(McdModelGetGeometry(p.model[0]), (const MeVector4 *)p.tm[0], down, lowest);
    p.tm[0][3][2] -= lowest[2];
    const McdContact *c = meet(&p);
    ck_assert_int_eq(p.result.contactCount, 2);
    const double a = McdContactGetRadius(&c[0], 0), b = McdContactGetRadius(&c[1], 0);
    assert_near(fmax(a, b), low / cosine, TOL(1e-6, 1e-12));
    assert_near(fmin(a, b), high / cosine, TOL(1e-6, 1e-12));
    clear(&p);
    McdTerm(p.frame);
}

static void turnAboutX(double v[3], double angle) {
    const double y = v[1];
    v[1] = cos(angle) * y - sin(angle) * v[2];
    v[2] = sin(angle) * y + cos(angle) * v[2];
}

/* Turns a transform about a line through a point, along the world's x. */
static void turnAbout(MeMatrix4 tm, const double point[3], double angle) {
    for (int row = 0; row < 4; row++) {
        double v[3];
        for (int k = 0; k < 3; k++)
            v[k] = (double)tm[row][k] - (row == 3 ? point[k] : 0);
        turnAboutX(v, angle);
        for (int k = 0; k < 3; k++)
            tm[row][k] = (MeReal)(v[k] + (row == 3 ? point[k] : 0));
    }
}

static McdGeometryID roller(McdFrameworkID f, int kind) {
    const MeReal r = .3;
    return kind == 0 ? McdSphereCreate(f, r) : kind == 1 ? McdCylinderCreate(f, r, 1) : McdSphylCreate(f, r, 1);
}

/* What the radius is for: a turn about the middle of the circle changes neither the place nor the separation. */
TEST(a_turn_about_the_middle_of_the_circle_leaves_the_contact) {
    Probe p;
    setUp(&p);
    for (int kind = 0; kind < 3; kind++) {
        double middle[3];
        place(&p, 0, roller(p.frame, kind), .1, .2, .295);
        layDown(&p, 0);
        place(&p, 1, McdBoxCreate(p.frame, 4, 4, 1), 0, 0, -.5);
        const McdContact before = meet(&p)[0];
        const double out = McdContactGetSeparation(&before) / 2 + McdContactGetRadius(&before, 0);
        for (int k = 0; k < 3; k++)
            middle[k] = (double)before.position[k] + out * (double)before.normal[k];
        turnAbout(p.tm[0], middle, .2);
        const McdContact *after = meet(&p);
        assert_near(McdContactGetSeparation(after), McdContactGetSeparation(&before), TOL(1e-7, 1e-12));
        assert_vec3_near(after->position, before.position[0], before.position[1], before.position[2], TOL(1e-6, 1e-12));
        clear(&p);
    }
    McdTerm(p.frame);
}

TEST(triangles_and_parts_of_aggregates_pass_radii_on) {
    static const MeReal flat[9] = {0};
    Probe p;
    setUp(&p);
    place(&p, 0, McdSphereCreate(p.frame, .5), .9, 1.2, .5);
    place(&p, 1, McdRGHeightFieldCreate(p.frame, flat, 3, 3, 1, 1, 0, 0), 0, 0, 0);
    expectRadii(&p, .5, 0);
    MeMatrix4 up;
    MeMatrix4TMMakeIdentity(up);
    up[3][2] = 1;
    const McdGeometryID ball = McdSphereCreate(p.frame, .5), pole = McdAggregateCreate(p.frame, 1);
    McdAggregateAddElement(pole, ball, up);
    place(&p, 0, pole, 0, 0, -.5);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    expectRadii(&p, .5, 0);
    McdGeometryDestroy(ball);
    McdTerm(p.frame);
}

/* From what single precision knows of both balls' places; the separation itself is rounded after that. */
/* Its axis leans by `lean` from the normal of the plane; lower rim on it. Returns what it touches with. */
static double rimOf(double lean, double axis[3]) {
    const double c = cos(lean), s = sin(lean);
    double rim;
    Probe p;
    setUp(&p);
    place(&p, 0, McdCylinderCreate(p.frame, 2, 1), 0, 0, .5 * c + 2 * s);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    MeVector3Set(p.tm[0][0], c, 0, -s);
    MeVector3Set(p.tm[0][2], s, 0, c);
    const McdContact *contact = meet(&p);
    ck_assert(McdContactGetRim(contact, 1, axis) == 0);
    rim = McdContactGetRim(contact, 0, axis);
    expectExactOf(contact);
    clear(&p);
    McdTerm(p.frame);
    return rim;
}

TEST(a_leaning_disc_touches_with_its_rim) {
    double axis[3] = {7, 7, 7};
    ck_assert(rimOf(0, axis) == 0);
    assert_vec3_near(axis, 7, 7, 7, 0);
    assert_near(rimOf(.5, axis), 2, TOL(1e-6, 1e-12));
    assert_vec3_near(axis, sin(.5), 0, cos(.5), TOL(1e-7, 1e-12));
}

/* A box that leans, by its lower edge or on a corner, on a plane; on the edge of another box; and a disc. */
TEST(vertices_are_told_from_edges_and_rims) {
    for (int kind = 0; kind < 4; kind++) {
        const double lean = kind == 3 ? .5 : .3, c = cos(lean), s = sin(lean);
        Probe p;
        setUp(&p);
        const McdGeometryID shape =
            kind == 3 ? McdCylinderCreate(p.frame, 2, 1) : McdBoxCreate(p.frame, 2, kind == 2 ? 20 : 2, 2);
        place(&p, 0, shape, 0, 0, kind == 3 ? .5 * c + 2 * s : kind == 2 ? 1 + c + s : c + s);
        place(&p, 1, kind == 2 ? McdBoxCreate(p.frame, 20, 2, 2) : McdPlaneCreate(p.frame), 0, 0, 0);
        MeVector3Set(p.tm[0][0], c, 0, -s);
        MeVector3Set(p.tm[0][2], s, 0, c);
        const McdContact *contact = meet(&p);
        ck_assert(!McdContactIsVertex(contact, 0) == (kind >= 2) && !McdContactIsVertex(contact, 1));
        expectExactOf(contact);
        clear(&p);
        McdTerm(p.frame);
    }
}

TEST(the_separation_is_told_in_double) {
    Probe p;
    const MeReal x = .1, y = (MeReal).2, z = (MeReal).4, radius = (MeReal).23;
    setUp(&p);
    place(&p, 0, McdSphereCreate(p.frame, radius), x, y, z);
    place(&p, 1, McdSphereCreate(p.frame, radius), 0, 0, 0);
    const double exact =
        sqrt((double)x * (double)x + (double)y * (double)y + (double)z * (double)z) - 2 * (double)radius;
    const McdContact *c = meet(&p);
    assert_near(McdContactGetSeparation(c), exact, 1e-15);
    assert_near(c->separation, exact, TOL(1e-10, 1e-15));
    ck_assert(sizeof(MeReal) == sizeof(double) || McdContactGetSeparation(c) != (double)c->separation);
    clear(&p);
    McdTerm(p.frame);
}

/* Of balls that are alike it is half way between them; a coordinate that a program writes counts. */
TEST(the_position_is_told_in_double) {
    Probe p;
    const MeReal place0[3] = {.1, .2, .4};
    double position[3];
    setUp(&p);
    place(&p, 0, McdSphereCreate(p.frame, .23), place0[0], place0[1], place0[2]);
    place(&p, 1, McdSphereCreate(p.frame, .23), 0, 0, 0);
    McdContact c = *meet(&p);
    McdContactGetPosition(&c, position);
    for (int i = 0; i < 3; i++)
        assert_near(position[i], (double)place0[i] / 2, 1e-15);
    c.position[1] = 7;
    McdContactGetPosition(&c, position);
    assert_near(position[0], (double)place0[0] / 2, 1e-15);
    assert_near(position[1], 7, 0);
    clear(&p);
    McdTerm(p.frame);
}

/* ---- what programs make themselves ------------------------------------------------------------------------------- */

static int MEAPI touchOnce(McdModelPair *pair, McdIntersectResult *result) {
    McdContact *c = result->contacts;
    (void)pair;
    MeVector3Set(c->position, 0, 0, 0);
    MeVector3Set(c->normal, 0, 0, 1);
    c->separation = (MeReal)-.125;
    result->contactCount = result->touch = 1;
    return 1;
}

TEST(contacts_of_a_programs_own_interaction_are_not_round) {
    Probe p;
    McdInteractions own = {.intersectFn = touchOnce};
    setUp(&p);
    McdFrameworkSetInteractions(p.frame, kMcdGeometryTypeSphere, kMcdGeometryTypeSphere, &own);
    place(&p, 0, McdSphereCreate(p.frame, 1), 0, 0, 0);
    place(&p, 1, McdSphereCreate(p.frame, 1), 0, 0, 0);
    const McdContact *c = meet(&p);
    ck_assert(McdContactGetSeparation(c) == -.125);
    ck_assert(McdContactGetRadius(c, 0) == 0 && McdContactGetRadius(c, 1) == 0);
    clear(&p);
    McdTerm(p.frame);
}

static void MEAPI writeSeparation(McdModelID model, McdIntersectResult *result) {
    (void)model;
    result->contacts[0].separation = (MeReal).25;
}

TEST(a_separation_that_a_program_writes_counts) {
    Probe p;
    setUp(&p);
    place(&p, 0, McdSphereCreate(p.frame, 1), 0, 0, 1);
    place(&p, 1, McdPlaneCreate(p.frame), 0, 0, 0);
    McdModelSetIntersectCallback(p.model[0], writeSeparation);
    const McdContact *c = meet(&p);
    ck_assert(McdContactGetSeparation(c) == .25);
    ck_assert(McdContactGetRadius(c, 0) == 0);
    clear(&p);
    McdTerm(p.frame);
}

TEST(what_is_no_contact_or_no_side_gets_a_warning) {
    McdContact c;
    memset(&c, 0, sizeof c);
    ck_assert(McdContactGetSeparation(0) == 0);
    assert_warned("McdContactGetSeparation: no contact");
    ck_assert(McdContactGetRadius(0, 0) == 0);
    assert_warned("McdContactGetRadius: no contact");
    ck_assert(McdContactGetRadius(&c, 2) == 0);
    assert_warned("McdContactGetRadius: side must be 0");
    ck_assert(!McdContactIsVertex(0, 0));
    assert_warned("McdContactIsVertex: no contact");
    ck_assert(!McdContactIsVertex(&c, 2));
    assert_warned("McdContactIsVertex: side must be 0");
    double axis[3];
    ck_assert(!McdContactGetEdge(0, 0, axis));
    assert_warned("McdContactGetEdge: no contact");
    ck_assert(!McdContactGetEdge(&c, 2, axis));
    assert_warned("McdContactGetEdge: side must be 0");
    ck_assert(!McdContactGetEdge(&c, 1, 0));
    assert_warned("McdContactGetEdge: no place for the axis");
    ck_assert(McdContactGetRim(0, 0, axis) == 0);
    assert_warned("McdContactGetRim: no contact");
    ck_assert(McdContactGetRim(&c, 2, axis) == 0);
    assert_warned("McdContactGetRim: side must be 0");
    ck_assert(McdContactGetRim(&c, 0, 0) == 0);
    assert_warned("McdContactGetRim: no place for the axis");
    double position[3] = {1, 2, 3};
    McdContactGetPosition(0, position);
    assert_warned("McdContactGetPosition: no contact");
    assert_vec3_near(position, 1, 2, 3, 0);
    McdContactGetPosition(&c, 0);
    assert_warned("McdContactGetPosition: no place");
}
