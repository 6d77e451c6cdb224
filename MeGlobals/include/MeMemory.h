/** @file MeMemory.h
 *  Where Karma's memory comes from (User Guide app. C, "Re-Routing Memory Management In Karma").
 *
 *  All memory that Karma allocates comes from the functions in MeMemoryAPI. A program that wants its own sets
 *  them before it calls anything else of Karma:
 *
 *  @code
 *      MeMemoryAPI.create = MyCreate;
 *      MeMemoryAPI.destroy = MyDestroy;
 *      MeMemoryAPI.createAligned = MyCreateAligned;
 *      MeMemoryAPI.destroyAligned = MyDestroyAligned;
 *  @endcode
 *
 *  create and destroy belong together, and so do createAligned and destroyAligned: replace both of a pair, or
 *  neither. Karma itself never calls resize, so a program that does not call it either may leave it as it is;
 *  otherwise it belongs to create and destroy. No member may be null. Karma never destroys
 *  a null. It calls the functions from the
 *  threads that call Karma.
 *
 *  A function that has no memory to give returns null. The Karma function that asked then calls MeFatalError with a
 *  text that says which function the program has called and what there was no memory for, and if that returns, has a
 *  neutral result: nothing was created, or what the memory was for does not happen in this step; nothing is lost or
 *  left over.
 *
 *  What other libraries allocate is theirs: FCL's tree of boxes in each McdSpace (C++'s new: two nodes for each model
 *  there, mended without failing where there is no memory), Qhull while McdConvexMeshCreateHull runs (malloc; its hooks
 *  qh_malloc and qh_free are functions of the whole program, which Karma leaves to it), and OpenGL, freeglut, stb,
 *  Dear ImGui and assimp in the viewer.
 */
#ifndef MEMEMORY_H
#define MEMEMORY_H

#include "MeCall.h"
#include <stddef.h>

ME_BEGIN_C

/** @name Functions of the program
 *  They are called in the middle of anything, and must not create, destroy, enable or step anything of Karma: such
 *  calls are refused, with a warning (docs/simulation.md, "Callbacks").
 *  @{ */
/** Gives @a bytes (0 counts as 1) of memory, aligned for any of C's types, with any contents. Null if there
 *  is none. */
typedef void *(MEAPI *MeMemoryFuncPtrCreate)(size_t bytes);
/** The same, at a multiple of @a alignment bytes, which is a power of 2. */
typedef void *(MEAPI *MeMemoryFuncPtrCreateAligned)(size_t bytes, unsigned int alignment);
/** Gives memory of another size with the same contents, as far as they fit, instead of a block from create. A
 *  null block is like none. Null if there is none: then the block is as it was. */
typedef void *(MEAPI *MeMemoryFuncPtrResize)(void *const block, size_t bytes);
/** Takes a block back. Null is no block. */
typedef void(MEAPI *MeMemoryFuncPtrDestroy)(void *const block);
/** @} */

/** The functions in use. */
typedef struct MeMemoryAPIStruct {
    MeMemoryFuncPtrCreate create;               /**< Default: malloc. */
    MeMemoryFuncPtrCreateAligned createAligned; /**< Default: aligned_alloc. */
    MeMemoryFuncPtrResize resize;               /**< Default: realloc. */
    MeMemoryFuncPtrDestroy destroy;             /**< For what create and resize gave. Default: free. */
    MeMemoryFuncPtrDestroy destroyAligned;      /**< For what createAligned gave. Default: free. */
} MeMemoryAPIStruct;

/** As a number of things that there may be: as many as there is memory for. Pools begin without, then, and grow when
 *  they are full, each time to twice their size; nothing that a program has a pointer to moves. */
enum { MeNoLimit = 0x7fffffff };

extern MEPUBLIC MeMemoryAPIStruct MeMemoryAPI; /**< Set it before the first call of anything else of Karma. */

ME_END_C

#endif
