/* What rolls or slides over facets that rise before it, in pipes and bowls of a mesh: without restitution each facet
 * takes the part of the velocity towards it, and no step gives energy. The energies that are left are those of steps of
 * 1/960 s. */
#include "universe.h"

#include <math.h>

enum { BALL, CYLINDER, CAPSULE, SHAPES };

static const double gravity = 9.8;
static MeMatrix4 place = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
static MeVector3 corner[128 * 128];
static int triangle[2 * 128 * 128][3];

/* A body of the radius r on a surface of 8 r; its energies are relative to the lowest point of its centre. */
typedef struct Path {
    McdModelID body;
    double swing, start; /* m, of the centre; m²/s² */
    double left, max;    /* of the energy at the start */
} Path;

static void addTriangle(int *count, int a, int b, int c) {
    const int of[3] = {a, b, c};
    memcpy(triangle[(*count)++], of, sizeof of);
}

static void begin(double friction) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
}

/* The lower half of a pipe of n facets along y. */
static void addPipe(double radius, int n) {
    int count = 0;
    for (int i = 0; i <= n / 2; i++)
        for (int k = 0; k < 2; k++) {
            const double angle = 2 * (double)ME_PI * i / n;
            MeVector3Set(corner[2 * i + k], (MeReal)(-radius * cos(angle)), (MeReal)((k ? 1 : -1) * radius),
                         (MeReal)(-radius * sin(angle)));
        }
    for (int i = 0; i < n / 2; i++) {
        addTriangle(&count, 2 * i, 2 * i + 2, 2 * i + 3);
        addTriangle(&count, 2 * i, 2 * i + 3, 2 * i + 1);
    }
    MstFixedModelCreate(u, McdMeshCreate(u->frame, (const MeVector3 *)corner, n + 2, &triangle[0][0], count, 0), place);
}

/* A bowl of n facets around. */
static void addBowl(double radius, int n) {
    const int rows = n / 4;
    int count = 0;
    MeVector3Set(corner[0], 0, 0, (MeReal)-radius);
    for (int i = 1; i <= rows; i++)
        for (int k = 0; k < n; k++) {
            const double up = .45 * (double)ME_PI * i / rows, around = 2 * (double)ME_PI * k / n;
            MeVector3Set(corner[1 + (i - 1) * n + k], (MeReal)(radius * sin(up) * cos(around)),
                         (MeReal)(radius * sin(up) * sin(around)), (MeReal)(-radius * cos(up)));
        }
    for (int k = 0; k < n; k++)
        addTriangle(&count, 0, 1 + k, 1 + (k + 1) % n);
    for (int i = 1; i < rows; i++)
        for (int k = 0; k < n; k++) {
            const int a = 1 + (i - 1) * n + k, b = 1 + (i - 1) * n + (k + 1) % n;
            addTriangle(&count, a, a + n, b + n);
            addTriangle(&count, a, b + n, b);
        }
    MstFixedModelCreate(u, McdMeshCreate(u->frame, (const MeVector3 *)corner, 1 + rows * n, &triangle[0][0], count, 0),
                        place);
}

/* m²/s². */
static double energyOf(const Path *p) {
    MeReal kinetic = MdtBodyGetKineticEnergy(McdModelGetBody(p->body));
    MeVector3 at;
    McdModelDynamicsGetPosition(p->body, at);
    return (double)kinetic / (double)MdtBodyGetMass(McdModelGetBody(p->body)) + gravity * ((double)at[2] + p->swing);
}

/* Steps for ten swings. The largest energy is that after half a second, since the start may overlap facets. */
static void follow(Path *p, double inertia, double rate) {
    const double time = 10 * 2 * (double)ME_PI * sqrt((1 + inertia) * p->swing / gravity);
    p->start = energyOf(p);
    p->max = 0;
    for (int i = 0; i < time * rate; i++) {
        MstUniverseStep(u, (MeReal)(1 / rate));
        if (i > .5 * rate)
            p->max = fmax(p->max, energyOf(p) / p->start);
    }
    p->left = energyOf(p) / p->start;
}

/* Of the radius squared: the moment about the axis along which it rolls, over the mass. */
static double inertiaOf(const Path *p, int shape, double r) {
    const MdtBodyID body = McdModelGetBody(p->body);
    const int axis = shape == BALL ? 1 : 2;
    MeMatrix3 tensor;
    MdtBodyGetInertiaTensor(body, tensor);
    return (double)tensor[axis][axis] / ((double)MdtBodyGetMass(body) * r * r);
}

static Path rollInPipe(int shape, double r, int n, double friction, double rate) {
    const double angle = .8;
    Path p = {.swing = 7 * r};
    begin(friction);
    addPipe(8 * r, n);
    const McdGeometryID g = shape == BALL       ? McdSphereCreate(u->frame, (MeReal)r)
                            : shape == CYLINDER ? McdCylinderCreate(u->frame, (MeReal)r, (MeReal)r)
                                                : McdSphylCreate(u->frame, (MeReal)r, (MeReal)r);
    p.body = MstModelAndBodyCreate(u, g, 1000);
    McdModelDynamicsSetPosition(p.body, (MeReal)(p.swing * sin(angle)), 0, (MeReal)(.004 * r - p.swing * cos(angle)));
    if (shape != BALL)
        McdModelDynamicsSetQuaternion(p.body, (MeReal)sqrt(.5), (MeReal)sqrt(.5), 0, 0);
    follow(&p, friction > 0 ? inertiaOf(&p, shape, r) : 0, rate);
    return p;
}

/* Circling, at .8 of the speed at which it would stay as high. */
static Path circleInBowl(double r, int n, double rate) {
    const double angle = .5;
    Path p = {.swing = 7 * r};
    begin(0);
    addBowl(8 * r, n);
    p.body = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, (MeReal)r), 1000);
    McdModelDynamicsSetPosition(p.body, (MeReal)(p.swing * sin(angle)), 0, (MeReal)(-p.swing * cos(angle)));
    McdModelDynamicsSetLinearVelocity(p.body, 0,
                                      (MeReal)(.8 * sqrt(gravity * p.swing * sin(angle) * sin(angle) / cos(angle))), 0);
    follow(&p, 0, rate);
    return p;
}

static void assertLeft(const char *what, const Path *p, double r, int n, double rate, double left, double share) {
    ck_assert_msg(fabs(p->left / left - 1) < share && p->max < 1,
                  "%s of radius %g, %d facets, %g Hz: energy left %g, not %g; largest %g", what, r, n, rate, p->left,
                  left, p->max);
}

/* Gained energy without end: up to 1.9 times that of the start. */
TEST(a_ball_that_circles_in_a_bowl_loses_what_facets_take) {
    static const double radii[] = {1, .3, .1}, rates[] = {30, 60, 120};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const Path few = circleInBowl(radii[i], 64, rates[k]), many = circleInBowl(radii[i], 128, rates[k]);
            assertLeft("bowl", &few, radii[i], 64, rates[k], .6240, .01);
            assertLeft("bowl", &many, radii[i], 128, rates[k], .7665, .01);
        }
}

/* Kept .97 of the energy with 200 facets at 30 Hz. */
TEST(a_ball_in_a_pipe_loses_what_facets_take) {
    for (int i = 0; i < 2; i++) {
        const double rate = i ? 60 : 30, share = i ? .01 : .03;
        const Path few = rollInPipe(BALL, .4, 64, 0, rate), many = rollInPipe(BALL, .4, 200, 0, rate);
        const Path rough = rollInPipe(BALL, .4, 64, 2, rate), fine = rollInPipe(BALL, .4, 200, 2, rate);
        assertLeft("sliding ball", &few, .4, 64, rate, .2461, share);
        assertLeft("sliding ball", &many, .4, 200, rate, .5748, share);
        assertLeft("rolling ball", &rough, .4, 64, rate, .3384, share);
        assertLeft("rolling ball", &fine, .4, 200, rate, .6640, share);
    }
}

/* Kept .2 to .6, by chance: contacts at the diagonals of facets turned them aside, and of those on facets at a small
 * angle to each other the next one took the load of the last. */
TEST(cylinders_and_capsules_in_a_pipe_lose_what_facets_take) {
    static const double radii[] = {.4, .1}, rates[] = {60, 120, 240}, left[2][2] = {{.3581, .3470}, {.6809, .6716}};
    for (int i = 0; i < 3 * 2 * 2; i++) {
        const double r = radii[i % 2], rate = rates[i / 2 % 3];
        const int n = i / 6 ? 200 : 64;
        for (int shape = CYLINDER; shape < SHAPES; shape++) {
            const Path p = rollInPipe(shape, r, n, 2, rate);
            assertLeft(shape == CYLINDER ? "cylinder" : "capsule", &p, r, n, rate, left[i / 6][shape == CAPSULE], .02);
        }
    }
}

/* Gained up to .44. */
TEST(nothing_round_gains_energy_in_a_pipe) {
    static const double radii[] = {.03, .1, .4}, rates[] = {30, 60};
    for (int i = 0; i < 3 * 2 * 2 * 2; i++) {
        const double r = radii[i % 3], rate = rates[i / 3 % 2], friction = i / 6 % 2 ? 2 : 0;
        const int n = i / 12 ? 200 : 64;
        for (int shape = 0; shape < SHAPES; shape++) {
            const Path p = rollInPipe(shape, r, n, friction, rate);
            ck_assert_msg(p.max < 1, "shape %d of radius %g, %d facets, friction %g, %g Hz: %g", shape, r, n, friction,
                          rate, p.max);
        }
    }
}
