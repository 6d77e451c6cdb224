/* Inside Mcd: the boxes over the triangles of a mesh: a binary tree, built by FCL (fcl::BVHModel), walked here. The
 * interface between C and C++ as mcd_tree_i.h: nothing of FCL is visible, and nothing is thrown.
 *
 * A tree keeps boxes and the numbers of triangles, but not the triangles. Coordinates are the mesh's. Trees are read by
 * several threads at once. The order of visits depends on the triangles alone. */
#ifndef MCD_BVH_H
#define MCD_BVH_H

#include "MeMath.h"

ME_BEGIN_C

typedef struct McdBvh McdBvh;

/* Triangles by vertex numbers: corner k of triangle i is vertex[index[3 i + k]]. */
typedef struct McdBvhTriangles {
    const MeVector3 *vertex;
    const int *index;
    int vertexCount, count;
} McdBvhTriangles;

/* Builds the tree; null if there is no memory. count >= 1, all coordinates finite. */
McdBvh *mcd_bvhCreate(const McdBvhTriangles *triangles);
void mcd_bvhDestroy(McdBvh *bvh);
/* Fits all boxes to the same triangles after vertices have moved; the structure stays. Corners that are not finite are
 * ignored. */
void mcd_bvhRefit(McdBvh *bvh, const McdBvhTriangles *triangles);
/* The box around all triangles. */
void mcd_bvhBounds(const McdBvh *bvh, MeVector3 min, MeVector3 max);

/* Calls visit for each triangle whose box overlaps a box, until it returns false. */
typedef MeBool (*McdBvhVisit)(void *context, int triangle);
void mcd_bvhQuery(const McdBvh *bvh, const double low[3], const double high[3], McdBvhVisit visit, void *context);
/* For segments from `from` by `by`, best side by side: calls visit for each triangle whose box segment number `ray` may
 * hit before the current fraction of its length, initially 1, then what visit returns. The order is roughly from near
 * to far. */
typedef double (*McdBvhCastVisit)(void *context, int ray, int triangle, double fraction);
void mcd_bvhCast(const McdBvh *bvh, int count, const double from[][3], const double by[][3], McdBvhCastVisit visit,
                 void *context);

ME_END_C

#endif
