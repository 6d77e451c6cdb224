/* Position motors: an angle, a displacement, an orientation and a frame go to their target as the damped oscillator of
 * the motor's frequency and damping ratio does, whatever the masses, the step and the stiffness. */
#include "measure.h"

static const double pi = 3.14159265358979323846;

typedef enum { HINGE, SLIDER, BALL, SKELETAL, ALONG, ABOUT, KINDS } Kind;

typedef struct {
    MdtWorldID world;
    MdtBodyID body, other; /* a box of 1 x .2 x .1 m; null: the world */
    Kind kind;
    MdtConstraintID joint;
    MdtLimitID limit; /* of a hinge or slider */
} Machine;

static const double edge[3] = {1, .2, .1}, home[3] = {.5, 0, 0};

/* At the bodies' centres of mass, whose pull on the joint would change its effective mass with the angle; beside the
 * world, at the end of a box. */
static Machine machine(Kind kind, double mass, double otherMass, double gravity) {
    Machine m = {.kind = kind, .world = scene_world(4, 4, gravity)};
    const double end = otherMass > 0 ? home[0] : 0;
    MdtWorldSetEpsilon(m.world, 0);
    m.body = scene_box(m.world, mass, edge, home[0], home[1], home[2]);
    m.other = otherMass > 0 ? scene_box(m.world, otherMass, edge, home[0], home[1], home[2]) : NULL;
    if (kind == HINGE) {
        MdtHingeID j = scene_hinge(m.world, m.body, m.other, end, 0, 0, 0, 0, 1);
        m.joint = MdtHingeQuaConstraint(j);
        m.limit = MdtHingeGetLimit(j);
    } else if (kind == SLIDER) {
        MdtPrismaticID j = MdtPrismaticCreate(m.world);
        MdtPrismaticSetBodies(j, m.body, m.other);
        MdtPrismaticSetAxis(j, 0, 1, 0);
        m.joint = MdtPrismaticQuaConstraint(j);
        m.limit = MdtPrismaticGetLimit(j);
    } else if (kind == BALL) {
        m.joint = MdtBSJointQuaConstraint(scene_ball(m.world, m.body, m.other, end, 0, 0));
    } else if (kind == SKELETAL) {
        MdtSkeletalID j = MdtSkeletalCreate(m.world);
        MdtSkeletalSetBodies(j, m.body, m.other);
        MdtSkeletalSetPosition(j, end, 0, 0);
        MdtSkeletalSetConeOption(j, MdtSkeletalConeOptionFree);
        MdtSkeletalSetTwistOption(j, MdtSkeletalTwistOptionFree);
        m.joint = MdtSkeletalQuaConstraint(j);
    } else {
        MdtSpring6ID j = MdtSpring6Create(m.world);
        MdtSpring6SetBodies(j, m.body, m.other);
        MdtSpring6SetPosition(j, home[0], home[1], home[2]);
        m.joint = MdtSpring6QuaConstraint(j);
    }
    MdtConstraintEnable(m.joint);
    return m;
}

static void setMotor(Machine m, double frequency, double ratio, double force) {
    if (m.limit)
        MdtLimitSetPositionMotor(m.limit, MdtLimitGetMotorTarget(m.limit), frequency, ratio, force);
    else if (m.kind == BALL)
        MdtBSJointSetPositionMotor(MdtConstraintDCastBSJoint(m.joint), frequency, ratio, force);
    else if (m.kind == SKELETAL)
        MdtSkeletalSetPositionMotor(MdtConstraintDCastSkeletal(m.joint), frequency, ratio, force);
    for (int axis = 0; axis < 3 && m.kind >= ALONG; axis++) {
        MdtSpring6SetLinearMotor(MdtConstraintDCastSpring6(m.joint), axis, frequency, ratio, force);
        MdtSpring6SetAngularMotor(MdtConstraintDCastSpring6(m.joint), axis, frequency, ratio, force);
    }
}

/* A target about z, or along y, with its velocity. */
static void setTarget(Machine m, double target, double velocity) {
    const MeVector4 q = {(MeReal)cos(target / 2), 0, 0, (MeReal)sin(target / 2)};
    const MeVector3 p = {0, (MeReal)target, 0}, v = {0, (MeReal)velocity, 0}, w = {0, 0, (MeReal)velocity};
    if (m.limit)
        MdtLimitSetMotorTarget(m.limit, target, velocity);
    else if (m.kind == BALL)
        MdtBSJointSetMotorTarget(MdtConstraintDCastBSJoint(m.joint), q, w);
    else if (m.kind == SKELETAL)
        MdtSkeletalSetMotorTarget(MdtConstraintDCastSkeletal(m.joint), q, w);
    else if (m.kind == ALONG)
        MdtSpring6SetTargetPosition(MdtConstraintDCastSpring6(m.joint), p, v);
    else
        MdtSpring6SetTargetQuaternion(MdtConstraintDCastSpring6(m.joint), q, w);
}

static double angleOf(MdtBodyID b) {
    double R[3][3];
    measure_rotation(b, R);
    return atan2(R[1][0], R[0][0]);
}

static double coordinate(Machine m) {
    double p[3], q[3] = {0, 0, 0};
    measure_position(m.body, p);
    if (m.other)
        measure_position(m.other, q);
    return m.kind == SLIDER || m.kind == ALONG ? p[1] - q[1] : angleOf(m.body) - angleOf(m.other);
}

/* A contact that carries nothing, so that MdtSolverFast is obeyed: partitions without contacts are solved exactly. */
static void useFastSolver(Machine m) {
    MdtContactID c = MdtContactCreateBetween(m.world, m.body, NULL);
    MdtContactSetPosition(c, home[0], home[1], home[2]);
    MdtContactSetNormal(c, 0, 0, 1);
    MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFrictionZero);
    MdtContactEnable(c);
    MdtWorldSetSolver(m.world, MdtSolverFast);
}

/* The distance from the target of an oscillator that is let go at x. */
static double oscillator(double x, double frequency, double ratio, double t) {
    const double w = 2 * pi * frequency;
    if (ratio == 1)
        return x * exp(-w * t) * (1 + w * t);
    if (ratio < 1) {
        const double d = w * sqrt(1 - ratio * ratio);
        return x * exp(-ratio * w * t) * (cos(d * t) + ratio * w / d * sin(d * t));
    }
    const double s = w * sqrt(ratio * ratio - 1), fast = -ratio * w - s, slow = -ratio * w + s;
    return x * (fast * exp(slow * t) - slow * exp(fast * t)) / (fast - slow);
}

/* The largest error in a second at 1 Hz, with `rate` steps a second. */
static double errorOf(Kind kind, double mass, double otherMass, double ratio, int rate, MeBool isFast) {
    const double way = .3;
    Machine m = machine(kind, mass, otherMass, 0);
    setMotor(m, 1, ratio, 1e9);
    setTarget(m, way, 0);
    if (isFast)
        useFastSolver(m);
    double worst = 0;
    for (int i = 1; i <= rate; i++) {
        MdtWorldStep(m.world, 1. / rate);
        worst = fmax(worst, fabs(coordinate(m) - way + oscillator(way, 1, ratio, (double)i / rate)));
    }
    return worst;
}

/* Of second order by both solvers: an error of .001 at 60 steps a second, and a quarter of it at 120. */
LOOP_TEST(the_way_is_the_oscillator_s, 0, KINDS) {
    static const double ratios[] = {.1, .5, 1, 2}, others[] = {0, 3};
    for (int r = 0; r < 4; r++)
        for (int o = 0; o < 2; o++)
            for (int isFast = 0; isFast < 2; isFast++) {
                const double coarse = errorOf((Kind)_i, 2, others[o], ratios[r], 60, isFast);
                const double fine = errorOf((Kind)_i, 2, others[o], ratios[r], 120, isFast);
                assert_below(coarse, .0012);
                assert_near(coarse / fine, 4, .2);
            }
}

/* The frequency is that of the bodies' masses as the joint shows them, for each ratio of the masses. */
LOOP_TEST(masses_do_not_matter, 0, KINDS) {
    static const double others[] = {1e-3, 1e-1, 1e1, 1e3};
    for (int isFast = 0; isFast < 2; isFast++) {
        const double same = errorOf((Kind)_i, 1, 1, .5, 60, isFast);
        for (int o = 0; o < 4; o++)
            assert_near(errorOf((Kind)_i, 1, others[o], .5, 60, isFast), same, TOL(5e-6, 5e-6));
    }
}

/* At any frequency and damping: no further beyond the target than the oscillator, and there in the end. */
LOOP_TEST(it_overshoots_no_more_than_the_oscillator, 0, KINDS) {
    static const double ratios[] = {.3, .7, 1, 3, 30};
    const double way = .01;
    for (int r = 0; r < 5; r++)
        for (double perStep = 1e-2; perStep < 2e6; perStep *= 3) {
            Machine m = machine((Kind)_i, 2, _i % 2 ? 3 : 0, 0);
            const double beyond = ratios[r] < 1 ? exp(-pi * ratios[r] / sqrt(1 - ratios[r] * ratios[r])) : 0;
            double max = 0;
            setMotor(m, perStep / FRAME, ratios[r], MEINFINITY);
            setTarget(m, way, 0);
            const int n = perStep < .1 ? 60 : 12;
            for (int i = 0; i < n; i++) {
                MdtWorldStep(m.world, FRAME);
                max = fmax(max, coordinate(m) - way);
            }
            assert_below(max, beyond * way + 1e-6);
            if (perStep > 1e3)
                assert_near(coordinate(m), way, 1e-6);
        }
}

/* ---- loads and bounds ---- */

/* At rest under a load F the coordinate is off by F / (m w²): of weights on sliders g / w², and on the box at its end,
 * I = m (l² + d²) / 3 + ... about the hinge, m g l/2 cos q / (I w²). */
LOOP_TEST(a_load_leaves_an_offset, 0, KINDS) {
    const double g = 9.81, frequency = 4, w = 2 * pi * frequency, fromEnd = (1 + .04) / 12 + .25;
    if (_i == ABOUT)
        return; /* its torque is not the weight's: it moves along, too */
    for (int isFast = 0; isFast < 2; isFast++) {
        Machine m = machine((Kind)_i, 2, 0, g);
        setMotor(m, frequency, 1, MEINFINITY);
        if (isFast)
            useFastSolver(m);
        steps(m.world, 300, FRAME);
        double q = -g / (w * w);
        for (int i = 0; i < 50 && _i != SLIDER && _i != ALONG; i++)
            q = -g * .5 * cos(q) / (fromEnd * w * w);
        assert_near(coordinate(m), q, TOL(1e-6, 1e-6));
    }
}

/* N or N m: of the joint on the body, along y or about z at the hinge. */
static double force(Machine m) {
    MeVector3 f, t;
    double w[3];
    measure_rate(m.body, w);
    const double middle = angleOf(m.body) - w[2] * (double)FRAME / 2; /* of the step: where forces act */
    const double x = -home[0] * cos(middle), y = -home[0] * sin(middle);
    MdtConstraintGetForce(m.joint, 0, f);
    MdtConstraintGetTorque(m.joint, 0, t); /* about the centre of mass */
    return m.kind == SLIDER || m.kind == ALONG ? (double)f[1]
           : m.kind == ABOUT                   ? (double)t[2]
                                               : (double)t[2] - (x * (double)f[1] - y * (double)f[0]);
}

/* With all its force the motor moves its mass as a constant force does, x = F t² / 2 m. Where it is too stiff for the
 * midpoint rule, bodies are moved by the velocity at the end of a step: h / 2 ahead. */
LOOP_TEST(the_force_is_bounded, 0, KINDS) {
    const double max = .25, mass = _i == SLIDER || _i == ALONG ? 2
                                   : _i == ABOUT               ? 2 * 1.04 / 12
                                                               : 2 * (1.04 / 12 + .25);
    /* read back at the end's pose, which about a hinge is not that in which the force acts */
    const int more = _i == SLIDER || _i >= ALONG ? 120 : 0;
    for (double frequency = 3; frequency < 1e6; frequency *= 100)
        for (int isFast = 0; isFast < 2; isFast++) {
            Machine m = machine((Kind)_i, 2, 0, 0);
            setMotor(m, frequency, 1, max);
            setTarget(m, 1, 0);
            if (isFast)
                useFastSolver(m);
            double worst = 0;
            for (int i = 1; i <= 24; i++) {
                const double t = i * (double)FRAME;
                MdtWorldStep(m.world, FRAME);
                worst = fmax(worst, fabs(force(m)));
                assert_near(coordinate(m), max / mass * t * (t + (frequency > 20) * (double)FRAME) / 2, .0003);
            }
            assert_near(worst, max, max * 1e-4);
            for (int i = 0; i < more; i++) {
                MdtWorldStep(m.world, FRAME);
                assert_below(fabs(force(m)), max * (1 + TOL(2e-5, 2e-6)));
            }
        }
}

/* Ten boxes in a row, each held to the last one, under gravity: at 1e5 Hz straight to 6e-7 of a box, by both solvers,
 * though each is twice as heavy as the last. */
LOOP_TEST(stiff_motors_hold_a_beam, 0, 8) {
    enum { LINKS = 10 };
    const MeBool isFast = _i & 1, isBall = _i & 2;
    const double ratio = _i & 4 ? 2 : 1, bound = 1e7;
    MdtWorldID w = scene_world(LINKS, LINKS + 1, 9.81);
    MdtBodyID before = NULL;
    double mass = 1, p[3];
    MdtWorldSetEpsilon(w, 0);
    for (int i = 0; i < LINKS; i++, mass *= ratio) {
        MdtBodyID b = scene_box(w, mass, edge, i + .5, 0, 0);
        if (isBall)
            MdtBSJointSetPositionMotor(scene_ball(w, b, before, i, 0, 0), 1e5, 1, bound);
        else
            MdtLimitSetPositionMotor(MdtHingeGetLimit(scene_hinge(w, b, before, i, 0, 0, 0, 0, 1)), 0, 1e5, 1, bound);
        if (i == 0 && isFast)
            useFastSolver((Machine){.world = w, .body = b});
        before = b;
    }
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(w, FRAME);
        measure_position(before, p);
        assert_near(p[1], 0, 1e-3);
    }
    assert_near(p[0], LINKS - .5, 1e-6);
    measure_velocity(before, p);
    assert_near(keaLength(p), 0, TOL(1e-3, 1e-3));
}

/* Stiff motors at their bounds along a chain of light and heavy boxes: the force decides, and nothing runs away. */
LOOP_TEST(saturated_motors_stay_finite, 0, 12) {
    static const double masses[] = {.05, 20, .03, 2}, bounds[] = {.5, 20, 2e3};
    const MeBool isFast = _i & 1, isBall = _i & 2;
    const MeVector4 q = {(MeReal).8, 0, (MeReal).36, (MeReal).48};
    MdtWorldID w = scene_world(4, 5, 9.81);
    MdtBodyID link[4];
    MdtWorldSetEpsilon(w, 0);
    for (int i = 0; i < 4; i++) {
        MdtBodyID before = i ? link[i - 1] : NULL;
        link[i] = scene_box(w, masses[i], edge, i + .5, 0, 0);
        if (isBall) {
            MdtBSJointID j = scene_ball(w, link[i], before, i, 0, 0);
            MdtBSJointSetPositionMotor(j, 1e5, 1, bounds[_i / 4]);
            MdtBSJointSetMotorTarget(j, q, NULL);
        } else {
            MdtHingeID j = scene_hinge(w, link[i], before, i, 0, 0, 0, 0, 1);
            MdtLimitSetPositionMotor(MdtHingeGetLimit(j), 1, 1e5, 1, bounds[_i / 4]);
        }
    }
    if (isFast)
        useFastSolver((Machine){.world = w, .body = link[0]});
    for (int i = 0; i < 120; i++) {
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < 4; k++) {
            double v[3];
            measure_velocity(link[k], v);
            assert_below(keaLength(v), 1e3);
        }
    }
}

/* ---- targets ---- */

/* A target that moves is followed without lag, once the start is forgotten; the angle counts full turns. */
LOOP_TEST(a_moving_target_is_followed, 0, KINDS) {
    const double speed = 2;
    Machine m = machine((Kind)_i, 2, 0, 0);
    setMotor(m, 2, 1, MEINFINITY);
    for (int i = 0; i < 360; i++) {
        setTarget(m, speed * i * (double)FRAME, speed);
        MdtWorldStep(m.world, FRAME);
    }
    const double end = speed * 360 * (double)FRAME;
    const double error =
        coordinate(m) - end; /* steady turns lag by (w h)²/12 of what they turn, and are caught up with */
    assert_near(_i == SLIDER || _i == ALONG ? error : remainder(error, 2 * pi), 0, TOL(1e-4, 1e-4));
    if (m.limit)
        assert_near(MdtLimitGetPosition(m.limit), end, TOL(1e-4, 1e-4));
}

/* From any orientation to any other a ball joint turns as the oscillator: about one axis, although the box's moments of
 * inertia about its end differ by 60. */
LOOP_TEST(an_orientation_is_reached_straight, 0, 2) {
    const double angle = 1.5, axis[3] = {.48, .6, .64};
    Machine m = machine(_i ? SKELETAL : BALL, 2, 0, 0);
    const double c = cos(angle / 2), s = sin(angle / 2);
    const MeVector4 q = {(MeReal)c, (MeReal)(s * axis[0]), (MeReal)(s * axis[1]), (MeReal)(s * axis[2])};
    const double target[4] = {c, s * axis[0], s * axis[1], s * axis[2]};
    setMotor(m, 1, 1, MEINFINITY);
    if (_i)
        MdtSkeletalSetMotorTarget(MdtConstraintDCastSkeletal(m.joint), q, NULL);
    else
        MdtBSJointSetMotorTarget(MdtConstraintDCastBSJoint(m.joint), q, NULL);
    steps(m.world, 240, FRAME);
    MeVector4 now;
    MdtBodyGetQuaternion(m.body, now);
    double dot = 0;
    for (int i = 0; i < 4; i++)
        dot += (double)now[i] * target[i];
    assert_near(fabs(dot), 1, TOL(1e-6, 1e-9));
}

/* All six directions of a frame, each with a motor of its own, and one that is rigid. */
TEST(a_frame_goes_to_its_target) {
    Machine m = machine(ALONG, 2, 3, 0);
    MdtSpring6ID j = MdtConstraintDCastSpring6(m.joint);
    const MeVector3 place = {(MeReal).1, (MeReal)-.2, (MeReal).3};
    const MeVector4 turn = {(MeReal).8, 0, (MeReal).6, 0};
    for (int i = 0; i < 3; i++) {
        MdtSpring6SetLinearMotor(j, i, (MeReal)(1 + i), 1, 1e4);
        MdtSpring6SetAngularMotor(j, i, (MeReal)(2 + i), 1, 1e4);
    }
    MdtSpring6SetLinearMotor(j, 1, 0, 1, 0);
    MdtSpring6SetLinearStiffness(j, 1, MEINFINITY);
    MdtSpring6SetTargetPosition(j, place, NULL);
    MdtSpring6SetTargetQuaternion(j, turn, NULL);
    steps(m.world, 400, FRAME);
    double p[3], q[3], R[3][3], other[3][3], d[3], local[3];
    measure_position(m.body, p);
    measure_position(m.other, q);
    keaSubtract(d, p, q);
    measure_turnIn(m.other, d, local);
    assert_vec3_near(local, .1, -.2, .3, TOL(2e-6, 1e-7));
    measure_rotation(m.body, R);
    measure_rotation(m.other, other);
    const double axis[3] = {R[0][0], R[1][0], R[2][0]};
    measure_turnIn(m.other, axis, local);
    assert_vec3_near(local, .28, 0, -.96, TOL(2e-6, 1e-7)); /* R e_x: 1 - 2 .6², -2 .8 .6 */
    MeVector3 told;
    MeVector4 toldTurn;
    MdtSpring6GetTargetPosition(j, told);
    MdtSpring6GetTargetQuaternion(j, toldTurn);
    assert_vec3_near(told, .1, -.2, .3, 1e-7);
    assert_near(toldTurn[2], .6, 1e-7);
}

/* ---- two free bodies, sleep, stops, wheels ---- */

/* Adds a body's momentum and angular momentum about `home`, kg m/s, kg m²/s. */
static void addMomenta(MdtBodyID b, double mass, double sum[2][3]) {
    double p[3], v[3], w[3], local[3], spin[3], orbit[3];
    measure_position(b, p);
    measure_velocity(b, v);
    measure_rate(b, w);
    measure_turnIn(b, w, local);
    for (int i = 0; i < 3; i++) {
        const double y = edge[(i + 1) % 3], z = edge[(i + 2) % 3];
        local[i] *= mass * (y * y + z * z) / 12;
    }
    measure_turnOut(b, local, spin);
    keaSubtract(p, p, home);
    keaCross(orbit, p, v);
    keaAddScaled(sum[0], mass, v);
    keaAddScaled(sum[1], mass, orbit);
    keaAddScaled(sum[1], 1, spin);
}

/* Forces between two bodies are internal. (Where the motor is stiff, bodies that slide along each other do not keep it:
 * they are moved by the velocity at the end.) */
LOOP_TEST(free_bodies_keep_their_momenta, 0, KINDS) {
    for (int isStiff = 0; isStiff < (_i == SLIDER || _i == ALONG ? 1 : 2); isStiff++) {
        Machine m = machine((Kind)_i, 2, 3, 0);
        double before[2][3] = {{0}}, after[2][3] = {{0}};
        setMotor(m, isStiff ? 1e4 : 2, .5, 30);
        setTarget(m, 1, 0);
        MdtBodySetAngularVelocity(m.body, (MeReal).3, 1, 2);
        MdtBodySetAngularVelocity(m.other, (MeReal).3, 1, 2);
        addMomenta(m.body, 2, before);
        addMomenta(m.other, 3, before);
        steps(m.world, 120, FRAME);
        addMomenta(m.body, 2, after);
        addMomenta(m.other, 3, after);
        for (int k = 0; k < 2; k++)
            for (int i = 0; i < 3; i++)
                assert_near(after[k][i], before[k][i], TOL(2e-5, 1e-9));
    }
}

/* What has come to rest sleeps, and wakes for a new target. */
LOOP_TEST(a_new_target_wakes_a_sleeper, 0, KINDS) {
    Machine m = machine((Kind)_i, 2, 0, 1);
    MdtWorldSetAutoDisable(m.world, 1);
    setMotor(m, 5, 1, 1e3);
    steps(m.world, 400, FRAME);
    ck_assert(!MdtBodyIsEnabled(m.body));
    const double before = coordinate(m);
    setTarget(m, .2, 0);
    steps(m.world, 100, FRAME);
    assert_near(coordinate(m) - before, .2, .02);
}

TEST(a_stop_is_not_passed) {
    for (double frequency = 1; frequency < 1e6; frequency *= 10) {
        Machine m = machine(HINGE, 2, 0, 0);
        MdtSingleLimitSetStop(MdtLimitGetLowerLimit(m.limit), -1);
        MdtSingleLimitSetStop(MdtLimitGetUpperLimit(m.limit), (MeReal).25);
        MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(m.limit), 0);
        MdtLimitActivateLimits(m.limit, 1);
        MdtLimitSetPositionMotor(m.limit, 1, frequency, 1, 100);
        for (int i = 0; i < 240; i++) {
            MdtWorldStep(m.world, FRAME);
            assert_below(coordinate(m), .25 + 1e-5);
        }
        assert_near(coordinate(m), .25, 1e-5);
    }
}

TEST(a_wheel_steers_to_its_angle) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID chassis = scene_body(w, 100, 0, 0, 0), wheel = scene_body(w, 5, 1, 0, 0);
    MdtCarWheelID j = MdtCarWheelCreate(w);
    MdtCarWheelSetBodies(j, chassis, wheel);
    MdtCarWheelSetPosition(j, 1, 0, 0);
    MdtCarWheelSetSteeringAndHingeAxes(j, 0, 1, 0, 0, 0, 1);
    MdtCarWheelSetSuspension(j, 1e4, 1e3, 0, -1, 1, 0);
    MdtCarWheelEnable(j);
    MdtCarWheelSetSteeringPositionMotor(j, (MeReal).4, 3, 1, 50);
    steps(w, 120, FRAME);
    assert_near(MdtCarWheelGetSteeringAngle(j), .4, TOL(1e-4, 1e-4));
    MdtCarWheelSetSteeringLimitedForceMotor(j, 1, 50); /* the velocity again: of the wheel against the chassis */
    steps(w, 30, FRAME);
    assert_near(MdtCarWheelGetSteeringAngleRate(j), -1, TOL(1e-4, 1e-4));
}

/* ---- the interface ---- */

TEST(a_limit_has_one_motor) {
    Machine m = machine(HINGE, 2, 0, 0), other = machine(SLIDER, 2, 0, 0);
    MdtLimitSetMotorTarget(m.limit, 1, 0);
    assert_warned("position motor");
    MdtLimitSetPositionMotor(m.limit, 1, 2, 3, 4);
    MdtLimitSetMotorTarget(m.limit, 5, 6);
    MdtPrismaticSetLimit(MdtConstraintDCastPrismatic(other.joint), m.limit);
    assert_near(MdtLimitGetMotorTarget(other.limit), 5, 0);
    assert_near(MdtLimitGetMotorFrequency(other.limit), 2, 0);
    assert_near(MdtLimitGetMotorDampingRatio(other.limit), 3, 0);
    assert_near(MdtLimitGetMotorMaxForce(other.limit), 4, 0);
    assert_near(MdtLimitGetMotorDesiredVelocity(other.limit), 6, 0);
    ck_assert(MdtLimitIsMotorized(other.limit));
    MdtLimitSetLimitedForceMotor(other.limit, 1, 2);
    assert_near(MdtLimitGetMotorFrequency(other.limit), 0, 0);
    MdtLimitSetPositionMotor(m.limit, 1, 0, 1, 4);
    ck_assert(!MdtLimitIsMotorized(m.limit));
    MdtLimitSetPositionMotor(m.limit, 1, -1, 1, 4);
    assert_warned("frequency");
    MdtLimitSetPositionMotor(m.limit, 1, 1, -1, 4);
    assert_warned("damping ratio");
    MdtSpring6SetLinearMotor(MdtConstraintDCastSpring6(machine(ALONG, 1, 0, 0).joint), 3, 1, 1, 1);
    assert_warned("axis index");
    const MeVector4 none = {0, 0, 0, 0};
    MdtBSJointSetMotorTarget(MdtConstraintDCastBSJoint(machine(BALL, 1, 0, 0).joint), none, NULL);
    assert_warned("orientation");
}
