/* Locks of differentials: speeds that they keep equal, torques that they pass, for cars of any size and step. */
#include "vehicle.h"

/* A car on a plane whose driven wheels' torque together is `torque` times load and radius of one, in the first gear.
 * The wheels of `ice` have a tenth of the friction. */
static void begin(int i, double torque, unsigned int ice, MeBool isFourWheel) {
    setCar(&setups[i]);
    universe_addFloor();
    const double load = now.mass * GRAVITY / 4, radius = .32 * now.size;
    params.gear[0] = params.finalDrive = 1;
    params.torque = (MstCurve){1, {{0, (MeReal)(torque * load * radius)}}};
    params.redline = (MeReal)(20 * sqrt(now.size) / radius * 30 / ME_PI);
    params.idle = params.redline / 1000;
    for (int k = 0; k < WHEELS; k++) {
        wheels[k].along = wheels[k].across = tyre(.08, ice >> k & 1 ? .1 : 1);
        wheels[k].drive = isFourWheel || k >= REAR_LEFT;
        wheels[k].inertia = (MeReal)(2e-4 * now.mass * now.size * now.size);
    }
}

static void setUp(void) {
    putCar(0);
    MstVehicleSetGear(car, 1);
    run(.5);
}

/* m/s², of the car forwards. */
static double acceleration(double after, double during) {
    run(after);
    const double before = (double)MstVehicleGetSpeed(car);
    run(during);
    return ((double)MstVehicleGetSpeed(car) - before) / during;
}

static double difference(int a, int b) {
    return fabs((double)wheel(a).spin - (double)wheel(b).spin);
}

/* rad/s: what the state, in MeReal, tells of equal speeds. */
static double roundingOf(int i) {
    return TOL(2e-7, 4e-10) * (1 + fabs((double)wheel(i).spin));
}

/* One wheel on ice: the other one gets the torque that ice does not bear, if the differential is locked. */
TEST(a_locked_axle_drives_by_the_wheel_that_grips) {
    for (int i = 0; i < SETUPS; i++)
        for (int locked = 0; locked < 2; locked++) {
            begin(i, .8, 1u << REAR_LEFT, MEFALSE);
            params.axleLock = (MeReal)locked;
            setUp();
            drive(1, 0, 0, 0);
            const double a = acceleration(.3, .5), wheelsToo = 1 + 4 * 2e-4 / .32 / .32;
            if (locked) {
                assert_near(a / (.8 * GRAVITY / 4) * wheelsToo, 1, .01);
                assert_near((double)wheel(REAR_LEFT).spin, (double)wheel(REAR_RIGHT).spin, roundingOf(REAR_LEFT));
            } else {
                ck_assert(a < .3 * GRAVITY / 4 && difference(REAR_LEFT, REAR_RIGHT) * now.size > 1);
            }
        }
}

static double frictionOf(int i) {
    const MstWheelState state = wheel(i);
    return hypot((double)state.force[0], (double)state.force[1]) / (double)state.load;
}

/* More torque than both wheels bear: each has its friction. */
TEST(a_locked_axle_slides_with_both_wheels) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i, 3, 1u << REAR_LEFT, MEFALSE);
        params.axleLock = 1;
        setUp();
        drive(1, 0, 0, 0);
        run(.3);
        for (int k = 0; k < (int)(.5 / now.h); k++) {
            run(now.h);
            assert_near((double)wheel(REAR_LEFT).spin, (double)wheel(REAR_RIGHT).spin, roundingOf(REAR_LEFT));
            assert_near(frictionOf(REAR_RIGHT), 1, .01);
            assert_near(frictionOf(REAR_LEFT), .1, .001);
        }
    }
}

/* A share of half of the axle's torque goes over to the wheel that grips. */
TEST(a_limited_slip_passes_its_share) {
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 3; k++) {
            const double share = .2 * (k + 1), torque = 1;
            begin(i, torque, 1u << REAR_LEFT, MEFALSE);
            for (int j = REAR_LEFT; j < WHEELS; j++)
                wheels[j].inertia *= 10;
            params.axleLock = (MeReal)share;
            setUp();
            drive(1, 0, 0, 0);
            run(.4);
            ck_assert(difference(REAR_LEFT, REAR_RIGHT) > .1);
            const double load = now.mass * GRAVITY / 4, inertia = 2e-3 * now.mass * now.size;
            const double gain = (double)wheel(REAR_RIGHT).spin;
            run(.1);
            const double spun = inertia / .32 * ((double)wheel(REAR_RIGHT).spin - gain) / .1 / load;
            assert_near((double)wheel(REAR_RIGHT).force[0] / load + spun, torque / 2 * (1 + share), .02);
        }
}

/* The front axle on ice. */
TEST(a_centre_lock_drives_by_the_axle_that_grips) {
    for (int i = 0; i < SETUPS; i++)
        for (int locked = 0; locked < 2; locked++) {
            begin(i, 1.2, 1u << FRONT_LEFT | 1u << FRONT_RIGHT, METRUE);
            params.centreLock = (MeReal)locked;
            setUp();
            drive(1, 0, 0, 0);
            const double a = acceleration(.3, .4), wheelsToo = 1 + 4 * 2e-4 / .32 / .32;
            if (locked) {
                assert_near(a / (1.2 * GRAVITY / 4) * wheelsToo, 1, .01);
                const double front = (double)(wheel(FRONT_LEFT).spin + wheel(FRONT_RIGHT).spin);
                assert_near(front, (double)(wheel(REAR_LEFT).spin + wheel(REAR_RIGHT).spin),
                            4 * roundingOf(FRONT_LEFT));
            } else {
                ck_assert(a < .6 * GRAVITY / 4);
            }
        }
}

/* In a circle of radius r the wheels of a locked axle turn as fast as the mean of both: the inner one slips forwards by
 * y/r, the outer one back. */
TEST(a_locked_axle_scrubs_in_a_curve) {
    for (int i = 0; i < SETUPS; i++)
        for (int locked = 0; locked < 2; locked++) {
            begin(i, .5, 0, MEFALSE);
            params.axleLock = (MeReal)locked;
            setUp();
            setSpeed(1.5 * sqrt(now.size));
            drive(0, .2, 0, 0);
            run(1);
            MeVector3 spin;
            MdtBodyGetAngularVelocity(body, spin);
            const double r = (double)MstVehicleGetSpeed(car) / (double)spin[2], slip = .75 * now.size / r;
            const MstWheelState inner = wheel(REAR_LEFT), outer = wheel(REAR_RIGHT);
            if (locked) {
                assert_near((double)inner.spin, (double)outer.spin, roundingOf(REAR_LEFT));
                assert_near((double)(inner.force[0] - outer.force[0]) * .08 / (double)(inner.load + outer.load) / slip,
                            1, .05);
                ck_assert(inner.force[0] > 0 && outer.force[0] < 0);
            } else {
                assert_near((double)inner.spin / (double)outer.spin, (1 - slip) / (1 + slip), .01);
            }
        }
}

/* All locks, all pedals, other solvers and sub-steps: the speeds of four wheels stay equal. */
TEST(locks_hold_whatever_is_done) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i, 4, 1u << FRONT_RIGHT | 1u << REAR_LEFT, METRUE);
        params.axleLock = params.centreLock = 1;
        for (int k = 0; k < WHEELS; k++) {
            wheels[k].rollingResistance = (MeReal).02;
            wheels[k].brake /= 4;
        }
        MdtWorldSetSubSteps(u->world, 1 + i % 3);
        MdtWorldSetSolver(u->world, i == 3 ? MdtSolverFast : MdtSolverAuto);
        setUp();
        MstVehicleSetAutomatic(car, METRUE);
        for (int k = 0; k < (int)(8 / now.h); k++) {
            const double t = k * now.h;
            drive(sin(3 * t), cos(2 * t), fmax(sin(5 * t), 0), t > 5 && t < 6);
            run(now.h);
            for (int j = 1; j < WHEELS; j++)
                assert_near((double)wheel(j).spin, (double)wheel(0).spin, roundingOf(0));
            ck_assert(fabs(place(2) / now.size - .52) < .1);
        }
        drive(0, 0, 1, 0);
        run(4);
        assert_near(hypot(velocity(0), velocity(1)), 0, 1e-3);
    }
}

/* On a board that is lighter than the car and slides: the clutches' prediction counts its mass. */
TEST(locks_hold_on_ground_that_gives_way) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i, 2, 0, METRUE);
        params.axleLock = params.centreLock = 1;
        const double l = 120 * now.size, w = 6 * now.size, t = .2 * now.size, mass = .3 * now.mass;
        const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, (MeReal)l, (MeReal)w, (MeReal)t),
                                                   (MeReal)(mass / (l * w * t)));
        const MdtBodyID board = McdModelGetBody(m);
        MeVector3 v;
        MdtBodySetPosition(board, 0, 0, (MeReal)(t / 2));
        MdtContactParamsSetType(MstBridgeGetContactParams(u->bridge, 0, 0), MdtContactTypeFrictionZero);
        putCar(t);
        MstVehicleSetGear(car, 1);
        run(.5);
        for (int k = 0; k < (int)(1.5 / now.h); k++) {
            drive(k * now.h < .8, 0, 0, 0);
            run(now.h);
            for (int j = 1; j < WHEELS; j++)
                assert_near((double)wheel(j).spin, (double)wheel(0).spin, roundingOf(0));
        }
        MdtBodyGetLinearVelocity(board, v);
        ck_assert(velocity(0) > .2 * sqrt(now.size));
        assert_near((double)v[0] * mass, -velocity(0) * now.mass, 1e-3 * now.mass * velocity(0));
    }
}
