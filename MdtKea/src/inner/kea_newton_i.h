/* Inside Kea: shared by the two methods for the coupled problem (kea_newton.c, kea_states.c). */
#ifndef KEA_NEWTON_I_H
#define KEA_NEWTON_I_H

#include "inner/kea_problem_i.h"

/* 1/kg: E + N. */
static inline double softness(const KeaProblemRow *row) {
    return row->E + row->N;
}

/* Sets y of all rows at d + step * direction, the impulses without bounds; clamps y to p, which gives the states. */
void kea_newtonSetUnclamped(KeaProblem *q, double step);
void kea_newtonClamp(KeaProblem *q, MeBool coupled);
/* The gradient at d with the present p; and at d + step * direction, with its largest norm in tolerances. */
void kea_newtonGradient(KeaProblem *q);
double kea_newtonError(KeaProblem *q, double step);
/* Assembles the matrix H for the present states and factors it. False: singular. */
MeBool kea_newtonFactorize(KeaProblem *q, MeBool coupled);
/* The Newton direction -H⁻¹ (gradient); d += step * direction. */
void kea_newtonDirection(KeaProblem *q);
void kea_newtonApply(KeaProblem *q, double step);
/* The coupled problem from d = 0 and the states that follow from p0 and r. False: the states do not settle, and d is of
 * no use. */
MeBool kea_statesSolve(KeaProblem *q);
/* The same with the factors of the last problem. */
MeBool kea_statesRefine(KeaProblem *q);

#endif
