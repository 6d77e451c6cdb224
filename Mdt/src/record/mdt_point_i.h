/* Inside Mdt: the life and the properties of manifolds and their points. */
#ifndef MDT_POINT_I_H
#define MDT_POINT_I_H

#include "record/mdt_record_i.h"

/* The live contact; null, with a warning that names the caller, for anything else. */
MdtPoint *mdt_pointOf(void *contact, const char *caller);
MdtManifold *mdt_groupOf(void *group, const char *caller);

/* ---- life -------------------------------------------------------------------------------------------------------- */

/* A group without contacts; a contact that is in none. Null, with a warning: the world is full. */
MdtManifold *mdt_manifoldCreate(MdtWorldID w, const char *caller);
MdtPoint *mdt_pointCreate(MdtWorldID w, const char *caller);
/* A further contact of a group, alone in its record. */
MdtPoint *mdt_pointCreateIn(MdtManifold *group, const char *caller);
void mdt_pointTerm(MdtPoint *p);
void mdt_manifoldClear(MdtManifold *m); /* destroys its contacts */
void mdt_manifoldTerm(MdtManifold *m);
/* Moves a contact that is in no group into one; removes a contact that is alone in its record from its group. */
void mdt_pointJoin(MdtPoint *p, MdtManifold *group);
void mdt_pointLeave(MdtPoint *p);
/* Has it a record of its own, so that it can leave its group? */
MeBool mdt_pointIsAlone(const MdtPoint *p);

/* ---- properties -------------------------------------------------------------------------------------------------- */

/* A slot of the record comes into use; how many are. */
MdtPoint *mdt_slotActivate(MdtManifold *block, int slot);
int mdt_countSlots(const MdtManifold *block);
/* The values that its points share. */
void mdt_blockSetSurface(MdtManifold *block, const MdtBclContactParams *params);

/* The extras of a contact, or with MDT_GROUP_SLOT of the manifold itself; null: none. */
MdtExtra *mdt_extraOf(const MdtManifold *block, int slot);
/* The same, made where there is none; null, with a warning: there is no memory. */
MdtExtra *mdt_extraMake(MdtManifold *block, int slot, const char *caller);

const MdtBclContactParams *mdt_pointParams(const MdtPoint *p);
void mdt_pointNormal(const MdtPoint *p, double normal[3]); /* unit */
void mdt_pointDirection(const MdtPoint *p, const double normal[3], double direction[3]);
MeReal mdt_pointRadius(const MdtPoint *p, int side);
const MdtKeaVelocity *mdt_pointWorldVelocity(const MdtPoint *p);
/* The radius of the circle that the surface touches with, and its axis; 0: none. */
double mdt_pointRim(const MdtPoint *p, int side, double axis[3]);
/* Whether the surface is round there, so that the contact rolls. */
MeBool mdt_pointIsRound(const MdtPoint *p, int side);
void mdt_pointSetRim(MdtPoint *p, int side, double rim, const double axis[3]);
void mdt_pointSetParams(MdtPoint *p, const MdtBclContactParams *params);
void mdt_pointSetNormal(MdtPoint *p, const MeReal normal[3]);
void mdt_pointSetRadius(MdtPoint *p, int side, MeReal radius);
/* Place and depth that were found between bodies as they are shown, in double; see MdtContactSetExact. `normal`: the
 * contact's; `share`: mdt_pointShares. */
void mdt_pointSetFound(MdtPoint *p, const double normal[3], const double share[2], const double position[3],
                       double depth);
/* The weights of the bodies' displacements in that of the contact: 1 and 0 where only one surface is round, which
 * rolls; 1 of the only body; else 1/2. */
void mdt_pointShares(const MdtPoint *p, double share[2]);
/* Resets everything but the bodies to the values of a new contact. */
void mdt_pointReset(MdtPoint *p);
/* The forces of the last step are no guess for the next. */
void mdt_manifoldForget(MdtManifold *m);
/* Are its points in their slots, and as many as it says? */
MeBool mdt_manifoldIsConsistent(const MdtManifold *m);

#endif
