/* Inside Kea: what the two ways to solve the coupled problem share (kea_newton.c, kea_states.c). */
#ifndef KEA_NEWTON_I_H
#define KEA_NEWTON_I_H

#include "inner/kea_problem_i.h"

/* 1/kg: the row's own, and the method's. */
static inline double softness(const KeaProblemRow *row) {
    return row->E + row->N;
}

/* y, p and states of all rows at d + step * along. */
void kea_newtonForces(KeaProblem *q, double step, MeBool coupled);
/* The gradient there with the p that there are, and by how much it is too large: 1 is what is tolerated. */
double kea_newtonError(KeaProblem *q, double step);
/* Fills the matrix, by states, and factors it. False: it is singular. */
MeBool kea_newtonFactorize(KeaProblem *q, MeBool coupled);
/* The step against the gradient, in `along`; and takes a part of it. */
void kea_newtonDirection(KeaProblem *q);
void kea_newtonTake(KeaProblem *q, double step);
/* The coupled problem from d = 0 and the states that p0 and r tell. False: those alternate, d is near or is not. */
MeBool kea_statesSolve(KeaProblem *q);
/* The same with the factors of the last problem. */
MeBool kea_statesRefine(KeaProblem *q);

#endif
