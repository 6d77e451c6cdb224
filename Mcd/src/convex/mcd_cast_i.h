/* Inside Mcd: how far a convex shape may move before it touches a triangle, by its support function alone or in closed
 * form. */
#ifndef MCD_CAST_I_H
#define MCD_CAST_I_H

#include "convex/mcd_shape_i.h"

/* A shape that moves towards a triangle without rotation. */
typedef struct McdTriangleCast {
    const McdShape *shape;
    const double (*corner)[3], *normal; /* of the triangle; the normal has unit length */
    const double *by;                   /* the displacement, in units of which fractions are */
    double last;                        /* later fractions do not matter */
} McdTriangleCast;

/* The fraction at which the shape reaches the triangle's plane, the point that does, and the plane's normal towards the
 * shape. 0: it crosses the plane already; INFINITY: it moves away. If the point is over the triangle, the shape touches
 * the triangle there, and not before. */
double mcd_castToPlane(const McdTriangleCast *c, double point[3], double normal[3]);
MeBool mcd_castIsOver(const McdTriangleCast *c, const double point[3]);
/* A lower bound of the fraction at which the shape touches the triangle, not less than `fraction`, which is one; point:
 * one of the shape at that fraction. INFINITY: not before `last`. */
double mcd_castBound(const McdTriangleCast *c, double fraction, const double point[3]);
/* Where the shape first touches the triangle's edges and corners, if it starts apart from the triangle: the fraction,
 * the point and the normal to the shape. INFINITY: not up to `last`. Serves spheres and cylinders. */
double mcd_castToBorder(const McdTriangleCast *c, double point[3], double normal[3]);
MeBool mcd_castServesBorder(const McdShape *s);

#endif
