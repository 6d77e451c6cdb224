/* A part of a step by stages that together are of order 4 (MdtWorldSetIntegratorOrder).
 *
 * The step of joints alone is symmetric, but it is no map near the identity: the velocities' components along the
 * directions that joints hold change their sign at every step (kea_velocity.c). Two of them, each of h/2, are: their
 * expansion is that of a symmetric method of order 2, which has odd powers of h only, h³ first. Five such pairs,
 *
 *     (a, a, b, a, a) h,   a = 1/(4 - 4^(1/3)) = .4145,   b = 1 - 4 a = -.6579,   4 a³ + b³ = 0,
 *
 * have no term of h³ and, being symmetric too, none of h⁴ (Suzuki 1990; Hairer, Lubich and Wanner, Geometric Numerical
 * Integration, II.4). The triple jump has three pairs, and fifty times the error at a pendulum at 60 Hz; and it leaves
 * the step, by a third of its length, where this one stays within: it can be ended after any stage.
 *
 * Stages take joints for rigid, whatever epsilon: compliance looks at the end of a stage. The part of the errors that
 * gamma takes away is divided over the stages that go forward. The one that goes back is taken forward by the system
 * with its velocities turned round (MdtKeaReverse).
 *
 * Where a stage is not reversible (MdtKeaIsReversible), or is not solved to its end, the rest of the part is taken
 * without composition.
 */
#include "MeAssert.h"
#include "step/mdt_step_i.h"

/* Only for partitions without contacts; whether the joints are reversible is known when their rows are made. */
MeBool mdt_mayCompose(const MdtIsland *p) {
    return p->world->order == 4 && p->numJoints > 0 && p->numContacts == 0 && !p->isFast;
}

enum { STAGES = 5 };

/* One of two halves of a stage. False: it can not be reversed, or was not solved to its end. */
static MeBool advanceHalf(MdtIsland *p, double half) {
    mdt_substepMakeRows(p, half);
    if (!MdtKeaIsReversible(&p->kea))
        return MEFALSE;
    mdt_substepAdvanceRows(p, half, 0);
    return !p->isStopped && !p->kea.report.capped;
}

/* Returns whether the whole stage was taken, and solved to its end. */
static MeBool advanceStage(MdtIsland *p, double stage) {
    const double half = 0.5 * fabs(stage);
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

/* One composition, and what is left of the part where that comes to an end. */
static void advanceStages(MdtIsland *p, const double share[], double substep) {
    const double end = p->elapsed + substep, min = 1e-9 * substep;
    MeBool isDone = METRUE;
    for (int i = 0; i < STAGES && isDone; i++)
        isDone = advanceStage(p, share[i] * substep);
    if (isDone && p->report)
        mdt_reportComposed(p->report);
    if (!p->isStopped && end - p->elapsed > min)
        mdt_substepAdvance(p, end - p->elapsed, 0);
}

/* Where the motion is violent the whole composition is halved, not its stages: errors of order 3 cancel only among
 * stages of one composition. */
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
