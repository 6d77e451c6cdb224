/* Inside Mcd: convex shapes at a place, in double, as the narrow phase uses them.
 *
 * A shape is a core and a rounding: all points within `rounding` of the core. The core of a sphere is a point, of a
 * sphyl a segment, of a fat convex mesh the mesh; all others have rounding 0. Coordinates are along the world's
 * axes, relative to an origin near the pair (mcd_pairOrigin), so that precision does not depend on the distance from
 * the world's origin.
 *
 * Normals point from the second shape (b) to the first (a): the direction in which a is pushed.
 */
#ifndef MCD_SHAPE_H
#define MCD_SHAPE_H

#include "McdCTypes.h"
#include "McdGeometryTypes.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "convex/mcd_reach_i.h"
#include <float.h>
#include <math.h>
#include <stddef.h>

/* Converts a transform for functions that only read it: before C23, C does not convert the pointer implicitly. */
static inline const MeVector4 *mcd_const(MeMatrix4Ptr tm) {
    return (const MeVector4 *)tm;
}

/* Whether all numbers are finite and within the range of single precision, also in double-precision builds.
 * Collision requires this of numbers that programs give and of products of their transforms: then no product of
 * eight of them exceeds the range of double. */
static inline MeBool mcd_areInRange(const MeReal *x, int count) {
    MeBool areInRange = METRUE;
    for (int i = 0; i < count; i++)
        areInRange &= MeFabs(x[i]) <= (MeReal)FLT_MAX; /* false for NaN */
    return areInRange;
}

static inline MeBool mcd_isInRange3(const double x[3]) {
    return fabs(x[0]) <= (double)FLT_MAX && fabs(x[1]) <= (double)FLT_MAX && fabs(x[2]) <= (double)FLT_MAX;
}

/* Converts a result for programs: values beyond the range of MeReal are clamped to it. */
static inline MeReal mcd_clampReal(double x) {
    return (MeReal)MeCLAMP(x, -(double)MEINFINITY, (double)MEINFINITY);
}

/* Coordinate i in the world of a point in the frame at tm. */
static inline double mcd_placedCoordinate(const MeVector4 *tm, const double point[3], int i) {
    return (double)tm[0][i] * point[0] + (double)tm[1][i] * point[1] + (double)tm[2][i] * point[2] + (double)tm[3][i];
}

/* Whether a transform can be used: not null, finite, products do not overflow, and its axes are not nearly coplanar,
 * which would make shapes flat. Axes that are not unit or not orthogonal are accepted, though not rigid. */
MeBool mcd_isValidTransform(const MeVector4 *tm);

/* ---- shapes ---- */

typedef struct McdKind McdKind; /* mcd_kind_i.h */
typedef struct McdHull McdHull;
typedef struct McdSampled McdSampled; /* mcd_sampled_i.h */

/* A convex shape at a place. */
typedef struct McdShape {
    const McdKind *kind; /* the functions of its type */
    const McdHull *hull;
    const McdSampled *sampled; /* if kind->isSampled */
    const MeReal *spin;        /* rad/s, of a sampled shape's model; null: none */
    double axis[3][3];         /* rows: the shape's own axes */
    double place[3];           /* the shape's own origin */
    double size[3];      /* box: half extents. cylinder, cone: lower radius, upper radius, length (from z = -low) */
    double low;          /* cylinder, cone: depth of the base below the origin; sphyl: half of its segment */
    double rounding;     /* all points within this distance of the core belong to the shape */
    double extent;       /* no point is farther from `place` than this; tolerances are relative to it */
    double corner[3][3]; /* triangle: its corners, in the query's coordinates */
} McdShape;

/* A convex polyhedron in its own frame, made by mcd_hullCreate. Faces are convex polygons, counter-clockwise from
 * outside, coplanar triangles merged. */
typedef struct McdHullFace {
    double normal[3]; /* outward, length 1 */
    double offset;    /* normal . x = offset on the face */
    int first, count; /* its corners: faceVertex[first .. first + count - 1] */
} McdHullFace;

struct McdHull {
    int vertexCount, faceCount, edgeCount;
    double (*vertex)[3];
    McdHullFace *face;
    int *faceVertex;
    int (*edge)[2];      /* vertices; each edge once */
    int (*edgeFace)[2];  /* the faces on the left and right of edge[0] -> edge[1], seen from outside */
    int *neighbourFirst; /* vertexCount + 1 indices into `neighbour`: where each vertex's list begins */
    int *neighbour;
    double centre[3], extent; /* mean of the vertices; largest distance of a vertex from it */
};

/* The axes of a shape at a transform that has passed mcd_isValidTransform. */
void mcd_shapeAxes(const MeMatrix4 tm, double axis[3][3]);
void mcd_triangleShape(const double corners[3][3], McdShape *shape);
/* The unit normal of a triangle: by the right-hand rule, or on the side of `given` unless that is null. False if the
 * triangle has no area or is not finite. */
MeBool mcd_triangleNormal(const double corner[3][3], const double *given, double normal[3]);
/* Where a segment enters a triangle through its front, or through either side if twoSided; false if it does not. All
 * in one frame. */
MeBool mcd_segmentTriangle(const double corner[3][3], const double normal[3], MeBool twoSided, const double from[3],
                           const double to[3], double *fraction, double hitNormal[3]);

/* The convex hull of points, in their own coordinates, by Qhull. Null, with a warning that names `function`, for
 * points that span no volume (flat, collinear, fewer than four, NaN). mcd_hullDestroy frees it. */
McdHull *mcd_hullCreate(const double (*point)[3], int count, const char *function);
void mcd_hullDestroy(McdHull *hull);

/* The query's coordinates of the point (x, y, z) of the shape's own frame. */
static inline void mcd_shapePoint(const McdShape *s, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = s->place[i] + (s->axis[0][i] * x + s->axis[1][i] * y + s->axis[2][i] * z);
}

/* The same for a direction. */
static inline void mcd_shapeDirection(const McdShape *s, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = s->axis[0][i] * x + s->axis[1][i] * y + s->axis[2][i] * z;
}

/* The components of a direction along the shape's own axes. */
static inline void mcd_shapeToOwnAxes(const McdShape *s, const double direction[3], double own[3]) {
    for (int i = 0; i < 3; i++)
        own[i] = s->axis[i][0] * direction[0] + s->axis[i][1] * direction[1] + s->axis[i][2] * direction[2];
}

/* Whether the shape's axes are orthonormal. Programs may set any transform; checks of lengths apply to rigid ones
 * only. */
MeBool mcd_shapeIsRigid(const McdShape *s);
/* For checks: whether the shape is rigid, and no function of the program says where its points are. */
MeBool mcd_shapeIsKnown(const McdShape *s);
/* For checks: whether both shapes are known, and double precision resolves the smaller one at the distance of the
 * larger one's surface and of their places. Otherwise rounding exceeds what is checked: a hull of 427 m is found .8
 * m farther from a triangle of 1.1e7 m than it is along the normal. */
MeBool mcd_areResolved(const McdShape *a, const McdShape *b);

/* The point of the core farthest in a direction of any length. */
void mcd_coreSupport(const McdShape *s, const double direction[3], double point[3]);
/* The support point with the rounding; direction has length 1. */
void mcd_support(const McdShape *s, const double direction[3], double point[3]);
/* The shape's box, along the axes of its coordinates. */
void mcd_shapeBounds(const McdShape *s, double low[3], double high[3]);
/* The radius of curvature of a round surface at a point with the unit normal `outward`; 0 where it is not round. See
 * McdContactGetRadius. */
double mcd_surfaceRadius(const McdShape *s, const double outward[3], const double point[3]);
/* Whether the shape has circular rims about its z axis (McdKind.rim). */
MeBool mcd_shapeHasRim(const McdShape *s);
/* Whether the core's support in the direction is an edge, or the side of a cylinder: writes its unit axis. */
MeBool mcd_shapeEdge(const McdShape *s, const double outward[3], double axis[3]);
/* m: by how much support points are not the farthest ones; 0 but for a program's function in single precision. */
double mcd_shapeNoise(const McdShape *s);

/* ---- manifolds ------------------------------------------------------------------------------------------------ */

/* Of the faces, and with the places where more will be needed before the next test (mcd_landing.c). */
enum { MCD_FACE_CONTACTS = 4, MCD_MANIFOLD_POINTS = 12 };

typedef struct McdManifoldPoint {
    double position[3]; /* midway between the surfaces */
    double separation;  /* along the normal; negative: penetration */
    double radius[2];   /* mcd_surfaceRadius of both shapes */
    MeBool isVertex[2]; /* the contact is at a vertex of the shape, and moves with it */
    MeU64 feature;      /* a's feature in the upper 32 bits, b's in the lower; depends only on the shapes' topology */
} McdManifoldPoint;

typedef struct McdManifold {
    double normal[3]; /* from b to a, length 1 */
    int count;
    double minGap; /* m: if there are no points, a lower bound of the gap between the surfaces; 0: not known */
    McdManifoldPoint point[MCD_MANIFOLD_POINTS];
} McdManifold;

/* Finds the contacts of two convex shapes, with gaps within the reach. Returns their number; 0 if the shapes are
 * farther apart. Serves every pair of types, by the grid in mcd_grid.c. */
int mcd_convexManifold(const McdShape *a, const McdShape *b, McdReach reach, McdManifold *m);
/* Finds the contacts of shape a with the half-space below the plane normal . x = offset, which is shape b. */
int mcd_planeManifold(const McdShape *a, const double normal[3], double offset, McdReach reach, McdManifold *m);
/* Swaps the roles of the two shapes in a manifold: negates the normal, swaps radii and features. */
void mcd_manifoldSwap(McdManifold *m);
/* The signed distance of a convex shape from the half-space below z = 0 of tm; outputs as of mcd_convexDistance. */
double mcd_planeDistance(const McdShape *a, const MeVector4 *tm, const double origin[3], double onA[3], double onB[3],
                         double normal[3]);
/* The signed distance of two convex shapes (negative: depth), the nearest points on both surfaces, and the normal. */
double mcd_convexDistance(const McdShape *a, const McdShape *b, double onA[3], double onB[3], double normal[3]);
/* The signed distance of a point from a convex shape, and the normal to the point. */
double mcd_pointGap(const McdShape *s, const double point[3], double normal[3]);
double mcd_pointDistance(const McdShape *s, const double point[3]);

#endif
