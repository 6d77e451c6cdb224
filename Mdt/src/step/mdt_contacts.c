/* Conversion of a partition's contacts to Kea's manifolds, and of the forces back. Up to four points of a group that
 * share normal, surface and radii form one manifold of Kea's; a point with other values of its own (MdtExtra) forms one
 * alone. The manifolds are in the order of simulation. */
#include "MeAssert.h"
#include "api/mdt_api_i.h"
#include "step/mdt_step_i.h"
#include <string.h>

/* ---- grouping points to manifolds ---- */

static MeBool isMoving(const MdtKeaVelocity *v) {
    return keaDot(v->lin, v->lin) + keaDot(v->ang, v->ang) > 0;
}

/* True if the point has values of its own, besides normal and radii, that a manifold of Kea's has only once. */
static MeBool needsOwnManifold(const MdtExtra *extra) {
    const int own = MDT_OWN_PARAMS | MDT_OWN_DIRECTION | MDT_WATCHED;
    return (extra->record.flags & own) || isMoving(&extra->worldVelocity) || mdt_isAxis(extra->axis[0]) ||
           mdt_isAxis(extra->axis[1]);
}

/* True if some point of the record has values that differ from the shared ones. */
static MeBool hasOwnValues(const MdtManifold *block) {
    for (const MdtExtra *extra = block->extras; extra; extra = extra->next)
        if (extra->slot != MDT_GROUP_SLOT &&
            ((extra->record.flags & (MDT_OWN_NORMAL | MDT_OWN_RADIUS)) || needsOwnManifold(extra)))
            return METRUE;
    return MEFALSE;
}

/* True if the group forms at most one manifold of Kea's, as most groups do: counting it then reads no point. */
static MeBool isOneManifold(const MdtManifold *first) {
    return !first->next && !hasOwnValues(first);
}

/* In other groups, such as those on triangles of a surface or on children of compounds, points of equal normal, radii
 * and surface form one manifold, whichever records they are in. A point forms a manifold alone if the group has more
 * such combinations, which is correct, but slower. No test distinguishes 8 from 32. */
enum { MAX_COMBINATIONS = 16 };

typedef struct SharedValues {
    const MeReal *normal, *radius;
    const MdtSurface *surface;
    int manifold, numPoints;
} SharedValues;

typedef struct Grouping {
    int numCombinations, numManifolds; /* of the group so far */
    SharedValues kind[MAX_COMBINATIONS];
} Grouping;

static MeBool haveSameValues(const SharedValues *kind, const SharedValues *other) {
    return kind->surface == other->surface && memcmp(kind->normal, other->normal, 3 * sizeof *kind->normal) == 0 &&
           memcmp(kind->radius, other->radius, 2 * sizeof *kind->radius) == 0;
}

static SharedValues sharedValuesOf(const MdtManifold *block, const MdtExtra *extra) {
    SharedValues kind = {.normal = block->normal, .radius = block->radius, .surface = block->surface};
    if (extra && (extra->record.flags & MDT_OWN_NORMAL))
        kind.normal = extra->normal;
    if (extra && (extra->record.flags & MDT_OWN_RADIUS))
        kind.radius = extra->radius;
    return kind;
}

/* Adds the point to a manifold. Returns the manifold's index in the group: the old numManifolds if it is a new one. */
static int assignManifold(Grouping *s, const MdtManifold *block, const MdtPoint *point) {
    const MdtExtra *extra = mdt_extraOf(block, point->slot);
    if (extra && needsOwnManifold(extra))
        return s->numManifolds++;
    MEASSERT(s->numCombinations <= MAX_COMBINATIONS);
    SharedValues kind = sharedValuesOf(block, extra);
    int at = 0;
    while (at < s->numCombinations && !haveSameValues(&s->kind[at], &kind))
        at++;
    if (at < s->numCombinations && s->kind[at].numPoints < MdtKeaMANIFOLDPOINTS) {
        s->kind[at].numPoints++;
        return s->kind[at].manifold;
    }
    kind.manifold = s->numManifolds;
    kind.numPoints = 1;
    if (at < MAX_COMBINATIONS)
        s->kind[at] = kind;
    s->numCombinations = MeMAX(s->numCombinations, MeMIN(at + 1, MAX_COMBINATIONS));
    return s->numManifolds++;
}

/* ---- sizes ---- */

static int countGrouped(const MdtManifold *first) {
    Grouping grouping;
    grouping.numCombinations = grouping.numManifolds = 0;
    for (const MdtPoint *p = mdt_pointFirst(first); p; p = mdt_pointAfter(p))
        assignManifold(&grouping, mdt_blockOf(p), p);
    return grouping.numManifolds;
}

int mdt_contactsCount(const MdtManifold *first) {
    return isOneManifold(first) ? first->numPoints > 0 : countGrouped(first);
}

static size_t keaBytes(int count) {
    return (size_t)count * sizeof(MdtKeaManifold);
}

size_t mdt_contactsSize(int count) {
    return keaBytes(count) + (size_t)count * sizeof(MdtIslandManifold);
}

void mdt_contactsLayOut(MdtIsland *p, void *memory, int count) {
    MEASSERT((uintptr_t)memory % sizeof(double) == 0);
    p->kea.manifolds = memory;
    p->manifolds = (MdtIslandManifold *)(void *)((char *)memory + keaBytes(count));
    p->kea.numManifolds = count;
}

/* ---- manifolds for Kea ---- */

static void packPoint(MdtKeaManifold *m, MdtIslandManifold *own, MdtPoint *point) {
    const MeBool isWarm = point->numWarm > 0;
    const int at = m->numPoints++;
    MEASSERT(at < MdtKeaMANIFOLDPOINTS);
    MdtKeaPoint *to = &m->point[at];
    own->point[at] = point;
    keaZero(own->mean[at]);
    keaCopy(to->position, point->position);
    to->depth = to->depthNow = point->depth;
    for (int k = 0; k < 2; k++)
        to->isVertex[k] = mdt_pointIsVertex(point, k);
    keaZero(to->force); /* the answer, if memory fails before there is one */
    to->guess[0] = point->force[0];
    to->isNew = !isWarm && point->force[0] == 0;
    for (int i = 1; i < 3; i++)
        to->guess[i] = isWarm ? point->force[i] : 0;
}

/* Puts a mover in the world's place; null: none. One that stands still is like the world. */
static void setMover(MdtKeaManifold *m, const MdtMover *mover) {
    if (!mover)
        return;
    m->mover = mover->isMoving ? &mover->kea : NULL;
    m->worldVelocity = mover->isMoving ? &mover->kea.chord : NULL;
}

/* Begins a manifold without points, with the values that `first` shares with the points that follow. */
static void beginManifold(MdtKeaManifold *m, const MdtPoint *first, int *problems) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(first)->base;
    const MdtBclContactParams *params = mdt_pointParams(first);
    const MdtKeaVelocity *velocity = mdt_pointWorldVelocity(first);
    m->numPoints = 0;
    m->worldVelocity = isMoving(velocity) ? velocity : NULL;
    m->mover = NULL;
    mdt_pointNormal(first, m->normal);
    mdt_pointDirection(first, m->normal, m->direction);
    for (int k = 0; k < 2; k++) {
        m->body[k] = base->side[k].body ? base->side[k].body->index : MdtKeaWORLD;
        if (m->body[k] < 0)
            setMover(m, mdt_sideMover(base, k));
        m->radius[k] = mdt_pointRadius(first, k);
        m->rim[k] = mdt_pointRim(first, k, m->axis[k]);
    }
    MEASSERT(m->body[0] != m->body[1]);
    MdtBclContactSurface(params, &m->surface);
    *problems |= mdt_surfaceProblem(params);
}

/* Packs the points of a record as one manifold. Returns the index behind it. */
static int packBlock(const MdtIsland *p, const MdtManifold *block, int at, int *problems) {
    MdtPoint *point = mdt_pointIn(block, 0);
    if (!point)
        return at;
    MEASSERT(at < p->kea.numManifolds);
    beginManifold(&p->kea.manifolds[at], point, problems);
    for (; point; point = mdt_pointIn(block, point->slot + 1))
        packPoint(&p->kea.manifolds[at], &p->manifolds[at], point);
    return at + 1;
}

static int packGrouped(const MdtIsland *p, const MdtManifold *first, int at, int *problems) {
    Grouping grouping;
    grouping.numCombinations = grouping.numManifolds = 0;
    for (MdtPoint *point = mdt_pointFirst(first); point; point = mdt_pointAfter(point)) {
        const int before = grouping.numManifolds, place = assignManifold(&grouping, mdt_blockOf(point), point);
        MEASSERT(place <= before && at + place < p->kea.numManifolds);
        if (place == before)
            beginManifold(&p->kea.manifolds[at + place], point, problems);
        packPoint(&p->kea.manifolds[at + place], &p->manifolds[at + place], point);
    }
    return at + grouping.numManifolds;
}

int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems) {
    return isOneManifold(first) ? packBlock(p, first, at, problems) : packGrouped(p, first, at, problems);
}

void mdt_contactsCarry(const MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++) {
            MdtKeaPoint *at = &p->kea.manifolds[i].point[k];
            mdt_pointGetCurrent(p->manifolds[i].point[k], p->late + p->elapsed, at->position, &at->depth);
        }
}

/* ---- forces back to the contacts ---- */

static void addForce(const MdtKeaManifold *m, const double force[3], double share, double mean[3]) {
    double across[3];
    keaCross(across, m->normal, m->direction);
    keaAddScaled(mean, share * force[0], m->normal);
    keaAddScaled(mean, share * force[1], m->direction);
    keaAddScaled(mean, share * force[2], across);
    MEASSERT(isfinite(keaDot(mean, mean)));
}

/* For results independent of threads (rule in MeTeam.h), a range writes to its own manifolds and their
 * contacts only. */
typedef struct Unpacking {
    const MdtIsland *p;
    double share;
    MeBool isGuess;
} Unpacking;

static void MEAPI addForces(void *context, int first, int end, int worker) {
    const Unpacking *u = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        const MdtKeaManifold *m = &u->p->kea.manifolds[i];
        for (int k = 0; k < m->numPoints; k++)
            addForce(m, m->point[k].force, u->share, u->p->manifolds[i].mean[k]);
    }
}

void mdt_contactsAddForces(const MdtIsland *p, double share) {
    Unpacking u = {.p = p, .share = share};
    MeTeamRunRanges(p->team, p->kea.numManifolds, MDT_RANGE, addForces, &u);
}

void mdt_contactsClearForces(const MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            keaZero(p->kea.manifolds[i].point[k].force);
}

void mdt_contactsKeepDeclined(const MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            keaCopy(p->manifolds[i].declined[k], p->kea.manifolds[i].point[k].force);
}

void mdt_contactsGuessDeclined(const MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            keaCopy(p->kea.manifolds[i].point[k].guess, p->manifolds[i].declined[k]);
}

static void unpackPoint(MdtKeaPoint *from, MdtPoint *point, const double mean[3], MeBool isGuess) {
    MEASSERT(from->numRows >= 0 && from->numRows <= MdtBclGETMAXROWSCONTACT + 3);
    point->numRows = (MeU8)from->numRows;
    point->numWarm = isGuess ? (MeU8)from->numRows : 0;
    keaCopy(point->force, from->force);
    for (int i = 0; i < 3; i++)
        from->guess[i] = isGuess || i == 0 ? from->force[i] : 0;
    mdt_toReal(point->mean, mean);
}

static void MEAPI unpackPoints(void *context, int first, int end, int worker) {
    const Unpacking *u = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        MdtKeaManifold *m = &u->p->kea.manifolds[i];
        const MdtIslandManifold *own = &u->p->manifolds[i];
        for (int k = 0; k < m->numPoints; k++)
            unpackPoint(&m->point[k], own->point[k], own->mean[k], u->isGuess);
    }
}

void mdt_contactsUnpack(const MdtIsland *p, MeBool isGuess) {
    Unpacking u = {.p = p, .isGuess = isGuess};
    MeTeamRunRanges(p->team, p->kea.numManifolds, MDT_RANGE, unpackPoints, &u);
}

double mdt_contactsPenetration(const MdtIsland *p) {
    double max = 0;
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            max = fmax(max, p->kea.manifolds[i].point[k].depth);
    return max;
}
