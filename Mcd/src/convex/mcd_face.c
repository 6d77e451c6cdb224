/* Contact manifolds: the two supporting faces are clipped against each other, and the result is reduced to four
 * points.
 *
 * Projected along the normal, both faces are points, lines or convex polygons in the plane orthogonal to it.
 * Contacts are the corners of their intersection. Each has a height on either surface; the difference is its
 * separation. On flat faces the separation is linear, so the deepest point is one of these corners.
 */
#include "convex/mcd_face_i.h"

#include <stdbool.h>
#include <string.h>

/* Contacts within this depth of the deepest one are preferred in the reduction: a fraction of the pair's size
 * (carryingShare), or of the range of depths (tiltShare). Without the first, a body lying flat would change its four
 * contacts with the rounding of each step; without the second, a box on an edge would keep contacts at one end only
 * and rock. Mcd_BoxBox fails with twice either value. */
static const double carryingShare = 1e-3, tiltShare = 0.25;
/* Relative to the pair's size: the error of separations where a face's normal was preferred to a slightly better
 * normal. */
static const double preference = 1e-5;
/* Lines at a smaller angle (sine) touch along a segment, lines at larger angles in a point. */
static const double segmentSine = .05;

/* ---- faces ------------------------------------------------------------------------------------------ */

/* For checks: the corners have different names and are counter-clockwise about the unit normal. */
static MeBool isFaceGood(const McdShape *s, const McdFace *f) {
    const double rounding =
        f->count > 0 ? 4e-16 * mcd_length(f->point[0]) : 0; /* of coordinates: may exceed a tiny shape */
    const double slack = 1e-9 * s->extent * s->extent + 16 * rounding * (s->extent + rounding);
    for (int i = 0; i < f->count; i++)
        for (int j = 0; j < i; j++)
            if (f->name[i] == f->name[j])
                return MEFALSE;
    for (int i = 0; i < f->count && f->count > 2 && mcd_shapeIsKnown(s); i++) {
        const double *p = f->point[i], *q = f->point[(i + 1) % f->count], *r = f->point[(i + 2) % f->count];
        double pq[3], qr[3], n[3];
        mcd_sub(pq, q, p);
        mcd_sub(qr, r, q);
        mcd_cross(n, pq, qr);
        if (mcd_dot(n, f->normal) < -slack)
            return MEFALSE;
    }
    return f->count < 3 || !mcd_shapeIsKnown(s) || mcd_isUnit(f->normal) || mcd_dot(f->normal, f->normal) == 0;
}

void mcd_faceToward(const McdShape *s, const double direction[3], McdFace *f) {
    f->count = 0;
    f->id = 0;
    f->curvatureRadius = 0;
    f->isDisc = MEFALSE;
    mcd_set(f->normal, 0, 0, 0);
    s->kind->face(s, direction, f);
    MEASSERT(f->count >= 1 && f->count <= MCD_FACE_POINTS);
    MEVALIDATE(isFaceGood(s, f));
}

/* ---- intersection of the faces ------------------------------------------------------------------------- */

/* Projects a face; false for a polygon that is seen edge-on. */
static MeBool makeOutline(const McdView *v, const McdFace *f, MeBool isMirrored, McdOutline *o) {
    o->count = f->count;
    o->id = f->id;
    o->isDisc = f->isDisc;
    o->slopeX = o->slopeY = 0;
    for (int i = 0; i < f->count; i++) {
        const int from = isMirrored ? f->count - 1 - i : i;
        o->x[i] = mcd_dot(v->u, f->point[from]);
        o->y[i] = mcd_dot(v->w, f->point[from]);
        o->z[i] = mcd_dot(v->n, f->point[from]);
        o->name[i] = f->name[from];
    }
    if (f->count < 3)
        return METRUE;
    const double up = mcd_dot(f->normal, v->n), edgeOn = 1e-2; /* of a smaller cosine: not clipped */
    if (!(fabs(up) > edgeOn))
        return MEFALSE;
    o->slopeX = -mcd_dot(f->normal, v->u) / up;
    o->slopeY = -mcd_dot(f->normal, v->w) / up;
    return METRUE;
}

/* The remainder of outline a while b's edges clip it: corners of a, corners of b, and crossings of edges. One array
 * per member, since each value is read soon after it was written: a copy of a whole struct would stall until all its
 * stores are visible to loads. */
typedef struct Polygon {
    int count;
    double x[MCD_CANDIDATES + 1], y[MCD_CANDIDATES + 1]; /* one more than the maximum: see cutByEdge */
    double a[MCD_CANDIDATES + 1];                        /* height on a; used only where a is a line */
    MeU32 origin[MCD_CANDIDATES + 1];
} Polygon;

/* The origin of a corner, packed: index of the corner or edge of a (OF_A) and of b (OF_B) that it lies on, `none` if
 * it lies inside that outline; index of the edge that begins at it (EDGE_OF), whether that edge is b's (IS_EDGE_B),
 * and whether the corner is a crossing of two edges (IS_CROSS). */
enum { OF_A = 0, OF_B = 8, EDGE_OF = 16, IS_EDGE_B = 24, IS_CROSS = 25 }; /* bit positions */

static const MeU32 none = 255; /* no corner's index */
_Static_assert(MCD_FACE_POINTS <= 255, "an index of a corner is a byte");

static MeU32 indexAt(MeU32 origin, int bit) {
    return origin >> bit & 255;
}

static MeU32 isSet(MeU32 origin, int bit) {
    return origin >> bit & 1;
}

/* Selects one of two values without a branch: the condition is unpredictable. */
static MeU32 selectBits(MeU32 condition, MeU32 yes, MeU32 no) {
    return no ^ ((yes ^ no) & (0 - condition));
}

/* The origin of the corner where b's edge j crosses the polygon's edge that begins at a corner with the given
 * origin. If both are edges of b: their common corner. isIn: the given corner is inside edge j. */
static MeU32 originOfCross(MeU32 origin, MeU32 j, MeU32 edges, MeU32 isIn) {
    const MeU32 isB = isSet(origin, IS_EDGE_B), edge = indexAt(origin, EDGE_OF),
                after = edge + 1 < edges ? edge + 1 : 0;
    return selectBits(isB, none, edge) << OF_A | selectBits(isB & (j != after), edge, j) << OF_B |
           selectBits(isIn, j, edge) << EDGE_OF | (isB | isIn) << IS_EDGE_B | (isB ^ 1) << IS_CROSS;
}

/* The code of the outline's corner or edge `of`; if that is `none`, of its interior. */
static MeU32 codeOnOutline(const McdOutline *o, MeU32 of, MeU32 kind) {
    const MeU32 isSome = of != none, name = o->name[of & (0 - isSome)];
    return mcd_featureCode(selectBits(isSome, kind, INSIDE), o->id, selectBits(isSome, name, 0));
}

static MeU64 featureOf(MeU32 origin, const McdOutline *a, const McdOutline *b) {
    const MeU32 kind = isSet(origin, IS_CROSS) ? EDGE : CORNER;
    return mcd_featureOfPair(codeOnOutline(a, indexAt(origin, OF_A), kind),
                             codeOnOutline(b, indexAt(origin, OF_B), kind));
}

typedef struct Circle {
    double x, y, radius;
} Circle;

/* The bounding circle of an outline; of infinite radius for up to 4 corners, where testing it would cost more than
 * it saves. */
static Circle circleAround(const McdOutline *o) {
    Circle c = {0, 0, INFINITY};
    double max = 0;
    if (o->count <= 4)
        return c;
    for (int i = 0; i < o->count; i++) {
        c.x += o->x[i] / o->count;
        c.y += o->y[i] / o->count;
    }
    for (int i = 0; i < o->count; i++) {
        const double x = o->x[i] - c.x, y = o->y[i] - c.y;
        max = MeMAX(max, x * x + y * y);
    }
    c.radius = sqrt(max);
    return c;
}

/* Computes for each corner its signed distance from b's edge that begins at b's corner j, times the edge's length,
 * positive inside. Returns false if no corner is outside, which the bounding circle usually shows without the
 * distances. */
static MeBool isEdgeCutting(const Polygon *p, const Circle *around, const McdOutline *b, int j, double slack,
                            double *inside) {
    const int next = j + 1 < b->count ? j + 1 : 0;
    const double x = b->x[j], y = b->y[j], ex = b->x[next] - x, ey = b->y[next] - y, length = sqrt(ex * ex + ey * ey);
    double min = INFINITY;
    if (ex * (around->y - y) - ey * (around->x - x) >= around->radius * length)
        return MEFALSE; /* also for an edge without length */
    for (int i = 0; i < p->count; i++) {
        inside[i] = ex * (p->y[i] - y) - ey * (p->x[i] - x) + slack * length;
        min = MeMIN(min, inside[i]);
    }
    return !(min >= 0);
}

static void copyCorner(Polygon *to, int k, const Polygon *from, int i) {
    to->x[k] = from->x[i];
    to->y[k] = from->y[i];
    to->a[k] = from->a[i];
    to->origin[k] = from->origin[i];
}

/* Cuts off the part of the polygon outside of b's edge j (Sutherland and Hodgman). Which corners are inside is
 * unpredictable, so each corner is written, and overwritten by the next one if it is outside. An extra entry after
 * the last corner closes the polygon: a copy of the first corner, and its distance in `inside`. */
static void cutByEdge(Polygon *from, const double *inside, const McdOutline *b, int j, Polygon *to) {
    const int count = from->count;
    int made = 0;
    copyCorner(from, count, from, 0);
    for (int i = 0; i < count; i++) {
        const double dp = inside[i], dq = inside[i + 1];
        const int isIn = dp >= 0;
        copyCorner(to, made, from, i);
        made += isIn;
        if (isIn == (dq >= 0) || made == MCD_CANDIDATES - 1)
            continue;
        const double t = dp / (dp - dq);
        MEASSERT(t >= 0 && t <= 1); /* one end is inside, the other one outside */
        to->x[made] = from->x[i] + t * (from->x[i + 1] - from->x[i]);
        to->y[made] = from->y[i] + t * (from->y[i + 1] - from->y[i]);
        to->a[made] = from->a[i] + t * (from->a[i + 1] - from->a[i]);
        to->origin[made] = originOfCross(from->origin[i], (MeU32)j, (MeU32)b->count, (MeU32)isIn);
        made++;
    }
    to->count = made;
}

/* Clips polygon or line a by polygon b. */
static int clipPolygon(const McdOutline *a, const McdOutline *b, double slack, McdCandidate *candidate) {
    Polygon memory[2], *from = &memory[0], *to = &memory[1];
    double inside[MCD_CANDIDATES + 1];
    const Circle around = circleAround(a);
    from->count = a->count;
    for (int i = 0; i < a->count; i++) {
        from->x[i] = a->x[i];
        from->y[i] = a->y[i];
        from->a[i] = a->z[i];
        from->origin[i] = (MeU32)i << OF_A | none << OF_B | (MeU32)i << EDGE_OF;
    }
    for (int j = 0; j < b->count && from->count; j++) {
        if (!isEdgeCutting(from, &around, b, j, slack, inside))
            continue;
        inside[from->count] = inside[a->count > 2 ? 0 : from->count - 1];
        cutByEdge(from, inside, b, j, to);
        Polygon *const swap = from;
        from = to;
        to = swap;
    }
    MEASSERT(from->count >= 0 && from->count <= MCD_CANDIDATES);
    for (int i = 0; i < from->count; i++)
        candidate[i] = (McdCandidate){.x = from->x[i],
                                      .y = from->y[i],
                                      .a = a->count > 2 ? mcd_planeHeight(a, from->x[i], from->y[i]) : from->a[i],
                                      .b = mcd_planeHeight(b, from->x[i], from->y[i]),
                                      .feature = featureOf(from->origin[i], a, b)};
    return from->count;
}

static void swapCandidates(McdCandidate *candidate, int count) {
    for (int i = 0; i < count; i++) {
        const double a = candidate[i].a;
        candidate[i].a = candidate[i].b;
        candidate[i].b = a;
        candidate[i].feature = candidate[i].feature << 32 | candidate[i].feature >> 32;
    }
}

/* Two nearly parallel lines: candidates at the ends of the segment along which they overlap. At an offset across the
 * lines the round surfaces recede by radius - sqrt(radius^2 - offset^2), where `radius` is the sum of their radii. */
static int overlapLines(const McdOutline *a, const McdOutline *b, double radius, McdCandidate *candidate) {
    double ax = a->x[1] - a->x[0], ay = a->y[1] - a->y[0];
    double bx = b->x[1] - b->x[0], by = b->y[1] - b->y[0];
    const double la = hypot(ax, ay), lb = hypot(bx, by);
    if (!(la > 0 && lb > 0) || fabs(ax * by - ay * bx) > segmentSine * la * lb)
        return 0;
    ax /= la;
    ay /= la;
    const double t0 = (b->x[0] - a->x[0]) * ax + (b->y[0] - a->y[0]) * ay;
    const double t1 = (b->x[1] - a->x[0]) * ax + (b->y[1] - a->y[0]) * ay;
    const double begin = MeMAX(0, MeMIN(t0, t1)), end = MeMIN(la, MeMAX(t0, t1));
    if (!(begin < end))
        return 0;
    for (int i = 0; i < 2; i++) {
        const double t = i ? end : begin, tb = (t - t0) / (t1 - t0), ta = t / la;
        const double x = a->x[0] + t * ax, y = a->y[0] + t * ay;
        const double offset = hypot(b->x[0] + tb * bx - x, b->y[0] + tb * by - y);
        const double away = offset < radius ? radius - sqrt(radius * radius - offset * offset) : radius;
        const MeBool isA = i ? end == la : begin == 0;
        const MeU32 nameA = isA ? mcd_featureCode(CORNER, a->id, a->name[i]) : mcd_featureCode(INSIDE, a->id, 0);
        const MeU32 nameB = isA ? mcd_featureCode(INSIDE, b->id, 0)
                                : mcd_featureCode(CORNER, b->id, b->name[i ? t1 < t0 ? 0 : 1 : t1 < t0]);
        candidate[i] = (McdCandidate){.x = x + (b->x[0] + tb * bx - x) / 2,
                                      .y = y + (b->y[0] + tb * by - y) / 2,
                                      .a = a->z[0] + ta * (a->z[1] - a->z[0]) + away,
                                      .b = b->z[0] + tb * (b->z[1] - b->z[0]),
                                      .feature = mcd_featureOfPair(nameA, nameB)};
    }
    return 2;
}

/* Two lines that cross: the candidate is their crossing, where the witness points of a guessed normal coincide in
 * projection. */
static int crossLines(const McdOutline *a, const McdOutline *b, MeU64 feature, McdCandidate *candidate) {
    static const double half = .5 + 1e-9; /* half of a line's length, plus rounding */
    const double ax = a->x[1] - a->x[0], ay = a->y[1] - a->y[0], bx = b->x[1] - b->x[0], by = b->y[1] - b->y[0];
    const double x = b->x[0] - a->x[0], y = b->y[0] - a->y[0], area = ax * by - ay * bx;
    const double la = sqrt(ax * ax + ay * ay), lb = sqrt(bx * bx + by * by);
    if (!(fabs(area) > segmentSine * la * lb))
        return 0;
    const double s = (x * by - y * bx) / area, t = (x * ay - y * ax) / area;
    if (fabs(s - .5) > half || fabs(t - .5) > half)
        return 0;
    candidate[0] = (McdCandidate){.x = a->x[0] + s * ax,
                                  .y = a->y[0] + s * ay,
                                  .a = a->z[0] + s * (a->z[1] - a->z[0]),
                                  .b = b->z[0] + t * (b->z[1] - b->z[0]),
                                  .feature = feature};
    return 1;
}

static int clipFaces(const McdOutline *a, const McdOutline *b, double radius, double slack, McdCandidate *candidate) {
    if (a->count < 2 || b->count < 2)
        return 0;
    if (b->count > 2 && b->count <= MeMAX(a->count, 4))
        return clipPolygon(a, b, slack, candidate);
    if (a->count == 2 && b->count == 2)
        return overlapLines(a, b, radius, candidate);
    if (a->count == 2)
        return clipPolygon(a, b, slack, candidate);
    /* The face with fewer corners clips the other one: fewer passes. */
    const int count = clipPolygon(b, a, slack, candidate);
    swapCandidates(candidate, count);
    return count;
}

/* ---- reduction to four points ------------------------------------------------------------------------------------ */

static double planarDistanceSquared(const McdCandidate *p, const McdCandidate *q) {
    const double x = p->x - q->x, y = p->y - q->y;
    return x * x + y * y;
}

/* Removes candidates whose gap exceeds the margin, and duplicates. With more than 8 points, which are in the
 * polygon's order, only the previous and the first point are compared. */
static int dropFarAndDuplicates(McdCandidate *candidate, int count, double margin, double slack) {
    const double min = 16 * slack * slack;
    int kept = 0;
    for (int i = 0; i < count; i++) {
        int isNew = candidate[i].a - candidate[i].b <= margin;
        for (int j = 0; j < kept; j = j == 0 && count > 8 && kept > 1 ? kept - 1 : j + 1)
            isNew &= planarDistanceSquared(&candidate[i], &candidate[j]) > min;
        if (kept != i)
            candidate[kept] = candidate[i];
        kept += isNew;
    }
    return kept;
}

static double depthOf(const McdCandidate *s) {
    return s->b - s->a;
}

/* The candidate farthest from a point. Of candidates equal to within the slack the first one is chosen, so that a
 * body at rest keeps its contacts. */
static int farthestOf(const McdCandidate *candidate, int count, const McdCandidate *from, double slack) {
    int best = 0;
    double enough = slack * slack; /* (max + slack)^2 */
    for (int i = 0; i < count; i++) {
        const double squared = planarDistanceSquared(&candidate[i], from);
        if (squared > enough) {
            const double max = sqrt(squared) + slack;
            enough = max * max;
            best = i;
        }
    }
    return best;
}

static McdCandidate middleOf(const McdCandidate *candidate, int count) {
    McdCandidate middle = {.x = 0, .y = 0};
    for (int i = 0; i < count; i++) {
        middle.x += candidate[i].x / count;
        middle.y += candidate[i].y / count;
    }
    return middle;
}

/* Twice the signed area of a triangle, positive if counter-clockwise. */
static double areaOf(const McdCandidate *a, const McdCandidate *b, const McdCandidate *c) {
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* The candidate farthest from the line first-second on either side, left in best[0] and right in best[1]; -1: none. */
static void farthestBeside(const McdCandidate *candidate, int count, const McdCandidate *first,
                           const McdCandidate *second, double slack, int best[2]) {
    const double dx = second->x - first->x, dy = second->y - first->y, min = 4 * slack * sqrt(dx * dx + dy * dy);
    double max[2] = {min, min};
    best[0] = best[1] = -1;
    for (int i = 0; i < count; i++) {
        const double area = areaOf(first, second, &candidate[i]);
        const int side = area < 0;
        if (fabs(area) > max[side] * (1 + 1e-6)) {
            max[side] = fabs(area);
            best[side] = i;
        }
    }
}

static int deepestOf(const McdCandidate *candidate, int count) {
    int best = 0;
    for (int i = 1; i < count; i++)
        if (depthOf(&candidate[i]) > depthOf(&candidate[best]))
            best = i;
    return best;
}

/* If all kept points are shallower than the deepest candidate by more than the slack, that candidate replaces the
 * kept point nearest to it. */
static void includeDeepest(const McdCandidate *candidate, int count, McdCandidate *kept, int made, double slack) {
    const McdCandidate *deepest = &candidate[deepestOf(candidate, count)];
    int nearest = 0;
    for (int i = 0; i < made; i++) {
        if (depthOf(&kept[i]) >= depthOf(deepest) - slack)
            return;
        if (planarDistanceSquared(&kept[i], deepest) < planarDistanceSquared(&kept[nearest], deepest))
            nearest = i;
    }
    kept[nearest] = *deepest;
}

/* Adds a fourth point to a triangle of kept points: the candidate that enlarges its area most, beyond one of the two
 * sides at the third point. Returns the number of points. */
static int addFourthPoint(const McdCandidate *candidate, int count, McdCandidate *kept, double slack) {
    double max = 0;
    int best = -1;
    for (int k = 0; k < 2; k++) {
        int beside[2];
        farthestBeside(candidate, count, &kept[k], &kept[2], slack, beside);
        /* the triangle's remaining corner is on one side of this line; `beyond` is on the other */
        const double inside = areaOf(&kept[k], &kept[2], &kept[1 - k]);
        const int beyond = beside[inside >= 0];
        const double area = beyond >= 0 ? fabs(areaOf(&kept[k], &kept[2], &candidate[beyond])) : 0;
        if (area > max) {
            max = area;
            best = beyond;
        }
    }
    if (best >= 0)
        kept[3] = candidate[best];
    return best >= 0 ? 4 : 3;
}

/* Moves to the front the candidates whose depth is within `band`, or within tiltShare of the range of depths, of the
 * deepest. Returns their number. */
static int moveDeepestToFront(McdCandidate *candidate, int count, double band) {
    double deepest = -INFINITY, shallowest = INFINITY;
    int nearDeepest = 0;
    for (int i = 0; i < count; i++) {
        deepest = fmax(deepest, depthOf(&candidate[i]));
        shallowest = fmin(shallowest, depthOf(&candidate[i]));
    }
    const double min = deepest - fmax(band, tiltShare * (deepest - shallowest));
    for (int i = 0; i < count; i++)
        if (depthOf(&candidate[i]) >= min) {
            const McdCandidate c = candidate[i];
            memmove(&candidate[nearDeepest + 1], &candidate[nearDeepest],
                    (size_t)(i - nearDeepest) * sizeof *candidate);
            candidate[nearDeepest++] = c;
        }
    return nearDeepest;
}

/* Reduces to four points that support as well as all of them. Of the candidates near the deepest: the one farthest
 * from their centre, then the one farthest from that; then on each side of their line the farthest candidate, one
 * near the deepest if there is any. If one side is empty: the candidate that adds most area. A point that is deepest
 * only by rounding is not preferred: it could be the middle of an edge, and a corner would remain without support.
 * On a disc, which may roll on its rim, candidates of any depth are used.
 *
 * mcd_spread does not fit: here all points are in one plane, ties to within the slack must keep the contacts of
 * bodies at rest, and mcd_spread would make a pair a fifth slower. */
static int reduceToFour(McdCandidate *candidate, int count, MeBool isDisc, double size) {
    const double slack = mcd_slack * size;
    const int nearDeepest = isDisc ? count : moveDeepestToFront(candidate, count, carryingShare * size);
    const McdCandidate middle = middleOf(candidate, nearDeepest);
    McdCandidate kept[4];
    int of[2], all[2], made = 0;
    kept[made++] = candidate[farthestOf(candidate, nearDeepest, &middle, slack)];
    kept[made++] = candidate[farthestOf(candidate, nearDeepest > 1 ? nearDeepest : count, &kept[0], slack)];
    farthestBeside(candidate, nearDeepest, &kept[0], &kept[1], slack, of);
    farthestBeside(candidate, count, &kept[0], &kept[1], slack, all);
    for (int i = 0; i < 2; i++)
        if (all[i] >= 0)
            kept[made++] = candidate[of[i] >= 0 ? of[i] : all[i]];
    if (made == 3 && !isDisc)
        made = addFourthPoint(candidate, count, kept, slack);
    includeDeepest(candidate, count, kept, made, slack);
    memcpy(candidate, kept, (size_t)made * sizeof *candidate);
    return made;
}

/* ---- manifolds ------------------------------------------------------------------------------------------ */

/* Whether a candidate at (x, y, z) is at a vertex of the face. A corner of a disc is one sample of its rim, and the
 * rim's farthest point moves along it. The witness points of a proximity (SUPPORT) have no name: they are compared. */
static MeBool isAtVertex(const McdFace *f, MeU32 feature, const McdView *v, double x, double y, double z) {
    double point[3];
    if (mcd_isOfCap(feature))
        return METRUE;
    if (f->isDisc || mcd_featureKind(feature) != SUPPORT)
        return !f->isDisc && mcd_featureKind(feature) == CORNER;
    for (int k = 0; k < 3; k++)
        point[k] = v->u[k] * x + v->w[k] * y + v->n[k] * z;
    for (int i = 0; i < f->count; i++) {
        double offset[3];
        mcd_sub(offset, f->point[i], point);
        if (mcd_length(offset) <= 16 * v->slack)
            return METRUE;
    }
    return MEFALSE;
}

/* The radius of a shape's surface at a contact. Sampling takes long: once for all contacts of a normal. */
static double radiusAt(const McdShape *s, const double outward[3], const double position[3], const McdManifold *m,
                       int side) {
    return s->kind->isSampled && m->count > 1 ? m->point[0].radius[side] : mcd_surfaceRadius(s, outward, position);
}

static McdManifoldPoint *addContact(const McdShape *a, const McdShape *b, const McdView *v, const McdCandidate *s,
                                    McdManifold *m) {
    const double za = s->a - a->rounding, zb = s->b + b->rounding;
    McdManifoldPoint *p = &m->point[m->count++];
    for (int i = 0; i < 3; i++)
        p->position[i] = v->u[i] * s->x + v->w[i] * s->y + v->n[i] * ((za + zb) / 2);
    p->separation = za - zb;
    p->feature = s->feature;
    const double out[3] = {-v->n[0], -v->n[1], -v->n[2]};
    p->radius[0] = radiusAt(a, out, p->position, m, 0);
    p->radius[1] = radiusAt(b, v->n, p->position, m, 1);
    p->isVertex[0] = p->isVertex[1] = MEFALSE;
    return p;
}

/* A candidate midway between the witness points: the deepest contact, independent of the faces. */
static McdCandidate supportCandidate(const McdView *v, const McdProximity *p, MeU64 feature) {
    double middle[3];
    for (int i = 0; i < 3; i++)
        middle[i] = (p->onA[i] + p->onB[i]) / 2;
    const double z = mcd_dot(v->n, middle);
    return (McdCandidate){.x = mcd_dot(v->u, middle),
                          .y = mcd_dot(v->w, middle),
                          .a = z + p->separation / 2,
                          .b = z - p->separation / 2,
                          .feature = feature};
}

static McdView makeView(const McdShape *a, const McdShape *b, const McdProximity *p) {
    McdView v = {.n = p->normal, .slack = mcd_slack * mcd_pairSize(a, b)};
    mcd_basis(p->normal, v.u, v.w);
    return v;
}

static void startManifold(McdManifold *m, const double normal[3]) {
    mcd_copy(m->normal, normal);
    m->count = 0;
}

int mcd_pointManifold(const McdShape *a, const McdShape *b, const McdProximity *p, MeU64 feature, double margin,
                      McdManifold *m) {
    startManifold(m, p->normal);
    if (!(p->separation - a->rounding - b->rounding <= margin))
        return 0;
    const McdView v = makeView(a, b, p);
    const McdCandidate s = supportCandidate(&v, p, feature);
    addContact(a, b, &v, &s, m);
    return 1;
}

/* Whether a candidate's height on a face is as exact as its position: if the face is at less than 45 degrees to the
 * contact plane, and always at the ends of a line. */
static MeBool isHeightExact(const McdOutline *o, MeU32 feature) {
    if (o->count > 2)
        return o->slopeX * o->slopeX + o->slopeY * o->slopeY < 1;
    const double x = o->x[1] - o->x[0], y = o->y[1] - o->y[0], z = o->z[1] - o->z[0];
    return mcd_featureKind(feature) == CORNER || z * z < x * x + y * y;
}

/* Limits the depth of all candidates to the depth of the cores, which rounding (slack) lets them exceed on steep
 * faces. Returns the index of the deepest candidate; -1: there is none. */
static int clampSeparations(McdCandidate *candidate, int count, double separation) {
    double min = INFINITY;
    int deepest = -1;
    for (int i = 0; i < count; i++) {
        candidate[i].a = MeMAX(candidate[i].a, candidate[i].b + separation);
        const double gap = candidate[i].a - candidate[i].b;
        const int isLess = gap < min;
        min = isLess ? gap : min;
        deepest = isLess ? i : deepest;
    }
    return deepest;
}

/* For checks: features are unique, and separations are between that of the cores and the margin. */
static MeBool isManifoldGood(const McdShape *a, const McdShape *b, const McdProximity *p, double margin,
                             const McdManifold *m) {
    const double rounding = a->rounding + b->rounding;
    const double slack = preference * mcd_pairSize(a, b) + 1e-12 * fabs(p->separation);
    if (!mcd_areResolved(a, b))
        return METRUE;
    for (int i = 0; i < m->count; i++) {
        const McdManifoldPoint *point = &m->point[i];
        for (int j = 0; j < i; j++)
            if (m->point[j].feature == point->feature)
                return MEFALSE;
        if (point->separation < p->separation - rounding - slack || !(point->separation <= margin + slack) ||
            !(point->radius[0] >= 0 && point->radius[1] >= 0))
            return MEFALSE;
    }
    return METRUE;
}

int mcd_facesManifold(const McdShape *a, const McdShape *b, const McdFace *faceA, const McdFace *faceB,
                      const McdProximity *p, McdReach reach, McdManifold *m) {
    McdCandidate candidate[MCD_CANDIDATES], all[MCD_CANDIDATES];
    McdOutline outA, outB;
    const McdView v = makeView(a, b, p);
    const double size = mcd_pairSize(a, b);
    const double coreMargin = reach.margin + a->rounding + b->rounding;
    const MeU64 support =
        mcd_featureOfPair(mcd_featureCode(SUPPORT, faceA->id, 0), mcd_featureCode(SUPPORT, faceB->id, 0));
    int count = 0;
    outA.count = outB.count = 0;
    outA.id = outB.id = 0;
    outA.isDisc = outB.isDisc = MEFALSE;
    startManifold(m, p->normal);
    MEASSERT(isfinite(mcd_dot(p->normal, p->normal)) && !isnan(p->separation));
    MEASSERT(faceA->count > 0 && faceA->count <= MCD_FACE_POINTS && faceB->count > 0 &&
             faceB->count <= MCD_FACE_POINTS);
    /* The normal of b's face is along the contact normal, so its corners are counter-clockwise in projection; a's
     * face is mirrored. */
    if (makeOutline(&v, faceA, 1, &outA) && makeOutline(&v, faceB, 0, &outB))
        count = clipFaces(&outA, &outB, faceA->curvatureRadius + faceB->curvatureRadius + a->rounding + b->rounding,
                          v.slack, candidate);
    if (p->isGuess && outA.count == 2 && outB.count == 2 && count == 0)
        count = crossLines(&outA, &outB, support, candidate);
    count = dropFarAndDuplicates(candidate, count, coreMargin, v.slack);
    const int min = clampSeparations(candidate, count, p->separation);
    const double deficit = min < 0 ? INFINITY : candidate[min].a - candidate[min].b - p->separation;
    if (p->isGuess && !(deficit <= v.slack && isHeightExact(&outA, (MeU32)(candidate[min].feature >> 32)) &&
                        isHeightExact(&outB, (MeU32)candidate[min].feature)))
        return 0;
    /* Where a face's normal was preferred to a slightly better normal, the deepest candidate's separation has that
     * error: corrects it. */
    if (deficit <= preference * mcd_pairSize(a, b))
        candidate[min].a = candidate[min].b + p->separation;
    else if (p->separation <= coreMargin)
        candidate[count++] = supportCandidate(&v, p, support);
    const MeBool mayLand = (mcd_mayLand(a) || mcd_mayLand(b)) && reach.approach > mcd_mayEnter * size;
    const int allCount = mayLand ? count : 0;
    memcpy(all, candidate, (size_t)allCount * sizeof *all);
    if (count > MCD_FACE_CONTACTS)
        count = reduceToFour(candidate, count, faceA->isDisc || faceB->isDisc, size);
    if (mayLand && count > 0)
        count = mcd_addLanding(a, b, &outA, &outB, &v, reach, all, allCount, candidate, count);
    MEASSERT(count <= MCD_MANIFOLD_POINTS);
    for (int i = 0; i < count; i++) {
        const McdCandidate *c = &candidate[i];
        McdManifoldPoint *point = addContact(a, b, &v, c, m);
        point->isVertex[0] = isAtVertex(faceA, (MeU32)(c->feature >> 32), &v, c->x, c->y, c->a);
        point->isVertex[1] = isAtVertex(faceB, (MeU32)c->feature, &v, c->x, c->y, c->b);
    }
    MEVALIDATE(isManifoldGood(a, b, p, reach.margin, m));
    return m->count;
}

void mcd_manifoldSwap(McdManifold *m) {
    MEASSERT(m->count >= 0 && m->count <= MCD_MANIFOLD_POINTS);
    mcd_scale(m->normal, m->normal, -1);
    for (int i = 0; i < m->count; i++) {
        McdManifoldPoint *p = &m->point[i];
        const double radius = p->radius[0];
        p->radius[0] = p->radius[1];
        p->radius[1] = radius;
        const MeBool isVertex = p->isVertex[0];
        p->isVertex[0] = p->isVertex[1];
        p->isVertex[1] = isVertex;
        p->feature = p->feature << 32 | p->feature >> 32;
    }
}
