/* Inside Mdt: a world's workers. */
#ifndef MDT_WORKERS_I_H
#define MDT_WORKERS_I_H

#include "step/mdt_step_i.h"

/* Sets the number of workers and allocates their memory, except for scratch memory of steps. False, after a fatal
 * error, if there is no memory: nothing is changed. mdt_workersTerm frees all workers (MdtWorldTasks.c). */
MeBool mdt_workersInit(MdtWorldID w, int count, const char *caller);
void mdt_workersTerm(MdtWorldID w);

#endif
