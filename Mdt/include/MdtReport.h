/** @file MdtReport.h
 *  The report of a step: what was solved, in which way, what it cost, and how far off the result is. The engine tells
 *  its own error.
 *
 *  Off by default: then nothing is computed, and the report is zero. A simulation is the same, bit for bit, with it and
 *  without. Units are SI, the frame is the world's.
 *
 *  Bad input: a null or destroyed world, a null place for the report, and a partition that there is not get a warning
 *  and MEFALSE, 0, or a report of zeros.
 */
#ifndef MDTREPORT_H
#define MDTREPORT_H

#include "MdtTypes.h"

ME_BEGIN_C

/** How a partition was stepped, in the order of effort: a world's way is the last of its partitions'. */
typedef enum MdtReportWay {
    MdtReportWayNone,    /**< put to rest, or without rows: free motion */
    MdtReportWayRest,    /**< at rest, and nothing has changed: the last step's answer was taken without a solve */
    MdtReportWayKept,    /**< the last step's answer still held: nothing was factored */
    MdtReportWayFast,    /**< solved by passes over the manifolds (MdtWorldSetSolver) */
    MdtReportWayExact,   /**< solved */
    MdtReportWayTimed,   /**< bodies met or came to stick, at the moment when they did (MdtWorldSetTimedContacts) */
    MdtReportWayDivided, /**< the step was halved, because motion in it was violent */
    MdtReportWayLimited, /**< work or iterations ran out (MdtWorldSetWorkBudget, MdtWorldSetMaxLCPIterations) */
} MdtReportWay;

/** Why that solver (MdtWorldSetSolver); of a world, the first partition's whose way is the world's. */
typedef enum MdtReportWhy {
    MdtReportWhyNone,  /**< nothing was solved */
    MdtReportWhyAsked, /**< the program's choice, or an accuracy of 0 */
    MdtReportWhyUnfit, /**< exact: with rows that the program makes, with more than the cap, where bodies fly that keep
                            their energy, or without contacts where the fast one is asked for, or has not met the
                            accuracy */
    MdtReportWhyCheap, /**< exact: it costs no more than the fast solver; without contacts a hundred times as much */
    MdtReportWhyAfforded, /**< exact: the world's account of exact work pays it */
    /* those of the fast solver */
    MdtReportWhyFlight,    /**< nothing in it touches the world, and it is not met in time (MdtWorldSetTimedContacts) */
    MdtReportWhyDear,      /**< the exact one costs more than the account pays */
    MdtReportWhyTakenOver, /**< for the rest of a step, in which the exact solver left joints open or ran out of work */
} MdtReportWhy;

/** What time is told of. */
typedef enum MdtReportStage {
    MdtReportStageRows,      /**< making rows of constraints, and the impacts at the start of a part */
    MdtReportStageSolve,     /**< finding their forces */
    MdtReportStageIntegrate, /**< moving the bodies, free motion included; reading back; making the report */
    MdtReportStages,         /**< how many there are */
} MdtReportStage;

/**
 * Of one partition, or of all partitions of a step: counts, energies and times are sums, errors are maxima. Solves
 * count that were thrown away, because their part of the step was divided; their errors do not. The work of impacts
 * shows in the time only. Of small partitions that were solved together (MdtWorldSetSolver: debris), each has the
 * parts, passes, iterations and residuals of all, and its share of their work and time, by bodies and rows.
 */
typedef struct MdtReport {
    /* what was solved */
    int bodies; /**< those that are at rest are in no partition; in the step that puts them to rest they still are */
    int constraints; /**< joints and contacts, contact groups, and the contacts in them */
    int rows;        /**< of a divided step: the most of any part */
    /* in which way */
    MdtReportWay way;
    MdtReportWhy why;
    int parts;          /**< that the step was taken in: 1 if it was not divided, 0 of a partition put to rest */
    int rested;         /**< 1: the way is MdtReportWayRest; no rows are made then, and no error is measured */
    int composed;       /**< compositions of order 4 (MdtWorldSetIntegratorOrder), in each sub-step one where no body
                             turns far; 0: all was of order 2 */
    int events;         /**< how often a step was divided where bodies met or came to stick */
    int passes;         /**< linearizations */
    int iterations;     /**< of Newton's method (Karma: pivots) */
    int factorizations; /**< of sparse matrices */
    int stages;         /**< velocity stages */
    int freezes;        /**< passes whose friction bounds were not renewed, since that did not settle */
    int fallbacks;      /**< parts whose forces are within bounds, but inexact, or whose bodies were stopped; there is a
                        warning too where the step is too long or the program has capped the iterations */
    int conflicts;      /**< parts with constraints that contradict each other: a compromise was taken */
    int limited; /**< parts whose work or iterations ran out: the best answer so far was taken; a fallback, too */
    MeReal work; /**< millions of multiplications, as MdtWorldSetWorkBudget counts them; that of impacts included */
    /* how far off */
    MeReal residualVelocity; /**< m/s: largest velocity of a row that its force should have prevented (angular: times
                                the bodies' radius of gyration) */
    /** The same in tolerances, of which each contact and joint has its own: accuracy (MdtWorldSetAccuracy) and a tenth
     *  of its bodies' change of velocity, less where it bears more than their own weight or joins unequal masses, and
     *  at most 1e-4 of a size a step. Up to 1 the accuracy is met; 0: by the exact solver, to its own tolerance. */
    MeReal excess;
    MeReal residualForce; /**< N: largest change of a row's force that would prevent it (angular: N m) */
    MeReal jointError;    /**< m: largest error left in a joint against what this step asked (angular: rad) */
    MeReal jointGap;      /**< m: how far the bodies of a joint are from where it holds them, at the end of the step */
    MeReal jointTurn;     /**< rad: the same for joints that hold directions */
    MeReal penetration;   /**< m: of the deepest contact as the step began, 0 where none is deep, or at rest */
    /* energy at the end of the step */
    MeReal kineticEnergy;   /**< J, of the bodies */
    MeReal potentialEnergy; /**< J, in the world's gravity, 0 at the origin; of gravity only, not of springs */
    /* cost */
    /** s, by MdtReportStage, on a monotonic clock. Of small partitions, one in sixteen is timed by itself; the others
     *  are timed together, and their time is divided as that one's was and by bodies and rows. Sums are measured. */
    MeReal time[MdtReportStages];
} MdtReport;

/**
 * From the next step on, steps are reported. What is reported already is kept. Memory is allocated the first time, for
 * as many partitions as the world may have bodies (of a world without a limit: when a step needs it), and lives as long
 * as the world; should there be none, a fatal error is reported and the report stays off, or there is none of that
 * step.
 */
MEPUBLIC void MEAPI MdtWorldEnableReport(const MdtWorldID w);
/** Steps are not reported any more; what was reported is gone. */
MEPUBLIC void MEAPI MdtWorldDisableReport(const MdtWorldID w);
/** Whether steps are reported. */
MEPUBLIC MeBool MEAPI MdtWorldReportIsEnabled(const MdtWorldID w);

/**
 * Writes the report of the world's last step to @a report: sums and maxima over its partitions. MEFALSE and zeros when
 * the report is off, or no step was taken since it was enabled. Called during a step, it tells of the
 * partitions so far.
 */
MEPUBLIC MeBool MEAPI MdtWorldGetReport(const MdtWorldID w, MdtReport *report);
/** The number of partitions of the last step; 0 where MdtWorldGetReport returns MEFALSE. */
MEPUBLIC int MEAPI MdtWorldGetReportCount(const MdtWorldID w);
/**
 * Writes the report of one partition of the last step, 0 <= @a partition < MdtWorldGetReportCount, to @a report; the
 * numbers are those that MdtBodyGetPartition tells. MEFALSE and zeros when the report is off, or no step was taken
 * since it was enabled, which is no misuse.
 */
MEPUBLIC MeBool MEAPI MdtWorldGetPartitionReport(const MdtWorldID w, const int partition, MdtReport *report);

ME_END_C

#endif
