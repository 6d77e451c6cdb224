/* What holds for the motion of every joint: the degrees of freedom that it removes stay removed and the others free,
 * its forces are opposite and balance loads, momentum is kept, the order of the bodies does not matter where both sides
 * have the same role, and places where a joint loses its meaning are survived.
 *
 * Every joint is set up between two bodies at the same places, with the same frame: the axes p, o, t = p x o at a point
 * P. Where its two sides stand to each other is measured from the bodies' poses in the joint's six coordinates: the way
 * from side 1's point to side 0's along side 1's axes, and the turn of side 0's axes against side 1's as a rotation
 * vector. */
#include "measure.h"

enum { PX = 1, PO = 2, PT = 4, TX = 8, TO = 16, TT = 32, ALL_P = 7, ALL_T = 56, ALL = 63 };

typedef struct {
    MdtWorldID world;
    MdtBodyID body[2]; /* null: the world */
    MdtConstraintID joint;
    double point[2][3], axes[2][3][3]; /* where the joint was set up, world frame: by side, by axis */
    double localPoint[2][3], localAxes[2][3][3];
} Pair;

typedef struct {
    const char *name;
    MdtConstraintID (*create)(MdtWorldID w);
    void (*setUp)(Pair *s); /* after SetBodies */
    int rows;
    int held;                           /* coordinates that stay zero */
    int free;                           /* coordinates that move under random forces */
    double (*violation)(const Pair *s); /* of what is not a matter of held coordinates; may be null */
    int loads;                          /* coordinates that carry a force or torque */
    MeBool isSymmetric;                 /* the two sides have the same role */
    double exactness, tolerance;        /* of the held coordinates, of the violation */
} Joint;

/* ---- where the joint stands ---- */

static void pointNow(const Pair *s, int side, double p[3]) {
    measure_pointOut(s->body[side], s->localPoint[side], p);
}

static void axisNow(const Pair *s, int side, int axis, double a[3]) {
    measure_turnOut(s->body[side], s->localAxes[side][axis], a);
}

static void separation(const Pair *s, double d[3]) {
    double p[2][3];
    pointNow(s, 0, p[0]);
    pointNow(s, 1, p[1]);
    keaSubtract(d, p[0], p[1]);
}

/* The rotation vector of side 0's axes in side 1's. */
static void turnBetween(double a[2][3][3], double turn[3]) {
    double M[3][3], q[4];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            M[i][j] = keaDot(a[1][i], a[0][j]);
    keaQuaternionFromMatrix(q, (const double(*)[3])M);
    const double sine = keaLength(q + 1), angle = 2 * atan2(sine, q[0]);
    keaScale(turn, sine > 1e-12 ? angle / sine : 2, q + 1);
}

static void coordinates(const Pair *s, double x[6]) {
    double d[3], a[2][3][3];
    separation(s, d);
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 3; i++)
            axisNow(s, side, i, a[side][i]);
    for (int i = 0; i < 3; i++)
        x[i] = keaDot(d, a[1][i]);
    turnBetween(a, x + 3);
}

/* ---- violations that are not coordinates ---- */

static double universalViolation(const Pair *s) {
    double a[3], b[3];
    axisNow(s, 0, 0, a);
    axisNow(s, 1, 1, b);
    return fabs(keaDot(a, b));
}

/* The wheel's point on the line of the chassis along the steering axis, the hinge axis at right angles to that. */
static double wheelViolation(const Pair *s) {
    double d[3], axis[3][3], hinge[3];
    separation(s, d);
    for (int i = 0; i < 3; i++)
        axisNow(s, 0, i, axis[i]);
    axisNow(s, 1, 1, hinge);
    return fabs(keaDot(d, axis[1])) + fabs(keaDot(d, axis[2])) + fabs(keaDot(hinge, axis[0]));
}

static double lockedWheelViolation(const Pair *s) {
    double across[3], hinge[3];
    axisNow(s, 0, 2, across);
    axisNow(s, 1, 1, hinge);
    return wheelViolation(s) + fabs(keaDot(across, hinge));
}

enum { ROD_MM = 700 };
static const double rodLength = ROD_MM * 1e-3;

static double rodViolation(const Pair *s) {
    double d[3];
    separation(s, d);
    return fabs(keaLength(d) - rodLength);
}

static const double halfAngle = .5;

static double angleBetween(const double a[3], const double b[3]) {
    double across[3];
    keaCross(across, a, b);
    return atan2(keaLength(across), keaDot(a, b));
}

static double coneViolation(const Pair *s) {
    double a[3], b[3];
    axisNow(s, 0, 0, a);
    axisNow(s, 1, 0, b);
    return fmax(0, angleBetween(a, b) - halfAngle);
}

/* Swing and twist are held to pi/4. */
static double skeletalViolation(const Pair *s) {
    double a[2][3][3], q[4], M[3][3];
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 3; i++)
            axisNow(s, side, i, a[side][i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            M[i][j] = keaDot(a[1][i], a[0][j]);
    keaQuaternionFromMatrix(q, (const double(*)[3])M);
    const double quarter = atan(1), twist = remainder(2 * atan2(q[1], q[0]), 8 * quarter);
    return fmax(0, angleBetween(a[0][0], a[1][0]) - quarter) + fmax(0, fabs(twist) - quarter);
}

/* ---- setting up ---- */

#define XYZ(v) (MeReal)(v)[0], (MeReal)(v)[1], (MeReal)(v)[2]

#define CREATE(Joint)                                                                                                  \
    static MdtConstraintID create##Joint(MdtWorldID w) {                                                               \
        return Mdt##Joint##QuaConstraint(Mdt##Joint##Create(w));                                                       \
    }
CREATE(BSJoint)
CREATE(Hinge)
CREATE(Prismatic)
CREATE(Universal)
CREATE(Angular3)
CREATE(CarWheel)
CREATE(Linear1)
CREATE(Linear2)
CREATE(FixedPath)
CREATE(FPFOJoint)
CREATE(RPROJoint)
CREATE(Spring)
CREATE(Spring6)
CREATE(ConeLimit)
CREATE(Skeletal)
CREATE(UserConstraint)

static void setPoint(Pair *s) {
    MdtConstraintSetPosition(s->joint, XYZ(s->point[0]));
}

static void setPointAndAxis(Pair *s) {
    setPoint(s);
    MdtConstraintSetAxis(s->joint, XYZ(s->axes[0][0]));
}

static void setPointAndAxes(Pair *s) {
    setPoint(s);
    MdtConstraintSetAxes(s->joint, XYZ(s->axes[0][0]), XYZ(s->axes[0][1]));
}

static void setUpPrismatic(Pair *s) {
    MdtPrismaticSetAxis(MdtConstraintDCastPrismatic(s->joint), XYZ(s->axes[0][0]));
}

static void setUpUniversal(Pair *s) {
    MdtUniversalID j = MdtConstraintDCastUniversal(s->joint);
    setPoint(s);
    MdtUniversalSetAxis(j, 0, XYZ(s->axes[0][0]));
    MdtUniversalSetAxis(j, 1, XYZ(s->axes[1][1]));
}

static void setUpNothing(Pair *s) {
    (void)s;
}

static void setUpAngular2(Pair *s) {
    MdtAngular3ID j = MdtConstraintDCastAngular3(s->joint);
    MdtAngular3SetAxis(j, XYZ(s->axes[0][0]));
    MdtAngular3EnableRotation(j, 1);
}

static void setUpCarWheel(Pair *s) {
    MdtCarWheelID j = MdtConstraintDCastCarWheel(s->joint);
    setPoint(s);
    MdtCarWheelSetSteeringAxis(j, XYZ(s->axes[0][0]));
    MdtCarWheelSetHingeAxis(j, XYZ(s->axes[1][1]));
    MdtCarWheelSetSteeringLimitedForceMotor(j, 0, 0);
}

static void setUpLockedCarWheel(Pair *s) {
    setUpCarWheel(s);
    MdtCarWheelSetSteeringLock(MdtConstraintDCastCarWheel(s->joint), 1);
}

static void setUpLinear2(Pair *s) {
    setPoint(s);
    MdtLinear2SetDirection(MdtConstraintDCastLinear2(s->joint), XYZ(s->axes[0][0]));
}

static void setUpFixedPath(Pair *s) {
    MdtFixedPathID j = MdtConstraintDCastFixedPath(s->joint);
    for (unsigned int k = 0; k < 2; k++)
        MdtFixedPathSetPosition(j, k, XYZ(s->localPoint[k]));
}

static void setUpFPFO(Pair *s) {
    MdtFPFOJointSetPosition(MdtConstraintDCastFPFOJoint(s->joint), XYZ(s->point[0]));
}

/* Frames of the centres of mass: side 0 in side 1 as the bodies stand. */
static void setUpRPRO(Pair *s) {
    MdtRPROJointID j = MdtConstraintDCastRPROJoint(s->joint);
    double R[2][3][3], M[3][3], q[4];
    for (int k = 0; k < 2; k++) {
        measure_rotation(s->body[k], R[k]);
        MdtRPROJointSetAttachmentPosition(j, XYZ(s->localPoint[k]), (unsigned int)k);
    }
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < 3; l++)
            M[i][l] = R[1][0][i] * R[0][0][l] + R[1][1][i] * R[0][1][l] + R[1][2][i] * R[0][2][l];
    keaQuaternionFromMatrix(q, (const double(*)[3])M);
    const MeVector4 relative = {q[0], q[1], q[2], q[3]};
    MdtRPROJointSetRelativeQuaternion(j, relative);
}

/* The ends lie on the first axis, side 1's first. */
static void setUpRod(Pair *s) {
    MdtSpringID j = MdtConstraintDCastSpring(s->joint);
    for (unsigned int k = 0; k < 2; k++)
        MdtSpringSetPosition(j, k, XYZ(s->point[k]));
    MdtSpringSetStiffness(j, MEINFINITY);
}

static void setUpSpring6(Pair *s) {
    MdtSpring6ID j = MdtConstraintDCastSpring6(s->joint);
    setPointAndAxes(s);
    for (int i = 0; i < 3; i++) {
        MdtSpring6SetLinearStiffness(j, i, MEINFINITY);
        MdtSpring6SetAngularStiffness(j, i, MEINFINITY);
    }
}

/* At the limit: side 0's axes are turned about t by the half angle. */
static void setUpConeLimit(Pair *s) {
    MdtConeLimitID j = MdtConstraintDCastConeLimit(s->joint);
    for (unsigned int k = 0; k < 2; k++)
        MdtConeLimitBodySetAxes(j, k, XYZ(s->axes[k][0]), XYZ(s->axes[k][1]));
    MdtConeLimitSetConeHalfAngle(j, halfAngle);
}

/* A ball and socket: three rows along the world's axes, from the poses alone, the forces in the middle of the gap. */
static void MEAPI ballRows(MdtKeaConstraints *const list, void *const constraint,
                           const MdtKeaTransformation *const pose, MdtKeaBody *const bodies[],
                           const void *const params) {
    const Pair *s = constraint;
    const MdtBclSolverParameters *parameters = params;
    double arm[2][3], gap[3];
    (void)bodies;
    for (int k = 0; k < 2; k++)
        keaApply(arm[k], pose[k].R, s->localPoint[k]);
    for (int i = 0; i < 3; i++)
        gap[i] = pose[0].pos[i] + arm[0][i] - pose[1].pos[i] - arm[1][i];
    keaAddScaled(arm[0], -.5, gap);
    keaAddScaled(arm[1], .5, gap);
    for (int i = 0; i < 3; i++) {
        MdtKeaRow *row = MdtBclAddRow(list);
        for (int k = 0; k < 2; k++) {
            row->J[k].lin[i] = k == 0 ? 1 : -1;
            keaCross(row->J[k].ang, arm[k], row->J[k].lin);
        }
        row->error = gap[i];
        row->target = -parameters->gamma * gap[i] / parameters->stepsize;
    }
}

static void setUpUser(Pair *s) {
    MdtUserConstraintID j = MdtConstraintDCastUserConstraint(s->joint);
    MdtUserConstraintSetFunction(j, ballRows);
    MdtUserConstraintSetConstraintData(j, s);
}

/* ---- the joints ---- */

/* Poses are read in single precision there: places of about 1 m to 1e-7, and orientations. A hard limit whose axes turn
 * across it is noticed one step late: an axis that turns by an angle a step leaves it by half that square. */
#define EXACTLY      TOL(2e-6, 1e-8)
#define ABOUT_CURVES 1e-2

/* A program's own rows are met to first order: a turning arm leaves them. */
#define FIRST_ORDER 2e-2

static const Joint joints[] = {
    /* name, create, set up, rows; held, free, violation; loads, symmetric; tolerances of held and violation */
    {"BSJoint", createBSJoint, setPoint, 3, ALL_P, ALL_T, NULL, ALL_P, 1, EXACTLY, EXACTLY},
    {"Hinge", createHinge, setPointAndAxis, 5, ALL_P | TO | TT, TX, NULL, ALL_P | TO | TT, 1, EXACTLY, EXACTLY},
    {"Prismatic", createPrismatic, setUpPrismatic, 5, PO | PT | ALL_T, PX, NULL, PO | PT | ALL_T, 1, EXACTLY, EXACTLY},
    {"Universal", createUniversal, setUpUniversal, 4, ALL_P, TX | TO, universalViolation, ALL_P | TT, 0, EXACTLY,
     EXACTLY},
    {"Angular3", createAngular3, setUpNothing, 3, ALL_T, ALL_P, NULL, ALL_T, 1, EXACTLY, EXACTLY},
    {"Angular3 rotating", createAngular3, setUpAngular2, 2, TO | TT, ALL_P | TX, NULL, TO | TT, 1, EXACTLY, EXACTLY},
    {"CarWheel", createCarWheel, setUpCarWheel, 3, 0, PX | TX | TO, wheelViolation, PO | PT | TT, 0, EXACTLY, EXACTLY},
    {"CarWheel locked", createCarWheel, setUpLockedCarWheel, 4, 0, PX | TO, lockedWheelViolation, PO | PT | TX | TT, 0,
     EXACTLY, EXACTLY},
    {"Linear1", createLinear1, setPointAndAxis, 1, PX, PO | PT | ALL_T, NULL, PX, 0, EXACTLY, EXACTLY},
    {"Linear2", createLinear2, setUpLinear2, 2, PO | PT, PX | ALL_T, NULL, PO | PT, 0, EXACTLY, EXACTLY},
    {"FixedPath", createFixedPath, setUpFixedPath, 3, ALL_P, ALL_T, NULL, ALL_P, 1, EXACTLY, EXACTLY},
    {"FPFOJoint", createFPFOJoint, setUpFPFO, 6, ALL, 0, NULL, ALL, 1, EXACTLY, EXACTLY},
    {"RPROJoint", createRPROJoint, setUpRPRO, 6, ALL, 0, NULL, ALL, 1, EXACTLY, EXACTLY},
    {"Spring (rod)", createSpring, setUpRod, 1, 0, ALL_P | ALL_T, rodViolation, PX, 1, EXACTLY, EXACTLY},
    {"Spring6", createSpring6, setUpSpring6, 6, ALL, 0, NULL, ALL, 1, EXACTLY, EXACTLY},
    {"ConeLimit", createConeLimit, setUpConeLimit, 1, 0, ALL_P | ALL_T, coneViolation, TT, 1, EXACTLY, ABOUT_CURVES},
    {"Skeletal", createSkeletal, setPointAndAxes, 3, ALL_P, ALL_T, skeletalViolation, ALL_P, 1, EXACTLY, ABOUT_CURVES},
    {"UserConstraint", createUserConstraint, setUpUser, 3, ALL_P, ALL_T, NULL, ALL_P, 1, FIRST_ORDER, EXACTLY},
};
enum { NUM_JOINTS = sizeof joints / sizeof joints[0] };

/* ---- the pair ---- */

static MdtBodyID makeBody(MdtWorldID w, int which) {
    static const double edge[2][3] = {{.5, .8, .3}, {.9, .4, .6}}, mass[2] = {2, 3};
    static const double place[2][3] = {{.3, -.2, .1}, {1.2, .4, -.3}};
    MdtBodyID b = scene_box(w, mass[which], edge[which], place[which][0], place[which][1], place[which][2]);
    if (which == 0)
        MdtBodySetQuaternion(b, .7, .1, -.5, .5);
    else
        MdtBodySetQuaternion(b, .1, .7, .5, -.5);
    return b;
}

/* A rod is between two points on the first axis, a cone limit between axes that are turned against each other about t:
 * by body, so that the order of the bodies changes nothing else. */
static void placeJoint(const Joint *j, Pair *s, int sideOfBody0) {
    static const double point[3] = {.8, .2, .1}, axes[2][3] = {{.6, .48, .64}, {.8, -.36, -.48}};
    for (int k = 0; k < 2; k++) {
        keaCopy(s->point[k], point);
        keaCopy(s->axes[k][0], axes[0]);
        keaCopy(s->axes[k][1], axes[1]);
        keaCross(s->axes[k][2], axes[0], axes[1]);
    }
    if (j->setUp == setUpRod)
        keaAddScaled(s->point[1 - sideOfBody0], -rodLength, axes[0]);
    if (j->setUp == setUpConeLimit) {
        double p[3], o[3];
        keaScale(p, cos(halfAngle), axes[0]);
        keaAddScaled(p, sin(halfAngle), axes[1]);
        keaCross(o, s->axes[0][2], p);
        keaCopy(s->axes[sideOfBody0][0], p);
        keaCopy(s->axes[sideOfBody0][1], o);
    }
    for (int k = 0; k < 2; k++) {
        measure_pointIn(s->body[k], s->point[k], s->localPoint[k]);
        for (int i = 0; i < 3; i++)
            measure_turnIn(s->body[k], s->axes[k][i], s->localAxes[k][i]);
    }
}

/* Bodies 0 and 1 of makeBody in the joint's order; -1: the world. */
static void makePair(const Joint *j, Pair *s, int first, int second) {
    const int which[2] = {first, second};
    MdtBodyID made[2] = {NULL, NULL};
    memset(s, 0, sizeof *s);
    s->world = scene_world(2, 2, 0);
    MdtWorldSetEpsilon(s->world, 0);
    for (int b = 0; b < 2; b++) /* in the same order in every pair */
        if (b == first || b == second)
            made[b] = makeBody(s->world, b);
    for (int k = 0; k < 2; k++)
        s->body[k] = which[k] < 0 ? NULL : made[which[k]];
    s->joint = j->create(s->world);
    MdtConstraintSetBodies(s->joint, s->body[0], s->body[1]);
    placeJoint(j, s, first == 1);
    j->setUp(s);
    MdtConstraintEnable(s->joint);
}

static void assertHeld(const Joint *j, const Pair *s, int step) {
    double x[6];
    coordinates(s, x);
    for (int i = 0; i < 6; i++)
        ck_assert_msg(!(j->held & 1 << i) || fabs(x[i]) < j->exactness, "%s, step %d: coordinate %d is %.3g", j->name,
                      step, i, x[i]);
    const double off = j->violation ? j->violation(s) : 0;
    ck_assert_msg(off < j->tolerance, "%s, step %d: violated by %.3g", j->name, step, off);
}

/* ---- degrees of freedom ---- */

/* given: the sum of the impulses. */
static void pushAtRandom(Pair *s, Random *r, double given[3]) {
    for (int k = 0; k < 2; k++) {
        double f[3], t[3];
        random_vector(r, 20, f);
        random_vector(r, 3, t);
        if (!s->body[k])
            continue;
        for (int i = 0; i < 3; i++)
            f[i] = (MeReal)f[i];
        add_force(s->body[k], f);
        add_torque(s->body[k], t);
        keaAddScaled(given, (double)FRAME, f);
    }
}

static void totalMomentum(const Pair *s, double linear[3], double angular[3]) {
    keaZero(linear);
    keaZero(angular);
    for (int k = 0; k < 2; k++) {
        double p[3], L[3];
        if (!s->body[k])
            continue;
        measure_momentum(s->body[k], p, L);
        keaAddScaled(linear, 1, p);
        keaAddScaled(angular, 1, L);
    }
}

static void widen(double min[6], double max[6], const double x[6]) {
    for (int i = 0; i < 6; i++) {
        min[i] = fmin(min[i], x[i]);
        max[i] = fmax(max[i], x[i]);
    }
}

static void shake(const Joint *j, int first, int second) {
    Pair s;
    Random random = {4711};
    double x[6], min[6], max[6], p[3], L[3], given[3] = {0, 0, 0};
    makePair(j, &s, first, second);
    coordinates(&s, min);
    coordinates(&s, max);
    assertHeld(j, &s, 0);
    for (int i = 1; i <= 300; i++) {
        if (i % 2) /* one that goes on in the next step would be taken for samples of one that varies */
            pushAtRandom(&s, &random, given);
        MdtWorldStep(s.world, FRAME);
        assertHeld(j, &s, i);
        coordinates(&s, x);
        widen(min, max, x);
    }
    for (int i = 0; i < 6; i++)
        ck_assert_msg(!(j->free & 1 << i) || max[i] - min[i] > .1, "%s: coordinate %d moves by %.3g only", j->name, i,
                      max[i] - min[i]);
    totalMomentum(&s, p, L);
    for (int i = 0; i < 3 && first >= 0 && second >= 0; i++)
        assert_near(p[i], given[i], TOL(6e-6, 6e-13));
}

TEST(removed_freedoms_stay_removed_and_the_others_free) {
    for (int i = 0; i < NUM_JOINTS; i++)
        shake(&joints[i], 0, 1);
    messages_forget(); /* a universal joint may come to a right angle on its way */
}

TEST(the_world_stands_on_either_side) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        shake(&joints[i], 0, -1);
        shake(&joints[i], -1, 1);
    }
    messages_forget(); /* a universal joint may come to a right angle on its way */
}

/* About t: the cone limit's axes apart. */
static void turnOutwards(Pair *s) {
    double w[3];
    keaScale(w, 3, s->axes[0][2]);
    MdtBodySetAngularVelocity(s->body[0], XYZ(w));
}

TEST(each_joint_has_the_guide_s_number_of_rows) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        Pair s;
        makePair(&joints[i], &s, 0, 1);
        turnOutwards(&s);
        MdtWorldStep(s.world, FRAME);
        ck_assert_msg(MdtConstraintGetRowCount(s.joint) == joints[i].rows, "%s has %d rows", joints[i].name,
                      MdtConstraintGetRowCount(s.joint));
    }
}

/* ---- forces ---- */

/* Force opposite to force, and no torque in sum about the origin: the forces act at the mean of the places where the
 * bodies stood when the step began and where it has brought them. A program's own rows stay those of the start. */
TEST(forces_are_opposite) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        Pair s;
        Random random = {7};
        double max = 0;
        makePair(&joints[i], &s, 0, 1);
        for (int step = 0; step < 100; step++) {
            double place[2][3], end[2][3], f[2][3], t[2][3], about[3], sum[3] = {0, 0, 0}, given[3] = {0, 0, 0};
            pushAtRandom(&s, &random, given);
            measure_position(s.body[0], place[0]);
            measure_position(s.body[1], place[1]);
            MdtWorldStep(s.world, FRAME);
            for (unsigned int k = 0; k < 2; k++) {
                measure_position(s.body[k], end[k]);
                if (joints[i].setUp != setUpUser)
                    keaSubtract(end[k], end[k], place[k]), keaAddScaled(place[k], .5, end[k]);
                read_force(s.joint, k, f[k]);
                read_torque(s.joint, k, t[k]);
                keaCross(about, place[k], f[k]);
                keaAddScaled(sum, 1, about);
                keaAddScaled(sum, 1, t[k]);
            }
            max = fmax(max, fmax(keaLength(f[0]), keaLength(t[0])));
            for (int n = 0; n < 3; n++) {
                assert_near(f[1][n], -f[0][n], 0);
                ck_assert_msg(fabs(sum[n]) < TOL(1e-4, 1e-8), "%s, step %d: torques differ by %.3g", joints[i].name,
                              step, sum[n]);
            }
        }
        ck_assert_msg(max > 1, "%s gives no more than %.3g", joints[i].name, max);
    }
}

/* A load along what the joint holds, at its point: the body rests, and the joint gives back the load. Rows are met to
 * 1e-10 of their arms, up to 1 m, back and forth: in forces up to twice 2 m δ/h². */
static void balance(const Joint *j, int first, int second) {
    static const double size[6] = {3, 5, 7, 1.1, 1.3, 1.7}; /* N, N m */
    Pair s;
    makePair(j, &s, first, second);
    const unsigned int side = s.body[0] ? 0 : 1;
    double load[3] = {0, 0, 0}, turn[3] = {0, 0, 0}, arm[3], place[3], moved[3], back[3], lever[3];
    for (int i = 0; i < 6; i++)
        if (j->loads & 1 << i)
            keaAddScaled(i < 3 ? load : turn, side == 0 ? size[i] : -size[i], s.axes[1][i % 3]);
    measure_position(s.body[side], place);
    keaSubtract(arm, s.point[side], place);
    keaCross(lever, arm, load);
    keaAddScaled(turn, 1, lever);
    for (int step = 0; step < 50; step++) {
        add_force(s.body[side], load);
        add_torque(s.body[side], turn);
        MdtWorldStep(s.world, FRAME);
    }
    measure_position(s.body[side], moved);
    read_force(s.joint, side, back);
    for (int i = 0; i < 3; i++) {
        ck_assert_msg(fabs(moved[i] - place[i]) < TOL(1e-5, 1e-9), "%s has moved by %.3g", j->name,
                      moved[i] - place[i]);
        ck_assert_msg(fabs(back[i] + load[i]) < TOL(1e-4, 5e-6), "%s: force %d is %.9g against %.9g", j->name, i,
                      back[i], load[i]);
    }
    read_torque(s.joint, side, back);
    for (int i = 0; i < 3; i++)
        ck_assert_msg(fabs(back[i] + turn[i]) < TOL(1e-4, 5e-6), "%s: torque %d is %.9g against %.9g", j->name, i,
                      back[i], turn[i]);
}

TEST(the_force_read_back_balances_a_load) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        balance(&joints[i], 0, -1);
        balance(&joints[i], -1, 1);
    }
}

/* The angular momentum that a step of backward Euler adds: bodies go by h v⁺ and not by the mean, so that
 * Σ x × m v changes by (h/2) Σ m v⁺ × v. */
static void firstOrder(const Pair *s, double (*v)[3], double change[3]) {
    keaZero(change);
    for (int k = 0; k < 2; k++) {
        double next[3], turned[3];
        measure_velocity(s->body[k], next);
        keaCross(turned, next, v[k]);
        keaAddScaled(change, .5 * (double)FRAME * (double)MdtBodyGetMass(s->body[k]), turned);
        keaCopy(v[k], next);
    }
}

/* A joint that comes to stops and stays at them is taken by the midpoint rule or by backward Euler, step by step: its
 * angular momentum changes by nothing or by what the latter adds. */
static void stepsAtStops(const Pair *s, int n, double expected[3]) {
    double v[2][3], p[3], before[3], now[3], change[3], late[3];
    totalMomentum(s, p, before);
    for (int k = 0; k < 2; k++)
        measure_velocity(s->body[k], v[k]);
    for (int i = 0; i < n; i++) {
        MdtWorldStep(s->world, FRAME);
        totalMomentum(s, p, now);
        firstOrder(s, v, change);
        keaSubtract(late, now, before);
        if (keaDot(late, change) > .5 * keaDot(change, change))
            keaAddScaled(expected, 1, change);
        keaCopy(before, now);
    }
}

/* The program gives the rows of a user constraint for the start of a step, and they act at the mean of the poses, h/2
 * (v + v⁺)/2 further on: Σ x × m v changes by (h/4) Σ (v + v⁺) × m (v⁺ - v), the opposite. */
static void stepsWithOldRows(const Pair *s, int n, double expected[3]) {
    double v[2][3], change[3];
    for (int k = 0; k < 2; k++)
        measure_velocity(s->body[k], v[k]);
    for (int i = 0; i < n; i++) {
        MdtWorldStep(s->world, FRAME);
        firstOrder(s, v, change);
        keaAddScaled(expected, -1, change);
    }
}

/* A pair that is thrown, without any load: nothing from outside, so its momenta stay. */
TEST(a_free_pair_keeps_its_momenta) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        Pair s;
        double p[2][3], L[2][3];
        makePair(&joints[i], &s, 0, 1);
        MdtBodySetLinearVelocity(s.body[0], 1, 2, -1);
        MdtBodySetAngularVelocity(s.body[0], 2, -1, 3);
        MdtBodySetAngularVelocity(s.body[1], -1, 2, 2);
        totalMomentum(&s, p[0], L[0]);
        if (strcmp(joints[i].name, "Skeletal") == 0)
            stepsAtStops(&s, 300, L[0]);
        else if (strcmp(joints[i].name, "UserConstraint") == 0)
            stepsWithOldRows(&s, 300, L[0]);
        else
            steps(s.world, 300, FRAME);
        totalMomentum(&s, p[1], L[1]);
        for (int n = 0; n < 3; n++) {
            ck_assert_msg(fabs(p[1][n] - p[0][n]) < TOL(2e-5, 1e-9), "%s: momentum %g", joints[i].name, p[1][n]);
            ck_assert_msg(fabs(L[1][n] - L[0][n]) < TOL(1e-4, 1e-8), "%s: angular momentum %.9g from %.9g",
                          joints[i].name, L[1][n], L[0][n]);
        }
    }
    messages_forget(); /* a universal joint may come to a right angle on its way */
}

/* ---- life ---- */

TEST(a_joint_acts_only_while_it_is_enabled) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        Pair s;
        double v[3], w[3], f[3];
        makePair(&joints[i], &s, 0, 1);
        MdtConstraintDisable(s.joint);
        MdtBodySetLinearVelocity(s.body[0], 1, 2, 3);
        MdtBodySetLinearVelocity(s.body[1], -1, -2, -3);
        steps(s.world, 5, FRAME);
        measure_velocity(s.body[0], v);
        measure_rate(s.body[0], w);
        read_force(s.joint, 0, f);
        assert_vec3_near(v, 1, 2, 3, 0);
        assert_vec3_near(w, 0, 0, 0, 0);
        assert_vec3_near(f, 0, 0, 0, 0);
        turnOutwards(&s);
        MdtConstraintEnable(s.joint);
        MdtWorldStep(s.world, FRAME);
        measure_rate(s.body[1], w);
        measure_velocity(s.body[1], v);
        v[0] += 1, v[1] += 2, v[2] += 3;
        ck_assert_msg(keaLength(v) + keaLength(w) > .1, "%s does not act", joints[i].name);
    }
}

/* ---- the order of the bodies ---- */

/* Each step meets its rows to 1e-10 of arms up to 1 m, by another way for the other order: up to 6e-9 in rates, for 100
 * steps and 1.7 s. */
static const double sameWay = TOL(1e-5, 1e-6);

/* Skeletal measures its swing and twist at the mean of the poses, which is no rotation, by (w h)²/8, where w is how
 * fast the two turn against each other: from one side and from the other its stops turn them by that share differently.
 */
static double meanTurn(const Pair *s, int step, double *fastest) {
    double w[2][3];
    for (int k = 0; k < 2; k++)
        measure_rate(s->body[k], w[k]);
    keaSubtract(w[0], w[0], w[1]);
    *fastest = fmax(*fastest, keaLength(w[0]));
    return pow(*fastest * (double)FRAME, 2) / 8 * *fastest * step * (double)FRAME;
}

/* Linear1, Linear2 and CarWheel have two different sides, and so has the universal joint, whose axes must change
 * places: they are in the tests of their own. */
TEST(the_order_of_the_bodies_does_not_matter) {
    for (int i = 0; i < NUM_JOINTS; i++) {
        Pair s[2];
        if (!joints[i].isSymmetric)
            continue;
        makePair(&joints[i], &s[0], 0, 1);
        makePair(&joints[i], &s[1], 1, 0);
        double fastest = 0;
        for (int step = 0; step < 100; step++) {
            for (int order = 0; order < 2; order++) {
                const double f[3] = {4 * sin(.1 * step), 3, -2}, t[3] = {1, cos(.1 * step), .5};
                add_force(s[order].body[order], f);
                add_torque(s[order].body[1 - order], t);
                MdtWorldStep(s[order].world, FRAME);
            }
            for (int k = 0; k < 2; k++) {
                double p[2][3], R[2][3][3];
                for (int order = 0; order < 2; order++) {
                    measure_position(s[order].body[order ^ k], p[order]);
                    measure_rotation(s[order].body[order ^ k], R[order]);
                }
                const double same =
                    strcmp(joints[i].name, "Skeletal") ? sameWay : sameWay + meanTurn(&s[0], step, &fastest);
                for (int n = 0; n < 3; n++) {
                    ck_assert_msg(fabs(p[0][n] - p[1][n]) < same, "%s, step %d: places differ by %.3g", joints[i].name,
                                  step, p[0][n] - p[1][n]);
                    ck_assert_msg(fabs(R[0][n][0] - R[1][n][0]) < same, "%s, step %d: axes differ by %.3g",
                                  joints[i].name, step, R[0][n][0] - R[1][n][0]);
                }
            }
        }
    }
}

/* ---- gaps that the program opens --------------------------------------------------------------------------------- */

static double speedOf(const Pair *s) {
    double speed = 0;
    for (int k = 0; k < 2; k++) {
        MeVector3 v = {0}, w = {0};
        if (s->body[k]) {
            MdtBodyGetLinearVelocity(s->body[k], v);
            MdtBodyGetAngularVelocity(s->body[k], w);
        }
        speed = fmax(speed, (double)MeVector3Magnitude(v) + (double)MeVector3Magnitude(w));
    }
    return speed;
}

/* Moves body 0 along an axis of the world, and turns it. */
static void openPair(const Pair *s, int axis, double gap, double angle) {
    MeVector3 p;
    MeVector4 q;
    MdtBodyGetPosition(s->body[0], p);
    MdtBodyGetQuaternion(s->body[0], q);
    p[axis] += (MeReal)gap;
    const double c = cos(angle / 2), n = sin(angle / 2);
    MdtBodySetPosition(s->body[0], XYZ(p));
    MdtBodySetQuaternion(s->body[0], (MeReal)(c * (double)q[0] - n * (double)q[3]),
                         (MeReal)(c * (double)q[1] - n * (double)q[2]), (MeReal)(c * (double)q[2] + n * (double)q[1]),
                         (MeReal)(c * (double)q[3] + n * (double)q[0]));
}

static void makeHeavier(MdtBodyID b, double factor) {
    MeMatrix3 inertia;
    MdtBodyGetInertiaTensor(b, inertia);
    for (int i = 0; i < 9; i++)
        inertia[i / 3][i % 3] *= (MeReal)factor;
    MdtBodySetMass(b, (MeReal)factor * MdtBodyGetMass(b));
    MdtBodySetInertiaTensor(b, inertia);
}

/* Bodies that stand still and are pulled together by a joint stand still after each step, wherever the joint is. Gaps
 * below a hundred thousandth of their size close with a velocity. */
LOOP_TEST(a_gap_closes_without_a_velocity, 0, NUM_JOINTS) {
    static const double gaps[] = {.01, .3, 2}, steps[] = {1. / 30, 1. / 60, 1. / 240}, factors[] = {1, 1000};
    static const double gamma = .2, smallest = 1e-5;
    const Joint *j = &joints[_i];
    for (int k = 0; k < 3 * 3 * 2 * 2 && j->setUp != setUpUser; k++) {
        Pair s;
        const double gap = gaps[k % 3], h = steps[k / 3 % 3];
        const int isPair = k / 9 % 2;
        double x[6], fastest = 0;
        if (j->setUp == setUpUniversal && gap > 1) /* on its way it would be bent by 90 degrees */
            continue;
        makePair(j, &s, 0, isPair ? 1 : -1);
        MdtWorldSetEpsilon(s.world, (MeReal)1e-4);
        makeHeavier(s.body[0], factors[k / 18]);
        if (isPair)
            MdtConstraintDisable(s.joint);
        openPair(&s, k / 2 % 3, gap, gap < 1 ? gap : 0);
        if (isPair)
            MdtConstraintEnable(s.joint);
        for (int i = 0; i < 120; i++) {
            MdtWorldStep(s.world, (MeReal)h);
            fastest = fmax(fastest, speedOf(&s));
        }
        ck_assert_msg(fastest < 2 * gamma * smallest / h, "%s, %d: %g m/s or rad/s", j->name, k, fastest);
        coordinates(&s, x);
        for (int i = 0; i < 6; i++)
            ck_assert_msg(!(j->held & 1 << i) || fabs(x[i]) < 1e-5, "%s, %d: coordinate %d is %g", j->name, k, i, x[i]);
    }
}
