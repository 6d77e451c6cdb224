/* Convex shapes that are known by their support function alone: their faces, lines and curvature, by sampling.
 *
 * The support point s(n) in a direction n is constant while n stays within the normal cone of a vertex, and jumps
 * where n crosses the normal of a flat face or of a straight line of the surface. So support points in directions on a
 * narrow cone about n tell which of these is near: where the cone is made narrower,
 *
 *   the points around the normal of a flat face stay as far apart as the face is wide, in two dimensions;
 *   those around the normal of a line stay apart along the line, and come together across it;
 *   those of a surface that is curved in both directions come together.
 *
 * The plane through three of the points has the face's normal if the whole shape is below it; else it is a better
 * direction than the last one, and the cone is made narrower. So a face is found exactly, whatever its border is like,
 * and also if the direction is tilted against it. */
#include "convex/mcd_sampled_i.h"
#include <string.h>

enum { AROUND = 8, RIM = 16, ROUNDS = 9 };

/* Tangent of the cone's first angle: up to this tilt a face is found (as a disc's: mcd_discs.c). */
static const double wide = .05;
/* The cone is made narrower by this factor in each round. Points that come together by more than the square root of it
 * are on a curved surface, others on a face with a rounded border. */
static const double narrower = .25;
/* Tangent of the angle in which corners of a face are collected, m per m that these are below the face. */
static const double beside = 1e-5;
/* Tangent for differences of support points: the radius of curvature is exact to its square. */
static const double difference = 1e-3;

/* ---- support points ---------------------------------------------------------------------------------------------- */

/* Brackets calls of the program's function, one or many. */
static MeProgramCall enterProgram(void) {
    return MeProgramEnterQuiet("McdFrameworkRegisterConvexType");
}

/* Whether a support point can be one: finite, within the extent, not behind the middle by more than rounding. */
static MeBool isPossible(const McdSampled *s, const double direction[3], const double point[3]) {
    const double max = s->extent * (1 + 1e-6);
    return mcd_dot(point, point) <= max * max && mcd_heightOver(point, s->middle, direction) >= -1e-6 * s->extent;
}

static void warnOfPoint(const McdSampled *s) {
    if (atomic_exchange(&s->type->hasWarned, 1) == 0)
        MeWarning(
            1,
            "McdFrameworkRegisterConvexType: the support function of %s gave a point that is not finite, or not the "
            "farthest of the shape that it gave at its creation: after a change of its data call McdConvexSetData",
            s->type->name);
}

/* mcd_sampledCall within enterProgram. */
static void callSupport(const McdSampled *s, const double direction[3], double point[3]) {
    mcd_set(point, NAN, NAN, NAN);
    s->type->functions.support(s->data, direction, point);
    if (s->extent == INFINITY) /* it is being measured */
        return;
    if (!isPossible(s, direction, point)) {
        mcd_copy(point, s->middle);
        warnOfPoint(s);
    }
    const double height = mcd_heightOver(point, s->middle, direction);
    if (height < 0)
        mcd_mad(point, point, -height, direction); /* so that a box is never turned inside out */
}

void mcd_sampledCall(const McdSampled *s, const double direction[3], double point[3]) {
    const MeProgramCall before = enterProgram();
    callSupport(s, direction, point);
    MeProgramLeave(&before);
}

/* The support point in the direction n + k along, n and along of length 1 and orthogonal. */
static void supportBeside(const McdSampled *s, const double n[3], double k, const double along[3], double point[3]) {
    double d[3];
    mcd_mad(d, n, k, along);
    mcd_scale(d, d, 1 / mcd_length(d));
    callSupport(s, d, point);
}

/* A direction in the shape's own frame, of length 1; z for one without length. */
static void ownDirection(const McdShape *s, const double direction[3], double own[3]) {
    mcd_shapeToOwnAxes(s, direction, own);
    const double length = mcd_length(own);
    if (length > 0 && length < INFINITY)
        mcd_scale(own, own, 1 / length);
    else
        mcd_set(own, 0, 0, 1);
}

void mcd_sampledSupport(const McdShape *s, const double direction[3], double point[3]) {
    double own[3], at[3];
    ownDirection(s, direction, own);
    mcd_sampledCall(s->sampled, own, at);
    mcd_shapePoint(s, at[0], at[1], at[2], point);
}

/* ---- a cone of directions ---------------------------------------------------------------------------------------- */

/* Support points around a direction. */
typedef struct Ring {
    int count;
    double u[3], w[3]; /* across the direction */
    double point[RIM][3];
} Ring;

/* Directions of the ring lie between the axes, along which corners of a box are equally far. */
static const double firstAngle = .2;
static const double turn[RIM][2] = {
    {0.98006657784124163, 0.19866933079506122},   {0.82943599035157356, 0.55860177041386505},
    {0.55253129218685415, 0.83349215422481648},   {0.19150871349532253, 0.9814909131802324},
    {-0.19866933079506111, 0.98006657784124163},  {-0.55860177041386516, 0.82943599035157345},
    {-0.83349215422481648, 0.55253129218685404},  {-0.9814909131802324, 0.19150871349532236},
    {-0.98006657784124163, -0.19866933079506127}, {-0.82943599035157345, -0.55860177041386516},
    {-0.55253129218685404, -0.83349215422481648}, {-0.19150871349532286, -0.98149091318023229},
    {0.19866933079506122, -0.98006657784124163},  {0.55860177041386549, -0.82943599035157323},
    {0.83349215422481648, -0.55253129218685415},  {0.98149091318023229, -0.19150871349532292}};

static void sampleRing(const McdSampled *s, const double n[3], double tilt, int count, Ring *ring) {
    ring->count = count;
    mcd_basis(n, ring->u, ring->w);
    for (int i = 0; i < count; i++) {
        const double *to = turn[i * (RIM / count)];
        double along[3];
        mcd_scale(along, ring->u, to[0]);
        mcd_mad(along, along, to[1], ring->w);
        supportBeside(s, n, tilt, along, ring->point[i]);
    }
}

static int farthestFrom(const Ring *ring, const double point[3]) {
    int best = 0;
    for (int i = 1; i < ring->count; i++)
        if (mcd_distanceSquared(ring->point[i], point) > mcd_distanceSquared(ring->point[best], point))
            best = i;
    return best;
}

/* The two points that are far apart, and the one farthest from the line through them, seen along n. */
typedef struct Spread {
    const double *end[2], *aside;
    double length, width; /* m */
} Spread;

static Spread spreadOf(const Ring *ring, const double n[3]) {
    Spread spread;
    double line[3], normal[3];
    spread.end[0] = ring->point[farthestFrom(ring, ring->point[0])];
    spread.end[1] = spread.aside = ring->point[farthestFrom(ring, spread.end[0])];
    mcd_sub(line, spread.end[1], spread.end[0]);
    spread.length = mcd_length(line);
    spread.width = 0;
    mcd_cross(normal, n, line);
    for (int i = 0; i < ring->count && spread.length > 0; i++) {
        const double width = fabs(mcd_heightOver(ring->point[i], spread.end[0], normal)) / spread.length;
        if (width <= spread.width)
            continue;
        spread.width = width;
        spread.aside = ring->point[i];
    }
    return spread;
}

/* ---- flat faces -------------------------------------------------------------------------------------------------- */

/* The unit normal of the plane through the three points, on n's side; false: it is steep. */
static MeBool planeOf(const Spread *spread, const double n[3], double normal[3]) {
    double x[3], y[3];
    mcd_sub(x, spread->end[1], spread->end[0]);
    mcd_sub(y, spread->aside, spread->end[0]);
    mcd_cross(normal, x, y);
    const double length = mcd_length(normal);
    if (!(length > 0))
        return MEFALSE;
    mcd_scale(normal, normal, (mcd_dot(normal, n) < 0 ? -1 : 1) / length);
    return mcd_dot(normal, n) > 1 - wide * wide;
}

/* m: how far the shape is above the plane through a point. */
static double heightAbove(const McdSampled *s, const double normal[3], const double point[3]) {
    double farthest[3];
    callSupport(s, normal, farthest);
    return mcd_heightOver(farthest, point, normal);
}

/* Finds the normal of a flat face that is tilted by no more than `wide` against the direction n. `first`: the ring
 * about n. */
static MeBool findFacet(const McdSampled *s, const double n[3], const Ring *first, double normal[3]) {
    const double min = mcd_slack * s->extent;
    Ring ring = *first;
    double tilt = wide, before = 0;
    mcd_copy(normal, n);
    for (int round = 0; round < ROUNDS; round++) {
        const Spread spread = spreadOf(&ring, normal);
        if (spread.width <= 16 * min || spread.width < sqrt(narrower) * before || !planeOf(&spread, n, normal))
            return MEFALSE;
        if (heightAbove(s, normal, spread.end[0]) <= min)
            return METRUE;
        before = spread.width;
        tilt *= narrower;
        sampleRing(s, normal, tilt, AROUND, &ring);
    }
    return MEFALSE;
}

static MeBool areEqual(const McdSampled *s, const double a[3], const double b[3]) {
    const double same = 4 * mcd_slack * s->extent;
    return mcd_distanceSquared(a, b) <= same * same;
}

static void addPoint(const McdShape *s, McdFace *f, const double point[3], MeU32 name) {
    mcd_faceAdd(s, f, point[0], point[1], point[2], name);
}

/* Which place of the ring the direction n, tilted against the face, comes behind; -1: it is the face's. */
static int placeInRing(const Ring *ring, const double n[3]) {
    const double x = mcd_dot(n, ring->u), y = mcd_dot(n, ring->w);
    if (!(x * x + y * y > mcd_slack * mcd_slack))
        return -1;
    const double place = (atan2(y, x) - firstAngle) * (ring->count / 6.283185307179586);
    return mcd_floorBetween(place < 0 ? place + ring->count : place, 0, ring->count - 1);
}

/* The corners of the face. A rim is sampled; `farthest`, the support point in the direction n, is added to it. */
static void makeFacet(const McdShape *shape, const double n[3], const double normal[3], const double farthest[3],
                      McdFace *f) {
    enum { FARTHEST = MCD_FACE_POINTS - 1 };
    const McdSampled *s = shape->sampled;
    Ring ring;
    const double *last = 0;
    sampleRing(s, normal, beside, RIM, &ring);
    const int after = placeInRing(&ring, n);
    mcd_shapeDirection(shape, normal[0], normal[1], normal[2], f->normal);
    for (int i = 0; i < RIM; i++) {
        const double *point = ring.point[i], *next = ring.point[(i + 1) % RIM];
        if ((!last || !areEqual(s, point, last)) && !(i > 0 && areEqual(s, point, ring.point[0])))
            addPoint(shape, f, point, (MeU32)i);
        last = point;
        if (i == after && fabs(mcd_heightOver(farthest, point, normal)) <= mcd_slack * s->extent &&
            !areEqual(s, farthest, point) && !areEqual(s, farthest, next)) {
            addPoint(shape, f, farthest, FARTHEST);
            last = farthest;
        }
    }
    f->isDisc = f->count >= RIM;
}

/* ---- lines ------------------------------------------------------------------------------------------------------- */

/* A straight line of the surface. */
typedef struct Line {
    double end[2][3], along[3], normal[3], length;
} Line;

/* Sets the direction along the line, and the normal that is nearest to n; false: too steep. */
static MeBool alignLine(Line *line, const double n[3]) {
    mcd_sub(line->along, line->end[1], line->end[0]);
    line->length = mcd_length(line->along);
    if (!(line->length > 0))
        return MEFALSE;
    mcd_scale(line->along, line->along, 1 / line->length);
    const double up = mcd_dot(n, line->along);
    mcd_mad(line->normal, n, -up, line->along);
    mcd_scale(line->normal, line->normal, 1 / mcd_length(line->normal));
    return fabs(up) < 2 * wide;
}

static void sampleEnds(const McdSampled *s, Line *line, double tilt) {
    supportBeside(s, line->normal, -tilt, line->along, line->end[0]);
    supportBeside(s, line->normal, tilt, line->along, line->end[1]);
}

/* Finds the straight line of the surface whose normal is nearest to n. Rounded ends are approached from outside. */
static MeBool findLine(const McdSampled *s, const double n[3], const Spread *first, Line *line) {
    double tilt = wide, before = 0;
    MeBool isLine = MEFALSE;
    Line next;
    mcd_copy(next.end[0], first->end[0]);
    mcd_copy(next.end[1], first->end[1]);
    for (int round = 0; round < ROUNDS; round++) {
        if (!alignLine(&next, n) || next.length < sqrt(narrower) * before)
            break;
        const double height = heightAbove(s, next.normal, next.end[0]);
        if (height <= mcd_slack * s->extent) {
            isLine = METRUE;
            *line = next;
        }
        if (height <= 1e-12 * s->extent)
            break;
        before = next.length;
        tilt *= narrower;
        sampleEnds(s, &next, tilt);
    }
    return isLine;
}

/* m: the radius of curvature of the surface with the normal n in the direction across. */
static double radiusAcross(const McdSampled *s, const double n[3], const double across[3], double tilt) {
    double p[3], q[3];
    supportBeside(s, n, tilt, across, p);
    supportBeside(s, n, -tilt, across, q);
    mcd_sub(p, p, q);
    return fmax(mcd_dot(p, across), 0) * (sqrt(1 + tilt * tilt) / (2 * tilt));
}

/* The ends are named in the order of the coordinate in which they differ most. */
static void makeLine(const McdShape *shape, const Line *line, McdFace *f) {
    const double *along = line->along;
    double across[3];
    int k = fabs(along[1]) > fabs(along[0]);
    k = fabs(along[2]) > fabs(along[k]) ? 2 : k;
    const int low = along[k] < 0;
    mcd_cross(across, line->normal, along);
    mcd_shapeDirection(shape, line->normal[0], line->normal[1], line->normal[2], f->normal);
    f->curvatureRadius = radiusAcross(shape->sampled, line->normal, across, difference);
    addPoint(shape, f, line->end[low], 0);
    addPoint(shape, f, line->end[!low], 1);
}

/* ---- faces, lines, points ---------------------------------------------------------------------------------------- */

/* A number of a direction, which changes with its longest coordinate. */
static MeU32 sideOf(const double n[3]) {
    int k = fabs(n[1]) > fabs(n[0]);
    k = fabs(n[2]) > fabs(n[k]) ? 2 : k;
    return (MeU32)(2 * k + (n[k] < 0));
}

static MeBool isSharp(const McdSampled *s, const double farthest[3], const Ring *ring) {
    for (int i = 0; i < ring->count; i++)
        if (!areEqual(s, ring->point[i], farthest))
            return MEFALSE;
    return METRUE;
}

static void findFace(const McdShape *shape, const double direction[3], McdFace *f) {
    enum { POINT, LINE = 8, FACET = 16 };
    const McdSampled *s = shape->sampled;
    double n[3], farthest[3], normal[3];
    Ring ring;
    Line line;
    ownDirection(shape, direction, n);
    callSupport(s, n, farthest);
    sampleRing(s, n, wide, AROUND, &ring);
    if (isSharp(s, farthest, &ring)) {
        addPoint(shape, f, farthest, 0);
        return;
    }
    const Spread spread = spreadOf(&ring, n);
    if (findFacet(s, n, &ring, normal)) {
        f->id = FACET + sideOf(normal);
        makeFacet(shape, n, normal, farthest, f);
        if (f->count > 2)
            return;
        f->count = 0;
    }
    if (findLine(s, n, &spread, &line)) {
        f->id = LINE + sideOf(line.normal);
        makeLine(shape, &line, f);
        return;
    }
    f->id = POINT;
    f->isDisc = METRUE; /* the point moves along the surface */
    mcd_set(f->normal, 0, 0, 0);
    addPoint(shape, f, farthest, 0);
}

void mcd_sampledFace(const McdShape *s, const double direction[3], McdFace *f) {
    const MeProgramCall before = enterProgram();
    findFace(s, direction, f);
    MeProgramLeave(&before);
}

/* ---- curvature --------------------------------------------------------------------------------------------------- */

/* m: the radius of curvature in a direction across the normal n; 0: there is a corner, or a flat face or line, at which
 * support points jump. */
static double smoothRadius(const McdSampled *s, const double n[3], const double across[3]) {
    static const double same = 1e-2; /* twice as much for what jumps */
    const double radius = radiusAcross(s, n, across, difference);
    return radius > difference * s->extent && fabs(radiusAcross(s, n, across, difference / 2) - radius) <= same * radius
               ? radius
               : 0;
}

/* The direction in which the contact moves over the surface as the shape turns; false: it does not turn. */
static MeBool rollingDirection(const McdShape *shape, const double outward[3], double across[3]) {
    double spin[3], moves[3];
    if (!shape->spin)
        return MEFALSE;
    mcd_fromReal(spin, shape->spin);
    mcd_cross(moves, outward, spin);
    const double speed = mcd_length(moves);
    if (!(speed > 0 && speed < INFINITY))
        return MEFALSE;
    mcd_scale(moves, moves, 1 / speed);
    ownDirection(shape, moves, across);
    return METRUE;
}

/* The radius of curvature in the direction in which the shape rolls; the mean one if it does not; across a line, if it
 * tilts over that. */
static double radiusAlong(const McdShape *shape, const double outward[3]) {
    const McdSampled *s = shape->sampled;
    McdFace face = {.count = 0};
    double n[3], u[3], w[3];
    ownDirection(shape, outward, n);
    mcd_basis(n, u, w);
    const MeBool rolls = rollingDirection(shape, outward, w);
    const double along = smoothRadius(s, n, w), across = rolls || along == 0 ? along : smoothRadius(s, n, u);
    if (across > 0)
        return s->rounding + (along + across) / 2;
    findFace(shape, outward, &face);
    return s->rounding + (face.count == 2 ? face.curvatureRadius : 0);
}

double mcd_sampledRadius(const McdShape *s, const double outward[3], const double point[3]) {
    const MeProgramCall before = enterProgram();
    const double radius = radiusAlong(s, outward);
    MeProgramLeave(&before);
    (void)point;
    return radius;
}

/* ---- the whole shape --------------------------------------------------------------------------------------------- */

void mcd_sampledBox(const McdSampled *s, double centre[3], double half[3]) {
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        double n[3] = {0, 0, 0}, high[3], low[3];
        n[i] = 1;
        mcd_sampledCall(s, n, high);
        n[i] = -1;
        mcd_sampledCall(s, n, low);
        centre[i] = (high[i] + low[i]) / 2;
        half[i] = fabs(high[i] - low[i]) / 2 + s->rounding;
        longest = fmax(longest, half[i]);
    }
    for (int i = 0; i < 3; i++)
        half[i] = fmax(half[i], 1e-3 * longest);
}

typedef struct Grid {
    const McdSampled *sampled;
    double stretch[3];
    int sign[3], count;
} Grid;

/* The support points with the rounding of row i. */
static void gridRow(const Grid *g, int i, double row[][3]) {
    for (int j = 0; j <= g->count - i; j++) {
        const double at[3] = {i, j, g->count - i - j};
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = g->sign[k] * at[k] * g->stretch[k] + 0.; /* no -0: octants agree about directions between them */
        mcd_scale(d, d, 1 / mcd_length(d));
        callSupport(g->sampled, d, row[j]);
        mcd_mad(row[j], row[j], g->sampled->rounding, d);
    }
}

static void visitTriangle(const double a[3], const double b[3], const double c[3], MeBool isMirrored,
                          McdSampledVisit visit, void *context) {
    double corner[3][3];
    mcd_copy(corner[0], a);
    mcd_copy(corner[1], isMirrored ? c : b);
    mcd_copy(corner[2], isMirrored ? b : c);
    visit(context, mcd_constRows(corner));
}

static void visitOctant(const Grid *g, McdSampledVisit visit, void *context) {
    double memory[2][MCD_GRID + 1][3];
    const MeBool isMirrored = g->sign[0] * g->sign[1] * g->sign[2] < 0;
    gridRow(g, 0, memory[0]);
    for (int i = 0; i < g->count; i++) {
        double(*row)[3] = memory[i % 2], (*next)[3] = memory[(i + 1) % 2];
        gridRow(g, i + 1, next);
        for (int j = 0; j < g->count - i; j++) {
            visitTriangle(row[j], next[j], row[j + 1], isMirrored, visit, context);
            if (j + 1 < g->count - i)
                visitTriangle(next[j], next[j + 1], row[j + 1], isMirrored, visit, context);
        }
    }
}

void mcd_sampledTriangles(const McdSampled *s, const double half[3], int count, McdSampledVisit visit, void *context) {
    const MeProgramCall before = enterProgram();
    MEASSERT(count > 0 && count <= MCD_GRID);
    for (int octant = 0; octant < 8; octant++) {
        Grid g = {.sampled = s, .count = count};
        for (int k = 0; k < 3; k++) {
            g.sign[k] = octant >> k & 1 ? -1 : 1;
            g.stretch[k] = 1 / half[k];
        }
        visitOctant(&g, visit, context);
    }
    MeProgramLeave(&before);
}

static MeU32 flatFacesOf(const McdSampled *s) {
    const MeProgramCall before = enterProgram();
    MeU32 faces = 0;
    for (int i = 0; i < 6; i++) {
        double n[3] = {0, 0, 0}, normal[3];
        Ring ring;
        n[i / 2] = i % 2 ? -1 : 1;
        sampleRing(s, n, wide, AROUND, &ring);
        if (findFacet(s, n, &ring, normal) && mcd_dot(normal, n) >= 1 - mcd_slack * mcd_slack)
            faces |= 1u << i;
    }
    MeProgramLeave(&before);
    return faces;
}

typedef struct Extent {
    double max, sum[3]; /* max: squared */
    int count;
    MeBool isFinite;
} Extent;

static void measureTriangle(void *context, const double corner[3][3]) {
    Extent *e = context;
    for (int i = 0; i < 3; i++) {
        const double squared = mcd_dot(corner[i], corner[i]);
        e->max = squared > e->max ? squared : e->max;
        mcd_mad(e->sum, e->sum, 1, corner[i]);
        e->count++;
        e->isFinite = e->isFinite && mcd_isInRange3(corner[i]);
    }
}

static double roundingOf(const McdSampled *s) {
    const McdConvexRoundingFn rounding = s->type->functions.rounding;
    const MeProgramCall before = enterProgram();
    const double m = rounding ? rounding(s->data) : 0;
    MeProgramLeave(&before);
    return m;
}

MeBool mcd_sampledMeasure(McdSampled *s) {
    enum { COUNT = 16 };
    static const double even[3] = {1, 1, 1};
    Extent e = {.isFinite = METRUE};
    s->extent = INFINITY;
    s->rounding = roundingOf(s);
    if (!(s->rounding >= 0 && s->rounding <= (double)FLT_MAX))
        return MEFALSE;
    mcd_sampledTriangles(s, even, COUNT, measureTriangle, &e);
    /* Each direction is within sqrt(2) / COUNT of one of the grid's, in which the farthest point lies nearly as far. */
    s->extent = sqrt(e.max) / (1 - 1. / (COUNT * COUNT));
    if (!e.isFinite || !(s->extent >= (double)FLT_MIN && s->extent <= (double)FLT_MAX / 4))
        return MEFALSE;
    mcd_scale(s->middle, e.sum, 1. / e.count);
    s->flatFaces = flatFacesOf(s);
    return METRUE;
}
