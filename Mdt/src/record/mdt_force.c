/* Forces of programs: forces that are given in successive steps are interpreted as samples of a continuous force.
 *
 * A program computes a force F_n from the body's state at the start of step n, and F_n acts for the whole step. For a
 * body that moves by x' = x + h ((1 - θ) v + θ v'), a spring -k x computed like this multiplies the amplitude by
 * sqrt(1 + (1 - θ) (h w)²) in each step. With
 *
 *     (1 - θ) h (F_n - F_n-1)
 *
 * added to the momentum at the start of step n, h being the time between the two samples, the positions are those of
 * Störmer and Verlet, x_n+1 - 2 x_n + x_n-1 = h² F_n / m, which conserve the amplitude (Hairer, Lubich and Wanner,
 * Geometric Numerical Integration, I.1.4). Nothing is added when a force begins or ends: a constant force acts for
 * exactly the steps in which it is given.
 *
 * For a damper the correction amounts to the method of Adams and Bashforth, which is stable up to h c / m = 1; without
 * the correction the limit is 2. Therefore stiffness and damping are estimated from the last changes of the force
 * (estimateLaw), and the correction fades out where damping is large.
 */
#include "MeAssert.h"
#include "record/mdt_record_i.h"
#include <string.h>

/* ---- estimating the feedback from motion to force ---- */

/* With each new frame the weight of all older ones in the sums is multiplied by this. */
static const double forgettingFactor = 0.9;
/* In the first frames the instrument is the same frame's motion, as no earlier one is known. */
enum { NEW_FRAMES = 4 };

/* Adds a frame: mean momentum p, its change q, and f, the change of the force times the frame's time. */
static void addToFit(MdtFeedback *fit, double p, double q, double f) {
    const MeBool isNew = fit->frames < NEW_FRAMES;
    const double P = isNew ? p : keaDot(fit->before[0], fit->along), Q = isNew ? q : keaDot(fit->before[1], fit->along);
    const double row[3] = {1, P, Q}, column[5] = {1, p, q, f, p * p + q * q};
    if (fit->frames++ == 0)
        fit->sum[0][0] = 1; /* an imaginary first frame without force and momentum */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++)
            fit->sum[i][k] = forgettingFactor * fit->sum[i][k] + row[i] * column[k];
}

/* Feedback law: f = a - κ p - δ q; stiffness κ, damping δ. */
typedef struct Law {
    double stiffness, damping;
} Law;

/* The sum of products less the product of means: removes the effect of the constant a. */
static double centredSum(const MdtFeedback *fit, int i, int k) {
    return fit->sum[i][k] - fit->sum[i][0] * fit->sum[0][k] / fmax(fit->sum[0][0], 1);
}

/* κ = h² k / m and δ = h c / m, by the method of instrumental variables. A force that is independent of the motion has
 * changed the momentum of the last frame, but not that of the frame before it, which is the instrument. If the
 * correlation is weak, or p and q are proportional, the ridge makes both estimates smaller. */
static Law estimateLaw(const MdtFeedback *fit) {
    const double a = centredSum(fit, 1, 1), b = centredSum(fit, 1, 2), c = centredSum(fit, 2, 1),
                 d = centredSum(fit, 2, 2), pf = centredSum(fit, 1, 3), qf = centredSum(fit, 2, 3),
                 ridge = 0.03 * fit->sum[0][4];
    /* (AᵀA + ridge² 1)⁻¹ Aᵀ y, of A = (a b; c d) */
    const double A = a * a + c * c + ridge * ridge, B = a * b + c * d, D = b * b + d * d + ridge * ridge;
    const double y = a * pf + c * qf, z = b * pf + d * qf, det = A * D - B * B;
    return det > 0 ? (Law){-(D * y - B * z) / det, -(A * z - B * y) / det} : (Law){0, 0};
}

/* The fraction of the correction that is stable: 1 up to δ = .6, falling to 0 at δ = 1; also 0 if a damped force
 * alternates and grows. If δ is below .6 κ, the body's effective mass is much larger than its own mass, since it is
 * attached to other bodies, and both are overestimated: 1. Oscillators with all damping ratios up to 1 and h w up to .9
 * stay within 5 % of the analytic envelope (tests/Mst/test_Forces.c). */
static double stableShare(const Law *law, MeBool alternates) {
    const double all = 0.6, none = 1;
    if (law->damping < 0.6 * law->stiffness)
        return 1;
    if (alternates)
        return 0;
    return fmin(fmax((none - law->damping) / (none - all), 0), 1);
}

/* The fraction of a change of force, times the frame, that stable springs and dampers, κ <= 4 and δ <= 2, may have
 * caused by the motion. A body that is attached to something, or rests on it, may be prevented from moving: the
 * remaining change of the force is an independent push, and is not corrected. */
static double explainedShare(double change, const double p[3], const double q[3]) {
    MEASSERT(change > 0);
    const double share = fmin((4 * keaLength(p) + 2 * keaLength(q)) / change, 1);
    return share < 0.1 ? 0 : share; /* a body that is held moves by rounding only */
}

/* True if the force alternates and grows over many frames, as one does that is too stiff for the step: κ > 4 or δ > 2.
 * The estimates are right to a quarter; forces that grow by chance, or because the program wants it, have others. A
 * force that grows by more than a factor of 4 in a frame overflows sooner. */
static MeBool isUnstable(const MdtFeedback *fit) {
    enum { MANY = 8 };
    const Law law = estimateLaw(fit);
    return fit->growth >= MANY && (law.stiffness > 3 || law.damping > 1.5);
}

/* True if the load accelerates the body beyond the thresholds of sleep in a step; smaller loads may be rounding. */
static MeBool isLoadVisible(const double load[3], double inverse, double h, MeReal threshold) {
    return h * h * inverse * inverse * keaDot(load, load) > (double)threshold;
}

static void warnOfStiffness(MdtBodyID b, const char *function) {
    if (b->record.flags & MDT_WARNED)
        return;
    b->record.flags |= MDT_WARNED;
    MeWarning(2,
              "%s: the load on a body (sort key %d) grows step by step of %g s: its spring or "
              "damper is too stiff for explicit forces, with frequency times step above 2. Take shorter steps, or "
              "MdtSpring or MdtSpring6, which are stable at any stiffness",
              function, b->link.sortKey, b->forces->time);
}

/* The correction, N s or N m s, for a force that was `last` in the last step and is `now`. `before` and `after` are the
 * momenta at the last step's start and now. Also updates the estimate `fit`. */
static void computeCorrection(const MdtBody *b, MdtFeedback *fit, const double now[3], const double last[3],
                              const double before[3], const double after[3], double correction[3]) {
    const double h = b->forces->time, growth = keaDot(now, now) / keaDot(last, last);
    MEASSERT(h > 0);
    double mean[3], change[3];
    keaSubtract(correction, now, last);
    keaSubtract(change, after, before);
    keaScale(mean, 0.5, before);
    keaAddScaled(mean, 0.5, after);
    double size = keaLength(correction);
    const double explained = size > 0 && b->attachments ? explainedShare(h * size, mean, change) : 1;
    if (size > 0) {
        size = keaDot(correction, fit->along) < 0 ? -size : size; /* keeps the direction continuous */
        keaScale(fit->along, 1 / size, correction);
    }
    addToFit(fit, keaDot(mean, fit->along), keaDot(change, fit->along), h * size);
    keaCopy(fit->before[0], mean);
    keaCopy(fit->before[1], change);
    enum { LONGEST_RISE = 3 }; /* frames: at κ = 4.4 a change keeps its sign for two frames */
    fit->steady = size * fit->change < 0 ? 0 : fit->steady + 1;
    fit->change = size;
    const MeBool isAnswer = fit->steady < LONGEST_RISE && growth > 1 && explained > 0.5;
    fit->growth = isAnswer ? fit->growth + (growth > 16 ? 2 : 1) : fit->growth > 2 ? fit->growth - 2 : 0;
    const Law law = estimateLaw(fit);
    keaScale(correction, (1 - b->theta) * h * explained * stableShare(&law, fit->growth > 2 && keaDot(now, last) < 0),
             correction);
}

/* ---- the correction ---- */

void mdt_bodyMomenta(const MdtBody *b, double momentum[2][3]) {
    keaScale(momentum[0], b->mass, b->kea.velocity);
    keaCopy(momentum[1], b->kea.angularMomentum);
}

/* Adds the correction to the body's momenta at the start of the frame, and warns of instability. */
static void addCorrections(MdtBodyID b) {
    MdtForces *f = b->forces;
    const MdtPartitionParams *sleepParams = &b->world->sleepParams;
    const double *I = b->kea.moments, inverse[2] = {b->kea.invMass, 1 / fmax(I[0], fmax(I[1], I[2]))};
    const MeReal threshold[2] = {sleepParams->vel_thresh, sleepParams->velrot_thresh};
    double after[2][3], correction[2][3];
    mdt_bodyMomenta(b, after);
    for (int k = 0; k < 2; k++) {
        computeCorrection(b, &f->feedback[k], f->load[k], f->lastLoad[k], f->momentum[k], after[k], correction[k]);
        if (isUnstable(&f->feedback[k]) && isLoadVisible(f->load[k], inverse[k], f->time, threshold[k]))
            warnOfStiffness(b, k == 0 ? "MdtBodyAddForce" : "MdtBodyAddTorque");
    }
    for (int k = 0; k < 2; k++)
        keaAddScaled(b->kea.kick[k], 1, correction[k]);
}

/* ---- one frame ---- */

const MdtForces mdt_noForces;

MdtForces *mdt_forcesMake(MdtBodyID b, const char *caller) {
    if (!b->forces)
        b->forces = MeMemoryTakeZeroed(1, sizeof *b->forces, caller, "the forces of a body");
    return b->forces;
}

void mdt_forcesFree(MdtBodyID b) {
    MeMemoryGive(b->forces);
    b->forces = NULL;
}

void mdt_forceRestart(MdtBodyID b) {
    if (!b->forces)
        return;
    b->forces->time = 0;
    memset(b->forces->feedback, 0, sizeof b->forces->feedback);
}

void mdt_forceContinue(MdtBodyID b) {
    for (int k = 0; k < 2 && b->forces; k++)
        keaAddScaled(b->forces->load[k], 1, b->forces->lastLoad[k]);
    b->record.flags |= MDT_KEPT;
}

void mdt_forceBegin(MdtBodyID b) {
    if (b->record.flags & MDT_KEPT)
        return;
    if (!(b->record.flags & MDT_FORCED))
        mdt_forceRestart(b);
    else if (b->forces->time > 0)
        addCorrections(b);
}

void MEAPI MdtBodyAddLoad(const MdtBodyID b, const double force[3]) {
    MdtForces *f = mdt_forcesMake(b, "MstUniverseStep");
    if (f)
        keaAddScaled(f->load[0], 1, force);
}

void MEAPI MdtBodyResetForces(const MdtBodyID b) {
    if (!mdt_isAnyBody(b, __func__))
        return;
    if (b->forces)
        memset(b->forces->load, 0, sizeof b->forces->load);
    b->record.flags &= ~MDT_FORCED;
}

void mdt_forceApply(MdtBodyID b, double frame) {
    MEASSERT(frame > 0);
    MdtForces *f = b->forces;
    keaCopy(b->kea.force, mdt_forcesOf(b)->load[0]);
    keaCopy(b->kea.torque, mdt_forcesOf(b)->load[1]);
    if (f)
        memcpy(f->lastLoad, f->load, sizeof f->lastLoad);
    if ((b->record.flags & (MDT_FORCED | MDT_KEPT)) == MDT_FORCED)
        f->time = frame;
    b->record.flags &= ~MDT_KEPT;
    MdtBodyResetForces(b);
}
