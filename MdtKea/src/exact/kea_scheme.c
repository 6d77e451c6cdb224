/* Time integration: end states from the unknown velocities u, the residual of momentum, and its derivatives.
 *
 * A body moves through the step with u = (v_m, w_m), and its θ is 1/2 (midpoint rule) or 1 (backward Euler):
 *
 *     x⁺ = x + h v_m               v⁺ = v + (v_m - v)/θ
 *     q⁺ = cay(h w_m) q            W⁺ = W + (Rᵀ w_m - W)/θ           W: in body axes; cay(a) = (1, a/2) normalized
 *     momentum:  m v⁺ - m v_free = Σ p,    R⁺ I W⁺ - L_free = Σ r_m x p,
 *
 * with v_free, L_free the values at the end without rows. J is that of the mean pose, R_m = (R + R⁺)/2, for which
 *
 *     R⁺ - R = h [w_m]x R_m        exactly, so that φ⁺ - φ = h J_m u for every φ that is quadratic in the poses:
 *
 * rigid joints do no work, and the energy changes only by
 *
 *     E⁺ - E = -Σ (θ - 1/2) |v⁺ - v|²_M  +  the work of loads, springs, motors and contacts
 *
 * (Simo & Wong 1991; Gonzalez 2000). With θ = 1/2 it is conserved; with θ = 1 (bodies in contact) it decreases.
 *
 * The derivative of the momentum is M/θ plus the geometric stiffness: an impulse P at the arm r, which rotates with the
 * body, contributes (h/2) [P]x[r]x. Only its symmetric part without negative eigenvalues is used, so that the inner
 * problem stays convex.
 *
 * A body with equal moments, or without Coriolis term, is integrated in world axes (KeaBody.isSpatial),
 * w⁺ = w + (w_m - w)/θ, which is the same identity with less work.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* Sets principal axes and angular velocity at the start. */
static void setStartSpin(const MdtKeaBody *body, KeaBody *b) {
    double L[3];
    kea_principalAxes(body, body->quaternion, b->axes);
    b->isSpatial = kea_hasEqualMoments(body->moments) || kea_isSteady(body);
    if (b->isSpatial) {
        kea_inertia(body, body->quaternion, b->inertia);
        MdtKeaBodyGetAngularVelocity(body, b->spin);
        return;
    }
    keaApplyTransposed(L, (const double(*)[3])b->axes, body->angularMomentum);
    for (int i = 0; i < 3; i++)
        b->spin[i] = L[i] / body->moments[i];
}

/* N s: the scale of a body's impulses: those of its loads plus a small fraction of its momentum. */
static double impulseScaleOf(const MdtKeaSystem *s, int i) {
    const MdtKeaBody *body = s->bodies[i];
    const double size = s->work->body[i].size;
    double dv[3], dL[3];
    keaSubtract(dv, s->predicted[i].lin, body->velocity);
    keaSubtract(dL, s->work->body[i].freeMomentum, body->angularMomentum);
    const double momentum = keaLength(body->velocity) / body->invMass + keaLength(body->angularMomentum) / size;
    return keaMax(keaLength(dv) / body->invMass + keaLength(dL) / size + kea_roundingShare * momentum,
                  kea_minSpeed(size, s->parameters.stepsize) / body->invMass);
}

/* Guesses u by the acceleration of the last step, unless that was a jerk, such as an impact. */
static void guessVelocity(MdtKeaSystem *s, int i) {
    const MdtKeaVelocity *v = &s->velocity[i];
    KeaBody *b = &s->work->body[i];
    const double *a = s->bodies[i]->acceleration, h = s->parameters.stepsize;
    const double change = h * (keaLength(a) + b->size * keaLength(a + 3)) / s->bodies[i]->invMass;
    const double step = change < kea_jerk * s->work->problem.scale[i] ? b->theta * h : 0;
    for (int k = 0; k < 3; k++) {
        b->u[k] = v->lin[k] + step * a[k];
        b->u[3 + k] = v->ang[k] + step * a[3 + k];
    }
}

void kea_beginBodies(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++) {
        const MdtKeaBody *body = s->bodies[i];
        KeaBody *b = &s->work->body[i];
        MEASSERT(body->invMass > 0 && body->moments[0] > 0 && body->moments[1] > 0 && body->moments[2] > 0);
        b->isFree = METRUE;
        setStartSpin(body, b);
        q->scale[i] = impulseScaleOf(s, i);
        q->length[i] = b->size;
    }
}

void kea_guessMotion(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        guessVelocity(s, i);
}

/* ---- motion ---- */

void kea_moveVelocity(const MdtKeaSystem *s, int i, MeBool byEnd, double move[6]) {
    const MdtKeaBody *body = s->bodies[i];
    const KeaBody *b = &s->work->body[i];
    const double theta = kea_isMovedByU(s, i) ? b->theta : byEnd ? 1 : b->moveTheta, share = theta / b->theta;
    double w[3];
    keaCopy(w, b->spin);
    if (!b->isSpatial)
        keaApply(w, (const double(*)[3])b->axes, b->spin);
    for (int k = 0; k < 3; k++) {
        move[k] = share == 1 ? b->u[k] : body->velocity[k] + (b->u[k] - body->velocity[k]) * share;
        move[3 + k] = share == 1 ? b->u[3 + k] : w[k] + (b->u[3 + k] - w[k]) * share;
    }
}

/* The rotation quaternion cay(h w), w the angular part of u. */
static void cayley(double turn[4], const double u[6], double h) {
    turn[0] = 1;
    keaScale(turn + 1, 0.5 * h, u + 3);
    keaQuaternionNormalize(turn);
}

/* Sets orientation, angular velocity and angular momentum at the end; move: the velocity that the body is moved by. */
static void rotateBody(const MdtKeaBody *body, const double move[6], KeaBody *b, KeaEnd *end, double h) {
    const double perTheta = 1 / b->theta;
    double turn[4], w[3], L[3];
    cayley(turn, move, h);
    keaQuaternionProduct(end->quaternion, turn, body->quaternion);
    keaQuaternionNormalize(end->quaternion);
    kea_principalAxes(body, end->quaternion, b->endAxes);
    if (b->isSpatial) {
        for (int i = 0; i < 3; i++)
            b->endVelocity[3 + i] = b->spin[i] + (b->u[3 + i] - b->spin[i]) * perTheta;
        kea_angularMomentum(body, end->quaternion, b->endVelocity + 3, end->angularMomentum);
        return;
    }
    keaApplyTransposed(w, (const double(*)[3])b->axes, b->u + 3);
    for (int i = 0; i < 3; i++) {
        w[i] = b->spin[i] + (w[i] - b->spin[i]) * perTheta;
        L[i] = body->moments[i] * w[i];
    }
    keaApply(b->endVelocity + 3, (const double(*)[3])b->endAxes, w);
    keaApply(end->angularMomentum, (const double(*)[3])b->endAxes, L);
}

void kea_moveBodies(MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    for (int i = 0; i < s->numBodies; i++) {
        const MdtKeaBody *body = s->bodies[i];
        KeaBody *b = &s->work->body[i];
        KeaEnd *end = &s->work->end[i];
        const double perTheta = 1 / b->theta;
        double move[6];
        kea_moveVelocity(s, i, MEFALSE, move);
        end->theta = kea_isMovedByU(s, i) ? b->theta : b->moveTheta;
        keaCopy(end->position, body->position);
        keaAddScaled(end->position, h, move);
        for (int k = 0; k < 3; k++)
            b->endVelocity[k] = end->velocity[k] = body->velocity[k] + (b->u[k] - body->velocity[k]) * perTheta;
        rotateBody(body, move, b, end, h);
        kea_setPoses(s, i);
        kea_setErrorScales(s, i);
    }
}

/* ---- momentum and its derivative ---- */

/* Sets the load of the inner problem: the momentum at the end minus that without rows, m v⁺ - m v_free and
 * R⁺ I W⁺ - L_free. */
static void setMomentumResidual(const MdtKeaBody *body, const KeaBody *b, const double free[3], const KeaEnd *end,
                                double load[6]) {
    for (int i = 0; i < 3; i++)
        load[i] = (end->velocity[i] - free[i]) / body->invMass;
    if (b->isSpatial) { /* I (w⁺ - w) with the inertia at the start */
        double dw[3];
        keaSubtract(dw, b->endVelocity + 3, b->spin);
        keaApply(load + 3, (const double(*)[3])b->inertia, dw);
        keaAddScaled(load + 3, -1, b->freeMomentum);
        keaAddScaled(load + 3, 1, body->angularMomentum);
    } else {
        keaSubtract(load + 3, end->angularMomentum, b->freeMomentum);
    }
}

/* A I Aᵀ with A the mean of the principal axes at start and end. */
static void meanInertia(const MdtKeaBody *body, const KeaBody *b, double inertia[3][3]) {
    if (b->isSpatial) {
        memcpy(inertia, b->inertia, sizeof b->inertia);
        return;
    }
    double A[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            A[i][k] = 0.5 * (b->axes[i][k] + b->endAxes[i][k]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += A[i][k] * body->moments[k] * A[j][k];
            inertia[i][j] = inertia[j][i] = sum;
        }
    }
}

/* Sums up the geometric stiffness of all rows on each body in metric[].angular. */
static void gatherStiffness(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    const double h = s->parameters.stepsize;
    for (int b = 0; b < s->numBodies; b++)
        memset(q->metric[b].angular, 0, sizeof q->metric[b].angular);
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if ((!row->position && !row->spring) || row->isFixed)
            continue;
        for (int k = 0; k < 2; k++) {
            double P[3];
            if (row->body[k] < 0)
                continue;
            keaScale(P, kea_impulseOf(q, i), row->J[k].lin);
            kea_addGeometricStiffness(q->metric[row->body[k]].angular, 0.5 * h, P, row->arm[k]);
        }
    }
    for (int b = 0; b < s->numBodies && s->work->hasLocks; b++)
        kea_dropLockedRotations(s->work->body[b].locked, q->metric[b].angular);
}

/* Sets the metric B = inertia / θ + geometric stiffness, which B->angular has at first. Stiffness far below the inertia
 * is left out: Newton's method converges as well without it. */
static void setBodyMetric(const MdtKeaBody *body, const KeaBody *b, KeaMetric *B) {
    const double perTheta = 1 / b->theta, min = kea_minOf(body->moments) * perTheta;
    double inertia[3][3];
    meanInertia(body, b, inertia);
    if (kea_largestEntry((const double(*)[3])B->angular) > kea_smallStiffness * min)
        kea_clampPositive(B->angular, 0.5 * min); /* more negative stiffness than that could make B singular */
    else
        memset(B->angular, 0, sizeof B->angular);
    MEASSERT(b->theta == 0.5 || b->theta == 1);
    B->linear = 1 / (body->invMass * b->theta);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            B->angular[i][j] += inertia[i][j] * perTheta;
    kea_invert(B->inverse, (const double(*)[3])B->angular);
}

/* ---- the exact derivative of the momentum, for the tangent problem ---- */

/* D = h (1 + h/2 [w]x) / (1 + |h w / 2|²). */
static void setTurnDerivative(double D[3][3], const double w[3], double h) {
    const double half = 0.5 * h, share = h / (1 + half * half * keaDot(w, w));
    const double x[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            D[i][j] = (i == j ? share : 0) + half * share * x[i][j];
}

/* r += s A D */
static void addProduct(double r[3][3], double s, double (*const A)[3], double (*const D)[3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                r[i][j] += s * A[i][k] * D[k][j];
}

/* r = derivative with w_m of R⁺ I W⁺, or of a spatial body's I (w⁺ - w). */
static void momentumDerivative(const MdtKeaSystem *s, int body, double r[3][3]) {
    const KeaBody *b = &s->work->body[body];
    const double *L = s->work->end[body].angularMomentum, perTheta = 1 / b->theta;
    double x[3][3] = {{0, -L[2], L[1]}, {L[2], 0, -L[0]}, {-L[1], L[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = b->isSpatial ? b->inertia[i][j] : 0;
            for (int k = 0; k < 3 && !b->isSpatial; k++)
                sum += b->endAxes[i][k] * s->bodies[body]->moments[k] * b->axes[j][k];
            r[i][j] = sum * perTheta;
        }
    if (!b->isSpatial)
        addProduct(r, -1, x, s->work->turnDerivative[body]);
}

/* -d (r_m x P) = 1/2 P x (D d w x r⁺), r⁺ = r_m + h/2 w_m x r_m. */
static void addExactStiffness(const MdtKeaSystem *s, int body, double r[3][3], const double P[3], const double arm[3]) {
    double end[3], K[3][3];
    keaCross(end, s->work->body[body].u + 3, arm);
    keaScale(end, 0.5 * s->parameters.stepsize, end);
    keaAddScaled(end, 1, arm);
    const double Pr = keaDot(P, end);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[i][j] = (i == j ? Pr : 0) - end[i] * P[j];
    addProduct(r, 0.5, K, s->work->turnDerivative[body]);
}

/* Leaves the derivative between free rotations, and the inertia of locked ones. */
static void lockTangent(const MdtKeaSystem *s, int body, double r[3][3]) {
    const KeaBody *b = &s->work->body[body];
    kea_dropLockedRotations(b->locked, r);
    for (int k = 0; k < 3; k++)
        if (b->locked >> (3 + k) & 1)
            r[k][k] = b->inertia[k][k] / b->theta;
}

void kea_differentiateBodies(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++) {
        setTurnDerivative(s->work->turnDerivative[i], s->work->body[i].u + 3, s->parameters.stepsize);
        momentumDerivative(s, i, q->tangentInertia[i]);
    }
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        for (int k = 0; k < 2 && (row->position || row->spring) && !row->isFixed; k++) {
            const int b = row->body[k];
            double P[3];
            if (b < 0)
                continue;
            keaScale(P, kea_impulseOf(q, i), row->J[k].lin);
            addExactStiffness(s, b, q->tangentInertia[b], P, row->arm[k]);
        }
    }
    for (int i = 0; i < s->numBodies && s->work->hasLocks; i++)
        lockTangent(s, i, q->tangentInertia[i]);
}

void kea_linearizeBodies(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int i = 0; i < s->numBodies; i++)
        setMomentumResidual(s->bodies[i], &s->work->body[i], s->predicted[i].lin, &s->work->end[i], q->load[i]);
    if (kea_keepsMetric(s))
        return;
    gatherStiffness(s);
    for (int i = 0; i < s->numBodies; i++)
        setBodyMetric(s->bodies[i], &s->work->body[i], &q->metric[i]);
}

void kea_balanceMomentum(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++) {
        const KeaBody *b = &s->work->body[i];
        keaCopy(s->work->end[i].velocity, s->predicted[i].lin);
        keaCopy(s->work->end[i].angularMomentum, b->freeMomentum);
    }
    for (int i = 0; i < s->numRows; i++) {
        const KeaProblemRow *p = &s->work->problem.row[i];
        const double impulse = kea_impulseOf(&s->work->problem, i);
        for (int k = 0; k < 2; k++) {
            if (p->body[k] < 0)
                continue;
            KeaEnd *end = &s->work->end[p->body[k]];
            keaAddScaled(end->velocity, impulse * s->bodies[p->body[k]]->invMass, p->J[k]);
            keaAddScaled(end->angularMomentum, impulse, p->J[k] + 3);
        }
    }
    for (int i = 0; i < s->numBodies; i++) {
        const KeaEnd *end = &s->work->end[i];
        keaCopy(s->work->body[i].endVelocity, end->velocity);
        kea_angularVelocity(s->bodies[i], end->quaternion, end->angularMomentum, s->work->body[i].endVelocity + 3);
    }
}

void kea_endInertia(const MdtKeaSystem *s, int i, double inertia[3][3]) {
    if (s->work->body[i].isSpatial)
        memcpy(inertia, s->work->body[i].inertia, sizeof s->work->body[i].inertia);
    else
        kea_inertia(s->bodies[i], s->work->end[i].quaternion, inertia);
}
