/* The User Guide's quadbike (chapter 8) on flat ground, from the universe (PASTE_01) to a callback (PASTE_15);
 * beside it a chassis without wheels, whose contacts have what PASTE_02 sets: a type of friction, and no force. */
#include "MeViewer.h"
#include "Mst.h"
#include <stdlib.h>

enum { WHEELS = 4 };

typedef struct Vehicle {
    MdtBodyID chassisBody, wheelBody[WHEELS], hBarBody;
    McdModelID chassisCM, wheelCM[WHEELS];
    MdtCarWheelID wheelJoint[WHEELS];
    MdtHingeID hBarJoint;
} Vehicle;

static const MeReal timeStep = 0.02f;
static MstUniverseID universe;
static MdtWorldID world;
static McdSpaceID space;
static MstBridgeID bridge;
static McdFrameworkID framework;
static MstMaterialID groundMat, wheelMat, chassisMat;
static MeMatrix4 ground;
static Vehicle quadBike;
static MdtBodyID bareChassis;
static RRender *rc;
static int ticks;

/* PASTE_01 */
static int InitialiseMEWorld(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = 20;
    sizes.dynamicConstraintsMaxCount = 1000;
    sizes.materialsMaxCount = 10;
    sizes.collisionModelsMaxCount = 300;
    sizes.collisionPairsMaxCount = 1000;
    sizes.collisionUserGeometryTypesMaxCount = 0;
    sizes.collisionGeometryInstancesMaxCount = 0;
    universe = MstUniverseCreate(&sizes);
    if (!universe)
        return 0;
    world = MstUniverseGetWorld(universe);
    space = MstUniverseGetSpace(universe);
    bridge = MstUniverseGetBridge(universe);
    framework = MstUniverseGetFramework(universe);
    MdtWorldSetEpsilon(world, 0.0001f);
    MdtWorldSetGamma(world, timeStep * 10);
    MdtWorldSetGravity(world, 0, -20, 0);
    return 1;
}

/* PASTE_15 */
static MeBool MEAPI WheelGroundCB(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    MdtBodyID body = MdtContactGetBody(dynC, 0);
    MdtCarWheelID wj = (MdtCarWheelID)MdtBodyGetUserData(body);
    if (wj) {
        MeVector3 haxis, normal, dir;
        MdtContactParamsID params = MdtContactGetParams(dynC);
        MdtCarWheelGetHingeAxis(wj, haxis);
        MdtContactGetNormal(dynC, normal);
        MeVector3Cross(dir, normal, haxis);
        MeVector3Normalize(dir);
        MdtContactSetDirection(dynC, dir[0], dir[1], dir[2]);
        MdtContactParamsSetSecondarySlip(params, 0.001f + MeFabs(MeVector3Dot(normal, haxis)));
    }
    (void)result, (void)colC;
    return 1;
}

/* PASTE_02 and PASTE_14 */
static void InitialiseMaterials(void) {
    MdtContactParamsID params;
    groundMat = MstBridgeGetDefaultMaterial();
    wheelMat = MstBridgeGetNewMaterial(bridge);
    chassisMat = MstBridgeGetNewMaterial(bridge);
    params = MstBridgeGetContactParams(bridge, groundMat, wheelMat);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetPrimarySlip(params, 0.0001f);
    MdtContactParamsSetSecondarySlip(params, 0.005f);
    MdtContactParamsSetSoftness(params, 0.0001f);
    params = MstBridgeGetContactParams(bridge, groundMat, chassisMat);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetSoftness(params, 0.0001f);
    MstBridgeSetPerContactCB(bridge, wheelMat, groundMat, WheelGroundCB);
}

/* PASTE_05, without triangles: from the XY plane to XZ. */
static void InitialiseTerrain(void) {
    MeALIGNDATA(MeMatrix4, tm, 16) = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    McdModelID model = McdModelCreate((McdGeometryID)McdPlaneCreate(framework));
    MeMatrix4Copy(ground, tm);
    McdModelSetTransformPtr(model, ground);
    McdSpaceInsertModel(space, model);
    McdModelSetMaterial(model, groundMat);
    McdSpaceUpdateModel(model);
    McdSpaceFreezeModel(model);
}

/* PASTE_06 */
static void createChassis(Vehicle *veh, MeReal x) {
    MeMatrix3 Ixyz = {{5, 0, 0}, {0, 45, 0}, {0, 0, 40}};
    MeMatrix4 comTM;
    MeMatrix4TMMakeIdentity(comTM);
    comTM[3][1] = -0.15f;
    veh->chassisBody = MdtBodyCreate(world);
    veh->chassisCM = McdModelCreate((McdGeometryID)McdBoxCreate(framework, 2, 0.4f, 0.6f));
    McdModelSetBody(veh->chassisCM, veh->chassisBody);
    McdModelSetMaterial(veh->chassisCM, chassisMat);
    McdSpaceInsertModel(space, veh->chassisCM);
    MdtBodyEnable(veh->chassisBody);
    MdtBodySetPosition(veh->chassisBody, x, 0.7f, 0);
    MdtBodySetMass(veh->chassisBody, 150);
    MdtBodySetInertiaTensor(veh->chassisBody, Ixyz);
    MdtBodySetCenterOfMassRelativeTransform(veh->chassisBody, comTM);
}

/* PASTE_07 and PASTE_08 */
static void createWheel(Vehicle *veh, int i) {
    MeMatrix3 Ixyz = {{0.25f, 0, 0}, {0, 0.25f, 0}, {0, 0, 0.25f}};
    MeVector3 pos;
    veh->wheelBody[i] = MdtBodyCreate(world);
    veh->wheelCM[i] = McdModelCreate((McdGeometryID)McdSphereCreate(framework, 0.35f));
    McdModelSetBody(veh->wheelCM[i], veh->wheelBody[i]);
    McdModelSetMaterial(veh->wheelCM[i], wheelMat);
    McdSpaceInsertModel(space, veh->wheelCM[i]);
    MdtBodyEnable(veh->wheelBody[i]);
    MdtBodySetMass(veh->wheelBody[i], 10);
    MdtBodySetInertiaTensor(veh->wheelBody[i], Ixyz);
    MdtBodySetPosition(veh->wheelBody[i], i < 2 ? 0.8f : -0.8f, 0.4f, i % 2 ? 0.6f : -0.6f);
    McdSpaceDisablePair(veh->wheelCM[i], veh->chassisCM);
    for (int j = i - 1; j >= 0; j--)
        McdSpaceDisablePair(veh->wheelCM[i], veh->wheelCM[j]);
    veh->wheelJoint[i] = MdtCarWheelCreate(world);
    MdtCarWheelSetBodies(veh->wheelJoint[i], veh->chassisBody, veh->wheelBody[i]);
    MdtBodyGetPosition(veh->wheelBody[i], pos);
    MdtCarWheelSetPosition(veh->wheelJoint[i], pos[0], pos[1], pos[2]);
    MdtCarWheelSetSteeringAndHingeAxes(veh->wheelJoint[i], 0, 1, 0, 0, 0, 1);
    if (i >= 2)
        MdtCarWheelSetSteeringLock(veh->wheelJoint[i], 1);
    MdtCarWheelSetSuspension(veh->wheelJoint[i], 50000, 0.4f, 0.001f, -0.15f, 0.15f, 0);
    MdtCarWheelEnable(veh->wheelJoint[i]);
    MdtBodySetUserData(veh->wheelBody[i], (void *)veh->wheelJoint[i]);
}

/* PASTE_09 */
static void createHandlebars(Vehicle *veh) {
    veh->hBarBody = MdtBodyCreate(world);
    MdtBodyEnable(veh->hBarBody);
    MdtBodySetPosition(veh->hBarBody, 0.5f, 1.3f, 0);
    veh->hBarJoint = MdtHingeCreate(world);
    MdtHingeSetBodies(veh->hBarJoint, veh->chassisBody, veh->hBarBody);
    MdtHingeSetAxis(veh->hBarJoint, 0, 1, 0);
    MdtHingeSetPosition(veh->hBarJoint, 0.5f, 1.3f, 0);
    MdtHingeEnable(veh->hBarJoint);
}

/* PASTE_10, PASTE_12 and PASTE_13: throttle, and a little to the left. */
static void UpdateVehicleControls(Vehicle *veh) {
    const MeReal pgap = 0.1f, maxSpeed = 10, maxForce = 1000, torque = -200, wish = 0.02f;
    MeVector3 haxis;
    for (int i = 0; i < 2; i++)
        MdtCarWheelSetSteeringLimitedForceMotor(
            veh->wheelJoint[i], maxSpeed * MeMIN(pgap, wish + MdtCarWheelGetSteeringAngle(veh->wheelJoint[i])),
            maxForce);
    for (int i = 0; i < WHEELS; i++) {
        MdtCarWheelGetHingeAxis(veh->wheelJoint[i], haxis);
        MdtBodyAddTorque(veh->wheelBody[i], torque * haxis[0], torque * haxis[1], torque * haxis[2]);
        MdtBodyAddTorque(veh->chassisBody, -torque * haxis[0], -torque * haxis[1], -torque * haxis[2]);
    }
    MdtLimitController(MdtHingeGetLimit(veh->hBarJoint), -wish, pgap, maxSpeed, maxForce);
}

/* PASTE_03 and PASTE_04 */
static void MEAPI tick(RRender *context, void *data) {
    UpdateVehicleControls(&quadBike);
    McdSpaceUpdateAll(space);
    MstBridgeUpdateContacts(bridge, space, world);
    MdtWorldStep(world, timeStep);
    ticks++;
    (void)context, (void)data;
}

/* The quadbike has gone forward; the chassis without wheels lies on the ground and has not slid. */
static int isRight(void) {
    MeVector3 rides, lies;
    MdtBodyGetPosition(quadBike.chassisBody, rides);
    MdtBodyGetPosition(bareChassis, lies);
    return ticks == 60 && rides[0] > 1 && rides[1] > 0.3f && lies[1] > 0.1f && lies[1] < 0.25f &&
           MeFabs(lies[0] + 10) < 0.1f;
}

static void MEAPI_CDECL cleanup(void) {
    const int right = isRight();
    MstUniverseDestroy(universe);
    RRenderContextDestroy(rc);
    if (!right)
        _Exit(1);
}

int MEAPI_CDECL main(int argc, const char *argv[]) {
    Vehicle bare;
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    if (!rc || !InitialiseMEWorld())
        return 1;
    InitialiseMaterials();
    InitialiseTerrain();
    createChassis(&quadBike, 0);
    for (int i = 0; i < WHEELS; i++)
        createWheel(&quadBike, i);
    createHandlebars(&quadBike);
    createChassis(&bare, -10);
    bareChassis = bare.chassisBody;
    atexit(cleanup);
    RRun(rc, tick, 0);
    return 1;
}
