/* Where a moving sphere or cylinder first touches the edges and corners of a triangle, in closed form.
 *
 * A shape that moves by b touches the line of an edge within the plane P through the edge along b. There its section is
 * a convex figure, of which the point farthest along d, the component of b at right angles to the edge, touches first.
 * If it does so beyond an end of the edge, the shape touches the edge first at that end: the corner, on its way by -b,
 * enters the shape. A shape touches a corner no earlier than the lines of its edges. */
#include "convex/mcd_cast_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_vector_i.h"

/* The edges and the motion, in coordinates of the solver's choice, and the first touch so far. */
typedef struct Border {
    double corner[3][3], by[3];
    double first;               /* fraction; later touches do not matter */
    double point[3], normal[3]; /* of the touch; normal: to the shape */
    MeBool isFound;
} Border;

static void keepTouch(Border *b, double fraction, const double point[3], const double outward[3]) {
    b->first = fraction;
    b->isFound = METRUE;
    mcd_copy(b->point, point);
    mcd_scale(b->normal, outward, -1);
}

/* How a shape touches the line of an edge first: nowhere before b->first; before the start, or beyond one of its ends;
 * within. */
typedef enum EdgeTouch {
    EDGE_NONE,
    EDGE_FROM, /* beyond the end from which the edge goes */
    EDGE_TO,
    EDGE_BOTH, /* the line is touched from the start */
    EDGE_WITHIN
} EdgeTouch;

/* The place of a touch at `share` of the edge. */
static EdgeTouch touchAt(double share) {
    return share < 0 ? EDGE_FROM : share > 1 ? EDGE_TO : EDGE_WITHIN;
}

typedef EdgeTouch (*EdgeFn)(const McdShape *s, Border *b, const double from[3], const double edge[3]);
typedef void (*CornerFn)(const McdShape *s, Border *b, const double corner[3]);

static void touchBorder(const McdShape *s, Border *b, EdgeFn touchEdge, CornerFn touchCorner) {
    int corners = 0; /* a bit for each that an edge's touch leaves open */
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        double edge[3];
        mcd_sub(edge, b->corner[next], b->corner[i]);
        const MeBool hasLength = mcd_dot(edge, edge) > 0; /* after rounding */
        const EdgeTouch touch = hasLength ? touchEdge(s, b, b->corner[i], edge) : EDGE_FROM;
        corners |= (touch == EDGE_FROM || touch == EDGE_BOTH) << i | (touch == EDGE_TO || touch == EDGE_BOTH) << next;
    }
    for (int i = 0; i < 3; i++)
        if (corners >> i & 1)
            touchCorner(s, b, b->corner[i]);
}

/* ---- spheres, in coordinates relative to their centre ------------------------------------------------------------ */

/* The fraction at which a point at `from`, moving by `by`, is at the distance r from the origin: the first root of
 * |from + t by| = r. Negative: it is nearer from the start; INFINITY: it never is so near. */
static double approach(const double from[3], const double by[3], double r) {
    const double closing = -mcd_dot(from, by), gap = mcd_dot(from, from) - r * r;
    if (gap <= 0)
        return -1;
    const double square = closing * closing - mcd_dot(by, by) * gap;
    return closing > 0 && square >= 0 ? gap / (closing + sqrt(square)) : INFINITY;
}

static EdgeTouch sphereTouchesEdge(const McdShape *s, Border *b, const double from[3], const double edge[3]) {
    const double square = mcd_dot(edge, edge), start = -mcd_dot(from, edge) / square,
                 rate = mcd_dot(b->by, edge) / square;
    double across[3], by[3], point[3], outward[3];
    mcd_mad(across, from, start, edge); /* from the centre to the line, which moves by -by */
    mcd_scale(by, edge, rate);
    mcd_sub(by, by, b->by);
    const double t = approach(across, by, s->rounding);
    if (!(t <= b->first))
        return EDGE_NONE;
    if (t < 0)
        return EDGE_BOTH;
    const EdgeTouch touch = touchAt(start + t * rate);
    if (touch != EDGE_WITHIN)
        return touch;
    mcd_mad(outward, across, t, by);
    mcd_scale(outward, outward, 1 / s->rounding);
    mcd_mad(point, from, start + t * rate, edge);
    keepTouch(b, t, point, outward);
    return touch;
}

static void sphereTouchesCorner(const McdShape *s, Border *b, const double corner[3]) {
    double by[3], outward[3];
    mcd_scale(by, b->by, -1);
    const double t = approach(corner, by, s->rounding);
    if (!(t >= 0 && t < b->first))
        return;
    mcd_mad(outward, corner, t, by);
    mcd_scale(outward, outward, 1 / s->rounding);
    keepTouch(b, t, corner, outward);
}

/* ---- cylinders, in their own frame ------------------------------------------------------------------------------- */

/* The point of a cylinder's section with the plane m x = k that is farthest along d, which lies in the plane. */
typedef struct Farthest {
    double along; /* d x of it */
    double point[3];
    int end; /* of which disc it is on the rim: -1, 1; 0: on the side */
} Farthest;

static void keepFarthest(Farthest *f, const double d[3], double x, double y, double z, int end) {
    const double point[3] = {x, y, z}, along = mcd_dot(d, point);
    if (!(along > f->along))
        return;
    f->along = along;
    f->end = end;
    mcd_copy(f->point, point);
}

/* Of the two points of a rim that are in the plane. */
static void tryRim(Farthest *f, const McdShape *s, const double m[3], double k, const double d[3], int end) {
    const double radius = s->size[0], z = end < 0 ? -s->low : s->size[2] - s->low;
    const double square = m[0] * m[0] + m[1] * m[1], height = (k - m[2] * z) / square;
    const double half = radius * radius / square - height * height;
    if (!(half >= 0))
        return;
    const double away = (m[0] * d[1] - m[1] * d[0] > 0 ? 1 : -1) * sqrt(half);
    keepFarthest(f, d, height * m[0] - away * m[1], height * m[1] + away * m[0], z, end);
}

/* The side is farthest where its normal is a combination of d and m. */
static MeBool trySide(Farthest *f, const McdShape *s, const double m[3], double k, const double d[3]) {
    const double x = d[0] * m[2] - d[2] * m[0], y = d[1] * m[2] - d[2] * m[1], across = sqrt(x * x + y * y);
    if (!(across > 0 && m[2] != 0))
        return MEFALSE;
    const double share = (m[2] > 0 ? s->size[0] : -s->size[0]) / across;
    const double z = (k - share * (m[0] * x + m[1] * y)) / m[2];
    if (!(z >= -s->low && z <= s->size[2] - s->low))
        return MEFALSE;
    keepFarthest(f, d, share * x, share * y, z, 0);
    return METRUE;
}

/* The outward normal at a point that touches an edge, at right angles to both: on a rim one of those between the
 * normals of side and disc. */
static void outwardAt(const McdShape *s, const Farthest *f, const double edge[3], const double d[3],
                      double outward[3]) {
    const double radial[3] = {f->point[0] / s->size[0], f->point[1] / s->size[0], 0};
    double side = f->end ? fabs(edge[2]) : 1, disc = f->end ? fabs(mcd_dot(radial, edge)) : 0;
    if (f->end && !(side * side + disc * disc > 1e-20 * mcd_dot(edge, edge))) {
        side = fmax(mcd_dot(radial, d), 0); /* at right angles to both: any of them is */
        disc = fmax(f->end * d[2], 0);
    }
    const double length = sqrt(side * side + disc * disc);
    mcd_set(outward, side * radial[0], side * radial[1], f->end * disc);
    mcd_scale(outward, outward, 1 / length);
}

static EdgeTouch cylinderTouchesEdge(const McdShape *s, Border *b, const double from[3], const double edge[3]) {
    const double square = mcd_dot(edge, edge), rate = mcd_dot(b->by, edge) / square;
    Farthest f = {.along = -INFINITY};
    double m[3], d[3], outward[3];
    mcd_cross(m, edge, b->by);
    mcd_mad(d, b->by, -rate, edge);
    const double speed = mcd_dot(d, d), k = mcd_dot(m, from);
    if (!(speed > 1e-20 * mcd_dot(b->by, b->by))) /* along the edge */
        return EDGE_BOTH;
    if (!trySide(&f, s, m, k, d)) {
        tryRim(&f, s, m, k, d, -1);
        tryRim(&f, s, m, k, d, 1);
    }
    const double t = (mcd_dot(d, from) - f.along) / speed;
    if (!(t <= b->first)) /* also of an empty section */
        return EDGE_NONE;
    if (t < 0)
        return EDGE_BOTH;
    double point[3], offset[3];
    mcd_mad(point, f.point, t, b->by);
    mcd_sub(offset, point, from);
    const EdgeTouch touch = touchAt(mcd_dot(offset, edge) / square);
    if (touch != EDGE_WITHIN)
        return touch;
    outwardAt(s, &f, edge, d, outward);
    keepTouch(b, t, point, outward);
    return touch;
}

/* The interval of fractions in which the corner, moving by -by, is within the cylinder: between the discs and within
 * the side. */
static void cylinderTouchesCorner(const McdShape *s, Border *b, const double corner[3]) {
    const double radius = s->size[0], vz = -b->by[2], low = -s->low - corner[2], high = s->size[2] - s->low - corner[2];
    double enter = -INFINITY, leave = INFINITY, outward[3] = {0, 0, vz > 0 ? -1 : 1};
    if (vz == 0 && (low > 0 || high < 0))
        return;
    if (vz != 0) {
        enter = fmin(low / vz, high / vz);
        leave = fmax(low / vz, high / vz);
    }
    const double a = b->by[0] * b->by[0] + b->by[1] * b->by[1], closing = corner[0] * b->by[0] + corner[1] * b->by[1];
    const double gap = corner[0] * corner[0] + corner[1] * corner[1] - radius * radius;
    const double discriminant = closing * closing - a * gap;
    if (!(discriminant >= 0) || (a == 0 && gap > 0))
        return;
    if (a > 0) {
        const double in = (closing - sqrt(discriminant)) / a, out = (closing + sqrt(discriminant)) / a;
        leave = fmin(leave, out);
        if (in > enter) {
            enter = in;
            mcd_set(outward, (corner[0] - in * b->by[0]) / radius, (corner[1] - in * b->by[1]) / radius, 0);
        }
    }
    if (enter >= 0 && enter < b->first && enter <= leave)
        keepTouch(b, enter, corner, outward);
}

/* ---- the query --------------------------------------------------------------------------------------------------- */

MeBool mcd_castServesBorder(const McdShape *s) {
    return s->kind->rank == MCD_RANK_SPHERE || (s->kind->rank == MCD_RANK_CYLINDER && mcd_shapeIsRigid(s));
}

static Border borderOf(const McdTriangleCast *c) {
    const McdShape *s = c->shape;
    const MeBool isSphere = s->kind->rank == MCD_RANK_SPHERE;
    Border b = {.first = c->last};
    for (int i = 0; i < 3; i++) {
        double offset[3];
        mcd_sub(offset, c->corner[i], s->place);
        if (isSphere)
            mcd_copy(b.corner[i], offset);
        else
            mcd_shapeToOwnAxes(s, offset, b.corner[i]);
    }
    if (isSphere)
        mcd_copy(b.by, c->by);
    else
        mcd_shapeToOwnAxes(s, c->by, b.by);
    return b;
}

double mcd_castToBorder(const McdTriangleCast *c, double point[3], double normal[3]) {
    const McdShape *s = c->shape;
    const MeBool isSphere = s->kind->rank == MCD_RANK_SPHERE;
    Border b = borderOf(c);
    MEASSERT(mcd_castServesBorder(s));
    touchBorder(s, &b, isSphere ? sphereTouchesEdge : cylinderTouchesEdge,
                isSphere ? sphereTouchesCorner : cylinderTouchesCorner);
    if (!b.isFound)
        return INFINITY;
    if (isSphere) {
        mcd_mad(point, s->place, 1, b.point);
        mcd_copy(normal, b.normal);
    } else {
        mcd_shapePoint(s, b.point[0], b.point[1], b.point[2], point);
        mcd_shapeDirection(s, b.normal[0], b.normal[1], b.normal[2], normal);
    }
    MEASSERT(b.first >= 0 && b.first <= c->last && mcd_isUnit(normal));
    return b.first;
}
