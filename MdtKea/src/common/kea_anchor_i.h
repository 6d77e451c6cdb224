/* Inside Kea: the place of a contact, and its lever arms (kea_anchor.c). */
#ifndef KEA_ANCHOR_I_H
#define KEA_ANCHOR_I_H

#include "kea_i.h"

/* A point of a manifold, kept through the parts of a divided step. Frame: world, but for anchor and circleAxis. */
typedef struct KeaContact {
    const MdtKeaManifold *manifold;
    MdtKeaPoint *at; /* the manifold's point */
    /* kea_anchor.c, as the step begins */
    double anchor[2][3];     /* m, body frames: the surface point of each body, or the centre of its sphere or circle */
    double circle[2];        /* m, radius of the circle (the manifold's rim); 0: none, or it may come to lie flat */
    double circleAxis[2][3]; /* unit, body frames: axis of the circle */
    MeBool isAboutCentre[2]; /* a ball, or the round end of something, about its body's centre of mass */
    MeBool areBalls;         /* both bodies are */
    /* kea_anchor.c, as the part of the step begins */
    double normal[3], direction[3]; /* the manifold's; of two balls the normal turns with their centres */
    double point[3];                /* m; of two round surfaces the middle of their own */
    double depth;                   /* m */
    double arm[2][3];               /* m, from the bodies' centres to the point */
    double turn[3];                 /* rad, rotation vector of the contact in this part, of flat surfaces; 0 of round */
    MeBool moves;                   /* lever arms change within this part */
    /* kea_contact.c */
    int frictionRows; /* set of directions that have a friction row: 1 primary, 2 secondary */
    int firstRow;     /* index of its normal row */
} KeaContact;

/* Of a body as this part of the step begins, or of the world at the origin. */
const MdtKeaVelocity *kea_sideVelocity(const MdtKeaSystem *s, const MdtKeaManifold *m, int k);
/* Sets place, depth, arms and their motion as this part of the step begins. */
void kea_contactPlace(const MdtKeaSystem *s, KeaContact *c);
/* m, lever arms at a later moment of the part: share 1 is its end, 1/2 the mean of start and end. */
void kea_contactArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]);
/* The same where collision detection has found it, whatever part of the step begins. */
void kea_contactPlaceAnew(const MdtKeaSystem *s, KeaContact *c);

#endif
