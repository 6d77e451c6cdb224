/* A symbol whose name depends on the precision: mixing precisions is a link error (MePrecision.h). */
#include "MePrecision.h"

const char ME_PRECISION_MARK = 1;
