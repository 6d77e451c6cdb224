/* RPRO: a robot arm plays an animation, as well as its strength allows (Dynamics guide, chapter 3, "MdtRPROJoint").
 *
 * An RPRO joint holds one body at a place of another and turned against it as the program says: relative position,
 * relative orientation. Before every step the program gives the quaternion that the animation has now, and the angular
 * velocity with which it moves on. The joint finds the torques; what they may be at most is its strength. As long as
 * that is enough the arm is exactly where the animation wants it. When it is not, the joint gives way, and comes back
 * when it can: a cheap way to let a figure play a movement and be pushed about all the same.
 *
 * The pale arm is what the animation wants. By itself a weight comes and goes every five seconds, too heavy for the
 * shoulder when the arm is stretched out, until you press a key. Try: key 3 hangs it on the hand or takes it off; Up
 * makes the joints stronger; key 4 strikes the hand.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { UPPER, FORE, PARTS, NONE = -1 }; /* the arm's two parts, and the joints at their near ends: shoulder and elbow */

static const MeReal step = (MeReal)(1.0 / 60);                  /* s */
static const MeReal length[PARTS] = {(MeReal)1.4, (MeReal)1.2}; /* m */
static const MeReal mass[PARTS] = {4, 3};                       /* kg */
static const MeReal loadMass = 6, cord = (MeReal)0.4;           /* kg; m, from the hand to the weight's middle */
static const MeReal height = (MeReal)3.2;                       /* m, of the shoulder above the ground */
static const MeReal share[PARTS] = {1, (MeReal)0.6};            /* of the strength */

static MdtWorldID world;
static MdtBodyID part[PARTS], load;
static MdtRPROJointID joint[PARTS];
static MdtBSJointID hook;

static MeReal strength = 200; /* N m, of the shoulder */
static MeReal animationTime;  /* s */
static int isMoving;
static int shown;               /* frames, while the weight comes and goes by itself; NONE: a key was pressed */
static MeVector4 wanted[PARTS]; /* the quaternions for the joints */

static RRender *rc;
static MeMatrix4 ghostTM[PARTS];
static RNativeLine *cordLine;

/* The animation, as angles: the shoulder turns about the upright axis and lifts, the elbow bends. */
static void animationAt(MeReal t, MeReal *turn, MeReal *lift, MeReal *bend) {
    *turn = (MeReal)0.8 * MeSin((MeReal)0.9 * t);
    *lift = (MeReal)0.6 + (MeReal)0.35 * MeSin((MeReal)1.8 * t);
    *bend = -1 + (MeReal)0.45 * MeSin((MeReal)2.7 * t);
}

static void wantedAt(MeReal t, MeVector4 q[PARTS]) {
    const MeVector3 y = {0, 1, 0}, z = {0, 0, 1};
    MeVector4 about, up;
    MeReal turn, lift, bend;
    animationAt(t, &turn, &lift, &bend);
    MeQuaternionMake(about, y, turn);
    MeQuaternionMake(up, z, lift);
    MeQuaternionProduct(q[UPPER], about, up);
    MeQuaternionMake(q[FORE], z, bend);
}

/* Where the animation has the arm: the transforms of its parts. */
static void poseOf(MeVector4 q[PARTS], MeMatrix4 tm[PARTS]) {
    MeVector4 fore;
    MeVector3 end = {0, height, 0}, along;
    for (int i = 0; i < PARTS; i++) {
        if (i == UPPER)
            MeQuaternionToTM(tm[i], q[UPPER]);
        else {
            MeQuaternionProduct(fore, q[UPPER], q[FORE]);
            MeQuaternionToTM(tm[i], fore);
        }
        MeVector3Copy(along, tm[i][0]);
        MeVector3Scale(along, length[i] / 2);
        MeVector3Add(end, end, along);
        MeMatrix4TMSetPositionVector(tm[i], end);
        MeVector3Add(end, end, along);
    }
}

/* The angular velocity that takes one quaternion to another in one step, in the axes in which they are given. */
static void velocityBetween(const MeVector4 from, const MeVector4 to, MeVector3 w) {
    const MeVector4 back = {from[0], -from[1], -from[2], -from[3]};
    MeVector4 way;
    MeQuaternionProduct(way, to, back);
    const MeReal sine = MeSqrt(way[1] * way[1] + way[2] * way[2] + way[3] * way[3]);
    const MeReal angle = 2 * MeAtan2(sine, way[0]), scale = sine > 0 ? angle / sine / step : 0;
    MeVector3Set(w, way[1] * scale, way[2] * scale, way[3] * scale);
}

/* Before every step: where the joints should be now, and how they go on. */
static void animate(void) {
    MeVector4 next[PARTS];
    const MeReal then = animationTime + (isMoving ? step : 0);
    wantedAt(animationTime, wanted);
    wantedAt(then, next);
    for (int i = 0; i < PARTS; i++) {
        MeVector3 w;
        velocityBetween(wanted[i], next[i], w);
        MdtRPROJointSetRelativeQuaternion(joint[i], wanted[i]);
        MdtRPROJointSetRelativeAngularVelocity(joint[i], w);
    }
    animationTime = then;
    wantedAt(then, wanted);
    poseOf(wanted, ghostTM);
}

static void MEAPI applyStrength(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < PARTS; i++) {
        const MeReal s = strength * share[i];
        MdtRPROJointSetAngularStrength(joint[i], s, s, s);
    }
}

/* The place of the hand, and where the weight hangs. */
static void handAt(MeVector3 p) {
    const MeVector3 end = {length[FORE] / 2, 0, 0};
    MeMatrix4TMTransform(p, MdtBodyGetTransformPtr(part[FORE]), end);
}

static void takeOffLoad(void) {
    MdtBSJointDisable(hook);
    MdtBodyDisable(load);
    MdtBodySetPosition(load, (MeReal)1.2, (MeReal)0.2,
                       (MeReal)1.6); /* which would wake it, had it come to rest by itself */
    MdtBodyDisable(load);
}

static void hangUpLoad(void) {
    MeVector3 p, v;
    handAt(p);
    MdtBodyGetVelocityAtPoint(part[FORE], p, v);
    MdtBodySetPosition(load, p[0], p[1] - cord, p[2]);
    MdtBodySetQuaternion(load, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(load, v[0], v[1], v[2]);
    MdtBodySetAngularVelocity(load, 0, 0, 0);
    MdtBodyEnable(load);
    MdtBSJointSetBodies(hook, load, part[FORE]);
    MdtBSJointSetPosition(hook, p[0], p[1], p[2]);
    MdtBSJointEnable(hook);
}

static void changeLoad(void) {
    if (MdtBSJointIsEnabled(hook))
        takeOffLoad();
    else
        hangUpLoad();
}

static void changeLoadByItself(void) {
    enum { FIRST = 75, EACH = 300 };
    if (shown != NONE && ++shown % EACH == FIRST)
        changeLoad();
}

static void MEAPI toggleLoad(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    changeLoad();
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    animationTime = 0;
    isMoving = 1;
    takeOffLoad();
    wantedAt(0, wanted);
    poseOf(wanted, ghostTM);
    for (int i = 0; i < PARTS; i++) {
        MdtBodySetTransform(part[i], ghostTM[i]);
        MdtBodySetLinearVelocity(part[i], 0, 0, 0);
        MdtBodySetAngularVelocity(part[i], 0, 0, 0);
        MdtBodyEnable(part[i]);
    }
}

static void MEAPI strike(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MeVector3 p;
    shown = NONE;
    handAt(p);
    MdtBodyAddImpulseAtPosition(part[FORE], 0, -15, -15, p[0], p[1], p[2]);
}

static void MEAPI toggleAnimation(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    shown = NONE;
    isMoving = !isMoving;
}

/* How far a joint is from what is wanted, rad. */
static MeReal errorOf(int i) {
    MeVector4 q[PARTS], relative;
    MdtBodyGetQuaternion(part[UPPER], q[UPPER]);
    MdtBodyGetQuaternion(part[FORE], q[FORE]);
    const MeVector4 back = {q[UPPER][0], -q[UPPER][1], -q[UPPER][2], -q[UPPER][3]};
    if (i == FORE)
        MeQuaternionProduct(relative, back, q[FORE]);
    const MeReal *is = i == FORE ? relative : q[UPPER];
    const MeVector4 inverse = {wanted[i][0], -wanted[i][1], -wanted[i][2], -wanted[i][3]};
    MeVector4 way;
    MeQuaternionProduct(way, is, inverse);
    return 2 * MeAtan2(MeSqrt(way[1] * way[1] + way[2] * way[2] + way[3] * way[3]), MeFabs(way[0]));
}

/* The torque of the joint itself. What is read is about the part's centre of mass, and contains that of the joint's
 * force, which acts at the near end. */
static MeReal torqueOf(int i) {
    const MeVector3 nearEnd = {-length[i] / 2, 0, 0};
    MeVector3 f, t, lever, ofForce;
    MdtRPROJointGetForce(joint[i], 0, f);
    MdtRPROJointGetTorque(joint[i], 0, t);
    MeMatrix4TMRotate(lever, MdtBodyGetTransformPtr(part[i]), nearEnd);
    MeVector3Cross(ofForce, lever, f);
    MeVector3Subtract(t, t, ofForce);
    return MeVector3Magnitude(t);
}

static void showFigures(void) {
    static const char *const name[PARTS] = {"shoulder", "elbow"};
    char text[200];
    int n = 0;
    for (int i = 0; i < PARTS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%s off by %.2f deg, torque %.1f of %.0f N m    ", name[i],
                      (double)errorOf(i) * 180 / (double)ME_PI, (double)torqueOf(i), (double)(strength * share[i]));
    snprintf(text + n, sizeof text - (size_t)n, "carries %.0f kg", MdtBSJointIsEnabled(hook) ? (double)loadMass : 0.0);
    RRenderSetStatusText(rc, text);
}

static void drawCord(void) {
    const MeReal *at = MdtBodyGetTransformPtr(load)[3], *up = MdtBodyGetTransformPtr(load)[1];
    const MeReal reach = MdtBSJointIsEnabled(hook) ? cord : (MeReal)0.3;
    const AcmeReal from[3] = {(AcmeReal)at[0], (AcmeReal)at[1], (AcmeReal)at[2]};
    const AcmeReal to[3] = {(AcmeReal)(at[0] + reach * up[0]), (AcmeReal)(at[1] + reach * up[1]),
                            (AcmeReal)(at[2] + reach * up[2])};
    RNLineMoveEnds(cordLine, from, to);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    changeLoadByItself();
    animate();
    MdtWorldStep(world, step);
    drawCord();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(PARTS + 1, PARTS + 1);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* the animation goes on */
    for (int i = 0; i < PARTS; i++) {
        part[i] = MdtBodyCreate(world);
        MdtBodySetMass(part[i], mass[i]);
        MdtMakeInertiaTensorBox(mass[i], length[i], (MeReal)0.25, (MeReal)0.25, inertia);
        MdtBodySetInertiaTensor(part[i], inertia);
        joint[i] = MdtRPROJointCreate(world);
        /* The near end of this part, at the far end of the one before, or at a place of the world. */
        MdtRPROJointSetBodies(joint[i], part[i], i == UPPER ? 0 : part[UPPER]);
        MdtRPROJointSetAttachmentPosition(joint[i], -length[i] / 2, 0, 0, 0);
    }
    MdtRPROJointSetAttachmentPosition(joint[UPPER], 0, height, 0, 1);
    MdtRPROJointSetAttachmentPosition(joint[FORE], length[UPPER] / 2, 0, 0, 1);
    for (int i = 0; i < PARTS; i++)
        MdtRPROJointEnable(joint[i]);
    applyStrength(0, 0);

    load = MdtBodyCreate(world);
    MdtBodySetMass(load, loadMass);
    MdtMakeInertiaTensorSphere(loadMass, (MeReal)0.2, inertia);
    MdtBodySetInertiaTensor(load, inertia);
    MdtBodySetAngularVelocityDamping(load, 1);
    hook = MdtBSJointCreate(world);
}

static void boxAt(float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float *color, MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphicTranslateVertices(rc, RGraphicBoxCreate(rc, lx, ly, lz, color, tm), offset);
}

/* A part with its joint, which is drawn as a cylinder along z at the near end, and, of the forearm, a hand. */
static void createPartGraphics(int i, const float *color, const float *jointColor, MeMatrix4Ptr tm) {
    const MeVector3 nearEnd = {-length[i] / 2, 0, 0};
    const float thick = i == UPPER ? .24f : .18f;
    boxAt((float)length[i], thick, thick, 0, 0, 0, color, tm);
    RGraphicTranslateVertices(rc, RGraphicCylinderCreate(rc, thick * .85f, thick * 1.4f, jointColor, tm), nearEnd);
    if (i == FORE)
        for (int k = -1; k <= 1; k += 2)
            boxAt(.22f, .05f, .16f, length[i] / 2 + (MeReal)0.08, (MeReal)k * (MeReal)0.07, 0, jointColor, tm);
}

static void createStand(void) {
    static MeMatrix4 columnTM, footTM;
    const float grey[4] = {.45f, .47f, .50f, 1};
    MeMatrix4TMFromEulerAnglesAndPosition(columnTM, -ME_PI / 2, 0, 0, 0, 0, 0);
    RGraphicFrustumCreate(rc, .3f, .16f, 0, (float)height - .2f, 48, grey, columnTM);
    MeMatrix4TMFromEulerAnglesAndPosition(footTM, -ME_PI / 2, 0, 0, 0, (MeReal)0.05, 0);
    RGraphicCylinderCreate(rc, .6f, .1f, grey, footTM);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, dark[4] = {.30f, .31f, .33f, 1}, zero[3] = {0, 0, 0};
    const float ghost[4] = {RPalette[5][0], RPalette[5][1], RPalette[5][2], .3f};
    const AcmeVector3 lookAt = {.7f, 2.3f, 0};
    createStand();
    for (int i = 0; i < PARTS; i++)
        createPartGraphics(i, RPalette[i == UPPER ? 0 : 2], RPalette[4], MdtBodyGetTransformPtr(part[i]));
    for (int i = 0; i < PARTS; i++)
        createPartGraphics(i, ghost, ghost, ghostTM[i]);
    RGraphicSphereCreate(rc, .2f, RPalette[3], MdtBodyGetTransformPtr(load));
    cordLine = RNLineCreate(rc, zero, zero, dark, 0);
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 9, .3f, .17f);
}

static void createControls(void) {
    static const char *const help[] = {
        "A robot arm plays an animation, as well as it can.",
        "$ACTION2 - start again",
        "$ACTION3 - hang up or take off a weight",
        "$ACTION4 - strike the hand",
        "$ACTION5 - the animation stops or goes on",
    };
    static const RParameter parameters[] = {
        {"strength", "N m", &strength, 25, 500, 25, .less = "Down", .more = "Up", .changed = applyStrength},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: RPRO");
    RRenderSetAppName(rc, "RPRO");
    RRenderCreateUserHelp(rc, help, 5);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, toggleLoad, 0);
    RRenderSetActionNCallBack(rc, 4, strike, 0);
    RRenderSetActionNCallBack(rc, 5, toggleAnimation, 0);
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
    shown = 0;

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
