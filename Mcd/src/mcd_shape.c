/* Convex shapes at a place: made from geometries, and their support points. */
#include "mcd_kind_i.h"
#include "mcd_vector_i.h"

#include <string.h>

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
        return MEFALSE;
    squareAxes(s->axis);
    return METRUE;
}

MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape) {
    const McdKind *kind = mcd_kindOf(g);
    if (!kind || !kind->setShape || !mcd_isPlace(tm))
        return MEFALSE;
    memset(shape, 0, sizeof *shape);
    shape->kind = kind;
    if (!place(shape, tm, origin))
        return MEFALSE;
    kind->setShape(g, shape);
    MEASSERT(shape->rounding >= 0 && !(shape->extent < shape->rounding));
    return METRUE;
}

MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape) {
    return mcd_shapeAt(ins->geometry, (const MeReal(*)[4])mcd_instanceTM(ins), origin, shape);
}

/* ---- farthest points --------------------------------------------------------------------------------------- */

void mcd_coreSupport(const McdShape *s, const double d[3], double point[3]) {
    s->kind->support(s, d, point);
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

double mcd_surfaceRadius(const McdShape *s, const double outward[3], const double point[3]) {
    return s->kind->radius ? s->kind->radius(s, outward, point) : s->rounding;
}
