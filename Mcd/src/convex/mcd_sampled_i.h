/* Inside Mcd: convex shapes that are known by their support function alone, which is the program's. Their faces are
 * found by sampling: by support points around a direction (mcd_sampled.c). */
#ifndef MCD_SAMPLED_H
#define MCD_SAMPLED_H

#include "McdConvexType.h"
#include "convex/mcd_kind_i.h"
#include <stdatomic.h>

/* What all shapes of a type share. */
typedef struct McdSampledType {
    McdKind kind; /* first: a shape's kind is its type */
    McdConvexFunctions functions;
    size_t dataSize;
    atomic_int hasWarned; /* about a support point that is not valid */
    char name[];
} McdSampledType;

/* One shape, in its own frame. */
struct McdSampled {
    McdSampledType *type;
    const void *data;
    double rounding, extent; /* m; extent: from the origin, an upper bound, with the rounding */
    double middle[3];        /* a point of the shape */
    MeU32 flatFaces;         /* bits: faces whose normals are x, -x, y, -y, z, -z */
};

/* Calls the support function; direction: length 1. If its point is not finite, beyond the extent, or behind the middle:
 * the middle, and a warning, once for the type. While the extent is INFINITY, any point is taken. */
void mcd_sampledCall(const McdSampled *s, const double direction[3], double point[3]);
/* Sets rounding, extent and flatFaces; false: not finite, or without extent. */
MeBool mcd_sampledMeasure(McdSampled *s);
/* The functions of the type's McdKind. */
void mcd_sampledSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_sampledFace(const McdShape *s, const double direction[3], McdFace *f);
double mcd_sampledRadius(const McdShape *s, const double outward[3], const double point[3]);

/* The middle and half the sides of the shape's box, of which none is less than a thousandth of the longest. */
void mcd_sampledBox(const McdSampled *s, double centre[3], double half[3]);
/* Visits the triangles between support points, rounding included; counter-clockwise from outside. The directions are
 * on a grid that divides each edge of an octahedron in `count` pieces, at most MCD_GRID; of an ellipsoid with these
 * half axes the points are as far apart as those directions. */
enum { MCD_GRID = 64 };
typedef void (*McdSampledVisit)(void *context, const double corner[3][3]);
void mcd_sampledTriangles(const McdSampled *s, const double half[3], int count, McdSampledVisit visit, void *context);

#endif
