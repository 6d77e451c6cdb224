/* Bounding sphere of points.
 *
 * The smallest sphere is determined by 2 to 4 support points on it. Iteration: add the farthest point outside to the
 * support; the smallest sphere of these few points gives the next support. The radius grows in each iteration, so no
 * support occurs twice (Gaertner, Fast and Robust Smallest Enclosing Balls, ESA 1999). */
#include "MeBounding.h"

#include "MeAssert.h"
#include "MeMath.h"
#include <string.h>

enum { DIM = 3, SUPPORT = DIM + 1 };

typedef struct Ball {
    double centre[DIM], radiusSquared;
} Ball;

/* Tolerance for rounding errors of squared distances, relative to the squared radius. */
static const double slack = 1e-12;

static double dot(const double a[DIM], const double b[DIM]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double distanceSquared(const double a[DIM], const double b[DIM]) {
    const double d[DIM] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return dot(d, d);
}

static MeBool isInside(const Ball *ball, const double point[DIM]) {
    return distanceSquared(ball->centre, point) <= ball->radiusSquared * (1 + slack);
}

/* Solves n <= 3 linear equations in place; false if the matrix is singular to working precision. */
static MeBool solve(double m[DIM][DIM + 1], int n) {
    for (int i = 0; i < n; i++) {
        int pivot = i;
        for (int k = i + 1; k < n; k++)
            if (fabs(m[k][i]) > fabs(m[pivot][i]))
                pivot = k;
        double row[DIM + 1];
        memcpy(row, m[pivot], sizeof row);
        memcpy(m[pivot], m[i], sizeof row);
        memcpy(m[i], row, sizeof row);
        if (!(fabs(row[i]) > slack * fabs(row[DIM])))
            return MEFALSE;
        for (int k = 0; k < n; k++) {
            const double factor = m[k][i] / row[i];
            for (int j = i; k != i && j <= DIM; j++)
                m[k][j] -= factor * row[j];
        }
    }
    for (int i = 0; i < n; i++)
        m[i][DIM] /= m[i][i];
    return METRUE;
}

/* The smallest sphere through n points: its centre is p_0 + sum l_i v_i, v_i = p_i - p_0, where
 * 2 sum_j (v_i . v_j) l_j = v_i . v_i. */
static MeBool ballThrough(double *const p[SUPPORT], int n, Ball *ball) {
    double v[DIM][DIM], m[DIM][DIM + 1];
    memcpy(ball->centre, p[0], sizeof ball->centre);
    for (int i = 0; i < n - 1; i++)
        for (int k = 0; k < DIM; k++)
            v[i][k] = p[i + 1][k] - p[0][k];
    for (int i = 0; i < n - 1; i++) {
        for (int j = 0; j < n - 1; j++)
            m[i][j] = 2 * dot(v[i], v[j]);
        m[i][DIM] = dot(v[i], v[i]);
    }
    if (!solve(m, n - 1))
        return MEFALSE;
    for (int i = 0; i < n - 1; i++)
        for (int k = 0; k < DIM; k++)
            ball->centre[k] += m[i][DIM] * v[i][k];
    ball->radiusSquared = distanceSquared(ball->centre, p[0]);
    return METRUE;
}

/* Computes the smallest sphere that contains count <= 5 points and passes through the last one. Moves the points on it
 * to the front and returns their number; 0: none was found. */
static int updateSupport(double point[SUPPORT + 1][DIM], int count, Ball *ball) {
    const int last = count - 1;
    int best = -1;
    for (int set = 0; set < 1 << last; set++) {
        double *p[SUPPORT + 1] = {point[last]};
        int n = 1;
        for (int i = 0; i < last; i++)
            if (set >> i & 1)
                p[n++] = point[i];
        Ball here;
        MeBool isAround = n <= SUPPORT && ballThrough(p, n, &here);
        for (int i = 0; i < last && isAround; i++)
            isAround = set >> i & 1 || isInside(&here, point[i]);
        if (isAround && (best < 0 || here.radiusSquared < ball->radiusSquared)) {
            best = set;
            *ball = here;
        }
    }
    if (best < 0)
        return 0;
    int n = 0;
    for (int i = 0; i < last; i++)
        if (best >> i & 1)
            memmove(point[n++], point[i], sizeof point[0]);
    memmove(point[n++], point[last], sizeof point[0]);
    return n;
}

/* Finds the point farthest from the centre. */
static void findFarthestPoint(MeVector3 *points, int count, const double centre[DIM], double found[DIM]) {
    double max = -1;
    memcpy(found, centre, DIM * sizeof *found);
    for (int i = 0; i < count; i++) {
        const double p[DIM] = {(double)points[i][0], (double)points[i][1], (double)points[i][2]};
        if (distanceSquared(p, centre) > max) {
            max = distanceSquared(p, centre);
            memcpy(found, p, sizeof p);
        }
    }
}

static MeBool areFinite(MeVector3 *points, int count) {
    for (int i = 0; i < count; i++)
        for (int k = 0; k < DIM; k++)
            if (!MeRealIsValid(points[i][k]))
                return MEFALSE;
    return METRUE;
}

static void smallestBall(MeVector3 *points, int count, Ball *ball) {
    double support[SUPPORT + 1][DIM] = {{(double)points[0][0], (double)points[0][1], (double)points[0][2]}};
    memcpy(ball->centre, support[0], sizeof ball->centre);
    ball->radiusSquared = 0;
    for (int n = 1;;) {
        const double before = ball->radiusSquared;
        findFarthestPoint(points, count, ball->centre, support[n]);
        if (isInside(ball, support[n]))
            return;
        n = updateSupport(support, n + 1, ball);
        if (n == 0 || !(ball->radiusSquared > before)) /* no progress, due to rounding */
            return;
        MEASSERT(n <= SUPPORT);
    }
}

void MEAPI MeBoundingSphereCalc(MeVector3 *points, int numPoints, MeVector3 centre, MeReal *radius) {
    Ball ball = {{0, 0, 0}, 0};
    double rounded[DIM], outermost[DIM];
    const MeBool isGiven = points && numPoints > 0 && centre && radius && areFinite(points, numPoints);
    if (!isGiven)
        MeWarning(1,
                  "MeBoundingSphereCalc: %d points at %p, or a result that is null, or a coordinate that is not finite",
                  numPoints, (void *)points);
    else
        smallestBall(points, numPoints, &ball);
    for (int k = 0; k < DIM && centre; k++) {
        centre[k] = (MeReal)ball.centre[k];
        rounded[k] = (double)centre[k];
    }
    if (!radius)
        return;
    *radius = 0;
    if (!isGiven)
        return;
    findFarthestPoint(points, numPoints, rounded, outermost);
    const double reach = sqrt(distanceSquared(outermost, rounded));
    *radius = (MeReal)(reach * (1 + 2 * (double)ME_EPSILON)); /* rounds up, for two rounding errors */
    MEASSERT((double)*radius >= reach);
}
