/* The sparse factor (kea_factor_i.h) against dense elimination: solutions, structure, cost, and lack of memory. */
#include "inner/kea_factor_i.h"
#include "MeMemory.h"
#include "common/kea_policy_i.h"
#include "common/kea_machine_i.h"
#include "inner/kea_problem_i.h"
#include "inner/kea_structure_i.h"
#include "karma_test.h"
#include "random_numbers.h"

/* A_ji of an edge (i, j). */
static double *lowerOf(KeaFactor *f, int edge) {
    return f->lowerInput + f->edgeAt[edge];
}

enum { MAX_NODES = 24, MAX_EDGES = MAX_NODES * MAX_NODES / 2, MAX = MAX_NODES * KEA_FACTOR_MAX_BLOCK };

/* ---- graphs ---- */

typedef struct {
    int numNodes, numEdges;
    int size[MAX_NODES], edges[MAX_EDGES][2];
} Graph;

static void join(Graph *g, int a, int b) {
    for (int e = 0; e < g->numEdges; e++)
        if ((g->edges[e][0] == a && g->edges[e][1] == b) || (g->edges[e][0] == b && g->edges[e][1] == a))
            return;
    if (a == b)
        return;
    const int swap = below(2);
    g->edges[g->numEdges][swap] = a;
    g->edges[g->numEdges++][!swap] = b;
}

typedef enum { CHAIN, TREE, STAR, LOOP, RANDOM, KINDS } Kind;

/* Nodes in no order that would help; sizes 1 to 12. */
static void makeGraph(Graph *g, Kind kind, int numNodes) {
    int label[MAX_NODES];
    g->numNodes = numNodes;
    g->numEdges = 0;
    for (int i = 0; i < numNodes; i++) {
        const int other = below(i + 1);
        label[i] = label[other];
        label[other] = i;
        g->size[i] = 1 + below(KEA_FACTOR_MAX_BLOCK);
    }
    for (int i = 1; i < numNodes && kind != RANDOM; i++)
        join(g, label[i], label[kind == STAR ? 0 : kind == TREE ? below(i) : i - 1]);
    if (kind == LOOP)
        join(g, label[0], label[numNodes - 1]);
    for (int i = 0; i < 2 * numNodes && kind == RANDOM; i++)
        join(g, below(numNodes), below(numNodes));
}

static MdtKeaCache *cache; /* of the factor that is there */

static KeaFactor *createFor(int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    cache = MdtKeaCacheCreate();
    KeaFactor *f = kea_cacheFind(cache, numNodes, size, numEdges, edges);
    ck_assert_ptr_nonnull(f);
    kea_factorClear(f);
    return f;
}

static KeaFactor *create(const Graph *g) {
    return createFor(g->numNodes, g->size, g->numEdges, g->edges);
}

static void destroy(void) {
    MdtKeaCacheDestroy(cache);
}

/* ---- dense reference ---- */

typedef struct {
    int n;
    double A[MAX][MAX];
} Dense;

static Dense dense, eliminated;

static void addBlock(double *block, double w, const double *a, const double *b, int rows, int columns) {
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            block[i * columns + j] += w * a[i] * b[j];
}

/* A sum of squares over the edges and something on the diagonal; `skew`: a part that is not symmetric, which leaves
 * x·Ax > 0. The lower triangles of the diagonal blocks are as they should be. */
static void fill(KeaFactor *f, const Graph *g, double skew) {
    double a[KEA_FACTOR_MAX_BLOCK], b[KEA_FACTOR_MAX_BLOCK];
    for (int i = 0; i < g->numNodes; i++)
        for (int k = 0; k < g->size[i]; k++)
            kea_factorDiagonal(f, i)[k * (g->size[i] + 1)] += uniform(0.5, 2);
    for (int e = 0; e < g->numEdges; e++) {
        const int i = g->edges[e][0], j = g->edges[e][1], n = g->size[i], m = g->size[j];
        for (int k = 0; k < 3; k++) {
            for (int c = 0; c < KEA_FACTOR_MAX_BLOCK; c++) {
                a[c] = uniform(-1, 1);
                b[c] = uniform(-1, 1);
            }
            addBlock(kea_factorDiagonal(f, i), 1, a, a, n, n);
            addBlock(kea_factorDiagonal(f, j), 1, b, b, m, m);
            addBlock(kea_factorUpper(f, e), 1 + skew, a, b, n, m);
            addBlock(lowerOf(f, e), 1 - skew, b, a, m, n);
        }
    }
}

static void toDense(KeaFactor *f, const Graph *g) {
    memset(&dense, 0, sizeof dense);
    dense.n = kea_factorOffset(f, g->numNodes);
    for (int i = 0; i < g->numNodes; i++)
        for (int r = 0; r < g->size[i]; r++)
            for (int c = 0; c < g->size[i]; c++)
                dense.A[kea_factorOffset(f, i) + r][kea_factorOffset(f, i) + c] =
                    kea_factorDiagonal(f, i)[r * g->size[i] + c];
    for (int e = 0; e < g->numEdges; e++) {
        const int i = g->edges[e][0], j = g->edges[e][1], n = g->size[i], m = g->size[j];
        for (int r = 0; r < n; r++)
            for (int c = 0; c < m; c++) {
                dense.A[kea_factorOffset(f, i) + r][kea_factorOffset(f, j) + c] = kea_factorUpper(f, e)[r * m + c];
                dense.A[kea_factorOffset(f, j) + c][kea_factorOffset(f, i) + r] = lowerOf(f, e)[c * n + r];
            }
    }
}

/* x := A⁻¹ x by elimination with pivoting. */
static void solveDense(double *x) {
    const int n = dense.n;
    eliminated = dense;
    for (int c = 0; c < n; c++) {
        int best = c;
        for (int i = c + 1; i < n; i++)
            best = fabs(eliminated.A[i][c]) > fabs(eliminated.A[best][c]) ? i : best;
        for (int j = 0; j < n; j++) {
            const double t = eliminated.A[c][j];
            eliminated.A[c][j] = eliminated.A[best][j];
            eliminated.A[best][j] = t;
        }
        const double t = x[c];
        x[c] = x[best];
        x[best] = t;
        for (int i = c + 1; i < n; i++) {
            const double share = eliminated.A[i][c] / eliminated.A[c][c];
            for (int j = c; j < n && share != 0; j++)
                eliminated.A[i][j] -= share * eliminated.A[c][j];
            x[i] -= share * x[c];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++)
            x[i] -= eliminated.A[i][j] * x[j];
        x[i] /= eliminated.A[i][i];
    }
}

static double sizeOf(const double *x, int n) {
    double max = 0;
    for (int i = 0; i < n; i++)
        max = fmax(max, fabs(x[i]));
    return max;
}

/* The last factorization against elimination, for a random right-hand side. */
static void assertSolvesBy(void (*solve)(const KeaFactor *f, double x[]), KeaFactor *f, const Graph *g,
                           const char *what, unsigned seed) {
    double x[MAX], y[MAX];
    toDense(f, g);
    for (int i = 0; i < dense.n; i++)
        x[i] = y[i] = uniform(-1, 1);
    solve(f, x);
    solveDense(y);
    for (int i = 0; i < dense.n; i++)
        ck_assert_msg(fabs(x[i] - y[i]) <= 1e-11 * sizeOf(y, dense.n),
                      "%s, seed %u, unknown %d of %d: %.17g, not %.17g", what, seed, i, dense.n, x[i], y[i]);
}

static void assertSolves(KeaFactor *f, const Graph *g, const char *what, unsigned seed) {
    assertSolvesBy(kea_factorSolve, f, g, what, seed);
}

static void assertSolvesInverted(KeaFactor *f, const Graph *g, unsigned seed) {
    kea_factorInvert(f);
    assertSolvesBy(kea_factorSolveInverted, f, g, "inverted blocks", seed);
}

/* ---- solutions ---- */

TEST(cholesky_solves_as_elimination_does) {
    for (unsigned seed = 1; seed <= 150; seed++) {
        Graph g;
        state = seed;
        makeGraph(&g, (Kind)(seed % KINDS), 1 + below(12));
        KeaFactor *f = create(&g);
        fill(f, &g, 0);
        ck_assert_msg(kea_factorCholesky(f, 1e-14), "seed %u", seed);
        assertSolves(f, &g, "Cholesky", seed);
        assertSolvesInverted(f, &g, seed);
        destroy();
    }
}

TEST(lu_solves_as_elimination_does) {
    for (unsigned seed = 1; seed <= 150; seed++) {
        Graph g;
        state = seed * 7919;
        makeGraph(&g, (Kind)(seed % KINDS), 1 + below(12));
        KeaFactor *f = create(&g);
        fill(f, &g, uniform(-2, 2));
        ck_assert_msg(kea_factorLU(f, 1e-14), "seed %u", seed);
        assertSolves(f, &g, "LU", seed);
        destroy();
    }
}

/* The blocks of 6 that Kea's bodies have, and of 3, take paths of their own. */
TEST(equal_blocks_solve_as_elimination_does) {
    for (unsigned seed = 1; seed <= 60; seed++) {
        Graph g;
        state = seed * 104729;
        makeGraph(&g, (Kind)(seed % KINDS), 2 + below(MAX_NODES - 1));
        for (int i = 0; i < g.numNodes; i++)
            g.size[i] = seed % 2 ? 6 : 3;
        KeaFactor *f = create(&g);
        fill(f, &g, seed % 3 ? 0 : 0.7);
        ck_assert_msg(seed % 3 ? kea_factorCholesky(f, 1e-14) : kea_factorLU(f, 1e-14), "seed %u", seed);
        assertSolves(f, &g, seed % 3 ? "Cholesky" : "LU", seed);
        if (seed % 3)
            assertSolvesInverted(f, &g, seed);
        destroy();
    }
}

/* What Cholesky's factorization does not read may hold anything. */
TEST(cholesky_reads_upper_parts_only) {
    Graph g;
    double x[MAX], y[MAX];
    state = 5;
    makeGraph(&g, RANDOM, 10);
    KeaFactor *f = create(&g);
    fill(f, &g, 0);
    const int n = kea_factorOffset(f, g.numNodes);
    for (int i = 0; i < n; i++)
        x[i] = y[i] = uniform(-1, 1);
    ck_assert(kea_factorCholesky(f, 1e-14));
    kea_factorSolve(f, x);
    for (int e = 0; e < g.numEdges; e++)
        for (int k = 0; k < g.size[g.edges[e][0]] * g.size[g.edges[e][1]]; k++)
            lowerOf(f, e)[k] = NAN;
    for (int i = 0; i < g.numNodes; i++)
        for (int r = 0; r < g.size[i]; r++)
            for (int c = 0; c < r; c++)
                kea_factorDiagonal(f, i)[r * g.size[i] + c] = NAN;
    ck_assert(kea_factorCholesky(f, 1e-14));
    kea_factorSolve(f, y);
    ck_assert_int_eq(memcmp(x, y, (size_t)n * sizeof *x), 0);
    destroy();
}

/* ---- rows ---- */

/* As one row after the other, entry by entry: `count` of random rows that join the nodes of an edge. */
static void addOneByOne(double block[6][6], int count, const double w[], double (*const a)[6], double (*const b)[6]) {
    for (int r = 0; r < count; r++)
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 6; k++)
                block[i][k] += w[r] * a[r][i] * b[r][k];
}

static void isTheSame(const double *block, double (*const expected)[6]) {
    ck_assert_int_eq(memcmp(block, expected, 36 * sizeof(double)), 0);
}

/* Node 0 has the rows' first body if `turned` is 0, else the second. */
static void checkRows(const KeaFactorKernel *kernel, int count, int turned, MeBool isSymmetric) {
    const int size[2] = {6, 6}, edges[1][2] = {{0, 1}};
    KeaFactor *f = createFor(2, size, 1, edges);
    KeaFactorRows rows = {.node = {turned, !turned}};
    static double a[2][KEA_FACTOR_ROWS][6], b[2][KEA_FACTOR_ROWS][6], block[4][6][6];
    memset(block, 0, sizeof block);
    for (rows.count = 0; rows.count < count; rows.count++) {
        const int r = rows.count;
        rows.weight[r] = uniform(0, 10);
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 6; i++) {
                a[k][r][i] = uniform(-1, 1);
                b[k][r][i] = uniform(-1, 1);
            }
            rows.a[k][r] = a[k][r];
            rows.b[k][r] = b[k][r];
        }
    }
    const int low = turned;
    kernel->addRows(f, &rows, isSymmetric);
    addOneByOne(block[0], count, rows.weight, a[low], b[low]);
    addOneByOne(block[1], count, rows.weight, a[!low], b[!low]);
    addOneByOne(block[2], count, rows.weight, a[low], b[!low]);
    if (!isSymmetric)
        addOneByOne(block[3], count, rows.weight, a[!low], b[low]);
    isTheSame(kea_factorDiagonal(f, 0), block[0]);
    isTheSame(kea_factorDiagonal(f, 1), block[1]);
    isTheSame(kea_factorUpper(f, 0), block[2]);
    isTheSame(lowerOf(f, 0), block[3]);
    destroy();
}

TEST(rows_together_add_what_they_add_one_by_one) {
    state = 3;
    for (int count = 1; count <= KEA_FACTOR_ROWS; count++)
        for (int turned = 0; turned < 2; turned++)
            for (int isSymmetric = 0; isSymmetric < 2; isSymmetric++) {
                checkRows(&kea_factorKernel, count, turned, isSymmetric);
#ifdef KEA_HAS_AVX2
                if (kea_machineHasAvx2())
                    checkRows(&kea_factorKernelAvx2, count, turned, isSymmetric);
#endif
            }
}

/* ---- what cannot be factored ---- */

/* One diagonal entry is made too small; afterwards the matrix, put right again, is factored as before. */
TEST(not_positive_definite_is_told_and_the_matrix_kept) {
    for (unsigned seed = 1; seed <= 100; seed++) {
        Graph g;
        double x[MAX], y[MAX];
        state = seed * 31;
        makeGraph(&g, (Kind)(seed % KINDS), 1 + below(10));
        KeaFactor *f = create(&g);
        fill(f, &g, 0);
        const int n = kea_factorOffset(f, g.numNodes), node = below(g.numNodes), row = below(g.size[node]);
        for (int i = 0; i < n; i++)
            x[i] = y[i] = uniform(-1, 1);
        ck_assert(kea_factorCholesky(f, 1e-14));
        kea_factorSolve(f, x);
        double *entry = kea_factorDiagonal(f, node) + row * (g.size[node] + 1), kept = *entry;
        *entry = -0.01;
        ck_assert_msg(!kea_factorCholesky(f, 1e-14), "seed %u", seed);
        *entry = NAN;
        ck_assert_msg(!kea_factorCholesky(f, 1e-14), "seed %u", seed);
        *entry = kept;
        ck_assert(kea_factorCholesky(f, 1e-14));
        kea_factorSolve(f, y);
        ck_assert_msg(memcmp(x, y, (size_t)n * sizeof *x) == 0, "seed %u", seed);
        destroy();
    }
}

/* Indefinite, though every diagonal block is positive: 1 and 1 joined by 2. */
TEST(indefinite_between_blocks_is_told) {
    const int size[] = {1, 1}, edges[][2] = {{1, 0}};
    KeaFactor *f = createFor(2, size, 1, edges);
    kea_factorDiagonal(f, 0)[0] = kea_factorDiagonal(f, 1)[0] = 1;
    kea_factorUpper(f, 0)[0] = lowerOf(f, 0)[0] = 2;
    ck_assert(!kea_factorCholesky(f, 1e-14));
    ck_assert(kea_factorLU(f, 1e-14)); /* [1 2; 2 1] (x, y) = (5, 4): x = 1, y = 2 */
    double x[] = {5, 4};
    kea_factorSolve(f, x);
    assert_near(x[0], 1, 1e-15);
    assert_near(x[1], 2, 1e-15);
    destroy();
}

TEST(singular_blocks_are_told) {
    const int size[] = {2};
    KeaFactor *f = createFor(1, size, 0, NULL);
    double *D = kea_factorDiagonal(f, 0), x[] = {3, 7};
    ck_assert(!kea_factorCholesky(f, 1e-14) && !kea_factorLU(f, 1e-14));
    D[0] = D[1] = D[2] = D[3] = 1;
    ck_assert(!kea_factorCholesky(f, 1e-14) && !kea_factorLU(f, 1e-14));
    D[3] = 1 + 1e-15;
    ck_assert(!kea_factorCholesky(f, 1e-14) && !kea_factorLU(f, 1e-14));
    D[0] = D[3] = 0; /* rows are exchanged */
    ck_assert(!kea_factorCholesky(f, 1e-14) && kea_factorLU(f, 1e-14));
    kea_factorSolve(f, x);
    ck_assert(x[0] == 7 && x[1] == 3);
    destroy();
}

/* ---- structure ---- */

/* In trees nothing comes into being: the factor has the blocks of the matrix. */
TEST(trees_are_factored_without_fill) {
    for (unsigned seed = 1; seed <= 300; seed++) {
        Graph g;
        state = seed * 1299709;
        makeGraph(&g, seed % 3 == 0 ? CHAIN : seed % 3 == 1 ? TREE : STAR, 1 + below(MAX_NODES));
        size_t entries = 0;
        for (int i = 0; i < g.numNodes; i++)
            entries += (size_t)(g.size[i] * g.size[i]);
        for (int e = 0; e < g.numEdges; e++)
            entries += (size_t)(g.size[g.edges[e][0]] * g.size[g.edges[e][1]]);
        KeaFactor *f = create(&g);
        ck_assert_msg(kea_factorEntries(f) == entries, "seed %u: %zu, not %zu", seed, kea_factorEntries(f), entries);
        destroy();
    }
}

/* A ring of n nodes is a triangle at last: n - 3 blocks come into being. */
TEST(rings_fill_one_block_a_node) {
    for (int n = 3; n <= MAX_NODES; n++) {
        Graph g;
        state = (unsigned)n;
        makeGraph(&g, LOOP, n);
        for (int i = 0; i < n; i++)
            g.size[i] = 6;
        KeaFactor *f = create(&g);
        ck_assert_uint_eq(kea_factorEntries(f), (size_t)(36 * (n + n + n - 3)));
        destroy();
    }
}

/* The chain 0 - 1 - 2 ..., all blocks of 6. */
static KeaFactor *longChain(int n) {
    int *size = malloc((size_t)n * sizeof *size), (*edges)[2] = malloc((size_t)n * sizeof *edges);
    for (int i = 0; i < n; i++) {
        size[i] = 6;
        edges[i][0] = i;
        edges[i][1] = i + 1;
    }
    KeaFactor *f = createFor(n, size, n - 1, (const int(*)[2])edges);
    free(size);
    free(edges);
    return f;
}

static double chainFlops(int n) {
    KeaFactor *f = longChain(n);
    const double flops = kea_factorFlops(f);
    destroy();
    return flops;
}

TEST(chains_cost_the_same_for_every_node) {
    const double step = chainFlops(101) - chainFlops(100);
    ck_assert(step == 7 * 7 + 8 * 8 + 9 * 9 + 10 * 10 + 11 * 11 + 12 * 12);
    ck_assert(chainFlops(1000) - chainFlops(100) == 900 * step);
}

/* The second difference 2 x_i - x_{i-1} - x_{i+1} and a hundredth of x_i, by blocks: A x = b for a known x. */
TEST(ten_thousand_nodes_in_a_chain) {
    enum { N = 10000 };
    static double x[6 * N], b[6 * N];
    KeaFactor *f = longChain(N);
    ck_assert_uint_eq(kea_factorEntries(f), 36 * (N + N - 1));
    for (int i = 0; i < 6 * N; i++)
        x[i] = sin(0.37 * i);
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < 6; k++) {
            kea_factorDiagonal(f, i)[7 * k] = 2.01;
            if (i + 1 < N)
                kea_factorUpper(f, i)[7 * k] = -1;
            b[6 * i + k] = 2.01 * x[6 * i + k] - (i > 0 ? x[6 * i - 6 + k] : 0) - (i + 1 < N ? x[6 * i + 6 + k] : 0);
        }
    }
    ck_assert(kea_factorCholesky(f, 1e-14));
    kea_factorSolve(f, b);
    for (int i = 0; i < 6 * N; i++)
        assert_near(b[i], x[i], 2e-13);
    destroy();
}

TEST(a_factor_matches_its_own_graph_only) {
    const int size[] = {6, 3, 6}, otherSize[] = {6, 6, 3};
    const int edges[][2] = {{0, 1}, {2, 1}}, flipped[][2] = {{0, 1}, {1, 2}}, elsewhere[][2] = {{0, 1}, {0, 2}};
    KeaFactor *f = createFor(3, size, 2, edges), *lone = kea_cacheFind(cache, 2, size, 0, NULL);
    ck_assert(kea_factorMatches(f, 3, size, 2, edges));
    ck_assert(!kea_factorMatches(f, 2, size, 1, edges));
    ck_assert(!kea_factorMatches(f, 3, size, 1, edges));
    ck_assert(!kea_factorMatches(f, 3, otherSize, 2, edges));
    ck_assert(!kea_factorMatches(f, 3, size, 2, flipped));
    ck_assert(!kea_factorMatches(f, 3, size, 2, elsewhere));
    ck_assert(kea_factorMatches(lone, 2, size, 0, NULL) && kea_factorMatches(lone, 2, size, 0, edges));
    ck_assert(!kea_factorMatches(lone, 3, size, 0, NULL));
    destroy();
}

static void solveInto(double *x, const Graph *g, unsigned seed, const int *original, MeBool flip) {
    KeaFactor *f = create(g);
    state = seed;
    for (int i = 0; i < g->numNodes; i++)
        for (int k = 0; k < g->size[i]; k++)
            kea_factorDiagonal(f, i)[k * (g->size[i] + 1)] = 60 + uniform(0, 1);
    for (int e = 0; e < g->numEdges; e++) { /* the block of an edge is that of its number before they were mixed */
        const int n = g->size[g->edges[e][0]], m = g->size[g->edges[e][1]];
        for (int r = 0; r < n; r++)
            for (int c = 0; c < m; c++)
                kea_factorUpper(f, e)[r * m + c] = sin(original[e] + (flip ? 0.7 * c + 0.3 * r : 0.7 * r + 0.3 * c));
    }
    ck_assert(kea_factorCholesky(f, 1e-14));
    for (int i = 0; i < kea_factorOffset(f, g->numNodes); i++)
        x[i] = cos(i);
    kea_factorSolve(f, x);
    destroy();
}

/* The order of elimination depends on the graph, not on how its edges are listed. */
TEST(one_graph_gives_the_same_bits) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        Graph g, mixed;
        double x[MAX] = {0}, y[MAX] = {0};
        int original[MAX_EDGES], same[MAX_EDGES];
        state = seed * 17;
        makeGraph(&g, (Kind)(seed % KINDS), 2 + below(MAX_NODES - 1));
        mixed = g;
        for (int e = 0; e < g.numEdges; e++)
            original[e] = same[e] = e;
        for (int e = g.numEdges - 1; e > 0; e--) {
            const int other = below(e + 1), t = original[e];
            original[e] = original[other];
            original[other] = t;
        }
        for (int e = 0; e < g.numEdges; e++) {
            mixed.edges[e][0] = g.edges[original[e]][1];
            mixed.edges[e][1] = g.edges[original[e]][0];
        }
        solveInto(x, &g, seed, same, MEFALSE);
        solveInto(y, &g, seed, same, MEFALSE);
        ck_assert_msg(memcmp(x, y, sizeof x) == 0, "twice, seed %u", seed);
        solveInto(y, &mixed, seed, original, METRUE);
        ck_assert_msg(memcmp(x, y, sizeof x) == 0, "mixed, seed %u", seed);
    }
}

/* ---- memory ---- */

static MeMemoryAPIStruct real;
static int calls, failAt, blocks;

static void *MEAPI scarce(size_t bytes) {
    if (++calls == failAt)
        return NULL;
    blocks++;
    return real.create(bytes);
}

static void MEAPI giveBack(void *const block) {
    ck_assert_msg(block != NULL, "a null was destroyed");
    blocks--;
    real.destroy(block);
}

static void *MEAPI noResize(void *const block, size_t bytes) {
    (void)block;
    (void)bytes;
    ck_abort_msg("resize was called");
    return NULL;
}

static void makeScarce(void) {
    real = MeMemoryAPI;
    MeMemoryAPI.create = scarce;
    MeMemoryAPI.destroy = giveBack;
    MeMemoryAPI.resize = noResize;
    blocks = calls = failAt = 0;
}

/* Whether each of these allocations that fails gives null, and nothing is lost: the same, once there is memory. */
static int failuresOf(const Graph *g) {
    KeaFactor *f = NULL;
    int k = 0;
    while (!f) {
        cache = MdtKeaCacheCreate();
        failAt = calls + ++k;
        f = kea_cacheFind(cache, g->numNodes, g->size, g->numEdges, g->edges);
        failAt = 0;
        if (!f)
            ck_assert_ptr_nonnull(kea_cacheFind(cache, g->numNodes, g->size, g->numEdges, g->edges));
        destroy();
        ck_assert_int_eq(blocks, 0);
        ck_assert_int_lt(k, 1000);
    }
    return k - 1;
}

TEST(the_cache_survives_lack_of_memory) {
    Graph g;
    makeScarce();
    failAt = 1;
    ck_assert_ptr_null(MdtKeaCacheCreate());
    for (unsigned seed = 1; seed <= 20; seed++) {
        state = seed;
        makeGraph(&g, (Kind)(seed % KINDS), 2 + below(MAX_NODES - 1));
        ck_assert_int_ge(failuresOf(&g), 4); /* the order, its columns, the structure, the numbers */
    }
    MeMemoryAPI = real;
    messages_forget();
}

/* A factor in use, then a larger graph for which there is no memory: the first is as good as before. */
TEST(a_factor_survives_lack_of_memory_for_another) {
    Graph g, large;
    state = 11;
    makeGraph(&g, RANDOM, 6);
    makeGraph(&large, RANDOM, MAX_NODES);
    makeScarce();
    KeaFactor *f = NULL, *other = NULL;
    for (int k = 1; !other; k++) {
        f = create(&g);
        failAt = calls + k;
        other = kea_cacheFind(cache, large.numNodes, large.size, large.numEdges, large.edges);
        failAt = 0;
        for (int pass = 0; pass < 2; pass++) {
            kea_factorClear(f);
            state = 12;
            fill(f, &g, 0);
            ck_assert(kea_factorCholesky(f, 1e-14));
            assertSolves(f, &g, "after lack of memory", (unsigned)k);
            ck_assert_ptr_eq(kea_cacheFind(cache, g.numNodes, g.size, g.numEdges, g.edges), f);
        }
        ck_assert_int_lt(k, 1000);
        if (!other)
            destroy();
    }
    destroy();
    ck_assert_int_eq(blocks, 0);
    MeMemoryAPI = real;
    messages_forget();
}

/* More graphs than the cache has room for: the last ones are found again, and the first is made anew in the place of
 * the one that was not used for longest. */
TEST(the_cache_keeps_what_was_used_last) {
    enum { FIRST = 2, END = FIRST + 100, KEPT = END - 64 };
    const int edges[][2] = {{0, 1}};
    KeaFactor *made[END] = {NULL};
    cache = MdtKeaCacheCreate();
    for (int n = FIRST; n < END; n++) {
        made[n] = kea_cacheFind(cache, n, NULL, 1, edges);
        ck_assert(kea_factorOffset(made[n], n) == 6 * n);
    }
    for (int n = KEPT; n < END; n++) {
        ck_assert_ptr_eq(kea_cacheFind(cache, n, NULL, 1, edges), made[n]);
        ck_assert_int_eq(kea_factorOffset(made[n], n), 6 * n);
    }
    ck_assert_ptr_eq(kea_cacheFind(cache, FIRST, NULL, 1, edges), made[KEPT]);
    ck_assert_int_eq(kea_factorOffset(made[KEPT], FIRST), 6 * FIRST);
    destroy();
}

/* Structures come, go and are moved; each factor that is kept solves as it should, also where the last user of the
 * memory of the numbers was another one. */
TEST(factors_of_one_cache_do_not_disturb_one_another) {
    enum { GRAPHS = 100, TURNS = 2000 };
    static Graph g[GRAPHS];
    state = 21;
    for (int i = 0; i < GRAPHS; i++)
        makeGraph(&g[i], (Kind)(i % KINDS), 1 + below(12));
    cache = MdtKeaCacheCreate();
    for (int turn = 0; turn < TURNS; turn++) {
        const Graph *one = &g[below(GRAPHS)], *two = &g[below(GRAPHS)];
        KeaFactor *f = kea_cacheFind(cache, one->numNodes, one->size, one->numEdges, one->edges);
        kea_factorClear(kea_cacheFind(cache, two->numNodes, two->size, two->numEdges, two->edges));
        kea_factorClear(f);
        fill(f, one, 0);
        ck_assert(kea_factorCholesky(f, 1e-14));
        assertSolves(f, one, "turn", (unsigned)turn);
    }
    destroy();
}

/* However the graphs change: once the blocks are as large as the largest of them need, nothing is allocated. */
TEST(a_warm_cache_allocates_nothing) {
    enum { WARM = 300, GRAPHS = 3000 };
    Graph g;
    state = 31;
    makeScarce();
    cache = MdtKeaCacheCreate();
    for (int i = 0; i < GRAPHS; i++) {
        makeGraph(&g, (Kind)(i % KINDS), 1 + below(MAX_NODES));
        const int before = calls;
        ck_assert_ptr_nonnull(kea_cacheFind(cache, g.numNodes, g.size, g.numEdges, g.edges));
        ck_assert_msg(i < WARM || calls == before, "graph %d: %d allocations", i, calls - before);
    }
    ck_assert_int_le(calls, 40); /* five blocks, that double */
    destroy();
    ck_assert_int_eq(blocks, 0);
    MeMemoryAPI = real;
}

/* ---- kernels ---- */

#ifdef KEA_HAS_AVX2
/* Of a matrix that depends on the seed alone: A⁻¹ of a vector, by one kernel. */
typedef enum { LU, CHOLESKY, INVERTED, FORMS } Form;

static void solveBy(const KeaFactorKernel *kernel, const Graph *g, int seed, Form form, double x[MAX]) {
    const MeBool isSymmetric = form != LU;
    state = (unsigned long long)seed;
    KeaFactor *f = create(g);
    fill(f, g, isSymmetric ? 0 : 0.3);
    for (int i = 0; i < g->numNodes; i++) {
        double a[KEA_FACTOR_ROWS][2][6], b[KEA_FACTOR_ROWS][2][6];
        KeaFactorRows rows = {.node = {i, -1}, .edge = -1};
        for (int r = 0; r < KEA_FACTOR_ROWS; r++) {
            for (int k = 0; k < 12; k++) {
                a[r][k / 6][k % 6] = uniform(-1, 1);
                b[r][k / 6][k % 6] = uniform(-0.1, 0.1) + a[r][k / 6][k % 6] * isSymmetric;
            }
            kea_factorAppendRow(&rows, 1, a[r], isSymmetric ? a[r] : b[r]);
        }
        if (g->size[i] == 6)
            kernel->addRows(f, &rows, isSymmetric);
    }
    for (int i = 0; i < MAX; i++)
        x[i] = uniform(-1, 1);
    f->isSymmetric = isSymmetric;
    ck_assert(kernel->factorize(f, kea_minPivot));
    if (form == INVERTED)
        kernel->invert(f);
    (form == INVERTED ? kernel->solveInverted : kernel->solve)(f, x);
    destroy();
}
#endif

/* With blocks of any size, and of six all, and of three. */
LOOP_TEST(every_width_gives_the_same_bits, 0, 6) {
#ifdef KEA_HAS_AVX2
    static double narrow[MAX], wide[MAX];
    static Graph g;
    if (!kea_machineHasAvx2())
        return;
    for (int kind = 0; kind < KINDS; kind++)
        for (int sizes = 0; sizes < 3; sizes++) {
            state = (unsigned long long)(_i + 1);
            makeGraph(&g, (Kind)kind, 4 + 4 * _i);
            for (int i = 0; i < g.numNodes && sizes > 0; i++)
                g.size[i] = sizes == 1 ? 6 : 3;
            for (int form = 0; form < FORMS; form++) {
                solveBy(&kea_factorKernel, &g, _i, (Form)form, narrow);
                solveBy(&kea_factorKernelAvx2, &g, _i, (Form)form, wide);
                ck_assert_msg(memcmp(narrow, wide, sizeof wide) == 0, "kind %d, sizes %d, form %d", kind, sizes, form);
            }
        }
#endif
}
