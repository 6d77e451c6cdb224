/* What MeViewer.h brings along. */
#include "MeViewer.h"

int main(void) {
    float colour[4];
    MeMatrix4 tm;
    void *block = MeMemoryAPI.create(8);
    MeMemoryAPI.destroy(block);
    MeHSVtoRGB(120, 1, 1, colour);
    MeMatrix4TMMakeIdentity(tm);
    MeProfileStartSection("a", 0);
    MeProfileEndSection("a");
    MeWarning(9, "not shown");
    return sizeof(AcmeVector3) != 3 * sizeof(AcmeReal) || colour[1] != 1 || tm[0][0] != 1;
}
