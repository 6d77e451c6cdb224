/** @file McdProfile.h
 *  For programs written for earlier versions: collision is measured by MeProfile.h.
 */
#ifndef MCDPROFILE_H
#define MCDPROFILE_H

#include "MeProfile.h"

#endif
