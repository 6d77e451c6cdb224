/* What more cores would gain: task times of one core, put onto many. */
#ifndef BENCH_CRITICAL_H
#define BENCH_CRITICAL_H

#include "Mst.h"

/* Steps the scene so many times for each number of cores, and prints how many times as fast they would be, and which
 * share of a step one thread does alone, by stage. */
void critical_tell(const char *name, MstUniverseID (*make)(void), int steps);

#endif
