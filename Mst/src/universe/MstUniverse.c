/* Universes: collision and dynamics in one. */
#include "MstUniverse.h"
#include "MstEvents.h"
#include "McdFrame.h"
#include "McdAll.h"
#include "MdtDefaults.h"
#include "MdtWorld.h"
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MeProfile.h"
#include "MeTeam.h"
#include "mover/mst_mover_i.h"
#include "step/mst_step_i.h"
#include "universe/mst_universe_i.h"
#include "vehicle/mst_vehicle_i.h"

const MstUniverseSizes MstUniverseDefaultSizes = {100, 500, 0, 100, 500, 100, 10, 1, 1};
const MstUniverseSizes MstUniverseGrowingSizes = {0, 0, 0, 0, 0, 0, 0, 1, 1};

typedef struct MstUniverseRecord {
    MstUniverse universe; /* the public part: first */
    MeU32 magic;
    MeHandle handle;
    MstStepHook *hook; /* called around each step; null: none */
    MeBool hasWarnedOfLongStep;
} MstUniverseRecord;

static MeBool isUniverse(MstUniverseID u, const char *function) {
    if (u && MST_IS_KNOWN(u, MST_UNIVERSE) && ((const MstUniverseRecord *)u)->magic == MST_UNIVERSE)
        return METRUE;
    mst_warnGone(u, "universe", function);
    return MEFALSE;
}

static MeBool isBridge(const MstUniverse *u) {
    return u->bridge && MeHandleIsLive(u->bridge, MST_BRIDGE);
}

/* Name of the first member that the program has destroyed; null if there is none. */
static const char *missingMember(const MstUniverse *u) {
    return !MdtWorldIsValid(u->world)       ? "world"
           : !McdFrameworkIsValid(u->frame) ? "framework"
           : !McdSpaceIsValid(u->space)     ? "space"
           : !isBridge(u)                   ? "bridge"
                                            : 0;
}

static MeBool hasAllMembers(const MstUniverse *u, const char *function) {
    const char *member = missingMember(u);
    if (member)
        MeWarning(1, "%s: the universe's %s has been destroyed; it ends with the universe: see MstUniverseDestroy",
                  function, member);
    return !member;
}

/* Whether no stage of the bridge, framework or world is active. False: with a message. */
static MeBool areStagesFree(const MstUniverse *u, const char *function) {
    return (!isBridge(u) || MeStageIsFree(&((MstBridgeRecord *)u->bridge)->stage, function)) &&
           (!McdFrameworkIsValid(u->frame) || MeStageIsFree(McdFrameworkGetStage(u->frame), function)) &&
           (!MdtWorldIsValid(u->world) || MeStageIsFree(MdtWorldGetStage(u->world), function));
}

MeBool mst_universeIsFree(MstUniverseID u, const char *function) {
    return isUniverse(u, function) && hasAllMembers(u, function) && areStagesFree(u, function) &&
           MeProgramMayChange(function);
}

/* Destroys the members that exist: not all may have been created, and the program may have destroyed some. */
static void destroyMembers(MstUniverse *u) {
    mst_vehiclesDestroy(u);
    mst_moversLeave(u);
    if (McdSpaceIsValid(u->space))
        McdSpaceDestroy(u->space);
    if (McdFrameworkIsValid(u->frame)) {
        McdFrameworkDestroyAllModelsAndGeometries(u->frame);
        McdTerm(u->frame);
    }
    if (isBridge(u))
        MstBridgeDestroy(u->bridge);
    if (MdtWorldIsValid(u->world))
        MdtWorldDestroy(u->world);
    MstStepHook *hook = ((MstUniverseRecord *)u)->hook;
    if (hook)
        hook->destroy(hook);
    MeHandleLeave(&((MstUniverseRecord *)u)->handle);
    ((MstUniverseRecord *)u)->magic = 0;
    MeMemoryGive(u);
}

/* A size in the form of the members' limits. */
static unsigned int limitOf(unsigned int size) {
    return size > 0 ? size : MeNoLimit;
}

static void createCollision(MstUniverse *u) {
    const MstUniverseSizes *sizes = &u->sizes;
    u->frame = McdInit((int)sizes->collisionUserGeometryTypesMaxCount, (int)limitOf(sizes->collisionModelsMaxCount),
                       (int)limitOf(sizes->collisionGeometryInstancesMaxCount), sizes->lengthScale);
    if (!u->frame)
        return;
    McdAllRegisterTypes(u->frame);
    McdAllRegisterInteractions(u->frame);
    u->space = McdSpaceAxisSortCreate(u->frame, McdAllAxes, (int)limitOf(sizes->collisionModelsMaxCount),
                                      (int)limitOf(sizes->collisionPairsMaxCount));
}

/* epsilon = sag gamma / (F h²), where a load of a million times the mass scale, under 10 m/s² and in steps of 1/60 s,
 * sags by 1e-7 of the length scale. */
double mst_epsilonForSizes(const MstUniverseSizes *sizes) {
    const double sag = 1e-7 * (double)sizes->lengthScale, F = 10 * 1e6 * (double)sizes->massScale, h = 1. / 60;
    return sag * MDTWORLD_DEFAULT_GAMMA / (F * h * h);
}

static void createMembers(MstUniverse *u) {
    const MstUniverseSizes *sizes = &u->sizes;
    u->world = MdtWorldCreate(limitOf(sizes->dynamicBodiesMaxCount), limitOf(sizes->dynamicConstraintsMaxCount),
                              sizes->lengthScale, sizes->massScale);
    if (u->world)
        createCollision(u);
    if (u->space)
        u->bridge = MstBridgeCreate(u->frame, limitOf(sizes->materialsMaxCount));
    if (u->bridge)
        McdSpaceSetCollider(u->space, u->bridge);
}

#define MEMBER(member) "MstUniverseSizes." #member

/* Makes messages about full pools name the universe's sizes. */
static void nameLimits(MstUniverse *u) {
    MdtWorldRenameLimits(u->world, MEMBER(dynamicBodiesMaxCount), MEMBER(dynamicConstraintsMaxCount));
    McdFrameworkRenameLimits(u->frame, MEMBER(collisionUserGeometryTypesMaxCount), MEMBER(collisionModelsMaxCount),
                             MEMBER(collisionGeometryInstancesMaxCount));
    McdSpaceRenameLimits(u->space, MEMBER(collisionModelsMaxCount), MEMBER(collisionPairsMaxCount));
    MeLimitRename(&((MstBridgeRecord *)u->bridge)->materialLimit, MEMBER(materialsMaxCount));
}

MstUniverseID MEAPI MstUniverseCreate(const MstUniverseSizes *const sizes) {
    if (!MeProgramMayChange("MstUniverseCreate"))
        return 0;
    MstUniverseRecord *record = MeMemoryTakeZeroed(1, sizeof *record, "MstUniverseCreate", "a universe");
    if (!record)
        return 0;
    MstUniverse *u = &record->universe;
    u->sizes = sizes ? *sizes : MstUniverseDefaultSizes;
    const char *before = MeMessagesAs("MstUniverseCreate");
    createMembers(u);
    MeMessagesAs(before);
    record->magic = MST_UNIVERSE;
    MeHandleEnter(&record->handle, record, MST_UNIVERSE);
    if (!u->bridge) {
        MeWarning(1, "MstUniverseCreate: an object of it could not be created with these sizes");
        destroyMembers(u);
        return 0;
    }
    MEASSERT(u->world && u->frame && u->space);
    MdtWorldSetEpsilon(u->world, (MeReal)mst_epsilonForSizes(&u->sizes));
    nameLimits(u);
    McdSpaceSetLookAhead(u->space, (MeReal)(1. / 60)); /* until the first step */
    MdtWorldSetMinSafeTime(u->world, (MeReal)1e-9);    /* fast bodies are stopped at their time of impact */
    MstSetWorldHandlers(u->world);
    return u;
}

void MEAPI MstUniverseDestroy(const MstUniverseID u) {
    if (u && !MeHandleIsLive(u, MST_UNIVERSE))
        mst_warnGone(u, "universe", "MstUniverseDestroy");
    else if (u && areStagesFree(u, "MstUniverseDestroy"))
        destroyMembers(u);
}

static void updateBoxes(McdSpaceID s, MeReal step) {
    MeProfileStartSection("Collision", 0);
    MeProfileStartSection("Boxes", 0);
    McdSpacePathUpdateAll(s, step);
    MeProfileEndSection("Boxes");
    MeProfileEndSection("Collision");
}

/* Warns, once, if a body dropped from rest would fall farther than the length scale in one step, and so pass through
 * floors: usually the program gives the step in another unit. */
static void warnOfLongStep(MstUniverseRecord *u, double step) {
    MeVector3 g;
    MdtWorldGetGravity(u->universe.world, g);
    const double fall = 0.5 * (double)MeVector3Magnitude(g) * step * step;
    if (u->hasWarnedOfLongStep || fall <= (double)u->universe.sizes.lengthScale)
        return;
    u->hasWarnedOfLongStep = METRUE;
    MeWarning(
        1,
        "MstUniverseStep: the step is %g s, in which a body falls %g m: things will go through each other. Steps are "
        "in seconds, 1/60 as a rule",
        step, fall);
}

/* Makes a step. Active stages defer or refuse removals of the universe's objects until its end. */
static void advance(MstUniverse *u, MeReal step) {
    MstBridgeRecord *bridge = (MstBridgeRecord *)u->bridge;
    MeStage *const guarded[] = {McdFrameworkGetStage(u->frame), MdtWorldGetStage(u->world)};
    const char *before = MeCallerSet("MstUniverseStep");
    MEASSERT(McdFrameworkGetModelCount(u->frame) >= McdSpaceGetModelCount(u->space));
    for (int i = 0; i < 2; i++)
        MeStageBegin(guarded[i], 0);
    McdSpaceSetLookAhead(u->space, step);
    MeTeam *team = MdtWorldGetTeam(u->world);
    McdSpaceSetTeam(u->space, team);
    MeTeamKeep(team);
    MdtWorldApplyImpulses(u->world, step);
    mst_followMoved(u->world, step);
    mst_vehiclesFollow(u);
    updateBoxes(u->space, step);
    mst_updateContacts(bridge, u->space, u->world);
    mst_vehiclesBegin(u, step);
    mst_stepWorld(u, step);
    mst_vehiclesEnd(u);
    MEASSERT(bridge->substep == 0);
    MeTeamRelease(team);
    McdSpaceSetTeam(u->space, 0); /* the program may set another one until the next step */
    mst_updateEvents(bridge, u->world);
    for (int i = 0; i < 2; i++)
        MeStageEnd(guarded[i], 0);
    MeCallerSet(before);
}

/* Makes a step, for a hook that has called functions of the program. False: these have destroyed a member. */
static MeBool advanceWholeStep(MstUniverse *u, MeReal step) {
    if (!hasAllMembers(u, "MstUniverseStep"))
        return MEFALSE;
    advance(u, step);
    return METRUE;
}

void MEAPI MstUniverseStep(const MstUniverseID u, const MeReal step) {
    if (!isUniverse(u, "MstUniverseStep") || !hasAllMembers(u, "MstUniverseStep") ||
        !areStagesFree(u, "MstUniverseStep"))
        return;
    if (!(step >= (MeReal)FLT_MIN && step <= (MeReal)FLT_MAX)) {
        MeWarning(1, "MstUniverseStep: the step is %g: it must be positive; nothing is changed", (double)step);
        return;
    }
    warnOfLongStep((MstUniverseRecord *)u, (double)step);
    MeStage *stage = &((MstBridgeRecord *)u->bridge)->stage;
    MeStageBegin(stage, MST_GUARD_BRIDGE);
    MstStepHook *hook = ((MstUniverseRecord *)u)->hook;
    if (hook)
        hook->step(hook, u, step, advanceWholeStep);
    else
        advance(u, step);
    MeStageEnd(stage, MST_GUARD_BRIDGE);
}

MstStepHook **mst_universeHook(MstUniverseID u, const char *function) {
    return isUniverse(u, function) ? &((MstUniverseRecord *)u)->hook : 0;
}

const MstEvent *MEAPI MstUniverseGetEvents(const MstUniverseID u, int *count) {
    if (isUniverse(u, "MstUniverseGetEvents"))
        return MstBridgeGetEvents(u->bridge, count);
    if (count)
        *count = 0;
    return 0;
}

/* A function that returns a member of a universe; null, with a warning, for a bad handle. */
#define MEMBER_GETTER(Type, function, member)                                                                          \
    Type MEAPI function(const MstUniverseID u) {                                                                       \
        return isUniverse(u, __func__) ? u->member : 0;                                                                \
    }

MEMBER_GETTER(MdtWorldID, MstUniverseGetWorld, world)
MEMBER_GETTER(McdFrameworkID, MstUniverseGetFramework, frame)
MEMBER_GETTER(McdSpaceID, MstUniverseGetSpace, space)
MEMBER_GETTER(MstBridgeID, MstUniverseGetBridge, bridge)
