/* Inside Mdt: manifolds, the contacts of two bodies, or of a body and the world.
 *
 * A manifold is one record: its bodies, the normal and the surface that its points share, and up to four points. What
 * programs know as a contact group is a manifold; further contacts of it are in manifolds that continue it. A contact
 * that is in no group has a manifold of its own (MDT_LONE). A contact's handle is the address of its point.
 *
 * A point that differs from the others in what they share, or has what few have (user data, a primary direction, the
 * velocity of a moving world, parameters that a program writes through a pointer), has an MdtExtra with it.
 */
#ifndef MDT_MANIFOLD_I_H
#define MDT_MANIFOLD_I_H

#include "base/mdt_constraint_i.h"
#include "base/mdt_surface_i.h"
#include <stdbool.h>

enum { MDT_POINTS = 4, MDT_GROUP_SLOT = MDT_POINTS };

/* A contact. 80 bytes in single precision. */
typedef struct MdtPoint {
    unsigned int magic;   /* MDT_POINT; 0: not in use */
    MeU8 slot;            /* its index in the manifold */
    MeU8 numRows;         /* in this step */
    MeU8 numWarm;         /* if there are as many rows, `force` is a guess at theirs */
    bool isFound : 1;     /* matched with a new contact (mdt_renew.c) */
    bool isCondemned : 1; /* will be destroyed when a stage ends (mdt_stage.c) */
    MeU32 feature;        /* its maker's */
    MeVector3 mean;       /* N, in the last step, on the first body */
    double position[3];   /* m */
    double depth;         /* m, as it was set */
    double force[3];      /* N, of the rows of the last part of a step: normal, primary, secondary */
} MdtPoint;

/* Which shared values of the manifold's points an MdtExtra replaces: flags beside MDT_WATCHED. */
enum { MDT_OWN_NORMAL = 256, MDT_OWN_RADIUS = 512, MDT_OWN_PARAMS = 1024, MDT_OWN_DIRECTION = 2048 };

typedef struct MdtExtra {
    MdtRecord record;      /* its flags: MDT_OWN_... and MDT_WATCHED */
    struct MdtExtra *next; /* of the same manifold */
    int slot;              /* whose; MDT_GROUP_SLOT: the group's */
    MeI32 sortKey;         /* of a contact in a group, where it means nothing */
    void *userData;
    MdtContactID nextContact;     /* its maker's list */
    MdtBclContactParams params;   /* OWN_PARAMS */
    MeReal normal[3], radius[2];  /* OWN_NORMAL, OWN_RADIUS */
    double direction[3];          /* OWN_DIRECTION */
    MdtKeaVelocity worldVelocity; /* m/s, rad/s */
    double rim[2], axis[2][3];    /* m; unit, where there is a rim: MdtContactSetRim */
    MeU64 certified;              /* of watched parameters: their hash as the certified step left them */
} MdtExtra;

typedef struct MdtManifold {
    MdtBaseConstraint base;    /* of one that continues a group's: not linked, not attached */
    struct MdtManifold *group; /* which this one continues; null: it is a group itself, or lone */
    struct MdtManifold *next;  /* continues the same group */
    MdtExtra *extras;
    const MdtSurface *surface;
    void *generator, **holder;   /* MdtContactGroup.h */
    MeReal normal[3];            /* direction in which the first body is pushed; of any length */
    MeReal radius[2];            /* m, MdtContactSetRadius */
    unsigned int numPoints : 24; /* of the whole group; so many would take 2 GB */
    unsigned int used : 8;       /* bits: which of its slots are */
    MdtPoint point[MDT_POINTS];
} MdtManifold;

#ifndef _ME_API_DOUBLE
_Static_assert(sizeof(MdtManifold) == 512, "half a kilobyte for two boxes at rest: eight cache lines");
#endif

/* ---- which belongs to which -------------------------------------------------------------------------------------- */

static inline MdtManifold *mdt_blockOf(const MdtPoint *p) {
    return (MdtManifold *)(void *)((char *)(uintptr_t)(p - p->slot) - offsetof(MdtManifold, point));
}
/* The group that the point is in, or the manifold in which it is alone. */
static inline MdtManifold *mdt_manifoldOf(const MdtPoint *p) {
    MdtManifold *block = mdt_blockOf(p);
    return block->group ? block->group : block;
}
static inline MeBool mdt_isInGroup(const MdtPoint *p) {
    return !(mdt_manifoldOf(p)->base.record.flags & MDT_LONE);
}
/* The lowest slot of a set; MDT_POINTS of none. A table, as which slots are in use cannot be predicted. */
static inline int mdt_lowestSlot(unsigned int slots) {
    static const MeU8 lowest[1 << MDT_POINTS] = {MDT_POINTS, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0};
    return lowest[slots];
}
/* The first point in use from a slot of the record on; null: there is none. */
static inline MdtPoint *mdt_pointIn(const MdtManifold *block, int slot) {
    const unsigned int rest = (unsigned int)block->used >> slot;
    return rest ? (MdtPoint *)(uintptr_t)&block->point[slot + mdt_lowestSlot(rest)] : NULL;
}
static inline MdtPoint *mdt_pointFrom(const MdtManifold *block) {
    MdtPoint *p = NULL;
    for (; block && !p; block = block->next)
        p = mdt_pointIn(block, 0);
    return p;
}
/* Those in use, in the order of simulation; null after the last. */
static inline MdtPoint *mdt_pointFirst(const MdtManifold *m) {
    return m->numPoints > 0 ? mdt_pointFrom(m) : NULL;
}
static inline MdtPoint *mdt_pointAfter(const MdtPoint *p) {
    const MdtManifold *block = mdt_blockOf(p);
    MdtPoint *next = mdt_pointIn(block, p->slot + 1);
    return next ? next : mdt_pointFrom(block->next);
}

static inline MeBool mdt_isManifold(const MdtBaseConstraint *c) {
    return c->record.magic == MDT_MANIFOLD;
}
static inline MeBool mdt_isPoint(const MdtBaseConstraint *c) {
    return c->record.magic == MDT_POINT;
}
static inline MdtPoint *mdt_asPoint(MdtConstraintID c) {
    return (MdtPoint *)(void *)c;
}

static inline MdtManifold *mdt_asManifold(MdtConstraintID c) {
    return (MdtManifold *)(void *)c;
}

#endif
