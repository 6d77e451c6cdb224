/** @file MeMisc.h
 *  Colours.
 */
#ifndef MEMISC_H
#define MEMISC_H

#include "MeCall.h"

ME_BEGIN_C

/**
 * Converts a colour to red, green and blue, each 0 to 1, from hue in degrees (0 red, 120 green, 240 blue, periodic in
 * 360), saturation (0 grey, 1 full colour) and value (0 black, 1 bright). Saturation and value are clamped to 0 .. 1;
 * numbers that are not finite count as 0.
 */
MEPUBLIC void MEAPI MeHSVtoRGB(float h, float s, float v, float rgb[3]);

ME_END_C

#endif
