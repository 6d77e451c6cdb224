/* MeMath.h alone brings messages, assertions and the C library that programs use. */
#include "MeMath.h"

int main(void) {
    char text[16];
    memset(text, 0, sizeof text);
    sprintf(text, "%d", abs(-7));
    free(malloc(4));
    MEASSERT(sqrt(4.) == 2);
    MeInfo(9, "not shown");
    ME_REPORT(MeInfo(9, "not shown"));
    return strcmp(text, "7");
}
