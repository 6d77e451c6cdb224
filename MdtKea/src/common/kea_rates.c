/* What is asked of rows by whoever solves them: their rates, and whether they may reach a bound. */
#include "kea_i.h"
#include "common/kea_policy_i.h"

MeBool kea_mayReachBound(const MdtKeaRow *row) {
    if (row->lower == -HUGE_VAL || row->upper == HUGE_VAL)
        return row->lower > -HUGE_VAL || row->upper < HUGE_VAL;
    return row->force > kea_nearBound * row->upper || row->force < kea_nearBound * row->lower;
}

double kea_endRate(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double rate = s->work->ahead[i];
    for (int k = 0; k < 2; k++) {
        if (p->body[k] < 0)
            continue;
        const double *v = s->work->body[p->body[k]].endVelocity;
        rate += keaDot(p->J[k], v) + keaDot(p->J[k] + 3, v + 3);
    }
    return rate;
}

double kea_meanRate(const MdtKeaSystem *s, int i) {
    const KeaProblemRow *p = &s->work->problem.row[i];
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        if (p->body[k] < 0)
            continue;
        const double *u = s->work->body[p->body[k]].u;
        rate += keaDot(p->J[k], u) + keaDot(p->J[k] + 3, u + 3);
    }
    return rate;
}
