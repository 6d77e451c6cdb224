/* Inside Mcd: convex shapes at a place, in double, as the nearfield sees them.
 *
 * A shape is a core and a rounding: all points within `rounding` of the core. A sphere's core is a point, a sphyl's a
 * segment, a fat convex mesh's the mesh; all others have rounding 0. Coordinates are the world's axes with the origin
 * moved near the pair (mcd_pairOrigin), so that precision does not depend on the distance from the world's origin.
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
#include <float.h>
#include <math.h>
#include <stddef.h>

/* A transform for functions that only read it: before C23, C does not convert the pointer by itself. */
static inline const MeVector4 *mcd_const(MeMatrix4Ptr tm) {
    return (const MeVector4 *)tm;
}

/* Numbers that collision takes from programs, and from products of their transforms, are finite and not beyond the
 * range of single precision, in double precision too: so no product of eight of them is beyond the range of double. */
static inline MeBool mcd_areNear(const MeReal *x, int count) {
    MeBool areNear = METRUE;
    for (int i = 0; i < count; i++)
        areNear &= MeFabs(x[i]) <= (MeReal)FLT_MAX; /* false for NaN */
    return areNear;
}

static inline MeBool mcd_isNear3(const double x[3]) {
    return fabs(x[0]) <= (double)FLT_MAX && fabs(x[1]) <= (double)FLT_MAX && fabs(x[2]) <= (double)FLT_MAX;
}

/* A result for programs: numbers beyond the range of MeReal become its largest. */
static inline MeReal mcd_real(double x) {
    return (MeReal)MeCLAMP(x, -(double)MEINFINITY, (double)MEINFINITY);
}

/* Transforms whose axes are not of length 1, or not at right angles, are accepted, though not rigid: only overflow of
 * products is excluded, and axes near one plane, which make shapes flat. False for null. */
MeBool mcd_isPlace(const MeVector4 *tm);

/* ---- shapes ---- */

typedef struct McdKind McdKind; /* mcd_kind_i.h */
typedef struct McdHull McdHull;

/* A convex shape at a place. */
typedef struct McdShape {
    const McdKind *kind; /* its type's functions */
    const McdHull *hull;
    double axis[3][3];   /* rows: its own axes */
    double place[3];     /* its own origin */
    double size[3];      /* box: half sizes. cylinder and cone: lower radius, upper radius, length; they lie between
                          z = -low and length - low */
    double low;          /* cylinder and cone: distance of the base below the origin; of a cylinder and a sphyl's core
                          half the height */
    double rounding;     /* all points within it of the core belong to the shape */
    double extent;       /* no point is farther than this from `place`: tolerances are relative to it */
    double corner[3][3]; /* triangle: its corners, in the coordinates of the query */
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
    int (*edgeFace)[2];  /* the faces left and right of edge[0] -> edge[1], seen from outside */
    int *neighbourFirst; /* vertexCount + 1 indices into neighbour: the vertices joined to a vertex by edges */
    int *neighbour;
    double centre[3], extent; /* the mean of the vertices; the largest distance of a vertex from it */
};

enum { MCD_SHAPE_TRIANGLE = -2 }; /* McdKind.type of a triangle, which is no geometry of its own */

/* A shape's axes at a transform that mcd_isPlace. */
void mcd_shapeAxes(const MeMatrix4 tm, double axis[3][3]);
void mcd_triangleShape(const double corners[3][3], McdShape *shape);
/* The unit normal of a triangle, by the right-hand rule or, if one is given, on its side; false without area. */
MeBool mcd_triangleNormal(const double corner[3][3], const double *given, double normal[3]);
/* Where a segment enters a triangle's front (either side if both count): false if it does not. All in one frame. */
MeBool mcd_segmentTriangle(const double corner[3][3], const double normal[3], MeBool twoSided, const double from[3],
                           const double to[3], double *fraction, double hitNormal[3]);

/* Qhull's hull of some points, in their own coordinates; null, with a warning that names the function, for points that
 * span no volume (flat, collinear, fewer than four, NaN). */
McdHull *mcd_hullCreate(const double (*point)[3], int count, const char *function);
void mcd_hullDestroy(McdHull *hull);

/* A point and a direction from its own axes, and a direction to them. */
static inline void mcd_shapePoint(const McdShape *s, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = s->place[i] + (s->axis[0][i] * x + s->axis[1][i] * y + s->axis[2][i] * z);
}

static inline void mcd_shapeDirection(const McdShape *s, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = s->axis[0][i] * x + s->axis[1][i] * y + s->axis[2][i] * z;
}

static inline void mcd_shapeOwn(const McdShape *s, const double direction[3], double own[3]) {
    for (int i = 0; i < 3; i++)
        own[i] = s->axis[i][0] * direction[0] + s->axis[i][1] * direction[1] + s->axis[i][2] * direction[2];
}

/* Are its axes orthonormal? Programs may set any transform; checks of lengths apply to rigid ones only. */
MeBool mcd_shapeIsRigid(const McdShape *s);
/* For checks: are both rigid, and does a double resolve the smaller one at the distances of the larger one's surface,
 * and at their places? What checks look at is lost in rounding otherwise: a hull
 * of 427 m is told to be .8 m farther from a triangle of 1.1e7 m than it is along the normal. */
MeBool mcd_areResolved(const McdShape *a, const McdShape *b);

/* The point of the core farthest in a direction of any length. */
void mcd_coreSupport(const McdShape *s, const double direction[3], double point[3]);
/* The same with the rounding; direction has length 1. */
void mcd_support(const McdShape *s, const double direction[3], double point[3]);
/* The radius of a round surface at a point of it, the unit vector outward being its normal; 0 where it is not round.
 * See McdContactGetRadius. */
double mcd_surfaceRadius(const McdShape *s, const double outward[3], const double point[3]);

/* ---- manifolds ------------------------------------------------------------------------------------------------ */

enum { MCD_MANIFOLD_POINTS = 4 };

typedef struct McdManifoldPoint {
    double position[3]; /* half-way between both surfaces */
    double separation;  /* along the normal; negative: penetration */
    double radius[2];   /* mcd_surfaceRadius of both shapes */
    MeU64 feature;      /* which features touch, a's in the upper half: a pure function of the shapes' topology */
} McdManifoldPoint;

typedef struct McdManifold {
    double normal[3]; /* from b to a, length 1 */
    int count;
    double minGap; /* m: without points, a lower bound of the gap between the surfaces; 0: not known */
    McdManifoldPoint point[MCD_MANIFOLD_POINTS];
} McdManifold;

/* Contacts of two convex shapes whose gap is at most margin. Returns the count; 0 if they are farther apart. Every
 * pair of types is served, through the grid in mcd_grid.c. */
int mcd_convexManifold(const McdShape *a, const McdShape *b, double margin, McdManifold *m);
/* Contacts with the half-space below the plane normal . x = offset: b is the half-space. */
int mcd_planeManifold(const McdShape *a, const double normal[3], double offset, double margin, McdManifold *m);
/* The manifold of the shapes in the other order. */
void mcd_manifoldTurn(McdManifold *m);
/* The signed distance of a convex shape from the half-space below z = 0 of tm, as mcd_convexDistance. */
double mcd_planeDistance(const McdShape *a, const MeVector4 *tm, const double origin[3], double onA[3], double onB[3],
                         double normal[3]);
/* The signed distance of two convex shapes (negative: depth), the nearest points on both surfaces, and the normal. */
double mcd_convexDistance(const McdShape *a, const McdShape *b, double onA[3], double onB[3], double normal[3]);

#endif
