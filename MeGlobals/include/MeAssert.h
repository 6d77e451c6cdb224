/** @file MeAssert.h
 *  Checks of what must be true whatever the program does.
 *
 *  They are for broken invariants, not for bad input, which gets a MeWarning. In Karma's libraries they are on in Debug
 *  and RelWithDebInfo builds, and where CMake's KARMA_CHECK is ON (then KARMA_ASSERT=1); in programs, which do not set
 *  KARMA_ASSERT, unless NDEBUG is defined, as for assert(). Otherwise they evaluate nothing. They cost no more than
 *  what they check.
 *
 *  MEVALIDATE is for checks that cost more than what they check, such as walking a list: they are compiled in where
 *  KARMA_VALIDATE is defined too.
 */
#ifndef MEASSERT_H
#define MEASSERT_H

#include "MeMessage.h"
#include <stdint.h>

#if defined(KARMA_ASSERT)
#define ME_ASSERT_ENABLED KARMA_ASSERT
#elif defined(NDEBUG)
#define ME_ASSERT_ENABLED 0
#else
#define ME_ASSERT_ENABLED 1
#endif

#if ME_ASSERT_ENABLED
/** MeFatalError with the place and the text of @a P, should it be false. */
#define MEASSERT(P) ((P) ? (void)0 : MeFatalError(0, "%s:%d: not true: %s", __FILE__, __LINE__, #P))
#else
#define MEASSERT(P) ((void)(0 && (P))) /* named, so that no compiler takes what only checks use for forgotten */
#endif

#if ME_ASSERT_ENABLED && defined(KARMA_VALIDATE)
#define ME_VALIDATE_ENABLED 1
/** MEASSERT of something that takes long to find out. */
#define MEVALIDATE(P) MEASSERT(P)
#else
#define ME_VALIDATE_ENABLED 0
#define MEVALIDATE(P)       ((void)(0 && (P)))
#endif

/** MEASSERT that the pointer @a P is a multiple of @a A bytes. */
#define MEASSERTALIGNED(P, A) MEASSERT((uintptr_t)(P) % (uintptr_t)(A) == 0)

#endif
