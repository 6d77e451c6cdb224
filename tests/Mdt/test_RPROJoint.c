/* The RPRO joint: an orientation that the program drives, up to a strength; and FPFO, which holds everything. */
#include "measure.h"

static const double edge[3] = {.4, .7, .3};

typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtRPROJointID joint;
} Driven;

/* A body of the mass 2 at the world's origin, driven against the world. */
static Driven drive(double gravity) {
    Driven s;
    s.world = scene_world(2, 2, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_box(s.world, 2, edge, 0, 0, 0);
    s.joint = MdtRPROJointCreate(s.world);
    MdtRPROJointSetBodies(s.joint, s.body, 0);
    MdtRPROJointEnable(s.joint);
    return s;
}

/* Turned for the time t with the angular velocity w from the orientation `from`. */
static void turnedBy(const double w[3], double t, const double from[4], double q[4]) {
    double u[3], step[4];
    keaScale(u, t, w);
    keaQuaternionExp(step, u);
    keaQuaternionProduct(q, step, from);
}

static void setOrientation(MdtRPROJointID j, const double q[4], const double w[3]) {
    const MeVector4 r = {q[0], q[1], q[2], q[3]};
    MeVector3 rate = {w[0], w[1], w[2]};
    MdtRPROJointSetRelativeQuaternion(j, r);
    MdtRPROJointSetRelativeAngularVelocity(j, rate);
}

/* The angle between the body's orientation, seen from `base`, and a wanted one. */
static double angleOff(MdtBodyID b, MdtBodyID base, const double q[4]) {
    double R[2][3][3], W[3][3], worst = 0;
    measure_rotation(b, R[0]);
    measure_rotation(base, R[1]);
    keaQuaternionToMatrix(W, q);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double is = R[1][0][i] * R[0][0][j] + R[1][1][i] * R[0][1][j] + R[1][2][i] * R[0][2][j];
            worst = fmax(worst, fabs(is - W[i][j]));
        }
    return worst;
}

/* The mean of two rotations by D against each other is no rotation, by D²/8, which is 5e-7 here. */
static const double meanOfTurns = TOL(1e-5, 2e-6);

static const double straight[4] = {1, 0, 0, 0}, none[3] = {0, 0, 0};

/* ---- driving ---- */

/* Between two bodies that tumble. */
TEST(one_body_is_driven_in_another) {
    const double rate[3] = {1, 2, -1.5}, h = FRAME, other[3] = {.9, .2, .5};
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = scene_box(w, 2, edge, .5, 0, 0), b = scene_box(w, 3, other, -.5, 0, 0);
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtRPROJointSetBodies(j, a, b);
    MdtRPROJointSetAttachmentPosition(j, -.5, 0, 0, 0);
    MdtRPROJointSetAttachmentPosition(j, .5, 0, 0, 1);
    MdtRPROJointEnable(j);
    MdtBodySetAngularVelocity(b, 1, -2, 1);
    double q[4], p[2][3], L[2][3], momentum[3] = {0, 0, 0}, spin[3] = {0, 0, 0};
    const double arm[2][3] = {{-.5, 0, 0}, {.5, 0, 0}};
    for (int i = 0; i < 300; i++) {
        turnedBy(rate, i * h, straight, q);
        setOrientation(j, q, rate);
        MdtWorldStep(w, FRAME);
        turnedBy(rate, (i + 1) * h, straight, q);
        assert_below(angleOff(a, b, q), TOL(2e-6, 1e-8));
        measure_pointOut(a, arm[0], p[0]);
        measure_pointOut(b, arm[1], p[1]);
        for (int n = 0; n < 3; n++)
            assert_near(p[0][n], p[1][n], TOL(5e-7, 6e-10));
        measure_momentum(a, p[0], L[0]);
        measure_momentum(b, p[1], L[1]);
        for (int n = 0; n < 3; n++) { /* the drive is between the two */
            if (i == 0) {
                momentum[n] = p[0][n] + p[1][n];
                spin[n] = L[0][n] + L[1][n];
            }
            assert_near(p[0][n] + p[1][n], momentum[n], TOL(1e-6, 9e-14));
            assert_near(L[0][n] + L[1][n], spin[n], TOL(6e-7, 2e-11));
        }
    }
}

/* Without the angular velocity the joint is drawn after its quaternion: it lags by w h / γ. */
TEST(without_the_angular_velocity_it_lags) {
    const double rate[3] = {0, 0, 1}, h = FRAME, gamma = .2;
    Driven s = drive(0);
    double q[4], x[3], axis[3] = {1, 0, 0};
    for (int i = 0; i < 300; i++) {
        turnedBy(rate, i * h, straight, q);
        setOrientation(s.joint, q, none);
        MdtWorldStep(s.world, FRAME);
    }
    measure_turnOut(s.body, axis, x);
    const double lag = remainder(300 * h - atan2(x[1], x[0]), 8 * atan(1));
    assert_near_rel(lag, h / gamma, 2e-3); /* the rows see 2 sin(θ/2) */
}

/* Frames in the bodies: the first one, turned and shifted in its body, lies on the second one, turned by the
 * quaternion. */
TEST(the_attachment_frames_are_held_together) {
    const double f[2][4] = {{.8, .6, 0, 0}, {.5, .5, -.5, .5}}, q[4] = {.6, 0, .8, 0};
    const double at[2][3] = {{.3, -.2, .1}, {-.4, .5, .2}};
    MdtWorldID w = scene_world(2, 1, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID body[2] = {scene_box(w, 2, edge, 0, 0, 0), scene_box(w, 1, edge, 1, 1, 0)};
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtRPROJointSetBodies(j, body[0], body[1]);
    for (unsigned int k = 0; k < 2; k++) {
        MdtRPROJointSetAttachmentPosition(j, at[k][0], at[k][1], at[k][2], k);
        MdtRPROJointSetAttachmentQuaternion(j, f[k][0], f[k][1], f[k][2], f[k][3], k);
    }
    setOrientation(j, q, none);
    MdtRPROJointEnable(j);
    MdtBodySetAngularVelocity(body[0], 1, 0, 1);
    steps(w, 300, FRAME); /* it comes together first */
    for (int i = 0; i < 60; i++) {
        double p[2][3], F[2][3][3], W[3][3];
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < 2; k++) {
            measure_pointOut(body[k], at[k], p[k]);
            keaQuaternionToMatrix(F[k], f[k]);
        }
        keaQuaternionToMatrix(W, q);
        for (int n = 0; n < 3; n++)
            assert_near(p[0][n], p[1][n], TOL(8e-7, 2e-10));
        for (int n = 0; n < 3; n++) {
            /* the axis n of frame 0 in its body; the same of the wanted frame in body 1 */
            const double is[3] = {F[0][0][n], F[0][1][n], F[0][2][n]}, turned[3] = {W[0][n], W[1][n], W[2][n]};
            double wanted[3], a[3], b[3];
            keaApply(wanted, (const double(*)[3])F[1], turned);
            measure_turnOut(body[0], is, a);
            measure_turnOut(body[1], wanted, b);
            for (int i2 = 0; i2 < 3; i2++)
                assert_near(a[i2], b[i2], TOL(9e-7, 9e-14));
        }
    }
}

/* ---- strength ---- */

TEST(the_joint_holds_up_to_its_linear_strength) {
    Driven s = drive(0);
    double p[3], v[3], f[3];
    MdtRPROJointSetLinearStrength(s.joint, 100, 5, 100);
    for (int i = 0; i < 60; i++) { /* less than the strength in y, much more in x */
        MdtBodyAddForce(s.body, 90, -4.9, 0);
        MdtWorldStep(s.world, FRAME);
    }
    measure_position(s.body, p);
    assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 9e-14));
    for (int i = 1; i <= 30; i++) { /* more */
        MdtBodyAddForce(s.body, 90, -9, 0);
        MdtWorldStep(s.world, FRAME);
        measure_velocity(s.body, v);
        read_force(MdtRPROJointQuaConstraint(s.joint), 0, f);
        assert_vec3_near(f, -90, 5, 0, TOL(1e-4, 6e-11));
        assert_vec3_near(v, 0, -(9 - 5) / 2. * i * (double)FRAME, 0, TOL(1e-6, 2e-11));
    }
    measure_position(s.body, p);
    assert_below(p[1], -.2);
    steps(s.world, 600, FRAME); /* it comes back */
    measure_position(s.body, p);
    assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 9e-14));
}

TEST(the_joint_holds_up_to_its_angular_strength) {
    Driven s = drive(0);
    double w[3], t[3];
    MdtBodySetSphericalInertiaTensor(s.body, .5);
    MdtRPROJointSetAngularStrength(s.joint, 50, 50, 2);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddTorque(s.body, 30, 0, 1.9);
        MdtWorldStep(s.world, FRAME);
    }
    assert_below(angleOff(s.body, NULL, straight), TOL(1e-6, 1e-9));
    double rate = 0;
    for (int i = 1; i <= 30; i++) {
        MdtBodyAddTorque(s.body, 0, 0, 3);
        MdtWorldStep(s.world, FRAME);
        measure_rate(s.body, w);
        read_torque(MdtRPROJointQuaConstraint(s.joint), 0, t);
        assert_near(t[2], -2, meanOfTurns);
        rate += (3 + t[2]) / .5 * (double)FRAME;
        assert_vec3_near(w, 0, 0, rate, TOL(1e-6, 2e-10));
    }
    assert_below(.2, angleOff(s.body, NULL, straight));
    steps(s.world, 600, FRAME);
    assert_below(angleOff(s.body, NULL, straight), TOL(1e-6, 1e-8));
}

/* Strength 0 in one direction: free there, held in the others. */
TEST(no_strength_no_hold) {
    Driven s = drive(9.81);
    double p[3];
    MdtRPROJointSetLinearStrength(s.joint, MEINFINITY, 0, MEINFINITY);
    steps(s.world, 60, FRAME);
    measure_position(s.body, p);
    assert_near(p[0], 0, 9e-14);
    assert_near(p[1], -9.81 / 2, TOL(1e-5, 5e-13));
}

/* ---- FPFO ---- */

/* The strength is a torque, however far the joint is from its quaternion. */
TEST(overpowered_it_pulls_with_its_strength_at_any_angle) {
    for (int degrees = 30; degrees <= 150; degrees += 30) {
        const double angle = degrees * 3.14159265358979323846 / 180;
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtRPROJointID j = MdtRPROJointCreate(w);
        double t[3];
        MdtRPROJointSetBodies(j, b, 0);
        MdtRPROJointSetAngularStrength(j, 3, 3, 3);
        MdtRPROJointEnable(j);
        MdtBodySetQuaternion(b, cos(angle / 2), 0, sin(angle / 2), 0);
        MdtWorldStep(w, FRAME);
        read_torque(MdtRPROJointQuaConstraint(j), 0, t);
        assert_vec3_near(t, 0, -3, 0, meanOfTurns);
    }
}
