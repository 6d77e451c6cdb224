/* Contacts of a ball, cylinder or sphyl that moves over triangles. Contacts act throughout a step, in which what rolls
 * passes from one triangle to the next. The contacts at its start alone would keep it on the first triangle's plane
 * beyond an edge where the surface falls, and let it penetrate the next triangle where the surface rises: both by the
 * displacement times the edge's angle, of first order in the step. So:
 *
 *   - Where the surface falls away below a contact of a round side, its normal becomes that of the chord, from the
 *     side's centre to where it touches the surface after its displacement. Motion along the chord ends on the surface,
 *     and no work is done.
 *   - The triangles that the shape comes down to, one after the other, get contacts ahead of time, with the current
 *     gaps; its path goes on along each. The narrow phase does not find them, since the nearest feature is
 *     still the edge between both triangles, which has no admissible normal. A shape that overlaps the surface by d
 *     overlaps the next triangle's plane, too, before it is over that triangle: it moves as over a surface that is
 *     lower by d, and loses a share of d at each triangle. Otherwise it would enter each facet of a bowl by the
 *     displacement times the angle, and be lifted out of it against gravity.
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

/* Finds by how much the surface falls away below a round contact, and where to: from the round side's centre after its
 * displacement to the nearest point of the surface. */
static void findDrop(const McdMeshQuery *q, McdMeshContact *c) {
    double centre[3], end[3], nearest[3];
    mcd_mad(centre, c->position, c->radius + c->separation / 2, c->normal);
    mcd_mad(end, centre, 1, c->ahead);
    const double distance = distanceToSurface(q, end, nearest);
    mcd_sub(c->down, nearest, end);
    mcd_scale(c->down, c->down, distance > 0 ? 1 / distance : 0);
    c->drop = isfinite(distance) ? distance - c->radius - c->separation : 0;
}

/* The displacement of a contact's round side along the surface; of a line across it, since it touches with other points
 * of its own where it moves along itself. */
static void findAhead(const McdMeshQuery *q, McdMeshContact *c) {
    double across[3];
    mcd_cross(across, c->normal, q->shape.axis[2]);
    const double square = mcd_dot(across, across);
    if (q->shape.kind->rank == MCD_RANK_SPHERE)
        mcd_mad(c->ahead, q->displacement, -mcd_dot(q->displacement, c->normal), c->normal);
    else
        mcd_scale(c->ahead, across, square > 0 ? mcd_dot(q->displacement, across) / square : 0);
}

/* Whether the surface falls evenly below a line of contact, beyond an edge along it: then all of the line falls. Beyond
 * an edge that crosses it the line stays up with its other end, or goes on along the edge. */
static MeBool fallsEvenly(const McdMesh *mesh, int found) {
    static const double even = .1;
    double low = INFINITY, high = 0;
    for (int i = 0; i < found; i++) {
        const McdMeshContact *c = &mesh->contact[i];
        if (!mcd_meshAreParallel(c->normal, mesh->contact[0].normal))
            return MEFALSE;
        low = fmin(low, c->drop);
        high = fmax(high, c->drop);
    }
    return found > 1 && high - low <= even * high;
}

/* If the surface falls away below a round contact: tilts the contact's normal to that of the chord, from the round
 * side's centre to where it touches the surface after its displacement. */
static void followSurface(double slack, McdMeshContact *c) {
    double centre[3], chord[3], tilted[3];
    if (!(c->drop > slack) || c->drop * c->drop >= mcd_dot(c->ahead, c->ahead)) /* or it falls, rather than moves on */
        return;
    mcd_mad(centre, c->position, c->radius + c->separation / 2, c->normal);
    mcd_mad(chord, c->ahead, c->drop, c->down);
    const double square = mcd_dot(chord, chord);
    mcd_mad(tilted, c->normal, square > 0 ? -mcd_dot(c->normal, chord) / square : 0, chord);
    const double length = mcd_length(tilted);
    if (!(length > MCD_MESH_RISES)) /* the chord is along the normal: the shape does not move on */
        return;
    mcd_scale(c->normal, tilted, 1 / length);
    mcd_mad(c->position, centre, -(c->radius + c->separation / 2), c->normal);
}

/* Lets the found contacts of round sides follow the surface where it falls away, but for those that roll over an edge
 * throughout the step. */
static void followFalls(McdMeshQuery *q, int found) {
    /* relative to the extent: the errors of a drop, of closed forms, and of searched contacts */
    static const double rounding = 1e-9, inexact = 1e-6;
    const MeBool isBall = q->shape.kind->rank == MCD_RANK_SPHERE;
    for (int i = 0; i < found; i++) {
        McdMeshContact *c = &q->mesh->contact[i];
        c->drop = 0;
        if (!(c->radius > 0) || mcd_dot(c->edge, c->edge) > 0)
            continue;
        findAhead(q, c);
        findDrop(q, c);
    }
    if (!isBall && !fallsEvenly(q->mesh, found))
        return;
    for (int i = 0; i < found; i++)
        followSurface((isBall ? rounding : inexact) * q->shape.extent, &q->mesh->contact[i]);
}

static MeBool hasContactAlong(const McdMesh *mesh, const double normal[3]) {
    for (int i = 0; i < mesh->contactCount; i++)
        if (mcd_meshAreParallel(mesh->contact[i].normal, normal))
            return METRUE;
    return MEFALSE;
}

/* The share of an overlap that the shape loses where it comes to the next triangle: the gamma of dynamics' defaults, as
 * the contacts ahead take the place of those that would correct the overlap. With 0 a ball of .1 m in a bowl of 128
 * facets, which take .234 of its energy, loses .199 at 60 Hz, .531 at 30 Hz. */
#define MCD_MESH_SHED .2

/* A path over the surface: straight until the shape meets a triangle, then along that triangle. */
typedef struct Path {
    double start[3]; /* the shape's place before it */
    double ahead[3]; /* m: the displacement that is left, from q->shape.place */
    double overlap;  /* m: of the deepest contact at the start. The shape moves as over a surface that is lower by that:
                        it overlaps the triangles that it comes to before it is over them */
} Path;

/* m: the depth of the deepest contact. */
static double deepestOverlap(const McdMesh *mesh) {
    double depth = 0;
    for (int i = 0; i < mesh->contactCount; i++)
        depth = fmax(depth, -mesh->contact[i].separation);
    return depth;
}

/* The fraction of the path ahead after which the shape, which is above the triangle's plane, meets the triangle;
 * infinite if it does not. */
static double touchOf(const McdMeshQuery *q, const Path *path, const McdMeshTriangle *t) {
    const double fall = -mcd_dot(path->ahead, t->normal), tolerance = MCD_MESH_OVERLAP * q->shape.extent;
    double back[3], from[3], to[3], in, out;
    if (t->isFlat || !(fall > tolerance))
        return INFINITY;
    mcd_scale(back, t->normal, -1);
    mcd_coreSupport(&q->shape, back, from);
    const double gap = heightOver(t, from) - q->shape.rounding + path->overlap;
    if (!(gap >= -tolerance && gap < fall))
        return INFINITY;
    const double share = fmax(gap, 0) / fall;
    mcd_mad(to, from, 1, path->ahead);
    return mcd_meshClipSegment(t, from, to, tolerance, &in, &out) && in <= share && share <= out ? share : INFINITY;
}

/* The first triangle that the shape meets, on a body with joints one without a contact; null: none. */
static const McdMeshTriangle *firstTouched(const McdMeshQuery *q, const Path *path, double *soonest) {
    const McdMeshTriangle *first = NULL;
    *soonest = INFINITY;
    for (int i = 0; i < q->mesh->count; i++) {
        const McdMeshTriangle *t = &q->mesh->triangle[i];
        const double share = touchOf(q, path, t);
        if (!(share < *soonest) || (q->pair->isJointed && hasContactAlong(q->mesh, t->normal)))
            continue;
        *soonest = share;
        first = t;
    }
    return first;
}

/* Goes on to where the shape meets a triangle, and along its plane from there on. */
static void advance(McdMeshQuery *q, Path *path, double share, const double normal[3]) {
    MEASSERT(share >= 0 && share <= 1);
    mcd_mad(q->shape.place, q->shape.place, share, path->ahead);
    mcd_scale(path->ahead, path->ahead, 1 - share);
    mcd_mad(path->ahead, path->ahead, -mcd_dot(path->ahead, normal), normal);
}

/* Whether the triangle lies in the other's plane. */
static MeBool isInPlane(const McdMeshQuery *q, const McdMeshTriangle *t, const McdMeshTriangle *other) {
    return !t->isFlat && mcd_meshAreParallel(t->normal, other->normal) &&
           fabs(heightOver(other, t->corner[0])) <= MCD_MESH_RISES * q->shape.extent;
}

/* Moves a contact that was found at the shape's present place to the start of the path, with the gap there. */
static void moveToStart(const McdMeshQuery *q, const Path *path, McdMeshContact *c) {
    double moved[3];
    mcd_sub(moved, q->shape.place, path->start);
    const double gap = fmax(c->separation + (1 - MCD_MESH_SHED) * path->overlap - mcd_dot(moved, c->normal), 0);
    mcd_mad(c->position, c->position, -1, moved);
    mcd_mad(c->position, c->position, (c->separation - gap) / 2, c->normal);
    c->separation = gap;
}

/* Adds the contacts with the plane of a triangle that the shape meets. Those with triangles of other models are other
 * pairs'. */
static void addContactsAhead(McdMeshQuery *q, const Path *path, const McdMeshTriangle *touched) {
    const int first = q->mesh->contactCount;
    for (int i = 0; i < q->mesh->own; i++)
        if (isInPlane(q, &q->mesh->triangle[i], touched))
            mcd_meshAddClipped(q, &q->mesh->triangle[i], touched->normal, MCD_MESH_OVERLAP);
    for (int i = first; i < q->mesh->contactCount; i++)
        moveToStart(q, path, &q->mesh->contact[i]);
}

/* Adds contacts with the triangles that the shape meets on its path: with the first one alone, and not in overlap, if
 * joints constrain the body, whose contacts ahead bear weight from the start of the step. */
static void followPath(McdMeshQuery *q) {
    enum { MAX_TRIANGLES = 8 };
    const int max = q->pair->isJointed ? 1 : MAX_TRIANGLES;
    Path path = {.overlap = q->pair->isJointed ? 0 : deepestOverlap(q->mesh)};
    mcd_copy(path.start, q->shape.place);
    mcd_copy(path.ahead, q->displacement);
    for (int i = 0; i < max; i++) {
        double share;
        const McdMeshTriangle *t = firstTouched(q, &path, &share);
        if (!t)
            break;
        advance(q, &path, share, t->normal);
        if (!hasContactAlong(q->mesh, t->normal))
            addContactsAhead(q, &path, t);
    }
    mcd_copy(q->shape.place, path.start);
}

/* Whether the shape rolls: its displacement is that of all of its points that may touch. */
static MeBool isRound(const McdShape *shape) {
    const McdRank rank = shape->kind->rank;
    return rank == MCD_RANK_SPHERE || rank == MCD_RANK_SPHYL || rank == MCD_RANK_CYLINDER;
}

void mcd_meshSweep(McdMeshQuery *q) {
    const int found = q->mesh->contactCount; /* without the contacts ahead */
    if (!isRound(&q->shape) || mcd_dot(q->displacement, q->displacement) == 0 || found == 0)
        return;
    followPath(q);
    followFalls(q, found);
}
