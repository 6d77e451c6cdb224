/* Solids of revolution between two discs about z: cylinders and cones. */
#include "convex/mcd_kind_i.h"

/* Sine of the angle between axis and normal up to which a disc touches flat, with its face; beyond, with its rim. */
static const double flatSine = .05;

/* The lower disc and the upper one. */
typedef struct Discs {
    double radius[2], height[2];
} Discs;

void mcd_discsShape(McdShape *s, double lowerRadius, double upperRadius, double length, double low) {
    mcd_set(s->size, lowerRadius, upperRadius, length);
    s->low = low;
    s->extent = MeMAX(hypot(lowerRadius, low), hypot(upperRadius, length - low));
}

static Discs discsOf(const McdShape *s) {
    return (Discs){{s->size[0], s->size[1]}, {-s->low, s->size[2] - s->low}};
}

/* The slant height: the length of the side from rim to rim. */
static double slantOf(const Discs *discs) {
    return hypot(discs->height[1] - discs->height[0], discs->radius[0] - discs->radius[1]);
}

/* ---- support point ------------------------------------------------------------------------------------------ */

void mcd_discsSupport(const McdShape *s, const double d[3], double point[3]) {
    const Discs discs = discsOf(s);
    const double x = mcd_dot(s->axis[0], d), y = mcd_dot(s->axis[1], d), z = mcd_dot(s->axis[2], d);
    const double across = sqrt(x * x + y * y);
    const int end = discs.height[1] * z + discs.radius[1] * across >= discs.height[0] * z + discs.radius[0] * across;
    const double radius = discs.radius[end], k = across > 0 ? radius / across : 0;
    mcd_shapePoint(s, across > 0 ? x * k : radius, y * k, discs.height[end], point);
}

void mcd_discsBounds(const McdShape *s, double low[3], double high[3]) {
    const Discs discs = discsOf(s);
    for (int i = 0; i < 3; i++) {
        const double x = s->axis[0][i], y = s->axis[1][i], z = s->axis[2][i], across = sqrt(x * x + y * y);
        const double height[2] = {discs.height[0] * z, discs.height[1] * z};
        const double half[2] = {discs.radius[0] * across, discs.radius[1] * across};
        low[i] = s->place[i] + MeMIN(height[0] - half[0], height[1] - half[1]);
        high[i] = s->place[i] + MeMAX(height[0] + half[0], height[1] + half[1]);
    }
}

/* ---- faces ------------------------------------------------------------------------------------------------- */

/* The index of the sixteenth of a full turn in which the direction (x, y) lies, counted from x. */
static int sectorOf(double x, double y) {
    static const double tangent = .41421356237309503; /* of a sixteenth of a full turn */
    const double ax = fabs(x), ay = fabs(y);
    const int quarter = (ay > tangent * ax) + (ay > ax) + (tangent * ay > ax);
    MEASSERT(quarter >= 0 && quarter <= 3);
    if (y >= 0)
        return x >= 0 ? quarter : 7 - quarter;
    return x < 0 ? 8 + quarter : 15 - quarter;
}

enum { RIM = 16, FARTHEST = 63 };

/* The rim of a tilted disc: a regular pentagon, one corner of which is the support point, in the direction (x, y). With
 * corners that are fixed on the disc it could not roll. It rolls from corner to corner if it turns by more than
 * tan(36 degrees) in a step. */
static void makeTiltedRim(const McdShape *s, double x, double y, double radius, double height, double side,
                          McdFace *f) {
    enum { CORNERS = 5 };
    static const double cosine[CORNERS] = {1, .30901699437494742, -.80901699437494742, -.80901699437494742,
                                           .30901699437494742},
                        sine[CORNERS] = {0, .95105651629515357, .58778525229247313, -.58778525229247313,
                                         -.95105651629515357};
    for (int i = 0; i < CORNERS; i++)
        mcd_faceAdd(s, f, radius * (cosine[i] * x - sine[i] * y), side * radius * (sine[i] * x + cosine[i] * y), height,
                    (MeU32)(FARTHEST - i));
}

/* The rim of a disc that lies flat: a polygon of 16 fixed corners, and the support point, in the direction (x, y),
 * where no fixed corner is as far by a share `across` of the radius. */
static void makeFlatRim(const McdShape *s, double x, double y, double across, double radius, double height, double side,
                        McdFace *f) {
    static const double cosine[RIM] = {1,  .9238795325112867,  .7071067811865476,  .3826834323650898,
                                       0,  -.3826834323650898, -.7071067811865476, -.9238795325112867,
                                       -1, -.9238795325112867, -.7071067811865476, -.3826834323650898,
                                       0,  .3826834323650898,  .7071067811865476,  .9238795325112867};
    const int after = sectorOf(x, y), before = (after + 1) % RIM; /* fixed corners beside the support point */
    double centre[3], u[3], w[3];
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
        if ((1 - MeMAX(here, next)) * across > mcd_slack)
            mcd_faceAdd(s, f, radius * x, side * radius * y, height, FARTHEST);
    }
}

void mcd_discFace(const McdShape *s, const double d[3], double radius, double height, double side, McdFace *f) {
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), x = across > 0 ? d[0] / across : 1,
                 y = across > 0 ? side * d[1] / across : 0;
    mcd_shapeDirection(s, 0, 0, side, f->normal);
    f->id = side > 0;
    f->isDisc = METRUE;
    if (across > flatSine)
        makeTiltedRim(s, x, y, radius, height, side, f);
    else
        makeFlatRim(s, x, y, across, radius, height, side, f);
}

/* The generator line of the side that faces the direction d (own axes). */
static void makeSideLine(const McdShape *s, const double d[3], const Discs *discs, McdFace *f) {
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]), x = across > 0 ? d[0] / across : 1,
                 y = across > 0 ? d[1] / across : 0;
    const double *radius = discs->radius, *height = discs->height, slant = slantOf(discs);
    const double out = (height[1] - height[0]) / slant, up = (radius[0] - radius[1]) / slant;
    mcd_shapeDirection(s, out * x, out * y, up, f->normal);
    f->id = 2;
    f->curvatureRadius = (radius[0] + radius[1]) / 2;
    for (int i = 0; i < 2; i++)
        mcd_faceAdd(s, f, radius[i] * x, radius[i] * y, height[i], (MeU32)i);
}

/* The feature whose normal is closest to the direction: an end disc, or a generator line of the side. */
void mcd_discsFace(const McdShape *s, const double direction[3], McdFace *f) {
    const Discs discs = discsOf(s);
    const double *radius = discs.radius, *height = discs.height;
    double d[3];
    mcd_shapeToOwnAxes(s, direction, d);
    const double across = sqrt(d[0] * d[0] + d[1] * d[1]);
    const double side = (across * (height[1] - height[0]) + d[2] * (radius[0] - radius[1])) / slantOf(&discs);
    if (d[2] > side && radius[1] > 0)
        mcd_discFace(s, d, radius[1], height[1], 1, f);
    else if (-d[2] > side && radius[0] > 0)
        mcd_discFace(s, d, radius[0], height[0], -1, f);
    else
        makeSideLine(s, d, &discs, f);
}

/* ---- the side's curvature ---------------------------------------------------------------------------------- */

/* The radius of curvature of the side across its generator lines, by Meusnier: the distance along the normal from
 * the surface to the axis, r / cos(slope). */
double mcd_discsRadius(const McdShape *s, const double outward[3], const double point[3]) {
    static const double across = .9987502603949663; /* cos(.05): wider angles to the side's normal: a rim */
    const Discs discs = discsOf(s);
    const double lower = discs.radius[0], upper = discs.radius[1], bottom = discs.height[0], top = discs.height[1];
    const double slant = slantOf(&discs), out = (top - bottom) / slant;
    const double up = mcd_dot(s->axis[2], outward), aside = sqrt(fmax(1 - up * up, 0));
    MEASSERT(out >= 0);
    if (!(aside * out + up * (lower - upper) / slant >= across))
        return 0;
    const double t = MeCLAMP((mcd_heightOver(point, s->place, s->axis[2]) - bottom) / (top - bottom), 0, 1);
    return (lower + t * (upper - lower)) / out;
}

/* The radius of the circle about the axis that the contact point lies on, on a rim or on the side; 0 where the
 * normal is within .05 rad of the axis: a disc touches flat. */
double mcd_discsRim(const McdShape *s, const double outward[3], const double point[3]) {
    static const double near = .9987502603949663; /* cos(.05) */
    const double up = mcd_dot(s->axis[2], outward);
    double offset[3], aside[3];
    mcd_sub(offset, point, s->place);
    mcd_mad(offset, offset, -mcd_dot(offset, s->axis[2]), s->axis[2]);
    mcd_mad(aside, outward, -up, s->axis[2]);
    const double rim = mcd_length(offset), sine = mcd_length(aside);
    return sine > flatSine && mcd_dot(offset, aside) > near * rim * sine ? rim : 0;
}
