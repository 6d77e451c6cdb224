/** @file MstAdvise.h
 *  Advice: measures which settings would make a program's own scene faster, and at what error, by trying them. Beyond
 *  Karma.
 *
 *      MstAdvise(universe, 0, 0, 0);       // once the scene is made, before the first step to be measured
 *      ...                                 // the program goes on as usual; its next MstUniverseStep prints the advice
 *
 *  Each setting is tried in a copy of the whole process (fork), with the universe, the program's variables and the
 *  state of its callbacks. In the copy, MstUniverseStep applies the setting and returns; the program continues until
 *  the wanted number of steps is made, and the copy ends in the last of them. Settings are tried one after the other.
 *  Meanwhile the original process waits in MstUniverseStep, unchanged: it continues bit for bit as without advice. All
 *  trials begin in the same state, so they can be compared body by body.
 *
 *  Effects of a copy outside its memory are real: files it writes, messages it sends, a window it draws into. So a
 *  program that asks for advice must not draw (-null). Texts to stdout and stderr are discarded in copies; code with
 *  other effects checks MstAdviseIsCopy. The program's threads do not exist in copies; there the calling thread steps
 *  the universe alone, with the same result. A copy that crashes or hangs is ended and reported. A setter that the
 *  program calls in every step overrides the setting that is tried.
 *
 *  **Errors** are measured against a reference: the exact solver with 8 sub-steps, contacts at their time of impact, no
 *  sleep, no reuse of contacts, and swept models where a body is fast. The reference is compared with a run of 4
 *  sub-steps: errors are measured only up to the time at which the two differ by more than the tolerance, as the motion
 *  is chaotic from then on. The reference, too, finds contacts once a step: errors that only a shorter step would
 *  reveal are not seen. Penetration, joint gaps and times are those of all steps (MdtReport.h).
 *
 *  **Times** are the CPU times of the thread in MstUniverseStep, without the first steps, which pay for copy-on-write
 *  of memory. Settings are timed in turns, so that other load of the machine affects all of them, and medians are used.
 *
 *  Where the system cannot create a process, there is no advice (a count of 0). Bad input gets a warning; the function
 *  then returns MEFALSE or does nothing.
 */
#ifndef MSTADVISE_H
#define MSTADVISE_H

#include "MstTypes.h"

ME_BEGIN_C

/** What to measure. */
typedef struct MstAdviceParams {
    MeReal seconds;   /**< s that each copy simulates, > 0. Default 3. */
    MeReal after;     /**< s to simulate before the trials begin, >= 0. Default 0. */
    MeReal tolerance; /**< m: errors of position, penetration and joints below it count as none. Default 0: 0.001 of the
                           length scale. */
    int rounds;       /**< number of timings of each setting, 1..15. Default 5. */
    MeReal patience;  /**< wall-clock time for all trials, s, > 0; the trial of all advised settings together may take a
                           quarter more. Default 60. When it is over, the advice uses what has been measured. */
    MeBool byWork; /**< Settings are compared by MdtReport::work instead of time: the same on every machine, but without
                        collision and the passes of the fast solver. Default no. */
} MstAdviceParams;

/** The advice about a setting. */
typedef enum MstVerdict {
    MstVerdictNone,   /**< no gain: leave it */
    MstVerdictTake,   /**< faster, and no less exact than now or within the tolerance: use it */
    MstVerdictMend,   /**< needed: the present scene exceeds the tolerance, and this is the cheapest setting within
                           it */
    MstVerdictTrade,  /**< faster, but less exact: check whether the error is visible */
    MstVerdictExact,  /**< at most half the error, but slower */
    MstVerdictFailed, /**< the copy ended early (a crash, or the program's end), or was too slow */
} MstVerdict;

/** The result for one setting. */
typedef struct MstTrial {
    char setting[128];       /**< the calls to make; "as it is" in the first trial */
    char advice[320];        /**< a sentence */
    MstVerdict verdict;      /**< MstVerdictNone for the first trial. */
    int steps;               /**< steps that the copy completed */
    MeReal time;             /**< s per step, median of the rounds */
    MeReal ratio;            /**< time (or work) relative to the unchanged scene, median of the rounds */
    MeReal leastRatio;       /**< smallest ratio of the rounds */
    MeReal largestRatio;     /**< largest ratio of the rounds */
    MeReal work;             /**< millions of multiplications per step (MdtReport) */
    MeReal error;            /**< m: the largest distance from the reference, over bodies and time, of a point at the
                                  body's radius of gyration */
    MeReal velocityError;    /**< m/s: the same for velocities, as a mean over time for the worst body */
    MeReal energyError;      /**< relative to the largest kinetic energy in the reference */
    MeReal penetration;      /**< m, the largest of all steps */
    MeReal jointGap;         /**< m, the largest of all steps */
    MeReal residualVelocity; /**< m/s, the largest residual of a solver */
} MstTrial;

/** The result of all trials. Valid during the call of MstAdviceCB. */
typedef struct MstAdvice {
    const MstTrial *trial;   /**< first the unchanged scene; last all advised settings together, if there are several */
    int count;               /**< number of trials; 0: not even the unchanged scene could be run */
    int best;                /**< index of the advised trial; 0: change nothing */
    int follow[16];          /**< the trials whose settings make up the best one: itself, or several to be combined */
    int followCount;         /**< number of entries in follow; 0 if best is 0 */
    int bodies;              /**< bodies at the start */
    MeReal step;             /**< s, the length of a step */
    MeReal tolerance;        /**< m */
    MeReal comparedTime;     /**< s for which the reference is valid; 0: for less than a step, so that no errors are
                                  known */
    MeReal referenceError;   /**< m, estimated error of the reference in comparedTime */
    const char *restriction; /**< a sentence about omitted trials or steps; "" if there are none */
} MstAdvice;

/** Receives the result, within the MstUniverseStep that has computed it. It may print, copy the advice, call exit(), or
 *  change any object (docs/simulation.md, "Callbacks"). */
typedef void(MEAPI *MstAdviceCB)(const MstAdvice *advice, void *userdata);

/** Sets all members to their defaults. */
MEPUBLIC void MEAPI MstAdviceParamsReset(MstAdviceParams *p);
/**
 * Requests advice about the steps that follow: the first MstUniverseStep after @a params->after simulated seconds tries
 * settings for up to @a params->patience seconds, and calls @a done with @a userdata. Null params: the defaults. A null
 * @a done: MstAdvicePrint. Refused while an earlier request waits, and in the middle of a step. Settings are only
 * tried, never kept. Only for programs that step by MstUniverseStep.
 */
MEPUBLIC MeBool MEAPI MstAdvise(const MstUniverseID u, const MstAdviceParams *params, MstAdviceCB done, void *userdata);
/** Is this process a copy in which a setting is being tried? */
MEPUBLIC MeBool MEAPI MstAdviseIsCopy(const MstUniverseID u);
/** Prints the result by MeInfo: a table, and the advice. */
MEPUBLIC void MEAPI MstAdvicePrint(const MstAdvice *advice);

ME_END_C

#endif
