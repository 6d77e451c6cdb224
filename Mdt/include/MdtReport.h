/** @file MdtReport.h
 *  The report of a step: what was solved, how, at what cost, and with which errors, as the engine measures them itself.
 *
 *  Off by default: then nothing is computed, and the report is zero. The simulation is the same, bit for bit, with and
 *  without it. Units are SI, vectors are in the world frame.
 *
 *  Bad input: a null or destroyed world, a null pointer for the report, and a partition number out of range get a
 *  warning and MEFALSE, 0, or a report of zeros.
 */
#ifndef MDTREPORT_H
#define MDTREPORT_H

#include "MdtTypes.h"

ME_BEGIN_C

/** How a partition was stepped, in the order of effort; for a world, the largest value of its partitions. */
typedef enum MdtReportWay {
    MdtReportWayNone,    /**< put to sleep, or without rows: free motion */
    MdtReportWayRest,    /**< at rest and unchanged: the last step's answer was used without a solve */
    MdtReportWayKept,    /**< the last step's answer was still valid: no matrix was factored */
    MdtReportWayFast,    /**< solved by passes over the manifolds (MdtWorldSetSolver) */
    MdtReportWayExact,   /**< solved by Newton's method (MdtWorldSetSolver) */
    MdtReportWayTimed,   /**< the step was divided when bodies collided or began to stick (MdtWorldSetTimedContacts) */
    MdtReportWayDivided, /**< the step was halved because of violent motion */
    MdtReportWayLimited, /**< work or iterations ran out (MdtWorldSetWorkBudget, MdtWorldSetMaxLCPIterations) */
} MdtReportWay;

/** Why the solver was chosen (MdtWorldSetSolver); for a world, the reason of the first partition with the world's way.
 */
typedef enum MdtReportWhy {
    MdtReportWhyNone,     /**< nothing was solved */
    MdtReportWhyAsked,    /**< the program's choice, or an accuracy of 0 */
    MdtReportWhyUnfit,    /**< exact, since the fast solver is unfit: rows made by the program, a mimic of more than two
                            bodies, more rows than the cap, or bodies in free flight that conserve energy; without
                            contacts also where the program asked for the fast solver, or where it missed the
                            accuracy */
    MdtReportWhyCheap,    /**< exact: at most the cost of the fast solver; without contacts, a hundred times that */
    MdtReportWhyAfforded, /**< exact: paid by the world's accounts of exact work */
    /* reasons for the fast solver */
    MdtReportWhyFlight,    /**< no contact is with the world, and contacts are not timed (MdtWorldSetTimedContacts) */
    MdtReportWhyDear,      /**< the exact solver would cost more than the accounts pay */
    MdtReportWhyTakenOver, /**< for the rest of a step: the exact solver left joints open or ran out of work */
} MdtReportWhy;

/** Stages whose time is measured. */
typedef enum MdtReportStage {
    MdtReportStageRows,      /**< making rows of constraints, and impacts at the start of a part */
    MdtReportStageSolve,     /**< computing the forces of constraints */
    MdtReportStageIntegrate, /**< integrating the bodies, reading back, making the report */
    MdtReportStages,         /**< the number of stages */
} MdtReportStage;

/**
 * Report of one partition, or of all partitions of a step: counts, energies and times are sums, errors are maxima.
 * Solves that were discarded, because their part of the step was divided, are counted, but not their errors. Impacts
 * are in work and time only. Small partitions that were solved together (docs/solver.md, "Debris") each have the
 * parts, passes, iterations and residuals of all of them, and a share of work and time by bodies and rows.
 */
typedef struct MdtReport {
    /* size */
    int bodies;      /**< awake bodies, and those that this step puts to sleep */
    int constraints; /**< joints and contacts, contact groups, and the contacts in them */
    int rows;        /**< of a divided step: the largest number of any part */
    /* path */
    MdtReportWay way;
    MdtReportWhy why;
    int parts;          /**< parts of the step: 1 if it was not divided, 0 for a partition put to sleep */
    int rested;         /**< 1: the way is MdtReportWayRest, without rows and without measured errors */
    int composed;       /**< compositions of order 4 (MdtWorldSetIntegratorOrder): one per sub-step unless bodies
                             turn far; 0: all parts were of order 2 */
    int events;         /**< divisions of the step where bodies collided or began to stick */
    int passes;         /**< linearizations */
    int iterations;     /**< iterations of Newton's method (Karma: pivots) */
    int factorizations; /**< factorizations of sparse matrices */
    int stages;         /**< velocity stages */
    int freezes;        /**< passes with constant friction bounds, as renewing them did not converge */
    int fallbacks;      /**< parts with inexact forces within bounds, or with stopped bodies; with a
                        warning if the step is too long or the program has capped the iterations */
    int conflicts;      /**< parts with contradictory constraints, solved by a compromise */
    int limited; /**< parts that ran out of work or iterations, solved by the best answer so far; also fallbacks */
    MeReal work; /**< millions of multiplications, as MdtWorldSetWorkBudget counts them; with impacts */
    /* errors */
    MeReal residualVelocity; /**< m/s: largest velocity of a row that its force should have prevented (angular: times
                                the bodies' radius of gyration) */
    /** The largest velocity error relative to the tolerance of its contact or joint: the accuracy (MdtWorldSetAccuracy)
     *  and a tenth of its bodies' change of velocity, less if it carries more than their own weight or joins unequal
     *  masses, and at most 1e-4 of a body's size per step. Up to 1: the accuracy is reached; 0: by the exact solver, to
     *  its own tolerance. */
    MeReal excess;
    MeReal residualForce; /**< N: largest change of a row's force that would remove that velocity (angular: N m) */
    MeReal jointError;    /**< m: largest error of a joint relative to the correction due in this step (angular: rad) */
    MeReal jointGap;      /**< m: largest position error of a joint at the end of the step; of a stop if it is passed */
    MeReal jointTurn;     /**< rad: largest angle error of a joint at the end of the step */
    MeReal penetration;   /**< m: of the deepest contact at the start of the step; 0 without overlaps, or at rest */
    /* energy at the end of the step */
    MeReal kineticEnergy;   /**< J, of the bodies */
    MeReal potentialEnergy; /**< J, of the world's gravity only, 0 at the origin; without springs */
    /* cost */
    /** s, by MdtReportStage, on a monotonic clock. One in sixteen small partitions is timed alone; the others are timed
     *  together, and their time is divided by bodies and rows, and by the fractions of that one. Sums are measured. */
    MeReal time[MdtReportStages];
} MdtReport;

/**
 * Reports the steps from the next one on; if steps are reported already, the last report is kept. Memory is allocated
 * at the first call, for as many partitions as the world may have bodies (without such a limit: when a step needs it),
 * and lives as long as the world. If there is none, a fatal error is reported, and the report stays off, or that step
 * has none.
 */
MEPUBLIC void MEAPI MdtWorldEnableReport(const MdtWorldID w);
/** Ends reporting, and discards the last report. */
MEPUBLIC void MEAPI MdtWorldDisableReport(const MdtWorldID w);
/** Whether steps are reported. */
MEPUBLIC MeBool MEAPI MdtWorldReportIsEnabled(const MdtWorldID w);

/**
 * Writes the report of the world's last step to @a report: sums and maxima over its partitions. MEFALSE and zeros if
 * the report is off, or there was no step since it was enabled. During a step, it covers the partitions so far.
 */
MEPUBLIC MeBool MEAPI MdtWorldGetReport(const MdtWorldID w, MdtReport *report);
/** The number of partitions of the last step; 0 where MdtWorldGetReport returns MEFALSE. */
MEPUBLIC int MEAPI MdtWorldGetReportCount(const MdtWorldID w);
/**
 * Writes the report of one partition of the last step to @a report, 0 <= @a partition < MdtWorldGetReportCount; the
 * numbers are those of MdtBodyGetPartition. MEFALSE and zeros if the report is off, or there was no step since it was
 * enabled; that is no misuse.
 */
MEPUBLIC MeBool MEAPI MdtWorldGetPartitionReport(const MdtWorldID w, const int partition, MdtReport *report);

ME_END_C

#endif
