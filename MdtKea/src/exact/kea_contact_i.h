/* Inside Kea: contacts of the exact solver, on their way from manifolds to rows.
 *
 *     kea_anchor.c        where a contact is: attached to its bodies, carried along with them, moving within a part
 *     kea_contact.c       its rows
 */
#ifndef KEA_CONTACT_I_H
#define KEA_CONTACT_I_H

#include "kea_i.h"

/* A point of a manifold in the parts of a step. */
typedef struct KeaContact {
    const MdtKeaManifold *manifold;
    MdtKeaPoint *at;
    /* kea_anchor.c, as the step begins */
    double anchor[2][3]; /* m, the surface points of the two bodies, or centres of what is round, in their frames */
    double circle[2];    /* m, the manifold's rim, or 0 where it may come to lie flat */
    double axle[2][3];   /* unit, its axis, in their frames */
    /* kea_anchor.c, as the part of the step begins */
    double normal[3], direction[3]; /* the manifold's; of two balls the normal turns with their centres */
    double point[3];                /* m; of two round surfaces the middle of their own */
    double depth;                   /* m */
    double arm[2][3];               /* m, from the bodies' centres to the point */
    double turn[3];                 /* rad, by which the arms of flat surfaces turn in this part; 0: round */
    MeBool moves;                   /* arms change within this part */
    /* kea_contact.c */
    int rubs;     /* directions that have a row: 1 primary, 2 secondary */
    int firstRow; /* where its rows begin */
} KeaContact;

/* Where it is as this part of the step begins, and how it moves in it. */
void kea_contactPlace(const MdtKeaSystem *s, KeaContact *c);
/* m, its arms after this share of the way in the part: 1 to the end, 1/2 for the mean of start and end. */
void kea_contactArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]);

#endif
