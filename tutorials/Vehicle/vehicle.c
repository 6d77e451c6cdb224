/* Vehicle: a car in few lines (MstVehicle.h).
 *
 * The chassis is a box with a body. Its wheels have none: the vehicle casts them onto the ground, and has springs,
 * tyres, an engine with five gears and an automatic, differentials and brakes. The program says no more than what a
 * driver does, and draws the wheels by their transforms. Over the ramp the car flies; it pushes the crates away.
 *
 * Left alone it drives round a course. Watch the load of the wheels in bends, and the slip of those that drive when it
 * starts.
 */
#include "course.h"
#include "parts.h"
#include <stdio.h>

enum { WHEELS = 4, CRATES = 6 };

static McdModelID chassis, crate[CRATES];
static MstVehicleID car;
static MeReal handbrake;

static void createCar(void) {
    const MeVector3 low = {0, (MeReal)-0.2, 0};
    MstVehicleParams params;
    MstWheelParams wheel;
    chassis =
        playModel(McdBoxCreate(playUniverse->frame, (MeReal)3.8, (MeReal)0.5, (MeReal)1.6), 400, 0, 1, 0, RPalette[0]);
    MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(chassis), low);
    partBox(playRc, 1.8f, .5f, 1.4f, (MeReal)-0.2, (MeReal)0.45, 0, RPalette[5],
            MdtBodyGetTransformPtr(McdModelGetBody(chassis)));
    MstVehicleSetDefaults(&params, playUniverse);
    car = MstVehicleCreate(playUniverse, chassis, &params);
    MstWheelSetDefaults(&wheel, playUniverse);
    for (int i = 0; i < WHEELS; i++) { /* forward is x, left is -z */
        const MeBool isFront = i < 2;
        MeVector3Set(wheel.position, isFront ? (MeReal)1.25 : (MeReal)-1.25, (MeReal)-0.3,
                     i % 2 ? (MeReal)0.8 : (MeReal)-0.8);
        wheel.axle = i / 2;
        wheel.antiRoll = 8000;
        wheel.steering = isFront ? (MeReal)0.6 : 0;
        wheel.drive = 1;
        wheel.handbrake = isFront ? 0 : 3000;
        MstVehicleAddWheel(car, &wheel);
        partWheel(playRc, .32f, .25f, MstVehicleGetWheelTransformPtr(car, i));
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    courseStart(chassis, (MeReal)0.7, 9);
    for (int i = 0; i < CRATES; i++)
        playPlace(crate[i], 26, (MeReal)(0.35 + 0.7 * (i / 3)), (MeReal)(0.8 * (i % 3) - 8.8), 1, 0);
    handbrake = 0;
}

static void MEAPI toggleHandbrake(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    handbrake = 1 - handbrake;
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    MstWheelState w[WHEELS];
    (void)context;
    courseDrive(car, 10, 4, 14, handbrake);
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i < WHEELS; i++)
        MstVehicleGetWheel(car, i, &w[i]);
    const MeReal *at = MdtBodyGetTransformPtr(McdModelGetBody(chassis))[3];
    snprintf(text, sizeof text,
             "%.1f m/s  gear %d  rpm %.0f  loads %.0f %.0f %.0f %.0f N  slip %+.3f  x %.1f y %.2f z %.1f m",
             (double)MstVehicleGetSpeed(car), MstVehicleGetGear(car), (double)MstVehicleGetEngineSpeed(car),
             (double)w[0].load, (double)w[1].load, (double)w[2].load, (double)w[3].load, (double)w[2].slip[0],
             (double)at[0], (double)at[1], (double)at[2]);
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"A car, hills, a ramp and some crates.", "$UP - throttle",
                                       "$DOWN - brake; standing: back",         "$LEFT, $RIGHT - steer",
                                       "$ACTION1 - handbrake on or off",        "$ACTION2 - start again"};
    static const float wood[4] = {.76f, .58f, .36f, 1};
    if (!courseCreate() || !playStart(argc, argv, "Vehicle", 1 + CRATES))
        return 1;
    courseShow();
    const McdGeometryID cube = McdBoxCreate(playUniverse->frame, (MeReal)0.7, (MeReal)0.7, (MeReal)0.7);
    for (int i = 0; i < CRATES; i++)
        crate[i] = playModel(cube, 40, 0, 0, 0, wood);
    createCar();
    playHelp(help, 6);
    RRenderSetActionNCallBack(playRc, 1, toggleHandbrake, 0);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
