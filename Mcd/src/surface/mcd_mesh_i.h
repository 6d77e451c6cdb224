/* Inside Mcd: contacts of a convex shape with triangles that form a surface.
 *
 * A geometry (a triangle list's callback, a height field's grid) gathers the triangles near the shape;
 * mcd_meshIntersect finds the contacts. Ghost contacts at internal edges are avoided by Voronoi regions: a normal at
 * an edge or corner belongs to the surface only if no triangle there rises above the plane orthogonal to the normal;
 * otherwise the face's normal is used. Neighbours are recognized by equal coordinates of their corners; at
 * T-junctions, by a point beyond the border.
 *
 * A triangle in flat surroundings has only one admissible normal, its own. Points of the shape below its plane are
 * contacts if the shape entered the surface there: if coplanar triangles cover the segment from the point's
 * projection to the entry, where the line from the point to the shape's highest point crosses the plane. Otherwise
 * the point belongs to a part of the shape that overhangs the border, below triangles that the shape does not touch.
 */
#ifndef MCD_MESH_H
#define MCD_MESH_H

#include "convex/mcd_kind_i.h"
#include "model/mcd_result_i.h"

typedef struct McdMeshTriangle {
    double corner[3][3]; /* in the query's coordinates */
    double normal[3];
    double reach;        /* of casts: the fraction at which the shape reaches its plane */
    double inward[3][3]; /* unit vectors in the plane, orthogonal to the edges; set by mcd_meshFindContacts */
    int vertex[3];       /* numbers of the corners' vertices: equal for equal coordinates */
    MeU32 key[3];        /* hashes of the corners' coordinates in the mesh's frame; set by mcd_meshBuildAdjacency */
    int flags;           /* McdTriangleFlags */
    McdElementData element;
    int facing;       /* the only admissible contact normal: 1 its own, -1 the opposite; 0: to be searched */
    MeBool isFlat;    /* degenerate after rounding (an edge without length): touches nothing */
    MeBool isPatch;   /* it is the only one, and stands for coplanar ones without a border near the shape */
    MeBool isPending; /* within reach of the shape, no contacts so far */
    MeBool isBelow;   /* the core's nearest point to its plane is above it and projects into the triangle */
} McdMeshTriangle;

/* The smallest and the largest of its corners' coordinates i. */
static inline double mcd_triangleLow(const McdMeshTriangle *t, int i) {
    return MeMIN3(t->corner[0][i], t->corner[1][i], t->corner[2][i]);
}
static inline double mcd_triangleHigh(const McdMeshTriangle *t, int i) {
    return MeMAX3(t->corner[0][i], t->corner[1][i], t->corner[2][i]);
}

typedef struct McdMeshContact {
    double position[3], normal[3], separation;
    double radius;        /* mcd_surfaceRadius of the shape there */
    double edge[3];       /* unit, of the edge that it rolls over (mcd_mesh_edge.c); 0: none */
    double ahead[3];      /* m: the displacement of the round side along the surface (mcd_mesh_sweep.c) */
    double drop, down[3]; /* m: by how much the surface falls away below it then; the direction to where it is */
    MeBool isVertex;      /* at a vertex of the shape */
    MeBool isOnFace;      /* along the triangle's normal */
    MeU32 feature;
    McdElementData element;
    int dims;  /* of its manifold: McdContact.dims */
    int ofCap; /* 1 + the number of the corner that a tilt may bring down (mcd_cap.c); 0: of the shape's face */
    int isCut; /* made by clipping, not a corner of the shape; of coincident points the corner is kept */
} McdMeshContact;

struct McdScratch;

/* The triangles near a shape and its contacts with them, for one query; initially zeroed (McdScratch). */
typedef struct McdMesh {
    int count, max; /* triangles */
    int own;        /* triangles of the surface itself; those that follow are of its surroundings (mcd_mesh_around.c) */
    McdMeshTriangle *triangle;
    double (*place)[3];     /* their corners in the mesh's frame, three each */
    int *firstOf, *usersOf; /* triangles of vertex v: usersOf[firstOf[v] .. firstOf[v + 1] - 1]; 3 max + 1, 3 max */
    int *cornerOf, *slot;   /* hash table of vertices: a corner of each vertex, 3 max; vertices by hash, 12 max */
    int *fan;               /* of each vertex: whether coplanar triangles surround it; 3 max */
    int contactCount, contactMax;
    McdMeshContact *contact, *cluster, *merged;
    int *contactOrder;
    void *spots, *sites; /* arrays of McdSpot, McdSite */
    int *kept;
    int skipped;     /* number of triangles without area */
    int vertexCount; /* vertices that the geometry has numbered; 0: numbered by coordinates */
} McdMesh;

/* Grows one of the mesh's arrays. */
#define MCD_MESH_GROW(pointer, used, count)                                                                            \
    MeMemoryGrow(&(pointer), (size_t)(used), (size_t)(count), sizeof *(pointer), "McdIntersect",                       \
                 "triangles and contacts")

struct McdMeshQuery {
    McdModelPair *pair;         /* model1 is the convex one */
    struct McdScratch *scratch; /* the query's memory */
    McdMesh *mesh;              /* the scratch's */
    McdShape shape;
    double margin;  /* m: McdReach */
    MeBool mayLand; /* the shape is a hull, and comes nearer before the next test: */
    McdForecast forecast;
    double origin[3];
    double displacement[3];      /* m, of the shape relative to the mesh until the next query; 0: not known */
    double axis[3][3], place[3]; /* the mesh's frame; place is relative to the origin */
    double low[3], high[3];      /* the shape's box in the mesh's frame, with the margin */
    double centre[3];            /* centre of that box, in the query's coordinates */
    double radius;               /* of that box, without the margin */
    double ball[3], ballRadius;  /* bounding ball of shape and margin, in the mesh's frame */
    double box[3], half[3];      /* the shape's box along its own axes: centre and half extents */
    MeBool isForContacts;        /* else the members below are not set */
    double own[3], side[3][3];   /* that box in the mesh's frame: centre and unit axes */
    double reach;                /* the margin with the rounding of that frame */
};

/* Finds the contacts of a convex model (model1) with a surface (model2); 1 if there are any. */
int MEAPI mcd_meshIntersect(McdModelPair *p, McdIntersectResult *result);
/* Ensures room for a number of triangles; false, after a fatal error, if there is no memory. */
MeBool mcd_meshReserve(McdMesh *mesh, int triangles);
/* For gather functions: adds a triangle, with its corners in the mesh's frame, unless it is too far away, has no
 * area, or is not finite. normal: on the outside; null: by the right-hand rule. vertex: numbers of the corners,
 * below vertexCount; null: they are numbered by coordinates. */
void mcd_meshAdd(McdMeshQuery *q, const double corner[3][3], const double *normal, int flags, const int *vertex,
                 McdElementData element);

/* Whether the shape's box, grown by the margin, may touch a triangle with these corners in the mesh's frame. If it
 * touches none there are no contacts, and a gather function may leave out all. Of queries for contacts alone. */
MeBool mcd_meshIsNear(const McdMeshQuery *q, const double corner[3][3]);

/* ---- queries (mcd_mesh_query.c) ---------------------------------------------------------------------------------- */

/* The box around the whole mesh, relative to origin. */
void mcd_meshBounds(McdGeometryInstance *ins, const double origin[3], double low[3], double high[3]);
/* Calls visit for each triangle near a box, until it returns false. Triangles and box are along the world's axes,
 * relative to origin. asker: model1 of the pair that a triangle list's callback gets; null: the list's own model. */
typedef MeBool (*McdMeshVisit)(void *context, const McdMeshTriangle *t, const McdShape *triangle);
void mcd_meshForEachNear(McdGeometryInstance *ins, McdModelID asker, const double origin[3], const double low[3],
                         const double high[3], McdMeshVisit visit, void *context);
/* A box that moves without rotation from time 0 to `last`, which a visit may shorten; in units of which `by` is the
 * displacement in one. */
typedef struct McdMeshPath {
    double low[3], high[3], by[3], last; /* relative to the origin, at time 0 */
    double from, to;                     /* of the piece that is visited */
    MeBool mayPass; /* a path that is no longer than its box may be visited as one piece, beyond the mesh's box */
} McdMeshPath;
/* Visits the triangles near the path of a box, as mcd_meshForEachNear, in pieces one after the other, so that the box
 * around each contains few triangles that are far from it. A triangle may be visited in several pieces. A visit is of
 * all triangles of a piece. */
typedef void (*McdMeshPathVisit)(void *context, McdMeshTriangle t[], int count);
void mcd_meshForEachAlong(McdGeometryInstance *ins, McdModelID asker, const double origin[3], McdMeshPath *path,
                          McdMeshPathVisit visit, void *context);
/* The signed distance of a convex shape from another part of a model, the nearest points and the normal (to the shape);
 * INFINITY: the part is a surface without triangles within reach. */
typedef struct McdGap {
    double distance, onShape[3], onOther[3], normal[3];
} McdGap;
/* Measures the gap to a part; false if the part is not convex, a plane or a surface, or has no valid transform.
 * Triangles farther away than `reach` (or INFINITY) may be ignored. asker: as of mcd_meshForEachNear. */
MeBool mcd_measureGap(const McdShape *shape, McdGeometryInstance *ins, McdModelID asker, const double origin[3],
                      double reach, McdGap *gap);

/* Whether there are a pair of live models with valid transforms, the second of a type of surface, and room for
 * contacts; warns if not. */
MeBool mcd_meshMayIntersect(const McdModelPair *p, McdGeometryType surface, const McdIntersectResult *result,
                            const char *function);
/* Registers an interaction of a convex type with a surface's type. */
MeBool mcd_meshRegister(McdFramework *frame, McdGeometryType type, McdGeometryType meshType, McdIntersectFn function);
/* Defines Mcd<shape><mesh>Intersect and ...RegisterInteraction for all convex shapes. */
#define MCD_MESH_INTERACTION(shape, mesh)                                                                              \
    int MEAPI Mcd##shape##mesh##Intersect(McdModelPair *p, McdIntersectResult *result) {                               \
        return mcd_meshMayIntersect(p, kMcdGeometryType##mesh, result, __func__) ? mcd_meshIntersect(p, result) : 0;   \
    }                                                                                                                  \
    MeBool MEAPI Mcd##shape##mesh##RegisterInteraction(McdFramework *frame) {                                          \
        ME_RETURN_UNDER_OWN_NAME(MeBool, mcd_meshRegister(frame, kMcdGeometryType##shape, kMcdGeometryType##mesh,      \
                                                          Mcd##shape##mesh##Intersect));                               \
    }
#define MCD_MESH_INTERACTIONS(mesh)                                                                                    \
    MCD_MESH_INTERACTION(Sphere, mesh)                                                                                 \
    MCD_MESH_INTERACTION(Box, mesh)                                                                                    \
    MCD_MESH_INTERACTION(Cylinder, mesh)                                                                               \
    MCD_MESH_INTERACTION(Sphyl, mesh)                                                                                  \
    MCD_MESH_INTERACTION(ConvexMesh, mesh)                                                                             \
    MCD_MESH_INTERACTION(Cone, mesh)

#endif
