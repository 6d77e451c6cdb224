/* Inside Mdt: the records of constraints, but for manifolds. */
#ifndef MDT_CONSTRAINT_I_H
#define MDT_CONSTRAINT_I_H

#include "base/mdt_body_i.h"

/* One side of a constraint, linked into its body's list. */
struct MdtAttachment {
    MdtBodyID body; /* null: the world, or nothing yet */
    MdtAttachment *next, *previous;
};

/* The head of joints and manifolds. A contact has none: an MdtConstraintID may also be a point of a manifold, and every
 * function of the API that takes one says what it does then. */
struct MdtBaseConstraint {
    MdtRecord record;
    MdtLink link;
    MdtWorldID world;
    MdtAttachment side[2];
};

/* A record lies at a multiple of 16, so the address of an attachment tells which side it is. */
_Static_assert(offsetof(MdtBaseConstraint, side) % 16 == 8 && sizeof(MdtAttachment) % 16 == 8, "sides alternate");
static inline int mdt_attachmentSide(const MdtAttachment *at) {
    return (uintptr_t)at % 16 == 8 ? 0 : 1;
}
static inline MdtConstraintID mdt_attachmentOwner(const MdtAttachment *at) {
    return (MdtConstraintID)(void *)((char *)(at - mdt_attachmentSide(at)) - offsetof(MdtBaseConstraint, side));
}

/* A joint, spring or limit: any constraint that is no contact. */
typedef struct MdtJoint {
    MdtBaseConstraint base;
    void *userData;
    const MdtBclType *type;
    MdtBclConstraint bcl;
    MdtKeaVelocity worldVelocity;
    MdtKeaForcePair force;          /* in the last step */
    MeU64 certified;                /* a hash of `bcl` as the certified step left it, then */
    MeReal breakForce, breakTorque; /* N, N m; MEINFINITY: it does not break */

    int firstRow, numRows;                                   /* in this step */
    double warm[MdtBclGETMAXROWS], ripple[MdtBclGETMAXROWS]; /* N, m/s, of the rows in the last step, */
    int numWarm;                                             /* if there are as many */
    MeBool isDegenerate, wasDegenerate;                      /* in this step, in the last one */
    MeBool isDriven; /* in the last step: its motor ran, or what it is attached to moved */
} MdtJoint;

static inline MeBool mdt_isJoint(const MdtBaseConstraint *c) {
    return c->record.magic == MDT_JOINT;
}

/* An input of the constraint's rows has changed. */
static inline void mdt_constraintDisturb(MdtConstraintID c) {
    for (int k = 0; k < 2; k++)
        if (c->side[k].body && (c->record.flags & MDT_ENABLED))
            mdt_bodyDisturb(c->side[k].body);
}

/* A call of the program has had to do with a joint: it may have changed it. */
static inline void mdt_constraintTouch(MdtConstraintID c) {
    if (c->record.magic != MDT_JOINT || (c->record.flags & MDT_TOUCHED))
        return;
    c->record.flags |= MDT_TOUCHED;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            c->side[k].body->record.flags |= MDT_TOUCHED;
}

static inline MdtJoint *mdt_asJoint(MdtConstraintID c) {
    return mdt_isJoint(c) ? (MdtJoint *)(void *)c : NULL;
}

#endif
