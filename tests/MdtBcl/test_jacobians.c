/* Every joint's rows against finite differences: the rate J v of a position row is the derivative of its error, and the
 * rate of a limit that of its coordinate, for random frames, poses and velocities, met or not. */
#include "MdtBcl.h"
#include "MdtKeaMath.h"
#include "MeMath.h"
#include "karma_test.h"

static const double small = 1e-6; /* of a finite difference: errors of 1e-12 of curvature, 1e-10 of rounding */
static const double tolerance = 2e-8;

static unsigned long long seed;

static double number(void) { /* in -1..1 */
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(long long)(seed >> 11) / (double)(1LL << 52) - 1;
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
        s->context.acceleration[k] = &MdtBclWorldVelocity;
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
            assert_near(now[i], s.rows[i].error, 1e-12);
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
    c->of.skeletal.secondary = (MeReal).3;
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
    c->of.cone.limit.limit[1].stop = (MeReal).1;
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
    c->of.distance.limit.limit[0].stop = c->of.distance.limit.limit[1].stop = (MeReal).7;
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

START_TEST(position_rows) {
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
END_TEST

#define LIMIT(member) offsetof(MdtBclConstraint, of.member)

START_TEST(coordinates_of_limits) {
    checkCoordinate(MdtBclPRISMATIC, NULL, LIMIT(limit));
    checkCoordinate(MdtBclSPRING, string, LIMIT(distance.limit));
    checkCoordinate(MdtBclCONELIMIT, narrow, LIMIT(cone.limit));
    checkCoordinate(MdtBclSKELETAL, NULL, LIMIT(skeletal.cone)); /* a circular cone: an angle */
    checkCoordinate(MdtBclSKELETAL, NULL, LIMIT(skeletal.turn));
    checkCoordinate(MdtBclSKELETAL, slotSkeletal, LIMIT(skeletal.cone));
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, position_rows);
    tcase_add_test(t, coordinates_of_limits);
}

TEST_MAIN("jacobians", tests)
