/* Lengths of arrays of three or four numbers, and directions of angles, for the files of MeMath.h. */
#ifndef MEMATH_I_H
#define MEMATH_I_H

#include "MeMath.h"

/* The length of n numbers, right for any that are finite as long as it is itself. */
MeReal me_length(const MeReal *v, int n);

/* Brings n numbers to length 1 and returns the length they had, or returns 0 and leaves them if they have no
 * direction. */
MeReal me_normalize(MeReal *v, int n);

/* Cosine and sine of an angle; of what is a quarter turn, or a multiple, to its rounding in single precision, as
 * ME_PI / 2 is, exactly. */
void me_direction(MeReal angle, MeReal *cosine, MeReal *sine);

#endif
