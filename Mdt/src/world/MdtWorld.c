/* Worlds: creation, parameters, counting. The stages of a step are in mdt_step.c. */
#include "world/mdt_workers_i.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeMath.h"
#include <float.h>
#include <limits.h>

/* A function that returns a property of the world w; `none` for a bad handle. */
#define WORLD_GETTER(Type, function, none, value)                                                                      \
    Type MEAPI function(const MdtWorldID w) {                                                                          \
        MDT_NEED_WORLD(w, none);                                                                                       \
        return value;                                                                                                  \
    }

/* The scale; 1, with a warning, if it is not positive and finite. */
static MeReal validScale(const char *what, MeReal scale) {
    if (mdt_isPositiveInRange(scale))
        return scale;
    MeWarning(1, "MdtWorldCreate: the %s scale is %g, it must be positive; 1 is taken", what, (double)scale);
    return 1;
}

/* Sets the default thresholds of sleep that the program has not set. They scale with the length scale, but that of
 * acceleration is limited to a tenth of gravity, since a falling body would count as resting otherwise. Both get the
 * same factor, so that their ratio, a time, is constant. */
static void setSleepThresholds(MdtWorldID w) {
    const double length = (double)w->params.lengthScale, full = MDTWORLD_DEFAULT_ACC_THRESH * length * length;
    double g[3];
    mdt_fromReal(g, w->params.gravity);
    const double tenth = keaDot(g, g) / 100, share = tenth > 0 ? fmin(tenth / full, 1) : 1;
    if (!w->hasAccThresh)
        w->sleepParams.acc_thresh = (MeReal)(share * full);
    if (!w->hasVelThresh)
        w->sleepParams.vel_thresh = (MeReal)(share * MDTWORLD_DEFAULT_VEL_THRESH * length * length);
}

static void setDefaults(MdtWorldID w, MeReal lengthScale, MeReal massScale) {
    w->params.lengthScale = lengthScale;
    w->params.massScale = massScale;
    w->params.gravity[0] = MDTWORLD_DEFAULT_GRAVITY_X;
    w->params.gravity[1] = MDTWORLD_DEFAULT_GRAVITY_Y;
    w->params.gravity[2] = MDTWORLD_DEFAULT_GRAVITY_Z;
    w->params.gravity[3] = 0;
    w->epsilon = (MeReal)MDTWORLD_DEFAULT_EPSILON / massScale;
    w->gamma = (MeReal)MDTWORLD_DEFAULT_GAMMA;
    w->maxMatrixSize = MDTMAXMATRIXSIZE_MAX;
    w->workBudget = MDTWORLD_DEFAULT_WORK_BUDGET;
    w->minSafeTime = (MeReal)MDTWORLD_DEFAULT_MIN_SAFETIME;
    w->sleepParams.autoDisable = METRUE;
    w->hasVelThresh = w->hasAccThresh = w->hasThresholds = MEFALSE;
    setSleepThresholds(w);
    w->sleepParams.velrot_thresh = (MeReal)MDTWORLD_DEFAULT_VELROT_THRESH;
    w->sleepParams.accrot_thresh = (MeReal)MDTWORLD_DEFAULT_ACCROT_THRESH;
    w->sleepParams.alive_time = (MeReal)MDTWORLD_DEFAULT_ALIVE_TIME_THRESH;
    w->sleepParams.alive_window = -1;
}

/* Unregisters a constraint; its record is freed with the pool. */
static void unregisterConstraint(MdtConstraintID c) {
    if (mdt_isJoint(c)) {
        mdt_jointFree((MdtJoint *)(void *)c);
        MeHandleLeave(&c->record.handle);
        return;
    }
    for (MdtManifold *block = (MdtManifold *)(void *)c; block; block = block->next) {
        MeHandleLeave(&block->base.record.handle);
        for (MdtExtra *extra = block->extras; extra; extra = extra->next)
            MeHandleLeave(&extra->record.handle);
    }
}

static void freeWorld(MdtWorldID w) {
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        mdt_moverFree(mdt_linkOwner(link));
        mdt_forcesFree(mdt_linkOwner(link));
        MeHandleLeave(&((MdtBodyID)mdt_linkOwner(link))->record.handle);
    }
    for (MdtLink *link = w->constraints.first; link; link = link->next)
        unregisterConstraint(mdt_linkOwner(link));
    void *arrays[] = {w->bodyOf,       w->actingOf,        w->constraintOf,    w->keaOf,         w->bodyStart,
                      w->actingStart,  w->constraintStart, w->taskOf,          w->output.info,   w->reports,
                      w->broken,       w->graph.body,      w->graph.parent,    w->graph.isAwake, w->graph.acting,
                      w->graph.actsOn, w->graph.isEnabled, w->graph.partition, w->record,        w->lastRecord};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        MeMemoryGive(arrays[i]);
    mdt_batchesTerm(&w->batches);
    mdt_workersTerm(w);
    mdt_poolTerm(&w->bodyPool);
    mdt_poolTerm(&w->hiddenPool);
    mdt_poolTerm(&w->jointPool);
    mdt_poolTerm(&w->manifoldPool);
    mdt_poolTerm(&w->extraPool);
    mdt_surfacesTerm(&w->surfaces);
    w->magic = 0;
    MeMemoryGive(w);
}

static MeBool allocateArrays(MdtWorldID w, int bodies, int constraints, const char *caller) {
    w->bodyPool = (MdtPool){.recordSize = sizeof(MdtBody),
                            .what = "bodies",
                            .limit = {.max = bodies, .name = "MdtWorldCreate's maxBodies"}};
    w->hiddenPool = (MdtPool){.recordSize = sizeof(MdtBody), .what = "movers", .limit = {.max = MeNoLimit}};
    const MeLimit room = {.max = constraints, .name = "MdtWorldCreate's maxConstraints"};
    w->constraintLimit = room;
    w->jointPool = (MdtPool){.recordSize = sizeof(MdtJoint), .what = "joints", .limit = room};
    w->manifoldPool = (MdtPool){.recordSize = sizeof(MdtManifold), .what = "contacts", .limit = room};
    w->extraPool = (MdtPool){.recordSize = sizeof(MdtExtra), .what = "properties of contacts", .limit = room};
    return mdt_workersInit(w, 1, caller) && mdt_poolInit(&w->bodyPool, caller) &&
           mdt_poolInit(&w->hiddenPool, caller) && mdt_poolInit(&w->jointPool, caller) &&
           mdt_poolInit(&w->manifoldPool, caller) && mdt_poolInit(&w->extraPool, caller) &&
           mdt_surfacesInit(&w->surfaces, w->params.lengthScale, caller) &&
           mdt_worldReserve(w, bodies == MeNoLimit ? 0 : bodies, constraints == MeNoLimit ? 0 : constraints, caller);
}

MdtWorldID MEAPI(MdtWorldCreate)(const unsigned int maxBodies, const unsigned int maxConstraints,
                                 const MeReal lengthScale, const MeReal massScale) {
    const unsigned int max = INT_MAX / 4;
    if ((maxBodies > max && maxBodies != MeNoLimit) || (maxConstraints > max && maxConstraints != MeNoLimit)) {
        MeWarning(1, "MdtWorldCreate: %u bodies and %u constraints are more than the %u that a world can have",
                  maxBodies, maxConstraints, max);
        return NULL;
    }
    MdtWorldID w = MeMemoryTakeZeroed(1, sizeof *w, "MdtWorldCreate", "a world");
    if (!w)
        return NULL;
    w->timedBodies = MDT_TIMED_BODIES;
    w->accuracy = -1;
    mdt_choicesReset(w);
    w->subSteps = 1;
    w->order = 2;
    w->certificate = 1;   /* 0 is none */
    w->graph.changes = 1; /* `seen` is 0: the partitions are to be found */
    w->numReports = MDT_NO_REPORTS;
    setDefaults(w, validScale("length", lengthScale), validScale("mass", massScale));
    if (!allocateArrays(w, (int)maxBodies, (int)maxConstraints, "MdtWorldCreate")) {
        freeWorld(w);
        return NULL;
    }
    w->magic = MDT_WORLD;
    MeHandleEnter(&w->handle, w, MDT_WORLD);
    mdt_countWorlds(1);
    return w;
}

void MEAPI MdtWorldRenameLimits(const MdtWorldID w, const char *bodies, const char *constraints) {
    MDT_NEED_WORLD(w, );
    MeLimitRename(&w->bodyPool.limit, bodies);
    MeLimitRename(&w->constraintLimit, constraints);
}

/* True if neither the world nor the models of its bodies are in use; otherwise a message. */
static MeBool mayDestroyContents(MdtWorldID w, const char *caller) {
    if (!MeStageIsFree(&w->stage, caller))
        return MEFALSE;
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        const MdtBodyID b = mdt_linkOwner(link);
        if (mdt_userOf(b) && mdt_userOf(b)->guardOf(b)) {
            MeProgramRefuse(caller, "models of its bodies are in use");
            return MEFALSE;
        }
    }
    return METRUE;
}

/* Lets the models that hidden bodies place leave them, which destroys these. */
static void leaveHidden(MdtWorldID w) {
    for (MdtBodyID b = MdtWorldNextHidden(w, NULL); b; b = MdtWorldNextHidden(w, NULL))
        b->mover->user->leave(b);
}

void MEAPI MdtWorldDestroy(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    if (!mayDestroyContents(w, __func__))
        return;
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        const MdtBodyID b = mdt_linkOwner(link);
        if (mdt_userOf(b))
            mdt_userOf(b)->leave(b);
    }
    leaveHidden(w);
    MEASSERT(!w->stage.first);
    MeHandleLeave(&w->handle);
    mdt_countWorlds(-1);
    freeWorld(w);
}

/* Destroys all constraints and bodies, except those that the program's handlers create meanwhile. */
static MeBool destroyContents(MdtWorldID w, const char *caller) {
    const unsigned long end = w->nextSerial;
    if (!mayDestroyContents(w, caller))
        return MEFALSE;
    mdt_listSort(&w->constraints);
    mdt_listSort(&w->bodies);
    MeStageBegin(&w->stage, MDT_GUARD_GRAPH);
    for (MdtLink *link = w->constraints.first, *next; link; link = next) {
        next = link->next;
        if (link->serial < end)
            mdt_constraintRemove(mdt_constraintPublicHandle(mdt_linkOwner(link)));
    }
    for (MdtLink *link = w->bodies.first, *next; link; link = next) {
        next = link->next;
        if (link->serial < end)
            mdt_bodyTerm(mdt_linkOwner(link));
    }
    leaveHidden(w);
    MeStageEnd(&w->stage, MDT_GUARD_GRAPH);
    mdt_choicesReset(w);
    return METRUE;
}

void MEAPI MdtWorldReset(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    destroyContents(w, __func__);
}

void MEAPI MdtWorldReCreate(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    if (destroyContents(w, __func__))
        setDefaults(w, w->params.lengthScale, w->params.massScale);
}

int MEAPI MdtWorldGetMaxMemoryPoolUsed(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    int max = 0;
    for (int i = 0; i < w->numWorkers; i++)
        max = MeMAX(max, MeChunkGetMaxSize(&w->workers[i].scratch));
    return max;
}

void MEAPI MdtWorldSetGravity(const MdtWorldID w, const MeReal gx, const MeReal gy, const MeReal gz) {
    MDT_NEED_WORLD(w, );
    if (!mdt_isFinite3(__func__, "gravity", gx, gy, gz))
        return;
    const MeReal *g = w->params.gravity;
    if (g[0] != gx || g[1] != gy || g[2] != gz)
        mdt_sleepersWakeAll(w);
    w->params.gravity[0] = gx, w->params.gravity[1] = gy, w->params.gravity[2] = gz;
    w->idle.isOver = METRUE;
    setSleepThresholds(w);
}

void MEAPI MdtWorldGetGravity(const MdtWorldID w, MeVector3 g) {
    if (!mdt_isResult(__func__, g, 3) || !mdt_isWorld(w, __func__))
        return;
    for (int i = 0; i < 3; i++)
        g[i] = w->params.gravity[i];
}

void MEAPI MdtWorldSetEpsilon(const MdtWorldID w, const MeReal e) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "epsilon", e, 0))
        w->epsilon = e;
}

WORLD_GETTER(MeReal, MdtWorldGetEpsilon, 0, w->epsilon)

static MeBool isFraction(const char *caller, MeReal gamma) {
    if (gamma >= 0 && gamma <= 1)
        return METRUE;
    MeWarning(1, "%s: gamma is %g, it must be between 0 and 1; nothing is changed", caller, (double)gamma);
    return MEFALSE;
}

void MEAPI MdtWorldSetGamma(const MdtWorldID w, const MeReal g) {
    MDT_NEED_WORLD(w, );
    if (isFraction(__func__, g))
        w->gamma = g;
}

WORLD_GETTER(MeReal, MdtWorldGetGamma, 0, w->gamma)

void MEAPI MdtWorldSetGammaWithRefTimeStep(const MdtWorldID w, const MeReal aGamma, const MeReal aRefStep,
                                           const MeReal aTimeStep) {
    MDT_NEED_WORLD(w, );
    if (isFraction(__func__, aGamma) && mdt_isPositive(__func__, "the reference step", aRefStep) &&
        mdt_isPositive(__func__, "the step", aTimeStep))
        w->gamma = (MeReal)(1 - pow(1 - (double)aGamma, (double)aTimeStep / (double)aRefStep));
}

void MEAPI MdtWorldSetAutoDisable(const MdtWorldID w, const MeBool d) {
    MDT_NEED_WORLD(w, );
    w->sleepParams.autoDisable = d != 0;
}

WORLD_GETTER(MeBool, MdtWorldGetAutoDisable, 0, w->sleepParams.autoDisable)

void MEAPI MdtWorldSetAutoDisableVelocityThreshold(const MdtWorldID w, const MeReal vt) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the threshold", vt, 0))
        w->sleepParams.vel_thresh = vt, w->hasVelThresh = w->hasThresholds = METRUE;
}

WORLD_GETTER(MeReal, MdtWorldGetAutoDisableVelocityThreshold, 0, w->sleepParams.vel_thresh)

void MEAPI MdtWorldSetAutoDisableAngularVelocityThreshold(const MdtWorldID w, const MeReal avt) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the threshold", avt, 0))
        w->sleepParams.velrot_thresh = avt, w->hasThresholds = METRUE;
}

WORLD_GETTER(MeReal, MdtWorldGetAutoDisableAngularVelocityThreshold, 0, w->sleepParams.velrot_thresh)

void MEAPI MdtWorldSetAutoDisableAccelerationThreshold(const MdtWorldID w, const MeReal at) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the threshold", at, 0))
        w->sleepParams.acc_thresh = at, w->hasAccThresh = w->hasThresholds = METRUE;
}

WORLD_GETTER(MeReal, MdtWorldGetAutoDisableAccelerationThreshold, 0, w->sleepParams.acc_thresh)

void MEAPI MdtWorldSetAutoDisableAngularAccelerationThreshold(const MdtWorldID w, const MeReal aat) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the threshold", aat, 0))
        w->sleepParams.accrot_thresh = aat, w->hasThresholds = METRUE;
}

WORLD_GETTER(MeReal, MdtWorldGetAutoDisableAngularAccelerationThreshold, 0, w->sleepParams.accrot_thresh)

void MEAPI MdtWorldSetAutoDisableAliveTime(const MdtWorldID w, const MeReal aw) {
    MDT_NEED_WORLD(w, );
    if (!mdt_isNotBelow(__func__, "the alive time", aw, 0))
        return;
    w->sleepParams.alive_time = aw;
    w->sleepParams.alive_window = -1;
}

void MEAPI(MdtWorldSetAutoDisableAliveWindow)(const MdtWorldID w, const int aliveWindow) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the alive window", (MeReal)aliveWindow, 0))
        w->sleepParams.alive_window = aliveWindow;
}

static double stepForWindows(const MdtWorldID w) {
    return w->lastStep > 0 ? w->lastStep : 1.0 / 60; /* the usual one before the first step */
}

WORLD_GETTER(MeReal, MdtWorldGetAutoDisableAliveTime, 0,
             w->sleepParams.alive_window < 0 ? w->sleepParams.alive_time
                                             : (MeReal)(w->sleepParams.alive_window * stepForWindows(w)))

int MEAPI MdtWorldGetAutoDisableAliveWindow(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    if (w->sleepParams.alive_window >= 0)
        return w->sleepParams.alive_window;
    return (int)fmin(ceil((double)w->sleepParams.alive_time / stepForWindows(w) - 1e-3), INT_MAX);
}

void MEAPI MdtWorldSetMinSafeTime(const MdtWorldID w, const MeReal t) {
    MDT_NEED_WORLD(w, );
    if (mdt_isPositive(__func__, "the safe time", t))
        w->minSafeTime = t;
}

void MEAPI MdtWorldSetBodyHandlers(const MdtWorldID w, MdtBodyHandler enabled, MdtBodyHandler disabled) {
    MDT_NEED_WORLD(w, );
    w->bodyEnabled = enabled;
    w->bodyDisabled = disabled;
}

void MEAPI MdtWorldSetModelHandlers(const MdtWorldID w, MdtBodyHandler enabled, MdtBodyHandler disabled) {
    MDT_NEED_WORLD(w, );
    w->modelsEnabled = enabled;
    w->modelsDisabled = disabled;
}

WORLD_GETTER(MeReal, MdtWorldGetMinSafeTime, 0, w->minSafeTime)

WORLD_GETTER(int, MdtWorldGetMaxBodies, 0, w->bodyPool.limit.max)

WORLD_GETTER(int, MdtWorldGetMaxConstraints, 0, w->constraintLimit.max)

WORLD_GETTER(int, MdtWorldGetTotalBodies, 0, w->bodies.count)

WORLD_GETTER(int, MdtWorldGetTotalConstraints, 0, w->numConstraints)

WORLD_GETTER(int, MdtWorldGetEnabledBodies, 0, w->enabledBodies)

WORLD_GETTER(int, MdtWorldGetEnabledConstraints, 0, w->enabledConstraints)

void MEAPI MdtWorldForAllConstraints(const MdtWorldID w, MdtConstraintIteratorCBPtr cb, void *ccbdata) {
    MDT_NEED_WORLD(w, );
    if (!mdt_isPointer(__func__, "the callback", (const void *)(size_t)cb))
        return;
    mdt_listSort(&w->constraints);
    const unsigned long end = w->nextSerial; /* constraints that are created meanwhile are not visited */
    MeStageBegin(&w->stage, MDT_GUARD_CONSTRAINTS);
    const MeProgramCall before = MeProgramEnter(__func__);
    for (MdtLink *link = w->constraints.first; link; link = link->next)
        if (link->serial < end)
            mdt_constraintVisit(mdt_linkOwner(link), cb, ccbdata);
    MeProgramLeave(&before);
    MeStageEnd(&w->stage, MDT_GUARD_CONSTRAINTS);
}

void MEAPI MdtWorldResetForces(const MdtWorldID w) {
    MDT_NEED_WORLD(w, );
    for (MdtLink *link = w->bodies.first; link; link = link->next) {
        MdtBodyResetForces(mdt_linkOwner(link));
        MdtBodyResetImpulses(mdt_linkOwner(link));
    }
}

MeReal MEAPI MdtWorldGetDefaultDensity(const MdtWorldID w) {
    MDT_NEED_WORLD(w, 0);
    const MeReal l = w->params.lengthScale;
    return w->params.massScale / (l * l * l);
}

static MeBool isIntInRange(const char *caller, int n, int min, int max) {
    if (n >= min && n <= max)
        return METRUE;
    MeWarning(1, "%s: %d is not between %d and %d; nothing is changed", caller, n, min, max);
    return MEFALSE;
}

void MEAPI MdtWorldSetSubSteps(const MdtWorldID w, const int n) {
    MDT_NEED_WORLD(w, );
    if (isIntInRange(__func__, n, 1, 1000))
        w->subSteps = n;
}

WORLD_GETTER(int, MdtWorldGetSubSteps, 1, w->subSteps)

void MEAPI MdtWorldSetIntegratorOrder(const MdtWorldID w, const int order) {
    MDT_NEED_WORLD(w, );
    if (order == 2 || order == 4)
        w->order = order;
    else
        MeWarning(1, "%s: %d is neither 2 nor 4; nothing is changed", __func__, order);
}

WORLD_GETTER(int, MdtWorldGetIntegratorOrder, 2, w->order)

void MEAPI MdtWorldSetTimedContacts(const MdtWorldID w, const int bodies) {
    MDT_NEED_WORLD(w, );
    if (isIntInRange(__func__, bodies, 0, INT_MAX))
        w->timedBodies = bodies;
}

WORLD_GETTER(int, MdtWorldGetTimedContacts, 0, w->timedBodies)

void MEAPI MdtWorldSetMaxLCPIterations(const MdtWorldID w, const int mi) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the number of iterations", (MeReal)mi, 0))
        w->maxLcpIterations = mi;
}

WORLD_GETTER(int, MdtWorldGetMaxLCPIterations, 0, w->maxLcpIterations)

void MEAPI MdtWorldSetWorkBudget(const MdtWorldID w, const MeReal work) {
    MDT_NEED_WORLD(w, );
    if (mdt_isNotBelow(__func__, "the work", work, 0))
        w->workBudget = work;
}

WORLD_GETTER(MeReal, MdtWorldGetWorkBudget, 0, w->workBudget)

/* ---- the solver ---- */

void MEAPI MdtWorldSetSolver(const MdtWorldID w, const MdtSolver solver) {
    MDT_NEED_WORLD(w, );
    if (mdt_isSolver(solver))
        w->solver = solver;
    else
        MeWarning(1, "MdtWorldSetSolver: %d is no solver; it stays as it is", (int)solver);
}

WORLD_GETTER(MdtSolver, MdtWorldGetSolver, MdtSolverAuto, w->solver)

void MEAPI MdtWorldSetSolverCB(const MdtWorldID w, MdtSolverCB cb, void *data) {
    MDT_NEED_WORLD(w, );
    w->solverCb = cb;
    w->solverCbData = data;
    w->isSolverWarned = MEFALSE;
    w->certificate++; /* certified partitions may get another solver */
}

void MEAPI MdtWorldSetAccuracy(const MdtWorldID w, const MeReal velocity) {
    MDT_NEED_WORLD(w, );
    if (mdt_isFinite(__func__, "the accuracy", velocity))
        w->accuracy = velocity;
}

WORLD_GETTER(MeReal, MdtWorldGetAccuracy, 0, (MeReal)mdt_worldAccuracy(w, w->lastStep, MEFALSE))

/* ---- the cap on the rows ---- */

void MEAPI MdtWorldSetMaxMatrixSize(const MdtWorldID w, const int size) {
    MDT_NEED_WORLD(w, );
    if (size > 0)
        w->maxMatrixSize = size;
    else
        MeWarning(1, "MdtWorldSetMaxMatrixSize: the size is %d, it must be positive; nothing is changed", size);
}

WORLD_GETTER(int, MdtWorldGetMaxMatrixSize, 0, w->maxMatrixSize)

void MEAPI MdtWorldSetContactImportanceCB(const MdtWorldID w, MdtContactImportanceCBPtr cb) {
    MDT_NEED_WORLD(w, );
    w->importance = cb;
}

void MEAPI MdtWorldSetMatrixSizeLog(const MdtWorldID w, int *const sizeLog, const int logSize) {
    MDT_NEED_WORLD(w, );
    w->sizeLog = sizeLog;
    w->sizeLogLength = sizeLog && logSize > 0 ? logSize : 0;
}

/* ---- the step ---- */

/* Do the counts of what is enabled, or of a kind, agree with the lists? */
static MeBool areCountsRight(const MdtWorld *w) {
    int bodies = 0, constraints = 0, joints = 0, noCollide = 0, ofProgram = 0, mimics = 0, all = 0;
    for (const MdtLink *link = w->bodies.first; link; link = link->next)
        bodies += ((const MdtBody *)mdt_linkOwner(link))->record.flags & MDT_ENABLED;
    for (const MdtLink *link = w->constraints.first; link; link = link->next) {
        const MdtBaseConstraint *c = mdt_linkOwner(link);
        const MeBool isEnabled = (c->record.flags & MDT_ENABLED) != 0, isJoint = mdt_isJoint(c);
        constraints += isEnabled;
        joints += isEnabled && isJoint;
        noCollide += isJoint && (c->record.flags & MDT_NO_COLLIDE);
        ofProgram += isJoint && ((const MdtJoint *)(const void *)c)->bcl.type == MdtBclUSER;
        mimics += isJoint && ((const MdtJoint *)(const void *)c)->bcl.type == MdtBclMIMIC;
        all += isJoint ? 1 : (int)((const MdtManifold *)(const void *)c)->numPoints;
        all += !isJoint && !(c->record.flags & MDT_LONE);
    }
    return bodies == w->enabledBodies && constraints == w->enabledConstraints && joints == w->enabledJoints &&
           noCollide == w->numNoCollide && ofProgram == w->userConstraints && mimics == w->mimics &&
           all == w->numConstraints;
}

void MEAPI MdtWorldAdvance(const MdtWorldID w, const MeReal h, const MeBool stopAtSafeTime) {
    MeStageBegin(&w->stage, MDT_GUARD_WORLD);
    w->lastStep = (double)h;
    for (int i = 0; i < w->sizeLogLength; i++)
        w->sizeLog[i] = 0;
    mdt_idleCheck(w, (double)h);
    MEVALIDATE(areCountsRight(w));
    mdt_forgottenCheck(w, (double)h);
    mdt_breakBegin(w);
    mdt_worldStep(w, (double)h, stopAtSafeTime);
    mdt_breakEnd(w);
    MEVALIDATE(areCountsRight(w));
    MeStageEnd(&w->stage, MDT_GUARD_WORLD);
}

void MEAPI MdtWorldStep(const MdtWorldID w, const MeReal stepSize) {
    MDT_NEED_WORLD(w, );
    if (mdt_isPositive(__func__, "the step size", stepSize) && MeStageIsFree(&w->stage, __func__))
        MdtWorldAdvance(w, stepSize, MEFALSE);
}

void MEAPI MdtWorldStepSafeTime(const MdtWorldID w, const MeReal stepSize) {
    MDT_NEED_WORLD(w, );
    if (mdt_isPositive(__func__, "the step size", stepSize) && MeStageIsFree(&w->stage, __func__))
        MdtWorldAdvance(w, stepSize, METRUE);
}

/* ---- partitions ---- */

void MEAPI MdtWorldSetPartitionCB(const MdtWorldID w, MdtPartitionEndCB cb, void *data) {
    MDT_NEED_WORLD(w, );
    w->partitionCb = cb;
    w->partitionCbData = data;
}
