/* The containers that programs use beside Karma's own objects. */
#include "Mdt.h"
#include "MeBounding.h"
#include "MeDict.h"
#include "MeHash.h"
#include "MeHeap.h"
#include "MeIDPool.h"
#include "MePoolx.h"
#include "MeSet.h"

static int MEAPI byValue(const void *a, const void *b) {
    return *(const int *)a - *(const int *)b;
}

int main(void) {
    int number[3] = {3, 1, 2};
    MeHash *names = MeHashCreate(16);
    MeHashSetHashFunc(names, MeHashString);
    MeHashSetKeyCompareFunc(names, MeHashStringCompare);
    MeHashInsert("wheel", &number[0], names);
    const int found = MeHashLookup("wheel", names) == &number[0];
    MeHashDestroy(names);

    MeHeap *heap = MeHeapCreate(3, byValue);
    MeSet *set = MeSetCreate(byValue);
    MeIDPool *ids = MeIDPoolCreate();
    for (int i = 0; i < 3; i++) {
        MeHeapPush(heap, &number[i]);
        MeSetAdd(set, &number[i]);
    }
    const int min = *(int *)MeHeapPop(heap), max = *(int *)MeSetPop(set);
    const int first = MeIDPoolRequestID(ids), second = MeIDPoolRequestID(ids);
    MeHeapDestroy(heap);
    MeSetDestroy(set);
    MeIDPoolDestroy(ids);

    MeVector3 point[2] = {{0, 0, 0}, {2, 0, 0}}, centre;
    MeReal radius;
    MeBoundingSphereCalc(point, 2, centre, &radius);
    return !(found && min == 1 && max == 3 && first == 0 && second == 1 && centre[0] == 1 && radius >= 1);
}
