/* Integrals of 1, x and x x^T, and the mass properties that follow from them. */
#include "geometry/mcd_moments_i.h"
#include "convex/mcd_vector_i.h"

void mcd_momentsAddSecond(McdMoments *s, double w, const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            s->second[i][j] += w * (a[i] * b[j] + a[j] * b[i]) / 2;
}

/* First moment m/n sum v, second m/(n (n + 1)) (sum v v^T + (sum v)(sum v)^T). */
void mcd_momentsAddSimplex(McdMoments *s, double m, const double (*corner)[3], int n) {
    double sum[3] = {0, 0, 0};
    for (int i = 0; i < n; i++) {
        mcd_mad(sum, sum, 1, corner[i]);
        mcd_momentsAddSecond(s, m / (n * (n + 1)), corner[i], corner[i]);
    }
    s->m += m;
    mcd_mad(s->first, s->first, m / n, sum);
    mcd_momentsAddSecond(s, m / (n * (n + 1)), sum, sum);
}

void mcd_momentsMass(const McdMoments *s, const double about[3], McdMass *mass) {
    McdMoments own = *s; /* about the centre of mass */
    double offset[3];
    MEASSERT(s->m > 0);
    for (int k = 0; k < 3; k++)
        offset[k] = s->first[k] / s->m;
    mcd_mad(mass->centre, about, 1, offset);
    mcd_momentsAddSecond(&own, -s->m, offset, offset);
    mass->volume = s->m;
    const double trace = own.second[0][0] + own.second[1][1] + own.second[2][2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            mass->inertia[i][j] = (i == j ? trace : 0) - own.second[i][j];
}
