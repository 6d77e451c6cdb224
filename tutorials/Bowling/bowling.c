/* Bowling: ten pins, a lane, and a ball with spin (User Guide, chapter 4, "Convex Mesh" and "Aggregate"; chapter 5,
 * "Materials").
 *
 * Everything has its real size. A pin is an aggregate of a convex hull, from the foot to the neck, and a sphere, the
 * head. The lane is oiled: the ball slides at first, and what spin it was given turns it only slowly to rolling.
 * Friction acts against the slip of the point that touches, so spin about the lane's axis bends the ball's way (a
 * hook), and backspin makes it slow: a ball thrown with v and backspin w comes to roll with 5/7 v - 2/7 r w.
 *
 * Watch the status line: the pins that have fallen, the ball's speed and its slip, which ends when it rolls.
 */
#include "RParameter.h"
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { PINS = 10, SIDES = 16, RINGS = 5 };

static const MeReal laneHalf = (MeReal)0.525, laneTop = (MeReal)0.1; /* m: half its width; above the floor */
static const MeReal foul = 7, headPin = -6;                          /* m, z: where the ball starts, where pins do */
static const MeReal apart = (MeReal)0.3048;                          /* m, from pin to pin */
static const MeReal ballRadius = (MeReal)0.108;                      /* m */
static const MeReal oil = (MeReal)0.2;                               /* friction of ball and lane */

/* Half the profile of a pin: the hull's rings, then the head. */
static const MeReal ringHeight[RINGS] = {0, (MeReal)0.057, (MeReal)0.114, (MeReal)0.17, (MeReal)0.318}; /* m */
static const MeReal ringRadius[RINGS] = {(MeReal)0.03, (MeReal)0.05, (MeReal)0.0605, (MeReal)0.052, (MeReal)0.02};
static const MeReal headHeight = (MeReal)0.345, headRadius = (MeReal)0.034;

static McdModelID pin[PINS], ball;
static MeMatrix4 part[2]; /* of a pin, kept by pointer */
static MeReal foot;       /* m, from a pin's foot up to its centre of mass */

static MeReal speed = 7, aim, hook,
              backspin; /* m/s, rad, rad/s, rad/s: of the next ball; a hook to the left is positive */

/* ---- pins -------------------------------------------------------------------------------------------------------- */

static McdGeometryID createBelly(void) {
    MeVector3 point[RINGS * SIDES];
    for (int i = 0; i < RINGS * SIDES; i++) {
        const MeReal r = ringRadius[i / SIDES], angle = 2 * ME_PI * (MeReal)(i % SIDES) / SIDES;
        MeVector3Set(point[i], r * MeCos(angle), ringHeight[i / SIDES], r * MeSin(angle));
    }
    return McdConvexMeshCreateHull(playUniverse->frame, (const MeVector3 *)point, RINGS * SIDES, 0);
}

static McdGeometryID createPinGeometry(void) {
    const McdAggregateID whole = McdAggregateCreate(playUniverse->frame, 2);
    MeVector3 centre;
    MeMatrix4TMMakeIdentity(part[0]);
    MeMatrix4TMMakeIdentity(part[1]);
    MeMatrix4TMSetPosition(part[1], 0, headHeight, 0);
    McdAggregateAddElement(whole, createBelly(), part[0]);
    McdAggregateAddElement(whole, McdSphereCreate(playUniverse->frame, headRadius), part[1]);
    playCentre(whole, centre);
    foot = centre[1];
    return whole;
}

/* Four rows, the head pin nearest to the player. */
static void placePin(int i) {
    const int row = i < 1 ? 0 : i < 3 ? 1 : i < 6 ? 2 : 3, first = row * (row + 1) / 2;
    const MeReal x = apart * ((MeReal)(i - first) - (MeReal)row / 2), z = headPin - apart * (MeReal)0.866 * (MeReal)row;
    playPlace(pin[i], x, laneTop + foot, z, 0, 0);
}

static int countFallen(void) {
    int fallen = 0;
    for (int i = 0; i < PINS; i++) {
        const MeMatrix4Ptr tm = McdModelGetTransformPtr(pin[i]);
        fallen += tm[1][1] < (MeReal)0.9 || tm[3][1] < laneTop;
    }
    return fallen;
}

/* ---- lane and ball ----------------------------------------------------------------------------------------------- */

static void createBlock(MeReal x, MeReal y, MeReal z, MeReal width, MeReal height, MeReal length, const float *color) {
    static MeMatrix4 tm[6];
    static int used;
    MeMatrix4TMMakeIdentity(tm[used]);
    MeMatrix4TMSetPosition(tm[used], x, y, z);
    playFixed(McdBoxCreate(playUniverse->frame, width, height, length), tm[used++], color);
}

/* A gutter on either side, with a curb; walls beside and behind the pins. */
static void createLane(void) {
    static const float maple[4] = {.85f, .68f, .45f, 1}, dark[4] = {.30f, .30f, .36f, 1},
                       grey[4] = {.52f, .52f, .56f, 1};
    const MeReal thick = (MeReal)0.1, high = (MeReal)0.5, deck = headPin + 1, pit = headPin - 3; /* m */
    const MeReal start = foul + (MeReal)0.7, end = headPin - (MeReal)1.3, side = laneHalf + (MeReal)0.25 + thick / 2;
    createBlock(0, laneTop / 2, (start + end) / 2, 2 * laneHalf, laneTop, start - end, maple);
    for (int k = -1; k <= 1; k += 2) {
        const MeReal x = (MeReal)k * side;
        createBlock(x, laneTop, (start + deck) / 2, thick, 2 * laneTop, start - deck, grey);
        createBlock(x, high / 2, (deck + pit) / 2, thick, high, deck - pit, dark);
    }
    createBlock(0, high / 2, pit - thick / 2, 2 * side + thick, high, thick, dark);
}

static void setMaterial(MstMaterialID a, MstMaterialID b, MeReal friction, MeReal restitution) {
    const MdtContactParamsID p = playContact(a, b);
    MdtContactParamsSetSurface(p, friction, restitution);
}

/* The lane, the floor and the walls are of the default material. */
static void createModels(void) {
    static const float white[4] = {.93f, .92f, .88f, 1};
    const MstMaterialID wood = MstBridgeGetNewMaterial(playUniverse->bridge),
                        resin = MstBridgeGetNewMaterial(playUniverse->bridge);
    const McdGeometryID g = createPinGeometry();
    setMaterial(wood, 0, (MeReal)0.35, (MeReal)0.3);
    setMaterial(wood, wood, (MeReal)0.2, (MeReal)0.6);
    setMaterial(resin, wood, (MeReal)0.2, (MeReal)0.7);
    setMaterial(resin, 0, oil, 0);
    /* rad²/s²: small things turn fast while they move slowly */
    MdtWorldSetAutoDisableAngularVelocityThreshold(playUniverse->world, (MeReal)0.2);
    for (int i = 0; i < PINS; i++) {
        pin[i] = playModel(g, 750, 0, 0, 0, white);
        McdModelDynamicsSetDamping(pin[i], (MeReal)0.1, (MeReal)0.5); /* lying round things would roll on for ever */
        McdModelSetMaterial(pin[i], (int)wood);
    }
    ball = playModel(McdSphereCreate(playUniverse->frame, ballRadius), 1300, 0, 0, 0, RPalette[3]);
    McdModelSetMaterial(ball, (int)resin);
}

/* ---- the player -------------------------------------------------------------------------------------------------- */

static void MEAPI throwBall(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    playPlace(ball, 0, laneTop + ballRadius, foul, 0, 0);
    McdModelDynamicsSetLinearVelocity(ball, speed * MeSin(aim), 0, -speed * MeCos(aim));
    McdModelDynamicsSetAngularVelocity(ball, backspin, 0, hook);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    for (int i = 0; i < PINS; i++)
        placePin(i);
    throwBall(context, userdata);
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

/* m/s, of the ball's lowest point over the lane. */
static double slipOf(const MeReal *v, const MeReal *w) {
    return sqrt((double)((v[0] + w[2] * ballRadius) * (v[0] + w[2] * ballRadius) +
                         (v[2] - w[0] * ballRadius) * (v[2] - w[0] * ballRadius)));
}

static void MEAPI Tick(RRender *context) {
    char text[240];
    MeVector3 p, v, w;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    McdModelDynamicsGetPosition(ball, p);
    McdModelDynamicsGetLinearVelocity(ball, v);
    McdModelDynamicsGetAngularVelocity(ball, w);
    snprintf(
        text, sizeof text,
        "fallen %d of %d    ball at %.3f m, %.3f m to go, %.3f m/s, slip %.3f m/s    next: aim %.3f rad, hook %.0f, "
        "backspin %.0f rad/s    awake %d",
        countFallen(), PINS, (double)p[0], (double)(p[2] - headPin), (double)MeVector3Magnitude(v), slipOf(v, w),
        (double)aim, (double)hook, (double)backspin, playAwake());
    RRenderSetStatusText(playRc, text);
}

static void createControls(void) {
    static const char *const help[] = {
        "Ten pins, and a ball that slides before it rolls.",
        "$ACTION2 - set the pins, and throw",
        "$ACTION3 - throw once more, at what stands",
    };
    static const RParameter parameters[] = {
        {"speed of the next ball", "m/s", &speed, 4, 12, (MeReal)0.5, .less = "Down", .more = "Up"},
        {"aim", "rad", &aim, (MeReal)-0.06, (MeReal)0.06, (MeReal)0.002, .less = "Left", .more = "Right"},
        {"spin for a hook to the left", "rad/s", &hook, -40, 40, 1, .less = "d", .more = "a"},
        {"backspin", "rad/s", &backspin, -100, 100, 2, .less = "s", .more = "w"},
    };
    playHelp(help, 3);
    RRenderCreateParameters(playRc, parameters, 4);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, throwBall, 0);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    if (!playStart(argc, argv, "Bowling", PINS + 1))
        return 1;
    playFloor();
    createLane();
    createModels();
    createControls();
    playCamera(0, .25f, -6.1f, 3.4f, .3f, .38f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
