/* Explosions: a bomb in a tower of crates, and a wall that shields what is behind it (MstUniverseExplode).
 *
 * One call pushes every body within a radius of a point. Its impulse grows with the area that the body shows to the
 * point, and falls off with the distance. So of crates of one size the wooden ones fly, and those of iron, ten times
 * as heavy, hardly move. A fixed model shields what is behind it: the crates behind the wall stand still.
 *
 * The bomb goes off by itself after a second and a half. Press 3 for another one at the same place, 4 for a world in
 * which nothing shields, and change the impulse: a negative one pulls. The status line tells how many bodies the last
 * explosion pushed, and how many crates still stand behind the wall.
 */
#include "RParameter.h"
#include "play.h"
#include <stdio.h>

enum { LAYERS = 8, AROUND = 8, TOWER = LAYERS * AROUND, BEHIND = 9, FLASH = 24 };

static const MeReal side = (MeReal)0.5, radius = 7; /* m, of a crate, of the explosion */
static const MeVector3 bomb = {0, (MeReal)0.6, 0};
static MeReal impulse = 700; /* N s/m² */
static MeMatrix4 flashTM;
static McdModelID crate[TOWER + BEHIND];
static RGraphic *flash;
static MeBool isShielded = METRUE;
static int frame, flashAge = FLASH, pushed;

/* Rings of eight crates, every second one turned by half a crate: a tower with a shaft. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < TOWER; i++) {
        const int layer = i / AROUND;
        const MeReal turn = 2 * ME_PI * ((MeReal)(i % AROUND) + (MeReal)0.5 * (MeReal)(layer % 2)) / AROUND;
        playPlace(crate[i], (MeReal)0.9 * MeCos(turn), side * ((MeReal)layer + (MeReal)0.5), (MeReal)0.9 * MeSin(turn),
                  1, -turn);
    }
    for (int i = 0; i < BEHIND; i++)
        playPlace(crate[TOWER + i], (MeReal)4.2, side * ((MeReal)(i / 3) + (MeReal)0.5),
                  (MeReal)0.6 * (MeReal)(i % 3 - 1), 1, 0);
    frame = pushed = 0;
    flashAge = FLASH;
}

static void MEAPI explode(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    pushed = MstUniverseExplode(playUniverse, bomb, radius, impulse, 1, isShielded);
    flashAge = 0;
}

static void MEAPI toggleShield(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    isShielded = !isShielded;
}

/* A ball of light that grows to the explosion's radius, and fades. */
static void showFlash(void) {
    const float share = (float)flashAge / FLASH,
                color[4] = {1, .75f - .4f * share, .3f - .3f * share, .6f - .58f * share};
    MeMatrix4TMMakeIdentity(flashTM);
    for (int i = 0; i < 3; i++) {
        flashTM[i][i] = radius * (MeReal)(1 - (1 - share) * (1 - share));
        flashTM[3][i] = bomb[i] + (flashAge < FLASH ? 0 : -1000);
    }
    RGraphicSetColor(flash, color);
    flashAge += flashAge < FLASH;
}

static int countStanding(void) {
    int standing = 0;
    for (int i = TOWER; i < TOWER + BEHIND; i++)
        standing += MeFabs(McdModelGetTransformPtr(crate[i])[3][1] - side * ((MeReal)((i - TOWER) / 3) + (MeReal)0.5)) <
                    (MeReal)0.1;
    return standing;
}

static void MEAPI Tick(RRender *context) {
    char text[120];
    MeReal highest = 0;
    (void)context;
    if (frame++ == 90)
        explode(context, 0);
    MstUniverseStep(playUniverse, playFrame);
    showFlash();
    for (int i = 0; i < TOWER; i++)
        highest = MeMAX(highest, McdModelGetTransformPtr(crate[i])[3][1]);
    snprintf(text, sizeof text, "pushed %d of %d    highest %.1f m    behind the wall %d of %d stand    motion %.0f J",
             pushed, TOWER + BEHIND, (double)highest, countStanding(), BEHIND, playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"A bomb in a tower, and a wall.", "$ACTION2 - start again",
                                       "$ACTION3 - another explosion", "$ACTION4 - walls shield, or nothing does"};
    static const RParameter parameters[] = {
        {"impulse", "N s/m²", &impulse, -1000, 2000, 100, .less = "Down", .more = "Up"},
    };
    static const float iron[4] = {.35f, .38f, .42f, 1}, wood[4] = {.76f, .58f, .36f, 1},
                       stone[4] = {.6f, .58f, .55f, 1};
    static const MeVector3 wallAt = {(MeReal)3.2, 1, 0};
    if (!playStart(argc, argv, "Explosions", TOWER + BEHIND))
        return 1;
    const McdGeometryID cube = McdBoxCreate(playUniverse->frame, side, side, side);
    playFloor();
    playColor(MstFixedModelCreateAt(playUniverse, McdBoxCreate(playUniverse->frame, (MeReal)0.4, 2, 3), wallAt, 0),
              stone);
    for (int i = 0; i < TOWER + BEHIND; i++)
        crate[i] = playModel(cube, i < AROUND ? 2000 : 200, 0, 0, 0,
                             i < AROUND                    ? iron
                             : i < TOWER && i / AROUND % 2 ? RPalette[2]
                                                           : wood);
    flash = RGraphicSphereCreate(playRc, 1, stone, flashTM);
    playHelp(help, 4);
    RRenderCreateParameters(playRc, parameters, 1);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, explode, 0);
    RRenderSetActionNCallBack(playRc, 4, toggleShield, 0);
    playCamera(1, 2, 0, 16, .6f, .25f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
