/* Inside Kea: sparse factorization of matrices of small dense blocks, whose structure is a graph.
 *
 * Node i of the graph has size[i] unknowns (1..KEA_FACTOR_MAX_BLOCK); an edge (i, j) means that the blocks A_ij and
 * A_ji are not zero. Kea uses it for bodies (6 unknowns each; edges are pairs of bodies that rows join) and for joints
 * (an unknown for each row; edges are shared bodies). The order of elimination and the structure of the factor depend
 * only on the graph; a cache computes them once and keeps them (kea_cacheFind). Numbers are filled in and factored
 * whenever they change.
 *
 * All factors of a cache share the memory of their numbers: kea_factorClear acquires it for one factor, until the next
 * call of kea_factorClear or kea_cacheFind.
 */
#ifndef KEA_FACTOR_I_H
#define KEA_FACTOR_I_H

#include "MePrecision.h"
#include <stddef.h>

enum { KEA_FACTOR_MAX_BLOCK = 12 };

struct MdtKeaCache;
typedef struct KeaFactor KeaFactor;

/* Finds the factor of a graph in the cache, or orders and analyses the graph. The cache owns the factor. Edges are
 * unique, with i != j, in any order; the result depends only on the graph (same graph, same bits). size null: 6 for
 * each node. The factor is valid until KEA_MAX_FACTORS other graphs have been requested. Null if there is no memory. */
KeaFactor *kea_cacheFind(struct MdtKeaCache *cache, int numNodes, const int size[], int numEdges,
                         const int (*edges)[2]);
/* Scratch memory of `bytes`, aligned to a cache line, in one of KEA_PASS_BLOCKS blocks. The next call for the same
 * block invalidates it. Null: no memory. */
enum { KEA_STEP_BLOCK, KEA_GROUP_BLOCK, KEA_JOINT_BLOCK, KEA_JOINT_FACTOR_BLOCK, KEA_PASS_BLOCKS };
void *kea_cacheScratch(struct MdtKeaCache *cache, int block, size_t bytes);
/* Whether f is the factor of this graph. */
MeBool kea_factorMatches(const KeaFactor *f, int numNodes, const int size[], int numEdges, const int (*edges)[2]);

/* Begins a matrix: sets all blocks to zero, in the memory that the factors of the cache share. */
void kea_factorClear(KeaFactor *f);
/* For several matrices at once, each in memory of the caller, of kea_factorNumbersSize bytes: kea_factorClearIn begins
 * a matrix there; kea_factorUseNumbers returns to a matrix after others of the cache were used. */
size_t kea_factorNumbersSize(const KeaFactor *f);
void kea_factorClearIn(KeaFactor *f, char *memory);
void kea_factorUseNumbers(KeaFactor *f, char *memory);
/* The blocks of the matrix, row-major, which callers add to. For an edge e = (i, j), `upper` is A_ij, size[i] rows by
 * size[j] columns. A_ji, which only kea_factorLU reads, is written by kea_factorAddRows. */
double *kea_factorDiagonal(KeaFactor *f, int node);
double *kea_factorUpper(KeaFactor *f, int edge);

/* Rows that join the same two nodes of six unknowns, or belong to one node: row i has the weight w_i and, for each
 * node, the vectors a_i and b_i. They are added together so that each block is loaded and stored once; the sums are the
 * same as one by one. A joint with its limits has up to eight rows; longer runs are added in pieces. */
enum { KEA_FACTOR_ROWS = 8 };
typedef struct KeaFactorRows {
    int node[2], edge; /* -1: none */
    MeBool isCross;    /* only the blocks of the edge */
    int count;
    double weight[KEA_FACTOR_ROWS];
    const double *a[2][KEA_FACTOR_ROWS], *b[2][KEA_FACTOR_ROWS];
} KeaFactorRows;

/* Appends a row, w aᵀ b, to the batch that kea_factorAddRows adds; a[k] and b[k] are its vectors for node k. The caller
 * ensures that there is room. */
static inline void kea_factorAppendRow(KeaFactorRows *rows, double weight, double (*const a)[6], double (*const b)[6]) {
    const int i = rows->count++;
    rows->weight[i] = weight;
    for (int k = 0; k < 2; k++) {
        rows->a[k][i] = a[k];
        rows->b[k][i] = b[k];
    }
}
/* Adds Σ w_i a_iᵀ b_i to the blocks of the nodes and of their edge, in the order of i; to `lower` only if not
 * isSymmetric. */
void kea_factorAddRows(KeaFactor *f, const KeaFactorRows *rows, MeBool isSymmetric);

/* The index of a node's first unknown in vectors; for numNodes, the number of all unknowns. */
int kea_factorOffset(const KeaFactor *f, int node);

/* Factors a symmetric matrix, A = L Lᵀ, from its diagonal blocks (upper triangles) and `upper`. False: A is not
 * positive definite in the arithmetic, as a pivot is below `min`, e.g. 1e-14, relative to its diagonal entry when the
 * elimination of its block began. The matrix itself is not overwritten, and may be changed and factored again. */
MeBool kea_factorCholesky(KeaFactor *f, double min);
/* Factors a matrix with symmetric structure but unsymmetric numbers, A = L U, with row exchanges within diagonal blocks
 * only, for which rows are scaled by their own diagonal entries. False: a pivot is below `min`, relative to these. */
MeBool kea_factorLU(KeaFactor *f, double min);
/* x := A⁻¹ x, by the last factorization. */
void kea_factorSolve(const KeaFactor *f, double x[]);

/* For many right sides: kea_factorInvert, after kea_factorCholesky, inverts the blocks of the factor; then
 * kea_factorSolveInverted gives x := A⁻¹ x in half of the time, and kea_factorSolve may no longer be called. It is less
 * accurate for nearly singular matrices. */
void kea_factorInvert(KeaFactor *f);
void kea_factorSolveInverted(const KeaFactor *f, double x[]);

/* Multiplications of one Cholesky factorization, and number of doubles of the factor: for choosing between two
 * graphs. */
double kea_factorFlops(const KeaFactor *f);
size_t kea_factorEntries(const KeaFactor *f);

#endif
