/** @file MeProfile.h
 *  Profiling: the time spent in sections of code.
 *
 *  A program marks sections of its code, which may be nested, and frames:
 *
 *  @code
 *      MeProfileStartTiming(mode, kMeProfileLogTotals);
 *      for (each frame) {
 *          MeProfileStartFrame();
 *          MeProfileStartSection("Dynamics", 0);
 *          MdtWorldStep(world, step);
 *          MeProfileEndSection("Dynamics");
 *          MeProfileEndFrame();
 *      }
 *      MeProfileOutputResults();
 *      MeProfileStopTiming();
 *  @endcode
 *
 *  Sections are distinguished by their names and their enclosing sections. While timing is off, a mark costs one test;
 *  marks are never compiled out. Only the thread that started timing is timed: marks in other threads do nothing, and
 *  only that thread may read results or stop. Memory is allocated by MeMemoryAPI, for each new section and, with
 *  kMeProfileLogAll, as the log grows; without memory, timing stops.
 */
#ifndef MEPROFILE_H
#define MEPROFILE_H

#include "MePrecision.h"

ME_BEGIN_C

/** Hardware counters. There are none on this platform: time is measured in any mode. */
typedef enum MeProfileCounterModes_enum {
    kMeProfileCounterModeFlops = 0, /**< Floating-point operations. */
    kMeProfileCounterModeCache = 1  /**< Cache misses. */
} MeProfileCounterModes_enum;

/** What is stored besides the last finished frame. */
typedef enum MeProfileLogModes_enum {
    kMeProfileDontLog = 0,  /**< Nothing: MeProfileOutputResults has nothing to print. */
    kMeProfileLogAll = 1,   /**< Totals, and every call: 32 bytes each, up to a million. */
    kMeProfileLogTotals = 2 /**< Totals for each section. */
} MeProfileLogModes_enum;

/** What MeProfileOutputResults prints. Event and Gnuplot need kMeProfileLogAll. */
typedef enum MeProfileOutput_enum {
    kMeProfileOutputAverage = 0, /**< Per section: calls and milliseconds per frame, worst frame. */
    kMeProfileOutputEvent = 1,   /**< Per call, in the order of their ends: frame, begin, duration. */
    kMeProfileOutputNormal = 2,  /**< Per section: calls, total, average and worst frame. The default. */
    kMeProfileOutputGnuplot = 3  /**< Per frame: its number, and a column of milliseconds per section. */
} MeProfileOutput_enum;

/** How to measure. */
typedef struct MeProfileTimerMode {
    MeProfileCounterModes_enum counter; /**< Without effect: see MeProfileCounterModes_enum. */
} MeProfileTimerMode;

/** How to report. */
typedef struct MeProfileOutput {
    MeProfileOutput_enum format; /**< What to print. */
    const char *filename;        /**< Output file, replaced; null for stdout. The pointer is kept. */
} MeProfileOutput;

/** A reading of the clock. */
typedef struct MeProfileTimerResult {
    MeU64 ticks; /**< Since an arbitrary time; MeProfileGetClockSpeed() ticks are a second. */
} MeProfileTimerResult;

/** @name Start and stop
 *  @{ */
/** Starts timing, and discards all earlier results. */
MEPUBLIC void MEAPI MeProfileStartTiming(MeProfileTimerMode mode, MeProfileLogModes_enum logging);
/** Ends all sections and the frame, and stops timing. Results remain available. */
MEPUBLIC void MEAPI MeProfileStopTimers(void);
/** The same, and discards all results and frees the memory. */
MEPUBLIC void MEAPI MeProfileStopTiming(void);
/** @} */

/** @name Marks
 *  @{ */
/** Begins a frame; ends the present one if there is one. */
MEPUBLIC void MEAPI MeProfileStartFrame(void);
/** Ends a frame. Calls in progress are split at the begin and the end of a frame: their time so far counts for the
 *  ending frame. Time outside of frames counts in totals, but in no frame. */
MEPUBLIC void MEAPI MeProfileEndFrame(void);
/**
 * Begins a section inside the present one.
 * @param codeSection its name, which is copied; null warns and does nothing
 * @param autoStop    not 0: if the present section was begun with autoStop, too, it is ended first, so that both are in
 * the same outer section. Such a section also ends with its outer one, and needs no end of its own.
 */
MEPUBLIC void MEAPI MeProfileStartSectionFn(const char *codeSection, char unsigned autoStop);
/** Ends a section. Unfinished sections inside it are ended, too, with a warning; an end without a begin warns and does
 *  nothing. Only the first such warning since MeProfileStartTiming is given. */
MEPUBLIC void MEAPI MeProfileEndSectionFn(const char *codeSection);
/** @} */

#define MeProfileStartSection(x, y) MeProfileStartSectionFn((x), (unsigned char)(y)) /**< The same. */
#define MeProfileEndSection(x)      MeProfileEndSectionFn((x))                       /**< The same. */

/** @name Results
 *  Results of the last finished frame; 0 before there is one.
 *  @{ */
/** The seconds spent in a section, inner sections included, summed over all enclosing sections. 0 for null or an
 *  unknown name. */
MEPUBLIC MeReal MEAPI MeProfileGetSectionTime(const char *codeSection);
/** The seconds spent in all sections. */
MEPUBLIC MeReal MEAPI MeProfileGetAllSectionTime(void);
/** Sets format and file of MeProfileOutputResults. An unknown format warns and changes nothing. */
MEPUBLIC void MEAPI MeProfileSetOutputParameters(MeProfileOutput output);
/** Prints the results. Warns if there are none, if the format needs a log that was not kept, or if the file cannot be
 *  written. */
MEPUBLIC void MEAPI MeProfileOutputResults(void);
/** @} */

/** @name The clock
 *  Monotonic, and independent of timing.
 *  @{ */
MEPUBLIC MeU64 MEAPI MeProfileGetClockSpeed(void);                              /**< Ticks per second. */
MEPUBLIC void MEAPI MeProfileGetTimerValue(MeProfileTimerResult *const result); /**< Reads the clock. */
/** @} */

/** @name A stopwatch
 *  Independent of all functions above: consecutive sections, without frames and nesting.
 *  @{ */
MEPUBLIC void MEAPI ticInit(void);    /**< Starts measuring, and discards earlier results. */
MEPUBLIC void MEAPI ticCleanup(void); /**< Stops measuring, discards results and frees the memory. */
/** Ends the present section and begins another one; null only ends. Does nothing before ticInit. */
MEPUBLIC void MEAPI tic(const char *name);
/** Prints calls and milliseconds of each section to a file, which is replaced, or to stdout if null. Warns if the file
 *  cannot be written. */
MEPUBLIC void MEAPI ticOutputResults(const char *filename);
/** @} */

ME_END_C

#endif
