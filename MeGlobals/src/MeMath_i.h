/* Inside MeGlobals: vector lengths, and cosine and sine of angles. */
#ifndef MEMATH_I_H
#define MEMATH_I_H

#include "MeMath.h"

/* The length of a vector of n components, accurate wherever all components and the length are finite. */
MeReal me_length(const MeReal *v, int n);

/* Normalizes a vector of n components and returns its previous length; returns 0, with the vector unchanged, if it has
 * no direction. */
MeReal me_normalize(MeReal *v, int n);

/* Cosine and sine of an angle; in single precision exact for multiples of a quarter turn, up to rounding of the angle,
 * such as ME_PI / 2. */
void me_direction(MeReal angle, MeReal *cosine, MeReal *sine);

#endif
