/* Mdt.h alone brings mathematics, memory, messages, chunks, pools, every joint, the constraint library and the main
 * loop. */
#include "Mdt.h"

int main(void) {
    MeChunk chunk;
    MeChunkInit(&chunk, 16);
    MeChunkPutMem(&chunk, MeChunkGetMem(&chunk, 100));
    MeChunkTerm(&chunk);

    MePool pool;
    if (!MePoolFixedAPI.init(&pool, sizeof(MeVector3), 2, 16))
        return 1;
    pool.api->destroy(&pool);

    MdtBclContactParams friction;
    MdtContactParamsReset(&friction);
    MeMemoryAPI.destroy(MeMemoryAPI.create(8));
    MeInfo(9, "not shown: %d", (int)MdtBclGETMAXROWS);

    MdtWorldID world = MdtWorldCreate(2, 2);
    MdtBSJointID ball = MdtBSJointCreate(world);
    MdtHingeID hinge = MdtHingeCreate(world);
    MdtBSJointDestroy(ball);
    MdtHingeDestroy(hinge);
    MdtWorldDestroy(world);
    return strlen("libc") != 4;
}
