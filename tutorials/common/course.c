#include "course.h"
#include "drive.h"
#include "terrain.h"

/* From point to point, x and z. */
static const MeReal course[][2] = {{20, -8},  {40, -8}, {52, 14},   {36, 40},   {0, 48},
                                   {-36, 40}, {-54, 8}, {-52, -16}, {-40, -14}, {-20, -8}};
enum { COURSE = sizeof course / sizeof course[0] };

static MeAppTerrain *terrain;
static MeMatrix4 rampTM;
static MeBool isAutomatic;
static int target;

MeBool courseCreate(void) {
    terrain = terrainCreate(30, 3);
    return terrain != 0;
}

void courseShow(void) {
    static const MeVector3 corner[6] = {{-4, 0, -2}, {-4, 0, 2}, {3, 0, -2}, {3, 0, 2}, {3, 1, -2}, {3, 1, 2}};
    MeAppTerrainCreateModel(terrain, playUniverse);
    MeAppTerrainShow(terrain, playRc);
    MeMatrix4TMMakeIdentity(rampTM);
    MeVector3Set(rampTM[3], 8, 0, -8);
    playFixed(McdConvexMeshCreateHull(playUniverse->frame, corner, 6, 0), rampTM, RPalette[1]);
}

void courseStart(McdModelID chassis, MeReal height, float cameraDistance) {
    playPlace(chassis, -26, height, -8, 1, 0);
    isAutomatic = METRUE;
    target = 0;
    MeAppFollow(playApp, McdModelGetBody(chassis), cameraDistance, .22f);
    RCameraRotateAngle(playRc, -.6f); /* a little from the side */
}

void courseDrive(MstVehicleID v, MeReal fastest, MeReal sharp, MeReal calm, MeReal handbrake) {
    const MdtBodyID body = McdModelGetBody(MstVehicleGetChassis(v));
    const MeReal curvature = driveAlong(body, course, COURSE, &target), speed = MstVehicleGetSpeed(v);
    const MeReal slower = 1 / (1 + speed * speed / (calm * calm)), limit = fastest / (1 + 20 * MeFabs(curvature));
    isAutomatic = isAutomatic && !driveForward() && !driveLeft();
    if (isAutomatic)
        MstVehicleDrive(v, speed < limit ? (MeReal)0.6 : 0, sharp * curvature, speed > limit + 2 ? (MeReal)0.3 : 0,
                        handbrake);
    else
        MstVehicleDrive(v, (MeReal)driveForward(), (MeReal)driveLeft() * slower, 0, handbrake);
}
