/* What tests of motion measure for themselves, from the poses and velocities that programs see. Null is the world. */
#ifndef MEASURE_H
#define MEASURE_H

#include "MdtKeaMath.h"
#include "scene.h"

static inline void measure_position(MdtBodyID b, double p[3]) {
    MeVector3 v = {0, 0, 0};
    if (b)
        MdtBodyGetCenterOfMassPosition(b, v);
    for (int i = 0; i < 3; i++)
        p[i] = v[i];
}

/* The columns are the body's axes. */
static inline void measure_rotation(MdtBodyID b, double R[3][3]) {
    MeMatrix4Ptr tm = b ? MdtBodyGetCenterOfMassTransformPtr(b) : NULL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            R[i][j] = tm ? (double)tm[j][i] : i == j;
}

static inline void measure_velocity(MdtBodyID b, double v[3]) {
    MeVector3 r = {0, 0, 0};
    if (b)
        MdtBodyGetLinearVelocity(b, r);
    for (int i = 0; i < 3; i++)
        v[i] = r[i];
}

static inline void measure_rate(MdtBodyID b, double w[3]) {
    MeVector3 r = {0, 0, 0};
    if (b)
        MdtBodyGetAngularVelocity(b, r);
    for (int i = 0; i < 3; i++)
        w[i] = r[i];
}

/* Directions and points: from the body's frame to the world's, and back. */
static inline void measure_turnOut(MdtBodyID b, const double local[3], double world[3]) {
    double R[3][3];
    measure_rotation(b, R);
    keaApply(world, (const double(*)[3])R, local);
}

static inline void measure_turnIn(MdtBodyID b, const double world[3], double local[3]) {
    double R[3][3];
    measure_rotation(b, R);
    keaApplyTransposed(local, (const double(*)[3])R, world);
}

static inline void measure_pointOut(MdtBodyID b, const double local[3], double world[3]) {
    double p[3];
    measure_position(b, p);
    measure_turnOut(b, local, world);
    keaAddScaled(world, 1, p);
}

static inline void measure_pointIn(MdtBodyID b, const double world[3], double local[3]) {
    double p[3], arm[3];
    measure_position(b, p);
    keaSubtract(arm, world, p);
    measure_turnIn(b, arm, local);
}

/* Momentum, and angular momentum about the world's origin: x × m v + R I Rᵀ ω. */
static inline void measure_momentum(MdtBodyID b, double linear[3], double angular[3]) {
    double p[3], v[3], w[3], local[3], turned[3], I[3][3];
    MeMatrix3 tensor;
    measure_position(b, p);
    measure_velocity(b, v);
    measure_rate(b, w);
    keaScale(linear, MdtBodyGetMass(b), v);
    MdtBodyGetInertiaTensor(b, tensor);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            I[i][j] = tensor[i][j];
    measure_turnIn(b, w, local);
    keaApply(turned, (const double(*)[3])I, local);
    measure_turnOut(b, turned, w);
    keaCross(angular, p, linear);
    keaAddScaled(angular, 1, w);
}

/* A swing about zero, from samples at equal steps: crossings of zero are found by a straight line, peaks by a parabola.
 * */
typedef struct {
    int samples, crossings, peaks;
    double before[2];
    double firstCrossing, lastCrossing, firstPeak, lastPeak; /* in steps; of the peaks, their logarithms */
    double firstPeakAt, lastPeakAt;
} Swing;

static inline void swing_peak(Swing *s, double x) {
    const double a = fabs(s->before[1]), b = fabs(s->before[0]), c = fabs(x), bend = a - 2 * b + c;
    const double shift = bend < 0 ? .5 * (a - c) / bend : 0;
    s->lastPeak = log(b - .25 * (a - c) * shift);
    s->lastPeakAt = s->samples - 1 + shift;
    if (s->peaks++ == 0) {
        s->firstPeak = s->lastPeak;
        s->firstPeakAt = s->lastPeakAt;
    }
}

static inline void swing_add(Swing *s, double x) {
    if (s->samples > 0 && x * s->before[0] < 0) {
        s->lastCrossing = s->samples - x / (x - s->before[0]);
        if (s->crossings++ == 0)
            s->firstCrossing = s->lastCrossing;
    }
    const int isPeak = s->before[0] * x > 0 && s->before[0] * s->before[1] > 0 && fabs(s->before[0]) >= fabs(x) &&
                       fabs(s->before[0]) > fabs(s->before[1]);
    if (s->samples > 1 && isPeak)
        swing_peak(s, x);
    s->before[1] = s->before[0];
    s->before[0] = x;
    s->samples++;
}

/* rad/s and 1/s, with steps of h. */
static inline double swing_frequency(const Swing *s, double h) {
    return 3.14159265358979323846 * (s->crossings - 1) / ((s->lastCrossing - s->firstCrossing) * h);
}

static inline double swing_decay(const Swing *s, double h) {
    return (s->firstPeak - s->lastPeak) / ((s->lastPeakAt - s->firstPeakAt) * h);
}

/* What the midpoint rule makes of x'' = -w² x - 2 decay x': its factor from step to step is (1 + s h/2) / (1 - s h/2),
 * s = -decay ± i sqrt(w² - decay²); frequency and decay of the swing are those of its logarithm over h. */
static inline double midpoint_frequency(double w, double decay, double h) {
    return atan2(h * sqrt(w * w - decay * decay), 1 - .25 * w * w * h * h) / h;
}

static inline double midpoint_decay(double w, double decay, double h) {
    const double even = 1 + .25 * w * w * h * h;
    return log((even + decay * h) / (even - decay * h)) / (2 * h);
}

/* A swing as the midpoint rule has it, but for what lines and parabolas through samples of it leave at its first and
 * its last crossing or peak, and for `noise`: what the samples lack, relative to the swing, and of a swing of θ that
 * turns a body, (w θ h)²/32, by which the way of tan(angle/2) differs. */
static inline void swing_check(const Swing *s, double w, double decay, double h, double noise) {
    const double wh = w * h, n = s->crossings - 1, lines = .0102 * pow(wh, 3) + .08 * decay * h * wh;
    assert_near_rel(swing_frequency(s, h), midpoint_frequency(w, decay, h), lines / n + noise);
    assert_near(swing_decay(s, h), midpoint_decay(w, decay, h),
                ((.01 * wh * wh + .12 * decay * h) * wh * wh / n + noise) * w);
}

/* The angle by which a body in joints goes on that turns steadily: tan(angle/2) = rate h/2. */
static inline double midpoint_turn(double rate, double h) {
    return 2 * atan(.5 * rate * h);
}

/* The same where the moments of what turns differ by `difference` of the greatest: steps are halved until none turns it
 * by more than 0.1 rad over that difference. */
static inline double divided_turn(double rate, double h, double difference) {
    int parts = 1;
    while (fabs(rate) * h / parts * difference > .1)
        parts *= 2;
    return parts * midpoint_turn(rate, h / parts);
}

/* Numbers from -1 to 1, the same in every run. */
typedef struct {
    unsigned long long state;
} Random;

static inline double random_number(Random *r) {
    r->state = r->state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(long long)(r->state >> 11) / (double)(1LL << 52) - 1;
}

static inline void random_vector(Random *r, double size, double v[3]) {
    for (int i = 0; i < 3; i++)
        v[i] = size * random_number(r);
}

static inline void add_force(MdtBodyID b, const double f[3]) {
    MdtBodyAddForce(b, f[0], f[1], f[2]);
}

static inline void add_torque(MdtBodyID b, const double t[3]) {
    MdtBodyAddTorque(b, t[0], t[1], t[2]);
}

static inline void read_force(MdtConstraintID c, unsigned int body, double f[3]) {
    MeVector3 r;
    MdtConstraintGetForce(c, body, r);
    for (int i = 0; i < 3; i++)
        f[i] = r[i];
}

static inline void read_torque(MdtConstraintID c, unsigned int body, double t[3]) {
    MeVector3 r;
    MdtConstraintGetTorque(c, body, r);
    for (int i = 0; i < 3; i++)
        t[i] = r[i];
}

#endif
