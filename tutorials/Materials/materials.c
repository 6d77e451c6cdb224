/* Materials: what touches what decides how it slides and bounces (User Guide, chapter 5, "The Bridge"; MstEvents.h).
 *
 * Three blocks of ice, wood and rubber on one slope, each on its lane. The bridge's table says for each pair of
 * materials which friction and restitution it has; a callback gives the belt at the foot its speed. Events do the rest:
 * sparks fly where something begins to touch hard enough, and the gate over the belt is a sensor, which lights up while
 * something is in it. What falls off the belt is put on the slope again. Watch the rubber stay, the wood slide and the
 * ice race; and two balls, of wood and of rubber, bounce beside it.
 */
#include "play.h"
#include <stdio.h>

enum { LANES = 3, BALLS = 2, SPARKS = 24, SPARK_FRAMES = 14, RAYS = 6 };
enum { SOLID = 1, ZONE = 2, GROUND = 4 }; /* categories */

static const double slope = .36, beltSpeed = 1.6; /* rad, m/s */
static const float color[LANES][4] = {{.55f, .80f, .95f, 1}, {.72f, .50f, .28f, 1}, {.22f, .22f, .26f, 1}};
static const float dark[4] = {.55f, .57f, .60f, 1}, bright[4] = {1, .80f, .10f, 1};

/* Where something was hit. */
typedef struct Spark {
    MeVector3 at, normal;
    double size; /* m */
    int age;     /* frames */
} Spark;

static MstMaterialID material[LANES], belt;
static McdModelID block[LANES], ball[BALLS], zone;
static MeMatrix4 slopeTM, beltTM, padTM, zoneTM;
static RGraphic *gate;
static Spark spark[SPARKS];
static int nextSpark, inZone, passed, hits;
static double hardest;

/* ---- what is where ---- */

static void placeBlock(int i) {
    const double along = -3.4, up = .15 + .25 + .001;
    playPlace(block[i], (MeReal)((double)slopeTM[3][0] + along * cos(slope) + up * sin(slope)),
              (MeReal)((double)slopeTM[3][1] - along * sin(slope) + up * cos(slope)), (MeReal)(1.5 * (i - 1)), 2,
              (MeReal)-slope);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < LANES; i++)
        placeBlock(i);
    for (int i = 0; i < BALLS; i++)
        playPlace(ball[i], (MeReal)(-3 + 1.4 * i), 4, (MeReal)4.2, 0, 0);
    for (int i = 0; i < SPARKS; i++)
        spark[i].age = SPARK_FRAMES;
    passed = hits = 0;
    hardest = 0;
}

static void MEAPI dropBalls(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < BALLS; i++)
        playPlace(ball[i], (MeReal)(-3 + 1.4 * i), 4, (MeReal)4.2, 0, 0);
}

static double heightOf(McdModelID m) {
    MeVector3 p;
    McdModelDynamicsGetPosition(m, p);
    return (double)p[1];
}

static double speedOf(McdModelID m) {
    MeVector3 v;
    McdModelDynamicsGetLinearVelocity(m, v);
    return (double)MeVector3Magnitude(v);
}

/* What has come off the belt lies on the floor. */
static void bringBack(void) {
    for (int i = 0; i < LANES; i++)
        if (heightOf(block[i]) < .6 && speedOf(block[i]) < 1)
            placeBlock(i);
}

/* ---- events ---- */

static void addSpark(const MstEvent *e) {
    Spark *s = &spark[nextSpark];
    nextSpark = (nextSpark + 1) % SPARKS;
    MeVector3Copy(s->at, e->position);
    MeVector3Copy(s->normal, e->normal);
    s->size = .12 * MeMIN((double)e->approachSpeed, 8);
    s->age = 0;
}

static void lookAtEvents(void) {
    int count;
    const MstEvent *e = MstUniverseGetEvents(playUniverse, &count);
    for (int i = 0; i < count; i++, e++) {
        if (e->isSensor) {
            inZone += (e->kind == MstEventBegin) - (e->kind == MstEventEnd);
            passed += e->kind == MstEventEnd;
        } else if (e->kind == MstEventBegin && e->approachSpeed > 1) {
            addSpark(e);
            hits++;
            hardest = MeMAX(hardest, (double)e->impulse);
        }
    }
    RGraphicSetColor(gate, inZone > 0 ? bright : dark);
}

/* Rays in the plane of the hit, a little upward, that fly outward and go out. */
static void drawSpark(const Spark *s) {
    const double out = s->size * (.3 + 1.7 * s->age / SPARK_FRAMES), in = s->size * 1.6 * s->age / SPARK_FRAMES;
    const float glow = 1 - (float)s->age / SPARK_FRAMES;
    MeVector3 u, v;
    MeVector3PlaneSpace(s->normal, u, v);
    for (int r = 0; r < RAYS; r++) {
        const double turn = 2 * (double)ME_PI * (double)r / RAYS, c = cos(turn), w = sin(turn);
        AcmeVector3 a, b;
        for (int k = 0; k < 3; k++) {
            const double way = c * (double)u[k] + w * (double)v[k] + .6 * fabs((double)s->normal[k]);
            a[k] = (AcmeReal)((double)s->at[k] + in * way);
            b[k] = (AcmeReal)((double)s->at[k] + out * way);
        }
        RLineAdd(playRc, a, b, 1, .35f + .45f * glow, .1f * glow);
    }
}

static void drawSparks(void) {
    RLineRemoveAll(playRc);
    for (int i = 0; i < SPARKS; i++)
        if (spark[i].age++ < SPARK_FRAMES)
            drawSpark(&spark[i]);
}

static void showFigures(void) {
    char text[240];
    snprintf(text, sizeof text,
             "ice %.3f m/s    wood %.3f m/s    rubber %.3f m/s    in the gate %d    passed %d    hits %d    hardest "
             "%.2f N s",
             speedOf(block[0]), speedOf(block[1]), speedOf(block[2]), inZone, passed, hits, hardest);
    RRenderSetStatusText(playRc, text);
}

static void MEAPI Tick(RRender *context) {
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    lookAtEvents();
    bringBack();
    drawSparks();
    showFigures();
}

/* ---- the table ---- */

static MeBool MEAPI moveBelt(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    (void)result, (void)colC;
    MdtContactSetWorldVelocity(dynC, (MeReal)beltSpeed, 0, 0);
    return METRUE;
}

static void createMaterials(void) {
    static const double friction[LANES] = {.02, .25, .9}, restitution[LANES] = {.1, .35, .85};
    const MstBridgeID b = playUniverse->bridge;
    for (int i = 0; i < LANES; i++)
        material[i] = MstBridgeGetNewMaterial(b);
    belt = MstBridgeGetNewMaterial(b);
    for (int i = 0; i < LANES; i++) {
        for (int k = 0; k <= LANES; k++) { /* with each other, and with the ground, the default material */
            const MdtContactParamsID p = playContact(material[i], k < LANES ? material[k] : 0);
            *p = *playContact(0, 0);
            MdtContactParamsSetFrictionCoeffecient(p, (MeReal)(k < LANES ? friction[i] * friction[k] : friction[i]));
            MdtContactParamsSetRestitution(p, (MeReal)restitution[i]);
        }
        *playContact(material[i], belt) = *playContact(0, 0);
        MdtContactParamsSetFrictionCoeffecient(playContact(material[i], belt), 1);
        MstBridgeSetPerContactCB(b, material[i], belt, moveBelt);
    }
}

/* ---- the scene ---- */

static McdModelID makeGround(double x, double y, double z, double wide, double high, double deep, MeMatrix4 tm,
                             const float c[4]) {
    const MeReal turn = tm == slopeTM ? (MeReal)-slope : 0;
    MeMatrix3 R;
    MeMatrix3MakeRotationZ(R, turn);
    MeMatrix4TMMakeFromRotationAndPosition(tm, R, (MeReal)x, (MeReal)y, (MeReal)z);
    const McdModelID m = playFixed(McdBoxCreate(playUniverse->frame, (MeReal)wide, (MeReal)high, (MeReal)deep), tm, c);
    McdModelSetFilter(m, GROUND, SOLID);
    return m;
}

static void createGround(void) {
    static const float stone[4] = {.70f, .70f, .67f, 1}, rubberBelt[4] = {.33f, .36f, .34f, 1};
    McdModelSetFilter(playFloor(), GROUND, SOLID);
    makeGround(-4.2, 2.33, 0, 8, .3, 4.6, slopeTM, stone);
    McdModelSetMaterial(makeGround(2, .65, 0, 5.2, .3, 4.6, beltTM, rubberBelt), (int)belt);
    makeGround(-2.3, .1, 4.2, 4, .2, 2, padTM, stone);
}

/* The gate: a model without a body that is in the space, and not frozen, so that it sees what sleeps, too. */
static void createZone(void) {
    const McdSpaceID space = playUniverse->space;
    const McdGeometryID box = McdBoxCreate(playUniverse->frame, (MeReal)0.9, (MeReal)1.3, (MeReal)4.8);
    MeMatrix4TMMakeIdentity(zoneTM);
    MeVector3Set(zoneTM[3], 2, (MeReal)1.5, 0);
    zone = McdModelCreate(box);
    McdModelSetTransformPtr(zone, zoneTM);
    McdModelSetSensor(zone, METRUE);
    McdModelSetFilter(zone, ZONE, SOLID);
    McdSpaceInsertModel(space, zone);
    gate = RGraphicBoxCreate(playRc, .9f, 1.3f, 4.8f, dark, zoneTM);
    RGraphicSetWireframe(gate, METRUE);
}

static void createModels(void) {
    const McdFrameworkID f = playUniverse->frame;
    const McdGeometryID brick = McdBoxCreate(f, (MeReal)0.9, (MeReal)0.5, (MeReal)0.8);
    const McdGeometryID sphere = McdSphereCreate(f, (MeReal)0.35);
    createGround();
    createZone();
    for (int i = 0; i < LANES; i++) {
        block[i] = playModel(brick, 5, 0, 0, 0, color[i]);
        McdModelSetMaterial(block[i], (int)material[i]);
    }
    for (int i = 0; i < BALLS; i++) {
        ball[i] = playModel(sphere, 5, 0, 0, 0, color[i + 1]);
        McdModelSetMaterial(ball[i], (int)material[i + 1]);
    }
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "Ice, wood and rubber; sparks where they hit; a gate that sees them.",
        "$ACTION2 - begin again",
        "$ACTION3 - drop the balls again",
    };
    if (!playStart(argc, argv, "Materials", LANES + BALLS))
        return 1;
    createMaterials();
    createModels();
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, dropBalls, 0);
    playCamera(-1.2f, 1.4f, .6f, 15, .35f, .35f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
