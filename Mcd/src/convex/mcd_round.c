/* Proximity in closed form where a core is a point or segment (spheres and sphyls), against each other, boxes and
 * cylinders. Where cores intersect or touch, the normal is not unique: a fixed direction orthogonal to them is used. */
#include "convex/mcd_nearfield_i.h"

/* Relative to the smaller shape: cores nearer than this touch. */
static const double touching = 1e-12;

/* Completes the proximity from its witness points. If these coincide, the normal is `across`. */
static MeBool setProximityOfPoints(const McdShape *a, const McdShape *b, const double across[3], double limit,
                                   McdProximity *p) {
    double d[3];
    mcd_sub(d, p->onA, p->onB);
    const double distance = mcd_length(d);
    p->separation = distance;
    p->isGuess = 0;
    if (distance > touching * mcd_pairSize(a, b))
        mcd_scale(p->normal, d, 1 / distance);
    else
        mcd_copy(p->normal, across);
    return distance <= limit;
}

MeBool mcd_pointPointProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    static const double up[3] = {0, 0, 1};
    mcd_copy(p->onA, a->place);
    mcd_copy(p->onB, b->place);
    return setProximityOfPoints(a, b, up, limit, p);
}

MeBool mcd_pointSegmentProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    const double t = mcd_heightOver(a->place, b->place, b->axis[2]), half = b->low;
    mcd_copy(p->onA, a->place);
    mcd_mad(p->onB, b->place, MeCLAMP(t, -half, half), b->axis[2]);
    return setProximityOfPoints(a, b, b->axis[0], limit, p);
}

/* The closest points of two lines, alternately projected from one to the other; then clamped to the segments. */
void mcd_nearestOfSegments(const McdShape *a, const McdShape *b, double *s, double *t) {
    double d[3];
    mcd_sub(d, a->place, b->place);
    const double c = mcd_dot(a->axis[2], b->axis[2]), da = mcd_dot(d, a->axis[2]), db = mcd_dot(d, b->axis[2]);
    const double ha = a->low, hb = b->low, sine2 = 1 - c * c;
    if (sine2 > 1e-14) {
        *s = (c * db - da) / sine2;
    } else { /* parallel: the middle of the overlap */
        const double low = MeMAX(-ha, -da - hb), high = MeMIN(ha, -da + hb);
        *s = (low + high) / 2;
    }
    *s = MeCLAMP(*s, -ha, ha);
    *t = MeCLAMP(db + c * *s, -hb, hb);
    *s = MeCLAMP(c * *t - da, -ha, ha);
    MEASSERT(fabs(*s) <= ha && fabs(*t) <= hb); /* also false for NaN */
}

MeBool mcd_segmentSegmentProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    double s, t, across[3];
    mcd_nearestOfSegments(a, b, &s, &t);
    mcd_mad(p->onA, a->place, s, a->axis[2]);
    mcd_mad(p->onB, b->place, t, b->axis[2]);
    mcd_cross(across, a->axis[2], b->axis[2]);
    const double length = mcd_length(across);
    if (length > 1e-6)
        mcd_scale(across, across, 1 / length);
    else
        mcd_copy(across, b->axis[0]);
    return setProximityOfPoints(a, b, across, limit, p);
}

/* a's place along b's axes. */
static void placeInFrame(const McdShape *a, const McdShape *b, double x[3]) {
    double d[3];
    mcd_sub(d, a->place, b->place);
    mcd_shapeToOwnAxes(b, d, x);
}

/* Stores the proximity of a's point; normal (outward) and nearest surface point are given in b's axes. */
static MeBool setProximityInFrame(const McdShape *a, const McdShape *b, const double normal[3], const double nearest[3],
                                  double separation, double limit, McdProximity *p) {
    MEASSERT(mcd_isUnit(normal));
    mcd_shapeDirection(b, normal[0], normal[1], normal[2], p->normal);
    mcd_shapePoint(b, nearest[0], nearest[1], nearest[2], p->onB);
    mcd_copy(p->onA, a->place);
    p->separation = separation;
    p->isGuess = 0;
    return separation <= limit;
}

/* The direction and distance from b's nearest point to the point x outside; false if these coincide. */
static MeBool findOutwardNormal(const McdShape *a, const McdShape *b, const double x[3], const double nearest[3],
                                double n[3], double *distance) {
    mcd_sub(n, x, nearest);
    *distance = mcd_length(n);
    if (!(*distance > touching * mcd_pairSize(a, b)))
        return MEFALSE;
    mcd_scale(n, n, 1 / *distance);
    return METRUE;
}

MeBool mcd_pointBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    double x[3], nearest[3], n[3], distance;
    int k = 0;
    placeInFrame(a, b, x);
    for (int i = 0; i < 3; i++) {
        nearest[i] = MeCLAMP(x[i], -b->size[i], b->size[i]);
        if (fabs(x[i]) - b->size[i] > fabs(x[k]) - b->size[k])
            k = i;
    }
    if (!findOutwardNormal(a, b, x, nearest, n, &distance)) {
        mcd_set(n, 0, 0, 0);
        n[k] = x[k] < 0 ? -1 : 1;
        nearest[k] = n[k] * b->size[k];
        distance = fabs(x[k]) - b->size[k];
    }
    return setProximityInFrame(a, b, n, nearest, distance, limit, p);
}

MeBool mcd_pointCylinderProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    double x[3], nearest[3], n[3], distance;
    placeInFrame(a, b, x);
    const double radius = b->size[0], half = b->low, across = hypot(x[0], x[1]);
    const double k = across > radius ? radius / across : 1;
    mcd_set(nearest, x[0] * k, x[1] * k, MeCLAMP(x[2], -half, half));
    if (!findOutwardNormal(a, b, x, nearest, n, &distance)) {
        if (fabs(x[2]) - half >= across - radius) { /* nearest surface: an end disc */
            mcd_set(n, 0, 0, x[2] < 0 ? -1 : 1);
            nearest[2] = n[2] * half;
            distance = fabs(x[2]) - half;
        } else { /* nearest surface: the side; for a point on the axis, along x */
            mcd_set(n, across > 0 ? x[0] / across : 1, across > 0 ? x[1] / across : 0, 0);
            mcd_set(nearest, n[0] * radius, n[1] * radius, nearest[2]);
            distance = across - radius;
        }
    }
    return setProximityInFrame(a, b, n, nearest, distance, limit, p);
}
