/* The cap of a hull: the corners that a tilt may bring down on a plane.
 *
 * The contacts of two shapes are those of their faces at the step's start. Within the step a body that lands turns, by
 * its spin or by the impact, and sets down corners beside that face: at w h = .4 they would be 40 % of the thickness of
 * a flat hull of 16 points deep at the step's end. A tilt of up to t brings a corner at the distance d along the plane
 * from the lowest one down by at most t d. */
#include "convex/mcd_nearfield_i.h"

double mcd_tiltOf(McdReach reach, double size) {
    return MeMIN(reach.approach / size, 1); /* beyond 1 rad a small turn's bound of heights says nothing */
}

MeBool mcd_mayTilt(double tilt) {
    return 2 * tilt > mcd_mayEnter; /* no two points of a shape are farther apart than twice its size */
}

/* Whether a tilt may bring a corner as far down as the lowest one. */
static MeBool mayComeDown(const McdHull *h, int corner, int lowest, double height, double tilt) {
    const double square = mcd_distanceSquared(h->vertex[corner], h->vertex[lowest]), aside = square - height * height;
    return height * height <= tilt * tilt * aside;
}

int mcd_capToward(const McdShape *s, const double direction[3], double tilt, McdCap *cap) {
    const McdHull *h = s->hull;
    double down[3], far = -INFINITY;
    int lowest = 0;
    cap->count = 0;
    if (!h)
        return 0;
    mcd_shapeToOwnAxes(s, direction, down);
    for (int i = 0; i < h->vertexCount; i++) {
        const double x = mcd_dot(h->vertex[i], down);
        lowest = x > far ? i : lowest;
        far = fmax(far, x);
    }
    /* Of more corners than there is room for every second, fourth, and so on: they lie close together. */
    for (int stride = 1; cap->count == 0; stride *= 2) {
        for (int i = 0, found = 0; i < h->vertexCount && cap->count <= MCD_CAP_POINTS; i++) {
            const double over = far - mcd_dot(h->vertex[i], down);
            if (over > 2 * tilt * s->extent || !mayComeDown(h, i, lowest, over, tilt) || found++ % stride != 0)
                continue;
            if (cap->count < MCD_CAP_POINTS) {
                cap->corner[cap->count] = i;
                mcd_shapePoint(s, h->vertex[i][0], h->vertex[i][1], h->vertex[i][2], cap->point[cap->count]);
            }
            cap->count++;
        }
        if (cap->count > MCD_CAP_POINTS)
            cap->count = 0;
    }
    MEASSERT(cap->count >= 1 && cap->count <= MCD_CAP_POINTS);
    return cap->count;
}
