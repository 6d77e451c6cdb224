/** @file MeStream.h
 *  Streams: files, or memory buffers with the same interface.
 *
 *  A stream has one position for reading and writing. Every function warns of a null stream, and then does nothing or
 *  returns 0. A stream may be used by one thread at a time.
 */
#ifndef MESTREAM_H
#define MESTREAM_H

#include "MeSimpleFile.h"
#include <stddef.h>

ME_BEGIN_C

/** An opaque type. */
typedef struct _MeStream _MeStream;
typedef _MeStream *MeStream;

/** @name Life
 *  Null, after MeFatalError, if there is no memory.
 *  @{ */
/** Opens a file as MeOpen does. Null, without a message, if it cannot be opened. */
MEPUBLIC MeStream MEAPI MeStreamOpen(const char *filename, MeOpenMode_enum mode);
/** Opens a file as MeOpenWithSearch does. */
MEPUBLIC MeStream MEAPI MeStreamOpenWithSearch(const char *filename, MeOpenMode_enum mode);
/** Creates an empty stream in its own memory, with an initial capacity, which grows. */
MEPUBLIC MeStream MEAPI MeStreamOpenAsMemBuffer(unsigned int initialSize);
/** Creates a stream in the program's memory: bufLength bytes may be read, and bufSize, at least as many, may be
 *  written. The memory is owned by the program and must exist until the stream is closed. When more than bufSize bytes
 *  are written, the stream continues in its own memory, and the buffer keeps its contents of that time. Null, with a
 *  warning, for bad arguments. */
MEPUBLIC MeStream MEAPI MeStreamCreateFromMemBuffer(char *buffer, unsigned int bufLength, unsigned int bufSize);
/** Closes a stream, and frees its own memory. Null does nothing. */
MEPUBLIC void MEAPI MeStreamClose(MeStream stream);
/** @} */

/** @name Reading and writing
 *  @{ */
/** Reads up to count whole records of size bytes; returns their number. */
MEPUBLIC size_t MEAPI MeStreamRead(void *buffer, size_t size, size_t count, MeStream stream);
/** Writes count records of size bytes over existing data; returns their number. */
MEPUBLIC size_t MEAPI MeStreamWrite(void *buffer, size_t size, size_t count, MeStream stream);
/** Reads up to and including the end of the line, but at most n - 1 bytes, and appends a 0, as fgets does. Returns
 *  string; null at the end of the stream, and, with a warning, for a null string or n < 1. */
MEPUBLIC char *MEAPI MeStreamReadLine(char *string, int n, MeStream stream);
/** Sets the position to the beginning. */
MEPUBLIC void MEAPI MeStreamRewind(MeStream stream);
/** @} */

/** @name Memory
 *  For memory streams; a file stream gets a warning.
 *  @{ */
/** Frees the stream's own memory beyond its contents. */
MEPUBLIC void MEAPI MeStreamMemBufferFreeSlackSpace(MeStream stream);
/** Whether the memory grows only as needed, instead of at least doubling. Default: false. */
MEPUBLIC void MEAPI MeStreamMemBufferUseConservativeGrowth(MeStream stream, MeBool bConsGrowth);
/** @} */

ME_END_C

#endif
