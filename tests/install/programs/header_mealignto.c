/* MeALIGNTO and MeALIGNDATA align data, and ME_REPORT comes through MeMessage.h. */
#include "MeMessage.h"
#include "MePrecision.h"
#include <stddef.h>

static MeALIGNDATA(MeMatrix4, byData, 16);
MeALIGNTO(16) static MeMatrix4 byPrefix;

int main(void) {
    ME_REPORT(MeInfo(9, "not shown"));
    return ((size_t)byData | (size_t)byPrefix) % 16 != 0;
}
