/* The normal of two smooth shapes, made exact.
 *
 * The search for the distance ends when the separation is exact to a fraction t of the size (mcd_distance.c); the
 * normal then has an error of sqrt(t), as the separation S(n) along n is at its maximum. With x and y, the support
 * points of both cores along the normal, S = n . (x - y); its gradient across n is that of x - y. Newton's method
 * finds its zero, with differences of support points as second derivative. A step that does not enlarge S is not
 * taken: where a flat face or a corner touches, x and y jump, and the search's normal is exact already. */
#include "convex/mcd_sampled_i.h"

/* The separation along a normal, with the support points, and its gradient along u and w. */
typedef struct Slope {
    double x[3], y[3], separation, gradient[2];
} Slope;

typedef struct Pair {
    const McdShape *a, *b;
    double size, noise; /* m */
} Pair;

static void slopeAlong(const Pair *p, const double n[3], const double u[3], const double w[3], Slope *s) {
    double back[3], between[3];
    mcd_scale(back, n, -1);
    mcd_coreSupport(p->a, back, s->x);
    mcd_coreSupport(p->b, n, s->y);
    mcd_sub(between, s->x, s->y);
    s->separation = mcd_dot(between, n);
    s->gradient[0] = mcd_dot(between, u);
    s->gradient[1] = mcd_dot(between, w);
}

/* The unit vector n + k along, n and along of length 1 and orthogonal. */
static void turnNormal(const double n[3], double k, const double along[3], double turned[3]) {
    mcd_mad(turned, n, k, along);
    mcd_scale(turned, turned, 1 / mcd_length(turned));
}

/* Derivatives of the gradient, by central differences: both directions turn with the normal, so that the derivative of
 * the term with S itself is -S on the diagonal. */
static void curvatureAt(const Pair *p, const double n[3], const double u[3], const double w[3], double separation,
                        double h[2][2]) {
    static const double step = 1e-4;
    const double *along[2] = {u, w};
    for (int i = 0; i < 2; i++) {
        double turned[3];
        Slope ahead, behind;
        turnNormal(n, step, along[i], turned);
        slopeAlong(p, turned, u, w, &ahead);
        turnNormal(n, -step, along[i], turned);
        slopeAlong(p, turned, u, w, &behind);
        for (int k = 0; k < 2; k++)
            h[i][k] = (ahead.gradient[k] - behind.gradient[k]) / (2 * step) - (i == k ? separation : 0);
    }
}

/* Newton's step along u and w; false: S is not concave here. */
static MeBool newtonStep(const double gradient[2], double h[2][2], double step[2]) {
    static const double max = .1; /* rad; more means that the points jump */
    const double mixed = (h[0][1] + h[1][0]) / 2, all = h[0][0] * h[1][1] - mixed * mixed;
    if (!(h[0][0] < 0 && all > 0))
        return MEFALSE;
    step[0] = (mixed * gradient[1] - h[1][1] * gradient[0]) / all;
    step[1] = (mixed * gradient[0] - h[0][0] * gradient[1]) / all;
    return fabs(step[0]) + fabs(step[1]) < max;
}

static double steepness(const Slope *s) {
    return fabs(s->gradient[0]) + fabs(s->gradient[1]);
}

/* One step; false: the normal stays as it is. */
static MeBool improveNormal(const Pair *p, double n[3], Slope *s) {
    double u[3], w[3], h[2][2], step[2], next[3];
    Slope there;
    mcd_basis(n, u, w);
    slopeAlong(p, n, u, w, s);
    if (!(steepness(s) > fmax(1e-14 * p->size, p->noise)))
        return MEFALSE;
    curvatureAt(p, n, u, w, s->separation, h);
    if (!newtonStep(s->gradient, h, step))
        return MEFALSE;
    for (int i = 0; i < 3; i++)
        next[i] = n[i] + step[0] * u[i] + step[1] * w[i];
    mcd_scale(next, next, 1 / mcd_length(next));
    mcd_basis(next, u, w);
    slopeAlong(p, next, u, w, &there);
    if (!(there.separation >= s->separation - 1e-15 * p->size && steepness(&there) < steepness(s)))
        return MEFALSE;
    mcd_copy(n, next);
    *s = there;
    return METRUE;
}

/* Two smooth surfaces; false: one of them is not, where they touch. */
static MeBool polishByNewton(const Pair *pair, McdProximity *p) {
    enum { STEPS = 6 };
    double n[3];
    Slope s = {.separation = 0};
    mcd_copy(n, p->normal);
    for (int i = 0; i < STEPS && improveNormal(pair, n, &s); i++)
        ;
    if (!(steepness(&s) <= fmax(1e-9 * pair->size, 4 * pair->noise)))
        return MEFALSE;
    mcd_copy(p->normal, n);
    p->separation = s.separation;
    mcd_copy(p->onA, s.x);
    mcd_copy(p->onB, s.y);
    return METRUE;
}

/* ---- a smooth surface at an edge, a corner or a rim -------------------------------------------------------------- */

/* m: the mean radius of curvature where the outward normal is n; 0: there is a corner, an edge or a flat face. */
static double meanRadius(const McdShape *s, const double n[3]) {
    static const double step = 1e-4, min = 1e-3, max = 1e3; /* of the extent */
    double axis[2][3], radius[2];
    mcd_basis(n, axis[0], axis[1]);
    for (int i = 0; i < 2; i++) {
        double turned[3], ahead[3], behind[3];
        turnNormal(n, step, axis[i], turned);
        mcd_coreSupport(s, turned, ahead);
        turnNormal(n, -step, axis[i], turned);
        mcd_coreSupport(s, turned, behind);
        radius[i] = mcd_heightOver(ahead, behind, axis[i]) / (2 * step);
        if (!(radius[i] > min * s->extent && radius[i] < max * s->extent))
            return 0;
    }
    return (radius[0] + radius[1]) / 2;
}

static void segmentSupport(const McdShape *s, const double d[3], double point[3]) {
    mcd_shapePoint(s, 0, 0, copysign(s->low, mcd_dot(s->axis[2], d)), point);
}

static void segmentFace(const McdShape *s, const double d[3], McdFace *f) {
    (void)d;
    mcd_faceAdd(s, f, 0, 0, -s->low, 0);
    mcd_faceAdd(s, f, 0, 0, s->low, 1);
}

static const McdKind pointKind = {.support = mcd_pointSupport, .face = mcd_pointFace, .rank = MCD_RANK_SPHERE};
static const McdKind segmentKind = {.support = segmentSupport, .face = segmentFace, .rank = MCD_RANK_SPHYL};

/* What touches a smooth surface from inside: a ball, or a capsule where it touches along a straight line. */
typedef struct Inner {
    McdShape core; /* the ball's centre, or the capsule's axis */
    double radius;
} Inner;

static MeBool makeAxis(const McdLine *line, Inner *inner) {
    McdShape *axis = &inner->core;
    double between[3];
    axis->kind = &segmentKind;
    mcd_sub(between, line->end[1], line->end[0]);
    axis->low = mcd_length(between) / 2;
    if (!(axis->low > 0)) /* the program's function gives other points than before */
        return MEFALSE;
    mcd_scale(axis->axis[2], between, .5 / axis->low);
    mcd_basis(axis->axis[2], axis->axis[0], axis->axis[1]);
    mcd_mad(axis->place, line->end[0], .5, between);
    mcd_mad(axis->place, axis->place, -inner->radius, line->normal);
    return inner->radius > 0;
}

/* Makes it where the outward normal is `out`. False: there is none. */
static MeBool makeInner(const McdShape *s, const double out[3], Inner *inner) {
    McdLine line;
    inner->core = (McdShape){.kind = &pointKind, .extent = s->extent, .axis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (mcd_sampledLineToward(s, out, &line, &inner->radius))
        return makeAxis(&line, inner);
    inner->radius = meanRadius(s, out);
    return inner->radius > 0;
}

/* Moves it to where the outward normal is `out`. The ball keeps its radius: what it converges to does not depend on
 * it. */
static MeBool moveInner(const McdShape *s, const double out[3], Inner *inner) {
    double point[3];
    if (inner->core.kind == &segmentKind)
        return makeInner(s, out, inner);
    mcd_coreSupport(s, out, point);
    mcd_mad(inner->core.place, point, -inner->radius, out);
    return METRUE;
}

/* The ball of the mean radius that touches the surface from inside touches the other shape where the surface does. So
 * the normal is that from the other shape's nearest point to the ball's centre, which is nearly the same for a slightly
 * wrong normal: the error shrinks by half of the radii's difference over their mean, in each round. */
static MeBool polishByCentre(const Pair *pair, MeBool isOfA, McdProximity *p) {
    enum { ROUNDS = 24 };
    const McdShape *smooth = isOfA ? pair->a : pair->b, *other = isOfA ? pair->b : pair->a;
    const double side = isOfA ? -1 : 1; /* of the surface's outward normal */
    double n[3], out[3], before[3], onInner[3], onOther[3], change = 1, noise = 0;
    Inner inner;
    mcd_scale(out, p->normal, side);
    if (!smooth->kind->isSampled || !makeInner(smooth, out, &inner))
        return MEFALSE;
    noise = pair->noise / inner.radius;
    for (int i = 0; i < ROUNDS && change > fmax(1e-10, noise); i++) {
        if (!moveInner(smooth, out, &inner) ||
            !(mcd_convexDistance(&inner.core, other, onInner, onOther, n) + other->rounding > 0))
            return MEFALSE;
        mcd_copy(before, out);
        mcd_scale(out, n, -1);
        change = sqrt(mcd_distanceSquared(out, before));
    }
    mcd_scale(n, out, side);
    const double separation = mcd_separationAlong(pair->a, pair->b, n);
    if (!(change <= fmax(1e-7, 4 * noise)) || !(separation >= p->separation - mcd_slack * 1e-3 * pair->size))
        return MEFALSE;
    double *const onSmooth = isOfA ? p->onA : p->onB, *const onCore = isOfA ? p->onB : p->onA;
    mcd_copy(p->normal, n);
    p->separation = separation;
    mcd_mad(onCore, onOther, other->rounding, out);
    mcd_mad(onSmooth, onCore, -separation, out);
    return METRUE;
}

MeBool mcd_polishNormal(const McdShape *a, const McdShape *b, McdProximity *p) {
    const Pair pair = {a, b, mcd_pairSize(a, b), mcd_shapeNoise(a) + mcd_shapeNoise(b)};
    return polishByNewton(&pair, p) || polishByCentre(&pair, METRUE, p) || polishByCentre(&pair, MEFALSE, p);
}
