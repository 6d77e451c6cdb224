/* ConeLimit: the angle between an axis of each body stays below a half angle (Dynamics guide ch. 3, "MdtConeLimit").
 *
 *     θ = angle(a_0, a_1),   dθ/dt = m·(ω_1 - ω_0),   m = a_0 x a_1 / |a_0 x a_1|.
 *
 * θ is the coordinate of a limit with an upper stop only, without restitution. Since m changes with the axes, a hard
 * stop is a position row, which constrains θ at the end of the step. Where the axes are parallel m is undefined, and
 * its last value is used.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    MdtBclCone *cone = &c->of.cone;
    bcl_resetFrames(c);
    memset(cone, 0, sizeof *cone);
    MdtBclLimitReset(&cone->limit);
    cone->limit.limit[0].stiffness = 0; /* no lower stop */
    cone->limit.limit[1].restitution = 0;
    cone->limit.limit[1].stop = ME_PI;
    cone->limit.bActive = METRUE;
    cone->stiffness = cone->damping = MEINFINITY;
    cone->normal[1] = 1;
}

/* rad: the angle between the axes; across: their cross product. */
static double measureAngle(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double across[3]) {
    double a0[3], a1[3];
    keaApply(a0, pose[0]->R, c->frame[0].primary);
    keaApply(a1, pose[1]->R, c->frame[1].primary);
    keaCross(across, a0, a1);
    return atan2(keaLength(across), keaDot(a0, a1));
}

/* The row of the angle θ. */
static void angleRow(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow *row) {
    double across[3];
    bcl_startRow(row, x);
    const double angle = measureAngle(c, x->pose, across), sine = keaLength(across);
    if (sine > BCL_PARALLEL)
        keaScale(row->J[1].ang, 1 / sine, across);
    else
        keaCopy(row->J[1].ang, c->of.cone.normal);
    MEASSERT(!isfinite(sine) || bcl_isUnit(row->J[1].ang)); /* a pose beyond the numbers: NaN */
    keaScale(row->J[0].ang, -1, row->J[1].ang);
    if (sine > BCL_PARALLEL) /* of the Hessian of θ, which also has -2 tan(θ/2) times the product of both movements */
        bcl_bendRow(c, x, fmax(1 / tan(angle), 0), row);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclCone *cone = &c->of.cone;
    MdtKeaRow row;
    double across[3];
    if (cone->limit.limit[1].stop >= ME_PI) {
        cone->limit.rows = 0;
        return 0;
    }
    const double angle = measureAngle(c, x->pose, across), sine = keaLength(across);
    const MeBool hasPlane = sine > BCL_PARALLEL;
    if (hasPlane)
        keaScale(cone->normal, 1 / sine, across);
    if (!hasPlane && angle < (double)cone->limit.limit[1].stop) { /* a_1 is in the middle of the cone: no row */
        c->isDegenerate = MEFALSE;
        cone->limit.rows = 0;
        return 0;
    }
    bcl_setStopSpring(&cone->limit.limit[1], cone->stiffness, cone->damping);
    angleRow(c, x, &row);
    const int rows = bcl_limitPrepare(&cone->limit, x, &row, angle);
    MEASSERT(rows >= 0 && rows <= MdtBclGETMAXROWSCONELIMIT);
    c->isDegenerate = rows > 0 && !hasPlane;
    return rows;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double across[3];
    if (c->of.cone.limit.rows)
        bcl_limitErrors(&c->of.cone.limit, measureAngle(c, pose, across), e);
}

static int passed(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclLimit *limit = &c->of.cone.limit;
    double across[3];
    return limit->limit[1].stop < ME_PI ? bcl_limitPassed(limit, measureAngle(c, pose, across)) : 0;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    MdtKeaRow row;
    angleRow(c, x, &row);
    bcl_limitFill(&c->of.cone.limit, x, &row, 0, rows);
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtKeaRow row;
    double across[3];
    if (c->of.cone.limit.limit[1].stop >= ME_PI)
        return;
    angleRow(c, x, &row);
    bcl_limitReadBack(&c->of.cone.limit, measureAngle(c, x->pose, across), bcl_rate(&row, x->velocity), rows);
}

const MdtBclType bcl_coneLimit = {.name = "ConeLimit",
                                  .maxRows = MdtBclGETMAXROWSCONELIMIT + 1, /* and its bend */
                                  .reset = reset,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .passed = passed,
                                  .readBack = readBack,
                                  .degenerate = "its axes are parallel, which leaves it no plane to push in"};
