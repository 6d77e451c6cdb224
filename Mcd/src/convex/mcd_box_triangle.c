/* A box and a triangle by the separating axis theorem: of the 13 axes, normals of faces and cross products of edges,
 * the one with the least overlap is the contact normal. Their Minkowski difference has no faces but across these. */
#include "convex/mcd_nearfield_i.h"

/* Both in the box' axes, relative to its centre. */
typedef struct BoxTriangle {
    const double *size; /* half of the box' sides */
    double corner[3][3], edge[3][3], normal[3];
    double limit, bias;
    double separation, axis[3]; /* the best axis so far, from the triangle to the box, length 1 */
    MeBool isTriangleFace;
    int boxEdge, triangleEdge; /* of a cross product: the box' axis, the triangle's edge; -1: it is a face's normal */
} BoxTriangle;

static void toBox(const McdShape *box, const McdShape *triangle, BoxTriangle *x) {
    x->size = box->size;
    for (int k = 0; k < 3; k++) {
        double opposite[3];
        mcd_sub(opposite, triangle->corner[k], box->place);
        mcd_shapeOwn(box, opposite, x->corner[k]);
    }
    mcd_shapeOwn(box, triangle->axis[2], x->normal);
    for (int k = 0; k < 3; k++)
        mcd_sub(x->edge[k], x->corner[(k + 1) % 3], x->corner[k]);
}

/* False: along this axis the shapes are farther apart than the limit. */
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
        const double below = low - x->size[i], above = -high - x->size[i]; /* the box is below, or above */
        double direction[3] = {0, 0, 0};
        direction[i] = 1;
        if (MeMAX(below, above) > x->separation &&
            !keepAxis(x, MeMAX(below, above), direction, below > above ? -1 : 1, 1))
            return MEFALSE;
    }
    return METRUE;
}

static MeBool tryTriangleFace(BoxTriangle *x) {
    const double height = -mcd_dot(x->normal, x->corner[0]); /* of the box' centre */
    const double reach =
        x->size[0] * fabs(x->normal[0]) + x->size[1] * fabs(x->normal[1]) + x->size[2] * fabs(x->normal[2]);
    x->isTriangleFace = !(fabs(height) - reach <= x->separation + x->bias);
    return !x->isTriangleFace || keepAxis(x, fabs(height) - reach, x->normal, height < 0 ? -1 : 1, 1);
}

/* The cross product of the box' axis i and the triangle's edge k; both corners of the edge project to one point. */
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
    /* gap <= least * length, without the root */
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
    const double ofFaces = x->separation + x->bias; /* to be better than */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (!tryEdgeAxis(x, i, k, MeMAX(ofFaces, x->separation)))
                return MEFALSE;
    return METRUE;
}

/* The nearest points of the triangle's edge and the box' edge that is farthest towards it. */
static void crossEdges(const McdShape *box, const McdShape *triangle, const BoxTriangle *x, McdProximity *p) {
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

/* The box' farthest corner over the triangle, or the triangle's in the box' face. */
static void cornerOverFace(const McdShape *box, const McdShape *triangle, MeBool isTriangleFace, McdProximity *p) {
    const double back[3] = {-p->normal[0], -p->normal[1], -p->normal[2]};
    if (isTriangleFace) {
        mcd_coreSupport(box, back, p->onA);
        mcd_mad(p->onB, p->onA, -p->separation, p->normal);
    } else {
        mcd_coreSupport(triangle, p->normal, p->onB);
        mcd_mad(p->onA, p->onB, p->separation, p->normal);
    }
}

MeBool mcd_boxTriangleProximity(const McdShape *box, const McdShape *triangle, double limit, McdProximity *p) {
    BoxTriangle x = {.limit = limit, .bias = mcd_faceBias * mcd_pairSize(box, triangle), .separation = -INFINITY};
    toBox(box, triangle, &x);
    const MeBool isNear = tryBoxFaces(&x) && tryTriangleFace(&x) && tryEdgeAxes(&x);
    p->separation = x.separation;
    if (!isNear)
        return MEFALSE;
    mcd_shapeDirection(box, x.axis[0], x.axis[1], x.axis[2], p->normal);
    p->isGuess = x.separation > 0;
    if (x.triangleEdge >= 0)
        crossEdges(box, triangle, &x, p);
    else
        cornerOverFace(box, triangle, x.isTriangleFace, p);
    MEVALIDATE(mcd_isAlongNormal(box, triangle, p));
    return isfinite(x.separation) != 0;
}
