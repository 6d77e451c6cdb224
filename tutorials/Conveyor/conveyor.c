/* Conveyor: four belts carry boxes round and round (User Guide, chapter 5, "Callback Functions"; Dynamics guide,
 * chapter 3, "Slip: An Alternate Way to Model Friction", where slide is explained).
 *
 * A belt does not move: only its surface does. Its contacts say so: MdtContactParamsSetPrimarySlide gives the speed of
 * the surface, MdtContactSetDirection the way. The bridge makes contacts anew in every step, so both are set in the
 * callback that it calls for each contact of boxes and belts. Friction does the rest: it drags a box along until both
 * have the same speed, and at a corner, where one belt takes over from another, it turns the way of the box.
 *
 * Watch the status line: the speed of boxes on the straight, and the laps of the slowest and of the fastest one.
 */
#include "RParameter.h"
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { BELTS = 4, BOXES = 10, WALLS = 5 };

/* A belt's top is at the same height everywhere; it runs along x or along z. */
typedef struct {
    MeReal x, z, length, width; /* m: its middle, its size along x and along z */
    MeReal alongX, alongZ;      /* the way */
} Belt;

static const Belt belt[BELTS] = {
    {-1, 3, 6, 2, 1, 0},
    {3, 1, 2, 6, 0, -1},
    {1, -3, 6, 2, -1, 0},
    {-3, -1, 2, 6, 0, 1},
};

static const MeReal beltTop = (MeReal)0.6; /* m */
static const MeReal stripes = (MeReal)0.5; /* m, apart */

static McdModelID beltModel[BELTS], box[BOXES];
static MeReal size[BOXES][3];
static MeReal speed = (MeReal)1.5;      /* m/s, of the belts */
static MeReal moved;                    /* m, the belts since a stripe was at the start */
static double lap[BOXES], angle[BOXES]; /* turns so far; rad, where the box is */

/* ---- belts ------------------------------------------------------------------------------------------------------- */

/* The belt of a pair; the other one is a box. */
static const Belt *beltOf(const McdModelPair *pair) {
    for (int i = 0; i < BELTS; i++)
        if (beltModel[i] == pair->model1 || beltModel[i] == pair->model2)
            return &belt[i];
    return 0;
}

/* The bridge calls this for every contact of a box with a belt; false deletes the contact, and that is for those with a
 * belt's edge, at which boxes would get stuck that come from the next belt. The first body of a contact with something
 * fixed is the one that moves, so that slide carries it along. */
static MeBool MEAPI carry(McdIntersectResult *result, McdContact *collision, MdtContactID contact) {
    const Belt *b = beltOf(result->pair);
    if (MeFabs(collision->normal[1]) < (MeReal)0.7)
        return MEFALSE;
    MdtContactSetDirection(contact, b->alongX, 0, b->alongZ);
    MdtContactParamsSetPrimarySlide(MdtContactGetParams(contact), speed);
    return METRUE;
}

static void setMaterial(MstMaterialID a, MstMaterialID b, MeReal friction) {
    const MdtContactParamsID p = playContact(a, b);
    MdtContactParamsSetSurface(p, friction, 0);
}

static McdModelID createBlock(MeReal x, MeReal z, MeReal top, MeReal length, MeReal width, const float color[4]) {
    static MeMatrix4 tm[BELTS + WALLS];
    static int used;
    MeMatrix4TMMakeIdentity(tm[used]);
    MeMatrix4TMSetPosition(tm[used], x, top / 2, z);
    return playFixed(McdBoxCreate(playUniverse->frame, length, top, width), tm[used++], color);
}

/* Four walls around the belts, and a block in the middle. */
static void createWalls(void) {
    static const float steel[4] = {.60f, .64f, .70f, 1};
    const MeReal thick = (MeReal)0.15, out = 4 + thick / 2, low = beltTop + (MeReal)0.25;
    createBlock(0, out, low, 8 + 2 * thick, thick, steel);
    createBlock(0, -out, low, 8 + 2 * thick, thick, steel);
    createBlock(out, 0, low, thick, 8, steel);
    createBlock(-out, 0, low, thick, 8, steel);
    createBlock(0, 0, low, 4, 4, steel);
}

static void createBelts(MstMaterialID rubber) {
    static const float black[4] = {.20f, .21f, .24f, 1};
    for (int i = 0; i < BELTS; i++) {
        beltModel[i] = createBlock(belt[i].x, belt[i].z, beltTop, belt[i].length, belt[i].width, black);
        McdModelSetMaterial(beltModel[i], (int)rubber);
    }
}

/* Stripes across a belt that move with its surface. */
static void drawBelt(const Belt *b) {
    const MeReal along = b->alongX != 0 ? b->length : b->width, across = b->alongX != 0 ? b->width : b->length;
    const MeReal y = beltTop + (MeReal)0.005;
    for (MeReal s = moved; s < along; s += stripes) {
        const MeReal x = b->x + (s - along / 2) * b->alongX, z = b->z + (s - along / 2) * b->alongZ;
        const MeReal dx = across / 2 * b->alongZ, dz = across / 2 * b->alongX;
        const AcmeVector3 from = {(float)(x - dx), (float)y, (float)(z - dz)},
                          to = {(float)(x + dx), (float)y, (float)(z + dz)};
        RLineAdd(playRc, from, to, .75f, .72f, .35f);
    }
}

/* ---- boxes ------------------------------------------------------------------------------------------------------- */

static double angleOf(McdModelID m) {
    const MeReal *p = McdModelGetTransformPtr(m)[3];
    return atan2((double)p[2], (double)p[0]);
}

/* Around the loop, not in line, and dropped. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++) {
        const Belt *b = &belt[i % BELTS];
        const MeReal s = (MeReal)(1.7 * (i / BELTS) - 2), off = (MeReal)(0.3 * (i % 3 - 1));
        playPlace(box[i], b->x + s * b->alongX + off * b->alongZ, beltTop + (MeReal)0.3 + size[i][1],
                  b->z + s * b->alongZ + off * b->alongX, 1, (MeReal)(0.4 * i));
        lap[i] = 0;
        angle[i] = angleOf(box[i]);
    }
}

static void createBoxes(MstMaterialID card) {
    for (int i = 0; i < BOXES; i++) {
        size[i][0] = (MeReal)(0.5 + 0.1 * (i % 3));
        size[i][1] = (MeReal)(0.3 + 0.1 * (i % 4));
        size[i][2] = (MeReal)(0.6 + 0.1 * (i % 2));
        box[i] = playModel(McdBoxCreate(playUniverse->frame, size[i][0], size[i][1], size[i][2]), 200, 0, 0, 0,
                           RPalette[i % 6]);
        McdModelSetMaterial(box[i], (int)card);
    }
}

/* The belts run from z towards x, and from x towards -z: that way round a lap counts. */
static void countLaps(void) {
    for (int i = 0; i < BOXES; i++) {
        const double now = angleOf(box[i]);
        double turned = angle[i] - now;
        turned += turned > 3.2 ? -2 * (double)ME_PI : turned < -3.2 ? 2 * (double)ME_PI : 0;
        lap[i] += turned / (2 * (double)ME_PI);
        angle[i] = now;
    }
}

static int countOnBelts(void) {
    int on = 0;
    for (int i = 0; i < BOXES; i++) {
        const MeReal *p = McdModelGetTransformPtr(box[i])[3];
        on += p[1] > beltTop && MeFabs(p[0]) < 4 && MeFabs(p[2]) < 4;
    }
    return on;
}

/* m/s, of the boxes in the middle halves of belts, along them; 0: there is none. */
static double speedOnTheStraight(void) {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < BOXES; i++) {
        const MeReal *p = McdModelGetTransformPtr(box[i])[3];
        MeVector3 v;
        McdModelDynamicsGetLinearVelocity(box[i], v);
        if (MeFabs(p[0]) > 1 && MeFabs(p[2]) > 1)
            continue;
        sum += sqrt((double)(v[0] * v[0] + v[2] * v[2]));
        count++;
    }
    return count ? sum / count : 0;
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

/* Boxes that have fallen asleep do not notice that the belt below them moves again. */
static void MEAPI wakeBoxes(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BOXES; i++)
        McdModelDynamicsEnable(box[i]);
}

static void MEAPI stopOrGo(RRender *context, void *userdata) {
    speed = speed > 0 ? 0 : (MeReal)1.5;
    wakeBoxes(context, userdata);
}

static void showFigures(void) {
    double min = lap[0], max = lap[0];
    char text[200];
    for (int i = 1; i < BOXES; i++) {
        min = min < lap[i] ? min : lap[i];
        max = max > lap[i] ? max : lap[i];
    }
    snprintf(
        text, sizeof text,
        "belts %.2f m/s    on the straight %.3f m/s    boxes on the belts %d of %d    laps %.2f to %.2f    awake %d",
        (double)speed, speedOnTheStraight(), countOnBelts(), BOXES, min, max, playAwake());
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    moved = (MeReal)fmod((double)(moved + speed * playFrame + stripes), (double)stripes);
    countLaps();
    RLineRemoveAll(playRc);
    for (int i = 0; i < BELTS; i++)
        drawBelt(&belt[i]);
    showFigures();
}

static void createModels(void) {
    const MstMaterialID rubber = MstBridgeGetNewMaterial(playUniverse->bridge),
                        card = MstBridgeGetNewMaterial(playUniverse->bridge);
    setMaterial(rubber, card, (MeReal)0.8);
    setMaterial(card, card, (MeReal)0.2);
    setMaterial(card, 0, (MeReal)0.1); /* walls */
    MstBridgeSetPerContactCB(playUniverse->bridge, rubber, card, carry);
    playFloor();
    createBelts(rubber);
    createWalls();
    createBoxes(card);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Belts whose surfaces move, and boxes on them.",
        "$ACTION2 - once more",
        "$ACTION3 - stop, or go",
    };
    static const RParameter parameters[] = {
        {"speed of the belts", "m/s", &speed, 0, 3, (MeReal)0.05, .less = "Down", .more = "Up", .changed = wakeBoxes},
    };
    if (!playStart(argc, argv, "Conveyor", BOXES))
        return 1;
    createModels();
    playHelp(help, 3);
    RRenderCreateParameters(playRc, parameters, 1);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, stopOrGo, 0);
    playCamera(0, .4f, 0, 13, .5f, .6f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
