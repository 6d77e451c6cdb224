/* Structures that functions take by pointer, filled with any values that a program may write there. calls.py reads the
 * table at the end: each stands for the C type of its name, an underscore behind it for another pointer. */
#include "fuzz_calls.h"

#include <stdlib.h>
#include <string.h>

#include "Mcd.h"
#include "McdQuery.h"
#include "Mdt.h"
#include "MeProfile.h"
#include "Mst.h"
#include "MstDebugDraw.h"

enum { MANY = 64, RESULTS = 16 };

static void fill_Nothing(void *record, FuzzRandom *random) {
    (void)record;
    (void)random;
}

static void fill_McdContact(void *record, FuzzRandom *random) {
    McdContact *contacts = record;
    memset(contacts, 0, MANY * sizeof *contacts);
    for (int i = 0; i < MANY; i++) {
        McdContact *const c = &contacts[i];
        for (int k = 0; k < 3; k++) {
            c->position[k] = (MeReal)fuzzReal(random);
            c->normal[k] = (MeReal)fuzzReal(random);
        }
        c->separation = (MeReal)fuzzReal(random);
        c->dims = (int)fuzzInteger(random);
    }
}

/* Behind the results. */
void *fuzzContactsOf(void *results) {
    return (McdIntersectResult *)results + RESULTS;
}

static void fill_McdIntersectResult(void *record, FuzzRandom *random) {
    McdIntersectResult *result = record;
    memset(result, 0, sizeof *result);
    result->contacts = fuzzIsNasty(random) ? NULL : fuzzContactsOf(result);
    const long count = fuzzInteger(random);
    result->contactMaxCount = (int)(count > MANY ? MANY : count);
}

static void fill_McdRequest(void *record, FuzzRandom *random) {
    McdRequest *request = record;
    request->contactMaxCount = (int)fuzzInteger(random);
    request->faceNormalsFirst = (MeBool)fuzzBelow(random, 2);
}

static void fill_MstMoverParams(void *record, FuzzRandom *random) {
    MstMoverParams *p = record;
    MeReal *const lengths[] = {&p->radius, &p->height, &p->slopeLimit, &p->stepHeight, &p->skin, &p->pushStrength};
    memset(p, 0, sizeof *p);
    *p = (MstMoverParams){.radius = (MeReal)0.3, .height = (MeReal)1.8, .skin = (MeReal)0.02, .up = {0, 0, 1}};
    for (int i = 0; i < 6; i++)
        if (fuzzIsNasty(random))
            *lengths[i] = (MeReal)fuzzReal(random);
}

static unsigned int count(FuzzRandom *random, unsigned int usual) {
    return fuzzIsNasty(random) ? (unsigned int)fuzzInteger(random) : usual;
}

static void fillReals(MeReal *const reals[], int count, FuzzRandom *random) {
    for (int i = 0; i < count; i++)
        if (fuzzIsNasty(random))
            *reals[i] = (MeReal)fuzzReal(random);
}

static void fillCurve(MstCurve *c, MeReal x, MeReal y, FuzzRandom *random) {
    *c = (MstCurve){3, {{0, y / 2}, {x, y}, {2 * x, y / 2}}};
    if (fuzzIsNasty(random))
        c->count = (int)fuzzInteger(random);
    if (fuzzIsNasty(random))
        c->point[fuzzBelow(random, 3)].y = (MeReal)fuzzReal(random);
}

static void fill_MstVehicleParams(void *record, FuzzRandom *random) {
    MstVehicleParams *p = record;
    *p = (MstVehicleParams){.forward = {1, 0, 0},
                            .up = {0, 0, 1},
                            .cast = (MstVehicleCast)fuzzBelow(random, 4),
                            .idle = 900,
                            .redline = 6000,
                            .gears = 2,
                            .gear = {3, 1},
                            .reverse = 3,
                            .finalDrive = 4,
                            .shiftUp = 5000,
                            .shiftDown = 2000,
                            .axleLock = (MeReal)fuzzBelow(random, 2),
                            .steeringRate = 3,
                            .leanLimit = (MeReal)fuzzBelow(random, 2),
                            .leanFrequency = 2};
    MeReal *const reals[] = {&p->forward[0],    &p->up[1],         &p->idle,      &p->redline,
                             &p->engineInertia, &p->engineBraking, &p->gear[0],   &p->reverse,
                             &p->finalDrive,    &p->shiftUp,       &p->shiftTime, &p->axleLock,
                             &p->drag,          &p->steeringRate,  &p->leanLimit, &p->leanFrequency};
    fillReals(reals, sizeof reals / sizeof *reals, random);
    fillCurve(&p->torque, 3000, 200, random);
    p->gears = (int)count(random, 2);
}

static void fill_MstWheelParams(void *record, FuzzRandom *random) {
    MstWheelParams *p = record;
    *p = (MstWheelParams){.position = {(MeReal)fuzzBelow(random, 3) - 1, (MeReal)fuzzBelow(random, 3) - 1, 0},
                          .radius = (MeReal)0.3,
                          .width = (MeReal)0.2,
                          .inertia = 1,
                          .bump = (MeReal)0.1,
                          .frequency = (MeReal)1.5,
                          .dampingRatio = (MeReal)0.4,
                          .antiRoll = (MeReal)(1000 * fuzzBelow(random, 2)),
                          .axle = (int)fuzzBelow(random, 2),
                          .steering = (MeReal)(0.5 * (double)fuzzBelow(random, 2)),
                          .drive = (MeReal)fuzzBelow(random, 2),
                          .brake = 1000};
    MeReal *const reals[] = {&p->position[0], &p->radius,    &p->width,     &p->inertia,      &p->bump,
                             &p->droop,       &p->frequency, &p->stiffness, &p->antiRoll,     &p->steering,
                             &p->drive,       &p->brake,     &p->handbrake, &p->dampingRatio, &p->rollingResistance};
    fillReals(reals, sizeof reals / sizeof *reals, random);
    fillCurve(&p->along, (MeReal)0.1, 1, random);
    fillCurve(&p->across, (MeReal)0.1, 1, random);
}

static void fill_McdIterators(void *record, FuzzRandom *random) {
    int *numbers = record; /* all members are ints, or pointers that are null at the end */
    (void)random;
    memset(numbers, 0, 64);
}

static void fill_MdtPartitionParams(void *record, FuzzRandom *random) {
    MdtPartitionParams *p = record;
    p->autoDisable = (MeBool)fuzzBelow(random, 2);
    p->vel_thresh = (MeReal)fuzzReal(random);
    p->velrot_thresh = (MeReal)fuzzReal(random);
    p->acc_thresh = (MeReal)fuzzReal(random);
    p->accrot_thresh = (MeReal)fuzzReal(random);
    p->alive_time = (MeReal)fuzzReal(random);
    p->alive_window = (int)fuzzInteger(random);
}

static MeReal scale(FuzzRandom *random) {
    return (MeReal)(fuzzIsNasty(random) ? fuzzReal(random) : 1);
}

static void fill_MstUniverseSizes(void *record, FuzzRandom *random) {
    MstUniverseSizes *s = record;
    *s = fuzzChance(random, 50) ? MstUniverseGrowingSizes : MstUniverseDefaultSizes;
    s->dynamicBodiesMaxCount = count(random, s->dynamicBodiesMaxCount);
    s->dynamicConstraintsMaxCount = count(random, s->dynamicConstraintsMaxCount);
    s->collisionUserGeometryTypesMaxCount = count(random, s->collisionUserGeometryTypesMaxCount);
    s->collisionModelsMaxCount = count(random, s->collisionModelsMaxCount);
    s->collisionPairsMaxCount = count(random, s->collisionPairsMaxCount);
    s->collisionGeometryInstancesMaxCount = count(random, s->collisionGeometryInstancesMaxCount);
    s->materialsMaxCount = count(random, s->materialsMaxCount);
    s->lengthScale = scale(random);
    s->massScale = scale(random);
}

static void MEAPI drawLine(void *data, const MeVector3 a, const MeVector3 b, const float color[4]) {
    (void)data, (void)a, (void)b, (void)color;
}

static void MEAPI drawText(void *data, const MeVector3 p, const char *text, const float color[4]) {
    (void)data, (void)p, (void)text, (void)color;
}

static void fill_MstDebugDraw(void *record, FuzzRandom *random) {
    MstDebugDraw *draw = record;
    memset(draw, 0, sizeof *draw);
    draw->line = fuzzChance(random, 80) ? drawLine : NULL;
    draw->text = fuzzChance(random, 80) ? drawText : NULL;
    draw->forceLength = fuzzChance(random, 50) ? 0 : (MeReal)fuzzReal(random);
}

/* Of as many vertices or materials as a mesh may have here (LIMITS in calls.py), and a few that it has not. */
enum { NUMBERS = 48 };
static void fill_Numbers(void *record, FuzzRandom *random) {
    int *number = record;
    for (int i = 0; i < NUMBERS; i++)
        number[i] = fuzzChance(random, 98) ? (int)fuzzBelow(random, 64) : (int)fuzzInteger(random);
}

enum { ITERATOR = 64, RESULTS_BYTES = RESULTS * sizeof(McdIntersectResult) + MANY * sizeof(McdContact) };

const FuzzRecordType fuzzRecords[] = {
#define RECORD(name, size, fill) {size, fill},
    /* clang-format off */
    RECORD(McdContact, MANY * sizeof(McdContact), fill_McdContact)
    RECORD(McdIntersectResult, RESULTS_BYTES, fill_McdIntersectResult)
    RECORD(McdSafeTimeResult, sizeof(McdSafeTimeResult), fill_Nothing)
    RECORD(McdDistanceResult, sizeof(McdDistanceResult), fill_Nothing)
    RECORD(McdLineSegIntersectResult, 16 * sizeof(McdLineSegIntersectResult), fill_Nothing)
    RECORD(McdCastResult, sizeof(McdCastResult), fill_Nothing)
    RECORD(McdClosestResult, sizeof(McdClosestResult), fill_Nothing)
    RECORD(McdRequest, sizeof(McdRequest), fill_McdRequest)
    RECORD(McdModelPairContainerIterator, ITERATOR, fill_McdIterators)
    RECORD(McdSpacePairIterator, ITERATOR, fill_McdIterators)
    RECORD(McdSpaceModelIterator, ITERATOR, fill_McdIterators)
    RECORD(McdModel_, MANY * sizeof(McdModelID), fill_Nothing)
    RECORD(MeVector4_, sizeof(MeMatrix4Ptr), fill_Nothing)
    RECORD(char_, sizeof(char *), fill_Nothing)
    RECORD(int, NUMBERS * sizeof(int), fill_Numbers)
    RECORD(unsigned_int, NUMBERS * sizeof(int), fill_Numbers)
    RECORD(MdtPartitionParams, sizeof(MdtPartitionParams), fill_MdtPartitionParams)
    RECORD(MdtReport, sizeof(MdtReport), fill_Nothing)
    RECORD(MeProfileTimerResult, sizeof(MeProfileTimerResult), fill_Nothing)
    RECORD(MstUniverseSizes, sizeof(MstUniverseSizes), fill_MstUniverseSizes)
    RECORD(MstMoverParams, sizeof(MstMoverParams), fill_MstMoverParams)
    RECORD(MstMoverResult, sizeof(MstMoverResult), fill_Nothing)
    RECORD(MstVehicleParams, sizeof(MstVehicleParams), fill_MstVehicleParams)
    RECORD(MstWheelParams, sizeof(MstWheelParams), fill_MstWheelParams)
    RECORD(MstWheelState, sizeof(MstWheelState), fill_Nothing)
    RECORD(MstDebugDraw, sizeof(MstDebugDraw), fill_MstDebugDraw)
    /* clang-format on */
};
const int fuzzRecordCount = sizeof fuzzRecords / sizeof fuzzRecords[0];
