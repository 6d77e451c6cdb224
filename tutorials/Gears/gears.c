/* Gears: a train of wheels, a rack, a gripper and a hoist (MdtGear.h, MdtMimic.h, MdtPulley.h).
 *
 * One motor turns the first of three wheels, of 10, 30 and 20 teeth; the last one is a pinion, and moves a rack to
 * and fro. The rack carries two fingers: a motor slides one of them, and a mimic makes the other one follow. Beside it
 * hangs a load on a rope that runs over two wheels, and a counterweight, on which the program pulls now and then.
 *
 * The teeth are painted, and nothing here collides: the joints are the teeth. Watch the status line: by how much the
 * wheels are out of phase, however long they have turned, and by how much the fingers differ.
 */
#include "RParameter.h"
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { WHEELS = 3, PERIOD = 240 /* steps */ };

static const MeReal radius[WHEELS] = {(MeReal)0.25, (MeReal)0.75, (MeReal)0.5}, place[WHEELS] = {-2, -1, (MeReal)0.25};
static const int teeth[WHEELS] = {10, 30, 20};
static MeMatrix4 pulleyTM[2];
static MdtBodyID wheel[WHEELS], weight;
static MdtGearID gear[WHEELS]; /* from a wheel to the next one; the last one is the rack's */
static MdtLimitID motor, finger[2];
static MdtPulleyID rope;
static MeReal speed = 4; /* rad/s, of the first wheel */
static int now;

static MdtBodyID createPart(McdGeometryID g, MeReal x, MeReal y, const float color[4]) {
    McdModelID m = playModel(g, 500, x, y, 0, color);
    McdModelSetFilterGroup(m, -1);
    return McdModelGetBody(m);
}

static McdGeometryID box(MeReal x, MeReal y, MeReal z) {
    return McdBoxCreate(playUniverse->frame, x, y, z);
}

/* One graphic of two: the second one turned about z and moved along x and y. */
static RGraphic *join(RGraphic *all, RGraphic *more, double turn, double x, double y) {
    MeMatrix4 tm;
    MeMatrix3 turned;
    MeMatrix3MakeRotationZ(turned, (MeReal)turn);
    MeMatrix4TMMakeFromRotationAndPosition(tm, turned, (MeReal)x, (MeReal)y, 0);
    RGraphic *both = RGraphicCombine(playRc, all, more, tm);
    RGraphicDelete(playRc, all, 0);
    RGraphicDelete(playRc, more, 0);
    return both;
}

/* A disc with a bar for two opposite teeth each; the middle wheel has gaps where its neighbours have teeth. */
static RGraphic *paintWheel(int i) {
    const float r = (float)radius[i], depth = .06f, thick = .15f, pitch = 2 * (float)ME_PI / (float)teeth[i];
    RGraphic *all = RGraphicCylinderCreate(playRc, r - depth, thick, RPalette[i], 0);
    for (int k = 0; k < teeth[i] / 2; k++)
        all = join(all, RGraphicBoxCreate(playRc, 2 * (r + depth), .45f * pitch * r, thick, RPalette[i], 0),
                   pitch * (k + (i == 1 ? .5 : 0)), 0, 0);
    return all;
}

/* As long teeth as those of the pinion, which stands between two of them. */
static RGraphic *paintRack(void) {
    const float pitch = 2 * (float)ME_PI * (float)radius[2] / (float)teeth[2];
    RGraphic *all = RGraphicBoxCreate(playRc, 3, .1f, .15f, RPalette[3], 0);
    for (int k = -9; k < 9; k++)
        all = join(all, RGraphicBoxCreate(playRc, .45f * pitch, .12f, .15f, RPalette[3], 0), 0, pitch * (k + .5), .1);
    return all;
}

static void createWheel(int i) {
    MdtHingeID shaft = MdtHingeCreate(playUniverse->world);
    wheel[i] = createPart(McdCylinderCreate(playUniverse->frame, radius[i], (MeReal)0.15), place[i], 3, RPalette[i]);
    MeAppShowModelAs(playApp, MdtBodyGetModel(wheel[i]), paintWheel(i));
    MdtHingeSetBodies(shaft, wheel[i], 0);
    MdtHingeSetPosition(shaft, place[i], 3, 0);
    MdtHingeSetAxis(shaft, 0, 0, 1);
    MdtHingeEnable(shaft);
    if (i == 0)
        motor = MdtHingeGetLimit(shaft);
}

static MdtPrismaticID slide(MdtBodyID b, MdtBodyID on, MeReal x) {
    MdtPrismaticID j = MdtPrismaticCreate(playUniverse->world);
    MdtPrismaticSetBodies(j, b, on);
    MdtPrismaticSetAxis(j, x, 0, 0);
    MdtPrismaticEnable(j);
    return j;
}

static MdtGearID createGear(MdtBodyID first, MdtBodyID second) {
    MdtGearID g = MdtGearCreate(playUniverse->world);
    MdtGearSetBodies(g, first, second);
    MdtGearSetAxis(g, 0, 0, 1);
    MdtGearEnable(g);
    return g;
}

static void createTrain(MdtBodyID rack) {
    for (int i = 0; i < WHEELS; i++)
        createWheel(i);
    for (int i = 0; i + 1 < WHEELS; i++) {
        gear[i] = createGear(wheel[i], wheel[i + 1]);
        MdtGearSetTeeth(gear[i], teeth[i], teeth[i + 1]);
    }
    slide(rack, 0, 1);
    gear[2] = createGear(wheel[2], rack);
    MdtGearBodySetAxis(gear[2], 1, -1, 0, 0); /* the pinion is above the rack */
    MdtGearSetRack(gear[2], radius[2]);
}

static void createGripper(MdtBodyID hand) {
    MdtConstraintID joint[2];
    for (int i = 0; i < 2; i++) {
        MdtBodyID b =
            createPart(box((MeReal)0.1, (MeReal)0.6, (MeReal)0.3), (MeReal)(i ? 0.65 : -0.15), 2, RPalette[4]);
        MdtPrismaticID j = slide(b, hand, i ? -1 : 1);
        joint[i] = MdtPrismaticQuaConstraint(j);
        finger[i] = MdtPrismaticGetLimit(j);
        MdtLimitCalculatePosition(finger[i], METRUE);
    }
    MdtMimicID mimic = MdtMimicCreate(playUniverse->world);
    MdtMimicSetJoints(mimic, joint[0], joint[1]);
    MdtMimicEnable(mimic);
}

static void createHoist(void) {
    MdtBodyID load = createPart(box((MeReal)0.6, (MeReal)0.6, (MeReal)0.6), 3, 1, RPalette[5]);
    weight = createPart(box((MeReal)0.5, (MeReal)0.5, (MeReal)0.5), 4, 3, RPalette[6]);
    MdtBodySetMass(weight, MdtBodyGetMass(load));
    rope = MdtPulleyCreate(playUniverse->world);
    MdtPulleySetBodies(rope, load, weight);
    MdtPulleySetWheel(rope, 0, 3, 5, 0);
    MdtPulleySetWheel(rope, 1, 4, 5, 0);
    MdtPulleySetSlack(rope, METRUE);
    for (int i = 0; i < 2; i++) {
        static const float steel[4] = {.35f, .38f, .42f, 1};
        MeMatrix4TMMakeIdentity(pulleyTM[i]);
        MeVector3Set(pulleyTM[i][3], (MeReal)(3 + i), 5, 0);
        RGraphicCylinderCreate(playRc, .12f, .1f, steel, pulleyTM[i]);
    }
    MdtPulleyEnable(rope);
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    double phase = 0;
    const int at = now++ % PERIOD;
    const MeReal way = at < PERIOD / 2 ? 1 : -1, pull = at % (PERIOD / 2) < PERIOD / 4 ? -way : way;
    (void)context;
    MdtLimitSetLimitedForceMotor(motor, way * speed, 2000);
    MdtLimitSetLimitedForceMotor(finger[0], way * (MeReal)0.15, 200);
    MdtBodyAddForce(weight, 0, pull * 80, 0);
    MstUniverseStep(playUniverse, playFrame);
    for (int i = 0; i < WHEELS; i++)
        phase = fmax(phase, fabs((double)MdtGearGetError(gear[i])));
    snprintf(text, sizeof text,
             "wheel %.2f rad    out of phase %.6f rad    fingers %.4f m, apart %.6f m    load at %.2f m",
             (double)MdtGearGetCoordinate(gear[0], 0), phase, (double)MdtLimitGetPosition(finger[0]),
             fabs((double)(MdtLimitGetPosition(finger[0]) - MdtLimitGetPosition(finger[1]))),
             5 - (double)MdtPulleyGetDistance(rope, 0));
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"Wheels, a rack, a gripper and a hoist."};
    static const RParameter parameters[] = {
        {"speed of the motor", "rad/s", &speed, 0, 8, (MeReal)0.25, .less = "Down", .more = "Up"},
    };
    if (!playStart(argc, argv, "Gears", 10))
        return 1;
    playFloor();
    MdtBodyID rack = createPart(box(3, (MeReal)0.1, (MeReal)0.15), (MeReal)0.25, (MeReal)2.4, RPalette[3]);
    MeAppShowModelAs(playApp, MdtBodyGetModel(rack), paintRack());
    createTrain(rack);
    createGripper(rack);
    createHoist();
    playHelp(help, 1);
    RRenderCreateParameters(playRc, parameters, 1);
    MeAppSetLayers(playApp, MstDebugLimits); /* the rope */
    playCamera(1, 3, 0, 7.6f, .25f, .15f);
    playRun(Tick);
    return 0;
}
