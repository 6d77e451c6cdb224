/* A box and a triangle by the separating axis theorem: of the 13 axes (face normals and cross products of edges) the
 * one with the smallest overlap is the contact normal. These are the normals of all faces of the Minkowski
 * difference. */
#include "convex/mcd_nearfield_i.h"

/* Both shapes in the box's frame, relative to its centre. */
typedef struct BoxTriangle {
    const double *size; /* half extents of the box */
    double corner[3][3], edge[3][3], normal[3];
    double limit, bias;
    double separation, axis[3]; /* the best axis so far, unit, from the triangle to the box */
    MeBool isTriangleFace;
    int boxEdge, triangleEdge; /* of a cross product: box's axis, triangle's edge; -1: a face's normal */
} BoxTriangle;

static void transformToBox(const McdShape *box, const McdShape *triangle, BoxTriangle *x) {
    x->size = box->size;
    for (int k = 0; k < 3; k++) {
        double opposite[3];
        mcd_sub(opposite, triangle->corner[k], box->place);
        mcd_shapeToOwnAxes(box, opposite, x->corner[k]);
    }
    mcd_shapeToOwnAxes(box, triangle->axis[2], x->normal);
    for (int k = 0; k < 3; k++)
        mcd_sub(x->edge[k], x->corner[(k + 1) % 3], x->corner[k]);
}

/* Keeps this axis as the best. Returns false if the shapes are farther apart along it than the limit. */
static MeBool keepAxis(BoxTriangle *x, double separation, const double direction[3], double side, double scale) {
    x->separation = separation;
    mcd_scale(x->axis, direction, side * scale);
    return !(separation > x->limit);
}

static MeBool tryBoxFaces(BoxTriangle *x) {
    x->boxEdge = x->triangleEdge = -1;
    for (int i = 0; i < 3; i++) {
        const double a = x->corner[0][i], b = x->corner[1][i], c = x->corner[2][i];
        const double low = MeMIN(a, MeMIN(b, c)), high = MeMAX(a, MeMAX(b, c));
        const double below = low - x->size[i], above = -high - x->size[i]; /* separations, box below or above */
        double direction[3] = {0, 0, 0};
        direction[i] = 1;
        if (MeMAX(below, above) > x->separation &&
            !keepAxis(x, MeMAX(below, above), direction, below > above ? -1 : 1, 1))
            return MEFALSE;
    }
    return METRUE;
}

static MeBool tryTriangleFace(BoxTriangle *x) {
    const double height = -mcd_dot(x->normal, x->corner[0]); /* of the box's centre above the triangle's plane */
    const double reach =
        x->size[0] * fabs(x->normal[0]) + x->size[1] * fabs(x->normal[1]) + x->size[2] * fabs(x->normal[2]);
    x->isTriangleFace = !(fabs(height) - reach <= x->separation + x->bias);
    return !x->isTriangleFace || keepAxis(x, fabs(height) - reach, x->normal, height < 0 ? -1 : 1, 1);
}

/* Tries the cross product of the box's axis i and the triangle's edge k, along which both ends of the edge project
 * to one point. */
static MeBool tryEdgeAxis(BoxTriangle *x, int i, int k, double min) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const double *edge = x->edge[k], *on = x->corner[k], *opposite = x->corner[(k + 2) % 3];
    double d[3];
    d[i] = 0;
    d[i1] = -edge[i2];
    d[i2] = edge[i1];
    const double squared = d[i1] * d[i1] + d[i2] * d[i2];
    if (!(squared > mcd_parallelSine * mcd_parallelSine * mcd_dot(edge, edge)))
        return METRUE;
    const double p = d[i1] * on[i1] + d[i2] * on[i2], q = d[i1] * opposite[i1] + d[i2] * opposite[i2];
    const double reach = x->size[i1] * fabs(d[i1]) + x->size[i2] * fabs(d[i2]);
    const double below = MeMIN(p, q) - reach, above = -MeMAX(p, q) - reach, gap = MeMAX(below, above);
    /* gap <= min * length, without the square root */
    if (gap < 0 && (min >= 0 || gap * gap >= min * min * squared))
        return METRUE;
    const double scale = 1 / sqrt(squared);
    if (gap * scale <= min)
        return METRUE;
    x->boxEdge = i;
    x->triangleEdge = k;
    return keepAxis(x, gap * scale, d, below > above ? -1 : 1, scale);
}

static MeBool tryEdgeAxes(BoxTriangle *x) {
    const double ofFaces = x->separation + x->bias; /* the separation to exceed */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (!tryEdgeAxis(x, i, k, MeMAX(ofFaces, x->separation)))
                return MEFALSE;
    return METRUE;
}

/* Witness points of an edge-edge contact: the closest points of the triangle's edge and the box's edge that is
 * farthest towards the triangle. */
static void setEdgeWitnesses(const McdShape *box, const McdShape *triangle, const BoxTriangle *x, McdProximity *p) {
    const double *u = box->axis[x->boxEdge], *to = triangle->corner[x->triangleEdge];
    const double length = box->size[x->boxEdge];
    double w[3], from[3], d[3];
    mcd_sub(w, triangle->corner[(x->triangleEdge + 1) % 3], to);
    mcd_copy(from, box->place);
    for (int i = 0; i < 3; i++)
        if (i != x->boxEdge)
            mcd_mad(from, from, copysign(box->size[i], -x->axis[i]), box->axis[i]);
    mcd_sub(d, to, from);
    const double ww = mcd_dot(w, w), uw = mcd_dot(u, w), du = mcd_dot(d, u), dw = mcd_dot(d, w), det = ww - uw * uw;
    const double s = (du * ww - uw * dw) / det, t = (uw * du - dw) / det;
    mcd_mad(p->onA, from, MeCLAMP(s, -length, length), u);
    mcd_mad(p->onB, to, MeCLAMP(t, 0, 1), w);
}

MeBool mcd_boxTriangleProximity(const McdShape *box, const McdShape *triangle, double limit, McdProximity *p) {
    BoxTriangle x = {.limit = limit, .bias = mcd_faceBias * mcd_pairSize(box, triangle), .separation = -INFINITY};
    transformToBox(box, triangle, &x);
    const MeBool isNear = tryBoxFaces(&x) && tryTriangleFace(&x) && tryEdgeAxes(&x);
    p->separation = x.separation;
    if (!isNear)
        return MEFALSE;
    mcd_shapeDirection(box, x.axis[0], x.axis[1], x.axis[2], p->normal);
    p->isGuess = x.separation > 0;
    if (x.triangleEdge >= 0)
        setEdgeWitnesses(box, triangle, &x, p);
    else
        mcd_setFaceWitnesses(box, triangle, !x.isTriangleFace, p);
    MEVALIDATE(mcd_isAlongNormal(box, triangle, p, 1e-8, 1e-12));
    return isfinite(x.separation) != 0;
}
