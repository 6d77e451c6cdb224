/* Inside Mdt: the common head of all constraints, and the record of a joint. */
#ifndef MDT_CONSTRAINT_I_H
#define MDT_CONSTRAINT_I_H

#include "base/mdt_body_i.h"

/* One side of a constraint, linked into the list of its body. */
struct MdtAttachment {
    MdtBodyID body; /* null: the world, or not attached yet */
    MdtAttachment *next, *previous;
};

/* The common head of joints and manifolds. A contact has none: an MdtConstraintID may also point to an MdtPoint of a
 * manifold, and API functions that take an MdtConstraintID treat that case separately. */
struct MdtBaseConstraint {
    MdtRecord record;
    MdtLink link;
    MdtWorldID world;
    MdtAttachment side[2];
};

/* Records are aligned to 16 bytes, so the address of an attachment tells which side it is. */
_Static_assert(offsetof(MdtBaseConstraint, side) % 16 == 8 && sizeof(MdtAttachment) % 16 == 8, "sides alternate");
static inline int mdt_attachmentSide(const MdtAttachment *at) {
    return (uintptr_t)at % 16 == 8 ? 0 : 1;
}
static inline MdtConstraintID mdt_attachmentOwner(const MdtAttachment *at) {
    return (MdtConstraintID)(void *)((char *)(at - mdt_attachmentSide(at)) - offsetof(MdtBaseConstraint, side));
}

/* The body of a side that forces move; null: the world, or a mover. */
static inline MdtBodyID mdt_sideBody(const MdtBaseConstraint *c, int side) {
    const MdtBodyID b = c->side[side].body;
    return b && !b->mover ? b : NULL;
}
/* The mover of a side; null: none. */
static inline const MdtMover *mdt_sideMover(const MdtBaseConstraint *c, int side) {
    return c->side[side].body ? c->side[side].body->mover : NULL;
}
/* Whether the constraint has a mover that moves in this step. */
static inline MeBool mdt_isCarried(const MdtBaseConstraint *c) {
    const MdtMover *m0 = mdt_sideMover(c, 0), *m1 = mdt_sideMover(c, 1);
    return (m0 && m0->isMoving) || (m1 && m1->isMoving);
}

/* A joint, spring or limit: any constraint that is no contact. */
typedef struct MdtJoint {
    MdtBaseConstraint base;
    void *userData;
    const MdtBclType *type;
    MdtBclConstraint bcl;
    MdtKeaVelocity worldVelocity;
    MdtBodyID further[2];  /* of a mimic in this step: bodies of its joints beside those of its sides; null: none */
    MdtKeaForcePair force; /* of the joint on its bodies in the last step */
    MeU64 certified;       /* hash of `bcl` after the step that was certified */
    MeReal breakForce, breakTorque; /* N, N m; MEINFINITY: it does not break */

    int firstRow, numRows;                                   /* the joint's rows in this step's system */
    double warm[MdtBclGETMAXROWS], ripple[MdtBclGETMAXROWS]; /* N, m/s, of the rows in the last step: warm start */
    int numWarm;           /* number of rows in the last step; used if it is the same now */
    double gap, gapBefore; /* size of its errors at the start of this step and of the last one, while it closes after
                              the program has enabled it or placed a body; HUGE_VAL: unknown; 0: it is not closing */
    MeBool isDegenerate, wasDegenerate; /* it was degenerate (MdtBclConstraint) in this step; in the last one */
    MeBool isDriven;                    /* its motor ran, or its attachment to the world moved, in the last step */
} MdtJoint;

static inline MeBool mdt_isJoint(const MdtBaseConstraint *c) {
    return c->record.magic == MDT_JOINT;
}

/* Call it when an input of the constraint's rows has changed: ends the rest certificates of its bodies. */
static inline void mdt_constraintDisturb(MdtConstraintID c) {
    for (int k = 0; k < 2; k++)
        if (c->side[k].body && (c->record.flags & MDT_ENABLED))
            mdt_bodyDisturb(c->side[k].body);
}

/* Marks a joint that the program passes to an API function, and its bodies: the call may change the joint. */
static inline void mdt_constraintMarkTouched(MdtConstraintID c) {
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
