/* The version of the library. */
#include "MeVersion.h"

#ifdef _ME_API_DOUBLE
#define PRECISION " (double precision)"
#else
#define PRECISION " (single precision)"
#endif

const char *MEAPI MeToolkitVersionString(void) {
    return ME_BUILD_VERSION_STRING ME_PRODUCTVERSION_QUALIFIER PRECISION;
}
