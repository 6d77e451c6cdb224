/* The debug drawing functions in use. */
#include "MeDebugDraw.h"

static void MEAPI drawNothing(MeVector3 start, MeVector3 end, MeReal r, MeReal g, MeReal b) {
    (void)start, (void)end, (void)r, (void)g, (void)b;
}

MeDebugDrawAPIStruct MeDebugDrawAPI = {drawNothing};
