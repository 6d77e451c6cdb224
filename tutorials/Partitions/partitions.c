/* Partitions: which bodies have to be solved for together (Dynamics guide, chapter 1, "Partitioning the World").
 *
 * Before every step the world is divided into partitions: sets of bodies that constraints tie together. Each is solved
 * by itself, which is a great deal faster than one large system. The world itself joins nothing: pendulums that hang
 * from the same beam are a partition each, until springs tie them together. Bodies of one partition have one colour
 * here.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include <stdio.h>
#include <stdlib.h>

enum { BODIES = 12, LINKS = BODIES - 1 };

static const MeReal step = (MeReal)(1.0 / 60);            /* s */
static const MeReal rodLength = 2, radius = (MeReal)0.32; /* m */
static const MeReal spacing = 1;                          /* m */
static const MeReal beam = (MeReal)3.4;                   /* m, height */

static MdtWorldID world;
static MdtBodyID body[BODIES];
static MdtSpringID link[LINKS]; /* between a body and the next; enabled or not */

static RRender *rc;
static RGraphic *ballG[BODIES], *springG[LINKS], *rodG[BODIES];

static MeReal placeOf(int i) {
    return spacing * ((MeReal)i - (MeReal)(BODIES - 1) / 2);
}

static int isLinked(int i) {
    return MdtSpringIsEnabled(link[i]) != 0;
}

static void setLinked(int i, int linked) {
    if (linked)
        MdtSpringEnable(link[i]);
    else
        MdtSpringDisable(link[i]);
    MdtBodyEnable(body[i]);
}

/* All pendulums hang; the first one is drawn aside. Every third link is there. */
static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BODIES; i++) {
        const MeReal angle = i == 0 ? (MeReal)-0.9 : 0;
        MdtBodySetPosition(body[i], placeOf(i) + rodLength * MeSin(angle), beam - rodLength * MeCos(angle), 0);
        MdtBodySetQuaternion(body[i], MeCos(angle / 2), 0, 0, MeSin(angle / 2));
        MdtBodySetLinearVelocity(body[i], 0, 0, 0);
        MdtBodySetAngularVelocity(body[i], 0, 0, 0);
        MdtBodyEnable(body[i]);
    }
    for (int i = 0; i < LINKS; i++)
        setLinked(i, i % 3 != 2);
}

/* Ties together what is apart, from the left. */
static void MEAPI join(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < LINKS; i++) {
        if (!isLinked(i)) {
            setLinked(i, 1);
            return;
        }
    }
}

static void MEAPI cut(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = LINKS - 1; i >= 0; i--) {
        if (isLinked(i)) {
            setLinked(i, 0);
            return;
        }
    }
}

static void MEAPI kick(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodyEnable(body[0]);
    MdtBodyAddImpulse(body[0], 4, 0, 0);
}

/* Bodies that are not simulated have no partition. */
static int countPartitions(int *sleeping) {
    int max = -1;
    *sleeping = 0;
    for (int i = 0; i < BODIES; i++) {
        const int p = MdtBodyIsEnabled(body[i]) ? MdtBodyGetPartition(body[i]) : -1;
        max = MeMAX(max, p);
        *sleeping += p < 0;
    }
    return max + 1;
}

static void showBodies(void) {
    for (int i = 0; i < BODIES; i++) {
        const int p = MdtBodyIsEnabled(body[i]) ? MdtBodyGetPartition(body[i]) : 7;
        RGraphicSetColor(ballG[i], RPalette[p < 0 ? 7 : p % 8]);
        MeVector3 at;
        MdtBodyGetPosition(body[i], at);
        const AcmeReal top[3] = {(float)placeOf(i), (float)beam, 0};
        const AcmeReal bottom[3] = {(float)at[0], (float)at[1], (float)at[2]};
        RGraphicLineMoveEnds(rodG[i], top, bottom);
    }
}

/* A spring that is not enabled is drawn as a point inside its ball. */
static void showLinks(void) {
    for (int i = 0; i < LINKS; i++) {
        MeVector3 at[2];
        MdtBodyGetPosition(body[i], at[0]);
        MdtBodyGetPosition(body[isLinked(i) ? i + 1 : i], at[1]);
        const AcmeReal from[3] = {(float)at[0][0], (float)at[0][1], (float)at[0][2]};
        const AcmeReal to[3] = {(float)at[1][0], (float)at[1][1], (float)at[1][2]};
        RGraphicLineMoveEnds(springG[i], from, to);
    }
}

static void showFigures(void) {
    char text[120];
    int sleeping, links = 0;
    const int partitions = countPartitions(&sleeping);
    for (int i = 0; i < LINKS; i++)
        links += isLinked(i);
    snprintf(text, sizeof text, "%d bodies    links %d    partitions %d    at rest %d", BODIES, links, partitions,
             sleeping);
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MdtWorldStep(world, step);
    showBodies();
    showLinks();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

/* Each body hangs from the world by a hinge: constraints to the world tie nothing together. */
static void createPendulum(int i) {
    MeMatrix3 inertia;
    body[i] = MdtBodyCreate(world);
    MdtMakeInertiaTensorSphere(1, radius, inertia);
    MdtBodySetInertiaTensor(body[i], inertia);
    MdtBodySetAngularVelocityDamping(body[i], (MeReal)0.3);
    MdtBodySetLinearVelocityDamping(body[i], (MeReal)0.3);
    MdtBodySetPosition(body[i], placeOf(i), beam - rodLength, 0);
    MdtHingeID hinge = MdtHingeCreate(world);
    MdtHingeSetBodies(hinge, body[i], 0);
    MdtHingeSetPosition(hinge, placeOf(i), beam, 0);
    MdtHingeSetAxis(hinge, 0, 0, 1);
    MdtHingeEnable(hinge);
}

static void createDynamics(void) {
    world = MdtWorldCreate(BODIES, BODIES + LINKS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0); /* so that every body has a partition all the time; key 5 switches it on */
    for (int i = 0; i < BODIES; i++)
        createPendulum(i);
    for (int i = 0; i < LINKS; i++) {
        link[i] = MdtSpringCreate(world);
        MdtSpringSetBodies(link[i], body[i], body[i + 1]);
        MdtSpringSetNaturalLength(link[i], spacing);
        MdtSpringSetStiffness(link[i], 6);
        MdtSpringSetDamping(link[i], (MeReal)0.1);
    }
}

static void MEAPI toggleRest(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtWorldSetAutoDisable(world, !MdtWorldGetAutoDisable(world));
    for (int i = 0; i < BODIES; i++)
        MdtBodyEnable(body[i]);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1}, grey[4] = {.45f, .47f, .50f, 1}, dark[4] = {.30f, .31f, .33f, 1};
    const AcmeVector3 lookAt = {0, 1.7f, 0};
    static MeMatrix4 beamTM;
    MeMatrix4TMMakeIdentity(beamTM);
    MeMatrix4TMSetPosition(beamTM, 0, beam + (MeReal)0.1, 0);
    RGraphicBoxCreate(rc, (float)(BODIES * spacing), .2f, .3f, grey, beamTM);
    for (int i = 0; i < BODIES; i++) {
        const AcmeReal nowhere[3] = {0, 0, 0};
        ballG[i] = RGraphicSphereCreate(rc, (float)radius, RPalette[0], MdtBodyGetTransformPtr(body[i]));
        rodG[i] = RGraphicLineCreate(rc, nowhere, nowhere, dark, 0);
        if (i < LINKS)
            springG[i] = RGraphicLineCreate(rc, nowhere, nowhere, RPalette[3], 0);
    }
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 14, .25f, .12f);
}

static void createControls(void) {
    static const char *const help[] = {
        "Bodies that are tied together are solved for together.",
        "One colour, one partition.",
        "$ACTION2 - start again",
        "$ACTION3 - join the next two",
        "$ACTION4 - cut the last link",
        "$ACTION5 - put to rest what does not move",
        "$UP - kick the first one",
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: Partitions");
    RRenderSetAppName(rc, "Partitions");
    RRenderCreateUserHelp(rc, help, 7);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
    RRenderSetActionNCallBack(rc, 3, join, 0);
    RRenderSetActionNCallBack(rc, 4, cut, 0);
    RRenderSetActionNCallBack(rc, 5, toggleRest, 0);
    RRenderSetUpCallBack(rc, kick, 0);
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

    atexit(cleanup);
    RRun(rc, Tick); /* does not return */
    return 0;
}
