/* Advice: the order of trials, and the report to the program (MstAdvise.h, mst_advise_i.h).
 *
 *     scene as it is      -> its traits, and by them the settings
 *     reference, twice    -> how long it is valid
 *     each setting, once  -> errors
 *     all of them, again  -> times, in turns
 *     all settings to be combined, together
 *
 * Each of these runs a copy of the process. In the copy, the function that created it returns METRUE, as do its callers
 * up to the hook of MstUniverseStep: the copy then continues the program. */
#include "MstAdvise.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "advise/mst_advise_i.h"
#include "step/mst_step_i.h"
#include <stdio.h>
#include <string.h>

enum { MAX_ROUNDS = 15, TRIALS = MST_SETTINGS + 2 }; /* as it is, each setting, all advised settings together */
enum { MAX_STEPS = 1000000, MAX_SAMPLES = 128 };
enum { MAX_RECORD_BYTES = 64 << 20 }; /* of one copy's record */
/* A trial is ended, and fails, when it has taken this many times as long as the scene as it is. */
enum { TOO_SLOW = 20 };
/* A setting that makes steps slower than by this factor is timed only once. */
static const double maxRatioToRepeat = 3;

typedef struct MstAdviser {
    MstStepHook hook; /* first: the universe points to it */
    MstAdviceParams params;
    MstAdviceCB done;
    void *userdata;
    double elapsed; /* s simulated since the request */
    MeBool isCopy;
    MstCopy copy;
    /* during the trials: */
    double deadline; /* s, of mst_clock */
    MstSetting setting[MST_SETTINGS];
    int settings;
    MstRecord *reference; /* the reference with more sub-steps */
    int lastSample;
    int rounds; /* completed rounds of timing */
    double cost[TRIALS][MAX_ROUNDS];
    MstTrial trial[TRIALS];
    int combination[MST_KNOBS]; /* by knob: index of the chosen trial; 0: none */
    MstAdvice advice;
} MstAdviser;

/* ---- parameters -------------------------------------------------------------------------------------------------- */

void MEAPI MstAdviceParamsReset(MstAdviceParams *p) {
    if (p)
        *p = (MstAdviceParams){3, 0, 0, 5, 60, MEFALSE};
    else
        MeWarning(1, "MstAdviceParamsReset: p is null");
}

static const char *findMistake(const MstAdviceParams *p) {
    if (!(p->seconds > 0) || !MeRealIsValid(p->seconds))
        return "seconds must be above 0";
    if (!(p->after >= 0) || !MeRealIsValid(p->after))
        return "after must be 0 or more";
    if (!(p->tolerance >= 0) || !MeRealIsValid(p->tolerance))
        return "tolerance must be 0 or more";
    if (p->rounds < 1 || p->rounds > MAX_ROUNDS)
        return "rounds must be 1 to 15";
    return p->patience > 0 && MeRealIsValid(p->patience) ? 0 : "patience must be above 0";
}

static void adviserStep(MstStepHook *hook, MstUniverseID u, MeReal step, MstStepFn stepOnce);
static void adviserDestroy(MstStepHook *hook);

MeBool MEAPI MstAdvise(const MstUniverseID u, const MstAdviceParams *params, MstAdviceCB done, void *userdata) {
    MstAdviceParams all;
    MstAdviceParamsReset(&all);
    if (params)
        all = *params;
    MstStepHook **place = mst_universeHook(u, "MstAdvise");
    const char *mistake = findMistake(&all);
    if (place && mistake)
        MeWarning(1, "MstAdvise: %s", mistake);
    else if (place && *place)
        MeWarning(1, "MstAdvise: an earlier call still waits for its steps");
    if (!place || mistake || *place)
        return MEFALSE;
    MstAdviser *a = MeMemoryTakeZeroed(1, sizeof *a, "MstAdvise", "advice");
    if (!a)
        return MEFALSE;
    a->hook = (MstStepHook){adviserStep, adviserDestroy};
    a->params = all;
    a->done = done;
    a->userdata = userdata;
    *place = &a->hook;
    return METRUE;
}

MeBool MEAPI MstAdviseIsCopy(const MstUniverseID u) {
    MstStepHook **place = mst_universeHook(u, "MstAdviseIsCopy");
    return place && *place && (*place)->step == adviserStep && ((MstAdviser *)*place)->isCopy;
}

static void adviserDestroy(MstStepHook *hook) {
    MeMemoryGive(hook);
}

/* ---- one copy ---------------------------------------------------------------------------------------------------- */

static double remainingTime(const MstAdviser *a) {
    return a->deadline - mst_clock();
}

/* Runs settings in a copy, which writes the record. METRUE: this process is the copy. */
static MeBool runCopy(MstAdviser *a, MstUniverseID u, MstRecord *record, const MstSetting *const setting[], int count,
                      double limit) {
    a->copy.record = record;
    a->isCopy = mst_copyRun(&a->copy, u, setting, count, limit);
    return a->isCopy;
}

/* The cost per step of a record: work or seconds; negative if steps are missing. */
static double costPerStep(const MstAdviser *a, const MstRecord *r) {
    const MstRecordSize *size = &a->copy.size;
    if (r->steps < size->steps)
        return -1;
    return a->params.byWork ? r->work / r->steps : r->time / (size->steps - size->warmUp);
}

/* ---- size of records --------------------------------------------------------------------------------------------- */

static MstRecordSize recordSizeFor(const MstAdviser *a, MstUniverseID u, double step) {
    enum { FEW = 64, WARM_UP = 8 };
    MstRecordSize size;
    const double steps = (double)a->params.seconds / step;
    size.steps = steps < 1 ? 1 : steps > MAX_STEPS ? MAX_STEPS : (int)(steps + .5);
    size.warmUp = size.steps >= 4 * WARM_UP ? WARM_UP : 0;
    size.stride = (size.steps + MAX_SAMPLES - 1) / MAX_SAMPLES;
    size.samples = size.steps / size.stride;
    size.bodies = MdtWorldGetTotalBodies(u->world) + FEW;
    const double max = (double)MAX_RECORD_BYTES / ((double)size.samples * sizeof(MstSample));
    if (size.bodies > max)
        size.bodies = max < 1 ? 1 : (int)max;
    return size;
}

/* ---- sequence of trials ------------------------------------------------------------------------------------------ */

static const MstSetting asItIsSetting = {MST_KNOB_NONE, 0, 0, "as it is"};

/* Lists the settings of a trial; returns their number. */
static int settingsOfTrial(const MstAdviser *a, int trial, const MstSetting *setting[MST_KNOBS]) {
    int count = 0;
    if (trial == 0)
        setting[count++] = &asItIsSetting;
    else if (trial <= a->settings)
        setting[count++] = &a->setting[trial - 1];
    else
        for (int knob = 0; knob < MST_KNOBS; knob++)
            if (a->combination[knob])
                setting[count++] = &a->setting[a->combination[knob] - 1];
    return count;
}

static MeBool runTrial(MstAdviser *a, MstUniverseID u, MstRecord *record, int trial, double limit) {
    const MstSetting *setting[MST_KNOBS];
    const int count = settingsOfTrial(a, trial, setting);
    return runCopy(a, u, record, setting, count, limit);
}

static MeBool runAsItIs(MstAdviser *a, MstUniverseID u, MstRecord *record) {
    if (runTrial(a, u, record, 0, remainingTime(a)))
        return METRUE;
    if (record->steps < a->copy.size.steps) {
        a->advice.restriction = "The program ended, or its patience did, before all steps were made.";
        a->copy.size.steps = record->steps;
        if (a->copy.size.warmUp >= record->steps)
            a->copy.size.warmUp = 0;
    }
    return MEFALSE;
}

/* Runs the reference with 4 and with 8 sub-steps, and compares both. A copy that runs out of time has fewer steps, and
 * the comparison ends there. */
static MeBool runReference(MstAdviser *a, MstUniverseID u, MstRecord *record) {
    const MeBool hasFastBodies = record->traits.hasFastBodies;
    for (int i = 0; i < 2; i++) {
        const MstSetting reference = {MST_KNOB_REFERENCE, i ? 8 : 4, hasFastBodies, "reference"};
        const MstSetting *setting = &reference;
        if (runCopy(a, u, i ? a->reference : record, &setting, 1, remainingTime(a) / 4))
            return METRUE;
    }
    if (a->reference->steps < a->copy.size.steps)
        a->advice.restriction = "The reference took too long to make all steps.";
    double largest;
    a->lastSample = mst_recordsAgree(record, a->reference, &a->copy.size, (double)a->advice.tolerance, &largest);
    a->advice.referenceError = (MeReal)largest;
    a->advice.comparedTime = (MeReal)((a->lastSample + 1) * a->copy.size.stride * (double)a->advice.step);
    return MEFALSE;
}

/* Evaluates the first run of a trial: its errors and residuals. Its times are measured later, in turns with other
 * trials. */
static void recordTrial(MstAdviser *a, const MstRecord *record, int trial) {
    MstTrial *t = &a->trial[trial];
    mst_trialMeasure(t, record, a->reference, &a->copy.size, a->lastSample);
    a->cost[trial][0] = costPerStep(a, record);
    if (trial > 0 && a->cost[trial][0] < 0)
        t->verdict = MstVerdictFailed;
}

static double timeLimit(const MstAdviser *a, double asItIs) {
    return fmin(remainingTime(a), fmax(1, TOO_SLOW * asItIs));
}

static MeBool runTrials(MstAdviser *a, MstUniverseID u, MstRecord *record, double asItIs) {
    for (int trial = 1; trial <= a->settings; trial++) {
        snprintf(a->trial[trial].setting, sizeof a->trial[trial].setting, "%s", a->setting[trial - 1].call);
        if (remainingTime(a) <= 0) {
            a->advice.restriction = "Patience ended before all settings were tried.";
            a->trial[trial].verdict = MstVerdictFailed;
            continue;
        }
        if (runTrial(a, u, record, trial, timeLimit(a, asItIs)))
            return METRUE;
        recordTrial(a, record, trial);
    }
    return MEFALSE;
}

/* Times the trials `first` to `last` and the scene as it is, in turns. */
static MeBool timeTrials(MstAdviser *a, MstUniverseID u, MstRecord *record, int first, int last) {
    const int rounds = a->params.byWork ? 1 : a->params.rounds;
    for (a->rounds = 1; a->rounds < rounds && remainingTime(a) > 0; a->rounds++)
        for (int trial = 0; trial <= last; trial = trial < first ? first : trial + 1) {
            double *cost = a->cost[trial];
            cost[a->rounds] = -1;
            if (trial > 0 && (cost[0] < 0 || cost[0] > maxRatioToRepeat * a->cost[0][0]))
                continue;
            if (runTrial(a, u, record, trial, fmax(remainingTime(a), 1)))
                return METRUE;
            cost[a->rounds] = costPerStep(a, record);
        }
    mst_trialSetCosts(&a->trial[0], a->cost[0], a->cost[0], a->rounds, !a->params.byWork);
    for (int trial = first; trial <= last; trial++)
        mst_trialSetCosts(&a->trial[trial], a->cost[trial], a->cost[0], a->rounds, !a->params.byWork);
    return MEFALSE;
}

/* Chooses for each knob the setting that saves most time, or that the scene needs. Returns their number. */
static int chooseCombination(MstAdviser *a) {
    int count = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int trial = 1; trial <= a->settings; trial++) {
            const MstTrial *t = &a->trial[trial];
            int *chosen = &a->combination[a->setting[trial - 1].knob];
            if (t->verdict != (pass ? MstVerdictTake : MstVerdictMend))
                continue;
            if (!*chosen || (a->trial[*chosen].verdict == MstVerdictTake && t->ratio < a->trial[*chosen].ratio)) {
                count += !*chosen;
                *chosen = trial;
            }
        }
    return count;
}

static void nameCombination(MstAdviser *a, MstTrial *t) {
    int length = 0;
    for (int knob = 0; knob < MST_KNOBS; knob++)
        if (a->combination[knob] && length < (int)sizeof t->setting)
            length += snprintf(t->setting + length, sizeof t->setting - (size_t)length, "%s%d",
                               length ? " and " : "together: ", a->combination[knob]);
}

/* The index of the setting that saves most time or, if there is one, that the scene needs. */
static int bestSingleTrial(const MstAdviser *a) {
    int best = 0;
    for (int i = 1; i <= a->settings; i++) {
        const MstTrial *t = &a->trial[i];
        if (t->verdict == MstVerdictMend)
            return i;
        if (t->verdict == MstVerdictTake && (!best || t->ratio < a->trial[best].ratio))
            best = i;
    }
    return best;
}

static MeBool runCombination(MstAdviser *a, MstUniverseID u, MstRecord *record, double asItIs) {
    const int trial = a->settings + 1, chosen = chooseCombination(a);
    a->advice.best = bestSingleTrial(a);
    if (chosen < 2)
        return MEFALSE;
    const double extension = (double)a->params.patience / 4; /* extra time for the combination */
    a->deadline = fmax(a->deadline, mst_clock() + extension);
    nameCombination(a, &a->trial[trial]);
    if (runTrial(a, u, record, trial, timeLimit(a, asItIs)))
        return METRUE;
    recordTrial(a, record, trial);
    a->advice.count++;
    if (timeTrials(a, u, record, trial, trial))
        return METRUE;
    mst_trialsRate(a->trial, a->advice.count, (double)a->advice.tolerance, METRUE);
    const MstTrial *all = &a->trial[trial], *alone = &a->trial[a->advice.best];
    const MeBool isNeeded = alone->verdict == MstVerdictMend;
    if (mst_trialIsAcceptable(all, isNeeded ? alone : &a->trial[0], (double)a->advice.tolerance) &&
        all->ratio < alone->ratio)
        a->advice.best = trial;
    return MEFALSE;
}

static void listBestSettings(MstAdviser *a) {
    MstAdvice *advice = &a->advice;
    if (advice->best > a->settings) {
        for (int knob = 0; knob < MST_KNOBS; knob++)
            if (a->combination[knob])
                advice->follow[advice->followCount++] = a->combination[knob];
    } else if (advice->best > 0)
        advice->follow[advice->followCount++] = advice->best;
}

/* Returns METRUE in a copy. */
static MeBool runAll(MstAdviser *a, MstUniverseID u, MstRecord *record) {
    const double begin = mst_clock();
    snprintf(a->trial[0].setting, sizeof a->trial[0].setting, "%s", asItIsSetting.call);
    if (runAsItIs(a, u, record))
        return METRUE;
    const double asItIs = mst_clock() - begin;
    if (record->steps == 0)
        return MEFALSE;
    a->settings = mst_settingsPlan(u, &record->traits, a->setting);
    a->advice.count = 1 + a->settings;
    if (runReference(a, u, record) || runTrial(a, u, record, 0, fmax(remainingTime(a), 1)))
        return METRUE;
    recordTrial(a, record, 0);
    if (runTrials(a, u, record, asItIs) || timeTrials(a, u, record, 1, a->settings))
        return METRUE;
    mst_trialsRate(a->trial, a->advice.count, (double)a->advice.tolerance, a->lastSample >= 0);
    if (runCombination(a, u, record, asItIs))
        return METRUE;
    listBestSettings(a);
    return MEFALSE;
}

/* ---- around a step ----------------------------------------------------------------------------------------------- */

static void initAdvice(MstAdviser *a, MstUniverseID u, double step) {
    const double tolerance = (double)a->params.tolerance;
    a->deadline = mst_clock() + (double)a->params.patience;
    a->lastSample = -1;
    a->copy.size = recordSizeFor(a, u, step);
    a->advice.trial = a->trial;
    a->advice.restriction = "";
    a->advice.step = (MeReal)step;
    a->advice.bodies = MdtWorldGetTotalBodies(u->world);
    a->advice.tolerance = (MeReal)(tolerance > 0 ? tolerance : 1e-3 * (double)u->sizes.lengthScale);
}

/* Returns METRUE in a copy. */
static MeBool advise(MstAdviser *a, MstUniverseID u, double step) {
    initAdvice(a, u, step);
    const MstRecordSize size = a->copy.size;
    MstRecord *record = mst_recordCreate(&size);
    a->reference = mst_recordCreate(&size);
    if (!record || !a->reference)
        MeWarning(1, "MstAdvise: there is no memory for the records of copies");
    else if (runAll(a, u, record))
        return METRUE;
    mst_recordDestroy(record, &size);
    mst_recordDestroy(a->reference, &size);
    return MEFALSE;
}

/* Frees the adviser first, as the callback may request advice again or end the program. */
static void reportAdvice(MstAdviser *a) {
    MstTrial trial[TRIALS];
    MstAdvice advice = a->advice;
    const MstAdviceCB done = a->done;
    void *userdata = a->userdata;
    memcpy(trial, a->trial, sizeof trial);
    advice.trial = trial;
    MeMemoryGive(a);
    const MeProgramCall before = MeProgramEnter("MstAdvise");
    if (done)
        done(&advice, userdata);
    else
        MstAdvicePrint(&advice);
    MeProgramLeave(&before);
}

/* Runs all trials if their time has come. METRUE: this process is a copy, which makes the step and records it. */
static MeBool beginStep(MstAdviser *a, MstUniverseID u, double step) {
    if (!(step > 0) || !MeRealIsValid((MeReal)step))
        return MEFALSE; /* nothing moves: no advice */
    if (!a->isCopy && a->elapsed < (double)a->params.after - .5 * step) {
        a->elapsed += step;
        return MEFALSE;
    }
    if (a->isCopy || advise(a, u, step)) {
        mst_copyStepBegins(&a->copy);
        return METRUE;
    }
    *mst_universeHook(u, "MstUniverseStep") = 0;
    reportAdvice(a);
    return MEFALSE;
}

static void adviserStep(MstStepHook *hook, MstUniverseID u, MeReal step, MstStepFn stepOnce) {
    MstAdviser *a = (MstAdviser *)hook;
    const MeBool isCopy = beginStep(a, u, (double)step);
    if (stepOnce(u, step) && isCopy)
        mst_copyStepEnds(&a->copy, u, (double)step);
}

/* ---- printing ---------------------------------------------------------------------------------------------------- */

static void printHead(const MstAdvice *advice) {
    MeInfo(0, "%d bodies, %d steps of %.4g s each time", advice->bodies, advice->trial[0].steps, (double)advice->step);
    if (advice->comparedTime > 0)
        MeInfo(0, "errors are those of the first %.3g s, in which the reference is right to %.1g m",
               (double)advice->comparedTime, (double)advice->referenceError);
    else
        MeInfo(0, "chance decides so soon in this scene that no errors can be told: a larger tolerance, or a later "
                  "start, may help");
    if (advice->restriction[0])
        MeInfo(0, "%s", advice->restriction);
    MeInfo(0, "%2s %9s %6s %13s %9s %9s %9s %9s %9s %9s  %s", "", "ms/step", "ratio", "", "M mult.", "error m",
           "error m/s", "energy", "deep m", "gap m", "setting");
}

static void printTrial(const MstTrial *t, int number) {
    char spread[32];
    snprintf(spread, sizeof spread, "(%.2f .. %.2f)", (double)t->leastRatio, (double)t->largestRatio);
    MeInfo(0, "%2d %9.4f %6.2f %13s %9.3g %9.2g %9.2g %9.2g %9.2g %9.2g  %s", number, 1e3 * (double)t->time,
           (double)t->ratio, spread, (double)t->work, (double)t->error, (double)t->velocityError,
           (double)t->energyError, (double)t->penetration, (double)t->jointGap, t->setting);
}

static void printBest(const MstAdvice *advice) {
    const MstTrial *best = &advice->trial[advice->best];
    if (advice->best == 0)
        MeInfo(0, "best: leave all as it is");
    else
        MeInfo(0, "best: %d, %.0f %% of the time, error %.2g m instead of %.2g:", advice->best,
               100 * (double)best->ratio, (double)best->error, (double)advice->trial[0].error);
    for (int i = 0; i < advice->followCount; i++)
        MeInfo(0, "    %s", advice->trial[advice->follow[i]].setting);
}

void MEAPI MstAdvicePrint(const MstAdvice *advice) {
    if (!advice) {
        MeWarning(1, "MstAdvicePrint: advice is null");
        return;
    }
    if (advice->count == 0) {
        MeInfo(0, "no advice: not a step of the scene could be made in a copy of the process");
        return;
    }
    printHead(advice);
    for (int i = 0; i < advice->count; i++)
        printTrial(&advice->trial[i], i);
    for (int i = 1; i < advice->count; i++)
        if (advice->trial[i].verdict != MstVerdictNone)
            MeInfo(0, "%2d %s", i, advice->trial[i].advice);
    printBest(advice);
}
