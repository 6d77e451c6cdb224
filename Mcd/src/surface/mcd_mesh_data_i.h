/* Inside Mcd: the triangles of an indexed mesh, which the mesh and its scaled copies share. */
#ifndef MCD_MESH_DATA_H
#define MCD_MESH_DATA_H

#include "model/mcd_frame_i.h"
#include "surface/mcd_bvh_i.h"

typedef struct McdMeshData {
    int references;
    McdBvhTriangles triangles; /* vertex: `own`, or the program's; index: `index` */
    MeVector3 *own;            /* the vertices; null: borrowed */
    int *index;                /* welded: equal coordinates have one number; (v, v, v): left out at creation */
    MeU32 *material;           /* of each triangle; null: none */
    int *neighbour;            /* 3 i + k: the triangle across the edge of i from its corner k; -1: none, or several */
    int *patch;                /* of each triangle, see mcd_mesh_flat.c */
    McdBvh *bvh;
    int flags;   /* McdMeshFlags */
    int leftOut; /* triangles without area, with bad vertices or bad coordinates, at creation */
} McdMeshData;

/* What a program gives; the arguments of McdMeshCreateWithFlags. */
typedef struct McdMeshInput {
    const MeVector3 *vertex;
    int vertexCount;
    const int *index;
    int triangleCount;
    const MeU32 *material;
    int flags;
} McdMeshInput;

/* Null, with a message that names the function, if no triangle is good, or there is no memory. One reference. */
McdMeshData *mcd_meshDataCreate(const McdMeshInput *input, const char *function);
/* Drops a reference. */
void mcd_meshDataRelease(McdMeshData *data);
/* Copies as many vertices as there are, or borrows them; mcd_meshDataRefit must follow. */
void mcd_meshDataSetVertices(McdMeshData *data, const MeVector3 *vertices);
/* Fits the tree to the vertices' current places. */
void mcd_meshDataRefit(McdMeshData *data, const char *function);
/* The corners of a triangle times a scale along each axis. */
void mcd_meshDataCorners(const McdMeshData *data, int triangle, const MeReal scale[3], double corner[3][3]);
/* Whether the triangle was left out since it had no good corners. */
MeBool mcd_meshDataIsPoint(const McdMeshData *data, int triangle);
/* Whether the surface has no border: each edge is used as often in one direction as in the other. */
MeBool mcd_meshDataIsClosed(const McdMeshData *data);

/* ---- flat parts (mcd_mesh_flat.c) -------------------------------------------------------------------------------- */

/* False, after a fatal error, if there is no memory. */
MeBool mcd_meshDataFindNeighbours(McdMeshData *data, const char *function);
/* Sets `patch`, by the neighbours. stack: of as many numbers as triangles. */
void mcd_meshDataFindPatches(McdMeshData *data, int *stack);
/* If all triangles near a box are inside of one patch: the last of them; else -1. Then the surface in the box is the
 * plane of that triangle, without border. */
int mcd_meshDataPatchOf(const McdMeshData *data, const int *triangle, int count);

#endif
