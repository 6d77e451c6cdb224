/* Evaluates the records of copies: errors, ratios, verdicts, sentences (MstAdvise.h). */
#include "MeMath.h"
#include "advise/mst_advise_i.h"
#include <stdio.h>
#include <string.h>

/* A setting is faster if its cost ratio is below this in every round: smaller gains may be noise, and are not worth a
 * line in a program. */
static const double maxRatioOfGain = .95;

/* ---- errors ------------------------------------------------------------------------------------------------------ */

static double distance(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* The angle (rad) between two orientations: four times asin of half the quaternions' distance; q and -q are the same
 * orientation. */
static double angleBetween(const double a[4], const double b[4]) {
    double minus = 0, plus = 0;
    for (int i = 0; i < 4; i++) {
        minus += (a[i] - b[i]) * (a[i] - b[i]);
        plus += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 4 * asin(fmin(1, .5 * sqrt(fmin(minus, plus))));
}

/* m: the distance of the positions, plus that of a point at the radius of gyration due to the rotation. */
static double positionError(const MstSample *a, const MstSample *b) {
    return distance(a->position, b->position) + b->radius * angleBetween(a->quaternion, b->quaternion);
}

static double velocityErrorOf(const MstSample *a, const MstSample *b) {
    return distance(a->velocity, b->velocity) + b->radius * distance(a->angularVelocity, b->angularVelocity);
}

/* Number of bodies in a sample of both records; 0 if the numbers differ, as a body was created or destroyed in one. */
static int comparableBodies(const MstRecord *a, const MstRecord *b, const MstRecordSize *size, int sample) {
    if (sample >= a->sampleCount || sample >= b->sampleCount)
        return 0;
    const int bodies = mst_recordMoment(b, sample)->bodies;
    return mst_recordMoment(a, sample)->bodies == bodies ? (bodies < size->bodies ? bodies : size->bodies) : 0;
}

/* The largest position error of a body in a sample. */
static double maxPositionError(const MstRecord *a, const MstRecord *b, const MstRecordSize *size, int sample,
                               int bodies) {
    const MstSample *x = mst_recordSamples(a, size, sample), *y = mst_recordSamples(b, size, sample);
    double worst = 0;
    for (int i = 0; i < bodies; i++)
        worst = fmax(worst, positionError(&x[i], &y[i]));
    return worst;
}

int mst_recordsAgree(const MstRecord *a, const MstRecord *b, const MstRecordSize *size, double tolerance,
                     double *largest) {
    *largest = 0;
    for (int sample = 0;; sample++) {
        const int bodies = comparableBodies(a, b, size, sample);
        const double error = bodies > 0 ? maxPositionError(a, b, size, sample, bodies) : HUGE_VAL;
        if (!(error <= tolerance))
            return sample - 1;
        *largest = fmax(*largest, error);
    }
}

static double maxMeanVelocityError(const MstRecord *r, const MstRecord *reference, const MstRecordSize *size,
                                   int last) {
    const int bodies = comparableBodies(r, reference, size, 0);
    double worst = 0;
    for (int i = 0; i < bodies; i++) {
        double sum = 0;
        int count = 0;
        for (int sample = 0; sample <= last && i < comparableBodies(r, reference, size, sample); sample++, count++)
            sum +=
                velocityErrorOf(&mst_recordSamples(r, size, sample)[i], &mst_recordSamples(reference, size, sample)[i]);
        worst = fmax(worst, count > 0 ? sum / count : 0);
    }
    return worst;
}

static void measureErrors(MstTrial *t, const MstRecord *r, const MstRecord *reference, const MstRecordSize *size,
                          int last) {
    double place = 0, energy = 0, kinetic = 0;
    for (int sample = 0; sample <= last; sample++) {
        const int bodies = comparableBodies(r, reference, size, sample);
        const MstMoment *now = mst_recordMoment(r, sample), *exact = mst_recordMoment(reference, sample);
        place = fmax(place, bodies > 0 ? maxPositionError(r, reference, size, sample, bodies) : HUGE_VAL);
        energy = fmax(energy, fabs(now->energy - exact->energy));
        kinetic = fmax(kinetic, exact->kinetic);
    }
    t->error = (MeReal)place;
    t->energyError = (MeReal)(kinetic > 0 ? energy / kinetic : 0);
    t->velocityError = (MeReal)maxMeanVelocityError(r, reference, size, last);
}

void mst_trialMeasure(MstTrial *t, const MstRecord *r, const MstRecord *reference, const MstRecordSize *size,
                      int lastSample) {
    t->steps = r->steps;
    t->time = (MeReal)(r->steps > size->warmUp ? r->time / (r->steps - size->warmUp) : 0);
    t->work = (MeReal)(r->steps > 0 ? r->work / r->steps : 0);
    t->penetration = (MeReal)r->penetration;
    t->jointGap = (MeReal)r->jointGap;
    t->residualVelocity = (MeReal)r->residualVelocity;
    if (lastSample >= 0)
        measureErrors(t, r, reference, size, lastSample);
}

/* ---- cost -------------------------------------------------------------------------------------------------------- */

/* The median of at most 15 numbers, sorted in a copy. */
static double median(const double *x, int count) {
    double sorted[15];
    for (int i = 0; i < count; i++) {
        int k = i;
        for (; k > 0 && sorted[k - 1] > x[i]; k--)
            sorted[k] = sorted[k - 1];
        sorted[k] = x[i];
    }
    return count % 2 ? sorted[count / 2] : .5 * (sorted[count / 2 - 1] + sorted[count / 2]);
}

void mst_trialSetCosts(MstTrial *t, const double *cost, const double *asItIs, int rounds, MeBool isTime) {
    double seen[15], ratio[15], min = HUGE_VAL, largest = 0;
    int count = 0;
    for (int i = 0; i < rounds; i++)
        if (cost[i] >= 0 && asItIs[i] >= 0) {
            seen[count] = cost[i];
            ratio[count] = asItIs[i] > 0 ? cost[i] / asItIs[i] : cost[i] > 0 ? HUGE_VAL : 1;
            min = fmin(min, ratio[count]);
            largest = fmax(largest, ratio[count++]);
        }
    if (count == 0)
        return;
    if (isTime)
        t->time = (MeReal)median(seen, count);
    t->ratio = (MeReal)median(ratio, count);
    t->leastRatio = (MeReal)min;
    t->largestRatio = (MeReal)largest;
}

/* ---- verdicts ---------------------------------------------------------------------------------------------------- */

/* Whether a value is within the tolerance, or exceeds the one before by at most 10 %: no visible difference. */
static MeBool isNoWorse(MeReal value, MeReal before, double tolerance) {
    return (double)value <= fmax(tolerance, 1.1 * (double)before);
}

MeBool mst_trialIsAcceptable(const MstTrial *t, const MstTrial *asItIs, double tolerance) {
    return isNoWorse(t->error, asItIs->error, tolerance) && isNoWorse(t->penetration, asItIs->penetration, tolerance) &&
           isNoWorse(t->jointGap, asItIs->jointGap, tolerance);
}

static MeBool isFaster(const MstTrial *t) {
    return (double)t->largestRatio < maxRatioOfGain;
}

static MeBool isWithinTolerance(const MstTrial *t, double tolerance) {
    return (double)t->error <= tolerance;
}

static MstVerdict verdictOf(const MstTrial *t, const MstTrial *asItIs, double tolerance, MeBool isCompared) {
    if (t->verdict == MstVerdictFailed)
        return MstVerdictFailed;
    if (!isCompared)
        return isFaster(t) ? MstVerdictTrade : MstVerdictNone;
    if (isFaster(t))
        return mst_trialIsAcceptable(t, asItIs, tolerance) ? MstVerdictTake : MstVerdictTrade;
    return (double)t->error < .5 * (double)asItIs->error && !isWithinTolerance(asItIs, tolerance) ? MstVerdictExact
                                                                                                  : MstVerdictNone;
}

/* Marks the cheapest setting that corrects the scene's errors as needed. */
static void chooseNeededSetting(MstTrial *t, int count, double tolerance) {
    MstTrial *best = 0;
    for (int i = 1; i < count; i++)
        if (t[i].verdict == MstVerdictExact && isWithinTolerance(&t[i], tolerance) &&
            mst_trialIsAcceptable(&t[i], &t[0], tolerance) && (!best || t[i].ratio < best->ratio))
            best = &t[i];
    if (best)
        best->verdict = MstVerdictMend;
}

/* ---- sentences --------------------------------------------------------------------------------------------------- */

static void formatCost(const MstTrial *t, char *text, size_t size) {
    const double ratio = (double)t->ratio;
    if (ratio < 1)
        snprintf(text, size, "%.0f %% less", 100 * (1 - ratio));
    else if (ratio < 2)
        snprintf(text, size, "%.0f %% more", 100 * (ratio - 1));
    else
        snprintf(text, size, "%.1f times", ratio);
}

/* Writes which errors of a trial exceed the tolerance and those of the scene as it is. */
static void formatLoss(const MstTrial *t, const MstTrial *asItIs, double tolerance, char *text, size_t size) {
    int length = 0;
    *text = 0;
    const struct {
        const char *name;
        MeReal value, before;
    } loss[] = {{"error", t->error, asItIs->error},
                {"penetration", t->penetration, asItIs->penetration},
                {"joint gap", t->jointGap, asItIs->jointGap}};
    for (int i = 0; i < 3; i++)
        if (!isNoWorse(loss[i].value, loss[i].before, tolerance) && length < (int)size)
            length += snprintf(text + length, size - (size_t)length, "%s%s %.2g m instead of %.2g", length ? ", " : "",
                               loss[i].name, (double)loss[i].value, (double)loss[i].before);
}

static void writeAdvice(MstTrial *t, const MstTrial *asItIs, double tolerance, MeBool isCompared) {
    char cost[32], loss[160];
    formatCost(t, cost, sizeof cost);
    formatLoss(t, asItIs, tolerance, loss, sizeof loss);
    const double error = (double)t->error, now = (double)asItIs->error;
    switch (t->verdict) {
    case MstVerdictTake:
        snprintf(t->advice, sizeof t->advice, "Take it: %s, error %.2g m (now %.2g).", cost, error, now);
        break;
    case MstVerdictMend:
        snprintf(t->advice, sizeof t->advice, "Needed: error %.2g m instead of %.2g, for %s.", error, now, cost);
        break;
    case MstVerdictTrade:
        snprintf(t->advice, sizeof t->advice, "%s, but %s.", cost, isCompared ? loss : "its error cannot be told");
        break;
    case MstVerdictExact:
        snprintf(t->advice, sizeof t->advice, "More exact: error %.2g m instead of %.2g, for %s.", error, now, cost);
        break;
    case MstVerdictFailed:
        snprintf(t->advice, sizeof t->advice, "Its copy ended after %d steps: too slow, or it crashed.", t->steps);
        break;
    case MstVerdictNone:
        snprintf(t->advice, sizeof t->advice, "Gains nothing.");
        break;
    }
}

void mst_trialsRate(MstTrial *t, int count, double tolerance, MeBool isCompared) {
    for (int i = 1; i < count; i++)
        t[i].verdict = verdictOf(&t[i], &t[0], tolerance, isCompared);
    if (isCompared && !isWithinTolerance(&t[0], tolerance))
        chooseNeededSetting(t, count, tolerance);
    for (int i = 1; i < count; i++)
        writeAdvice(&t[i], &t[0], tolerance, isCompared);
    snprintf(t[0].advice, sizeof t[0].advice, "%s", "");
}
