/* Convex shapes to test with, and slow answers about them that are obviously right.
 *
 * The signed distance of two convex shapes is the largest separation along any direction: n . x over a's points, least,
 * less n . y over b's points, most. So whatever direction is tried gives a lower bound; a result that reaches the best
 * of very many directions, and is itself the separation along its own normal, is right. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"

/* xorshift64*: the same on every machine. */
typedef struct Random {
    unsigned long long state;
} Random;
double random_unit(Random *r); /* 0 .. 1 */
double random_between(Random *r, double low, double high);
void random_direction(Random *r, double out[3]);

enum {
    SHAPE_SPHERE,
    SHAPE_SPHYL,
    SHAPE_BOX,
    SHAPE_CYLINDER,
    SHAPE_CONE,
    SHAPE_HULL,
    SHAPE_FAT_HULL,
    SHAPE_TRIANGLE,
    SHAPE_KINDS
};
extern const char *const shape_name[SHAPE_KINDS];

/* Its own axes along the coordinates', at the origin. */
void shape_box(McdShape *s, double x, double y, double z);
void shape_cylinder(McdShape *s, double radius, double halfHeight);
void shape_cone(McdShape *s, double lower, double upper, double length);
void shape_sphyl(McdShape *s, double radius, double halfHeight);
void shape_sphere(McdShape *s, double radius);
void shape_hull(McdShape *s, const McdHull *hull, double fatness);
/* Of a kind, with sizes from .3 to 1 times a scale; slab: one of them a fiftieth. */
void shape_random(McdShape *s, int kind, double scale, MeBool slab, Random *r);
/* A prism or a double pyramid over a polygon; from a store of 2048, the oldest is used again. */
const McdHull *hull_prism(int sides, double radius, double halfHeight);
const McdHull *hull_pyramids(int sides, double radius, double halfHeight);

/* Qhull's, of that many points on an ellipsoid. */
const McdHull *hull_points(int count, const double radii[3], Random *r);

void shape_rotate(McdShape *s, const double axis[3], double angle); /* about the coordinates' origin */
void shape_rotateRandomly(McdShape *s, Random *r);
void shape_move(McdShape *s, double x, double y, double z);
/* The farthest point, by its own formulas; with the rounding. */
void reference_support(const McdShape *s, const double n[3], double out[3]);
double reference_along(const McdShape *a, const McdShape *b, const double n[3]);
/* By all face normals and pairs of edges: exact for overlapping polyhedra. */
double reference_axes(const McdShape *a, const McdShape *b, double normal[3]);
/* By these, `directions` more all over the sphere, and a search around the best ones. */
double reference_distance(const McdShape *a, const McdShape *b, int directions, double normal[3]);
/* How far outside of the shape a point is, negative inside; for polyhedra (with rounding), and exact inside. */
double reference_outside(const McdShape *s, const double point[3]);

#endif
