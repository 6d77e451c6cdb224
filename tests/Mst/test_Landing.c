/* What lands sets down corners and rims within a step: these are contacts, though not of the face that it has toward
 * the other body at the step's start. */
#include "universe.h"

#include <math.h>

enum { POINTS = 16, CELLS = 40, SAMPLES = CELLS + 1, RUNS = 25 };
enum { PLANE, BOX, MESH, FIELD, GROUNDS, ROUND = GROUNDS, COLUMN, FREE, ALL };
static const char *const groundName[ALL] = {"plane",      "box",           "mesh",     "height field",
                                            "round hull", "narrow column", "free hull"};
enum { HULL, DISC, CONE };
static const char *const shapeName[] = {"hull", "disc", "cone"};

static unsigned int seed;

static double number(void) { /* -1 .. 1 */
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / 8388608. - 1;
}

static void direction(double n[3]) {
    double square;
    do {
        square = 0;
        for (int i = 0; i < 3; i++) {
            n[i] = number();
            square += n[i] * n[i];
        }
    } while (!(square > .01 && square < 1));
    for (int i = 0; i < 3; i++)
        n[i] /= sqrt(square);
}

static MeMatrix4 place = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

/* The ground's top is z = 0; `size` is that of the bodies. */
static void addGround(int ground, double size) {
    static MeVector3 vertex[SAMPLES * SAMPLES];
    static MeReal height[SAMPLES * SAMPLES];
    static int triangle[2 * CELLS * CELLS][3];
    static MeMatrix4 below; /* used by the model */
    const double cell = 1.1 * size, begin = -cell * CELLS / 2;
    MeMatrix4Copy(below, place);
    below[3][2] = -size;
    for (int i = 0; i < SAMPLES * SAMPLES; i++)
        MeVector3Set(vertex[i], begin + cell * (i % SAMPLES), begin + cell * (i / SAMPLES), 0);
    for (int i = 0; i < 2 * CELLS * CELLS; i++) {
        const int a = i / 2 / CELLS * SAMPLES + i / 2 % CELLS, b = a + SAMPLES + 1;
        triangle[i][0] = a;
        triangle[i][1] = i % 2 ? b : a + 1;
        triangle[i][2] = i % 2 ? a + SAMPLES : b;
    }
    const McdGeometryID g =
        ground == PLANE   ? McdPlaneCreate(u->frame)
        : ground == MESH  ? McdMeshCreate(u->frame, vertex, SAMPLES * SAMPLES, triangle[0], 2 * CELLS * CELLS, 0)
        : ground == FIELD ? McdRGHeightFieldCreate(u->frame, height, SAMPLES, SAMPLES, cell, cell, begin, begin)
                          : McdBoxCreate(u->frame, CELLS * cell, CELLS * cell, 2 * size);
    MstFixedModelCreate(u, g, ground == PLANE || ground == MESH || ground == FIELD ? place : below);
}

/* Points on a flat ellipsoid, symmetric about the origin. */
static McdGeometryID makeHull(double size, double thin) {
    MeVector3 point[POINTS];
    for (int i = 0; i < POINTS; i += 2) {
        double n[3];
        direction(n);
        MeVector3Set(point[i], n[0] * size / 2, n[1] * size / 2, n[2] * thin / 2);
        MeVector3Set(point[i + 1], -n[0] * size / 2, -n[1] * size / 2, -n[2] * thin / 2);
    }
    return McdConvexMeshCreateHull(u->frame, point, POINTS, 0);
}

typedef struct Drop {
    double size, aspect; /* m; the size over the thickness */
    double rate, restitution;
    MdtSolver solver;
    int ground, shape;
} Drop;

static McdGeometryID makeShape(const Drop *d) {
    const double thin = d->size / d->aspect;
    return d->shape == DISC   ? McdCylinderCreate(u->frame, d->size / 2, thin)
           : d->shape == CONE ? McdConeCreate(u->frame, thin, d->size / 2)
                              : makeHull(d->size, thin);
}

/* What stands on the ground. Returns its height; *other: its model, if it may move. */
static double addObstacle(const Drop *d, McdModelID *other) {
    const double size = d->size;
    static MeMatrix4 middle; /* used by the model */
    *other = 0;
    if (d->ground < GROUNDS)
        return 0;
    if (d->ground == ROUND) {
        MeMatrix4Copy(middle, place);
        middle[3][2] = size / 2;
        MstFixedModelCreate(u, makeHull(2 * size, size), middle);
        return size;
    }
    const double high = d->ground == COLUMN ? .8 * size : size / d->aspect;
    *other = MstModelAndBodyCreate(
        u, d->ground == COLUMN ? McdBoxCreate(u->frame, .3 * size, .3 * size, high) : makeHull(size, high), 1000);
    McdModelDynamicsSetPosition(*other, 0, 0, high / 2);
    return high;
}

static McdModelID drop(const Drop *d, McdModelID *other) {
    MeVector3 w = {0, 0, 0};
    double n[3];
    universe_begin(0);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtWorldSetSolver(u->world, d->solver);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, d->restitution);
    addGround(d->ground, d->size);
    const double top = addObstacle(d, other);
    const McdModelID m = MstModelAndBodyCreate(u, makeShape(d), 1000);
    direction(n);
    const double half = 1.5 * number();
    McdModelDynamicsSetQuaternion(m, cos(half), n[0] * sin(half), n[1] * sin(half), n[2] * sin(half));
    for (int k = 0; k < 3; k++)
        w[k] = 10 * number();
    McdModelDynamicsSetPosition(m, .1 * d->size, .23 * d->size, top + 1.5 * d->size);
    McdModelDynamicsSetAngularVelocity(m, w[0], w[1], w[2]);
    return m;
}

/* m: the deepest contact of the last step. */
static double deepestOf(McdModelID m) {
    double max = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(McdModelGetBody(m)); c;
         c = MdtBodyGetNextContact(McdModelGetBody(m), c))
        max = fmax(max, (double)MdtContactGetPenetration(c));
    return max;
}

static double entryOf(McdModelID m) {
    MeVector3 low, high;
    McdModelGetAABB(m, low, high);
    return -(double)low[2];
}

/* The overlap is of second order in the angle by which a body that drops from its own size turns in a step. Without
 * those contacts it is up to 25 times as much: .4 of the thickness of a hull of 10 cm at 60 Hz. */
static void expectLanding(const Drop *d, double min, double share) {
    const double thin = d->size / d->aspect, turn = sqrt(3 * 9.81 / d->size) / d->rate,
                 bound = min + share * turn * turn;
    double worst = 0;
    seed = 4242;
    for (int run = 0; run < RUNS; run++) {
        McdModelID other;
        const McdModelID m = drop(d, &other);
        double entry = 0;
        for (int i = 0; i < 3 * d->rate; i++) {
            MstUniverseStep(u, 1 / d->rate);
            entry = fmax(entry, d->ground < GROUNDS ? entryOf(m) : deepestOf(m));
        }
        worst = fmax(worst, entry / thin);
    }
    printf("%s of %g m, %g : 1, %g Hz, e %g on a %s: overlaps by %.3f of the thickness, of %.3f\n", shapeName[d->shape],
           d->size, d->aspect, d->rate, d->restitution, groundName[d->ground], worst, bound);
    ck_assert_double_lt(worst, bound);
}

LOOP_TEST(corners_that_come_down_within_a_step_are_contacts, 0, GROUNDS) {
    expectLanding(&(Drop){.3, 3, 60, 0, MdtSolverAuto, _i, HULL}, .015, .7);
}

TEST(of_any_size_and_step_and_solver) {
    static const Drop drops[] = {
        {.3, 3, 30, 0, MdtSolverAuto, PLANE, HULL},  {1, 3, 60, 0, MdtSolverAuto, PLANE, HULL},
        {.1, 3, 240, 0, MdtSolverAuto, PLANE, HULL}, {.1, 1, 60, 0, MdtSolverAuto, MESH, HULL},
        {.3, 3, 60, .5, MdtSolverAuto, PLANE, HULL}, {.3, 3, 60, 0, MdtSolverFast, BOX, HULL},
    };
    for (size_t i = 0; i < sizeof drops / sizeof *drops; i++)
        expectLanding(&drops[i], .015, .7);
}

TEST(and_on_round_narrow_and_free_bodies) {
    for (int ground = ROUND; ground < ALL; ground++)
        for (int i = 0; i < 3; i++)
            expectLanding(&(Drop){i ? .3 : 1, 3, i == 2 ? 240 : 60, 0, MdtSolverAuto, ground, HULL}, .06, 2);
}

TEST(rims_that_come_down_within_a_step_are_contacts) {
    for (int shape = DISC; shape <= CONE; shape++)
        for (int i = 0; i < 4; i++)
            expectLanding(&(Drop){i ? .3 : 1, 3, i == 2 ? 240 : 60, i == 3 ? .5 : 0, MdtSolverAuto, BOX, shape}, .04,
                          4);
}

static McdGeometryID makeCoin(double radius, double thin) {
    MeVector3 point[2 * POINTS];
    for (int i = 0; i < 2 * POINTS; i++) {
        const double at = 2 * (double)ME_PI / POINTS * (i / 2);
        MeVector3Set(point[i], radius * cos(at), radius * sin(at), i % 2 ? thin / 2 : -thin / 2);
    }
    return McdConvexMeshCreateHull(u->frame, point, 2 * POINTS, 0);
}

/* What is pushed on all sides of its centre comes to rest: contacts at all of its corners, beside those of its face,
 * take four times the work. */
LOOP_TEST(coins_that_land_nearly_flat_do_so_with_few_contacts, 0, 2) {
    const double max = _i ? 120 : 65;
    double work = 0;
    seed = 5;
    for (int run = 0; run < 40; run++) {
        universe_begin(0);
        MdtWorldSetGravity(u->world, 0, 0, -9.81);
        MdtWorldEnableReport(u->world);
        MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), .5, _i ? .5 : 0);
        addGround(BOX, .3);
        const McdModelID m = MstModelAndBodyCreate(u, makeCoin(.15, .1), 1000);
        const double half = .025 * (1 + number()), to = (double)ME_PI * number();
        McdModelDynamicsSetPosition(m, 0, 0, .45 + .25 * number());
        McdModelDynamicsSetQuaternion(m, cos(half), sin(half) * cos(to), sin(half) * sin(to), 0);
        for (int i = 0; i < 120; i++) {
            MdtReport report;
            MstUniverseStep(u, 1. / 60);
            MdtWorldGetReport(u->world, &report);
            work += (double)report.work;
        }
    }
    printf("40 coins take %.0f million multiplications, of %g\n", work, max);
    ck_assert_double_lt(work, max);
}

/* Shards sleep, on the ground: none stays in it. */
TEST(shards_do_not_stay_in_the_ground) {
    static const Drop drops[] = {{.1, 8, 30, 0, MdtSolverAuto, PLANE, HULL},
                                 {.1, 20, 30, 0, MdtSolverAuto, MESH, HULL},
                                 {.2, 20, 30, 0, MdtSolverAuto, BOX, HULL}};
    for (size_t i = 0; i < sizeof drops / sizeof *drops; i++) {
        seed = 99;
        for (int run = 0; run < RUNS; run++) {
            McdModelID other;
            const McdModelID m = drop(&drops[i], &other);
            MdtContactParamsSetRollingFriction(MstBridgeGetContactParams(u->bridge, 0, 0), .01 * drops[i].size);
            int step = 0;
            while (step < 40 * drops[i].rate && McdModelGetBody(m) && MdtBodyIsEnabled(McdModelGetBody(m))) {
                MstUniverseStep(u, 1 / drops[i].rate);
                step++;
            }
            ck_assert_msg(!MdtBodyIsEnabled(McdModelGetBody(m)), "shard %d of %zu is awake", run, i);
            ck_assert_double_lt(entryOf(m) * drops[i].aspect / drops[i].size, .03);
        }
    }
}
