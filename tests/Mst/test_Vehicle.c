/* Vehicles on a plane: suspension, tyres, engine, brakes, steering, against formulas, for cars of any size and step. */
#include "vehicle.h"

static void begin(int i) {
    setCar(&setups[i]);
    universe_addFloor();
}

/* ---- suspension -------------------------------------------------------------------------------------------------- */

/* The wheels' places are those of rest; the springs carry the chassis' weight there. */
TEST(it_stands_where_its_wheels_are_placed) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i);
        putCar(.03 * now.size);
        run(8);
        assert_near(place(2) / now.size, .52, TOL(1e-5, 1e-8));
        for (int k = 0; k < WHEELS; k++)
            assert_near((double)wheel(k).load, now.mass * GRAVITY / 4, now.mass * TOL(1e-3, 1e-6));
    }
}

/* A load of m sinks by m g / k, at any stiffness. */
TEST(it_sags_by_the_weight_over_the_stiffness) {
    static const double stiffness[] = {30, 300, 1e4, 1e7}; /* 1/s², of the whole car's mass */
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 4; k++) {
            begin(i);
            for (int j = 0; j < WHEELS; j++) {
                wheels[j].stiffness = (MeReal)(stiffness[k] * now.mass / 4);
                wheels[j].bump = (MeReal)(2 * now.size);
            }
            putCar(0);
            run(1);
            const double before = place(2);
            for (int n = 0; n < (int)(20 / now.h); n++) { /* a quarter more */
                MdtBodyAddForce(body, 0, 0, (MeReal)(-now.mass * GRAVITY / 4));
                run(now.h);
            }
            assert_near((before - place(2)) / now.size, GRAVITY / 4 / stiffness[k] / now.size, TOL(2e-5, 1e-7));
        }
}

/* The top of the parabola through three values. */
static double topOf(const double z[3]) {
    const double slope = (z[2] - z[0]) / 2, bend = z[2] - 2 * z[1] + z[0];
    return z[1] - slope * slope / 2 / bend;
}

/* s: the time between two upward crossings of a height, interpolated; and the ratio of the peaks that follow them. */
static double period(double height, double *ratio) {
    double times[2] = {0, 0}, peak[2] = {0, 0}, z[3] = {0, 0, place(2) - height}, t = 0;
    int found = 0;
    while (found < 3 && t < 20) {
        run(now.h);
        t += now.h;
        z[0] = z[1], z[1] = z[2], z[2] = place(2) - height;
        if (z[1] < 0 && z[2] >= 0 && found++ < 2)
            times[found - 1] = t - now.h * z[2] / (z[2] - z[1]);
        if (found > 0 && found < 3 && z[1] >= z[0] && z[1] > z[2])
            peak[found - 1] = topOf(z);
    }
    ck_assert_int_eq(found, 3);
    *ratio = peak[1] / peak[0];
    return times[1] - times[0];
}

TEST(it_rides_at_its_frequency_and_damping) {
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 3; k++) {
            const double f = k == 1 ? 1.5 : 1.2, damping = k == 2 ? .3 : .05;
            double ratio;
            begin(i);
            for (int j = 0; j < WHEELS; j++) {
                wheels[j].frequency = (MeReal)f;
                wheels[j].dampingRatio = (MeReal)damping;
                wheels[j].bump = wheels[j].droop = (MeReal)(.3 * now.size);
            }
            putCar(-.01 * now.size);
            const double T = period(.52 * now.size, &ratio);
            assert_near(T * f * sqrt(1 - damping * damping), 1, .02);
            assert_near(log(ratio) / (-2 * ME_PI * damping / sqrt(1 - damping * damping)), 1, .02);
        }
}

/* ---- along ------------------------------------------------------------------------------------------------------- */

/* The torque of the engine, through the gears, or the grip of the rear wheels: load / (1 - mu h / base) less. */
TEST(it_accelerates_by_its_engine_or_by_its_grip) {
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 2; k++) {
            begin(i);
            const double g = GRAVITY, ratio = 10, grip = .5, pull = k == 0 ? .2 * g : 5 * g;
            const double torque = pull * now.mass * .32 * now.size / ratio;
            params.torque = (MstCurve){1, {{0, (MeReal)torque}}};
            params.redline = (MeReal)1e9;
            params.gear[0] = (MeReal)ratio;
            params.finalDrive = 1;
            for (int j = 0; j < WHEELS; j++)
                wheels[j].along = wheels[j].across = tyre(.08, grip);
            putCar(0);
            MstVehicleSetGear(car, 1);
            drive(1, 0, 0, 0);
            run(1.5);
            const double before = velocity(0);
            run(1);
            /* all weight that the acceleration moves to the rear acts at the height of the chassis' middle */
            const double max = grip * g / 2 / (1 - grip * .52 / 2.6);
            assert_near((velocity(0) - before) / fmin(pull, max), 1, .01);
        }
}

TEST(it_brakes_in_v2_over_2_mu_g) {
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 2; k++) {
            const double speed = k ? 30 : 8, grip = .8;
            begin(i);
            for (int j = 0; j < WHEELS; j++)
                wheels[j].along = tyre(.08, grip);
            putCar(0);
            run(.5);
            setSpeed(speed);
            run(.2);
            const double from = place(0), v = velocity(0);
            drive(0, 0, 1, 0);
            run(speed / grip / GRAVITY + 2);
            assert_near((place(0) - from) / (v * v / 2 / grip / GRAVITY), 1, .02);
            assert_near(velocity(0), 0, 1e-4);
        }
}

/* Brakes that are weaker than the tyres: torque / radius. */
TEST(it_brakes_by_its_brakes) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i);
        for (int j = 0; j < WHEELS; j++)
            wheels[j].brake = (MeReal)(now.mass * 3 / 4 * .32 * now.size);
        putCar(0);
        run(.5);
        setSpeed(15);
        run(.2);
        const double from = place(0), v = velocity(0);
        drive(0, 0, 1, 0);
        run(8);
        assert_near((place(0) - from) / (v * v / 2 / 3), 1, .02);
        assert_near(velocity(0), 0, 1e-4);
    }
}

TEST(its_gears_tell_its_speed) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i);
        putCar(0);
        MstVehicleSetGear(car, 3);
        run(.2);
        setSpeed(20);
        run(.5);
        const double ratio = (double)(params.gear[2] * params.finalDrive);
        assert_near((double)MstVehicleGetEngineSpeed(car) * ME_PI / 30 / ratio * .32 * now.size / velocity(0), 1, 1e-3);
    }
}

/* Turns per minute that the engine would have without slip, in the present gear. */
static double turnsOverGround(void) {
    const double ratio = (double)(params.gear[MstVehicleGetGear(car) - 1] * params.finalDrive);
    return velocity(0) / (.32 * now.size) * ratio * 30 / ME_PI;
}

/* Wheels that spin, or that brakes stop, do not change gears: the speed over the ground does. */
TEST(the_automatic_does_not_hunt_on_ice) {
    for (int i = 0; i < SETUPS; i++) {
        int shifts = 0, last = 1;
        begin(i);
        params.torque = (MstCurve){1, {{0, (MeReal)(.3 * now.mass * now.size)}}};
        for (int k = 0; k < WHEELS; k++)
            wheels[k].along = wheels[k].across = (MstCurve){3, {{0, 0}, {(MeReal).08, (MeReal).3}, {1, (MeReal).2}}};
        for (int k = 0; k < 5; k++)
            params.gear[k] *= (MeReal)(3 * sqrt(now.size)); /* for a top speed that is reached soon */
        putCar(0);
        run(.5);
        for (int k = 0; k < (int)(30 / now.h); k++) {
            const double t = k * now.h;
            drive(t < 18 ? 1 : 0, 0, t < 18 ? 0 : 1, 0);
            run(now.h);
            const int gear = MstVehicleGetGear(car);
            shifts += gear != last;
            last = gear;
            ck_assert(gear == 5 || turnsOverGround() < 1.05 * (double)params.shiftUp);
            ck_assert(gear == 1 || turnsOverGround() > .9 * (double)params.shiftDown);
        }
        ck_assert_msg(shifts >= 4 && shifts <= 8, "%d: %d changes", i, shifts);
    }
}

/* ---- across ------------------------------------------------------------------------------------------------------ */

TEST(it_turns_on_the_circle_of_its_wheels) {
    for (int i = 0; i < SETUPS; i++) {
        begin(i);
        putCar(0);
        run(.5);
        setSpeed(1);
        drive(0, .5, 0, 0);
        run(2);
        MeVector3 spin;
        MdtBodyGetAngularVelocity(body, spin);
        const double rear = 2.6 * now.size / tan(.3), radius = hypot(rear, 1.3 * now.size);
        assert_near(hypot(velocity(0), velocity(1)) / (double)spin[2] / radius, 1, .01);
        ck_assert((double)spin[2] > 0 && (double)wheel(FRONT_LEFT).steering > (double)wheel(FRONT_RIGHT).steering);
    }
}

TEST(it_slides_at_mu_g) {
    for (int i = 0; i < SETUPS; i++)
        for (int axis = 0; axis < 2; axis++) {
            begin(i);
            for (int j = 0; j < WHEELS; j++)
                wheels[j].along = wheels[j].across = tyre(.08, .4);
            putCar(0);
            drive(0, 0, 1, 1);
            run(1);
            MdtBodySetLinearVelocity(body, axis ? 0 : 10, axis ? 10 : 0, 0);
            run(.3);
            const double before = velocity(axis);
            run(1);
            assert_near((before - velocity(axis)) / .4 / GRAVITY, 1, .01);
        }
}

/* ---- both sides -------------------------------------------------------------------------------------------------- */

/* The roll under a torque is that over the stiffness of springs and bars, 4 (k + 2 bar) y². */
TEST(bars_keep_it_from_rolling) {
    for (int i = 0; i < SETUPS; i++)
        for (int bars = 0; bars < 2; bars++) {
            begin(i);
            const double k = 30 * now.mass, bar = bars ? 40 * now.mass : 0, y = .75 * now.size;
            for (int j = 0; j < WHEELS; j++) {
                wheels[j].stiffness = (MeReal)k;
                wheels[j].antiRoll = (MeReal)bar;
                wheels[j].across = wheels[j].along = tyre(.08, 1e-4); /* free to slide aside */
            }
            putCar(0);
            const double angle = .003 / now.size, torque = angle * 4 * (k + 2 * bar) * y * y;
            for (int n = 0; n < (int)(4 / now.h); n++) {
                MdtBodyAddTorque(body, (MeReal)torque, 0, 0);
                run(now.h);
            }
            const double roll = (double)MdtBodyGetTransformPtr(body)[1][2];
            const double height = (now.cast == kMstVehicleSphere ? .2 : .52) * now.size; /* above what rolls */
            const double weight = now.mass * GRAVITY * height / (4 * (k + 2 * bar) * y * y);
            assert_near(roll / angle * (1 - weight), 1, TOL(2e-3, 1e-3));
        }
}

/* One driven wheel on ice: an open differential gives the other one no more torque. */
TEST(a_locked_differential_pulls_with_both_wheels) {
    for (int i = 0; i < SETUPS; i++)
        for (int locked = 0; locked < 2; locked++) {
            begin(i);
            params.axleLock = (MeReal)locked;
            const double load = now.mass * GRAVITY / 4, radius = .32 * now.size;
            params.gear[0] = params.finalDrive = 1;
            params.torque = (MstCurve){1, {{0, (MeReal)(1.2 * load * radius)}}};
            params.redline = (MeReal)(8 / radius * 30 / ME_PI);
            params.idle = params.redline / 100;
            for (int j = 0; j < WHEELS; j++)
                wheels[j].along = wheels[j].across = tyre(.08, j == REAR_LEFT ? .1 : 1);
            for (int j = REAR_LEFT; j < WHEELS; j++)
                wheels[j].inertia = (MeReal)(1e-3 * now.mass * now.size * now.size);
            putCar(0);
            MstVehicleSetGear(car, 1);
            run(.5);
            drive(1, 0, 0, 0);
            run(.3);
            const double before = velocity(0);
            run(.5);
            const double pull = (velocity(0) - before) / .5 * 4 / GRAVITY;
            ck_assert_msg(locked ? pull > 1.05 && pull < 1.4 : pull > .15 && pull < .3, "%d %d: %g", i, locked, pull);
        }
}

/* ---- motorcycles ------------------------------------------------------------------------------------------------- */

/* Two of the wheels, in the middle. */
static void putMotorcycle(void) {
    const MeReal l = (MeReal)(2 * now.size), t = (MeReal)(.4 * now.size);
    params.leanLimit = 1;
    const McdModelID chassis =
        MstModelAndBodyCreate(u, McdBoxCreate(u->frame, l, t, t), (MeReal)(now.mass / (double)(l * t * t)));
    body = McdModelGetBody(chassis);
    MdtBodySetPosition(body, 0, 0, (MeReal)(.52 * now.size));
    car = MstVehicleCreate(u, chassis, &params);
    for (int i = 0; i < 2; i++) {
        wheels[2 * i].position[1] = 0;
        wheels[2 * i].along = wheels[2 * i].across = tyre(.02, 2);
        ck_assert_int_eq(MstVehicleAddWheel(car, &wheels[2 * i]), i);
    }
}

/* In a steady curve tan(lean) = v² / (r g). */
TEST(a_motorcycle_leans_into_curves) {
    for (int i = 0; i < SETUPS; i++)
        for (int side = -1; side <= 1 && setups[i].cast != kMstVehicleSphere; side++) { /* a sphere is a wide tyre */
            begin(i);
            putMotorcycle();
            MstVehicleSetGear(car, 0);
            run(.5);
            setSpeed(5 * sqrt(now.size));
            drive(0, .35 * side, 0, 0);
            run(3);
            MeVector3 w;
            MdtBodyGetAngularVelocity(body, w);
            const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
            const double lean = asin((double)tm[1][2]), speed = hypot(velocity(0), velocity(1));
            ck_assert(side * (double)w[2] >= 0 && (side == 0 || fabs((double)w[2]) * now.size > .2));
            assert_near(tan(-lean), speed * (double)w[2] / GRAVITY, .05 * fabs(speed * (double)w[2] / GRAVITY) + 1e-4);
        }
}

/* From side to side, ahead and back: it leans no more than a twentieth beyond its limit. */
TEST(a_motorcycle_leans_up_to_its_limit) {
    for (int i = 0; i < SETUPS; i++) {
        double max = 0;
        begin(i);
        putMotorcycle();
        params.leanLimit = (MeReal).8;
        MstVehicleDestroy(car);
        car = MstVehicleCreate(u, MdtBodyGetModel(body), &params);
        for (int k = 0; k < 2; k++)
            ck_assert_int_eq(MstVehicleAddWheel(car, &wheels[2 * k]), k);
        for (int k = 0; k < (int)(20 / now.h); k++) {
            const double t = k * now.h;
            drive(t < 4 ? -.5 : t < 9 ? .5 : -.5, t < 2 ? 0 : sin(t), 0, 0);
            run(now.h);
            max = fmax(max, fabs(asin(fmin(1, fabs((double)MdtBodyGetTransformPtr(body)[1][2])))));
        }
        ck_assert_msg(max > .4 && max < .8 * 1.05, "%d: leans by %g", i, max);
    }
}

/* ---- which wheels steer ------------------------------------------------------------------------------------------ */

/* All wheels by one angle: it goes aside without turning. The rear ones alone, or against the front ones: it turns. */
TEST(any_wheels_may_steer) {
    static const double angles[][2] = {{.3, .3}, {0, -.3}, {.3, -.3}, {.3, .1}}; /* rad: front, rear */
    for (int k = 0; k < 4; k++) {
        begin(0);
        for (int i = 0; i < WHEELS; i++)
            wheels[i].steering = (MeReal)angles[k][i < REAR_LEFT ? 0 : 1];
        putCar(0);
        run(2);
        setSpeed(2);
        drive(.1, 1, 0, 0);
        run(1);
        MeVector3 w;
        MdtBodyGetAngularVelocity(body, w);
        const double speed = hypot(velocity(0), velocity(1)), base = 2.6 * now.size;
        const double curvature = (tan(angles[k][0]) - tan(angles[k][1])) / base;
        const double middle = (tan(angles[k][0]) + tan(angles[k][1])) / 2; /* of the way aside, at the middle */
        assert_near((double)w[2], curvature * speed / sqrt(1 + middle * middle), .02);
    }
}

/* Sideways: by the friction that the tyres have, at any stiffness. */
TEST(a_stiff_suspension_has_no_grip_of_its_own) {
    static const double frequencies[] = {1.5, 20, 60, 100, 1000};
    for (int k = 0; k < 5; k++) {
        begin(0);
        for (int i = 0; i < WHEELS; i++)
            wheels[i].frequency = (MeReal)frequencies[k];
        putCar(0);
        run(2);
        MdtBodySetLinearVelocity(body, 0, 8, 0);
        run(.4);
        assert_near(velocity(1), 8 - GRAVITY * .4, .05 * GRAVITY * .4);
    }
}
