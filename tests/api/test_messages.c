/* What a message names: the function that the program called, and no other.
 *
 * messages.py writes a call of every public function with bad input (messages_calls.c). Each is made with handles that
 * are null, of joints also with those of destroyed ones, and with live ones beside numbers that are none. Null and dead
 * handles get a warning and 0. Else it may be silent where nothing is wrong, it must not crash, and what it says begins
 * with its name, and nothing is said twice. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "karma_test.h"
#include "Mcd.h"
#include "Mdt.h"
#include "Mst.h"
#ifdef KARMA_HAS_VIEWER
#include "MeApp.h"
#endif

/* ---- live objects, of which a call may do away with any: they are made anew for each ---- */

#define JOINTS(DO)                                                                                                     \
    DO(BSJoint)                                                                                                        \
    DO(Hinge)                                                                                                          \
    DO(Prismatic)                                                                                                      \
    DO(Universal)                                                                                                      \
    DO(Angular3)                                                                                                       \
    DO(CarWheel)                                                                                                       \
    DO(Linear1)                                                                                                        \
    DO(Linear2)                                                                                                        \
    DO(FixedPath)                                                                                                      \
    DO(FPFOJoint)                                                                                                      \
    DO(RPROJoint)                                                                                                      \
    DO(Spring)                                                                                                         \
    DO(Spring6)                                                                                                        \
    DO(ConeLimit)                                                                                                      \
    DO(Skeletal)                                                                                                       \
    DO(Gear)                                                                                                           \
    DO(Pulley)                                                                                                         \
    DO(Mimic)                                                                                                          \
    DO(UserConstraint)                                                                                                 \
    DO(ContactGroup)

static struct {
    MstUniverseID universe;
    MdtWorldID world;
    McdFrameworkID frame;
    McdSpaceID space;
    MstBridgeID bridge;
    MdtContactParamsID params;
    McdModelID model;
    MdtBodyID body, other;
    McdGeometryID geometry;
    MdtContactID contact;
    McdModelPairID pair;
#define JOINT(Joint) Mdt##Joint##ID a##Joint;
    JOINTS(JOINT)
#undef JOINT
#ifdef KARMA_HAS_VIEWER
    RRender *rc;
    MeApp *app;
    RGraphic *graphic;
    RMenu *menu;
#endif
} live;

#define LIVE_MstUniverseID        live.universe
#define LIVE_MdtWorldID           live.world
#define LIVE_McdFrameworkID       live.frame
#define LIVE_McdFramework_pointer live.frame
#define LIVE_McdSpaceID           live.space
#define LIVE_MstBridgeID          live.bridge
#define LIVE_MdtContactParamsID   live.params
#define LIVE_McdModelID           live.model
#define LIVE_MdtBodyID            live.body
#define LIVE_McdGeometryID        live.geometry
#define LIVE_McdModelPairID       live.pair
#define LIVE_MdtConstraintID      MdtHingeQuaConstraint(live.aHinge)
#define LIVE_MdtLimitID           MdtHingeGetLimit(live.aHinge)
#define LIVE_MdtSingleLimitID     MdtLimitGetLowerLimit(MdtHingeGetLimit(live.aHinge))
#define LIVE_MdtContactID         live.contact
#define LIVE_MdtBSJointID         live.aBSJoint
#define LIVE_MdtHingeID           live.aHinge
#define LIVE_MdtPrismaticID       live.aPrismatic
#define LIVE_MdtUniversalID       live.aUniversal
#define LIVE_MdtAngular3ID        live.aAngular3
#define LIVE_MdtCarWheelID        live.aCarWheel
#define LIVE_MdtLinear1ID         live.aLinear1
#define LIVE_MdtLinear2ID         live.aLinear2
#define LIVE_MdtFixedPathID       live.aFixedPath
#define LIVE_MdtFPFOJointID       live.aFPFOJoint
#define LIVE_MdtRPROJointID       live.aRPROJoint
#define LIVE_MdtSpringID          live.aSpring
#define LIVE_MdtSpring6ID         live.aSpring6
#define LIVE_MdtConeLimitID       live.aConeLimit
#define LIVE_MdtSkeletalID        live.aSkeletal
#define LIVE_MdtGearID            live.aGear
#define LIVE_MdtPulleyID          live.aPulley
#define LIVE_MdtMimicID           live.aMimic
#define LIVE_MdtUserConstraintID  live.aUserConstraint
#define LIVE_MdtContactGroupID    live.aContactGroup
#define LIVE_RRender_pointer      live.rc
#define LIVE_MeApp_pointer        live.app
#define LIVE_RGraphic_pointer     live.graphic
#define LIVE_RMenu_pointer        live.menu

static void makeLive(void) {
    live.universe = MstUniverseCreate(&MstUniverseDefaultSizes);
    live.world = MstUniverseGetWorld(live.universe);
    live.frame = MstUniverseGetFramework(live.universe);
    live.space = MstUniverseGetSpace(live.universe);
    live.bridge = MstUniverseGetBridge(live.universe);
    live.params = MstBridgeGetContactParams(live.bridge, 0, 0);
    live.geometry = McdBoxCreate(live.frame, 1, 1, 1);
    live.model = MstModelAndBodyCreate(live.universe, live.geometry, 1);
    live.body = McdModelGetBody(live.model);
    live.other = MdtBodyCreate(live.world);
    live.pair = McdModelPairCreate(live.model, MstModelAndBodyCreate(live.universe, live.geometry, 1));
#define JOINT(Joint)                                                                                                   \
    live.a##Joint = Mdt##Joint##Create(live.world);                                                                    \
    Mdt##Joint##SetBodies(live.a##Joint, live.body, live.other);
    JOINTS(JOINT)
#undef JOINT
    live.contact = MdtContactCreateBetween(live.world, live.body, live.other);
#ifdef KARMA_HAS_VIEWER
    const char *words[] = {"test", "-null"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(2, words);
    live.rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    live.app = MeAppCreateFromUniverse(live.universe, live.rc);
    live.graphic = RGraphicBoxCreate(live.rc, 1, 1, 1, RPalette[0], 0);
    live.menu = RMenuCreate(live.rc, "menu");
#endif
}

/* ---- calls ---- */

typedef enum { NOTHING, DEAD, HALF, NUMBERS } Way;
static const char *const wayNames[] = {"NOTHING", "DEAD", "HALF", "NUMBERS"};

typedef struct {
    const char *name;
    Way way;
    void (*call)(void);
    int needsHandle; /* null or dead, it is to warn, and to give 0 */
} Call;

/* What messages.py leaves out, a function or all of a header's, and why:
    LEAVE(MeMath, "vectors and matrices: arithmetic, without checks")
    LEAVE(MePrecision, "the same")
    LEAVE(MeAssert, "ends the program, as asked")
    LEAVE(MeProfileSetOutputParameters, "takes a structure")
    LEAVE(MeProfileStartTiming, "takes a structure")
    LEAVE(MeMessage, "says what it is given")
    LEAVE(MCDGEOMETRY_CHECK_ISVALID, "says what the program wrote")
 */

/* What the calls of a child process said, in memory that outlives it. */
typedef struct {
    size_t at;
    int said, wrong, repeated, given;
    char text[1024];
    int bad, silent;
} Record;

static Record *record;

/* Is what a function gave for nothing 0? */
static void noteZero(const void *what, size_t size) {
    for (size_t i = 0; i < size; i++)
        record->given |= ((const unsigned char *)what)[i];
}

#include "messages_calls.c"

/* Functions that programs call by another name: that of a macro which picks one by the arguments. */
static const char *const calledAs[][2] = {
    {"McdSpaceGetNextPairs", "McdSpaceGetPairs"},
    {"McdSpaceGetNextTransitions", "McdSpaceGetTransitions"},
    {"MdtContactCreateBetween", "MdtContactCreate"},
    {"MstHandleTransitionsOf", "MstHandleTransitions"},
    {"RRenderSetActionCallBack", "RRenderSetActionNCallBack"},
    {"RRenderSetActionCallBackNoData", "RRenderSetActionNCallBack"},
    {"RRenderSetButtonCallBack", "RRenderSetUpCallBack"}, /* of button 0 */
    {"RRenderSetButtonCallBackNoData", "RRenderSetUpCallBack"},
    {"RRenderSetMouseCallBackWithText", "RRenderSetMouseCallBack"},
    {"RRenderSetJoystickCallBackWithText", "RRenderSetJoystickCallBack"},
    {"RRunWithData", "RRun"},
    {"RRunWithoutData", "RRun"},
    {"RUserHelpOfChars", "RRenderCreateUserHelp"},
    {"RUserHelpOfConstChars", "RRenderCreateUserHelp"},
};

static const char *nameOf(const Call *c) {
    for (size_t i = 0; i < sizeof calledAs / sizeof calledAs[0]; i++)
        if (strcmp(c->name, calledAs[i][0]) == 0)
            return calledAs[i][1];
    return c->name;
}

static void MEAPI onMessage(const int level, const char *const format, va_list ap) {
    (void)level;
    char text[sizeof record->text];
    const char *name = nameOf(&calls[record->at]);
    vsnprintf(text, sizeof text, format, ap);
    const size_t length = strlen(name);
    if (strncmp(text, name, length) != 0 || text[length] != ':')
        record->wrong++;
    record->repeated += record->said++ > 0 && strcmp(text, record->text) == 0;
    memcpy(record->text, text, sizeof text);
}

/* Of nothing these are silent: it is destroyed, is not valid, and is no constraint. */
static const char *const quiet[] = {"*Destroy",        "*IsValid",          "*QuaConstraint", "*GetTypeName",
                                    "McdGeometryInit", "McdModelGetSerial", "MeAppEnd",       "RRenderRefuseOptions"};

/* These read the vector, or give another number for nothing: -1, a default, the code of a failure. */
static const char *const giving[] = {"McdAggregateGetBSphere",
                                     "McdGeometryGetBSphere",
                                     "McdGeometryGetType",
                                     "McdGeometryGetTypeId",
                                     "McdModelGetBSphere",
                                     "McdModelGetGeometryType",
                                     "McdRGHeightFieldGetBSphere",
                                     "McdTriangleListCreate",
                                     "McdTriangleListGetBSphere",
                                     "MdtBodyGetPartition",
                                     "MdtBodyGetVelocityAtPoint",
                                     "MdtContactGetRim",
                                     "MdtContactParamsGetPrimaryFrictionModel",
                                     "MdtContactParamsGetSecondaryFrictionModel",
                                     "MdtContactParamsGetType",
                                     "MdtConvertPositionVector",
                                     "MdtConvertVector",
                                     "MdtRPROJointSetRelativeAngularVelocity",
                                     "MdtWorldGetIntegratorOrder",
                                     "MdtWorldGetSubSteps",
                                     "MdtWorldGetWorkerCount",
                                     "MeAppFindClickDir",
                                     "MeAppFindClickPos",
                                     "MeAppHullCreate",
                                     "MeAppPickMcdModel",
                                     "RGraphicLineMoveEnds",
                                     "RGraphicSetTexture",
                                     "RRenderGetGroundLook",
                                     "RRenderGetPictureQuality",
                                     "RRenderTextureCreate"};

static MeBool isOneOf(const char *name, const char *const list[], size_t count) {
    for (size_t i = 0; i < count; i++) {
        const size_t end = strlen(list[i]) - 1, length = strlen(name);
        if (strcmp(name, list[i]) == 0 ||
            (*list[i] == '*' && length >= end && !strcmp(name + length - end, list[i] + 1)))
            return METRUE;
    }
    return MEFALSE;
}

static MeBool isAnswerToNothing(const Call *c) {
    return isOneOf(c->name, quiet, sizeof quiet / sizeof *quiet) ||
           (record->said && (!record->given || isOneOf(c->name, giving, sizeof giving / sizeof *giving)));
}

static void judge(void) {
    const Call *c = &calls[record->at];
    if (record->wrong || record->repeated) {
        fprintf(stderr, "%s (%s) says %s: %s\n", c->name, wayNames[c->way],
                record->wrong ? "under another name" : "twice", record->text);
        record->bad++;
    }
    if (c->needsHandle && !isAnswerToNothing(c)) {
        fprintf(stderr, "%s (%s) %s\n", c->name, wayNames[c->way], record->said ? "gives something" : "says nothing");
        record->bad++;
    }
    record->silent += !record->said;
    record->said = record->wrong = record->repeated = record->given = 0;
}

enum { BATCH = 50, COUNT = sizeof calls / sizeof calls[0] };

static void callSome(void) {
    const size_t end = record->at + BATCH < COUNT ? record->at + BATCH : COUNT;
    for (; record->at < end; record->at++) {
        const Call *c = &calls[record->at];
        if (c->way != NOTHING)
            makeLive();
        if (c->way == DEAD) {
#define JOINT(Joint) Mdt##Joint##Destroy(live.a##Joint);
            JOINTS(JOINT)
#undef JOINT
        }
        MeSetWarningHandler(onMessage);
        MeSetFatalErrorHandler(onMessage);
        c->call();
        MeSetWarningHandler(0);
        judge();
    }
    _exit(0);
}

TEST(names_the_function_called) {
    record = mmap(NULL, sizeof *record, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ck_assert_ptr_ne(record, MAP_FAILED);
    int crashes = 0;
    for (record->at = 0; record->at < COUNT;) {
        fflush(NULL);
        const pid_t child = fork();
        ck_assert_int_ge(child, 0);
        if (child == 0)
            callSome();
        int status;
        ck_assert_int_eq(waitpid(child, &status, 0), child);
        if (status == 0)
            continue;
        fprintf(stderr, "%s (%s) ends the program\n", calls[record->at].name, wayNames[calls[record->at].way]);
        crashes++;
        record->at++;
        record->said = record->wrong = record->repeated = record->given = 0;
    }
    printf("%d calls, %d silent\n", (int)COUNT, record->silent);
    ck_assert_int_eq(crashes, 0);
    ck_assert_int_eq(record->bad, 0);
    munmap(record, sizeof *record);
}
