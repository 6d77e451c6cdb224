/* Motorcycle: two wheels that lean into curves (MstVehicle.h, leanLimit).
 *
 * Two wheels in line do not stand by themselves: the vehicle's balance, a damped spring about the length of the
 * machine, leans it to the angle at which gravity and the curve are in balance, tan(lean) = v² / (r g). It steers no
 * further than it leans, so that it first leans over, as riders do.
 *
 * Left alone it rides round a course. Compare the lean with v² / (r g) in the status line.
 */
#include "course.h"
#include "parts.h"
#include <stdio.h>

static McdModelID chassis;
static MstVehicleID bike;

static void createBike(void) {
    const float seat[4] = {.2f, .2f, .22f, 1};
    MstVehicleParams params;
    MstWheelParams wheel;
    chassis =
        playModel(McdBoxCreate(playUniverse->frame, (MeReal)1.1, (MeReal)0.5, (MeReal)0.3), 1500, 0, 1, 0, RPalette[4]);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(McdModelGetBody(chassis));
    partBox(playRc, .7f, .12f, .28f, (MeReal)-0.3, (MeReal)0.3, 0, seat, tm);
    partBox(playRc, .08f, .08f, .7f, (MeReal)0.45, (MeReal)0.45, 0, seat, tm);
    MstVehicleSetDefaults(&params, playUniverse);
    params.torque = (MstCurve){3, {{1000, 40}, {6000, 70}, {9000, 50}}};
    params.engineInertia = (MeReal)0.02;
    params.engineBraking = 10;
    params.redline = 9000;
    params.shiftUp = 8000;
    params.shiftDown = 3000;
    params.leanLimit = (MeReal)0.8;
    bike = MstVehicleCreate(playUniverse, chassis, &params);
    MstWheelSetDefaults(&wheel, playUniverse);
    wheel.inertia = (MeReal)0.5;
    wheel.frequency = 2;
    for (int i = 0; i < 2; i++) {
        MeVector3Set(wheel.position, i ? (MeReal)-0.7 : (MeReal)0.7, (MeReal)-0.25, 0);
        wheel.axle = i;
        wheel.brake = i ? 150 : 400;
        wheel.steering = i ? 0 : (MeReal)0.6;
        wheel.drive = (MeReal)i;
        MstVehicleAddWheel(bike, &wheel);
        partWheel(playRc, .32f, .14f, MstVehicleGetWheelTransformPtr(bike, i));
    }
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    courseStart(chassis, (MeReal)0.57, 6);
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    MeVector3 w;
    (void)context;
    courseDrive(bike, 12, 2, 4, 0);
    MstUniverseStep(playUniverse, playFrame);
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(McdModelGetBody(chassis));
    MdtBodyGetAngularVelocity(McdModelGetBody(chassis), w);
    snprintf(text, sizeof text, "%.1f m/s  gear %d  lean %+.1f degrees, for the curve %+.1f  x %.1f y %.2f z %.1f m",
             (double)MstVehicleGetSpeed(bike), MstVehicleGetGear(bike), (double)(MeAsin(-tm[2][1]) * -180 / ME_PI),
             (double)(MeAtan(MstVehicleGetSpeed(bike) * w[1] / (MeReal)9.81) * 180 / ME_PI), (double)tm[3][0],
             (double)tm[3][1], (double)tm[3][2]);
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"A motorcycle on hills, and a ramp.", "$UP - throttle",
                                       "$DOWN - brake; standing: back", "$LEFT, $RIGHT - steer",
                                       "$ACTION2 - start again"};
    if (!courseCreate() || !playStart(argc, argv, "Motorcycle", 1))
        return 1;
    courseShow();
    createBike();
    playHelp(help, 5);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
