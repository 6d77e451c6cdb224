/* Contact reduction: which of many contacts to keep.
 *
 * The kept ones have to support the others. Where bodies move a little, the separation of contact i, at x_i, changes by
 * w(x_i), w affine. While the kept contacts k do not overlap, s_k + w(x_k) >= 0, and while the bodies tilt by at
 * most t, |grad w| <= t, no contact overlaps by more than
 *
 *     need_i = min { sum l_k s_k + t |x_i - sum l_k x_k| : l_k >= 0, sum l_k = 1 } - s_i
 *
 * by the duality of linear programs. The minimum is the lower convex hull of the kept contacts with a cone of slope t
 * around it. Contacts without a need are left out. The deepest contact is kept, then one by one that with the greatest
 * need: of contacts in one plane far corners, of others those that touch before those that do not. t is a tenth more
 * than the tilt by which all contacts of the choice come to touch: with a quarter of it a thin plank sinks into bumps
 * and stays there, with twice it small discs rock.
 *
 * Contacts with several normals are compared in six dimensions: a difference of normals counts as a distance. */
#include "convex/mcd_spread_i.h"
#include "MeMath.h"
#include "convex/mcd_vector_i.h"
#include "MeAssert.h"

/* Spots, and what holds for all of them. */
typedef struct Choice {
    McdSpot *spot;
    int count, dims; /* 3 if there is one normal, else 6 */
    double tilt;     /* rad: t */
    double slack;    /* m: smaller differences of needs do not matter */
    double level;    /* m: smaller differences of depth do not, either */
} Choice;

/* Relative to the spots' extent. Spots that all touch are compared as if separations ranged over flatRange; needs that
 * differ by less than sameNeed times that range are equal, so that bodies at rest keep their contacts. With ten times
 * sameNeed Mcd_Batch leaves out a corner of a slab. */
static const double flatRange = 1e-3, sameNeed = 1e-4;

/* (a - o) . (b - o) */
static double product(const Choice *c, const McdSpot *o, const McdSpot *a, const McdSpot *b) {
    double sum = 0;
    for (int i = 0; i < c->dims; i++)
        sum += (a->at[i] - o->at[i]) * (b->at[i] - o->at[i]);
    return sum;
}

static double distanceOf(const Choice *c, const McdSpot *a, const McdSpot *b) {
    return sqrt(product(c, a, b, b));
}

/* ---- support ----------------------------------------------------------------------------------------------------- */

/* Whether the spot is supported, or chosen: support only falls, so that neither will change. */
static MeBool isSettled(const Choice *c, const McdSpot *s) {
    return s->support - s->separation <= c->slack;
}

static void lowerSupport(McdSpot *s, double support) {
    if (!(s->support <= support))
        s->support = support;
}

/* Lowers the support of all spots to that of two chosen ones, where x lies between them:
 * s_a + u (s_b - s_a) + t sqrt(p + u (u ll - 2 lp)), u between 0 and 1. Its minimum is where the cone's slope along the
 * line is that of the separation. */
static void addSegment(const Choice *c, const McdSpot *a, const McdSpot *b) {
    const double ll = product(c, a, b, b), rise = b->separation - a->separation;
    const double room = c->tilt * c->tilt * ll - rise * rise; /* negative: the lower end's cone is below the other */
    for (int i = 0; i < c->count; i++) {
        McdSpot *s = &c->spot[i];
        if (isSettled(c, s))
            continue;
        const double p = product(c, a, s, s), lp = product(c, a, b, s);
        double u = rise < 0;
        if (room > 0)
            u = MeCLAMP((lp - rise * sqrt(fmax(p * ll - lp * lp, 0) / room)) / ll, 0, 1);
        lowerSupport(s, a->separation + u * rise + c->tilt * sqrt(fmax(p + u * (u * ll - 2 * lp), 0)));
    }
}

/* Lowers the support of the spots over a triangle of chosen ones. */
static void addTriangle(const Choice *c, const McdSpot *o, const McdSpot *a, const McdSpot *b) {
    const double aa = product(c, o, a, a), ab = product(c, o, a, b), bb = product(c, o, b, b);
    const double det = aa * bb - ab * ab, riseA = a->separation - o->separation, riseB = b->separation - o->separation;
    if (!(det > 1e-12 * aa * bb))
        return;
    for (int i = 0; i < c->count; i++) {
        McdSpot *s = &c->spot[i];
        if (isSettled(c, s))
            continue;
        const double ap = product(c, o, a, s), bp = product(c, o, b, s);
        const double u = (ap * bb - bp * ab) / det, v = (bp * aa - ap * ab) / det;
        if (u < 0 || v < 0 || u + v > 1)
            continue;
        const double aside = fmax(product(c, o, s, s) - u * ap - v * bp, 0); /* squared distance from the triangle */
        lowerSupport(s, o->separation + u * riseA + v * riseB + c->tilt * sqrt(aside));
    }
}

/* Adds the support of the last chosen spot, alone and with those chosen before. */
static void addSupport(const Choice *c, const int *kept, int keptCount) {
    const McdSpot *last = &c->spot[kept[keptCount - 1]];
    for (int j = 0; j < keptCount - 1; j++) {
        addSegment(c, &c->spot[kept[j]], last);
        for (int k = 0; k < j; k++)
            addTriangle(c, &c->spot[kept[j]], &c->spot[kept[k]], last);
    }
    for (int i = 0; keptCount == 1 && i < c->count; i++)
        lowerSupport(&c->spot[i], last->separation + c->tilt * distanceOf(c, last, &c->spot[i]));
}

/* ---- choice ------------------------------------------------------------------------------------------------------ */

static MeBool haveOneNormal(const McdSpot *spot, int count) {
    for (int i = 1; i < count; i++)
        if (mcd_dot(spot[i].at + 3, spot[0].at + 3) < .9998) /* 1.1 degrees */
            return MEFALSE;
    return METRUE;
}

/* Rad: the slope of the plane through the separations, by least squares: that of a face that tilts about any axis.
 * Widths far below the extent count as zero. */
static double slopeOf(const Choice *c, const McdSpot *middle, double extent) {
    double axis[2][3], uu = c->count * sameNeed * extent * sameNeed * extent, uv = 0, vv = uu, us = 0, vs = 0;
    mcd_basis(c->spot[0].at + 3, axis[0], axis[1]);
    for (int i = 0; i < c->count; i++) {
        double arm[3];
        mcd_sub(arm, c->spot[i].at, middle->at);
        const double u = mcd_dot(arm, axis[0]), v = mcd_dot(arm, axis[1]);
        uu += u * u, uv += u * v, vv += v * v;
        us += u * c->spot[i].separation, vs += v * c->spot[i].separation;
    }
    const double det = uu * vv - uv * uv;
    return det > 0 ? hypot(us * vv - vs * uv, vs * uu - us * uv) / det : 0;
}

/* Measures the spots' extent, and scales their normals. */
static Choice beginChoice(McdSpot *spot, int count, McdSpot *middle) {
    Choice c = {spot, count, 3, 0, 0, 0};
    double low = INFINITY, high = -INFINITY, extent = 0;
    *middle = (McdSpot){.separation = 0};
    for (int i = 0; i < count; i++) {
        mcd_mad(middle->at, middle->at, 1. / count, spot[i].at);
        low = fmin(low, spot[i].separation);
        high = fmax(high, spot[i].separation);
        spot[i].support = INFINITY;
    }
    for (int i = 0; i < count; i++)
        extent = fmax(extent, distanceOf(&c, middle, &spot[i]));
    const MeBool isFlat = haveOneNormal(spot, count);
    const double slope = isFlat ? slopeOf(&c, middle, extent) : 0;
    c.tilt = fmax(extent > 0 ? 1.1 * fmax((high - low) / extent, slope) : 0, flatRange);
    c.slack = sameNeed * c.tilt * extent;
    c.level = sameNeed * flatRange * extent;
    if (isFlat)
        return c;
    c.dims = 6;
    for (int i = 0; i < count; i++)
        mcd_scale(spot[i].at + 3, spot[i].at + 3, 2 * extent);
    return c;
}

/* The deepest spot; of those equally deep the one farthest from the middle. */
static int firstOf(const Choice *c, const McdSpot *middle) {
    double low = INFINITY, max = -1;
    int best = 0;
    for (int i = 0; i < c->count; i++)
        low = fmin(low, c->spot[i].separation);
    for (int i = 0; i < c->count; i++) {
        const double far = c->tilt * distanceOf(c, middle, &c->spot[i]);
        if (c->spot[i].separation <= low + c->level && far > max + c->slack) {
            max = far;
            best = i;
        }
    }
    return best;
}

/* The spot that needs support most, of equal ones the first; -1: none does. */
static int neediestOf(const Choice *c, double same) {
    double max = fmax(c->slack, c->tilt * same);
    int best = -1;
    for (int i = 0; i < c->count; i++) {
        const double need = c->spot[i].support - c->spot[i].separation;
        if (need > max) {
            max = need + c->slack;
            best = i;
        }
    }
    return best;
}

void mcd_sortAscending(int *kept, int count) {
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && kept[k] < kept[k - 1]; k--) {
            const int swap = kept[k];
            kept[k] = kept[k - 1];
            kept[k - 1] = swap;
        }
}

static MeBool areAscending(const int *kept, int count) {
    for (int i = 1; i < count; i++)
        if (kept[i] <= kept[i - 1])
            return MEFALSE;
    return METRUE;
}

/* Marks a spot as chosen. */
static int choose(const Choice *c, int next, int *kept, int keptCount) {
    kept[keptCount++] = next;
    addSupport(c, kept, keptCount);
    c->spot[next].support = -INFINITY; /* not again */
    return keptCount;
}

int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept) {
    McdSpot middle;
    int keptCount = 0;
    if (count <= 0 || maxCount <= 0)
        return 0;
    const Choice c = beginChoice(spot, count, &middle);
    for (int next = firstOf(&c, &middle); next >= 0; next = keptCount < maxCount ? neediestOf(&c, same) : -1)
        keptCount = choose(&c, next, kept, keptCount);
    mcd_sortAscending(kept, keptCount);
    MEASSERT(keptCount >= 1 && keptCount <= maxCount && kept[0] >= 0 && kept[keptCount - 1] < count);
    MEVALIDATE(areAscending(kept, keptCount));
    return keptCount;
}

int mcd_spreadForTilt(McdSpot *spot, int count, int maxCount, double tilt, double slack, int keptCount, int *kept) {
    McdSpot middle;
    MEASSERT(keptCount >= 1 && keptCount <= maxCount && count >= keptCount);
    Choice c = beginChoice(spot, count, &middle);
    c.tilt = tilt;
    c.slack = slack;
    for (int i = 0; i < keptCount; i++)
        choose(&c, kept[i], kept, i);
    for (int next = 0; keptCount < maxCount && (next = neediestOf(&c, 0)) >= 0;)
        keptCount = choose(&c, next, kept, keptCount);
    return keptCount;
}
