/** @file McdProfile.h
 *  Collision measures itself by MeProfile.h, as everything else does. Programs of earlier versions name this
 *  header.
 */
#ifndef MCDPROFILE_H
#define MCDPROFILE_H

#include "MeProfile.h"

#endif
