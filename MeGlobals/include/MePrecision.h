/** @file MePrecision.h
 *  The number type, its functions and small types of fixed size (Dynamics guide, Preface, "Type Conventions").
 *
 *  Karma is built in two precisions. A program selects double precision by defining `_ME_API_DOUBLE`, which the CMake
 *  targets and pkg-config files do. Code compiled for one precision does not link with libraries of the other: the
 *  linker then reports `MeGlobalsIsSinglePrecision` or `MeGlobalsIsDoublePrecision` as undefined.
 */
#ifndef MEPRECISION_H
#define MEPRECISION_H

#include "MeCall.h"
#include <float.h>
#include <math.h>

ME_BEGIN_C

#ifdef _ME_API_DOUBLE
typedef double MeReal;
#define MEINFINITY DBL_MAX     /**< Stands for "no limit": the largest number, so that sums with it stay finite. */
#define ME_EPSILON DBL_EPSILON /**< Distance from 1 to the next number. */
extern MEPUBLIC const char MeGlobalsIsDoublePrecision;
#define ME_PRECISION_MARK MeGlobalsIsDoublePrecision
#else
typedef float MeReal;
#define MEINFINITY        FLT_MAX /**< Stands for "no limit": the largest number, so that sums with it stay finite. */
#define ME_EPSILON        FLT_EPSILON /**< Distance from 1 to the next number. */
extern MEPUBLIC const char MeGlobalsIsSinglePrecision;
#define ME_PRECISION_MARK MeGlobalsIsSinglePrecision
#endif

/* Every object file refers to the mark of its own precision. */
#if defined(__GNUC__)
__attribute__((used)) static const char *const mePrecisionMark = &ME_PRECISION_MARK;
#endif

#define _BUILD_VANILLA 1 /**< Portable C, no hand-written assembler. */

typedef int MeBool; /**< 0 is false, anything else true. */
#define MEFALSE 0
#define METRUE  1

typedef signed char MeI8;
typedef short MeI16;
typedef int MeI32;
typedef long MeI64;
typedef unsigned char MeU8;
typedef unsigned short MeU16;
typedef unsigned int MeU32;
typedef unsigned long MeU64;
#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 MeI128;
__extension__ typedef unsigned __int128 MeU128;
#endif

typedef MeReal MeVector3[3];    /**< x, y, z. */
typedef MeReal MeVector4[4];    /**< x, y, z, w (1 for a point, 0 for a direction), or a quaternion (w, x, y, z). */
typedef MeVector3 MeMatrix3[3]; /**< Three rows. MeMatrix3 m = {a,b,c, d,e,f, g,h,i} fills it row by row. */
typedef MeVector4 MeMatrix4[4]; /**< A transform as OpenGL stores it: rows 0-2 the axes, row 3 the translation. */
typedef MeReal *MeVector3Ptr;
typedef MeReal *MeVector4Ptr;
typedef MeVector3 *MeMatrix3Ptr;
typedef MeVector4 *MeMatrix4Ptr;

typedef float AcmeReal; /**< The viewer's number: float in both precisions. */
typedef AcmeReal AcmeVector3[3];

/** Declares @a V of type @a T, aligned to @a N bytes: `static MeALIGNDATA(MeMatrix4, identity, 16) = {...};` */
#if defined(__GNUC__)
#define MeALIGNDATA(T, V, N) T V __attribute__((aligned(N)))
/** Aligns the declared variable to @a N bytes, before or after the declaration: `MeALIGNTO(16) static MeMatrix4
 * identity;` */
#define MeALIGNTO(N) __attribute__((aligned(N)))
#else
#define MeALIGNDATA(T, V, N) T V
#define MeALIGNTO(N)
#endif

#ifdef _ME_API_DOUBLE
#define MeSqrt(x)     sqrt(x)
#define MeFabs(x)     fabs(x)
#define MeSin(x)      sin(x)
#define MeCos(x)      cos(x)
#define MeTan(x)      tan(x)
#define MeAsin(x)     asin(x)
#define MeAcos(x)     acos(x)
#define MeAtan(x)     atan(x)
#define MeAtan2(y, x) atan2(y, x)
#else
#define MeSqrt(x)     sqrtf(x)
#define MeFabs(x)     fabsf(x)
#define MeSin(x)      sinf(x)
#define MeCos(x)      cosf(x)
#define MeTan(x)      tanf(x)
#define MeAsin(x)     asinf(x)
#define MeAcos(x)     acosf(x)
#define MeAtan(x)     atanf(x)
#define MeAtan2(y, x) atan2f(y, x)
#endif
#define MeSqr(x)       ((x) * (x))
#define MeRecip(x)     ((MeReal)1 / (x))
#define MeRecipSqrt(x) ((MeReal)1 / MeSqrt(x))
/** True for a number, false for NaN and the infinities. */
#define MeRealIsValid(f) (isfinite(f) ? METRUE : MEFALSE)

/** Tolerances for numbers near 1: rounding errors of one operation, of a few, of a long computation. */
#ifdef _ME_API_DOUBLE
#define ME_MIN_EPSILON    ((MeReal)1e-14)
#define ME_SMALL_EPSILON  ((MeReal)1e-11)
#define ME_MEDIUM_EPSILON ((MeReal)1e-8)
#else
#define ME_MIN_EPSILON    ((MeReal)1e-6)
#define ME_SMALL_EPSILON  ((MeReal)1e-5)
#define ME_MEDIUM_EPSILON ((MeReal)1e-3)
#endif

/** Comparisons with an absolute tolerance @a e; in those without one it is ME_SMALL_EPSILON. */
#define ME_IS_ZERO_TOL(x, e)      (MeFabs(x) < (e))
#define ME_ARE_EQUAL_TOL(x, y, e) (MeFabs((x) - (y)) < (e))
#define ME_IS_ZERO_3VEC_TOL(x, e) (ME_IS_ZERO_TOL((x)[0], e) && ME_IS_ZERO_TOL((x)[1], e) && ME_IS_ZERO_TOL((x)[2], e))
#define ME_IS_ZERO_4VEC_TOL(x, e) (ME_IS_ZERO_3VEC_TOL(x, e) && ME_IS_ZERO_TOL((x)[3], e))
#define ME_ARE_EQUAL_3VEC_TOL(x, y, e)                                                                                 \
    (ME_ARE_EQUAL_TOL((x)[0], (y)[0], e) && ME_ARE_EQUAL_TOL((x)[1], (y)[1], e) && ME_ARE_EQUAL_TOL((x)[2], (y)[2], e))
#define ME_ARE_EQUAL_4VEC_TOL(x, y, e) (ME_ARE_EQUAL_3VEC_TOL(x, y, e) && ME_ARE_EQUAL_TOL((x)[3], (y)[3], e))
#define ME_IS_ZERO(x)                  ME_IS_ZERO_TOL(x, ME_SMALL_EPSILON)
#define ME_IS_ZERO_3VEC(x)             ME_IS_ZERO_3VEC_TOL(x, ME_SMALL_EPSILON)
#define ME_IS_ZERO_4VEC(x)             ME_IS_ZERO_4VEC_TOL(x, ME_SMALL_EPSILON)
#define ME_ARE_EQUAL(x, y)             ME_ARE_EQUAL_TOL(x, y, ME_SMALL_EPSILON)
#define ME_ARE_EQUAL_3VEC(x, y)        ME_ARE_EQUAL_3VEC_TOL(x, y, ME_SMALL_EPSILON)
#define ME_ARE_EQUAL_4VEC(x, y)        ME_ARE_EQUAL_4VEC_TOL(x, y, ME_SMALL_EPSILON)

ME_END_C

#endif
