/* Scenes whose right answer is known, as plain data: for the tests of Karma and for comparing engines.
 *
 * A scene builds a SceneWorld; whoever simulates it hands the states of all bodies to `observe` at the start and after
 * every frame, and asks `measure` for the errors at the end. Nothing here knows an engine. SI units, y up. */
#ifndef SCENES_SCENE_H
#define SCENES_SCENE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SCENE_FRAME (1.0 / 60) /* s, one picture of a game */
#define SCENE_WORLD (-1)       /* in place of a body's index */

enum { SCENE_MAX_BODIES = 1200, SCENE_MAX_JOINTS = 1024, SCENE_MAX_ERRORS = 3 };
enum { SCENE_MAX_PARTS = 36, SCENE_MAX_HEIGHTS = 4000 };

typedef struct SceneState {
    double position[3];   /* m, of the centre of mass */
    double quaternion[4]; /* w x y z, body to world */
    double velocity[3];   /* m/s */
    double spin[3];       /* rad/s, in the world's axes */
} SceneState;

typedef enum SceneShape { SCENE_BOX, SCENE_SPHERE, SCENE_CAPSULE, SCENE_CYLINDER, SCENE_COMPOUND } SceneShape;

/* A box of a compound, in the body's axes, whose origin is the centre of mass. */
typedef struct ScenePart {
    double half[3], position[3]; /* m */
    double quaternion[4];        /* w x y z */
} ScenePart;

/* Solid and of one density, but for compounds, which say their inertia. Where two touch, the larger friction and the
 * larger restitution hold; the ground has 0. */
typedef struct SceneBody {
    SceneShape shape;
    double
        half[3]; /* m, half edges; a sphere's radius, three times; of a capsule and of a cylinder its radius, twice, and
                  half its length, along z; of a compound the half edges of a box around it */
    double mass; /* kg; 0: it never moves */
    double inertia[3]; /* kg m², about its own axes, if not those of one density; else 0 */
    double friction, restitution;
    double force[3];        /* N, that pushes its centre of mass, */
    double forceEnds;       /* s, until then; 0: all the time */
    const ScenePart *parts; /* of a compound: in its world, which must live as long */
    int numParts;
    SceneState start;
} SceneBody;

typedef enum SceneJointKind { SCENE_BALL_JOINT, SCENE_HINGE } SceneJointKind;

/* The first joint of each child makes a tree; further ones close loops. An engine that closes them with constraints
 * may hold a hinge there by its point alone, which in a plane linkage is the same. Bodies that are joined do not
 * collide. Angles of a hinge are the child's against the parent, about the axis, 0 at the start. */
typedef struct SceneJoint {
    SceneJointKind kind;
    int child, parent;         /* indices of bodies; the parent may be SCENE_WORLD */
    double point[3];           /* m, in the world, at the start */
    double axis[3];            /* unit, in the world, at the start; of a hinge */
    double stops[2];           /* rad, the least and the largest angle of a hinge; both 0: none */
    double speed;              /* rad/s, of a hinge's motor */
    double torque;             /* N m, the largest of the motor; 0: there is none */
    double stiffness, damping; /* N m/rad, N m s/rad, of a hinge's spring; both 0: there is none */
    double rest;               /* rad, where the spring has no torque */
    /* rad: where the motor is to have led the hinge to at that time; null: it keeps its speed */
    double (*path)(double time);
} SceneJoint;

/* Heights over a grid: the point (i, k) is at x0 + i step, heights[k xCount + i], z0 + k step. A cell is two triangles,
 * on either side of the line from (i + 1, k) to (i, k + 1). Above is outside; no friction of its own. */
typedef struct SceneTerrain {
    int xCount, zCount;                /* 0: there is none */
    double x0, z0, step;               /* m */
    double heights[SCENE_MAX_HEIGHTS]; /* m */
} SceneTerrain;

typedef struct SceneWorld {
    double gravity[3]; /* m/s² */
    bool collides;     /* the bodies with each other and with the ground: the terrain, or else the plane y = 0 */
    int numBodies, numJoints, numParts;
    SceneTerrain terrain;
    ScenePart parts[SCENE_MAX_PARTS]; /* of all compounds */
    SceneBody bodies[SCENE_MAX_BODIES];
    SceneJoint joints[SCENE_MAX_JOINTS];
} SceneWorld;

/* What is noted while a scene runs. Each scene uses what it needs. */
typedef struct SceneTrace {
    double energy;                      /* J, at the start */
    double worst[SCENE_MAX_ERRORS];     /* the largest errors so far */
    double lastTime;                    /* s, of the states that were seen last, */
    SceneState last[SCENE_MAX_BODIES];  /* and these */
    double before[SCENE_MAX_BODIES][3]; /* m, positions a frame before that */
    double marked[SCENE_MAX_BODIES][3]; /* m, positions at some time */
    double sums[2][2];                  /* of weights, and of something with these weights, in two spans of time */
    double reference[6];                /* a state that is integrated along with the scene */
    int events[2];                      /* crossings, flips, bounces of the first and of the second body */
    double firstEvent, lastEvent;       /* s */
    double top[2][2];                   /* m, the tops of the first two bounces, by body */
    bool isDone;                        /* nothing more to see */
} SceneTrace;

typedef struct SceneError {
    const char *name; /* with its unit, or none for a ratio; null: there are no more */
    double fails;     /* an error this large means that the scene has failed */
    double goal;      /* what Karma is to reach with one step per frame; where it does, the tests assert it */
} SceneError;

typedef struct Scene Scene;
struct Scene {
    const char *name;
    const char *text; /* what happens, and what the errors are */
    double parameter; /* mass [kg] where several scenes are alike */
    int count;        /* of links, where several are alike; of the boxes of a heap */
    double duration;  /* s, at most */
    double frame;     /* s, between two looks at the states, where it is not SCENE_FRAME; else 0 */
    bool bounces;     /* needs restitution */
    bool hasEdges;    /* edges meet faces: needs an engine that finds contacts itself (contacts.h does not) */
    int heaped;       /* bodies that lean on each other, all in one partition, where they are many; else 0 */
    bool isCrowd;     /* many bodies: fewer settings are compared */
    SceneError errors[SCENE_MAX_ERRORS];
    void (*build)(const Scene *scene, SceneWorld *world);
    void (*observe)(SceneTrace *trace, const SceneWorld *world, const SceneState states[], double time);
    void (*measure)(const SceneTrace *trace, const SceneWorld *world, double errors[SCENE_MAX_ERRORS]);
};

extern const Scene *const scenes[]; /* ends with a null */
/* Not among them: the map of stability sets the parameter (mass ratio; for the beam Hz, of a link on its spring) and
 * the count. */
extern const Scene scenes_mapChain, scenes_mapTower, scenes_mapBeam;
#define SCENE_MAP_FRAME (1.0 / 15) /* s, the longest step of the map */

/* s, between two looks at the states. */
double scene_frame(const Scene *s);
/* Null if there is none of that name. */
const Scene *scene_find(const char *name);

/* At rest, or not yet placed. */
SceneBody *scene_addBox(SceneWorld *w, double mass, double lx, double ly, double lz, double x, double y, double z);
SceneBody *scene_addSphere(SceneWorld *w, double mass, double radius, double x, double y, double z);
SceneBody *scene_addCapsule(SceneWorld *w, double mass, double radius, double length, double x, double y, double z);
SceneBody *scene_addCylinder(SceneWorld *w, double mass, double radius, double length, double x, double y, double z);
/* Without parts yet. */
SceneBody *scene_addCompound(SceneWorld *w, double mass, const double inertia[3], double x, double y, double z);
/* To the compound that was added last: its middle, and its turn about the compound's z-axis [rad]. */
void scene_addPart(SceneWorld *w, double lx, double ly, double lz, const double position[3], double turn);
/* Of a child with a parent, at a point. */
SceneJoint *scene_join(SceneWorld *w, SceneJointKind kind, int child, int parent, double x, double y, double z);
/* Of the body that was added last with the one before it, or, for the first body, with the world. */
SceneJoint *scene_joinLast(SceneWorld *w, SceneJointKind kind, double x, double y, double z);

/* kg m², about the body's own axes. */
void scene_inertia(const SceneBody *b, double inertia[3]);
/* J, kinetic and of gravity, of all bodies. */
double scene_energy(const SceneWorld *w, const SceneState states[]);
/* Where the body (or SCENE_WORLD) has taken the point that was at `point` at the start. */
void scene_attachment(const SceneWorld *w, const SceneState states[], int body, const double point[3], double out[3]);
/* m, of the joint whose two attachments are the farthest from each other. */
double scene_gap(const SceneWorld *w, const SceneState states[]);
/* J, the same energy at the start of the world. */
double scene_startEnergy(const SceneWorld *w);

/* Whether its force acts now: in a step that begins then. */
static inline bool scene_isPushed(const SceneBody *b, double time) {
    return (b->force[0] != 0 || b->force[1] != 0 || b->force[2] != 0) &&
           (b->forceEnds <= 0 || time < b->forceEnds - 1e-9);
}

/* rad/s, of a motor in a step of h that begins then: along a path it is the mean speed of the step. */
static inline double scene_motorSpeed(const SceneJoint *j, double time, double h) {
    return j->path ? (j->path(time + h) - j->path(time)) / h : j->speed;
}

/* Vectors, and quaternions w x y z. */
static inline double scene_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
void scene_rotate(const double q[4], const double v[3], double out[3]);
void scene_rotateBack(const double q[4], const double v[3], double out[3]);

#ifdef __cplusplus
}
#endif

#endif
