/** @file MeCall.h
 *  How Karma's functions are called and exported (User Guide ch. 3, "Calling Conventions").
 *
 *  MEAPI stands between the return type and the name of every API function and callback. On the platforms that
 *  Karma is built for today all conventions are the compiler's own, so the words expand to nothing; programs keep
 *  them for source compatibility.
 */
#ifndef MECALL_H
#define MECALL_H

#define MEAPI          /**< Calling convention of API functions and of callbacks. */
#define MEAPI_CDECL    /**< The C convention, for main() and for what atexit() calls. */
#define MEAPI_STDCALL  /**< The callee cleans the stack, where such a convention exists. */
#define MEAPI_FASTCALL /**< Arguments in registers, where such a convention exists. */

/** Marks what a shared library exports; everything else in it is hidden. */
#if defined(__GNUC__)
#define MEPUBLIC __attribute__((visibility("default")))
#else
#define MEPUBLIC
#endif

/** Around the declarations of a header: C linkage for programs in C++. */
#ifdef __cplusplus
#define ME_BEGIN_C extern "C" {
#define ME_END_C   }
#else
#define ME_BEGIN_C
#define ME_END_C
#endif

#endif
