/* Profiling: marks, frames, the tree of sections and the log. */
#define _POSIX_C_SOURCE 199309L /* clock_gettime */
#include "MeProfile_i.h"

#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "MeMessage_i.h"
#include <stdatomic.h>
#include <string.h>
#include <time.h>

static const int firstEvents = 1024, maxEvents = 1 << 20;

MeProfileState me_profile;

/* Only the thread that started timing is timed. `owner` is the address of its threadMark; null when timing is off. */
static _Thread_local char threadMark;
static _Atomic(const char *) owner;

/* The callback of MeProfileWatch. */
static struct {
    void(MEAPI *call)(void *context);
    void *context;
} watcher;

static void callWatcher(void) {
    if (watcher.call)
        watcher.call(watcher.context);
}

static MeBool isThreadTimed(void) {
    return atomic_load_explicit(&owner, memory_order_relaxed) == &threadMark;
}

static void setOwner(const char *mark) {
    atomic_store_explicit(&owner, mark, memory_order_relaxed);
}

/* ---- the clock ---- */

static const MeU64 ticksPerSecond = 1000000000;

uint64_t me_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * ticksPerSecond + (uint64_t)t.tv_nsec;
}

MeU64 MEAPI MeProfileGetClockSpeed(void) {
    return ticksPerSecond;
}

void MEAPI MeProfileGetTimerValue(MeProfileTimerResult *const result) {
    if (me_isGiven(result, "result", __func__))
        result->ticks = me_now();
}

/* ---- the tree ---- */

static MeBool isNestedInSameName(const MeSection *parent, const char *name) {
    for (const MeSection *s = parent; s != NULL; s = s->parent) {
        if (strcmp(s->name, name) == 0)
            return METRUE;
    }
    return MEFALSE;
}

MeSection *me_sectionCreate(MeSection *parent, const char *name) {
    const size_t length = strlen(name) + 1;
    MeSection *const s = MeMemoryTake(1, sizeof *s + length, "MeProfile", "a section");
    if (s == NULL)
        return NULL;
    *s = (MeSection){.parent = parent, .isRecursive = isNestedInSameName(parent, name)};
    memcpy(s->name, name, length);
    if (parent == NULL)
        return s;
    s->depth = parent->depth + 1;
    MEASSERT((parent->firstChild == NULL) == (parent->lastChild == NULL));
    if (parent->lastChild != NULL)
        parent->lastChild->next = s;
    else
        parent->firstChild = s;
    parent->lastChild = s;
    return s;
}

MeSection *me_sectionChild(MeSection *parent, const char *name) {
    for (MeSection *s = parent->firstChild; s != NULL; s = s->next) {
        if (strcmp(s->name, name) == 0)
            return s;
    }
    return me_sectionCreate(parent, name);
}

void me_sectionDestroy(MeSection *section) {
    if (section == NULL)
        return;
    while (section->firstChild != NULL) {
        MeSection *const child = section->firstChild;
        section->firstChild = child->next;
        me_sectionDestroy(child);
    }
    MeMemoryGive(section);
}

MeSection *me_sectionNext(MeSection *section) {
    if (section->firstChild != NULL)
        return section->firstChild;
    while (section != NULL && section->next == NULL)
        section = section->parent;
    return section != NULL ? section->next : NULL;
}

/* ---- counting ---- */

/* Makes room for another event; false if the log is full or there is no memory. */
static MeBool growLog(void) {
    MeProfileState *const p = &me_profile;
    MEASSERT(p->numEvents <= p->maxEvents);
    if (p->numEvents < p->maxEvents)
        return METRUE;
    if (p->maxEvents == maxEvents) {
        MeWarning(1, "MeProfile: the log is full with %d calls; kMeProfileLogTotals needs none", maxEvents);
        p->logging = kMeProfileLogTotals;
        return MEFALSE;
    }
    const int more = MeMAX(2 * p->maxEvents, firstEvents);
    if (!MeMemoryGrow(&p->events, (size_t)p->numEvents, (size_t)more, sizeof *p->events, "MeProfile", "the log"))
        return MEFALSE;
    p->maxEvents = more;
    return METRUE;
}

/* Adds the time of a section in progress up to now. */
static void countTime(MeSection *s, uint64_t now) {
    MeProfileState *const p = &me_profile;
    const uint64_t elapsed = now - s->start;
    MEASSERT(now >= s->start);
    s->total.time += elapsed;
    if (p->isInFrame)
        s->thisFrame.time += elapsed;
    if (p->logging == kMeProfileLogAll && growLog()) {
        const int frame = p->isInFrame ? p->frames + 1 : 0;
        p->events[p->numEvents++] = (MeEvent){s, s->start - p->start, elapsed, frame};
    }
    s->start = now;
}

static void countTimeOfAllInProgress(uint64_t now) {
    for (MeSection *s = me_profile.current; s->parent != NULL; s = s->parent)
        countTime(s, now);
}

static void beginCall(MeSection *s, MeBool isAutoStop, uint64_t now) {
    MEASSERT(s->parent == me_profile.current);
    s->start = now;
    s->isAutoStop = isAutoStop;
    s->total.calls++;
    if (me_profile.isInFrame)
        s->thisFrame.calls++;
    me_profile.current = s;
}

static void endCurrentCall(uint64_t now) {
    MeSection *const s = me_profile.current;
    MEASSERT(s->parent != NULL); /* the root is not a section */
    countTime(s, now);
    me_profile.current = s->parent;
}

/* ---- on and off ---- */

void MEAPI MeProfileStartTiming(MeProfileTimerMode mode, MeProfileLogModes_enum logging) {
    (void)mode;
    MeProfileStopTiming();
    MeSection *const root = me_sectionCreate(NULL, "");
    if (root == NULL)
        return;
    me_profile = (MeProfileState){.logging = logging, .start = me_now(), .root = root, .current = root};
    setOwner(&threadMark);
}

void MEAPI MeProfileStopTimers(void) {
    if (!isThreadTimed())
        return;
    const uint64_t now = me_now();
    while (me_profile.current != me_profile.root)
        endCurrentCall(now);
    if (me_profile.isInFrame)
        MeProfileEndFrame();
    setOwner(NULL);
}

void MEAPI MeProfileStopTiming(void) {
    MeProfileStopTimers();
    me_sectionDestroy(me_profile.root);
    MeMemoryGive(me_profile.events);
    me_profile = (MeProfileState){0};
    setOwner(NULL);
}

/* ---- marks ---- */

void MEAPI MeProfileStartFrame(void) {
    if (!isThreadTimed())
        return;
    if (me_profile.isInFrame)
        MeProfileEndFrame();
    countTimeOfAllInProgress(me_now());
    me_profile.isInFrame = METRUE;
}

static void finishFrame(MeSection *s) {
    s->lastFrame = s->thisFrame;
    s->allFrames.calls += s->thisFrame.calls;
    s->allFrames.time += s->thisFrame.time;
    s->worstFrame = MeMAX(s->worstFrame, s->thisFrame.time);
    s->thisFrame = (MeTally){0, 0};
}

void MEAPI MeProfileEndFrame(void) {
    if (!isThreadTimed() || !me_profile.isInFrame)
        return;
    countTimeOfAllInProgress(me_now());
    for (MeSection *s = me_profile.root; s != NULL; s = me_sectionNext(s))
        finishFrame(s);
    me_profile.frames++;
    me_profile.isInFrame = MEFALSE;
}

void MEAPI MeProfileStartSectionFn(const char *codeSection, char unsigned autoStop) {
    if (!isThreadTimed())
        return;
    if (!me_isGiven(codeSection, "name", "MeProfileStartSection"))
        return;
    callWatcher();
    const uint64_t now = me_now();
    if (autoStop && me_profile.current->isAutoStop)
        endCurrentCall(now);
    MeSection *const section = me_sectionChild(me_profile.current, codeSection);
    if (section != NULL)
        beginCall(section, autoStop, now);
    else
        MeProfileStopTimers(); /* out of memory */
}

static void warnOnce(const char *name, const char *what) {
    if (!me_profile.hasWarned)
        MeWarning(1, "MeProfileEndSection: section '%s' %s", name, what);
    me_profile.hasWarned = METRUE;
}

void MEAPI MeProfileEndSectionFn(const char *codeSection) {
    if (!isThreadTimed())
        return;
    const char *const name = codeSection != NULL ? codeSection : "(null)";
    const MeSection *ending = me_profile.current;
    MeBool isInnerLeft = MEFALSE;
    while (ending->parent != NULL && strcmp(ending->name, name) != 0) {
        isInnerLeft = isInnerLeft || !ending->isAutoStop;
        ending = ending->parent;
    }
    if (ending->parent == NULL) {
        warnOnce(name, "has not been started");
        return;
    }
    if (isInnerLeft)
        warnOnce(name, "ends before a section that was started in it");
    callWatcher();
    const uint64_t now = me_now();
    while (me_profile.current != ending->parent)
        endCurrentCall(now);
}

void MEAPI MeProfileWatch(void(MEAPI *watch)(void *watchContext), void *watchContext) {
    watcher.call = watch;
    watcher.context = watchContext;
}

const char *MEAPI MeProfileCurrentSection(void) {
    return isThreadTimed() && me_profile.current->parent ? me_profile.current->name : NULL;
}

/* ---- results ---- */

static MeReal toSeconds(uint64_t nanoseconds) {
    return (MeReal)((double)nanoseconds / (double)ticksPerSecond);
}

MeReal MEAPI MeProfileGetSectionTime(const char *codeSection) {
    uint64_t sum = 0;
    if (me_profile.root == NULL || codeSection == NULL)
        return 0;
    for (MeSection *s = me_sectionNext(me_profile.root); s != NULL; s = me_sectionNext(s)) {
        if (!s->isRecursive && strcmp(s->name, codeSection) == 0)
            sum += s->lastFrame.time;
    }
    return toSeconds(sum);
}

MeReal MEAPI MeProfileGetAllSectionTime(void) {
    uint64_t sum = 0;
    if (me_profile.root == NULL)
        return 0;
    for (const MeSection *s = me_profile.root->firstChild; s != NULL; s = s->next)
        sum += s->lastFrame.time;
    return toSeconds(sum);
}
