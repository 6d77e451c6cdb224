#include "drive.h"

/* Frames: how long the viewer waits before it repeats a key, and between repeats, with one to spare. */
enum { FIRST = 26, REPEAT = 6 };

enum { UP, DOWN, LEFT, RIGHT, KEYS };

static int heldFor[KEYS];    /* so many more frames */
static int sincePress[KEYS]; /* frames */
static MeVector3 lookAt;
static MeReal seenHeading;

/* ---- keys ----------------------------------------------------------------------------------------------------- */

static void press(int key, int opposite) {
    heldFor[key] = sincePress[key] < REPEAT ? MeMAX(heldFor[key], REPEAT) : FIRST;
    heldFor[opposite] = 0;
    sincePress[key] = 0;
}

static void MEAPI pressUp(RRender *rc, void *userdata) {
    (void)rc, (void)userdata;
    press(UP, DOWN);
}

static void MEAPI pressDown(RRender *rc, void *userdata) {
    (void)rc, (void)userdata;
    press(DOWN, UP);
}

static void MEAPI pressLeft(RRender *rc, void *userdata) {
    (void)rc, (void)userdata;
    press(LEFT, RIGHT);
}

static void MEAPI pressRight(RRender *rc, void *userdata) {
    (void)rc, (void)userdata;
    press(RIGHT, LEFT);
}

void driveStart(RRender *rc) {
    for (int i = 0; i < KEYS; i++)
        sincePress[i] = FIRST;
    RRenderSetUpCallBack(rc, pressUp, 0);
    RRenderSetDownCallBack(rc, pressDown, 0);
    RRenderSetLeftCallBack(rc, pressLeft, 0);
    RRenderSetRightCallBack(rc, pressRight, 0);
}

void driveTick(void) {
    for (int i = 0; i < KEYS; i++) {
        heldFor[i] = MeMAX(heldFor[i] - 1, 0);
        sincePress[i] = MeMIN(sincePress[i] + 1, FIRST);
    }
}

int driveForward(void) {
    return (heldFor[UP] > 0) - (heldFor[DOWN] > 0);
}

int driveLeft(void) {
    return (heldFor[LEFT] > 0) - (heldFor[RIGHT] > 0);
}

/* ---- course --------------------------------------------------------------------------------------------------- */

/* An arc that begins straight ahead and ends at (x, y), y to the left, has the curvature 2 y / (x² + y²). */
MeReal driveAlong(MdtBodyID body, const MeReal (*course)[2], int points, int *next) {
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    const MeVector3 way = {course[*next][0] - tm[3][0], 0, course[*next][1] - tm[3][2]};
    const MeReal toLeft = -MeVector3Dot(way, tm[2]), square = MeVector3Dot(way, way);
    if (square < 36)
        *next = (*next + 1) % points;
    return 2 * toLeft / MeMAX(square, 1);
}

/* ---- camera --------------------------------------------------------------------------------------------------- */

/* Anticlockwise from x as seen from above; as it was while the body looks straight up or down. */
static MeReal headingOf(MdtBodyID body, MeReal old) {
    const MeReal *forward = MdtBodyGetTransformPtr(body)[0];
    const MeReal level = forward[0] * forward[0] + forward[2] * forward[2];
    return level > (MeReal)0.1 ? MeAtan2(-forward[2], forward[0]) : old;
}

static void look(RRender *rc) {
    const AcmeVector3 at = {(float)lookAt[0], (float)lookAt[1], (float)lookAt[2]};
    RCameraSetLookAt(rc, at);
}

void driveCamera(RRender *rc, MdtBodyID body, float distance, float elevation) {
    MdtBodyGetPosition(body, lookAt);
    seenHeading = headingOf(body, 0);
    look(rc);
    RCameraSetView(rc, distance, (float)(seenHeading - ME_PI / 2), elevation);
}

void driveFollow(RRender *rc, MdtBodyID body) {
    const MeReal turned = headingOf(body, seenHeading) - seenHeading;
    const MeReal turn = (MeReal)0.05 * MeAtan2(MeSin(turned), MeCos(turned));
    MeVector3 at;
    MdtBodyGetPosition(body, at);
    MeVector3Lerp(lookAt, lookAt, at, (MeReal)0.25);
    seenHeading += turn;
    look(rc);
    RCameraRotateAngle(rc, (float)turn);
}
