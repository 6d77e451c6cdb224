/* MuJoCo with its defaults: the Newton solver, pyramidal friction, and the Euler, the implicit or the RK4
 * integrator.
 *
 * A model is compiled from XML before it can be simulated, so bodies and joints are collected until the first step.
 * Joints are MuJoCo's own kind, coordinates of a tree, whose gaps are 0 by construction; those that close loops are
 * constraints. It has no restitution. */
#include "engine.h"

#include <mujoco/mujoco.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TEXT = 1 << 20, MAX_BODIES = 250, MAX_DEPTH = 90 /* its reader of XML nests to 100 */ };

static const double unreachable = 100; /* rad/s: a motor of such a speed is a constant torque */

struct EngineWorld {
    int setting, numBodies;
    bool collides, hasGround;
    double gravity[3];
    const SceneTerrain *terrain; /* null: none */
    SceneBody bodies[SCENE_MAX_BODIES];
    const SceneJoint *joints[SCENE_MAX_BODIES]; /* the first of each child; null: free */
    const SceneJoint *loops[SCENE_MAX_JOINTS];  /* the others */
    int numLoops;
    int ids[SCENE_MAX_BODIES]; /* the model's */
    char text[MAX_TEXT];       /* of the model */
    size_t length;
    mjModel *model;
    mjData *data;
    double time;  /* s */
    bool hasNone; /* it could not be made */
    bool isFresh; /* what getState reads has been computed since the last step */
};

static const char *const settings[] = {"Euler", "implicit", "RK4", NULL};

/* The model as XML */

static void say(EngineWorld *w, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    w->length += (size_t)vsnprintf(w->text + w->length, MAX_TEXT - w->length, format, arguments);
    va_end(arguments);
    if (w->length >= MAX_TEXT)
        abort();
}

static void sayNumbers(EngineWorld *w, const char *name, const double values[], int n) {
    say(w, " %s='", name);
    for (int i = 0; i < n; i++)
        say(w, "%.17g ", values[i]);
    say(w, "'");
}

static void sayPose(EngineWorld *w, const SceneState *s, const SceneState *parent) {
    double position[3], quaternion[4], back[4];
    for (int i = 0; i < 3; i++)
        position[i] = s->position[i] - parent->position[i];
    scene_rotateBack(parent->quaternion, position, position);
    mju_negQuat(back, parent->quaternion);
    mju_mulQuat(quaternion, back, s->quaternion);
    sayNumbers(w, "pos", position, 3);
    sayNumbers(w, "quat", quaternion, 4);
}

static void sayJoint(EngineWorld *w, const SceneJoint *j, const SceneState *s) {
    if (!j) {
        say(w, "<freejoint/>");
        return;
    }
    double point[3], axis[3];
    for (int i = 0; i < 3; i++)
        point[i] = j->point[i] - s->position[i];
    scene_rotateBack(s->quaternion, point, point);
    scene_rotateBack(s->quaternion, j->axis, axis);
    say(w, "<joint type='%s'", j->kind == SCENE_HINGE ? "hinge" : "ball");
    sayNumbers(w, "pos", point, 3);
    if (j->kind == SCENE_HINGE)
        sayNumbers(w, "axis", axis, 3);
    if (j->stops[0] < j->stops[1]) {
        say(w, " limited='true'");
        sayNumbers(w, "range", j->stops, 2);
    }
    if (j->stiffness > 0)
        say(w, " stiffness='%.17g' damping='%.17g' springref='%.17g'", j->stiffness, j->damping, j->rest);
    say(w, "/>");
}

static void sayMass(EngineWorld *w, const SceneBody *b) {
    double inertia[3];
    scene_inertia(b, inertia);
    say(w, "<inertial pos='0 0 0' mass='%.17g'", b->mass);
    sayNumbers(w, "diaginertia", inertia, 3);
    say(w, "/>");
}

static void sayGeom(EngineWorld *w, const SceneBody *b, const char *type) {
    say(w, "<geom type='%s' friction='%.17g .005 .0001' contype='%d' conaffinity='%d'", type, b->friction, w->collides,
        w->collides);
}

static void sayParts(EngineWorld *w, const SceneBody *b) {
    for (int i = 0; i < b->numParts; i++) {
        sayGeom(w, b, "box");
        sayNumbers(w, "pos", b->parts[i].position, 3);
        sayNumbers(w, "quat", b->parts[i].quaternion, 4);
        sayNumbers(w, "size", b->parts[i].half, 3);
        say(w, "/>");
    }
}

static void sayShape(EngineWorld *w, const SceneBody *b) {
    static const char *const types[] = {
        [SCENE_BOX] = "box", [SCENE_SPHERE] = "sphere", [SCENE_CAPSULE] = "capsule", [SCENE_CYLINDER] = "cylinder"};
    const double capsule[2] = {b->half[0], b->half[2] - b->half[0]}, cylinder[2] = {b->half[0], b->half[2]};
    if (b->mass > 0)
        sayMass(w, b);
    if (b->shape == SCENE_COMPOUND) {
        sayParts(w, b);
        return;
    }
    sayGeom(w, b, types[b->shape]);
    if (b->shape == SCENE_CAPSULE)
        sayNumbers(w, "size", capsule, 2);
    else if (b->shape == SCENE_CYLINDER)
        sayNumbers(w, "size", cylinder, 2);
    else
        sayNumbers(w, "size", b->half, b->shape == SCENE_SPHERE ? 1 : 3);
    say(w, "/>");
}

static void sayChildren(EngineWorld *w, int parent);

static void sayBody(EngineWorld *w, int i, const SceneState *parent) {
    const SceneBody *b = &w->bodies[i];
    say(w, "<body name='b%d'", i);
    sayPose(w, &b->start, parent);
    say(w, ">");
    if (b->mass > 0)
        sayJoint(w, w->joints[i], &b->start);
    sayShape(w, b);
    sayChildren(w, i);
    say(w, "</body>\n");
}

static void sayChildren(EngineWorld *w, int parent) {
    static const SceneState origin = {.quaternion = {1}};
    for (int i = 0; i < w->numBodies; i++)
        if ((w->joints[i] ? w->joints[i]->parent : SCENE_WORLD) == parent)
            sayBody(w, i, parent == SCENE_WORLD ? &origin : &w->bodies[parent].start);
}

/* They are met softly, and their bodies do not collide. */
static void sayLoops(EngineWorld *w) {
    if (w->numLoops == 0)
        return;
    say(w, "<equality>");
    for (int i = 0; i < w->numLoops; i++) {
        const SceneJoint *j = w->loops[i];
        double anchor[3];
        for (int c = 0; c < 3; c++)
            anchor[c] = j->point[c] - w->bodies[j->child].start.position[c];
        scene_rotateBack(w->bodies[j->child].start.quaternion, anchor, anchor);
        say(w, "<connect body1='b%d'", j->child);
        if (j->parent != SCENE_WORLD)
            say(w, " body2='b%d'", j->parent);
        sayNumbers(w, "anchor", anchor, 3);
        say(w, "/>\n");
    }
    say(w, "</equality><contact>");
    for (int i = 0; i < w->numLoops; i++)
        if (w->loops[i]->parent != SCENE_WORLD)
            say(w, "<exclude body1='b%d' body2='b%d'/>", w->loops[i]->child, w->loops[i]->parent);
    say(w, "</contact>");
}

/* m */
static void findHeights(const SceneTerrain *t, double *low, double *high) {
    *low = *high = t->heights[0];
    for (int i = 1; i < t->xCount * t->zCount; i++) {
        *low = fmin(*low, t->heights[i]);
        *high = fmax(*high, t->heights[i]);
    }
}

/* Its z is up, so its y is -z here; its origin is the middle of the grid, its lowest height 0. Below that it is a metre
 * thick. */
static void sayTerrain(EngineWorld *w, const SceneTerrain *t) {
    double low, high;
    findHeights(t, &low, &high);
    const double width = (t->xCount - 1) * t->step / 2, depth = (t->zCount - 1) * t->step / 2;
    const double size[4] = {width, depth, high - low, 1}, place[3] = {t->x0 + width, low, t->z0 + depth};
    say(w, "<asset><hfield name='terrain' nrow='%d' ncol='%d'", t->zCount, t->xCount);
    sayNumbers(w, "size", size, 4);
    say(w, "/></asset><worldbody><geom type='hfield' hfield='terrain' friction='0 .005 .0001' euler='%.17g 0 0'",
        -acos(0));
    sayNumbers(w, "pos", place, 3);
    say(w, "/></worldbody>");
}

/* As shares of the highest, its rows in the other order. */
static void setTerrain(mjModel *m, const SceneTerrain *t) {
    double low, high;
    findHeights(t, &low, &high);
    for (int k = 0; k < t->zCount; k++)
        for (int i = 0; i < t->xCount; i++)
            m->hfield_data[k * t->xCount + i] =
                (float)((t->heights[(t->zCount - 1 - k) * t->xCount + i] - low) / (high - low));
}

static void sayModel(EngineWorld *w) {
    say(w, "<mujoco><compiler angle='radian'/><option integrator='%s'", settings[w->setting]);
    sayNumbers(w, "gravity", w->gravity, 3);
    say(w, "/>");
    if (w->collides) /* else bodies fall through the ground where the default 500 rows are used up */
        say(w, "<size nconmax='%d' njmax='%d'/>", 100 + 16 * w->numBodies, 500 + 64 * w->numBodies);
    if (w->terrain)
        sayTerrain(w, w->terrain);
    say(w, "<worldbody>");
    if (w->hasGround) /* its normal is its z-axis */
        say(w, "<geom type='plane' size='1 1 1' zaxis='0 1 0' friction='0 .005 .0001'/>");
    sayChildren(w, SCENE_WORLD);
    say(w, "</worldbody>");
    sayLoops(w);
    say(w, "</mujoco>");
}

/* Compiling it */

static void keepQuiet(const char *text) {
    (void)text; /* else they go to a file in the working directory */
}

/* Null, with a message, if there is no memory for it. */
static mjModel *compile(const char *text, size_t length) {
    char error[500] = "";
    mjVFS *files = malloc(sizeof *files);
    if (!files)
        abort();
    mj_defaultVFS(files);
    mj_makeEmptyFileVFS(files, "scene.xml", (int)length);
    memcpy(files->filedata[0], text, length);
    mjModel *model = mj_loadXML("scene.xml", files, error, sizeof error);
    mj_deleteVFS(files);
    free(files);
    if (!model)
        fprintf(stderr, "MuJoCo does not take its model: %s\n", error);
    return model;
}

/* Linear in the world's axes, angular in the body's, against the parent's. */
static void setVelocity(EngineWorld *w, int i) {
    const SceneState *s = &w->bodies[i].start;
    const SceneJoint *j = w->joints[i];
    if (w->bodies[i].mass <= 0)
        return;
    double *at = w->data->qvel + w->model->body_dofadr[w->ids[i]], spin[3], local[3];
    for (int c = 0; c < 3; c++)
        spin[c] = s->spin[c] - (j && j->parent != SCENE_WORLD ? w->bodies[j->parent].start.spin[c] : 0);
    scene_rotateBack(s->quaternion, spin, local);
    if (!j)
        memcpy(at, s->velocity, sizeof s->velocity);
    if (j && j->kind == SCENE_HINGE)
        at[0] = scene_dot(spin, j->axis);
    else
        memcpy(j ? at : at + 3, local, sizeof local);
}

/* They stay until they are set anew. */
static void setForce(EngineWorld *w, int i) {
    const SceneJoint *j = w->joints[i];
    for (int c = 0; c < 3; c++)
        w->data->xfrc_applied[6 * w->ids[i] + c] = scene_isPushed(&w->bodies[i], w->time) ? w->bodies[i].force[c] : 0;
    if (j && j->torque > 0)
        w->data->qfrc_applied[w->model->body_dofadr[w->ids[i]]] = j->speed > 0 ? j->torque : -j->torque;
}

static void makeModel(EngineWorld *w) {
    mju_user_warning = keepQuiet;
    sayModel(w);
    w->model = compile(w->text, w->length);
    w->hasNone = !w->model;
    if (w->hasNone)
        return;
    if (w->terrain)
        setTerrain(w->model, w->terrain);
    w->data = mj_makeData(w->model);
    for (int i = 0; i < w->numBodies; i++) {
        char name[16];
        snprintf(name, sizeof name, "b%d", i);
        w->ids[i] = mj_name2id(w->model, mjOBJ_BODY, name);
        setVelocity(w, i);
        setForce(w, i);
    }
}

/* The interface */

static EngineWorld *create(int setting, const double gravity[3], bool collides) {
    EngineWorld *w = calloc(1, sizeof *w);
    if (!w)
        abort();
    w->setting = setting;
    w->collides = collides;
    memcpy(w->gravity, gravity, sizeof w->gravity);
    return w;
}

static void addGround(EngineWorld *w) {
    w->hasGround = true;
}

static void addTerrain(EngineWorld *w, const SceneTerrain *t) {
    w->terrain = t;
}

static void addBody(EngineWorld *w, const SceneBody *b) {
    w->bodies[w->numBodies++] = *b;
}

static void addJoint(EngineWorld *w, const SceneJoint *j) {
    if (w->joints[j->child])
        w->loops[w->numLoops++] = j;
    else
        w->joints[j->child] = j;
}

static void step(EngineWorld *w, double h) {
    if (w->hasNone)
        return;
    for (int i = 0; i < w->numBodies; i++)
        if (w->bodies[i].forceEnds > 0)
            setForce(w, i);
    w->time += h;
    w->model->opt.timestep = h;
    mj_step(w->model, w->data);
    w->isFresh = false;
}

/* mj_step leaves the poses of the step's start. */
static void refresh(EngineWorld *w) {
    if (!w->model && !w->hasNone)
        makeModel(w);
    if (w->isFresh || w->hasNone)
        return;
    mj_kinematics(w->model, w->data);
    mj_comPos(w->model, w->data);
    mj_comVel(w->model, w->data);
    w->isFresh = true;
}

static void getState(EngineWorld *w, int body, SceneState *s) {
    double motion[6];
    refresh(w);
    if (w->hasNone) {
        *s = w->bodies[body].start;
        return;
    }
    memcpy(s->position, w->data->xpos + 3 * w->ids[body], sizeof s->position);
    memcpy(s->quaternion, w->data->xquat + 4 * w->ids[body], sizeof s->quaternion);
    mj_objectVelocity(w->model, w->data, mjOBJ_XBODY, w->ids[body], motion, 0);
    memcpy(s->spin, motion, sizeof s->spin);
    memcpy(s->velocity, motion + 3, sizeof s->velocity);
}

/* It starts anew from the first pose after a number that is none or too large, and leaves out what has no room. */
static bool hasGivenUp(EngineWorld *w) {
    if (w->hasNone)
        return true;
    const mjWarningStat *warnings = w->data->warning;
    return warnings[mjWARN_CONTACTFULL].number || warnings[mjWARN_CNSTRFULL].number ||
           warnings[mjWARN_BADQPOS].number || warnings[mjWARN_BADQVEL].number || warnings[mjWARN_BADQACC].number;
}

static void destroy(EngineWorld *w) {
    if (!w->hasNone) {
        mj_deleteData(w->data);
        mj_deleteModel(w->model);
    }
    free(w);
}

/* Of the tree of bodies: parents stand before their children. */
static int depthOf(const SceneWorld *world) {
    int depths[SCENE_MAX_BODIES] = {0}, deepest = 0;
    for (int i = 0; i < world->numJoints; i++) {
        const SceneJoint *j = &world->joints[i];
        if (depths[j->child] == 0)
            depths[j->child] = 1 + (j->parent == SCENE_WORLD ? 0 : depths[j->parent]);
        deepest = depths[j->child] > deepest ? depths[j->child] : deepest;
    }
    return deepest;
}

static const char *lack(const Scene *scene, const SceneWorld *world, int setting) {
    (void)scene, (void)setting;
    if (depthOf(world) > MAX_DEPTH)
        return "its XML does not nest so deep";
    for (int i = 0; i < world->numJoints; i++)
        if (world->joints[i].torque > 0 && fabs(world->joints[i].speed) < unreachable)
            return "no motor that holds a speed with a bounded torque";
    return world->numBodies > MAX_BODIES ? "no memory for its dense matrix of so many bodies" : NULL;
}

const Engine engine_mujoco = {
    .name = "MuJoCo",
    .version = PEER_VERSION,
    .about =
        "double precision; its defaults: Newton, friction pyramid, soft contacts; joints are coordinates, those that "
        "close loops soft constraints; no restitution",
    .settings = settings,
    .crowds = 1,
    .lack = lack,
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
