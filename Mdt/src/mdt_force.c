/* Forces of programs: one that is given in step after step is taken for samples of a force that varies in time.
 *
 * A program computes a force F_n from where its body is as step n begins, and F_n acts for the whole step. Of a body
 * that moves by x' = x + h ((1 - θ) v + θ v'), a spring -k x given like this multiplies the amplitude by
 * sqrt(1 + (1 - θ) (h w)²) in each step. With
 *
 *     (1 - θ) h (F_n - F_n-1)
 *
 * added to the momentum at the start of step n, h being the time between the two, the positions are those of Störmer
 * and Verlet, x_n+1 - 2 x_n + x_n-1 = h² F_n / m, which keep it (Hairer, Lubich and Wanner, Geometric Numerical
 * Integration, I.1.4). Nothing is added where a force begins or ends: one that is constant, or switched, acts for
 * exactly its steps.
 *
 * Of a damper the correction is the method of Adams and Bashforth, which is stable up to h c / m = 1; without it the
 * limit is 2. So stiffness and damping are estimated from the last changes of the force (fitFeedback), and the
 * correction fades out where damping is large.
 */
#include "MeAssert.h"
#include "mdt_i.h"
#include <string.h>

/* ---- what the force answers to ---- */

/* Each frame counts .6 times as much as the next: the last three make up four fifths, as many as there are unknowns.
 * Before the first there is one of no force, no momentum and no change. */
static void addToFit(MdtFeedback *fit, double p, double q, double f) {
    double *const sum[] = {&fit->weight, &fit->p, &fit->q, &fit->f, &fit->pp, &fit->pq, &fit->qq, &fit->fp, &fit->fq};
    const double now[] = {1, p, q, f, p * p, p * q, q * q, f * p, f * q}, memory = 0.6;
    fit->weight = fmax(fit->weight, 1);
    for (int i = 0; i < (int)(sizeof now / sizeof *now); i++)
        *sum[i] = memory * *sum[i] + now[i];
}

/* f = a - κ p - δ q */
typedef struct Law {
    double offset, stiffness, damping;
} Law;

/* Least squares along the force's change, with f that change times h, p the mean momentum of the frame and q its
 * change: κ = h² k / m, δ = h c / m. A body that moves uniformly besides has an offset a. */
static Law lawOf(const MdtFeedback *fit) {
    const double n = fmax(fit->weight, 1), pp = fit->pp - fit->p * fit->p / n, qq = fit->qq - fit->q * fit->q / n,
                 pq = fit->pq - fit->p * fit->q / n, fp = fit->fp - fit->f * fit->p / n,
                 fq = fit->fq - fit->f * fit->q / n;
    const double ridge = 1e-3 * (pp + qq); /* where p and q are proportional */
    const double det = (pp + ridge) * (qq + ridge) - pq * pq;
    Law law = {0, 0, 0};
    if (det > 0) {
        law.stiffness = (pq * fq - (qq + ridge) * fp) / det;
        law.damping = (pq * fp - (pp + ridge) * fq) / det;
    }
    law.offset = (fit->f + law.stiffness * fit->p + law.damping * fit->q) / n;
    return law;
}

/* The share of a change f of the force that the motion p, q explains: by the law of the frames before this one, to a
 * factor of 3; in the first frames by any spring and damper that is stable. The rest depends on time, such as a push
 * that the program makes stronger, and is taken as it is given. */
static double explainedShare(const MdtFeedback *before, double p, double q, double f) {
    const double few = 2; /* 1 + .6 + .6² < few < 1 + .6 + .6² + .6³: fewer than three */
    const Law law = lawOf(before);
    const double most = before->weight < few
                            ? 4 * fabs(p) + 2 * fabs(q)
                            : 3 * (law.offset - law.stiffness * p - law.damping * q) * (f < 0 ? -1 : 1);
    return fmin(fmax(most / fabs(f), 0), 1);
}

/* The share of the correction that is stable: all of it up to δ = .6, none from 1 on. Where δ is below .6 κ the body
 * has far more inertia than its own mass (it is tied to others), so that both are overestimated. Oscillators with all
 * ratios of damping up to 1 and h w up to .9 stay within 4 % of the analytic envelope (tests/Mdt/test_Feedback.c). */
static double stableShare(const Law *law) {
    const double all = 0.6, none = 1;
    if (law->damping < 0.6 * law->stiffness)
        return 1;
    return fmin(fmax((none - law->damping) / (none - all), 0), 1);
}

/* Does it alternate and grow, as only a force does that is too stiff for the step? */
static MeBool runsAway(MdtFeedback *fit, const double now[3], const double last[3]) {
    enum { MANY = 6 };
    const MeBool isLarger = keaDot(now, last) < 0 && keaDot(now, now) > keaDot(last, last);
    fit->growth = isLarger ? fit->growth + 1 : fit->growth / 2;
    return fit->growth >= MANY;
}

/* By more than the thresholds of rest: what is less may be rounding. */
static MeBool isVisible(const double load[3], double inverse, double h, MeReal threshold) {
    return h * h * inverse * inverse * keaDot(load, load) > (double)threshold;
}

static void warnOfStiffness(MdtBodyID b, const char *function) {
    if (b->record.flags & MDT_TOLD)
        return;
    b->record.flags |= MDT_TOLD;
    MeWarning(2,
              "%s: the load on a body (sort key %d) changes its sign and grows in each step of %g s: its spring or "
              "damper is too stiff for explicit forces, with frequency times step above 2. Take shorter steps, or "
              "MdtSpring or MdtSpring6, which are stable at any stiffness",
              function, b->link.sortKey, b->applied.time);
}

/* N s, N m s: what a step of h seconds lacks if the force is `now` and was `last`; the momentum was `before`, and is
 * `after`. */
static void correct(MdtFeedback *fit, double theta, double h, const double now[3], const double last[3],
                    const double before[3], const double after[3], double correction[3]) {
    keaSubtract(correction, now, last);
    double size = keaLength(correction);
    if (size > 0) {
        size = keaDot(correction, fit->along) < 0 ? -size : size; /* an axis turns, and does not change its sign */
        keaScale(fit->along, 1 / size, correction);
    }
    const double p0 = keaDot(before, fit->along), p1 = keaDot(after, fit->along), p = 0.5 * (p0 + p1), q = p1 - p0;
    const double explained = size == 0 ? 0 : explainedShare(fit, p, q, h * size);
    addToFit(fit, p, q, h * size);
    const Law law = lawOf(fit);
    keaScale(correction, (1 - theta) * h * explained * stableShare(&law), correction);
}

/* ---- the correction ---- */

static void getMomenta(const MdtBody *b, double momentum[2][3]) {
    keaScale(momentum[0], b->mass, b->kea.velocity);
    keaCopy(momentum[1], b->kea.angularMomentum);
}

/* The force goes on: changes the body's momenta as the frame begins. */
static void continueLoad(MdtBodyID b) {
    MdtApplied *last = &b->applied;
    double after[2][3], correction[2][3];
    getMomenta(b, after);
    correct(&last->pushing, b->theta, last->time, b->force, last->force, last->momentum[0], after[0], correction[0]);
    correct(&last->turning, b->theta, last->time, b->torque, last->torque, last->momentum[1], after[1], correction[1]);
    const double h = last->time, *I = b->kea.moments, inverse = 1 / fmax(I[0], fmax(I[1], I[2]));
    if (runsAway(&last->pushing, b->force, last->force) &&
        isVisible(b->force, b->kea.invMass, h, b->world->rest.vel_thresh))
        warnOfStiffness(b, "MdtBodyAddForce");
    if (runsAway(&last->turning, b->torque, last->torque) &&
        isVisible(b->torque, inverse, h, b->world->rest.velrot_thresh))
        warnOfStiffness(b, "MdtBodyAddTorque");
    for (int k = 0; k < 2; k++)
        keaAddScaled(b->kea.kick[k], 1, correction[k]);
}

/* ---- one frame ---- */

void mdt_forceForget(MdtBodyID b) {
    b->applied.time = 0;
    memset(&b->applied.pushing, 0, sizeof b->applied.pushing);
    memset(&b->applied.turning, 0, sizeof b->applied.turning);
}

void mdt_forceKeep(MdtBodyID b) {
    keaAddScaled(b->force, 1, b->applied.force);
    keaAddScaled(b->torque, 1, b->applied.torque);
    b->record.flags |= MDT_KEPT;
}

void mdt_forceBegin(MdtBodyID b) {
    if (b->record.flags & MDT_KEPT)
        return;
    if (!(b->record.flags & MDT_FORCED))
        mdt_forceForget(b);
    else if (b->applied.time > 0)
        continueLoad(b);
}

void mdt_forceApply(MdtBodyID b, double frame) {
    MdtApplied *a = &b->applied;
    keaCopy(a->force, b->force);
    keaCopy(a->torque, b->torque);
    if ((b->record.flags & (MDT_FORCED | MDT_KEPT)) == MDT_FORCED)
        a->time = frame;
    keaCopy(b->kea.force, b->force);
    keaCopy(b->kea.torque, b->torque);
    b->record.flags &= ~MDT_KEPT;
    MdtBodyResetForces(b);
}
