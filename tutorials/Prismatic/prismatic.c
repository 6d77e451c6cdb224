/* Prismatic: a lift (Dynamics guide, chapter 3, "MdtPrismatic" and "Joint Limit").
 *
 * The cabin slides along an upright axis and cannot turn: a prismatic joint between it and the world. The joint's limit
 * measures how far it has slid, and has
 *   - a motor of limited force, which MdtLimitController drives to a place: fast from afar, slower near it;
 *   - an upper stop, which is hard;
 *   - a lower stop, which is a damped spring: the buffers in the pit.
 * The lift goes up and down by itself until the arrow keys call it. Try: call it beyond the top floor; load it until
 * the motor is too weak; switch the motor off and watch the buffers.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

#define FLOORS 3
#define RINGS  8 /* turns of a buffer's coil */

static const MeReal step = (MeReal)(1.0 / 60);               /* s */
static const MeReal size[3] = {2, (MeReal)2.3, 2};           /* m, the cabin */
static const MeReal emptyMass = 200;                         /* kg */
static const MeReal storey = (MeReal)2.8;                    /* m, from floor to floor */
static const MeReal pit = (MeReal)0.8;                       /* m, of the lowest floor above the ground */
static const MeReal stopAt[2] = {(MeReal)-0.2, (MeReal)5.9}; /* m, measured from the lowest floor */
static const MeReal speed = 2;                               /* m/s */
static const MeReal stiffness = 100000;                      /* N/m, of the buffers */
static const MeReal bufferDamping = 5000;                    /* N s/m */
static const MeReal wait = (MeReal)0.8;                      /* s, at a floor */

static MdtWorldID world;
static MdtBodyID cabin;
static MdtPrismaticID slider;
static MdtLimitID limit;

static MeReal force = 3000; /* N, the most that the motor gives */
static int hasMotor, isAutomatic;
static int isLoaded = 1;
static int goal, way; /* the floor to go to; -1 or 1: going down or up by itself */
static MeReal waited; /* s */

static RRender *rc;
static RGraphic *loadG;
static MeMatrix4 ringTM[2][RINGS], drumTM;
static RNativeLine *cable;

/* What is in the list of graphics is drawn. */
static void setLoad(int loaded) {
    if (loaded && !isLoaded)
        RGraphicAddToList(rc, loadG, 0);
    if (!loaded && isLoaded)
        RGraphicRemoveFromList(rc, loadG, 0);
    isLoaded = loaded;
    MdtBodySetMass(cabin, isLoaded ? emptyMass + 150 : emptyMass);
}

/* The cabin at the lowest floor, at rest. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodySetPosition(cabin, 0, pit + size[1] / 2, 0);
    MdtBodySetQuaternion(cabin, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(cabin, 0, 0, 0);
    MdtBodySetAngularVelocity(cabin, 0, 0, 0);
    MdtBodyEnable(cabin);
    MdtLimitResetState(limit); /* it measures anew where the cabin is */
    hasMotor = isAutomatic = way = 1;
    goal = 0;
    waited = 0;
    setLoad(0);
}

static void MEAPI toggleMotor(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    hasMotor = !hasMotor;
}

static void MEAPI toggleLoad(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    setLoad(!isLoaded);
}

/* One floor more than there is can be called at either end: it is the stop's turn then. */
static void call(int floor) {
    isAutomatic = 0;
    goal = MeCLAMP(floor, -1, FLOORS);
}

static void MEAPI up(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    call(goal + 1);
}

static void MEAPI down(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    call(goal - 1);
}

/* By itself it goes up floor by floor and down again, and waits at each. */
static void chooseGoal(void) {
    const MeReal toGo = (MeReal)goal * storey - MdtLimitGetPosition(limit);
    waited = MeFabs(toGo) < (MeReal)0.02 ? waited + step : 0;
    if (!isAutomatic || waited < wait)
        return;
    if (goal + way < 0 || goal + way >= FLOORS)
        way = -way;
    goal += way;
    waited = 0;
}

/* Before every step the controller says how fast the motor is to go: at full speed, and in proportion to the way that
 * is left within the last 0.8 m. */
static void driveMotor(void) {
    if (hasMotor)
        MdtLimitController(limit, (MeReal)goal * storey, (MeReal)0.8, speed, force);
    else
        MdtLimitActivateMotor(limit, 0);
}

static void showFigures(void) {
    char text[200], where[40] = "where it falls";
    MeVector3 f;
    MdtPrismaticGetForce(slider, 0, f);
    if (hasMotor && goal >= 0 && goal < FLOORS)
        snprintf(where, sizeof where, "to floor %d", goal);
    else if (hasMotor)
        snprintf(where, sizeof where, goal < 0 ? "below the lowest floor" : "above the top floor");
    snprintf(text, sizeof text,
             "height %.3f m    speed %+.2f m/s    goes %s    motor %s, at most %.0f N    mass %.0f kg, held by %.0f N",
             (double)MdtLimitGetPosition(limit), (double)MdtLimitGetVelocity(limit), where, hasMotor ? "on" : "off",
             (double)force, (double)MdtBodyGetMass(cabin), (double)f[1]);
    RRenderSetStatusText(rc, text);
}

/* The cable, its drum, and the buffers, which are as high as the cabin lets them. */
static void drawMachinery(void) {
    const MeReal bottom = MdtBodyGetTransformPtr(cabin)[3][1] - size[1] / 2, drumRadius = (MeReal)0.45;
    const MeReal free = pit + stopAt[0], top = MeMIN(bottom, free);
    const AcmeReal from[3] = {0, (AcmeReal)(bottom + size[1]), 0}, to[3] = {0, 9.8f, 0};
    MeMatrix3 R;
    RNLineMoveEnds(cable, from, to);
    MeMatrix3MakeRotationZ(R, -bottom / drumRadius);
    MeMatrix4TMMakeFromRotationAndPosition(drumTM, R, -drumRadius, (MeReal)9.8, 0);
    MeMatrix3MakeRotationX(R, ME_PI / 2);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < RINGS; k++)
            MeMatrix4TMMakeFromRotationAndPosition(ringTM[i][k], R, i == 0 ? (MeReal)-0.6 : (MeReal)0.6,
                                                   top * ((MeReal)k + (MeReal)0.5) / RINGS, 0);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    chooseGoal();
    driveMotor();
    MdtWorldStep(world, step);
    drawMachinery();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RGraphicDestroy(loadG); /* ours, while it is in no list */
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createStops(void) {
    MdtSingleLimitID lower = MdtLimitGetLowerLimit(limit), upper = MdtLimitGetUpperLimit(limit);
    MdtSingleLimitSetStop(lower, stopAt[0]);
    MdtSingleLimitSetStiffness(lower, stiffness); /* at most the limit's stiffness threshold: soft */
    MdtSingleLimitSetDamping(lower, bufferDamping);
    MdtSingleLimitSetStop(upper, stopAt[1]);
    MdtSingleLimitSetRestitution(upper, (MeReal)0.2); /* its stiffness is infinite at first: hard */
    MdtLimitActivateLimits(limit, 1);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(1, 1, 2, 200); /* typical sizes: 2 m, 200 kg */
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* the motor is told something new before every step */
    cabin = MdtBodyCreate(world);
    MdtBodySetMass(cabin, emptyMass);
    MdtMakeInertiaTensorBox(emptyMass, size[0], size[1], size[2], inertia);
    MdtBodySetInertiaTensor(cabin, inertia);
    MdtBodySetPosition(cabin, 0, pit + size[1] / 2, 0); /* here its way is zero: the place when the axis is set */

    slider = MdtPrismaticCreate(world);
    MdtPrismaticSetBodies(slider, cabin, 0);
    MdtPrismaticSetAxis(slider, 0, 1, 0);
    limit = MdtPrismaticGetLimit(slider);
    createStops();
    MdtPrismaticEnable(slider);
}

/* A box at some place in the frame of a transform; without one, in the world. */
static RGraphic *boxAt(float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float *color,
                       MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphic *g = RGraphicBoxCreate(rc, lx, ly, lz, color, tm);
    RGraphicTranslateVertices(rc, g, offset);
    return g;
}

static void createCabin(void) {
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(cabin);
    const float *blue = RPalette[0], *sky = RPalette[5];
    const float w = (float)size[0], h = (float)size[1], post = (w - .1f) / 2;
    boxAt(w, .12f, w, 0, -size[1] / 2 + (MeReal)0.06, 0, blue, tm);
    boxAt(w, .12f, w, 0, size[1] / 2 - (MeReal)0.06, 0, blue, tm);
    for (int i = 0; i < 4; i++)
        boxAt(.1f, h, .1f, i < 2 ? post : -post, 0, i % 2 ? post : -post, blue, tm);
    boxAt(w - .2f, h - .2f, .06f, 0, 0, (MeReal)(-w / 2 + .05f), sky, tm);
    loadG = boxAt(1.1f, 1.1f, 1.1f, 0, (MeReal)(-h / 2 + .67f), 0, RPalette[1], tm);
}

/* Rails, floors, the beam that carries the drum. */
static void createBuilding(void) {
    const float grey[4] = {.45f, .47f, .50f, 1}, pale[4] = {.80f, .78f, .72f, 1};
    for (int i = 0; i < FLOORS; i++) {
        boxAt(3.6f, .25f, 3.2f, -3, pit + (MeReal)i * storey - (MeReal)0.125, 0, pale, 0);
        for (int k = -1; k <= 1; k += 2) {
            const MeReal below = i == 0 ? 0 : pit + (MeReal)(i - 1) * storey, at = pit + (MeReal)i * storey;
            boxAt(.2f, (float)(at - below) - .25f, .2f, (MeReal)-4.5, (at + below) / 2 - (MeReal)0.125,
                  (MeReal)k * (MeReal)1.3, pale, 0);
        }
    }
    for (int k = -1; k <= 1; k += 2)
        boxAt(.14f, 9.8f, .14f, (MeReal)k * (MeReal)1.12, (MeReal)4.9, (MeReal)-0.6, grey, 0);
    boxAt(2.5f, .2f, .2f, 0, (MeReal)9.8, (MeReal)-0.6, grey, 0);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.35f, .37f, .40f, 1}, zero[3] = {0, 0, 0};
    const AcmeVector3 lookAt = {-1.2f, 4.8f, 0};
    createCabin();
    createBuilding();
    for (int i = 0; i < 2 * RINGS; i++)
        RGraphicTorusCreate(rc, .18f, .28f, RPalette[3], ringTM[i / RINGS][i % RINGS]);
    RGraphicCylinderCreate(rc, .45f, .8f, RPalette[2], drumTM);
    boxAt(.7f, .08f, .82f, 0, 0, 0, RPalette[4], drumTM); /* a mark, so that one sees it turn */
    cable = RNLineCreate(rc, zero, zero, grey, 0);
    RGraphicGroundPlaneCreate(rc, 80, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 17.5f, .45f, .1f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A lift on a prismatic joint with motor and stops.",
        "$ACTION2 - start again",
        "$ACTION3 - motor on or off",
        "$ACTION4 - 150 kg in or out",
        "$UP, $DOWN - call it a floor higher or lower",
    };
    static const RParameter parameters[] = {
        {"the motor's force", "N", &force, 0, 8000, 250, .less = "Left", .more = "Right"},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Prismatic");
    RRenderSetAppName(rc, "Prismatic");
    RRenderCreateUserHelp(rc, help, 5);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleMotor, 0);
    RRenderSetActionNCallBack(rc, 4, toggleLoad, 0);
    RRenderSetUpCallBack(rc, up, 0);
    RRenderSetDownCallBack(rc, down, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
    rc = RRenderContextCreate(options, 0, 1);
    RRenderRefuseOptions(rc, options);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    createDynamics();
    createGraphics();
    createControls();
    Reset(rc, 0);

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
