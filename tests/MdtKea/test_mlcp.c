/* The dense solver against the enumeration of all active sets, and on problems that have no unique answer. */
#include "kea_mlcp_i.h"
#include "karma_test.h"

#define MOST 40

/* A small generator of its own, so that a failure can be repeated from the printed seed. */
static unsigned long long state;

static double uniform(double low, double high) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

typedef struct {
    int n;
    double A[MOST * MOST], E[MOST], b[MOST], lower[MOST], upper[MOST];
} Problem;

/* A = G G^T of the given rank. */
static void randomMatrix(Problem *p, int n, int rank) {
    double G[MOST][MOST + 8];
    p->n = n;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < rank; k++)
            G[i][k] = uniform(-1, 1);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            p->A[i * n + j] = 0;
            for (int k = 0; k < rank; k++)
                p->A[i * n + j] += G[i][k] * G[j][k];
        }
}

/* A mixture of joint, contact, friction and motor rows. */
static void randomBounds(Problem *p) {
    for (int i = 0; i < p->n; i++) {
        const double kind = uniform(0, 4), bound = uniform(.05, 2);
        p->lower[i] = kind < 1 ? -HUGE_VAL : kind < 2 ? 0 : -bound;
        p->upper[i] = kind < 2 ? HUGE_VAL : kind < 3 ? bound : uniform(.05, 2);
        p->b[i] = uniform(-3, 3);
    }
}

/* Solves the n x n system M x = r in place by elimination with pivoting; false when it is singular. */
static MeBool eliminate(int n, double M[][MOST], double *r) {
    for (int c = 0; c < n; c++) {
        int best = c;
        for (int i = c + 1; i < n; i++)
            if (fabs(M[i][c]) > fabs(M[best][c]))
                best = i;
        if (fabs(M[best][c]) < 1e-12)
            return MEFALSE;
        for (int j = 0; j < n; j++) {
            const double t = M[c][j];
            M[c][j] = M[best][j];
            M[best][j] = t;
        }
        const double t = r[c];
        r[c] = r[best];
        r[best] = t;
        for (int i = c + 1; i < n; i++) {
            const double f = M[i][c] / M[c][c];
            for (int j = c; j < n; j++)
                M[i][j] -= f * M[c][j];
            r[i] -= f * r[c];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++)
            r[i] -= M[i][j] * r[j];
        r[i] /= M[i][i];
    }
    return METRUE;
}

static double rowOf(const Problem *p, int i, const double *x) {
    double sum = p->E[i] * x[i] - p->b[i];
    for (int j = 0; j < p->n; j++)
        sum += p->A[i * p->n + j] * x[j];
    return sum;
}

/* By how much x fails to be the answer: bounds, and w against them. */
static double violation(const Problem *p, const double *x) {
    double worst = 0;
    for (int i = 0; i < p->n; i++) {
        const double w = rowOf(p, i, x);
        worst = fmax(worst, fmax(p->lower[i] - x[i], x[i] - p->upper[i]));
        if (!(x[i] <= p->lower[i] && w > 0) && !(x[i] >= p->upper[i] && w < 0))
            worst = fmax(worst, fabs(w));
    }
    return worst;
}

/* Tries every way of putting rows free, at the lower, or at the upper bound. The answer is unique. */
static MeBool enumerate(const Problem *p, double *x) {
    int sets = 1;
    for (int i = 0; i < p->n; i++)
        sets *= 3;
    for (int code = 0; code < sets; code++) {
        double M[MOST][MOST], r[MOST];
        int free[MOST], count = 0, c = code;
        MeBool possible = METRUE;
        for (int i = 0; i < p->n; i++, c /= 3) {
            x[i] = c % 3 == 1 ? p->lower[i] : c % 3 == 2 ? p->upper[i] : 0;
            possible = possible && isfinite(x[i]);
            if (c % 3 == 0)
                free[count++] = i;
        }
        if (!possible)
            continue;
        for (int i = 0; i < count; i++) {
            r[i] = -rowOf(p, free[i], x);
            for (int j = 0; j < count; j++)
                M[i][j] = p->A[free[i] * p->n + free[j]] + (i == j ? p->E[free[i]] : 0);
        }
        if (!eliminate(count, M, r))
            continue;
        for (int i = 0; i < count; i++)
            x[free[i]] = r[i];
        if (violation(p, x) < 1e-9)
            return METRUE;
    }
    return MEFALSE;
}

static char memory[1 << 20];

static void load(KeaMlcp *m, const Problem *p) {
    KeaArena arena = {memory, 0};
    kea_mlcpInit(m, p->n, p->A, &arena);
    ck_assert(arena.used < sizeof memory);
    for (int i = 0; i < p->n; i++) {
        m->E[i] = p->E[i];
        m->b[i] = p->b[i];
        m->lower[i] = p->lower[i];
        m->upper[i] = p->upper[i];
    }
    kea_mlcpBegin(m);
}

START_TEST(random_problems_have_the_enumerated_answer) {
    for (unsigned seed = 1; seed <= 2000; seed++) {
        Problem p;
        KeaMlcp m;
        double x[MOST];
        state = seed;
        const int n = 1 + (int)(seed % 6);
        randomMatrix(&p, n, n + 1);
        randomBounds(&p);
        for (int i = 0; i < n; i++)
            p.E[i] = seed % 3 == 0 ? 0 : uniform(0, .1);
        if (!enumerate(&p, x))
            continue; /* singular to 1e-12 */
        load(&m, &p);
        kea_mlcpSolve(&m);
        ck_assert_msg(!m.capped && !m.regularized, "seed %u", seed);
        for (int i = 0; i < n; i++)
            ck_assert_msg(fabs(m.x[i] - x[i]) <= 1e-6 * (1 + fabs(x[i])),
                          "seed %u row %d of %d: %.12g, enumerated %.12g", seed, i, n, m.x[i], x[i]);
    }
}
END_TEST

START_TEST(large_random_problems_are_complementary) {
    for (unsigned seed = 1; seed <= 300; seed++) {
        Problem p;
        KeaMlcp m;
        state = seed * 7919;
        randomMatrix(&p, MOST, MOST + 4);
        randomBounds(&p);
        for (int i = 0; i < MOST; i++)
            p.E[i] = 0;
        load(&m, &p);
        kea_mlcpSolve(&m);
        ck_assert_msg(!m.capped && !m.regularized, "seed %u", seed);
        ck_assert_msg(violation(&p, m.x) < 1e-8, "seed %u: violation %g", seed, violation(&p, m.x));
    }
}
END_TEST

/* Rows that repeat each other, ε = 1e-4: bounded, and the equations hold. */
START_TEST(redundant_rows_with_epsilon_are_bounded) {
    for (unsigned seed = 1; seed <= 300; seed++) {
        Problem p;
        KeaMlcp m;
        state = seed * 104729;
        randomMatrix(&p, 24, 6);
        randomBounds(&p);
        double most = 0;
        for (int i = 0; i < p.n; i++) {
            p.E[i] = 1e-4;
            most = fmax(most, fabs(p.b[i]));
        }
        load(&m, &p);
        kea_mlcpSolve(&m);
        ck_assert_msg(!m.capped, "seed %u", seed);
        ck_assert_msg(violation(&p, m.x) < 1e-6, "seed %u: violation %g", seed, violation(&p, m.x));
        for (int i = 0; i < p.n; i++)
            ck_assert_msg(fabs(m.x[i]) <= most / 1e-4 * sqrt(p.n), "seed %u: x = %g", seed, m.x[i]);
    }
}
END_TEST

/* ε = 0, but the right-hand side fits the rows: an answer exists, and of all answers with the same effect the force is
 * the least. */
START_TEST(consistent_redundant_rows_without_epsilon_share) {
    for (unsigned seed = 1; seed <= 200; seed++) {
        Problem p;
        KeaMlcp m;
        double x[MOST], before = 0, after = 0;
        state = seed * 1299709;
        randomMatrix(&p, 20, 6);
        for (int i = 0; i < p.n; i++) {
            p.E[i] = 0;
            p.lower[i] = -HUGE_VAL;
            p.upper[i] = HUGE_VAL;
            x[i] = uniform(-1, 1);
            p.b[i] = 0;
        }
        for (int i = 0; i < p.n; i++)
            p.b[i] = rowOf(&p, i, x);
        load(&m, &p);
        kea_mlcpSolve(&m);
        ck_assert_msg(!m.regularized, "seed %u", seed);
        ck_assert_msg(violation(&p, m.x) < 1e-8, "seed %u: violation %g", seed, violation(&p, m.x));
        for (int i = 0; i < p.n; i++) {
            before += x[i] * x[i];
            after += m.x[i] * m.x[i];
        }
        ck_assert_msg(after <= before * (1 + 1e-6), "seed %u: %g is more than %g", seed, after, before);
    }
}
END_TEST

START_TEST(contradictory_rows_end_in_a_compromise) {
    Problem p = {.n = 2};
    KeaMlcp m;
    for (int i = 0; i < 2; i++) {
        p.A[2 * i] = p.A[2 * i + 1] = 1;
        p.lower[i] = -HUGE_VAL;
        p.upper[i] = HUGE_VAL;
    }
    p.b[0] = 1;
    p.b[1] = -1;
    load(&m, &p);
    kea_mlcpSolve(&m);
    ck_assert(m.regularized);
    assert_near(m.x[0] + m.x[1], 0, 1e-6);
    assert_below(fabs(m.x[0]), 1e6);
}
END_TEST

START_TEST(rows_that_nothing_moves_carry_nothing) {
    Problem p = {.n = 2, .A = {0, 0, 0, 2}, .b = {5, 4}, .lower = {-HUGE_VAL, 0}, .upper = {HUGE_VAL, HUGE_VAL}};
    KeaMlcp m;
    load(&m, &p);
    kea_mlcpSolve(&m);
    assert_near(m.x[0], 0, 0);
    assert_near(m.x[1], 2, 1e-12);
}
END_TEST

START_TEST(equal_bounds_are_kept) {
    Problem p = {.n = 2, .A = {1, .5, .5, 1}, .b = {5, 4}, .lower = {1, 0}, .upper = {1, HUGE_VAL}};
    KeaMlcp m;
    load(&m, &p);
    kea_mlcpSolve(&m);
    assert_near(m.x[0], 1, 0);
    assert_near(m.x[1], 3.5, 1e-9);
}
END_TEST

/* The cap stops the pivoting: the forces are within bounds all the same. */
START_TEST(a_capped_solve_stays_within_bounds) {
    Problem p;
    KeaMlcp m;
    state = 3;
    randomMatrix(&p, 30, 34);
    randomBounds(&p);
    for (int i = 0; i < p.n; i++)
        p.E[i] = 0;
    load(&m, &p);
    m.maxIterations = 1;
    kea_mlcpSolve(&m);
    ck_assert(m.capped);
    for (int i = 0; i < p.n; i++)
        ck_assert(m.x[i] >= p.lower[i] && m.x[i] <= p.upper[i] && isfinite(m.x[i]));
}
END_TEST

/* A second solve starts from the sets of the first: another right-hand side that is near needs hardly any pivots. */
START_TEST(a_repeated_solve_is_warm) {
    Problem p;
    KeaMlcp m;
    state = 11;
    randomMatrix(&p, 30, 34);
    randomBounds(&p);
    for (int i = 0; i < p.n; i++)
        p.E[i] = 0;
    load(&m, &p);
    kea_mlcpSolve(&m);
    const int pivots = m.pivots, factorizations = m.factorizations;
    ck_assert_int_gt(pivots, 0);
    for (int i = 0; i < p.n; i++)
        m.b[i] = p.b[i] *= 1 + 1e-9;
    kea_mlcpSolve(&m);
    ck_assert_int_eq(m.pivots, pivots);
    ck_assert_int_eq(m.factorizations, factorizations);
    assert_below(violation(&p, m.x), 1e-8);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, random_problems_have_the_enumerated_answer);
    tcase_add_test(t, large_random_problems_are_complementary);
    tcase_add_test(t, redundant_rows_with_epsilon_are_bounded);
    tcase_add_test(t, consistent_redundant_rows_without_epsilon_share);
    tcase_add_test(t, contradictory_rows_end_in_a_compromise);
    tcase_add_test(t, rows_that_nothing_moves_carry_nothing);
    tcase_add_test(t, equal_bounds_are_kept);
    tcase_add_test(t, a_capped_solve_stays_within_bounds);
    tcase_add_test(t, a_repeated_solve_is_warm);
}

TEST_MAIN("mlcp", tests)
