/* Inside Mdt: manifolds, the contacts of two bodies, or of a body and the world.
 *
 * A manifold is one record: two bodies, the normal and the surface that its points share, and up to four points. A
 * contact group of the API is a manifold; its fifth and further contacts are in manifolds that continue it. A contact
 * that is in no group has a manifold of its own (MDT_LONE). A contact's handle is the address of its MdtPoint.
 *
 * A point has an MdtExtra if one of its values differs from the shared ones, or if it has rare data: user data, a
 * primary direction, the velocity of a moving world, or parameters that a program writes through a pointer.
 */
#ifndef MDT_MANIFOLD_I_H
#define MDT_MANIFOLD_I_H

#include "base/mdt_constraint_i.h"
#include "base/mdt_surface_i.h"
#include <stdbool.h>

enum { MDT_POINTS = 4, MDT_GROUP_SLOT = MDT_POINTS };

/* A contact. 80 bytes in single precision. */
typedef struct MdtPoint {
    unsigned int magic;   /* MDT_POINT; 0: the slot is free */
    MeU8 slot;            /* its index in the manifold */
    MeU8 numRows;         /* its rows in this step */
    MeU8 numWarm;         /* rows that `force` belongs to: the warm start if numRows is the same */
    MeU8 vertices : 2;    /* bit k: a vertex of body k touches (MdtContactSetVertex) */
    bool isFound : 1;     /* continues as one of the newly found contacts (mdt_renew.c) */
    bool isCondemned : 1; /* will be destroyed when a stage ends (mdt_stage.c) */
    MeU32 feature;        /* feature id, set by the maker of the contact */
    MeVector3 mean;       /* N, mean force on the first body in the last step */
    double position[3];   /* m */
    double depth;         /* m, as it was found or set */
    double force[3];      /* N, of the rows in the last part of the last step: normal, primary, secondary */
} MdtPoint;

/* Flags of an MdtExtra: which values of the manifold it replaces for its point. */
enum { MDT_OWN_NORMAL = 256, MDT_OWN_RADIUS = 512, MDT_OWN_PARAMS = 1024, MDT_OWN_DIRECTION = 2048 };

typedef struct MdtExtra {
    MdtRecord record;      /* flags: MDT_OWN_... and MDT_WATCHED */
    struct MdtExtra *next; /* next extra of the same manifold */
    int slot;              /* index of its point; MDT_GROUP_SLOT: of the group itself */
    MeI32 sortKey;         /* sort key of a contact in a group: stored, without effect */
    void *userData;
    MdtContactID nextContact;     /* next contact in the list of the contacts' maker (MdtContactSetNext) */
    MdtBclContactParams params;   /* valid with MDT_OWN_PARAMS */
    MeReal normal[3], radius[2];  /* valid with MDT_OWN_NORMAL, MDT_OWN_RADIUS */
    double direction[3];          /* valid with MDT_OWN_DIRECTION */
    MdtKeaVelocity worldVelocity; /* m/s, rad/s */
    double rim[2], axis[2][3];    /* m; unit: MdtContactSetRim or, if the rim is 0, MdtContactSetEdge */
    MeU64 certified;              /* MDT_WATCHED: hash of `params` after the step that was certified */
} MdtExtra;

typedef struct MdtManifold {
    MdtBaseConstraint base;    /* not linked or attached if this one continues a group */
    struct MdtManifold *group; /* the group that this one continues; null: none */
    struct MdtManifold *next;  /* next manifold that continues the same group */
    MdtExtra *extras;
    const MdtSurface *surface;
    void *generator, **holder;   /* MdtContactGroup.h */
    MeReal normal[3];            /* direction in which the first body is pushed; not normalized */
    MeReal radius[2];            /* m, MdtContactSetRadius */
    unsigned int numPoints : 24; /* points of the whole group; 2^24 would take 2 GB */
    unsigned int used : 8;       /* bit set of the slots in use */
    MdtPoint point[MDT_POINTS];
} MdtManifold;

#ifndef _ME_API_DOUBLE
_Static_assert(sizeof(MdtManifold) == 512, "half a kilobyte for two boxes at rest: eight cache lines");
#endif

/* ---- from points to manifolds, and back -------------------------------------------------------------------------- */

static inline MdtManifold *mdt_blockOf(const MdtPoint *p) {
    return (MdtManifold *)(void *)((char *)(uintptr_t)(p - p->slot) - offsetof(MdtManifold, point));
}
/* The manifold of the group that the point is in or, without a group, its own. */
static inline MdtManifold *mdt_manifoldOf(const MdtPoint *p) {
    MdtManifold *block = mdt_blockOf(p);
    return block->group ? block->group : block;
}
static inline MeBool mdt_isInGroup(const MdtPoint *p) {
    return !(mdt_manifoldOf(p)->base.record.flags & MDT_LONE);
}
/* The lowest slot of a bit set; MDT_POINTS if it is empty. A table, since branches on it would be mispredicted. */
static inline int mdt_lowestSlot(unsigned int slots) {
    static const MeU8 lowest[1 << MDT_POINTS] = {MDT_POINTS, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0};
    MEASSERT(slots < 1u << MDT_POINTS);
    return lowest[slots];
}
/* The first point of the record in use at this slot or after it; null if there is none. */
static inline MdtPoint *mdt_pointIn(const MdtManifold *block, int slot) {
    const unsigned int rest = (unsigned int)block->used >> slot;
    return rest ? (MdtPoint *)(uintptr_t)&block->point[slot + mdt_lowestSlot(rest)] : NULL;
}
/* The first point in use of this record or of those after it; null if there is none. */
static inline MdtPoint *mdt_pointFrom(const MdtManifold *block) {
    MdtPoint *p = NULL;
    for (; block && !p; block = block->next)
        p = mdt_pointIn(block, 0);
    return p;
}
/* Iterate over the points of a group in the order of simulation; null after the last. */
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
