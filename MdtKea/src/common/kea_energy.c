/* Kinetic energy, and the one limiter: no answer that was not found, and no rebound, adds energy.
 *
 * Two sets of velocities, an elastic one that may have too much and a plastic one that has not, are blended along the
 * straight line between them: E(v + a (elastic - plastic)) is a parabola in a, and the largest a in [0, 1] that is
 * allowed is its root. What has no plastic answer is slowed down as a whole.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"

double kea_energyOf(const KeaMetric *B, const double a[6], const double b[6]) {
    double Ba[6];
    kea_applyMetric(Ba, B, a);
    return 0.5 * kea_dot6(Ba, b);
}

double kea_kineticEnergy(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]) {
    double sum = 0, v[6];
    for (int b = 0; b < s->numBodies; b++) {
        for (int k = 0; k < 6; k++)
            v[k] = change ? velocity[b][k] + change[b][k] : velocity[b][k];
        sum += kea_energyOf(&s->work->problem.metric[b], v, v);
    }
    return sum;
}

/* A bounded joint that is led along: it works, as a motor does that is met by its velocity. */
static MeBool isTrackingMotor(const MdtKeaRow *row) {
    return row->position && row->drift != 0 && row->lower < 0 && row->upper > 0 && row->lower > -HUGE_VAL;
}

double kea_energyAllowed(const MdtKeaSystem *s) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const MdtKeaBody *body = s->bodies[b];
        const double *u = s->work->body[b].u;
        double dv[3], dL[3];
        keaSubtract(dv, s->work->body[b].freeVelocity, body->velocity);
        keaSubtract(dL, s->work->body[b].freeMomentum, body->angularMomentum);
        sum += 0.5 * (keaDot(body->velocity, body->velocity) / body->invMass +
                      keaDot(body->angularMomentum, s->velocity[b].ang));
        sum += keaDot(dv, u) / body->invMass + keaDot(dL, u + 3);
    }
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 && (!s->rows[i].position || isTrackingMotor(&s->rows[i])))
            sum += s->work->problem.row[i].p * kea_meanRate(s, i);
    return sum;
}

/* ---- blending ---- */

/* The largest a in [0, 1] with c[0] + c[1] a + c[2] a² <= 0; 0 if there is none. */
static double largestRoot(const double c[3]) {
    const double root = c[1] * c[1] - 4 * c[0] * c[2];
    if (c[0] + c[1] + c[2] <= 0)
        return 1;
    return c[2] > 0 && root > 0 ? keaMin(keaMax((-c[1] + sqrt(root)) / (2 * c[2]), 0), 1) : 0;
}

double kea_elasticShare(const MdtKeaSystem *s, double (*velocity)[6], double (*elastic)[6], double (*plastic)[6],
                        double allowed) {
    double c[3] = {-allowed, 0, 0}, v[6], step[6];
    for (int b = 0; b < s->numBodies; b++) {
        const KeaMetric *B = &s->work->problem.metric[b];
        for (int k = 0; k < 6; k++) {
            v[k] = velocity[b][k] + plastic[b][k];
            step[k] = elastic[b][k] - plastic[b][k];
        }
        c[0] += kea_energyOf(B, v, v);
        c[1] += 2 * kea_energyOf(B, v, step);
        c[2] += kea_energyOf(B, step, step);
    }
    const double share = largestRoot(c);
    MEASSERT(share >= 0 && share <= 1);
    return share;
}

/* ---- slowing down ---- */

/* Of the bodies that no row acts on; they keep it. */
static double freeEnergy(const MdtKeaSystem *s, double (*velocity)[6]) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++)
        if (s->work->body[b].isFree)
            sum += kea_energyOf(&s->work->problem.metric[b], velocity[b], velocity[b]);
    return sum;
}

MeBool kea_slowDown(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]) {
    const double energy = kea_kineticEnergy(s, velocity, NULL);
    if (energy <= allowed)
        return MEFALSE;
    const double kept = freeEnergy(s, velocity);
    if (!(energy > kept)) /* nothing but free bodies moves */
        return MEFALSE;
    const double less = sqrt(keaMax(allowed - kept, 0) / (energy - kept)) - 1;
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            change[b][k] = s->work->body[b].isFree ? 0 : less * velocity[b][k];
    MEASSERT(!(kea_kineticEnergy(s, velocity, change) > keaMax(allowed, kept) + kea_assertedRounding * energy));
    return METRUE;
}
