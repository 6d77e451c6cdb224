/* The inner problem (kea_problem_i.h) against slow ways to solve it: enumeration of what is at a bound, the angle of
 * sliding by bisection, fixed points. It is solved as in a step: passes that take the method's own softness out
 * again. */
#include "common/kea_policy_i.h"
#include "inner/kea_problem_i.h"
#include "karma_test.h"
#include "kea_i.h"
#include "random_numbers.h"

enum { MAX_BODIES = 12, MAX_ROWS = 48, MAX_ENUMERATED = 7, MAX_PASSES = 12 };

/* ---- dense elimination ---- */

/* x := M⁻¹ x with full pivoting. Unknowns that M does not determine become 0. Returns the rank. */
static int eliminate(int n, double M[][MAX_ROWS], double *x) {
    int column[MAX_ROWS], rank = 0;
    double max = 0, solution[MAX_ROWS] = {0};
    for (int i = 0; i < n; i++)
        column[i] = i;
    for (; rank < n; rank++) {
        int r = rank, c = rank;
        for (int i = rank; i < n; i++)
            for (int j = rank; j < n; j++)
                if (fabs(M[i][column[j]]) > fabs(M[r][column[c]]))
                    r = i, c = j;
        max = fmax(max, fabs(M[r][column[c]]));
        if (fabs(M[r][column[c]]) <= 1e-11 * max)
            break;
        for (int j = 0; j < n; j++) {
            const double t = M[r][j];
            M[r][j] = M[rank][j];
            M[rank][j] = t;
        }
        const double t = x[r];
        const int swap = column[c];
        x[r] = x[rank];
        x[rank] = t;
        column[c] = column[rank];
        column[rank] = swap;
        for (int i = rank + 1; i < n; i++) {
            const double share = M[i][swap] / M[rank][swap];
            for (int j = 0; j < n; j++)
                M[i][j] -= share * M[rank][j];
            x[i] -= share * x[rank];
        }
    }
    for (int i = rank - 1; i >= 0; i--) {
        double sum = x[i];
        for (int j = i + 1; j < rank; j++)
            sum -= M[i][column[j]] * solution[column[j]];
        solution[column[i]] = sum / M[i][column[i]];
    }
    memcpy(x, solution, (size_t)n * sizeof *x);
    return rank;
}

/* ---- problems ---- */

static _Alignas(16) char memory[1 << 20];
static KeaProblem q;
static MdtKeaCache *cache;
static double startLoad[MAX_BODIES][6], startR[MAX_ROWS], total[MAX_BODIES][6];

static void begin(int numBodies, int numRows) {
    KeaArena arena = {memory, 0};
    memset(&q, 0, sizeof q);
    memset(memory, 0, sizeof memory);
    q.numBodies = numBodies;
    q.numRows = numRows;
    kea_problemLayOut(&q, numBodies, numRows, &arena);
    ck_assert_uint_lt(arena.used, sizeof memory);
    for (int i = 0; i < numRows; i++) {
        KeaProblemRow *row = &q.row[i];
        row->body[0] = row->body[1] = MdtKeaWORLD;
        row->normal = row->partner = -1;
        row->lower = -HUGE_VAL;
        row->upper = HUGE_VAL;
        row->state = KEA_ACTIVE;
    }
}

static void setInverse(KeaMetric *B) {
    for (int c = 0; c < 3; c++) {
        double M[3][MAX_ROWS] = {{0}}, x[MAX_ROWS] = {0};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                M[i][j] = B->angular[i][j];
        x[c] = 1;
        ck_assert_int_eq(eliminate(3, M, x), 3);
        for (int i = 0; i < 3; i++)
            B->inverse[i][c] = x[i];
    }
}

/* A body of the size 1, and a load that would give it a speed of about 1. */
static void setBody(int b, double mass, const double angular[3][3]) {
    KeaMetric *B = &q.metric[b];
    B->linear = mass;
    memcpy(B->angular, angular, sizeof B->angular);
    setInverse(B);
    q.scale[b] = mass;
    q.length[b] = 1;
}

static void randomBody(int b) {
    const double mass = exp(uniform(-2, 2));
    double G[3][3], angular[3][3];
    for (int i = 0; i < 9; i++)
        G[i / 3][i % 3] = uniform(-1, 1);
    for (int i = 0; i < 9; i++)
        angular[i / 3][i % 3] = mass * ((i % 4 == 0 ? 0.3 : 0) + G[i / 3][0] * G[i % 3][0] + G[i / 3][1] * G[i % 3][1] +
                                        G[i / 3][2] * G[i % 3][2]);
    setBody(b, mass, (const double(*)[3])angular);
    for (int i = 0; i < 6; i++)
        q.load[b][i] = mass * uniform(-1, 1);
}

static void randomJacobian(KeaProblemRow *row) {
    row->body[0] = below(q.numBodies);
    row->body[1] = below(3) == 0 ? MdtKeaWORLD : below(q.numBodies);
    if (row->body[1] == row->body[0])
        row->body[1] = MdtKeaWORLD;
    if (row->body[1] >= 0 && below(2)) {
        const int b = row->body[0];
        row->body[0] = row->body[1];
        row->body[1] = b;
    }
    for (int i = 0; i < 12; i++)
        row->J[i / 6][i % 6] = uniform(-1, 1);
}

static double rateOf(const KeaProblemRow *row, double (*const v)[6]) {
    double sum = 0;
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < 6 && row->body[k] >= 0; c++)
            sum += row->J[k][c] * v[row->body[k]][c];
    return sum;
}

/* Joints, one-sided rows and bounded ones, as much as a velocity v0 obeys, so that there is an answer. */
static void randomLaws(double (*const v0)[6]) {
    for (int i = 0; i < q.numRows; i++) {
        KeaProblemRow *row = &q.row[i];
        const int kind = below(4);
        row->r = rateOf(row, v0);
        if (kind == 1) {
            row->lower = 0;
            row->r -= uniform(0, 1);
        } else if (kind == 2) {
            row->upper = 0;
            row->r += uniform(0, 1);
        } else if (kind == 3) {
            row->lower = -uniform(0.05, 2);
            row->upper = uniform(0.05, 2);
            row->r += uniform(-1, 1);
        }
    }
}

static void randomProblem(int numBodies, int numRows, MeBool isSoft, MeBool isRedundant) {
    double v0[MAX_BODIES][6];
    begin(numBodies, numRows);
    for (int b = 0; b < numBodies; b++) {
        randomBody(b);
        for (int c = 0; c < 6; c++)
            v0[b][c] = uniform(-1, 1);
    }
    for (int i = 0; i < numRows; i++) {
        KeaProblemRow *row = &q.row[i];
        const int model = below(i + 1);
        randomJacobian(row);
        if (isRedundant && model < i && below(2)) { /* a multiple of an earlier row */
            const double share = uniform(-2, 2);
            memcpy(row->body, q.row[model].body, sizeof row->body);
            for (int c = 0; c < 12; c++)
                row->J[c / 6][c % 6] = share * q.row[model].J[c / 6][c % 6];
        }
        row->E = isSoft ? uniform(0.01, 1) : 0;
    }
    randomLaws(v0);
}

/* The method's own softness, as in a step; one for both rows of a cone. */
static void measure(void) {
    cache = MdtKeaCacheCreate();
    ck_assert(kea_problemBegin(&q, cache));
    kea_problemSetEffectiveMasses(&q);
    for (int i = 0; i < q.numRows; i++)
        q.row[i].N = 1e-6 * q.row[i].Aii;
    for (int i = 0; i < q.numRows; i++)
        if (q.row[i].partner > i)
            q.row[i].N = q.row[q.row[i].partner].N = fmax(q.row[i].N, q.row[q.row[i].partner].N);
    memcpy(startLoad, q.load, (size_t)q.numBodies * sizeof *q.load);
    for (int i = 0; i < q.numRows; i++)
        startR[i] = q.row[i].r;
    memset(total, 0, sizeof total);
}

/* Passes, until laws and momentum are kept. The answer: `total` and p. */
static void solve(void) {
    MeBool isDone = MEFALSE;
    measure();
    for (int pass = 0; pass < MAX_PASSES && !isDone; pass++) {
        kea_frictionSetBounds(&q);
        kea_problemSolve(&q, METRUE);
        kea_problemAccumulate(&q, total);
        isDone = kea_problemResidual(&q, NULL) < 1e-13 && kea_problemError(&q) < 1;
    }
}

static void end(void) {
    MdtKeaCacheDestroy(cache);
}

/* ---- the reference: forces only ---- */

typedef struct {
    int n;
    double A[MAX_ROWS][MAX_ROWS], b[MAX_ROWS]; /* A = J B⁻¹ Jᵀ, b = r + J B⁻¹ g */
} Reference;

static Reference ref;

/* B⁻¹ x, by elimination. */
static void divide(int b, const double x[6], double result[6]) {
    double M[6][MAX_ROWS] = {{0}}, y[MAX_ROWS] = {0};
    for (int i = 0; i < 3; i++) {
        M[i][i] = q.metric[b].linear;
        for (int j = 0; j < 3; j++)
            M[3 + i][3 + j] = q.metric[b].angular[i][j];
    }
    memcpy(y, x, 6 * sizeof *x);
    ck_assert_int_eq(eliminate(6, M, y), 6);
    memcpy(result, y, 6 * sizeof *y);
}

static void makeReference(void) {
    ref.n = q.numRows;
    for (int i = 0; i < q.numRows; i++) {
        double v[MAX_BODIES][6] = {{0}}, push[6];
        for (int k = 0; k < 2; k++)
            if (q.row[i].body[k] >= 0)
                divide(q.row[i].body[k], q.row[i].J[k], v[q.row[i].body[k]]);
        for (int j = 0; j < q.numRows; j++)
            ref.A[j][i] = rateOf(&q.row[j], v);
        ref.b[i] = q.row[i].r;
        for (int k = 0; k < 2; k++) {
            if (q.row[i].body[k] < 0)
                continue;
            divide(q.row[i].body[k], q.load[q.row[i].body[k]], push);
            for (int c = 0; c < 6; c++)
                ref.b[i] += q.row[i].J[k][c] * push[c];
        }
    }
}

/* J d + E p - r */
static double missing(int i, const double *p) {
    double sum = q.row[i].E * p[i] - ref.b[i];
    for (int j = 0; j < ref.n; j++)
        sum += ref.A[i][j] * p[j];
    return sum;
}

/* By how much p fails to be the answer, of rows without friction. */
static double violation(const double *p) {
    double worst = 0;
    for (int i = 0; i < ref.n; i++) {
        const KeaProblemRow *row = &q.row[i];
        const double w = missing(i, p);
        worst = fmax(worst, fmax(row->lower - p[i], p[i] - row->upper));
        if (!(p[i] <= row->lower && w > 0) && !(p[i] >= row->upper && w < 0))
            worst = fmax(worst, fabs(w));
    }
    return worst;
}

/* Tries every way of putting rows free, at the lower, or at the upper bound. */
static MeBool enumerate(double *p) {
    int sets = 1;
    for (int i = 0; i < ref.n; i++)
        sets *= 3;
    for (int code = 0; code < sets; code++) {
        double M[MAX_ENUMERATED][MAX_ROWS], x[MAX_ROWS];
        int free[MAX_ENUMERATED], count = 0, c = code;
        MeBool possible = METRUE;
        for (int i = 0; i < ref.n; i++, c /= 3) {
            p[i] = c % 3 == 1 ? q.row[i].lower : c % 3 == 2 ? q.row[i].upper : 0;
            possible = possible && isfinite(p[i]);
            if (c % 3 == 0)
                free[count++] = i;
        }
        if (!possible)
            continue;
        for (int i = 0; i < count; i++) {
            x[i] = -missing(free[i], p);
            for (int j = 0; j < count; j++)
                M[i][j] = ref.A[free[i]][free[j]] + (i == j ? q.row[free[i]].E : 0);
        }
        eliminate(count, M, x);
        for (int i = 0; i < count; i++)
            p[free[i]] = x[i];
        if (violation(p) < 1e-10)
            return METRUE;
    }
    return MEFALSE;
}

/* J d of row i with the forces p, where d = B⁻¹ (Jᵀ p - g). */
static double expectedRate(int i, const double *p) {
    return missing(i, p) - q.row[i].E * p[i] + startR[i];
}

static void assertRates(const double *p, double tolerance, const char *what, unsigned seed) {
    for (int i = 0; i < q.numRows; i++) {
        const double rate = rateOf(&q.row[i], total), expected = expectedRate(i, p);
        ck_assert_msg(fabs(rate - expected) <= tolerance * (1 + fabs(expected)),
                      "%s, seed %u, row %d of %d: J d = %.15g, not %.15g", what, seed, i, q.numRows, rate, expected);
    }
}

static void assertForces(const double *p, double tolerance, const char *what, unsigned seed) {
    double max = 0;
    for (int i = 0; i < q.numRows; i++)
        max = fmax(max, fabs(p[i]));
    for (int i = 0; i < q.numRows; i++)
        ck_assert_msg(fabs(q.row[i].p - p[i]) <= tolerance * max, "%s, seed %u, row %d of %d: p = %.15g, not %.15g",
                      what, seed, i, q.numRows, q.row[i].p, p[i]);
}

/* The bodies' side, B d + g = Jᵀ p. */
static void assertBalance(double tolerance, const char *what, unsigned seed) {
    for (int b = 0; b < q.numBodies; b++) {
        double sum[6], size = q.scale[b];
        memcpy(sum, startLoad[b], sizeof sum);
        for (int i = 0; i < 3; i++) {
            sum[i] += q.metric[b].linear * total[b][i];
            for (int j = 0; j < 3; j++)
                sum[3 + i] += q.metric[b].angular[i][j] * total[b][3 + j];
        }
        for (int i = 0; i < q.numRows; i++)
            for (int k = 0; k < 2; k++)
                for (int c = 0; c < 6 && q.row[i].body[k] == b; c++) {
                    sum[c] -= q.row[i].p * q.row[i].J[k][c];
                    size = fmax(size, fabs(q.row[i].p));
                }
        for (int c = 0; c < 6; c++)
            ck_assert_msg(fabs(sum[c]) <= tolerance * size, "%s, seed %u, body %d: momentum off by %g of %g", what,
                          seed, b, sum[c], size);
    }
}

/* ---- without friction ---- */

static void compareWithEnumeration(unsigned count, MeBool isSoft, MeBool isRedundant, const char *what) {
    unsigned skipped = 0;
    for (unsigned seed = 1; seed <= count; seed++) {
        double p[MAX_ROWS];
        state = seed + (isSoft ? 100000u : 0) + (isRedundant ? 200000u : 0);
        randomProblem(2 + below(3), 1 + below(MAX_ENUMERATED), isSoft, isRedundant);
        makeReference();
        solve();
        if (!enumerate(p)) {
            skipped++; /* singular to 1e-11 */
        } else {
            assertRates(p, 1e-9, what, seed);
            assertBalance(1e-9, what, seed);
            ck_assert_msg(kea_problemResidual(&q, NULL) < 1e-9, "%s, seed %u: %g", what, seed,
                          kea_problemResidual(&q, NULL));
            if (isSoft)
                assertForces(p, 1e-9, what, seed);
        }
        end();
    }
    ck_assert_msg(skipped <= count / 20, "%s: %u of %u skipped", what, skipped, count);
}

TEST(soft_rows_have_the_enumerated_answer) {
    compareWithEnumeration(300, METRUE, MEFALSE, "soft");
}

TEST(rigid_rows_have_the_enumerated_answer) {
    compareWithEnumeration(300, MEFALSE, MEFALSE, "rigid");
}

TEST(redundant_rows_have_the_enumerated_answer) {
    compareWithEnumeration(300, MEFALSE, METRUE, "redundant");
    compareWithEnumeration(100, METRUE, METRUE, "redundant and soft");
}

/* More rows than can be enumerated, and more than the bodies have degrees of freedom: the conditions themselves. */
TEST(large_problems_are_complementary) {
    for (unsigned seed = 1; seed <= 60; seed++) {
        double p[MAX_ROWS];
        state = seed * 7919;
        randomProblem(MAX_BODIES - (int)(seed % 5), MAX_ROWS, seed % 2, seed % 3 == 0);
        makeReference();
        solve();
        for (int i = 0; i < q.numRows; i++)
            p[i] = q.row[i].p;
        assertBalance(1e-9, "large", seed);
        ck_assert_msg(violation(p) < 1e-8, "seed %u: violation %g", seed, violation(p));
        end();
    }
}

/* ---- split rows ---- */

/* Row 0 has four bodies, of which row 1 has two; four joints follow. Their room is that of the pairs of bodies. */
static void splitProblem(MeBool isSoft) {
    enum { ROWS = 6 };
    begin(5, ROWS + MdtKeaSPLITROOM);
    q.numRows = ROWS;
    for (int b = 0; b < q.numBodies; b++)
        randomBody(b);
    for (int i = 0; i < ROWS; i++) {
        randomJacobian(&q.row[i]);
        q.row[i].E = isSoft ? uniform(0.01, 1) : 0;
        q.row[i].r = uniform(-1, 1);
    }
    for (int k = 0; k < 4; k++)
        q.row[k / 2].body[k % 2] = k;
    if (below(2)) { /* or three, the second one the world's */
        q.row[0].body[1] = MdtKeaWORLD;
        q.row[1].body[0] = 4;
    }
    q.row[0].isSplit = q.row[1].isTail = q.row[1].isInactive = METRUE;
    q.row[1].lower = q.row[1].upper = q.row[1].r = q.row[1].E = 0;
}

/* The largest part of B d + g - Jᵀ p, with the split row's force on all of its bodies. */
static double lostMomentum(double (*const d)[6]) {
    double max = 0;
    for (int b = 0; b < q.numBodies; b++) {
        double sum[6];
        kea_applyMetric(sum, &q.metric[b], d[b]);
        for (int c = 0; c < 6; c++)
            sum[c] += startLoad[b][c];
        for (int i = 0; i < q.numRows; i++)
            for (int k = 0; k < 2; k++)
                for (int c = 0; c < 6 && q.row[i].body[k] == b; c++)
                    sum[c] -= q.row[i].J[k][c] * (i == 1 ? q.row[0].p : q.row[i].p);
        for (int c = 0; c < 6; c++)
            max = fmax(max, fabs(sum[c]));
    }
    return max;
}

TEST(a_split_row_is_one_row_of_four_bodies) {
    for (unsigned seed = 1; seed <= 100; seed++) {
        state = seed * 77;
        splitProblem(seed % 2);
        solve();
        assert_near(lostMomentum(total), 0, 1e-9);
        for (int i = 0; i < q.numRows; i++) {
            const double rate = rateOf(&q.row[i], total) + (i == 0 ? rateOf(&q.row[1], total) : 0);
            if (i != 1)
                assert_near(rate + q.row[i].E * q.row[i].p, startR[i], 1e-9);
        }
        ck_assert(q.row[0].p != 0 && q.row[1].p == 0);
        end();
    }
}

/* Sweeps keep momentum, too, and come near. */
TEST(a_split_row_in_sweeps) {
    for (unsigned seed = 1; seed <= 20; seed++) {
        state = seed * 77;
        splitProblem(METRUE);
        measure();
        q.counts.isLimited = METRUE;
        q.maxWork = 1e9;
        q.sweptPasses = 1;
        kea_problemSolve(&q, METRUE);
        assert_near(lostMomentum(q.d), 0, 1e-11);
        const double rate = rateOf(&q.row[0], q.d) + rateOf(&q.row[1], q.d);
        assert_near(rate + q.row[0].E * q.row[0].p, startR[0], 1e-6);
        end();
    }
}

/* What a residual is: a law that is not kept by so many m/s, as far as the row's own softness does not take them. */
TEST(residual_tells_what_is_missing) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        state = seed * 31;
        randomProblem(3, 5, seed % 2, MEFALSE);
        solve();
        ck_assert_msg(kea_problemResidual(&q, NULL) < 1e-12, "seed %u: %g", seed, kea_problemResidual(&q, NULL));
        for (int i = 0; i < q.numRows; i++) {
            KeaProblemRow *row = &q.row[i];
            const double r = row->r;
            if (row->p <= row->lower || row->p >= row->upper)
                continue;
            row->r += 1e-3 * fmin(1, row->Aii * fmin(row->p - row->lower, row->upper - row->p));
            assert_near_rel(kea_problemResidual(&q, NULL), (row->r - r) * row->Aii / (row->Aii + row->E),
                            TOL(5e-7, 4e-9));
            row->r = r;
        }
        end();
    }
}

/* Of an answer that passes leave when they run out, 1e-6 of a row's size, 1e-6 of the momentum that is tolerated
 * and 1e-4 of the speed may be missing. */
TEST(answers_are_exact_enough_to_a_millionth) {
    for (int k = 0; k < 2; k++) {
        const double share = k ? 1.4 : 0.7;
        KeaResiduals e[3] = {{.worst = 0}};
        e[0].position = share * 1e-6 / kea_positionTolerance;
        e[1].velocity = share * 1e-4 / kea_velocityTolerance;
        e[2].momentum = share * 1e-6 / kea_newtonTolerance;
        for (int i = 0; i < 3; i++)
            ck_assert_int_eq(kea_isExactEnough(&e[i], 1), !k);
    }
}

/* Two joints that contradict each other, 1 and -1 m/s along one direction: half way, with finite impulses. */
TEST(contradictory_rows_end_in_a_compromise) {
    const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    begin(1, 2);
    setBody(0, 1, unit);
    for (int i = 0; i < 2; i++) {
        q.row[i].body[0] = 0;
        q.row[i].J[0][0] = 1;
        q.row[i].r = i ? -1 : 1;
    }
    measure();
    ck_assert(kea_problemSolve(&q, METRUE));
    assert_near(q.d[0][0], 0, 9e-16);
    assert_near_rel(q.row[0].p, 1e6, TOL(5e-7, 9e-16)); /* r / N */
    assert_near_rel(q.row[1].p, -1e6, TOL(5e-7, 9e-16));
    kea_problemAccumulate(&q, total);
    assert_near(kea_problemResidual(&q, NULL), 1, 9e-16);
    end();
}

TEST(equal_bounds_are_kept) {
    const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    begin(1, 2);
    setBody(0, 2, unit);
    for (int i = 0; i < 2; i++) {
        q.row[i].body[1] = 0; /* the second place is as good as the first */
        q.row[i].J[1][i] = 1;
        q.row[i].r = 5;
    }
    q.row[0].lower = q.row[0].upper = 1;
    solve();
    ck_assert(q.row[0].p == 1);
    assert_near(total[0][0], 0.5, 5e-16);
    assert_near(total[0][1], 5, 5e-15);
    assert_near(q.row[1].p, 10, 2e-14);
    end();
}

TEST(rows_that_are_off_keep_their_impulse) {
    for (unsigned seed = 1; seed <= 20; seed++) {
        state = seed;
        randomProblem(2, 4, MEFALSE, MEFALSE);
        q.row[2].isInactive = METRUE;
        q.row[2].p = q.row[2].p0 = 0.3;
        solve();
        ck_assert(q.row[2].p == 0.3);
        assertBalance(1e-9, "off", seed);
        end();
    }
}

/* The iterations stop: impulses are within bounds all the same. */
TEST(a_capped_solve_stays_within_bounds) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        state = seed * 104729;
        randomProblem(8, 40, MEFALSE, seed % 2);
        q.maxIterations = 1;
        measure();
        kea_problemSolve(&q, METRUE);
        ck_assert_int_eq(q.counts.iterations, 1);
        for (int i = 0; i < q.numRows; i++)
            ck_assert_msg(q.row[i].p >= q.row[i].lower && q.row[i].p <= q.row[i].upper && isfinite(q.row[i].p),
                          "seed %u row %d", seed, i);
        end();
    }
}

/* From the answer, nothing is factored any more. */
TEST(a_repeated_solve_is_warm) {
    for (unsigned seed = 1; seed <= 30; seed++) {
        state = seed * 17;
        randomProblem(5, 12, MEFALSE, MEFALSE);
        solve();
        const KeaCounts before = q.counts;
        ck_assert_int_gt(before.factorizations, 0);
        ck_assert(kea_problemSolve(&q, METRUE));
        ck_assert_msg(q.counts.factorizations == before.factorizations, "seed %u", seed);
        ck_assert_msg(q.counts.iterations == before.iterations, "seed %u", seed);
        end();
    }
}

/* ---- friction ---- */

/* Rows i, i + 1, i + 2: the normal and a cone, at a point with the arm r, of body a against b (or the world). */
static void setContact(int i, int a, int b, const double frame[3][3], const double arm[2][3], double mu) {
    for (int k = 0; k < 3; k++) {
        KeaProblemRow *row = &q.row[i + k];
        row->body[0] = a;
        row->body[1] = b;
        for (int s = 0; s < 2; s++) {
            const double sign = s ? -1 : 1, *r = arm[s], *n = frame[k];
            for (int c = 0; c < 3; c++) {
                row->J[s][c] = sign * n[c];
                row->J[s][3 + c] = sign * (r[(c + 1) % 3] * n[(c + 2) % 3] - r[(c + 2) % 3] * n[(c + 1) % 3]);
            }
        }
        row->normal = k ? i : -1;
        row->partner = k ? i + 3 - k : -1;
        row->friction = k ? mu : 0;
    }
    q.row[i].lower = 0;
}

/* An orthonormal frame; the first vector is not far from y. */
static void randomFrame(double frame[3][3]) {
    const double y[3] = {uniform(-0.3, 0.3), 1, uniform(-0.3, 0.3)}, x[3] = {1, uniform(-1, 1), uniform(-1, 1)};
    double length = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]), along = 0;
    for (int i = 0; i < 3; i++)
        along += (frame[0][i] = y[i] / length) * x[i];
    for (int i = 0; i < 3; i++)
        frame[1][i] = x[i] - along * frame[0][i];
    length = sqrt(frame[1][0] * frame[1][0] + frame[1][1] * frame[1][1] + frame[1][2] * frame[1][2]);
    for (int i = 0; i < 3; i++)
        frame[1][i] /= length;
    for (int i = 0; i < 3; i++)
        frame[2][i] = frame[0][(i + 1) % 3] * frame[1][(i + 2) % 3] - frame[0][(i + 2) % 3] * frame[1][(i + 1) % 3];
}

/* By how much the impulses of contacts fail Coulomb's law: Signorini's, and friction against the slip at its bound. */
static double coulombViolation(const double *p) {
    double worst = 0;
    for (int i = 0; i + 2 < ref.n; i += 3) {
        const double w = missing(i, p), u = missing(i + 1, p), v = missing(i + 2, p), slip = hypot(u, v);
        const double radius = q.row[i + 1].friction * p[i], force = hypot(p[i + 1], p[i + 2]);
        worst = fmax(worst, p[i] > 0 ? fabs(w) : fmax(-w, -p[i]));
        worst = fmax(worst, force - radius);
        if (force < radius * (1 - 1e-9))
            worst = fmax(worst, slip);
        else /* |slip| force = -slip·force */
            worst = fmax(worst, slip * force + u * p[i + 1] + v * p[i + 2]);
    }
    return worst;
}

/* The slip at the bound, in the direction across the friction that pushes towards `angle`; p: the impulses. */
static double across(double angle, double mu, double *p, double *along) {
    const double e[2] = {cos(angle), sin(angle)};
    p[0] = ref.b[0] / (ref.A[0][0] + mu * (ref.A[0][1] * e[0] + ref.A[0][2] * e[1]));
    p[1] = mu * p[0] * e[0];
    p[2] = mu * p[0] * e[1];
    const double u = missing(1, p), v = missing(2, p);
    *along = u * e[0] + v * e[1];
    return v * e[0] - u * e[1];
}

/* One round of projected relaxation; returns the largest change. */
static double relaxOnce(double *p) {
    double change = 0;
    for (int i = 0; i + 2 < ref.n; i += 3) {
        const double old[3] = {p[i], p[i + 1], p[i + 2]}, softest = ref.A[i + 1][i + 1] + ref.A[i + 2][i + 2];
        p[i] = fmax(0, p[i] - missing(i, p) / ref.A[i][i]);
        const double a = p[i + 1] - missing(i + 1, p) / softest, b = p[i + 2] - missing(i + 2, p) / softest;
        const double radius = q.row[i + 1].friction * p[i], size = hypot(a, b);
        const double share = size > radius ? radius / size : 1;
        p[i + 1] = share * a;
        p[i + 2] = share * b;
        for (int c = 0; c < 3; c++)
            change = fmax(change, fabs(p[i + c] - old[c]));
    }
    return change;
}

/* Until what is left, judged by the rate at which changes fall, is below 1e-12: slow, and its fixed points are the
 * answers. False: it does not settle. */
static MeBool relax(double *p) {
    enum { ROUNDS = 100 };
    memset(p, 0, (size_t)ref.n * sizeof *p);
    double before = relaxOnce(p);
    for (int k = 0; k < 3000; k++) {
        double change = 0;
        for (int i = 0; i < ROUNDS; i++)
            change = relaxOnce(p);
        const double rate = pow(change / before, 1.0 / ROUNDS);
        if (change == 0 || (rate < 1 && change * rate / (1 - rate) < 1e-12))
            return METRUE;
        before = change;
    }
    return MEFALSE;
}

/* One body at two points, or one body on another that lies on the ground. */
TEST(pairs_of_contacts_are_fixed_points) {
    int settled = 0, count[3] = {0}; /* open, sticking, sliding */
    for (unsigned seed = 1; seed <= 150; seed++) {
        double frame[3][3], arm[2][3], p[MAX_ROWS];
        state = seed * 1299709;
        const int numBodies = 1 + (int)(seed % 2);
        begin(numBodies, 6);
        for (int b = 0; b < numBodies; b++) {
            randomBody(b);
            q.load[b][1] = q.metric[b].linear * uniform(-0.2, 1.5); /* mostly downwards */
        }
        for (int i = 0; i < 2; i++) {
            randomFrame(frame);
            for (int c = 0; c < 6; c++)
                arm[c / 3][c % 3] = (c == 1 ? -0.5 : c == 4 ? 0.5 : 0) + uniform(-0.4, 0.4);
            arm[0][0] += i ? 0.6 : -0.6;
            if (i == 0 || numBodies == 1)
                setContact(3 * i, 0, MdtKeaWORLD, (const double(*)[3])frame, (const double(*)[3])arm,
                           uniform(0.05, 0.5));
            else
                setContact(3 * i, 1, 0, (const double(*)[3])frame, (const double(*)[3])arm, uniform(0.05, 0.5));
        }
        makeReference();
        const MeBool isKnown = relax(p);
        solve();
        if (isKnown) {
            settled++;
            assertForces(p, 1e-9, "pair", seed);
            assertRates(p, 1e-9, "pair", seed);
        }
        for (int i = 0; i < 6; i++)
            p[i] = q.row[i].p;
        for (int i = 0; i < 6; i += 3)
            count[p[i] == 0 ? 0 : hypot(p[i + 1], p[i + 2]) < q.row[i + 1].friction * p[i] * (1 - 1e-9) ? 1 : 2]++;
        ck_assert_msg(coulombViolation(p) < 1e-9, "seed %u: %g", seed, coulombViolation(p));
        ck_assert_msg(kea_problemResidual(&q, NULL) < 1e-10, "seed %u: %g", seed, kea_problemResidual(&q, NULL));
        assertBalance(1e-9, "pair", seed);
        end();
    }
    ck_assert_msg(settled > 140 && count[0] > 10 && count[1] > 15 && count[2] > 100, "%d settled, %d %d %d", settled,
                  count[0], count[1], count[2]);
}

/* Two friction rows that share no cone bound each force by itself: a pyramid. */
TEST(a_pyramid_bounds_each_row) {
    const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, arm[2][3] = {{0}};
    const double frame[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    begin(1, 3);
    setBody(0, 1, unit);
    setContact(0, 0, MdtKeaWORLD, frame, arm, 0.5);
    q.row[1].partner = q.row[2].partner = -1;
    q.row[2].friction = 0.25;
    q.row[2].upper = 0.1; /* and a bound of its own */
    q.load[0][1] = 1;
    q.load[0][2] = 0.3; /* sticks */
    q.load[0][0] = -2;  /* slides, against a lower bound */
    solve();
    assert_near(q.row[0].p, 1, 9e-16);
    assert_near(q.row[1].p, 0.3, 3e-16);
    assert_near(q.row[2].p, -0.25, 3e-16);
    end();
    begin(1, 3);
    setBody(0, 1, unit);
    setContact(0, 0, MdtKeaWORLD, frame, arm, 0.5);
    q.row[1].partner = q.row[2].partner = -1;
    q.row[2].upper = 0.1;
    q.load[0][1] = 1;
    q.load[0][0] = 2;
    solve();
    assert_near(q.row[2].p, 0.1, 9e-17);
    assert_near(total[0][0], -1.9, 2e-15);
    end();
}

/* A slide in a known direction: the friction is that part of the bound, whatever the slip. */
TEST(forced_friction_follows_the_normal_force) {
    for (unsigned seed = 1; seed <= 40; seed++) {
        double frame[3][3], arm[2][3] = {{0, -0.5, 0}, {0, 0, 0}};
        state = seed * 11;
        const double angle = uniform(-3, 3), mu = uniform(0.1, 0.5);
        begin(1, 3);
        randomBody(0);
        randomFrame(frame);
        setContact(0, 0, MdtKeaWORLD, (const double(*)[3])frame, (const double(*)[3])arm, mu);
        q.load[0][1] = q.metric[0].linear * uniform(0.5, 1);
        for (int k = 1; k < 3; k++) {
            q.row[k].isForced = METRUE;
            q.row[k].forced = k == 1 ? cos(angle) : sin(angle);
        }
        makeReference();
        solve();
        double p[MAX_ROWS], along;
        across(angle, mu, p, &along);
        if (p[0] > 0) {
            assertForces(p, 1e-9, "forced", seed);
            assertRates(p, 1e-9, "forced", seed);
        }
        ck_assert_msg(kea_problemResidual(&q, NULL) < 1e-10, "seed %u: %g", seed, kea_problemResidual(&q, NULL));
        end();
    }
}

/* ---- sweeps ---- */

/* A column of balls, each on the one below, the lowest on the ground, that a step's weight acts on. */
static void makeColumn(void) {
    const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    begin(MAX_BODIES, MAX_BODIES);
    for (int b = 0; b < MAX_BODIES; b++) {
        setBody(b, 1, unit);
        q.load[b][1] = 1;
        q.row[b].body[0] = b;
        q.row[b].body[1] = b > 0 ? b - 1 : MdtKeaWORLD;
        q.row[b].J[0][1] = 1;
        q.row[b].J[1][1] = -1;
        q.row[b].lower = 0;
    }
}

/* Row by row an impulse goes one ball far in a sweep, and 32 plain ones leave .6 of the error. */
TEST(sweeps_carry_weight_down_a_column) {
    makeColumn();
    measure();
    q.sweptPasses = 1;
    kea_problemSweep(&q);
    kea_problemAccumulate(&q, total);
    assertBalance(1e-12, "column", 0);
    for (int i = 0; i < q.numRows; i++)
        assert_near(q.row[i].p, MAX_BODIES - i, 0.03);
    assert_below(kea_problemResidual(&q, NULL), 0.006);
    end();
}

/* Whatever else there is, rows without bounds are solved directly, if they can be. */
TEST(joints_hold_after_sweeps) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        state = seed * 15485863;
        randomProblem(8, 24, seed % 2, MEFALSE);
        measure();
        q.sweptPasses = 1;
        kea_problemSweep(&q);
        for (int i = 0; i < q.numRows; i++) {
            const KeaProblemRow *row = &q.row[i];
            if (row->lower == -HUGE_VAL && row->upper == HUGE_VAL)
                ck_assert_msg(fabs(row->Jd + row->E * row->p - row->r) < 1e-4, "seed %u, row %d: %g", seed, i,
                              row->Jd + row->E * row->p - row->r);
        }
        kea_problemAccumulate(&q, total);
        assertBalance(1e-9, "joints", seed);
        end();
    }
}

/* Bodies that meet at contacts with friction, after however few sweeps: they have no more energy than before, and
 * friction is within its cone. */
TEST(sweeps_gain_no_energy) {
    for (unsigned seed = 1; seed <= 200; seed++) {
        double v[MAX_BODIES][6], before = 0, after = 0;
        state = seed * 104729;
        begin(6, 30);
        for (int b = 0; b < q.numBodies; b++) {
            randomBody(b);
            memset(q.load[b], 0, sizeof q.load[b]);
            for (int c = 0; c < 6; c++)
                v[b][c] = uniform(-1, 1);
        }
        for (int i = 0; i < q.numRows; i += 3) {
            const int a = below(q.numBodies), b = below(q.numBodies);
            double frame[3][3], arm[2][3];
            for (int k = 0; k < 6; k++)
                arm[k / 3][k % 3] = uniform(-1, 1);
            randomFrame(frame);
            setContact(i, a, a == b ? MdtKeaWORLD : b, (const double(*)[3])frame, (const double(*)[3])arm,
                       uniform(0, 2));
            for (int k = 0; k < 3; k++)
                q.row[i + k].r = -rateOf(&q.row[i + k], v);
        }
        measure();
        q.sweptPasses = 1;
        q.maxWork = kea_problemWorkOfSweptPass(&q, KEA_FEWEST_SWEEPS + (int)seed % 12);
        kea_problemSweep(&q);
        for (int b = 0; b < q.numBodies; b++) {
            before += kea_energyOf(&q.metric[b], v[b], v[b]);
            for (int c = 0; c < 6; c++)
                v[b][c] += q.d[b][c];
            after += kea_energyOf(&q.metric[b], v[b], v[b]);
        }
        ck_assert_msg(after <= before * (1 + 1e-12), "seed %u: %g J, before %g J", seed, after, before);
        for (int i = 0; i < q.numRows; i += 3)
            ck_assert_msg(hypot(q.row[i + 1].p, q.row[i + 2].p) <= q.row[i + 1].friction * q.row[i].p * (1 + 1e-12),
                          "seed %u, row %d", seed, i);
        end();
    }
}
