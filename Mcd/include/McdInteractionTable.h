/** @file McdInteractionTable.h
 *  The table of interactions belongs to the framework, see McdFrame.h. Programs of earlier versions name this
 *  header.
 */
#ifndef MCDINTERACTIONTABLE_H
#define MCDINTERACTIONTABLE_H

#include "McdFrame.h"

#endif
