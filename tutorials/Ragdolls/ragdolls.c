/* Ragdolls: eight figures of joints and limits fall down a staircase (User Guide, chapter 5; Dynamics guide, chapter
 * 3).
 *
 * Eleven parts and ten joints each. Elbows and knees are hinges with stops, so that they bend one way only. Waist,
 * neck, shoulders and hips are ball-and-socket joints, each with a cone limit beside it: the axis of the limb stays in
 * a cone about an axis of the part that it hangs on. Parts that are joined overlap, and McdSpaceDisablePair keeps them
 * from colliding; all other parts collide, and so do the figures with each other.
 *
 * Watch the status line: how far the worst joint has opened since the start, and by how much the worst stop or cone has
 * been passed, since the start and now: a blow may push a limb beyond within a step, and the limit takes it back. In
 * the end all lie still, and cost nothing.
 */
#include "play.h"
#include <stdio.h>

enum { DOLLS = 8, STEPS = 7 };
enum { PELVIS, CHEST, HEAD, ARMS, FOREARMS = ARMS + 2, THIGHS = FOREARMS + 2, SHINS = THIGHS + 2, PARTS = SHINS + 2 };

/* A part: a box or a ball if its size says so, else a sphyl that hangs down; its middle as the figure stands. */
typedef struct {
    MeReal x, y;    /* m */
    MeReal size[3]; /* m: of a box; or a radius, a height (0: a ball), and 0 */
    int above;      /* the part that it is joined to */
    MeReal jointX, jointY;
    MeReal cone; /* rad: half angle; 0: a hinge */
    MeReal bend; /* a hinge's: rad, the most; negative: forward */
} Part;

#define R(x) ((MeReal)(x))
static const Part part[PARTS] = {
    {0, R(1.02), {R(.34), R(.24), R(.22)}, -1, 0, 0, 0, 0},
    {0, R(1.38), {R(.42), R(.40), R(.24)}, PELVIS, 0, R(1.16), R(.6), 0},
    {0, R(1.78), {R(.15), 0, 0}, CHEST, 0, R(1.60), R(.6), 0},
    {R(-.30), R(1.36), {R(.07), R(.24), 0}, CHEST, R(-.27), R(1.52), R(1.4), 0},
    {R(.30), R(1.36), {R(.07), R(.24), 0}, CHEST, R(.27), R(1.52), R(1.4), 0},
    {R(-.30), R(1.02), {R(.06), R(.24), 0}, ARMS, R(-.30), R(1.19), 0, R(-2.2)},
    {R(.30), R(1.02), {R(.06), R(.24), 0}, ARMS + 1, R(.30), R(1.19), 0, R(-2.2)},
    {R(-.11), R(.71), {R(.09), R(.32), 0}, PELVIS, R(-.11), R(.92), R(1.0), 0},
    {R(.11), R(.71), {R(.09), R(.32), 0}, PELVIS, R(.11), R(.92), R(1.0), 0},
    {R(-.11), R(.26), {R(.07), R(.34), 0}, THIGHS, R(-.11), R(.49), 0, R(2.2)},
    {R(.11), R(.26), {R(.07), R(.34), 0}, THIGHS + 1, R(.11), R(.49), 0, R(2.2)},
};

static const MeReal rise = R(0.45), tread = R(0.65), width = 8, landing = 4; /* m, of the stairs */

static McdModelID body[DOLLS][PARTS];
static MdtConstraintID joint[DOLLS][PARTS]; /* of a part to the one above */
static MdtHingeID hinge[DOLLS][PARTS];      /* the same, of elbows and knees; else null */
static MdtConeLimitID cone[DOLLS][PARTS];   /* of all others */
static MeReal widest, furthest, beyond;     /* m, of a joint; rad beyond a stop or a cone, so far and now */

static MeBool isSphyl(int i) {
    return !(part[i].size[2] > 0) && part[i].size[1] > 0;
}

/* ---- where they start ------------------------------------------------------------------------------------------- */

/* Two rows of four on the landing, the second one in the air behind the first; all look down the stairs, along z. */
static void startOf(int doll, MeVector3 feet) {
    const MeReal row = (MeReal)(doll / 4), column = (MeReal)(doll % 4);
    MeVector3Set(feet, R(1.5) * (column - R(1.5)) + R(0.4) * row, rise * STEPS + R(0.05) + R(1.2) * row,
                 R(-0.5) - R(0.15) * column - R(1.2) * row);
}

/* Pushed, the head more than the feet. */
static void placeDoll(int doll) {
    MeVector3 feet;
    startOf(doll, feet);
    for (int i = 0; i < PARTS; i++) {
        playPlace(body[doll][i], feet[0] + part[i].x, feet[1] + part[i].y, feet[2], 0, isSphyl(i) ? -ME_PI / 2 : 0);
        McdModelDynamicsSetLinearVelocity(body[doll][i], 0, 0, R(1.5) + part[i].y + R(0.2) * (MeReal)(doll % 3));
        if (hinge[doll][i])
            MdtLimitResetState(MdtHingeGetLimit(hinge[doll][i]));
    }
}

/* ---- making them ------------------------------------------------------------------------------------------------ */

static McdGeometryID createShape(int i) {
    const McdFrameworkID frame = playUniverse->frame;
    const MeReal *size = part[i].size;
    if (size[2] > 0)
        return McdBoxCreate(frame, size[0], size[1], size[2]);
    return isSphyl(i) ? McdSphylCreate(frame, size[0], size[1]) : McdSphereCreate(frame, size[0]);
}

/* The cone of a waist or a neck stands upright; those of limbs hang, forward, and an arm's sideways too. */
static MdtConeLimitID createCone(int i, MdtBodyID below, MdtBodyID above) {
    const MdtConeLimitID limit = MdtConeLimitCreate(playUniverse->world);
    const MeReal sideways = i >= THIGHS ? 0 : part[i].x > 0 ? R(0.6) : R(-0.6);
    MdtConeLimitSetBodies(limit, below, above);
    MdtConeLimitSetAxes(limit, 0, 1, 0, 1, 0, 0);
    if (i >= ARMS) {
        MdtConeLimitBodySetAxes(limit, 0, 0, -1, 0, 1, 0, 0);
        MdtConeLimitBodySetAxes(limit, 1, sideways, -1, R(0.6), 1, 0, 0);
    }
    MdtConeLimitSetConeHalfAngle(limit, part[i].cone);
    MdtConeLimitEnable(limit);
    return limit;
}

static MdtConstraintID createSocket(MdtBodyID below, MdtBodyID above, const MeReal at[3]) {
    const MdtBSJointID socket = MdtBSJointCreate(playUniverse->world);
    MdtBSJointSetBodies(socket, below, above);
    MdtBSJointSetPosition(socket, at[0], at[1], at[2]);
    MdtBSJointEnable(socket);
    return MdtBSJointQuaConstraint(socket);
}

static void setStop(MdtSingleLimitID stop, MeReal angle) {
    MdtSingleLimitSetStop(stop, angle);
    MdtSingleLimitSetRestitution(stop, 0);
}

/* Across the limb, with stops at straight and at the most that it bends. */
static MdtHingeID createHinge(int i, MdtBodyID below, MdtBodyID above, const MeReal at[3]) {
    const MdtHingeID h = MdtHingeCreate(playUniverse->world);
    const MdtLimitID limit = MdtHingeGetLimit(h);
    MdtHingeSetBodies(h, below, above);
    MdtHingeSetPosition(h, at[0], at[1], at[2]);
    MdtHingeSetAxis(h, 1, 0, 0);
    setStop(MdtLimitGetLowerLimit(limit), MeMIN(part[i].bend, 0));
    setStop(MdtLimitGetUpperLimit(limit), MeMAX(part[i].bend, 0));
    MdtLimitActivateLimits(limit, METRUE);
    MdtHingeEnable(h);
    return h;
}

static void joinPart(int doll, int i) {
    const McdModelID m = body[doll][i], above = body[doll][part[i].above];
    const MdtBodyID b1 = McdModelGetBody(m), b2 = McdModelGetBody(above);
    MeVector3 feet;
    startOf(doll, feet);
    const MeReal at[3] = {feet[0] + part[i].jointX, feet[1] + part[i].jointY, feet[2]};
    if (part[i].cone > 0) {
        joint[doll][i] = createSocket(b1, b2, at);
        cone[doll][i] = createCone(i, b1, b2);
    } else {
        hinge[doll][i] = createHinge(i, b1, b2, at);
        joint[doll][i] = MdtHingeQuaConstraint(hinge[doll][i]);
    }
    McdSpaceDisablePair(m, above);
}

static const float *colorOf(int doll, int i) {
    static const float skin[4] = {.93f, .76f, .62f, 1}, cloth[4] = {.27f, .31f, .42f, 1};
    if (i == HEAD || i == FOREARMS || i == FOREARMS + 1)
        return skin;
    return i == PELVIS || i >= THIGHS ? cloth : RPalette[doll % 6];
}

static void createDoll(int doll) {
    for (int i = 0; i < PARTS; i++) {
        body[doll][i] = playModel(createShape(i), 1000, 0, 0, 0, colorOf(doll, i));
        McdModelDynamicsSetDamping(body[doll][i], 0, 2); /* rad/s lost per rad/s and second: flesh */
    }
    placeDoll(doll);
    for (int i = CHEST; i < PARTS; i++)
        joinPart(doll, i);
    McdSpaceDisablePair(body[doll][THIGHS], body[doll][THIGHS + 1]); /* hips are narrow */
}

/* Down towards the viewer, along z; each step is a box that reaches the floor. The uppermost is the landing. */
static void createStairs(void) {
    static MeMatrix4 tm[STEPS];
    static const float stone[2][4] = {{.66f, .64f, .60f, 1}, {.76f, .74f, .70f, 1}};
    for (int i = 0; i < STEPS; i++) {
        const MeReal height = rise * (MeReal)(STEPS - i), depth = i ? tread : landing;
        MeMatrix4TMMakeIdentity(tm[i]);
        MeMatrix4TMSetPosition(tm[i], 0, height / 2, i ? tread * ((MeReal)i - R(0.5)) : -landing / 2);
        playFixed(McdBoxCreate(playUniverse->frame, width, height, depth), tm[i], stone[i & 1]);
    }
}

/* ---- the program ------------------------------------------------------------------------------------------------ */

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int doll = 0; doll < DOLLS; doll++)
        placeDoll(doll);
    widest = furthest = 0;
}

/* All are thrown up, each part by itself as fast as its figure. */
static void MEAPI throwUp(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int doll = 0; doll < DOLLS; doll++)
        for (int i = 0; i < PARTS; i++) {
            McdModelDynamicsEnable(body[doll][i]);
            McdModelDynamicsSetLinearVelocity(body[doll][i], 0, R(6) + R(0.3) * (MeReal)doll, R(-3));
        }
}

static MeReal opening(MdtConstraintID c) {
    MeVector3 a, b;
    MdtConstraintBodyGetPosition(c, 0, a);
    MdtConstraintBodyGetPosition(c, 1, b);
    MeVector3Subtract(a, a, b);
    return MeVector3Magnitude(a);
}

static MeReal beyondStop(MdtHingeID h, MeReal bend) {
    const MeReal angle = MdtLimitGetPosition(MdtHingeGetLimit(h));
    return MeMAX(angle - MeMAX(bend, 0), MeMIN(bend, 0) - angle);
}

static MeReal beyondCone(MdtConeLimitID limit) {
    MeVector3 a, b;
    MdtConstraintBodyGetAxis(MdtConeLimitQuaConstraint(limit), 0, a);
    MdtConstraintBodyGetAxis(MdtConeLimitQuaConstraint(limit), 1, b);
    return MeAcos(MeVector3Dot(a, b)) - MdtConeLimitGetConeHalfAngle(limit);
}

static void measure(void) {
    beyond = 0;
    for (int doll = 0; doll < DOLLS; doll++) {
        for (int i = CHEST; i < PARTS; i++) {
            const MdtHingeID h = hinge[doll][i];
            widest = MeMAX(widest, opening(joint[doll][i]));
            beyond = MeMAX(beyond, h ? beyondStop(h, part[i].bend) : beyondCone(cone[doll][i]));
        }
    }
    furthest = MeMAX(furthest, beyond);
}

static double lowestHead(void) {
    MeReal low = MEINFINITY;
    for (int doll = 0; doll < DOLLS; doll++)
        low = MeMIN(low, McdModelGetTransformPtr(body[doll][HEAD])[3][1]);
    return (double)low;
}

static void MEAPI Tick(RRender *context) {
    char text[200];
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    measure();
    snprintf(text, sizeof text,
             "joints open at most %.4f mm    limits passed by %.4f rad, now by %.4f    lowest head at %.2f m    "
             "awake %d    motion %.2f J",
             1000 * (double)widest, (double)furthest, (double)beyond, lowestHead(), playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Figures of joints and limits on a staircase.",
        "$ACTION2 - once more",
        "$ACTION3 - throw them up",
    };
    if (!playStart(argc, argv, "Ragdolls", DOLLS * PARTS))
        return 1;
    playFloor();
    createStairs();
    for (int doll = 0; doll < DOLLS; doll++)
        createDoll(doll);
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, throwUp, 0);
    playCamera(0, 1.8f, 2, 14, .6f, .35f);
    playRun(Tick);
    return 0;
}
