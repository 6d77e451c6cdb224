/* The matrix of a sparse factor, and calls of the kernel for this machine (kea_factor_kernel_i.h). */
#include "MeAssert.h"
#include "common/kea_machine_i.h"
#include "inner/kea_structure_i.h"
#include <string.h>

static const KeaFactorKernel *kernelOfMachine(void) {
#ifdef KEA_HAS_AVX2
    if (kea_machineHasAvx2())
        return &kea_factorKernelAvx2;
#endif
    return &kea_factorKernel;
}

/* ---- the graph ---- */

MeBool kea_factorMatches(const KeaFactor *f, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    return f->numNodes == numNodes && f->numEdges == numEdges &&
           memcmp(f->size, size, (size_t)numNodes * sizeof(int)) == 0 &&
           (numEdges == 0 || memcmp(f->edges, edges, (size_t)numEdges * sizeof *edges) == 0);
}

int kea_factorOffset(const KeaFactor *f, int node) {
    MEASSERT(node >= 0 && node <= f->numNodes);
    return f->offset[node];
}

double kea_factorFlops(const KeaFactor *f) {
    return f->flops;
}

size_t kea_factorEntries(const KeaFactor *f) {
    return f->diagonalSize + f->factorSize;
}

/* ---- the matrix ---- */

size_t kea_factorNumbersSize(const KeaFactor *f) {
    KeaFactor plan = *f;
    return kea_structureLayOutNumbers(&plan, NULL);
}

void kea_factorUseNumbers(KeaFactor *f, char *memory) {
    kea_structureLayOutNumbers(f, memory);
    f->numbers->owner = f;
}

void kea_factorClear(KeaFactor *f) {
    kea_factorClearIn(f, f->numbers->block.memory);
}

void kea_factorClearIn(KeaFactor *f, char *memory) {
    kea_factorUseNumbers(f, memory);
    memset(f->diagonal, 0, f->diagonalSize * sizeof(double));
    memset(f->upperInput, 0, f->inputSize * sizeof(double));
    memset(f->lowerInput, 0, f->inputSize * sizeof(double));
}

double *kea_factorDiagonal(KeaFactor *f, int node) {
    MEASSERT(node >= 0 && node < f->numNodes);
    return f->diagonal + f->diagonalAt[node];
}

double *kea_factorUpper(KeaFactor *f, int edge) {
    MEASSERT(edge >= 0 && edge < f->numEdges);
    return f->upperInput + f->edgeAt[edge];
}

/* ---- factorization and solution ---- */

void kea_factorAddRows(KeaFactor *f, const KeaFactorRows *rows, MeBool isSymmetric) {
    MEASSERT(rows->count <= KEA_FACTOR_ROWS && rows->node[0] < f->numNodes && rows->node[1] < f->numNodes);
    MEASSERT(rows->edge >= 0 || rows->node[0] < 0 || rows->node[1] < 0);
    kernelOfMachine()->addRows(f, rows, isSymmetric);
}

MeBool kea_factorCholesky(KeaFactor *f, double min) {
    f->isSymmetric = METRUE;
    return kernelOfMachine()->factorize(f, min);
}

MeBool kea_factorLU(KeaFactor *f, double min) {
    f->isSymmetric = MEFALSE;
    return kernelOfMachine()->factorize(f, min);
}

void kea_factorSolve(const KeaFactor *f, double x[]) {
    MEASSERT(f->numbers->owner == f);
    kernelOfMachine()->solve(f, x);
}

void kea_factorInvert(KeaFactor *f) {
    MEASSERT(f->numbers->owner == f && f->isSymmetric);
    kernelOfMachine()->invert(f);
}

void kea_factorSolveInverted(const KeaFactor *f, double x[]) {
    MEASSERT(f->numbers->owner == f);
    kernelOfMachine()->solveInverted(f, x);
}
