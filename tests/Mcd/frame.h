/* A framework that goes with all that is in it at the end of the test. */
#ifndef FRAME_H
#define FRAME_H

#include "Mcd.h"
#include "karma_test.h"

static inline void frame_end(void *frame) {
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}

static inline McdFrameworkID frame_make(int userTypes, int models, int instances, MeReal scale) {
    McdFrameworkID f = McdInit(userTypes, models, instances, scale);
    test_finally(frame_end, f);
    return f;
}

#endif
