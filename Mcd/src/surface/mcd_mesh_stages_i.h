/* Inside Mcd: the stages of a query of a surface (mcd_mesh.c), in their order, and what they share. */
#ifndef MCD_MESH_STAGES_H
#define MCD_MESH_STAGES_H

#include "surface/mcd_mesh_i.h"
#include "convex/mcd_vector_i.h"

/* Unit normals that differ by less (rad) are one direction. */
#define MCD_MESH_SAME_DIRECTION 1e-4
/* A neighbour rises above a plane if its angle (rad) with it is larger; much smaller than MCD_MESH_SAME_DIRECTION, so
 * that a normal that is not quite a face's is recognized as an internal edge's. */
#define MCD_MESH_RISES 1e-6
/* Triangles are grown by this, relative to the shape's extent, so that a point between two neighbours is over one. */
#define MCD_MESH_OVERLAP 1e-9
/* Normals within this cosine of each other make one manifold: 1.1 degrees. */
#define MCD_MESH_SAME_MANIFOLD .9998

MeU32 mcd_meshHash(MeU32 a, MeU32 b);

static inline MeBool mcd_meshAreParallel(const double a[3], const double b[3]) {
    return mcd_distanceSquared(a, b) < MCD_MESH_RISES * MCD_MESH_RISES;
}

/* ---- adjacency and Voronoi regions (mcd_mesh_topology.c) --------------------------------------------------------- */

/* The Voronoi region of a triangle that a contact normal belongs to. */
typedef enum McdMeshRegion {
    MCD_FACE_REGION,     /* the triangle's own normal */
    MCD_BORDER_REGION,   /* an edge's or a corner's: between the normals of the faces there */
    MCD_INTERNAL_REGION, /* none: a neighbour rises above the plane across the normal, as at internal edges */
    MCD_FLAT_BORDER      /* an open border whose flags admit only the face's normal */
} McdMeshRegion;

/* Numbers the corners, if the program has not, and lists the triangles at each vertex. */
void mcd_meshBuildAdjacency(McdMesh *mesh);
McdMeshRegion mcd_meshRegion(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]);
/* Is every normal but the face's in MCD_INTERNAL_REGION, because the surroundings are flat? */
MeBool mcd_meshHasOnlyFaceNormal(const McdMeshQuery *q, const McdMeshTriangle *t);
MeBool mcd_meshHasVertex(const McdMeshTriangle *t, int v);
/* The corners that are farthest in a direction, within a tolerance: a bit mask. */
int mcd_meshFarthestCorners(const McdMeshTriangle *t, const double direction[3]);

/* ---- contacts (mcd_mesh_contacts.c) ------------------------------------------------------------------------------ */

/* Finds the contacts with all triangles of the query. */
void mcd_meshFindContacts(McdMeshQuery *q);

/* ---- contacts during a step (mcd_mesh_sweep.c) ------------------------------------------------------------------ */

/* Moves the contacts of a ball to where it comes to in the step. */
void mcd_meshSweep(McdMeshQuery *q);

/* ---- contacts along a given normal (mcd_mesh_clip.c) ------------------------------------------------------------- */

/* A point, a line or a convex polygon of the shape. */
enum { MCD_POLYGON_POINTS = 68 /* MCD_FACE_POINTS, and one more for each of three cuts, and one for rounding */ };
typedef struct McdPolygon {
    int count;
    double point[MCD_POLYGON_POINTS][3];
    MeU32 name[MCD_POLYGON_POINTS];
    MeBool isCut[MCD_POLYGON_POINTS]; /* no corner of the shape's face: where a cut has met an edge */
} McdPolygon;

/* The shape's face towards a direction. */
void mcd_polygonFace(const McdShape *shape, const double direction[3], McdPolygon *p);
/* The shape's support point, which need not be on that face. */
void mcd_polygonSupport(const McdShape *shape, const double direction[3], McdPolygon *p);
/* Adds a contact to the query's. */
void mcd_meshAddContact(McdMeshQuery *q, const McdMeshTriangle *t, const double position[3], const double normal[3],
                        double separation, MeU32 feature, MeBool isCut);
/* Adds contacts at the polygon's points within the margin; false if there are none. *least is the least separation so
 * far; onlyDeeper skips points that are not deeper than it. */
MeBool mcd_meshAddPoints(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], const McdPolygon *p,
                         MeBool onlyDeeper, double *min);
/* Adds contacts along the normal (the triangle's or its opposite): of the shape's face, clipped to the triangle grown
 * by tolerance times the extent, and of the support point. False if there are none. */
MeBool mcd_meshAddClipped(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], double tolerance);
/* Clips a segment to the triangle's prism: 0 <= in <= out <= 1; false if nothing is left. */
MeBool mcd_meshClipSegment(const McdMeshTriangle *t, const double from[3], const double to[3], double tolerance,
                           double *in, double *out);

/* ---- reduction (mcd_mesh_reduce.c) ------------------------------------------------------------------------------- */

/* Room for so many contacts; false, after a fatal error, if there is no memory. */
MeBool mcd_meshReserveContacts(McdMesh *mesh, int contacts);
/* Merges contacts to manifolds of at most four contacts per normal, at most `max` in all. */
void mcd_meshReduceContacts(McdMeshQuery *q, int max);

#endif
