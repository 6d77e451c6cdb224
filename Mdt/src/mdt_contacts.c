/* Contacts of a partition as Kea takes them, and their forces back. A record of points that share a normal, a surface
 * and radii is a manifold of Kea's, and a point that has something of its own (MdtExtra) is one by itself. They come in
 * the order of simulation. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <string.h>

/* ---- room ---- */

static MeBool isMoving(const MdtKeaVelocity *v) {
    return keaDot(v->lin, v->lin) + keaDot(v->ang, v->ang) > 0;
}

static MeBool isApart(const MdtExtra *extra) {
    const int own = MDT_OWN_NORMAL | MDT_OWN_RADIUS | MDT_OWN_PARAMS | MDT_OWN_DIRECTION | MDT_WATCHED;
    return extra->slot != MDT_GROUP_SLOT &&
           ((extra->record.flags & own) || isMoving(&extra->worldVelocity) || extra->rim[0] > 0 || extra->rim[1] > 0);
}

/* Whether a point of the record has a normal, radius or surface of its own, and so needs a manifold of Kea's for
 * itself. */
static MeBool hasApart(const MdtManifold *block) {
    for (const MdtExtra *extra = block->extras; extra; extra = extra->next)
        if (isApart(extra))
            return METRUE;
    return MEFALSE;
}

int mdt_contactsCount(const MdtManifold *first) {
    int count = 0;
    if (!first->next && !hasApart(first)) /* most: their points need not come from memory */
        return first->numPoints > 0;
    for (const MdtManifold *block = first; block; block = block->next)
        count += hasApart(block) ? mdt_countSlots(block) : mdt_pointIn(block, 0) != NULL;
    return count;
}

static size_t keaSize(int count) {
    return (size_t)count * sizeof(MdtKeaManifold);
}

size_t mdt_contactsSize(int count) {
    return keaSize(count) + (size_t)count * sizeof(MdtIslandManifold);
}

void mdt_contactsLayOut(MdtIsland *p, void *memory, int count) {
    p->kea.manifolds = memory;
    p->manifolds = (MdtIslandManifold *)(void *)((char *)memory + keaSize(count));
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

/* Returns the first one behind those that it has written. */
static int packBlock(const MdtIsland *p, const MdtManifold *block, int at, int *problems) {
    const MeBool areApart = hasApart(block);
    int end = at;
    for (MdtPoint *point = mdt_pointIn(block, 0); point; point = mdt_pointIn(block, point->slot + 1)) {
        if (end == at || areApart)
            beginManifold(&p->kea.manifolds[end++], point, problems);
        packPoint(&p->kea.manifolds[end - 1], &p->manifolds[end - 1], point);
    }
    return end;
}

int mdt_contactsPack(const MdtIsland *p, const MdtManifold *first, int at, int *problems) {
    for (const MdtManifold *block = first; block; block = block->next)
        at = packBlock(p, block, at, problems);
    return at;
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
    double most = 0;
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            most = fmax(most, p->kea.manifolds[i].point[k].depth);
    return most;
}
