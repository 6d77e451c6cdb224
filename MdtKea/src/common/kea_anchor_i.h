/* Inside Kea: position and lever arms of a contact (kea_anchor.c). */
#ifndef KEA_ANCHOR_I_H
#define KEA_ANCHOR_I_H

#include "kea_i.h"

/* A point of a manifold, kept through the sub-steps of a step. Frame: world, but for anchor and circleAxis. */
typedef struct KeaContact {
    const MdtKeaManifold *manifold;
    MdtKeaPoint *at; /* the manifold's point */
    /* kea_anchor.c, at the start of the step */
    double anchor[2][3];     /* m, body frames: the surface point of each body, or the centre of its sphere or circle */
    double circle[2];        /* m, radius of the circle (the manifold's rim); 0: none, or it may become flat */
    double circleAxis[2][3]; /* unit, body frames: axis of the circle or line */
    MeBool isLine[2];        /* the surface is round about a line at right angles to the normal */
    MeBool isVertex[2];      /* a vertex of the body touches, and the bodies rotate relative to each other */
    MeBool isAboutCentre[2]; /* the surface is spherical about its body's centre of mass */
    MeBool hasCentres;       /* the normal is the line of both surfaces' centres of curvature */
    /* kea_anchor.c, at the start of the sub-step */
    double normal[3], direction[3]; /* the manifold's; they turn with the line of centres */
    double line[3];                 /* m, of the centres, if there are any */
    double point[3];                /* m; for two round surfaces the middle of both surface points */
    double depth;                   /* m */
    double arm[2][3];               /* m, from the bodies' centres to the point */
    double turn[3];                 /* rad, rotation vector of a contact of flat surfaces in this sub-step; else 0 */
    double faceTurn[3];             /* rad, of a mover on whose face the contact lies: normal and directions turn */
    MeBool followsCentres;          /* of two round surfaces: normal and directions turn with the line of centres */
    MeBool moves;                   /* lever arms or directions change within this sub-step, */
    MeBool rolls;                   /* since the point moves with a round side, a rim or a vertex */
    /* kea_contact.c */
    int friction; /* set of its kinds of friction: 1 primary, 2 secondary, 4 rolling, 8 spinning */
    int firstRow; /* index of the contact's normal row */
} KeaContact;

/* The pose of side k of a manifold at the start of the sub-step: of its body, its mover, or the world. A mover's is
 * written to `memory`. */
const MdtKeaTransformation *kea_sidePose(const MdtKeaSystem *s, const MdtKeaManifold *m, int k,
                                         MdtKeaTransformation *memory);
/* The velocity of side k of a manifold at the start of the sub-step, at the origin of kea_sidePose. */
const MdtKeaVelocity *kea_sideVelocity(const MdtKeaSystem *s, const MdtKeaManifold *m, int k);
/* m: the arms of a manifold from the origins of kea_sidePose to a point. */
void kea_armsTo(const MdtKeaSystem *s, const MdtKeaManifold *m, const double point[3], double arm[2][3]);
/* Whether a joint constrains a body of the manifold (kea_markTied). */
MeBool kea_isManifoldTied(const MdtKeaSystem *s, const MdtKeaManifold *m);
/* Sets position, depth, arms and their motion at the start of the sub-step. */
void kea_contactPlace(const MdtKeaSystem *s, KeaContact *c);
/* Sets how the point moves within the sub-step: isVertex, turn, moves. After the place, and the rows of joints. */
void kea_contactChooseMotion(const MdtKeaSystem *s, KeaContact *c);
/* m: lever arms after a share of the sub-step: 1 is its end, 1/2 the mean of start and end. `move`: the velocities with
 * which the bodies move during the sub-step, not read for the world. Needs c->moves. */
void kea_contactArms(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                     double arm[2][3]);
/* Turns a direction of the contact's, d, with the face on which it lies, or with the line of the centres of two round
 * surfaces, for the same shares. */
void kea_contactTurnDirection(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                              double d[3]);
/* m: by how much the gap grows in the sub-step beyond h times the rate of `move` with the mean lever arms: the path of
 * the point of a rim is curved. */
double kea_contactBend(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6]);
/* kea_contactPlace, but at the position that collision detection found, in whatever sub-step. */
void kea_contactPlaceAtStart(const MdtKeaSystem *s, KeaContact *c);

#endif
