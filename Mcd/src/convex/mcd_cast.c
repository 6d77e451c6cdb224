/* How far a convex shape may move before it touches a triangle, by the shape's support function alone. Most triangles
 * that are near a shape's path are ruled out by few support points, where an exact distance takes many. */
#include "convex/mcd_cast_i.h"
#include "convex/mcd_vector_i.h"

/* The shape's support point in a direction of unit length, at a fraction. */
static void supportAt(const McdTriangleCast *c, double fraction, const double direction[3], double point[3]) {
    mcd_support(c->shape, direction, point);
    mcd_mad(point, point, fraction, c->by);
}

double mcd_castToPlane(const McdTriangleCast *c, double point[3], double normal[3]) {
    double height = 0;
    for (int below = 0; below < 2 && !(height > 0); below++) {
        double down[3];
        mcd_scale(normal, c->normal, below ? -1 : 1);
        mcd_scale(down, normal, -1);
        supportAt(c, 0, down, point);
        height = mcd_heightOver(point, c->corner[0], normal);
    }
    const double closing = -mcd_dot(normal, c->by);
    if (!(height > 0))
        return 0;
    if (!(closing > 0))
        return INFINITY;
    mcd_mad(point, point, height / closing, c->by);
    return height / closing;
}

MeBool mcd_castIsOver(const McdTriangleCast *c, const double point[3]) {
    for (int i = 0; i < 3; i++) {
        double edge[3], across[3];
        mcd_sub(edge, c->corner[(i + 1) % 3], c->corner[i]);
        mcd_cross(across, c->normal, edge); /* inward or outward: a program gives the normal */
        const double inside = mcd_heightOver(c->corner[(i + 2) % 3], c->corner[i], across);
        const double height = mcd_heightOver(point, c->corner[i], across);
        if (!(inside > 0 ? height >= 0 : height <= 0))
            return MEFALSE;
    }
    return METRUE;
}

/* The point of an edge nearest to a point. */
static void nearestOnEdge(const double from[3], const double to[3], const double point[3], double nearest[3]) {
    double along[3];
    mcd_sub(along, to, from);
    const double square = mcd_dot(along, along), height = mcd_heightOver(point, from, along);
    mcd_mad(nearest, from, square > 0 ? MeCLAMP(height / square, 0, 1) : 0, along);
}

/* The point of the triangle nearest to a point. */
static void nearestOnTriangle(const McdTriangleCast *c, const double point[3], double nearest[3]) {
    double min = INFINITY;
    mcd_mad(nearest, point, -mcd_heightOver(point, c->corner[0], c->normal), c->normal);
    if (mcd_castIsOver(c, point))
        return;
    for (int i = 0; i < 3; i++) {
        double at[3];
        nearestOnEdge(c->corner[i], c->corner[(i + 1) % 3], point, at);
        const double square = mcd_distanceSquared(at, point);
        if (!(square < min))
            continue;
        min = square;
        mcd_copy(nearest, at);
    }
}

/* The plane through the triangle's point nearest to a point of the shape, orthogonal to the way between both, has the
 * triangle behind it. Where it has the shape before it, the shape must first reach it. The next point is on the line
 * between the last two support points: where the shape is flat, these are at its ends in turn. */
double mcd_castBound(const McdTriangleCast *c, double fraction, const double point[3]) {
    enum { PLANES = 8 }; /* 4 leave a quarter more triangles to an exact distance, 16 rule out 4 % of them */
    const double closest = 1e-9 * c->shape->extent; /* m: the direction of a shorter way is rounding */
    double at[3], end[2][3], nearest[3];
    mcd_copy(at, point);
    mcd_copy(end[1], point);
    for (int i = 0; i < PLANES; i++) {
        double outward[3], back[3], *const now = end[i % 2], *const before = end[(i + 1) % 2];
        nearestOnTriangle(c, at, nearest);
        mcd_sub(outward, at, nearest);
        const double length = mcd_length(outward);
        if (!(length > closest))
            break;
        mcd_scale(outward, outward, 1 / length);
        mcd_scale(back, outward, -1);
        supportAt(c, fraction, back, now);
        const double height = mcd_heightOver(now, nearest, outward), closing = -mcd_dot(outward, c->by);
        if (height > 0) {
            if (!(closing > 0) || fraction + height / closing > c->last)
                return INFINITY;
            fraction += height / closing;
            mcd_mad(now, now, height / closing, c->by);
            mcd_mad(before, before, height / closing, c->by);
        }
        nearestOnTriangle(c, now, nearest);
        nearestOnEdge(before, now, nearest, at);
    }
    return fraction;
}
