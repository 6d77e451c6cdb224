/* Tumbler: boxes in a turning drum (User Guide, chapter 5; Dynamics guide, chapter 3, "MdtHinge" and "Joint Limit").
 *
 * The drum is a body: an aggregate of boards, ends and four paddles, on a hinge with the world, turned by the hinge's
 * motor. The motor has a limited torque: with too little, the drum stands still and the heap with it. The boxes are
 * lifted on the rising side and fall down again, all in one heap that never comes to rest, with friction at every
 * contact: the hardest thing for a solver. From 1.8 rad/s on (the square root of g over the radius) they stay at the
 * wall.
 *
 * Watch the status line: the drum's speed against the wanted one, the torque that the heap asks of the motor, and that
 * no box gets out.
 */
#include "RGeometry.h"
#include "RParameter.h"
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { BOARDS = 12, ENDS = 2, PADDLES = 4, PARTS = BOARDS + PADDLES + ENDS, BOXES = 64, LAYER = 16 };

static const MeReal radius = 3, depth = 3, thick = (MeReal)0.2; /* m, of the drum: inside, along its axis; of boards */
static const MeReal paddle = (MeReal)0.6;                       /* m, inwards */
static const MeReal height = (MeReal)3.8;                       /* m, of the axis */
static const MeReal strength = 40000;                           /* N m, of the motor */
static const MeReal side = (MeReal)0.45;                        /* m, of boxes */

static McdModelID drum, box[BOXES];
static McdAggregateID whole, opaque, glass; /* the drum, and two parts of it for the eye */
static MeMatrix4 part[PARTS];               /* of the drum, kept by pointer */
static MdtHingeID axle;
static MeReal speed = (MeReal)0.8; /* rad/s, wanted */

/* ---- the drum ---------------------------------------------------------------------------------------------------- */

static void addPart(McdAggregateID shown, McdGeometryID g, int i) {
    McdAggregateAddElement(whole, g, part[i]);
    McdAggregateAddElement(shown, g, part[i]);
}

/* Turned about the axis, which is z, and so far from it. */
static void placePart(int i, MeReal angle, MeReal away) {
    MeMatrix3 R;
    MeMatrix3MakeRotationZ(R, angle);
    MeMatrix4TMMakeFromRotationAndPosition(part[i], R, away * MeCos(angle), away * MeSin(angle), 0);
}

/* The boards' inner sides touch the circle, and their edges overlap. */
static void addBoards(void) {
    const MeReal width = 2 * (radius + thick) * (MeReal)tan((double)ME_PI / BOARDS);
    const McdGeometryID board = McdBoxCreate(playUniverse->frame, thick, width, depth),
                        blade = McdBoxCreate(playUniverse->frame, paddle, thick, depth);
    for (int i = 0; i < BOARDS; i++) {
        placePart(i, 2 * ME_PI * (MeReal)i / BOARDS, radius + thick / 2);
        addPart(opaque, board, i);
    }
    for (int i = BOARDS; i < BOARDS + PADDLES; i++) {
        placePart(i, 2 * ME_PI * (MeReal)i / PADDLES, radius - paddle / 2);
        addPart(opaque, blade, i);
    }
}

/* The one towards the viewer is of glass. */
static void addEnds(void) {
    const McdGeometryID end = McdCylinderCreate(playUniverse->frame, radius + thick, thick);
    for (int i = PARTS - ENDS; i < PARTS; i++) {
        const MeBool isFront = i == PARTS - 1;
        MeMatrix4TMMakeIdentity(part[i]);
        MeMatrix4TMSetPosition(part[i], 0, 0, (isFront ? 1 : -1) * (depth + thick) / 2);
        addPart(isFront ? glass : opaque, end, i);
    }
}

static void createMotor(void) {
    axle = MdtHingeCreate(playUniverse->world);
    MdtHingeSetBodies(axle, McdModelGetBody(drum), 0);
    MdtHingeSetPosition(axle, 0, height, 0);
    MdtHingeSetAxis(axle, 0, 0, 1);
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(axle), speed, strength);
    MdtHingeEnable(axle);
}

static void createDrum(void) {
    static const float clear[4] = {.65f, .80f, .90f, .07f}, wood[4] = {.66f, .49f, .32f, 1};
    whole = McdAggregateCreate(playUniverse->frame, PARTS);
    opaque = McdAggregateCreate(playUniverse->frame, PARTS);
    glass = McdAggregateCreate(playUniverse->frame, 1);
    addBoards();
    addEnds();
    drum = MstModelAndBodyCreate(playUniverse, whole, 100);
    McdModelDynamicsSetPosition(drum, 0, height, 0);
    RGraphicAggregateCreate(playRc, opaque, wood, McdModelGetTransformPtr(drum));
    RGraphicAggregateCreate(playRc, glass, clear, McdModelGetTransformPtr(drum));
    createMotor();
}

/* Behind the drum, for the eye: it holds the axle. */
static void createPost(void) {
    static MeMatrix4 tm;
    static const float steel[4] = {.45f, .48f, .54f, 1};
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetPosition(tm, 0, height / 2, -depth / 2 - thick - (MeReal)0.3);
    RGraphicBoxCreate(playRc, .6f, (float)height + .6f, .5f, steel, tm);
}

/* ---- boxes ------------------------------------------------------------------------------------------------------- */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    playPlace(drum, 0, height, 0, 0, 0);
    for (int i = 0; i < BOXES; i++) {
        const int inLayer = i % LAYER;
        const MeReal x = (MeReal)(inLayer % 4) - (MeReal)1.5, z = (MeReal)(inLayer / 4) - (MeReal)1.5;
        playPlace(box[i], (MeReal)0.7 * x, height - (MeReal)1.5 + (MeReal)(0.6 * (i / LAYER)), (MeReal)0.65 * z, i % 3,
                  (MeReal)(0.3 * (i % 5)));
    }
}

/* Smooth wood. */
static void createBoxes(void) {
    MdtContactParamsSetFrictionCoeffecient(playContact(0, 0), (MeReal)0.3);
    const McdGeometryID g = McdBoxCreate(playUniverse->frame, side, side, side);
    for (int i = 0; i < BOXES; i++)
        box[i] = playModel(g, 300, 0, 0, 0, RPalette[i % 6]);
}

static int countInside(void) {
    int inside = 0;
    for (int i = 0; i < BOXES; i++) {
        const MeReal *p = McdModelGetTransformPtr(box[i])[3], y = p[1] - height;
        inside += p[0] * p[0] + y * y < (radius + thick) * (radius + thick) && MeFabs(p[2]) < depth / 2;
    }
    return inside;
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

/* The drum and what is in it may be asleep. */
static void MEAPI applySpeed(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtLimitSetLimitedForceMotor(MdtHingeGetLimit(axle), speed, strength);
    McdModelDynamicsEnable(drum);
}

static void MEAPI stopOrGo(RRender *context, void *userdata) {
    speed = speed != 0 ? 0 : (MeReal)0.8;
    applySpeed(context, userdata);
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    MeVector3 w, torque;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    McdModelDynamicsGetAngularVelocity(drum, w);
    MdtHingeGetTorque(axle, 0, torque);
    snprintf(text, sizeof text,
             "drum %.3f of %.2f rad/s    torque %.2f kN m    boxes inside %d of %d    awake %d    motion %.1f J",
             (double)w[2], (double)speed, (double)torque[2] / 1000, countInside(), BOXES, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A drum that turns, and sixty-four boxes in it.",
        "$ACTION2 - once more",
        "$ACTION3 - stop, or go",
    };
    static const RParameter parameters[] = {
        {"speed of the drum", "rad/s", &speed, (MeReal)-2.5, (MeReal)2.5, (MeReal)0.02, .less = "Down", .more = "Up",
         .changed = applySpeed},
    };
    if (!playStart(argc, argv, "Tumbler", BOXES + 1))
        return 1;
    /* A heap that never rests: nobody sees what the exact solver would do better, at thirty times the cost. */
    MdtWorldSetSolver(playUniverse->world, MdtSolverFast);
    playFloor();
    createPost();
    createDrum();
    createBoxes();
    playHelp(help, 3);
    RRenderCreateParameters(playRc, parameters, 1);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, stopOrGo, 0);
    playCamera(0, (float)height, 0, 14, .35f, .1f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
