/* Partitions of Kea's fast solver: whether it is chosen, and their manifolds as it takes them. Contacts have no rows
 * there: a record of points that share a normal and a surface is a manifold of Kea's, and a point that has something of
 * its own (MdtExtra) is one by itself. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <string.h>

/* Beside each manifold of Kea's: whose points it has. */
typedef struct MdtIslandManifold {
    MdtPoint *point[MdtKeaMANIFOLDPOINTS];
    double mean[MdtKeaMANIFOLDPOINTS][3]; /* N, of the parts of the step that are done, on the first body */
} MdtIslandManifold;

/* ---- the choice ---- */

/* m/s: of the bodies of a contact towards each other, by their velocities at the start of the step. */
static double approachAt(const MdtPoint *point) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(point)->base;
    double normal[3], sum = 0;
    mdt_pointNormal(point, normal);
    for (int k = 0; k < 2; k++) {
        const MdtBody *b = base->side[k].body;
        double arm[3], v[3], w[3], turn[3];
        if (!b)
            continue;
        mdt_fromReal(v, b->velocity);
        mdt_fromReal(w, b->angularVelocity);
        keaSubtract(arm, point->position, b->kea.position);
        keaCross(turn, w, arm);
        sum += (k == 0 ? -1 : 1) * (keaDot(normal, v) + keaDot(normal, turn));
    }
    return sum;
}

/* Do bodies meet in this step faster than `least`, or are they pushed apart as fast? */
static MeBool meetsWith(const MdtIsland *p, const MdtManifold *m, double least) {
    for (const MdtPoint *at = mdt_pointFirst(m); at; at = mdt_pointAfter(at)) {
        if ((double)p->world->gamma * at->depth > least * p->h)
            return METRUE;
        const double approach = approachAt(at);
        if (approach > least && at->depth + approach * p->h > 0)
            return METRUE;
    }
    return MEFALSE;
}

/* Have bodies met in the last step, or do they in this one? Then their velocities change by far more than gravity
 * explains, and what follows is known no better than the law by which they part. */
static MeBool hasImpacts(const MdtIsland *p) {
    double g[3];
    mdt_fromReal(g, p->world->params.gravity);
    const double most = MDT_IMPACT * keaLength(g);
    for (int i = 0; i < p->numBodies; i++)
        if (keaLength(p->bodies[i]->acceleration.lin) > most)
            return METRUE;
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isManifold(p->acting[i]) && meetsWith(p, mdt_asManifold(p->acting[i]), most * p->h))
            return METRUE;
    return MEFALSE;
}

/* Nothing in it touches the world: it carries no weight, and its forces come of meetings and of overlaps alone. */
static MeBool isInFlight(const MdtIsland *p) {
    for (int i = 0; i < p->numActing; i++)
        if (!p->acting[i]->side[0].body || !p->acting[i]->side[1].body)
            return MEFALSE;
    return METRUE;
}

static MeBool touches(const MdtPoint *point) {
    return point->depth >= 0 || (point->numWarm > 0 && point->force[0] > 0);
}

/* Bodies that bounce, of which only few touch anything, are met one after the other (mdt_subdivide.c). */
static MeBool isMetInTime(const MdtIsland *p) {
    MeBool doesBounce = MEFALSE;
    int touching = 0;
    for (int i = 0; i < p->numActing; i++) {
        if (mdt_isJoint(p->acting[i]))
            continue;
        MeBool isTouching = MEFALSE;
        for (const MdtPoint *at = mdt_pointFirst(mdt_asManifold(p->acting[i])); at; at = mdt_pointAfter(at)) {
            doesBounce = doesBounce || mdt_bounces(mdt_pointParams(at));
            isTouching = isTouching || touches(at);
        }
        touching += isTouching;
    }
    return doesBounce && touching <= p->world->timedBodies;
}

static int rootOf(int parent[], int i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Joins the bodies of joints; false where more than a few are tied together: such are solved exactly, since passes
 * would let long chains stretch. */
static MeBool areTiesShort(const MdtIsland *p, int parent[], int joints[]) {
    for (int i = 0; i < p->numBodies; i++) {
        p->bodies[i]->index = parent[i] = i;
        joints[i] = 0;
    }
    for (int i = 0; i < p->numActing; i++) {
        const MdtJoint *j = mdt_asJoint(p->acting[i]);
        if (!j)
            continue;
        const MdtBodyID a = j->base.side[0].body, b = j->base.side[1].body;
        const int first = rootOf(parent, (a ? a : b)->index), second = rootOf(parent, (b ? b : a)->index);
        if (first != second)
            joints[first] += joints[second];
        parent[second] = first;
        if (++joints[first] > MDT_TIED_JOINTS || mdt_constraintType(p->acting[i]) == MdtBclUSER)
            return MEFALSE;
    }
    return METRUE;
}

/* Are there many contacts for each joint, and joints in small groups? */
static MeBool areJointsApart(const MdtIsland *p) {
    const int size = 2 * p->numBodies * (int)sizeof(int);
    if (p->numContacts < MDT_CROWD || p->numContacts < 2 * p->numJoints)
        return MEFALSE;
    int *parent = MeChunkGetMem(&p->world->scratch, size);
    const MeBool areShort = parent && areTiesShort(p, parent, parent + p->numBodies);
    if (parent)
        MeChunkPutMem(&p->world->scratch, parent);
    return areShort;
}

MeBool mdt_crowdIsChosen(const MdtIsland *p, int maxRows) {
    const MdtWorld *w = p->world;
    if (p->numContacts == 0 || (p->numJoints > 0 && !areJointsApart(p)) || w->solver == MdtSolverExact ||
        maxRows > w->maxMatrixSize)
        return MEFALSE;
    if (w->solver == MdtSolverFast)
        return METRUE;
    if (p->numBodies <= w->timedBodies || mdt_worldAccuracy(w, p->h) == 0 || isMetInTime(p))
        return MEFALSE;
    return p->numBodies >= MDT_CROWD || (p->numJoints == 0 && (isInFlight(p) || hasImpacts(p)));
}

/* ---- room ---- */

static MeBool isMoving(const MdtKeaVelocity *v) {
    return keaDot(v->lin, v->lin) + keaDot(v->ang, v->ang) > 0;
}

/* Has a point what a manifold of Kea's shares? */
static MeBool hasOwn(const MdtManifold *block) {
    const int own = MDT_OWN_NORMAL | MDT_OWN_PARAMS | MDT_OWN_DIRECTION | MDT_WATCHED;
    for (const MdtExtra *extra = block->extras; extra; extra = extra->next) {
        if (extra->slot != MDT_GROUP_SLOT && ((extra->record.flags & own) || isMoving(&extra->worldVelocity)))
            return METRUE;
    }
    return MEFALSE;
}

int mdt_crowdCount(const MdtIsland *p) {
    int count = 0;
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isManifold(p->acting[i]))
            for (const MdtManifold *block = mdt_asManifold(p->acting[i]); block; block = block->next)
                count += hasOwn(block) ? mdt_countSlots(block) : 1;
    return count;
}

static size_t keaSize(int count) {
    return ((size_t)count * sizeof(MdtKeaManifold) + 15) & ~(size_t)15;
}

size_t mdt_crowdSize(int count) {
    return keaSize(count) + (size_t)count * sizeof(MdtIslandManifold);
}

void mdt_crowdLayOut(MdtIsland *p, void *memory, int count) {
    p->kea.manifolds = memory;
    p->manifolds = (MdtIslandManifold *)(void *)((char *)memory + keaSize(count));
    for (int i = 0; i < count; i++)
        memset(p->manifolds[i].mean, 0, sizeof p->manifolds[i].mean);
}

/* ---- manifolds for Kea ---- */

/* The law of restitution, and whether the bodies touch in this step, are those of a contact's row. */
static void askRow(const MdtIsland *p, const MdtPoint *point, const MdtKeaManifold *m, MdtKeaPoint *to,
                   MeBool *touches) {
    MdtBclContact contact = {.params = mdt_pointParams(point), .penetration = to->depth, .normalForce = to->force[0]};
    MdtKeaRow rows[MdtBclGETMAXROWSCONTACT];
    MdtBclContext x;
    mdt_rowsContext(p, &mdt_manifoldOf(point)->base, mdt_pointWorldVelocity(point), &x);
    x.elapsed = 0;
    x.firstRow = 0;
    keaCopy(contact.position, to->position);
    keaCopy(contact.normal, m->normal);
    keaCopy(contact.direction, m->direction);
    *touches = MdtBclContactPrepare(&contact, &x) > 1;
    MdtBclContactFill(&contact, &x, rows);
    to->rebound = rows[0].bounces ? rows[0].rebound : 0;
}

static void setPoint(const MdtIsland *p, const MdtPoint *point, MdtKeaPoint *to) {
    const MeBool isWarm = point->numWarm > 0 && point->numWarm == point->numRows;
    if (p->elapsed > 0)
        mdt_pointCarried(point, to->position, &to->depth);
    else {
        keaCopy(to->position, point->position);
        to->depth = point->depth;
    }
    to->rebound = 0;
    for (int i = 0; i < 3; i++)
        to->force[i] = isWarm && i < point->numRows ? point->force[i] : 0;
}

/* A manifold of no points, with what the point shares with those that may follow. */
static MdtKeaManifold *beginManifold(MdtIsland *p, const MdtPoint *first) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(first)->base;
    const MdtKeaVelocity *velocity = mdt_pointWorldVelocity(first);
    MdtKeaManifold *m = &p->kea.manifolds[p->kea.numManifolds++];
    for (int k = 0; k < 2; k++)
        m->body[k] = base->side[k].body ? base->side[k].body->index : MdtKeaWORLD;
    m->numPoints = 0;
    m->worldVelocity = isMoving(velocity) ? velocity : NULL;
    mdt_pointNormal(first, m->normal);
    mdt_pointDirection(first, m->normal, m->direction);
    MdtBclContactSurface(mdt_pointParams(first), &p->parameters, &m->surface);
    mdt_checkSurface(p->world, mdt_pointParams(first));
    return m;
}

/* Friction that does not depend on the normal force acts only where bodies touch. */
static void addPoint(MdtIsland *p, MdtKeaManifold *m, MdtPoint *point) {
    const MeBool bounces = (mdt_pointParams(point)->options & MdtBclContactOptionBounce) != 0;
    const int at = m->numPoints++;
    MeBool touches = METRUE;
    setPoint(p, point, &m->point[at]);
    p->manifolds[m - p->kea.manifolds].point[at] = point;
    if (bounces || m->surface.bound[0] > 0 || m->surface.bound[1] > 0)
        askRow(p, point, m, &m->point[at], &touches);
    if (!touches)
        m->surface.bound[0] = m->surface.bound[1] = 0;
}

static void makeBlock(MdtIsland *p, const MdtManifold *block) {
    const MeBool isApart = hasOwn(block);
    MdtKeaManifold *m = NULL;
    for (MdtPoint *point = mdt_pointIn(block, 0); point; point = mdt_pointIn(block, point->slot + 1)) {
        if (!m || isApart)
            m = beginManifold(p, point);
        addPoint(p, m, point);
    }
}

static int rowsOf(const MdtKeaSurface *s) {
    const int first = s->coefficient[0] > 0 || s->bound[0] > 0, second = s->coefficient[1] > 0 || s->bound[1] > 0;
    return 1 + first + second;
}

void mdt_crowdMake(MdtIsland *p) {
    p->kea.numManifolds = p->numManifoldRows = 0;
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isManifold(p->acting[i]))
            for (const MdtManifold *block = mdt_asManifold(p->acting[i]); block; block = block->next)
                makeBlock(p, block);
    for (int i = 0; i < p->kea.numManifolds; i++)
        p->numManifoldRows += p->kea.manifolds[i].numPoints * rowsOf(&p->kea.manifolds[i].surface);
}

/* ---- and back ---- */

static void unpackPoint(const MdtKeaManifold *m, int at, MdtPoint *point, double mean[3], double share) {
    const double *force = m->point[at].force;
    double across[3];
    keaCross(across, m->normal, m->direction);
    keaAddScaled(mean, share * force[0], m->normal);
    keaAddScaled(mean, share * force[1], m->direction);
    keaAddScaled(mean, share * force[2], across);
    keaCopy(point->force, force);
    mdt_toReal(point->mean, mean);
}

void mdt_crowdUnpack(MdtIsland *p, double share, MeBool isGuess) {
    for (int i = 0; i < p->kea.numManifolds; i++) {
        const MdtKeaManifold *m = &p->kea.manifolds[i];
        MdtIslandManifold *own = &p->manifolds[i];
        const int rows = rowsOf(&m->surface);
        for (int k = 0; k < m->numPoints; k++) {
            own->point[k]->numRows = (MeU8)rows;
            own->point[k]->numWarm = isGuess ? (MeU8)rows : 0;
            unpackPoint(m, k, own->point[k], own->mean[k], share);
        }
    }
}

double mdt_crowdPenetration(const MdtIsland *p) {
    double most = 0;
    for (int i = 0; i < p->kea.numManifolds; i++)
        for (int k = 0; k < p->kea.manifolds[i].numPoints; k++)
            most = fmax(most, p->kea.manifolds[i].point[k].depth);
    return most;
}

int mdt_islandRows(const MdtIsland *p) {
    return p->kea.numRows + (p->isFast ? p->numManifoldRows : 0);
}
