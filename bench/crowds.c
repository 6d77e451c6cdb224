/* What crowds of one kind of body cost in a universe while they fall into a pit, settle, and are shaken there.
 *
 *     crowds [--kind balls|capsules|cylinders|hulls|chairs|sizes|masses] [--bodies N] [--steps N] [--shaken]
 *
 * 500 bodies, 500 steps, all kinds in turn if not given. They fall, turned any way, into a pit of four walls that lean
 * outward, where they pile up some layers high. Friction .5, steps of 1/60 s, nothing put to sleep. `chairs` are
 * aggregates of boxes (a seat, a back, four legs that reach into the seat), `sizes` boxes and balls between .1 and 1 m
 * of one density, `masses` boxes of one size, every second one a hundred times as heavy as the others. With --shaken
 * gravity swings sidewise from step 200 on, as it does for what lies in a pit that is shaken. A line for every hundred
 * steps: ms a step, of it the solve, the worst step; overlaps and contacts over all these steps, the energy at their
 * end. */
#include "timing.h"

#include "MdtReport.h"
#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STRETCH = 100, SHAKEN_FROM = 200 /* steps */, HULLS = 8, HULL_POINTS = 12 };
enum { BALLS, CAPSULES, CYLINDERS, HULL_KIND, CHAIRS, SIZES, MASSES, KINDS };

static const char *const kindName[KINDS] = {"balls", "capsules", "cylinders", "hulls", "chairs", "sizes", "masses"};
static const double pi = 3.14159265358979, gravity = 9.81, density = 500;
static const double lean = .2;                           /* rad, of the walls */
static const double shaking = 5 /* m/s^2 */, rate = 1.5; /* Hz */

typedef struct Options {
    int kind, bodies, steps; /* kind -1: all */
    MeBool isShaken;
} Options;

typedef struct Crowd {
    MstUniverseID universe;
    McdGeometryID shape[HULLS]; /* those that several bodies have */
    unsigned int seed;
    double x, y, z, row, layer; /* m: where the next body begins, and the largest of its row and of its layer */
    MeMatrix4 wall[4];          /* transforms of fixed models are kept by pointer */
} Crowd;

typedef struct Stretch {
    double time[STRETCH], solve, overlaps, deepest; /* s, s, m, m */
    long contacts;
} Stretch;

static double randomFrom(Crowd *c, double low, double high) {
    c->seed = c->seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(c->seed >> 8) / (1 << 24);
}

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

static McdGeometryID boxOf(const Crowd *c, double x, double y, double z) {
    return McdBoxCreate(c->universe->frame, (MeReal)x, (MeReal)y, (MeReal)z);
}

static void addBox(const Crowd *c, McdAggregateID whole, const double size[3], const double at[3]) {
    MeMatrix4 place;
    MeMatrix4TMMakeIdentity(place);
    for (int i = 0; i < 3; i++)
        place[3][i] = (MeReal)at[i];
    McdAggregateAddElement(whole, boxOf(c, size[0], size[1], size[2]), place);
}

/* Legs and back reach 3 cm into the seat, which is 6 cm thick. */
static McdGeometryID chairOf(const Crowd *c) {
    static const double seat[3] = {.45, .06, .45}, back[3] = {.45, .5, .06}, leg[3] = {.06, .45, .06};
    static const double middle[3] = {0, 0, 0}, behind[3] = {0, .25, -.195};
    const McdAggregateID chair = McdAggregateCreate(c->universe->frame, 6);
    addBox(c, chair, seat, middle);
    addBox(c, chair, back, behind);
    for (int i = 0; i < 4; i++) {
        const double at[3] = {i & 1 ? .195 : -.195, -.225, i & 2 ? .195 : -.195};
        addBox(c, chair, leg, at);
    }
    return chair;
}

static McdGeometryID hullOf(Crowd *c) {
    MeVector3 point[HULL_POINTS];
    for (int i = 0; i < HULL_POINTS; i++) {
        const double z = randomFrom(c, -1, 1), angle = randomFrom(c, 0, 2 * pi), radius = .3 * sqrt(1 - z * z);
        MeVector3Set(point[i], (MeReal)(radius * cos(angle)), (MeReal)(radius * sin(angle)), (MeReal)(.3 * z));
    }
    return McdConvexMeshCreateHull(c->universe->frame, (const MeVector3 *)point, HULL_POINTS, 0);
}

/* The geometries that bodies share, of which there are as many as this returns. */
static int makeShapes(Crowd *c, int kind) {
    const McdFrameworkID frame = c->universe->frame;
    const int count = kind == HULL_KIND ? HULLS : 1;
    for (int i = 0; i < count; i++)
        c->shape[i] = kind == BALLS       ? McdSphereCreate(frame, (MeReal).3)
                      : kind == CAPSULES  ? McdSphylCreate(frame, (MeReal).2, (MeReal).5)
                      : kind == CYLINDERS ? McdCylinderCreate(frame, (MeReal).3, (MeReal).6)
                      : kind == CHAIRS    ? chairOf(c)
                      : kind == HULL_KIND ? hullOf(c)
                                          : boxOf(c, .5, .5, .5);
    return count;
}

/* Of equal shares for each ratio of sizes. */
static McdGeometryID shapeOfAnySize(Crowd *c, int i) {
    const double size = pow(10, randomFrom(c, -1, 0));
    return i % 2 ? boxOf(c, size, size, size) : McdSphereCreate(c->universe->frame, (MeReal)(size / 2));
}

/* m: no two points of a body are farther apart. */
static double diameterOf(McdGeometryID g) {
    MeVector3 centre;
    MeReal radius;
    McdGeometryGetBSphere(g, centre, &radius);
    return 2 * ((double)radius + (double)MeVector3Magnitude(centre));
}

/* Side by side in rows, and rows in layers, as far apart as their diameters. */
static void place(Crowd *c, McdModelID m, double side) {
    const double d = 1.02 * diameterOf(McdModelGetGeometry(m));
    MeReal q[4];
    if (c->x + d > side) {
        c->x = 0;
        c->z += c->row;
        c->row = 0;
    }
    if (c->z + d > side) {
        c->x = c->z = c->row = 0;
        c->y += c->layer;
        c->layer = 0;
    }
    McdModelDynamicsSetPosition(m, (MeReal)(c->x + d / 2 - side / 2), (MeReal)(c->y + d / 2),
                                (MeReal)(c->z + d / 2 - side / 2));
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)randomFrom(c, -.5, .5);
    McdModelDynamicsSetQuaternion(m, q[0], q[1], q[2], q[3]);
    c->x += d;
    c->row = fmax(c->row, d);
    c->layer = fmax(c->layer, d);
}

/* ---- the pit ----------------------------------------------------------------------------------------------------- */

/* Each wall's face begins at the edge of the pit's square floor and leans outward. */
static void makePit(Crowd *c, double side) {
    static MeMatrix4 groundTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    const double high = 40, thick = 2;
    const McdGeometryID wall = boxOf(c, 2 * high, high, thick);
    MstFixedModelCreate(c->universe, McdPlaneCreate(c->universe->frame), groundTM);
    for (int i = 0; i < 4; i++) {
        const double angle = i * pi / 2, x = sin(angle), z = cos(angle); /* outward, level */
        const double out = side / 2 + high / 2 * sin(lean) + thick / 2 * cos(lean);
        const double up = high / 2 * cos(lean) - thick / 2 * sin(lean);
        MeMatrix4 *tm = &c->wall[i];
        MeMatrix4TMMakeIdentity(*tm);
        MeVector3Set((*tm)[0], (MeReal)z, 0, (MeReal)-x);
        MeVector3Set((*tm)[1], (MeReal)(x * sin(lean)), (MeReal)cos(lean), (MeReal)(z * sin(lean)));
        MeVector3Set((*tm)[2], (MeReal)(x * cos(lean)), (MeReal)-sin(lean), (MeReal)(z * cos(lean)));
        MeVector3Set((*tm)[3], (MeReal)(x * out), (MeReal)up, (MeReal)(z * out));
        MstFixedModelCreate(c->universe, wall, *tm);
    }
}

static void makeUniverse(Crowd *c) {
    c->universe = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!c->universe)
        abort();
    MdtWorldSetGravity(c->universe->world, 0, (MeReal)-gravity, 0);
    MdtWorldSetAutoDisable(c->universe->world, MEFALSE);
    MdtWorldEnableReport(c->universe->world);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(c->universe->bridge, 0, 0), (MeReal).5, 0);
}

/* The floor's side is such that they are some five to ten layers. */
static void makeCrowd(Crowd *c, const Options *o, int kind) {
    *c = (Crowd){.seed = 1, .y = .1};
    makeUniverse(c);
    const int shapes = makeShapes(c, kind);
    McdModelID *model = calloc((size_t)o->bodies, sizeof *model);
    double cubes = 0;
    if (!model)
        abort();
    for (int i = 0; i < o->bodies; i++) {
        const McdGeometryID g = kind == SIZES ? shapeOfAnySize(c, i) : c->shape[i % shapes];
        model[i] = MstModelAndBodyCreate(c->universe, g, (MeReal)(kind == MASSES && i % 2 ? 100 * density : density));
        cubes += pow(diameterOf(g), 3);
    }
    const double side = .8 * cbrt(cubes);
    makePit(c, side);
    for (int i = 0; i < o->bodies; i++)
        place(c, model[i], side);
    free(model);
}

/* ---- steps ------------------------------------------------------------------------------------------------------- */

/* A contact of two bodies is in the lists of both. */
static void note(const Crowd *c, Stretch *s) {
    for (MdtBodyID b = MdtBodyGetFirst(c->universe->world); b; b = MdtBodyGetNext(b))
        for (MdtContactID k = MdtBodyGetFirstContact(b); k; k = MdtBodyGetNextContact(b, k)) {
            const double depth = fmax((double)MdtContactGetPenetration(k), 0);
            if (MdtContactGetBody(k, 0) != b)
                continue;
            s->contacts++;
            s->overlaps += depth;
            s->deepest = fmax(s->deepest, depth);
        }
}

static void step(const Crowd *c, int i, MeBool isShaken, Stretch *s) {
    MdtReport report;
    const double phase = 2 * pi * rate * (i - SHAKEN_FROM) / 60;
    if (isShaken && i >= SHAKEN_FROM)
        MdtWorldSetGravity(c->universe->world, (MeReal)(shaking * sin(phase)), (MeReal)-gravity, 0);
    const double start = now();
    MstUniverseStep(c->universe, (MeReal)(1. / 60));
    s->time[i % STRETCH] = now() - start;
    if (MdtWorldGetReport(c->universe->world, &report))
        s->solve += (double)report.time[MdtReportStageSolve];
    note(c, s);
}

static void tell(const Crowd *c, const char *name, int to, const Stretch *s) {
    MdtReport report;
    double sum = 0, worst = 0;
    MdtWorldGetReport(c->universe->world, &report);
    for (int i = 0; i < STRETCH; i++) {
        sum += s->time[i];
        worst = fmax(worst, s->time[i]);
    }
    printf("| %s | %d | %.2f | %.2f | %.1f | %.1e | %.1e | %.2g | %ld |\n", name, to, 1e3 * sum / STRETCH,
           1e3 * s->solve / STRETCH, 1e3 * worst, s->overlaps / (double)(s->contacts ? s->contacts : 1), s->deepest,
           (double)report.kineticEnergy, s->contacts / STRETCH);
    fflush(stdout);
}

static void run(const Options *o, int kind) {
    Crowd c;
    Stretch s = {.contacts = 0};
    makeCrowd(&c, o, kind);
    for (int i = 0; i < o->steps; i++) {
        step(&c, i, o->isShaken, &s);
        if ((i + 1) % STRETCH != 0)
            continue;
        tell(&c, kindName[kind], i + 1, &s);
        s = (Stretch){.contacts = 0};
    }
    MstUniverseDestroy(c.universe);
}

static int usage(void) {
    fprintf(stderr,
            "usage: crowds [--kind balls|capsules|cylinders|hulls|chairs|sizes|masses] [--bodies N] [--steps N] "
            "[--shaken]\n");
    return 2;
}

static int kindNamed(const char *name) {
    for (int i = 0; i < KINDS; i++)
        if (strcmp(name, kindName[i]) == 0)
            return i;
    return -1;
}

int main(int argc, char **argv) {
    Options o = {.kind = -1, .bodies = 500, .steps = 500};
    for (int i = 1; i < argc; i++) {
        int *number = strcmp(argv[i], "--bodies") == 0 ? &o.bodies : strcmp(argv[i], "--steps") == 0 ? &o.steps : NULL;
        if (strcmp(argv[i], "--shaken") == 0)
            o.isShaken = METRUE;
        else if (strcmp(argv[i], "--kind") == 0 && i + 1 < argc && (o.kind = kindNamed(argv[i + 1])) >= 0)
            i++;
        else if (!number || ++i == argc || (*number = atoi(argv[i])) < 1)
            return usage();
    }
    printf("| kind | to step | ms a step | of it the solve | worst | mean overlap, m | largest | kinetic energy, J | "
           "contacts |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int kind = 0; kind < KINDS; kind++)
        if (o.kind < 0 || o.kind == kind)
            run(&o, kind);
    return 0;
}
