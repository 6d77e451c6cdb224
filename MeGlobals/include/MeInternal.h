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

/** Messages that wait until the program may be told: handlers are called on the thread that steps a world, in an order
 *  that does not depend on threads. All zero: none wait. */
typedef struct MeHeldMessages {
    struct MeHeldMessage *first, *last;
    int key; /**< of those that come next: whoever holds them writes it */
} MeHeldMessages;

/** @name Messages that wait
 *  @{ */
/** From now on, in this thread, messages but for fatal errors join @a held, with its key; null: they are sent at once,
 *  as ever. Returns what they joined before. */
MEPUBLIC MeHeldMessages *MEAPI MeMessagesHold(MeHeldMessages *held);
/** Sends what waits in all of these, by their keys, and of one key in the order in which they came. Messages of one key
 *  are all in the same place. */
MEPUBLIC void MEAPI MeMessagesSend(MeHeldMessages *const held[], int count);
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
    int most;         /**< MeNoLimit: as many as there is memory for. */
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
