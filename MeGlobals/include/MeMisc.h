/** @file MeMisc.h
 *  Colours (User Guide app. B, "Creating the Graphics").
 */
#ifndef MEMISC_H
#define MEMISC_H

#include "MeCall.h"

ME_BEGIN_C

/**
 * Red, green and blue, 0 to 1, of a colour given by its hue in degrees (0 red, 120 green, 240 blue, 360 red
 * again, and so on round the circle), its saturation (0 grey, 1 full colour) and its value (0 black, 1
 * bright). Saturation and value outside 0 to 1 count as the nearer end, and what is not a finite number as 0.
 */
MEPUBLIC void MEAPI MeHSVtoRGB(float h, float s, float v, float rgb[3]);

ME_END_C

#endif
