/* Stages of the integration scheme of order 4 (MdtWorldSetIntegratorOrder), for a part of a step.
 *
 * The step of joints alone is symmetric, but no map near the identity: the components of velocities along the
 * directions that joints constrain change their sign in every step (kea_velocity.c). Two steps of h/2 each are such a
 * map: their expansion is that of a symmetric method of order 2, with odd powers of h only, beginning with h³. Five
 * such pairs,
 *
 *     (a, a, b, a, a) h,   a = 1/(4 - 4^(1/3)) = .4145,   b = 1 - 4 a = -.6579,   4 a³ + b³ = 0,
 *
 * have no term of h³ and, being symmetric too, none of h⁴ (Suzuki 1990; Hairer, Lubich and Wanner, Geometric Numerical
 * Integration, II.4). The triple jump has three pairs, and fifty times the error with a pendulum at 60 Hz; it also goes
 * beyond the step by a third of its length, while this scheme stays within it and may be ended after any stage.
 *
 * In stages joints are rigid, whatever epsilon is, since compliance acts on the end of a stage. The relaxation by gamma
 * is divided among the forward stages. The backward stage is a forward one with all velocities reversed
 * (MdtKeaReverse).
 *
 * If a stage is not reversible (MdtKeaIsReversible), or its solve is inexact, the rest of the part is integrated with
 * order 2.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

/* Only for partitions without contacts. Whether the joints are reversible is known when their rows have been made. */
MeBool mdt_mayCompose(const MdtIsland *p) {
    if (p->world->order != 4 || p->numJoints == 0 || p->numContacts > 0 || p->isFast)
        return MEFALSE;
    for (int i = 0; i < p->numActing; i++)
        if (mdt_isCarried(p->acting[i])) /* its motion has no reverse */
            return MEFALSE;
    return METRUE;
}

enum { STAGES = 5 };

/* Advances by half of a stage. False if it is not reversible, or its solve is inexact. */
static MeBool advanceHalf(MdtIsland *p, double half) {
    mdt_substepMakeRows(p, half);
    if (!MdtKeaIsReversible(&p->kea))
        return MEFALSE;
    mdt_substepAdvanceRows(p, half, 0);
    return !p->isStopped && !p->kea.report.capped;
}

/* True if the whole stage was integrated, and its solves were exact. */
static MeBool advanceStage(MdtIsland *p, double stage) {
    const double half = 0.5 * fabs(stage);
    MEASSERT(half > 0);
    MEASSERT(p->stage == MDT_STAGE_NONE && p->kea.parameters.pair == MdtKeaPairNone);
    p->stage = stage < 0 ? MDT_STAGE_BACK : MDT_STAGE_FORWARD;
    p->kea.parameters.pair = MdtKeaPairFirst;
    if (stage < 0)
        MdtKeaReverse(&p->kea);
    const MeBool isDone = advanceHalf(p, half) && advanceHalf(p, half);
    if (stage < 0)
        MdtKeaReverse(&p->kea);
    p->stage = MDT_STAGE_NONE;
    p->kea.parameters.pair = MdtKeaPairNone;
    return isDone;
}

/* One composition; if it ends early, order 2 for the rest of the part. */
static void advanceStages(MdtIsland *p, const double share[], double substep) {
    const double end = p->elapsed + substep, min = 1e-9 * substep;
    MeBool isDone = METRUE;
    for (int i = 0; i < STAGES && isDone; i++)
        isDone = advanceStage(p, share[i] * substep);
    if (isDone && p->report)
        p->report->composed++;
    if (!p->isStopped && end - p->elapsed > min)
        mdt_substepAdvance(p, end - p->elapsed, 0);
}

/* If bodies would turn too far, the whole composition is halved, not its stages: errors of order 3 cancel only among
 * the stages of one composition. */
static void divideComposition(MdtIsland *p, const double share[], double substep, int halvings) {
    enum { MAX_HALVINGS_COMPOSED = 6 };
    if (halvings == MAX_HALVINGS_COMPOSED || !MdtKeaTurnsTooFar(&p->kea, 0.5 * fabs(share[STAGES / 2]) * substep)) {
        advanceStages(p, share, substep);
        return;
    }
    divideComposition(p, share, 0.5 * substep, halvings + 1);
    if (!p->isStopped)
        divideComposition(p, share, 0.5 * substep, halvings + 1);
}

void mdt_substepCompose(MdtIsland *p, double substep) {
    const double a = 1 / (4 - cbrt(4)), share[STAGES] = {a, a, 1 - 4 * a, a, a};
    p->forward = 4 * a;
    divideComposition(p, share, substep, 0);
}
