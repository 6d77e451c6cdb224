/* Quadbike: a rider on a quadbike on rough ground (User Guide, chapter 8, "Quadbike Tutorial").
 *
 * What the chapter builds, in its order and with its names: materials, terrain of triangles that a callback hands over,
 * a vehicle of a chassis, four wheels that collide as balls, and handlebars; throttle, brakes and steering; a callback
 * that turns each wheel's contact into the direction in which the wheel rolls; and a rider of eight boxes, joined by
 * hinges with springs and by ball-and-socket joints, whose hands hold the handlebars. The bars pull the arms, the rider
 * leans into bends and crouches, the faster the more.
 *
 * Left alone the quadbike rides round a course; the arrow keys take the bars. Watch knees and hips over the hills, and
 * the figures: how far the rider leans, and how far the knees are bent.
 */
#include "drive.h"
#include "parts.h"
#include "play.h"
#include "terrain.h"
#include <stdio.h>

enum { FRONT_LEFT, FRONT_RIGHT, BACK_LEFT, BACK_RIGHT, WHEELS };
enum {
    LOWER_LEGS,
    UPPER_LEGS,
    TRUNK,
    HEAD,
    LEFT_UPPER_ARM,
    LEFT_LOWER_ARM,
    RIGHT_UPPER_ARM,
    RIGHT_LOWER_ARM,
    NUM_LIMBS
};
enum {
    ANKLES,
    KNEES,
    HIPS,
    NECK,
    LEFT_SHOULDER,
    RIGHT_SHOULDER,
    LEFT_ELBOW,
    RIGHT_ELBOW,
    LEFT_WRIST,
    RIGHT_WRIST,
    NUM_JOINTS
};
enum { BODIES = 1 + WHEELS + 1 + NUM_LIMBS, TRI_LIST_SIZE = 50 };

/* ---- data: m, from the middle of the chassis; forward is x, up y, right z -------------------------------------- */

typedef struct VehicleData {
    MeReal chassisDims[3], wheelRadius;
    MeVector3 wheelOffset[WHEELS], hBarOffset;
} VehicleData;

typedef struct RiderData {
    MeVector3 limbEnd[NUM_LIMBS][2]; /* the middles of a limb's ends */
    MeReal limbThick[NUM_LIMBS][2];  /* along x, and along z, when the limb hangs */
    int jointBodies[NUM_JOINTS][2];  /* -1: the vehicle */
    MeVector3 jointPos[NUM_JOINTS], jointAxis[NUM_JOINTS];
    int isHinge;                      /* a bit for each joint */
    MeReal jointParam[NUM_JOINTS][2]; /* stiffness N m/rad and damping N m s/rad of a hinge's limits */
} RiderData;

static const VehicleData vehicleData = {
    {(MeReal)1.75, (MeReal)0.3, (MeReal)0.45},
    (MeReal)0.25,
    {{(MeReal)0.65, (MeReal)-0.2, (MeReal)-0.48},
     {(MeReal)0.65, (MeReal)-0.2, (MeReal)0.48},
     {(MeReal)-0.6, (MeReal)-0.2, (MeReal)-0.48},
     {(MeReal)-0.6, (MeReal)-0.2, (MeReal)0.48}},
    {(MeReal)0.5, (MeReal)0.45, 0},
};

#define ANKLE                                                                                                          \
    { 0, (MeReal)-0.1, 0 }
#define KNEE                                                                                                           \
    { (MeReal)0.22, (MeReal)0.28, 0 }
#define HIP                                                                                                            \
    { (MeReal) - 0.2, (MeReal)0.38, 0 }
#define THROAT                                                                                                         \
    { (MeReal)0.05, (MeReal)0.85, 0 }
#define CROWN                                                                                                          \
    { (MeReal)0.1, (MeReal)1.09, 0 }
#define SHOULDER(side)                                                                                                 \
    { (MeReal)0.03, (MeReal)0.8, (side) * (MeReal)0.22 }
#define ELBOW(side)                                                                                                    \
    { (MeReal)0.2, (MeReal)0.5, (side) * (MeReal)0.44 }
#define GRIP(side)                                                                                                     \
    { (MeReal)0.5, (MeReal)0.45, (side) * (MeReal)0.34 }
#define AXIS_X                                                                                                         \
    { 1, 0, 0 }
#define AXIS_Z                                                                                                         \
    { 0, 0, 1 }
/* Rotated forwards: as the arm moves back, the elbow moves outwards. */
#define SHOULDER_AXIS(side)                                                                                            \
    { (side) * (MeReal)0.3, 0, (MeReal)0.954 }

/* Right and left legs are one body. */
static const RiderData riderData = {
    {{ANKLE, KNEE},
     {KNEE, HIP},
     {HIP, THROAT},
     {THROAT, CROWN},
     {SHOULDER(-1), ELBOW(-1)},
     {ELBOW(-1), GRIP(-1)},
     {SHOULDER(1), ELBOW(1)},
     {ELBOW(1), GRIP(1)}},
    {{(MeReal)0.12, (MeReal)0.7},
     {(MeReal)0.16, (MeReal)0.6},
     {(MeReal)0.2, (MeReal)0.36},
     {(MeReal)0.2, (MeReal)0.18},
     {(MeReal)0.1, (MeReal)0.1},
     {(MeReal)0.08, (MeReal)0.08},
     {(MeReal)0.1, (MeReal)0.1},
     {(MeReal)0.08, (MeReal)0.08}},
    {{LOWER_LEGS, -1},
     {UPPER_LEGS, LOWER_LEGS},
     {TRUNK, UPPER_LEGS},
     {HEAD, TRUNK},
     {LEFT_UPPER_ARM, TRUNK},
     {RIGHT_UPPER_ARM, TRUNK},
     {LEFT_LOWER_ARM, LEFT_UPPER_ARM},
     {RIGHT_LOWER_ARM, RIGHT_UPPER_ARM},
     {LEFT_LOWER_ARM, -1},
     {RIGHT_LOWER_ARM, -1}},
    {ANKLE, KNEE, HIP, THROAT, SHOULDER(-1), SHOULDER(1), ELBOW(-1), ELBOW(1), GRIP(-1), GRIP(1)},
    {AXIS_Z, AXIS_Z, AXIS_X, AXIS_Z, SHOULDER_AXIS(-1), SHOULDER_AXIS(1), {0}, {0}, {0}, {0}},
    1 << ANKLES | 1 << KNEES | 1 << HIPS | 1 << NECK | 1 << LEFT_SHOULDER | 1 << RIGHT_SHOULDER,
    {{8000, 500}, {8000, 500}, {4000, 300}, {400, 20}},
};

/* Where it rides by itself. */
static const MeReal course[][2] = {{14, 0},   {38, -4}, {50, 16},   {34, 40}, {0, 46},
                                   {-36, 38}, {-52, 8}, {-40, -20}, {-14, 0}};

enum { COURSE = sizeof course / sizeof course[0] };

/* ---- what there is --------------------------------------------------------------------------------------------- */

typedef struct Vehicle {
    const VehicleData *data;
    MdtBodyID chassisBody, wheelBody[WHEELS], hBarBody;
    McdGeometryID chassisGeom, wheelGeom[WHEELS];
    McdModelID chassisCM, wheelCM[WHEELS];
    MdtCarWheelID wheelJoint[WHEELS];
    MdtHingeID hBarJoint;
    MeReal throttleInput, brakeInput, steeringInput; /* 0 to 1, 0 to 1, -1 to 1: to the left */
} Vehicle;

typedef struct Rider {
    const RiderData *data;
    MdtBodyID limbBody[NUM_LIMBS];
    McdGeometryID limbGeom[NUM_LIMBS];
    McdModelID limbCM[NUM_LIMBS];
    MdtConstraintID joint[NUM_JOINTS];
} Rider;

static struct {
    McdGeometryID collGeom;
    McdModelID collModel;
    MeMatrix4 transform;
} landscape;

static Vehicle quadBike = {.data = &vehicleData};
static Rider character = {.data = &riderData};
static MstMaterialID groundMat, wheelMat, chassisMat;

static const MeVector3 startPos = {-20, (MeReal)0.45, 0};
static MeMatrix4 startTM[BODIES]; /* of all bodies, in the world's order */

static const MeReal width = (MeReal)0.5;   /* rad, of the steering */
static const MeReal pgap = (MeReal)0.1;    /* rad: nearer to its goal the steering slows down */
static const MeReal maxSpeed = 20;         /* 1/s, and for the bars rad/s times ten: of the steering */
static const MeReal maxForce = 400;        /* N m, of the steering */
static const MeReal maxAng = (MeReal)0.35; /* rad, of the rider's leaning */

static MeBool isAutomatic;
static int target; /* of the course */
static MeAppTerrain *terrain;

/* ---- terrain --------------------------------------------------------------------------------------------------- */

/* The row or column of cells that is a way from the middle. */
static int cellAt(MeReal way) {
    const int points = MeAppTerrainGetPoints(terrain);
    const int n = (int)((MeReal)(points / 2) + way / MeAppTerrainGetCell(terrain));
    return MeCLAMP(n, 0, points - 2);
}

/* Hands over the triangles of the cells round a place: the grid tells at once which those are. */
static int MEAPI TriListGeneratorCB(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius,
                                    int max) {
    const int i0 = cellAt(pos[0] - radius), i1 = cellAt(pos[0] + radius);
    const int j0 = cellAt(-pos[2] - radius), j1 = cellAt(-pos[2] + radius);
    int count = 0;
    (void)pair;
    for (int j = j0; j <= j1; j++) {
        for (int i = i0; i <= i1; i++) {
            for (int t = 0; t < 2 && count < max; t++, count++) {
                for (int k = 0; k < 3; k++)
                    triangle[count].vertices[k] = MeAppTerrainGetCorner(terrain, i, j, t, k);
                triangle[count].normal = 0;
                triangle[count].flags = (McdTriangleFlags)(kMcdTriangleUseSmallestPenetration | kMcdTriangleUseEdges);
                triangle[count].triangleData.ptr = 0;
            }
        }
    }
    return count;
}

static void InitialiseTerrain(void) {
    MeVector3 min = {-80, -10, -80}, max = {80, 30, 80};
    landscape.collGeom = McdTriangleListCreate(playUniverse->frame, min, max, TRI_LIST_SIZE, TriListGeneratorCB);
    landscape.collModel = McdModelCreate(landscape.collGeom);
    MeMatrix4TMMakeIdentity(landscape.transform);
    McdModelSetTransformPtr(landscape.collModel, landscape.transform);
    McdSpaceInsertModel(playUniverse->space, landscape.collModel);
    McdModelSetMaterial(landscape.collModel, (int)groundMat);
    McdSpaceUpdateModel(landscape.collModel);
    McdSpaceFreezeModel(landscape.collModel);
}

/* ---- materials ------------------------------------------------------------------------------------------------- */

/* Has a wheel's contact lie along the way in which the wheel rolls, and slip the more to the side the more it leans. */
static MeBool MEAPI WheelGroundCB(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    const MdtBodyID body = MdtContactGetBody(dynC, 0); /* terrain has no body so wheel must be body 0 */
    const MdtCarWheelID wj = (MdtCarWheelID)MdtBodyGetUserData(body);
    MeVector3 haxis, normal, dir;
    (void)result, (void)colC;
    if (wj) {
        MdtCarWheelGetHingeAxis(wj, haxis);
        MdtContactGetNormal(dynC, normal);
        MeVector3Cross(dir, normal, haxis);
        MeVector3Normalize(dir);
        MdtContactSetDirection(dynC, dir[0], dir[1], dir[2]);
        MdtContactParamsSetSecondarySlip(MdtContactGetParams(dynC),
                                         (MeReal)0.001 + MeFabs(MeVector3Dot(normal, haxis)));
    }
    return METRUE;
}

static void InitialiseMaterials(void) {
    const MstBridgeID bridge = playUniverse->bridge;
    groundMat = MstBridgeGetDefaultMaterial();
    wheelMat = MstBridgeGetNewMaterial(bridge);
    chassisMat = MstBridgeGetNewMaterial(bridge);
    MdtContactParamsID params = MstBridgeGetContactParams(bridge, groundMat, wheelMat);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetPrimarySlip(params, (MeReal)0.0001);
    MdtContactParamsSetSecondarySlip(params, (MeReal)0.005);
    MdtContactParamsSetSoftness(params, (MeReal)0.0001);
    params = MstBridgeGetContactParams(bridge, groundMat, chassisMat);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetFriction(params, MEINFINITY); /* the chassis does not slide */
    MdtContactParamsSetSoftness(params, (MeReal)0.0001);
    MstBridgeSetPerContactCB(bridge, wheelMat, groundMat, WheelGroundCB);
}

/* ---- vehicle --------------------------------------------------------------------------------------------------- */

static void createChassis(Vehicle *veh) {
    MeMatrix3 Ixyz = {{5, 0, 0}, {0, 45, 0}, {0, 0, 40}}; /* 1/12 m (y² + z²), and so on */
    MeMatrix4 comTM;
    MeMatrix4TMMakeIdentity(comTM);
    MeVector3Set(comTM[3], 0, (MeReal)-0.15, 0); /* low, so that it does not roll over so easily */
    veh->chassisBody = MdtBodyCreate(playUniverse->world);
    veh->chassisGeom = McdBoxCreate(playUniverse->frame, veh->data->chassisDims[0], veh->data->chassisDims[1],
                                    veh->data->chassisDims[2]);
    veh->chassisCM = McdModelCreate(veh->chassisGeom);
    McdModelSetBody(veh->chassisCM, veh->chassisBody);
    McdModelSetMaterial(veh->chassisCM, (int)chassisMat);
    McdSpaceInsertModel(playUniverse->space, veh->chassisCM);
    MdtBodyEnable(veh->chassisBody);
    MdtBodySetPosition(veh->chassisBody, startPos[0], startPos[1], startPos[2]);
    MdtBodySetMass(veh->chassisBody, 150);
    MdtBodySetInertiaTensor(veh->chassisBody, Ixyz);
    MdtBodySetCenterOfMassRelativeTransform(veh->chassisBody, comTM);
}

static void createWheel(Vehicle *veh, int i) {
    MeMatrix3 Ixyz = {{(MeReal)0.25, 0, 0}, {0, (MeReal)0.25, 0}, {0, 0, (MeReal)0.25}}; /* 2/5 m r² */
    MeVector3 pos;
    veh->wheelBody[i] = MdtBodyCreate(playUniverse->world);
    veh->wheelGeom[i] = McdSphereCreate(playUniverse->frame, veh->data->wheelRadius);
    veh->wheelCM[i] = McdModelCreate(veh->wheelGeom[i]);
    McdModelSetBody(veh->wheelCM[i], veh->wheelBody[i]);
    McdModelSetMaterial(veh->wheelCM[i], (int)wheelMat);
    McdSpaceInsertModel(playUniverse->space, veh->wheelCM[i]);
    MdtBodyEnable(veh->wheelBody[i]);
    MdtBodySetMass(veh->wheelBody[i], 10);
    MdtBodySetInertiaTensor(veh->wheelBody[i], Ixyz);
    MeVector3Add(pos, startPos, veh->data->wheelOffset[i]);
    MdtBodySetPosition(veh->wheelBody[i], pos[0], pos[1], pos[2]);
    McdSpaceDisablePair(veh->wheelCM[i], veh->chassisCM);
    for (int j = i - 1; j >= 0; j--)
        McdSpaceDisablePair(veh->wheelCM[i], veh->wheelCM[j]);
}

/* The chassis must be the first body. The wheel's user data leads to its joint, for WheelGroundCB. */
static void createWheelJoint(Vehicle *veh, int i) {
    MeVector3 pos;
    veh->wheelJoint[i] = MdtCarWheelCreate(playUniverse->world);
    MdtCarWheelSetBodies(veh->wheelJoint[i], veh->chassisBody, veh->wheelBody[i]);
    MdtBodyGetPosition(veh->wheelBody[i], pos);
    MdtCarWheelSetPosition(veh->wheelJoint[i], pos[0], pos[1], pos[2]);
    MdtCarWheelSetSteeringAndHingeAxes(veh->wheelJoint[i], 0, 1, 0, 0, 0, 1);
    if (i == BACK_LEFT || i == BACK_RIGHT)
        MdtCarWheelSetSteeringLock(veh->wheelJoint[i], 1);
    MdtCarWheelSetSuspension(veh->wheelJoint[i], 50000, (MeReal)0.4, (MeReal)0.001, (MeReal)-0.15, (MeReal)0.15, 0);
    MdtCarWheelEnable(veh->wheelJoint[i]);
    MdtBodySetUserData(veh->wheelBody[i], (void *)veh->wheelJoint[i]);
}

static void createHandlebars(Vehicle *veh) {
    MeVector3 pos;
    veh->hBarBody = MdtBodyCreate(playUniverse->world);
    MdtBodyEnable(veh->hBarBody);
    MeVector3Add(pos, startPos, veh->data->hBarOffset);
    MdtBodySetPosition(veh->hBarBody, pos[0], pos[1], pos[2]);
    veh->hBarJoint = MdtHingeCreate(playUniverse->world);
    MdtHingeSetBodies(veh->hBarJoint, veh->chassisBody, veh->hBarBody);
    MdtHingeSetAxis(veh->hBarJoint, 0, 1, 0);
    MdtBodyGetPosition(veh->hBarBody, pos);
    MdtHingeSetPosition(veh->hBarJoint, pos[0], pos[1], pos[2]);
    MdtHingeEnable(veh->hBarJoint);
}

static void InitialiseVehicle(Vehicle *veh) {
    createChassis(veh);
    for (int i = 0; i < WHEELS; i++)
        createWheel(veh, i);
    for (int i = 0; i < WHEELS; i++)
        createWheelJoint(veh, i);
    createHandlebars(veh);
}

/* ---- rider ----------------------------------------------------------------------------------------------------- */

/* A limb's y lies along the way from its first end to the second one: the angles about x and z that turn it so. */
static MeReal limbAlong(const Rider *rider, int i, MeVector3 middle, MeReal *xAngle, MeReal *zAngle) {
    MeVector3 d, a, b;
    MeVector3Copy(a, rider->data->limbEnd[i][0]);
    MeVector3Copy(b, rider->data->limbEnd[i][1]);
    MeVector3Subtract(d, b, a);
    MeVector3Lerp(middle, a, b, (MeReal)0.5);
    *xAngle = MeAtan2(d[2], MeSqrt(d[0] * d[0] + d[1] * d[1]));
    *zAngle = MeAtan2(-d[0], d[1]);
    return MeVector3Magnitude(d);
}

static void createLimb(Rider *rider, int i) {
    MeVector3 pos;
    MeMatrix3 R;
    MeReal xAngle, zAngle;
    const MeReal length = limbAlong(rider, i, pos, &xAngle, &zAngle);
    rider->limbBody[i] = MdtBodyCreate(playUniverse->world);
    MeVector3Add(pos, startPos, pos);
    MdtBodySetPosition(rider->limbBody[i], pos[0], pos[1], pos[2]);
    MeMatrix3FromEulerAngles(R, xAngle, 0, zAngle);
    MdtBodySetOrientation(rider->limbBody[i], R);
    MdtBodyEnable(rider->limbBody[i]);

    rider->limbGeom[i] =
        McdBoxCreate(playUniverse->frame, rider->data->limbThick[i][0], length, rider->data->limbThick[i][1]);
    rider->limbCM[i] = McdModelCreate(rider->limbGeom[i]);
    McdModelSetBody(rider->limbCM[i], rider->limbBody[i]);
    McdSpaceInsertModel(playUniverse->space, rider->limbCM[i]);
    MstAutoSetMassProperties(rider->limbBody[i], rider->limbCM[i], 600);

    for (int j = i - 1; j >= 0; j--)
        McdSpaceDisablePair(rider->limbCM[i], rider->limbCM[j]);
    McdSpaceDisablePair(rider->limbCM[i], quadBike.chassisCM);
    for (int j = 0; j < WHEELS; j++)
        McdSpaceDisablePair(rider->limbCM[i], quadBike.wheelCM[j]);
}

/* What a limb is joined to: another one; the feet stand on the chassis, the hands hold the handlebars. */
static MdtBodyID otherBody(const Rider *rider, const int bodies[2]) {
    if (bodies[1] != -1)
        return rider->limbBody[bodies[1]];
    return bodies[0] == LOWER_LEGS ? quadBike.chassisBody : quadBike.hBarBody;
}

/* Upper and lower limit of a hinge are one, so that springs bring it back to where it is now. */
static void setPosture(MdtHingeID hinge, const MeReal param[2]) {
    const MdtLimitID limit = MdtHingeGetLimit(hinge);
    MdtSingleLimitSetStiffness(MdtLimitGetUpperLimit(limit), param[0]);
    MdtSingleLimitSetStiffness(MdtLimitGetLowerLimit(limit), param[0]);
    MdtSingleLimitSetDamping(MdtLimitGetUpperLimit(limit), param[1]);
    MdtSingleLimitSetDamping(MdtLimitGetLowerLimit(limit), param[1]);
    MdtLimitActivateLimits(limit, 1);
}

static void createRiderJoint(Rider *rider, int i) {
    const MdtBodyID body1 = rider->limbBody[rider->data->jointBodies[i][0]];
    const MdtBodyID body2 = otherBody(rider, rider->data->jointBodies[i]);
    const MeReal *axis = rider->data->jointAxis[i];
    MeVector3 pos;
    MeVector3Add(pos, startPos, rider->data->jointPos[i]);
    if (rider->data->isHinge & 1 << i) {
        const MdtHingeID hinge = MdtHingeCreate(playUniverse->world);
        MdtHingeSetBodies(hinge, body1, body2);
        MdtHingeSetPosition(hinge, pos[0], pos[1], pos[2]);
        MdtHingeSetAxis(hinge, axis[0], axis[1], axis[2]);
        rider->joint[i] = MdtHingeQuaConstraint(hinge);
        if (rider->data->jointParam[i][0] != 0)
            setPosture(hinge, rider->data->jointParam[i]);
    } else {
        const MdtBSJointID bsj = MdtBSJointCreate(playUniverse->world);
        MdtBSJointSetBodies(bsj, body1, body2);
        MdtBSJointSetPosition(bsj, pos[0], pos[1], pos[2]);
        rider->joint[i] = MdtBSJointQuaConstraint(bsj);
    }
    MdtConstraintEnable(rider->joint[i]);
}

static void InitialiseRider(Rider *rider) {
    for (int i = 0; i < NUM_LIMBS; i++)
        createLimb(rider, i);
    for (int i = 0; i < NUM_JOINTS; i++)
        createRiderJoint(rider, i);
}

/* ---- control --------------------------------------------------------------------------------------------------- */

/* m/s, forward */
static MeReal speedOf(const Vehicle *veh) {
    MeVector3 vel;
    MdtBodyGetLinearVelocity(veh->chassisBody, vel);
    return MeVector3Dot(vel, MdtBodyGetTransformPtr(veh->chassisBody)[0]);
}

/* The engine's torque on a wheel, and the opposite one on the chassis. It tends to 0 as the wheel gets as fast as 60
 * rad/s, as the guide proposes. Standing, and braking on, it goes back slowly. */
static void driveWheel(Vehicle *veh, int i) {
    MeVector3 haxis;
    const MeReal rate = -MdtCarWheelGetHingeAngleRate(veh->wheelJoint[i]);
    const MeReal torque = veh->throttleInput * -200 * MeMAX(1 - MeFabs(rate) / 60, 0);
    MdtCarWheelGetHingeAxis(veh->wheelJoint[i], haxis);
    MdtBodyAddTorque(veh->wheelBody[i], torque * haxis[0], torque * haxis[1], torque * haxis[2]);
    MdtBodyAddTorque(veh->chassisBody, -torque * haxis[0], -torque * haxis[1], -torque * haxis[2]);
}

/* The steering motor's velocity is proportional to what is missing: the angle is the chassis' against the wheel. */
static void steerWheel(Vehicle *veh, int i) {
    const MeReal theta = MdtCarWheelGetSteeringAngle(veh->wheelJoint[i]);
    const MeReal desired_vel = MeCLAMP(veh->steeringInput * width + theta, -pgap, pgap);
    MdtCarWheelSetSteeringLimitedForceMotor(veh->wheelJoint[i], maxSpeed * desired_vel, maxForce);
}

static void UpdateVehicleControls(Vehicle *veh) {
    for (int i = 0; i < WHEELS; i++) {
        if (i == FRONT_LEFT || i == FRONT_RIGHT)
            steerWheel(veh, i);
        else if (veh->throttleInput != 0)
            driveWheel(veh, i);
        MdtCarWheelSetHingeLimitedForceMotor(veh->wheelJoint[i], 0, veh->brakeInput * 500);
    }
    MdtLimitController(MdtHingeGetLimit(veh->hBarJoint), -veh->steeringInput * width, pgap, maxSpeed * pgap, maxForce);
}

static void setStop(MdtConstraintID joint, MeReal angle) {
    const MdtLimitID limit = MdtHingeGetLimit(MdtConstraintDCastHinge(joint));
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), angle);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), angle);
}

/* The rider leans into the bend and crouches, in proportion to the speed. */
static void UpdateRiderControls(Rider *rider) {
    MeReal angle = MeMIN(MeMAX(0, speedOf(&quadBike)) * (MeReal)0.035, maxAng);
    angle = -quadBike.steeringInput * angle;
    setStop(rider->joint[HIPS], angle);
    angle = MeFabs(angle);
    setStop(rider->joint[KNEES], angle * 2);
    setStop(rider->joint[ANKLES], -angle * (MeReal)1.2);
}

/* Keys: throttle, brake (standing: back), steering; or the course at 6 m/s. The bars turn at 3 1/s. */
static void readInput(Vehicle *veh) {
    const MeReal v = speedOf(veh), max = MeMIN(1, 20 / MeMAX(v * v, 1)), further = 3 * playFrame;
    MeReal wanted = (MeReal)driveLeft(), forward = (MeReal)driveForward();
    if (driveLeft() || driveForward())
        isAutomatic = MEFALSE;
    if (isAutomatic) {
        wanted = MeAtan((MeReal)1.25 * driveAlong(veh->chassisBody, course, COURSE, &target)) / width;
        forward = v < 6 ? (MeReal)0.8 : 0;
    }
    veh->steeringInput += MeCLAMP(MeCLAMP(wanted, -max, max) - veh->steeringInput, -further, further);
    veh->throttleInput = forward > 0 || v < (MeReal)0.5 ? MeMAX(forward, (MeReal)-0.4) : 0;
    veh->brakeInput = forward < 0 && v >= (MeReal)0.5 ? 1 : 0;
    if (forward != 0 || wanted != 0)
        MdtBodyEnable(veh->chassisBody); /* parked, it sleeps */
}

/* ---- keys and status ------------------------------------------------------------------------------------------- */

static void keepStart(void) {
    int n = 0;
    for (MdtBodyID b = MdtBodyGetFirst(playUniverse->world); b; b = MdtBodyGetNext(b))
        MdtBodyGetTransform(b, startTM[n++]);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    int n = 0;
    (void)context, (void)userdata;
    for (MdtBodyID b = MdtBodyGetFirst(playUniverse->world); b; b = MdtBodyGetNext(b)) {
        MdtBodySetTransform(b, startTM[n++]);
        MdtBodySetLinearVelocity(b, 0, 0, 0);
        MdtBodySetAngularVelocity(b, 0, 0, 0);
        MdtBodyEnable(b);
    }
    quadBike.steeringInput = 0;
    isAutomatic = METRUE;
    target = 0;
    MeAppFollow(playApp, quadBike.chassisBody, 5.5f, .22f);
    RCameraRotateAngle(playRc, -.7f); /* a little from the side */
}

static void MEAPI toggleAutomatic(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isAutomatic = !isAutomatic;
}

static double degrees(MeReal angle) {
    return (double)(angle * 180 / ME_PI);
}

static double hingeAngle(MdtConstraintID joint) {
    return degrees(MdtLimitGetPosition(MdtHingeGetLimit(MdtConstraintDCastHinge(joint))));
}

static void showFigures(void) {
    char text[240];
    MeVector3 w, at;
    MdtBodyGetAngularVelocity(quadBike.chassisBody, w);
    MdtBodyGetPosition(quadBike.chassisBody, at);
    snprintf(text, sizeof text,
             "speed %.2f m/s  steer %+.2f deg  bars %+.2f deg  turn %+.2f deg/s  lean %+.2f deg  knees %+.2f deg  x "
             "%.2f y %.3f z %.2f m",
             (double)speedOf(&quadBike), -degrees(MdtCarWheelGetSteeringAngle(quadBike.wheelJoint[FRONT_LEFT])),
             -degrees(MdtLimitGetPosition(MdtHingeGetLimit(quadBike.hBarJoint))), degrees(w[1]),
             hingeAngle(character.joint[HIPS]), hingeAngle(character.joint[KNEES]), (double)at[0], (double)at[1],
             (double)at[2]);
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    readInput(&quadBike);
    UpdateVehicleControls(&quadBike);
    UpdateRiderControls(&character);
    McdSpaceUpdateAll(playUniverse->space);
    MstBridgeUpdateContacts(playUniverse->bridge, playUniverse->space, playUniverse->world);
    MdtWorldStep(playUniverse->world, playFrame);
    showFigures();
}

/* ---- graphics -------------------------------------------------------------------------------------------------- */

static void CreateVehicleGraphics(void) {
    static const float paint[4] = {.78f, .22f, .16f, 1}, dark[4] = {.25f, .26f, .29f, 1},
                       lamp[4] = {.97f, .93f, .70f, 1};
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(quadBike.chassisBody), bar = MdtBodyGetTransformPtr(quadBike.hBarBody);
    partBox(playRc, 1.5f, .12f, .34f, 0, (MeReal)-0.12, 0, dark, tm);
    partBox(playRc, .75f, .16f, .26f, (MeReal)-0.42, (MeReal)0.06, 0, dark, tm); /* seat */
    partBox(playRc, .55f, .24f, .3f, (MeReal)0.3, (MeReal)0.04, 0, paint, tm);   /* tank */
    partBox(playRc, .25f, .06f, .9f, 0, (MeReal)-0.16, 0, dark, tm);             /* for the feet */
    for (int side = -1; side <= 1; side += 2) {
        partBox(playRc, .62f, .05f, .28f, (MeReal)0.65, (MeReal)0.14, (MeReal)(0.42 * side), paint, tm);
        partBox(playRc, .62f, .05f, .28f, (MeReal)-0.62, (MeReal)0.14, (MeReal)(0.42 * side), paint, tm);
        partBox(playRc, .06f, .1f, .14f, (MeReal)0.88, (MeReal)0.04, (MeReal)(0.12 * side), lamp, tm);
        partBox(playRc, .05f, .05f, .16f, 0, 0, (MeReal)(0.36 * side), dark, bar);
    }
    partBox(playRc, .5f, .12f, .3f, (MeReal)0.65, (MeReal)0.08, 0, paint, tm);
    partBox(playRc, .5f, .06f, .5f, (MeReal)-0.65, (MeReal)0.15, 0, dark, tm); /* rack */
    partBox(playRc, .04f, .04f, .6f, 0, 0, 0, RPalette[7], bar);
    partBox(playRc, .05f, .4f, .05f, 0, (MeReal)-0.2, 0, RPalette[7], bar);
    for (int i = 0; i < WHEELS; i++)
        partWheel(playRc, (float)quadBike.data->wheelRadius, .22f, MdtBodyGetTransformPtr(quadBike.wheelBody[i]));
}

/* Each limb is a box; legs are one body, but look like two. */
static void CreateRiderGraphics(void) {
    static const float skin[4] = {.85f, .66f, .53f, 1};
    const float *const color[NUM_LIMBS] = {RPalette[0], RPalette[0], RPalette[4], RPalette[1],
                                           RPalette[4], skin,        RPalette[4], skin};
    for (int i = 0; i < NUM_LIMBS; i++) {
        MeMatrix4Ptr tm = MdtBodyGetTransformPtr(character.limbBody[i]);
        MeReal x, y, z;
        McdBoxGetDimensions(character.limbGeom[i], &x, &y, &z);
        if (i == LOWER_LEGS || i == UPPER_LEGS)
            for (int side = -1; side <= 1; side += 2)
                partBox(playRc, (float)x, (float)y, .14f, 0, 0, (MeReal)side * (z / 2 - (MeReal)0.07), color[i], tm);
        else
            partBox(playRc, (float)x, (float)y, (float)z, 0, 0, 0, color[i], tm);
    }
}

static void InitialiseMEWorld(void) {
    MdtWorldSetEpsilon(playUniverse->world,
                       (MeReal)0.0001); /* as the User Guide's program has it: its tyres give a little */
    MdtWorldSetGamma(playUniverse->world, playFrame * 10);
    MdtWorldSetGravity(playUniverse->world, 0, -20, 0);
}

static void createEverything(void) {
    InitialiseMEWorld();
    InitialiseMaterials();
    InitialiseTerrain();
    InitialiseVehicle(&quadBike);
    InitialiseRider(&character);
    keepStart();
    MeAppTerrainShow(terrain, playRc);
    CreateVehicleGraphics();
    CreateRiderGraphics();
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A quadbike, and a rider who leans into bends.",
        "$UP - throttle",
        "$DOWN - brake; standing: back",
        "$LEFT, $RIGHT - steer",
        "$ACTION2 - start again",
        "$ACTION3 - let it ride round its course, or stop that",
    };
    terrain = terrainCreate(24, (MeReal)1.8);
    if (!terrain || !playStart(argc, argv, "Quadbike", BODIES))
        return 1;
    createEverything();
    playHelp(help, 6);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, toggleAutomatic, 0);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
