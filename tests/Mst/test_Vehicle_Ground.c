/* Vehicles on slopes, platforms, seams, meshes and crates; sleep; what is destroyed; threads; bad input. */
#include "McdMesh.h"
#include "MeTask.h"
#include "vehicle.h"

#ifdef TEST_IS_SLOW
enum { LONG = 10 };
#else
enum { LONG = 100 };
#endif

static MeMatrix4 groundTM;

/* A box whose top is the plane z = 0, turned about y by a slope: forward, x, is downhill. */
static McdModelID addSlope(double angle) {
    MeMatrix4TMMakeIdentity(groundTM);
    groundTM[0][0] = groundTM[2][2] = (MeReal)cos(angle);
    groundTM[0][2] = (MeReal)-sin(angle);
    groundTM[2][0] = (MeReal)sin(angle);
    MeMatrix4TMSetPosition(groundTM, (MeReal)(-5 * sin(angle)), 0, (MeReal)(-5 * cos(angle)));
    return MstFixedModelCreate(u, McdBoxCreate(u->frame, 400, 400, 10), groundTM);
}

/* Puts the car on that slope, its nose turned from downhill by an angle. */
static void putOnSlope(double angle, double turn) {
    putCar(0);
    const MeReal c = (MeReal)cos(angle / 2), s = (MeReal)sin(angle / 2), d = (MeReal)cos(turn / 2),
                 e = (MeReal)sin(turn / 2);
    MdtBodySetQuaternion(body, c * d, s * e, s * d, c * e);
    const double height = .52 * now.size;
    MdtBodySetPosition(body, (MeReal)(height * sin(angle)), 0, (MeReal)(height * cos(angle)));
}

TEST(it_stands_on_a_slope_with_its_handbrake) {
    for (int i = 0; i < SETUPS; i++)
        for (int turn = 0; turn < 3; turn++) {
            setCar(&setups[i]);
            addSlope(20 * ME_PI / 180);
            putOnSlope(20 * ME_PI / 180, turn * .8);
            drive(0, 0, 0, 1);
            run(5);
            const double x = place(0), y = place(1), z = place(2);
            run(LONG);
            assert_near(place(0), x, 1e-4);
            assert_near(place(1), y, 1e-4);
            assert_near(place(2), z, 1e-4);
        }
}

/* Without brakes it rolls down at g sin(angle). */
TEST(it_rolls_down_a_slope) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        addSlope(.1);
        putOnSlope(.1, 0);
        MstVehicleSetGear(car, 0);
        run(1);
        const double before = velocity(0);
        run(1);
        assert_near((velocity(0) - before) / GRAVITY / sin(.1) / cos(.1), 1, 1e-3);
    }
}

TEST(it_falls_asleep_and_wakes) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        const McdModelID ground = addSlope(0);
        MdtWorldSetAutoDisable(u->world, 1);
        for (int k = 0; k < WHEELS; k++)
            wheels[k].rollingResistance = (MeReal).01;
        putCar(.02 * now.size);
        run(8);
        ck_assert(!MdtBodyIsEnabled(body));
        drive(.5, 0, 0, 0);
        run(1);
        ck_assert(MdtBodyIsEnabled(body) && velocity(0) > .1);
        drive(0, 0, 1, 0);
        run(10);
        ck_assert(!MdtBodyIsEnabled(body));
        McdModelDestroy(ground);
        run(.5);
        ck_assert(MdtBodyIsEnabled(body) && velocity(2) < -4);
    }
}

static McdModelID floorModel;

static void lowerFloor(void) {
    McdSpaceUnfreezeModel(floorModel);
    groundTM[3][2] -= (MeReal).3;
}

static void removeFloor(void) {
    McdSpaceRemoveModel(floorModel);
}

static void disablePair(void) {
    McdSpaceDisablePair(floorModel, MdtBodyGetModel(body));
}

static void groupFloor(void) {
    McdModelSetFilterGroup(floorModel, -3);
    McdModelSetFilterGroup(MdtBodyGetModel(body), -3);
}

static void senseFloor(void) {
    McdModelSetSensor(floorModel, METRUE);
}

static void thinFloor(void) {
    McdModelSetGeometry(floorModel, McdBoxCreate(u->frame, 40, 40, 1));
}

TEST(a_change_of_the_ground_wakes_it) {
    static void (*const changes[])(void) = {lowerFloor, removeFloor, disablePair, groupFloor, senseFloor, thinFloor};
    for (int cast = 0; cast < 3; cast++)
        for (int i = 0; i < 6; i++) {
            Setup s = setups[0];
            s.cast = (MstVehicleCast)cast;
            setCar(&s);
            MeMatrix4TMMakeIdentity(groundTM);
            groundTM[3][2] = -1;
            floorModel = MstFixedModelCreate(u, McdBoxCreate(u->frame, 40, 40, 2), groundTM);
            putCar(0);
            MdtWorldSetAutoDisable(u->world, METRUE);
            drive(0, 0, 0, 1);
            run(15);
            ck_assert(!MdtBodyIsEnabled(body));
            const double before = place(2);
            changes[i]();
            run(1);
            ck_assert_msg(place(2) < before - .25, "cast %d, change %d", cast, i);
        }
}

/* In parts of steps, and by the fast solver, with a load on its roof. */
TEST(it_obeys_other_solvers_and_sub_steps) {
    for (int i = 0; i < SETUPS; i++)
        for (int fast = 0; fast < 2; fast++) {
            setCar(&setups[i]);
            universe_addFloor();
            MdtWorldSetSolver(u->world, fast ? MdtSolverFast : MdtSolverAuto);
            MdtWorldSetSubSteps(u->world, fast ? 1 : 3);
            MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 1, 0);
            for (int k = 0; k < WHEELS; k++)
                wheels[k].brake = (MeReal)(.16 * now.mass * now.size); /* 2 m/s² */
            putCar(0);
            const double side = .5 * now.size;
            const McdModelID box = MstModelAndBodyCreate(
                u, McdBoxCreate(u->frame, (MeReal)side, (MeReal)side, (MeReal)side), (MeReal)(.05 * now.mass / side));
            MdtBodySetMass(McdModelGetBody(box), (MeReal)(.05 * now.mass));
            MstAutoSetInertialTensor(box);
            MdtBodySetPosition(McdModelGetBody(box), 0, 0, (MeReal)(.72 * now.size + side / 2));
            run(4);
            const double sag = .05 * GRAVITY / pow(2 * ME_PI * 1.5, 2);
            assert_near((.52 * now.size - place(2)) / sag, 1, .02);
            setSpeed(6);
            MdtBodySetLinearVelocity(McdModelGetBody(box), 6, 0, 0);
            drive(0, 0, 1, 0);
            run(.5);
            const double before = velocity(0);
            run(1);
            assert_near((before - velocity(0)) / (4 * .16 / .32 / 1.05), 1, .02);
            run(4);
            assert_near(velocity(0), 0, 1e-3);
        }
}

TEST(a_platform_that_starts_wakes_it) {
    setCar(&setups[0]);
    const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 60, 60, 1), 1);
    const MdtBodyID platform = McdModelGetBody(m);
    MdtBodySetPosition(platform, 0, 0, (MeReal)-.5);
    MdtBodySetKinematic(platform, METRUE);
    MdtWorldSetAutoDisable(u->world, 1);
    putCar(0);
    drive(0, 0, 0, 1);
    run(5);
    ck_assert(!MdtBodyIsEnabled(body));
    MdtBodySetLinearVelocity(platform, 0, 0, (MeReal).5);
    run(2);
    ck_assert(MdtBodyIsEnabled(body));
    assert_near(velocity(2), .5, .01);
}

/* ---- ground that moves ------------------------------------------------------------------------------------------- */

TEST(it_rides_on_a_platform) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 60, 60, 1), 1);
        const MdtBodyID platform = McdModelGetBody(m);
        MdtBodySetPosition(platform, 0, 0, (MeReal)-.5);
        MdtBodySetKinematic(platform, METRUE);
        putCar(0);
        drive(0, 0, 0, 1);
        run(1);
        for (double v = 0; v < 3; v += 2 * now.h) { /* 2 m/s² */
            MdtBodySetLinearVelocity(platform, (MeReal)(v / 2), (MeReal)(v / 2), 0);
            run(now.h);
        }
        MdtBodySetLinearVelocity(platform, (MeReal)1.5, (MeReal)1.5, 0);
        run(3);
        MeVector3 p;
        MdtBodyGetPosition(platform, p);
        assert_near(velocity(0), 1.5, 1e-5);
        assert_near(place(0), (double)p[0], .05 * now.size);
        assert_near(place(1), (double)p[1], .05 * now.size);
    }
}

/* A fixed model that the program moves is a platform, too. */
TEST(it_rides_on_a_model_that_is_moved) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        MeMatrix4TMMakeIdentity(groundTM);
        MeMatrix4TMSetPosition(groundTM, 0, 0, (MeReal)-.5);
        const McdModelID platform = MstFixedModelCreate(u, McdBoxCreate(u->frame, 60, 60, 1), groundTM);
        McdSpaceUnfreezeModel(platform);
        putCar(0);
        drive(0, 0, 0, 1);
        run(1);
        double v = 0;
        for (int n = 0; n < (int)(3 / now.h); n++) {
            v = fmin(v + now.h, 1.5);
            groundTM[3][0] += (MeReal)(v * now.h);
            run(now.h);
        }
        assert_near(velocity(0), 1.5, TOL(2e-3, 2e-4)); /* it sways on its springs yet */
        MstFixedModelDestroy(platform);
        run(.1);
        ck_assert(!wheel(0).ground);
    }
}

/* m: of the car, from the middle of the platform, in its axes. */
static void placeOn(MdtBodyID platform, double at[3]) {
    MeVector3 p;
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(platform);
    MdtBodyGetPosition(body, p);
    for (int i = 0; i < 3; i++) {
        at[i] = 0;
        for (int k = 0; k < 3; k++)
            at[i] += (double)tm[i][k] * ((double)p[k] - (double)tm[3][k]);
    }
}

enum { TURNS, SHUTTLES, LIFTS, MOTIONS };

static void movePlatform(MdtBodyID platform, int motion, double t, double share) {
    const MeReal spin = (MeReal)(share * .5 / sqrt(now.size)), speed = (MeReal)(share * sin(2 * t));
    const MeReal aside = (MeReal)(share * cos(2 * t));
    if (motion == TURNS)
        MdtBodySetAngularVelocity(platform, 0, 0, spin);
    else
        MdtBodySetLinearVelocity(platform, motion == SHUTTLES ? speed : 0, motion == SHUTTLES ? aside : 0,
                                 motion == LIFTS ? speed : 0);
}

/* The ground takes 4 s to its full motion and back from it, a turn of a turntable: the car is where it was. */
TEST(a_parked_car_does_not_creep_on_ground_that_moves) {
    static const double steps[] = {1. / 30, 1. / 60, 1. / 240};
    for (int i = 0; i < SETUPS; i++)
        for (int motion = 0; motion < MOTIONS; motion++) {
            Setup s = setups[i];
            double before[3], after[3];
            s.h = steps[(i + motion) % 3];
            setCar(&s);
            const McdModelID m = MstModelAndBodyCreate(
                u, McdBoxCreate(u->frame, (MeReal)(60 * now.size), (MeReal)(60 * now.size), 1), 1);
            const MdtBodyID platform = McdModelGetBody(m);
            MdtBodySetPosition(platform, 0, 0, (MeReal)-.5);
            MdtBodySetKinematic(platform, METRUE);
            for (int k = 0; k < REAR_LEFT; k++)
                wheels[k].handbrake = 0;
            putCar(0);
            MdtBodySetPosition(body, (MeReal)(8 * now.size), (MeReal)now.size, (MeReal)(.52 * now.size));
            drive(0, 0, 0, 1);
            run(1);
            placeOn(platform, before);
            const double end = 4 + 2 * ME_PI / .5 * sqrt(now.size);
            for (int k = 0; k < (int)((end + 4) / now.h); k++) {
                const double t = fmin((k + 1) * now.h, end);
                movePlatform(platform, motion, t, fmin(fmin(t, end - t) / 4, 1));
                run(now.h);
            }
            placeOn(platform, after);
            for (int k = 0; k < 3; k++)
                assert_near((after[k] - before[k]) / now.size, 0, 1e-3);
        }
}

/* The car accelerates on a heavy board that slides without friction: their momentum stays. */
TEST(it_pushes_the_ground_back) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        universe_addFloor();
        const double l = 60 * now.size, w = 6 * now.size, t = .2 * now.size, mass = 2 * now.mass;
        const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, (MeReal)l, (MeReal)w, (MeReal)t),
                                                   (MeReal)(mass / (l * w * t)));
        const MdtBodyID board = McdModelGetBody(m);
        MdtBodySetPosition(board, 0, 0, (MeReal)(t / 2));
        MdtContactParamsSetType(MstBridgeGetContactParams(u->bridge, 0, 0), MdtContactTypeFrictionZero);
        putCar(t);
        run(.5);
        MstVehicleSetGear(car, 1);
        drive(1, 0, 0, 0);
        run(1.5);
        MeVector3 v;
        MdtBodyGetLinearVelocity(board, v);
        ck_assert(velocity(0) > .5);
        assert_near((double)v[0] * mass, -velocity(0) * now.mass, 1e-3 * now.mass * velocity(0));
    }
}

/* ---- seams, meshes, crates --------------------------------------------------------------------------------------- */

enum { TILES = 40 };
static MeMatrix4 tileTM[TILES];

/* Teleported or made with its wheels or its chassis in the floor it comes out no faster than its springs drive it from
 * their stops, whatever the step and the depth. */
TEST(it_is_not_thrown_out_of_the_floor) {
    static const double depths[] = {.05, .2, .5, .9};
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 4 * 3; k++) {
            double fastest = 0, highest = 0;
            setCar(&setups[i]);
            MdtWorldSetSolver(u->world, (MdtSolver)(k / 4));
            addSlope(0);
            putCar(0);
            drive(0, 0, 0, i % 2);
            run(k % 2 * 1.);
            MdtBodySetPosition(body, 0, 0, (MeReal)((.52 - depths[k % 4]) * now.size));
            for (int n = 0; n < 2 / now.h; n++) {
                run(now.h);
                fastest = fmax(fastest, velocity(2));
                highest = fmax(highest, place(2) - .52 * now.size);
            }
            const double rate = 2 * ME_PI * (double)wheels[0].frequency;
            const double travel = (double)wheels[0].bump + GRAVITY / (rate * rate);
            ck_assert_msg(fastest < rate * travel && highest < travel, "setup %d, %d: %g m/s, %g m", i, k, fastest,
                          highest);
            assert_near(place(2) / now.size, .52, .01);
        }
}

TEST(it_does_not_feel_seams) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        for (int k = 0; k < TILES; k++) {
            MeMatrix4TMMakeIdentity(tileTM[k]);
            MeMatrix4TMSetPosition(tileTM[k], (MeReal)(k - 5), 0, (MeReal)-.5);
            MstFixedModelCreate(u, McdBoxCreate(u->frame, 1, 20, 1), tileTM[k]);
        }
        putCar(0);
        MstVehicleSetGear(car, 0);
        run(.5);
        setSpeed(8);
        for (int k = 0; k < 180; k++) {
            run(1. / 60);
            assert_near(place(2) / now.size, .52, 1e-4);
            if (place(0) > 25)
                break;
        }
        assert_near(velocity(0), 8, 1e-3);
    }
}

/* More models below the car than its rays gather: small tiles, or a few large ones. */
TEST(it_stands_on_any_number_of_tiles) {
    static MeMatrix4 tms[33][33];
    for (int i = 0; i < SETUPS; i++)
        for (int side = 3; side <= 33; side += 10) {
            setCar(&setups[i]);
            const double size = 5 * now.size / side;
            for (int k = 0; k < side * side; k++) {
                MeMatrix4 *tm = &tms[k / side][k % side];
                MeMatrix4TMMakeIdentity(*tm);
                MeMatrix4TMSetPosition(*tm, (MeReal)((k / side - side / 2) * size),
                                       (MeReal)((k % side - side / 2) * size), (MeReal)-.5);
                MstFixedModelCreate(u, McdBoxCreate(u->frame, (MeReal)size, (MeReal)size, 1), *tm);
            }
            putCar(0);
            drive(0, 0, 0, 1);
            run(1);
            assert_near(place(2) / now.size, .52, 1e-4);
            for (int k = 0; k < WHEELS; k++)
                ck_assert(wheel(k).ground);
        }
}

static double heightOf(double x, double y) {
    return .25 * sin(x / 2.5) * cos(y / 3) - .25;
}

static McdModelID addHills(void) {
    enum { SIDE = 80 };
    static MeVector3 vertex[(SIDE + 1) * (SIDE + 1)];
    static int index[6 * SIDE * SIDE];
    int n = 0;
    for (int i = 0; i <= SIDE; i++)
        for (int j = 0; j <= SIDE; j++) {
            const double x = i - 20, y = j - SIDE / 2;
            MeVector3Set(vertex[i * (SIDE + 1) + j], (MeReal)x, (MeReal)y, (MeReal)heightOf(x, y));
        }
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            const int a = i * (SIDE + 1) + j, b = a + SIDE + 1;
            const int corner[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(index + n, corner, sizeof corner);
            n += 6;
        }
    MeMatrix4TMMakeIdentity(groundTM);
    const McdGeometryID mesh = (McdGeometryID)McdMeshCreate(u->frame, vertex, (SIDE + 1) * (SIDE + 1), index, n / 3, 0);
    return MstFixedModelCreate(u, mesh, groundTM);
}

TEST(it_drives_over_hills) {
    for (int i = 0; i < SETUPS; i++) {
        setCar(&setups[i]);
        addHills();
        putCar(.5 * now.size);
        run(1);
        drive(.6, 0, 0, 0);
        double highest = 0;
        for (int k = 0; k < 240; k++) {
            drive(velocity(0) < 6 ? .6 : 0, 0, 0, 0);
            run(1. / 60);
            highest = fmax(highest, place(2));
            ck_assert(place(2) > -.6);
        }
        ck_assert(place(0) > 15 && fabs(place(1)) < 1 && highest < .55 * now.size);
    }
}

TEST(it_drives_over_crates_and_pushes_them) {
    for (int i = 0; i < SETUPS; i++) {
        MdtBodyID crate[3];
        setCar(&setups[i]);
        universe_addFloor();
        for (int k = 0; k < 3; k++) {
            const double side = (k == 0 ? .1 : .8) * now.size;
            const McdModelID m =
                MstModelAndBodyCreate(u, McdBoxCreate(u->frame, (MeReal)side, (MeReal)(2 * now.size), (MeReal)side),
                                      (MeReal)(.02 * now.mass / (side * side * 2 * now.size)));
            crate[k] = McdModelGetBody(m);
            MdtBodySetPosition(crate[k], (MeReal)((k == 0 ? 5 : 6 + 4 * k) * now.size), 0, (MeReal)(side / 2));
        }
        putCar(0);
        double highest = 0;
        for (int k = 0; k < 300; k++) {
            drive(velocity(0) < 4 * now.size ? 1 : 0, 0, 0, 0);
            run(1. / 60);
            highest = fmax(highest, place(2));
        }
        MeVector3 p;
        MdtBodyGetPosition(crate[2], p);
        ck_assert((double)p[0] > place(0) + 1.5 * now.size && velocity(0) > 1.9 && highest < .6 * now.size);
    }
}

/* ---- what is destroyed ------------------------------------------------------------------------------------------- */

TEST(it_is_inert_without_its_chassis) {
    setCar(&setups[0]);
    universe_addFloor();
    putCar(0);
    run(.2);
    McdModelID chassis = MstVehicleGetChassis(car);
    MstModelAndBodyDestroy(chassis);
    run(.2);
    ck_assert(!MstVehicleGetChassis(car));
    assert_none(MstVehicleGetSpeed, car);
    const MstWheelState state = wheel(0);
    ck_assert(!state.ground && state.load == 0);
    MstVehicleDestroy(car);
}

TEST(its_ground_may_go) {
    setCar(&setups[0]);
    const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 20, 20, 1), 1000);
    MdtBodySetPosition(McdModelGetBody(m), 0, 0, (MeReal)-.5);
    MstFixedModelCreateAt(u, McdPlaneCreate(u->frame), (MeVector3){0, 0, -1}, (MeVector4){1, 0, 0, 0});
    putCar(0);
    run(1);
    ck_assert(wheel(0).ground == m);
    MstModelAndBodyDestroy(m);
    ck_assert(!wheel(0).ground);
    run(3);
    ck_assert(wheel(0).ground && wheel(0).ground != m);
    assert_near(place(2), -.48, 1e-3);
}

static void destroyConstraints(void) {
    MdtBodyDestroyConstraints(body);
}

TEST(its_joints_may_go) {
    setCar(&setups[0]);
    universe_addFloor();
    putCar(0);
    run(1);
    destroyConstraints();
    run(1);
    ck_assert(place(2) < .4);
    MstVehicleDestroy(car);
    run(.1);
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

enum { CARS = 30 };

static void driveMany(int threads, MeReal end[CARS][3]) {
    MdtBodyID all[CARS];
    MstVehicleID vehicle[CARS];
    setCar(&setups[0]);
    addHills();
    const MeTaskPoolID pool = threads > 1 ? MeTaskPoolCreate(threads) : 0;
    MdtWorldSetTaskPool(u->world, pool);
    for (int i = 0; i < CARS; i++) {
        putCar(1);
        MdtBodySetPosition(body, (MeReal)(4.5 * (i / 6) - 10), (MeReal)(4 * (i % 6) - 10), 1);
        all[i] = body;
        vehicle[i] = car;
    }
    for (int k = 0; k < 120; k++) {
        for (int i = 0; i < CARS; i++)
            MstVehicleDrive(vehicle[i], 1, (MeReal)sin(i + .05 * k), 0, 0);
        run(1. / 60);
    }
    for (int i = 0; i < CARS; i++)
        MdtBodyGetPosition(all[i], end[i]);
    MdtWorldSetTaskPool(u->world, 0);
    if (pool)
        MeTaskPoolDestroy(pool);
}

TEST(threads_change_nothing) {
    static MeReal end[2][CARS][3];
    driveMany(1, end[0]);
    driveMany(4, end[1]);
    ck_assert(memcmp(end[0], end[1], sizeof end[0]) == 0);
}

/* ---- input ------------------------------------------------------------------------------------------------------- */

TEST(bad_arguments_are_refused) {
    setCar(&setups[0]);
    universe_addFloor();
    putCar(0);
    McdModelID chassis = MstVehicleGetChassis(car);
    McdModelID other = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 1), 1);
    MstVehicleParams bad = params;
    MstWheelParams badWheel = wheels[0];
    assert_refused(MstVehicleSetDefaults, 0, u);
    assert_refused(MstWheelSetDefaults, &badWheel, 0);
    assert_none(MstVehicleCreate, 0, other, &params);
    assert_none(MstVehicleCreate, u, 0, &params);
    assert_none(MstVehicleCreate, u, other, 0);
    assert_none(MstVehicleCreate, u, chassis, &params); /* it has one */
    bad.redline = bad.idle;
    assert_none(MstVehicleCreate, u, other, &bad);
    badWheel.along.count = 0;
    assert_refused(MstVehicleAddWheel, car, &badWheel);
    ck_assert_int_eq(MstVehicleGetWheelCount(car), WHEELS);
    assert_refused(MstVehicleDrive, car, (MeReal)NAN, 0, 0, 0);
    assert_refused(MstVehicleSetGear, car, 99);
    assert_none(MstVehicleGetWheelTransformPtr, car, WHEELS);
    assert_none(MstVehicleGetGear, 0);
}

/* ---- wheels that are bodies -------------------------------------------------------------------------------------- */

/* They stand, drive, steer and brake as the others do, by contacts; in any unit of length. */
static void driveOnBodies(int i) {
    Setup s = setups[i];
    s.cast = kMstVehicleBodies;
    setCar(&s);
    universe_addFloor();
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 1, 0);
    for (int k = 0; k < WHEELS; k++) {
        wheels[k].inertia = (MeReal)(1e-3 * now.mass * now.size * now.size);
        wheels[k].brake = (MeReal)(.5 * now.mass * metre * now.size);
    }
    putCar(0);
    run(3);
    assert_near(place(2) / now.size, .52, 5e-3);
    drive(1, 0, 0, 0);
    run(2);
    ck_assert(velocity(0) > metre && fabs(place(1)) < .05 * now.size);
    drive(.3, .5, 0, 0);
    run(1);
    MeVector3 spin;
    MdtBodyGetAngularVelocity(body, spin);
    ck_assert((double)spin[2] > .05);
    drive(0, 0, 1, 0);
    run(6);
    assert_near(hypot(velocity(0), velocity(1)) / metre, 0, .01);
    MdtBodySetPosition(body, (MeReal)(50 * metre), 0, (MeReal)(.52 * now.size)); /* the wheels go with it */
    run(1);
    for (int k = 0; k < WHEELS; k++)
        ck_assert((double)MstVehicleGetWheelTransformPtr(car, k)[3][0] > 40 * metre);
    ck_assert(wheel(0).ground && fabs(place(2) / now.size - .52) < .05);
    MstVehicleDestroy(car);
    ck_assert_int_eq((int)MdtWorldGetTotalBodies(u->world), 1);
}

TEST(its_wheels_may_be_bodies) {
    for (int i = 0; i < 6; i++) {
        metre = i % 2 ? 100 : 1;
        driveOnBodies(i / 2);
    }
    metre = 1;
}

/* In centimetres: the way after some seconds of all pedals is a hundred times that in metres. */
static void driveInUnits(int i, double unit, double way[2]) {
    metre = unit;
    setCar(&setups[i]);
    params.axleLock = 1;
    params.shiftTime = (MeReal).1;
    universe_addFloor();
    putCar(0);
    for (int k = 0; k < (int)(6 / now.h); k++) {
        const double t = k * now.h;
        drive(t < 2 ? .5 : t < 4 ? -.5 : .5, .3, 0, t > 5);
        run(now.h);
    }
    way[0] = place(0) / metre;
    way[1] = place(1) / metre;
    metre = 1;
}

TEST(it_drives_alike_in_any_unit_of_length) {
    for (int i = 0; i < SETUPS; i++) {
        double metres[2], centimetres[2];
        driveInUnits(i, 1, metres);
        driveInUnits(i, 100, centimetres);
        for (int k = 0; k < 2; k++)
            assert_near(centimetres[k], metres[k], TOL(1e-2, 1e-4));
    }
}
