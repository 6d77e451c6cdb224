/** @file MeSimpleFile.h
 *  Files by descriptors of the system.
 *
 *  An open file has a number >= 0, to be closed by MeClose. If it cannot be opened, the result is -1, without a
 *  message. All functions warn of null pointers, negative counts and descriptors that are not open, and then return -1
 *  or null. Bytes are read and written unchanged in all modes.
 */
#ifndef MESIMPLEFILE_H
#define MESIMPLEFILE_H

#include "MePrecision.h"

ME_BEGIN_C

/** The access mode of a file. */
typedef enum MeOpenMode_enum {
    kMeOpenModeRDONLY = 0,  /**< Read; the file must exist. */
    kMeOpenModeWRONLY = 1,  /**< Write; created, or truncated if it exists. */
    kMeOpenModeRDWR = 2,    /**< Read and write; created if missing, otherwise unchanged. */
    kMeOpenModeRDBINARY = 3 /**< The same as kMeOpenModeRDONLY. */
} MeOpenMode_enum;

/** The origin of MeLseek. */
typedef enum MeSeekOrigin_enum {
    kMeSeekSET = 0, /**< From the beginning. */
    kMeSeekCUR = 1, /**< From the present position. */
    kMeSeekEND = 2  /**< From the end. */
} MeSeekOrigin_enum;

/** @name Opening
 *  Directories cannot be opened: -1.
 *  @{ */
/** Opens a file by exactly this name. */
MEPUBLIC int MEAPI MeOpenRaw(const char *filename, MeOpenMode_enum mode);
/** Opens a file; if there is none of this name, with backslashes replaced by slashes, as in names of programs for
 * Windows. */
MEPUBLIC int MEAPI MeOpen(const char *filename, MeOpenMode_enum mode);
/** MeOpen; in modes for reading, a missing file is searched in the directories of MeGetDefaultFileLocation, in order:
 *  in each by the given name, if it is relative, then by the part after its last slash. */
MEPUBLIC int MEAPI MeOpenWithSearch(const char *filename, MeOpenMode_enum mode);
/**
 * The i-th directory of the search; null after the last: the value of the environment variable KARMA_FILES, if set,
 * then resources, ../resources, ../../resources, .. and ../.. relative to the working directory.
 */
MEPUBLIC const char *MEAPI MeGetDefaultFileLocation(int i);
/** Closes a file: 0, or -1. */
MEPUBLIC int MEAPI MeClose(int file);
/** @} */

/** @name Reading and writing
 *  @{ */
/** Reads up to count bytes; returns their number, 0 at the end, -1 on an error. */
MEPUBLIC int MEAPI MeRead(int file, void *buf, int count);
/** Writes count bytes; returns the number written, -1 on an error. */
MEPUBLIC int MEAPI MeWrite(int file, void *buf, int count);
/** Sets the position for reading and writing: offset bytes from the origin. Returns the position from the beginning;
 *  -1, without effect, if it would be before it. */
MEPUBLIC int MEAPI MeLseek(int file, int offset, MeSeekOrigin_enum origin);
/** Reads a whole file and appends a 0; size, which may be null, gets the number of bytes without the 0. The caller owns
 *  the memory and frees it by MeMemoryAPI.destroy. The file remains open. Null if it cannot be read. */
MEPUBLIC char *MEAPI MeLoadWholeFileHandle(const int f, int *size);
/** Replaces the contents of a file. The file remains open. A failure gets a warning. */
MEPUBLIC void MEAPI MeSaveWholeFileHandle(const int f, const char *data, const int size);
/** @} */

ME_END_C

#endif
