/** @file MeVersion.h
 *  The version of this SDK: the one place where it is written. */
#ifndef MEVERSION_H
#define MEVERSION_H

#include "MeCall.h"

#define ME_PRODUCT_NAME             "Karma"
#define ME_PRODUCTVERSION_MAJOR     0
#define ME_PRODUCTVERSION_MINOR     1
#define ME_PRODUCTVERSION_REV       0
#define ME_PRODUCTVERSION_QUALIFIER "" /**< "" for a release, else a word such as "beta". */
#ifndef ME_PRODUCTVERSION_BUILDNUMBER
#define ME_PRODUCTVERSION_BUILDNUMBER 0 /**< Set by packagers with -D; 0 in a plain build. */
#endif
#define ME_VERSION_TEXT_OF(a, b, c) #a "." #b "." #c
#define ME_VERSION_TEXT(a, b, c)    ME_VERSION_TEXT_OF(a, b, c)

#define ME_VERSION_STRING ME_VERSION_TEXT(ME_PRODUCTVERSION_MAJOR, ME_PRODUCTVERSION_MINOR, ME_PRODUCTVERSION_REV)

#define ME_BUILD_VERSION_STRING ME_PRODUCT_NAME " " ME_VERSION_STRING
#define ME_COPYRIGHT_LINE1      "Copyright the Karma authors."
#define ME_COPYRIGHT_LINE2      "MIT licence: see the file LICENSE."
#define ME_COPYRIGHT_LINE3      "An independent implementation of the interface of MathEngine Karma."

ME_BEGIN_C

/** The version of the library that the program runs with, e.g. "Karma 0.1.0 (single precision)". Never null. */
MEPUBLIC const char *MEAPI MeToolkitVersionString(void);

ME_END_C

#endif
