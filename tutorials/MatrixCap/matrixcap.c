/* MatrixCap: a bound on the work for a partition (Dynamics guide, chapter 4, "Limiting the Matrix Size").
 *
 * A contact with friction gives the solver three rows, and the time for a partition grows with its rows. With a cap on
 * them the world leaves some out: first friction, then contacts between bodies, then contacts with the world, and of
 * each the shallowest first. The pyramid of balls has 30 contacts that carry and 10 between neighbours, 100 rows. Each
 * contact is drawn as a line, green with friction, yellow without, red when it is left out: a little is hardly seen,
 * but with too little the balls sink into each other.
 */
#include "Mdt.h"
#include "MeViewer.h"
#include "RMark.h"
#include "RParameter.h"
#include <stdio.h>
#include <stdlib.h>

enum { STOREYS = 5, BALLS = STOREYS * (STOREYS + 1) / 2, BASE = STOREYS + 1, MAX_CONTACTS = 4 * BALLS };

static const MeReal step = (MeReal)(1.0 / 60); /* s */
static const MeReal radius = (MeReal)0.5;      /* m */

static MdtWorldID world;
static MdtBodyID ball[BALLS];
static MdtContactID contact[MAX_CONTACTS];
static int contacts;
static MeReal cap = 100; /* rows */
static int rows[1];      /* of the one partition that there is, written by the world */
static MeReal startHeight;

static RRender *rc;

/* The fixed balls lie side by side, half in the ground. */
static void placeOfBase(int i, MeVector3 p) {
    p[0] = ((MeReal)i - (MeReal)STOREYS / 2) * 2 * radius;
    p[1] = p[2] = 0;
}

/* Each ball lies in the hollow of two below: a storey higher by sqrt(3) radii. */
static void placeOfBall(int storey, int i, MeVector3 p) {
    p[0] = ((MeReal)i - (MeReal)(STOREYS - 1 - storey) / 2) * 2 * radius;
    p[1] = (MeReal)(storey + 1) * radius * MeSqrt(3);
    p[2] = 0;
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtBodyID *next = ball;
    for (int storey = 0; storey < STOREYS; storey++) {
        for (int i = 0; i < STOREYS - storey; i++, next++) {
            MeVector3 p;
            placeOfBall(storey, i, p);
            MdtBodySetPosition(*next, p[0], p[1], p[2]);
            MdtBodySetQuaternion(*next, 1, 0, 0, 0);
            MdtBodySetLinearVelocity(*next, 0, 0, 0);
            MdtBodySetAngularVelocity(*next, 0, 0, 0);
            MdtBodyEnable(*next);
            startHeight = p[1];
        }
    }
}

static void MEAPI applyCap(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    MdtWorldSetMaxMatrixSize(world, (int)cap);
}

/* ---- contacts, made by hand ---- */

static void destroyContacts(void) {
    while (contacts > 0)
        MdtContactDestroy(contact[--contacts]);
}

/* Between a ball and another, or one of the fixed balls (no body), if they touch or nearly do. */
static void touch(MdtBodyID a, MdtBodyID b, const MeVector3 p, const MeVector3 q) {
    const MeReal margin = (MeReal)0.02;
    MeVector3 n;
    for (int i = 0; i < 3; i++)
        n[i] = p[i] - q[i];
    const MeReal distance = MeSqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (distance > 2 * radius + margin || contacts == MAX_CONTACTS)
        return;
    MdtContactID c = MdtContactCreate(world, a, b);
    MdtContactSetPosition(c, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    MdtContactSetNormal(c, n[0], n[1], n[2]);
    MdtContactSetPenetration(c, 2 * radius - distance);
    MdtContactSetRadius(c, 0, radius); /* round: the ball rolls */
    MdtContactSetRadius(c, 1, radius);
    MdtContactParamsSetSurface(MdtContactGetParams(c), (MeReal)0.5, 0);
    MdtContactEnable(c);
    contact[contacts++] = c;
}

static void createContacts(void) {
    for (int i = 0; i < BALLS; i++) {
        MeVector3 p, q;
        MdtBodyGetPosition(ball[i], p);
        for (int k = 0; k < BASE; k++) {
            placeOfBase(k, q);
            touch(ball[i], 0, p, q);
        }
        for (int k = 0; k < i; k++) {
            MdtBodyGetPosition(ball[k], q);
            touch(ball[i], ball[k], p, q);
        }
    }
}

/* ---- pictures and figures ---- */

/* From centre to centre would hide in the balls: a line across, in front of them. */
static void drawContacts(void) {
    RLineRemoveAll(rc);
    for (int i = 0; i < contacts; i++) {
        const int count = MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[i]));
        const float *color = RPalette[count > 1 ? 2 : count == 1 ? 4 : 3];
        MeVector3 p, n;
        MdtContactGetPosition(contact[i], p);
        MdtContactGetNormal(contact[i], n);
        for (int k = -2; k <= 2; k++) { /* some lines side by side, so that it can be seen */
            const float shift = .012f * (float)k, z = (float)radius * 1.02f;
            const AcmeVector3 from = {(float)(p[0] - (MeReal)0.3 * n[0]) + shift, (float)(p[1] - (MeReal)0.3 * n[1]),
                                      z};
            const AcmeVector3 to = {(float)(p[0] + (MeReal)0.3 * n[0]) + shift, (float)(p[1] + (MeReal)0.3 * n[1]), z};
            RLineAdd(rc, from, to, color[0], color[1], color[2]);
        }
    }
}

static void MEAPI nameColors(RRender *context, void *userdata) {
    static const float dark[4] = {.10f, .12f, .15f, 1};
    static const char *const names[3] = {"  left out", "  without friction: 1 row", "  with friction: 3 rows"};
    static const int color[3] = {3, 4, 2};
    (void)userdata;
    for (int i = 0; i < 3; i++) {
        const MeVector3 place = {(MeReal)1.6, (MeReal)3.7 + (MeReal)0.35 * (MeReal)i, 0};
        RMarkPoint(context, place, RPalette[color[i]], 12);
        RMarkText(context, place, names[i], dark);
    }
}

static void showFigures(void) {
    char text[160];
    int with[3] = {0, 0, 0};
    for (int i = 0; i < contacts; i++) {
        const int count = MdtConstraintGetRowCount(MdtContactQuaConstraint(contact[i]));
        with[count > 1 ? 2 : count]++;
    }
    snprintf(text, sizeof text,
             "cap %.0f    rows %d    contacts with friction %d, without %d, left out %d    the top has sunk by %.3f m",
             (double)cap, rows[0], with[2], with[1], with[0],
             (double)(startHeight - MdtBodyGetTransformPtr(ball[BALLS - 1])[3][1]));
    RRenderSetStatusText(rc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    destroyContacts();
    createContacts();
    MdtWorldStep(world, step);
    drawContacts();
    showFigures();
}

static void MEAPI_CDECL cleanup(void) {
    RRenderContextDestroy(rc);
    MdtWorldDestroy(world);
}

static void createDynamics(void) {
    MeMatrix3 inertia;
    world = MdtWorldCreate(BALLS, MAX_CONTACTS);
    MdtWorldSetGravity(world, 0, (MeReal)-9.8, 0);
    MdtWorldSetAutoDisable(world, 0);
    MdtWorldSetMatrixSizeLog(world, rows, 1);
    MdtMakeInertiaTensorSphere(1, radius, inertia);
    for (int i = 0; i < BALLS; i++) {
        ball[i] = MdtBodyCreate(world);
        MdtBodySetInertiaTensor(ball[i], inertia);
    }
    applyCap(0, 0);
}

static void createGraphics(void) {
    const float ground[4] = {.82f, .83f, .80f, 1};
    const AcmeVector3 lookAt = {0, 2.1f, 0};
    static MeMatrix4 baseTM[BASE];
    for (int i = 0; i < BASE; i++) {
        MeVector3 p;
        placeOfBase(i, p);
        MeMatrix4TMMakeIdentity(baseTM[i]);
        MeMatrix4TMSetPosition(baseTM[i], p[0], p[1], p[2]);
        RGraphicSphereCreate(rc, (float)radius, RPalette[7], baseTM[i]);
    }
    for (int i = 0; i < BALLS; i++)
        RGraphicSphereCreate(rc, (float)radius, RPalette[5], MdtBodyGetTransformPtr(ball[i]));
    RGraphicGroundPlaneCreate(rc, 60, 2, ground, 0);
    RCameraSetLookAt(rc, lookAt);
    RCameraSetView(rc, 8.5f, .2f, .12f);
    RRenderSetMarkCallBack(rc, nameColors, 0);
}

static void createControls(void) {
    static const char *const help[] = {
        "A pyramid of balls, solved with fewer and fewer rows.",
        "Green contacts have friction, yellow ones none, red ones are left out.",
        "$ACTION2 - start again",
    };
    static const RParameter parameters[] = {
        {"the cap", "rows", &cap, 10, 100, 10, .less = "Down", .more = "Up", .changed = applyCap},
    };
    RRenderSetWindowTitle(rc, "Karma tutorial: MatrixCap");
    RRenderSetAppName(rc, "MatrixCap");
    RRenderCreateUserHelp(rc, help, 3);
    RRenderCreateParameters(rc, parameters, 1);
    RRenderSetActionNCallBack(rc, 2, Reset, 0);
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
