/* Runs a random scene and says what went wrong in it.
 *
 *   not finite  a number of a body is not, or the library had to stop bodies because one was about to be.
 *   energy      without a motor, and since the last kick, the energy has grown by more than RANDOM_GROWTH of the scene's
 *               energy: the sum of m g size, and the kinetic energy after the kick. With motors it may also grow by what
 *               they can give, force times speed (motor).
 *   gap         a joint is further open than RANDOM_GAP of its smaller body's size, and what epsilon lets its force
 *               stretch it, in each of RANDOM_PATIENCE steps.
 *   sunk        a corner is deeper in the ground than RANDOM_DEPTH of its body's size, for as long.
 *   capped      the library says that its solver gave up.
 *
 * Energy is measured where it is exact for the leapfrog: velocities are those of the middle of the step, so the heights
 * are too; a spring has between k/2 x y and k/4 (x² + y²) with x and y its strains before and after the step, the first
 * for the leapfrog, the second for an implicit spring. Growth counts from the larger to the smaller of the two. A joint
 * that epsilon lets stretch counts as a spring of gamma / (epsilon h²). */
#ifndef RANDOM_JUDGE_H
#define RANDOM_JUDGE_H

#include "random_scene.h"

#define RANDOM_GROWTH   1e-2
#define RANDOM_GAP      1e-3
#define RANDOM_DEPTH    1e-2
#define RANDOM_PATIENCE 30 /* steps */

typedef enum {
    FAULT_NOT_FINITE,
    FAULT_ENERGY,
    FAULT_MOTOR,
    FAULT_GAP,
    FAULT_SUNK,
    FAULT_CAPPED,
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
    double growth; /* the largest, of the scene's energy */
    double gap;    /* the widest ever, of the size */
    int gapJoint;
} RandomVerdict;

/* Makes the scene, runs it, and destroys it. With a log, every step gets a line. */
void random_judge(unsigned long long seed, RandomVerdict *verdict, FILE *log);

/* The first fault, or -1. */
int random_worstFault(const RandomVerdict *verdict);

#endif
