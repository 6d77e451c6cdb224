/** @file MeAssert.h
 *  Checks of what must be true whatever the program does.
 *
 *  They are for broken invariants, not for bad input, which gets a MeWarning. They are compiled in while
 *  Karma is built with KARMA_CHECK=1, and in programs (which do not set KARMA_CHECK) unless NDEBUG is
 *  defined, as for assert(). Otherwise they evaluate nothing.
 */
#ifndef MEASSERT_H
#define MEASSERT_H

#include "MeMessage.h"
#include <stdint.h>

#if defined(KARMA_CHECK)
#define ME_ASSERT_ENABLED KARMA_CHECK
#elif defined(NDEBUG)
#define ME_ASSERT_ENABLED 0
#else
#define ME_ASSERT_ENABLED 1
#endif

#if ME_ASSERT_ENABLED
/** MeFatalError with the place and the text of @a P, should it be false. */
#define MEASSERT(P) ((P) ? (void)0 : MeFatalError(0, "%s:%d: not true: %s", __FILE__, __LINE__, #P))
#else
#define MEASSERT(P) ((void)sizeof((P) ? 1 : 0))
#endif

/** MEASSERT that the pointer @a P is a multiple of @a A bytes. */
#define MEASSERTALIGNED(P, A) MEASSERT((uintptr_t)(P) % (uintptr_t)(A) == 0)

#endif
