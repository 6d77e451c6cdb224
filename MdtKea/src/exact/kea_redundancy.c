/* How redundant joints share their load.
 *
 * Where joints make a loop, Jᵀ has a null space. The null-space part of p is arbitrary, and where the joints
 * contradict each other by as little as rounding, it grows from step to step. The smallest is taken, reported, and
 * kept as the next warm start:
 *
 *     min 1/2 Σ p_i² / w_i,  Jᵀ p = f:    p = W J y,   (Jᵀ W J + δ B) y = f,
 *
 * w the inverse of the row's A_ii without lever arms, B the metric, δ what rounding needs.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include <string.h>

static int rootOf(int parent[], int i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* A union-find over the bodies and the world, behind the last of them. Stops make no loop: they let go. */
MeBool kea_hasLoops(const MdtKeaSystem *s) {
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
        const int a = rootOf(parent, row->body[0] < 0 ? s->numBodies : row->body[0]);
        const int b = rootOf(parent, row->body[1] < 0 ? s->numBodies : row->body[1]);
        if (a == b)
            return METRUE;
        parent[a] = b;
    }
    return MEFALSE;
}

/* Rigid joints only: what is bounded or soft has found its value. */
static MeBool isRigidJoint(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    return row->position && row->softness == 0 && row->lower == -HUGE_VAL && row->upper == HUGE_VAL &&
           !s->work->problem.row[i].isOff;
}

static double weightOf(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double sum = 0;
    for (int k = 0; k < 2; k++)
        if (p->body[k] >= 0)
            sum += s->bodies[p->body[k]]->invMass * keaDot(p->J[k], p->J[k]);
    return 1 / (sum > 0 ? sum : p->size);
}

static void setProblem(MdtKeaSystem *s) {
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
        p->isOff = !isRigidJoint(s, i);
        if (p->isOff)
            continue;
        for (int k = 0; k < 2; k++)
            for (int c = 0; c < 6 && p->body[k] >= 0; c++)
                q->load[p->body[k]][c] -= p->p * p->J[k][c];
        p->E = 0;
        p->N = 1 / weightOf(s, i);
        p->r = p->p0 = 0;
        p->state = KEA_HELD;
    }
}

/* The problem's own equations, B d + g = Jᵀ p and p = -J d / N, are these with g = -f and d = -y. */
void kea_shareForces(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    const MeBool hadBounds = q->hasBounds;
    if (!s->work->hasLoops || !kea_problemHasBudget(q, MEFALSE))
        return; /* forces that do the same are as good */
    for (int i = 0; i < s->numRows; i++)
        s->work->keptP[i] = q->row[i].p;
    setProblem(s);
    for (int i = 0; i < s->numRows; i++)
        if (q->row[i].isOff)
            q->row[i].p = 0;
    q->hasBounds = MEFALSE;
    const MeBool isSolved = kea_problemSolve(q, MEFALSE);
    q->hasBounds = hadBounds;
    for (int i = 0; i < s->numRows; i++)
        if (!isSolved || q->row[i].isOff)
            q->row[i].p = s->work->keptP[i];
        else
            q->row[i].p = -q->row[i].p;
}
