/** @file McdInteractionTable.h
 *  For programs written for earlier versions: the table of interactions belongs to the framework, see McdFrame.h.
 */
#ifndef MCDINTERACTIONTABLE_H
#define MCDINTERACTIONTABLE_H

#include "McdFrame.h"

#endif
