/* World-space convex shapes of geometries, instances and models. */
#include "convex/mcd_vector_i.h"
#include "model/mcd_result_i.h"
#include <string.h>

/* The middle of an interval; 0 if that is not finite: boxes of planes are infinite, and a program's box may be NaN. */
static double middleOf(double lower, double upper) {
    const double middle = (lower + upper) / 2;
    return isfinite(middle) ? middle : 0;
}

void mcd_pairOrigin(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3]) {
    for (int i = 0; i < 3; i++)
        origin[i] = middleOf(MeMAX(ins1->min[i], ins2->min[i]), MeMIN(ins1->max[i], ins2->max[i]));
    MEASSERT(isfinite(origin[0]) && isfinite(origin[1]) && isfinite(origin[2]));
}

void mcd_halfSpaceAt(const MeVector4 *tm, const double origin[3], double normal[3], double *offset) {
    *offset = 0;
    mcd_fromReal(normal, tm[2]);
    for (int i = 0; i < 3; i++)
        *offset += normal[i] * ((double)tm[3][i] - origin[i]);
}

MeBool mcd_shapeSizes(McdGeometryID g, McdShape *s) {
    s->kind = mcd_kindOf(g);
    if (!s->kind || !s->kind->setShape) {
        s->kind = 0;
        return MEFALSE;
    }
    mcd_set(s->size, 0, 0, 0);
    s->low = s->rounding = s->extent = 0;
    s->hull = 0;
    s->sampled = 0;
    s->spin = 0;
    s->kind->setShape(g, s);
    MEASSERT(s->rounding >= 0 && !(s->extent < s->rounding));
    return METRUE;
}

/* Sets everything but the axes, and corners, which only triangles have. False: not a convex shape, or not finite. */
static MeBool setShapeExceptAxes(McdGeometryID g, const McdModelRecord *m, const MeReal place[3],
                                 const double origin[3], McdShape *s) {
    if (!mcd_shapeSizes(g, s))
        return MEFALSE;
    if (m && s->kind->isSampled)
        s->spin = m->angularVelocity;
    for (int i = 0; i < 3; i++)
        s->place[i] = (double)place[i] - origin[i];
    return isfinite(s->place[0] + s->place[1] + s->place[2]);
}

static MeBool shapeOfModelAt(McdGeometryID g, const McdModelRecord *m, const MeMatrix4 tm, const double origin[3],
                             McdShape *shape) {
    if (!mcd_isValidTransform(tm) || !setShapeExceptAxes(g, m, tm[3], origin, shape))
        return MEFALSE;
    mcd_shapeAxes(tm, shape->axis);
    return METRUE;
}

MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape) {
    return shapeOfModelAt(g, 0, tm, origin, shape);
}

MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape) {
    const McdModelRecord *m = mcd_record(ins->model);
    if (ins->parent && !ins->firstChild && ins->isPlaced) {
        memcpy(shape->axis, ins->placedAxis, sizeof shape->axis);
        return setShapeExceptAxes(ins->geometry, m, ins->placed[3], origin, shape);
    }
    if (!m || ins != &m->instance || !mcd_isPlacedAsCompared(m))
        return shapeOfModelAt(ins->geometry, m, (const MeReal(*)[4])mcd_instanceTM(ins), origin, shape);
    memcpy(shape->axis, m->shape.axis, sizeof shape->axis);
    return setShapeExceptAxes(ins->geometry, m, ins->tm[3], origin, shape);
}

MeBool mcd_shapesOf(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3], McdShape *a,
                    McdShape *b) {
    mcd_pairOrigin(ins1, ins2, origin);
    return mcd_shapeOf(ins1, origin, a) && mcd_shapeOf(ins2, origin, b);
}

/* For checks: whether the pose is the one that was compared. A callback of the program may since have changed the
 * transform, or the sizes: those count in the next round, so that all pairs of a round see the same shape. */
static MeBool isPoseAsCompared(const McdModelRecord *m) {
    double axis[3][3];
    MeMatrix4 tm = {{0}};
    for (int i = 0; i < 3; i++)
        memcpy(tm[i], m->inputs.axis[i], sizeof(MeVector3));
    mcd_shapeAxes(mcd_const(tm), axis);
    for (int i = 0; i < 3; i++)
        if (m->shape.place[i] != (double)m->inputs.place[i])
            return MEFALSE;
    return memcmp(axis, m->shape.axis, sizeof axis) == 0;
}

MeBool mcd_shapeInRound(McdModelRecord *m, const double origin[3], McdShape *shape) {
    if (m->stamp == 0 || m->comparedIn != m->frame->round || !m->isPlaced || !m->shape.kind)
        return MEFALSE;
    MEVALIDATE(isPoseAsCompared(m));
    memcpy(shape, &m->shape, offsetof(McdShape, corner));
    mcd_sub(shape->place, shape->place, origin);
    if (shape->kind->isSampled)
        shape->spin = m->angularVelocity;
    return METRUE;
}
