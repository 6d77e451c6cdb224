/* Inside Mst: what advice (MstAdvise.h) is made of.
 *
 *     part        file            what
 *     settings    mst_setting.c   which are worth a trial, and how each is applied
 *     copies      mst_copy.c      runs a setting in a copy of the process, which leaves a record
 *     judgement   mst_judge.c     records -> trials: errors, ratios, verdicts, sentences
 *     course      MstAdvise.c     what is run in which order; the API
 */
#ifndef MST_ADVISE_I_H
#define MST_ADVISE_I_H

#include "MdtReport.h"
#include "MstAdvise.h"
#include "universe/mst_universe_i.h"
#include <stddef.h>

/* ---- settings ---------------------------------------------------------------------------------------------------- */

/* What is turned; of one knob one setting is taken. */
typedef enum MstKnob {
    MST_KNOB_NONE,
    MST_KNOB_REFERENCE, /* value: sub-steps; value2: is something fast? */
    MST_KNOB_TIMED,
    MST_KNOB_SUBSTEPS,
    MST_KNOB_SOLVER,
    MST_KNOB_ACCURACY,
    MST_KNOB_BUDGET,
    MST_KNOB_ORDER,
    MST_KNOB_FRICTION,
    MST_KNOB_SWEPT,
    MST_KNOB_SLEEP,           /* value: METRUE or MEFALSE */
    MST_KNOB_SLEEP_THRESHOLD, /* value: a factor of speeds */
    MST_KNOB_REUSE,
    MST_KNOB_SCALES, /* values: length and mass */
    MST_KNOBS
} MstKnob;

typedef struct MstSetting {
    MstKnob knob;
    double value, value2;
    char call[112];
} MstSetting;

enum { MST_SETTINGS = 24 }; /* at most: two or three of each knob */

/* What the scene as it is shows of itself, by which settings are chosen. */
typedef struct MstSceneTraits {
    MeBool hasContacts, hasJoints, hasFast, hasExactContacts, hasLimits, hasLargeIsland, hasRunners;
} MstSceneTraits;

int mst_settingsPlan(MstUniverseID u, const MstSceneTraits *traits, MstSetting setting[MST_SETTINGS]);
void mst_settingApply(MstUniverseID u, const MstSetting *s);

/* ---- copies ------------------------------------------------------------------------------------------------------ */

/* A body at a moment. */
typedef struct MstSample {
    double position[3], quaternion[4], velocity[3], turning[3], radius; /* of gyration */
} MstSample;

/* What a copy leaves: memory that it shares with the process that asked. */
typedef struct MstRecord {
    int steps;       /* done */
    int isReporting; /* the report was on in all of them */
    double time, work;
    double penetration, jointGap, residualVelocity; /* the largest */
    MstSceneTraits traits;
    int sampleCount;
    /* Behind it: of each sample its number of bodies and energies, then the bodies, most of them first. */
} MstRecord;

typedef struct MstMoment {
    int bodies;
    double kinetic, energy; /* J */
} MstMoment;

/* How much of a scene is kept. */
typedef struct MstRecordSize {
    int steps, warmUp, stride, samples, bodies;
} MstRecordSize;

size_t mst_recordBytes(const MstRecordSize *size);
MstMoment *mst_recordMoment(const MstRecord *r, int sample);
MstSample *mst_recordSamples(const MstRecord *r, const MstRecordSize *size, int sample);

/* A copy's own state; all of it is the asking process's but for `record`. */
typedef struct MstCopy {
    MstRecord *record;
    MstRecordSize size;
    double begun; /* s, the step that is being made */
} MstCopy;

MstRecord *mst_recordCreate(const MstRecordSize *size);
void mst_recordDestroy(MstRecord *r, const MstRecordSize *size);
/* Makes a copy of the process with these settings. METRUE in the copy, which goes on; MEFALSE in the process that
 * asked, once the copy has ended, after `limit` s at the latest. */
MeBool mst_copyRun(MstCopy *c, MstUniverseID u, const MstSetting *const setting[], int count, double limit);
void mst_copyStepBegins(MstCopy *c);
/* Does not return from the last step. */
void mst_copyStepEnds(MstCopy *c, MstUniverseID u, double step);
double mst_clock(void); /* s, monotonic */

/* ---- judgement --------------------------------------------------------------------------------------------------- */

/* Up to which sample two records agree within the tolerance; -1: not in the first. Tells the largest difference until
 * then. */
int mst_recordsAgree(const MstRecord *a, const MstRecord *b, const MstRecordSize *size, double tolerance,
                     double *largest);
/* Errors and residuals of a trial. */
void mst_trialMeasure(MstTrial *t, const MstRecord *r, const MstRecord *reference, const MstRecordSize *size,
                      int lastSample);
/* Its ratios, and its time, if costs are times: costs of each round, negative where there was none. */
void mst_trialTime(MstTrial *t, const double *cost, const double *asItIs, int rounds, MeBool isTime);
/* What to do about all trials but the first, and sentences. */
void mst_trialsRate(MstTrial *t, int count, double tolerance, MeBool isCompared);
/* Whether a trial is no worse than another, or within the tolerance. */
MeBool mst_trialIsAcceptable(const MstTrial *t, const MstTrial *asItIs, double tolerance);

#endif
