/* Inside Kea: a sparse factor as its files see it (kea_factor_i.h). The structure (symbolic phase) belongs to a graph
 * and is kept in the cache. The numbers belong to one matrix, from kea_factorClear to kea_factorSolve: factors share
 * their memory. */
#ifndef KEA_STRUCTURE_I_H
#define KEA_STRUCTURE_I_H

#include "common/kea_arena_i.h"
#include "inner/kea_factor_i.h"
#include "inner/kea_order_i.h"

typedef struct KeaFactorEntry {
    size_t at;   /* where the block is, in upper and lower */
    int row;     /* turn of the row's node */
    int edge;    /* of the graph; -1: fill-in */
    MeBool flip; /* A_ij of the edge is the lower block */
} KeaFactorEntry;

/* A column `turn` that updates another one, by the block at this entry of its own. */
typedef struct KeaFactorSource {
    int turn, entry;
} KeaFactorSource;

/* The memory of all factors' numbers, and the one that has it now. */
typedef struct KeaNumbers {
    KeaBlock block;
    const KeaFactor *owner;
} KeaNumbers;

struct KeaFactor {
    int numNodes, numEdges, numEntries;
    double flops;
    size_t diagonalSize, inputSize, factorSize; /* of the numbers */
    /* structure, in one block of memory */
    int *size, *offset; /* by node; the offset of one more */
    int (*edges)[2];
    int *node;             /* by turn */
    int *start;            /* by turn, and one more: */
    KeaFactorEntry *entry; /* entry[start[t] .. start[t + 1]), ascending rows */
    int *sourceStart;
    KeaFactorSource *source; /* of turn t: source[sourceStart[t] .. sourceStart[t + 1]), ascending turns */
    size_t *diagonalAt;      /* by node */
    size_t *edgeAt;          /* by edge */
    /* numbers, laid out when the factor takes their memory */
    KeaNumbers *numbers;
    double *diagonal, *upperInput, *lowerInput;
    double *pivot; /* by node: the factors of the diagonal block */
    double *upper, *lower;
    int *exchange; /* by unknown: the row exchanges within a block */
    int *place;    /* by turn: the entry of the column that is being made */
    MeBool isSymmetric;
};

/* Loops over the numbers, once for each width of registers that the machine may have (kea_factor_kernel_i.h). */
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

/* What the factor of a graph will need. Returns the bytes of its structure. */
size_t kea_structurePlan(KeaFactor *f, const KeaOrder *o, const int size[], int numEdges, const int (*edges)[2]);
/* Writes the structure that was planned. */
void kea_structureWrite(KeaFactor *f, char *memory, const KeaOrder *o, const int size[], const int (*edges)[2]);
/* Sets the pointers of a structure that was moved to `memory`. */
void kea_structureMove(KeaFactor *f, char *memory);
/* Lays the numbers out; with no memory it only measures. Returns their bytes. */
size_t kea_structureLayOutNumbers(KeaFactor *f, char *memory);

#endif
