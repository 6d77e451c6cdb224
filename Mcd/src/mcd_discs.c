/* Solids between two discs about z: cylinders and cones. */
#include "mcd_kind_i.h"

/* Of the radius: the rim's farthest point is a corner of its own where it stands out by more, as mcd_face.c's slack. */
static const double standsOut = 2e-7;

/* ---- the farthest point ------------------------------------------------------------------------------------ */

void mcd_discsSupport(const McdShape *s, const McdDiscs *discs, const double d[3], double point[3]) {
    const double x = mcd_dot(s->axis[0], d), y = mcd_dot(s->axis[1], d), z = mcd_dot(s->axis[2], d);
    const double across = sqrt(x * x + y * y);
    const MeBool isTop = discs->top * z + discs->upper * across >= discs->bottom * z + discs->lower * across;
    const double radius = isTop ? discs->upper : discs->lower, k = across > 0 ? radius / across : 0;
    mcd_shapePoint(s, across > 0 ? x * k : radius, y * k, isTop ? discs->top : discs->bottom, point);
}

/* ---- faces ------------------------------------------------------------------------------------------------- */

/* In which of the 16 parts of a turn, counted from x on, a direction lies. */
static int sectorOf(double x, double y) {
    static const double tangent = .41421356237309503; /* of a 16th of a turn */
    const double ax = fabs(x), ay = fabs(y);
    const int quarter = (ay > tangent * ax) + (ay > ax) + (tangent * ay > ax);
    MEASSERT(quarter >= 0 && quarter <= 3);
    if (y >= 0)
        return x >= 0 ? quarter : 7 - quarter;
    return x < 0 ? 8 + quarter : 15 - quarter;
}

/* The rim of a disc at a height, counter-clockwise seen from the side of z = side. Its farthest point is put among the
 * fixed ones where it is farther than they are. */
static void discFace(const McdShape *s, const double d[3], double radius, double height, double side, McdFace *f) {
    enum { RIM = 16, FARTHEST = 63 };
    static const double cosine[RIM] = {1,  .9238795325112867,  .7071067811865476,  .3826834323650898,
                                       0,  -.3826834323650898, -.7071067811865476, -.9238795325112867,
                                       -1, -.9238795325112867, -.7071067811865476, -.3826834323650898,
                                       0,  .3826834323650898,  .7071067811865476,  .9238795325112867};
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), x = across > 0 ? d[0] / across : 1,
                 y = across > 0 ? side * d[1] / across : 0;
    const int after = sectorOf(x, y), before = (after + 1) % RIM; /* the fixed points beside the farthest */
    double centre[3], u[3], w[3];
    mcd_shapeDirection(s, 0, 0, side, f->normal);
    f->id = side > 0;
    mcd_mad(centre, s->place, height, s->axis[2]);
    mcd_scale(u, s->axis[0], radius);
    mcd_scale(w, s->axis[1], side * radius);
    for (int i = 0; i < RIM; i++) {
        const double c = cosine[i], n = cosine[(i + 12) % RIM];
        double *p = f->point[f->count];
        for (int k = 0; k < 3; k++)
            p[k] = centre[k] + (u[k] * c + w[k] * n);
        f->name[f->count++] = (MeU32)i;
        if (i != after)
            continue;
        const double here = c * x + n * y, next = cosine[before] * x + cosine[(before + 12) % RIM] * y;
        if ((1 - MeMAX(here, next)) * across > standsOut)
            mcd_faceAdd(s, f, radius * x, side * radius * y, height, FARTHEST);
    }
}

/* The line on the side of a cylinder or cone that lies towards (x, y); its normal rises by `rise` over 1. */
static void sideLine(const McdShape *s, const double d[3], const double radius[2], const double height[2], McdFace *f) {
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), x = across > 0 ? d[0] / across : 1,
                 y = across > 0 ? d[1] / across : 0;
    const double long_ = hypot(height[1] - height[0], radius[0] - radius[1]);
    const double out = (height[1] - height[0]) / long_, up = (radius[0] - radius[1]) / long_;
    mcd_shapeDirection(s, out * x, out * y, up, f->normal);
    f->id = 2;
    f->bend = (radius[0] + radius[1]) / 2;
    for (int i = 0; i < 2; i++)
        mcd_faceAdd(s, f, radius[i] * x, radius[i] * y, height[i], (MeU32)i);
}

/* Of both discs and the side, what looks most that way. */
void mcd_discsFace(const McdShape *s, const McdDiscs *discs, const double direction[3], McdFace *f) {
    const double lower = discs->lower, upper = discs->upper, bottom = discs->bottom, top = discs->top;
    const double radius[2] = {lower, upper}, height[2] = {bottom, top};
    double d[3];
    mcd_shapeOwn(s, direction, d);
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), long_ = hypot(top - bottom, lower - upper);
    const double side = (across * (top - bottom) + d[2] * (lower - upper)) / long_;
    if (d[2] > side && upper > 0)
        discFace(s, d, upper, top, 1, f);
    else if (-d[2] > side && lower > 0)
        discFace(s, d, lower, bottom, -1, f);
    else
        sideLine(s, d, radius, height, f);
}

/* ---- how round the side is --------------------------------------------------------------------------------- */

/* The side of a cylinder or cone: its normal has the same part along the axis everywhere, and meets the axis at the
 * middle of its curvature across. */
double mcd_discsRadius(const McdShape *s, const McdDiscs *discs, const double outward[3], const double point[3]) {
    const double lower = discs->lower, upper = discs->upper, bottom = discs->bottom, top = discs->top;
    static const double across = .9987502603949663; /* cos(.05): at a wider angle it is the rim that touches */
    const double slant = hypot(top - bottom, lower - upper), out = (top - bottom) / slant;
    const double up = mcd_dot(s->axis[2], outward), aside = sqrt(fmax(1 - up * up, 0));
    double off[3];
    MEASSERT(out >= 0);
    if (!(aside * out + up * (lower - upper) / slant >= across))
        return 0;
    mcd_sub(off, point, s->place);
    const double t = MeCLAMP((mcd_dot(off, s->axis[2]) - bottom) / (top - bottom), 0, 1);
    return (lower + t * (upper - lower)) / out;
}

/* Where the axis is not the normal, a rim, or the side, touches with the point of a circle about the axis that lies
 * farthest along the normal. */
double mcd_discsRim(const McdShape *s, const double outward[3], const double point[3]) {
    static const double least = .05, near = .9987502603949663; /* rad: nearer to the axis it is a disc that touches */
    const double up = mcd_dot(s->axis[2], outward);
    double off[3], aside[3];
    mcd_sub(off, point, s->place);
    mcd_mad(off, off, -mcd_dot(off, s->axis[2]), s->axis[2]);
    mcd_mad(aside, outward, -up, s->axis[2]);
    const double rim = mcd_length(off), sine = mcd_length(aside);
    return sine > least && mcd_dot(off, aside) > near * rim * sine ? rim : 0;
}
