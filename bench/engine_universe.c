/* Karma as programs use it: a universe, whose contacts Mcd finds and the bridge makes; rigid (epsilon 0), or with
 * the epsilon that it comes with. Every friction and restitution that there is among the bodies becomes a material. */
#include "engine.h"
#include "karma_body.h"

#include "MeVersion.h"
#include "Mst.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_MATERIALS = 16 };

struct EngineWorld {
    MstUniverseID universe;
    MeMatrix4 ground;
    MeReal heights[SCENE_MAX_HEIGHTS];  /* of the terrain */
    MeMatrix4 places[SCENE_MAX_BODIES]; /* of what never moves */
    McdModelID models[SCENE_MAX_BODIES];
    MdtBodyID bodies[SCENE_MAX_BODIES]; /* null: it never moves */
    SceneBody from[SCENE_MAX_BODIES];
    int numBodies;
    const SceneJoint *joints[SCENE_MAX_JOINTS];
    MdtConstraintID joined[SCENE_MAX_JOINTS];
    int numJoints;
    double time;                               /* s */
    const SceneBody *materials[MAX_MATERIALS]; /* a body of each; null: the ground's, which has no friction */
    int numMaterials;
    MeTaskPoolID pool; /* null: one worker */
    bool isStrict, isInexact;
};

/* Of the solver of contacts, and of workers. */
static void choose(EngineWorld *w, int setting, const double gravity[3]) {
    const MdtWorldID world = w->universe->world;
    if (setting == ENGINE_EXACT)
        MdtWorldSetSolver(world, MdtSolverExact);
    if (setting == ENGINE_FAST || setting == ENGINE_FINE)
        MdtWorldSetSolver(world, MdtSolverFast);
    if (setting == ENGINE_FINE) /* a tenth of the default, g h / 100 */
        MdtWorldSetAccuracy(world, (MeReal)(1e-3 * sqrt(scene_dot(gravity, gravity)) * SCENE_FRAME));
    if (setting == ENGINE_TWO_WORKERS) {
        w->pool = MeTaskPoolCreate(2);
        MdtWorldSetTaskPool(world, w->pool);
    }
}

static EngineWorld *create(int setting, const double gravity[3], bool collides) {
    (void)collides;
    EngineWorld *w = calloc(1, sizeof *w);
    if (!w)
        abort();
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    sizes.materialsMaxCount = MAX_MATERIALS;
    w->universe = MstUniverseCreate(&sizes);
    w->numMaterials = 1;
    w->isStrict = (setting & ENGINE_STRICT) != 0;
    karma_setWorld(w->universe->world, setting & ~ENGINE_STRICT, gravity);
    choose(w, setting & ~ENGINE_STRICT, gravity);
    if (w->isStrict)
        MdtWorldEnableReport(w->universe->world);
    return w;
}

/* A plane's normal is the z of its transform. */
static void addGround(EngineWorld *w) {
    MeMatrix3 upright;
    MeMatrix3MakeRotationX(upright, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(w->ground, upright, 0, 0, 0);
    MstFixedModelCreate(w->universe, McdPlaneCreate(w->universe->frame), w->ground);
}

/* A height field's z is up, so its y is -z here, and its rows come in the other order. */
static void addTerrain(EngineWorld *w, const SceneTerrain *t) {
    const MeReal step = (MeReal)t->step;
    MeMatrix3 upright;
    for (int k = 0; k < t->zCount; k++)
        for (int i = 0; i < t->xCount; i++)
            w->heights[k * t->xCount + i] = (MeReal)t->heights[(t->zCount - 1 - k) * t->xCount + i];
    MeMatrix3MakeRotationX(upright, -ME_PI / 2);
    MeMatrix4TMMakeFromRotationAndPosition(w->ground, upright, (MeReal)t->x0, 0,
                                           (MeReal)(t->z0 + (t->zCount - 1) * t->step));
    MstFixedModelCreate(w->universe,
                        McdRGHeightFieldCreate(w->universe->frame, w->heights, t->xCount, t->zCount, step, step, 0, 0),
                        w->ground);
}

/* Where two touch, the larger friction and the larger restitution hold. */
static void mixMaterials(const EngineWorld *w, int m1, int m2) {
    const SceneBody *a = w->materials[m1], *b = w->materials[m2];
    karma_setSurface(MstBridgeGetContactParams(w->universe->bridge, (MstMaterialID)m1, (MstMaterialID)m2),
                     fmax(a ? a->friction : 0, b ? b->friction : 0),
                     fmax(a ? a->restitution : 0, b ? b->restitution : 0));
}

static int materialOf(EngineWorld *w, const SceneBody *b) {
    for (int i = 1; i < w->numMaterials; i++)
        if (w->materials[i]->friction == b->friction && w->materials[i]->restitution == b->restitution)
            return i;
    const int material = (int)MstBridgeGetNewMaterial(w->universe->bridge);
    w->materials[material] = b;
    w->numMaterials = material + 1;
    for (int i = 0; i <= material; i++)
        mixMaterials(w, material, i);
    return material;
}

static void makePlace(MeMatrix4 tm, const double position[3], const double quaternion[4]) {
    const MeVector4 q = {(MeReal)quaternion[0], (MeReal)quaternion[1], (MeReal)quaternion[2], (MeReal)quaternion[3]};
    MeMatrix3 turn;
    MeQuaternionToR(turn, q);
    MeMatrix4TMMakeFromRotationAndPosition(tm, turn, (MeReal)position[0], (MeReal)position[1], (MeReal)position[2]);
}

static McdGeometryID boxOf(McdFrameworkID frame, const double half[3]) {
    return McdBoxCreate(frame, (MeReal)(2 * half[0]), (MeReal)(2 * half[1]), (MeReal)(2 * half[2]));
}

static McdGeometryID compoundOf(McdFrameworkID frame, const SceneBody *b) {
    const McdAggregateID whole = McdAggregateCreate(frame, b->numParts);
    for (int i = 0; i < b->numParts; i++) {
        MeMatrix4 place;
        makePlace(place, b->parts[i].position, b->parts[i].quaternion);
        McdAggregateAddElement(whole, boxOf(frame, b->parts[i].half), place);
    }
    return whole;
}

static McdGeometryID shapeOf(const EngineWorld *w, const SceneBody *b) {
    const McdFrameworkID frame = w->universe->frame;
    if (b->shape == SCENE_COMPOUND)
        return compoundOf(frame, b);
    if (b->shape == SCENE_SPHERE)
        return McdSphereCreate(frame, (MeReal)b->half[0]);
    if (b->shape == SCENE_CAPSULE)
        return McdSphylCreate(frame, (MeReal)b->half[0], (MeReal)(2 * (b->half[2] - b->half[0])));
    if (b->shape == SCENE_CYLINDER)
        return McdCylinderCreate(frame, (MeReal)b->half[0], (MeReal)(2 * b->half[2]));
    return boxOf(frame, b->half);
}

/* Parts count twice where they overlap, as in the mass that the universe makes of the density. */
static double volumeOf(const SceneBody *b) {
    const double r = b->half[0], ball = 4 * (double)ME_PI / 3 * r * r * r;
    if (b->shape == SCENE_SPHERE)
        return ball;
    if (b->shape == SCENE_CAPSULE)
        return ball + 2 * (double)ME_PI * r * r * (b->half[2] - r);
    if (b->shape == SCENE_CYLINDER)
        return 2 * (double)ME_PI * r * r * b->half[2];
    double parts = 0;
    for (int i = 0; i < b->numParts; i++)
        parts += 8 * b->parts[i].half[0] * b->parts[i].half[1] * b->parts[i].half[2];
    return b->shape == SCENE_COMPOUND ? parts : 8 * b->half[0] * b->half[1] * b->half[2];
}

static McdModelID addFixed(EngineWorld *w, const SceneBody *b) {
    makePlace(w->places[w->numBodies], b->start.position, b->start.quaternion);
    return MstFixedModelCreate(w->universe, shapeOf(w, b), w->places[w->numBodies]);
}

static McdModelID addMoving(EngineWorld *w, const SceneBody *b) {
    const McdModelID m = MstModelAndBodyCreate(w->universe, shapeOf(w, b), (MeReal)(b->mass / volumeOf(b)));
    const MdtBodyID body = w->bodies[w->numBodies] = McdModelGetBody(m);
    if (b->inertia[0] > 0) {
        const MeMatrix3 tensor = {
            {(MeReal)b->inertia[0], 0, 0}, {0, (MeReal)b->inertia[1], 0}, {0, 0, (MeReal)b->inertia[2]}};
        MdtBodySetInertiaTensor(body, tensor);
    }
    karma_setState(body, &b->start);
    return m;
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    const McdModelID m = b->mass > 0 ? addMoving(w, b) : addFixed(w, b);
    w->from[w->numBodies] = *b;
    McdModelSetMaterial(m, materialOf(w, &w->from[w->numBodies]));
    w->models[w->numBodies++] = m;
}

static MdtBodyID bodyAt(const EngineWorld *w, int index) {
    return index == SCENE_WORLD ? 0 : w->bodies[index];
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    w->joints[w->numJoints] = j;
    w->joined[w->numJoints++] = karma_join(w->universe->world, bodyAt(w, j->child), bodyAt(w, j->parent), j);
    if (j->parent != SCENE_WORLD && !McdSpaceDisablePair(w->models[j->child], w->models[j->parent]))
        abort();
}

static void step(EngineWorld *w, double h) {
    for (int i = 0; i < w->numBodies; i++)
        if (w->bodies[i])
            karma_push(w->bodies[i], &w->from[i], w->time);
    for (int i = 0; i < w->numJoints; i++)
        if (w->joints[i]->path)
            karma_lead(w->joined[i], w->joints[i], w->time, h);
    w->time += h;
    MstUniverseStep(w->universe, (MeReal)h);
    if (w->isStrict)
        w->isInexact |= karma_isInexact(w->universe->world);
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    if (w->bodies[body])
        karma_getState(w->bodies[body], s);
    else
        *s = w->from[body].start;
}

static bool hasGivenUp(EngineWorld *w) {
    return w->isInexact;
}

static void destroy(EngineWorld *w) {
    MstUniverseDestroy(w->universe);
    if (w->pool)
        MeTaskPoolDestroy(w->pool);
    free(w);
}

static const char *const settings[] = {
    [ENGINE_RIGID] = "auto",
    [ENGINE_DEFAULTS] = "defaults",
    [ENGINE_EXACT] = "exact",
    [ENGINE_FAST] = "fast",
    [ENGINE_FINE] = "fast/10",
    [ENGINE_TWO_WORKERS] = "2 threads",
    NULL,
};

#ifdef _ME_API_DOUBLE
#define ENGINE_UNIVERSE engine_universe_double
#else
#define ENGINE_UNIVERSE engine_universe_single
#endif

MEPUBLIC extern const Engine ENGINE_UNIVERSE;
const Engine ENGINE_UNIVERSE = {
    .name = KARMA_NAME,
    .version = ME_VERSION_STRING,
    .about = KARMA_PRECISION
    "; epsilon 0 or (defaults) a universe's 7.2e-11, gamma .2, the friction cone; contacts by Mcd, ahead of touch, "
    "through the bridge",
    .settings = settings,
    .bounces = true,
    .crowds = 1u << ENGINE_RIGID | 1u << ENGINE_FINE | 1u << ENGINE_TWO_WORKERS,
    .create = create,
    .addGround = addGround,
    .addTerrain = addTerrain,
    .addBody = addBody,
    .addJoint = addJoint,
    .step = step,
    .getState = getState,
    .hasGivenUp = hasGivenUp,
    .destroy = destroy,
};
