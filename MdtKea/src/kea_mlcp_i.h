/* The mixed linear complementarity problem of one partition, dense. See kea_mlcp.c. */
#ifndef KEA_MLCP_I_H
#define KEA_MLCP_I_H

#include "MePrecision.h"
#include "kea_arena_i.h"

typedef enum { KEA_FREE, KEA_LOWER, KEA_UPPER } KeaSet;

typedef struct KeaMlcp {
    /* the problem: find x with (A + E) x = b + w and the complementarity of w and the bounds */
    int n;
    const double *A; /* n x n, symmetric, by rows */
    double *E;       /* n, >= 0 */
    double *b;       /* n */
    double *lower;   /* n, -HUGE_VAL for none; lower <= upper */
    double *upper;   /* n,  HUGE_VAL for none */
    int maxIterations;

    /* the answer */
    double *x;   /* n */
    KeaSet *set; /* n: which x are free, which at a bound; kept as the start of the next solve */

    /* how it went, added up over solves */
    int pivots, factorizations;
    MeBool capped, regularized;

    /* workspace: everything scaled so that the diagonal of A + E is 1 */
    double *scale;  /* n: 1 / sqrt(A_ii + E_i); 0 for a row that nothing can move */
    double *factor; /* n x n: Cholesky factor of the free part */
    double *y, *previous, *rhs, *w, *from;
    int *index; /* n: the free rows */
    int numFree;
    double mobility;    /* the mean of A's diagonal */
    double *shift;      /* n: the regularization, of the scaled diagonal */
    double shiftFactor; /* by which all of it is multiplied in `factor` */
    MeBool factorValid;
} KeaMlcp;

/* Takes the vectors and the workspace for n rows out of the arena. */
void kea_mlcpInit(KeaMlcp *p, int n, const double *A, KeaArena *arena);

/* Scales the problem; to be called once when A, E are filled. All rows start free. */
void kea_mlcpBegin(KeaMlcp *p);

/* Takes over a new E, and a new row and column of A, for row i. The sets stay. */
void kea_mlcpRenew(KeaMlcp *p, int i);

/* Solves with the b and bounds now set, starting from the sets of the last solve. */
void kea_mlcpSolve(KeaMlcp *p);

#endif
