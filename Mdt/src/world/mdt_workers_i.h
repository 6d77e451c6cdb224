/* Inside Mdt: a world's workers. */
#ifndef MDT_WORKERS_I_H
#define MDT_WORKERS_I_H

#include "step/mdt_step_i.h"

/* Sets the number of workers, with their own memory except for scratch of steps. False: no memory, and nothing has
 * changed. Ends all of them (MdtWorldTasks.c). */
MeBool mdt_workersInit(MdtWorldID w, int count, const char *caller);
void mdt_workersTerm(MdtWorldID w);

#endif
