/* ODE with its defaults (ERP .2, CFM 1e-10 in double precision, 20 iterations of QuickStep). Contacts have the
 * pyramid that goes with the normal force (dContactApprox1), since without it the bound of friction is a force. */
#include "engine.h"

#include <ode/ode.h>

#include <stdlib.h>
#include <string.h>

enum { MAX_POINTS = 8 }; /* of a pair of shapes */

struct EngineWorld {
    dWorldID world;
    dSpaceID space; /* null: nothing collides */
    dJointGroupID contacts;
    void (*advance)(dWorldID, double);
    int numBodies;
    dBodyID bodies[SCENE_MAX_BODIES];
    double forces[SCENE_MAX_BODIES][3]; /* N */
};

static void stepExactly(dWorldID w, double h) {
    dWorldStep(w, h);
}

static void stepQuickly(dWorldID w, double h) {
    dWorldQuickStep(w, h);
}

/* ODE prints 'LCP internal error' every step; what comes of it shows in the errors. */
static void keepQuiet(int number, const char *text, va_list arguments) {
    (void)number;
    (void)text;
    (void)arguments;
}

static EngineWorld *create(int setting, const double gravity[3], bool collides) {
    static bool isReady = false;
    if (!isReady)
        dInitODE2(0);
    isReady = true;
    dSetMessageHandler(keepQuiet);
    dRandSetSeed(0); /* QuickStep shuffles its rows: every run alike */
    EngineWorld *w = calloc(1, sizeof *w);
    if (!w)
        abort();
    w->world = dWorldCreate();
    w->advance = setting ? stepQuickly : stepExactly;
    w->contacts = dJointGroupCreate(0);
    if (collides)
        w->space = dSimpleSpaceCreate(0);
    dWorldSetGravity(w->world, gravity[0], gravity[1], gravity[2]);
    return w;
}

static void addGround(EngineWorld *w) {
    dCreatePlane(w->space, 0, 1, 0, 0);
}

static void addShape(EngineWorld *w, dBodyID body, const SceneBody *b) {
    const double *half = b->half;
    const dGeomID geom = b->shape == SCENE_SPHERE ? dCreateSphere(w->space, half[0])
                                                  : dCreateBox(w->space, 2 * half[0], 2 * half[1], 2 * half[2]);
    dGeomSetBody(geom, body);
    dGeomSetData(geom, (void *)(size_t)b);
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    const SceneState *s = &b->start;
    memcpy(w->forces[w->numBodies], b->force, sizeof b->force);
    const dBodyID body = w->bodies[w->numBodies++] = dBodyCreate(w->world);
    dMass mass;
    if (b->shape == SCENE_SPHERE)
        dMassSetSphereTotal(&mass, b->mass, b->half[0]);
    else
        dMassSetBoxTotal(&mass, b->mass, 2 * b->half[0], 2 * b->half[1], 2 * b->half[2]);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, s->position[0], s->position[1], s->position[2]);
    dBodySetQuaternion(body, s->quaternion);
    dBodySetLinearVel(body, s->velocity[0], s->velocity[1], s->velocity[2]);
    dBodySetAngularVel(body, s->spin[0], s->spin[1], s->spin[2]);
    if (w->space)
        addShape(w, body, b);
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    const dJointID joint = j->kind == SCENE_HINGE ? dJointCreateHinge(w->world, 0) : dJointCreateBall(w->world, 0);
    dJointAttach(joint, w->bodies[j->child], j->parent == SCENE_WORLD ? 0 : w->bodies[j->parent]);
    if (j->kind == SCENE_BALL_JOINT) {
        dJointSetBallAnchor(joint, j->point[0], j->point[1], j->point[2]);
        return;
    }
    dJointSetHingeAnchor(joint, j->point[0], j->point[1], j->point[2]);
    dJointSetHingeAxis(joint, j->axis[0], j->axis[1], j->axis[2]);
}

static double largerOf(double a, double b) {
    return a > b ? a : b;
}

static void setSurface(dSurfaceParameters *surface, const SceneBody *a, const SceneBody *b) {
    surface->mode = dContactApprox1;
    surface->mu = largerOf(a ? a->friction : 0, b ? b->friction : 0);
    surface->bounce = largerOf(a ? a->restitution : 0, b ? b->restitution : 0);
    surface->bounce_vel = .001; /* m/s, as Karma's threshold */
    if (surface->bounce > 0)
        surface->mode |= dContactBounce;
}

static void meet(void *data, dGeomID g1, dGeomID g2) {
    EngineWorld *w = data;
    dContact contacts[MAX_POINTS];
    const int n = dCollide(g1, g2, MAX_POINTS, &contacts[0].geom, sizeof contacts[0]);
    for (int i = 0; i < n; i++) {
        setSurface(&contacts[i].surface, dGeomGetData(g1), dGeomGetData(g2));
        dJointAttach(dJointCreateContact(w->world, w->contacts, &contacts[i]), dGeomGetBody(g1), dGeomGetBody(g2));
    }
}

static void step(EngineWorld *w, double h) {
    for (int i = 0; i < w->numBodies; i++)
        if (scene_dot(w->forces[i], w->forces[i]) > 0)
            dBodyAddForce(w->bodies[i], w->forces[i][0], w->forces[i][1], w->forces[i][2]);
    if (w->space)
        dSpaceCollide(w->space, w, meet);
    w->advance(w->world, h);
    dJointGroupEmpty(w->contacts);
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    const dReal *position = dBodyGetPosition(w->bodies[body]), *quaternion = dBodyGetQuaternion(w->bodies[body]),
                *velocity = dBodyGetLinearVel(w->bodies[body]), *spin = dBodyGetAngularVel(w->bodies[body]);
    s->quaternion[0] = quaternion[0];
    for (int i = 0; i < 3; i++) {
        s->position[i] = position[i];
        s->quaternion[i + 1] = quaternion[i + 1];
        s->velocity[i] = velocity[i];
        s->spin[i] = spin[i];
    }
}

static void destroy(EngineWorld *w) {
    dJointGroupDestroy(w->contacts);
    if (w->space)
        dSpaceDestroy(w->space);
    dWorldDestroy(w->world);
    free(w);
}

static const char *const settings[] = {"Step", "QuickStep", NULL};

const Engine engine_ode = {
    .name = "ODE",
    .version = PEER_VERSION,
    .about =
        "double precision; its defaults: ERP .2, CFM 1e-10, QuickStep with 20 iterations; pyramid of dContactApprox1",
    .settings = settings,
    .bounces = true,
    .create = create,
    .addGround = addGround,
    .addBody = addBody,
    .addJoint = addJoint,
    .step = step,
    .getState = getState,
    .destroy = destroy,
};
