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

#include "mcd_i.h"

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

/* The common origin of a pair's coordinates: the middle of the overlap of their boxes. */
void mcd_pairOrigin(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3]);
/* The convex shape of an instance; false for geometries that are none (plane, lists, aggregates, null). */
MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape);
/* The same, at another transform than the instance's present one. */
MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape);
/* The same of a model that has been compared in this round (mcd_modelStamp), without reading its geometry anew. */
MeBool mcd_shapeInRound(McdModelRecord *m, const double origin[3], McdShape *shape);
/* Its kind, sizes and extent, as its geometry has them now. False: it is none. */
MeBool mcd_shapeSizes(McdGeometryID g, McdShape *shape);
/* A shape's axes at a transform that mcd_isPlace. */
void mcd_shapeAxes(const MeMatrix4 tm, double axis[3][3]);
void mcd_triangleShape(const double corners[3][3], McdShape *shape);

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

struct McdManifold {
    double normal[3]; /* from b to a, length 1 */
    int count;
    double apart; /* m: without points, the surfaces are so far apart at least; 0: it is not known */
    McdManifoldPoint point[MCD_MANIFOLD_POINTS];
};

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
