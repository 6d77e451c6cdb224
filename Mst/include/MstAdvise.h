/** @file MstAdvise.h
 *  Advice: which settings would make a program's own scene faster, at what error, measured by trying them. Beyond
 *  Karma.
 *
 *      MstAdvise(universe, 0, 0, 0);       // once the scene is made: before the step from which on it is to be tried
 *      ...                                 // the program goes on as ever; its next MstUniverseStep prints the advice
 *
 *  A setting is tried on a copy of the whole process (fork): the universe, whatever callbacks keep, the program's own
 *  variables. In the copy MstUniverseStep applies the setting and returns, and the program goes on there as it would
 *  have gone on, until it has made as many steps as are wanted; the copy ends in the last of them. Then the next
 *  setting has its turn. The program's own process waits in MstUniverseStep meanwhile, and nothing in it changes: it
 *  goes on bit for bit as if it had not asked. Each trial begins in the same state, so that trials can be compared body
 *  by body.
 *
 *  What a copy does outside of its memory is done in earnest: files it writes, messages it sends, a window it draws
 *  into. So a program that asks for advice draws nowhere (-null); its texts to stdout and stderr are swallowed in
 *  copies, and MstAdviseIsCopy tells the rest of it to hold still. Threads of the program do not exist in copies; the
 *  universe is stepped by the calling thread alone there, with the same result. A copy that crashes or hangs is ended
 *  and reported. A program that calls a setter in every step undoes what is tried by that setter.
 *
 *  **Errors** are measured against a reference: the exact solver with 8 sub-steps, contacts met in time, no sleep, no
 *  reuse of contacts, models swept where something is fast. How long it is worth something the reference says itself:
 *  with 4 sub-steps instead of 8 it stays within the tolerance for a while; then chance decides, and errors are
 *  measured up to that time. Contacts are found once a step in the reference, too: an error that only a shorter step
 *  would show is not seen. Penetration, joint gaps and times are those of all steps (MdtReport.h).
 *
 *  **Times** are those of MstUniverseStep on the processor's clock of the thread, without the first steps, which pay
 *  for the copied memory. Settings take turns, so that what else the machine does hits all of them, and the medians
 *  count.
 *
 *  Where the system has no process left for a copy, there is no advice (a count of 0). Bad input gets a warning, and
 *  MEFALSE or nothing.
 */
#ifndef MSTADVISE_H
#define MSTADVISE_H

#include "MstTypes.h"

ME_BEGIN_C

/** What is asked for. */
typedef struct MstAdviceParams {
    MeReal seconds;   /**< s of the scene that each copy runs, > 0. Default 3. */
    MeReal after;     /**< s of the scene before that, >= 0: for what happens later. Default 0. */
    MeReal tolerance; /**< m: errors below it, of places, penetration and joints, count as none. Default 0: a thousandth
                           of the length scale. */
    int rounds;       /**< how often each setting is timed, 1..15. Default 5. */
    MeReal patience;  /**< s on the clock that all of it may take, > 0, and a quarter more for what is to be taken
                           together. Default 60. When it is over, what has been measured has to do. */
    MeBool byWork; /**< Settings are judged by MdtReport::work instead of time, which is the same on every machine, but
                           does not count collision and the fast solver's passes. Default no. */
} MstAdviceParams;

/** What is to be done about a setting. */
typedef enum MstVerdict {
    MstVerdictNone,   /**< nothing: it gains nothing */
    MstVerdictTake,   /**< faster, and no less exact than now, or within the tolerance */
    MstVerdictMend,   /**< the cheapest that is within the tolerance, which the scene as it is is not */
    MstVerdictTrade,  /**< faster, and less exact: see whether its error is seen */
    MstVerdictExact,  /**< at most half of the error, for more time */
    MstVerdictFailed, /**< the copy ended early, by a crash or the program's own end, or was too slow */
} MstVerdict;

/** One setting, as tried. */
typedef struct MstTrial {
    char setting[128];       /**< the calls to make; of the first trial "as it is" */
    char advice[320];        /**< a sentence */
    MstVerdict verdict;      /**< None of the first trial. */
    int steps;               /**< that the copy has made */
    MeReal time;             /**< s of a step, the median of the rounds */
    MeReal ratio;            /**< of the time, or of the work, to that of the scene as it is; median of the rounds */
    MeReal leastRatio;       /**< least and largest of the rounds */
    MeReal largestRatio;     /**< the same */
    MeReal work;             /**< millions of multiplications in a step (MdtReport) */
    MeReal error;            /**< m: the farthest that any point of a body at its radius of gyration gets from where it
                                  is in the reference */
    MeReal velocityError;    /**< m/s: the same of velocities, the mean over the time of the worst body */
    MeReal energyError;      /**< as a share of the largest kinetic energy in the reference */
    MeReal penetration;      /**< m, the deepest of all steps */
    MeReal jointGap;         /**< m, the largest of all steps */
    MeReal residualVelocity; /**< m/s, the largest that a solver left */
} MstTrial;

/** The outcome. It lives as long as the call of MstAdviceCB. */
typedef struct MstAdvice {
    const MstTrial *trial;   /**< the first: as it is; the last: all that is to be taken together, if that is several */
    int count;               /**< of trials; 0: not even the scene as it is could be run */
    int best;                /**< the trial to follow; 0: leave all as it is */
    int follow[16];          /**< the trials whose settings it has: itself, or those that are to be taken together */
    int followCount;         /**< how many; 0 if best is 0 */
    int bodies;              /**< at the start */
    MeReal step;             /**< s, its length */
    MeReal tolerance;        /**< m */
    MeReal comparedTime;     /**< s for which the reference holds; 0: not for a step, and no errors are known */
    MeReal referenceError;   /**< m, of the reference in that time, by its own account */
    const char *restriction; /**< what was left out, a sentence; "" if nothing was */
} MstAdvice;

/** Is told the outcome, within the MstUniverseStep that has found it. It may print, keep copies, call exit(), or change
 *  what it likes (docs/simulation.md, "Callbacks"). */
typedef void(MEAPI *MstAdviceCB)(const MstAdvice *advice, void *userdata);

/** Sets all members to their defaults. */
MEPUBLIC void MEAPI MstAdviceParamsReset(MstAdviceParams *p);
/**
 * Asks for advice about the steps that follow: the first MstUniverseStep after @a params->after seconds of the scene
 * tries settings, takes up to @a params->patience seconds for it, and calls @a done with @a userdata. Null params: the
 * defaults. A null @a done: MstAdvicePrint. Not while an earlier call is waiting or in the middle of a step. Settings
 * are only tried, never kept. For programs that step by MstUniverseStep.
 */
MEPUBLIC MeBool MEAPI MstAdvise(const MstUniverseID u, const MstAdviceParams *params, MstAdviceCB done, void *userdata);
/** Is this process a copy in which a setting is being tried? */
MEPUBLIC MeBool MEAPI MstAdviseIsCopy(const MstUniverseID u);
/** Prints the outcome by MeInfo: a table, and what to do. */
MEPUBLIC void MEAPI MstAdvicePrint(const MstAdvice *advice);

ME_END_C

#endif
