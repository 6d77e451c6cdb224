/* Contacts of a partition as Kea takes them, and their forces back. Points of a group that share a normal, a surface
 * and radii are a manifold of Kea's, up to four of them; a point that has something else of its own (MdtExtra) is one
 * by itself. They come in the order of simulation. */
#include "MeAssert.h"
#include "api/mdt_api_i.h"
#include "step/mdt_step_i.h"
#include <string.h>

/* ---- which points are one manifold ---- */

static MeBool isMoving(const MdtKeaVelocity *v) {
    return keaDot(v->lin, v->lin) + keaDot(v->ang, v->ang) > 0;
}

/* Has the point something of its own, beside normal and radii, that the points of a manifold of Kea's share? */
static MeBool needsOwnManifold(const MdtExtra *extra) {
    const int own = MDT_OWN_PARAMS | MDT_OWN_DIRECTION | MDT_WATCHED;
    return (extra->record.flags & own) || isMoving(&extra->worldVelocity) || extra->rim[0] > 0 || extra->rim[1] > 0;
}

/* Whether a point of the record does not share all of its values. */
static MeBool hasOwnValues(const MdtManifold *block) {
    for (const MdtExtra *extra = block->extras; extra; extra = extra->next)
        if (extra->slot != MDT_GROUP_SLOT &&
            ((extra->record.flags & (MDT_OWN_NORMAL | MDT_OWN_RADIUS)) || needsOwnManifold(extra)))
            return METRUE;
    return MEFALSE;
}

/* Most groups: their points need not come from memory to be counted. */
static MeBool isOneManifold(const MdtManifold *first) {
    return !first->next && !hasOwnValues(first);
}

/* Other groups, as on the triangles of a surface, or of the parts of compounds: points of equal normal, radii and
 * surface are one manifold, whatever records they are in. So many combinations are compared; a point of a further one
 * is a manifold by itself, which is right too, and slower: no test tells 8 from 32. */
enum { MAX_KINDS = 16 };

typedef struct Kind {
    const MeReal *normal, *radius;
    const MdtSurface *surface;
    int manifold, numPoints;
} Kind;

typedef struct Sorting {
    int numKinds, numManifolds; /* of the group */
    Kind kind[MAX_KINDS];
} Sorting;

static MeBool isOfKind(const Kind *kind, const Kind *other) {
    return kind->surface == other->surface && memcmp(kind->normal, other->normal, 3 * sizeof *kind->normal) == 0 &&
           memcmp(kind->radius, other->radius, 2 * sizeof *kind->radius) == 0;
}

static Kind kindOf(const MdtManifold *block, const MdtExtra *extra) {
    Kind kind = {.normal = block->normal, .radius = block->radius, .surface = block->surface};
    if (extra && (extra->record.flags & MDT_OWN_NORMAL))
        kind.normal = extra->normal;
    if (extra && (extra->record.flags & MDT_OWN_RADIUS))
        kind.radius = extra->radius;
    return kind;
}

/* The index, in the group, of the manifold that the next point goes to; it is a new one if that was numManifolds. */
static int assignManifold(Sorting *s, const MdtManifold *block, const MdtPoint *point) {
    const MdtExtra *extra = mdt_extraOf(block, point->slot);
    if (extra && needsOwnManifold(extra))
        return s->numManifolds++;
    Kind kind = kindOf(block, extra);
    int at = 0;
    while (at < s->numKinds && !isOfKind(&s->kind[at], &kind))
        at++;
    if (at < s->numKinds && s->kind[at].numPoints < MdtKeaMANIFOLDPOINTS) {
        s->kind[at].numPoints++;
        return s->kind[at].manifold;
    }
    kind.manifold = s->numManifolds;
    kind.numPoints = 1;
    if (at < MAX_KINDS)
        s->kind[at] = kind;
    s->numKinds = MeMAX(s->numKinds, MeMIN(at + 1, MAX_KINDS));
    return s->numManifolds++;
}

/* ---- room ---- */

static int countSorted(const MdtManifold *first) {
    Sorting sorting;
    sorting.numKinds = sorting.numManifolds = 0;
    for (const MdtPoint *p = mdt_pointFirst(first); p; p = mdt_pointAfter(p))
        assignManifold(&sorting, mdt_blockOf(p), p);
    return sorting.numManifolds;
}

int mdt_contactsCount(const MdtManifold *first) {
    return isOneManifold(first) ? first->numPoints > 0 : countSorted(first);
}

static size_t keaBytes(int count) {
    return (size_t)count * sizeof(MdtKeaManifold);
}

size_t mdt_contactsSize(int count) {
    return keaBytes(count) + (size_t)count * sizeof(MdtIslandManifold);
}

void mdt_contactsLayOut(MdtIsland *p, void *memory, int count) {
    p->kea.manifolds = memory;
    p->manifolds = (MdtIslandManifold *)(void *)((char *)memory + keaBytes(count));
    p->kea.numManifolds = count;
}

/* ---- manifolds for Kea ---- */

static void packPoint(MdtKeaManifold *m, MdtIslandManifold *own, MdtPoint *point) {
    const MeBool isWarm = point->numWarm > 0;
    const int at = m->numPoints++;
    MdtKeaPoint *to = &m->point[at];
    own->point[at] = point;
    keaZero(own->mean[at]);
    keaCopy(to->position, point->position);
    to->depth = to->depthNow = point->depth;
    to->guess[0] = point->force[0];
    to->isNew = !isWarm && point->force[0] == 0;
    for (int i = 1; i < 3; i++)
        to->guess[i] = isWarm ? point->force[i] : 0;
}

/* A manifold of no points, with what the point shares with those that may follow. */
static void beginManifold(MdtKeaManifold *m, const MdtPoint *first, int *problems) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(first)->base;
    const MdtBclContactParams *params = mdt_pointParams(first);
    const MdtKeaVelocity *velocity = mdt_pointWorldVelocity(first);
    m->numPoints = 0;
    m->worldVelocity = isMoving(velocity) ? velocity : NULL;
    mdt_pointNormal(first, m->normal);
    mdt_pointDirection(first, m->normal, m->direction);
    for (int k = 0; k < 2; k++) {
        m->body[k] = base->side[k].body ? base->side[k].body->index : MdtKeaWORLD;
        m->radius[k] = mdt_pointRadius(first, k);
        m->rim[k] = mdt_pointRim(first, k, m->axis[k]);
    }
    MdtBclContactSurface(params, &m->surface);
    *problems |= mdt_surfaceProblem(params);
}

/* The points of a record. Returns the first manifold behind those that it has written. */
static int packBlock(const MdtIsland *p, const MdtManifold *block, int at, int *problems) {
    MdtPoint *point = mdt_pointIn(block, 0);
    if (!point)
        return at;
    beginManifold(&p->kea.manifolds[at], point, problems);
    for (; point; point = mdt_pointIn(block, point->slot + 1))
        packPoint(&p->kea.manifolds[at], &p->manifolds[at], point);
    return at + 1;
}

static int packSorted(const MdtIsland *p, const MdtManifold *first, int at, int *problems) {
    Sorting sorting;
    sorting.numKinds = sorting.numManifolds = 0;
    for (MdtPoint *point = mdt_pointFirst(first); point; point = mdt_pointAfter(point)) {
        const int before = sorting.numManifolds, place = assignManifold(&sorting, mdt_blockOf(point), point);
        if (place == before)
            beginManifold(&p->kea.manifolds[at + place], point, problems);
        packPoint(&p->kea.manifolds[at + place], &p->manifolds[at + place], point);
    }
    return at + sorting.numManifolds;
}

int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems) {
    return isOneManifold(first) ? packBlock(p, first, at, problems) : packSorted(p, first, at, problems);
}

void mdt_contactsCarry(MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++) {
            MdtKeaPoint *at = &p->kea.manifolds[i].point[k];
            mdt_pointCarried(p->manifolds[i].point[k], at->position, &at->depth);
        }
}

/* ---- and back ---- */

static void addForce(const MdtKeaManifold *m, const double force[3], double share, double mean[3]) {
    double across[3];
    keaCross(across, m->normal, m->direction);
    keaAddScaled(mean, share * force[0], m->normal);
    keaAddScaled(mean, share * force[1], m->direction);
    keaAddScaled(mean, share * force[2], across);
    MEASSERT(isfinite(keaDot(mean, mean)));
}

/* The rule for order (MeTeam.h): a range of manifolds writes to these, and to their contacts, alone. */
typedef struct Unpacking {
    MdtIsland *p;
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

void mdt_contactsAddForces(MdtIsland *p, double share) {
    Unpacking u = {.p = p, .share = share};
    MeTeamRunRanges(p->team, p->kea.numManifolds, MDT_RANGE, addForces, &u);
}

void mdt_contactsClearForces(MdtIsland *p) {
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            keaZero(p->kea.manifolds[i].point[k].force);
}

static void unpackPoint(MdtKeaPoint *from, MdtPoint *point, const double mean[3], MeBool isGuess) {
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

void mdt_contactsUnpack(MdtIsland *p, MeBool isGuess) {
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
