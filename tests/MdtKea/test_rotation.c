/* What of free rotation is exact, and the splitting of inertia tensors. */
#include "kea_i.h"
#include "karma_test.h"

static MdtKeaBody bodyWith(double a, double b, double c) {
    MdtKeaBody body = {.quaternion = {1, 0, 0, 0}, .invMass = 1, .flags = MdtKeaBodyFlagAddCoriolisForce};
    const double inertia[3][3] = {{a, 0, 0}, {0, b, 0}, {0, 0, c}};
    ck_assert(MdtKeaBodySetInertia(&body, inertia));
    return body;
}

static double distance(const double p[4], const double q[4]) {
    double plus = 0, minus = 0;
    for (int i = 0; i < 4; i++) {
        plus += (p[i] + q[i]) * (p[i] + q[i]);
        minus += (p[i] - q[i]) * (p[i] - q[i]);
    }
    return sqrt(fmin(plus, minus));
}

static void rotate(const MdtKeaBody *body, double q[4], const double L[3], double time, int n) {
    for (int i = 0; i < n; i++)
        kea_rotateFree(body, q, L, time / n, q);
}

/* A disc that wobbles, and a rod that turns across its axis and a little about it: a tilt of the axis by a rounding is
 * 60 / 2e-4 x 1.1e-16 = 3e-11 rad about it in this time, and 1000 of them add up to 1e-9. */
TEST(a_symmetric_top_is_exact) {
    const double moments[2][3] = {{2, 2, .5}, {1, 1, 2e-4}}, L[2][3] = {{30, 0, 40}, {0, 60, 3e-3}};
    for (int k = 0; k < 2; k++) {
        const MdtKeaBody body = bodyWith(moments[k][0], moments[k][1], moments[k][2]);
        double once[4] = {1, 0, 0, 0}, often[4] = {1, 0, 0, 0};
        rotate(&body, once, L[k], 1, 1);
        rotate(&body, often, L[k], 1, 1000);
        assert_below(distance(once, often), k == 0 ? 1e-12 : 1e-9);
    }
}

/* Back and forth is the identity: the splitting is symmetric. */
TEST(free_rotation_is_reversible) {
    const MdtKeaBody body = bodyWith(1, 2, 3);
    const double L[3] = {7, -11, 4}, start[4] = {1, 0, 0, 0};
    double q[4] = {1, 0, 0, 0};
    rotate(&body, q, L, 1, 60);
    rotate(&body, q, L, -1, 60);
    assert_below(distance(q, start), 1e-12);
}

static double energyOf(const MdtKeaBody *body, const double q[4], const double L[3]) {
    double w[3];
    kea_angularVelocity(body, q, L, w);
    return keaDot(L, w) / 2;
}

/* About the axis that free rotation leaves: a box of 1 x .5 x .2 m turns over and over. */
TEST(whirling_about_the_middle_axis_keeps_its_energy) {
    const double speed[] = {30, 300, 3000, 18000}, h = 1. / 60;
    const MdtKeaBody body = bodyWith(.29, 1.04, 1.25);
    for (int k = 0; k < 4; k++) {
        const double L[3] = {1e-3 * speed[k], 1.04 * speed[k], 1e-3 * speed[k]};
        double q[4] = {1, 0, 0, 0}, worst = 0;
        const double start = energyOf(&body, q, L);
        for (int i = 0; i < 600; i++) {
            kea_rotateFree(&body, q, L, h, q);
            worst = fmax(worst, fabs(energyOf(&body, q, L) / start - 1));
        }
        ck_assert_msg(worst < 1e-7, "%g rad/s: %g of the energy", speed[k], worst);
    }
}

TEST(inertia_tensors_split_into_moments_and_axes) {
    const double turn[4] = {.3, .5, -.7, .2}, moments[3] = {1e-3, 2, 5};
    double q[4], R[3][3], tensor[3][3], back[3][3];
    memcpy(q, turn, sizeof q);
    keaQuaternionNormalize(q);
    keaQuaternionToMatrix(R, q);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[i][j] =
                R[i][0] * moments[0] * R[j][0] + R[i][1] * moments[1] * R[j][1] + R[i][2] * moments[2] * R[j][2];
    MdtKeaBody body = {.quaternion = {1, 0, 0, 0}};
    ck_assert(MdtKeaBodySetInertia(&body, (const double(*)[3])tensor));
    assert_near(body.moments[0] + body.moments[1] + body.moments[2], 7.001, 7e-15);
    kea_principalAxes(&body, body.quaternion, R);
    kea_inverseInertiaBy(body.moments, (const double(*)[3])R, back);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double product = 0;
            for (int k = 0; k < 3; k++)
                product += back[i][k] * tensor[k][j];
            assert_near(product, i == j ? 1 : 0, 5e-12);
        }
}

TEST(bad_tensors_are_refused) {
    const double bad[][3][3] = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}},   {{1, 2, 0}, {2, 1, 0}, {0, 0, 1}},
                                {{1, .5, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                {{1, 0, 0}, {0, NAN, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, HUGE_VAL, 0}, {0, 0, 1}}};
    for (int i = 0; i < 6; i++) {
        MdtKeaBody body = bodyWith(1, 2, 3);
        ck_assert_msg(!MdtKeaBodySetInertia(&body, bad[i]), "tensor %d", i);
        ck_assert(body.moments[0] == 1 && body.moments[1] == 2 && body.moments[2] == 3);
    }
}

/* A tensor may be as crooked as arithmetic of a program leaves it, and as flat as a sheet. */
TEST(tensors_are_refused_where_they_are_said_to_be) {
    for (int k = 0; k < 3; k++)
        for (int isBad = 0; isBad < 2; isBad++) {
            double crooked[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, flat[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            MdtKeaBody body = bodyWith(1, 2, 3);
            crooked[k][(k + 1) % 3] = isBad ? 2.02e-5 : 1.98e-5;
            flat[k][k] = isBad ? .98e-12 : 1.02e-12;
            ck_assert_int_eq(MdtKeaBodySetInertia(&body, (const double(*)[3])crooked), !isBad);
            ck_assert_int_eq(MdtKeaBodySetInertia(&body, (const double(*)[3])flat), !isBad);
        }
}

/* ---- clamped matrices ---- */

/* All principal minors: >= 0 if and only if no eigenvalue is negative. */
static double minMinor(const double M[3][3]) {
    double min = HUGE_VAL, det = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        min = fmin(min, fmin(M[i][i], M[i][i] * M[j][j] - M[i][j] * M[j][i]));
        det += M[0][i] * (M[1][j] * M[2][k] - M[1][k] * M[2][j]);
    }
    return fmin(min, det);
}

/* The nearest matrix without negative eigenvalues, and the only one K₊ with K₊ >= 0, K₊ - K >= 0, K₊ (K₊ - K) = 0. Of
 * eigenvalues apart, equal in pairs, and 0, at all angles. */
TEST(clamping_takes_the_negative_part_away) {
    static const double sets[][3] = {{-1, 2, 3},    {-3, -2, 1},   {-3, -1, -2},  {-1, 2, 2}, {-2, -2, 1},
                                     {-1, -1, -1},  {-1, 0, 0},    {-1, -1, 0},   {-1, 0, 1}, {1, 1, -2},
                                     {-1e-9, 1, 2}, {-1, 1e-9, 2}, {-1, -1, 1e-9}};
    for (unsigned int i = 0; i < sizeof sets / sizeof sets[0]; i++)
        for (int angle = 0; angle < 40; angle++) {
            double q[4] = {cos(angle), sin(1.7 * angle), cos(.3 * angle), sin(.9 * angle)}, R[3][3];
            double K[3][3] = {{0}}, clamped[3][3], taken[3][3], product[3][3] = {{0}};
            keaQuaternionNormalize(q);
            keaQuaternionToMatrix(R, q);
            for (int j = 0; j < 9; j++)
                for (int k = 0; k < 3; k++)
                    K[j / 3][j % 3] += R[j / 3][k] * sets[i][k] * R[j % 3][k];
            memcpy(clamped, K, sizeof K);
            kea_clampPositive(clamped, 0);
            for (int j = 0; j < 9; j++)
                taken[j / 3][j % 3] = clamped[j / 3][j % 3] - K[j / 3][j % 3];
            for (int j = 0; j < 9; j++)
                for (int k = 0; k < 3; k++)
                    product[j / 3][j % 3] += clamped[j / 3][k] * taken[k][j % 3];
            ck_assert_msg(minMinor((const double(*)[3])clamped) > -1e-13, "set %u, angle %d: negative", i, angle);
            ck_assert_msg(minMinor((const double(*)[3])taken) > -1e-13, "set %u, angle %d: too little", i, angle);
            ck_assert_msg(kea_largestEntry((const double(*)[3])product) < 1e-13, "set %u, angle %d: not across", i,
                          angle);
        }
}

/* Unless what is negative does no harm. */
TEST(harmless_matrices_stay) {
    double K[3][3] = {{1, 0, 0}, {0, -.1, 0}, {0, 0, 2}};
    kea_clampPositive(K, .11);
    ck_assert(K[1][1] == -.1);
    kea_clampPositive(K, .09);
    assert_near(K[1][1], 0, 1e-15);
    assert_near(K[0][0], 1, 1e-15);
    assert_near(K[2][2], 2, 1e-15);
}
