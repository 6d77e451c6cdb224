/** @file MeChunk.h
 *  A growing scratch buffer.
 *
 *  A chunk lends one block of memory at a time. Its capacity starts at 1024 bytes and doubles until the requested block
 *  fits; contents are lost when it grows or is lent again. If all frames need the same memory, only the first one
 *  allocates.
 *
 *  Every function warns of a null chunk, and then does nothing or returns 0. A chunk may be used by one thread at a
 *  time.
 */
#ifndef MECHUNK_H
#define MECHUNK_H

#include "MePrecision.h"

ME_BEGIN_C

/** What MeChunkPutMem does with the memory. */
typedef enum kMeChunkMode {
    kMeChunkModeKeepOnPut = 1, /**< Keeps the memory for the next block. The default. */
    kMeChunkModeFreeOnPut = 2  /**< Frees the memory. */
} kMeChunkMode;

/** A chunk. Use only the functions below. */
typedef struct MeChunk {
    void *mem;         /**< null, or size bytes */
    int size;          /**< bytes */
    int maxSize;       /**< bytes, the largest block so far */
    int alignment;     /**< bytes, a power of 2 */
    MeBool inUse;      /**< The block is lent. */
    kMeChunkMode mode; /**< What MeChunkPutMem does. */
} MeChunk;

/** Initializes an empty chunk whose blocks are aligned to @a alignment bytes, a power of 2; otherwise warns and uses
 *  16. Allocates nothing. */
MEPUBLIC void MEAPI MeChunkInit(MeChunk *chunk, int alignment);
/** Frees the memory, with a warning if the block is lent. The chunk is then as after MeChunkInit. */
MEPUBLIC void MEAPI MeChunkTerm(MeChunk *chunk);
/** Sets the mode for blocks returned from now on. An unknown mode warns and changes nothing. */
MEPUBLIC void MEAPI MeChunkSetMode(MeChunk *chunk, kMeChunkMode mode);
/** Allocates at least @a initialSize bytes in advance. A negative size, or a lent block, warns and changes nothing. */
MEPUBLIC void MEAPI MeChunkSetAuto(MeChunk *chunk, int initialSize);

/**
 * Lends a block of @a size bytes with undefined contents, to be returned with MeChunkPutMem.
 * @return null, with a warning, for a negative size or while the block is lent; null if out of memory
 */
MEPUBLIC void *MEAPI MeChunkGetMem(MeChunk *chunk, int size);
/** Returns the block. Null does nothing; any other pointer than the lent block warns. */
MEPUBLIC void MEAPI MeChunkPutMem(MeChunk *chunk, void *mem);

/** @name Properties of a chunk
 *  @{ */
MEPUBLIC MeBool MEAPI MeChunkIsInUse(MeChunk *chunk);     /**< Is the block lent? */
MEPUBLIC int MEAPI MeChunkGetCurrentSize(MeChunk *chunk); /**< The capacity now, bytes. */
/** The size of the largest block so far, bytes. */
MEPUBLIC int MEAPI MeChunkGetMaxSize(MeChunk *chunk);
MEPUBLIC int MEAPI MeChunkGetAlignment(MeChunk *chunk); /**< As given to MeChunkInit. */
/** @} */

ME_END_C

#endif
