/* A scene from a number: bodies of all weights tied together in chains, trees and loops by joints of all kinds, shaken,
 * in a third of the scenes above a ground. The joints fit when the scene is made, and can be met at all times.
 *
 * The scene remembers for itself what its joints promise (ties) and where they store energy (stores), so that a test
 * need not ask the library for it: random_judge.h. */
#ifndef RANDOM_SCENE_H
#define RANDOM_SCENE_H

#include "measure.h"

enum {
    RANDOM_BODIES = 12,
    RANDOM_JOINTS = 40,
    RANDOM_TIES = 3,
    RANDOM_KICKS = 3,
    RANDOM_CONTACTS = 8 * RANDOM_BODIES,
    RANDOM_CALM = 40 /* steps without a kick at the end of a scene */
};

typedef struct {
    MdtBodyID id;
    MeBool isSphere;
    double edge[3]; /* m; of a sphere, its diameter */
    double size;    /* m, the mean edge */
    double mass;
    double moment[3];
    double potential; /* m g y at the end of the last step */
} RandomBody;

/* What a joint promises. The vectors are points or directions of its bodies, in their frames. */
typedef enum {
    TIE_POINT,       /* the points coincide */
    TIE_LINE,        /* point 0 is on the line through point 1 along `axis` of body 1 */
    TIE_DIRECTION,   /* the directions coincide */
    TIE_RIGHT_ANGLE, /* the directions are at right angles */
    TIE_ROD,         /* the points are `length` apart */
    TIE_STRING       /* at most */
} RandomTieKind;

typedef struct {
    RandomTieKind kind;
    double at[2][3], axis[3];
    double length; /* m */
} RandomTie;

/* The strain of a spring: what its energy is made of. */
typedef enum {
    STORE_NONE,
    STORE_DISTANCE, /* between the points `at` */
    STORE_SLIDE,    /* along `axis` of body 1 */
    STORE_ANGLE,    /* of `at[0]` of body 0 from `at[1]` of body 1, about `axis` of body 1 */
    STORE_LEAN,     /* the angle between the directions `at` */
    STORE_TURN      /* between the bodies' orientations, as they stood */
} RandomStoreKind;

typedef struct {
    RandomStoreKind kind;
    double at[2][3], axis[3];
    double rest[4]; /* STORE_TURN: the quaternion of body 0 against body 1 */
    double stop[2]; /* the spring acts below the first and above the second; they are one for a plain spring */
    double stiffness[2];
    double coordinate; /* last measured; angles count full turns */
    double strain[3];  /* at the end of the last step */
    double reach[3];   /* STORE_DISTANCE: from point 1 to point 0, last measured */
} RandomStore;

typedef struct {
    MdtConstraintID id;
    const char *kind;
    RandomBody *body[2]; /* null: the world */
    RandomTie tie[RANDOM_TIES];
    int ties;
    RandomStore store;
    double size; /* m, of its smaller body: what its gap is compared with */
} RandomJoint;

typedef struct {
    int step;
    RandomBody *body;
    double velocity[3], rate[3]; /* added */
} RandomKick;

typedef struct {
    unsigned long long seed;
    Random random;
    MdtWorldID world;
    const char *topology;
    RandomBody body[RANDOM_BODIES];
    int bodies;
    RandomJoint joint[RANDOM_JOINTS];
    int joints;
    RandomKick kick[RANDOM_KICKS];
    int kicks;
    double step, gravity, epsilon, gamma;
    int duration;                          /* steps */
    double ratio;                          /* of the masses, at most */
    double shaking;                        /* m/s */
    MeBool isOneKind, isBare;              /* joints of one kind; without limits */
    MeBool hasMotors, hasGround;           /* a ground is y = 0 */
    double restitution, friction;          /* of the ground */
    MdtContactID contact[RANDOM_CONTACTS]; /* of this step */
    int contacts;
} RandomScene;

void random_sceneMake(RandomScene *s, unsigned long long seed);
void random_sceneDestroy(RandomScene *s);

/* Kicks what is to be kicked before step number i, touches the ground, and steps. True: there was a kick. */
MeBool random_sceneStep(RandomScene *s, int i);

/* What the scene is, in a few lines. */
void random_sceneDescribe(const RandomScene *s, FILE *file);

/* The lowest points of a body that can touch the ground: corners of a box, or the one of a sphere. Returns how many. */
int random_cornersOf(const RandomBody *b, double corner[8][3]);

/* How far the springs of a joint's store are strained now, and their stiffnesses. Each call goes on from the last one
 * in counting turns. */
void random_strainOf(RandomJoint *j, double strain[3], double stiffness[3]);

/* The same at a coordinate, for stores that have one. */
void random_strainAt(const RandomStore *store, double coordinate, double strain[3]);

#endif
