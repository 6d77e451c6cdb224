/* What slides over a flat surface of triangles does not feel their edges: contacts of McdIntersect in a world without
 * friction. */
#include "Mdt.h"
#include "terrain.h"

#define FRAME ((MeReal)(1.0 / 60))

static const double cell = .37;

typedef struct Slide {
    MdtWorldID world;
    MdtBodyID body;
    MdtBclContactParams params;
    MdtContactID contact[TERRAIN_CONTACTS];
    int contactCount;
    Probe probe;
} Slide;

static void renewContacts(Slide *s) {
    for (int i = 0; i < s->contactCount; i++) {
        MdtContactDisable(s->contact[i]);
        MdtContactDestroy(s->contact[i]);
    }
    s->contactCount = probe_test(&s->probe);
    for (int i = 0; i < s->contactCount; i++) {
        const McdContact *c = &s->probe.contact[i];
        const MdtContactID m = s->contact[i] = MdtContactCreate(s->world);
        MdtContactSetBodies(m, s->body, 0);
        MdtContactSetPosition(m, c->position[0], c->position[1], c->position[2]);
        MdtContactSetNormal(m, c->normal[0], c->normal[1], c->normal[2]);
        MdtContactSetPenetration(m, -c->separation);
        MdtContactSetParams(m, &s->params);
        MdtContactEnable(m);
    }
}

static void start(Slide *s, McdGeometryID shape, McdGeometryID ground, double height, int lying) {
    memset(s, 0, sizeof *s);
    s->world = MdtWorldCreate(1, TERRAIN_CONTACTS);
    MdtWorldSetAutoDisable(s->world, 0);
    MdtWorldSetGravity(s->world, 0, 0, -9.81);
    s->body = MdtBodyCreate(s->world);
    MdtBodySetPosition(s->body, 0, 0, height);
    if (lying)
        MdtBodySetQuaternion(s->body, sqrt(.5), 0, sqrt(.5), 0);
    MdtBodyEnable(s->body);
    MdtContactParamsReset(&s->params);
    probe_init(&s->probe, shape, ground);
    McdModelSetTransformPtr(s->probe.model, MdtBodyGetTransformPtr(s->body));
}

static void end(Slide *s) {
    probe_term(&s->probe);
    MdtWorldDestroy(s->world);
}

/* Five seconds, or as far as the ground reaches. */
static void slide(McdGeometryID shape, McdGeometryID ground, double height, int lying, double speed, double angle) {
    Slide s;
    const double range = 16;
    const int steps = (int)fmin(300, range / speed * 60);
    start(&s, shape, ground, height, lying);
    MdtBodySetLinearVelocity(s.body, speed * cos(angle), speed * sin(angle), 0);
    for (int i = 0; i < steps; i++) {
        MeVector3 v, w, x;
        renewContacts(&s);
        ck_assert_int_gt(s.contactCount, 0);
        for (int k = 0; k < s.contactCount; k++)
            assert_vec3_near(s.probe.contact[k].normal, 0, 0, 1, TOL(5e-7, 9e-16));
        MdtWorldStep(s.world, FRAME);
        MdtBodyGetLinearVelocity(s.body, v);
        MdtBodyGetAngularVelocity(s.body, w);
        MdtBodyGetPosition(s.body, x);
        assert_near_rel(v[0] * cos(angle) + v[1] * sin(angle), speed, TOL(5e-7, 9e-16));
        assert_near(v[1] * cos(angle) - v[0] * sin(angle), 0, TOL(1e-6, 9e-15) * speed);
        assert_near(v[2], 0, 3e-5); /* what the solver leaves */
        assert_near(x[2], height, 3e-6);
        assert_vec3_near(w, 0, 0, 0, TOL(4e-5, 5e-13));
    }
    end(&s);
}

static void slideEveryWay(McdGeometryID shape, McdGeometryID ground, double height, int lying) {
    const double angles[] = {0, .785398163397448, 1.5707963267949, 2.1, 3.9, 5.5}, speeds[] = {.1, 2, 15};
    for (int a = 0; a < 6; a++)
        slide(shape, ground, height, lying, speeds[a % 3], angles[a]);
    slide(shape, ground, height, lying, 1, 1e-3);
}

static McdConvexMeshID prism(McdFrameworkID f) { /* five corners, lying on one side */
    MeVector3 p[10];
    for (int i = 0; i < 10; i++) {
        const double a = -1.5707963267949 + 6.283185307179586 * (i % 5 + .5) / 5;
        MeVector3Set(p[i], i < 5 ? (MeReal)-.6 : (MeReal).6, .5 * cos(a), .5 * sin(a));
    }
    return McdConvexMeshCreateHull(f, (const MeVector3 *)p, 10, 0);
}

static Terrain flat;
static MeReal zeros[101 * 101];

static void onGround(int isField) {
    McdFrameworkID f = terrain_framework();
    McdGeometryID ground;
    memset(&flat, 0, sizeof flat);
    terrain_grid(&flat, 100, cell, 0, kMcdTriangleStandard & ~kMcdTriangleTwoSided);
    ground = isField ? McdRGHeightFieldCreate(f, zeros, 101, 101, cell, cell, -50 * cell, -50 * cell)
                     : terrain_list(f, &flat);
    slideEveryWay(McdBoxCreate(f, 1, 1, 1), ground, .5, 0);
    slideEveryWay(McdBoxCreate(f, .2, .2, .2), ground, .1, 0);
    slideEveryWay(McdSphereCreate(f, .3), ground, .3, 0);
    slideEveryWay(McdSphylCreate(f, .3, 1), ground, .3, 1);
    slideEveryWay(McdCylinderCreate(f, .5, 1), ground, .5, 0);
    slideEveryWay(prism(f), ground, .5 * cos(3.14159265358979 / 5), 0);
}

TEST(over_a_triangle_list) {
    onGround(0);
}

TEST(over_a_height_field) {
    onGround(1);
}
