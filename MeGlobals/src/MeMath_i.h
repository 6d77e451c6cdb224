/* Lengths of arrays of three or four numbers, for the files of MeMath.h. */
#ifndef MEMATH_I_H
#define MEMATH_I_H

#include "MeMath.h"

/* The length of n numbers, right for any that are finite as long as it is itself. */
MeReal me_length(const MeReal *v, int n);

/* Brings n numbers to length 1 and returns the length they had, or returns 0 and leaves them if they have no
 * direction. */
MeReal me_normalize(MeReal *v, int n);

#endif
