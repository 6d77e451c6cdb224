/* Inside Kea: functions that both methods for the coupled problem share (kea_newton.c, kea_states.c). */
#ifndef KEA_NEWTON_I_H
#define KEA_NEWTON_I_H

#include "inner/kea_problem_i.h"

/* 1/kg: E + N. */
static inline double softness(const KeaProblemRow *row) {
    return row->E + row->N;
}

/* kea_newtonSetUnclamped sets y, the impulses without bounds, of all rows at d + step * direction; kea_newtonClamp sets
 * p, y projected onto the bounds, and the states. */
void kea_newtonSetUnclamped(KeaProblem *q, double step);
void kea_newtonClamp(KeaProblem *q, MeBool coupled);
/* kea_newtonGradient sets the gradient at d with the present p; kea_newtonError that at d + step * direction, and
 * returns the largest norm of a body's gradient in tolerances, which allow for the rounding of r and J d. */
void kea_newtonGradient(KeaProblem *q);
double kea_newtonError(KeaProblem *q, double step);
/* Assembles the matrix H for the present states and factors it. False: singular. */
MeBool kea_newtonFactorize(KeaProblem *q, MeBool coupled);
/* kea_newtonDirection sets the Newton direction -H⁻¹ (gradient); kea_newtonApply adds step * direction to d. */
void kea_newtonDirection(KeaProblem *q);
void kea_newtonApply(KeaProblem *q, double step);
/* Solves the coupled problem, starting from d = 0 and the states that follow from p and r. False: the states do not
 * settle, the matrix is singular, or the budget is used up; d is then undefined. */
MeBool kea_statesSolve(KeaProblem *q);
/* kea_statesSolve with the factors of the last problem. False also if the states are not those that were factored. */
MeBool kea_statesRefine(KeaProblem *q);

#endif
