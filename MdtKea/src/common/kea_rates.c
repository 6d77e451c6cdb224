/* Rows: rates J v, length scales, whether bounds may be reached; saved Jacobians. */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

MeBool kea_mayReachBound(const MdtKeaRow *row) {
    if (row->lower == -HUGE_VAL || row->upper == HUGE_VAL)
        return row->lower > -HUGE_VAL || row->upper < HUGE_VAL;
    return row->force > 0.5 * row->upper || row->force < 0.5 * row->lower;
}

double kea_smallerExtent(const MdtKeaSystem *s, const int body[2]) {
    double size = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        if (body[k] >= 0)
            size = keaMin(size, s->work->body[body[k]].size);
    return size < HUGE_VAL ? size : 1; /* as above */
}

double kea_pushSpeed(const MdtKeaSystem *s, const MdtKeaRow *row, double speed) {
    const double pushed = row->lower >= 0 ? keaMax(speed, 0) : row->upper <= 0 ? keaMax(-speed, 0) : fabs(speed);
    return pushed * kea_lengthOf(s, row);
}

/* ---- the owner's functions ---- */

void kea_evaluateJacobians(MdtKeaSystem *s, const MdtKeaTransformation poses[], double share) {
    s->share = share;
    if (s->jacobians)
        s->jacobians(s->context, poses);
}

void kea_evaluateErrors(MdtKeaSystem *s, double errors[]) {
    s->share = 1;
    if (s->errors)
        s->errors(s->context, s->work->endPose, errors);
}

/* ---- Jacobians, saved and restored ---- */

void kea_saveJacobians(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        memcpy(s->work->savedJ[i], s->rows[i].J, sizeof s->rows[i].J);
}

void kea_restoreJacobians(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        memcpy(s->rows[i].J, s->work->savedJ[i], sizeof s->rows[i].J);
}

void kea_saveImpulses(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->work->savedP[i] = s->work->problem.row[i].p;
}

/* 1/kg: J M⁻¹ Jᵀ of a row. */
static double inverseMassOf(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double sum = 0, turn[3], J[2][6];
    for (int k = 0; k < 2; k++)
        kea_copyBlock(J[k], &row->J[k]);
    kea_lockRow(s, row->body, J);
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const MdtKeaInverseMassMatrix *m = &s->invMass[row->body[k]];
        keaApply(turn, m->inertia, J[k] + 3);
        sum += m->mass * keaDot(J[k], J[k]) + keaDot(turn, J[k] + 3);
    }
    return sum;
}

/* With κ = h² k / m and δ = h d / m, the rates of the motion, times h, are the roots of x² - δ x + κ. The larger one is
 * beyond 2 if κ > 4 or, of real roots, if the polynomial is negative at 2. */
MeBool kea_isBackward(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (row->backward || !row->spring)
        return row->backward;
    const double h = s->parameters.stepsize, perMass = row->mass > 0 ? 1 / row->mass : inverseMassOf(s, row);
    const double stiffness = h * h * row->stiffness * perMass, damping = h * row->damping * perMass;
    return stiffness > kea_stiffSpring || 2 * damping > kea_stiffSpring + stiffness;
}
