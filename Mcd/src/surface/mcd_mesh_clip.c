/* Contacts of a convex shape with a triangle along a given normal: clips the shape's face to the triangle. */
#include "surface/mcd_mesh_stages_i.h"
#include "convex/mcd_landing_i.h"
#include "convex/mcd_nearfield_i.h"
#include "convex/mcd_sampled_i.h"

/* ---- polygons ---------------------------------------------------------------------------------------------------- */

static void appendPoint(McdPolygon *p, const double point[3], MeU32 name, MeBool isCut) {
    if (p->count == MCD_POLYGON_POINTS)
        return;
    p->isCut[p->count] = isCut;
    mcd_copy(p->point[p->count], point);
    p->name[p->count++] = name;
}

void mcd_polygonFace(const McdShape *shape, const double direction[3], McdPolygon *p) {
    McdFace face;
    mcd_faceToward(shape, direction, &face);
    MEASSERT(face.count >= 0 && face.count <= MCD_FACE_POINTS);
    p->count = 0;
    for (int i = 0; i < face.count; i++)
        appendPoint(p, face.point[i], mcd_meshHash(face.id, face.name[i]), MEFALSE);
}

void mcd_polygonSupport(const McdShape *shape, const double direction[3], McdPolygon *p) {
    double point[3];
    mcd_coreSupport(shape, direction, point);
    p->count = 0;
    appendPoint(p, point, 0, MEFALSE);
}

/* Sutherland-Hodgman clipping: keeps the part with inward . x >= offset. A point stays a point, a line a line. */
static void clipByPlane(const McdPolygon *in, const double inward[3], double offset, double tolerance, MeU32 edgeName,
                        McdPolygon *out) {
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        const int next = (i + 1) % in->count;
        const double a = mcd_dot(in->point[i], inward) - offset, b = mcd_dot(in->point[next], inward) - offset;
        if (a >= -tolerance)
            appendPoint(out, in->point[i], in->name[i], in->isCut[i]);
        if ((a >= -tolerance) == (b >= -tolerance) || (in->count == 2 && i == 1))
            continue;
        double d[3], at[3];
        mcd_sub(d, in->point[next], in->point[i]);
        mcd_mad(at, in->point[i], MeCLAMP(a / (a - b), 0, 1), d);
        appendPoint(out, at, mcd_meshHash(in->name[i] + in->name[next], edgeName), METRUE);
    }
    MEASSERT(out->count <= in->count + 2); /* a plane cuts at most two sides of a convex polygon, plus rounding */
}

/* Clips a polygon to the triangle's prism: the part over or below the triangle, along its normal. */
static void clipToPrism(const McdMeshTriangle *t, double tolerance, const McdPolygon *p, McdPolygon *clipped) {
    McdPolygon a, b;
    const McdPolygon *from[3] = {p, &a, &b};
    McdPolygon *to[3] = {&a, &b, clipped};
    clipped->count = 0;
    for (int i = 0; i < 3 && from[i]->count; i++) {
        const double *inward = t->inward[i];
        clipByPlane(from[i], inward, mcd_dot(t->corner[i], inward), tolerance, t->key[i] + t->key[(i + 1) % 3], to[i]);
    }
}

MeBool mcd_meshClipSegment(const McdMeshTriangle *t, const double from[3], const double to[3], double tolerance,
                           double *in, double *out) {
    *in = 0;
    *out = 1;
    for (int i = 0; i < 3; i++) {
        const double *inward = t->inward[i];
        const double a = mcd_heightOver(from, t->corner[i], inward) + tolerance;
        const double b = mcd_heightOver(to, t->corner[i], inward) + tolerance;
        if (a < 0 && b < 0)
            return MEFALSE;
        if (a < 0)
            *in = fmax(*in, a / (a - b));
        if (b < 0)
            *out = fmin(*out, a / (a - b));
    }
    MEASSERT(*in >= 0 && *in <= 1 && *out >= 0 && *out <= 1);
    return *in <= *out;
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

/* The normal in cells of a width: part of the feature id, so that contacts of one corner with two faces have different
 * ids. Those with facets at a small angle, too: one that carries a load is not the one that the shape comes to. Normals
 * of edges turn, so that their cells are wider. */
static MeU32 quantizedNormal(const double normal[3], MeBool isOnFace) {
    const int cells = isOnFace ? 4096 : 8;
    MeU32 hash = 0;
    for (int i = 0; i < 3; i++)
        hash = mcd_meshHash(hash, (MeU32)mcd_floorBetween(normal[i] * cells + cells + .5, 0, 2 * cells + 1));
    return hash;
}

/* Only of a program's support function whose points contradict each other. */
static MeBool isTooFar(const McdMeshQuery *q, double separation) {
    return separation > q->margin + MCD_MESH_OVERLAP * q->shape.extent;
}

/* Whether the shape touches with a point of its axis: the tip of a cone. */
static MeBool isOnAxis(const McdShape *s, const McdMeshContact *c) {
    double offset[3];
    mcd_mad(offset, c->position, c->separation / 2, c->normal);
    mcd_sub(offset, offset, s->place);
    mcd_mad(offset, offset, -mcd_dot(offset, s->axis[2]), s->axis[2]);
    return mcd_length(offset) <= MCD_MESH_OVERLAP * s->extent;
}

void mcd_meshAddContact(McdMeshQuery *q, const McdMeshTriangle *t, const double position[3], const double normal[3],
                        double separation, MeU32 feature, MeBool isCut) {
    McdMesh *mesh = q->mesh;
    const double size = mcd_dot(normal, normal);
    double outward[3];
    mcd_scale(outward, normal, -1);
    if (!(size > 0) || !isfinite(size + separation + position[0] + position[1] + position[2]))
        return; /* coordinates near the largest number may overflow */
    if (q->shape.kind->isSampled && isTooFar(q, separation)) {
        mcd_sampledWarn(q->shape.sampled);
        return;
    }
    if (!mcd_meshReserveContacts(mesh, mesh->contactCount + 1))
        return;
    MEASSERT(t >= mesh->triangle && t < mesh->triangle + mesh->count);
    McdMeshContact *c = &mesh->contact[mesh->contactCount++];
    MEASSERT(mesh->contactCount <= mesh->contactMax);
    MEASSERT(!isTooFar(q, separation));
    mcd_copy(c->position, position);
    mcd_copy(c->normal, normal);
    c->separation = separation;
    c->radius = mcd_surfaceRadius(&q->shape, outward, position);
    c->isOnFace = mcd_meshAreParallel(normal, t->normal);
    c->feature = mcd_meshHash(feature, quantizedNormal(normal, c->isOnFace));
    c->element = t->element;
    c->isCut = isCut;
    c->ofCap = 0;
    mcd_set(c->edge, 0, 0, 0);
    c->isVertex = !isCut && (!mcd_shapeHasRim(&q->shape) || isOnAxis(&q->shape, c));
}

MeBool mcd_meshAddPoints(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], const McdPolygon *p,
                         MeBool onlyDeeper, double *min) {
    MeBool isAnyAdded = MEFALSE;
    for (int i = 0; i < p->count; i++) {
        double at[3];
        const double separation = mcd_heightOver(p->point[i], t->corner[0], normal) - q->shape.rounding;
        if (separation > q->margin || (onlyDeeper && separation >= *min - MCD_MESH_OVERLAP * q->shape.extent))
            continue;
        mcd_mad(at, p->point[i], -(q->shape.rounding + separation / 2), normal);
        mcd_meshAddContact(q, t, at, normal, separation, p->name[i], p->isCut[i]);
        *min = fmin(*min, separation);
        isAnyAdded = METRUE;
    }
    return isAnyAdded;
}

void mcd_meshAddCap(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3]) {
    const double extent = q->shape.extent;
    double back[3], in, out, min = INFINITY;
    McdCap cap;
    mcd_scale(back, normal, -1);
    if (!q->mayLand || !mcd_capToward(&q->shape, back, mcd_landingTilt(&q->forecast, normal, extent), &cap))
        return;
    for (int i = 0; i < cap.count; i++) {
        McdPolygon one; /* only its first point is set */
        const int first = q->mesh->contactCount;
        one.count = 0;
        appendPoint(&one, cap.point[i], mcd_meshHash((MeU32)cap.corner[i], 1), MEFALSE);
        if (mcd_meshClipSegment(t, cap.point[i], cap.point[i], MCD_MESH_OVERLAP * extent, &in, &out))
            mcd_meshAddPoints(q, t, normal, &one, MEFALSE, &min);
        for (int k = first; k < q->mesh->contactCount; k++)
            q->mesh->contact[k].ofCap = cap.corner[i] + 1;
    }
}

MeBool mcd_meshAddClipped(McdMeshQuery *q, const McdMeshTriangle *t, const double normal[3], double tolerance) {
    McdPolygon p, clipped;
    double back[3], min = INFINITY;
    mcd_scale(back, normal, -1);
    mcd_polygonFace(&q->shape, back, &p);
    clipToPrism(t, tolerance * q->shape.extent, &p, &clipped);
    MeBool isAnyAdded = mcd_meshAddPoints(q, t, normal, &clipped, MEFALSE, &min);
    mcd_polygonSupport(&q->shape, back, &p);
    clipToPrism(t, tolerance * q->shape.extent, &p, &clipped);
    isAnyAdded |= mcd_meshAddPoints(q, t, normal, &clipped, METRUE, &min);
    mcd_meshAddCap(q, t, normal);
    return isAnyAdded;
}
