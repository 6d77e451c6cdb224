/* Kicks: impulses at the start of a step, which joints transmit in the same instant. */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include <string.h>

static MeBool isKicked(const MdtKeaBody *b) {
    return keaDot(b->kick[0], b->kick[0]) + keaDot(b->kick[1], b->kick[1]) > 0;
}

MeBool MEAPI MdtKeaIsKicked(const MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++)
        if (isKicked(s->bodies[b]))
            return METRUE;
    return MEFALSE;
}

/* m/s, rad/s: the change of a body's velocity by its kick without joints. */
static void kickVelocityOf(const KeaMetric *B, const MdtKeaBody *b, double change[6]) {
    keaScale(change, 1 / B->linear, b->kick[0]);
    keaApply(change + 3, B->inverse, b->kick[1]);
}

/* Sets up the inner problem in which joints keep their rates. Contacts, stops and motors are left out. `kicked`: the
 * bodies' changes of velocity without joints. */
static void setKickProblem(MdtKeaSystem *s, double (*kicked)[6], double target[]) {
    KeaProblem *q = &s->work->problem;
    double max = 0;
    for (int b = 0; b < s->numBodies; b++) {
        kea_setInstantBody(q, b, s->bodies[b]);
        kickVelocityOf(&q->metric[b], s->bodies[b], kicked[b]);
        max = keaMax(max, keaLength(kicked[b]) + q->length[b] * keaLength(kicked[b] + 3));
    }
    for (int b = 0; b < s->numBodies; b++)
        q->scale[b] = q->metric[b].linear * max;
    for (int i = 0; i < s->numRows; i++) {
        kea_setInstantRow(s, i, &q->row[i]);
        s->work->isIncluded[i] = (char)kea_isRigidJoint(&s->rows[i]);
    }
    for (int i = 0; i < s->numRows; i++)
        target[i] = -kea_rowRate(&q->row[i], kicked);
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
}

/* Solves min 1/2 |d - d_0|²_M over the changes d of velocity that do not change the rates of joints; d_0 = M⁻¹ kick. */
void MEAPI MdtKeaKick(MdtKeaSystem *s) {
    double(*kicked)[6] = s->work->velocity;
    setKickProblem(s, kicked, s->work->target);
    const MeBool isShared = kea_problemBegin(&s->work->problem, s->cache);
    if (isShared) {
        kea_setBudget(s, 1, 1);
        kea_problemSetEffectiveMasses(&s->work->problem);
        kea_solveInstant(s, s->work->target);
        kea_reportWork(s);
    }
    for (int b = 0; b < s->numBodies; b++) {
        MdtKeaBody *body = s->bodies[b];
        double dL[3];
        for (int k = 0; k < 6 && isShared; k++)
            kicked[b][k] += s->work->added[b][k];
        keaApply(dL, (const double(*)[3])s->work->problem.metric[b].angular, kicked[b] + 3);
        keaAddScaled(body->velocity, 1, kicked[b]);
        keaAddScaled(body->angularMomentum, 1, dL);
        memset(body->kick, 0, sizeof body->kick);
    }
}
