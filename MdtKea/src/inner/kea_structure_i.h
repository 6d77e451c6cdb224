/* Inside Kea: the record of a sparse factor (kea_factor_i.h). Its structure (symbolic phase) belongs to a graph and is
 * kept in the cache. Its numbers belong to one matrix, from kea_factorClear to kea_factorSolve: factors share their
 * memory. The `turn' of a node is its index in the order of elimination. */
#ifndef KEA_STRUCTURE_I_H
#define KEA_STRUCTURE_I_H

#include "common/kea_arena_i.h"
#include "inner/kea_factor_i.h"
#include "inner/kea_order_i.h"

/* A block of a column below its diagonal. */
typedef struct KeaFactorEntry {
    size_t at;   /* offset of the block in upper and lower */
    int row;     /* turn of the row's node */
    int edge;    /* edge of the graph; -1: fill-in */
    MeBool flip; /* A_ij of the edge is the lower block */
} KeaFactorEntry;

/* An earlier column, with the index `turn`, that updates another column by its block `entry`. */
typedef struct KeaFactorSource {
    int turn, entry;
} KeaFactorSource;

/* The shared memory of the numbers of all factors, and the factor that uses it at present. */
typedef struct KeaNumbers {
    KeaBlock block;
    const KeaFactor *owner;
} KeaNumbers;

struct KeaFactor {
    int numNodes, numEdges, numEntries;
    double flops;
    size_t diagonalSize, inputSize, factorSize; /* numbers of doubles: of diagonal, of upperInput, of upper */
    /* structure, in one block of memory */
    int *size, *offset; /* by node: unknowns; index of the first one in vectors, and at the end their number */
    int (*edges)[2];
    int *node;             /* by turn */
    int *start;            /* by turn, and one more: */
    KeaFactorEntry *entry; /* entry[start[t] .. start[t + 1]), ascending rows */
    int *sourceStart;
    KeaFactorSource *source; /* of turn t: source[sourceStart[t] .. sourceStart[t + 1]), ascending turns */
    size_t *diagonalAt;      /* by node */
    size_t *edgeAt;          /* by edge */
    /* numbers, laid out when the factor acquires their memory */
    KeaNumbers *numbers;
    double *diagonal, *upperInput, *lowerInput; /* the blocks of the matrix */
    double *pivot;                              /* by node: the factors of the diagonal block */
    double *upper, *lower;                      /* the blocks of the factors; `lower` is transposed */
    int *exchange;                              /* by unknown: the row exchanges within a block */
    int *place;                                 /* by turn: the entry of this row in the column that is computed */
    MeBool isSymmetric;
};

/* The numeric operations, compiled once for each width of registers that a machine may have (kea_factor_kernel_i.h). */
typedef struct KeaFactorKernel {
    MeBool (*factorize)(KeaFactor *f, double min);
    void (*solve)(const KeaFactor *f, double x[]);
    void (*invert)(KeaFactor *f);
    void (*solveInverted)(const KeaFactor *f, double x[]);
    void (*addRows)(KeaFactor *f, const KeaFactorRows *rows, MeBool isSymmetric);
} KeaFactorKernel;

extern const KeaFactorKernel kea_factorKernel;
#ifdef KEA_HAS_AVX2
extern const KeaFactorKernel kea_factorKernelAvx2;
#endif

/* Computes the sizes and the work of the factor of a graph. Returns the bytes of its structure. */
size_t kea_structurePlan(KeaFactor *f, const KeaOrder *o, const int size[], int numEdges, const int (*edges)[2]);
/* Writes the planned structure to `memory`. */
void kea_structureWrite(KeaFactor *f, char *memory, const KeaOrder *o, const int size[], const int (*edges)[2]);
/* Set the pointers to the structure, or to the numbers, in `memory`; null: only measure. Return their bytes. */
size_t kea_structureLayOut(KeaFactor *f, char *memory);
size_t kea_structureLayOutNumbers(KeaFactor *f, char *memory);

#endif
