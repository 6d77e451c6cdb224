/** @file MeInternal.h
 *  What Karma's own libraries share and programs do not see: this header is not installed, and may change at any time.
 *
 *  Memory. Every library takes its memory by these functions, and none calls MeMemoryAPI itself. They keep what
 *  MeMemory.h promises: a failing allocation is a MeFatalError that names the function and what it wanted, resize is
 *  never called, and null is never destroyed. Who gets a null has only to undo what was half made: nothing is left to
 *  be said.
 *
 *  Handles. In check builds a library wants to know whether a pointer that a program hands over is a live object,
 *  without reading through it. An object has a MeHandle in it, which is entered when the object is complete and leaves
 *  before its memory is freed or goes back to a pool:
 *
 *  @code
 *      typedef struct Thing {
 *          ...
 *          MeHandle handle;
 *      } Thing;
 *      MeHandleEnter(&thing->handle, thing, THING);     // THING: the magic number of its kind
 *      MeHandleIsLive(pointer, THING)                   // true for that address and kind; reads nothing at pointer
 *      MeHandleLeave(&thing->handle);
 *  @endcode
 *
 *  One table serves all libraries. It allocates nothing, so that entering cannot fail, and it may be used from several
 *  threads at once (a lock per bucket). A copy of an object is not live: where a stand-in is made by copying, clear its
 *  MeHandle (all zero) and enter it for as long as it is used.
 */
#ifndef MEINTERNAL_H
#define MEINTERNAL_H

#include "MeMemory.h"
#include "MePrecision.h"
#include <stddef.h>

ME_BEGIN_C

/** @name Memory
 *  @a function (or MeCallerSet's) and @a what are for the message: "function: no memory for what (n bytes)". All return
 *  null, or false, after a fatal error if there is no memory or if count * size is more than there can be.
 *  @{ */
/** A block of @a count elements of @a size bytes, with any contents; 0 elements count as 1 byte. */
MEPUBLIC void *MEAPI MeMemoryTake(size_t count, size_t size, const char *function, const char *what);
/** The same, of zeros. */
MEPUBLIC void *MEAPI MeMemoryTakeZeroed(size_t count, size_t size, const char *function, const char *what);
/** Makes @a *block, from one of these functions or null, a block of @a count elements, of which the first @a used are
 *  kept. False: it is as it was. @a block is the address of a pointer to any type. */
MEPUBLIC MeBool MEAPI MeMemoryGrow(void *block, size_t used, size_t count, size_t size, const char *function,
                                   const char *what);
/** Takes back what these three gave. Null is nothing. */
MEPUBLIC void MEAPI MeMemoryGive(void *block);
/** Any contents, which are not touched, at a multiple of @a alignment bytes (a power of 2), and their way back. */
MEPUBLIC void *MEAPI MeMemoryTakeAligned(size_t count, size_t size, unsigned int alignment, const char *function,
                                         const char *what);
MEPUBLIC void MEAPI MeMemoryGiveAligned(void *block);
/** @} */

/** Says that what is at an address will soon be read; any address will do. Nothing where the compiler has no word for
 *  it. The empty statement keeps gcc from dropping calls of a function that does nothing else, which it takes for pure.
 */
#if defined(__GNUC__)
#define ME_PREFETCH(address)                                                                                           \
    (__extension__({                                                                                                   \
        __builtin_prefetch(address);                                                                                   \
        __asm__ volatile("");                                                                                          \
    }))
#else
#define ME_PREFETCH(address) ((void)(address))
#endif

/** Bytes that processors read from memory at once. Records that loops read are aligned to it. */
enum { ME_CACHE_LINE = 64 };

/** ME_PREFETCH of a whole record; null does nothing. For loops over records that lie anywhere in memory, which no
 *  processor foresees. */
static inline void me_prefetch(const void *start, size_t bytes) {
    for (size_t at = 0; start && at < bytes; at += ME_CACHE_LINE)
        ME_PREFETCH((const char *)start + at);
}

/** @name Who is told
 *  A function that does its work by functions of other libraries says its name first, so that what they have to say of
 *  memory and of limits names what the program called:
 *
 *  @code
 *      const char *before = MeCallerSet("MstUniverseStep");
 *      ...
 *      MeCallerSet(before);
 *  @endcode
 *  @{ */
/** From now on, in this thread; null: nobody. Where somebody is set already, that stays. Returns who was set before. */
MEPUBLIC const char *MEAPI MeCallerSet(const char *function);
/** Who is to be named: who is set, else @a function. */
MEPUBLIC const char *MEAPI MeCallerName(const char *function);
/**
 * As MeCallerSet, for a function that does nothing but by others, and calls no callbacks: from now on, in this thread,
 * all warnings and fatal errors begin with its name in place of that of the function that sends them, "Name: ...", and
 * of several warnings the first is sent. So what is said names the function that the program has called.
 */
MEPUBLIC const char *MEAPI MeMessagesAs(const char *function);
/** Runs a statement so, under the name of the function that it stands in. */
#define ME_UNDER_OWN_NAME(...)                                                                                         \
    do {                                                                                                               \
        const char *const nameBefore = MeMessagesAs(__func__);                                                         \
        __VA_ARGS__;                                                                                                   \
        MeMessagesAs(nameBefore);                                                                                      \
    } while (0)
/** Returns a value that is found so. */
#define ME_RETURN_UNDER_OWN_NAME(Type, value)                                                                          \
    do {                                                                                                               \
        const char *const nameBefore = MeMessagesAs(__func__);                                                         \
        Type found = (value);                                                                                          \
        MeMessagesAs(nameBefore);                                                                                      \
        return found;                                                                                                  \
    } while (0)
/** @} */

/** @name Functions of the program (callbacks)
 *  The library says by which function the program has set the one that it calls, for messages, and until when it runs:
 *
 *  @code
 *      const MeProgramCall before = MeProgramEnter("MdtWorldSetBreakCB");
 *      w->breakCb(joint);
 *      MeProgramLeave(&before);
 *  @endcode
 *
 *  A quiet one may be called in the middle of anything: functions that take memory, handle messages, or draw. What it
 *  calls to create, destroy or step anything is refused, with a message that names both.
 *  @{ */
/** What was said before; of this thread. */
typedef struct MeProgramCall {
    const char *setBy;
    MeBool isQuiet;
    const char *caller, *speaker; /**< MeCallerSet, MeMessagesAs: the program's own calls go by their own names */
    MeBool hasSpoken;
} MeProgramCall;
MEPUBLIC MeProgramCall MEAPI MeProgramEnter(const char *setBy);
MEPUBLIC MeProgramCall MEAPI MeProgramEnterQuiet(const char *setBy);
MEPUBLIC void MEAPI MeProgramLeave(const MeProgramCall *before);
/** False, with a message that names @a function: a quiet function of the program runs. */
MEPUBLIC MeBool MEAPI MeProgramMayChange(const char *function);
/** MeWarning: "function: not from the function of X; nothing is changed", X being who set what runs; else @a otherwise.
 */
MEPUBLIC void MEAPI MeProgramRefuse(const char *function, const char *otherwise);
/** @} */

/** @name Stages
 *  While a function of the library goes through the records of an owner (a world, a framework, a bridge) and calls
 *  functions of the program, it holds the owner: at a level, which says what must stay as it is. What the program calls
 *  meanwhile, and would change that, waits in the owner's list, and is carried out, in the order in which it was
 *  called, when the owner is no longer held at that level. What cannot wait is refused.
 *
 *  Each library says what its levels are. Level 0 only forbids what is refused: to destroy the owner, and to call again
 *  what is running. Several threads may hold an owner at once; what waits is the calling thread's affair.
 *  @{ */
enum { ME_STAGE_LEVELS = 5 };
/** Of an owner; all zero: nobody holds it. */
typedef struct MeStage {
    int active[ME_STAGE_LEVELS]; /**< how often, by level */
    struct MeWaiting *first, *last;
    MeBool isCarrying; /**< what has waited is being carried out, */
    int round;         /**< which was called from the function of the program that what waited so often has led to */
} MeStage;
/** What is carried out: a function and what it was called with. */
typedef struct MeLater {
    void(MEAPI *carryOut)(const struct MeLater *later);
    void *object, *other[2];
    unsigned long serial; /**< of the object, by which another one in its place is told from it */
    long number;
} MeLater;
MEPUBLIC void MEAPI MeStageBegin(MeStage *stage, int level);
/** Ends it, and carries out what has waited for it. */
MEPUBLIC void MEAPI MeStageEnd(MeStage *stage, int level);
/** Is the owner held at that level, or a higher one? */
MEPUBLIC MeBool MEAPI MeStageIsActive(const MeStage *stage, int level);
/** What a function has to do that changes what must stay from a level on. */
typedef enum MeWhen {
    MeWhenNow,
    MeWhenStageEnds, /**< MeStageDefer */
    MeWhenNever      /**< nothing: it was refused, with a message (MeProgramMayChange) */
} MeWhen;
MEPUBLIC MeWhen MEAPI MeStageWhen(const MeStage *stage, int level, const char *function);
/** Puts it into the owner's list. False, after a message: no memory; or what is carried out makes the program call for
 *  more of it again and again, so that it would not end. */
MEPUBLIC MeBool MEAPI MeStageDefer(MeStage *stage, int level, const MeLater *later, const char *function);
/** True for an owner that is not held at all; else a message that names @a function. */
MEPUBLIC MeBool MEAPI MeStageIsFree(const MeStage *stage, const char *function);
/** @} */

/** Messages that wait until the program may be told: handlers are called on the thread that steps a world, in an order
 *  that does not depend on threads. All zero: none wait. */
typedef struct MeMessageBuffer {
    struct MeBufferedMessage *first, *last;
    int key; /**< of those that come next: whoever holds them writes it */
} MeMessageBuffer;

/** @name Messages that wait
 *  @{ */
/** From now on, in this thread, messages but for fatal errors join @a held, with its key; null: they are sent at once,
 *  as ever. Returns what they joined before. */
MEPUBLIC MeMessageBuffer *MEAPI MeMessagesBuffer(MeMessageBuffer *active);
/** Sends what waits in all of these, by their keys, and of one key in the order in which they came. Messages of one key
 *  are all in the same place. */
MEPUBLIC void MEAPI MeMessagesSend(MeMessageBuffer *const active[], int count);
/** @} */

/** @name Sections (MeProfile.h)
 *  For who asks what is done by one thread alone (bench/critical.c).
 *  @{ */
/** The innermost one in progress; null: none is, or this thread is not timed. Valid until the profile is stopped. */
MEPUBLIC const char *MEAPI MeProfileCurrentSection(void);
/** From now on, @a watch is called on the timed thread before a section begins or ends; null: nothing is. */
MEPUBLIC void MEAPI MeProfileWatch(void(MEAPI *watch)(void *watchContext), void *watchContext);
/** @} */

/** How many of something there may be. */
typedef struct MeLimit {
    int max;          /**< MeNoLimit: as many as there is memory for. */
    const char *name; /**< What the program is to raise: "McdInit's modelCount". */
    MeBool isSaidOnce, wasSaid;
} MeLimit;

/** @name Limits
 *  @{ */
/** Gives a limit another name, by which the program knows it; it is spoken of once from then on. */
MEPUBLIC void MEAPI MeLimitRename(MeLimit *limit, const char *name);
/** MeWarning: "function: no room for what: raise name, which is most". */
MEPUBLIC void MEAPI MeLimitWarn(MeLimit *limit, const char *function, const char *what);
/** @} */

/** Makes an object known; a part of it. All zero: not entered. */
typedef struct MeHandle {
    struct MeHandle *next; /**< in its bucket */
    const void *object;
    unsigned int kind;
} MeHandle;

/** @name Handles
 *  @{ */
MEPUBLIC void MEAPI MeHandleEnter(MeHandle *handle, const void *object, unsigned int kind);
/** One that is not entered is left alone. */
MEPUBLIC void MEAPI MeHandleLeave(MeHandle *handle);
MEPUBLIC MeBool MEAPI MeHandleIsLive(const void *object, unsigned int kind);
/** @} */

ME_END_C

#endif
