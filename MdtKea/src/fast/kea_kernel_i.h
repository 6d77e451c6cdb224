/* Inside Kea: the fast solver's operations on groups of eight manifolds (kea_fast_i.h). It is included by one source
 * for each width of registers, which defines KEA_KERNEL, the name of its table. */
#include "fast/kea_lanes_i.h"
#include "common/kea_policy_i.h"

/* Velocities, or displacements, of both bodies of each manifold of a group. */
typedef struct Pair {
    KeaLanes3 lin[2], ang[2];
} Pair;

/* Reads the motions of both bodies of each manifold. */
KEA_INLINE Pair gatherPair(const KeaGroup *g, const KeaMotion motion[]) {
    Pair p;
    for (int k = 0; k < 2; k++) {
        const float *lin[KEA_LANES], *ang[KEA_LANES];
        for (int i = 0; i < KEA_LANES; i++) {
            lin[i] = motion[g->body[k][i]].lin;
            ang[i] = motion[g->body[k][i]].ang;
        }
        p.lin[k] = lanesGather(lin);
        p.ang[k] = lanesGather(ang);
    }
    return p;
}

/* Writes the pair back to `motion`, but not the world, which does not move and is shared by groups. */
KEA_INLINE void scatterPair(const KeaGroup *g, const Pair *p, KeaMotion motion[]) {
    KeaMotion world;
    for (int k = 0; k < 2; k++) {
        float *lin[KEA_LANES], *ang[KEA_LANES];
        for (int i = 0; i < KEA_LANES; i++) {
            KeaMotion *m = g->body[k][i] ? &motion[g->body[k][i]] : &world;
            lin[i] = m->lin;
            ang[i] = m->ang;
        }
        lanesScatter(lin, p->lin[k]);
        lanesScatter(ang, p->ang[k]);
    }
}

/* Velocity of the first body relative to the second, at the centre. */
KEA_INLINE KeaLanes3 rateAtCentre(const KeaGroup *g, const Pair *p) {
    return lanesDifference(lanesSum(p->lin[0], lanesCross(p->ang[0], g->arm[0])),
                           lanesSum(p->lin[1], lanesCross(p->ang[1], g->arm[1])));
}

/* The part of a vector along free translations of a body. */
KEA_INLINE KeaLanes3 freeAxes(const KeaGroup *g, int b, KeaLanes3 a) {
    const KeaLanes3 *free = &g->locks->free[b];
    return (KeaLanes3){free->x * a.x, free->y * a.y, free->z * a.z};
}

/* Applies an impulse at the centre and a couple to both bodies. */
KEA_INLINE void applyImpulse(const KeaGroup *g, Pair *p, KeaLanes3 impulse, KeaLanes3 couple) {
    if (g->locks) {
        p->lin[0] = lanesSum(p->lin[0], lanesScale(g->invMass[0], freeAxes(g, 0, impulse)));
        p->lin[1] = lanesDifference(p->lin[1], lanesScale(g->invMass[1], freeAxes(g, 1, impulse)));
    } else {
        p->lin[0] = lanesSum(p->lin[0], lanesScale(g->invMass[0], impulse));
        p->lin[1] = lanesDifference(p->lin[1], lanesScale(g->invMass[1], impulse));
    }
    p->ang[0] = lanesSum(p->ang[0], lanesApply(g->invInertia[0], lanesSum(lanesCross(g->arm[0], impulse), couple)));
    p->ang[1] =
        lanesDifference(p->ang[1], lanesApply(g->invInertia[1], lanesSum(lanesCross(g->arm[1], impulse), couple)));
}

/* The parameter `points` of the functions below is the maximal number of points of the group's manifolds. Callers pass
 * a constant, for which the loops are unrolled. Points beyond it have impulse 0 and would add 0: the bits are the
 * same. */

/* The sum of normal impulses, and their moments Σ x p, Σ y p. */
KEA_INLINE void resultantOf(const KeaGroup *g, int points, const KeaLanes impulse[], KeaLanes r[3]) {
    r[0] = r[1] = r[2] = lanesOf(0);
    for (int k = 0; k < points; k++) {
        r[0] += impulse[k];
        r[1] += impulse[k] * g->x[k];
        r[2] += impulse[k] * g->y[k];
    }
}

/* The moment about the centre of normal impulses with the resultant r. */
KEA_INLINE KeaLanes3 coupleOf(const KeaGroup *g, KeaLanes3 across, const KeaLanes r[3]) {
    return lanesDifference(lanesScale(r[2], g->along), lanesScale(r[1], across));
}

/* Applies changes of normal impulses to both bodies. */
KEA_INLINE void applyNormals(const KeaGroup *g, int points, Pair *p, KeaLanes3 across, const KeaLanes change[]) {
    KeaLanes r[3];
    resultantOf(g, points, change, r);
    applyImpulse(g, p, lanesScale(r[0], g->normal), coupleOf(g, across, r));
}

/* The vector a t1 + b t2. */
KEA_INLINE KeaLanes3 inTangentPlane(const KeaGroup *g, KeaLanes3 across, KeaLanes a, KeaLanes b) {
    return lanesSum(lanesScale(a, g->along), lanesScale(b, across));
}

/* Applies normal impulses with the resultant r, friction along t1 and t2, and friction about n. */
KEA_INLINE void applyAll(const KeaGroup *g, Pair *p, KeaLanes3 across, const KeaLanes r[3],
                         const KeaLanes frictionImpulse[2], KeaLanes torsionImpulse) {
    const KeaLanes3 friction = inTangentPlane(g, across, frictionImpulse[0], frictionImpulse[1]);
    applyImpulse(g, p, lanesSum(lanesScale(r[0], g->normal), friction),
                 lanesSum(coupleOf(g, across, r), lanesScale(torsionImpulse, g->normal)));
}

/* Relative rates of the first body at the centre: u of kea_fast_i.h; along t1 and t2, m/s; about n, rad/s. */
typedef struct Rates {
    KeaLanes u[3], slide[2], spin;
} Rates;

KEA_INLINE Rates ratesOf(const KeaGroup *g, const Pair *p, KeaLanes3 across) {
    const KeaLanes3 v = rateAtCentre(g, p), w = lanesDifference(p->ang[0], p->ang[1]);
    return (Rates){.u = {lanesDot(g->normal, v), -lanesDot(across, w), lanesDot(g->along, w)},
                   .slide = {lanesDot(g->along, v), lanesDot(across, v)},
                   .spin = lanesDot(g->normal, w)};
}

/* The rate along n at point k. */
KEA_INLINE KeaLanes pointRate(const KeaGroup *g, int k, const KeaLanes u[3]) {
    return u[0] + g->x[k] * u[1] + g->y[k] * u[2];
}

/* The index of an entry of a symmetric 4 by 4 matrix that is stored by rows of its upper triangle. */
KEA_INLINE int entryOf(int i, int j) {
    return i <= j ? 4 * i - i * (i - 1) / 2 + j - i : 4 * j - j * (j - 1) / 2 + i - j;
}

/* One projected Gauss-Seidel update of point k; `left` are the residual rates of all points. */
KEA_INLINE void visitPoint(const KeaGroup *g, int points, int k, KeaLanes min, KeaLanes swept[], KeaLanes left[]) {
    const KeaLanes next = lanesMax(swept[k] - g->response[k] * left[k], min), change = next - swept[k];
    swept[k] = next;
    for (int j = 0; j < points; j++)
        left[j] += change * g->coupling[entryOf(k, j)];
}

/* Solves the complementarity problem of the normal impulses: rate + compliance impulse >= 0, impulse >= min, and one of
 * them with equality. First by the inverse, as if all points acted; if a point would pull, by three projected
 * Gauss-Seidel sweeps over the points, forwards and backwards: with one sweep a tower of 20 falls, eight gain nothing.
 * `impulse` is the guess, and then the answer; `rate` are the rates with the guess, minus their targets. */
KEA_INLINE void solvePoints(const KeaGroup *g, int points, const KeaLanes rate[], KeaLanes min, KeaLanes impulse[]) {
    KeaLanes all[KEA_POINTS], swept[KEA_POINTS], left[KEA_POINTS];
    KeaMask isAnswer = g->isDirect;
    for (int k = 0; k < points; k++) {
        all[k] = impulse[k];
        for (int j = 0; j < points; j++)
            all[k] -= g->direct[entryOf(k, j)] * rate[j];
        isAnswer &= all[k] >= min;
    }
    if (lanesAreAll(isAnswer)) {
        for (int k = 0; k < points; k++)
            impulse[k] = all[k];
        return;
    }
    for (int k = 0; k < points; k++) {
        swept[k] = impulse[k];
        left[k] = rate[k];
    }
    for (int k = 0; k < points; k++)
        visitPoint(g, points, k, min, swept, left);
    for (int k = points - 1; k >= 0; k--)
        visitPoint(g, points, k, min, swept, left);
    for (int k = 0; k < points; k++)
        visitPoint(g, points, k, min, swept, left);
    for (int k = 0; k < points; k++)
        impulse[k] = lanesSelect(isAnswer, all[k], swept[k]);
}

/* ---- friction ---- */

/* Bounds of friction: N s along t1 and t2, N m s about n, and about t1 and t2. */
typedef struct Limits {
    KeaLanes frictionImpulse[2], torsionImpulse, rollingImpulse;
} Limits;

/* The bounds of friction under these normal impulses. */
KEA_INLINE Limits frictionLimits(const KeaGroup *g, int points, const KeaLanes impulse[]) {
    KeaLanes load = lanesOf(0), moment = lanesOf(0);
    Limits limits;
    for (int k = 0; k < points; k++) {
        const KeaLanes pressing = lanesMax(impulse[k], lanesOf(0));
        load += pressing;
        moment += pressing * g->lever[k];
    }
    for (int i = 0; i < 2; i++)
        limits.frictionImpulse[i] = g->bound[i] + g->coefficient[i] * load;
    limits.torsionImpulse = g->torsionBound + g->coefficient[0] * moment + g->spinning * load;
    limits.rollingImpulse = g->rolling * load;
    return limits;
}

/* The factor that brings the vector (a, b) to a length of at most `limit`. */
KEA_INLINE KeaLanes shareWithin(KeaLanes limit, KeaLanes a, KeaLanes b) {
    const KeaLanes size = lanesRoot(a * a + b * b);
    return lanesSelect(size > limit, limit / size, lanesOf(1));
}

/* Clamps friction along t1 and t2 to its cone, or to its two bounds. */
KEA_INLINE void clampFriction(const KeaGroup *g, const Limits *limits, KeaLanes frictionImpulse[2]) {
    const KeaLanes share = shareWithin(limits->frictionImpulse[0], frictionImpulse[0], frictionImpulse[1]);
    for (int i = 0; i < 2; i++)
        frictionImpulse[i] = lanesSelect(g->isCone, share * frictionImpulse[i],
                                         lanesClamp(frictionImpulse[i], limits->frictionImpulse[i]));
}

/* Solves for friction, starting from the guess `frictionImpulse`: the rates along t1 and t2 vanish, or friction is at
 * its limits. */
KEA_INLINE void solveFriction(const KeaGroup *g, const KeaLanes rate[2], const Limits *limits,
                              KeaLanes frictionImpulse[2]) {
    frictionImpulse[0] -= g->frictionMass[0] * rate[0] + g->frictionMass[1] * rate[1];
    frictionImpulse[1] -= g->frictionMass[1] * rate[0] + g->frictionMass[2] * rate[1];
    clampFriction(g, limits, frictionImpulse);
}

/* The sliding rates minus their targets, plus the term of the friction's compliance. */
KEA_INLINE void slidingRates(const KeaGroup *g, const KeaLanes slide[2], const KeaLanes frictionImpulse[2],
                             KeaLanes rate[2]) {
    for (int i = 0; i < 2; i++)
        rate[i] = slide[i] - g->slide[i] + g->slip[i] * frictionImpulse[i];
}

/* ---- a visit ---- */

/* The next three functions solve for normal impulses, friction about n, and friction along t1 and t2. Each starts from
 * impulses extrapolated by beta, returns the change, and updates the rates that the following ones use by the coupling,
 * so that bodies are read and written only once. */

KEA_INLINE void visitNormals(KeaGroup *g, int points, Rates *rates, float beta, KeaLanes *uphill,
                             KeaLanes resultant[3]) {
    KeaLanes rate[KEA_POINTS], guess[KEA_POINTS], next[KEA_POINTS], change[KEA_POINTS];
    const KeaLanes *u = rates->u;
    for (int k = 0; k < points; k++) {
        guess[k] = next[k] = g->impulse[k] + beta * (g->impulse[k] - g->before[k]);
        rate[k] = pointRate(g, k, u) - g->bias[k] + g->compliance * guess[k];
    }
    solvePoints(g, points, rate, g->min, next);
    for (int k = 0; k < points; k++) {
        next[k] = lanesSelect(g->isPoint[k], next[k], lanesOf(0));
        change[k] = next[k] - guess[k];
        *uphill -= change[k] * (next[k] - g->impulse[k]);
        g->before[k] = g->impulse[k];
        g->impulse[k] = next[k];
    }
    resultantOf(g, points, change, resultant);
    for (int j = 0; j < 3; j++) {
        rates->slide[0] += g->toSlide[0][j] * resultant[j];
        rates->slide[1] += g->toSlide[1][j] * resultant[j];
        rates->spin += g->toSpin[j] * resultant[j];
    }
}

KEA_INLINE KeaLanes visitTorsion(KeaGroup *g, Rates *rates, const Limits *limits, float beta) {
    const KeaLanes guess = g->torsionImpulse + beta * (g->torsionImpulse - g->torsionImpulseBefore);
    const KeaLanes next = lanesClamp(guess - g->torsionMass * rates->spin, limits->torsionImpulse),
                   change = next - guess;
    g->torsionImpulseBefore = g->torsionImpulse;
    g->torsionImpulse = next;
    for (int i = 0; i < 2; i++)
        rates->slide[i] += g->torsionToSlide[i] * change;
    return change;
}

KEA_INLINE void visitFriction(KeaGroup *g, const Rates *rates, const Limits *limits, float beta, KeaLanes *uphill,
                              KeaLanes change[2]) {
    KeaLanes guess[2], next[2], rate[2];
    for (int i = 0; i < 2; i++)
        guess[i] = next[i] = g->frictionImpulse[i] + beta * (g->frictionImpulse[i] - g->frictionImpulseBefore[i]);
    slidingRates(g, rates->slide, guess, rate);
    solveFriction(g, rate, limits, next);
    for (int i = 0; i < 2; i++) {
        change[i] = next[i] - guess[i];
        *uphill -= change[i] * (next[i] - g->frictionImpulse[i]);
        g->frictionImpulseBefore[i] = g->frictionImpulse[i];
        g->frictionImpulse[i] = next[i];
    }
}

/* If the symmetric matrix T (11 12 22) of two directions has rank 1, sets its pseudo-inverse: both show the same free
 * axis. */
KEA_INLINE void invertLine(const KeaLanes T[3], KeaLanes inverse[3]) {
    const KeaLanes square = (T[0] + T[2]) * (T[0] + T[2]);
    const KeaMask isLine = (T[0] * T[2] - T[1] * T[1] <= (float)kea_lockedDirection * square) & (square > 0);
    for (int i = 0; i < 3; i++)
        inverse[i] = lanesSelect(isLine, T[i] / square, inverse[i]);
}

/* Solves for rolling friction about t1 and t2, starting from the guess `impulse`: the bodies do not rotate relative to
 * each other about them, or it is at its limit. */
KEA_INLINE void solveRolling(const KeaGroup *g, const Pair *p, KeaLanes3 across, const Limits *limits,
                             KeaLanes impulse[2]) {
    const KeaLanes3 w = lanesDifference(p->ang[0], p->ang[1]);
    const KeaLanes rate[2] = {lanesDot(g->along, w), lanesDot(across, w)};
    KeaLanes T[3] = {lanesOf(0), lanesOf(0), lanesOf(0)};
    for (int b = 0; b < 2; b++) {
        const KeaLanes3 turned = lanesApply(g->invInertia[b], across);
        T[0] += lanesDot(g->along, lanesApply(g->invInertia[b], g->along));
        T[1] += lanesDot(g->along, turned);
        T[2] += lanesDot(across, turned);
    }
    const KeaLanes det = T[0] * T[2] - T[1] * T[1], scale = lanesSelect(det > 0, 1 / det, lanesOf(0));
    if (g->locks) {
        KeaLanes inverse[3] = {scale * T[2], -scale * T[1], scale * T[0]};
        invertLine(T, inverse);
        impulse[0] -= inverse[0] * rate[0] + inverse[1] * rate[1];
        impulse[1] -= inverse[1] * rate[0] + inverse[2] * rate[1];
    } else {
        impulse[0] -= scale * (T[2] * rate[0] - T[1] * rate[1]);
        impulse[1] -= scale * (T[0] * rate[1] - T[1] * rate[0]);
    }
    const KeaLanes share = shareWithin(limits->rollingImpulse, impulse[0], impulse[1]);
    impulse[0] *= share;
    impulse[1] *= share;
}

/* Solves for rolling friction and, as both rotate and move a body, for friction along t1 and t2 again. A sweep leaves
 * 5/7 of the error of a ball at rest: three and the passes' extrapolation leave as little as without it. */
KEA_INLINE void visitRolling(KeaGroup *g, Pair *p, KeaLanes3 across, const Limits *limits, float beta) {
    const KeaLanes3 none = {lanesOf(0), lanesOf(0), lanesOf(0)};
    KeaLanes old[2], next[2];
    for (int i = 0; i < 2; i++) {
        old[i] = next[i] = g->rollingImpulse[i] + beta * (g->rollingImpulse[i] - g->rollingImpulseBefore[i]);
        g->rollingImpulseBefore[i] = g->rollingImpulse[i];
    }
    for (int sweep = 0; sweep < 3; sweep++) {
        solveRolling(g, p, across, limits, next);
        applyImpulse(g, p, none, inTangentPlane(g, across, next[0] - old[0], next[1] - old[1]));
        const KeaLanes3 v = rateAtCentre(g, p);
        const KeaLanes slide[2] = {lanesDot(g->along, v), lanesDot(across, v)};
        KeaLanes rate[2], friction[2] = {g->frictionImpulse[0], g->frictionImpulse[1]};
        slidingRates(g, slide, friction, rate);
        solveFriction(g, rate, limits, friction);
        applyImpulse(
            g, p, inTangentPlane(g, across, friction[0] - g->frictionImpulse[0], friction[1] - g->frictionImpulse[1]),
            none);
        for (int i = 0; i < 2; i++) {
            g->frictionImpulse[i] = friction[i];
            old[i] = next[i];
        }
    }
    for (int i = 0; i < 2; i++)
        g->rollingImpulse[i] = next[i];
}

/* Solves the manifolds of a group once. A manifold of one point has no friction about the normal but spinning friction,
 * since the point is its centre. */
KEA_INLINE void visitGroup(KeaGroup *g, int points, KeaMotion motion[], float beta, KeaLanes *uphill) {
    const KeaLanes3 across = lanesCross(g->normal, g->along);
    Pair p = gatherPair(g, motion);
    Rates rates = ratesOf(g, &p, across);
    KeaLanes normal[3], frictionImpulse[2], torsionImpulse = lanesOf(0);
    visitNormals(g, points, &rates, beta, uphill, normal);
    const Limits limits = frictionLimits(g, points, g->impulse);
    if (points > 1 || g->resistsRotation)
        torsionImpulse = visitTorsion(g, &rates, &limits, beta);
    visitFriction(g, &rates, &limits, beta, uphill, frictionImpulse);
    applyAll(g, &p, across, normal, frictionImpulse, torsionImpulse);
    if (g->resistsRotation)
        visitRolling(g, &p, across, &limits, beta);
    scatterPair(g, &p, motion);
}

static void pass(KeaGroup groups[], int count, KeaMotion motion[], float beta, float uphill[KEA_LANES]) {
    KeaLanes sum;
    memcpy(&sum, uphill, sizeof sum);
    for (int i = 0; i < count; i++)
        switch (groups[i].points) {
        case 1:
            visitGroup(&groups[i], 1, motion, beta, &sum);
            break;
        case 2:
            visitGroup(&groups[i], 2, motion, beta, &sum);
            break;
        default:
            visitGroup(&groups[i], KEA_POINTS, motion, beta, &sum);
        }
    memcpy(uphill, &sum, sizeof sum);
}

/* ---- before passes ---- */

/* 1/kg: the mobility of a body's centre of mass along a unit vector. */
KEA_INLINE KeaLanes translationAlong(const KeaGroup *g, int b, KeaLanes3 d) {
    return g->locks ? g->invMass[b] * lanesDot(d, freeAxes(g, b, d)) : g->invMass[b];
}

/* The matrix K by which impulses along u change u, 1/kg: 00 01 02 11 12 22. */
KEA_INLINE void findMobility(const KeaGroup *g, KeaLanes3 across, KeaLanes K[6]) {
    for (int i = 0; i < 6; i++)
        K[i] = lanesOf(0);
    for (int b = 0; b < 2; b++) {
        const KeaLanes3 lever = lanesCross(g->arm[b], g->normal);
        const KeaLanes3 turned = lanesApply(g->invInertia[b], lever), atAcross = lanesApply(g->invInertia[b], across),
                        atAlong = lanesApply(g->invInertia[b], g->along);
        K[0] += translationAlong(g, b, g->normal) + lanesDot(lever, turned);
        K[1] -= lanesDot(lever, atAcross);
        K[2] += lanesDot(lever, atAlong);
        K[3] += lanesDot(across, atAcross);
        K[4] -= lanesDot(across, atAlong);
        K[5] += lanesDot(g->along, atAlong);
    }
}

/* Sets A + E of the points, with A = J M⁻¹ Jᵀ, and the inverses of its diagonal entries. */
KEA_INLINE void setCoupling(KeaGroup *g, KeaLanes3 across) {
    KeaLanes K[6];
    findMobility(g, across, K);
    for (int k = 0; k < KEA_POINTS; k++)
        for (int j = k; j < KEA_POINTS; j++) {
            const KeaLanes own = k == j ? g->compliance : lanesOf(0);
            g->coupling[entryOf(k, j)] = own + K[0] + (g->x[k] + g->x[j]) * K[1] + (g->y[k] + g->y[j]) * K[2] +
                                         g->x[k] * g->x[j] * K[3] + (g->x[k] * g->y[j] + g->x[j] * g->y[k]) * K[4] +
                                         g->y[k] * g->y[j] * K[5];
        }
    for (int k = 0; k < KEA_POINTS; k++) {
        const KeaLanes own = g->coupling[entryOf(k, k)];
        g->response[k] = lanesSelect(g->isPoint[k] & (own > 0), 1 / own, lanesOf(0));
    }
}

/* Twice the signed area of the triangle of three points. */
KEA_INLINE KeaLanes areaOf(const KeaGroup *g, int a, int b, int c) {
    return (g->x[b] - g->x[a]) * (g->y[c] - g->y[a]) - (g->x[c] - g->x[a]) * (g->y[b] - g->y[a]);
}
/* The null vector of A for four points, of unit length: the areas of the triangles that omit one point, with
 * alternating signs. 0 for fewer points, which are treated as independent, and for contacts with compliance. */
KEA_INLINE void findNullVector(const KeaGroup *g, KeaLanes null[KEA_POINTS]) {
    const KeaMask isFull = g->isPoint[3] & ~(g->compliance > 0);
    null[0] = areaOf(g, 1, 2, 3);
    null[1] = -areaOf(g, 0, 2, 3);
    null[2] = areaOf(g, 0, 1, 3);
    null[3] = -areaOf(g, 0, 1, 2);
    const KeaLanes size = lanesRoot(null[0] * null[0] + null[1] * null[1] + null[2] * null[2] + null[3] * null[3]);
    const KeaMask isThere = isFull & (size > 0);
    for (int k = 0; k < KEA_POINTS; k++)
        null[k] = lanesSelect(isThere, null[k] / size, lanesOf(0));
}

/* A symmetric 2 by 2 block, for inversion of a symmetric matrix by such blocks; isSound becomes false in lanes in which
 * the matrix is too close to singular for single precision. */
typedef struct Block {
    KeaLanes a, b, d; /* a b, b d */
} Block;

KEA_INLINE Block inverseOf(Block m, KeaMask *isSound) {
    const KeaLanes det = m.a * m.d - m.b * m.b;
    *isSound &= det > kea_soundDeterminant * m.a * m.d;
    const KeaLanes scale = lanesSelect(*isSound, 1 / det, lanesOf(0));
    return (Block){scale * m.d, -scale * m.b, scale * m.a};
}

KEA_INLINE void invertBlocks(KeaLanes M[10], KeaMask *isSound) {
    const Block P = inverseOf((Block){M[0], M[1], M[4]}, isSound);
    const KeaLanes q[4] = {M[2], M[3], M[5], M[6]};
    const KeaLanes w[4] = {P.a * q[0] + P.b * q[2], P.a * q[1] + P.b * q[3], P.b * q[0] + P.d * q[2],
                           P.b * q[1] + P.d * q[3]};
    const Block schur = {M[7] - (q[0] * w[0] + q[2] * w[2]), M[8] - (q[0] * w[1] + q[2] * w[3]),
                         M[9] - (q[1] * w[1] + q[3] * w[3])};
    *isSound &= (schur.a > kea_soundDeterminant * M[7]) & (schur.d > kea_soundDeterminant * M[9]);
    const Block S = inverseOf(schur, isSound);
    const KeaLanes v[4] = {w[0] * S.a + w[1] * S.b, w[0] * S.b + w[1] * S.d, w[2] * S.a + w[3] * S.b,
                           w[2] * S.b + w[3] * S.d};
    M[0] = P.a + v[0] * w[0] + v[1] * w[1];
    M[1] = P.b + v[0] * w[2] + v[1] * w[3];
    M[4] = P.d + v[2] * w[2] + v[3] * w[3];
    M[2] = -v[0], M[3] = -v[1], M[5] = -v[2], M[6] = -v[3];
    M[7] = S.a, M[8] = S.b, M[9] = S.d;
}

/* Sets `direct`, the inverse of A + E; missing points get a diagonal entry of the others' size. For four rigid points A
 * has rank 3, and its pseudo-inverse is (A + s q qᵀ)⁻¹ - q qᵀ / s, with the null vector q and any s. The pseudo-inverse
 * would ignore that four targets may contradict each other: if they do by more than the slop, it is not used. */
KEA_INLINE void setInverse(KeaGroup *g, float stepsize) {
    const KeaLanes scale = g->coupling[0];
    KeaLanes null[KEA_POINTS], misfit = lanesOf(0), slop = lanesOf(0);
    findNullVector(g, null);
    for (int k = 0; k < KEA_POINTS; k++)
        for (int j = k; j < KEA_POINTS; j++) {
            const KeaLanes both = g->coupling[entryOf(k, j)] + scale * null[k] * null[j];
            g->direct[entryOf(k, j)] = lanesSelect(g->isPoint[k] & g->isPoint[j], both, k == j ? scale : lanesOf(0));
        }
    g->isDirect = (KeaMask){-1, -1, -1, -1, -1, -1, -1, -1};
    invertBlocks(g->direct, &g->isDirect);
    for (int k = 0; k < KEA_POINTS; k++) {
        misfit += null[k] * g->bias[k];
        slop = lanesMax(slop, g->slop[k]);
        for (int j = k; j < KEA_POINTS; j++)
            g->direct[entryOf(k, j)] = lanesSelect(g->isPoint[k] & g->isPoint[j],
                                                   g->direct[entryOf(k, j)] - null[k] * null[j] / scale, lanesOf(0));
    }
    g->isDirect &= lanesAbs(misfit) * stepsize <= slop;
}

/* Sets the effective masses of friction: along t1 and t2 together, and about n. */
KEA_INLINE void setFrictionMass(KeaGroup *g, KeaLanes3 across) {
    KeaLanes T[3] = {g->slip[0], lanesOf(0), g->slip[1]}, invTorsionMass = lanesOf(0);
    for (int b = 0; b < 2; b++) {
        const KeaLanes3 first = lanesCross(g->arm[b], g->along), second = lanesCross(g->arm[b], across);
        const KeaLanes3 turned = lanesApply(g->invInertia[b], second);
        T[0] += translationAlong(g, b, g->along) + lanesDot(first, lanesApply(g->invInertia[b], first));
        T[1] += lanesDot(first, turned);
        T[2] += translationAlong(g, b, across) + lanesDot(second, turned);
        if (g->locks)
            T[1] += g->invMass[b] * lanesDot(g->along, freeAxes(g, b, across));
        invTorsionMass += lanesDot(g->normal, lanesApply(g->invInertia[b], g->normal));
    }
    T[1] = lanesSelect(g->isOneWay, lanesOf(0), T[1]);
    const KeaLanes det = T[0] * T[2] - T[1] * T[1];
    g->frictionMass[0] = lanesSelect(det > 0, T[2] / det, lanesOf(0));
    g->frictionMass[1] = lanesSelect(det > 0, -T[1] / det, lanesOf(0));
    g->frictionMass[2] = lanesSelect((det > 0) & ~g->isOneWay, T[0] / det, lanesOf(0));
    if (g->locks)
        invertLine(T, g->frictionMass);
    g->torsionMass = lanesSelect(invTorsionMass > 0, 1 / invTorsionMass, lanesOf(0));
}

/* Sets the blocks of J M⁻¹ Jᵀ that couple friction with other impulses: the changes of the velocities along t1, t2 and
 * about n by a unit of the resultant of normal impulses (resultantOf), and of those along t1, t2 by a unit of friction
 * about n. */
KEA_INLINE void setFrictionCoupling(KeaGroup *g, KeaLanes3 across) {
    for (int j = 0; j < 3; j++)
        g->toSlide[0][j] = g->toSlide[1][j] = g->toSpin[j] = lanesOf(0);
    g->torsionToSlide[0] = g->torsionToSlide[1] = lanesOf(0);
    for (int b = 0; b < 2; b++) {
        const KeaLanes3 lever[2] = {lanesCross(g->arm[b], g->along), lanesCross(g->arm[b], across)};
        const KeaLanes3 minus = lanesScale(lanesOf(-1), across);
        const KeaLanes3 by[3] = {lanesApply(g->invInertia[b], lanesCross(g->arm[b], g->normal)),
                                 lanesApply(g->invInertia[b], minus), lanesApply(g->invInertia[b], g->along)};
        const KeaLanes3 byTorsion = lanesApply(g->invInertia[b], g->normal);
        for (int i = 0; i < 2; i++) {
            if (g->locks)
                g->toSlide[i][0] += g->invMass[b] * lanesDot(i == 0 ? g->along : across, freeAxes(g, b, g->normal));
            g->torsionToSlide[i] += lanesDot(lever[i], byTorsion);
            for (int j = 0; j < 3; j++)
                g->toSlide[i][j] += lanesDot(lever[i], by[j]);
        }
        for (int j = 0; j < 3; j++)
            g->toSpin[j] += lanesDot(g->normal, by[j]);
    }
}

static void prepare(KeaGroup groups[], int count, float stepsize) {
    for (int i = 0; i < count; i++) {
        KeaGroup *g = &groups[i];
        const KeaLanes3 across = lanesCross(g->normal, g->along);
        setCoupling(g, across);
        for (int k = 0; k < KEA_POINTS; k++)
            g->before[k] = g->impulse[k];
        setInverse(g, stepsize);
        setFrictionMass(g, across);
        setFrictionCoupling(g, across);
        g->frictionImpulseBefore[0] = g->frictionImpulse[0];
        g->frictionImpulseBefore[1] = g->frictionImpulse[1];
        g->torsionImpulseBefore = g->torsionImpulse;
        g->rollingImpulseBefore[0] = g->rollingImpulse[0];
        g->rollingImpulseBefore[1] = g->rollingImpulse[1];
    }
}

static void apply(const KeaGroup groups[], int count, KeaMotion motion[]) {
    for (int i = 0; i < count; i++) {
        const KeaGroup *g = &groups[i];
        const KeaLanes3 across = lanesCross(g->normal, g->along);
        Pair p = gatherPair(g, motion);
        KeaLanes normal[3];
        resultantOf(g, KEA_POINTS, g->impulse, normal);
        applyAll(g, &p, across, normal, g->frictionImpulse, g->torsionImpulse);
        if (g->resistsRotation)
            applyImpulse(g, &p, lanesScale(lanesOf(0), g->normal),
                         inTangentPlane(g, across, g->rollingImpulse[0], g->rollingImpulse[1]));
        scatterPair(g, &p, motion);
    }
}

static void extrapolate(KeaMotion motion[], KeaMotion before[], int count, float beta) {
    for (int i = 0; i < count; i++) {
        KeaLanes now, was;
        memcpy(&now, &motion[i], sizeof now);
        memcpy(&was, &before[i], sizeof was);
        const KeaLanes next = now + beta * (now - was);
        memcpy(&before[i], &now, sizeof now);
        memcpy(&motion[i], &next, sizeof next);
    }
}

/* ---- positions ---- */

static void advance(KeaGroup groups[], int count, const KeaMotion motion[], float stepsize) {
    for (int i = 0; i < count; i++) {
        KeaGroup *g = &groups[i];
        const Pair p = gatherPair(g, motion);
        const Rates rates = ratesOf(g, &p, lanesCross(g->normal, g->along));
        const KeaLanes *u = rates.u;
        for (int k = 0; k < KEA_POINTS; k++)
            g->gap[k] += stepsize * pointRate(g, k, u);
    }
}

/* Sets the velocities that both bodies are moved by to the end velocities, `motion`. Returns whether any was
 * changed. */
KEA_INLINE MeBool moveByEnd(const KeaGroup *g, int lane, const KeaMotion motion[], KeaMotion move[], float theta[]) {
    MeBool isNew = MEFALSE;
    for (int k = 0; k < 2; k++) {
        const int i = g->body[k][lane];
        if (theta[i] == 1)
            continue;
        move[i] = motion[i];
        theta[i] = 1;
        isNew = METRUE;
    }
    return isNew;
}

static MeBool choosePressed(const KeaGroup groups[], int count, const KeaMotion motion[], float stepsize,
                            KeaMotion move[], float theta[]) {
    MeBool isAny = MEFALSE;
    for (int i = 0; i < count; i++) {
        const KeaGroup *g = &groups[i];
        const KeaLanes3 across = lanesCross(g->normal, g->along);
        const Pair p = gatherPair(g, motion), q = gatherPair(g, move);
        const Rates end = ratesOf(g, &p, across), moved = ratesOf(g, &q, across);
        KeaMask isPressed = {0};
        for (int k = 0; k < KEA_POINTS; k++) {
            const KeaLanes atEnd = g->gap[k] + stepsize * pointRate(g, k, end.u);
            const KeaLanes atMove = g->gap[k] + stepsize * pointRate(g, k, moved.u);
            isPressed |= g->isPoint[k] & (atMove < lanesMin(atEnd, lanesOf(0)) - g->pressed);
        }
        for (int lane = 0; lane < KEA_LANES && !lanesAreAll(~isPressed); lane++)
            if (isPressed[lane])
                isAny |= moveByEnd(g, lane, motion, move, theta);
    }
    return isAny;
}

/* Removes the fraction `correction` of overlaps beyond the slop; gaps may close, but not become overlaps. Returns the
 * lanes whose bodies are moved so far that joints may open. */
KEA_INLINE KeaMask pushGroup(const KeaGroup *g, int points, KeaMotion motion[]) {
    const KeaLanes3 across = lanesCross(g->normal, g->along);
    Pair p = gatherPair(g, motion);
    const Rates rates = ratesOf(g, &p, across);
    const KeaLanes *u = rates.u;
    KeaLanes rate[KEA_POINTS], pseudoImpulse[KEA_POINTS];
    KeaMask isAny = {0};
    for (int k = 0; k < points; k++) {
        const KeaLanes gap = g->gap[k] + pointRate(g, k, u);
        const KeaLanes overlap = lanesMin(gap + g->slop[k], lanesOf(0));
        rate[k] = lanesSelect(gap > 0, gap, g->correction * overlap);
        pseudoImpulse[k] = lanesOf(0);
    }
    solvePoints(g, points, rate, lanesOf(0), pseudoImpulse);
    for (int k = 0; k < points; k++) {
        isAny |= g->isPoint[k] & (rate[k] < -(float)kea_closedJoint * g->size);
        pseudoImpulse[k] = lanesSelect(g->isPoint[k] & (g->correction > 0), pseudoImpulse[k], lanesOf(0));
    }
    applyNormals(g, points, &p, across, pseudoImpulse);
    scatterPair(g, &p, motion);
    return isAny;
}

static MeBool pushManifolds(const KeaGroup groups[], int count, KeaMotion motion[]) {
    KeaMask isAny = {0};
    for (int i = 0; i < count; i++)
        switch (groups[i].points) {
        case 1:
            isAny |= pushGroup(&groups[i], 1, motion);
            break;
        case 2:
            isAny |= pushGroup(&groups[i], 2, motion);
            break;
        default:
            isAny |= pushGroup(&groups[i], KEA_POINTS, motion);
        }
    return !lanesAreAll(~isAny);
}

/* ---- the residual ---- */

/* m/s: the speed at which the overlap of point k grows if it is deep at the end of the step; else 0. */
KEA_INLINE KeaLanes closingOf(const KeaGroup *g, int k, KeaLanes rate, float h) {
    const KeaMask isDeep = h * rate + g->gap[k] < -(float)kea_smallOverlap * g->size;
    return lanesSelect(g->isPoint[k] & isDeep & (rate < 0), -rate, lanesOf(0));
}

/* Adds the residuals `miss` of a row in the lanes that have it to the largest one, and their squares to a sum. */
KEA_INLINE void addResidual(KeaMask isRow, KeaLanes miss, KeaLanes *worst, KeaLanes *squares) {
    const KeaLanes counted = lanesSelect(isRow, miss, lanesOf(0));
    *worst = lanesMax(counted, *worst);
    *squares += counted * counted;
}

/* m/s: the tolerances of the contacts of a group (KeaTolerance). */
KEA_INLINE KeaLanes toleranceOf(const KeaGroup *g, const KeaTolerance *t) {
    KeaLanes change, load = lanesOf(0);
    for (int i = 0; i < KEA_LANES; i++)
        change[i] = fmaxf(t->change[g->body[0][i]], t->change[g->body[1][i]]);
    for (int k = 0; k < KEA_POINTS; k++)
        load += lanesSelect(g->isPoint[k], lanesMax(g->impulse[k], lanesOf(0)), lanesOf(0));
    const KeaLanes light = lanesMax(g->invMass[0], g->invMass[1]), heavy = lanesMin(g->invMass[0], g->invMass[1]);
    const KeaLanes ratio = lanesSelect(heavy > 0, light / heavy, lanesOf(1));
    const KeaLanes carried = light * load / (t->loadSpeed + change);
    const KeaLanes alone = t->accuracy + (float)kea_changeShare * change;
    return lanesMin(alone / lanesMax(lanesMax(carried, ratio), lanesOf(1)),
                    (float)kea_restingDepth / t->stepsize * g->size);
}

/* Adds the residuals of rolling and spinning friction, at the distance of the smaller body's size. */
KEA_INLINE void measureRotation(const KeaGroup *g, const Pair *p, KeaLanes3 across, const Limits *limits,
                                KeaLanes torsionImpulse, KeaLanes *left, KeaLanes *squares) {
    KeaLanes next[2] = {g->rollingImpulse[0], g->rollingImpulse[1]};
    const KeaMask isThere = g->isPoint[0] & (g->torsionMass > 0);
    solveRolling(g, p, across, limits, next);
    addResidual(isThere & (g->spinning > 0), g->size * lanesAbs(torsionImpulse - g->torsionImpulse) / g->torsionMass,
                left, squares);
    for (int i = 0; i < 2; i++)
        addResidual(isThere & (g->rolling > 0), g->size * lanesAbs(next[i] - g->rollingImpulse[i]) / g->torsionMass,
                    left, squares);
}

/* The residual of a row is the change of its projected impulse in one visit, as a velocity. */
static void measure(const KeaGroup groups[], int count, const KeaMotion motion[], const KeaTolerance *tolerance,
                    KeaMeasure *measure) {
    KeaMeasure all = *measure;
    for (int i = 0; i < count; i++) {
        const KeaGroup *g = &groups[i];
        const KeaLanes3 across = lanesCross(g->normal, g->along);
        const Pair p = gatherPair(g, motion);
        const Limits limits = frictionLimits(g, KEA_POINTS, g->impulse);
        const Rates rates = ratesOf(g, &p, across);
        const KeaLanes *u = rates.u;
        KeaLanes rate[2], frictionImpulse[2] = {g->frictionImpulse[0], g->frictionImpulse[1]}, left = lanesOf(0),
                          lever = lanesOf(0);
        for (int k = 0; k < KEA_POINTS; k++) {
            const KeaLanes speed = pointRate(g, k, u);
            const KeaLanes residual = speed - g->bias[k] + g->compliance * g->impulse[k];
            const KeaLanes next = lanesMax(g->impulse[k] - g->response[k] * residual, g->min);
            const KeaLanes miss = lanesAbs(next - g->impulse[k]) / g->response[k];
            addResidual(g->isPoint[k], miss, &left, &all.squares);
            lever = lanesMax(lanesSelect(g->isPoint[k], g->lever[k], lanesOf(0)), lever);
            all.closing = lanesMax(closingOf(g, k, speed, tolerance->stepsize), all.closing);
        }
        slidingRates(g, rates.slide, frictionImpulse, rate);
        solveFriction(g, rate, &limits, frictionImpulse);
        for (int k = 0; k < 2; k++) {
            const KeaLanes miss = lanesAbs(frictionImpulse[k] - g->frictionImpulse[k]) / g->frictionMass[2 * k];
            addResidual(g->isPoint[0] & (g->frictionMass[2 * k] > 0), miss, &left, &all.squares);
        }
        const KeaLanes torsionImpulse =
            lanesClamp(g->torsionImpulse - g->torsionMass * rates.spin, limits.torsionImpulse);
        addResidual(g->isPoint[1] & (g->torsionMass > 0),
                    lever * lanesAbs(torsionImpulse - g->torsionImpulse) / g->torsionMass, &left, &all.squares);
        if (g->resistsRotation)
            measureRotation(g, &p, across, &limits, torsionImpulse, &left, &all.squares);
        all.max = lanesMax(left, all.max);
        const KeaLanes over = left / toleranceOf(g, tolerance);
        all.excess = lanesMax(over, all.excess);
        all.excessSquares += lanesSelect(g->isPoint[0], over * over, lanesOf(0));
    }
    *measure = all;
}

const KeaKernel KEA_KERNEL = {.prepare = prepare,
                              .apply = apply,
                              .extrapolate = extrapolate,
                              .pass = pass,
                              .choosePressed = choosePressed,
                              .advance = advance,
                              .push = pushManifolds,
                              .measure = measure};
