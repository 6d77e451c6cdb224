/* Inside Mcd: three-dimensional vectors in double, and the only conversion from double to int. */
#ifndef MCD_VECTOR_H
#define MCD_VECTOR_H

#include "MePrecision.h"
#include <math.h>

static inline double mcd_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void mcd_set(double out[3], double x, double y, double z) {
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

static inline void mcd_copy(double out[3], const double a[3]) {
    mcd_set(out, a[0], a[1], a[2]);
}

static inline void mcd_fromReal(double out[3], const MeReal a[3]) {
    mcd_set(out, (double)a[0], (double)a[1], (double)a[2]);
}

static inline void mcd_toReal(MeReal out[3], const double a[3]) {
    out[0] = (MeReal)a[0];
    out[1] = (MeReal)a[1];
    out[2] = (MeReal)a[2];
}

static inline void mcd_scale(double out[3], const double a[3], double k) {
    mcd_set(out, a[0] * k, a[1] * k, a[2] * k);
}

static inline void mcd_sub(double out[3], const double a[3], const double b[3]) {
    mcd_set(out, a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/* a + k b */
static inline void mcd_mad(double out[3], const double a[3], double k, const double b[3]) {
    mcd_set(out, a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]);
}

static inline void mcd_cross(double out[3], const double a[3], const double b[3]) {
    mcd_set(out, a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

static inline double mcd_length(const double a[3]) {
    return sqrt(mcd_dot(a, a));
}

static inline double mcd_distanceSquared(const double a[3], const double b[3]) {
    double d[3];
    mcd_sub(d, a, b);
    return mcd_dot(d, d);
}

/* The height of a point over the plane through `base` with a unit normal. */
static inline double mcd_heightOver(const double point[3], const double base[3], const double normal[3]) {
    double offset[3];
    mcd_sub(offset, point, base);
    return mcd_dot(offset, normal);
}

/* Converts rows for functions that only read them: before C23, C does not convert the pointer implicitly. */
static inline const double (*mcd_constRows(double (*rows)[3]))[3] {
    return (const double(*)[3])rows;
}

/* Two directions u, w that form a right-handed frame (u, w, n) with the unit vector n. */
static inline void mcd_basis(const double n[3], double u[3], double w[3]) {
    if (fabs(n[0]) < .6)
        mcd_set(u, 0, n[2], -n[1]);
    else
        mcd_set(u, -n[2], 0, n[0]);
    mcd_scale(u, u, 1 / mcd_length(u));
    mcd_cross(w, n, u);
}

/* Whether the vector has length 1, to within rounding. */
static inline int mcd_isUnit(const double a[3]) {
    return fabs(mcd_dot(a, a) - 1) < 1e-9;
}

/* The largest int that is not above x, clamped to low .. high; low for NaN. */
static inline int mcd_floorBetween(double x, int low, int high) {
    return !(x > low) ? low : x >= high ? high : (int)floor(x);
}

#endif
