/* Kinetic energy and its limiter: neither rebounds nor answers that have not converged may add energy.
 *
 * The change of velocity with restitution (elastic) may add too much energy, the one without (plastic) does not. The
 * limiter interpolates between them: E(v + plastic + a (elastic - plastic)) is quadratic in a, and the largest a in
 * [0, 1] with E <= allowed is a root. Without a plastic answer, all velocities are scaled.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

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

/* J: the work of the loads on body b along a motion v. */
static double workAlong(const MdtKeaSystem *s, int b, const double v[6]) {
    double dv[3], dL[3];
    keaSubtract(dv, s->predicted[b].lin, s->bodies[b]->velocity);
    keaSubtract(dL, s->work->body[b].freeMomentum, s->bodies[b]->angularMomentum);
    return keaDot(dv, v) / s->bodies[b]->invMass + keaDot(dL, v + 3);
}

/* J: the work of the loads on body b in the step: with u, by which jointed bodies move, or along the displacement of
 * others, which do not move by u. */
static double workOfLoads(const MdtKeaSystem *s, int b) {
    double mean[6];
    memcpy(mean, s->work->body[b].u, sizeof mean);
    if (!s->work->body[b].isTied) {
        keaSubtract(mean, s->work->end[b].position, s->bodies[b]->position);
        keaScale(mean, 1 / s->parameters.stepsize, mean);
    }
    return workAlong(s, b, mean);
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

/* ---- the common motion ---- */

/* The motion of all bodies that are not free as one rigid body, which rows between them do not change: momentum and
 * angular momentum are its own. */
typedef struct CommonMotion {
    double centre[3], velocity[3], spin[3];
} CommonMotion;

/* Whether a row acts between a body and the world. */
static MeBool isWorldActing(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (!s->work->problem.row[i].isInactive && (s->rows[i].body[0] < 0 || s->rows[i].body[1] < 0))
            return METRUE;
    return MEFALSE;
}

/* Sets centre and velocity. Returns the mass, kg. */
static double findCentre(const MdtKeaSystem *s, double (*velocity)[6], CommonMotion *c) {
    double mass = 0;
    for (int b = 0; b < s->numBodies; b++) {
        const double m = s->work->body[b].isFree ? 0 : 1 / s->bodies[b]->invMass;
        keaAddScaled(c->centre, m, s->work->end[b].position);
        keaAddScaled(c->velocity, m, velocity[b]);
        mass += m;
    }
    keaScale(c->centre, mass > 0 ? 1 / mass : 0, c->centre);
    keaScale(c->velocity, mass > 0 ? 1 / mass : 0, c->velocity);
    return mass;
}

/* Adds a body's inertia and angular momentum about the centre. */
static void addBody(const MdtKeaSystem *s, int b, const CommonMotion *c, const double velocity[6], double inertia[3][3],
                    double momentum[3]) {
    const double m = 1 / s->bodies[b]->invMass;
    const double(*const own)[3] = (const double(*)[3])s->work->problem.metric[b].angular;
    double arm[3], orbit[3], spin[3];
    keaSubtract(arm, s->work->end[b].position, c->centre);
    for (int k = 0; k < 9; k++)
        inertia[k / 3][k % 3] += own[k / 3][k % 3] - m * arm[k / 3] * arm[k % 3];
    for (int k = 0; k < 3; k++)
        inertia[k][k] += m * keaDot(arm, arm);
    keaCross(orbit, arm, velocity);
    keaApply(spin, own, velocity + 3);
    keaAddScaled(momentum, m, orbit);
    keaAddScaled(momentum, 1, spin);
}

/* At the end positions; no motion if the world acts or locks axes. */
static CommonMotion commonMotion(const MdtKeaSystem *s, double (*velocity)[6]) {
    CommonMotion c = {.spin = {0}};
    double inertia[3][3] = {{0}}, momentum[3] = {0}, inverse[3][3];
    if (s->work->hasLocks || isWorldActing(s))
        return c;
    if (!(findCentre(s, velocity, &c) > 0))
        return c;
    for (int b = 0; b < s->numBodies; b++)
        if (!s->work->body[b].isFree)
            addBody(s, b, &c, velocity[b], inertia, momentum);
    kea_invert(inverse, (const double(*)[3])inertia);
    keaApply(c.spin, (const double(*)[3])inverse, momentum);
    return c;
}

/* The velocity of body b in that motion. */
static void shareOf(const MdtKeaSystem *s, const CommonMotion *c, int b, double v[6]) {
    double arm[3], turn[3];
    keaSubtract(arm, s->work->end[b].position, c->centre);
    keaCross(turn, c->spin, arm);
    keaCopy(v, c->velocity);
    keaAddScaled(v, 1, turn);
    keaCopy(v + 3, c->spin);
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

/* The common velocity of the displacements, without the rotation: the mean of those at the start and after the loads,
 * as u of an answer that has not converged does not keep it. Writes its energy at the start, J. */
static CommonMotion commonDisplacement(const MdtKeaSystem *s, double *energy) {
    CommonMotion c = {.spin = {0}}, after = c;
    *energy = 0;
    if (s->work->hasLocks || isWorldActing(s))
        return c;
    for (int b = 0; b < s->numBodies; b++)
        keaCopy(s->work->velocity[b], s->bodies[b]->velocity);
    const double mass = findCentre(s, s->work->velocity, &c);
    *energy = 0.5 * mass * keaDot(c.velocity, c.velocity);
    for (int b = 0; b < s->numBodies; b++)
        keaCopy(s->work->velocity[b], s->predicted[b].lin);
    findCentre(s, s->work->velocity, &after);
    keaAddScaled(c.velocity, 1, after.velocity);
    keaScale(c.velocity, 0.5, c.velocity);
    return c;
}

MeBool kea_limitDisplacements(const MdtKeaSystem *s) {
    double energy, common[6];
    const CommonMotion c = commonDisplacement(s, &energy);
    double start = workOfCorrection(s) - energy, work = workOfRows(s);
    for (int b = 0; b < s->numBodies; b++)
        if (!s->work->body[b].isFree) {
            shareOf(s, &c, b, common);
            start += startEnergy(s, b);
            work += workOfLoads(s, b) - workAlong(s, b, common);
        }
    start = keaMax(start, 0);
    if (!(start + work < 0))
        return MEFALSE;
    const double share = start / -work;
    MEASSERT(share >= 0 && share < 1);
    for (int b = 0; b < s->numBodies; b++) {
        double *u = s->work->body[b].u;
        shareOf(s, &c, b, common);
        for (int k = 0; k < 6 && !s->work->body[b].isFree; k++)
            u[k] = common[k] + share * (u[k] - common[k]);
    }
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

/* Sets `change` to what leaves only the common motion of the bodies that are not free. Returns its energy with that of
 * the free bodies, J. */
static double changeToCommon(const MdtKeaSystem *s, double (*velocity)[6], double (*change)[6]) {
    const CommonMotion c = commonMotion(s, velocity);
    for (int b = 0; b < s->numBodies; b++) {
        double common[6];
        shareOf(s, &c, b, common);
        for (int k = 0; k < 6; k++)
            change[b][k] = s->work->body[b].isFree ? 0 : common[k] - velocity[b][k];
    }
    return kea_kineticEnergy(s, velocity, change);
}

MeBool kea_scaleVelocities(const MdtKeaSystem *s, double (*velocity)[6], double allowed, double (*change)[6]) {
    const double energy = kea_kineticEnergy(s, velocity, NULL);
    if (energy <= allowed)
        return MEFALSE;
    const double kept = changeToCommon(s, velocity, change);
    if (!(energy > kept)) /* nothing but free bodies moves, or all move as one */
        return MEFALSE;
    const double less = 1 - sqrt(keaMax(allowed - kept, 0) / (energy - kept));
    MEASSERT(!(less < 0) && !(less > 1));
    for (int b = 0; b < s->numBodies; b++)
        for (int k = 0; k < 6; k++)
            change[b][k] *= less;
    MEASSERT(!(kea_kineticEnergy(s, velocity, change) >
               keaMax(allowed, kept) + kea_assertedRounding * energy + kea_energyRounding * largestTerms(s, velocity)));
    return METRUE;
}
