#include "play.h"
#include "MeMessage.h"
#include <stdio.h>
#include <stdlib.h>

MeApp *playApp;
RRender *playRc;
MstUniverseID playUniverse;
MeReal playFrame = (MeReal)(1.0 / 60);

static MeMatrix4 floorTM;
static MeBool showContacts;
static RMainLoopCallBackNoData programTick;

/* FNV-1a hash of all bodies' transforms and velocities: two runs with the same hash are the same, bit by bit. */
static MeU32 hashOf(const void *data, size_t size, MeU32 hash) {
    for (const unsigned char *byte = data; size > 0; size--)
        hash = (hash ^ *byte++) * 16777619u;
    return hash;
}

static MeU32 stateHash(void) {
    MeU32 hash = 2166136261u;
    for (MdtBodyID b = MdtBodyGetFirst(playUniverse->world); b; b = MdtBodyGetNext(b)) {
        MeVector3 v[2];
        MdtBodyGetLinearVelocity(b, v[0]);
        MdtBodyGetAngularVelocity(b, v[1]);
        hash = hashOf(v, sizeof v, hashOf(MdtBodyGetTransformPtr(b), sizeof(MeMatrix4), hash));
    }
    return hash;
}

static void MEAPI_CDECL cleanup(void) {
    if (playRc->m_Options.m_nFrames > 0)
        MeInfo(0, "state %08x", (unsigned int)stateHash());
    MeAppEnd(playApp);
}

static void setDefaults(void) {
    MdtContactParamsID p = playContact(0, 0);
    MdtContactParamsSetSurface(p, (MeReal)0.5, 0);
    MdtWorldSetGravity(playUniverse->world, 0, (MeReal)-9.81, 0);
}

static void MEAPI toggleContacts(RRender *rc, void *userdata) {
    (void)rc, (void)userdata;
    showContacts = !showContacts;
    MeAppToggleDrawContacts(playApp, showContacts);
    MeAppDrawContacts(playApp);
}

/* Sets up the drawing of contacts, hidden at first, and the key C. */
static void prepareContacts(int contacts) {
    static float orange[4] = {1, .45f, 0, 1};
    MeAppDrawContactsInit(playApp, orange, contacts);
    MeAppToggleDrawContacts(playApp, MEFALSE);
    RRenderSetActionNKey(playRc, 5, 'c');
    RRenderSetActionNCallBackWithText(playRc, 5, toggleContacts, 0, "show contacts, or hide them");
}

MeBool playStart(int argc, const char **argv, const char *name, int models) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    char title[80];
    models += 8; /* balls thrown with Space */
    sizes.dynamicBodiesMaxCount = (unsigned int)models;
    sizes.collisionModelsMaxCount = (unsigned int)models + 16;
    sizes.collisionGeometryInstancesMaxCount = 8 * (unsigned int)models;
    sizes.collisionPairsMaxCount = 16 * (unsigned int)models + 64;
    sizes.dynamicConstraintsMaxCount = 40 * (unsigned int)models + 64;
    playApp = MeAppStart(argc, argv, name, &sizes);
    if (!playApp)
        return MEFALSE;
    atexit(cleanup);
    playRc = playApp->rc;
    MeAppSetStepPtr(playApp, &playFrame);
    RCameraSetUp(playRc, 0, 1, 0);
    playUniverse = MeAppGetMstUniverse(playApp);
    snprintf(title, sizeof title, "Karma tutorial: %s", name);
    RRenderSetWindowTitle(playRc, title);
    setDefaults();
    prepareContacts((int)sizes.dynamicConstraintsMaxCount);
    return METRUE;
}

void playHelp(const char *const help[], int lines) {
    RRenderCreateUserHelp(playRc, help, lines);
}

void playCamera(float x, float y, float z, float distance, float angle, float elevation) {
    const AcmeVector3 at = {x, y, z};
    RCameraSetLookAt(playRc, at);
    RCameraSetView(playRc, distance, angle, elevation);
}

static void MEAPI tickWithHelpers(RRender *rc) {
    MeAppStep(playApp);
    programTick(rc);
}

void playRun(RMainLoopCallBackNoData tick) {
    programTick = tick;
    RRun(playRc, tickWithHelpers);
}

void playCentre(McdAggregateID whole, MeVector3 was) {
    MeMatrix4 own;
    MeMatrix3 inertia;
    MeReal volume;
    McdGeometryGetMassProperties(whole, own, inertia, &volume);
    MeVector3Copy(was, own[3]);
    for (int i = 0; i < McdAggregateGetElementCount(whole); i++) {
        MeMatrix4Ptr part = McdAggregateGetElementTransformPtr(whole, i);
        MeVector3Subtract(part[3], part[3], was);
    }
}

McdModelID playModel(McdGeometryID g, MeReal density, MeReal x, MeReal y, MeReal z, const float color[4]) {
    const McdModelID m = MstModelAndBodyCreate(playUniverse, g, density);
    if (!m)
        return 0;
    McdModelDynamicsSetPosition(m, x, y, z);
    MeAppShowModel(playApp, m, color);
    return m;
}

void playColor(McdModelID m, const float color[4]) {
    MeAppShowModel(playApp, m, color);
}

McdModelID playFixed(McdGeometryID g, MeMatrix4Ptr tm, const float color[4]) {
    const McdModelID m = MstFixedModelCreate(playUniverse, g, tm);
    if (m && color)
        MeAppShowModel(playApp, m, color);
    return m;
}

McdModelID playFloor(void) {
    static const float ground[4] = {.82f, .83f, .80f, 1};
    MeMatrix3 R;
    MeMatrix3MakeRotationX(R, -ME_PI / 2); /* the plane's z becomes y */
    MeMatrix4TMMakeFromRotationAndPosition(floorTM, R, 0, 0, 0);
    RGraphicGroundPlaneCreate(playRc, 60, 2, ground, 0);
    return playFixed(McdPlaneCreate(playUniverse->frame), floorTM, 0);
}

void playPlace(McdModelID m, MeReal x, MeReal y, MeReal z, int axis, MeReal angle) {
    const MdtBodyID b = McdModelGetBody(m);
    MeReal q[4] = {MeCos(angle / 2), 0, 0, 0};
    q[1 + axis] = MeSin(angle / 2);
    MdtBodySetPosition(b, x, y, z);
    MdtBodySetQuaternion(b, q[0], q[1], q[2], q[3]);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
    MdtBodyEnable(b);
}

MdtContactParamsID playContact(MstMaterialID m1, MstMaterialID m2) {
    return MstBridgeGetContactParams(playUniverse->bridge, m1, m2);
}

double playEnergy(void) {
    double sum = 0;
    for (MdtBodyID b = MdtBodyGetFirst(playUniverse->world); b; b = MdtBodyGetNext(b))
        sum += (double)MdtBodyGetKineticEnergy(b);
    return sum;
}

int playAwake(void) {
    return MdtWorldGetEnabledBodies(playUniverse->world);
}
