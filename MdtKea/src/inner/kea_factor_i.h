/* Inside Kea: sparse factorization of matrices of small dense blocks, whose structure is a graph.
 *
 * Node i of the graph has size[i] unknowns (1..KEA_FACTOR_MAX_BLOCK); an edge (i, j) says that the blocks A_ij and A_ji
 * are not zero. Kea uses it for bodies (6 each, edges are rows that join two bodies) and for constraints (their rows,
 * edges are shared bodies). The order of elimination and the structure of the factor depend on the graph alone and are
 * found once, and kept, by a cache (kea_cacheFind); numbers are filled in and factored as often as they change.
 *
 * All factors of a cache share the memory of their numbers: kea_factorClear takes it for one factor, which has it until
 * the next call of kea_factorClear or kea_cacheFind.
 */
#ifndef KEA_FACTOR_I_H
#define KEA_FACTOR_I_H

#include "MePrecision.h"
#include <stddef.h>

enum { KEA_FACTOR_MAX_BLOCK = 12 };

struct MdtKeaCache;
typedef struct KeaFactor KeaFactor;

/* The factor of a graph, made if there is none: ordered and analysed; its memory is the cache's. Edges are unique, i !=
 * j, in any order; the result depends on nothing else (same graph, same bits). Sizes null: 6 of every node. The factor
 * is there until as many other graphs have come up as a cache keeps. Null when there is no memory. */
KeaFactor *kea_cacheFind(struct MdtKeaCache *cache, int numNodes, const int size[], int numEdges,
                         const int (*edges)[2]);
/* Scratch memory, aligned to KEA_SCRATCH_LINE, of one of KEA_PASS_BLOCKS; what it holds is lost when it is taken again.
 * Null: no memory. */
enum { KEA_STEP_BLOCK, KEA_GROUP_BLOCK, KEA_JOINT_BLOCK, KEA_JOINT_FACTOR_BLOCK, KEA_PASS_BLOCKS };
enum { KEA_SCRATCH_LINE = 64 };
void *kea_cacheScratch(struct MdtKeaCache *cache, int block, size_t bytes);
/* Whether f is the factor of this graph. */
MeBool kea_factorMatches(const KeaFactor *f, int numNodes, const int size[], int numEdges, const int (*edges)[2]);

/* Begins a matrix: sets all its blocks to zero, in the memory that the factors of the cache share. */
void kea_factorClear(KeaFactor *f);
/* For several matrices at once: the memory of each is the caller's, kea_factorNumbersSize bytes. kea_factorClearIn
 * begins a matrix there; kea_factorAllocateNumbers returns to one after others were used. */
size_t kea_factorNumbersSize(const KeaFactor *f);
void kea_factorClearIn(KeaFactor *f, char *memory);
void kea_factorAllocateNumbers(KeaFactor *f, char *memory);
/* The blocks of the matrix, row-major, to be added to. Of an edge e = (i, j): `upper` is A_ij, size[i] rows by size[j]
 * columns; `lower` is A_ji, and is read by kea_factorLU only. */
double *kea_factorDiagonal(KeaFactor *f, int node);
double *kea_factorUpper(KeaFactor *f, int edge);
double *kea_factorLower(KeaFactor *f, int edge);

/* Rows that join the same two nodes of six unknowns, or belong to one: row i has the weight w_i, and a_i and b_i along
 * either node's unknowns. Added together, a block is loaded and stored once for all of them; the sums are the same. A
 * joint with its limits has up to eight; longer runs are added in parts. */
enum { KEA_FACTOR_ROWS = 8 };
typedef struct KeaFactorRows {
    int node[2], edge; /* -1: none */
    int count;
    double weight[KEA_FACTOR_ROWS];
    const double *a[2][KEA_FACTOR_ROWS], *b[2][KEA_FACTOR_ROWS];
} KeaFactorRows;

static inline void kea_factorPutRow(KeaFactorRows *rows, double weight, double (*const a)[6], double (*const b)[6]) {
    const int i = rows->count++;
    rows->weight[i] = weight;
    for (int k = 0; k < 2; k++) {
        rows->a[k][i] = a[k];
        rows->b[k][i] = b[k];
    }
}
/* Adds Σ w_i a_iᵀ b_i to the blocks of the nodes and of their edge, in the order of i; to `lower` unless the matrix is
 * symmetric. */
void kea_factorAddRows(KeaFactor *f, const KeaFactorRows *rows, MeBool isSymmetric);

/* Where the unknowns of a node start in vectors; of numNodes: how many there are in all. */
int kea_factorOffset(const KeaFactor *f, int node);

/* A = L Lᵀ of a symmetric matrix, of which the diagonal blocks (upper triangles) and `upper` are read. False where A is
 * not positive definite in the arithmetic: a pivot below `min`, e.g. 1e-14, relative to its diagonal entry as it was
 * when the turn of its block came. The matrix itself is kept, and may be changed and factored again. */
MeBool kea_factorCholesky(KeaFactor *f, double min);
/* A = L U of a matrix whose structure is symmetric but whose numbers are not, without pivoting between blocks (within a
 * diagonal block rows are exchanged, which are compared by their own diagonal entries). False where a pivot is below
 * `min`, relative to these. */
MeBool kea_factorLU(KeaFactor *f, double min);
/* x := A⁻¹ x, by the last factorization. */
void kea_factorSolve(const KeaFactor *f, double x[]);

/* Where many x are to be solved for: after kea_factorCholesky, inverts the blocks of the factor; x := A⁻¹ x by these,
 * in half of the time, and kea_factorSolve no longer. Of a matrix near to singular it is less accurate. */
void kea_factorInvert(KeaFactor *f);
void kea_factorSolveInverted(const KeaFactor *f, double x[]);

/* What one Cholesky factorization costs, and how many doubles the factor has: for choosing between two graphs. */
double kea_factorFlops(const KeaFactor *f);
size_t kea_factorEntries(const KeaFactor *f);

#endif
