/* Time reversal, for composition schemes, in which some steps go back in time.
 *
 * The scheme of kea_scheme.c with θ = 1/2 is symmetric: a step, followed by one with reversed velocities, returns to
 * the start. Not symmetric are terms that depend on one end of the step only (velocity rows, bounds, damping, θ = 1,
 * gamma, compliance), and driven joints, whose velocities are not reversed. A step back in time is computed as a step
 * forward of the system with reversed velocities, so that the step length is always positive.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"

/* Whether free motion of the body is reversible: false with damping, and for different moments without Coriolis
 * term. */
static MeBool isBodyReversible(const MdtKeaBody *body) {
    return body->damping[0] == 0 && body->damping[1] == 0 &&
           (!kea_isSteady(body) || kea_hasEqualMoments(body->moments));
}

/* Whether the row depends symmetrically on both ends of the step: joints without bounds and compliance, springs without
 * damping. */
static MeBool isRowReversible(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (row->isTail)
        return METRUE;
    if (row->contact >= 0 || row->normal >= 0 || row->lower > -HUGE_VAL || row->upper < HUGE_VAL)
        return MEFALSE;
    if (row->spring)
        return row->damping == 0 && row->target == 0 && !kea_isBackward(s, row);
    return row->position && row->drift == 0 && row->softness == 0;
}

MeBool MEAPI MdtKeaIsReversible(const MdtKeaSystem *s) {
    if (s->numManifolds > 0 || s->parameters.timed)
        return MEFALSE;
    for (int i = 0; i < s->numBodies; i++)
        if (!isBodyReversible(s->bodies[i]))
            return MEFALSE;
    for (int i = 0; i < s->numRows; i++)
        if (!isRowReversible(s, &s->rows[i]))
            return MEFALSE;
    return METRUE;
}

MeBool MEAPI MdtKeaTurnsTooFar(const MdtKeaSystem *s, double step) {
    for (int i = 0; i < s->numBodies; i++) {
        double w[3];
        MdtKeaBodyGetAngularVelocity(s->bodies[i], w);
        if (kea_turnsFar(s->bodies[i]->moments, step * keaLength(w), kea_farTurn))
            return METRUE;
    }
    return MEFALSE;
}

void MEAPI MdtKeaReverse(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++) {
        keaScale(s->bodies[i]->velocity, -1, s->bodies[i]->velocity);
        keaScale(s->bodies[i]->angularMomentum, -1, s->bodies[i]->angularMomentum);
    }
}
