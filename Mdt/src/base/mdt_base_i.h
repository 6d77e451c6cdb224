/* Inside Mdt: pools of records, sorted lists of records, checks of the arguments of API functions.
 *
 * Ownership: a world owns pools of records, which never move: bodies, joints, and the manifolds of contacts
 * (mdt_manifold_i.h). Live records are linked into the world's lists in the order of simulation: sort key, then
 * creation. A joint, or a manifold, is also linked into the lists of its bodies. A body's authoritative state is the
 * double one in `kea`; the transforms and velocities that programs read through pointers are copies of it.
 */
#ifndef MDT_BASE_I_H
#define MDT_BASE_I_H

#include "Mdt.h"
#include "MdtBcl.h"
#include "MdtInternal.h"
#include "MdtKeaMath.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include <stddef.h>
#include <stdint.h>

/* ---- records and pools --------------------------------------------------------------------------------------- */

/* The head of every record. */
typedef struct MdtRecord {
    unsigned int magic; /* the record's type, MDT_...; 0: the record is free */
    int flags;
    union {
        MeHandle handle;        /* the record's entry in the table of live objects (MeInternal.h) */
        struct MdtRecord *free; /* next in the pool's free list */
    };
} MdtRecord;

enum {
    MDT_WORLD = 0x4b57524c,
    MDT_BODY = 0x4b424459,
    MDT_JOINT = 0x4b4a4e54,
    MDT_MANIFOLD = 0x4b4d4e46,
    MDT_POINT = 0x4b504e54, /* a contact, within a manifold's record */
    MDT_EXTRA = 0x4b585452,
};

/* Records of one size: in one block or, if their number is not limited, in blocks that each double the total. A freed
 * record is reused after all others that are free, so that stale handles are recognized for as long as possible. */
typedef struct MdtPool {
    void *blocks; /* the newest; each begins with a pointer to the block allocated before it */
    size_t recordSize;
    MeLimit limit;
    const char *what; /* name of the records in messages, for instance "bodies" */
    int room, used;   /* numbers of records in all blocks */
    char *fresh;      /* the newest block's first record that was never in use; nothing was written there yet */
    int numFresh;
    MdtRecord *firstFree, *lastFree;
} MdtPool;

/* Call it before the first mdt_poolGet, with recordSize, what and limit set. A pool with a limit allocates all of its
 * memory here. False, after a fatal error, if there is no memory. */
MeBool mdt_poolInit(MdtPool *pool, const char *caller);
void mdt_poolTerm(MdtPool *pool);
/* A record whose fields are 0 except those of its head; null, with a message that names the caller, if the pool is full
 * or there is no memory. */
void *mdt_poolGet(MdtPool *pool, unsigned int magic, const char *caller);
void mdt_poolPut(MdtPool *pool, void *record);

/* ---- the list of a world's bodies, or constraints ------------------------------------------------------------ */

typedef struct MdtLink {
    struct MdtLink *next, *previous;
    unsigned long serial; /* number of the creation in the world: the order of equal sort keys */
    MeI32 sortKey;
} MdtLink;

/* The record that a link is part of: a body, a joint, a manifold. */
static inline void *mdt_linkOwner(const MdtLink *link) {
    return (char *)link - sizeof(MdtRecord);
}

typedef struct MdtList {
    MdtLink *first, *last;
    int count;
    MeBool isSorted;
} MdtList;

void mdt_listAppend(MdtList *list, MdtLink *link, unsigned long serial);
void mdt_listRemove(MdtList *list, MdtLink *link);
void mdt_listSetKey(MdtList *list, MdtLink *link, MeI32 key);
void mdt_listSort(MdtList *list); /* sorts by key, then serial; a merge sort that allocates nothing */

/* ---- checks -------------------------------------------------------------------------------------------------- */

/* True for a live handle; otherwise warns in the caller's name. */
MeBool mdt_isWorld(const MdtWorld *w, const char *caller);
MeBool mdt_isBody(const MdtBody *b, const char *caller);
MeBool mdt_isAnyBody(const MdtBody *b, const char *caller); /* mdt_isBody, and hidden bodies, which Mst reads, too */
MeBool mdt_isConstraint(const MdtBaseConstraint *c, const char *caller);
/* True for a finite number; otherwise warns. */
MeBool mdt_isFinite(const char *caller, const char *what, MeReal x);
/* mdt_isFinite for vectors. In double builds, too, numbers beyond the range of single precision are refused, so that
 * products of a few of them are finite. */
MeBool mdt_isFinite3(const char *caller, const char *what, MeReal x, MeReal y, MeReal z);
MeBool mdt_areFinite(const MeReal v[3]); /* mdt_isFinite3 without a warning */
/* True for a finite vector within the bound of positions (MdtBodyGetPositionBound); otherwise warns. */
MeBool mdt_isPositionValid(const char *caller, const char *what, const MdtWorld *w, MeReal x, MeReal y, MeReal z);
/* True for a finite x >= lower; otherwise warns. */
MeBool mdt_isNotBelow(const char *caller, const char *what, MeReal x, MeReal lower);
/* Sets the numbers of a position motor; if one is negative or not finite, warns and changes nothing. */
MeBool mdt_setServo(const char *caller, MdtBclServo *motor, MeReal frequency, MeReal dampingRatio, MeReal force);
MeBool mdt_isPositiveInRange(MeReal x); /* positive and within the range of single precision */
MeBool mdt_isPositive(const char *caller, const char *what, MeReal x);
MeBool mdt_isSortKey(const char *caller, MeI32 key);
MeBool mdt_isPointer(const char *caller, const char *what, const void *p);
/* True if result is not null; its n numbers are then zeroed, as the neutral result. Otherwise warns. */
MeBool mdt_isResult(const char *caller, MeReal *result, int n);
/* Normalizes a quaternion; false, with a warning, if it has no length. */
MeBool mdt_normalizeQuaternion(const char *caller, double q[4]);
/* Sets an orientation that changes; a velocity of null is 0. If an argument is bad, warns and changes nothing. */
void mdt_setTargetTurn(const char *caller, MdtBclTargetTurn *target, const MeReal q[4], const MeReal w[3]);
/* Stores x if it is >= 0; otherwise warns. Does nothing if place is null: the joint was not valid. */
void mdt_setNonNegative(const char *caller, const char *what, MeReal *place, MeReal x);
/* Stores an angle, clamped to 0..pi. An angle that is not finite is not stored, with a warning. */
void mdt_setAngle(const char *caller, const char *what, MeReal *place, MeReal x);
/* True for a live body. Otherwise warns, unless all worlds have been destroyed, and the body with its own. */
MeBool mdt_mayDestroyBody(const MdtBody *b, const char *caller);
/* Warns: "caller: the <what> has been destroyed, or never was one". */
void mdt_warnGone(const char *caller, const char *what);
/* Adds to the number of live worlds: 1 or -1. */
void mdt_countWorlds(int change);
double mdt_worldBound(const MdtWorld *w); /* m: the bound of positions (MdtBodyGetPositionBound) */
MeBool mdt_isSolver(MdtSolver solver);
/* True if each attachment in the body's list links back to the one before it and belongs to the body and its world. */
MeBool mdt_attachmentsAreLinked(const MdtBody *b);
/* True if the constraint is being destroyed, or will be when a stage ends. */
MeBool mdt_constraintIsCondemned(const MdtBaseConstraint *c);

#define MDT_NEED_WORLD(w, otherwise)                                                                                   \
    do {                                                                                                               \
        if (!mdt_isWorld((w), __func__))                                                                               \
            return otherwise;                                                                                          \
    } while (0)
#define MDT_NEED_BODY(b, otherwise)                                                                                    \
    do {                                                                                                               \
        if (!mdt_isBody((b), __func__))                                                                                \
            return otherwise;                                                                                          \
    } while (0)
#define MDT_NEED_CONSTRAINT(c, otherwise)                                                                              \
    do {                                                                                                               \
        if (!mdt_isConstraint((c), __func__))                                                                          \
            return otherwise;                                                                                          \
    } while (0)

/* ---- MeReal and double --------------------------------------------------------------------------------------- */

/* Converts to MeReal; clamps numbers beyond its range to +-MEINFINITY. */
static inline MeReal mdt_real(double x) {
    const double max = (double)MEINFINITY;
    return (MeReal)(x > max ? max : x < -max ? -max : x);
}

/* mdt_real for a vector. One test finds out whether any component became infinite: 0 times infinity is not a number.
 * This is called for every moving body. */
static inline void mdt_toReal(MeVector3 r, const double v[3]) {
    r[0] = (MeReal)v[0], r[1] = (MeReal)v[1], r[2] = (MeReal)v[2];
    if (!(0 * r[0] + 0 * r[1] + 0 * r[2] <= 0))
        r[0] = mdt_real(v[0]), r[1] = mdt_real(v[1]), r[2] = mdt_real(v[2]);
}

static inline void mdt_fromReal(double r[3], const MeVector3 v) {
    r[0] = v[0], r[1] = v[1], r[2] = v[2];
}

#endif
