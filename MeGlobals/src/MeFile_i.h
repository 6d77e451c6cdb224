/* Inside MeGlobals: opening of files. */
#ifndef MEFILE_I_H
#define MEFILE_I_H

#include "MeSimpleFile.h"

/* MeOpen and MeOpenWithSearch; warnings name `function`. */
int me_open(const char *filename, MeOpenMode_enum mode, const char *function);
int me_openWithSearch(const char *filename, MeOpenMode_enum mode, const char *function);

#endif
