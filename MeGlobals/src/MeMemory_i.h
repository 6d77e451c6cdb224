/* Inside MeGlobals: allocation by MeMemoryAPI with MeFatalError on failure. */
#ifndef MEMEMORY_I_H
#define MEMEMORY_I_H

#include "MeMemory.h"

/* Both return null, after a fatal error that names `function`, if out of memory. */
void *me_create(size_t bytes, const char *function);
void *me_createAligned(size_t bytes, unsigned int alignment, const char *function);

#endif
