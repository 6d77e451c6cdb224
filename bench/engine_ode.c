/* ODE with its defaults (ERP .2, CFM 1e-10 in double precision, 20 iterations of QuickStep). Contacts have the
 * pyramid that goes with the normal force (dContactApprox1), since without it the bound of friction is a force. */
#include "engine.h"

#include <ode/ode.h>

#include <stdlib.h>
#include <string.h>

enum { MAX_POINTS = 8 /* of a pair of shapes */, MAX_HEAPED = 64 };

struct EngineWorld {
    dWorldID world;
    dSpaceID space;             /* null: nothing collides */
    dHeightfieldDataID terrain; /* null: none */
    dJointGroupID contacts;
    void (*advance)(dWorldID, double);
    int numBodies;
    dBodyID bodies[SCENE_MAX_BODIES]; /* null: it never moves */
    SceneBody from[SCENE_MAX_BODIES];
    const SceneJoint *joints[SCENE_MAX_JOINTS];
    dJointID joined[SCENE_MAX_JOINTS];
    int numJoints;
    double time; /* s */
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

static const int iterations[] = {0, 20, 100};

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
    if (setting)
        dWorldSetQuickStepNumIterations(w->world, iterations[setting]);
    w->contacts = dJointGroupCreate(0);
    if (collides)
        w->space = dSweepAndPruneSpaceCreate(0, dSAP_AXES_XZY);
    dWorldSetGravity(w->world, gravity[0], gravity[1], gravity[2]);
    return w;
}

static void addGround(EngineWorld *w) {
    dCreatePlane(w->space, 0, 1, 0, 0);
}

/* Its origin is the middle of the grid. */
static void addTerrain(EngineWorld *w, const SceneTerrain *t) {
    const double width = (t->xCount - 1) * t->step, depth = (t->zCount - 1) * t->step;
    w->terrain = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(w->terrain, t->heights, 1, width, depth, t->xCount, t->zCount, 1, 0, 1, 0);
    const dGeomID geom = dCreateHeightfield(w->space, w->terrain, 1);
    dGeomSetPosition(geom, t->x0 + width / 2, 0, t->z0 + depth / 2);
}

static void addCompound(EngineWorld *w, dBodyID body, const SceneBody *b) {
    for (int i = 0; i < b->numParts; i++) {
        const ScenePart *p = &b->parts[i];
        const dGeomID geom = dCreateBox(w->space, 2 * p->half[0], 2 * p->half[1], 2 * p->half[2]);
        dGeomSetData(geom, (void *)(size_t)b);
        dGeomSetBody(geom, body);
        dGeomSetOffsetPosition(geom, p->position[0], p->position[1], p->position[2]);
        dGeomSetOffsetQuaternion(geom, p->quaternion);
    }
}

static void addShape(EngineWorld *w, dBodyID body, const SceneBody *b) {
    if (b->shape == SCENE_COMPOUND) {
        addCompound(w, body, b);
        return;
    }
    const double *half = b->half, *p = b->start.position;
    const dGeomID geom = b->shape == SCENE_SPHERE     ? dCreateSphere(w->space, half[0])
                         : b->shape == SCENE_CAPSULE  ? dCreateCapsule(w->space, half[0], 2 * (half[2] - half[0]))
                         : b->shape == SCENE_CYLINDER ? dCreateCylinder(w->space, half[0], 2 * half[2])
                                                      : dCreateBox(w->space, 2 * half[0], 2 * half[1], 2 * half[2]);
    dGeomSetData(geom, (void *)(size_t)b);
    if (body) {
        dGeomSetBody(geom, body);
        return;
    }
    dGeomSetPosition(geom, p[0], p[1], p[2]);
    dGeomSetQuaternion(geom, b->start.quaternion);
}

static dBodyID makeBody(EngineWorld *w, const SceneBody *b) {
    const SceneState *s = &b->start;
    const dBodyID body = dBodyCreate(w->world);
    double inertia[3];
    dMass mass;
    scene_inertia(b, inertia);
    dMassSetParameters(&mass, b->mass, 0, 0, 0, inertia[0], inertia[1], inertia[2], 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, s->position[0], s->position[1], s->position[2]);
    dBodySetQuaternion(body, s->quaternion);
    dBodySetLinearVel(body, s->velocity[0], s->velocity[1], s->velocity[2]);
    dBodySetAngularVel(body, s->spin[0], s->spin[1], s->spin[2]);
    return body;
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    const dBodyID body = b->mass > 0 ? makeBody(w, b) : NULL;
    w->from[w->numBodies] = *b;
    if (w->space)
        addShape(w, body, &w->from[w->numBodies]);
    w->bodies[w->numBodies++] = body;
}

static void setHinge(dJointID joint, const SceneJoint *j) {
    dJointSetHingeAnchor(joint, j->point[0], j->point[1], j->point[2]);
    dJointSetHingeAxis(joint, j->axis[0], j->axis[1], j->axis[2]);
    if (j->stops[0] < j->stops[1]) {
        dJointSetHingeParam(joint, dParamLoStop, j->stops[0]);
        dJointSetHingeParam(joint, dParamHiStop, j->stops[1]);
    }
    if (j->torque > 0) {
        dJointSetHingeParam(joint, dParamVel, j->speed);
        dJointSetHingeParam(joint, dParamFMax, j->torque);
    }
}

/* A stop without play whose ERP and CFM are those of an implicit spring for this step. */
static void setSpring(dJointID joint, const SceneJoint *j, double h) {
    const double impulse = h * j->stiffness + j->damping;
    dJointSetHingeParam(joint, dParamLoStop, j->rest);
    dJointSetHingeParam(joint, dParamHiStop, j->rest);
    dJointSetHingeParam(joint, dParamStopERP, h * j->stiffness / impulse);
    dJointSetHingeParam(joint, dParamStopCFM, 1 / impulse);
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    const dJointID joint = j->kind == SCENE_HINGE ? dJointCreateHinge(w->world, 0) : dJointCreateBall(w->world, 0);
    dJointAttach(joint, w->bodies[j->child], j->parent == SCENE_WORLD ? 0 : w->bodies[j->parent]);
    if (j->kind == SCENE_BALL_JOINT)
        dJointSetBallAnchor(joint, j->point[0], j->point[1], j->point[2]);
    else
        setHinge(joint, j);
    w->joints[w->numJoints] = j;
    w->joined[w->numJoints++] = joint;
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
    const dBodyID b1 = dGeomGetBody(g1), b2 = dGeomGetBody(g2);
    dContact contacts[MAX_POINTS];
    if (b1 == b2 || (b1 && b2 && dAreConnectedExcluding(b1, b2, dJointTypeContact)))
        return;
    const int n = dCollide(g1, g2, MAX_POINTS, &contacts[0].geom, sizeof contacts[0]);
    for (int i = 0; i < n; i++) {
        setSurface(&contacts[i].surface, dGeomGetData(g1), dGeomGetData(g2));
        dJointAttach(dJointCreateContact(w->world, w->contacts, &contacts[i]), b1, b2);
    }
}

static void step(EngineWorld *w, double h) {
    for (int i = 0; i < w->numBodies; i++) {
        const double *force = w->from[i].force;
        if (w->bodies[i] && scene_isPushed(&w->from[i], w->time))
            dBodyAddForce(w->bodies[i], force[0], force[1], force[2]);
    }
    for (int i = 0; i < w->numJoints; i++)
        if (w->joints[i]->stiffness > 0)
            setSpring(w->joined[i], w->joints[i], h);
    for (int i = 0; i < w->numJoints; i++)
        if (w->joints[i]->path)
            dJointSetHingeParam(w->joined[i], dParamVel, scene_motorSpeed(w->joints[i], w->time, h));
    w->time += h;
    if (w->space)
        dSpaceCollide(w->space, w, meet);
    w->advance(w->world, h);
    dJointGroupEmpty(w->contacts);
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    if (!w->bodies[body]) {
        *s = w->from[body].start;
        return;
    }
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
    if (w->terrain)
        dGeomHeightfieldDataDestroy(w->terrain);
    dWorldDestroy(w->world);
    free(w);
}

static const char *const settings[] = {"Step", "QuickStep", "QuickStep 100", NULL};

/* dWorldStep factors a dense matrix of all rows of a partition; a step cannot be ended while it runs. */
static const char *lack(const Scene *scene, const SceneWorld *world, int setting) {
    (void)world;
    return setting == 0 && scene->heaped > MAX_HEAPED ? "dWorldStep takes minutes for a step of so large a partition"
                                                      : NULL;
}

const Engine engine_ode = {
    .name = "ODE",
    .version = PEER_VERSION,
    .about = "double precision; its defaults: ERP .2, CFM 1e-10, QuickStep with 20 iterations (or 100); pyramid of "
             "dContactApprox1",
    .settings = settings,
    .bounces = true,
    .lack = lack,
    .create = create,
    .addGround = addGround,
    .addTerrain = addTerrain,
    .addBody = addBody,
    .addJoint = addJoint,
    .step = step,
    .getState = getState,
    .destroy = destroy,
};
