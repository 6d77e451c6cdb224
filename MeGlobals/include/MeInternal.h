/** @file MeInternal.h
 *  Shared by Karma's own libraries: this header is not installed, and may change at any time.
 *
 *  Memory. All libraries allocate by these functions; none calls MeMemoryAPI itself. They implement the guarantees of
 *  MeMemory.h: a failed allocation is a MeFatalError that names the function and the purpose, resize is never called,
 *  and null is never destroyed. A caller that gets null only has to undo its partial work; the message has been sent.
 *
 *  Handles. In check builds, a library checks whether a pointer from a program is a live object, without dereferencing
 *  it. Each object contains a MeHandle, which is entered into a table when the object is complete, and removed before
 *  its memory is freed or returned to a pool:
 *
 *  @code
 *      typedef struct Thing {
 *          ...
 *          MeHandle handle;
 *      } Thing;
 *      MeHandleEnter(&thing->handle, thing, THING);     // THING: the magic number of its kind
 *      MeHandleIsLive(pointer, THING)                   // true for that address and kind; does not read *pointer
 *      MeHandleLeave(&thing->handle);
 *  @endcode
 *
 *  All libraries share one table. It allocates nothing, so that entering cannot fail, and is thread-safe (one lock per
 *  bucket). A copy of an object is not live: to use a copy as an object, set its MeHandle to zero and enter it for that
 *  time.
 */
#ifndef MEINTERNAL_H
#define MEINTERNAL_H

#include "MeMemory.h"
#include "MePrecision.h"
#include <stddef.h>

ME_BEGIN_C

/** @name Memory
 *  Messages are "function: no memory for what (n bytes)", with MeCallerSet's name instead of @a function if it is set.
 *  All functions return null or false, after a fatal error, without memory or if count * size overflows.
 *  @{ */
/** Allocates a block of @a count elements of @a size bytes, with undefined contents; 0 elements count as 1 byte. */
MEPUBLIC void *MEAPI MeMemoryTake(size_t count, size_t size, const char *function, const char *what);
/** The same, set to zero. */
MEPUBLIC void *MEAPI MeMemoryTakeZeroed(size_t count, size_t size, const char *function, const char *what);
/** Replaces @a *block, which one of these functions allocated or which is null, by a block of @a count elements, and
 *  copies the first @a used ones. False: it is unchanged. @a block is the address of a pointer to any type. */
MEPUBLIC MeBool MEAPI MeMemoryGrow(void *block, size_t used, size_t count, size_t size, const char *function,
                                   const char *what);
/** Frees a block of these three functions. Null is allowed. */
MEPUBLIC void MEAPI MeMemoryGive(void *block);
/** Allocate a block with undefined contents at a multiple of @a alignment bytes (a power of 2), and free it. */
MEPUBLIC void *MEAPI MeMemoryTakeAligned(size_t count, size_t size, unsigned int alignment, const char *function,
                                         const char *what);
MEPUBLIC void MEAPI MeMemoryGiveAligned(void *block);
/** @} */

/** Prefetches the cache line of an address, which may be any. Does nothing if the compiler has no such builtin. The
 *  empty statement keeps gcc from dropping calls of functions that only prefetch, which it treats as pure.
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

/** Size of a cache line, bytes. Records that loops read are aligned to it. */
enum { ME_CACHE_LINE = 64 };

/** Prefetches a whole record; null does nothing. For loops over records at scattered addresses, which hardware does not
 *  prefetch. */
static inline void me_prefetch(const void *start, size_t bytes) {
    for (size_t at = 0; start && at < bytes; at += ME_CACHE_LINE)
        ME_PREFETCH((const char *)start + at);
}

/** @name Names in messages
 *  A function that works by calling other libraries sets its own name first, so that messages about memory and limits
 *  name the function that the program called:
 *
 *  @code
 *      const char *before = MeCallerSet("MstUniverseStep");
 *      ...
 *      MeCallerSet(before);
 *  @endcode
 *  @{ */
/** Sets the caller of this thread; null: none. A caller that is set already is kept. Returns the caller before. */
MEPUBLIC const char *MEAPI MeCallerSet(const char *function);
/** The caller, or @a function if none is set. */
MEPUBLIC const char *MEAPI MeCallerName(const char *function);
/**
 * Sets the name with which all warnings and fatal errors of this thread begin from now on, "Name: ...", in place of
 * that of the function that sends them; of several warnings only the first is sent. A function that only calls others,
 * and no callbacks, sets its own name, so that messages name the function that the program called. Null ends it.
 * Returns the name before.
 */
MEPUBLIC const char *MEAPI MeMessagesAs(const char *function);
/** Runs a statement under MeMessagesAs with the name of the enclosing function. */
#define ME_UNDER_OWN_NAME(...)                                                                                         \
    do {                                                                                                               \
        const char *const nameBefore = MeMessagesAs(__func__);                                                         \
        __VA_ARGS__;                                                                                                   \
        MeMessagesAs(nameBefore);                                                                                      \
    } while (0)
/** Returns a value that is computed under MeMessagesAs with the name of the enclosing function. */
#define ME_RETURN_UNDER_OWN_NAME(Type, value)                                                                          \
    do {                                                                                                               \
        const char *const nameBefore = MeMessagesAs(__func__);                                                         \
        Type found = (value);                                                                                          \
        MeMessagesAs(nameBefore);                                                                                      \
        return found;                                                                                                  \
    } while (0)
/** @} */

/** @name Functions of the program (callbacks)
 *  Around each callback the library registers by which function the program has set it; messages name that function:
 *
 *  @code
 *      const MeProgramCall before = MeProgramEnter("MdtWorldSetBreakCB");
 *      w->breakCb(joint);
 *      MeProgramLeave(&before);
 *  @endcode
 *
 *  A quiet callback may run in the middle of any operation: functions that allocate memory, handle messages, or draw.
 *  Its calls to create, destroy or step anything are refused, with a message that names both functions.
 *  @{ */
/** The state of this thread before a callback. */
typedef struct MeProgramCall {
    const char *setBy;
    MeBool isQuiet;
    const char *caller, *speaker; /**< of MeCallerSet and MeMessagesAs: not used for calls made by the callback */
    MeBool hasSpoken;
} MeProgramCall;
MEPUBLIC MeProgramCall MEAPI MeProgramEnter(const char *setBy);
MEPUBLIC MeProgramCall MEAPI MeProgramEnterQuiet(const char *setBy);
MEPUBLIC void MEAPI MeProgramLeave(const MeProgramCall *before);
/** Whether the program may change objects now. False while a quiet callback runs, with a warning that names
 *  @a function. */
MEPUBLIC MeBool MEAPI MeProgramMayChange(const char *function);
/** Warns "function: not from the function of X; nothing is changed", where X is the function that set the running
 * callback; without a callback, "function: otherwise; nothing is changed".
 */
MEPUBLIC void MEAPI MeProgramRefuse(const char *function, const char *otherwise);
/** @} */

/** @name Stages
 *  While the library iterates over the records of an owner (a world, a framework, a bridge) and runs callbacks, a stage
 *  of the owner is active, at a level that defines which records must not change. Calls from callbacks that would
 *  change these records are deferred: they are queued, and executed in order once the owner has no active stage of that
 *  level. Calls that cannot be deferred are refused.
 *
 *  Each library defines its levels. Level 0 only refuses calls: destroying the owner, and calling again the function
 *  that is running. Several threads may have stages of an owner active at once; only the calling thread defers calls.
 *  @{ */
enum { ME_STAGE_LEVELS = 5 };
/** The stages of an owner; all zero: none is active. */
typedef struct MeStage {
    int active[ME_STAGE_LEVELS]; /**< number of active stages, by level */
    struct MeDeferredCall *first, *last;
    MeBool isExecuting; /**< deferred calls are being executed */
    int round;          /**< nesting of the deferred call that is executed: deferred by a callback of a deferred call,
                             and so on */
} MeStage;
/** A deferred call: a function and its arguments. */
typedef struct MeLater {
    void(MEAPI *carryOut)(const struct MeLater *later);
    void *object, *other[2];
    unsigned long serial; /**< serial number of the object, which reveals whether another object now has its address */
    long number;
} MeLater;
MEPUBLIC void MEAPI MeStageBegin(MeStage *stage, int level);
/** Ends a stage, and executes deferred calls that no active stage prevents. */
MEPUBLIC void MEAPI MeStageEnd(MeStage *stage, int level);
/** Is a stage of that level, or a higher one, active? */
MEPUBLIC MeBool MEAPI MeStageIsActive(const MeStage *stage, int level);
/** When a function may change records that are guarded from a level on. */
typedef enum MeWhen {
    MeWhenNow,
    MeWhenStageEnds, /**< MeStageDefer */
    MeWhenNever      /**< not at all: refused, with a message (MeProgramMayChange) */
} MeWhen;
MEPUBLIC MeWhen MEAPI MeStageWhen(const MeStage *stage, int level, const char *function);
/** Queues a deferred call. False, after a message: no memory, or deferred calls lead to further ones without end. */
MEPUBLIC MeBool MEAPI MeStageDefer(MeStage *stage, int level, const MeLater *later, const char *function);
/** Whether no stage of the owner is active. False: with a message that names @a function. */
MEPUBLIC MeBool MEAPI MeStageIsFree(const MeStage *stage, const char *function);
/** @} */

/** A buffer of messages: sent later, so that handlers run on the thread that steps a world, in an order that does not
 *  depend on threads. All zero: empty. */
typedef struct MeMessageBuffer {
    struct MeBufferedMessage *first, *last;
    int key; /**< sort key of the following messages: set by the owner of the buffer */
} MeMessageBuffer;

/** @name Buffered messages
 *  @{ */
/** From now on, messages of this thread except fatal errors are buffered, with the buffer's key; null: sent at once.
 *  Returns the buffer before. */
MEPUBLIC MeMessageBuffer *MEAPI MeMessagesBuffer(MeMessageBuffer *active);
/** Sends the messages of all buffers in the order of keys; those of equal keys in the order in which they were
 *  buffered. All messages of a key must be in the same buffer. */
MEPUBLIC void MEAPI MeMessagesSend(MeMessageBuffer *const active[], int count);
/** @} */

/** @name Sections (MeProfile.h)
 *  For measuring which work is done by a single thread (bench/critical.c).
 *  @{ */
/** The innermost section in progress; null if there is none, or this thread is not timed. Valid until the profile
 * stops. */
MEPUBLIC const char *MEAPI MeProfileCurrentSection(void);
/** Sets a callback of the timed thread, called before each section begins or ends; null: none. */
MEPUBLIC void MEAPI MeProfileWatch(void(MEAPI *watch)(void *watchContext), void *watchContext);
/** @} */

/** A capacity limit. */
typedef struct MeLimit {
    int max;          /**< MeNoLimit: as many as there is memory for. */
    const char *name; /**< The setting that the program can raise, for messages: "McdInit's modelCount". */
    MeBool warnsOnce, hasWarnedOnce;
} MeLimit;

/** @name Limits
 *  @{ */
/** Sets another name of a limit, in the program's terms; from then on it warns only once. */
MEPUBLIC void MEAPI MeLimitRename(MeLimit *limit, const char *name);
/** Warns "function: no room for what: raise name, which is max". */
MEPUBLIC void MEAPI MeLimitWarn(MeLimit *limit, const char *function, const char *what);
/** @} */

/** Entry of an object in the table of live objects; a member of the object. All zero: not entered. */
typedef struct MeHandle {
    struct MeHandle *next; /**< in its bucket */
    const void *object;
    unsigned int kind;
} MeHandle;

/** @name Handles
 *  @{ */
MEPUBLIC void MEAPI MeHandleEnter(MeHandle *handle, const void *object, unsigned int kind);
/** A handle that is not entered is ignored. */
MEPUBLIC void MEAPI MeHandleLeave(MeHandle *handle);
MEPUBLIC MeBool MEAPI MeHandleIsLive(const void *object, unsigned int kind);
/** @} */

ME_END_C

#endif
