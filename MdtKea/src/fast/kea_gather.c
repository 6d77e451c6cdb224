/* Copies manifolds (double precision) into the groups of eight that passes work on, and their impulses back. */
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include <string.h>
#include "fast/kea_fast_i.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include <stddef.h>

/* Divides the shares by their sum. False: it is 0. */
static MeBool normalizeShares(double share[], int count) {
    double sum = 0;
    for (int k = 0; k < count; k++)
        sum += share[k];
    for (int k = 0; k < count && sum > 0; k++)
        share[k] /= sum;
    return sum > 0;
}

/* Sets the share of each point in the load: as in the last step; without load then, equal for all touching points, or
 * for all points if none touches. */
static void setShares(const MdtKeaManifold *m, double share[KEA_POINTS]) {
    MEASSERT(m->numPoints > 0 && m->numPoints <= KEA_POINTS);
    for (int k = 0; k < m->numPoints; k++)
        share[k] = keaMax(m->point[k].guess[0], 0);
    if (normalizeShares(share, m->numPoints))
        return;
    for (int k = 0; k < m->numPoints; k++)
        share[k] = m->point[k].depth >= 0;
    if (normalizeShares(share, m->numPoints))
        return;
    for (int k = 0; k < m->numPoints; k++)
        share[k] = 1 / (double)m->numPoints;
}

/* Sets centre and coordinates of a manifold. The centre, at which friction acts, is that of the load, so that points
 * without load do not add to the lever of friction. */
static void setPatch(const MdtKeaManifold *m, KeaPatch *p) {
    double share[KEA_POINTS];
    setShares(m, share);
    keaZero(p->centre);
    keaCopy(p->axis[0], m->direction);
    keaCross(p->axis[1], m->normal, m->direction);
    keaCopy(p->axis[2], m->normal);
    for (int k = 0; k < m->numPoints; k++)
        keaAddScaled(p->centre, share[k], m->point[k].position);
    for (int k = 0; k < m->numPoints; k++) {
        double offset[3];
        keaSubtract(offset, m->point[k].position, p->centre);
        p->x[k] = keaDot(offset, p->axis[0]);
        p->y[k] = keaDot(offset, p->axis[1]);
    }
}

/* ---- prefetching ---- */

/* Prefetches the manifold (its first `bytes`) and the patch in this lane of the next group. */
static void prefetchNext(const KeaGathering *from, const KeaGroup groups[], int i, int count, int lane, size_t bytes) {
    const int next = i + 1 < count ? groups[i + 1].manifold[lane] : -1;
    if (next < 0)
        return;
    me_prefetch(&from->s->manifolds[next], bytes);
    me_prefetch(&from->patch[next], sizeof *from->patch);
}

/* ---- from manifolds ---- */

static void setLane3(KeaLanes3 *to, int lane, const double from[3]) {
    to->x[lane] = (float)from[0];
    to->y[lane] = (float)from[1];
    to->z[lane] = (float)from[2];
}

static float clampBound(double bound) {
    MEASSERT(bound >= 0);
    return (float)keaMin(bound, kea_maxBound);
}

static void fillLocks(int locked, int k, KeaLocks *locks, int lane) {
    locks->free[k].x[lane] = locked & 1 ? 0 : 1;
    locks->free[k].y[lane] = locked & 2 ? 0 : 1;
    locks->free[k].z[lane] = locked & 4 ? 0 : 1;
}

static void fillBody(const MdtKeaSystem *s, const int place[], const MdtKeaManifold *m, int k, KeaGroup *g, int lane) {
    const int body = m->body[k];
    MEASSERT(body < s->numBodies);
    g->body[k][lane] = body >= 0 ? 1 + place[body] : 0;
    if (g->locks)
        fillLocks(body >= 0 ? s->bodies[body]->locked : 0, k, g->locks, lane);
}

static void fillInertia(const MdtKeaSystem *s, const MdtKeaManifold *m, int k, KeaGroup *g, int lane) {
    const MdtKeaInverseMassMatrix *mass = m->body[k] >= 0 ? &s->invMass[m->body[k]] : NULL;
    g->invMass[k][lane] = mass ? (float)mass->mass : 0;
    for (int i = 0, at = 0; i < 3; i++)
        for (int j = i; j < 3; j++, at++)
            g->invInertia[k][at][lane] = mass ? (float)mass->inertia[i][j] : 0;
}

static double softnessOf(const MdtKeaSystem *s, const MdtKeaManifold *m) {
    return s->parameters.epsilon + s->parameters.softening * m->surface.softness;
}

/* Whether the compliance is large relative to the masses: it is then part of the matrix, and gamma corrects overlaps by
 * velocities. The sag E F h² / gamma of a smaller one is allowed as slop. */
static MeBool isSoft(const MdtKeaSystem *s, const MdtKeaManifold *m) {
    double mobility = 0;
    for (int k = 0; k < 2; k++)
        mobility += m->body[k] >= 0 ? s->invMass[m->body[k]].mass : 0;
    return softnessOf(s, m) > kea_softShare * mobility;
}

static KeaApproach approachOf(const MdtKeaSystem *s, const MdtKeaManifold *m, const MdtKeaPoint *point) {
    double arm[2][3];
    kea_armsTo(s, m, point->position, arm);
    return kea_approachOfPoint(s, m, (const double(*)[3])arm);
}

/* m: the lower bound of the point's displacement along the normal in the step. A gap may close. A gap below the resting
 * depth at a point that has carried a load counts as closed: it is due to a tilt of the face, and targets of its points
 * would contradict each other otherwise. */
static double minDisplacement(const MdtKeaSystem *s, const MdtKeaManifold *m, const MdtKeaPoint *point, double size,
                              MeBool isSoft) {
    const double resting = point->guess[0] > 0 ? kea_restingDepth * size : 0;
    if (point->depth >= 0)
        return isSoft ? s->parameters.gamma * point->depth : 0;
    if (s->parameters.collidesAtStart && point->depth > -kea_nearbyGap * size)
        return 0;
    if (s->parameters.collidesAtEnd && !(point->guess[0] > 0))
        return -HUGE_VAL;
    const double start = s->parameters.followsContacts ? s->parameters.stepsize * approachOf(s, m, point).rate : 0;
    const double mean = 2 * point->depth - start; /* where the mean motion closes the gap */
    return keaMin(keaMin(point->depth, start < 0 ? mean : 0) + resting, 0);
}

/* Whether locked axes leave the point no rows (MdtKeaCountContactRows). */
static MeBool isLocked(const MdtKeaSystem *s, const MdtKeaPoint *point) {
    return s->work->hasLocks && point->numRows == 0;
}

static void fillPoint(const MdtKeaSystem *s, const MdtKeaManifold *m, const KeaPatch *p, double size, int k,
                      KeaGroup *g, int lane) {
    const MdtKeaPoint *point = &m->point[k];
    const double h = s->parameters.stepsize, gamma = s->parameters.gamma;
    const MeBool soft = g->correction[lane] == 0;
    const double slop = soft || gamma == 0 ? 0 : softnessOf(s, m) * h * h * keaMax(point->guess[0], 0) / gamma;
    const double along = g->isOneWay[lane] ? 0 : p->x[k];
    g->isPoint[k][lane] = isLocked(s, point) ? 0 : -1;
    g->x[k][lane] = (float)p->x[k];
    g->y[k][lane] = (float)p->y[k];
    g->gap[k][lane] = (float)-point->depth;
    g->slop[k][lane] = (float)(slop + kea_restingDepth * size);
    g->bias[k][lane] = (float)keaMax(minDisplacement(s, m, point, size, soft) / h, -kea_maxBound);
    g->lever[k][lane] = (float)sqrt(along * along + p->y[k] * p->y[k]);
    g->impulse[k][lane] = isLocked(s, point) ? 0 : (float)(h * keaMax(point->guess[0], -m->surface.adhesion));
}

static void fillRebounds(const MdtKeaSystem *s, const MdtKeaManifold *m, KeaGroup *g, int lane) {
    const MeBool soft = g->correction[lane] == 0;
    const double passes = soft ? 1 : kea_pushExponent * KEA_POSITION_PASSES,
                 left = pow(1 - s->parameters.gamma, passes);
    for (int k = 0; k < m->numPoints && m->surface.restitution > 0; k++) {
        const KeaApproach a = approachOf(s, m, &m->point[k]);
        g->rebound[k][lane] =
            (float)kea_reboundInStep(s, &a, -m->point[k].depth, left, m->surface.restitution, m->surface.threshold);
        if (soft || m->surface.restitution < 1 || g->rebound[k][lane] > 0)
            continue;
        const KeaHop hop =
            kea_hopInStep(s, m->body, &a, m->point[k].depth, m->surface.threshold, (double)g->bias[k][lane]);
        g->bias[k][lane] = (float)(hop.fixed - hop.share * a.rate);
    }
}

/* Sets the constant bounds of friction, N s in both directions and N m s about the normal. Such friction acts at all
 * points that may touch in this step. */
static void fillBounds(const MdtKeaSystem *s, const MdtKeaManifold *m, KeaGroup *g, int lane) {
    const double h = s->parameters.stepsize, *bound = m->surface.bound;
    double count = 0, lever = 0;
    for (int k = 0; k < m->numPoints && (bound[0] > 0 || bound[1] > 0); k++) {
        const KeaApproach a = approachOf(s, m, &m->point[k]);
        if (isLocked(s, &m->point[k]) || !kea_mayTouch(s, m->body, &a, -m->point[k].depth))
            continue;
        count += 1;
        lever += (double)g->lever[k][lane];
    }
    for (int i = 0; i < 2; i++)
        g->bound[i][lane] = count > 0 ? clampBound(h * count * bound[i]) : 0;
    g->torsionBound[lane] = lever > 0 ? clampBound(h * lever * bound[0]) : 0;
}

/* Sets the parameters of friction and its warm start: the friction of all points in the last step, as an impulse at the
 * centre and a moment. */
static void fillFriction(const MdtKeaSystem *s, const MdtKeaManifold *m, const KeaPatch *p, KeaGroup *g, int lane) {
    const double h = s->parameters.stepsize;
    double torsionImpulse = 0, frictionImpulse[2] = {0, 0};
    for (int k = 0; k < m->numPoints; k++) {
        const double *guess = m->point[k].guess;
        for (int i = 0; i < 2; i++)
            frictionImpulse[i] += guess[1 + i];
        torsionImpulse += p->x[k] * guess[2] - p->y[k] * guess[1];
    }
    for (int i = 0; i < 2; i++) {
        g->frictionImpulse[i][lane] = (float)(h * frictionImpulse[i]);
        g->coefficient[i][lane] = clampBound(m->surface.coefficient[i]);
        g->slip[i][lane] = (float)(m->surface.slip[i] / (h * m->numPoints));
        g->slide[i][lane] = (float)m->surface.slide[i];
    }
    g->torsionImpulse[lane] = (float)(h * torsionImpulse);
    g->rolling[lane] = clampBound(m->surface.rolling);
    g->spinning[lane] = clampBound(m->surface.spinning);
    g->resistsRotation |= m->surface.rolling > 0 || m->surface.spinning > 0;
    g->isCone[lane] = m->surface.isCone ? -1 : 0;
}

/* Whether lever arms are to change in the step: a body rotates, and the relative displacement of both bodies at the
 * centre is below kea_pressedDepth. If the bodies collide or slide, impulses act at one common point, that of the
 * start; otherwise angular momentum would not be conserved. A mover has none: it turns in any case, and what slides on
 * it can come to rest. */
static MeBool doArmsRotate(const MdtKeaSystem *s, const MdtKeaManifold *m, const KeaPatch *p) {
    double rate[3] = {0, 0, 0}, spin2 = 0;
    for (int k = 0; k < 2; k++) {
        const MdtKeaVelocity *v = kea_sideVelocity(s, m, k);
        double turn[3];
        keaCross(turn, v->ang, p->arm[k]);
        keaAddScaled(rate, k == 0 ? 1 : -1, v->lin);
        keaAddScaled(rate, k == 0 ? 1 : -1, turn);
        spin2 += keaDot(v->ang, v->ang);
    }
    return spin2 > 0 && (m->mover || 0.5 * s->parameters.stepsize * keaLength(rate) <
                                         kea_pressedDepth * kea_smallerExtent(s, m->body));
}

/* The velocity with which a side will move during the step, as predicted by its acceleration of the last one. If that
 * would change the velocity by more than itself, it was a jerk, such as an impact, and the velocity at the start
 * counts. */
static void predictMove(const MdtKeaSystem *s, const MdtKeaManifold *m, int k, double move[6]) {
    const MdtKeaVelocity *v = kea_sideVelocity(s, m, k);
    keaCopy(move, v->lin);
    keaCopy(move + 3, v->ang);
    if (m->body[k] < 0)
        return;
    const double half = 0.5 * s->parameters.stepsize, *a = s->bodies[m->body[k]]->acceleration;
    if (half * keaLength(a) < keaLength(v->lin))
        keaAddScaled(move, half, a);
    if (half * keaLength(a + 3) < keaLength(v->ang))
        keaAddScaled(move + 3, half, a + 3);
}

/* Whether a vertex of body k carries at each point of a manifold that has a load; or at all, if none has. */
static MeBool isOnVertices(const MdtKeaManifold *m, int k) {
    MeBool isLoaded = MEFALSE, areLoaded = METRUE, areAll = METRUE;
    for (int i = 0; i < m->numPoints; i++) {
        const MeBool hasLoad = m->point[i].guess[0] > 0;
        isLoaded |= hasLoad;
        areLoaded &= !hasLoad || m->point[i].isVertex[k];
        areAll &= m->point[i].isVertex[k];
    }
    return isLoaded ? areLoaded : areAll;
}

/* Velocities of the sides of a contact: the mean of the step, with which they move, and the angular one at its end. */
typedef struct SideMotions {
    double mean[2][6], spin[2][3];
} SideMotions;

/* Before the passes: predicted ones, and the spin of the start. */
static void predictMotions(const MdtKeaSystem *s, const MdtKeaManifold *m, SideMotions *sides) {
    for (int k = 0; k < 2; k++) {
        predictMove(s, m, k, sides->mean[k]);
        keaCopy(sides->spin[k], kea_sideVelocity(s, m, k)->ang);
    }
}

/* Turns the axes of a manifold. v: the relative velocity at the end. */
static void turnAxes(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], const double v[3],
                     KeaPatch *p) {
    double start[3][3];
    keaCopy(start[0], c->manifold->direction);
    keaCross(start[1], c->manifold->normal, c->manifold->direction);
    keaCopy(start[2], c->manifold->normal);
    for (int i = 0; i < 3 && (c->followsCentres || keaDot(c->faceTurn, c->faceTurn) > 0); i++) {
        double end[3];
        keaCopy(end, start[i]);
        keaCopy(p->axis[i], start[i]);
        kea_contactTurnDirection(s, c, move, 1, end);
        kea_contactTurnDirection(s, c, move, 0.5, p->axis[i]);
        keaScale(p->axis[i], 1 / keaLength(p->axis[i]), p->axis[i]);
        p->turned[i] = keaDot(end, v) - keaDot(p->axis[i], v);
    }
}

/* The lever arms of a manifold. Impulses act with the mean of the arms at the start and at the end of the step;
 * otherwise bodies that rotate together would gain angular momentum. The contact laws hold for the rates at the end.
 * Their difference from the rates with the mean arms is added := Σ ± w_k x (arm_k⁺ - arm_k), w the spin at the end. */
static void moveArms(const MdtKeaSystem *s, KeaContact *c, const SideMotions *sides, KeaPatch *p) {
    double end[2][3], v[3] = {0, 0, 0};
    kea_contactArms(s, c, sides->mean, 0.5, p->arm);
    kea_contactArms(s, c, sides->mean, 1, end);
    for (int k = 0; k < 2; k++) {
        double remainder[3], rate[3], spun[3];
        keaCross(spun, sides->spin[k], end[k]);
        keaAddScaled(v, k == 0 ? 1 : -1, spun);
        keaAddScaled(v, k == 0 ? 1 : -1, sides->mean[k]);
        keaSubtract(remainder, end[k], p->arm[k]);
        keaCross(rate, sides->spin[k], remainder);
        keaAddScaled(p->added, k == 0 ? 1 : -1, rate);
    }
    turnAxes(s, c, sides->mean, v, p);
}

/* The contact at the centre of a manifold. False: its lever arms do not change in the step. */
static MeBool placeCentre(const MdtKeaSystem *s, const MdtKeaManifold *m, const KeaPatch *p, MdtKeaPoint *centre,
                          KeaContact *c) {
    *centre = m->point[0];
    *c = (KeaContact){.manifold = m, .at = centre};
    keaCopy(centre->position, p->centre);
    for (int k = 0; k < 2; k++)
        centre->isVertex[k] = isOnVertices(m, k);
    kea_contactPlaceAtStart(s, c);
    kea_contactChooseMotion(s, c);
    return c->moves;
}

static void setArms(const MdtKeaSystem *s, const MdtKeaManifold *m, KeaPatch *p) {
    MdtKeaTransformation memory;
    MdtKeaPoint centre;
    KeaContact c;
    SideMotions sides;
    keaZero(p->added);
    keaZero(p->turned);
    for (int k = 0; k < 2; k++)
        keaSubtract(p->arm[k], p->centre, kea_sidePose(s, m, k, &memory)->pos);
    if (!doArmsRotate(s, m, p) || !placeCentre(s, m, p, &centre, &c))
        return;
    predictMotions(s, m, &sides);
    moveArms(s, &c, &sides, p);
}

/* Subtracts `share` of `added` from the targets, which are those of the rates with the mean arms. */
static void subtractArmRates(const MdtKeaManifold *m, const KeaPatch *p, double share, KeaGroup *g, int lane) {
    double rate[3];
    for (int i = 0; i < 3; i++)
        rate[i] = share * (keaDot(p->added, p->axis[i]) + p->turned[i]);
    g->slide[0][lane] -= (float)rate[0];
    g->slide[1][lane] -= (float)rate[1];
    for (int k = 0; k < m->numPoints; k++)
        g->bias[k][lane] -= (float)rate[2];
}

static void fillLane(const KeaGathering *from, int manifold, float correction, KeaGroup *g, int lane) {
    const MdtKeaSystem *s = from->s;
    const MdtKeaManifold *m = &s->manifolds[manifold];
    KeaPatch *p = &from->patch[manifold];
    const double size = kea_smallerExtent(s, m->body);
    setPatch(m, p);
    setArms(s, m, p);
    setLane3(&g->normal, lane, p->axis[2]);
    setLane3(&g->along, lane, p->axis[0]);
    for (int k = 0; k < 2; k++) {
        fillBody(s, from->place, m, k, g, lane);
        fillInertia(s, m, k, g, lane);
        setLane3(&g->arm[k], lane, p->arm[k]);
    }
    const MeBool soft = isSoft(s, m);
    g->size[lane] = (float)size;
    g->pressed[lane] = (float)(kea_pressedDepth * size);
    g->compliance[lane] = soft ? (float)softnessOf(s, m) : 0;
    g->correction[lane] = soft ? 0 : correction;
    g->min[lane] = -clampBound(s->parameters.stepsize * m->surface.adhesion);
    g->isOneWay[lane] = m->surface.isOneWay ? -1 : 0;
    for (int k = 0; k < m->numPoints; k++)
        fillPoint(s, m, p, size, k, g, lane);
    fillRebounds(s, m, g, lane);
    fillBounds(s, m, g, lane);
    fillFriction(s, m, p, g, lane);
    subtractArmRates(m, p, 1, g, lane);
}

/* After passes: the motion that they have found. */
static void findMotions(const KeaGathering *from, const MdtKeaManifold *m, const KeaGroup *g, int lane,
                        SideMotions *sides) {
    for (int k = 0; k < 2; k++) {
        const MdtKeaVelocity *start = kea_sideVelocity(from->s, m, k);
        const KeaMotion *end = &from->motion[g->body[k][lane]];
        for (int i = 0; i < 3; i++) {
            sides->mean[k][i] = 0.5 * (start->lin[i] + (double)end->lin[i]);
            sides->mean[k][3 + i] = 0.5 * (start->ang[i] + (double)end->ang[i]);
            sides->spin[k][i] = (double)end->ang[i];
        }
    }
}

/* m/s: the change of the rates by new lever arms. */
static double changeOfRates(const KeaPatch *p, const KeaPatch *before, const SideMotions *sides) {
    double change[3];
    keaSubtract(change, p->added, before->added);
    for (int k = 0; k < 2; k++) {
        double moved[3], rate[3];
        keaSubtract(moved, p->arm[k], before->arm[k]);
        keaCross(rate, sides->spin[k], moved);
        keaAddScaled(change, k == 0 ? 1 : -1, rate);
    }
    return keaLength(change);
}

static double renewArmsOfLane(const KeaGathering *from, KeaGroup *g, int lane) {
    const MdtKeaManifold *m = &from->s->manifolds[g->manifold[lane]];
    KeaPatch *p = &from->patch[g->manifold[lane]], before = *p;
    MdtKeaPoint centre;
    KeaContact c;
    SideMotions sides;
    findMotions(from, m, g, lane, &sides);
    if (!placeCentre(from->s, m, p, &centre, &c) || !c.rolls)
        return 0;
    subtractArmRates(m, p, -1, g, lane);
    keaZero(p->added);
    moveArms(from->s, &c, &sides, p);
    subtractArmRates(m, p, 1, g, lane);
    const double bend = kea_contactBend(from->s, &c, (const double(*)[6])sides.mean);
    const double ofPath = c.circle[0] > 0 || c.circle[1] > 0 ? kea_nearbyGap : kea_pressedDepth;
    g->pressed[lane] = (float)(ofPath * (double)g->size[lane] + keaMax(centre.depth, 0));
    for (int k = 0; k < m->numPoints; k++)
        g->gap[k][lane] = (float)(bend - m->point[k].depth);
    for (int k = 0; k < 2; k++)
        setLane3(&g->arm[k], lane, p->arm[k]);
    return changeOfRates(p, &before, &sides);
}

double kea_renewArms(const KeaGathering *from, KeaGroup groups[], int count) {
    double change = 0;
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            if (groups[i].manifold[lane] >= 0)
                change = keaMax(change, renewArmsOfLane(from, &groups[i], lane));
    return change;
}

void kea_renewInertia(const KeaGathering *from, KeaGroup groups[], int count) {
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            for (int k = 0; k < 2 && groups[i].manifold[lane] >= 0; k++)
                fillInertia(from->s, &from->s->manifolds[groups[i].manifold[lane]], k, &groups[i], lane);
}

static void setWorldMotion(const MdtKeaVelocity *velocity, KeaMotion *world) {
    memset(world, 0, sizeof *world);
    for (int c = 0; c < 3; c++) {
        world->lin[c] = (float)velocity->lin[c];
        world->ang[c] = (float)velocity->ang[c];
    }
}

static void fillWorlds(const KeaGathering *from, const MdtKeaManifold *m, KeaGroup *g, int lane) {
    for (int k = 0; k < 2; k++)
        if (m->body[k] < 0) {
            const int world = g->body[k][lane] = 1 + from->s->numBodies + g->manifold[lane];
            setWorldMotion(m->worldVelocity, &from->motion[world]);
            memset(&from->displacement[world], 0, sizeof *from->displacement);
        }
}

void kea_fillGroups(const KeaGathering *from, KeaGroup groups[], int count) {
    const MdtKeaSystem *s = from->s;
    const float correction = (float)(1 - pow(1 - s->parameters.gamma, kea_pushExponent));
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            const int manifold = groups[i].manifold[lane];
            prefetchNext(from, groups, i, count, lane, sizeof *s->manifolds);
            if (manifold < 0)
                continue;
            fillLane(from, manifold, correction, &groups[i], lane);
            if (s->manifolds[manifold].worldVelocity)
                fillWorlds(from, &s->manifolds[manifold], &groups[i], lane);
        }
}

/* ---- back to manifolds ---- */

/* The changes of momentum by a manifold's impulses, N s and N m s, of its first and its second body, each about its own
 * centre of mass, or the origin for the world. In double precision both linear parts are equal and opposite to the last
 * bit. */
static void impulsesOf(const KeaGathering *from, const KeaGroup *g, int lane, double of[2][6]) {
    const MdtKeaManifold *m = &from->s->manifolds[g->manifold[lane]];
    const KeaPatch *p = &from->patch[g->manifold[lane]];
    double impulse[3], couple[3];
    keaScale(impulse, (double)g->frictionImpulse[0][lane], p->axis[0]);
    keaAddScaled(impulse, (double)g->frictionImpulse[1][lane], p->axis[1]);
    keaScale(couple, (double)g->torsionImpulse[lane], p->axis[2]);
    keaAddScaled(couple, (double)g->rollingImpulse[0][lane], p->axis[0]);
    keaAddScaled(couple, (double)g->rollingImpulse[1][lane], p->axis[1]);
    for (int k = 0; k < m->numPoints; k++) {
        const double normal = (double)g->impulse[k][lane];
        keaAddScaled(impulse, normal, p->axis[2]);
        keaAddScaled(couple, normal * p->y[k], p->axis[0]);
        keaAddScaled(couple, -normal * p->x[k], p->axis[1]);
    }
    for (int k = 0; k < 2; k++) {
        double turn[3];
        keaCross(turn, p->arm[k], impulse);
        keaAddScaled(turn, 1, couple);
        keaScale(of[k], k == 0 ? 1 : -1, impulse);
        keaScale(of[k] + 3, k == 0 ? 1 : -1, turn);
    }
}

static void addImpulse(const KeaGathering *from, const KeaGroup *g, int lane, double (*change)[6]) {
    const MdtKeaManifold *m = &from->s->manifolds[g->manifold[lane]];
    double of[2][6];
    impulsesOf(from, g, lane, of);
    for (int k = 0; k < 2; k++)
        if (m->body[k] >= 0)
            kea_addScaled6(change[g->body[k][lane] - 1], 1, of[k]);
}

/* J: work of one manifold (kea_workOfSurfaces). */
static double workOfManifold(const KeaGathering *from, const KeaGroup *g, int lane) {
    const MdtKeaManifold *m = &from->s->manifolds[g->manifold[lane]];
    double work = 0, of[2][6];
    for (int k = 0; k < 2; k++)
        work += (double)g->frictionImpulse[k][lane] * (double)g->slide[k][lane];
    for (int k = 0; k < m->numPoints && g->compliance[lane] > 0; k++)
        work += (double)g->impulse[k][lane] * keaMax((double)g->bias[k][lane], 0);
    if (!m->worldVelocity)
        return work;
    impulsesOf(from, g, lane, of);
    for (int k = 0; k < 2; k++)
        if (m->body[k] < 0)
            work -= keaDot(of[k], m->worldVelocity->lin) + keaDot(of[k] + 3, m->worldVelocity->ang);
    return work;
}

double kea_workOfSurfaces(const KeaGathering *from, const KeaGroup groups[], int count) {
    double work = 0;
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            if (groups[i].manifold[lane] >= 0)
                work += workOfManifold(from, &groups[i], lane);
    return work;
}

void kea_addImpulses(const KeaGathering *from, const KeaGroup groups[], int count, double (*change)[6]) {
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            prefetchNext(from, groups, i, count, lane, offsetof(MdtKeaManifold, radius));
            if (groups[i].manifold[lane] >= 0)
                addImpulse(from, &groups[i], lane, change);
        }
}

void kea_scaleImpulses(KeaGroup groups[], int count, float share) {
    MEASSERT(share >= 0 && share <= 1);
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            KeaGroup *g = &groups[i];
            for (int k = 0; k < KEA_POINTS; k++)
                g->impulse[k][lane] = share > 0 ? share * g->impulse[k][lane] : 0;
            for (int k = 0; k < 2; k++) {
                g->frictionImpulse[k][lane] = share > 0 ? share * g->frictionImpulse[k][lane] : 0;
                g->rollingImpulse[k][lane] = share > 0 ? share * g->rollingImpulse[k][lane] : 0;
            }
            g->torsionImpulse[lane] = share > 0 ? share * g->torsionImpulse[lane] : 0;
        }
}

static double square(double x) {
    return x * x;
}

/* Writes the forces of points. Friction is distributed to the points by their shares w of the normal force, its moment
 * by w times the distance from the weighted centre q_m of the points:
 *     f_k = w_k f + w_k (tau - tau_0) n x (q_k - q_m) / Σ w q²,     tau_0: the moment of the first part. */
static void returnForcesOfPoints(const KeaGathering *from, const KeaGroup *g, int lane) {
    MdtKeaManifold *m = &from->s->manifolds[g->manifold[lane]];
    const KeaPatch *p = &from->patch[g->manifold[lane]];
    const double h = from->s->parameters.stepsize,
                 frictionImpulse[2] = {(double)g->frictionImpulse[0][lane], (double)g->frictionImpulse[1][lane]};
    double sum = 0, middle[2] = {0, 0}, spread = 0, share[KEA_POINTS];
    for (int k = 0; k < m->numPoints; k++)
        sum += keaMax((double)g->impulse[k][lane], 0);
    for (int k = 0; k < m->numPoints; k++) {
        share[k] = sum > 0 ? keaMax((double)g->impulse[k][lane], 0) / sum : 1 / (double)m->numPoints;
        middle[0] += share[k] * p->x[k];
        middle[1] += share[k] * p->y[k];
    }
    for (int k = 0; k < m->numPoints; k++)
        spread += share[k] * (square(p->x[k] - middle[0]) + square(p->y[k] - middle[1]));
    const double remainder =
        (double)g->torsionImpulse[lane] - (middle[0] * frictionImpulse[1] - middle[1] * frictionImpulse[0]);
    const double turn = spread > 0 ? remainder / spread : 0;
    for (int k = 0; k < m->numPoints; k++) {
        double *force = m->point[k].force;
        force[0] = (double)g->impulse[k][lane] / h;
        force[1] = share[k] * (frictionImpulse[0] - turn * (p->y[k] - middle[1])) / h;
        force[2] = share[k] * (frictionImpulse[1] + turn * (p->x[k] - middle[0])) / h;
    }
}

void kea_returnManifolds(const KeaGathering *from, const KeaGroup groups[], int count) {
    for (int i = 0; i < count; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            prefetchNext(from, groups, i, count, lane, sizeof *from->s->manifolds);
            if (groups[i].manifold[lane] >= 0)
                returnForcesOfPoints(from, &groups[i], lane);
        }
}
