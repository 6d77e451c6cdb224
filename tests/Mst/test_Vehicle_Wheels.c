/* Wheels of vehicles on ground of several materials, and wheels whose parameters change. */
#include "McdMesh.h"
#include "vehicle.h"

static MeMatrix4 groundTM = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
static MstMaterialID rubber, ice, gravel, plain;

/* Materials of tyres and grounds; of the last one and tyres nothing is set. */
static void makeMaterials(double onIce, double onGravel) {
    rubber = MstBridgeGetNewMaterial(u->bridge);
    ice = MstBridgeGetNewMaterial(u->bridge);
    gravel = MstBridgeGetNewMaterial(u->bridge);
    plain = MstBridgeGetNewMaterial(u->bridge);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, rubber, ice), (MeReal)onIce, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, gravel, rubber), (MeReal)onGravel, 0);
    for (int i = 0; i < WHEELS; i++)
        wheels[i].material = (int)rubber;
}

/* A floor in two halves: y > 0 is of the first material. */
static void addHalves(MstMaterialID left, MstMaterialID right) {
    const MeReal far = (MeReal)(2000 * metre);
    const MeVector3 corner[6] = {{-far, 0, 0},   {far, 0, 0},     {far, far, 0},
                                 {-far, far, 0}, {-far, -far, 0}, {far, -far, 0}};
    static const int index[12] = {0, 1, 2, 0, 2, 3, 4, 5, 1, 4, 1, 0};
    const MeU32 material[4] = {left, left, right, right};
    MstFixedModelCreate(u, McdMeshCreate(u->frame, corner, 6, index, 4, material), groundTM);
}

/* The way that the car needs to stop, over that with a coefficient of 1. */
static double stop(void) {
    const double speed = 12 * metre;
    run(.5);
    setSpeed(speed);
    run(.2);
    const double from = place(0), v = velocity(0);
    drive(0, 0, 1, 0);
    run(speed / metre / .2 / GRAVITY + 2);
    assert_near(velocity(0) / metre, 0, 1e-4);
    return (place(0) - from) / (v * v / 2 / GRAVITY / metre);
}

/* Curves times the coefficient of the pair of materials; as they are, where there is none. */
TEST(it_brakes_by_the_material_of_the_ground) {
    for (int i = 0; i < SETUPS; i++)
        for (int k = 0; k < 4; k++) {
            setCar(&setups[i]);
            makeMaterials(.2, .6);
            if (k == 3)
                MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal).1, 0);
            const MstMaterialID ground = k == 0 ? ice : k == 1 ? gravel : plain;
            addHalves(ground, ground);
            putCar(0);
            assert_near(stop() * (k == 0 ? .2 : k == 1 ? .6 : 1), 1, .03);
        }
}

/* Tyres without a material have their curves on any ground. */
TEST(without_a_material_curves_hold_anywhere) {
    setCar(&setups[0]);
    makeMaterials(.2, .6);
    for (int k = 0; k < WHEELS; k++)
        wheels[k].material = -1;
    addHalves(ice, ice);
    putCar(0);
    assert_near(stop(), 1, .03);
}

/* Half of the car on ice, of no friction at all: each triangle has its own. */
TEST(each_wheel_has_the_grip_of_its_triangle) {
    setCar(&setups[0]);
    makeMaterials(0, .5);
    addHalves(ice, gravel);
    putCar(0);
    run(.5);
    setSpeed(10);
    drive(0, 0, 1, 0);
    run(.1);
    for (int k = 0; k < WHEELS; k++) {
        const MstWheelState w = wheel(k);
        const double share = hypot((double)w.force[0], (double)w.force[1]) / (double)w.load;
        if (k % 2) /* right: gravel */
            assert_near(share, .5, .03);
        else
            assert_near(share, 0, 2e-3);
    }
}

TEST(wheels_may_change) {
    for (int i = 0; i < SETUPS; i++) {
        MstWheelParams is;
        setCar(&setups[i]);
        universe_addFloor();
        putCar(0);
        run(2);
        const double before = place(2), more = .1 * now.size;
        for (int k = 0; k < WHEELS; k++) {
            ck_assert(MstVehicleGetWheelParams(car, k, &is));
            ck_assert(memcmp(&is, &wheels[k], sizeof is) == 0);
            is.radius += (MeReal)more;
            is.along = tyre(.08, .5);
            is.axle = 1 - is.axle;
            ck_assert(MstVehicleSetWheelParams(car, k, &is));
        }
        run(3);
        assert_near((place(2) - before) / more, 1, .02);
        assert_near(stop() / 2, 1, .03);
    }
}

TEST(bad_changes_are_refused) {
    MstWheelParams bad, is;
    setCar(&setups[0]);
    universe_addFloor();
    putCar(0);
    bad = wheels[0];
    bad.radius = 0;
    assert_refused(MstVehicleSetWheelParams, car, 0, &bad);
    bad = wheels[0];
    bad.material = 99;
    assert_refused(MstVehicleSetWheelParams, car, 0, &bad);
    assert_refused(MstVehicleSetWheelParams, car, WHEELS, &wheels[0]);
    assert_refused(MstVehicleSetWheelParams, car, 0, 0);
    assert_refused(MstVehicleGetWheelParams, car, -1, &is);
    assert_refused(MstVehicleGetWheelParams, car, 0, 0);
    bad.material = -2;
    assert_refused(MstVehicleAddWheel, car, &bad);
    ck_assert(MstVehicleGetWheelParams(car, 0, &is));
    ck_assert(memcmp(&is, &wheels[0], sizeof is) == 0);
}
