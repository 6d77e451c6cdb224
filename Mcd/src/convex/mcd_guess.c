/* Candidates for the contact normal in closed form, and their verification: pairs for which these succeed need no
 * GJK and EPA.
 *
 * Shapes at rest mostly touch along the normal of a flat face. A cylinder's side or rim touches another cylinder, a
 * sphyl or a box along a normal that is orthogonal to two axes or edges, or that points from an axis to a corner,
 * from an axis or edge to the nearest point of a rim, or from rim to rim. The guess is the best of these as
 * separating axis. For separated shapes it is right if their faces along it are as near as its separation says
 * (mcd_facesManifold). For overlapping shapes it is right if no direction has a smaller depth: if their Minkowski
 * difference M contains the ball around the origin whose radius is the guessed depth.
 */
#include "convex/mcd_sampled_i.h"

typedef struct Pair {
    const McdShape *a, *b;
    double bias; /* m: how much better another normal must be than a face's */
} Pair;

/* ---- separating axes --------------------------------------------------------------------------------------------- */

/* Keeps the normal n (unit, from b to a) if its separation exceeds the best so far by more than the bias. */
static void tryNormal(const Pair *p, const double n[3], double bias, McdProximity *g) {
    const double s = mcd_separationAlong(p->a, p->b, n);
    if (s <= g->separation + bias)
        return;
    g->separation = s;
    mcd_copy(g->normal, n);
}

/* Tries an axis in the sense from b's place to a's. */
static void tryAxis(const Pair *p, const double axis[3], double bias, McdProximity *g) {
    double n[3], between[3];
    mcd_sub(between, p->a->place, p->b->place);
    mcd_scale(n, axis, mcd_dot(axis, between) < 0 ? -1 : 1);
    tryNormal(p, n, bias, g);
}

static MeBool isFlatAlong(const McdShape *s, int axis) {
    return ((s->kind->isSampled ? s->sampled->flatFaces >> 2 * axis & 3 : s->kind->flatAxes >> axis & 1)) != 0;
}

static void tryFlatFaces(const Pair *p, const McdShape *s, McdProximity *g) {
    for (int i = 0; i < 3; i++)
        if (isFlatAlong(s, i))
            tryAxis(p, s->axis[i], 0, g);
}

static void tryCrossProduct(const Pair *p, const double x[3], const double y[3], McdProximity *g) {
    double n[3];
    mcd_cross(n, x, y);
    const double sine = mcd_length(n);
    if (!(sine > mcd_parallelSine * mcd_length(x) * mcd_length(y)))
        return;
    mcd_scale(n, n, 1 / sine);
    tryAxis(p, n, p->bias, g);
}

/* The point nearest to y of an ellipse about the origin with the half axes e[0] >= e[1] >= 0 along the coordinates:
 * e^2 y / (t + e^2) with the largest root t of
 *
 *     F(t) = sum (e_i y_i / (t + e_i^2))^2 - 1
 *
 * (Eberly: Distance from a point to an ellipse, 2013). F is decreasing and convex, so that Newton's method converges
 * from below. Returns t, negative if y is inside; NaN: the nearest point is not found. */
static double nearestOfEllipse(const double e[2], const double y[2], double nearest[2]) {
    enum { STEPS = 24 }; /* mostly five suffice; near an axis the root is a double one */
    double t = -INFINITY;
    for (int i = 0; i < 2; i++)
        t = MeMAX(t, e[i] * (fabs(y[i]) - e[i]));
    for (int step = 0; step < STEPS; step++) {
        double f = -1, rate = 0;
        for (int i = 0; i < 2; i++) {
            const double below = t + e[i] * e[i], term = below > 0 ? e[i] * y[i] / below : 0;
            f += term * term;
            rate += below > 0 ? 2 * term * term / below : 0;
            nearest[i] = e[i] * term;
        }
        if (!(f > 1e-15))
            return f > -1e-9 ? t : NAN; /* else y is near an axis: two points are equally near */
        t += f / rate;
    }
    return NAN;
}

/* The half axes of the ellipse u cos t + v sin t, and their unit directions. */
static void findHalfAxes(const double u[2], const double v[2], double e[2], double direction[2][2]) {
    const double difference = u[0] * u[0] + u[1] * u[1] - v[0] * v[0] - v[1] * v[1];
    const double twice = 2 * (u[0] * v[0] + u[1] * v[1]), length = sqrt(difference * difference + twice * twice);
    const double cosine = length > 0 ? sqrt(fmax(.5 + difference / length / 2, 0)) : 1;
    const double sine = copysign(sqrt(fmax(1 - cosine * cosine, 0)), twice);
    const double x = u[0] * cosine + v[0] * sine, y = u[1] * cosine + v[1] * sine;
    e[0] = sqrt(x * x + y * y);
    direction[0][0] = e[0] > 0 ? x / e[0] : 1;
    direction[0][1] = e[0] > 0 ? y / e[0] : 0;
    direction[1][0] = -direction[0][1];
    direction[1][1] = direction[0][0];
    e[1] = fabs(direction[1][0] * (v[0] * cosine - u[0] * sine) + direction[1][1] * (v[1] * cosine - u[1] * sine));
}

/* Tries the normal from a line to the nearest point of a disc's rim. The line is an edge, or the axis of a round
 * side: given by a point on it and two orthogonal directions across it. Projected along the line the rim is an
 * ellipse. */
static void tryNormalToRim(const Pair *p, const McdShape *disc, double height, const double on[3],
                           const double across1[3], const double across2[3], McdProximity *g) {
    const double *across[2] = {across1, across2};
    double centre[3], n[3], u[2], v[2], e[2], direction[2][2], c[2], y[2], nearest[2];
    mcd_mad(centre, disc->place, height, disc->axis[2]);
    mcd_sub(centre, centre, on);
    for (int i = 0; i < 2; i++) {
        c[i] = mcd_dot(across[i], centre);
        u[i] = mcd_dot(across[i], disc->axis[0]) * disc->size[0];
        v[i] = mcd_dot(across[i], disc->axis[1]) * disc->size[0];
    }
    findHalfAxes(u, v, e, direction);
    for (int i = 0; i < 2; i++)
        y[i] = -(c[0] * direction[i][0] + c[1] * direction[i][1]);
    const double t = nearestOfEllipse(e, y, nearest);
    for (int i = 0; i < 2; i++)
        c[i] += nearest[0] * direction[0][i] + nearest[1] * direction[1][i];
    mcd_scale(n, across1, c[0]);
    mcd_mad(n, n, c[1], across2);
    const double distance = mcd_length(n);
    if (!(fabs(t) > 0) || !(distance > 0))
        return;
    mcd_scale(n, n, ((disc == p->a) == (t > 0) ? 1 : -1) / distance);
    tryNormal(p, n, p->bias, g);
}

/* A point on a rim, with its tangent (its derivative by the angle) and its offset from the centre. */
typedef struct RimPoint {
    const McdShape *disc;
    double centre[3], place[3], along[3], out[3];
} RimPoint;

/* Moves the point to the direction (x, y) of the disc's own axes. */
static void moveToDirection(RimPoint *r, double x, double y) {
    const double k = r->disc->size[0] / sqrt(x * x + y * y);
    mcd_shapeDirection(r->disc, x * k, y * k, 0, r->out);
    mcd_shapeDirection(r->disc, -y * k, x * k, 0, r->along);
    mcd_mad(r->place, r->centre, 1, r->out);
}

/* Moves the point to the one nearest to another point; false if all are equally near. */
static MeBool moveNearestTo(RimPoint *r, const double point[3]) {
    double offset[3];
    mcd_sub(offset, point, r->centre);
    const double x = mcd_dot(offset, r->disc->axis[0]), y = mcd_dot(offset, r->disc->axis[1]);
    if (!(x * x + y * y > 0))
        return MEFALSE;
    moveToDirection(r, x, y);
    return METRUE;
}

/* Advances the point by an angle, given by its tangent. */
static void advanceByAngle(RimPoint *r, double tangent) {
    double to[3];
    mcd_mad(to, r->out, tangent, r->along);
    moveToDirection(r, mcd_dot(to, r->disc->axis[0]), mcd_dot(to, r->disc->axis[1]));
}

/* Tries the normal between two rims at their nearest points, or deepest ones if they overlap: the line between them
 * is orthogonal to both tangents. Newton's method finds the points, starting where each rim is nearest to the other. */
static void tryNormalOfRims(const Pair *p, double heightA, double heightB, McdProximity *g) {
    enum { STEPS = 8 }; /* mostly four or five suffice */
    RimPoint a = {.disc = p->a}, b = {.disc = p->b};
    const double max = .5; /* tangent of the largest turn in a step; more means a bad start */
    const double size = a.disc->size[0] + b.disc->size[0];
    mcd_mad(a.centre, a.disc->place, heightA, a.disc->axis[2]);
    mcd_mad(b.centre, b.disc->place, heightB, b.disc->axis[2]);
    if (!moveNearestTo(&a, b.centre) || !moveNearestTo(&b, a.place))
        return;
    for (int step = 0; step < STEPS; step++) {
        double d[3];
        mcd_sub(d, a.place, b.place);
        const double f = mcd_dot(d, a.along), h = -mcd_dot(d, b.along), mixed = -mcd_dot(a.along, b.along);
        if (fabs(f) + fabs(h) <= 1e-14 * size * size) {
            tryCrossProduct(p, a.along, b.along, g);
            return;
        }
        const double ofA = mcd_dot(a.along, a.along) - mcd_dot(d, a.out);
        const double ofB = mcd_dot(b.along, b.along) + mcd_dot(d, b.out), all = ofA * ofB - mixed * mixed;
        if (!(fabs(all) > 1e-12 * size * size * size * size))
            return;
        advanceByAngle(&a, MeCLAMP((mixed * h - ofB * f) / all, -max, max));
        advanceByAngle(&b, MeCLAMP((mixed * f - ofA * h) / all, -max, max));
    }
}

static MeBool isCylinder(const McdShape *s) {
    return s->kind->rank == MCD_RANK_CYLINDER;
}

static MeBool isSphylOrCylinder(const McdShape *s) {
    return s->kind->rank == MCD_RANK_SPHYL || isCylinder(s);
}

static MeBool isBox(const McdShape *s) {
    return s->kind->rank == MCD_RANK_BOX;
}

static MeBool isAtRim(const McdShape *s, double height) {
    return isCylinder(s) && fabs(height) >= s->low;
}

/* Tries the normals between two round sides: the cross product of the axes, the direction between the nearest points
 * of the axes, and, where one of these is an end, the normals from the rim there. */
static void tryRoundSides(const Pair *p, McdProximity *g) {
    const McdShape *a = p->a, *b = p->b;
    double s, t, n[3], between[3];
    mcd_nearestOfSegments(a, b, &s, &t);
    tryCrossProduct(p, a->axis[2], b->axis[2], g);
    mcd_sub(between, a->place, b->place);
    mcd_mad(n, between, s, a->axis[2]);
    mcd_mad(n, n, -t, b->axis[2]);
    const double distance = mcd_length(n);
    if (distance > 0) {
        mcd_scale(n, n, 1 / distance);
        tryNormal(p, n, p->bias, g);
    }
    if (isAtRim(a, s))
        tryNormalToRim(p, a, s, b->place, b->axis[0], b->axis[1], g);
    if (isAtRim(b, t))
        tryNormalToRim(p, b, t, a->place, a->axis[0], a->axis[1], g);
    if (isAtRim(a, s) && isAtRim(b, t))
        tryNormalOfRims(p, s, t, g);
}

/* The box's corner in the direction of the point at `height` on the cylinder's axis. */
static void boxCornerToward(const McdShape *box, const McdShape *cylinder, double height, double corner[3]) {
    double at[3], own[3];
    mcd_mad(at, cylinder->place, height, cylinder->axis[2]);
    mcd_sub(at, at, box->place);
    mcd_shapeToOwnAxes(box, at, own);
    mcd_shapePoint(box, copysign(box->size[0], own[0]), copysign(box->size[1], own[1]), copysign(box->size[2], own[2]),
                   corner);
}

/* Tries the normals of a box and a cylinder: cross product of an edge and the axis; from the axis to a corner; from
 * an edge to a rim. */
static void tryBoxAndCylinder(const Pair *p, const McdShape *box, const McdShape *cylinder, McdProximity *g) {
    const double *axis = cylinder->axis[2];
    double offset[3], corner[3], n[3];
    for (int i = 0; i < 3; i++)
        tryCrossProduct(p, box->axis[i], axis, g);
    const double height = MeCLAMP(mcd_heightOver(box->place, cylinder->place, axis), -cylinder->low, cylinder->low);
    const double end = copysign(cylinder->low, height);
    boxCornerToward(box, cylinder, height, corner);
    mcd_sub(offset, corner, cylinder->place);
    mcd_mad(n, offset, -mcd_dot(offset, axis), axis);
    const double distance = mcd_length(n);
    if (distance > 0) {
        mcd_scale(n, n, (box == p->a ? 1 : -1) / distance);
        tryNormal(p, n, p->bias, g);
    }
    for (int i = 0; i < 3; i++)
        tryNormalToRim(p, cylinder, end, corner, box->axis[(i + 1) % 3], box->axis[(i + 2) % 3], g);
}

void mcd_guessFaces(const McdShape *a, const McdShape *b, McdProximity *g) {
    const Pair p = {a, b, 0};
    g->isGuess = 1;
    g->separation = -INFINITY;
    tryFlatFaces(&p, a, g);
    tryFlatFaces(&p, b, g);
}

MeBool mcd_guessSides(const McdShape *a, const McdShape *b, McdProximity *g) {
    const Pair p = {a, b, mcd_faceBias * mcd_pairSize(a, b)};
    if ((isCylinder(a) && isSphylOrCylinder(b)) || (isSphylOrCylinder(a) && isCylinder(b)))
        tryRoundSides(&p, g);
    else if (isBox(a) && isCylinder(b))
        tryBoxAndCylinder(&p, a, b, g);
    else if (isCylinder(a) && isBox(b))
        tryBoxAndCylinder(&p, b, a, g);
    else
        return MEFALSE;
    return METRUE;
}

/* ---- verification ------------------------------------------------------------------------------------------------ */

/* The support point of M in a direction. */
static void minkowskiSupport(const McdShape *a, const McdShape *b, const double direction[3], double w[3]) {
    double back[3];
    double x[3], y[3];
    mcd_scale(back, direction, -1);
    mcd_coreSupport(a, direction, x);
    mcd_coreSupport(b, back, y);
    mcd_sub(w, x, y);
}

enum { MAX_CORNERS = 8 };

/* Support points of M in four or eight directions around d, counter-clockwise, each tilted from d by the tangent
 * `aside`, the first one towards u, which is orthogonal to d. */
static void supportsAround(const McdShape *a, const McdShape *b, const double d[3], const double u[3], double aside,
                           int count, double corner[][3]) {
    static const double diagonal = .7071067811865476;
    static const double turn[MAX_CORNERS][2] = {{1, 0},  {diagonal, diagonal},   {0, 1},  {-diagonal, diagonal},
                                                {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}};
    double w[3];
    mcd_cross(w, d, u);
    for (int i = 0; i < count; i++) {
        const double *to = turn[i * (MAX_CORNERS / count)];
        double e[3];
        mcd_mad(e, d, aside * to[0], u);
        mcd_mad(e, e, aside * to[1], w);
        minkowskiSupport(a, b, e, corner[i]);
    }
}

/* The distance of the origin, positive inside, from the plane through an edge, counter-clockwise seen from outside,
 * and a point below the edge; INFINITY for an edge without length. */
static double distanceInside(const double from[3], const double to[3], const double below[3]) {
    double along[3], up[3], n[3];
    mcd_sub(along, to, from);
    mcd_sub(up, below, from);
    mcd_cross(n, up, along);
    const double squared = mcd_dot(n, n);
    return squared > 0 ? mcd_dot(n, from) / sqrt(squared) : INFINITY;
}

/* The ball that M must contain: its radius is the depth; tolerance: by how much another direction may have a smaller
 * depth. */
typedef struct Ball {
    double down[3], depth, tolerance;
} Ball;

/* Makes the ball of a guess; false if the depth is too small to be verified, or not finite. */
static MeBool makeBall(const McdShape *a, const McdShape *b, const McdProximity *p, Ball *ball) {
    mcd_scale(ball->down, p->normal, -1);
    ball->depth = -p->separation;
    ball->tolerance = mcd_guessTolerance(a, b);
    return ball->depth > 2 * ball->tolerance && ball->depth < INFINITY;
}

/* Whether the ball is inside the pyramid whose base is M's face in the direction of the guess and whose tip is the
 * opposite support point. Both are parts of M. */
MeBool mcd_isMinDepth(const McdShape *a, const McdShape *b, const McdProximity *p) {
    enum { CORNERS = 4 };
    /* The tilt of the four directions, which selects corners of the face; these are lower by at most this fraction
     * of the size. */
    static const double flat = 1e-8;
    double u[3], w[3], tip[3], base[CORNERS][3], min = INFINITY; /* stays INFINITY if the base is a point */
    Ball ball;
    if (!makeBall(a, b, p, &ball))
        return MEFALSE;
    const double radius = ball.depth - ball.tolerance;
    mcd_basis(ball.down, u, w);
    mcd_scale(u, u, .91); /* between the axes, along which two corners of a box's face are equally far */
    mcd_mad(u, u, .41, w);
    supportsAround(a, b, ball.down, u, flat, CORNERS, base);
    minkowskiSupport(a, b, p->normal, tip);
    for (int i = 0; i < CORNERS; i++) {
        if (!(mcd_dot(base[i], ball.down) >= radius))
            return MEFALSE;
        min = MeMIN(min, distanceInside(base[i], base[(i + 1) % CORNERS], tip));
    }
    return min >= radius && min < INFINITY;
}

/* Twice the signed area of a triangle, projected along d. */
static double areaAlong(const double d[3], const double x[3], const double y[3], const double z[3]) {
    double xy[3], xz[3], n[3];
    mcd_sub(xy, y, x);
    mcd_sub(xz, z, x);
    mcd_cross(n, xy, xz);
    return mcd_dot(n, d);
}

/* Removes the corners that lie within the others as projected along d; the remaining polygon is convex. Returns the
 * count. */
static int makeConvex(const double d[3], double ring[][3], int count) {
    int straight = 0; /* number of consecutive corners that were kept */
    for (int i = 0; straight < count && count > 2;) {
        const int before = (i + count - 1) % count, after = (i + 1) % count;
        if (areaAlong(d, ring[before], ring[i], ring[after]) > 0) {
            straight++;
            i = after;
            continue;
        }
        for (int k = i; k + 1 < count; k++)
            mcd_copy(ring[k], ring[k + 1]);
        count--;
        straight = 0;
        i = (i + count - 1) % count;
    }
    return count;
}

/* Whether the ball is inside the solid made of a tip, a ring of corners, and a top. */
static MeBool isBallInSolid(const double top[3], double ring[][3], int count, const double tip[3], double radius) {
    for (int i = 0; i < count; i++) {
        const double *from = ring[i], *to = ring[(i + 1) % count];
        if (!(distanceInside(to, from, top) >= radius && distanceInside(from, to, tip) >= radius))
            return MEFALSE;
    }
    return METRUE;
}

/* The direction midway between the axes of two shapes, projected along d. M's face across two lines is a
 * parallelogram; one of its obtuse corners is farthest in this direction or across it, however narrow the
 * parallelogram is. */
static void bisectAxes(const McdShape *a, const McdShape *b, const double d[3], double u[3]) {
    double x[3], y[3], w[3];
    mcd_cross(x, a->axis[2], d);
    mcd_cross(y, b->axis[2], d);
    mcd_mad(u, x, mcd_dot(x, y) < 0 ? -1 : 1, y);
    const double length = mcd_length(u);
    if (length > mcd_parallelSine)
        mcd_scale(u, u, 1 / length);
    else
        mcd_basis(d, u, w);
}

/* For round contacts: M's face is a line or a point, which is no base of a pyramid. Instead the guess's own support
 * point and support points around it form a roof over the ball. A plane of the roof is tilted by about half as much
 * as the directions of these points, which lowers it by depth (1 - cos(tilt / 2)): depth tilt^2 / 8 <= tolerance.
 * Since a disc seen almost edge-on turns its support point by more than the direction turns, smaller tilts are
 * tried, too. */
MeBool mcd_isMinDepthOfRound(const McdShape *a, const McdShape *b, const McdProximity *p) {
    enum { TRIES = 3 };
    double u[3], ring[MAX_CORNERS][3], top[3], tip[3];
    Ball ball;
    if (!makeBall(a, b, p, &ball))
        return MEFALSE;
    bisectAxes(a, b, ball.down, u);
    mcd_scale(top, ball.down, ball.depth);
    minkowskiSupport(a, b, p->normal, tip);
    double tilt = MeMIN(sqrt(8 * ball.tolerance / ball.depth), 1);
    for (int i = 0; i < TRIES; i++, tilt /= 4) {
        supportsAround(a, b, ball.down, u, tilt, MAX_CORNERS, ring);
        const int count = makeConvex(ball.down, ring, MAX_CORNERS);
        if (count > 2 && isBallInSolid(top, ring, count, tip, ball.depth - ball.tolerance))
            return METRUE;
    }
    return MEFALSE;
}
