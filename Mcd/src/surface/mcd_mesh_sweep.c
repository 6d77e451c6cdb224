/* Contacts of a ball that moves over triangles. Contacts act throughout a step, in which a rolling ball passes from
 * one triangle to the next. The contacts at its start alone would keep it on the first triangle's plane beyond an
 * edge where the surface falls, and let it penetrate the next triangle where the surface rises: both by the
 * displacement times the edge's angle, of first order in the step. So:
 *
 *   - Where the surface falls away below a contact, its normal becomes that of the chord, from the ball's place to
 *     where it touches the surface after its displacement. Motion along the chord ends on the surface, and no work is
 *     done.
 *   - The first triangle whose plane the ball reaches, over that triangle, gets a contact ahead of time, with the
 *     current gap. The narrow phase does not find it, since the nearest feature is still the edge between both
 *     triangles, which has no admissible normal.
 *
 * The displacement is that of the current velocities, as for all speculative contacts (mcd_pairReach). Other shapes
 * touch at points with different displacements; they keep the contacts of their current place. */
#include "convex/mcd_kind_i.h"
#include "surface/mcd_mesh_stages_i.h"

static double heightOver(const McdMeshTriangle *t, const double point[3]) {
    return mcd_heightOver(point, t->corner[0], t->normal);
}

static void nearestOnSegment(const double point[3], const double from[3], const double to[3], double nearest[3]) {
    double along[3];
    mcd_sub(along, to, from);
    const double square = mcd_dot(along, along), height = mcd_heightOver(point, from, along);
    mcd_mad(nearest, from, square > 0 ? MeCLAMP(height / square, 0, 1) : 0, along);
}

static MeBool isOver(const McdMeshTriangle *t, const double point[3]) {
    for (int i = 0; i < 3; i++)
        if (mcd_heightOver(point, t->corner[i], t->inward[i]) < 0)
            return MEFALSE;
    return METRUE;
}

/* The point of the triangle nearest to a point. */
static void nearestOnTriangle(const McdMeshTriangle *t, const double point[3], double nearest[3]) {
    double min = INFINITY;
    mcd_copy(nearest, t->corner[0]);
    if (isOver(t, point)) {
        mcd_mad(nearest, point, -heightOver(t, point), t->normal);
        return;
    }
    for (int i = 0; i < 3; i++) {
        double at[3];
        nearestOnSegment(point, t->corner[i], t->corner[(i + 1) % 3], at);
        const double square = mcd_distanceSquared(at, point);
        if (square >= min)
            continue;
        min = square;
        mcd_copy(nearest, at);
    }
}

/* m: the distance of a point from the surface; `nearest` gets the nearest surface point. One-sided triangles seen
 * from behind do not count. */
static double distanceToSurface(const McdMeshQuery *q, const double point[3], double nearest[3]) {
    double min = INFINITY;
    mcd_copy(nearest, point);
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        double at[3];
        if (heightOver(t, point) < 0 && !(t->flags & kMcdTriangleTwoSided))
            continue;
        nearestOnTriangle(t, point, at);
        const double square = mcd_distanceSquared(at, point);
        if (square >= min)
            continue;
        min = square;
        mcd_copy(nearest, at);
    }
    return sqrt(min);
}

/* If the surface falls away below the contact: tilts the contact's normal to that of the chord, from the ball's
 * place to where it touches the surface after its displacement. */
static void followSurface(const McdMeshQuery *q, McdMeshContact *c) {
    double displacement[3], end[3], nearest[3], chord[3], tilted[3];
    mcd_mad(displacement, q->displacement, -mcd_dot(q->displacement, c->normal), c->normal);
    mcd_mad(end, q->shape.place, 1, displacement);
    const double distance = distanceToSurface(q, end, nearest);
    const double drop = distance - q->shape.rounding - c->separation;
    if (!isfinite(distance) || !(drop > 1e-9 * q->shape.extent)) /* less is rounding of two distances */
        return;
    mcd_sub(chord, nearest, end);
    mcd_mad(chord, displacement, drop / distance, chord);
    const double square = mcd_dot(chord, chord);
    mcd_mad(tilted, c->normal, square > 0 ? -mcd_dot(c->normal, chord) / square : 0, chord);
    const double length = mcd_length(tilted);
    if (!(length > MCD_MESH_RISES)) /* the chord is along the normal: the ball does not move on */
        return;
    mcd_scale(c->normal, tilted, 1 / length);
    mcd_mad(c->position, q->shape.place, -(q->shape.rounding + c->separation / 2), c->normal);
}

static MeBool hasContactAlong(const McdMesh *mesh, const double normal[3]) {
    for (int i = 0; i < mesh->contactCount; i++)
        if (mcd_meshAreParallel(mesh->contact[i].normal, normal))
            return METRUE;
    return MEFALSE;
}

/* The fraction of the displacement after which the ball, which is above the triangle's plane, touches the triangle;
 * infinite if it does not. *gap gets the current gap. */
static double touchOnSweep(const McdMeshQuery *q, const McdMeshTriangle *t, double *gap) {
    const double fall = -mcd_dot(q->displacement, t->normal);
    double end[3], in, out;
    *gap = heightOver(t, q->shape.place) - q->shape.rounding;
    if (!(*gap >= 0 && *gap < fall))
        return INFINITY;
    mcd_mad(end, q->shape.place, 1, q->displacement);
    return mcd_meshClipSegment(t, q->shape.place, end, MCD_MESH_OVERLAP * q->shape.extent, &in, &out) &&
                   in <= *gap / fall && *gap / fall <= out
               ? *gap / fall
               : INFINITY;
}

/* Adds a contact with the first triangle that the ball reaches, unless there is a contact along its normal. */
static void addContactAhead(McdMeshQuery *q) {
    const McdMeshTriangle *first = NULL;
    double soonest = INFINITY, gap = 0, at[3];
    for (int i = 0; i < q->mesh->count; i++) {
        double ownGap;
        const double share = touchOnSweep(q, &q->mesh->triangle[i], &ownGap);
        if (!(share < soonest) || hasContactAlong(q->mesh, q->mesh->triangle[i].normal))
            continue;
        soonest = share;
        gap = ownGap;
        first = &q->mesh->triangle[i];
    }
    if (!first || first >= q->mesh->triangle + q->mesh->own) /* another model's pair has that contact */
        return;
    MEASSERT(soonest >= 0 && soonest <= 1 && gap >= 0);
    mcd_mad(at, q->shape.place, -(q->shape.rounding + gap / 2), first->normal);
    mcd_meshAddContact(q, first, at, first->normal, gap, 0, MEFALSE);
}

void mcd_meshSweep(McdMeshQuery *q) {
    const int found = q->mesh->contactCount; /* without the contact ahead */
    if (q->shape.kind->rank != MCD_RANK_SPHERE || mcd_dot(q->displacement, q->displacement) == 0 || found == 0)
        return;
    addContactAhead(q);
    for (int i = 0; i < found; i++)
        if (mcd_dot(q->mesh->contact[i].edge, q->mesh->contact[i].edge) == 0)
            followSurface(q, &q->mesh->contact[i]);
}
