/* Impulses of redundant joints: the solution of least norm.
 *
 * If joints form a loop, Jᵀ has a null space. The component of p in it is arbitrary, and grows from step to step if the
 * joints contradict each other, even if only by rounding: the forces on a door of 1 kg that turns on two hinges 1e-6 m
 * apart, with epsilon 0, are 1.7e4 N with this correction; without it 7e6 N after 300 steps and 5e11 N after 20 000
 * (Mdt_Hinge: hinges_that_contradict_each_other_do_not_build_up_forces). The p of least weighted norm is reported and
 * kept as the next warm start:
 *
 *     min 1/2 Σ p_i² / w_i,  Jᵀ p = f:    p = W J y,   (Jᵀ W J + δ B) y = f,
 *
 * with w the inverse of the row's A_ii without lever arms, f the resultant on the bodies, B the metric, and δ a
 * regularization.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

/* Union-find over the bodies and the world, whose index is numBodies. Rows that may reach a bound, such as stops, do
 * not count. */
MeBool kea_hasLoops(const MdtKeaSystem *s) {
    if (s->work->hasLocks) /* as if joints tied the body to the world */
        return METRUE;
    int *parent = s->work->parent, owner = 0;
    MeBool isFirst = METRUE;
    for (int i = 0; i <= s->numBodies; i++)
        parent[i] = i;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (!row->position || kea_mayReachBound(row) || (!isFirst && row->owner == owner))
            continue;
        owner = row->owner;
        isFirst = MEFALSE;
        if (!kea_unite(parent, row->body[0] < 0 ? s->numBodies : row->body[0],
                       row->body[1] < 0 ? s->numBodies : row->body[1]))
            return METRUE;
    }
    return MEFALSE;
}

/* Whether row i can be redundant: only rigid joints are, since the impulse of a bounded or soft row is unique. */
static MeBool isRigidJoint(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    return row->position && row->softness == 0 && row->lower == -HUGE_VAL && row->upper == HUGE_VAL &&
           !s->work->problem.row[i].isInactive;
}

/* kg: the weight w of row i. */
static double weightOf(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double sum = 0;
    for (int k = 0; k < 2; k++)
        if (p->body[k] >= 0)
            sum += s->bodies[p->body[k]]->invMass * keaDot(p->J[k], p->J[k]);
    MEASSERT(sum > 0 || p->Aii > 0);
    return 1 / (sum > 0 ? sum : p->Aii);
}

/* Sets the inner problem of the smallest impulses; rows that cannot be redundant are inactive. */
static void setRedundancyProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int b = 0; b < s->numBodies; b++) {
        KeaMetric *B = &q->metric[b];
        B->linear *= kea_redundancyRegularization;
        for (int k = 0; k < 9; k++)
            B->angular[k / 3][k % 3] *= kea_redundancyRegularization;
        memset(q->load[b], 0, sizeof q->load[b]);
    }
    for (int i = 0; i < s->numRows; i++) {
        KeaProblemRow *p = &q->row[i];
        p->isInactive = !isRigidJoint(s, i);
        if (p->isInactive)
            continue;
        kea_addRowForce(q->load, p, -p->p);
        p->E = 0;
        p->N = 1 / weightOf(s, i);
        p->r = p->p0 = 0;
        p->state = KEA_ACTIVE;
    }
}

/* The smallest impulses are the solution of an inner problem, B d + g = Jᵀ p with p = -J d / N, g = -f and d = -y. */
void kea_minimizeRedundantForces(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    const MeBool hadBounds = q->hasBounds;
    if (!s->work->hasLoops || !kea_problemHasBudget(q, MEFALSE))
        return; /* all solutions have the same effect on the bodies */
    kea_saveImpulses(s);
    setRedundancyProblem(s);
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].isInactive)
            q->row[i].p = 0;
    q->hasBounds = MEFALSE;
    const MeBool isSolved = kea_problemSolve(q, MEFALSE);
    q->hasBounds = hadBounds;
    for (int i = 0; i < s->numRows; i++)
        if (!isSolved || q->row[i].isInactive)
            q->row[i].p = s->work->savedP[i];
        else
            q->row[i].p = -q->row[i].p;
}
