/* The accuracy of a world's steps, and the speed below which bodies count as resting. */
#include "island/mdt_choice_i.h"

/* m/s: the velocity that gravity gives in a step; without gravity, a tenth of the length scale per second. */
static double speedScale(const MdtWorld *w, double h) {
    double g[3];
    mdt_fromReal(g, w->params.gravity);
    const double fall = keaLength(g) * h;
    MEASSERT(h >= 0 && isfinite(fall));
    return fall > 0 ? fall : 0.1 * (double)w->params.lengthScale;
}

double mdt_worldAccuracy(const MdtWorld *w, double h, MeBool hasJoints) {
    const double share = hasJoints ? 1e-2 : 1e-4; /* see MdtWorldSetAccuracy */
    return w->accuracy >= 0 ? (double)w->accuracy : share * speedScale(w, h);
}

double mdt_worldCalmSpeed(const MdtWorld *w, double h) {
    return fmax(1e-3 * speedScale(w, h), 0.1 * (double)w->accuracy);
}
