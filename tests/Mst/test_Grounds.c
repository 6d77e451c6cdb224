/* Grounds of two or four fixed models of any kinds, which lie flush: bodies pass from one to the next as on a single
 * surface. */
#include "universe.h"
#include <pthread.h>

/* ---- grounds ----------------------------------------------------------------------------------------------------- */

enum { BOXES, FIELD, LIST, PLANE, BOX_PART, LIST_PART, KINDS };
static const char *const kindName[KINDS] = {"box", "height field", "list", "plane", "part (box)", "part (list)"};

typedef struct Ground {
    int kind[2];         /* of the tile before the seam, and of the one beyond */
    double size;         /* m, of a body: the unit of the lengths below */
    double speed;        /* m/s, times the root of the size */
    double gap, step;    /* between the tiles (negative: they overlap); up, to the second tile */
    double fold;         /* rad, of the second tile about the seam, upward */
    double yaw, oblique; /* rad, of the seam about z; of the way to the seam's normal */
    double triangle;     /* side; 0: 1 */
    double away;         /* of the seam from the origin, along each axis */
    double friction, rate;
    MdtSolver solver;
    int order; /* bit 0: the bodies are created first; bit 1: the second tile */
} Ground;

enum { MAX_SIDE = 24, MAX_TILES = 4 };
/* The side of a tile, in sizes. A body starts 2 sizes and a step before the seam, and stops as far beyond. */
static double sideOf(const Ground *g) {
    return 2 * (12 + 2 * g->speed / g->rate);
}

/* A square of the plane z = 0 in a tile's frame, of n by n smaller squares. */
typedef struct Grid {
    int n;
    MeVector3 corner[(MAX_SIDE + 1) * (MAX_SIDE + 1)];
    MeReal height[(MAX_SIDE + 1) * (MAX_SIDE + 1)];
} Grid;

static Grid grids[MAX_TILES];
static MeMatrix4 tilePlace[MAX_TILES];

static pthread_t caller;
static int calls, callsElsewhere; /* of giveGrid, by another thread than the caller */

static int MEAPI giveGrid(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 at, MeReal radius, int max) {
    Grid *grid = McdTriangleListGetUserData(McdModelGetGeometry(pair->model2));
    calls++;
    callsElsewhere += !pthread_equal(caller, pthread_self());
    const double side = grid->corner[1][0] - grid->corner[0][0];
    int count = 0, from[2], to[2];
    for (int k = 0; k < 2; k++) {
        from[k] = (int)fmax(floor((at[k] - radius - grid->corner[0][k]) / side - 1e-3), 0);
        to[k] = (int)fmin(floor((at[k] + radius - grid->corner[0][k]) / side + 1e-3), grid->n - 1);
    }
    for (int j = from[1]; j <= to[1]; j++)
        for (int i = from[0]; i <= to[0]; i++)
            for (int half = 0; half < 2 && count < max; half++) {
                const int first = j * (grid->n + 1) + i;
                const int vertex[3] = {first, first + 1 + half * (grid->n + 1), first + 1 - half + grid->n + 1};
                memset(&triangle[count], 0, sizeof *triangle);
                for (int k = 0; k < 3; k++)
                    triangle[count].vertices[k] = &grid->corner[vertex[k]];
                triangle[count].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
                count++;
            }
    return count;
}

/* A tile's geometry, whose top is the square from (x, y) on; `place` gets the geometry's place in the tile's frame. */
static McdGeometryID makeTile(const Ground *g, int kind, int tile, double x, double y, MeMatrix4 place) {
    const double side = sideOf(g) * g->size, ideal = (g->triangle > 0 ? g->triangle : 1) * g->size;
    Grid *grid = &grids[tile];
    MeMatrix4TMMakeIdentity(place);
    if (kind == BOXES || kind == BOX_PART) {
        place[3][0] = x + side / 2;
        place[3][1] = y + side / 2;
        place[3][2] = -side / 8;
        return McdBoxCreate(u->frame, side, side, side / 4);
    }
    grid->n = (int)fmax(fmin(round(side / ideal), MAX_SIDE), 1);
    const MeReal step = side / grid->n, x0 = x, y0 = y;
    if (kind == FIELD)
        return McdRGHeightFieldCreate(u->frame, grid->height, grid->n + 1, grid->n + 1, step, step, x0, y0);
    for (int j = 0; j <= grid->n; j++)
        for (int i = 0; i <= grid->n; i++)
            MeVector3Set(grid->corner[j * (grid->n + 1) + i], x0 + (MeReal)i * step, y0 + (MeReal)j * step, 0);
    MeVector3 low = {x0, y0, -step}, high = {x0 + side, y0 + side, step};
    const McdGeometryID list = McdTriangleListCreate(u->frame, low, high, 2 * MAX_SIDE * MAX_SIDE + 1, giveGrid);
    McdTriangleListSetUserData(list, grid);
    return list;
}

/* Creates the model of a tile. */
static McdModelID layTile(const Ground *g, int kind, int tile, double x, double y, double yaw) {
    const double fold = tile == 1 ? g->fold : 0, c = cos(fold), s = sin(fold), cy = cos(yaw), sy = sin(yaw);
    const double axis[3][3] = {{c * cy, c * sy, s}, {-sy, cy, 0}, {-s * cy, -s * sy, c}};
    const double gap = tile == 1 ? g->gap : 0, up = tile == 1 ? g->step : 0;
    const double place[3] = {g->away + gap * cy, g->away + gap * sy, up};
    MeMatrix4 frame, part;
    MeMatrix4TMMakeIdentity(frame);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            frame[i][k] = axis[i][k];
        frame[3][k] = place[k] * g->size;
    }
    memcpy(tilePlace[tile], frame, sizeof frame);
    if (kind == PLANE)
        return MstFixedModelCreate(u, McdPlaneCreate(u->frame), tilePlace[tile]);
    const McdGeometryID geometry = makeTile(g, kind, tile, x * g->size, y * g->size, part);
    if (kind == BOX_PART || kind == LIST_PART) {
        const McdAggregateID whole = McdAggregateCreate(u->frame, 1);
        McdAggregateAddElement(whole, geometry, part);
        return MstFixedModelCreate(u, whole, tilePlace[tile]);
    }
    MeMatrix4TMCompound(tilePlace[tile], part, frame);
    return MstFixedModelCreate(u, geometry, tilePlace[tile]);
}

static void layTwo(const Ground *g) {
    for (int i = 0; i < 2; i++) {
        const int tile = g->order & 2 ? 1 - i : i;
        layTile(g, g->kind[tile], tile, tile ? 0 : -sideOf(g), -sideOf(g) / 2, g->yaw);
    }
}

/* Four tiles of different kinds that meet in a point. */
static void layFour(const Ground *g) {
    static const int kinds[MAX_TILES] = {FIELD, LIST, BOXES, LIST_PART};
    for (int i = 0; i < MAX_TILES; i++)
        layTile(g, kinds[i], i, 0, 0, g->yaw + i * 1.5707963267948966);
}

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

enum { BALL, CAPSULE, CYLINDER, DISC, ROLLERS, LONG = ROLLERS, CUBE, HULL, UPRIGHT, BODIES };
static const char *const bodyName[BODIES] = {"ball",         "capsule", "cylinder", "disc",
                                             "long capsule", "box",     "hull",     "upright cylinder"};

static McdModelID bodies[BODIES];

static McdGeometryID makeShape(int shape, double size) {
    const MeReal s = size, half = s / 2;
    MeVector3 corners[12]; /* of a hexagonal prism */
    for (int i = 0; i < 12; i++)
        MeVector3Set(corners[i], half * MeCos((MeReal)i * ME_PI / 3), half * MeSin((MeReal)i * ME_PI / 3),
                     i < 6 ? -half : half);
    switch (shape) {
    case BALL:
        return McdSphereCreate(u->frame, half);
    case CAPSULE:
    case LONG:
        return McdSphylCreate(u->frame, half, s);
    case CYLINDER:
    case UPRIGHT:
        return McdCylinderCreate(u->frame, half, s);
    case DISC:
        return McdCylinderCreate(u->frame, half, s / 10);
    case HULL:
        return McdConvexMeshCreateHull(u->frame, (const MeVector3 *)corners, 12, 0);
    default:
        return McdBoxCreate(u->frame, s, s, s);
    }
}

/* The rotation by a half turn about the bisector of z and a direction in the plane z = 0 takes the axis there. */
static void layAxis(McdModelID m, double x, double y) {
    const double half = sqrt(.5);
    McdModelDynamicsSetQuaternion(m, 0, half * x, half * y, half);
}

static double speedOf(const Ground *g) {
    return g->speed * sqrt(g->size);
}

/* m: from its start to the seam. */
static double approachOf(const Ground *g) {
    return (2 + g->speed / g->rate) * g->size;
}

/* A body's point on the seam: the bodies are side by side, and not exactly on the corner of tiles and triangles. */
static void placeOnSeam(const Ground *g, int body, double place[2]) {
    const double along = (2.6 * (body - 3.5) + .137) * g->size;
    place[0] = g->away * g->size - sin(g->yaw) * along;
    place[1] = g->away * g->size + cos(g->yaw) * along;
}

static void putBody(const Ground *g, int body) {
    const double way = g->yaw + g->oblique, x = cos(way), y = sin(way), v = speedOf(g);
    double place[2];
    const McdModelID m = bodies[body] = MstModelAndBodyCreate(u, makeShape(body, g->size), 1000);
    placeOnSeam(g, body, place);
    McdModelDynamicsSetPosition(m, place[0] - x * approachOf(g), place[1] - y * approachOf(g), g->size / 2);
    if (body == LONG)
        layAxis(m, x, y);
    else if (body < ROLLERS && body != BALL)
        layAxis(m, -y, x);
    else
        McdModelDynamicsSetQuaternion(m, cos(way / 2), 0, 0, sin(way / 2));
    McdModelDynamicsSetLinearVelocity(m, v * x, v * y, 0);
    if (g->friction > 0)
        McdModelDynamicsSetAngularVelocity(m, -y * v / (g->size / 2), x * v / (g->size / 2), 0);
}

static int bodyCount(const Ground *g) {
    return g->friction > 0 ? ROLLERS : BODIES;
}

static void putBodies(const Ground *g) {
    for (int i = 0; i < bodyCount(g); i++)
        putBody(g, i);
}

static void begin(const Ground *g) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    sizes.lengthScale = g->size;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    MdtWorldSetAutoDisable(u->world, 0);
    MdtWorldSetSolver(u->world, g->solver);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), g->friction, 0);
}

static int stepsOf(const Ground *g) {
    return (int)ceil(2 * approachOf(g) / speedOf(g) * g->rate);
}

/* ---- a level ground ---------------------------------------------------------------------------------------------- */

static void describe(const Ground *g, char *text, size_t length) {
    snprintf(
        text, length,
        "%s, %s: size %g, %g m/s, gap %g, step %g, yaw %g, oblique %g, triangles of %g, at %g, friction %g, %g Hz, "
        "solver %d, order %d",
        kindName[g->kind[0]], kindName[g->kind[1]], g->size, g->speed, g->gap, g->step, g->yaw, g->oblique, g->triangle,
        g->away, g->friction, g->rate, (int)g->solver, g->order);
}

/* The largest height of a body over the ground, or depth, relative to its size. */
static double heightOf(const Ground *g, int body) {
    MeVector3 p;
    McdModelDynamicsGetPosition(bodies[body], p);
    return fabs(p[2] / g->size - .5);
}

/* The displacement relative to that on a single tile. */
static double errorOf(const Ground *g, int body) {
    const double way = g->yaw + g->oblique, free = speedOf(g) * stepsOf(g) / g->rate - approachOf(g);
    double place[2];
    MeVector3 p;
    McdModelDynamicsGetPosition(bodies[body], p);
    placeOnSeam(g, body, place);
    return hypot(p[0] - place[0] - free * cos(way), p[1] - place[1] - free * sin(way)) / (free + approachOf(g));
}

static void assertPassed(const Ground *g, void (*lay)(const Ground *), double height, double error) {
    char text[300];
    begin(g);
    if (g->order & 1)
        putBodies(g);
    lay(g);
    if (!(g->order & 1))
        putBodies(g);
    describe(g, text, sizeof text);
    for (int i = 0; i < stepsOf(g); i++) {
        MstUniverseStep(u, 1 / g->rate);
        for (int k = 0; k < bodyCount(g); k++)
            ck_assert_msg(heightOf(g, k) <= height, "%s: %s hops by %g", text, bodyName[k], heightOf(g, k));
    }
    for (int k = 0; k < bodyCount(g); k++)
        ck_assert_msg(errorOf(g, k) <= error, "%s: %s is off by %g of its way", text, bodyName[k], errorOf(g, k));
}

static double pick(const double *values, size_t count, int i) {
    return values[(size_t)i % count];
}
#define PICK(values, i) pick(values, sizeof(values) / sizeof *(values), i)

/* Each pair of kinds, twice; the parameters differ from scene to scene. */
LOOP_TEST(no_body_feels_the_seam_of_two_models_of_any_kinds, 0, KINDS) {
    static const double speeds[] = {1, 5, 20, 50}, sizes[] = {1, .1, 10}, gaps[] = {0, 1e-6, 1e-4, 1e-3, -1e-3, -.1},
                        yaws[] = {0, .35, .8}, obliques[] = {0, .6, 1.4, 0, 1.5707963267948966},
                        triangles[] = {1, .37, 5}, aways[] = {0, 30, -200}, rates[] = {60, 30, 240, 60};
    int scene = 7 * _i;
    for (int kind = 0; kind < KINDS; kind++) {
        if (kind == PLANE)
            continue; /* an infinite one has no edge */
        for (int i = 0; i < 2; i++, scene++) {
            Ground g = {.kind = {_i, kind}, .size = PICK(sizes, scene), .speed = PICK(speeds, scene)};
            g.gap = PICK(gaps, scene);
            g.yaw = PICK(yaws, scene / 2);
            g.oblique = PICK(obliques, scene);
            g.triangle = PICK(triangles, scene / 3);
            g.away = PICK(aways, scene / 5);
            g.rate = PICK(rates, scene / 4 + scene);
            g.solver = (MdtSolver)(scene % 3);
            g.order = scene / 3 % 4;
            g.friction = scene % 5 == 1 ? .8 : 0;
            assertPassed(&g, layTwo, 1e-3, 2e-3);
        }
    }
}

TEST(no_body_feels_where_four_models_meet) {
    static const double speeds[] = {1, 5, 20, 50};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            assertPassed(&(Ground){.size = 1,
                                   .speed = speeds[i],
                                   .rate = 60,
                                   .yaw = .3 * k,
                                   .oblique = .8 - .2 * i,
                                   .friction = .8 * (i % 2)},
                         layFour, 1e-3, 2e-3);
}

/* ---- gaps -------------------------------------------------------------------------------------------------------- */

/* Bodies at rest above the gap: the ball is above neither tile, lines along the gap are above neither tile. */
LOOP_TEST(what_rests_above_a_gap_does_not_sink, 0, KINDS) {
    static const double gaps[] = {1e-5, 1e-4, 1e-3, .02};
    static const int across[KINDS] = {FIELD, LIST, BOX_PART, BOXES, LIST_PART, BOXES};
    if (_i == PLANE)
        return;
    for (int i = 0; i < 4; i++) {
        const Ground g = {.kind = {_i, across[_i]},
                          .size = 1,
                          .speed = 1,
                          .rate = 60,
                          .gap = gaps[i],
                          .friction = .5,
                          .oblique = i % 2 ? .4 : 0};
        begin(&g);
        layTwo(&g);
        putBodies(&g);
        for (int k = 0; k < ROLLERS; k++) {
            double place[2];
            placeOnSeam(&g, k, place);
            McdModelDynamicsSetPosition(bodies[k], place[0] + g.gap / (2 + i % 3), place[1], g.size / 2);
            McdModelDynamicsSetLinearVelocity(bodies[k], 0, 0, 0);
            McdModelDynamicsSetAngularVelocity(bodies[k], 0, 0, 0);
        }
        universe_step(30);
        for (int k = 0; k < ROLLERS; k++)
            ck_assert_msg(heightOf(&g, k) <= 1e-4, "%s, %s, gap %g: %s is off by %g", kindName[g.kind[0]],
                          kindName[g.kind[1]], g.gap, bodyName[k], heightOf(&g, k));
    }
}

/* ---- folds ------------------------------------------------------------------------------------------------------- */

/* The speed of each body after it has passed a fold. */
static void speedsOver(const Ground *g, double speed[BODIES]) {
    begin(g);
    layTwo(g);
    putBodies(g);
    for (int i = 0; i < stepsOf(g); i++)
        MstUniverseStep(u, 1 / g->rate);
    for (int k = 0; k < bodyCount(g); k++) {
        MeVector3 v;
        McdModelDynamicsGetLinearVelocity(bodies[k], v);
        speed[k] = MeVector3Magnitude(v) / speedOf(g);
    }
}

/* As on two rectangles of one list, which mcd_mesh_topology.c and tests/Mst/test_Seams.c hold to their levels. */
TEST(a_fold_between_two_models_is_one_of_a_single_surface) {
    static const double speeds[] = {5, 20}, angles[] = {1, -1, 5, -5};
    static const int first[] = {FIELD, LIST, BOXES}, second[] = {LIST_PART, BOXES, FIELD};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++) {
            Ground g = {.kind = {LIST, LIST},
                        .size = 1,
                        .speed = speeds[i],
                        .rate = 60,
                        .triangle = 2,
                        .fold = angles[k] * 3.14159265358979 / 180,
                        .yaw = .35};
            double expected[BODIES], speed[BODIES];
            speedsOver(&g, expected);
            for (int pair = 0; pair < 3; pair++) {
                g.kind[0] = first[pair];
                g.kind[1] = second[pair];
                speedsOver(&g, speed);
                for (int body = 0; body < BODIES; body++)
                    ck_assert_msg(fabs(speed[body] - expected[body]) <= .02,
                                  "%s, %s, %g m/s, %g degrees, %s: %g, not %g", kindName[g.kind[0]],
                                  kindName[g.kind[1]], speeds[i], angles[k], bodyName[body], speed[body],
                                  expected[body]);
            }
        }
}

/* ---- edges of the surface ---------------------------------------------------------------------------------------- */

/* A step up of a hundredth stops a box, and a gap as wide as a body lets it in. */
LOOP_TEST(a_step_and_a_wide_gap_between_models_are_felt, 0, KINDS) {
    static const int beyond[KINDS] = {FIELD, LIST, BOXES, BOXES, LIST_PART, BOX_PART};
    for (int i = 0; i < 2; i++) {
        Ground g = {.kind = {_i, beyond[_i]}, .size = 1, .speed = 1, .rate = 60};
        MeVector3 p;
        if (i == 0)
            g.step = .01;
        else if (_i == PLANE || beyond[_i] == FIELD || beyond[_i] == LIST || beyond[_i] == LIST_PART)
            continue; /* under it, or without a side */
        else
            g.gap = 2;
        begin(&g);
        layTwo(&g);
        putBodies(&g);
        for (int k = 0; k < stepsOf(&g); k++)
            MstUniverseStep(u, 1 / g.rate);
        McdModelDynamicsGetPosition(bodies[i ? BALL : CUBE], p);
        ck_assert_msg(i ? p[2] < .3 : p[0] < -.45, "%s, %s: at %g, %g", kindName[_i], kindName[beyond[_i]],
                      (double)p[0], (double)p[2]);
    }
}

static int contactsOf(McdModelID m) {
    int count = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(McdModelGetBody(m)); c;
         c = MdtBodyGetNextContact(McdModelGetBody(m), c))
        count++;
    return count;
}

/* A box at rest before the seam, without gravity, touches the first tile only. When that is destroyed, the second
 * tile's border becomes one of the surface. */
LOOP_TEST(a_border_is_one_of_the_surface_when_its_neighbour_goes, 0, 2) {
    const Ground g = {.kind = {_i ? BOXES : LIST, _i ? LIST : BOXES}, .size = 1, .speed = 1, .rate = 60};
    begin(&g);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    const McdModelID tile = layTile(&g, g.kind[0], 0, -sideOf(&g), -sideOf(&g) / 2, 0);
    layTile(&g, g.kind[1], 1, 0, -sideOf(&g) / 2, 0);
    putBody(&g, CUBE);
    McdModelDynamicsSetPosition(bodies[CUBE], -.505, 0, .5);
    McdModelDynamicsSetLinearVelocity(bodies[CUBE], 0, 0, 0);
    universe_step(3);
    ck_assert_int_eq(contactsOf(bodies[CUBE]), 4);
    MstFixedModelDestroy(tile);
    universe_step(2);
    ck_assert_int_eq(contactsOf(bodies[CUBE]), 2);
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

/* A list's callback is called by the thread that steps, also for contacts of other models at the seam. */
TEST(a_list_beside_other_models_is_asked_by_one_thread) {
    enum { BALLS = 120 };
    const Ground g = {.kind = {BOXES, LIST}, .size = 1, .speed = 1, .rate = 60};
    const MeTaskPoolID pool = MeTaskPoolCreate(4);
    begin(&g);
    MdtWorldSetTaskPool(u->world, pool);
    layTwo(&g);
    const McdGeometryID ball = McdSphereCreate(u->frame, .05);
    for (int i = 0; i < BALLS; i++)
        McdModelDynamicsSetPosition(MstModelAndBodyCreate(u, ball, 1000), i % 2 ? .04 : -.04, .15 * (i - 60), .05);
    caller = pthread_self();
    calls = callsElsewhere = 0;
    universe_step(3);
    MdtWorldSetTaskPool(u->world, NULL);
    MeTaskPoolDestroy(pool);
    ck_assert_int_gt(calls, 3 * BALLS); /* for pairs with the boxes, too */
    ck_assert_int_eq(callsElsewhere, 0);
}
