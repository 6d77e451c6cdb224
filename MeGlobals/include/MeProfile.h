/** @file MeProfile.h
 *  How much time is spent where (User Guide app. B mentions it as the viewer's companion).
 *
 *  A program marks sections of its code, which may contain others, and frames:
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
 *  Sections are told apart by the text of their names and by the sections that they are in. While timing is
 *  off, marks cost one test each; they are never compiled out. One thread is timed, the one that started
 *  timing: marks in other threads do nothing, and only that thread may read results or stop.
 *  Memory comes from MeMemoryAPI, when a section is met for the first time and, with kMeProfileLogAll, as the
 *  log grows; when there is none, timing stops.
 */
#ifndef MEPROFILE_H
#define MEPROFILE_H

#include "MePrecision.h"

ME_BEGIN_C

/** What a processor's counters would count. There are no counters on this platform: time is measured in any
 *  mode. */
typedef enum MeProfileCounterModes_enum {
    kMeProfileCounterModeFlops = 0, /**< Operations with real numbers. */
    kMeProfileCounterModeCache = 1  /**< Cache misses. */
} MeProfileCounterModes_enum;

/** What is remembered besides the last finished frame. */
typedef enum MeProfileLogModes_enum {
    kMeProfileDontLog = 0,  /**< Nothing: MeProfileOutputResults has nothing to print. */
    kMeProfileLogAll = 1,   /**< Totals, and every single call: 32 bytes each, up to a million. */
    kMeProfileLogTotals = 2 /**< Totals for each section. */
} MeProfileLogModes_enum;

/** What MeProfileOutputResults prints. Event and Gnuplot need kMeProfileLogAll. */
typedef enum MeProfileOutput_enum {
    kMeProfileOutputAverage = 0, /**< For each section: calls and milliseconds per frame, worst frame. */
    kMeProfileOutputEvent = 1,   /**< For each call, as they end: frame, begin, duration. */
    kMeProfileOutputNormal = 2,  /**< For each section: calls, total, average and worst frame. The default. */
    kMeProfileOutputGnuplot = 3  /**< For each frame: its number, and a column of milliseconds per section. */
} MeProfileOutput_enum;

/** How to measure. */
typedef struct MeProfileTimerMode {
    MeProfileCounterModes_enum counter; /**< Without effect, see there. */
} MeProfileTimerMode;

/** How to report. */
typedef struct MeProfileOutput {
    MeProfileOutput_enum format; /**< What to print. */
    const char *filename;        /**< Where to, replacing the file; null for stdout. Kept as a pointer. */
} MeProfileOutput;

/** A reading of the clock. */
typedef struct MeProfileTimerResult {
    MeU64 ticks; /**< Since some moment in the past; MeProfileGetClockSpeed() ticks are a second. */
} MeProfileTimerResult;

/** @name On and off
 *  @{ */
/** Begins to measure, forgetting all that was measured before. */
MEPUBLIC void MEAPI MeProfileStartTiming(MeProfileTimerMode mode, MeProfileLogModes_enum logging);
/** Ends all sections and the frame, and measures no more. Results are still to be had. */
MEPUBLIC void MEAPI MeProfileStopTimers(void);
/** The same, and forgets and frees everything. */
MEPUBLIC void MEAPI MeProfileStopTiming(void);
/** @} */

/** @name Marks
 *  @{ */
/** Begins a frame, ending the one that has not been ended. */
MEPUBLIC void MEAPI MeProfileStartFrame(void);
/** Ends a frame. A call that is still in progress is split, here and where a frame begins: its time so far
 *  counts for this frame. What happens outside of frames counts in totals, but not in the times of any
 *  frame. */
MEPUBLIC void MEAPI MeProfileEndFrame(void);
/**
 * Begins a section, inside the one in progress.
 * @param codeSection its name, which is copied; null warns and does nothing
 * @param autoStop    not 0: when the section in progress was begun like this too, then it is ended first, so
 *                    that both are in the same outer section. Such a section also ends with its outer one and
 *                    needs no end of its own.
 */
MEPUBLIC void MEAPI MeProfileStartSectionFn(const char *codeSection, char unsigned autoStop);
/** Ends a section. Sections that were begun in it are ended too, with a warning; an end without a beginning
 *  warns and does nothing. Only the first such warning since MeProfileStartTiming is given. */
MEPUBLIC void MEAPI MeProfileEndSectionFn(const char *codeSection);
/** @} */

#define MeProfileStartSection(x, y) MeProfileStartSectionFn((x), (unsigned char)(y)) /**< The same. */
#define MeProfileEndSection(x)      MeProfileEndSectionFn((x))                       /**< The same. */

/** @name Results
 *  Of the last frame that was finished; 0 before.
 *  @{ */
/** The seconds spent in a section, wherever it is called from, with what is inside. 0 for an unknown name or
 *  null. */
MEPUBLIC MeReal MEAPI MeProfileGetSectionTime(const char *codeSection);
/** The seconds spent in all sections together. */
MEPUBLIC MeReal MEAPI MeProfileGetAllSectionTime(void);
/** Chooses format and file for MeProfileOutputResults. An unknown format warns and changes nothing. */
MEPUBLIC void MEAPI MeProfileSetOutputParameters(MeProfileOutput output);
/** Prints what has been measured. Warns if there is nothing, if the format needs a log that was not kept, or
 *  if the file cannot be written. */
MEPUBLIC void MEAPI MeProfileOutputResults(void);
/** @} */

/** @name The clock
 *  Runs whether timing is on or off, evenly, and never back.
 *  @{ */
MEPUBLIC MeU64 MEAPI MeProfileGetClockSpeed(void);                              /**< Ticks per second. */
MEPUBLIC void MEAPI MeProfileGetTimerValue(MeProfileTimerResult *const result); /**< Reads the clock. */
/** @} */

/** @name A stopwatch
 *  Independent of everything above: one section follows another, without frames and without nesting.
 *  @{ */
MEPUBLIC void MEAPI ticInit(void);    /**< Begins to measure, forgetting all that was measured before. */
MEPUBLIC void MEAPI ticCleanup(void); /**< Measures no more, forgets and frees everything. */
/** Ends the section in progress and begins another; null only ends. Does nothing before ticInit. */
MEPUBLIC void MEAPI tic(const char *name);
/** Prints calls and milliseconds of each section, into a file (replacing it) or, for null, on stdout. Warns
 *  if the file cannot be written. */
MEPUBLIC void MEAPI ticOutputResults(const char *filename);
/** @} */

ME_END_C

#endif
