/* The hinge: its angle, its stops, its motor. */
#include "measure.h"

static const double inertia = (4 + 1e-6) / 12; /* it is a millimetre thick */
static const double pi = 3.14159265358979323846;

/* Turning steadily, the bar keeps its rate, to what the solver leaves. */
static const double steady = TOL(5e-6, 2e-8);

static double angleOf(HingedBar s) {
    return MdtLimitGetPosition(s.limit);
}

static double rateOf(HingedBar s) {
    MeVector3 w;
    MdtBodyGetAngularVelocity(s.bar, w);
    return w[2];
}

static void setStops(HingedBar s, double lower, double upper, double restitution) {
    MdtSingleLimitID stop[2] = {MdtLimitGetLowerLimit(s.limit), MdtLimitGetUpperLimit(s.limit)};
    MdtSingleLimitSetStop(stop[0], lower);
    MdtSingleLimitSetStop(stop[1], upper);
    MdtSingleLimitSetRestitution(stop[0], restitution);
    MdtSingleLimitSetRestitution(stop[1], restitution);
    MdtLimitActivateLimits(s.limit, 1);
}

static void setSpring(HingedBar s, double stiffness, double damping) {
    MdtSingleLimitID stop[2] = {MdtLimitGetLowerLimit(s.limit), MdtLimitGetUpperLimit(s.limit)};
    for (int i = 0; i < 2; i++) {
        MdtSingleLimitSetStiffness(stop[i], stiffness);
        MdtSingleLimitSetDamping(stop[i], damping);
    }
}

TEST(only_the_angle_is_free) {
    HingedBar s = scene_hingedBar(0);
    MdtBodyAddImpulseAtPosition(s.bar, .3, 1, .7, 1, 0, .2);
    for (int i = 0; i < 300; i++) {
        MeVector3 p, w;
        MdtWorldStep(s.world, FRAME);
        MdtBodyGetPosition(s.bar, p);
        MdtBodyGetAngularVelocity(s.bar, w);
        assert_near(p[2], 0, TOL(1e-7, 9e-14));
        assert_near(sqrt((double)p[0] * p[0] + (double)p[1] * p[1]), .5, TOL(5e-7, 5e-14));
        assert_near(w[0], 0, TOL(1e-6, 9e-14));
        assert_near(w[1], 0, TOL(1e-6, 9e-14));
        assert_near(w[2], 1 / inertia, steady); /* 1 N s at 1 m */
    }
}

TEST(the_angle_counts_full_turns) {
    const double rates[] = {3, -3, 40, -170}; /* the last one is 0.45 of a turn a step */
    for (int k = 0; k < 4; k++) {
        HingedBar s = scene_hingedBar(0);
        MdtBodySetCenterOfMassRelativePosition(s.bar, (MeVector3){-.5, 0, 0}); /* a rotor: no swing */
        MdtBodySetAngularVelocity(s.bar, 0, 0, rates[k]);
        steps(s.world, 600, FRAME);
        assert_near_rel(angleOf(s), 600 * divided_turn(rates[k], FRAME, 1), TOL(1e-6, 9e-14));
        assert_near_rel(MdtLimitGetVelocity(s.limit), rates[k], TOL(1e-6, 9e-14));
    }
}

TEST(position_is_only_an_offset) {
    HingedBar s = scene_hingedBar(0);
    scene_spinBar(s, 1);
    steps(s.world, 30, FRAME);
    MdtLimitSetPosition(s.limit, 7);
    assert_near(angleOf(s), 7, 0);
    MeVector3 before, after;
    MdtBodyGetPosition(s.bar, before);
    steps(s.world, 30, FRAME);
    MdtBodyGetPosition(s.bar, after);
    assert_near(angleOf(s), 7 + 30 * midpoint_turn(1, FRAME), steady);
    assert_near(after[0], .5 * cos(60 * midpoint_turn(1, FRAME)), steady);
}

TEST(a_hard_stop_returns_its_restitution_in_one_step) {
    const double es[] = {0, .5, 1};
    for (int k = 0; k < 3; k++)
        for (int side = -1; side <= 1; side += 2) {
            HingedBar s = scene_hingedBar(0);
            setStops(s, -.7, .9, es[k]);
            scene_spinBar(s, 2 * side);
            double max = 0, before = 2 * side;
            int reversals = 0;
            for (int i = 0; i < 40; i++) {
                MdtWorldStep(s.world, FRAME);
                max = fmax(max, angleOf(s) * side);
                if (fabs(rateOf(s) - before) > 1e-3) {
                    reversals++;
                    if (es[k] > 0)
                        assert_near(rateOf(s), -es[k] * 2 * side, steady);
                }
                before = rateOf(s);
            }
            if (es[k] == 0) {
                ck_assert_int_le(reversals, 2); /* it arrives within a step, then stands */
                assert_near(rateOf(s), 0, TOL(1e-6, 7e-12));
                assert_near(max, side > 0 ? .9 : .7, TOL(1e-6, 5e-12));
                assert_near(angleOf(s), side > 0 ? .9 : -.7, TOL(1e-6, 5e-12));
            } else {
                ck_assert_int_eq(reversals, 1);
                assert_below(max, (side > 0 ? .9 : .7) + TOL(1e-6, 1e-9));
            }
        }
}

TEST(a_lossless_stop_keeps_the_energy_of_a_falling_bar) {
    HingedBar s = scene_hingedBar(9.81);
    setStops(s, -.4, 3, 1);
    double min = 1e9, max = -1e9;
    for (int i = 0; i < 1200; i++) {
        MdtWorldStep(s.world, FRAME);
        MeVector3 p;
        MdtBodyGetPosition(s.bar, p);
        const double energy = .5 * inertia * rateOf(s) * rateOf(s) + 9.81 * (double)p[1];
        min = fmin(min, energy);
        max = fmax(max, energy);
    }
    assert_below(max, .25); /* of g v h / 2, by which a hit can come late; it started with 0 */
    assert_below(-min, .25);
}

TEST(stops_lie_beyond_full_turns) {
    HingedBar s = scene_hingedBar(0);
    setStops(s, -3 * pi, 5 * pi, 1);
    scene_spinBar(s, 9);
    double max = 0, min = 0;
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, angleOf(s));
        min = fmin(min, angleOf(s));
    }
    ck_assert_msg(max > 5 * pi - .16 && max <= 5 * pi + 1e-5, "highest angle %g", max);
    ck_assert_msg(min < -3 * pi + .16 && min >= -3 * pi - 1e-5, "lowest angle %g", min);
    assert_near(fabs(rateOf(s)), 9, steady);
}

/* A torque presses the bar onto the stop and it swings about the balance, beyond the stop all the time:
 * I θ'' = -k θ - d θ' - load. */
TEST(a_soft_stop_is_a_damped_spring) {
    const double ks[] = {10, 40, 160}, ds[] = {0, .1, .5}, load = .3;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const double w0 = sqrt(ks[a] / inertia), decay = ds[b] / (2 * inertia), rest = -load / ks[a];
            HingedBar s = scene_hingedBar(0);
            Swing swing = {0};
            setStops(s, 0, 10, 0);
            setSpring(s, ks[a], ds[b]);
            MdtLimitSetPosition(s.limit, .5 * rest);
            for (int i = 0; i < 3000 && swing.crossings < 9; i++) {
                MdtBodyAddTorque(s.bar, 0, 0, -load);
                MdtWorldStep(s.world, FRAME);
                swing_add(&swing, angleOf(s) - rest);
            }
            ck_assert_int_eq(swing.crossings, 9);
            swing_check(&swing, w0, decay, FRAME, TOL(1e-5, 2e-7));
        }
}

/* A stiffness that no explicit rule could bear: still no energy from nowhere. */
TEST(a_very_stiff_soft_stop_gains_no_energy) {
    HingedBar s = scene_hingedBar(9.81);
    setStops(s, -.5, 10, 0);
    setSpring(s, 1e8, 0);
    double max = 0;
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(s.world, FRAME);
        max = fmax(max, angleOf(s));
    }
    assert_below(max, .05); /* it started at 0 */
    assert_near(angleOf(s), -.5, TOL(6e-7, 5e-7));
}

TEST(a_stop_without_stiffness_and_damping_does_nothing) {
    HingedBar s = scene_hingedBar(0);
    setStops(s, -1, .5, 1);
    setSpring(s, 0, 0);
    scene_spinBar(s, 2);
    steps(s.world, 60, FRAME);
    const double turned = 60 * midpoint_turn(2, FRAME);
    assert_near(rateOf(s), 2, steady);
    assert_near(angleOf(s), turned, steady);
    assert_near(MdtLimitGetOvershoot(s.limit), turned - .5, steady);
}

TEST(the_motor_reaches_its_speed_with_its_force) {
    HingedBar s = scene_hingedBar(0);
    MdtLimitSetLimitedForceMotor(s.limit, 10, .5);
    ck_assert(MdtLimitIsMotorized(s.limit));
    const double acceleration = .5 / inertia;
    for (int i = 1; i <= 500; i++) {
        MdtWorldStep(s.world, FRAME);
        const double rate = fmin(10, acceleration * i * (double)FRAME);
        assert_near(rateOf(s), rate, steady);
    }
}

TEST(the_motor_stalls_at_its_force_limit) {
    /* gravity turns the horizontal bar with m g / 2 = 4.905 N m */
    HingedBar weak = scene_hingedBar(9.81);
    MdtLimitSetLimitedForceMotor(weak.limit, 5, 3);
    MdtWorldStep(weak.world, FRAME);
    assert_near_rel(rateOf(weak), -(4.905 - 3) / inertia * (double)FRAME, TOL(2e-6, 3e-6));
    HingedBar brake = scene_hingedBar(9.81);
    MdtLimitSetLimitedForceMotor(brake.limit, 0, 5);
    steps(brake.world, 300, FRAME);
    assert_near(angleOf(brake), 0, TOL(1e-6, 3e-8));
}

/* Without loads there is no speed to compare with but the bar's own, of which a brake leaves less and less: what moves
 * nothing in a step is no speed. From the fourth step on, 66 factorizations were taken in a dozen steps, then 3. */
TEST(what_a_motor_has_stopped_costs_nothing) {
    HingedBar s = scene_hingedBar(0);
    MdtWorldEnableReport(s.world);
    MdtBodySetAngularVelocity(s.bar, 0, 0, 1);
    MdtLimitSetLimitedForceMotor(s.limit, 0, 100);
    int max = 0;
    for (int i = 0; i < 200; i++) {
        MdtReport r;
        MdtWorldStep(s.world, FRAME);
        ck_assert(MdtWorldGetReport(s.world, &r));
        max = MeMAX(max, r.factorizations);
    }
    ck_assert_int_le(max, 12);
    assert_near(rateOf(s), 0, 1e-20);
}

/* The bar lies on the stop, motor and stop in balance: fmax = stiffness × overshoot. */
TEST(the_lock_holds_up_to_its_force) {
    HingedBar s = scene_hingedBar(10); /* its weight turns with 5 N m where the bar is level */
    MdtLimitSetLock(s.limit, -.2, 6);
    MdtLimitSetLimitedForceMotor(s.limit, 3, 100); /* rests while the lock holds */
    ck_assert(MdtLimitIsLocked(s.limit));
    steps(s.world, 240, FRAME);
    assert_near(angleOf(s), -.2, TOL(2e-7, 2e-9));
    MdtLimitSetLock(s.limit, -.2, 3);
    steps(s.world, 20, FRAME);
    assert_below(angleOf(s), -.3); /* overpowered */
    MdtLimitActivateLock(s.limit, 0);
    steps(s.world, 240, FRAME);
    assert_near(rateOf(s), 3, TOL(3e-6, 2e-11));
}

TEST(a_motor_rests_on_a_soft_stop_at_fmax_over_stiffness) {
    HingedBar s = scene_hingedBar(0);
    setStops(s, -1, .5, 0);
    setSpring(s, 40, 2);
    MdtLimitSetLimitedForceMotor(s.limit, 3, 8);
    steps(s.world, 1200, FRAME);
    assert_near(MdtLimitGetOvershoot(s.limit), 8.0 / 40, TOL(2e-7, 1e-9));
    assert_near(rateOf(s), 0, TOL(1e-6, 1e-8));
}

/* An arm driven up against a stop at 45 degrees: it comes to rest there, without rattling; the stop carries what the
 * motor has to spare, 10 - m g/2 cos 45°. */
TEST(a_motor_rests_on_a_hard_stop) {
    const double es[] = {0, .5};
    for (int k = 0; k < 2; k++) {
        HingedBar s = scene_hingedBar(9.81);
        setStops(s, -1, pi / 4, es[k]);
        MdtLimitSetLimitedForceMotor(s.limit, 50, 10);
        steps(s.world, 300, FRAME);
        double max = 0, min = 10;
        for (int i = 0; i < 60; i++) {
            MdtWorldStep(s.world, FRAME);
            max = fmax(max, angleOf(s));
            min = fmin(min, angleOf(s));
        }
        assert_near(min, pi / 4, TOL(1e-6, 1e-9));
        assert_near(max, pi / 4, TOL(1e-6, 3e-9));
        assert_near(s.limit->stopForce[1], 10 - 4.905 * cos(pi / 4), TOL(7e-6, 5e-7));
    }
}

/* What the joint gives back about the hinge's axis is motor minus stop: gravity's torque. */
TEST(the_torque_read_back_balances_the_load) {
    HingedBar s = scene_hingedBar(9.81);
    MdtLimitSetLimitedForceMotor(s.limit, 0, 20);
    steps(s.world, 300, FRAME);
    MeVector3 f, t, p, other;
    MdtHingeGetForce(s.hinge, 0, f);
    MdtHingeGetTorque(s.hinge, 0, t);
    MdtBodyGetPosition(s.bar, p);
    assert_vec3_near(f, 0, 9.81, 0, TOL(1e-5, 2e-8));
    const double aboutHinge = t[2] + ((double)p[0] * f[1] - (double)p[1] * f[0]);
    assert_near(aboutHinge, 4.905, TOL(5e-6, 3e-10));
    MdtHingeGetForce(s.hinge, 1, other);
    assert_vec3_near(other, -f[0], -f[1], -f[2], 0);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtHingeQuaConstraint(s.hinge)), 6);
}

/* The world as the first body: the same motion, the angle of the other sign. */
TEST(the_bodies_order_mirrors_the_angle) {
    HingedBar a = scene_hingedBar(9.81), b = scene_hingedBar(9.81);
    MdtHingeDisable(b.hinge);
    MdtHingeSetBodies(b.hinge, 0, b.bar);
    MdtHingeSetPosition(b.hinge, 0, 0, 0);
    MdtHingeSetAxis(b.hinge, 0, 0, 1);
    MdtHingeEnable(b.hinge);
    setStops(a, -1.2, .3, .5);
    setStops(b, -.3, 1.2, .5);
    for (int i = 0; i < 300; i++) {
        MdtWorldStep(a.world, FRAME);
        MdtWorldStep(b.world, FRAME);
        assert_near(angleOf(b), -angleOf(a), TOL(2e-6, 2e-13));
    }
}

TEST(limits_follow_the_guide_s_rules) {
    MdtBclLimit own;
    MdtBclSingleLimit stop;
    MdtLimitReset(&own);
    MdtSingleLimitReset(&stop);
    ck_assert(!MdtLimitIsActive(&own) && !MdtLimitIsMotorized(&own) && !MdtLimitPositionIsCalculated(&own));
    ck_assert(MdtLimitGetStiffnessThreshold(&own) == MEINFINITY);
    ck_assert(MdtSingleLimitGetStop(&stop) == 0 && MdtSingleLimitGetRestitution(&stop) == 1 &&
              MdtSingleLimitGetStiffness(&stop) == MEINFINITY && MdtSingleLimitGetDamping(&stop) == 0);
    /* a lower stop above the upper one takes it along, and the reverse */
    MdtSingleLimitSetStop(&stop, 3);
    MdtLimitSetLowerLimit(&own, &stop);
    assert_near(MdtSingleLimitGetStop(MdtLimitGetUpperLimit(&own)), 3, 0);
    MdtSingleLimitSetStop(&stop, -2);
    MdtLimitSetUpperLimit(&own, &stop);
    assert_near(MdtSingleLimitGetStop(MdtLimitGetLowerLimit(&own)), -2, 0);
    /* what cannot be negative, or above 1, is clamped */
    MdtSingleLimitSetStiffness(&stop, -1);
    MdtSingleLimitSetDamping(&stop, -1);
    ck_assert(MdtSingleLimitGetStiffness(&stop) == 0 && MdtSingleLimitGetDamping(&stop) == 0);
    MdtSingleLimitSetRestitution(&stop, 3);
    assert_near(MdtSingleLimitGetRestitution(&stop), 1, 0);
    MdtSingleLimitSetRestitution(&stop, -3);
    assert_near(MdtSingleLimitGetRestitution(&stop), 0, 0);
    MdtLimitSetStiffnessThreshold(&own, -3);
    assert_near(MdtLimitGetStiffnessThreshold(&own), 0, 0);
    /* the motor's switch and its force */
    MdtLimitSetLimitedForceMotor(&own, 4, 2);
    ck_assert(MdtLimitIsMotorized(&own) && MdtLimitPositionIsCalculated(&own));
    MdtLimitCalculatePosition(&own, 0);
    ck_assert(MdtLimitPositionIsCalculated(&own)); /* cannot be cleared while powered */
    MdtLimitSetLimitedForceMotor(&own, 4, -2);
    ck_assert(!MdtLimitIsMotorized(&own) && MdtLimitGetMotorMaxForce(&own) == 0);
    MdtLimitActivateMotor(&own, 1);
    ck_assert(MdtLimitIsMotorized(&own) && MdtLimitGetMotorDesiredVelocity(&own) == 4);
    messages_forget();
}

/* The step may be divided where the motion is violent; the guide's meaning of a load on a joint does not change. */
TEST(a_violently_turning_pair_stays_together) {
    const double edge[3] = {.2, 1, .2};
    MdtWorldID w = scene_world(2, 2, 9.81);
    MdtWorldSetEpsilon(w, 0);
    MdtBodyID a = scene_box(w, 1, edge, 0, -.5, 0), b = scene_box(w, 1, edge, 0, -1.5, 0);
    MdtHingeID h[2] = {MdtHingeCreate(w), MdtHingeCreate(w)};
    MdtHingeSetBodies(h[0], a, 0);
    MdtHingeSetBodies(h[1], b, a);
    for (int i = 0; i < 2; i++) {
        MdtHingeSetPosition(h[i], 0, (MeReal)-i, 0);
        MdtHingeSetAxis(h[i], 0, 0, 1);
        MdtHingeEnable(h[i]);
    }
    MdtBodySetAngularVelocity(a, 0, 0, 25);
    MdtBodySetAngularVelocity(b, 0, 0, -25);
    double energy = 0;
    for (int i = 0; i < 600; i++) {
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < 2; k++) {
            MeVector3 p, q;
            MdtConstraintBodyGetPosition(MdtHingeQuaConstraint(h[k]), 0, p);
            MdtConstraintBodyGetPosition(MdtHingeQuaConstraint(h[k]), 1, q);
            for (int j = 0; j < 3; j++)
                assert_near(p[j], q[j], TOL(1e-6, 3e-9));
        }
        MeVector3 pa, pb;
        MdtBodyGetPosition(a, pa);
        MdtBodyGetPosition(b, pb);
        energy = MdtBodyGetKineticEnergy(a) + MdtBodyGetKineticEnergy(b) + 9.81 * ((double)pa[1] + pb[1] + 2);
    }
    assert_below(energy, 100); /* it started with 58 + the impulse of the hinges */
}

/* The largest force on a door of 1 kg that turns with 1 rad/s on two hinges whose axes are so far apart, in m. */
static double forceOnDoor(double apart) {
    MdtWorldID w = scene_world(1, 2, 9.81);
    MdtWorldSetEpsilon(w, 0);
    MdtWorldSetSolver(w, MdtSolverExact);
    MdtBodyID door = scene_body(w, 1, .5, 0, 0);
    MdtHingeID hinge[2];
    double max = 0;
    MdtBodySetAngularVelocity(door, 0, 1, 0);
    for (int k = 0; k < 2; k++) {
        hinge[k] = scene_hinge(w, door, 0, k * apart, 2 * k - 1, 0, 0, 1, 0);
    }
    for (int i = 0; i < 300; i++) {
        MeVector3 f;
        MdtWorldStep(w, FRAME);
        for (int k = 0; k < 2; k++) {
            MdtHingeGetForce(hinge[k], 0, f);
            max = fmax(max, MeVector3Magnitude(f));
        }
    }
    return max;
}

/* Hinges whose axes are parallel allow no turn: forces are those that stop it, and do not grow from step to step. */
TEST(hinges_that_contradict_each_other_do_not_build_up_forces) {
    assert_below(forceOnDoor(0), 12);
    assert_below(forceOnDoor(1e-6), 1e5);
}

/* Arms of 1 and 2 m that motors drive against their stops, on a base that nothing holds: without a torque from outside
 * all of them together do not begin to spin. */
TEST(arms_that_are_driven_against_stops_do_not_spin_their_base) {
    static const double torques[] = {1, 100, 1e4, 1e5};
    for (int k = 0; k < 4; k++) {
        MdtWorldID w = scene_world(3, 2, 0);
        MdtBodyID body[3] = {scene_body(w, 50, 0, 0, 0)};
        MdtWorldSetEpsilon(w, 0);
        double spin = 0;
        for (int i = 1; i < 3; i++) {
            const double side = i == 1 ? -.4 : .4;
            body[i] = scene_body(w, 5, side, .5 * i, 0);
            MdtHingeID j = scene_hinge(w, body[i], body[0], side, 0, 0, 0, 0, 1);
            MdtLimitID limit = MdtHingeGetLimit(j);
            MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), i == 1 ? -.5 : -.3);
            MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), .4);
            MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
            MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
            MdtLimitActivateLimits(limit, 1);
            MdtLimitSetLimitedForceMotor(limit, i == 1 ? -10 : 10, torques[k]);
        }
        for (int step = 0; step < 120; step++) {
            double p[3], L[3], sum[3] = {0, 0, 0};
            MdtWorldStep(w, FRAME);
            for (int i = 0; i < 3; i++) {
                measure_momentum(body[i], p, L);
                keaAddScaled(sum, 1, L);
            }
            spin = fmax(spin, keaLength(sum));
        }
        assert_below(spin, TOL(2e-5, 1e-9));
    }
}
