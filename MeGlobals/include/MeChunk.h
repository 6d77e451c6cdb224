/** @file MeChunk.h
 *  A scratch buffer that grows to what is asked of it (User Guide app. C, "Memory Usage In Kea").
 *
 *  A chunk hands out one piece of memory at a time. It starts with 1024 bytes and doubles until the piece
 *  fits; contents do not survive from one piece to the next. When the needs are the same in every frame, the
 *  chunk stops allocating after the first.
 *
 *  Every function warns of a null chunk, and then does nothing or gives 0. One chunk is for one thread at a
 *  time.
 */
#ifndef MECHUNK_H
#define MECHUNK_H

#include "MePrecision.h"

ME_BEGIN_C

/** What happens to the memory when a piece is given back. */
typedef enum kMeChunkMode {
    kMeChunkModeKeepOnPut = 1, /**< It is kept for the next piece. The default. */
    kMeChunkModeFreeOnPut = 2  /**< It is freed. */
} kMeChunkMode;

/** Read and changed by the functions below only. */
typedef struct MeChunk {
    void *mem;         /**< Null, or size bytes. */
    int size;          /**< bytes */
    int maxSize;       /**< bytes, the largest piece asked for */
    int alignment;     /**< bytes, a power of 2 */
    MeBool inUse;      /**< A piece is out. */
    kMeChunkMode mode; /**< What PutMem does. */
} MeChunk;

/** Makes an empty chunk whose pieces begin at multiples of @a alignment bytes: a power of 2, else it warns
 *  and takes 16. Allocates nothing. */
MEPUBLIC void MEAPI MeChunkInit(MeChunk *chunk, int alignment);
/** Frees the memory, that of a piece which is out included (with a warning). The chunk is then as after
 *  MeChunkInit. */
MEPUBLIC void MEAPI MeChunkTerm(MeChunk *chunk);
/** Sets the mode for pieces given back from now on. Anything but a mode warns and changes nothing. */
MEPUBLIC void MEAPI MeChunkSetMode(MeChunk *chunk, kMeChunkMode mode);
/** Grows the chunk to hold @a initialSize bytes now, and not in the frame that first needs them. A negative
 *  size, or a piece that is out, warns and changes nothing. */
MEPUBLIC void MEAPI MeChunkSetAuto(MeChunk *chunk, int initialSize);

/**
 * A piece of @a size bytes, with any contents, to be given back with MeChunkPutMem.
 * @return null, with a warning, for a negative size or while a piece is out; null if out of memory
 */
MEPUBLIC void *MEAPI MeChunkGetMem(MeChunk *chunk, int size);
/** Gives the piece back. Null does nothing; anything else that is not the piece that is out warns. */
MEPUBLIC void MEAPI MeChunkPutMem(MeChunk *chunk, void *mem);

/** @name What a chunk has
 *  @{ */
MEPUBLIC MeBool MEAPI MeChunkIsInUse(MeChunk *chunk);     /**< Is a piece out? */
MEPUBLIC int MEAPI MeChunkGetCurrentSize(MeChunk *chunk); /**< The bytes that the chunk holds now. */
/** The bytes of the largest piece asked for so far. */
MEPUBLIC int MEAPI MeChunkGetMaxSize(MeChunk *chunk);
MEPUBLIC int MEAPI MeChunkGetAlignment(MeChunk *chunk); /**< As given to MeChunkInit. */
/** @} */

ME_END_C

#endif
