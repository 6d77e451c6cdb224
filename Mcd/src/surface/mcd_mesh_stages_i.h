/* Inside Mcd: the stages of finding contacts with a surface (mcd_mesh.c), in their order, and their shared
 * declarations. */
#ifndef MCD_MESH_STAGES_H
#define MCD_MESH_STAGES_H

#include "surface/mcd_mesh_i.h"
#include "convex/mcd_vector_i.h"

/* Unit normals that differ by less (rad) count as one direction. */
#define MCD_MESH_SAME_DIRECTION 1e-4
/* A neighbour rises above a plane if its angle (rad) with it is larger than this. Much smaller than
 * MCD_MESH_SAME_DIRECTION, so that a normal that is not quite a face's is recognized as an internal edge's. */
#define MCD_MESH_RISES 1e-6
/* Relative to the shape's extent: triangles are enlarged by this, so that a point between two neighbours is over one
 * of them. */
#define MCD_MESH_OVERLAP 1e-9
/* Contacts whose normals have a larger cosine form one manifold: 1.1 degrees. */
#define MCD_MESH_SAME_MANIFOLD .9998

MeU32 mcd_meshHash(MeU32 a, MeU32 b);
/* Equal for equal coordinates; -0 is 0. */
MeU32 mcd_meshHashOfPoint(const double place[3]);

static inline MeBool mcd_meshAreParallel(const double a[3], const double b[3]) {
    return mcd_distanceSquared(a, b) < MCD_MESH_RISES * MCD_MESH_RISES;
}

/* ---- surroundings (mcd_mesh_around.c) ---------------------------------------------------------------------------- */

/* Adds the triangles around the shape of other surfaces, convex parts and half-spaces that form one surface with this
 * one (mcd_pieces.c): neighbours, without contacts of their own. */
void mcd_meshAddAround(McdMeshQuery *q);

/* ---- adjacency and Voronoi regions (mcd_mesh_topology.c) --------------------------------------------------------- */

/* The Voronoi region of a triangle to which a contact normal belongs. */
typedef enum McdMeshRegion {
    MCD_FACE_REGION,     /* the triangle's own normal */
    MCD_BORDER_REGION,   /* an edge's or corner's: between the normals of the faces there */
    MCD_INTERNAL_REGION, /* none: a neighbour rises above the plane orthogonal to the normal, as at internal edges */
    MCD_FLAT_BORDER      /* an open border whose flags admit only the face's normal */
} McdMeshRegion;

/* Sets the corners' keys, numbers them, unless the geometry has, and lists the triangles of each vertex. */
void mcd_meshBuildAdjacency(McdMesh *mesh);
McdMeshRegion mcd_meshRegion(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]);
/* Whether the face's normal is the only admissible one, since the surroundings are flat: all others are in
 * MCD_INTERNAL_REGION. */
MeBool mcd_meshHasOnlyFaceNormal(const McdMeshQuery *q, const McdMeshTriangle *t);
MeBool mcd_meshHasVertex(const McdMeshTriangle *t, int v);
/* A bit mask of the corners that are farthest in a direction, within a tolerance. */
int mcd_meshFarthestCorners(const McdMeshTriangle *t, const double direction[3]);

/* ---- contacts (mcd_mesh_contacts.c) ------------------------------------------------------------------------------ */

/* Finds the contacts with all triangles of the query. */
void mcd_meshFindContacts(McdMeshQuery *q);

/* ---- motion of what rolls during the step (mcd_mesh_sweep.c) --------------------------------- */

/* Adapts the contacts of a ball, cylinder or sphyl to its motion during the step; other shapes keep theirs. */
void mcd_meshSweep(McdMeshQuery *q);
/* Marks contacts of round surfaces that roll over an edge throughout the step (mcd_mesh_edge.c). */
void mcd_meshMarkEdges(McdMeshQuery *q);

/* ---- contacts along a given normal (mcd_mesh_clip.c) ------------------------------------------------------------- */

/* A point, line or convex polygon on the shape. */
enum { MCD_POLYGON_POINTS = MCD_FACE_POINTS + 4 }; /* one for each of three cuts, one for rounding */
typedef struct McdPolygon {
    int count;
    double point[MCD_POLYGON_POINTS][3];
    MeU32 name[MCD_POLYGON_POINTS];
    MeBool isCut[MCD_POLYGON_POINTS]; /* not a corner of the shape's face but a cut through an edge */
} McdPolygon;

/* Sets the polygon to the shape's face towards a direction. */
void mcd_polygonFace(const McdShape *shape, const double direction[3], McdPolygon *p);
/* Sets the polygon to the shape's support point, which need not be on that face. */
void mcd_polygonSupport(const McdShape *shape, const double direction[3], McdPolygon *p);
/* Adds the contacts, along a normal, of corners that a tilt may bring down on the triangle. */
void mcd_meshAddCap(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]);
/* Adds a contact to the query's. */
void mcd_meshAddContact(McdMeshQuery *q, const McdMeshTriangle *t, const double position[3], const double normal[3],
                        double separation, MeU32 feature, MeBool isCut);
/* Adds contacts at the polygon's points within the margin; false if there are none. *min is the smallest separation
 * so far; onlyDeeper skips points that are not deeper than it. */
MeBool mcd_meshAddPoints(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], const McdPolygon *p,
                         MeBool onlyDeeper, double *min);
/* Adds the contacts along a normal (the triangle's or its opposite): of the shape's face, clipped to the triangle
 * enlarged by tolerance times the extent, and of the support point if that is deeper. False if there are none. */
MeBool mcd_meshAddClipped(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], double tolerance);
/* Clips a segment to the triangle's prism, enlarged by tolerance (m): 0 <= in <= out <= 1; false if nothing remains. */
MeBool mcd_meshClipSegment(const McdMeshTriangle *t, const double from[3], const double to[3], double tolerance,
                           double *in, double *out);

/* ---- reduction (mcd_mesh_reduce.c) ------------------------------------------------------------------------------- */

/* Ensures room for a number of contacts; false, after a fatal error, if there is no memory. */
MeBool mcd_meshReserveContacts(McdMesh *mesh, int contacts);
/* Reduces the contacts to manifolds of at most four per normal, and to at most `max` in total. */
void mcd_meshReduceContacts(McdMeshQuery *q, int max);

#endif
