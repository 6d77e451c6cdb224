/* Inside Mdt: pools of records, lists of them, checks of what programs give.
 *
 * Ownership: a world owns pools of records, which never move: bodies, joints, and the manifolds of contacts
 * (mdt_manifold_i.h). Live records are linked into the world's lists in the order of simulation: sort key, then
 * creation. A joint, or a manifold, is also linked into the lists of its bodies. A body's authoritative state is the
 * double one in `kea`; what programs point at is refreshed from it.
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
    unsigned int magic; /* says what it is; 0: not in use */
    int flags;
    union {
        MeHandle handle;        /* while it lives */
        struct MdtRecord *free; /* next in the pool's free list */
    };
} MdtRecord;

enum {
    MDT_WORLD = 0x4b57524c,
    MDT_BODY = 0x4b424459,
    MDT_JOINT = 0x4b4a4e54,
    MDT_MANIFOLD = 0x4b4d4e46,
    MDT_POINT = 0x4b504e54, /* within a manifold */
    MDT_EXTRA = 0x4b585452,
};

/* Records of one size, in one block, or, where there is no limit to them, in blocks of which each is as large as all
 * before it together. Freed ones are reused last, so that a stale handle is noticed for as long as possible. */
typedef struct MdtPool {
    void *blocks; /* each begins with a pointer to the one before it */
    size_t recordSize;
    MeLimit limit;
    const char *what; /* "bodies" */
    int room, used;   /* records in all blocks */
    char *fresh;      /* the first of the newest block that has never been in use; its memory has not been touched */
    int numFresh;
    MdtRecord *firstFree, *lastFree;
} MdtPool;

/* Before the first record; recordSize, what and limit are set. Takes all memory that there will be, if there is a
 * limit. */
MeBool mdt_poolInit(MdtPool *pool, const char *caller);
void mdt_poolTerm(MdtPool *pool);
/* Zeroed but for its head; null, with a message that names the caller, when there is no room. */
void *mdt_poolGet(MdtPool *pool, unsigned int magic, const char *caller);
void mdt_poolPut(MdtPool *pool, void *record);

/* ---- the list of a world's bodies, or constraints ------------------------------------------------------------ */

typedef struct MdtLink {
    struct MdtLink *next, *previous;
    unsigned long serial; /* counts creations in the world */
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
void mdt_listSort(MdtList *list); /* by key, then serial; a merge sort that allocates nothing */

/* ---- checks -------------------------------------------------------------------------------------------------- */

/* True for a live handle; else a warning that names the caller. */
MeBool mdt_isWorld(const MdtWorld *w, const char *caller);
MeBool mdt_isBody(const MdtBody *b, const char *caller);
MeBool mdt_isConstraint(const MdtBaseConstraint *c, const char *caller);
/* True for finite numbers; else a warning. */
MeBool mdt_isFinite(const char *caller, const char *what, MeReal x);
/* The same of vectors; no number is larger than those of single precision, so that products of some are finite. */
MeBool mdt_isFinite3(const char *caller, const char *what, MeReal x, MeReal y, MeReal z);
MeBool mdt_areFinite(const MeReal v[3]); /* without one */
/* Within the bound of positions, too. */
MeBool mdt_isPlace(const char *caller, const char *what, const MdtWorld *w, MeReal x, MeReal y, MeReal z);
/* True for lower <= x; else a warning. */
MeBool mdt_isNotBelow(const char *caller, const char *what, MeReal x, MeReal lower);
MeBool mdt_isUsable(MeReal x); /* positive, and within what single precision can have */
MeBool mdt_isPositive(const char *caller, const char *what, MeReal x);
MeBool mdt_isSortKey(const char *caller, MeI32 key);
MeBool mdt_isPointer(const char *caller, const char *what, const void *p);
/* True for a place to write n numbers to, which are zeroed: the neutral result. */
MeBool mdt_isResult(const char *caller, MeReal *result, int n);
/* Stores x >= 0; else a warning. A null place, of a joint that was none, is left alone. */
void mdt_setNonNegative(const char *caller, const char *what, MeReal *place, MeReal x);
/* Stores an angle, clamped to 0..pi; a warning for one that is not finite. */
void mdt_setAngle(const char *caller, const char *what, MeReal *place, MeReal x);
/* Warns of one that has gone while any world lives, and of null. */
MeBool mdt_mayDestroyBody(const MdtBody *b, const char *caller);
/* "caller: the constraint has been destroyed, or never was one" */
void mdt_warnGone(const char *caller, const char *what);
/* How many worlds live: one more, or one less. */
void mdt_countWorlds(int change);
double mdt_worldBound(const MdtWorld *w); /* m: of positions */
MeBool mdt_isSolver(MdtSolver solver);
/* Is the list of a body's constraints linked both ways? */
MeBool mdt_attachmentsAreLinked(const MdtBody *b);
/* Will it be destroyed when a stage ends? */
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

/* What MeReal has no number for is MEINFINITY. */
static inline MeReal mdt_real(double x) {
    const double max = (double)MEINFINITY;
    return (MeReal)(x > max ? max : x < -max ? -max : x);
}

/* Zero times infinity is no number: three are looked at at once, as this is done for all that moves. */
static inline void mdt_toReal(MeVector3 r, const double v[3]) {
    r[0] = (MeReal)v[0], r[1] = (MeReal)v[1], r[2] = (MeReal)v[2];
    if (!(0 * r[0] + 0 * r[1] + 0 * r[2] <= 0))
        r[0] = mdt_real(v[0]), r[1] = mdt_real(v[1]), r[2] = mdt_real(v[2]);
}

static inline void mdt_fromReal(double r[3], const MeVector3 v) {
    r[0] = v[0], r[1] = v[1], r[2] = v[2];
}

#endif
