/** @file MeAssert.h
 *  Assertions: conditions that hold whatever the program does.
 *
 *  They check Karma's own invariants, not input, which gets a MeWarning if it is bad. In Karma's libraries they are on
 *  in Debug and RelWithDebInfo builds, and if CMake's KARMA_CHECK is ON (then KARMA_ASSERT=1). In programs, which do
 *  not define KARMA_ASSERT, they are on unless NDEBUG is defined, as for assert(). When off, nothing is evaluated. The
 *  check of an assertion costs no more than the operation that it checks.
 *
 *  MEVALIDATE is for checks that cost more, such as walking a list: they are on in Debug builds alone, or where CMake's
 *  KARMA_VALIDATE is ON; in programs, where KARMA_VALIDATE is defined as 1.
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
/** If @a P is false: MeFatalError with its file, line and text. */
#define MEASSERT(P) ((P) ? (void)0 : MeFatalError(0, "%s:%d: not true: %s", __FILE__, __LINE__, #P))
#else
#define MEASSERT(P) ((void)(0 && (P))) /* names P: avoids warnings of unused variables */
#endif

#if defined(KARMA_VALIDATE)
#define ME_VALIDATE_ENABLED (ME_ASSERT_ENABLED && KARMA_VALIDATE)
#else
#define ME_VALIDATE_ENABLED 0
#endif

#if ME_VALIDATE_ENABLED
/** MEASSERT of a condition that is expensive to evaluate. */
#define MEVALIDATE(P) MEASSERT(P)
#else
#define MEVALIDATE(P) ((void)(0 && (P)))
#endif

/** MEASSERT that the pointer @a P is a multiple of @a A bytes. */
#define MEASSERTALIGNED(P, A) MEASSERT((uintptr_t)(P) % (uintptr_t)(A) == 0)

#endif
