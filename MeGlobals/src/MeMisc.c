/* Colours. */
#include "MeMisc.h"
#include "MeMessage.h"

#include <math.h>

static float toUnitInterval(float x) {
    if (!isfinite(x))
        return 0;
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* The share of a primary in a colour whose hue is `distance` sixths of the colour circle away: 1 up to one sixth, 0
 * from two sixths on. */
static float primaryShare(float distance) {
    const float shortest = distance > 3 ? 6 - distance : distance;
    return toUnitInterval(2 - shortest);
}

void MEAPI MeHSVtoRGB(float h, float s, float v, float rgb[3]) {
    if (!rgb) {
        MeWarning(1, "MeHSVtoRGB: rgb is null");
        return;
    }
    const float turn = isfinite(h) ? fmodf(h, 360) : 0;
    const float hue = (turn < 0 ? turn + 360 : turn) / 60;
    const float saturation = toUnitInterval(s), value = toUnitInterval(v);
    for (int i = 0; i < 3; i++) {
        const float primary = 2 * (float)i; /* red at 0, green at 2, blue at 4 sixths */
        rgb[i] = value * (1 - saturation * (1 - primaryShare(fabsf(hue - primary))));
    }
}
