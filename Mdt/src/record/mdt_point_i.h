/* Inside Mdt: the life and the properties of manifolds and their points. */
#ifndef MDT_POINT_I_H
#define MDT_POINT_I_H

#include "record/mdt_record_i.h"

/* The handle as a live contact, or as a group; null, with a warning that names the caller, for anything else. */
MdtPoint *mdt_pointOf(void *contact, const char *caller);
MdtManifold *mdt_groupOf(void *group, const char *caller);

/* ---- life -------------------------------------------------------------------------------------------------------- */

/* Create a group without contacts, and a contact that is in no group. Null, with a warning, if the world is full. */
MdtManifold *mdt_manifoldCreate(MdtWorldID w, const char *caller);
MdtPoint *mdt_pointCreate(MdtWorldID w, const char *caller);
/* Creates a further contact of a group in a record of its own. Null, with a warning, if the world is full. */
MdtPoint *mdt_pointCreateIn(MdtManifold *group, const char *caller);
void mdt_pointTerm(MdtPoint *p);
void mdt_manifoldClear(MdtManifold *m); /* destroys its contacts */
void mdt_manifoldTerm(MdtManifold *m);
/* Move a contact that is in no group into one, and a contact with a record of its own out of its group. */
void mdt_pointJoin(MdtPoint *p, MdtManifold *group);
void mdt_pointLeave(MdtPoint *p);
/* True if the contact has a record of its own, so that it can leave its group. */
MeBool mdt_pointIsAlone(const MdtPoint *p);

/* ---- properties -------------------------------------------------------------------------------------------------- */

/* Activates a free slot of the record; counts the slots in use. */
MdtPoint *mdt_slotActivate(MdtManifold *block, int slot);
int mdt_countSlots(const MdtManifold *block);
/* Sets the parameters that the points of the record share. */
void mdt_blockSetSurface(MdtManifold *block, const MdtBclContactParams *params);

/* The extra of a contact or, with MDT_GROUP_SLOT, of the manifold itself; null if there is none. */
MdtExtra *mdt_extraOf(const MdtManifold *block, int slot);
/* mdt_extraOf, but creates the extra if there is none. Null, with a warning: no memory. */
MdtExtra *mdt_extraMake(MdtManifold *block, int slot, const char *caller);

const MdtBclContactParams *mdt_pointParams(const MdtPoint *p);
void mdt_pointNormal(const MdtPoint *p, double normal[3]); /* unit */
void mdt_pointDirection(const MdtPoint *p, const double normal[3], double direction[3]);
MeReal mdt_pointRadius(const MdtPoint *p, int side);
const MdtKeaVelocity *mdt_pointWorldVelocity(const MdtPoint *p);
/* The radius and axis of the circle with which the body touches (MdtContactSetRim); 0 if there is none. Of an edge
 * (MdtContactSetEdge) the radius is 0. */
double mdt_pointRim(const MdtPoint *p, int side, double axis[3]);
/* True if the surface of that body is round at the contact, so that it rolls. */
MeBool mdt_pointIsRound(const MdtPoint *p, int side);
/* Whether a vertex of the side's body touches. */
static inline MeBool mdt_pointIsVertex(const MdtPoint *p, int side) {
    return p->vertices >> side & 1;
}
static inline void mdt_pointSetVertex(MdtPoint *p, int side, MeBool isVertex) {
    const unsigned int others = p->vertices & ~(1u << side);
    p->vertices = (MeU8)(others | (isVertex ? 1u << side : 0)) & 3u;
}
/* axis: unit; 0: neither a circle nor an edge, and rim is 0. */
void mdt_pointSetRim(MdtPoint *p, int side, double rim, const double axis[3]);
static inline MeBool mdt_isAxis(const double axis[3]) {
    return keaDot(axis, axis) > 0;
}
void mdt_pointSetParams(MdtPoint *p, const MdtBclContactParams *params);
void mdt_pointSetNormal(MdtPoint *p, const MeReal normal[3]);
void mdt_pointSetRadius(MdtPoint *p, int side, MeReal radius);
/* Sets position and depth as found in double between the bodies' public transforms, corrected by the rounding of these
 * (MdtContactSetExact). `normal`: the contact's; `share`: of mdt_pointMotionWeights. */
void mdt_pointSetFound(MdtPoint *p, const double normal[3], const double share[2], const double position[3],
                       double depth);
/* The weights with which the motions of the two bodies move the contact: 1 for the body that is round if only one is,
 * since that one rolls; 1 for the only body; else 1/2. */
void mdt_pointMotionWeights(const MdtPoint *p, double share[2]);
/* Resets everything but the bodies to the values of a new contact. */
void mdt_pointReset(MdtPoint *p);
/* Clears the warm start of all contacts. */
void mdt_manifoldClearWarmStart(MdtManifold *m);
/* True if the manifold's points are in valid slots, and as many as its count says. */
MeBool mdt_manifoldIsConsistent(const MdtManifold *m);

#endif
