/** @file MeSimpleFile.h
 *  Files by numbers, as the system knows them: what programs read their data with.
 *
 *  A file that cannot be opened gives -1, without a message: programs ask, and go on. Otherwise a number of 0 or more,
 *  to be closed by MeClose. The functions warn of null pointers, of counts below 0 and of numbers of files that are not
 *  open, and then give -1 or null. Bytes are read and written as they are, whatever the mode.
 */
#ifndef MESIMPLEFILE_H
#define MESIMPLEFILE_H

#include "MePrecision.h"

ME_BEGIN_C

/** What a file is opened for. */
typedef enum MeOpenMode_enum {
    kMeOpenModeRDONLY = 0,  /**< To be read; there must be such a file. */
    kMeOpenModeWRONLY = 1,  /**< To be written: made if there is none, else emptied. */
    kMeOpenModeRDWR = 2,    /**< To be read and written: made if there is none, else kept as it is. */
    kMeOpenModeRDBINARY = 3 /**< The same as kMeOpenModeRDONLY. */
} MeOpenMode_enum;

/** Where MeLseek counts from. */
typedef enum MeSeekOrigin_enum {
    kMeSeekSET = 0, /**< From the beginning. */
    kMeSeekCUR = 1, /**< From where the file is read next. */
    kMeSeekEND = 2  /**< From the end. */
} MeSeekOrigin_enum;

/** @name Opening
 *  Directories are not files: -1.
 *  @{ */
/** Opens the file of exactly that name. */
MEPUBLIC int MEAPI MeOpenRaw(const char *filename, MeOpenMode_enum mode);
/** The same; where there is no such file, backslashes count as slashes: names may be those of programs for Windows. */
MEPUBLIC int MEAPI MeOpen(const char *filename, MeOpenMode_enum mode);
/** MeOpen; to be read, a file that is not there is looked for in the directories of MeGetDefaultFileLocation, in their
 *  order: first by the name as it is given, if that is relative, then by what follows its last slash. */
MEPUBLIC int MEAPI MeOpenWithSearch(const char *filename, MeOpenMode_enum mode);
/**
 * Directories that are searched, i = 0, 1, ... until null: the one that the environment variable KARMA_FILES names, if
 * it is set, then resources, ../resources, ../../resources, .. and ../.. of the working directory.
 */
MEPUBLIC const char *MEAPI MeGetDefaultFileLocation(int i);
/** Closes a file: 0, or -1. */
MEPUBLIC int MEAPI MeClose(int file);
/** @} */

/** @name Reading and writing
 *  @{ */
/** Reads count bytes, or as many as there are; how many, 0 at the end, -1 if it cannot be read. */
MEPUBLIC int MEAPI MeRead(int file, void *buf, int count);
/** Writes count bytes; how many, -1 if it cannot be written. */
MEPUBLIC int MEAPI MeWrite(int file, void *buf, int count);
/** Sets where the file is read or written next: offset bytes from the origin. The place from the beginning, -1 for one
 *  before it, which changes nothing. */
MEPUBLIC int MEAPI MeLseek(int file, int offset, MeSeekOrigin_enum origin);
/** All bytes of a file from its beginning on, with a 0 after them; size gets how many, without the 0, and may be null.
 *  The memory is the caller's, who gives it to MeMemoryAPI.destroy. The file stays open. Null if it cannot be read. */
MEPUBLIC char *MEAPI MeLoadWholeFileHandle(const int f, int *size);
/** Makes size bytes all that is in a file. It stays open. What cannot be written gets a warning. */
MEPUBLIC void MEAPI MeSaveWholeFileHandle(const int f, const char *data, const int size);
/** @} */

ME_END_C

#endif
