/* The right answers of the scenes: closed forms, and equations of motion integrated until they converge. */
#ifndef SCENES_REFERENCE_H
#define SCENES_REFERENCE_H

#include <stdbool.h>

/* s, of a pendulum that is let go at `amplitude` [rad] and whose small swings have the angular frequency `omega`. */
double reference_pendulumPeriod(double amplitude, double omega);

/* A free body with these moments of inertia and this angular velocity, both in its own axes. */
typedef struct ReferenceTumbling {
    double firstFlip; /* s, when the angular velocity about y first changes its sign */
    int flips;        /* how often it does */
    double energy;    /* relative error of the integration */
} ReferenceTumbling;
ReferenceTumbling reference_tumbling(const double inertia[3], const double spin[3], double duration);

/* m, down a slope whose gravity has the parts `along` and `across` [m/s²], from rest; 0 if friction holds. */
double reference_slide(double along, double across, double friction, double time);

/* m, on the flat, with `speed` at the start, until it stands. */
double reference_stop(double speed, double friction, double gravity);

/* Whether a block that slides so on a face of this half width trips over its front edge: in the plane, the edge slips
 * until it stands, and from then on the block turns about it. */
bool reference_topples(double halfWidth, double halfHeight, double speed, double friction, double gravity);

/* A ball that is put on a level ground with `speed`, its spin that of one that rolls with the speed `surface`: it
 * slips, then rolls. */
double reference_rollingSpeed(double speed, double surface);
double reference_rollingDistance(double speed, double surface, double friction, double gravity, double time);

/* A disc of 1 kg, whose plane leans from upright, rolls steadily: the point of contact goes round a circle. */
typedef struct ReferenceDisc {
    double radius, halfWidth; /* m */
    double along, across;     /* m², moments of inertia, of 1 kg, about its axis and at right angles to it */
    double lean, circle;      /* rad; m, of the point of contact */
} ReferenceDisc;
/* rad/s, of its going round; no number if there is no such motion. */
double reference_rollingDisc(const ReferenceDisc *d, double gravity);

/* Moves a heavy symmetric top on by `time`: the unit vector along its axis, and its angular momentum about the pivot.
 * `across` is the moment of inertia about the pivot at right angles to the axis, `weight` m g l [N m], gravity -y. */
void reference_top(double axisAndMomentum[6], double across, double weight, double time);

#endif
