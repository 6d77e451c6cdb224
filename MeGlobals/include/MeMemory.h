/** @file MeMemory.h
 *  Memory allocation.
 *
 *  Karma allocates all memory by the functions in MeMemoryAPI. A program may replace them, before it calls any other
 *  function of Karma:
 *
 *  @code
 *      MeMemoryAPI.create = MyCreate;
 *      MeMemoryAPI.destroy = MyDestroy;
 *      MeMemoryAPI.createAligned = MyCreateAligned;
 *      MeMemoryAPI.destroyAligned = MyDestroyAligned;
 *  @endcode
 *
 *  create and destroy belong together, and so do createAligned and destroyAligned: replace both of a pair, or neither.
 *  resize belongs to create and destroy; Karma never calls it, so it need not be replaced by programs that do not call
 *  it. No member may be null. Karma never destroys null. The functions are called on the threads that call Karma.
 *
 *  A function without memory returns null. Karma then calls MeFatalError with a text that names the function that the
 *  program called and the purpose of the memory. If that returns, the Karma function returns a neutral result: nothing
 *  was created, or the effect that needed the memory is missing in this step; nothing is lost or leaked.
 *
 *  Other libraries allocate their own memory: FCL's tree of boxes in each McdSpace (C++'s new: two nodes per model;
 *  recovers without memory), Qhull during McdConvexMeshCreateHull (malloc; its hooks qh_malloc and qh_free are global
 *  functions of the program, so Karma does not replace them), and OpenGL, freeglut, stb, Dear ImGui and assimp in the
 *  viewer.
 */
#ifndef MEMEMORY_H
#define MEMEMORY_H

#include "MeCall.h"
#include <stddef.h>

ME_BEGIN_C

/** @name Functions of the program
 *  They may be called in the middle of any operation, and must not create, destroy, enable or step anything of Karma:
 *  such calls are refused, with a warning (docs/simulation.md, "Callbacks").
 *  @{ */
/** Allocates @a bytes (0 counts as 1) of memory, aligned for all C types, with undefined contents. Null if there is
 *  none. */
typedef void *(MEAPI *MeMemoryFuncPtrCreate)(size_t bytes);
/** The same, aligned to @a alignment bytes, a power of 2. */
typedef void *(MEAPI *MeMemoryFuncPtrCreateAligned)(size_t bytes, unsigned int alignment);
/** Reallocates a block of create with another size, keeping the contents that fit. A null block: allocates. Null if
 *  there is no memory: then the block is unchanged. */
typedef void *(MEAPI *MeMemoryFuncPtrResize)(void *const block, size_t bytes);
/** Frees a block. Null does nothing. */
typedef void(MEAPI *MeMemoryFuncPtrDestroy)(void *const block);
/** @} */

/** The functions in use. */
typedef struct MeMemoryAPIStruct {
    MeMemoryFuncPtrCreate create;               /**< Default: malloc. */
    MeMemoryFuncPtrCreateAligned createAligned; /**< Default: aligned_alloc. */
    MeMemoryFuncPtrResize resize;               /**< Default: realloc. */
    MeMemoryFuncPtrDestroy destroy;             /**< For blocks of create and resize. Default: free. */
    MeMemoryFuncPtrDestroy destroyAligned;      /**< For blocks of createAligned. Default: free. */
} MeMemoryAPIStruct;

/** As a maximum count: limited only by memory. Such pools start empty and double when they are full; objects that the
 *  program has pointers to do not move. */
enum { MeNoLimit = 0x7fffffff };

extern MEPUBLIC MeMemoryAPIStruct MeMemoryAPI; /**< Set it before the first call of anything else of Karma. */

ME_END_C

#endif
