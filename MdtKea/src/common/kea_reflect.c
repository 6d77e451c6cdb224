/* Reflections: impacts of a step that is not divided at them.
 *
 * At the start of the step contacts with restitution whose gaps would close within it reflect the velocities of their
 * bodies, in rounds, until no such contact is left. Bodies rebound before they touch, and move freely from there:
 * positions are off by up to the way of a step, the energy is exact. As in divided steps (kea_impact.c), a round
 * reflects all contacts that now approach, so that their order has no effect and what is symmetric remains so. Bodies
 * that such contacts connect are a set; its velocities are reflected along the direction d in which it would be
 * stopped:
 *
 *     v⁺ = v - (v·d + Σ e p J v)/(d·d) d,    d = M⁻¹ Jᵀ p,    p >= 0 with J (v + d) >= 0 where p = 0, = 0 elsewhere
 *
 * (dot products by M; v·d = Σ p J v). With e = 1 this keeps the kinetic energy for any p, so that passes for p need not
 * converge. The number of rounds is finite (Smith et al., Reflections on Simultaneous Impact, 2012), but bounded here:
 * the step stops what is left. Manifolds of sets that are too large for passes, as in packs of touching cubes, are
 * reflected one after the other, which is the law of a set of one manifold.
 *
 * With e < 1, a contact with the gap g and the approach a of loads has the impact speed u, u² = rate² + 2 g a, and
 * separates at this gap with v, v² = e² u² - 2 g a, as if it had closed the gap; with g < 0 alike.
 */
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include "inner/kea_factor_i.h"
#include "inner/kea_graph_i.h"
#include "MeAssert.h"
#include <string.h>

/* A point of a manifold: J of its normal, and M⁻¹ Jᵀ. */
typedef struct Point {
    MdtKeaPoint *at;
    double arm[2][3], turn[2][3], response[2][3]; /* m; 1/kg and per m */
    double mobility;                              /* 1/kg, J M⁻¹ Jᵀ */
    double gap, load, world; /* m; m/s: change of the rate by loads in the step, rate of the world */
    double rate, p;          /* of the present reflection: m/s, N s */
    MeBool isIn;             /* it takes part in the present reflection */
} Point;

typedef struct Face {
    const MdtKeaManifold *manifold;
    double normal[3];
    int first, count;
    int seen;     /* r.clock at the last visit */
    double share; /* of the approach speed with which it separates; negative: it does not meet */
    int next;     /* the next manifold of its set in the present round; -1: none */
} Face;

enum { FIRST = 1 };

typedef struct Reflections {
    MdtKeaSystem *s;
    Face *face;
    Point *point;
    int *meeting; /* manifolds that meet in the present round, in their order */
    /* By body: r.clock at its last change; of the sets of bodies that meet, union-find and the first manifold of each
     * root; the change d that stops them. */
    int *changed, *set, *firstFace;
    double (*change)[6];
    int numFaces, numPoints;
    int clock, visits; /* FIRST + reflections so far; visits of points */
    double speed;      /* m/s: kea_eventSpeed */
} Reflections;

/* ---- set up ---- */

static size_t layOut(const MdtKeaSystem *s, Reflections *r, int numPoints, char *memory) {
    KeaArena arena = {memory, 0};
    KEA_CARVE(&arena, r->face, (size_t)s->numManifolds);
    KEA_CARVE(&arena, r->point, (size_t)numPoints);
    KEA_CARVE(&arena, r->meeting, (size_t)s->numManifolds);
    KEA_CARVE(&arena, r->changed, (size_t)s->numBodies);
    KEA_CARVE(&arena, r->set, (size_t)s->numBodies);
    KEA_CARVE(&arena, r->firstFace, (size_t)s->numBodies);
    KEA_CARVE(&arena, r->change, (size_t)s->numBodies);
    return arena.used;
}

/* m/s: the rate of body k of a point along d, whose angular part is arm x d. */
static double rateOfBody(const Reflections *r, const Face *f, const Point *p, int k, const double d[3]) {
    const MdtKeaVelocity *v = kea_sideVelocity(r->s, f->manifold, k);
    double turn[3];
    keaCross(turn, p->arm[k], d);
    return (k == 0 ? 1 : -1) * (keaDot(d, v->lin) + keaDot(turn, v->ang));
}

/* The part of d along free translations of a body. */
static void freeAxes(const Reflections *r, int body, const double d[3], double freed[3]) {
    keaCopy(freed, d);
    keaDropAxes(r->s->work->body[body].locked, freed);
}

/* 1/kg: the mobility of a point along d. */
static double mobilityAlong(const Reflections *r, const Face *f, const Point *p, const double d[3]) {
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        const int b = f->manifold->body[k];
        double turn[3], response[3], freed[3];
        if (b < 0)
            continue;
        keaCross(turn, p->arm[k], d);
        keaApply(response, (const double(*)[3])r->s->invMass[b].inertia, turn);
        freeAxes(r, b, d, freed);
        sum += r->s->invMass[b].mass * (r->s->work->body[b].locked ? keaDot(freed, freed) : 1) + keaDot(turn, response);
    }
    return sum;
}

static void setPoint(const Reflections *r, const Face *f, Point *p) {
    const MdtKeaSystem *s = r->s;
    p->load = p->world = 0;
    for (int k = 0; k < 2; k++) {
        const int b = f->manifold->body[k];
        const double sign = k == 0 ? 1 : -1;
        keaCross(p->turn[k], p->arm[k], f->normal);
        keaScale(p->turn[k], sign, p->turn[k]);
        keaZero(p->response[k]);
        if (b < 0) {
            p->world += rateOfBody(r, f, p, k, f->normal);
            continue;
        }
        keaApply(p->response[k], (const double(*)[3])s->invMass[b].inertia, p->turn[k]);
        for (int i = 0; i < 3; i++)
            p->load += sign * f->normal[i] * (s->predicted[b].lin[i] - s->velocity[b].lin[i]) +
                       p->turn[k][i] * (s->predicted[b].ang[i] - s->velocity[b].ang[i]);
    }
    p->mobility = mobilityAlong(r, f, p, f->normal);
}

/* Sets place and gap of the point, which the exact solver has measured. */
static void placePoint(const Reflections *r, const MdtKeaManifold *m, MdtKeaPoint *at, const KeaContact *measured,
                       Point *p) {
    p->at = at;
    p->gap = -(measured ? measured->depth : at->depth);
    kea_armsTo(r->s, m, measured ? measured->point : at->position, p->arm);
}

/* Adds a manifold whose contacts bounce; measured: contacts of its points, null in the fast solver. */
static void addFace(Reflections *r, MdtKeaManifold *m, const KeaContact *measured) {
    Face *f = &r->face[r->numFaces];
    *f = (Face){.manifold = m, .first = r->numPoints};
    keaCopy(f->normal, measured ? measured->normal : m->normal);
    for (int k = 0; k < m->numPoints; k++) {
        Point *p = &r->point[r->numPoints];
        if (m->point[k].numRows == 0) /* of the fast solver: its locked ones, too */
            continue;
        placePoint(r, m, &m->point[k], measured ? measured + k : NULL, p);
        setPoint(r, f, p);
        r->numPoints++;
        f->count++;
    }
    r->numFaces += f->count > 0;
}

static void addFaces(Reflections *r) {
    const MdtKeaSystem *s = r->s;
    const MeBool isMeasured = s->parameters.solver != MdtKeaSolverFast;
    for (int i = 0, contact = 0; i < s->numManifolds; contact += s->manifolds[i++].numPoints) {
        MdtKeaManifold *m = &s->manifolds[i];
        if (m->surface.restitution > 0 && !kea_isManifoldTied(s, m))
            addFace(r, m, isMeasured ? &s->work->contact[contact] : NULL);
    }
}

/* ---- approach ---- */

/* The share of the approach speed with which the point separates: 0 below the threshold of restitution; negative: it
 * does not meet within the step, or too slowly, or would not come back to its gap. */
static double reboundShare(const Reflections *r, const Face *f, const Point *p) {
    const MdtKeaSurface *surface = &f->manifold->surface;
    const double h = r->s->parameters.stepsize, e = surface->restitution;
    const double fall = -2 * p->gap * p->load / h; /* m²/s²: until the gap closes; negative: since it did */
    const double ahead = p->gap > 0 ? fall : 0, late = p->gap > 0 ? 0 : keaMax(-fall, 0);
    const double slow = keaMax(kea_minImpactSpeed, kea_separatingSpeed * sqrt(1 - e * e));
    const double min = keaMax(slow * r->speed, kea_minReboundSpeed * fabs(p->load));
    if (!(p->rate < -min) || !(p->gap + h * (p->rate + p->load) < 0))
        return -1;
    const double speed = sqrt(keaMax(p->rate * p->rate + ahead, 0));
    const double rebound = kea_reboundOfImpact(e, surface->threshold, speed, late, 0);
    const double after2 = rebound * rebound - ahead;
    return rebound == 0 ? 0 : after2 < 0 ? -1 : sqrt(keaMin(after2, p->rate * p->rate)) / -p->rate;
}

/* Marks the points that are reflected. Returns the share of the fastest one; negative: none is. */
static double beginReflection(Reflections *r, const Face *f) {
    double fastest = 0, share = -1;
    for (int i = f->first; i < f->first + f->count; i++) {
        Point *p = &r->point[i];
        p->rate = p->world;
        for (int k = 0; k < 2; k++)
            if (f->manifold->body[k] >= 0)
                p->rate += rateOfBody(r, f, p, k, f->normal);
        const double own = reboundShare(r, f, p);
        p->isIn = own >= 0;
        p->p = 0;
        if (own >= 0 && -p->rate > fastest) {
            fastest = -p->rate;
            share = own;
        }
    }
    return share;
}

/* ---- one set of bodies ---- */

/* Adds the change of the bodies' velocities by an impulse at a point to their d. */
static void addChange(const Reflections *r, const Face *f, const Point *p, double impulse) {
    for (int k = 0; k < 2; k++) {
        const int b = f->manifold->body[k];
        double freed[3];
        if (b < 0)
            continue;
        freeAxes(r, b, f->normal, freed);
        keaAddScaled(r->change[b], (k == 0 ? impulse : -impulse) * r->s->invMass[b].mass, freed);
        keaAddScaled(r->change[b] + 3, impulse, p->response[k]);
    }
}

/* m/s: J d of a point. */
static double rateOfChange(const Reflections *r, const Face *f, const Point *p) {
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        const int b = f->manifold->body[k];
        if (b >= 0)
            rate += (k == 0 ? 1 : -1) * keaDot(f->normal, r->change[b]) + keaDot(p->turn[k], r->change[b] + 3);
    }
    return rate;
}

/* A projected Gauss-Seidel pass over the points of a manifold. Returns the largest change of a rate, m/s. */
static double passFace(Reflections *r, const Face *f) {
    double largest = 0;
    for (int i = f->first; i < f->first + f->count; i++) {
        Point *p = &r->point[i];
        if (!p->isIn)
            continue;
        const double before = p->p;
        p->p = keaMax(before - (p->rate + rateOfChange(r, f, p)) / p->mobility, 0);
        addChange(r, f, p, p->p - before);
        largest = keaMax(largest, fabs(p->p - before) * p->mobility);
    }
    r->visits += f->count;
    return largest;
}

/* Stops the points of a manifold. Returns by how much that changes a rate at first, m/s. */
static double stopFace(Reflections *r, const Face *f, double start) {
    const double first = passFace(r, f);
    double change = first;
    for (int pass = 1; pass < KEA_FACE_PASSES && f->count > 1 && change > kea_impactTolerance * keaMax(start, first);
         pass++)
        change = passFace(r, f);
    return first;
}

/* Finds impulses that stop the manifolds of a set, and their d. In each pass the points of a manifold are stopped, so
 * that what lands flat does not rotate. False: they do not converge. */
static MeBool stopSet(Reflections *r, int first) {
    const int last = r->visits + KEA_SET_VISITS;
    double start = 0;
    do {
        double largest = 0;
        for (int i = first; i >= 0; i = r->face[i].next)
            largest = keaMax(largest, stopFace(r, &r->face[i], start));
        start = keaMax(start, largest);
        if (r->face[first].next < 0 || largest <= kea_impactTolerance * start)
            return METRUE;
    } while (r->visits < last);
    return MEFALSE;
}

/* Pushes a point by an impulse along t. */
static void push(Reflections *r, const Face *f, const Point *p, const double t[3], double impulse) {
    for (int k = 0; k < 2; k++) {
        const int b = f->manifold->body[k];
        const double sign = k == 0 ? impulse : -impulse;
        double turn[3], response[3], freed[3];
        if (b < 0)
            continue;
        keaCross(turn, p->arm[k], t);
        keaApply(response, (const double(*)[3])r->s->invMass[b].inertia, turn);
        freeAxes(r, b, t, freed);
        keaAddScaled(r->s->velocity[b].lin, sign * r->s->invMass[b].mass, freed);
        keaAddScaled(r->s->velocity[b].ang, sign, response);
    }
}

/* Friction against the slip along the unit vector t: stops it, or is at its bound. Returns the impulse. */
static double stopSlip(Reflections *r, const Face *f, const Point *p, const double t[3], double slip, double viscosity,
                       double bound) {
    const double mobility = mobilityAlong(r, f, p, t) + viscosity / r->s->parameters.stepsize;
    const double stop = mobility > 0 ? slip / mobility : 0;
    const double impulse = -keaMin(keaMax(stop, -bound), bound);
    push(r, f, p, t, impulse);
    return impulse;
}

static void addFriction(Reflections *r, const Face *f, Point *p, double pressed) {
    const MdtKeaSurface *surface = &f->manifold->surface;
    double t[2][3], slip[2];
    keaCopy(t[0], f->manifold->direction);
    keaCross(t[1], f->normal, t[0]);
    for (int i = 0; i < 2; i++) {
        slip[i] = rateOfBody(r, f, p, 0, t[i]) + rateOfBody(r, f, p, 1, t[i]) - surface->slide[i];
        if (fabs(slip[i]) <= kea_minImpactSpeed * r->speed) /* the rounding of a slip that was stopped */
            slip[i] = 0;
    }
    if (surface->isCone && surface->coefficient[0] > 0) {
        const double size = keaHypotenuse(slip[0], slip[1]);
        double along[3] = {0, 0, 0};
        for (int i = 0; i < 2 && size > 0; i++)
            keaAddScaled(along, slip[i] / size, t[i]);
        const double impulse =
            size > 0 ? stopSlip(r, f, p, along, size, surface->slip[0], surface->coefficient[0] * pressed) : 0;
        for (int i = 0; i < 2 && size > 0; i++)
            p->at->force[1 + i] += impulse * slip[i] / size;
        return;
    }
    for (int i = 0; i < (surface->isOneWay ? 1 : 2); i++)
        if (surface->coefficient[i] > 0)
            p->at->force[1 + i] +=
                stopSlip(r, f, p, t[i], slip[i], surface->slip[i], surface->coefficient[i] * pressed);
}

/* The factor of d for a set: -(v·d + Σ share p J v)/(d·d); 0: there is no d. */
static double factorOf(const Reflections *r, int first) {
    double speed = 0, size = 0;
    for (int i = first; i >= 0; i = r->face[i].next) {
        const Face *f = &r->face[i];
        for (int k = f->first; k < f->first + f->count; k++) {
            const Point *p = &r->point[k];
            speed += p->p * (1 + f->share) * p->rate;
            size += p->p * rateOfChange(r, f, p);
        }
    }
    return size > 0 ? -speed / size : 0;
}

/* Adds the impulses of a reflection to the forces of a manifold's points, with their friction. */
static void addImpulses(Reflections *r, const Face *f, double factor) {
    for (int i = f->first; i < f->first + f->count; i++) {
        Point *p = &r->point[i];
        p->at->force[0] += factor * p->p;
        if (p->p > 0)
            addFriction(r, f, p, factor * p->p);
    }
}

/* Adds the body's change once in the reflection that r.clock counts. */
static void changeBody(Reflections *r, int b, double factor) {
    if (b < 0 || r->changed[b] == r->clock)
        return;
    keaAddScaled(r->s->velocity[b].lin, factor, r->change[b]);
    keaAddScaled(r->s->velocity[b].ang, factor, r->change[b] + 3);
    r->changed[b] = r->clock;
}

/* Begins a set with body b; negative: the world. */
static void beginSet(Reflections *r, int b) {
    if (b < 0)
        return;
    r->set[b] = b;
    r->firstFace[b] = -1;
    memset(r->change[b], 0, sizeof r->change[b]);
}

/* Reflects the velocities of a set that is stopped by the impulses found; first: its first manifold. */
static void reflectTogether(Reflections *r, int first) {
    const double factor = factorOf(r, first);
    if (!(factor > 0))
        return;
    r->clock++;
    for (int i = first; i >= 0; i = r->face[i].next)
        for (int k = 0; k < 2; k++)
            changeBody(r, r->face[i].manifold->body[k], factor);
    for (int i = first; i >= 0; i = r->face[i].next)
        addImpulses(r, &r->face[i], factor);
}

/* Reflects the velocities of a set one manifold after the other. */
static void reflectInTurn(Reflections *r, int first) {
    for (int i = first, next; i >= 0; i = next) {
        Face *f = &r->face[i];
        next = f->next;
        f->next = -1;
        for (int k = 0; k < 2; k++)
            beginSet(r, f->manifold->body[k]);
        f->share = beginReflection(r, f);
        if (f->share >= 0 && stopSet(r, i))
            reflectTogether(r, i);
    }
}

/* Leaves points that approach far more slowly than the fastest one of the set to a later round (kea_impact.c). */
static void leaveSlowPoints(Reflections *r, int first) {
    double fastest = 0;
    for (int i = first; i >= 0; i = r->face[i].next)
        for (int k = 0; k < r->face[i].count; k++)
            if (r->point[r->face[i].first + k].isIn)
                fastest = keaMax(fastest, -r->point[r->face[i].first + k].rate);
    for (int i = first; i >= 0; i = r->face[i].next)
        for (int k = 0; k < r->face[i].count; k++) {
            Point *p = &r->point[r->face[i].first + k];
            if (p->isIn && -p->rate < kea_lastRound * fastest) {
                p->isIn = MEFALSE;
                r->face[i].seen = 0;
            }
        }
}

static void reflectSet(Reflections *r, int first) {
    leaveSlowPoints(r, first);
    if (stopSet(r, first))
        reflectTogether(r, first);
    else
        reflectInTurn(r, first);
}

/* ---- rounds ---- */

/* r.clock at the last change of a body of the manifold. */
static int lastChange(const Reflections *r, const Face *f) {
    int last = 0;
    for (int k = 0; k < 2; k++)
        if (f->manifold->body[k] >= 0 && r->changed[f->manifold->body[k]] > last)
            last = r->changed[f->manifold->body[k]];
    return last;
}

/* Lists the manifolds that meet, and returns their number. One is visited again only if one of its bodies has changed.
 */
static int listMeeting(Reflections *r) {
    int count = 0;
    for (int i = 0; i < r->numFaces; i++) {
        Face *f = &r->face[i];
        if (f->seen >= lastChange(r, f))
            continue;
        f->seen = r->clock;
        r->visits += f->count;
        f->share = beginReflection(r, f);
        if (f->share >= 0)
            r->meeting[count++] = i;
    }
    return count;
}

/* The set of a manifold's bodies. */
static int setOf(const Reflections *r, const Face *f) {
    return kea_rootOf(r->set, f->manifold->body[f->manifold->body[0] >= 0 ? 0 : 1]);
}

/* Joins the bodies that meet into sets, and lists the manifolds of each in their order. */
static void joinSets(Reflections *r, int count) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            beginSet(r, r->face[r->meeting[i]].manifold->body[k]);
    for (int i = 0; i < count; i++) {
        const int *body = r->face[r->meeting[i]].manifold->body;
        if (body[0] >= 0 && body[1] >= 0)
            kea_unite(r->set, body[0], body[1]);
    }
    for (int i = count - 1; i >= 0; i--) {
        Face *f = &r->face[r->meeting[i]];
        int *first = &r->firstFace[setOf(r, f)];
        f->next = *first;
        *first = r->meeting[i];
    }
}

/* Makes rounds until nothing meets or there were `max` reflections of sets. */
static void reflectInRounds(Reflections *r, int max) {
    for (int before = 0, count; before < r->clock && r->clock < max && (count = listMeeting(r)) > 0;) {
        before = r->clock;
        joinSets(r, count);
        for (int i = 0; i < count && r->clock < max; i++)
            if (r->firstFace[setOf(r, &r->face[r->meeting[i]])] == r->meeting[i])
                reflectSet(r, r->meeting[i]);
    }
}

/* ---- all ---- */

static void commit(const Reflections *r) {
    MdtKeaSystem *s = r->s;
    for (int b = 0; b < s->numBodies; b++)
        if (r->changed[b] > FIRST) {
            keaCopy(s->bodies[b]->velocity, s->velocity[b].lin);
            MdtKeaBodySetAngularVelocity(s->bodies[b], s->velocity[b].ang);
            kea_beginBody(s, b);
        }
}

static MeBool begin(Reflections *r) {
    MdtKeaSystem *s = r->s;
    int count = 0;
    for (int i = 0; i < s->numManifolds; i++) {
        count += s->manifolds[i].numPoints;
        for (int k = 0; k < s->manifolds[i].numPoints; k++)
            keaZero(s->manifolds[i].point[k].force);
    }
    char *memory = kea_cacheScratch(s->cache, KEA_STEP_BLOCK, layOut(s, r, count, NULL));
    if (!memory)
        return MEFALSE;
    layOut(s, r, count, memory);
    r->speed = kea_eventSpeed(s);
    r->clock = FIRST;
    for (int b = 0; b < s->numBodies; b++)
        r->changed[b] = FIRST;
    addFaces(r);
    return METRUE;
}

int MEAPI MdtKeaReflect(MdtKeaSystem *s) {
    Reflections r = {.s = s};
    if (!begin(&r))
        return 0;
    reflectInRounds(&r, FIRST + KEA_REFLECTIONS * r.numFaces);
    if (r.clock > FIRST)
        commit(&r);
    s->report.work = KEA_VISIT * (double)r.visits;
    return r.clock - FIRST;
}
