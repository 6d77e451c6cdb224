/** @file MeStream.h
 *  Streams: a file, or memory that is read and written like one.
 *
 *  A stream has one place, where the next byte is read or written. Every function warns of a null stream, and then does
 *  nothing or gives 0. A stream is for one thread at a time.
 */
#ifndef MESTREAM_H
#define MESTREAM_H

#include "MeSimpleFile.h"
#include <stddef.h>

ME_BEGIN_C

/** Hidden. */
typedef struct _MeStream _MeStream;
typedef _MeStream *MeStream;

/** @name Life
 *  Null, after MeFatalError, if there is no memory.
 *  @{ */
/** Opens a file, see MeOpen. Null, without a message, if it cannot be opened. */
MEPUBLIC MeStream MEAPI MeStreamOpen(const char *filename, MeOpenMode_enum mode);
/** The same, see MeOpenWithSearch. */
MEPUBLIC MeStream MEAPI MeStreamOpenWithSearch(const char *filename, MeOpenMode_enum mode);
/** An empty stream in memory of its own, which has place for so many bytes at first and grows. */
MEPUBLIC MeStream MEAPI MeStreamOpenAsMemBuffer(unsigned int initialSize);
/** A stream of the program's memory: bufLength bytes are there to be read, and bufSize, not fewer, can be written
 *  there. The memory stays the program's, and must stay until the stream is closed. When more than bufSize is written,
 *  the stream goes on in memory of its own, and the buffer is as it was then. Null, with a warning, for bad
 *  arguments. */
MEPUBLIC MeStream MEAPI MeStreamCreateFromMemBuffer(char *buffer, unsigned int bufLength, unsigned int bufSize);
/** Closes it, and frees memory of its own. Null does nothing. */
MEPUBLIC void MEAPI MeStreamClose(MeStream stream);
/** @} */

/** @name Reading and writing
 *  @{ */
/** Reads count records of size bytes, or as many whole ones as there are; how many. */
MEPUBLIC size_t MEAPI MeStreamRead(void *buffer, size_t size, size_t count, MeStream stream);
/** Writes count records of size bytes; how many. What is there already is replaced. */
MEPUBLIC size_t MEAPI MeStreamWrite(void *buffer, size_t size, size_t count, MeStream stream);
/** Reads to the end of the line, which counts, but at most n - 1 bytes, and puts a 0 after them, as fgets does. Returns
 *  string; null at the end of the stream, and, with a warning, for a null string or an n below 1. */
MEPUBLIC char *MEAPI MeStreamReadLine(char *string, int n, MeStream stream);
/** Back to the beginning. */
MEPUBLIC void MEAPI MeStreamRewind(MeStream stream);
/** @} */

/** @name Memory
 *  For streams in memory; a file gets a warning.
 *  @{ */
/** Gives back memory of its own that nothing was written to. */
MEPUBLIC void MEAPI MeStreamMemBufferFreeSlackSpace(MeStream stream);
/** Whether it grows by what is needed only, rather than to twice its size. Default: false. */
MEPUBLIC void MEAPI MeStreamMemBufferUseConservativeGrowth(MeStream stream, MeBool bConsGrowth);
/** @} */

ME_END_C

#endif
