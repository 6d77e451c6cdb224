/* Rotation of a rigid body: inertia in its principal axes, and the torque-free motion over a step.
 *
 * With principal moments I and a reference axis r, the energy of free rotation splits into
 *
 *     H = |L|² / (2 I_r)  +  sum over i != r of  L_i²/2 (1/I_i - 1/I_r),        L in principal axes.
 *
 * The first part rotates the body about L and commutes with the others; each of the two others rotates it about one
 * principal axis. All three are solved exactly, so that |L| is conserved in any order, and the energy closely in a
 * symmetric one. Fast rotation uses Blanes and Moan's S6 of order 4 (Practical symplectic partitioned Runge-Kutta
 * methods, 2002), slow rotation the leapfrog of order 2. The reference axis is that of the middle moment: for a
 * symmetric top it is one of the two equal ones, and the splitting is exact.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* The exact flow, for time t, of the part of H of one principal axis: multiplies q by its rotation from the right, and
 * rotates L (principal axes) by the inverse. */
static void flowAboutAxis(double q[4], double L[3], int axis, double rate, double t) {
    const double half = 0.5 * t * rate * L[axis];
    const double sh = sin(half), ch = cos(half);
    double turn[4] = {ch, 0, 0, 0};
    turn[1 + axis] = sh;
    keaQuaternionProduct(q, q, turn);
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const double c = 1 - 2 * sh * sh, s = 2 * sh * ch;
    const double Lj = c * L[j] + s * L[k];
    L[k] = c * L[k] - s * L[j];
    L[j] = Lj;
}

/* The splitting of H: its two parts about axes other than the reference axis r. */
typedef struct {
    int a, b;            /* these axes */
    double rateA, rateB; /* 1/I_i - 1/I_r */
} Split;

static void leapfrog(double q[4], double L[3], const Split *s, double h) {
    flowAboutAxis(q, L, s->a, s->rateA, 0.5 * h);
    flowAboutAxis(q, L, s->b, s->rateB, h);
    flowAboutAxis(q, L, s->a, s->rateA, 0.5 * h);
}

static void blanesMoan4(double q[4], double L[3], const Split *s, double h) {
    static const double a[3] = {.0792036964311957, .353172906049774, -.0420650803577195};
    static const double b[2] = {.209515106613362, -.143851773179818};
    const double A[7] = {a[0], a[1], a[2], 1 - 2 * (a[0] + a[1] + a[2]), a[2], a[1], a[0]};
    const double B[6] = {b[0], b[1], .5 - b[0] - b[1], .5 - b[0] - b[1], b[1], b[0]};
    for (int i = 0; i < 7; i++) {
        flowAboutAxis(q, L, s->a, s->rateA, A[i] * h);
        if (i < 6)
            flowAboutAxis(q, L, s->b, s->rateB, B[i] * h);
    }
}

/* Divides the step into substeps that are short enough for the splitting. A symmetric top, for which it is exact, needs
 * one: a rod that rotates across its axis has rates of thousands of radians a step about it. */
static void rotateFast(double q[4], double L[3], const Split *s, double h, double angle) {
    const MeBool isExact = s->rateA == 0 || s->rateB == 0;
    const int numSubsteps = isExact ? 1 : (int)keaMin(ceil(angle / kea_fastRotation), KEA_MAX_ROTATIONS);
    for (int i = 0; i < numSubsteps; i++)
        blanesMoan4(q, L, s, h / numSubsteps);
}

/* The axis of the middle one of three moments. */
static int middleAxis(const double I[3]) {
    for (int i = 0; i < 3; i++) {
        const double x = I[(i + 1) % 3], y = I[(i + 2) % 3];
        if ((x <= I[i] && I[i] <= y) || (y <= I[i] && I[i] <= x))
            return i;
    }
    return 0;
}

/* The orientation of the principal axes in the world, as quaternion and as matrix. */
static void orientPrincipalAxes(const MdtKeaBody *body, const double q[4], double qp[4], double R[3][3]) {
    if (body->locked & MdtKeaLOCKEDROTATIONS)
        memcpy(qp, body->principal, sizeof body->principal);
    else
        keaQuaternionProduct(qp, q, body->principal);
    keaQuaternionToMatrix(R, qp);
}

/* Rotation without Coriolis term: the angular velocity is constant through the step. */
static void rotateSteadily(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]) {
    double w[3], turn[4];
    kea_angularVelocity(body, q0, L, w);
    keaScale(w, h, w);
    keaQuaternionExp(turn, w);
    keaQuaternionProduct(q1, turn, q0);
    keaQuaternionNormalize(q1);
}

void kea_rotateFree(const MdtKeaBody *body, const double q0[4], const double L[3], double h, double q1[4]) {
    if (kea_isSteady(body)) {
        rotateSteadily(body, q0, L, h, q1);
        return;
    }
    double q[4], R[3][3], l[3], u[3], turn[4], back[4];
    orientPrincipalAxes(body, q0, q, R);
    keaApplyTransposed(l, (const double(*)[3])R, L);

    const double *I = body->moments;
    const int r = middleAxis(I), a = (r + 1) % 3, b = (r + 2) % 3;
    keaScale(u, h / I[r], l);
    keaQuaternionExp(turn, u);
    keaQuaternionProduct(q, q, turn);

    const Split split = {a, b, 1 / I[a] - 1 / I[r], 1 / I[b] - 1 / I[r]};
    const double angle = fabs(h) * keaLength(L) * (fabs(split.rateA) + fabs(split.rateB));
    if (angle > kea_slowRotation)
        rotateFast(q, l, &split, h, angle);
    else if (angle > 0)
        leapfrog(q, l, &split, h);

    keaQuaternionConjugate(back, body->principal);
    keaQuaternionProduct(q1, q, back);
    keaQuaternionNormalize(q1);
}

void kea_rotateByChord(const double q0[4], double q1[4]) {
    double back[4], turn[4];
    keaQuaternionConjugate(back, q0);
    keaQuaternionProduct(turn, q1, back);
    const double sine = keaLength(turn + 1), half = atan2(sine, turn[0]);
    if (sine == 0 || half > 0.5 * kea_maxChord)
        return;
    turn[0] = 1;
    keaScale(turn + 1, half / sine, turn + 1);
    keaQuaternionProduct(q1, turn, q0);
    keaQuaternionNormalize(q1);
}

void kea_principalAxes(const MdtKeaBody *body, const double q[4], double R[3][3]) {
    double qp[4];
    orientPrincipalAxes(body, q, qp, R);
}

void kea_angularVelocityBy(const double moments[3], const double R[3][3], const double L[3], double w[3]) {
    double l[3];
    keaApplyTransposed(l, R, L);
    for (int i = 0; i < 3; i++)
        l[i] /= moments[i];
    keaApply(w, R, l);
}

void kea_angularVelocity(const MdtKeaBody *body, const double q[4], const double L[3], double w[3]) {
    double R[3][3];
    kea_principalAxes(body, q, R);
    kea_angularVelocityBy(body->moments, (const double(*)[3])R, L, w);
}

void kea_angularMomentum(const MdtKeaBody *body, const double q[4], const double w[3], double L[3]) {
    double R[3][3], l[3];
    kea_principalAxes(body, q, R);
    keaApplyTransposed(l, (const double(*)[3])R, w);
    for (int i = 0; i < 3; i++)
        l[i] *= body->moments[i];
    keaApply(L, (const double(*)[3])R, l);
}

void kea_inverseInertiaBy(const double moments[3], const double R[3][3], double inverse[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += R[i][k] * R[j][k] / moments[k];
            inverse[i][j] = inverse[j][i] = sum;
        }
    }
}

void kea_inertia(const MdtKeaBody *body, const double q[4], double inertia[3][3]) {
    double R[3][3];
    kea_principalAxes(body, q, R);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += R[i][k] * R[j][k] * body->moments[k];
            inertia[i][j] = inertia[j][i] = sum;
        }
    }
}

void MEAPI MdtKeaBodyGetAngularVelocity(const MdtKeaBody *body, double w[3]) {
    kea_angularVelocity(body, body->quaternion, body->angularMomentum, w);
}

void MEAPI MdtKeaBodySetAngularVelocity(MdtKeaBody *body, const double w[3]) {
    kea_angularMomentum(body, body->quaternion, w, body->angularMomentum);
}

MeBool kea_hasEqualMoments(const double I[3]) {
    return kea_maxOf(I) - kea_minOf(I) < kea_equalMoments * kea_maxOf(I);
}

MeBool kea_turnsFar(const double I[3], double angle, double far) {
    return angle * (kea_maxOf(I) - kea_minOf(I)) > far * kea_maxOf(I);
}

void kea_invert(double inverse[3][3], const double M[3][3]) {
    double c[3][3];
    for (int i = 0; i < 3; i++)
        keaCross(c[i], M[(i + 1) % 3], M[(i + 2) % 3]);
    const double det = keaDot(M[0], c[0]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[i][j] = c[j][i] / det;
}

double kea_largestEntry(const double M[3][3]) {
    double max = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            max = keaMax(max, fabs(M[i][k]));
    return max;
}

/* One Jacobi rotation that zeroes S[p][q] of a symmetric matrix; the columns of V follow. */
static void jacobiRotate(double S[3][3], double V[3][3], int p, int q) {
    if (S[p][q] == 0)
        return;
    const double theta = (S[q][q] - S[p][p]) / (2 * S[p][q]);
    const double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
    const double c = 1 / sqrt(t * t + 1), s = t * c;
    const int r = 3 - p - q;
    const double Srp = S[r][p], Srq = S[r][q], Spq = S[p][q];
    S[p][p] -= t * Spq;
    S[q][q] += t * Spq;
    S[p][q] = S[q][p] = 0;
    S[r][p] = S[p][r] = c * Srp - s * Srq;
    S[r][q] = S[q][r] = s * Srp + c * Srq;
    for (int i = 0; i < 3; i++) {
        const double Vp = V[i][p], Vq = V[i][q];
        V[i][p] = c * Vp - s * Vq;
        V[i][q] = s * Vp + c * Vq;
    }
}

/* The sum of the squares above the diagonal. */
static double squaresAboveDiagonal(const double S[3][3]) {
    return S[0][1] * S[0][1] + S[0][2] * S[0][2] + S[1][2] * S[1][2];
}

/* Whether off-diagonal entries are below the rounding of the diagonal; true for NaN, so that the iteration ends. */
static MeBool isDiagonal(const double S[3][3]) {
    return !(squaresAboveDiagonal(S) >
             kea_jacobiTolerance * (S[0][0] * S[0][0] + S[1][1] * S[1][1] + S[2][2] * S[2][2]));
}

void MEAPI MdtKeaDiagonalize(double S[3][3], double V[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            V[i][j] = i == j;
    while (!isDiagonal((const double(*)[3])S)) { /* 4 or 5 sweeps: convergence is quadratic */
        jacobiRotate(S, V, 0, 1);
        jacobiRotate(S, V, 0, 2);
        jacobiRotate(S, V, 1, 2);
    }
}

/* Whether a program's inertia tensor is finite, and symmetric but for rounding. */
static MeBool isSymmetricAndFinite(const double inertia[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double size = fabs(inertia[i][i]) + fabs(inertia[j][j]);
            if (!isfinite(inertia[i][j]) || fabs(inertia[i][j] - inertia[j][i]) > kea_asymmetry * size)
                return MEFALSE;
        }
    }
    return METRUE;
}

MeBool MEAPI MdtKeaBodySetInertia(MdtKeaBody *body, const double inertia[3][3]) {
    if (!isSymmetricAndFinite(inertia))
        return MEFALSE;
    double S[3][3], V[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            S[i][j] = 0.5 * (inertia[i][j] + inertia[j][i]);
    MdtKeaDiagonalize(S, V);
    const double moments[3] = {S[0][0], S[1][1], S[2][2]};
    for (int i = 0; i < 3; i++)
        if (!(moments[i] > kea_minMoment * kea_maxOf(moments))) /* false for NaN */
            return MEFALSE;
    keaCopy(body->moments, moments);
    keaQuaternionFromMatrix(body->principal, (const double(*)[3])V); /* rotations only: V is never a reflection */
    return METRUE;
}

/* Ascending eigenvalues of a symmetric matrix: the trigonometric solution of the characteristic equation (Smith
 * 1961). */
static void eigenvalues(const double S[3][3], double e[3]) {
    const double mean = (S[0][0] + S[1][1] + S[2][2]) / 3;
    const double a = S[0][0] - mean, b = S[1][1] - mean, c = S[2][2] - mean;
    const double p = sqrt((a * a + b * b + c * c + 2 * squaresAboveDiagonal(S)) / 6);
    e[0] = e[1] = e[2] = mean;
    if (!(p > 0))
        return;
    const double det = a * (b * c - S[1][2] * S[1][2]) - S[0][1] * (S[0][1] * c - S[1][2] * S[0][2]) +
                       S[0][2] * (S[0][1] * S[1][2] - b * S[0][2]);
    const double r = keaMax(-1, keaMin(1, det / (2 * p * p * p))), angle = acos(r) / 3;
    e[0] += 2 * p * cos(angle + 2.094395102393195492);
    e[2] += 2 * p * cos(angle);
    e[1] = 3 * mean - e[0] - e[2];
}

/* K := k K + w v vᵀ, v the unit eigenvector of an eigenvalue e of K: v vᵀ = adj(K - e 1) / tr(adj(K - e 1)). If e is
 * not separated from the other eigenvalues, the trace is rounding, and so is what would be added. */
static void addAlongEigenvector(double K[3][3], double k, double w, double e) {
    const double a = K[0][0] - e, b = K[1][1] - e, c = K[2][2] - e, x = K[1][2], y = K[0][2], z = K[0][1];
    const double adjugate[3][3] = {{b * c - x * x, x * y - z * c, z * x - b * y},
                                   {x * y - z * c, a * c - y * y, z * y - a * x},
                                   {z * x - b * y, z * y - a * x, a * b - z * z}};
    const double trace = adjugate[0][0] + adjugate[1][1] + adjugate[2][2], share = trace > 0 ? w / trace : 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[i][j] = k * K[i][j] + share * adjugate[i][j];
}

/* Whether all eigenvalues are above -harmless: the leading minors of K + harmless 1 are positive (Sylvester). */
static MeBool isHarmless(const double K[3][3], double harmless) {
    const double a = K[0][0] + harmless, b = K[1][1] + harmless, c = K[2][2] + harmless;
    const double x = K[1][2], y = K[0][2], z = K[0][1], minor = a * b - z * z;
    return a > 0 && minor > 0 && c * minor + 2 * x * y * z - a * x * x - b * y * y > 0;
}

/* If one eigenvalue is negative, its part of K is subtracted. If two or three are, K is replaced by the part of the
 * largest one, or by 0 if that is negative, too. The eigenvalue whose part is computed has another sign than the
 * others, so that it is separated from them by at least its absolute value. */
void kea_clampPositive(double K[3][3], double harmless) {
    double e[3];
    if (isHarmless((const double(*)[3])K, harmless))
        return;
    eigenvalues((const double(*)[3])K, e);
    if (e[1] > 0)
        addAlongEigenvector(K, 1, -e[0], e[0]);
    else
        addAlongEigenvector(K, 0, keaMax(e[2], 0), e[2]);
}
