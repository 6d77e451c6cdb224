/** @file MeCall.h
 *  Calling conventions and export of Karma's functions.
 *
 *  MEAPI stands between the return type and the name of every API function and callback. On all platforms that Karma
 *  supports today, the compiler's default convention is used: the macros expand to nothing, and exist for source
 *  compatibility.
 */
#ifndef MECALL_H
#define MECALL_H

#define MEAPI          /**< Calling convention of API functions and of callbacks. */
#define MEAPI_CDECL    /**< The C convention, for main() and for what atexit() calls. */
#define MEAPI_STDCALL  /**< The callee cleans the stack, where such a convention exists. */
#define MEAPI_FASTCALL /**< Arguments in registers, where such a convention exists. */

/** Marks functions and variables that a shared library exports; all others are hidden. */
#if defined(__GNUC__)
#define MEPUBLIC __attribute__((visibility("default")))
#else
#define MEPUBLIC
#endif

/** Enclose the declarations of a header: C linkage for programs in C++. */
#ifdef __cplusplus
#define ME_BEGIN_C extern "C" {
#define ME_END_C   }
#else
#define ME_BEGIN_C
#define ME_END_C
#endif

#endif
