/* Convex shapes as a program would add them, by their support functions (McdConvexType.h): an ellipsoid, a tapered
 * capsule (the hull of two balls on the z axis), a box, a cylinder, a cone, a polyhedron. */
#ifndef OWN_SHAPES_H
#define OWN_SHAPES_H

#include "Mcd.h"
#include <math.h>
#include <string.h>

/* ---- ellipsoid --------------------------------------------------------------------------------------------------- */

typedef struct Ellipsoid {
    double radius[3];
} Ellipsoid;

static inline void MEAPI ellipsoidSupport(const void *data, const double d[3], double point[3]) {
    const double *r = ((const Ellipsoid *)data)->radius;
    const double x = r[0] * d[0], y = r[1] * d[1], z = r[2] * d[2], length = sqrt(x * x + y * y + z * z);
    point[0] = r[0] * x / length;
    point[1] = r[1] * y / length;
    point[2] = r[2] * z / length;
}

static inline void MEAPI ellipsoidMass(const void *data, double *volume, double centre[3], double inertia[3][3]) {
    const double *r = ((const Ellipsoid *)data)->radius, m = 4. / 3 * 3.14159265358979324 * r[0] * r[1] * r[2];
    *volume = m;
    memset(centre, 0, 3 * sizeof *centre);
    memset(inertia, 0, 3 * sizeof *inertia);
    for (int i = 0; i < 3; i++) {
        const double a = r[(i + 1) % 3], b = r[(i + 2) % 3];
        inertia[i][i] = m / 5 * (a * a + b * b);
    }
}

static const McdConvexFunctions ellipsoidFunctions = {.support = ellipsoidSupport, .mass = ellipsoidMass};

static inline McdGeometryID ellipsoid_create(McdFrameworkID frame, double x, double y, double z) {
    const Ellipsoid e = {{x, y, z}};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Ellipsoid", sizeof e, &ellipsoidFunctions),
                           &e);
}

/* ---- tapered capsule --------------------------------------------------------------------------------------------- */

/* Balls at z = 0 and z = length, |radius[1] - radius[0]| < length. */
typedef struct Taper {
    double radius[2], length;
} Taper;

static inline void MEAPI taperSupport(const void *data, const double d[3], double point[3]) {
    const Taper *t = data;
    const int upper = t->radius[1] + t->length * d[2] > t->radius[0];
    for (int i = 0; i < 3; i++)
        point[i] = t->radius[upper] * d[i];
    point[2] += upper ? t->length : 0;
}

/* Adds a solid of revolution between z = from and z = to with the squared radius a + b z + c z²: the integrals of 1, z,
 * z² and of the fourth power of the radius. */
static inline void taperAdd(double a, double b, double c, double from, double to, double sum[4]) {
    for (int end = 0; end < 2; end++) {
        const double z = end ? to : from, sign = end ? 3.14159265358979324 : -3.14159265358979324, z2 = z * z;
        sum[0] += sign * z * (a + z * (b / 2 + z * c / 3));
        sum[1] += sign * z2 * (a / 2 + z * (b / 3 + z * c / 4));
        sum[2] += sign * z2 * z * (a / 3 + z * (b / 4 + z * c / 5));
        sum[3] += sign * z * (a * a + z * (a * b + z * ((b * b + 2 * a * c) / 3 + z * (b * c / 2 + z * c * c / 5))));
    }
}

/* A piece of each ball, and the cone that touches both: at the height r s above the centre, s = (r0 - r1) / length. */
static inline void MEAPI taperMass(const void *data, double *volume, double centre[3], double inertia[3][3]) {
    const Taper *t = data;
    const double r = t->radius[0], q = t->radius[1], l = t->length, s = (r - q) / l, slope = s / sqrt(1 - s * s);
    const double low = r * s, high = l + q * s, rim = r * sqrt(1 - s * s), top = rim + slope * low;
    double sum[4] = {0, 0, 0, 0};
    taperAdd(r * r, 0, -1, -r, low, sum);
    taperAdd(top * top, -2 * top * slope, slope * slope, low, high, sum);
    taperAdd(q * q - l * l, 2 * l, -1, high, l + q, sum);
    const double z = sum[1] / sum[0], along = sum[3] / 2, across = sum[3] / 4 + sum[2] - sum[0] * z * z;
    *volume = sum[0];
    centre[0] = centre[1] = 0;
    centre[2] = z;
    memset(inertia, 0, 3 * sizeof *inertia);
    inertia[0][0] = inertia[1][1] = across;
    inertia[2][2] = along;
}

static const McdConvexFunctions taperFunctions = {.support = taperSupport, .mass = taperMass};

static inline McdGeometryID taper_create(McdFrameworkID frame, double lower, double upper, double length) {
    const Taper t = {{lower, upper}, length};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Taper", sizeof t, &taperFunctions), &t);
}

/* ---- box, capsule, cylinder: what the library has itself --------------------------------------------------- */

typedef struct Brick {
    double half[3], rounding;
} Brick;

static inline void MEAPI brickSupport(const void *data, const double d[3], double point[3]) {
    for (int i = 0; i < 3; i++)
        point[i] = copysign(((const Brick *)data)->half[i], d[i]);
}

static inline double MEAPI brickRounding(const void *data) {
    return ((const Brick *)data)->rounding;
}

static const McdConvexFunctions brickFunctions = {.support = brickSupport, .rounding = brickRounding};

/* Full sides, as McdBoxCreate's; with a rounding around it. */
static inline McdGeometryID brick_create(McdFrameworkID frame, double x, double y, double z, double rounding) {
    const Brick b = {{(double)(MeReal)x / 2, (double)(MeReal)y / 2, (double)(MeReal)z / 2}, (double)(MeReal)rounding};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Brick", sizeof b, &brickFunctions), &b);
}

typedef struct Can {
    double radius, half, round; /* round: 1 for half balls at the ends */
} Can;

static inline void MEAPI canSupport(const void *data, const double d[3], double point[3]) {
    const Can *c = data;
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), k = c->round > 0 ? 1 : across > 0 ? 1 / across : 0;
    point[0] = c->radius * k * d[0];
    point[1] = c->radius * k * d[1];
    point[2] = copysign(c->half, d[2]) + (c->round > 0 ? c->radius * d[2] : 0);
}

static const McdConvexFunctions canFunctions = {.support = canSupport};

static inline McdGeometryID can_create(McdFrameworkID frame, double radius, double height, MeBool isRound) {
    const Can c = {(double)(MeReal)radius, (double)(MeReal)height / 2, isRound};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Can", sizeof c, &canFunctions), &c);
}

/* A segment with a rounding: what McdSphylCreate makes. */
static inline void MEAPI rodSupport(const void *data, const double d[3], double point[3]) {
    point[0] = point[1] = 0;
    point[2] = copysign(((const Can *)data)->half, d[2]);
}

static inline double MEAPI rodRounding(const void *data) {
    return ((const Can *)data)->radius;
}

static const McdConvexFunctions rodFunctions = {.support = rodSupport, .rounding = rodRounding};

static inline McdGeometryID rod_create(McdFrameworkID frame, double radius, double height) {
    const Can c = {(double)(MeReal)radius, (double)(MeReal)height / 2, 1};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Rod", sizeof c, &rodFunctions), &c);
}

/* ---- cone, polyhedron -------------------------------------------------------------------------------------------- */

/* The tip is `length` above the base, which is at z = -low. */
typedef struct Horn {
    double radius, length, low;
} Horn;

static inline void MEAPI hornSupport(const void *data, const double d[3], double point[3]) {
    const Horn *h = data;
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), k = across > 0 ? h->radius / across : 0;
    const int isTip = h->length * d[2] > h->radius * across;
    point[0] = isTip ? 0 : k * d[0];
    point[1] = isTip ? 0 : k * d[1];
    point[2] = isTip ? h->length - h->low : -h->low;
}

static const McdConvexFunctions hornFunctions = {.support = hornSupport};

/* The cone of McdConeCreate. */
static inline McdGeometryID horn_create(McdFrameworkID frame, double radius, double length) {
    const Horn h = {(double)(MeReal)radius, (double)(MeReal)length, (double)((MeReal)length / 4)};
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Horn", sizeof h, &hornFunctions), &h);
}

enum { GEM_CORNERS = 120 };

typedef struct Gem {
    int count;
    double corner[GEM_CORNERS][3];
} Gem;

static inline void MEAPI gemSupport(const void *data, const double d[3], double point[3]) {
    const Gem *g = data;
    double max = -INFINITY;
    for (int i = 0; i < g->count; i++) {
        const double *c = g->corner[i], height = c[0] * d[0] + c[1] * d[1] + c[2] * d[2];
        if (height <= max)
            continue;
        max = height;
        memcpy(point, c, 3 * sizeof *point);
    }
}

static const McdConvexFunctions gemFunctions = {.support = gemSupport};

static inline McdGeometryID gem_create(McdFrameworkID frame, const Gem *g) {
    return McdConvexCreate(frame, McdFrameworkRegisterConvexType(frame, "Gem", sizeof *g, &gemFunctions), g);
}

#endif
