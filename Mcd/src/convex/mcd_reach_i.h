/* Inside Mcd: which gaps of two shapes are contacts, and how the shapes move before the next test. */
#ifndef MCD_REACH_H
#define MCD_REACH_H

#include "McdGeometryTypes.h"

/* How a shape moves before the next test, if contacts do not change that. */
typedef struct McdCourse {
    double shift[3], turn[3]; /* m, of the centre about which it turns; rad */
    double arm[3];            /* m: from its place to that centre */
    double extent;            /* m, of an aggregate of which it is a child; else 0 */
    MeBool isFree;            /* contacts do change it */
} McdCourse;
typedef struct McdForecast {
    McdCourse course[2]; /* of both shapes */
    double fall[3];      /* m, of what is free */
} McdForecast;

/* Which gaps are contacts. */
typedef struct McdReach McdReach;
struct McdReach {
    double margin;   /* m: the largest gap */
    double approach; /* m: by how much surfaces may come nearer before the next test, also by falling; 0: not known */
    const McdGeometryInstance *instance[2];                  /* of both shapes, for: */
    void (*forecast)(const McdReach *reach, McdForecast *f); /* null: not known */
};
/* That of the shapes in the other order. */
static inline McdReach mcd_reachSwap(McdReach reach) {
    const McdGeometryInstance *first = reach.instance[0];
    reach.instance[0] = reach.instance[1];
    reach.instance[1] = first;
    return reach;
}

#endif
