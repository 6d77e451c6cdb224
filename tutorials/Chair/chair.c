/* Chair: one model of many geometries (User Guide, chapter 4, "Creating a Model with an Aggregate Geometry").
 *
 * A seat, a back and four legs are an aggregate: one geometry, hence one model and one body, that touches with any of
 * its parts. The legs share one geometry; each has its own place. The library knows the mass, the inertia and the
 * centre of mass of the whole, and the latter is below the middle and towards the back: that is why a chair falls over
 * backward more easily. Karma keeps the body's centre of mass at the geometry's origin, so the parts are moved until it
 * is there.
 *
 * Chairs are thrown. Watch on how many feet they come to stand: the status line counts the ones that stand upright.
 */
#include "play.h"
#include <stdio.h>

enum { CHAIRS = 6, PARTS = 6, BACK = 1, FIRST_LEG = 2 };

static const MeReal legRadius = (MeReal)0.05, legHeight = (MeReal)0.9; /* m */

static McdModelID chair[CHAIRS];
static MeMatrix4 part[PARTS]; /* kept by pointer */
static MeReal feet;           /* m, from the feet up to the centre of mass */

/* ---- the geometry ----------------------------------------------------------------------------------------------- */

static void addPart(McdAggregateID whole, int i, McdGeometryID g, MeReal x, MeReal y, MeReal z) {
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, i < FIRST_LEG ? 0 : -ME_PI / 2); /* cylinders lie along z: legs are to stand */
    MeMatrix4TMMakeFromRotationAndPosition(part[i], R, x, y, z);
    McdAggregateAddElement(whole, g, part[i]);
}

/* Upright: the feet at y = 0, the back at the side of -x. */
static McdGeometryID createGeometry(void) {
    const McdFrameworkID frame = playUniverse->frame;
    const McdAggregateID whole = McdAggregateCreate(frame, PARTS);
    const McdGeometryID leg = McdCylinderCreate(frame, legRadius, legHeight);
    const MeReal side = (MeReal)0.42;
    MeVector3 centre;
    addPart(whole, 0, McdBoxCreate(frame, 1, (MeReal)0.12, 1), 0, legHeight + (MeReal)0.06, 0);
    addPart(whole, BACK, McdBoxCreate(frame, (MeReal)0.1, 1, 1), (MeReal)-0.45, legHeight + (MeReal)0.62, 0);
    for (int i = FIRST_LEG; i < PARTS; i++)
        addPart(whole, i, leg, i & 1 ? side : -side, legHeight / 2, i & 2 ? side : -side);
    playCentre(whole, centre);
    feet = centre[1];
    return whole;
}

/* ---- the chairs ------------------------------------------------------------------------------------------------- */

/* The first one stands; the others are thrown, each in its own way. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    playPlace(chair[0], 0, feet, 0, 1, (MeReal)0.6);
    for (int i = 1; i < CHAIRS; i++) {
        const MeReal angle = (MeReal)(1.2 * i);
        playPlace(chair[i], 4 * MeCos(angle), (MeReal)(1.5 + 1.2 * i), 4 * MeSin(angle), i % 3, (MeReal)(0.7 * i));
        McdModelDynamicsSetLinearVelocity(chair[i], -2 * MeCos(angle), 2, -2 * MeSin(angle));
        McdModelDynamicsSetAngularVelocity(chair[i], (MeReal)(i % 3), 1, (MeReal)(2 - i % 4));
    }
}

/* A kick from below. */
static void MEAPI kick(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < CHAIRS; i++) {
        MdtBodyEnable(McdModelGetBody(chair[i]));
        McdModelDynamicsSetLinearVelocity(chair[i], 0, 5, 0);
        McdModelDynamicsSetAngularVelocity(chair[i], (MeReal)(3 - i), 0, 3);
    }
}

static int countUpright(void) {
    int upright = 0;
    for (int i = 0; i < CHAIRS; i++)
        upright += McdModelGetTransformPtr(chair[i])[1][1] > (MeReal)0.99;
    return upright;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text,
             "first chair: seat tilted %.3f, centre at %.4f m    upright %d of %d    awake %d    motion %.3f J",
             1 - (double)McdModelGetTransformPtr(chair[0])[1][1], (double)McdModelGetTransformPtr(chair[0])[3][1],
             countUpright(), CHAIRS, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Chairs: a seat, a back and four legs in one model.",
        "$ACTION2 - throw them again",
        "$ACTION3 - kick them",
    };
    if (!playStart(argc, argv, "Chair", CHAIRS))
        return 1;
    /* Some 5 ms of a step at most, where a chair comes down on several feet at once. */
    MdtWorldSetWorkBudget(playUniverse->world, 24);
    playFloor();
    const McdGeometryID geometry = createGeometry();
    for (int i = 0; i < CHAIRS; i++)
        chair[i] = playModel(geometry, 600, 0, 0, 0, RPalette[i % 6]);
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, kick, 0);
    playCamera(0, 1, 0, 10, .5f, .35f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
