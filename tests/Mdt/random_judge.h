/* Runs a random scene and says what went wrong in it.
 *
 *   not finite  a number of a body is not, or the library had to stop bodies because one was about to be.
 *   energy      without a motor, and since the last kick, the energy has grown by more than RANDOM_GROWTH of the
 *               scene's energy (the sum of m g size, and the kinetic energy after the kick) in each of the last
 *               RANDOM_LASTING steps. The growth that counts is the least of them.
 *   motor       the same with motors, when it has grown by more than they can give: force times speed.
 *   spike       the energy has grown by more than RANDOM_SPIKE, for however short.
 *   gap         a joint is further open than RANDOM_GAP of its smaller body's size, and what epsilon lets its force
 *               stretch it, in each of RANDOM_PATIENCE steps.
 *   sunk        a corner is deeper in the ground than RANDOM_DEPTH of its body's size, for as long.
 *   capped      the library says that its solver gave up.
 *
 * Energy is measured where it is exact for the leapfrog: velocities are those of the middle of the step, so the
 * heights are too; a spring has between k/2 x y and k/4 (x² + y²) with x and y its strains before and after the step,
 * the first for the leapfrog, the second for an implicit spring. Growth counts from the larger to the smaller of the
 * two. A joint that epsilon lets stretch counts as a spring of gamma / (epsilon h²). */
#ifndef RANDOM_JUDGE_H
#define RANDOM_JUDGE_H

#include "random_scene.h"

#define RANDOM_GROWTH   1e-2
#define RANDOM_LASTING  10 /* steps */
#define RANDOM_SPIKE    1e-1
#define RANDOM_GAP      1e-3
#define RANDOM_DEPTH    1e-2
#define RANDOM_PATIENCE 30 /* steps */

typedef enum {
    FAULT_NOT_FINITE,
    FAULT_ENERGY,
    FAULT_MOTOR,
    FAULT_SPIKE,
    FAULT_GAP,
    FAULT_SUNK,
    FAULT_CAPPED, /* the library said itself that a step was inexact: told, and no fault of the scene's */
    FAULTS
} RandomFaultKind;

extern const char *const random_faultName[FAULTS];

typedef struct {
    MeBool is;
    int step;      /* the first at which it was so */
    double amount; /* the largest: of the energy, or of the size */
    int joint;     /* of a gap */
} RandomFault;

typedef struct {
    RandomFault fault[FAULTS];
    double growth; /* the largest that lasted, of the scene's energy */
    double gap;    /* the widest ever, of the size, without what epsilon allows */
} RandomVerdict;

/* A scene under way. */
typedef struct {
    RandomScene scene;
    RandomVerdict verdict;
    FILE *log; /* gets a line for every step; may be null */
    int step;
    double min, scale;             /* J: the least energy since the last kick, motors' gifts included; what it is of */
    double growth[RANDOM_LASTING]; /* of the last steps, in turn */
    int calm;                      /* steps since the last kick */
    double stretch[RANDOM_JOINTS]; /* m, that epsilon allows */
    double gap[RANDOM_JOINTS];     /* m */
    int open[RANDOM_JOINTS];       /* steps */
    int sunk[RANDOM_BODIES];       /* steps */
} RandomJudge;

void random_judgeBegin(RandomJudge *j, unsigned long long seed, FILE *log);
/* False: it is over. */
MeBool random_judgeStep(RandomJudge *j);
void random_judgeEnd(RandomJudge *j);

/* The whole of it. True: nothing went wrong. */
MeBool random_judge(RandomJudge *j, unsigned long long seed, FILE *log);

#endif
