/* Karma, rigid (epsilon 0). It has no collision yet: its contacts are the scene's. */
#include "engine.h"

#include "Mdt.h"
#include "MeVersion.h"

#include <stdlib.h>

struct EngineWorld {
    MdtWorldID world;
    MdtBodyID bodies[SCENE_MAX_BODIES];
    int numBodies;
    MdtContactID contacts[SCENE_MAX_CONTACTS];
    int numContacts;
};

static EngineWorld *create(int setting, const double gravity[3], bool collides) {
    (void)setting;
    EngineWorld *w = calloc(1, sizeof *w);
    if (!w)
        abort();
    w->world = MdtWorldCreate(SCENE_MAX_BODIES, SCENE_MAX_JOINTS + (collides ? SCENE_MAX_CONTACTS : 0));
    MdtWorldSetAutoDisable(w->world, 0);
    MdtWorldSetEpsilon(w->world, 0);
    MdtWorldSetGravity(w->world, (MeReal)gravity[0], (MeReal)gravity[1], (MeReal)gravity[2]);
    return w;
}

static void addGround(EngineWorld *w) {
    (void)w; /* it is where the contacts are */
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    const SceneState *s = &b->start;
    double inertia[3];
    scene_inertia(b, inertia);
    const MeMatrix3 tensor = {{(MeReal)inertia[0], 0, 0}, {0, (MeReal)inertia[1], 0}, {0, 0, (MeReal)inertia[2]}};
    const MdtBodyID body = w->bodies[w->numBodies++] = MdtBodyCreate(w->world);
    MdtBodySetMass(body, (MeReal)b->mass);
    MdtBodySetInertiaTensor(body, tensor);
    MdtBodySetPosition(body, (MeReal)s->position[0], (MeReal)s->position[1], (MeReal)s->position[2]);
    MdtBodySetQuaternion(body, (MeReal)s->quaternion[0], (MeReal)s->quaternion[1], (MeReal)s->quaternion[2],
                         (MeReal)s->quaternion[3]);
    MdtBodySetLinearVelocity(body, (MeReal)s->velocity[0], (MeReal)s->velocity[1], (MeReal)s->velocity[2]);
    MdtBodySetAngularVelocity(body, (MeReal)s->spin[0], (MeReal)s->spin[1], (MeReal)s->spin[2]);
    MdtBodyEnable(body);
}

static MdtBodyID bodyAt(const EngineWorld *w, int index) {
    return index == SCENE_WORLD ? 0 : w->bodies[index];
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    const MdtConstraintID c = j->kind == SCENE_HINGE ? MdtHingeQuaConstraint(MdtHingeCreate(w->world))
                                                     : MdtBSJointQuaConstraint(MdtBSJointCreate(w->world));
    MdtConstraintSetBodies(c, bodyAt(w, j->child), bodyAt(w, j->parent));
    MdtConstraintSetPosition(c, (MeReal)j->point[0], (MeReal)j->point[1], (MeReal)j->point[2]);
    if (j->kind == SCENE_HINGE)
        MdtConstraintSetAxis(c, (MeReal)j->axis[0], (MeReal)j->axis[1], (MeReal)j->axis[2]);
    MdtConstraintEnable(c);
}

static MdtContactID makeContact(const EngineWorld *w, const SceneContact *from) {
    const MdtContactID c = MdtContactCreate(w->world);
    MdtContactSetBodies(c, bodyAt(w, from->body), bodyAt(w, from->other));
    MdtContactSetPosition(c, (MeReal)from->point[0], (MeReal)from->point[1], (MeReal)from->point[2]);
    MdtContactSetNormal(c, (MeReal)from->normal[0], (MeReal)from->normal[1], (MeReal)from->normal[2]);
    MdtContactSetPenetration(c, (MeReal)from->depth);
    const MdtContactParamsID p = MdtContactGetParams(c);
    if (from->friction > 0) {
        MdtContactParamsSetType(p, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(p, (MeReal)from->friction);
    }
    MdtContactParamsSetRestitution(p, (MeReal)from->restitution);
    MdtContactEnable(c);
    return c;
}

static void setContacts(EngineWorld *w, const SceneContact contacts[], int n) {
    while (w->numContacts > 0)
        MdtContactDestroy(w->contacts[--w->numContacts]);
    while (w->numContacts < n) {
        w->contacts[w->numContacts] = makeContact(w, &contacts[w->numContacts]);
        w->numContacts++;
    }
}

static void step(EngineWorld *w, double h) {
    MdtWorldStep(w->world, (MeReal)h);
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    MeVector3 position, velocity, spin;
    MeVector4 quaternion;
    MdtBodyGetPosition(w->bodies[body], position);
    MdtBodyGetQuaternion(w->bodies[body], quaternion);
    MdtBodyGetLinearVelocity(w->bodies[body], velocity);
    MdtBodyGetAngularVelocity(w->bodies[body], spin);
    s->quaternion[0] = (double)quaternion[0];
    for (int i = 0; i < 3; i++) {
        s->position[i] = (double)position[i];
        s->quaternion[i + 1] = (double)quaternion[i + 1];
        s->velocity[i] = (double)velocity[i];
        s->spin[i] = (double)spin[i];
    }
}

static void destroy(EngineWorld *w) {
    MdtWorldDestroy(w->world);
    free(w);
}

static const char *const settings[] = {"eps 0", NULL};

#ifdef _ME_API_DOUBLE
#define NAME         "Karma double"
#define ABOUT        "double precision"
#define ENGINE_KARMA engine_karma_double
#else
#define NAME         "Karma single"
#define ABOUT        "single precision"
#define ENGINE_KARMA engine_karma_single
#endif

MEPUBLIC extern const Engine ENGINE_KARMA;
const Engine ENGINE_KARMA = {
    .name = NAME,
    .version = ME_VERSION_STRING,
    .about = ABOUT
    "; epsilon 0, gamma .2, the friction cone; no collision yet: contacts by the scene's code, ahead of touch",
    .settings = settings,
    .bounces = true,
    .create = create,
    .addGround = addGround,
    .addBody = addBody,
    .addJoint = addJoint,
    .setContacts = setContacts,
    .step = step,
    .getState = getState,
    .destroy = destroy,
};
