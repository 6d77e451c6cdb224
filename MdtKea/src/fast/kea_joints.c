/* Joints in the fast solver. The bodies that joints connect, in trees or loops, are a block. Each pass solves a block
 * as a whole, by a sparse Cholesky factor of the primal matrix S = M + Jᵀ W J:
 *
 *     S Δv = Jᵀ W r,    Δp = W (r - J Δv),    r = t - J v - E p,    W = 1 / (E + N)
 *
 * with N the proximal parameter, because of which a pass leaves a small part of the residual to the next one. Rows with
 * bounds follow one by one (projected Gauss-Seidel), with the response S⁻¹ Jᵀ of the whole block, so that its joints
 * stay closed. Springs with bounds in both directions, such as position motors, are in the factor, too, as one by one
 * they would not converge along chains: an impulse η that pushes against the row keeps it at its bound (boundSprings).
 *
 * Velocities: J v⁺ = t - E p. The target t of a position row corrects no error; that of a stop lets it close. A spring
 * is implicit, as in the exact solver (setSpringLaw). J is that of the middle of the step, as predicted from the
 * start's velocities v, and bodies move by the mean of v and v⁺: the scheme is of second order. The rates that have to
 * vanish are those at the end, to second order
 *
 *     J_end v⁺ = J v⁺ + (J - J_0) v,    so t is reduced by (J - J_0) v
 *
 * and joints do no work but p·J_0 v / 2, by the error of the rates at the start. If a load turns bodies so fast that
 * the prediction fails, as a ton does links of a kilogram, J = J_0 in the whole block: its bodies move by v⁺, of first
 * order, with the geometric stiffness of its joints' impulses in their inertia.
 *
 * Positions: displacements remove the error that the velocities leave of
 *
 *     φ(x⁺) = φ(x) + h (s - E p)
 *
 * with the same factors: a simplified Newton method, with the Jacobian of the velocities.
 */
#include "inner/kea_doubles_i.h"
#include "fast/kea_joints_i.h"
#include "inner/kea_factor_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

/* ---- rows ---- */

/* Whether a row has no bounds. */
static MeBool isTwoSided(const MdtKeaRow *row) {
    return row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* The section of a block's rows to which a row belongs: 0 without bounds, 1 springs of the factor, 2 others. */
static int sectionOf(const KeaJointBlock *b, const MdtKeaRow *row) {
    const MeBool isWithin = row->force > row->lower && row->force < row->upper; /* in the last step */
    return isTwoSided(row) ? 0 : row->spring && row->lower < 0 && row->upper > 0 && isWithin && !b->isWide ? 1 : 2;
}

/* 1/kg: J M⁻¹ Jᵀ of a row. */
static double invEffectiveMassOf(const MdtKeaSystem *s, const KeaJointRow *r) {
    double invMass = 0, turned[3];
    for (int k = 0; k < 2; k++) {
        if (r->row->body[k] < 0)
            continue;
        const MdtKeaInverseMassMatrix *m = &s->invMass[r->row->body[k]];
        keaApply(turned, (const double(*)[3])m->inertia, r->J[k] + 3);
        invMass += m->mass * keaDot(r->J[k], r->J[k]) + keaDot(r->J[k] + 3, turned);
    }
    return invMass;
}

/* Copies the present Jacobian of the system's row. */
static void copyJointJacobian(const MdtKeaSystem *s, KeaJointRow *r) {
    for (int k = 0; k < 2; k++)
        kea_copyBlock(r->J[k], &r->row->J[k]);
    kea_lockRow(s, r->row->body, r->J);
}

/* m/s: (J - J_0) v, the change of the row's rate at the start's velocities, from the start to the middle. */
static double turnedRateOf(const MdtKeaSystem *s, const KeaJointRow *r) {
    const MdtKeaJBlock *start = s->work->savedJ[r->row - s->rows];
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        const MdtKeaVelocity *v = r->row->body[k] >= 0 ? &s->velocity[r->row->body[k]] : r->row->mover;
        if (!v)
            continue;
        rate += keaDot(r->J[k], v->lin) + keaDot(r->J[k] + 3, v->ang);
        rate -= kea_rateAlong(&start[k], v);
    }
    return rate;
}

/* m/s: the rate of a row at the start's velocities. */
static double startRateOf(const MdtKeaSystem *s, const KeaJointRow *r) {
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        const MdtKeaVelocity *v = r->row->body[k] < 0 ? NULL : &s->velocity[r->row->body[k]];
        rate += v ? keaDot(r->J[k], v->lin) + keaDot(r->J[k] + 3, v->ang) : 0;
    }
    return rate;
}

/* Sets target and compliance of a spring, p = -h [k φ + (θ h k + d) (J u - s)] with u = v⁺ (θ = 1) or, in a block of
 * second order, the mean of v and v⁺ (θ = 1/2). Without stiffness and damping it is inactive. One that only pushes and
 * has a gap carries no force at the start: half of the gap counts then. */
static void setSpringLaw(const MdtKeaSystem *s, MeBool isMean, KeaJointRow *r) {
    const MdtKeaRow *row = r->row;
    const double h = s->parameters.stepsize, theta = isMean ? 0.5 : 1;
    MEASSERT(row->stiffness >= 0 && row->damping >= 0);
    const double perRate = h * (theta * h * row->stiffness + row->damping);
    const double slack = row->lower == 0 ? keaMax(row->error, 0) : 0;
    r->isInactive = !(perRate > 0);
    r->compliance = r->isInactive ? 0 : 1 / (theta * perRate);
    r->target = -r->compliance * h * row->stiffness * (row->error - (1 - theta) * slack) + row->target / theta;
    if (isMean)
        r->target -= startRateOf(s, r);
}

/* Sets the law of a position row. It is rigid, corrected by displacements, unless it is soft or a joint of bounded
 * force; the velocity of a rigid row corrects no error, but lets a stop close. */
static void setPositionLaw(double h, KeaJointRow *r) {
    const MdtKeaRow *row = r->row;
    const MeBool isSoft = row->softness > kea_softShare * r->invEffectiveMass;
    r->isRigid = !isSoft && (isTwoSided(row) || row->lower == 0 || row->upper == 0);
    if (!r->isRigid)
        return;
    r->compliance = 0;
    r->targetError = row->error + h * (row->target + row->carried);
    r->target = isTwoSided(row)   ? row->drift
                : row->lower == 0 ? keaMin(row->target, row->drift)
                                  : keaMax(row->target, row->drift);
}

/* Sets all fields of a row but those of the graph. */
static void setJointRow(const MdtKeaSystem *s, MeBool isMean, KeaJointRow *r) {
    const MdtKeaRow *row = r->row;
    const double h = s->parameters.stepsize;
    copyJointJacobian(s, r);
    r->invEffectiveMass = invEffectiveMassOf(s, r);
    r->length = kea_lengthOf(s, row);
    r->perSize = r->length / kea_smallerExtent(s, row->body);
    r->perSquare = 1 / (r->length * r->length);
    r->isInactive = !(r->invEffectiveMass > 0);
    r->isRigid = MEFALSE;
    r->target = row->target;
    r->compliance = row->softness;
    r->targetError = r->jointError = 0;
    r->invMassInBlock = 0;
    if (row->spring)
        setSpringLaw(s, isMean, r);
    else if (row->position)
        setPositionLaw(h, r);
    if (!row->spring)
        r->target -= turnedRateOf(s, r);
    r->lower = h * row->lower;
    r->upper = h * row->upper;
    r->impulse = r->before = r->isInactive ? 0 : keaMin(keaMax(h * row->force, r->lower), r->upper);
    MEASSERT(!(r->lower > r->upper));
}

/* ---- the block's bodies ---- */

/* addJointForce: x += a Jᵀ; jointRateOf: J x. x is by node. */
static void addJointForce(const KeaJointRow *r, double a, double (*x)[6]) {
    for (int k = 0; k < 2; k++)
        if (r->node[k] >= 0)
            kea_addScaled6(x[r->node[k]], a, r->J[k]);
}
static double jointRateOf(const KeaJointRow *r, double (*const x)[6]) {
    KeaTwo rate = {0, 0};
    for (int k = 0; k < 2; k++)
        for (int i = 0; r->node[k] >= 0 && i < 6; i += 2)
            rate += twoAt(r->J[k] + i) * twoAt(x[r->node[k]] + i);
    return rate[0] + rate[1];
}

/* Copies the motions of the block's bodies to j->v, by node, and returns them. */
static double (*motionsOf(const KeaJoints *j, const KeaJointBlock *b, const KeaMotion motion[]))[6] {
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++) {
        const KeaMotion *m = &motion[j->body[n].motion];
        for (int i = 0; i < 3; i++) {
            j->v[n][i] = (double)m->lin[i];
            j->v[n][3 + i] = (double)m->ang[i];
        }
    }
    return j->v + b->firstNode;
}

/* Adds j->x to the motions of the block's bodies. */
static void moveBlock(const KeaJoints *j, const KeaJointBlock *b, KeaMotion motion[]) {
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++) {
        KeaMotion *m = &motion[j->body[n].motion];
        for (int i = 0; i < 3; i++) {
            m->lin[i] = (float)((double)m->lin[i] + j->x[n][i]);
            m->ang[i] = (float)((double)m->ang[i] + j->x[n][3 + i]);
        }
    }
}

/* The block's part of j->x. */
static double (*unknownsOf(const KeaJoints *j, const KeaJointBlock *b))[6] {
    return j->x + b->firstNode;
}

static void clearUnknowns(const KeaJoints *j, const KeaJointBlock *b) {
    memset(unknownsOf(j, b), 0, (size_t)b->numNodes * sizeof *j->x);
}

/* ---- the matrix ---- */

/* Adds the run of rows without bounds from `first` on that join the same bodies to the matrix. Returns their number. */
static int addUnboundedRows(const KeaJoints *j, const KeaJointBlock *b, int first) {
    const KeaJointRow *start = &j->row[first];
    KeaFactorRows rows = {.node = {start->node[0], start->node[1]}, .edge = start->edge};
    for (int i = first; i < b->firstBounded && rows.count < KEA_FACTOR_ROWS; i++) {
        KeaJointRow *r = &j->row[i];
        if (r->node[0] != start->node[0] || r->node[1] != start->node[1])
            break;
        kea_factorAppendRow(&rows, r->weight, r->J, r->J);
    }
    kea_factorAddRows(b->factor, &rows, METRUE);
    MEASSERT(rows.count > 0);
    return rows.count;
}

/* Assembles and factors S; `soft`: N relative to A_ii. False: the matrix is not positive definite in double
 * precision. */
static MeBool factorizeWith(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b, double soft) {
    kea_factorClearIn(b->factor, b->numbers);
    for (int n = 0; n < b->numNodes; n++) {
        const KeaJointBody *body = &j->body[b->firstNode + n];
        double *block = kea_factorDiagonal(b->factor, n);
        for (int i = 0; i < 3; i++) {
            block[7 * i] = 1 / s->invMass[body->body].mass;
            for (int k = 0; k < 3; k++)
                block[6 * (i + 3) + k + 3] = body->inertia[i][k];
        }
    }
    for (int i = b->firstRow; i < b->firstBounded; i++)
        j->row[i].weight = j->row[i].isInactive ? 0 : 1 / (j->row[i].compliance + soft * j->row[i].invEffectiveMass);
    for (int i = b->firstRow; i < b->firstBounded;)
        i += addUnboundedRows(j, b, i);
    return kea_factorCholesky(b->factor, kea_minPivot);
}

/* Factors a block. If masses differ so much that S is not positive definite in double precision, two larger N are
 * tried, kea_proximalLimit^(1/2) A_ii and A_ii; if even that fails, the block's joints have no force in this step.
 * Blocks of the factor are inverted only if no larger N was needed: products with inverses lose digits that the factors
 * keep. */
static void factorizeBlock(const MdtKeaSystem *s, const KeaJoints *j, KeaJointBlock *b) {
    b->isInverted = b->isSound = factorizeWith(s, j, b, kea_proximalLimit);
    const double softer = sqrt(kea_proximalLimit);
    for (double soft = softer; soft <= 1 && !b->isSound; soft /= softer)
        b->isSound = factorizeWith(s, j, b, soft);
    if (b->isInverted)
        kea_factorInvert(b->factor);
}

/* x := S⁻¹ x */
static void solveWithFactor(const KeaJointBlock *b, double x[]) {
    kea_factorUseNumbers(b->factor, b->numbers);
    (b->isInverted ? kea_factorSolveInverted : kea_factorSolve)(b->factor, x);
}

/* ---- blocks ---- */

/* The first body of a row, or the second one if the first is the world. */
static int anyBodyOf(const MdtKeaRow *row) {
    return row->body[0] >= 0 ? row->body[0] : row->body[1];
}

/* Unites the bodies that rows join (union-find). */
static void uniteJoinedBodies(const MdtKeaSystem *s, int parent[]) {
    for (int i = 0; i < s->numBodies; i++)
        parent[i] = i;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->body[0] >= 0 && row->body[1] >= 0)
            kea_unite(parent, row->body[0], row->body[1]);
    }
}

/* Sorts rows by the root of their block's set of bodies, and creates the blocks: a stable counting sort. */
static void sortRowsByBlock(const MdtKeaSystem *s, KeaJoints *j) {
    int at = 0;
    memset(j->sum, 0, (size_t)s->numBodies * sizeof *j->sum);
    for (int i = 0; i < s->numRows; i++)
        j->sum[kea_rootOf(j->parent, anyBodyOf(&s->rows[i]))]++;
    j->numBlocks = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const int here = j->sum[b];
        j->sum[b] = at;
        if (here > 0)
            j->block[j->numBlocks++] = (KeaJointBlock){.firstRow = at, .endRow = at + here};
        at += here;
    }
    MEASSERT(at == s->numRows);
    for (int i = 0; i < s->numRows; i++)
        j->sorted[j->sum[kea_rootOf(j->parent, anyBodyOf(&s->rows[i]))]++] = &s->rows[i];
}

/* Adds a body to the block, if it is not in it yet. */
static void addJointBody(const MdtKeaSystem *s, const int place[], KeaJoints *j, KeaJointBlock *b, int body) {
    if (body >= 0 && j->node[body] < 0) {
        KeaJointBody *own = &j->body[b->firstNode + b->numNodes];
        j->node[body] = b->numNodes++;
        *own = (KeaJointBody){.body = body, .motion = 1 + place[body]};
        kea_inertia(s->bodies[body], s->bodies[body]->quaternion, own->inertia);
    }
}

/* ---- geometric stiffness ---- */

/* Sums up the geometric stiffness of the last step's impulses on each body. */
static void sumStiffness(const MdtKeaSystem *s, KeaJoints *j, const KeaJointBlock *b) {
    const double h = s->parameters.stepsize;
    for (int i = b->firstRow; i < b->endRow; i++) {
        const MdtKeaRow *row = j->sorted[i];
        for (int k = 0; k < 2; k++) {
            double P[3];
            if (row->body[k] < 0 || !(row->position || row->spring))
                continue;
            keaScale(P, h * row->force, row->J[k].lin);
            KeaJointBody *own = &j->body[b->firstNode + j->node[row->body[k]]];
            kea_addGeometricStiffness(own->stiffness, h, P, row->arm[k]);
            own->load += keaLength(P);
            own->spread += keaLength(P) * keaDot(row->arm[k], row->arm[k]);
        }
    }
    for (int n = b->firstNode; n < b->firstNode + b->numNodes && s->work->hasLocks; n++)
        kea_dropLockedRotations(s->bodies[j->body[n].body]->locked, j->body[n].stiffness);
}

/* Sets inverse inertia and predicted angular velocity of a body to those by the inertia that the passes use. */
static void usePassInertia(MdtKeaSystem *s, const KeaJointBody *b) {
    double(*inverse)[3] = s->invMass[b->body].inertia;
    kea_invert(inverse, (const double(*)[3])b->inertia);
    kea_dropLockedRotations(s->bodies[b->body]->locked, inverse);
    keaApply(s->predicted[b->body].ang, (const double(*)[3])inverse, s->work->body[b->body].freeMomentum);
}

/* Adds the geometric stiffness K to a body's inertia: I w⁺ = L + Jᵀ p - K w⁺, so that impulses act on I + K. */
static void addToInertia(MdtKeaSystem *s, KeaJointBody *body) {
    KeaJointBody b = *body;
    if (kea_largestEntry((const double(*)[3])b.stiffness) <= kea_smallStiffness * kea_minOf(s->bodies[b.body]->moments))
        return;
    b.isStiff = METRUE;
    kea_clampPositive(b.stiffness, 0);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            b.inertia[i][k] += b.stiffness[i][k];
    usePassInertia(s, &b);
    *body = b;
}

/* L := I(q) I'⁻¹ L, with the inertia I' of the passes: L of the angular velocity that they have found. */
static void setMomentumAt(MdtKeaSystem *s, const KeaJointBody *b, const double q[4]) {
    double w[3], inertia[3][3], *L = s->work->end[b->body].angularMomentum;
    keaApply(w, (const double(*)[3])s->invMass[b->body].inertia, L);
    kea_inertia(s->bodies[b->body], q, inertia);
    keaApply(L, (const double(*)[3])inertia, w);
}

void kea_jointsRemoveStiffness(MdtKeaSystem *s, const KeaJoints *j) {
    for (int n = 0; n < j->numNodes; n++)
        if (j->body[n].isStiff)
            setMomentumAt(s, &j->body[n], s->bodies[j->body[n].body]->quaternion);
}

void kea_jointsSetMomenta(MdtKeaSystem *s, const KeaJoints *j) {
    for (int i = 0; i < j->numBlocks; i++)
        for (int n = j->block[i].firstNode; n < j->block[i].firstNode + j->block[i].numNodes; n++) {
            const int body = j->body[n].body;
            if (j->block[i].isMean && (s->bodies[body]->flags & MdtKeaBodyFlagAddCoriolisForce))
                setMomentumAt(s, &j->body[n], s->work->end[body].quaternion);
        }
}

/* ---- the middle of the step ---- */

/* Whether the middle of the step can be predicted from the body's velocity at the start: its joints' loads of the last
 * step do not turn it much within the step. Measure: (h ω)² of the pendulum that the body is under these loads, tr K /
 * 2 over its inertia about the place where they act. */
static MeBool isPredictable(const MdtKeaSystem *s, const KeaJointBody *b) {
    const double *I = s->bodies[b->body]->moments;
    const double about = b->load > 0 ? b->spread / (b->load * s->bodies[b->body]->invMass) : 0;
    const double stiffness = 0.5 * (b->stiffness[0][0] + b->stiffness[1][1] + b->stiffness[2][2]);
    return fabs(stiffness) <= kea_stiffLoad * (0.5 * (I[0] + I[1] + I[2]) + about);
}

/* Whether all bodies of the block are predictable, and no spring is too stiff for the midpoint rule. */
static MeBool isBlockPredictable(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b) {
    for (int i = b->firstRow; i < b->endRow; i++)
        if (kea_isBackward(s, j->sorted[i]))
            return MEFALSE;
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++)
        if (!isPredictable(s, &j->body[n]))
            return MEFALSE;
    return METRUE;
}

/* Sets the mean pose of a body, as its velocity at the start moves it along the chord, and for the passes its inertia
 * at the predicted end, where momenta are balanced. A body without Coriolis term keeps the inertia of the start. */
static void predictBody(MdtKeaSystem *s, KeaJointBody *b) {
    const MdtKeaBody *body = s->bodies[b->body];
    const MdtKeaVelocity *v = &s->velocity[b->body];
    const double h = s->parameters.stepsize;
    double turn[4] = {1};
    KeaEnd *end = &s->work->end[b->body];
    keaCopy(end->position, body->position);
    keaAddScaled(end->position, h, v->lin);
    keaScale(turn + 1, 0.5 * h, v->ang);
    keaQuaternionProduct(end->quaternion, turn, body->quaternion);
    keaQuaternionNormalize(end->quaternion);
    kea_setPoses(s, b->body);
    if (!(body->flags & MdtKeaBodyFlagAddCoriolisForce))
        return;
    kea_inertia(body, end->quaternion, b->inertia);
    usePassInertia(s, b);
}

/* Sets the mean pose of a body to that of the start, for a block of first order, whose rows stay those of the start,
 * and adds geometric stiffness to its inertia. */
static void useStartPose(MdtKeaSystem *s, KeaJointBody *b) {
    s->work->meanPose[b->body] = s->pose[b->body];
    addToInertia(s, b);
}

/* Saves the Jacobians of the start (work->savedJ), and evaluates the rows at the mean poses. */
static void evaluateMiddleRows(MdtKeaSystem *s, const KeaJoints *j) {
    MeBool isAny = MEFALSE;
    kea_saveJacobians(s);
    for (int i = 0; i < j->numBlocks; i++)
        isAny |= j->block[i].isMean;
    if (isAny)
        kea_evaluateJacobians(s, s->work->meanPose, 0.5);
}

/* ---- setting blocks up ---- */

/* Adds the bodies of the block's rows to it, and chooses whether it is solved at the middle of the step. */
static void setBlockBodies(MdtKeaSystem *s, const int place[], KeaJoints *j, KeaJointBlock *b) {
    for (int i = b->firstRow; i < b->endRow; i++)
        for (int k = 0; k < 2; k++)
            addJointBody(s, place, j, b, j->sorted[i]->body[k]);
    sumStiffness(s, j, b);
    b->isMean = isBlockPredictable(s, j, b);
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++) {
        if (b->isMean)
            predictBody(s, &j->body[n]);
        else
            useStartPose(s, &j->body[n]);
    }
}

/* Sets the block's rows, section by section, and its graph. */
static void setBlockRows(const MdtKeaSystem *s, KeaJoints *j, KeaJointBlock *b) {
    int at = b->firstRow;
    kea_graphBegin(&j->graph, b->endRow - b->firstRow);
    for (int section = 0; section < 3; section++) {
        b->firstSpring = section == 1 ? at : b->firstSpring;
        b->firstBounded = section == 2 ? at : b->firstBounded;
        for (int i = b->firstRow; i < b->endRow; i++) {
            const MdtKeaRow *row = j->sorted[i];
            if (sectionOf(b, row) != section)
                continue;
            KeaJointRow *r = &j->row[at++];
            r->row = row;
            for (int k = 0; k < 2; k++)
                r->node[k] = row->body[k] >= 0 ? j->node[row->body[k]] : -1;
            r->edge = r->node[0] >= 0 && r->node[1] >= 0 ? kea_graphEdge(&j->graph, r->node[0], r->node[1]) : -1;
            setJointRow(s, b->isMean, r);
        }
    }
    MEASSERT(at == b->endRow);
}

/* Whether the factors of all blocks are still in the cache: blocks with equal graphs share one, and there are no more
 * graphs than a cache keeps. */
static MeBool areFactorsKept(const KeaJoints *j) {
    const KeaFactor *kept[KEA_MAX_FACTORS];
    int count = 0;
    for (int i = 0; i < j->numBlocks; i++) {
        int k = 0;
        while (k < count && kept[k] != j->block[i].factor)
            k++;
        if (k == KEA_MAX_FACTORS)
            return MEFALSE;
        kept[k] = j->block[i].factor;
        count = k == count ? count + 1 : count;
    }
    return METRUE;
}

/* Sets up all blocks: bodies, rows and the structures of their factors. False: no memory for a factor. */
static MeBool setBlocks(MdtKeaSystem *s, const int place[], KeaJoints *j) {
    sortRowsByBlock(s, j);
    memset(j->node, 0xff, (size_t)s->numBodies * sizeof *j->node);
    j->numNodes = 0;
    j->numRows = s->numRows;
    for (int i = 0; i < j->numBlocks; i++) {
        j->block[i].firstNode = j->numNodes;
        setBlockBodies(s, place, j, &j->block[i]);
        j->numNodes += j->block[i].numNodes;
    }
    evaluateMiddleRows(s, j);
    for (int i = 0; i < j->numBlocks; i++) {
        j->block[i].isWide = j->block[i].numNodes > KEA_WIDE_BLOCK;
        setBlockRows(s, j, &j->block[i]);
        j->block[i].factor =
            kea_cacheFind(s->cache, j->block[i].numNodes, NULL, j->graph.numEdges, (const int(*)[2])j->graph.edges);
        if (!j->block[i].factor)
            return MEFALSE;
    }
    MEASSERT(j->numNodes <= s->numBodies);
    return METRUE;
}

/* Allocates the numbers of all factors, and the responses of rows with bounds. False: no memory. */
static MeBool allocateArrays(const MdtKeaSystem *s, KeaJoints *j) {
    for (char *memory = NULL;;) {
        KeaArena arena = {memory, 0};
        for (int i = 0; i < j->numBlocks; i++) {
            KeaJointBlock *b = &j->block[i];
            KEA_CARVE(&arena, b->numbers, kea_factorNumbersSize(b->factor));
            for (int k = b->firstSpring; k < b->endRow; k++)
                j->row[k].response = kea_carve(&arena, b->isWide ? 2 : (size_t)b->numNodes, 6 * sizeof(double));
        }
        if (memory)
            return METRUE;
        memory = kea_cacheScratch(s->cache, KEA_JOINT_FACTOR_BLOCK, arena.used);
        if (!memory)
            return MEFALSE;
    }
}

size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory) {
    KeaArena arena = {memory, 0};
    const size_t n = (size_t)s->numBodies, m = (size_t)s->numRows;
    KEA_CARVE(&arena, j->block, n);
    KEA_CARVE(&arena, j->body, n);
    KEA_CARVE(&arena, j->row, m);
    KEA_CARVE(&arena, j->x, n);
    KEA_CARVE(&arena, j->v, n);
    KEA_CARVE(&arena, j->errors, m);
    KEA_CARVE(&arena, j->parent, n);
    KEA_CARVE(&arena, j->node, n);
    KEA_CARVE(&arena, j->sum, n);
    KEA_CARVE(&arena, j->sorted, m);
    kea_graphLayOut(&j->graph, m, &arena);
    return arena.used;
}

/* Restores inertia and rows of the start. */
static void resetToStart(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        kea_beginBody(s, i);
    kea_evaluateJacobians(s, s->pose, 0);
}

MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j) {
    j->numBlocks = j->numNodes = j->numRows = 0;
    if (s->numRows == 0)
        return METRUE;
    char *memory = kea_cacheScratch(s->cache, KEA_JOINT_BLOCK, kea_jointsLayOut(s, j, NULL));
    if (!memory)
        return MEFALSE;
    kea_jointsLayOut(s, j, memory);
    uniteJoinedBodies(s, j->parent);
    if (!setBlocks(s, place, j))
        return MEFALSE;
    if (!areFactorsKept(j)) {
        memset(j->parent, 0, (size_t)s->numBodies * sizeof *j->parent); /* all bodies in one block */
        resetToStart(s);
        if (!setBlocks(s, place, j))
            return MEFALSE;
    }
    if (!allocateArrays(s, j))
        return MEFALSE;
    for (int i = 0; i < j->numBlocks; i++)
        factorizeBlock(s, j, &j->block[i]);
    return METRUE;
}

MeBool kea_jointsAreSound(const KeaJoints *j) {
    for (int i = 0; i < j->numBlocks; i++)
        if (!j->block[i].isSound)
            return MEFALSE;
    return METRUE;
}

/* N s: a row's impulse within its bounds, which one of the factor may leave in a pass. */
static double boundedImpulse(const KeaJointRow *r) {
    return keaMin(keaMax(r->impulse, r->lower), r->upper);
}

/* Sets j->x to Jᵀ p of all impulses, by node, N s and N m s. */
static void sumImpulses(const KeaJoints *j) {
    for (int i = 0; i < j->numBlocks; i++) {
        const KeaJointBlock *b = &j->block[i];
        clearUnknowns(j, b);
        for (int k = b->firstRow; k < b->endRow; k++)
            addJointForce(&j->row[k], boundedImpulse(&j->row[k]), unknownsOf(j, b));
    }
}

void kea_jointsApplyImpulses(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[]) {
    sumImpulses(j);
    for (int n = 0; n < j->numNodes; n++) {
        const MdtKeaInverseMassMatrix *m = &s->invMass[j->body[n].body];
        double turned[3];
        keaApply(turned, (const double(*)[3])m->inertia, j->x[n] + 3);
        keaScale(j->x[n], m->mass, j->x[n]);
        keaCopy(j->x[n] + 3, turned);
    }
    for (int i = 0; i < j->numBlocks; i++)
        moveBlock(j, &j->block[i], motion);
}

double kea_jointsWorkOfPass(const KeaJoints *j) {
    double work = (double)j->numRows * KEA_VISIT;
    for (int i = 0; i < j->numBlocks; i++)
        work += 2 * (double)kea_factorEntries(j->block[i].factor);
    return work;
}

double kea_jointsWorkOfFactors(const KeaJoints *j) {
    double work = (double)j->numRows * KEA_ASSEMBLY;
    for (int i = 0; i < j->numBlocks; i++)
        work += kea_factorFlops(j->block[i].factor);
    return work;
}

void kea_jointsScaleImpulses(KeaJoints *j, double share) {
    for (int k = 0; k < j->numRows; k++)
        j->row[k].impulse = j->row[k].before = share * j->row[k].impulse;
}

/* ---- solves by the factor ---- */

/* Solves S x = Jᵀ W r for the rows without bounds. */
static void solveUnboundedRows(const KeaJoints *j, const KeaJointBlock *b) {
    clearUnknowns(j, b);
    for (int i = b->firstRow; i < b->firstBounded; i++)
        addJointForce(&j->row[i], j->row[i].weight * j->row[i].residual, unknownsOf(j, b));
    solveWithFactor(b, unknownsOf(j, b)[0]);
}

/* Computes the response of a row with bounds: the velocities of the block (in a wide one, of the row's own bodies) per
 * unit of its impulse, and the row's rate with these velocities. */
static void computeResponse(const MdtKeaSystem *s, const KeaJointBlock *b, KeaJointRow *r) {
    double(*response)[6] = (double(*)[6])(void *)r->response;
    if (b->isWide) {
        r->invMassInBlock = r->invEffectiveMass;
        for (int k = 0; k < 2; k++) {
            if (r->node[k] < 0)
                continue;
            const MdtKeaInverseMassMatrix *m = &s->invMass[r->row->body[k]];
            keaScale(response[k], m->mass, r->J[k]);
            keaApply(response[k] + 3, (const double(*)[3])m->inertia, r->J[k] + 3);
        }
        return;
    }
    memset(response, 0, (size_t)b->numNodes * sizeof *response);
    addJointForce(r, 1, response);
    solveWithFactor(b, response[0]);
    r->invMassInBlock = jointRateOf(r, response);
}

/* Adds the response to an impulse of a row with bounds to the block's unknowns. */
static void addJointResponse(const KeaJoints *j, const KeaJointBlock *b, const KeaJointRow *r, double impulse) {
    double(*x)[6] = unknownsOf(j, b);
    if (b->isWide) {
        for (int k = 0; k < 2; k++)
            if (r->node[k] >= 0)
                kea_addScaled6(x[r->node[k]], impulse, r->response + 6 * k);
        return;
    }
    for (int n = 0; n < b->numNodes; n++)
        kea_addScaled6(x[n], impulse, r->response + 6 * n);
}

/* ---- velocities ---- */

/* N s: a row's impulse, extrapolated by beta times its last change. */
static double extrapolatedImpulse(const KeaJointRow *r, double beta) {
    return r->impulse + beta * (r->impulse - r->before);
}

/* Sets the impulse of a row from `guess` to `next`. Returns its part of the criterion of restarts (KeaKernel.pass), in
 * which impulses of angular rows are divided by the bodies' size. */
static double setJointImpulse(KeaJointRow *r, double guess, double next) {
    const double uphill = -(next - guess) * (next - r->impulse) * r->perSquare;
    r->before = r->impulse;
    r->impulse = next;
    return uphill;
}

/* Sets the velocity residuals of the block's rows at extrapolated impulses. */
static void setResiduals(const KeaJoints *j, const KeaJointBlock *b, const KeaMotion motion[], double beta) {
    double(*const v)[6] = motionsOf(j, b, motion);
    for (int i = b->firstRow; i < b->endRow; i++) {
        KeaJointRow *r = &j->row[i];
        r->residual = r->target - jointRateOf(r, v) - r->compliance * extrapolatedImpulse(r, beta);
    }
}

/* Solves one row with bounds. A row that stays at its bound needs no response. */
static double solveBoundedRow(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b, KeaJointRow *r,
                              double beta) {
    if (r->isInactive)
        return 0;
    const double guess = extrapolatedImpulse(r, beta), residual = r->residual - jointRateOf(r, unknownsOf(j, b));
    if ((guess == r->lower && residual <= 0) || (guess == r->upper && residual >= 0))
        return setJointImpulse(r, guess, guess);
    if (r->invMassInBlock == 0)
        computeResponse(s, b, r);
    const double next = keaMin(keaMax(guess + residual / (r->invMassInBlock + r->compliance), r->lower), r->upper);
    addJointResponse(j, b, r, next - guess);
    return setJointImpulse(r, guess, next);
}

static double solveBoundedRows(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b, double beta) {
    double uphill = 0;
    for (int i = b->firstBounded; i < b->endRow; i++)
        uphill += solveBoundedRow(s, j, b, &j->row[i], beta);
    return uphill;
}

/* N s: the impulse of a row of the factor after its solve, within or beyond its bounds. */
static double solvedImpulse(const KeaJoints *j, const KeaJointBlock *b, const KeaJointRow *r, double guess) {
    return guess + r->weight * (r->residual - jointRateOf(r, unknownsOf(j, b)));
}

/* Takes springs whose impulses the factor's solve has left beyond their bounds out of the factor, for the rest of the
 * step: they follow one by one. Returns whether there were any. */
static MeBool releaseSprings(const MdtKeaSystem *s, const KeaJoints *j, KeaJointBlock *b, double beta) {
    const int before = b->firstBounded;
    for (int i = b->firstSpring; i < b->firstBounded;) {
        KeaJointRow *r = &j->row[i];
        const double solved = solvedImpulse(j, b, r, extrapolatedImpulse(r, beta));
        if (r->isInactive || (solved >= r->lower && solved <= r->upper)) {
            i++;
            continue;
        }
        const KeaJointRow last = j->row[--b->firstBounded];
        j->row[b->firstBounded] = *r;
        *r = last;
    }
    if (b->firstBounded == before)
        return MEFALSE;
    for (int i = b->firstSpring; i < b->endRow; i++)
        j->row[i].invMassInBlock = 0;
    factorizeBlock(s, j, b);
    return METRUE;
}

/* One pass over a block. In a wide block rows with bounds are solved first, since they open its joints. */
static double solveBlock(const MdtKeaSystem *s, const KeaJoints *j, KeaJointBlock *b, KeaMotion motion[], double beta) {
    double uphill = 0;
    if (!b->isSound)
        return 0;
    setResiduals(j, b, motion, beta);
    if (b->isWide) {
        clearUnknowns(j, b);
        uphill += solveBoundedRows(s, j, b, beta);
        moveBlock(j, b, motion);
        setResiduals(j, b, motion, beta);
    }
    solveUnboundedRows(j, b);
    while (releaseSprings(s, j, b, beta) && b->isSound)
        solveUnboundedRows(j, b);
    if (!b->isWide)
        uphill += solveBoundedRows(s, j, b, beta);
    for (int i = b->firstRow; i < b->firstBounded; i++) {
        KeaJointRow *r = &j->row[i];
        const double guess = extrapolatedImpulse(r, beta);
        uphill += setJointImpulse(r, guess, solvedImpulse(j, b, r, guess));
    }
    moveBlock(j, b, motion);
    return uphill;
}

double kea_jointsSolveVelocities(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta) {
    double uphill = 0;
    for (int i = 0; i < j->numBlocks; i++)
        uphill += solveBlock(s, j, &j->block[i], motion, beta);
    return uphill;
}

/* m/s: the residual of a row: the change of its impulse if it were solved alone, as a velocity. */
static double residualOf(const KeaJointRow *r, double rate) {
    const double residual = r->target - rate - r->compliance * r->impulse,
                 invEffectiveMass = r->invEffectiveMass + r->compliance;
    const double next = keaMin(keaMax(r->impulse + residual / invEffectiveMass, r->lower), r->upper);
    return fabs(next - r->impulse) * invEffectiveMass * r->length;
}

/* m/s: the residual that a row may have: the tolerance of a contact (KeaTolerance) without the terms of load and mass
 * ratio. */
static double toleranceOf(const KeaJoints *j, const KeaJointBlock *b, const KeaJointRow *r, const KeaTolerance *t) {
    double change = 0;
    for (int k = 0; k < 2; k++)
        if (r->node[k] >= 0)
            change = keaMax(change, (double)t->change[j->body[b->firstNode + r->node[k]].motion]);
    return (double)t->accuracy + kea_changeShare * change;
}

double kea_jointsResidual(const KeaJoints *j, const KeaMotion motion[], const KeaTolerance *t, double *excess) {
    double max = 0;
    for (int i = 0; i < j->numBlocks; i++) {
        const KeaJointBlock *b = &j->block[i];
        double(*const v)[6] = motionsOf(j, b, motion);
        for (int k = b->firstRow; k < b->endRow; k++) {
            if (j->row[k].isInactive)
                continue;
            const double residual = residualOf(&j->row[k], jointRateOf(&j->row[k], v));
            max = keaMax(max, residual);
            *excess = keaMax(*excess, residual / toleranceOf(j, b, &j->row[k], t));
        }
    }
    return max;
}

/* ---- positions ---- */

/* An error relative to the smaller body's size. */
static double openingOf(const KeaJointRow *r, double error) {
    return fabs(error) * r->perSize;
}

/* The part of an error that violates the row: a stop is violated on one side only. */
static double violationOf(const KeaJointRow *r, double error) {
    return isTwoSided(r->row) ? error : r->lower == 0 ? keaMin(error, 0) : keaMax(error, 0);
}

double kea_jointsOpening(const KeaJoints *j) {
    double max = 0;
    for (int k = 0; k < j->numRows; k++)
        if (j->row[k].isRigid)
            max = keaMax(max, openingOf(&j->row[k], violationOf(&j->row[k], j->row[k].row->error)));
    return max;
}

void kea_jointsMoveByEnd(const KeaJoints *j, const KeaMotion motion[], KeaMotion move[], float theta[]) {
    for (int i = 0; i < j->numBlocks; i++) {
        const KeaJointBlock *b = &j->block[i];
        for (int n = b->firstNode; n < b->firstNode + b->numNodes && !b->isMean; n++) {
            move[j->body[n].motion] = motion[j->body[n].motion];
            theta[j->body[n].motion] = 1;
        }
    }
}

double kea_jointsFindErrors(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]) {
    const double h = s->parameters.stepsize;
    double max = 0, all = 0;
    if (!s->errors)
        return 0;
    kea_evaluateErrors(s, j->errors);
    for (int i = 0; i < j->numBlocks; i++) {
        const KeaJointBlock *b = &j->block[i];
        double(*const v)[6] = motionsOf(j, b, displacement);
        for (int k = b->firstRow; k < b->endRow; k++) {
            KeaJointRow *r = &j->row[k];
            if (!r->isRigid)
                continue;
            const double error = j->errors[r->row - s->rows] - (r->targetError - h * r->row->softness * r->impulse);
            r->jointError = error - jointRateOf(r, v);
            max = keaMax(max, openingOf(r, violationOf(r, error)));
            all = keaMax(all, openingOf(r, violationOf(r, j->errors[r->row - s->rows])));
        }
    }
    s->report.opening = all;
    return max;
}

void kea_jointsRelinearize(MdtKeaSystem *s, KeaJoints *j, const KeaMotion displacement[]) {
    if (!s->jacobians)
        return;
    kea_evaluateJacobians(s, s->work->endPose, 1);
    for (int i = 0; i < j->numBlocks; i++) {
        double(*const v)[6] = motionsOf(j, &j->block[i], displacement);
        for (int k = j->block[i].firstRow; k < j->block[i].endRow; k++) {
            KeaJointRow *r = &j->row[k];
            const double before = jointRateOf(r, v);
            copyJointJacobian(s, r);
            r->jointError += before - jointRateOf(r, v);
        }
    }
    kea_jointsRefactor(s, j);
}

void kea_jointsRefactor(const MdtKeaSystem *s, KeaJoints *j) {
    for (int i = 0; i < j->numBlocks; i++) {
        KeaJointBlock *b = &j->block[i];
        for (int k = b->firstRow; k < b->endRow; k++) {
            copyJointJacobian(s, &j->row[k]);
            j->row[k].invMassInBlock = 0;
        }
        factorizeBlock(s, j, b);
    }
}

/* Removes the violation of a stop by displacements; the stop does not pull. */
static void correctStop(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b, KeaJointRow *r) {
    const double residual = r->residual - jointRateOf(r, unknownsOf(j, b));
    const double need = r->lower == 0 ? keaMax(residual, 0) : keaMin(residual, 0);
    if (!r->isRigid || r->isInactive || need == 0)
        return;
    if (r->invMassInBlock == 0)
        computeResponse(s, b, r);
    addJointResponse(j, b, r, need / r->invMassInBlock);
}

/* Scales all displacements of a pass down so that no body rotates by more than kea_maxPush: beyond that angle errors
 * are no longer linear in the displacements. */
static void limitRotation(const KeaJoints *j, const KeaJointBlock *b) {
    double max = 0;
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++)
        max = keaMax(max, keaLength(j->x[n] + 3));
    if (max <= kea_maxPush)
        return;
    for (int n = b->firstNode; n < b->firstNode + b->numNodes; n++)
        for (int i = 0; i < 6; i++)
            j->x[n][i] *= kea_maxPush / max;
}

/* Sets the position residuals of a block's rows. Returns the largest error, relative to the smaller body's size. */
static double setPositionResiduals(const KeaJoints *j, const KeaJointBlock *b, const KeaMotion displacement[]) {
    double(*const v)[6] = motionsOf(j, b, displacement);
    double max = 0;
    for (int k = b->firstRow; k < b->endRow; k++) {
        KeaJointRow *r = &j->row[k];
        r->residual = r->isRigid ? -(r->jointError + jointRateOf(r, v)) : 0;
        max = keaMax(max, openingOf(r, violationOf(r, -r->residual)));
    }
    return max;
}

static void correctStops(const MdtKeaSystem *s, const KeaJoints *j, const KeaJointBlock *b) {
    for (int k = b->firstBounded; k < b->endRow; k++)
        correctStop(s, j, b, &j->row[k]);
}

double kea_jointsCorrectPositions(const MdtKeaSystem *s, KeaJoints *j, KeaMotion displacement[]) {
    double max = 0;
    for (int i = 0; i < j->numBlocks; i++) {
        const KeaJointBlock *b = &j->block[i];
        if (!b->isSound)
            continue;
        max = keaMax(max, setPositionResiduals(j, b, displacement));
        if (b->isWide) {
            clearUnknowns(j, b);
            correctStops(s, j, b);
            moveBlock(j, b, displacement);
            setPositionResiduals(j, b, displacement);
        }
        solveUnboundedRows(j, b);
        if (!b->isWide)
            correctStops(s, j, b);
        limitRotation(j, b);
        moveBlock(j, b, displacement);
    }
    return max;
}

/* ---- rebounds and results ---- */

MeBool kea_jointsSetRebounds(KeaJoints *j) {
    MeBool isAny = MEFALSE;
    for (int k = 0; k < j->numRows; k++) {
        KeaJointRow *r = &j->row[k];
        if (r->row->bounces && r->impulse > 0) {
            r->target = r->row->rebound;
            isAny = METRUE;
        }
    }
    return isAny;
}

double kea_jointsWorkOfDrives(const KeaJoints *j) {
    double work = 0;
    for (int k = 0; k < j->numRows; k++) {
        const KeaJointRow *r = &j->row[k];
        if (!r->row->bounces)
            work += r->impulse * (r->target - r->compliance * r->impulse);
    }
    return work;
}

void kea_jointsAddImpulses(const KeaJoints *j, double (*change)[6]) {
    sumImpulses(j);
    for (int n = 0; n < j->numNodes; n++)
        kea_addScaled6(change[j->body[n].motion - 1], 1, j->x[n]);
}

void kea_jointsReturnForces(MdtKeaSystem *s, const KeaJoints *j) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].ripple = 0;
    for (int k = 0; k < j->numRows; k++)
        s->rows[j->row[k].row - s->rows].force = boundedImpulse(&j->row[k]) / s->parameters.stepsize;
}
