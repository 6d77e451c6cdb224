/* Convex shapes at a place: how geometries become them, and their farthest points. */
#include "mcd_geometries.h"
#include "mcd_vector.h"

#include <string.h>

/* Below this many corners, looking at all of them is faster than walking along the edges. */
enum { SCANNED_CORNERS = 24 };

/* Planes have boxes without end, and a box may be older than the transform or not a number. */
static double middleOf(double lower, double upper) {
    const double middle = (lower + upper) / 2;
    return isfinite(middle) ? middle : 0;
}

void mcd_pairOrigin(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3]) {
    for (int i = 0; i < 3; i++)
        origin[i] = middleOf(MeMAX(ins1->min[i], ins2->min[i]), MeMIN(ins1->max[i], ins2->max[i]));
    MEASSERT(isfinite(origin[0]) && isfinite(origin[1]) && isfinite(origin[2]));
}

/* ---- from geometries --------------------------------------------------------------------------------------- */

static MeBool areAxesRigid(const double axis[3][3]) {
    double x[3];
    mcd_cross(x, axis[0], axis[1]);
    return mcd_isUnit(axis[0]) && mcd_isUnit(axis[1]) && mcd_isUnit(axis[2]) && fabs(mcd_dot(x, axis[2]) - 1) < 1e-9;
}

MeBool mcd_shapeIsRigid(const McdShape *s) {
    return areAxesRigid(s->axis);
}

/* What single precision has rounded becomes as square as double can tell, so that a box's faces are across its axes:
 * R + (I - R R^T) R / 2, one step towards the nearest rotation. Other matrices are left as they are. */
static void squareAxes(double axis[3][3]) {
    static const double rounded = 1e-5, square = 1e-13;
    double off[3][3], old[3][3], most = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            off[i][j] = off[j][i] = (i == j) - mcd_dot(axis[i], axis[j]);
            most = MeMAX(most, fabs(off[i][j]));
        }
    if (most < square || most > rounded)
        return;
    memcpy(old, axis, sizeof old);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            mcd_mad(axis[i], axis[i], off[i][j] / 2, old[j]);
    MEASSERT(fabs(mcd_dot(axis[0], axis[1])) < 1e-9 && mcd_isUnit(axis[2])); /* the error is squared */
}

static MeBool place(McdShape *s, const MeMatrix4 tm, const double origin[3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            s->axis[i][j] = (double)tm[i][j];
            sum += fabs(s->axis[i][j]);
        }
        s->place[i] = (double)tm[3][i] - origin[i];
        sum += fabs(s->place[i]);
    }
    if (!isfinite(sum))
        return 0;
    squareAxes(s->axis);
    return 1;
}

static void setSize(McdShape *s, double x, double y, double z) {
    mcd_set(s->size, x, y, z);
    s->extent = sqrt(x * x + y * y + z * z);
}

static void setRound(McdShape *s, double radius, double halfHeight) {
    mcd_set(s->size, 0, 0, halfHeight);
    s->rounding = radius;
    s->extent = radius + halfHeight;
}

static void setCylinder(McdShape *s, const McdCylinder *g) {
    mcd_set(s->size, g->radius, g->radius, g->halfHeight);
    s->extent = hypot(g->radius, g->halfHeight);
}

static void setCone(McdShape *s, const McdCone *g) {
    const double low = g->lowerHeight, high = (double)g->length - low;
    mcd_set(s->size, g->lowerRadius, g->upperRadius, g->length);
    s->low = low;
    s->extent = MeMAX(hypot(g->lowerRadius, low), hypot(g->upperRadius, high));
}

static void setHull(McdShape *s, const McdConvexMesh *g) {
    s->hull = g->hull;
    s->rounding = g->fatness;
    s->extent = mcd_length(g->hull->centre) + g->hull->extent + s->rounding;
}

MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape) {
    memset(shape, 0, sizeof *shape);
    shape->type = g->type;
    if (!mcd_isPlace(tm) || !place(shape, tm, origin))
        return 0;
    switch (g->type) {
    case kMcdGeometryTypeSphere:
        setRound(shape, ((const McdSphere *)g)->radius, 0);
        return 1;
    case kMcdGeometryTypeBox: {
        const MeReal *r = ((const McdBox *)g)->radii;
        setSize(shape, r[0], r[1], r[2]);
        return 1;
    }
    case kMcdGeometryTypeCylinder:
        setCylinder(shape, (const McdCylinder *)g);
        return 1;
    case kMcdGeometryTypeSphyl:
        setRound(shape, ((const McdSphyl *)g)->radius, ((const McdSphyl *)g)->halfHeight);
        return 1;
    case kMcdGeometryTypeCone:
        setCone(shape, (const McdCone *)g);
        return 1;
    case kMcdGeometryTypeConvexMesh:
        if (!((const McdConvexMesh *)g)->hull)
            return 0;
        setHull(shape, (const McdConvexMesh *)g);
        return 1;
    default:
        return 0;
    }
}

MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape) {
    return mcd_shapeAt(ins->geometry, (const MeReal(*)[4])mcd_instanceTM(ins), origin, shape);
}

void mcd_triangleShape(const double corners[3][3], McdShape *shape) {
    memset(shape, 0, sizeof *shape);
    shape->type = MCD_SHAPE_TRIANGLE;
    for (int i = 0; i < 3; i++) {
        shape->axis[i][i] = 1;
        mcd_copy(shape->corner[i], corners[i]);
        for (int j = 0; j < 3; j++)
            shape->place[j] += corners[i][j] / 3;
    }
    for (int i = 0; i < 3; i++)
        shape->extent = MeMAX(shape->extent, sqrt(mcd_distanceSquared(corners[i], shape->place)));
}

/* ---- farthest points --------------------------------------------------------------------------------------- */

static void toWorld(const McdShape *s, double x, double y, double z, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = s->place[i] + (s->axis[0][i] * x + s->axis[1][i] * y + s->axis[2][i] * z);
}

static int farthestOfAll(const McdHull *h, const double d[3]) {
    int best = 0;
    double most = mcd_dot(h->vertex[0], d);
    for (int i = 1; i < h->vertexCount; i++) {
        const double x = mcd_dot(h->vertex[i], d);
        if (x > most) {
            most = x;
            best = i;
        }
    }
    return best;
}

/* On a convex polyhedron a corner that no neighbour beats is the farthest of all. */
static int farthestByClimbing(const McdHull *h, const double d[3]) {
    int here = 0, next = 0;
    double most = mcd_dot(h->vertex[0], d);
    do {
        here = next;
        for (int i = h->neighbourFirst[here]; i < h->neighbourFirst[here + 1]; i++) {
            const double x = mcd_dot(h->vertex[h->neighbour[i]], d);
            if (x > most) {
                most = x;
                next = h->neighbour[i];
            }
        }
    } while (next != here);
    /* Corners that flatness let vanish are missing from the walk: local bests may be that much below. */
    MEVALIDATE(most >= mcd_dot(h->vertex[farthestOfAll(h, d)], d) - 1e-6 * h->extent * mcd_length(d));
    return here;
}

static void hullSupport(const McdShape *s, const double d[3], double point[3]) {
    const double own[3] = {mcd_dot(s->axis[0], d), mcd_dot(s->axis[1], d), mcd_dot(s->axis[2], d)};
    const McdHull *h = s->hull;
    const int i = h->vertexCount <= SCANNED_CORNERS ? farthestOfAll(h, own) : farthestByClimbing(h, own);
    toWorld(s, h->vertex[i][0], h->vertex[i][1], h->vertex[i][2], point);
}

/* The rim's radius at the bottom and at the top, and where these are. */
static void discsSupport(const McdShape *s, const double d[3], double lower, double upper, double bottom, double top,
                         double point[3]) {
    const double x = mcd_dot(s->axis[0], d), y = mcd_dot(s->axis[1], d), z = mcd_dot(s->axis[2], d);
    const double across = sqrt(x * x + y * y);
    const MeBool isTop = top * z + upper * across >= bottom * z + lower * across;
    const double radius = isTop ? upper : lower, k = across > 0 ? radius / across : 0;
    toWorld(s, across > 0 ? x * k : radius, y * k, isTop ? top : bottom, point);
}

static void triangleSupport(const McdShape *s, const double d[3], double point[3]) {
    int best = 0;
    for (int i = 1; i < 3; i++)
        if (mcd_dot(s->corner[i], d) > mcd_dot(s->corner[best], d))
            best = i;
    mcd_copy(point, s->corner[best]);
}

void mcd_coreSupport(const McdShape *s, const double d[3], double point[3]) {
    switch (s->type) {
    case kMcdGeometryTypeBox:
        toWorld(s, copysign(s->size[0], mcd_dot(s->axis[0], d)), copysign(s->size[1], mcd_dot(s->axis[1], d)),
                copysign(s->size[2], mcd_dot(s->axis[2], d)), point);
        break;
    case kMcdGeometryTypeCylinder:
        discsSupport(s, d, s->size[0], s->size[0], -s->size[2], s->size[2], point);
        break;
    case kMcdGeometryTypeCone:
        discsSupport(s, d, s->size[0], s->size[1], -s->low, s->size[2] - s->low, point);
        break;
    case kMcdGeometryTypeSphyl:
        toWorld(s, 0, 0, copysign(s->size[2], mcd_dot(s->axis[2], d)), point);
        break;
    case kMcdGeometryTypeConvexMesh:
        hullSupport(s, d, point);
        break;
    case MCD_SHAPE_TRIANGLE:
        triangleSupport(s, d, point);
        break;
    default:
        mcd_copy(point, s->place);
    }
}

/* Is the point no farther from the shape's place than its extent says? */
static MeBool isWithinExtent(const McdShape *s, const double point[3]) {
    const double most = s->extent * (1 + 1e-6) + 4 * DBL_EPSILON * mcd_length(s->place);
    return !mcd_shapeIsRigid(s) || mcd_distanceSquared(point, s->place) <= most * most;
}

void mcd_support(const McdShape *s, const double direction[3], double point[3]) {
    mcd_coreSupport(s, direction, point);
    mcd_mad(point, point, s->rounding, direction);
    MEVALIDATE(!mcd_isUnit(direction) || isWithinExtent(s, point));
}

/* ---- round surfaces ---------------------------------------------------------------------------------------- */

/* The side of a cylinder or cone: its normal has the same part along the axis everywhere, and meets the axis at the
 * middle of its curvature across. */
static double sideRadius(const McdShape *s, double lower, double upper, double bottom, double top,
                         const double outward[3], const double point[3]) {
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

double mcd_surfaceRadius(const McdShape *s, const double outward[3], const double point[3]) {
    switch (s->type) {
    case kMcdGeometryTypeCylinder:
        return sideRadius(s, s->size[0], s->size[0], -s->size[2], s->size[2], outward, point);
    case kMcdGeometryTypeCone:
        return sideRadius(s, s->size[0], s->size[1], -s->low, s->size[2] - s->low, outward, point);
    default:
        return s->rounding;
    }
}
