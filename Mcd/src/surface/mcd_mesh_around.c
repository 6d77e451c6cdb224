/* The surroundings of a surface of triangles: other surfaces, convex shapes and half-spaces that form one surface with
 * it, as triangles. They bound the Voronoi regions of its borders (mcd_mesh_topology.c), continue its faces
 * (mcd_seam.c), and are where a ball goes (mcd_mesh_sweep.c). Contacts with them are those of other pairs. */
#include "surface/mcd_mesh_stages_i.h"
#include "surface/mcd_pieces_i.h"

/* Adds a triangle that is given in the query's coordinates. */
static void addTriangle(McdMeshQuery *q, const double corner[3][3], const double normal[3], int flags) {
    static const McdElementData none = {0};
    double own[3][3], ownNormal[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            own[k][i] = mcd_heightOver(corner[k], q->place, q->axis[i]);
        ownNormal[i] = mcd_dot(normal, q->axis[i]);
    }
    mcd_meshAdd(q, mcd_constRows(own), ownNormal, flags, 0, none);
}

static MeBool addGathered(void *context, const McdMeshTriangle *t, const McdShape *triangle) {
    (void)triangle;
    addTriangle(context, (const double(*)[3])t->corner, t->normal, t->flags);
    return METRUE;
}

enum { FLAGS = kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges };

/* Adds the faces that the shape may touch, as fans of triangles. */
static void addFaces(McdMeshQuery *q, const McdShape *piece) {
    McdFace face;
    double normal[3];
    for (int i = 0; i < mcd_shapeFaces(piece); i++) {
        if (!mcd_shapeFaceNormal(piece, i, normal))
            continue;
        if (mcd_separationAlong(&q->shape, piece, normal) - q->shape.rounding - piece->rounding > q->margin)
            continue;
        mcd_faceToward(piece, normal, &face);
        for (int k = 0; k < face.count; k++)
            mcd_mad(face.point[k], face.point[k], piece->rounding, normal);
        for (int k = 2; k < face.count; k++) {
            double corner[3][3];
            mcd_copy(corner[0], face.point[0]);
            mcd_copy(corner[1], face.point[k - 1]);
            mcd_copy(corner[2], face.point[k]);
            addTriangle(q, mcd_constRows(corner), normal, FLAGS);
        }
    }
}

/* A box around shape and margin, along the world's axes. */
typedef struct Around {
    McdMeshQuery *q;
    double low[3], high[3];
} Around;

static MeBool addPiece(const McdPieces *p, McdGeometryInstance *piece, void *context) {
    const Around *a = context;
    McdMeshQuery *q = a->q;
    McdShape shape;
    if (mcd_isSurface(piece)) {
        mcd_meshForEachNear(piece, q->pair->model1, p->origin, a->low, a->high, addGathered, q);
    } else if (mcd_isHalfSpace(piece)) {
        double corner[3][3], normal[3];
        mcd_planeTriangle(mcd_const(mcd_instanceTM(piece)), p->origin, q->centre, q->radius + q->margin, corner,
                          normal);
        addTriangle(q, mcd_constRows(corner), normal, FLAGS);
    } else if (mcd_shapeOf(piece, p->origin, &shape) && mcd_shapeIsRigid(&shape)) {
        addFaces(q, &shape);
    }
    return MEFALSE;
}

void mcd_meshAddAround(McdMeshQuery *q) {
    McdPieces pieces;
    Around a = {.q = q};
    mcd_piecesBegin(&pieces, &mcd_record(q->pair->model2)->instance, &mcd_record(q->pair->model1)->instance, q->origin);
    q->mesh->own = q->mesh->count;
    for (int i = 0; i < 3; i++) {
        a.low[i] = q->centre[i] - q->radius - q->margin;
        a.high[i] = q->centre[i] + q->radius + q->margin;
    }
    mcd_piecesOverlap(&pieces, a.low, a.high, addPiece, &a);
    if (q->mesh->count > q->mesh->own)
        q->mesh->vertexCount = 0; /* the corners of all are numbered, by coordinates */
}
