/* The right answers of the scenes: closed forms, and equations of motion integrated until they converge. */
#include "reference.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* T = 2 pi / (omega agm(1, cos(amplitude / 2))), the complete elliptic integral by Gauss's mean. */
double reference_pendulumPeriod(double amplitude, double omega) {
    double a = 1, b = cos(amplitude / 2);
    while (a - b > 1e-15) {
        const double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return 2 * pi / (omega * a);
}

/* I dw/dt = I w x w */
static void acceleration(const double inertia[3], const double w[3], double a[3]) {
    a[0] = (inertia[1] - inertia[2]) * w[1] * w[2] / inertia[0];
    a[1] = (inertia[2] - inertia[0]) * w[2] * w[0] / inertia[1];
    a[2] = (inertia[0] - inertia[1]) * w[0] * w[1] / inertia[2];
}

static void rungeKutta(const double inertia[3], double w[3], double h) {
    double k[4][3], at[3];
    const double reach[4] = {0, h / 2, h / 2, h};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < 3; i++)
            at[i] = s ? w[i] + reach[s] * k[s - 1][i] : w[i];
        acceleration(inertia, at, k[s]);
    }
    for (int i = 0; i < 3; i++)
        w[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static double rotationEnergy(const double inertia[3], const double w[3]) {
    return (inertia[0] * w[0] * w[0] + inertia[1] * w[1] * w[1] + inertia[2] * w[2] * w[2]) / 2;
}

ReferenceTumbling reference_tumbling(const double inertia[3], const double spin[3], double duration) {
    const double h = 2e-4;
    const long steps = lround(duration / h);
    double w[3] = {spin[0], spin[1], spin[2]};
    ReferenceTumbling r = {0, 0, 0};
    for (long i = 0; i < steps; i++) {
        const double before = w[1];
        rungeKutta(inertia, w, h);
        if (before * w[1] < 0 && r.flips++ == 0)
            r.firstFlip = h * ((double)i + before / (before - w[1]));
    }
    r.energy = rotationEnergy(inertia, w) / rotationEnergy(inertia, spin) - 1;
    return r;
}

double reference_slide(double along, double across, double friction, double time) {
    const double a = along - friction * across;
    return a > 0 ? a * time * time / 2 : 0;
}

double reference_stop(double speed, double friction, double gravity) {
    return speed * speed / (2 * friction * gravity);
}

/* A block of 1 kg on its edge: its tilt, the rate of it, and the speed of the edge. */
typedef struct Tripping {
    double tilt, rate, speed;
} Tripping;

/* The edge is r sin a ahead of the centre and r cos a below it, a = upright - tilt. On it act N upward and -mu N:
 *     I d(rate)/dt = -N (r sin a - mu r cos a),  N = g + r sin a d(rate)/dt - r cos a rate². */
static Tripping trippingRate(Tripping t, double r, double upright, double friction, double gravity) {
    const double across = r * sin(upright - t.tilt), below = r * cos(upright - t.tilt), inertia = r * r / 3;
    const double arm = friction * below - across;
    const double turn = arm * (gravity - below * t.rate * t.rate) / (inertia - arm * across);
    const double normal = gravity + across * turn - below * t.rate * t.rate;
    return (Tripping){t.rate, turn, -friction * normal - below * turn - across * t.rate * t.rate};
}

static Tripping along(Tripping t, Tripping rate, double h) {
    return (Tripping){t.tilt + h * rate.tilt, t.rate + h * rate.rate, t.speed + h * rate.speed};
}

/* The midpoint rule while it slips; then energy says whether the centre passes over the edge. */
bool reference_topples(double halfWidth, double halfHeight, double speed, double friction, double gravity) {
    const double r = hypot(halfWidth, halfHeight), upright = atan2(halfWidth, halfHeight), h = 1e-5;
    Tripping t = {0, 0, speed};
    if (friction * halfHeight <= halfWidth)
        return false;
    while (t.speed > 0 && t.tilt < upright) {
        const Tripping middle = along(t, trippingRate(t, r, upright, friction, gravity), h / 2);
        t = along(t, trippingRate(middle, r, upright, friction, gravity), h);
    }
    return t.tilt >= upright || 2. / 3 * r * r * t.rate * t.rate > gravity * r * (1 - cos(upright - t.tilt));
}

/* Of a solid ball, 5/7 of the momentum about the point of contact is in the rolling, and the spin has 2/5 of it. */
double reference_rollingSpeed(double speed, double surface) {
    return (5 * speed + 2 * surface) / 7;
}

double reference_rollingDistance(double speed, double surface, double friction, double gravity, double time) {
    const double rolls = reference_rollingSpeed(speed, surface);
    const double brakes = speed > surface ? friction * gravity : -friction * gravity, slips = (speed - rolls) / brakes;
    if (time < slips)
        return speed * time - brakes * time * time / 2;
    return speed * slips - brakes * slips * slips / 2 + rolls * (time - slips);
}

/* The axis a leans down by l from the outward radial direction, e is the steepest way up the disc, b half its width,
 * and from contact to centre it is d = R e + b a, outward d_x = b cos l - R sin l, upward d_z = R cos l + b sin l. The
 * contact goes round at the rate W on a circle of radius r; rolling asks for the spin -W r/R about a. The angular
 * momentum L about the centre turns with W, and the ground pushes with F, which keeps the centre on its circle:
 *     dL/dt = W up x L = -d x F,   F = (-m W² (r + d_x), 0, m g)
 * for
 *     W² [m d_z (r + d_x) + A cos l r/R + (B - A) sin l cos l] = -m g d_x. */
double reference_rollingDisc(const ReferenceDisc *d, double gravity) {
    const double c = cos(d->lean), s = sin(d->lean), out = d->halfWidth * c - d->radius * s,
                 up = d->radius * c + d->halfWidth * s;
    return sqrt(-gravity * out /
                (up * (d->circle + out) + d->along * c * d->circle / d->radius + (d->across - d->along) * s * c));
}

/* da/dt = L x a / across, for the spin along a moves it not; dL/dt = l a x m g */
static void topRate(const double y[6], double across, double weight, double rate[6]) {
    rate[0] = (y[4] * y[2] - y[5] * y[1]) / across;
    rate[1] = (y[5] * y[0] - y[3] * y[2]) / across;
    rate[2] = (y[3] * y[1] - y[4] * y[0]) / across;
    rate[3] = weight * y[2];
    rate[4] = 0;
    rate[5] = -weight * y[0];
}

static void stepTop(double y[6], double across, double weight, double h) {
    double k[4][6], at[6];
    const double reach[4] = {0, h / 2, h / 2, h};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < 6; i++)
            at[i] = s ? y[i] + reach[s] * k[s - 1][i] : y[i];
        topRate(at, across, weight, k[s]);
    }
    for (int i = 0; i < 6; i++)
        y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

/* Runge and Kutta's method, by steps of at most 50 us. */
void reference_top(double axisAndMomentum[6], double across, double weight, double time) {
    const long steps = lround(ceil(time / 5e-5));
    for (long i = 0; i < steps; i++)
        stepTop(axisAndMomentum, across, weight, time / (double)steps);
}
