/* Skeletal: a ball and socket whose swing stays in an elliptical cone and whose twist stays between limits (User Guide
 * app. D, "MdtSkeletal").
 *
 * Frame 1 is the reference. D = frame 0 in frame 1 = (swing) (twist): the twist turns about the primary axis x, the
 * swing rotates x to a = D x along a great circle. With a = (cos θ, sin θ t), t a unit vector in the (y, z) plane, the
 * swing has the coordinates σ = θ t: the primary limit α is that along y, the secondary limit β that along z.
 *   cone:  f = |(σ_y/α, σ_z/β)| <= 1, one row, scaled to radians by the gradient of f.
 *          From da/dt = ω x a (axes of frame 1):  dθ/dt = cos θ t·a' - sin θ a'_x,   θ dt/dt = (θ/sin θ) (a' across t).
 *          A hard limit is a position row, which constrains f at the end of the step. Its direction turns along the rim
 *          by the curvature t·(∇∇f) t / |∇f| of the ellipse, t its tangent, times θ cot θ: by cot θ if α = β.
 *   twist: τ = 2 atan2(D_x, D_w), with D as a quaternion (w, v):
 *          dτ/dt = (w (w ω_x + ω_y v_z - ω_z v_y) + v_x v·ω) / (w² + v_x²).
 *   motor: three rows of D, at the end (bcl_servo.c).
 */
#include "bcl_i.h"
#include <string.h>

static void resetLimit(MdtBclLimit *limit) {
    MdtBclLimitReset(limit);
    limit->limit[0].restitution = limit->limit[1].restitution = 0;
    limit->bActive = METRUE;
}

static void reset(MdtBclConstraint *c) {
    MdtBclSkeletal *s = &c->of.skeletal;
    bcl_resetFrames(c);
    memset(s, 0, sizeof *s);
    s->primary = s->secondary = s->twist = ME_PI / 4;
    s->coneStiffness = s->coneDamping = s->twistStiffness = s->twistDamping = MEINFINITY;
    s->coneOption = MdtSkeletalConeOptionCone;
    s->twistOption = MdtSkeletalTwistOptionLimited;
    resetLimit(&s->cone);
    s->cone.limit[0].stiffness = 0; /* no lower stop */
    resetLimit(&s->turn);
    bcl_resetTurnServo(&s->servo);
}

/* The coordinates of the joint, and their derivatives in the axes of frame 1: rate = row·ω, ω = ω_0 - ω_1. */
typedef struct {
    double sigma[2], f, tau;       /* swing, rad; f of the cone; twist, rad */
    double cone[3], swing[2][3];   /* derivatives of the cone's coordinate and of σ */
    double twist[3], scale;        /* derivative of τ; |∇f| */
    double curvature;              /* of the cone's rim: rad that its row turns for a rad along it */
    MeBool isParallel, isOpposite; /* a points along x, or against it */
} Coordinates;

/* The derivative of the swing along a direction of the (y, z) plane, for a = (cos θ, sin θ t). */
static void swingRow(const double a[3], const double t[2], double theta, const double along[2], double row[3]) {
    const double sine = sin(theta), stretch = sine > BCL_PARALLEL ? theta / sine : 1;
    const double radial = along[0] * t[0] + along[1] * t[1], across = along[1] * t[0] - along[0] * t[1];
    const double c[3] = {-radial * sine, radial * cos(theta) * t[0] - across * stretch * t[1],
                         radial * cos(theta) * t[1] + across * stretch * t[0]};
    keaCross(row, a, c); /* c·(ω x a) = ω·(a x c) */
}

/* The derivative of the twist τ. */
static void twistRow(const double D[4], double row[3]) {
    const double w = D[0], *v = D + 1, size = fmax(w * w + v[0] * v[0], 1e-12);
    row[0] = (w * w + v[0] * v[0]) / size;
    row[1] = (w * v[2] + v[0] * v[1]) / size;
    row[2] = (-w * v[1] + v[0] * v[2]) / size;
}

/* The curvature of the rim where `along` is its normal; theta cot theta: `bow`. */
static double rimCurvature(const Coordinates *p, double alpha, double beta, const double along[2], double bow) {
    const double u[2] = {along[1] / alpha, along[0] / beta};
    return p->f > 0 ? fmax((u[0] * u[0] + u[1] * u[1]) / (p->f * p->scale) * bow, 0) : 0;
}

static void measureCoordinates(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], Coordinates *p) {
    static const double toY[2] = {1, 0}, toZ[2] = {0, 1};
    const MdtBclSkeletal *s = &c->of.skeletal;
    double D[4], R[3][3];
    bcl_relativeOrientation(D, c, pose, NULL);
    keaQuaternionToMatrix(R, D);
    const double a[3] = {R[0][0], R[1][0], R[2][0]}, sine = sqrt(a[1] * a[1] + a[2] * a[2]);
    const double theta = atan2(sine, a[0]);
    const double t[2] = {sine > 1e-12 ? a[1] / sine : 1, sine > 1e-12 ? a[2] / sine : 0};
    p->isParallel = sine <= BCL_PARALLEL && a[0] > 0;
    p->isOpposite = sine <= BCL_PARALLEL && a[0] < 0;
    p->sigma[0] = theta * t[0];
    p->sigma[1] = theta * t[1];
    p->tau = 2 * atan2(D[1], D[0]);
    swingRow(a, t, theta, toY, p->swing[0]);
    swingRow(a, t, theta, toZ, p->swing[1]);
    twistRow(D, p->twist);
    const double alpha = fmax((double)s->primary, 1e-6), beta = fmax((double)s->secondary, 1e-6);
    const double u[2] = {p->sigma[0] / alpha, p->sigma[1] / beta};
    p->f = sqrt(u[0] * u[0] + u[1] * u[1]);
    const double gradient[2] = {p->f > 0 ? u[0] / alpha / p->f : 1 / alpha, p->f > 0 ? u[1] / beta / p->f : 0};
    p->scale = sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1]);
    MEASSERT(isnan(theta) || (p->scale > 0 && isfinite(p->scale) && p->f >= 0)); /* NaN: a pose has overflowed */
    const double along[2] = {gradient[0] / p->scale, gradient[1] / p->scale};
    swingRow(a, t, theta, along, p->cone);
    p->curvature = rimCurvature(p, alpha, beta, along, sine > BCL_PARALLEL ? theta * a[0] / sine : 0);
}

/* A row of the relative angular velocity ω_0 - ω_1, with the coefficients `local` in the axes of frame 1. */
static void turnRow(const MdtBclConstraint *c, const MdtBclContext *x, const double local[3], MdtKeaRow *row) {
    double axes[3][3];
    bcl_axes(axes, c, 1, x->pose[1]);
    bcl_startRow(row, x);
    for (int i = 0; i < 3; i++)
        keaAddScaled(row->J[0].ang, local[i], axes[i]);
    keaScale(row->J[1].ang, -1, row->J[0].ang);
}

/* Sets coordinate, stiffness and damping of a stop. */
static void setStop(MdtBclSingleLimit *stop, double at, MeReal stiffness, MeReal damping) {
    stop->stop = (MeReal)at;
    bcl_setStopSpring(stop, stiffness, damping);
}

/* The number of swing coordinates that are constrained to 0: none, the secondary one, or both. */
static int countLockedSwings(const MdtBclSkeletal *s) {
    return s->coneOption == MdtSkeletalConeOptionFixed ? 2 : s->coneOption == MdtSkeletalConeOptionSlot ? 1 : 0;
}

/* Whether the swing has a limit: an elliptical cone or a slot of less than half a turn. */
static MeBool hasCone(const MdtBclSkeletal *s) {
    const MeReal min = s->primary < s->secondary ? s->primary : s->secondary;
    return s->coneOption == MdtSkeletalConeOptionSlot ? s->primary < ME_PI
                                                      : s->coneOption == MdtSkeletalConeOptionCone && min < ME_PI;
}

/* rad: the coordinate that the cone limits, positive outside: (f - 1) / |∇f|, with |∇f| at the start of the step; of a
 * slot |σ_y| - α. */
static double coneCoordinate(const MdtBclSkeletal *s, const Coordinates *p) {
    return s->coneOption == MdtSkeletalConeOptionSlot ? fabs(p->sigma[0]) - (double)s->primary : (p->f - 1) / s->scale;
}

/* The row of the coordinate that the cone limits. */
static void coneRow(const MdtBclConstraint *c, const MdtBclContext *x, const Coordinates *p, MdtKeaRow *row) {
    if (c->of.skeletal.coneOption != MdtSkeletalConeOptionSlot) {
        turnRow(c, x, p->cone, row);
        bcl_bendRow(c, x, p->curvature, row);
        return;
    }
    turnRow(c, x, p->swing[0], row);
    if (p->sigma[0] < 0)
        bcl_negate(row);
}

static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclSkeletal *s = &c->of.skeletal;
    MdtKeaRow row;
    Coordinates p;
    measureCoordinates(c, x->pose, &p);
    s->scale = p.scale;
    int count = 3 + countLockedSwings(s) + (s->twistOption == MdtSkeletalTwistOptionFixed);
    s->cone.rows = s->turn.rows = 0;
    if (hasCone(s)) {
        setStop(&s->cone.limit[1], 0, s->coneStiffness, s->coneDamping);
        coneRow(c, x, &p, &row);
        count += bcl_limitPrepare(&s->cone, x, &row, coneCoordinate(s, &p));
    }
    if (s->twistOption == MdtSkeletalTwistOptionLimited && s->twist < ME_PI) {
        setStop(&s->turn.limit[0], -(double)s->twist, s->twistStiffness, s->twistDamping);
        setStop(&s->turn.limit[1], s->twist, s->twistStiffness, s->twistDamping);
        turnRow(c, x, p.twist, &row);
        count += bcl_limitPrepare(&s->turn, x, &row, p.tau);
    }
    count += bcl_turnServoPrepare(c, &s->servo, x);
    /* in the middle of a cone the row has the direction in which the axis leaves it */
    const MeBool isOutside = s->coneOption == MdtSkeletalConeOptionCone && coneCoordinate(s, &p) >= 0;
    c->isDegenerate = p.isOpposite || (p.isParallel && s->cone.rows && isOutside);
    MEASSERT(count <= bcl_skeletal.maxRows);
    return count;
}

static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    const MdtBclSkeletal *s = &c->of.skeletal;
    Coordinates p;
    bcl_separation(c, pose, e);
    measureCoordinates(c, pose, &p);
    int n = 3;
    if (countLockedSwings(s) > 0)
        e[n++] = p.sigma[1];
    if (countLockedSwings(s) > 1)
        e[n++] = p.sigma[0];
    if (s->twistOption == MdtSkeletalTwistOptionFixed)
        e[n++] = p.tau;
    n += bcl_limitErrors(&s->cone, coneCoordinate(s, &p), e + n);
    bcl_limitErrors(&s->turn, p.tau, e + n);
}

static int passed(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclSkeletal *s = &c->of.skeletal;
    const MeBool hasTwist = s->twistOption == MdtSkeletalTwistOptionLimited && s->twist < ME_PI;
    Coordinates p;
    measureCoordinates(c, pose, &p);
    const int count = hasCone(s) ? bcl_limitPassed(&s->cone, coneCoordinate(s, &p)) : 0;
    return hasTwist ? count + bcl_limitPassed(&s->turn, p.tau) : count;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    const MdtBclSkeletal *s = &c->of.skeletal;
    MdtKeaRow row;
    Coordinates p;
    measureCoordinates(c, x->pose, &p);
    bcl_pointRows(c, x, rows);
    rows += 3;
    for (int i = 0; i < countLockedSwings(s); i++, rows++) {
        turnRow(c, x, p.swing[1 - i], rows);
        bcl_makePosition(rows, x, p.sigma[1 - i]);
    }
    if (s->twistOption == MdtSkeletalTwistOptionFixed) {
        turnRow(c, x, p.twist, rows);
        bcl_makePosition(rows++, x, p.tau);
    }
    coneRow(c, x, &p, &row);
    bcl_limitFill(&s->cone, x, &row, 0, rows);
    rows += s->cone.rows != 0;
    turnRow(c, x, p.twist, &row);
    bcl_limitFill(&s->turn, x, &row, 0, rows);
    rows += bcl_limitRows(&s->turn);
    if (bcl_isServo(&s->servo.motor))
        bcl_turnServoFill(c, &s->servo, x, rows);
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    MdtBclSkeletal *s = &c->of.skeletal;
    MdtKeaRow row;
    Coordinates p;
    measureCoordinates(c, x->pose, &p);
    rows += 3 + countLockedSwings(s) + (s->twistOption == MdtSkeletalTwistOptionFixed);
    coneRow(c, x, &p, &row);
    bcl_limitReadBack(&s->cone, coneCoordinate(s, &p), bcl_rate(&row, x->velocity), rows);
    rows += s->cone.rows != 0;
    turnRow(c, x, p.twist, &row);
    bcl_limitReadBack(&s->turn, p.tau, bcl_rate(&row, x->velocity), rows);
}

/* Turns frame 0 about its primary axis by minus the present twist. */
void MEAPI MdtBclSkeletalZeroTwist(MdtBclConstraint *c, const MdtKeaTransformation *const pose[2]) {
    MdtBclFrame *frame = &c->frame[0];
    double third[3], turned[3];
    Coordinates p;
    measureCoordinates(c, pose, &p);
    keaCross(third, frame->primary, frame->ortho);
    keaScale(turned, cos(p.tau), frame->ortho);
    keaAddScaled(turned, -sin(p.tau), third);
    keaCopy(frame->ortho, turned);
}

const MdtBclType bcl_skeletal = {.name = "Skeletal",
                                 .maxRows = MdtBclGETMAXROWSSKELETAL + 4, /* a position motor, and the cone's bend */
                                 .reset = reset,
                                 .prepare = prepare,
                                 .fill = fill,
                                 .errors = errors,
                                 .passed = passed,
                                 .readBack = readBack,
                                 .degenerate = "its swing has no direction"};
