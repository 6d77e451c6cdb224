/* Functions that the library calls back: what programs do there, and what they should not do there. All of
 * them now and then call functions that change or destroy what may be in use (fuzzMisuse).
 * calls.py reads the table at the end. */
#include "fuzz_calls.h"

#include <stdlib.h>

#include "Mcd.h"
#include "Mdt.h"
#include "Mst.h"

FuzzRandom fuzzCallbackRandom;

static MeReal anyReal(void) {
    return (MeReal)fuzzReal(&fuzzCallbackRandom);
}

static int maybe(void) {
    return fuzzBelow(&fuzzCallbackRandom, 2);
}

/* ---- Mcd ---- */

static int MEAPI isSeen(McdModelID m, void *data) {
    fuzzMisuse();
    (void)m;
    (void)data;
    return maybe();
}

static void spoilContacts(McdIntersectResult *result) {
    if (result->contactCount > 0 && maybe()) {
        McdContact *const c = &result->contacts[fuzzBelow(&fuzzCallbackRandom, result->contactCount)];
        c->position[fuzzBelow(&fuzzCallbackRandom, 3)] = anyReal();
        c->normal[fuzzBelow(&fuzzCallbackRandom, 3)] = anyReal();
        c->separation = anyReal();
    } else if (result->contactCount > 0 && maybe()) {
        result->contactCount--;
    }
}

static void MEAPI onModelIntersect(McdModel *m, McdIntersectResult *result) {
    fuzzMisuse();
    (void)m;
    spoilContacts(result);
}

static void MEAPI onModelUpdate(McdModel *m) {
    fuzzMisuse();
    (void)m;
}

static void MEAPI onPoolFull(McdModelID m1, McdModelID m2) {
    fuzzMisuse();
    (void)m1;
    (void)m2;
}

static void MEAPI updateBox(McdModelID m, MeReal duration) {
    fuzzMisuse();
    if (maybe())
        McdModelUpdatePath(m, duration);
}

static void MEAPI onTerm(McdFrameworkID frame) {
    fuzzMisuse();
    (void)frame;
}

static void makeTriangles(McdUserTriangle *triangles, int count, MeBool isSane) {
    static MeVector3 corners[64][3];
    static MeVector3 up = {0, 0, 1};
    for (int i = 0; i < count && i < 64; i++) {
        for (int k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++)
                corners[i][k][axis] = isSane ? (MeReal)((k == axis ? 8 : 0) - 4) : anyReal();
            if (isSane)
                corners[i][k][2] = 0;
            triangles[i].vertices[k] = &corners[i][k];
        }
        triangles[i].normal = maybe() ? &up : NULL;
        triangles[i].flags = (McdTriangleFlags)fuzzBelow(&fuzzCallbackRandom, 32);
    }
}

static int MEAPI floorOfTriangles(McdModelPair *p, McdUserTriangle *triangles, MeVector3 pos, MeReal radius, int max) {
    fuzzMisuse();
    (void)p;
    (void)pos;
    (void)radius;
    makeTriangles(triangles, max < 2 ? max : 2, METRUE);
    return max < 2 ? max : 2;
}

static int MEAPI anyTriangles(McdModelPair *p, McdUserTriangle *triangles, MeVector3 pos, MeReal radius, int max) {
    fuzzMisuse();
    (void)p;
    (void)pos;
    (void)radius;
    const int count = fuzzBelow(&fuzzCallbackRandom, max < 40 ? max + 1 : 40);
    makeTriangles(triangles, count, MEFALSE);
    return count;
}

static int MEAPI wrongCount(McdModelPair *p, McdUserTriangle *triangles, MeVector3 pos, MeReal radius, int max) {
    fuzzMisuse();
    (void)p;
    (void)pos;
    (void)radius;
    makeTriangles(triangles, max, maybe());
    return maybe() ? -1 : max;
}

/* ---- Mdt ---- */

static void MEAPI onConstraint(const MdtConstraintID c, void *data) {
    fuzzMisuse();
    (void)c;
    (void)data;
}

static void MEAPI onBody(const MdtBodyID b) {
    fuzzMisuse();
    (void)b;
}

static void MEAPI onBreak(const MdtConstraintID c) {
    fuzzMisuse();
    (void)c;
}

static MeReal MEAPI importance(const MdtContactID c) {
    fuzzMisuse();
    (void)c;
    return anyReal();
}

static void MEAPI onPartition(MdtPartitionOutput *po, void *data) {
    fuzzMisuse();
    (void)data;
    po->info[po->numPartitions - 1].isDisabled = maybe();
}

static MdtSolver MEAPI chooseSolver(MdtBodyID const bodies[], int count, void *data) {
    fuzzMisuse();
    (void)bodies;
    (void)count;
    (void)data;
    return (MdtSolver)fuzzBelow(&fuzzCallbackRandom, 4);
}

static void MEAPI addRows(MdtKeaConstraints *const list, void *const constraint,
                          const MdtKeaTransformation *const tlist, MdtKeaBody *const blist[],
                          const void *const params) {
    fuzzMisuse();
    (void)constraint;
    (void)tlist;
    (void)blist;
    (void)params;
    const int count = fuzzBelow(&fuzzCallbackRandom, 15);
    for (int i = 0; i < count; i++) {
        MdtKeaRow *const row = MdtBclAddRow(list);
        if (row)
            row->J[0].lin[i % 3] = 1, row->J[1].lin[i % 3] = -1;
    }
}

static void MEAPI addAnyRows(MdtKeaConstraints *const list, void *const constraint,
                             const MdtKeaTransformation *const tlist, MdtKeaBody *const blist[],
                             const void *const params) {
    fuzzMisuse();
    (void)constraint;
    (void)tlist;
    (void)blist;
    (void)params;
    MdtKeaRow *const row = MdtBclAddRow(list);
    for (int i = 0; row && i < 6; i++) {
        row->J[i / 3].lin[i % 3] = (double)anyReal();
        row->J[i / 3].ang[i % 3] = (double)anyReal();
    }
    if (row)
        row->target = (double)anyReal();
}

/* ---- Mst ---- */

static void MEAPI onIntersect(McdIntersectResult *result) {
    fuzzMisuse();
    spoilContacts(result);
}

static MeBool MEAPI onContact(McdIntersectResult *result, McdContact *collision, MdtContactID dynamics) {
    fuzzMisuse();
    (void)result;
    (void)collision;
    if (maybe())
        MdtContactSetNormal(dynamics, anyReal(), anyReal(), anyReal());
    if (maybe())
        MdtContactSetPenetration(dynamics, anyReal());
    return maybe();
}

static MeBool MEAPI onPair(McdIntersectResult *result, MdtContactGroupID group) {
    fuzzMisuse();
    (void)result;
    (void)group;
    return maybe();
}

static void MEAPI onTouch(const MstEvent *event) {
    fuzzMisuse();
    (void)event;
}

#define AS_ANY(f)       ((FuzzCallback)(f))
#define LIST(name, ...) static const FuzzCallback name##_list[] = {__VA_ARGS__};

LIST(McdLineSegIntersectEnableCallback, AS_ANY(isSeen))
LIST(McdModelIntersectFnPtr, AS_ANY(onModelIntersect))
LIST(McdModelUpdateFnPtr, AS_ANY(onModelUpdate))
LIST(McdSpacePoolErrorFnPtr, AS_ANY(onPoolFull))
LIST(McdSpaceUpdateAABBFnPtr, AS_ANY(updateBox))
LIST(McdTermAction, AS_ANY(onTerm))
LIST(McdTriangleListFnPtr, AS_ANY(floorOfTriangles), AS_ANY(anyTriangles), AS_ANY(wrongCount))
LIST(MdtConstraintIteratorCBPtr, AS_ANY(onConstraint))
LIST(MdtBodyHandler, AS_ANY(onBody))
LIST(MdtBreakCBPtr, AS_ANY(onBreak))
LIST(MdtContactImportanceCBPtr, AS_ANY(importance))
LIST(MdtPartitionEndCB, AS_ANY(onPartition))
LIST(MdtSolverCB, AS_ANY(chooseSolver))
LIST(MdtBclAddConstraintFn, AS_ANY(addRows), AS_ANY(addAnyRows))
LIST(MstIntersectCBPtr, AS_ANY(onIntersect))
LIST(MstPerContactCBPtr, AS_ANY(onContact))
LIST(MstPerPairCBPtr, AS_ANY(onPair))
LIST(MstTouchCBPtr, AS_ANY(onTouch))

const FuzzCallbackType fuzzCallbacks[] = {
#define CALLBACK(name) {name##_list, (int)(sizeof name##_list / sizeof name##_list[0])},
    /* clang-format off */
    CALLBACK(McdLineSegIntersectEnableCallback)
    CALLBACK(McdModelIntersectFnPtr)
    CALLBACK(McdModelUpdateFnPtr)
    CALLBACK(McdSpacePoolErrorFnPtr)
    CALLBACK(McdSpaceUpdateAABBFnPtr)
    CALLBACK(McdTermAction)
    CALLBACK(McdTriangleListFnPtr)
    CALLBACK(MdtConstraintIteratorCBPtr)
    CALLBACK(MdtBodyHandler)
    CALLBACK(MdtBreakCBPtr)
    CALLBACK(MdtContactImportanceCBPtr)
    CALLBACK(MdtPartitionEndCB)
    CALLBACK(MdtSolverCB)
    CALLBACK(MdtBclAddConstraintFn)
    CALLBACK(MstIntersectCBPtr)
    CALLBACK(MstPerContactCBPtr)
    CALLBACK(MstPerPairCBPtr)
    CALLBACK(MstTouchCBPtr)
    /* clang-format on */
};
const int fuzzCallbackCount = sizeof fuzzCallbacks / sizeof fuzzCallbacks[0];
