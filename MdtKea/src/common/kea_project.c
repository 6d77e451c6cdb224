/* Position projection (split impulse): reduces overlaps by displacing bodies, without changing velocities. */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* Whether row i is the normal row of a contact that overlaps at the end of the step. Writes the gap there, m, to
 * `error`. */
static MeBool isOverlapping(const MdtKeaSystem *s, int i, double *error) {
    const MdtKeaRow *row = &s->rows[i];
    *error = row->error + 0.5 * s->parameters.stepsize * (kea_startRate(s, i) + kea_endRate(s, i) - row->drift);
    return row->contact == i && !row->isOpen && *error < -kea_touchingGap * kea_smallerExtent(s, row->body);
}

/* m: the part of the correction that would remove the sag of a soft contact under its load, γ times the sag. */
static double correctedSlop(const MdtKeaSystem *s, int i) {
    return s->parameters.stepsize * s->rows[i].softness * s->work->problem.row[i].p;
}

MeBool kea_isRigidJoint(const MdtKeaRow *row) {
    return row->position && row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* Moves the end poses of all bodies by work->added. */
static void displaceBodies(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        KeaEnd *end = &s->work->end[b];
        double turn[4];
        keaAddScaled(end->position, 1, s->work->added[b]);
        keaQuaternionExp(turn, s->work->added[b] + 3);
        keaQuaternionProduct(end->quaternion, turn, end->quaternion);
        keaQuaternionNormalize(end->quaternion);
        keaCopy(s->work->endPose[b].pos, end->position);
        keaQuaternionToMatrix(s->work->endPose[b].R, end->quaternion);
    }
}

/* Three passes with N = 1e-5 A_ii, that of contacts after one good pass, leave 1e-15 of the error of a single row. With
 * 1e-6 Mst_Cases_Defaults fails in double precision: stacks_stand_by_default. */
void kea_solveInstant(MdtKeaSystem *s, const double target[]) {
    KeaProblem *q = &s->work->problem;
    memset(s->work->added, 0, (size_t)s->numBodies * sizeof *s->work->added);
    for (int i = 0; i < s->numRows; i++) {
        q->row[i].isInactive = !s->work->isIncluded[i];
        q->row[i].r = target[i];
    }
    for (int pass = 0; pass < 3 && !q->counts.isLimited; pass++) {
        for (int i = 0; i < s->numRows; i++)
            q->row[i].N = kea_proximalContact[1] * q->row[i].Aii;
        kea_problemSolve(q, MEFALSE);
        kea_problemAccumulate(q, s->work->added);
    }
}

/* Finds the smallest displacement, in the metric of masses, that removes the fraction γ of every overlap and makes none
 * deeper. */
void kea_projectPositions(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    double *target = s->work->target, error, max = 0;
    for (int i = 0; i < s->numRows; i++) {
        s->work->isIncluded[i] = (char)isOverlapping(s, i, &error);
        target[i] = s->work->isIncluded[i] ? keaMax(-s->parameters.gamma * error - correctedSlop(s, i), 0) : 0;
        max = keaMax(max, target[i]);
    }
    if (!(max > 0))
        return;
    kea_saveImpulses(s);
    for (int b = 0; b < s->numBodies; b++) {
        kea_setInstantBody(q, b, s->bodies[b]);
        q->scale[b] = q->metric[b].linear * max; /* kg m: of displacements */
    }
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        s->work->isIncluded[i] = (char)(kea_isRigidJoint(row) || (row->contact == i && !row->isOpen));
        kea_setInstantRow(s, i, &q->row[i]);
        q->row[i].isCheckedElsewhere = s->rows[i].contact != i;
    }
    kea_problemSetEffectiveMasses(q);
    kea_solveInstant(s, target);
    for (int i = 0; i < s->numRows; i++)
        q->row[i].p = s->work->savedP[i];
    displaceBodies(s);
}
