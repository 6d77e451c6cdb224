/* Karma, rigid (epsilon 0), or with the epsilon of a world that a program makes. Its contacts are the scene's, not
 * Mcd's: dynamics is compared. One that lasts from step to step stays the same object, so that Karma may start from its
 * last forces. */
#include "engine.h"
#include "karma_body.h"

#include "Mdt.h"
#include "MeVersion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Contact {
    MdtContactID id; /* null: none */
    int body, other;
    double arm[3]; /* m, of the point against the first body's centre, in the world's axes */
} Contact;

struct EngineWorld {
    MdtWorldID world;
    MdtBodyID bodies[SCENE_MAX_BODIES];
    double sizes[SCENE_MAX_BODIES]; /* m, smallest half edges */
    SceneBody from[SCENE_MAX_BODIES];
    int numBodies;
    const SceneJoint *joints[SCENE_MAX_JOINTS];
    MdtConstraintID joined[SCENE_MAX_JOINTS];
    int numJoints;
    double time; /* s */
    bool isStrict, isInexact;
    Contact contacts[SCENE_MAX_CONTACTS];
    int numContacts;
};

static EngineWorld *create(int setting, const double gravity[3], bool collides) {
    EngineWorld *w = calloc(1, sizeof *w);
    if (!w)
        abort();
    w->world = MdtWorldCreate(SCENE_MAX_BODIES, SCENE_MAX_JOINTS + (collides ? SCENE_MAX_CONTACTS : 0));
    karma_setWorld(w->world, setting & ~ENGINE_STRICT, gravity);
    if ((setting & ~ENGINE_STRICT) == ENGINE_ORDER_4)
        MdtWorldSetIntegratorOrder(w->world, 4);
    w->isStrict = (setting & ENGINE_STRICT) != 0;
    if (w->isStrict)
        MdtWorldEnableReport(w->world);
    return w;
}

static void addGround(EngineWorld *w) {
    (void)w; /* it is where the contacts are */
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    double inertia[3];
    scene_inertia(b, inertia);
    const MeMatrix3 tensor = {{(MeReal)inertia[0], 0, 0}, {0, (MeReal)inertia[1], 0}, {0, 0, (MeReal)inertia[2]}};
    w->from[w->numBodies] = *b;
    w->sizes[w->numBodies] = fmin(b->half[0], fmin(b->half[1], b->half[2]));
    const MdtBodyID body = w->bodies[w->numBodies++] = MdtBodyCreate(w->world);
    MdtBodySetMass(body, (MeReal)b->mass);
    MdtBodySetInertiaTensor(body, tensor);
    karma_setState(body, &b->start);
}

static MdtBodyID bodyAt(const EngineWorld *w, int index) {
    return index == SCENE_WORLD ? 0 : w->bodies[index];
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    w->joints[w->numJoints] = j;
    w->joined[w->numJoints++] = karma_join(w->world, bodyAt(w, j->child), bodyAt(w, j->parent), j);
}

static MdtContactID makeContact(const EngineWorld *w, const SceneContact *from) {
    const MdtContactID c = MdtContactCreate(w->world);
    MdtContactSetBodies(c, bodyAt(w, from->body), bodyAt(w, from->other));
    karma_setSurface(MdtContactGetParams(c), from->friction, from->restitution);
    MdtContactEnable(c);
    return c;
}

static void placeContact(MdtContactID c, const SceneContact *from) {
    MdtContactSetPosition(c, (MeReal)from->point[0], (MeReal)from->point[1], (MeReal)from->point[2]);
    MdtContactSetNormal(c, (MeReal)from->normal[0], (MeReal)from->normal[1], (MeReal)from->normal[2]);
    MdtContactSetPenetration(c, (MeReal)from->depth);
    for (unsigned int k = 0; k < 2; k++)
        MdtContactSetRadius(c, k, (MeReal)from->radius[k]);
}

static void measureArm(const EngineWorld *w, const SceneContact *from, double arm[3]) {
    MeVector3 centre;
    MdtBodyGetPosition(w->bodies[from->body], centre);
    for (int i = 0; i < 3; i++)
        arm[i] = from->point[i] - (double)centre[i];
}

static double distance(const double a[3], const double b[3]) {
    const double off[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(scene_dot(off, off));
}

/* Takes, of the old contacts that nobody has taken yet, the nearest of these bodies, if it is not too far: it is left
 * without its id. Returns null if there is none. */
static MdtContactID takeOld(Contact old[], int n, const Contact *like, double reach) {
    int best = -1;
    for (int i = 0; i < n; i++) {
        if (!old[i].id || old[i].body != like->body || old[i].other != like->other)
            continue;
        const double d = distance(old[i].arm, like->arm);
        if (d < reach) {
            reach = d;
            best = i;
        }
    }
    if (best < 0)
        return 0;
    const MdtContactID id = old[best].id;
    old[best].id = 0;
    return id;
}

static void destroyLeft(const Contact old[], int n) {
    for (int i = 0; i < n; i++)
        if (old[i].id)
            MdtContactDestroy(old[i].id);
}

/* New ones are made last, when there is room for them, and in their order: so the world's order depends on nothing but
 * what has happened. */
static void setContacts(EngineWorld *w, const SceneContact contacts[], int n) {
    Contact next[SCENE_MAX_CONTACTS];
    for (int i = 0; i < n; i++) {
        const SceneContact *from = &contacts[i];
        next[i] = (Contact){.body = from->body, .other = from->other};
        measureArm(w, from, next[i].arm);
        next[i].id = takeOld(w->contacts, w->numContacts, &next[i], .3 * w->sizes[from->body]);
    }
    destroyLeft(w->contacts, w->numContacts);
    for (int i = 0; i < n; i++) {
        if (!next[i].id)
            next[i].id = makeContact(w, &contacts[i]);
        placeContact(next[i].id, &contacts[i]);
        w->contacts[i] = next[i];
    }
    w->numContacts = n;
}

static void step(EngineWorld *w, double h) {
    for (int i = 0; i < w->numBodies; i++)
        karma_push(w->bodies[i], &w->from[i], w->time);
    for (int i = 0; i < w->numJoints; i++)
        if (w->joints[i]->path)
            karma_lead(w->joined[i], w->joints[i], w->time, h);
    w->time += h;
    MdtWorldStep(w->world, (MeReal)h);
    if (w->isStrict)
        w->isInexact |= karma_isInexact(w->world);
}

static bool hasGivenUp(EngineWorld *w) {
    return w->isInexact;
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    karma_getState(w->bodies[body], s);
}

static void destroy(EngineWorld *w) {
    MdtWorldDestroy(w->world);
    free(w);
}

static const char *const settings[] = {
    [ENGINE_RIGID] = "eps 0", [ENGINE_DEFAULTS] = "eps 1e-4", [ENGINE_ORDER_4] = "order 4", NULL};

#ifdef _ME_API_DOUBLE
#define ENGINE_KARMA engine_karma_double
#else
#define ENGINE_KARMA engine_karma_single
#endif

MEPUBLIC extern const Engine ENGINE_KARMA;
const Engine ENGINE_KARMA = {
    .name = KARMA_NAME,
    .version = ME_VERSION_STRING,
    .about = KARMA_PRECISION
    "; epsilon 0 or a world's 1e-4, order 2 or 4, gamma .2, the friction cone; contacts by the scene's "
    "code, not by Mcd, ahead of touch",
    .settings = settings,
    .bounces = true,
    .create = create,
    .addGround = addGround,
    .addBody = addBody,
    .addJoint = addJoint,
    .setContacts = setContacts,
    .step = step,
    .getState = getState,
    .hasGivenUp = hasGivenUp,
    .destroy = destroy,
};
