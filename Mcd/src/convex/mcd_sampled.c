/* Convex shapes that are known by their support function alone: support points, and what is measured when a shape gets
 * its data. */
#include "convex/mcd_sampled_i.h"

/* ---- support points ---------------------------------------------------------------------------------------------- */

MeProgramCall mcd_sampledEnter(void) {
    return MeProgramEnterQuiet("McdFrameworkRegisterConvexType");
}

/* Whether a support point can be one: finite, within the extent, not behind the middle by more than rounding. */
static MeBool isPossible(const McdSampled *s, const double direction[3], const double point[3]) {
    const double max = s->extent * (1 + 1e-6);
    return mcd_dot(point, point) <= max * max && mcd_heightOver(point, s->middle, direction) >= -1e-6 * s->extent;
}

void mcd_sampledWarn(const McdSampled *s) {
    if (atomic_exchange(&s->type->hasWarned, 1) == 0)
        MeWarning(
            1,
            "McdFrameworkRegisterConvexType: the support function of %s gave a point that is not finite, or not the "
            "farthest of the shape that it gave at its creation: after a change of its data call McdConvexSetData",
            s->type->name);
}

void mcd_sampledPoint(const McdSampled *s, const double direction[3], double point[3]) {
    mcd_set(point, NAN, NAN, NAN);
    s->type->functions.support(s->data, direction, point);
    if (s->extent == INFINITY) /* it is being measured */
        return;
    if (!isPossible(s, direction, point)) {
        mcd_copy(point, s->middle);
        mcd_sampledWarn(s);
    }
    const double height = mcd_heightOver(point, s->middle, direction);
    if (height < 0)
        mcd_mad(point, point, -height, direction); /* so that a box is never turned inside out */
}

void mcd_sampledCall(const McdSampled *s, const double direction[3], double point[3]) {
    const MeProgramCall before = mcd_sampledEnter();
    mcd_sampledPoint(s, direction, point);
    MeProgramLeave(&before);
}

void mcd_sampledBeside(const McdSampled *s, const double n[3], double k, const double along[3], double point[3]) {
    double d[3];
    mcd_mad(d, n, k, along);
    mcd_scale(d, d, 1 / mcd_length(d));
    mcd_sampledPoint(s, d, point);
}

void mcd_sampledDirection(const McdShape *s, const double direction[3], double own[3]) {
    mcd_shapeToOwnAxes(s, direction, own);
    const double length = mcd_length(own);
    if (length > 0 && length < INFINITY)
        mcd_scale(own, own, 1 / length);
    else
        mcd_set(own, 0, 0, 1);
}

void mcd_sampledSupport(const McdShape *s, const double direction[3], double point[3]) {
    double own[3], at[3];
    mcd_sampledDirection(s, direction, own);
    mcd_sampledCall(s->sampled, own, at);
    mcd_shapePoint(s, at[0], at[1], at[2], point);
}

double mcd_sampledHeight(const McdSampled *s, const double normal[3], const double point[3]) {
    double farthest[3];
    mcd_sampledPoint(s, normal, farthest);
    return mcd_heightOver(farthest, point, normal);
}

double mcd_sampledSlack(const McdSampled *s) {
    return fmax(mcd_slack * s->extent, 4 * s->noise);
}

double mcd_sampledExact(const McdSampled *s) {
    return fmax(1e-12 * s->extent, 4 * s->noise);
}

double mcd_sampledBesideFlat(const McdSampled *s) {
    return fmax(1e-6, 16 * s->noise / s->extent);
}

MeBool mcd_sampledEqual(const McdSampled *s, const double a[3], const double b[3]) {
    const double same = 4 * mcd_sampledSlack(s);
    return mcd_distanceSquared(a, b) <= same * same;
}

/* Directions of the ring lie between the axes, along which corners of a box are equally far. */
static const double turn[MCD_RING][2] = {
    {0.98006657784124163, 0.19866933079506122},   {0.82943599035157356, 0.55860177041386505},
    {0.55253129218685415, 0.83349215422481648},   {0.19150871349532253, 0.9814909131802324},
    {-0.19866933079506111, 0.98006657784124163},  {-0.55860177041386516, 0.82943599035157345},
    {-0.83349215422481648, 0.55253129218685404},  {-0.9814909131802324, 0.19150871349532236},
    {-0.98006657784124163, -0.19866933079506127}, {-0.82943599035157345, -0.55860177041386516},
    {-0.55253129218685404, -0.83349215422481648}, {-0.19150871349532286, -0.98149091318023229},
    {0.19866933079506122, -0.98006657784124163},  {0.55860177041386549, -0.82943599035157323},
    {0.83349215422481648, -0.55253129218685415},  {0.98149091318023229, -0.19150871349532292}};

void mcd_sampledRing(const McdSampled *s, const double n[3], double k, int count, double point[][3]) {
    double u[3], w[3];
    mcd_basis(n, u, w);
    for (int i = 0; i < count; i++) {
        const double *to = turn[i * (MCD_RING / count)];
        double along[3];
        mcd_scale(along, u, to[0]);
        mcd_mad(along, along, to[1], w);
        mcd_sampledBeside(s, n, k, along, point[i]);
    }
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
        mcd_sampledPoint(g->sampled, d, row[j]);
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
    const MeProgramCall before = mcd_sampledEnter();
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

static MeU32 flatFacesOf(const McdFeatures *k) {
    MeU32 faces = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < k->flats; j++)
            if ((i % 2 ? -1 : 1) * k->flat[j].normal[i / 2] >= 1 - mcd_slack * mcd_slack)
                faces |= 1u << i;
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
    const MeProgramCall before = mcd_sampledEnter();
    const double m = rounding ? rounding(s->data) : 0;
    MeProgramLeave(&before);
    return m;
}

/* m: how far the corners of a polyhedron are from the origin. */
static double farthestCorner(const McdFeatures *k) {
    double max = 0;
    for (int i = 0; i < k->corners; i++)
        max = fmax(max, mcd_length(k->corner[i]));
    return max;
}

/* m: by how much the points of directions side by side are farther in each other's direction than their own, at most.
 * Between directions so near a curved surface falls by 1e-10 of its radius, and support functions in double err by
 * 1e-15 of the extent. */
static double noiseOf(const McdSampled *s) {
    enum { COUNT = 128 };
    static const double between = 1e-5, evenTurn = 2.39996322972865332; /* rad: the golden angle */
    double noise = 0;
    for (int i = 0; i < COUNT; i++) {
        const double z = (2 * i + 1.) / COUNT - 1, aside = sqrt(1 - z * z), angle = evenTurn * i;
        const double d[3] = {aside * cos(angle), aside * sin(angle), z};
        double beside[3], axis[2][3], point[3], other[3];
        mcd_basis(d, axis[0], axis[1]);
        mcd_mad(beside, d, between, axis[0]);
        mcd_scale(beside, beside, 1 / mcd_length(beside));
        mcd_sampledPoint(s, d, point);
        mcd_sampledPoint(s, beside, other);
        noise = fmax(noise, fmax(mcd_heightOver(other, point, d), mcd_heightOver(point, other, beside)));
    }
    return noise;
}

/* Sets the noise, up to more than that of single precision. Beyond, the points are not those of one shape, which then
 * has no features. */
static void measureNoise(McdSampled *s, double extent) {
    static const double min = 1e-13, max = 1e-6; /* of the extent */
    const MeProgramCall before = mcd_sampledEnter();
    const double noise = noiseOf(s);
    MeProgramLeave(&before);
    s->isConsistent = noise <= max * extent;
    s->noise = s->isConsistent && noise > min * extent ? noise : 0;
    if (!s->isConsistent && atomic_exchange(&s->type->hasWarned, 1) == 0)
        MeWarning(1,
                  "McdFrameworkRegisterConvexType: the support function of %s gave points that are not the farthest of "
                  "one shape, by %g m: where it touches, there is one contact",
                  s->type->name, noise);
}

/* The features, and what follows from them; false, with an error: no memory. */
static MeBool measureFeatures(McdSampled *s) {
    const MeProgramCall before = mcd_sampledEnter();
    s->features = mcd_sampledFeatures(s);
    MeProgramLeave(&before);
    if (!s->features)
        return MEFALSE;
    s->flatFaces = flatFacesOf(s->features);
    if (s->features->isPolyhedron)
        s->extent = farthestCorner(s->features) + s->rounding + 4 * s->noise;
    return METRUE;
}

MeBool mcd_sampledMeasure(McdSampled *s) {
    enum { COUNT = 16 };
    static const double even[3] = {1, 1, 1};
    Extent e = {.isFinite = METRUE};
    s->features = 0;
    s->extent = INFINITY;
    s->rounding = roundingOf(s);
    if (!(s->rounding >= 0 && s->rounding <= (double)FLT_MAX))
        return MEFALSE;
    mcd_sampledTriangles(s, even, COUNT, measureTriangle, &e);
    /* Each direction is within sqrt(2) / COUNT of one of the grid's, in which the farthest point lies nearly as far. */
    const double extent = sqrt(e.max) / (1 - 1. / (COUNT * COUNT));
    if (!e.isFinite || !(extent >= (double)FLT_MIN && extent <= (double)FLT_MAX / 4))
        return MEFALSE;
    measureNoise(s, extent);
    s->extent = extent;
    mcd_scale(s->middle, e.sum, 1. / e.count);
    return measureFeatures(s);
}
