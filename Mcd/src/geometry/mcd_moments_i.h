/* Inside Mcd: mass properties of solids that are sums of parts: integrals of 1, x and x x^T over each part. */
#ifndef MCD_MOMENTS_H
#define MCD_MOMENTS_H

#include "geometry/mcd_local_i.h"

typedef struct McdMoments {
    double m, first[3], second[3][3];
} McdMoments;

/* Adds the symmetric part of w a b^T. */
void mcd_momentsAddSecond(McdMoments *s, double w, const double a[3], const double b[3]);
/* Adds a simplex with n corners v and content m, which may be negative. */
void mcd_momentsAddSimplex(McdMoments *s, double m, const double (*corner)[3], int n);
/* Sets volume, centre and inertia of a solid of unit density, m > 0, whose moments are about a point. */
void mcd_momentsMass(const McdMoments *s, const double about[3], McdMass *mass);

#endif
