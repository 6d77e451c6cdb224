/* Kinetic energy and its limiter: neither rebounds nor answers that have not converged may add energy.
 *
 * The change of velocity with restitution (elastic) may add too much energy, the one without (plastic) does not. The
 * limiter interpolates between them: E(v + plastic + a (elastic - plastic)) is quadratic in a, and the largest a in
 * [0, 1] with E <= allowed is a root. Without a plastic answer, all velocities are scaled.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"

double kea_kineticEnergy(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]) {
    double sum = 0, v[6];
    for (int b = 0; b < s->work->problem.numBodies; b++) {
        for (int k = 0; k < 6; k++)
            v[k] = change ? velocity[b][k] + change[b][k] : velocity[b][k];
        sum += kea_energyOf(&s->work->problem.metric[b], v, v);
    }
    return sum;
}

/* J: kinetic energy of body b at the start. */
static double startEnergy(const MdtKeaSystem *s, int b) {
    const MdtKeaBody *body = s->bodies[b];
    return 0.5 *
           (keaDot(body->velocity, body->velocity) / body->invMass + keaDot(body->angularMomentum, s->velocity[b].ang));
}

/* J: the work of the loads on body b in the step: with u, by which jointed bodies move, or along the displacement of
 * others, which do not move by u. */
static double workOfLoads(const MdtKeaSystem *s, int b) {
    const double *u = s->work->body[b].u;
    double dv[3], dL[3], mean[3];
    keaCopy(mean, u);
    if (!s->work->body[b].isTied) {
        keaSubtract(mean, s->work->end[b].position, s->bodies[b]->position);
        keaScale(mean, 1 / s->parameters.stepsize, mean);
    }
    keaSubtract(dv, s->predicted[b].lin, s->bodies[b]->velocity);
    keaSubtract(dL, s->work->body[b].freeMomentum, s->bodies[b]->angularMomentum);
    return keaDot(dv, mean) / s->bodies[b]->invMass + keaDot(dL, u + 3);
}

/* J: the work of springs, motors, moving surfaces and moving attachments in the step. */
static double workOfRows(const MdtKeaSystem *s) {
    double sum = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        const MeBool isMotor = row->contact < 0 && !row->position, isFriction = row->contact >= 0 && row->contact != i;
        const double rate = isMotor ? kea_meanRate(s, i) : isFriction ? row->target : row->drift;
        if (isMotor || rate != 0)
            sum += s->work->problem.row[i].p * rate;
    }
    return sum;
}

double kea_energyAllowed(const MdtKeaSystem *s) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++)
        sum += startEnergy(s, b) + workOfLoads(s, b);
    return sum + workOfRows(s);
}

/* ---- correction of errors ---- */

/* m/s: the speed at which the largest position error of a joint is corrected; withContacts: of a joint or contact. */
static double speedOfCorrection(const MdtKeaSystem *s, MeBool withContacts) {
    double speed = 0;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->position || (withContacts && row->contact == i))
            speed = keaMax(speed, kea_pushSpeed(s, row, row->target - row->drift));
    }
    return speed;
}

double kea_energyOfCorrection(const MdtKeaSystem *s) {
    const double speed = speedOfCorrection(s, MEFALSE);
    double mass = 0;
    for (int b = 0; b < s->numBodies; b++)
        mass += 1 / s->bodies[b]->invMass;
    return 0.5 * mass * speed * speed;
}

/* J: an upper bound of the work that the correction of errors does against loads: the momentum given by the loads times
 * the speed of the correction. */
static double workOfCorrection(const MdtKeaSystem *s) {
    double momentum = 0;
    for (int b = 0; b < s->numBodies; b++) {
        double dv[3];
        keaSubtract(dv, s->predicted[b].lin, s->bodies[b]->velocity);
        momentum += keaLength(dv) / s->bodies[b]->invMass;
    }
    return momentum * speedOfCorrection(s, METRUE);
}

MeBool kea_limitDisplacements(const MdtKeaSystem *s) {
    double start = workOfCorrection(s), work = workOfRows(s);
    for (int b = 0; b < s->numBodies; b++)
        if (!s->work->body[b].isFree) {
            start += startEnergy(s, b);
            work += workOfLoads(s, b);
        }
    if (!(start + work < 0))
        return MEFALSE;
    const double share = start / -work;
    MEASSERT(share >= 0 && share < 1);
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6 && !s->work->body[b].isFree; k++)
            s->work->body[b].u[k] *= share;
    return METRUE;
}

/* ---- interpolation ---- */

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
    for (int b = 0; b < s->work->problem.numBodies; b++) {
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

/* ---- scaling ---- */

/* J: energy of the bodies that no row acts on, which are not scaled. */
static double freeEnergy(const MdtKeaSystem *s, double (*velocity)[6]) {
    double sum = 0;
    for (int b = 0; b < s->numBodies; b++)
        if (s->work->body[b].isFree)
            sum += kea_energyOf(&s->work->problem.metric[b], velocity[b], velocity[b]);
    return sum;
}

/* J: the scale of the rounding of kea_kineticEnergy, whose terms cancel for a needle that spins about its own axis. */
static double largestTerms(const MdtKeaSystem *s, double (*velocity)[6]) {
    double sum = 0;
    for (int b = 0; b < s->work->problem.numBodies; b++) {
        const KeaMetric *B = &s->work->problem.metric[b];
        const double *v = velocity[b], *w = v + 3;
        sum += B->linear * keaDot(v, v) + (B->angular[0][0] + B->angular[1][1] + B->angular[2][2]) * keaDot(w, w);
    }
    return 0.5 * sum;
}

/* Whether a row acts between a body and the world. */
static MeBool isWorldActing(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (!s->work->problem.row[i].isInactive && (s->rows[i].body[0] < 0 || s->rows[i].body[1] < 0))
            return METRUE;
    return MEFALSE;
}

/* The common velocity of the bodies that are not free, which nothing but the world changes: 0 if that acts or locks
 * axes. Returns its energy, J. */
static double commonVelocity(const MdtKeaSystem *s, double (*velocity)[6], double common[3]) {
    double mass = 0;
    keaZero(common);
    if (s->work->hasLocks || isWorldActing(s))
        return 0;
    for (int b = 0; b < s->numBodies; b++)
        if (!s->work->body[b].isFree) {
            mass += 1 / s->bodies[b]->invMass;
            keaAddScaled(common, 1 / s->bodies[b]->invMass, velocity[b]);
        }
    keaScale(common, mass > 0 ? 1 / mass : 0, common);
    return 0.5 * mass * keaDot(common, common);
}

MeBool kea_scaleVelocities(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]) {
    double common[3];
    const double energy = kea_kineticEnergy(s, velocity, NULL);
    if (energy <= allowed)
        return MEFALSE;
    const double kept = freeEnergy(s, velocity) + commonVelocity(s, velocity, common);
    if (!(energy > kept)) /* nothing but free bodies moves */
        return MEFALSE;
    const double less = sqrt(keaMax(allowed - kept, 0) / (energy - kept)) - 1;
    MEASSERT(!(less < -1) && !(less > 0));
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            change[b][k] = s->work->body[b].isFree ? 0 : less * (velocity[b][k] - (k < 3 ? common[k] : 0));
    MEASSERT(!(kea_kineticEnergy(s, velocity, change) >
               keaMax(allowed, kept) + kea_assertedRounding * energy + kea_energyRounding * largestTerms(s, velocity)));
    return METRUE;
}
