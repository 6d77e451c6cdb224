/* The cap of a polyhedron: the corners and edges that a tilt may bring down on a plane.
 *
 * A tilt of up to t brings a corner at the distance d along the plane from the lowest one down by at most t d. */
#include "convex/mcd_kind_i.h"
#include "convex/mcd_landing_i.h"

static MeBool isBox(const McdShape *s) {
    return s->kind->rank == MCD_RANK_BOX;
}

MeBool mcd_isPolyhedron(const McdShape *s) {
    return s->hull != 0 || isBox(s);
}

MeBool mcd_isTurned(const McdShape *s) {
    return s->kind->rank == MCD_RANK_CYLINDER || s->kind->rank == MCD_RANK_CONE;
}

static int countCorners(const McdShape *s) {
    enum { BOX_CORNERS = 8 };
    return s->hull ? s->hull->vertexCount : isBox(s) ? BOX_CORNERS : 0;
}

/* A corner in the shape's own frame; of a box each bit of its number is a side. */
static void ownCorner(const McdShape *s, int corner, double own[3]) {
    if (s->hull)
        mcd_copy(own, s->hull->vertex[corner]);
    for (int k = 0; k < 3 && !s->hull; k++)
        own[k] = corner >> k & 1 ? s->size[k] : -s->size[k];
}

void mcd_cornerAt(const McdShape *s, int corner, double point[3]) {
    double own[3];
    ownCorner(s, corner, own);
    mcd_shapePoint(s, own[0], own[1], own[2], point);
}

/* Whether a tilt may bring a corner as far down as the lowest one. Hulls that land take 5 % more of all instructions
 * without it. */
static MeBool mayComeDown(const double corner[3], const double lowest[3], double height, double tilt) {
    return height * height <= tilt * tilt * (mcd_distanceSquared(corner, lowest) - height * height);
}

/* Sets the corners that a tilt may bring down, of them each one whose number the stride divides. False: there is no
 * room for them. */
static MeBool collectCap(const McdShape *s, const double down[3], const double lowest[3], double tilt, int stride,
                         McdCap *cap) {
    const int corners = countCorners(s);
    const double far = mcd_dot(lowest, down);
    double own[3];
    cap->count = 0;
    for (int i = 0, found = 0; i < corners; i++) {
        ownCorner(s, i, own);
        if (!mayComeDown(own, lowest, far - mcd_dot(own, down), tilt) || found++ % stride != 0)
            continue;
        if (cap->count == MCD_CAP_POINTS)
            return MEFALSE;
        cap->corner[cap->count] = i;
        mcd_shapePoint(s, own[0], own[1], own[2], cap->point[cap->count++]);
    }
    return METRUE;
}

/* Of more corners than there is room for those that a smaller tilt brings down: the body comes to them first. Of
 * corners in one plane every second, fourth, and so on. */
int mcd_capToward(const McdShape *s, const double direction[3], double tilt, McdCap *cap) {
    static const double flat = 1e-3; /* rad */
    const int corners = countCorners(s);
    double down[3], lowest[3] = {0, 0, 0}, own[3], far = -INFINITY;
    cap->count = 0;
    mcd_shapeToOwnAxes(s, direction, down);
    for (int i = 0; i < corners; i++) {
        ownCorner(s, i, own);
        const double x = mcd_dot(own, down);
        if (x > far) {
            far = x;
            mcd_copy(lowest, own);
        }
    }
    for (int stride = 1; !collectCap(s, down, lowest, tilt, stride, cap);) {
        if (tilt > flat)
            tilt *= .75;
        else
            stride *= 2;
    }
    MEASSERT(cap->count <= MCD_CAP_POINTS && (cap->count >= 1 || corners == 0));
    return cap->count;
}

/* ---- edges ------------------------------------------------------------------------------------------------------- */

static MeBool isInCap(const McdCap *cap, int corner) {
    for (int i = 0; i < cap->count; i++)
        if (cap->corner[i] == corner)
            return METRUE;
    return MEFALSE;
}

static int countNeighbours(const McdShape *s, int corner) {
    return s->hull ? s->hull->neighbourFirst[corner + 1] - s->hull->neighbourFirst[corner] : 3;
}

/* The edge number i of a corner: the other corner; its number among all, which it has twice. */
static int neighbourOf(const McdShape *s, int corner, int i, int *number) {
    *number = s->hull ? s->hull->neighbourFirst[corner] + i : 3 * corner + i;
    return s->hull ? s->hull->neighbour[*number] : corner ^ 1 << i;
}

int mcd_capEdges(const McdShape *s, const McdCap *cap, int (*edge)[3], int max) {
    int count = 0;
    for (int i = 0; i < cap->count; i++) {
        const int from = cap->corner[i], neighbours = countNeighbours(s, from);
        for (int k = 0; k < neighbours && count < max; k++) {
            int number;
            const int to = neighbourOf(s, from, k, &number);
            if (to < from && isInCap(cap, to))
                continue; /* added from there */
            edge[count][0] = from;
            edge[count][1] = to;
            edge[count++][2] = number;
        }
    }
    return count;
}

/* ---- heights ----------------------------------------------------------------------------------------------------- */

/* Cuts the span by a half-space: of the line's points those up to `room` along its normal, of which the line makes
 * `slope` each metre. */
static MeBool cutSpan(double slope, double room, double slack, double *low, double *high) {
    static const double parallel = 1e-12;
    if (fabs(slope) <= parallel)
        return room >= -slack;
    if (slope > 0)
        *high = MeMIN(*high, room / slope);
    else
        *low = MeMAX(*low, room / slope);
    return METRUE;
}

MeBool mcd_spanAlong(const McdShape *s, const double point[3], const double direction[3], double slack, double *low,
                     double *high) {
    double offset[3], own[3], along[3];
    MeBool isIn = METRUE;
    mcd_sub(offset, point, s->place);
    mcd_shapeToOwnAxes(s, offset, own);
    mcd_shapeToOwnAxes(s, direction, along);
    *low = -INFINITY;
    *high = INFINITY;
    for (int i = 0; s->hull && i < s->hull->faceCount && isIn; i++) {
        const McdHullFace *f = &s->hull->face[i];
        isIn = cutSpan(mcd_dot(f->normal, along), f->offset - mcd_dot(f->normal, own), slack, low, high);
    }
    for (int i = 0; !s->hull && i < 6 && isIn; i++) {
        const double side = i < 3 ? 1 : -1;
        isIn = cutSpan(side * along[i % 3], s->size[i % 3] - side * own[i % 3], slack, low, high);
    }
    return isIn && *low <= *high + slack;
}
