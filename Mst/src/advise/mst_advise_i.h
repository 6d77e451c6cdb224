/* Inside Mst: the parts of advice (MstAdvise.h).
 *
 *     part        file            contents
 *     settings    mst_setting.c   which settings are worth a trial, and how each is applied
 *     copies      mst_copy.c      runs a setting in a copy of the process, which writes a record
 *     evaluation  mst_judge.c     records -> trials: errors, ratios, verdicts, sentences
 *     sequence    MstAdvise.c     the order of trials; the API
 */
#ifndef MST_ADVISE_I_H
#define MST_ADVISE_I_H

#include "MdtReport.h"
#include "MstAdvise.h"
#include "universe/mst_universe_i.h"
#include <stddef.h>

/* ---- settings ---------------------------------------------------------------------------------------------------- */

/* What a setting changes; settings that are combined change different knobs. */
typedef enum MstKnob {
    MST_KNOB_NONE,
    MST_KNOB_REFERENCE, /* value: number of sub-steps; value2: whether to sweep all models with bodies */
    MST_KNOB_TIMED,
    MST_KNOB_SUBSTEPS,
    MST_KNOB_SOLVER,
    MST_KNOB_ACCURACY,
    MST_KNOB_BUDGET,
    MST_KNOB_ORDER,
    MST_KNOB_FRICTION,
    MST_KNOB_SWEPT,
    MST_KNOB_SLEEP,           /* value: METRUE or MEFALSE */
    MST_KNOB_SLEEP_THRESHOLD, /* value: multiplier of the threshold speeds and accelerations */
    MST_KNOB_REUSE,
    MST_KNOB_SCALES, /* values: length and mass */
    MST_KNOBS
} MstKnob;

typedef struct MstSetting {
    MstKnob knob;
    double value, value2;
    char call[112];
} MstSetting;

enum { MST_SETTINGS = 24 }; /* maximum number of settings: two or three of each knob */

/* Properties of the unchanged scene, by which settings are selected. */
typedef struct MstSceneTraits {
    MeBool hasContacts, hasJoints, usesFastSolver, usesExactSolver, exceedsBudget, hasLargeIsland, hasFastBodies;
} MstSceneTraits;

/* Writes the settings that are worth a trial; returns their number. */
int mst_settingsPlan(MstUniverseID u, const MstSceneTraits *traits, MstSetting setting[MST_SETTINGS]);
void mst_settingApply(MstUniverseID u, const MstSetting *s);

/* ---- copies ------------------------------------------------------------------------------------------------------ */

/* The state of a body in a sample. */
typedef struct MstSample {
    double position[3], quaternion[4], velocity[3], angularVelocity[3], radius; /* `radius`: radius of gyration */
} MstSample;

/* The results of a copy, in memory that it shares with the original process. */
typedef struct MstRecord {
    int steps;       /* completed steps */
    int isReporting; /* MdtReport was available in all steps */
    double time, work;
    double penetration, jointGap, residualVelocity; /* the largest of all steps */
    MstSceneTraits traits;
    int sampleCount;
    /* Followed in memory by an MstMoment per sample, then the MstSamples of each sample. */
} MstRecord;

typedef struct MstMoment {
    int bodies;
    double kinetic, energy; /* J */
} MstMoment;

/* The dimensions of a record: the number of steps, steps before timing starts, steps per sample, samples, and bodies
 * per sample. */
typedef struct MstRecordSize {
    int steps, warmUp, stride, samples, bodies;
} MstRecordSize;

size_t mst_recordBytes(const MstRecordSize *size);
MstMoment *mst_recordMoment(const MstRecord *r, int sample);
MstSample *mst_recordSamples(const MstRecord *r, const MstRecordSize *size, int sample);

/* The state of a copy. Only `record` is shared with the original process. */
typedef struct MstCopy {
    MstRecord *record;
    MstRecordSize size;
    double stepBegin; /* s, CPU time at which the present step began */
} MstCopy;

MstRecord *mst_recordCreate(const MstRecordSize *size);
void mst_recordDestroy(MstRecord *r, const MstRecordSize *size);
/* Makes a copy of the process with these settings. Returns METRUE in the copy, which continues; MEFALSE in the original
 * process, once the copy has ended, after `limit` s at the latest. */
MeBool mst_copyRun(MstCopy *c, MstUniverseID u, const MstSetting *const setting[], int count, double limit);
/* Starts the timing of a step in the copy. */
void mst_copyStepBegins(MstCopy *c);
/* Records a step of the copy; ends the process after the last step. */
void mst_copyStepEnds(MstCopy *c, MstUniverseID u, double step);
double mst_clock(void); /* s, monotonic */

/* ---- evaluation -------------------------------------------------------------------------------------------------- */

/* The last sample up to which two records agree within the tolerance; -1: they disagree in the first. Sets the largest
 * difference until then. */
int mst_recordsAgree(const MstRecord *a, const MstRecord *b, const MstRecordSize *size, double tolerance,
                     double *largest);
/* Sets the errors and residuals of a trial. */
void mst_trialMeasure(MstTrial *t, const MstRecord *r, const MstRecord *reference, const MstRecordSize *size,
                      int lastSample);
/* Sets a trial's ratios of cost to that of the scene as it is, and its time if isTime (costs are seconds). Both arrays
 * have one cost per round, negative where that round was not run. */
void mst_trialSetCosts(MstTrial *t, const double *cost, const double *asItIs, int rounds, MeBool isTime);
/* Sets verdicts and sentences of all trials but the first. */
void mst_trialsRate(MstTrial *t, int count, double tolerance, MeBool isCompared);
/* Whether a trial's errors are at most 10 % above those of another one, or within the tolerance. */
MeBool mst_trialIsAcceptable(const MstTrial *t, const MstTrial *asItIs, double tolerance);

#endif
