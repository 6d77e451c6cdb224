/* Every row against finite differences: the rate J v of a position row is the derivative of its error, that of a
 * limit's row the derivative of its coordinate, and those of motors, stops, springs, contacts and friction the
 * derivatives of what this file measures itself; for random frames, poses and velocities, met or not. */
#include "MdtBcl.h"
#include "MdtKeaMath.h"
#include "MeMath.h"
#include "karma_test.h"
#include <string.h>

static const double small = 1e-6; /* of a finite difference: errors of 1e-12 of curvature, 1e-10 of rounding */
static const double tolerance = 2e-8;

static unsigned long long seed;

static double number(void) { /* in -1..1 */
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(long long)(seed >> 11) / (1LL << 52) - 1;
}

static void vector(double v[3], double size) {
    for (int i = 0; i < 3; i++)
        v[i] = size * number();
}

typedef struct {
    double position[3], quaternion[4];
    MdtKeaVelocity velocity;
} Body;

static void randomBody(Body *b) {
    vector(b->position, 2);
    for (int i = 0; i < 4; i++)
        b->quaternion[i] = number();
    keaQuaternionNormalize(b->quaternion);
    vector(b->velocity.lin, 1);
    vector(b->velocity.ang, 1);
}

/* Where the body is after the time t. */
static void poseAt(const Body *b, double t, MdtKeaTransformation *pose) {
    double turn[3], step[4], q[4];
    keaScale(turn, t, b->velocity.ang);
    keaQuaternionExp(step, turn);
    keaQuaternionProduct(q, step, b->quaternion);
    keaQuaternionToMatrix(pose->R, q);
    keaCopy(pose->pos, b->position);
    keaAddScaled(pose->pos, t, b->velocity.lin);
}

typedef struct {
    Body body[2];
    MdtKeaTransformation pose[2];
    MdtBclConstraint joint;
    const MdtBclType *type;
    MdtBclContext context;
    MdtKeaRow rows[MdtBclGETMAXROWS];
} Scene;

static void setPoses(Scene *s, double t) {
    for (int k = 0; k < 2; k++) {
        poseAt(&s->body[k], t, &s->pose[k]);
        s->context.pose[k] = &s->pose[k];
        s->context.velocity[k] = s->context.predicted[k] = &s->body[k].velocity;
        s->context.invMass[k] = &MdtBclWorldInvMass;
        s->context.body[k] = k;
    }
}

/* Frames that coincide at poses of their own, so that the bodies' poses are anything from near to far from valid. */
static void randomFrames(Scene *s) {
    for (int k = 0; k < 2; k++) {
        MdtBclFrame *f = &s->joint.frame[k];
        vector(f->position, 1);
        vector(f->primary, 1);
        vector(f->ortho, 1);
        keaScale(f->primary, 1 / keaLength(f->primary), f->primary);
        keaAddScaled(f->ortho, -keaDot(f->ortho, f->primary), f->primary);
        keaScale(f->ortho, 1 / keaLength(f->ortho), f->ortho);
    }
}

static void makeScene(Scene *s, MdtBclJointType type, void (*change)(MdtBclConstraint *)) {
    memset(s, 0, sizeof *s);
    s->type = MdtBclTypeOf(type);
    s->joint.type = type;
    s->type->reset(&s->joint);
    randomBody(&s->body[0]);
    randomBody(&s->body[1]);
    randomFrames(s);
    s->context.parameters = (MdtBclSolverParameters){.stepsize = 1.0 / 60, .gamma = .2, .softening = 1};
    if (change)
        change(&s->joint);
    setPoses(s, 0);
}

static double rateOf(const Scene *s, const MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        rate += keaDot(row->J[k].lin, s->body[k].velocity.lin) + keaDot(row->J[k].ang, s->body[k].velocity.ang);
    return rate;
}

static void errorsAt(Scene *s, double t, double errors[]) {
    setPoses(s, t);
    s->type->errors(&s->joint, s->context.pose, errors);
}

/* SOME: rows of limits, which are there where the poses violate them. */
enum { TRIALS = 200, SOME = -1 };

static void check(MdtBclJointType type, void (*change)(MdtBclConstraint *), int wantedRows) {
    int total = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s;
        double before[MdtBclGETMAXROWS], after[MdtBclGETMAXROWS], now[MdtBclGETMAXROWS];
        seed = 1000 * (unsigned long long)type + (unsigned long long)trial;
        makeScene(&s, type, change);
        const int rows = s.type->prepare(&s.joint, &s.context);
        ck_assert_int_le(rows, s.type->maxRows);
        s.type->fill(&s.joint, &s.context, s.rows);
        errorsAt(&s, -small, before);
        errorsAt(&s, small, after);
        errorsAt(&s, 0, now);
        int positionRows = 0;
        for (int i = 0; i < rows; i++) {
            if (!s.rows[i].position)
                continue;
            positionRows++;
            assert_near(rateOf(&s, &s.rows[i]), (after[i] - before[i]) / (2 * small), tolerance);
            assert_near(now[i], s.rows[i].error, 6e-15);
        }
        total += positionRows;
        ck_assert(wantedRows == SOME || positionRows == wantedRows);
    }
    ck_assert_int_gt(total, TRIALS / 2);
}

/* The limit's position and velocity after a step that ends at the time t. */
static void readLimit(Scene *s, double t, const MdtBclLimit *limit, double *position, double *velocity) {
    MdtKeaRow none[MdtBclGETMAXROWS];
    memset(none, 0, sizeof none);
    setPoses(s, t);
    s->type->prepare(&s->joint, &s->context);
    s->type->readBack(&s->joint, &s->context, none);
    *position = limit->measured;
    *velocity = limit->velocity;
}

static void checkCoordinate(MdtBclJointType type, void (*change)(MdtBclConstraint *), size_t limitAt) {
    for (int trial = 0; trial < 200; trial++) {
        Scene s;
        double before, after, now, rate, unused;
        seed = 777 + 1000 * (unsigned long long)type + (unsigned long long)trial;
        makeScene(&s, type, change);
        MdtBclLimit *limit = (MdtBclLimit *)(void *)((char *)&s.joint + limitAt);
        limit->bCalculatePosition = METRUE;
        readLimit(&s, 0, limit, &now, &rate);
        readLimit(&s, -small, limit, &before, &unused);
        readLimit(&s, small, limit, &after, &unused);
        assert_near(rate, (after - before) / (2 * small), TOL(1e-6, tolerance) * (1 + fabs(rate)));
    }
}

static void fixSkeletal(MdtBclConstraint *c) {
    c->of.skeletal.coneOption = MdtSkeletalConeOptionFixed;
    c->of.skeletal.twistOption = MdtSkeletalTwistOptionFixed;
}

static void freeSkeletal(MdtBclConstraint *c) {
    c->of.skeletal.coneOption = MdtSkeletalConeOptionFree;
    c->of.skeletal.twistOption = MdtSkeletalTwistOptionFree;
}

static void ellipse(MdtBclConstraint *c) {
    c->of.skeletal.secondary = .3;
}

static void slotSkeletal(MdtBclConstraint *c) {
    c->of.skeletal.coneOption = MdtSkeletalConeOptionSlot;
    c->of.skeletal.twistOption = MdtSkeletalTwistOptionFree;
    c->of.skeletal.primary = ME_PI;
}

static void wideSlot(MdtBclConstraint *c) {
    c->of.skeletal.coneOption = MdtSkeletalConeOptionSlot;
}

static void narrow(MdtBclConstraint *c) {
    c->of.cone.limit.limit[1].stop = .1;
}

static void rotate(MdtBclConstraint *c) {
    c->of.angular.rotates = METRUE;
}

static void loosenWheel(MdtBclConstraint *c) {
    c->of.wheel.steering.force = 0;
}

static void lockWheel(MdtBclConstraint *c) {
    c->of.wheel.isLocked = METRUE;
}

static void rod(MdtBclConstraint *c) {
    c->of.distance.limit.limit[0].stiffness = c->of.distance.limit.limit[1].stiffness = MEINFINITY;
    c->of.distance.limit.limit[0].stop = c->of.distance.limit.limit[1].stop = .7;
}

static void string(MdtBclConstraint *c) {
    rod(c);
    c->of.distance.limit.limit[0].stiffness = c->of.distance.limit.limit[0].damping = 0;
}

static void turned(MdtBclConstraint *c) {
    static const double q[4] = {.5, .1, -.7, .5};
    memcpy(c->of.relative.quaternion, q, sizeof q);
    keaQuaternionNormalize(c->of.relative.quaternion);
}

/* All directions rigid, to a target that moves and turns. */
static void toTarget(MdtBclConstraint *c) {
    MdtBclSprings *s = &c->of.springs;
    static const double q[4] = {.5, .1, -.7, .5};
    for (int i = 0; i < 6; i++)
        s->stiffness[i] = MEINFINITY;
    memcpy(s->target.quaternion, q, sizeof q);
    keaQuaternionNormalize(s->target.quaternion);
    for (int i = 0; i < 3; i++)
        s->position[i] = .1 * i, s->velocity[i] = .2;
}

TEST(position_rows) {
    check(MdtBclSPRING6, toTarget, 6);
    check(MdtBclBSJOINT, NULL, 3);
    check(MdtBclHINGE, NULL, 5);
    check(MdtBclPRISMATIC, NULL, 5);
    check(MdtBclUNIVERSAL, NULL, 4);
    check(MdtBclANGULAR3, NULL, 3);
    check(MdtBclANGULAR3, rotate, 2);
    check(MdtBclLINEAR1, NULL, 1);
    check(MdtBclLINEAR2, NULL, 2);
    check(MdtBclFIXEDPATH, NULL, 3);
    check(MdtBclFPFOJOINT, NULL, 6);
    check(MdtBclRPROJOINT, NULL, 6);
    check(MdtBclRPROJOINT, turned, 6);
    check(MdtBclCARWHEEL, NULL, 4);
    check(MdtBclCARWHEEL, loosenWheel, 3);
    check(MdtBclCARWHEEL, lockWheel, 4);
    check(MdtBclSPRING, rod, 1);
    check(MdtBclSPRING, string, SOME);
    check(MdtBclSKELETAL, freeSkeletal, 3);
    check(MdtBclSKELETAL, fixSkeletal, 6);
    check(MdtBclSKELETAL, slotSkeletal, 4);
    check(MdtBclSKELETAL, wideSlot, SOME);
    check(MdtBclSKELETAL, ellipse, SOME);
    check(MdtBclCONELIMIT, narrow, SOME);
}

#define LIMIT(member) offsetof(MdtBclConstraint, of.member)

TEST(coordinates_of_limits) {
    checkCoordinate(MdtBclPRISMATIC, NULL, LIMIT(limit));
    checkCoordinate(MdtBclSPRING, string, LIMIT(distance.limit));
    checkCoordinate(MdtBclCONELIMIT, narrow, LIMIT(cone.limit));
    checkCoordinate(MdtBclSKELETAL, NULL, LIMIT(skeletal.cone)); /* a circular cone: an angle */
    checkCoordinate(MdtBclSKELETAL, NULL, LIMIT(skeletal.turn));
    checkCoordinate(MdtBclSKELETAL, slotSkeletal, LIMIT(skeletal.cone));
}

/* ---- motors, stops, springs: coordinates measured here ---- */

typedef struct {
    double at[3], axis[3][3]; /* of an attachment, in the world */
} Side;

static void sideOf(const Scene *s, int k, Side *side) {
    const MdtBclFrame *f = &s->joint.frame[k];
    keaApply(side->at, s->pose[k].R, f->position);
    keaAddScaled(side->at, 1, s->pose[k].pos);
    keaApply(side->axis[0], s->pose[k].R, f->primary);
    keaApply(side->axis[1], s->pose[k].R, f->ortho);
    keaCross(side->axis[2], side->axis[0], side->axis[1]);
}

static double angleBetween(const double from[3], const double to[3], const double about[3]) {
    double across[3];
    keaCross(across, from, to);
    return atan2(keaDot(across, about), keaDot(from, to));
}

/* Frame 1 as frame 0, turned about the primary axis: joints whose rows turn about a common axis need one. */
static void alignAxes(Scene *s, double turn) {
    Side zero;
    double ortho[3];
    sideOf(s, 0, &zero);
    keaScale(ortho, cos(turn), zero.axis[1]);
    keaAddScaled(ortho, sin(turn), zero.axis[2]);
    keaApplyTransposed(s->joint.frame[1].primary, s->pose[1].R, zero.axis[0]);
    keaApplyTransposed(s->joint.frame[1].ortho, s->pose[1].R, ortho);
}

typedef enum { ANY, ALIGNED, SAME } Stance; /* any frames, a common primary axis, the same orientation */

/* What each row's rate is the derivative of. Where the row is that of a stop or a spring it is its error, too. */
typedef void (*Coordinates)(const Side f[2], double out[]);

static void coordinatesAt(Scene *s, double t, Coordinates coordinates, double out[]) {
    Side side[2];
    setPoses(s, t);
    sideOf(s, 0, &side[0]);
    sideOf(s, 1, &side[1]);
    coordinates((const Side *)side, out);
}

/* The rows from `first` on are `count` with these coordinates, and no more. */
static void checkRates(MdtBclJointType type, void (*change)(MdtBclConstraint *), Stance stance, int first, int count,
                       Coordinates coordinates) {
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s;
        double before[MdtBclGETMAXROWS], after[MdtBclGETMAXROWS], now[MdtBclGETMAXROWS];
        seed = 5555 + 1000 * (unsigned long long)type + (unsigned long long)trial;
        makeScene(&s, type, change);
        if (stance != ANY)
            alignAxes(&s, stance == SAME ? 0 : 3 * number());
        ck_assert_int_eq(s.type->prepare(&s.joint, &s.context), first + count);
        s.type->fill(&s.joint, &s.context, s.rows);
        coordinatesAt(&s, -small, coordinates, before);
        coordinatesAt(&s, small, coordinates, after);
        coordinatesAt(&s, 0, coordinates, now);
        for (int i = 0; i < count; i++) {
            const MdtKeaRow *row = &s.rows[first + i];
            const double rate = rateOf(&s, row);
            assert_near(rate, (after[i] - before[i]) / (2 * small), tolerance * (1 + fabs(rate)));
            if (row->spring || row->position)
                assert_near(row->error, now[i], TOL(1e-6, 3e-13));
        }
    }
}

/* Stops that any coordinate is beyond. */
static const double lowest = 10, highest = -10;

static void beyondStops(MdtBclLimit *limit) {
    limit->bActive = METRUE;
    limit->limit[0].stop = lowest;
    limit->limit[1].stop = highest;
}

static void hardStops(MdtBclConstraint *c) {
    beyondStops(&c->of.limit);
    c->of.limit.bPowered = METRUE;
    c->of.limit.fmax = 1;
}

static void softStops(MdtBclConstraint *c) {
    hardStops(c);
    for (int side = 0; side < 2; side++) {
        c->of.limit.limit[side].stiffness = 100;
        c->of.limit.limit[side].damping = 1;
    }
}

static void locked(MdtBclConstraint *c) {
    hardStops(c);
    c->of.limit.bLocked = METRUE;
    c->of.limit.lockForce = 1;
}

static void motorAndStops(double coordinate, double out[3]) {
    out[0] = coordinate;
    out[1] = coordinate - lowest;
    out[2] = highest - coordinate;
}

static void hingeRows(const Side f[2], double out[]) {
    motorAndStops(angleBetween(f[1].axis[1], f[0].axis[1], f[0].axis[0]), out);
}

static double separation(const Side f[2], const double along[3]) {
    double d[3];
    keaSubtract(d, f[0].at, f[1].at);
    return keaDot(d, along);
}

static void prismaticRows(const Side f[2], double out[]) {
    motorAndStops(separation(f, f[1].axis[0]), out);
}

TEST(motors_locks_and_stops) {
    checkRates(MdtBclHINGE, hardStops, ALIGNED, 5, 3, hingeRows);
    checkRates(MdtBclHINGE, softStops, ALIGNED, 5, 3, hingeRows);
    checkRates(MdtBclHINGE, locked, ALIGNED, 5, 3, hingeRows);
    checkRates(MdtBclPRISMATIC, hardStops, ANY, 5, 3, prismaticRows);
    checkRates(MdtBclPRISMATIC, softStops, ANY, 5, 3, prismaticRows);
    checkRates(MdtBclPRISMATIC, locked, ANY, 5, 3, prismaticRows);
}

static double distanceOf(const Side f[2]) {
    double d[3];
    keaSubtract(d, f[0].at, f[1].at);
    return keaLength(d);
}

static void distanceRows(const Side f[2], double out[]) {
    out[0] = distanceOf(f) - lowest;
    out[1] = highest - distanceOf(f);
}

static void distanceStrain(const Side f[2], double out[]) {
    out[0] = distanceOf(f) - .5;
}

static void farStops(MdtBclConstraint *c) {
    beyondStops(&c->of.distance.limit);
}

static void springOfHalf(MdtBclConstraint *c) {
    c->of.distance.limit.limit[0].stop = c->of.distance.limit.limit[1].stop = .5;
}

/* The rotation vector from frame 1 to frame 0 in their axes, to the first order. */
static void smallTurn(const Side f[2], double out[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = (keaDot(f[1].axis[k], f[0].axis[j]) - keaDot(f[1].axis[j], f[0].axis[k])) / 2;
    }
}

static void spring6Rows(const Side f[2], double out[]) {
    for (int i = 0; i < 3; i++)
        out[i] = separation(f, f[1].axis[i]);
    smallTurn(f, out + 3);
}

static void leaningRows(const Side f[2], double out[]) {
    double turn[3];
    smallTurn(f, turn);
    out[0] = turn[1];
    out[1] = turn[2];
}

static void sixSprings(MdtBclConstraint *c) {
    for (int i = 0; i < 6; i++)
        c->of.springs.stiffness[i] = 10, c->of.springs.damping[i] = 1;
}

static void softOrientation(MdtBclConstraint *c) {
    c->of.angular.stiffness = c->of.angular.damping = 1;
}

static void softAxis(MdtBclConstraint *c) {
    softOrientation(c);
    c->of.angular.rotates = METRUE;
}

static void turnMotor(MdtBclConstraint *c) {
    c->of.servo.motor.frequency = 1;
}

static void skeletalMotor(MdtBclConstraint *c) {
    freeSkeletal(c);
    c->of.skeletal.servo.motor.frequency = 1;
}

static void sixMotors(MdtBclConstraint *c) {
    for (int i = 0; i < 6; i++)
        c->of.springs.motor[i].frequency = 1;
}

TEST(springs) {
    checkRates(MdtBclBSJOINT, turnMotor, SAME, 3, 3, smallTurn);
    checkRates(MdtBclSKELETAL, skeletalMotor, SAME, 3, 3, smallTurn);
    checkRates(MdtBclSPRING6, sixMotors, SAME, 0, 6, spring6Rows);
    checkRates(MdtBclSPRING, farStops, ANY, 0, 2, distanceRows);
    checkRates(MdtBclSPRING, springOfHalf, ANY, 0, 1, distanceStrain);
    checkRates(MdtBclSPRING6, sixSprings, SAME, 0, 6, spring6Rows);
    checkRates(MdtBclANGULAR3, softOrientation, SAME, 0, 3, smallTurn);
    checkRates(MdtBclANGULAR3, softAxis, SAME, 0, 2, leaningRows);
}

static const double halfAngle = .0625;

static double angleOfAxes(const Side f[2]) {
    double across[3];
    keaCross(across, f[0].axis[0], f[1].axis[0]);
    return atan2(keaLength(across), keaDot(f[0].axis[0], f[1].axis[0]));
}

static void coneRows(const Side f[2], double out[]) {
    out[0] = halfAngle - angleOfAxes(f);
}

/* The twist of (swing) (twist): half of it is the angle of the quaternion's w and x. */
static void coneAndTwistRows(const Side f[2], double out[]) {
    const double twist = atan2(keaDot(f[1].axis[2], f[0].axis[1]) - keaDot(f[1].axis[1], f[0].axis[2]),
                               keaDot(f[1].axis[1], f[0].axis[1]) + keaDot(f[1].axis[2], f[0].axis[2]));
    coneRows(f, out);
    out[1] = twist - lowest;
    out[2] = highest - twist;
}

static void hardCone(MdtBclConstraint *c) {
    c->of.cone.limit.limit[1].stop = halfAngle;
}

static void softCone(MdtBclConstraint *c) {
    hardCone(c);
    c->of.cone.stiffness = c->of.cone.damping = 1;
}

static void hardSkeletal(MdtBclConstraint *c) {
    c->of.skeletal.primary = c->of.skeletal.secondary = halfAngle;
    c->of.skeletal.twist = -lowest;
}

static void softSkeletal(MdtBclConstraint *c) {
    MdtBclSkeletal *s = &c->of.skeletal;
    hardSkeletal(c);
    s->coneStiffness = s->coneDamping = s->twistStiffness = s->twistDamping = 1;
}

TEST(cones_and_twists) {
    checkRates(MdtBclCONELIMIT, hardCone, ANY, 0, 1, coneRows);
    checkRates(MdtBclCONELIMIT, softCone, ANY, 0, 1, coneRows);
    checkRates(MdtBclSKELETAL, hardSkeletal, ANY, 3, 3, coneAndTwistRows);
    checkRates(MdtBclSKELETAL, softSkeletal, ANY, 3, 3, coneAndTwistRows);
}

/* s, the steering axis, is the primary axis of frame 0, h, the hinge axis, the second of frame 1. */
static void wheelRows(const Side f[2], double out[]) {
    const double height = -separation(f, f[0].axis[0]);
    out[0] = height - .125;
    out[1] = height - lowest;
    out[2] = highest - height;
    out[3] = angleBetween(f[0].axis[0], f[1].axis[0], f[1].axis[1]);
}

static void steeringRow(const Side f[2], double out[]) {
    out[0] = angleBetween(f[0].axis[1], f[1].axis[1], f[0].axis[0]);
    wheelRows(f, out + 1);
}

static void drivenWheel(MdtBclConstraint *c) {
    MdtBclCarWheel *w = &c->of.wheel;
    w->kp = w->kd = 1;
    w->reference = .125;
    w->low = lowest;
    w->high = highest;
    w->rolling.force = 1;
    w->steering.force = 0;
}

static void steeredWheel(MdtBclConstraint *c) {
    drivenWheel(c);
    c->of.wheel.steering.force = 1;
}

TEST(wheels) {
    checkRates(MdtBclCARWHEEL, drivenWheel, ALIGNED, 3, 4, wheelRows);
    for (int trial = 0; trial < TRIALS; trial++) { /* the steering row's error is the way of this step */
        Scene s;
        double before[5], after[5];
        seed = 99 + (unsigned long long)trial;
        makeScene(&s, MdtBclCARWHEEL, steeredWheel);
        alignAxes(&s, number());
        ck_assert_int_eq(s.type->prepare(&s.joint, &s.context), 8);
        s.type->fill(&s.joint, &s.context, s.rows);
        coordinatesAt(&s, -small, steeringRow, before);
        coordinatesAt(&s, small, steeringRow, after);
        for (int i = 0; i < 5; i++)
            assert_near(rateOf(&s, &s.rows[3 + i]), (after[i] - before[i]) / (2 * small), tolerance);
        ck_assert(s.rows[3].error == 0);
    }
}

/* ---- couplings ---- */

static void twoWheels(MdtBclConstraint *c) {
    c->of.coupling.coordinate[0].factor = -2.5;
}

static void housed(MdtBclConstraint *c) {
    twoWheels(c);
    c->of.coupling.housing = 1;
}

static void rack(MdtBclConstraint *c) {
    twoWheels(c);
    c->of.coupling.coordinate[1].kind = MdtBclCoordinateSlide;
}

static void rackOnPinion(MdtBclConstraint *c) {
    rack(c);
    c->of.coupling.housing = 0;
}

static void rope(MdtBclConstraint *c) {
    c->of.coupling.coordinate[1].factor = 2;
    c->of.coupling.constant = .75;
    vector(c->of.coupling.coordinate[0].frame[1].position, 1);
    vector(c->of.coupling.coordinate[1].frame[1].position, 1);
}

/* Angles are measured from where the gear is engaged, here where it is looked at. */
static void checkCoupling(MdtBclJointType type, void (*change)(MdtBclConstraint *)) {
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s;
        double before, after, now;
        seed = 31 * (unsigned long long)type + 7000 + (unsigned long long)trial;
        makeScene(&s, type, change);
        if (type == MdtBclGEAR)
            MdtBclGearEngage(&s.joint, s.context.pose);
        s.joint.of.coupling.constant += .5;
        ck_assert_int_eq(s.type->prepare(&s.joint, &s.context), 1);
        s.type->fill(&s.joint, &s.context, s.rows);
        setPoses(&s, -small);
        before = MdtBclCouplingError(&s.joint, s.context.pose);
        setPoses(&s, small);
        after = MdtBclCouplingError(&s.joint, s.context.pose);
        setPoses(&s, 0);
        now = MdtBclCouplingError(&s.joint, s.context.pose);
        assert_near(rateOf(&s, s.rows), (after - before) / (2 * small), tolerance);
        assert_near(s.rows[0].error, now, 4e-15);
        ck_assert(type == MdtBclPULLEY || fabs(now + .5) < 1e-14);
    }
}

/* A slide of body 0 on body 2 and one of body 1 on body 3: a split row. */
static void checkMimicOfFour(void) {
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s, other;
        double value[2];
        seed = 8800 + (unsigned long long)trial;
        makeScene(&s, MdtBclMIMIC, NULL);
        makeScene(&other, MdtBclMIMIC, NULL);
        MdtBclCoupling *u = &s.joint.of.coupling;
        u->isReady = METRUE;
        u->numSides = 4;
        for (int i = 0; i < 2; i++) {
            MdtBclCoordinate *q = &u->coordinate[i];
            q->kind = MdtBclCoordinateSlide;
            q->side[1] = 2 + i;
            q->frame[0] = s.joint.frame[i];
            q->frame[1] = other.joint.frame[i];
            s.context.body[2 + i] = 2 + i;
            s.context.pose[2 + i] = &other.pose[i];
            s.context.velocity[2 + i] = &other.body[i].velocity;
        }
        ck_assert_int_eq(s.type->prepare(&s.joint, &s.context), 2);
        s.type->fill(&s.joint, &s.context, s.rows);
        ck_assert(s.rows[0].isSplit && !s.rows[0].isTail && s.rows[1].isTail && !s.rows[1].isSplit);
        for (int k = 0; k < 2; k++) {
            setPoses(&s, k == 0 ? -small : small);
            setPoses(&other, k == 0 ? -small : small);
            value[k] = MdtBclCouplingError(&s.joint, s.context.pose);
        }
        assert_near(rateOf(&s, &s.rows[0]) + rateOf(&other, &s.rows[1]), (value[1] - value[0]) / (2 * small),
                    tolerance);
    }
}

TEST(couplings) {
    checkCoupling(MdtBclGEAR, twoWheels);
    checkCoupling(MdtBclGEAR, housed);
    checkCoupling(MdtBclGEAR, rack);
    checkCoupling(MdtBclGEAR, rackOnPinion);
    checkCoupling(MdtBclPULLEY, rope);
    checkMimicOfFour();
}

/* ---- contacts: how the points of the two bodies that are there move against each other ---- */

/* Where the point of body k that is at `place` at the time 0 is at t. */
static void materialPoint(const Scene *s, int k, const double place[3], double t, double out[3]) {
    MdtKeaTransformation now, then;
    double arm[3], local[3];
    poseAt(&s->body[k], 0, &now);
    poseAt(&s->body[k], t, &then);
    keaSubtract(arm, place, now.pos);
    keaApplyTransposed(local, now.R, arm);
    keaApply(out, then.R, local);
    keaAddScaled(out, 1, then.pos);
}

static double slideOf(const Scene *s, const double place[3], const double along[3]) {
    double moved[2][3];
    for (int k = 0; k < 2; k++) {
        double before[3], after[3];
        materialPoint(s, k, place, -small, before);
        materialPoint(s, k, place, small, after);
        keaSubtract(moved[k], after, before);
    }
    keaSubtract(moved[0], moved[0], moved[1]);
    return keaDot(moved[0], along) / (2 * small);
}

static void randomContact(MdtKeaManifold *m) {
    MdtBclContactParams params;
    MdtBclContactParamsReset(&params);
    params.type = MdtContactTypeFriction2D;
    memset(m, 0, sizeof *m);
    MdtBclContactSurface(&params, &m->surface);
    m->body[1] = m->numPoints = 1;
    vector(m->point[0].position, 2);
    vector(m->normal, 1);
    vector(m->direction, 1);
    keaScale(m->normal, 1 / keaLength(m->normal), m->normal);
    keaAddScaled(m->direction, -keaDot(m->direction, m->normal), m->normal);
    keaScale(m->direction, 1 / keaLength(m->direction), m->direction);
    m->point[0].depth = .25;
}

static void keaBodyOf(const Body *from, MdtKeaBody *to) {
    memset(to, 0, sizeof *to);
    keaCopy(to->position, from->position);
    memcpy(to->quaternion, from->quaternion, sizeof to->quaternion);
    keaCopy(to->velocity, from->velocity.lin);
    to->invMass = to->principal[0] = 1;
    to->moments[0] = to->moments[1] = to->moments[2] = 1;
    MdtKeaBodySetAngularVelocity(to, from->velocity.ang);
}

/* The exact solver's rows. */
static void contactRows(const Scene *scene, MdtKeaManifold *m, MdtKeaRow rows[3]) {
    MdtKeaBody bodies[2], *const pointers[2] = {&bodies[0], &bodies[1]};
    MdtKeaSystem kea;
    void *scratch = malloc(MdtKeaScratchSize(2, 3, 1));
    for (int k = 0; k < 2; k++)
        keaBodyOf(&scene->body[k], &bodies[k]);
    memset(&kea, 0, sizeof kea);
    kea.parameters.stepsize = 1. / 60;
    kea.parameters.gamma = .2;
    kea.numBodies = 2;
    kea.bodies = pointers;
    kea.maxRows = 3;
    kea.maxContacts = kea.numManifolds = 1;
    kea.manifolds = m;
    MdtKeaInit(&kea, scratch);
    ck_assert_int_eq(MdtKeaCountContactRows(&kea), 3);
    MdtKeaMakeContactRows(&kea);
    ck_assert_int_eq(kea.numRows, 3);
    memcpy(rows, kea.rows, 3 * sizeof *rows);
    free(scratch);
}

TEST(contacts_and_friction) {
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s;
        MdtKeaManifold m;
        double across[3];
        seed = 4321 + (unsigned long long)trial;
        makeScene(&s, MdtBclBSJOINT, NULL); /* for its bodies */
        randomContact(&m);
        keaCross(across, m.normal, m.direction);
        const double *along[3] = {m.normal, m.direction, across};
        contactRows(&s, &m, s.rows);
        for (int i = 0; i < 3; i++)
            assert_near(rateOf(&s, &s.rows[i]), slideOf(&s, m.point[0].position, along[i]), tolerance);
        assert_near(s.rows[0].error, -m.point[0].depth, TOL(2e-6, 2e-14)); /* but for the rounding of places */
    }
}

/* ---- wheels on the ground ---- */

static void onGround(MdtBclConstraint *c) {
    MdtBclGroundWheel *g = &c->of.groundWheel;
    g->isOnGround = METRUE;
    g->stiffness = g->freeLength = 1;
    g->distance = g->twinDistance = .5;
    g->low = -1e9;
    g->leanStiffness = g->barStiffness = 1;
    memcpy(g->twin, c->frame, sizeof g->twin);
    g->twin[0].position[1] += 1;
    g->twin[1].position[0] += .5;
    g->barBound[0] = -1;
    g->barBound[1] = 1;
}

/* m: of a suspension, from the attachment to where the ray meets the plane, less the wheel's radius. */
static double lengthOf(const Scene *s, const MdtBclFrame frame[2]) {
    double a[3], p[3], up[3], normal[3];
    keaApply(a, s->pose[0].R, frame[0].position);
    keaAddScaled(a, 1, s->pose[0].pos);
    keaApply(p, s->pose[1].R, frame[1].position);
    keaAddScaled(p, 1, s->pose[1].pos);
    keaSubtract(a, a, p);
    keaApply(up, s->pose[0].R, frame[0].primary);
    keaApply(normal, s->pose[1].R, frame[1].primary);
    return (keaDot(normal, a) - .5) / keaDot(normal, up);
}

static double lengthAt(Scene *s, double t, MeBool isBar) {
    setPoses(s, t);
    return lengthOf(s, s->joint.frame) - (isBar ? lengthOf(s, s->joint.of.groundWheel.twin) : 0);
}

TEST(wheels_on_the_ground) {
    for (int trial = 0; trial < TRIALS; trial++) {
        Scene s;
        seed = 77 + (unsigned long long)trial;
        makeScene(&s, MdtBclGROUNDWHEEL, NULL);
        alignAxes(&s, .1 * number());
        onGround(&s.joint);
        s.context.parameters.stepsize = 1e-12; /* its rows look ahead */
        ck_assert_int_eq(s.type->prepare(&s.joint, &s.context), 5);
        s.type->fill(&s.joint, &s.context, s.rows);
        for (int bar = 0; bar < 2; bar++) {
            const MdtKeaRow *row = &s.rows[bar ? 3 : 0];
            const double before = lengthAt(&s, -small, bar), after = lengthAt(&s, small, bar), rate = rateOf(&s, row);
            assert_near(rate, (after - before) / (2 * small), tolerance * (1 + fabs(rate)));
            assert_near(row->error, lengthAt(&s, 0, bar) - 1, 1e-9);
        }
    }
}
