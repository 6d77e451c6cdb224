/* The mark that makes a mixture of precisions a link error (see MePrecision.h). */
#include "MePrecision.h"

const char ME_PRECISION_MARK = 1;
