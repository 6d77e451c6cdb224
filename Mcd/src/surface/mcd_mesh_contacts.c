/* Contacts of a convex shape with each triangle of a surface. A triangle in flat surroundings has only one
 * admissible normal, its own: the shape's face is clipped to it. For other triangles the narrow phase finds the
 * normal, which is accepted only if it belongs to the Voronoi region of an edge or corner. */
#include "surface/mcd_mesh_stages_i.h"
#include "convex/mcd_seam_i.h"

/* ---- distances between the shape and a triangle ---------------------------------------------- */

static double heightOfCentre(const McdMeshQuery *q, const McdMeshTriangle *t) {
    return mcd_heightOver(q->centre, t->corner[0], t->normal);
}

/* Computes the unit vectors orthogonal to the edges, in the triangle's plane, pointing inward. False if the triangle
 * is so far away or so large that after rounding an edge has no length, or the third corner lies on an edge. */
static MeBool findInward(McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        double *inward = t->inward[i], edge[3];
        const double *opposite = t->corner[(i + 2) % 3];
        mcd_sub(edge, t->corner[(i + 1) % 3], t->corner[i]);
        mcd_cross(inward, t->normal, edge);
        const double length = mcd_length(inward);
        if (!(length > 0))
            return MEFALSE;
        mcd_scale(inward, inward, (mcd_heightOver(opposite, t->corner[i], inward) < 0 ? -1 : 1) / length);
        if (!(mcd_heightOver(opposite, t->corner[i], inward) > 0))
            return MEFALSE;
    }
    return METRUE;
}

/* Whether the shape's oriented box, grown by the margin, overlaps the triangle's prism. */
static MeBool overlapsPrism(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        double reach = 0;
        for (int k = 0; k < 3; k++)
            reach += q->half[k] * fabs(mcd_dot(q->shape.axis[k], t->inward[i]));
        if (mcd_heightOver(q->box, t->corner[i], t->inward[i]) + reach <
            -q->margin - MCD_MESH_OVERLAP * q->shape.extent)
            return MEFALSE;
    }
    return METRUE;
}

/* Whether the shape's oriented box, grown by the margin, overlaps the triangle along the box's axes. */
static MeBool overlapsBox(const McdMeshQuery *q, const McdMeshTriangle *t) {
    for (int i = 0; i < 3; i++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < 3; k++) {
            const double height = mcd_heightOver(t->corner[k], q->box, q->shape.axis[i]);
            low = fmin(low, height);
            high = fmax(high, height);
        }
        const double reach = q->half[i] + q->margin + MCD_MESH_OVERLAP * q->shape.extent;
        if (low > reach || high < -reach)
            return MEFALSE;
    }
    return METRUE;
}

/* Finds the manifold of the shape and the triangle as a convex shape, by the narrow phase; false if there is none. */
static MeBool intersectTriangle(const McdMeshQuery *q, const McdMeshTriangle *t, McdManifold *m) {
    McdShape triangle;
    if (t->isFlat || !overlapsBox(q, t))
        return MEFALSE;
    mcd_triangleShape(t->corner, &triangle);
    return mcd_convexManifold(&q->shape, &triangle, (McdReach){.margin = q->margin}, m) > 0;
}

/* ---- classification ---------------------------------------------------------------------------------------------- */

/* For checks: whether low and high, the shape's lowest and highest heights over the plane, are within its bounding
 * sphere. Heights are rounded relative to the distance of the corner that they are measured from: up to 1e30 m. */
static MeBool areHeightsGood(const McdMeshQuery *q, const McdMeshTriangle *t, double low, double high) {
    const double place = mcd_heightOver(q->shape.place, t->corner[0], t->normal),
                 distance = sqrt(mcd_distanceSquared(q->shape.place, t->corner[0])),
                 slack = 1e-6 * q->shape.extent + 1e-9 * fabs(place) + 1e-14 * distance;
    return !mcd_shapeIsKnown(&q->shape) || !mcd_isUnit(t->normal) ||
           (low <= high + slack && high <= place + q->shape.extent + slack && low >= place - q->shape.extent - slack);
}

/* Whether the core is above the triangle's plane and its lowest point projects into the triangle. Then that point and
 * its projection are the closest points, and the contact normal is the triangle's. */
static MeBool isBelowShape(const McdMeshQuery *q, const McdMeshTriangle *t, const double lowest[3], double low) {
    double in, out;
    return low + q->shape.rounding > 0 &&
           mcd_meshClipSegment(t, lowest, lowest, MCD_MESH_OVERLAP * q->shape.extent, &in, &out);
}

/* Classifies a triangle. Sets inward and isFlat; isPending for triangles within reach; facing for those with only
 * one admissible normal; isBelow. */
static void classifyTriangle(McdMeshQuery *q, McdMeshTriangle *t) {
    double back[3], lowest[3], highest[3];
    t->facing = 0;
    t->isPending = t->isBelow = MEFALSE;
    t->isFlat = !findInward(t);
    if (t->isFlat || !overlapsPrism(q, t))
        return;
    mcd_scale(back, t->normal, -1);
    mcd_support(&q->shape, back, lowest);
    mcd_support(&q->shape, t->normal, highest);
    const double low = mcd_heightOver(lowest, t->corner[0], t->normal);
    const double high = mcd_heightOver(highest, t->corner[0], t->normal);
    MEVALIDATE(areHeightsGood(q, t, low, high));
    if (low > q->margin || high < -q->margin)
        return;
    t->isPending = METRUE;
    t->isBelow = isBelowShape(q, t, lowest, low);
    if (t->flags & kMcdTriangleTwoSided)
        t->facing = !mcd_meshHasOnlyFaceNormal(q, t) ? 0 : low + high < 0 ? -1 : 1;
    else
        t->facing = heightOfCentre(q, t) >= 0 && mcd_meshHasOnlyFaceNormal(q, t);
    MEASSERT(t->facing >= 0 || t->flags & kMcdTriangleTwoSided);
}

/* ---- all triangles in one plane -------------------------------------------------------------- */

/* The first pending triangle if all pending ones are coplanar and face the same way; else null. */
static const McdMeshTriangle *commonPlane(const McdMeshQuery *q) {
    const McdMeshTriangle *first = 0;
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        if (!t->isPending)
            continue;
        if (!first)
            first = t;
        if (!t->facing || t->facing != first->facing || !mcd_meshAreParallel(t->normal, first->normal) ||
            fabs(mcd_heightOver(t->corner[0], first->corner[0], first->normal)) > MCD_MESH_OVERLAP * q->shape.extent)
            return 0;
    }
    return first;
}

/* Adds each point of the polygon as a contact of the first pending triangle below that point. Returns false if there
 * is no such triangle for some point. */
static MeBool addPointsOverTriangles(McdMeshQuery *q, const double normal[3], const McdPolygon *p, MeBool onlyDeeper,
                                     double *min) {
    for (int i = 0; i < p->count; i++) {
        McdPolygon one; /* only its first point is set */
        double in, out;
        int k = 0;
        one.count = 1;
        one.name[0] = p->name[i];
        one.isCut[0] = MEFALSE;
        mcd_copy(one.point[0], p->point[i]);
        while (k < q->mesh->count &&
               !(q->mesh->triangle[k].isPending && mcd_meshClipSegment(&q->mesh->triangle[k], p->point[i], p->point[i],
                                                                       MCD_MESH_OVERLAP * q->shape.extent, &in, &out)))
            k++;
        if (k == q->mesh->count)
            return MEFALSE;
        if (k < q->mesh->own)
            mcd_meshAddPoints(q, &q->mesh->triangle[k], normal, &one, onlyDeeper, min);
    }
    return METRUE;
}

/* If all pending triangles lie in one plane and cover the shape's face, adds the contacts with that plane. Otherwise
 * returns false and adds none. */
static MeBool addPlaneContacts(McdMeshQuery *q) {
    const McdMeshTriangle *t = commonPlane(q);
    McdPolygon p;
    double face[3], back[3], min = INFINITY;
    if (!t)
        return MEFALSE;
    MEASSERT(t->isPending && t->facing != 0);
    mcd_scale(face, t->normal, t->facing);
    mcd_scale(back, face, -1);
    mcd_polygonFace(&q->shape, back, &p);
    if (addPointsOverTriangles(q, face, &p, MEFALSE, &min)) {
        mcd_polygonSupport(&q->shape, back, &p);
        if (addPointsOverTriangles(q, face, &p, METRUE, &min)) {
            for (int i = 0; i < q->mesh->own; i++)
                if (q->mesh->triangle[i].isPending)
                    mcd_meshAddCap(q, &q->mesh->triangle[i], face);
            return METRUE;
        }
    }
    q->mesh->contactCount = 0;
    return MEFALSE;
}

/* ---- triangles with only one admissible normal ----------------------------------------------- */

/* The contact's point on the surface. */
static void surfacePointOf(const McdMeshContact *c, double foot[3]) {
    mcd_mad(foot, c->position, -c->separation / 2, c->normal);
}

/* Estimates where the shape entered the surface: where the line from the contact's point on the shape, below the
 * plane, to the shape's highest point crosses the plane. False if the whole shape is below. */
static MeBool findEntry(const McdMeshQuery *q, const McdMeshContact *c, double entry[3]) {
    double foot[3], point[3], highest[3], offset[3];
    surfacePointOf(c, foot);
    mcd_mad(point, c->position, c->separation / 2, c->normal);
    mcd_support(&q->shape, c->normal, highest);
    const double height = mcd_heightOver(highest, foot, c->normal);
    if (height <= 0)
        return MEFALSE;
    mcd_sub(offset, highest, point);
    mcd_mad(entry, point, c->separation / (c->separation - height), offset);
    MEASSERT(c->separation <= 0); /* one end below, the other above: no division by 0 */
    return METRUE;
}

/* Adds the contacts along the face's normal if at least one of them is on or above the surface, or its estimated point
 * of entry (findEntry) lies in this triangle, or if the narrow phase finds that the shape touches the triangle.
 * Otherwise adds none and returns false. */
static MeBool addFaceContacts(McdMeshQuery *q, const McdMeshTriangle *t) {
    const int first = q->mesh->contactCount;
    const double overlap = MCD_MESH_OVERLAP * q->shape.extent;
    double face[3], entry[3], in, out;
    McdManifold m;
    MEASSERT(t->facing == 1 || t->facing == -1);
    mcd_scale(face, t->normal, t->facing);
    mcd_meshAddClipped(q, t, face, MCD_MESH_OVERLAP);
    for (int i = first; i < q->mesh->contactCount; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        if (c->separation >= 0 || (findEntry(q, c, entry) && mcd_meshClipSegment(t, entry, entry, overlap, &in, &out)))
            return METRUE;
    }
    if (first < q->mesh->contactCount && intersectTriangle(q, t, &m))
        return METRUE;
    q->mesh->contactCount = first;
    return MEFALSE;
}

/* ---- triangles whose normal must be searched ------------------------------------------------- */

/* The border of a triangle in the direction of a contact's normal, and the other triangles of the query. */
typedef struct Border {
    const McdMeshQuery *q;
    const McdMeshTriangle *t;
    int corners; /* of the border: mcd_meshFarthestCorners */
} Border;

static MeBool sharesBorder(const Border *b, const McdMeshTriangle *other) {
    for (int k = 0; k < 3; k++)
        if (b->corners & 1 << k && !mcd_meshHasVertex(other, b->t->vertex[k]))
            return MEFALSE;
    return METRUE;
}

static MeBool isWithinReach(const McdMeshTriangle *t, const double point[3], double reach) {
    for (int i = 0; i < 3; i++)
        if (mcd_triangleLow(t, i) > point[i] + reach || mcd_triangleHigh(t, i) < point[i] - reach)
            return MEFALSE;
    return METRUE;
}

static void *findTriangle(const McdSeam *s, const double point[3], double reach, McdSeamVisit visit,
                          const void *context) {
    const Border *b = s->pieces;
    for (int i = 0; i < b->q->mesh->count; i++) {
        McdMeshTriangle *other = &b->q->mesh->triangle[i];
        McdShape shape;
        if (other == b->t || sharesBorder(b, other) || !isWithinReach(other, point, reach))
            continue;
        mcd_triangleShape(mcd_constRows(other->corner), &shape);
        if (visit(&shape, other->flags & kMcdTriangleTwoSided ? 0 : other->normal, context))
            return other;
    }
    return 0;
}

/* Whether a triangle that does not share the border's corners continues the face beyond the border (mcd_seam.c).
 * isOverGap: the shape is above the gap between both, from where the shift takes it above the face. */
static MeBool isContinued(const McdMeshQuery *q, const McdMeshTriangle *t, const double face[3], const McdManifold *m,
                          MeBool *isOverGap, double shift[3]) {
    const Border b = {q, t, mcd_meshFarthestCorners(t, m->normal)};
    const McdManifoldPoint *deepest = &m->point[0];
    McdSeam s = {.body = &q->shape, .side = face, .find = findTriangle, .pieces = &b};
    double normal[3];
    MEASSERT(m->count >= 1);
    for (int i = 1; i < m->count; i++)
        if (m->point[i].separation < deepest->separation)
            deepest = &m->point[i];
    mcd_triangleShape(t->corner, &s.shape);
    s.skin = mcd_seamSkin(&s.shape, &q->shape, q->origin);
    s.gap = mcd_seamGap(&q->shape);
    mcd_copy(s.normal, m->normal);
    s.separation = deepest->separation;
    mcd_mad(s.point, deepest->position, -deepest->separation / 2, m->normal);
    if (!mcd_seamPieceBeyond(&s, normal))
        return MEFALSE;
    *isOverGap = mcd_seamGapShift(&s, &q->shape, face, shift);
    return METRUE;
}

/* Adds the contacts along the face's normal of a shape above the gap beside the face: those of the shape moved onto
 * the face, moved back. False if there are none. */
static MeBool addOverGap(McdMeshQuery *q, const McdMeshTriangle *t, const double face[3], const double shift[3]) {
    const McdShape shape = q->shape;
    const int first = q->mesh->contactCount;
    mcd_mad(q->shape.place, shape.place, 1, shift);
    const MeBool isAnyAdded = mcd_meshAddClipped(q, t, face, MCD_MESH_OVERLAP);
    q->shape = shape;
    for (int i = first; i < q->mesh->contactCount; i++)
        mcd_mad(q->mesh->contact[i].position, q->mesh->contact[i].position, -1, shift);
    return isAnyAdded;
}

/* Adds the narrow phase's contacts. Their feature is that of the edge or corner, equal for all triangles there. */
static void addManifold(McdMeshQuery *q, const McdMeshTriangle *t, const McdManifold *m) {
    const int mask = mcd_meshFarthestCorners(t, m->normal);
    MeU32 feature = 0;
    MEASSERT(m->count >= 1 && m->count <= MCD_MANIFOLD_POINTS);
    for (int i = 0; i < 3; i++)
        if (mask & 1 << i)
            feature += t->key[i];
    for (int i = 0; i < m->count; i++)
        mcd_meshAddContact(q, t, m->point[i].position, m->normal, m->point[i].separation,
                           mcd_meshHash(feature, mcd_featureNumber(m->point[i].feature)), METRUE);
}

/* The side of a triangle on which contacts are: 1 the normal's, -1 the opposite. For a two-sided triangle that of
 * the contact normal or, if that is nearly parallel to the plane, that of the shape's centre. */
static double contactSideOf(const McdMeshTriangle *t, double cosine, double centreHeight) {
    if (!(t->flags & kMcdTriangleTwoSided))
        return 1;
    return (fabs(cosine) > .5 ? cosine : centreHeight) < 0 ? -1 : 1;
}

/* Drops the speculative contacts from number `first` on that were made by clipping: where the shape's face is tilted
 * over an internal edge, it will touch the neighbouring triangle, not this one. */
static void dropSpeculativeCuts(McdMeshQuery *q, int first) {
    int count = first;
    for (int i = first; i < q->mesh->contactCount; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        if (!c->isCut || c->separation <= 0)
            q->mesh->contact[count++] = *c;
    }
    q->mesh->contactCount = count;
}

/* Adds the contacts along the narrow phase's normal, where that is a normal of the surface, else along the face's
 * normal. For a triangle below the shape both are the same. False if the shape does not touch the triangle. */
static MeBool addSearchedContacts(McdMeshQuery *q, McdMeshTriangle *t) {
    McdManifold m;
    double face[3];
    MEASSERT(!t->facing);
    if (t->isBelow) {
        t->facing = 1;
        return mcd_meshAddClipped(q, t, t->normal, MCD_MESH_OVERLAP);
    }
    if (!intersectTriangle(q, t, &m))
        return MEFALSE;
    const double height = heightOfCentre(q, t), side = contactSideOf(t, mcd_dot(m.normal, t->normal), height);
    mcd_scale(face, t->normal, side);
    const double cosine = mcd_dot(m.normal, face);
    McdMeshRegion region = mcd_meshRegion(q, t, m.normal);
    MeBool isOverGap = MEFALSE;
    double shift[3];
    if ((region == MCD_BORDER_REGION || region == MCD_FLAT_BORDER) && isContinued(q, t, face, &m, &isOverGap, shift))
        region = MCD_INTERNAL_REGION;
    if (region == MCD_FLAT_BORDER && cosine < .5) /* pushed sideways by an edge that is not sharp: no contact */
        return METRUE;

    const MeBool isFace = mcd_distanceSquared(m.normal, face) < MCD_MESH_SAME_DIRECTION * MCD_MESH_SAME_DIRECTION ||
                          (region == MCD_FACE_REGION && cosine > 0);
    const MeBool isFromBehind = !(t->flags & kMcdTriangleTwoSided) && cosine < -MCD_MESH_SAME_DIRECTION;
    const MeBool mayUseBorder = (t->flags & kMcdTriangleUseSmallestPenetration) != 0;
    if (!isFace && region == MCD_BORDER_REGION && mayUseBorder && !isFromBehind) {
        addManifold(q, t, &m);
        return METRUE;
    }
    if (isFace || side * height >= 0)
        t->facing = (int)side;
    const int first = q->mesh->contactCount;
    if (t->facing && mcd_meshAddClipped(q, t, face, MCD_MESH_OVERLAP)) {
        if (!isFace && region == MCD_INTERNAL_REGION)
            dropSpeculativeCuts(q, first);
        return METRUE;
    }
    if (isOverGap && addOverGap(q, t, face, shift))
        return METRUE;
    /* If the normal equals the face's only within the tolerance, its point may be beside the face by as much. Where it
     * is farther away, a shape that curves up from the next triangle of the plane does not touch this one. */
    if (isFace)
        mcd_meshAddClipped(q, t, face, MCD_MESH_SAME_DIRECTION);
    return METRUE;
}

/* ---- coplanar triangles that were not hit directly ------------------------------------------- */

static MeBool areCoplanar(const McdMeshQuery *q, const McdMeshTriangle *a, const McdMeshTriangle *b) {
    if (1 - fabs(mcd_dot(a->normal, b->normal)) > MCD_MESH_RISES * MCD_MESH_RISES)
        return MEFALSE;
    return fabs(mcd_heightOver(b->corner[0], a->corner[0], a->normal)) <= MCD_MESH_RISES * q->shape.extent;
}

/* Whether triangles in t's plane cover the segment, the last of them facing along the normal. Extends the covered
 * part from its start until no triangle extends it further. */
static MeBool isSegmentCovered(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3],
                               const double from[3], const double to[3]) {
    double covered = 0, in, out;
    for (MeBool isExtended = METRUE; isExtended;) {
        isExtended = MEFALSE;
        for (int i = 0; i < q->mesh->count; i++) {
            const McdMeshTriangle *other = &q->mesh->triangle[i];
            if ((!other->facing && !other->isPending) || !areCoplanar(q, t, other) ||
                !mcd_meshClipSegment(other, from, to, MCD_MESH_OVERLAP * q->shape.extent, &in, &out) || in > covered)
                continue;
            if (out == 1 && other->facing * mcd_dot(other->normal, normal) > 0)
                return METRUE;
            isExtended = isExtended || out > covered;
            covered = fmax(covered, out);
        }
    }
    MEASSERT(covered >= 0 && covered <= 1);
    return MEFALSE;
}

/* The smallest separation among the first `count` contacts that lie in the triangle's plane. */
static double minSeparationOnPlane(const McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], int count) {
    double min = INFINITY;
    for (int i = 0; i < count; i++) {
        const McdMeshContact *c = &q->mesh->contact[i];
        double foot[3];
        surfacePointOf(c, foot);
        if (c->separation < min && mcd_meshAreParallel(c->normal, normal) &&
            fabs(mcd_heightOver(foot, t->corner[0], normal)) <= MCD_MESH_RISES * q->shape.extent)
            min = c->separation;
    }
    return min;
}

/* Adds contacts of coplanar neighbours that were not hit directly: points below the triangle that are as deep as the
 * deepest contact with its plane, if the surface covers the segment from there to the shape's entry into the plane. */
static void addCoplanarContacts(McdMeshQuery *q, const McdMeshTriangle *t) {
    McdMesh *mesh = q->mesh;
    double face[3], foot[3], entry[3];
    const int first = mesh->contactCount;
    int count = first;
    mcd_scale(face, t->normal, t->facing < 0 ? -1 : 1);
    if (!mcd_meshAddClipped(q, t, face, MCD_MESH_OVERLAP))
        return;
    const double deep = minSeparationOnPlane(q, t, face, first) + MCD_MESH_OVERLAP * q->shape.extent;
    for (int i = first; i < mesh->contactCount; i++) {
        const McdMeshContact *c = &mesh->contact[i];
        surfacePointOf(c, foot);
        if (c->separation < 0 && c->separation <= deep && findEntry(q, c, entry) &&
            isSegmentCovered(q, t, face, foot, entry))
            mesh->contact[count++] = *c;
    }
    MEASSERT(count >= first && count <= mesh->contactCount);
    mesh->contactCount = count;
}

/* ---- recovery from tunnelling ---------------------------------------------------------------- */

/* For shapes without contacts whose centre is behind a one-sided triangle by less than half of their radius: adds
 * contacts with the nearest such triangle, and with triangles of the same normal, which push the shape back. */
static void recoverFromBehind(McdMeshQuery *q) {
    const McdMeshTriangle *nearest = 0;
    McdManifold m;
    double min = fmin(q->radius, q->shape.extent) / 2;
    for (int i = 0; i < q->mesh->own; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        const double depth = -heightOfCentre(q, t);
        if (t->flags & kMcdTriangleTwoSided || depth < 0 || depth >= min || !intersectTriangle(q, t, &m))
            continue;
        min = depth;
        nearest = t;
    }
    for (int i = 0; nearest && i < q->mesh->own; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        if (mcd_dot(t->normal, nearest->normal) > MCD_MESH_SAME_MANIFOLD && intersectTriangle(q, t, &m))
            mcd_meshAddClipped(q, t, t->normal, MCD_MESH_OVERLAP);
    }
}

/* ---- all triangles ----------------------------------------------------------------------------------------------- */

void mcd_meshFindContacts(McdMeshQuery *q) {
    McdMesh *mesh = q->mesh;
    MEASSERT(mesh->contactCount == 0);
    for (int i = 0; i < mesh->count; i++)
        classifyTriangle(q, &mesh->triangle[i]);
    if (!addPlaneContacts(q)) {
        for (int i = 0; i < mesh->own; i++) {
            McdMeshTriangle *t = &mesh->triangle[i];
            if (t->isPending)
                t->isPending = t->facing ? !addFaceContacts(q, t) : !addSearchedContacts(q, t);
        }
        for (int i = 0; i < mesh->own; i++)
            if (mesh->triangle[i].isPending)
                addCoplanarContacts(q, &mesh->triangle[i]);
    }
    if (!mesh->contactCount)
        recoverFromBehind(q);
    MEASSERT(mesh->contactCount >= 0 && mesh->contactCount <= mesh->contactMax);
}
