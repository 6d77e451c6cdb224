/* The pairs of many models that move, are frozen, disabled, culled, inserted and removed, against all pairs tested one
 * by one: the same sets in the same order. */
#include "crates.h"

enum { MODELS = 60, STEPS = 300, TABLE = 4 };

typedef struct Twin { /* what the slow test knows of a model */
    MeBool isIn, hasBox, isFrozen;
    MeVector3 low, high;
    MeReal tolerance;
    int culling; /* index, or -1 */
    MeI16 key;
} Twin;

typedef struct Run {
    Yard yard;
    McdCullingTable *table;
    unsigned long long seed;
    Twin twin[MODELS];
    MeBool isDisabled[MODELS][MODELS];
    MeBool wasNear[MODELS][MODELS]; /* with the pair's object in the space, reported or in silence */
    MeBool wasRemoved[MODELS];      /* in this block: pairs of before say goodbye, whatever comes after */
    McdModelPair *object[MODELS][MODELS];
    int silent;        /* pairs that stayed in silence, over all steps */
    int order[MODELS]; /* models by sort key, then creation */
} Run;

static double randomUpTo(Run *r, double max) {
    r->seed = r->seed * 6364136223846793005ull + 1442695040888963407ull;
    return max * (double)(r->seed >> 11) / 9007199254740992.0;
}

static int chance(Run *r, int n) {
    return (int)randomUpTo(r, n);
}

static void takeBox(Run *r, int i) {
    McdModelGetAABB(r->yard.model[i], r->twin[i].low, r->twin[i].high);
    r->twin[i].hasBox = 1;
    r->twin[i].tolerance = McdModelGetContactTolerance(r->yard.model[i]);
}

static void insert(Run *r, int i) {
    Twin *t = &r->twin[i];
    t->culling = chance(r, 3) ? -1 : chance(r, TABLE);
    ck_assert(t->culling < 0
                  ? McdSpaceInsertModel(r->yard.space, r->yard.model[i])
                  : McdSpaceInsertModelWithCulling(r->yard.space, r->yard.model[i], r->table, t->culling, 5));
    t->isIn = 1;
    t->isFrozen = 0;
    if (t->hasBox)
        takeBox(r, i);
}

static void removeModel(Run *r, int i) {
    ck_assert(McdSpaceRemoveModel(r->yard.model[i]));
    r->twin[i].isIn = 0;
    r->wasRemoved[i] = 1;
    for (int j = 0; j < MODELS; j++)
        r->isDisabled[i][j] = r->isDisabled[j][i] = 0;
}

static void moveModel(Run *r, int i) {
    const MeMatrix4Ptr tm = r->yard.tm[i];
    for (int k = 0; k < 3; k++)
        tm[3][k] += (MeReal)(chance(r, 8) ? randomUpTo(r, .2) - .1 : randomUpTo(r, 6) - 3);
    for (int k = 0; k < 3; k++)
        if (tm[3][k] < 0 || tm[3][k] > 8)
            tm[3][k] = (MeReal)randomUpTo(r, 8);
    McdSpaceUpdateModel(r->yard.model[i]);
    takeBox(r, i);
}

static void toggleFrozen(Run *r, int i) {
    Twin *t = &r->twin[i];
    t->isFrozen = !t->isFrozen;
    ck_assert(t->isFrozen ? McdSpaceFreezeModel(r->yard.model[i]) : McdSpaceUnfreezeModel(r->yard.model[i]));
}

static void togglePair(Run *r, int i, int j) {
    if (i == j || !r->twin[j].isIn)
        return;
    const MeBool now = !r->isDisabled[i][j];
    r->isDisabled[i][j] = r->isDisabled[j][i] = now;
    ck_assert(now ? McdSpaceDisablePair(r->yard.model[i], r->yard.model[j])
                  : McdSpaceEnablePair(r->yard.model[j], r->yard.model[i]));
}

static void cull(Run *r, int i) {
    r->twin[i].culling = chance(r, TABLE);
    McdSpaceSetModelCullingParameters(r->yard.space, r->yard.model[i], r->table, r->twin[i].culling, 5);
}

static void change(Run *r) {
    memset(r->wasRemoved, 0, sizeof r->wasRemoved);
    for (int i = 0; i < MODELS; i++) {
        if (!r->twin[i].isIn) {
            if (chance(r, 5) == 0)
                insert(r, i);
            continue;
        }
        if (chance(r, 40) == 0)
            toggleFrozen(r, i);
        if (chance(r, 3) == 0 && !r->twin[i].isFrozen)
            moveModel(r, i);
        if (chance(r, 20) == 0)
            togglePair(r, i, chance(r, MODELS));
        if (chance(r, 100) == 0)
            cull(r, i);
        if (chance(r, 60) == 0) {
            removeModel(r, i);
            if (chance(r, 2))
                insert(r, i);
        }
    }
}

static MeBool isNear(const Run *r, int i, int j) {
    const Twin *a = &r->twin[i], *b = &r->twin[j];
    if (!a->isIn || !b->isIn || !a->hasBox || !b->hasBox || r->isDisabled[i][j])
        return 0;
    if (a->culling >= 0 && b->culling >= 0 && McdCullingTableGet(r->table, (MeU32)a->culling, (MeU32)b->culling))
        return 0;
    const MeReal margin = a->tolerance + b->tolerance;
    for (int k = 0; k < 3; k++)
        if (a->low[k] - margin > b->high[k] || b->low[k] - margin > a->high[k])
            return 0;
    return 1;
}

/* The next pair of a list: of these two models, the same object as before. */
static McdModelPair *expectPair(Run *r, int at, int end, int later, int earlier) {
    ck_assert_int_lt(at, end);
    McdModelPair *p = r->yard.pairs->array[at];
    ck_assert_ptr_eq(p->model1, r->yard.model[later]);
    ck_assert_ptr_eq(p->model2, r->yard.model[earlier]);
    return p;
}

/* Every pair in the order of the earlier, then of the later model. */
static void compare(Run *r) {
    const McdModelPairContainer *c = r->yard.pairs;
    int hello = c->helloFirst, staying = c->stayingFirst, goodbye = c->goodbyeFirst;
    for (int a = 0; a < MODELS; a++)
        for (int b = a + 1; b < MODELS; b++) {
            const int i = r->order[a], j = r->order[b];
            const MeBool cut = r->wasRemoved[i] || r->wasRemoved[j], stays = r->wasNear[i][j] && !cut;
            const MeBool areFrozen = r->twin[i].isFrozen && r->twin[j].isFrozen;
            const MeBool now = isNear(r, i, j) && (stays || !areFrozen);
            if (r->wasNear[i][j] && (!now || cut)) {
                McdModelPair *p = expectPair(r, goodbye++, c->goodbyeEnd, j, i);
                ck_assert_ptr_eq(p, r->object[i][j]);
                ck_assert_int_eq(p->phase, kMcdFFStateGoodbye);
            }
            if (now && stays && areFrozen) {
                ck_assert_ptr_eq(r->object[i][j]->model1, r->yard.model[j]);
                ck_assert_int_eq(r->object[i][j]->phase, kMcdFFStateStaying);
                r->silent++;
            } else if (now && stays) {
                McdModelPair *p = expectPair(r, staying++, c->stayingEnd, j, i);
                ck_assert_ptr_eq(p, r->object[i][j]);
                ck_assert_int_eq(p->phase, kMcdFFStateStaying);
            } else if (now) {
                r->object[i][j] = expectPair(r, hello++, c->helloEnd, j, i);
                ck_assert_int_eq(r->object[i][j]->phase, kMcdFFStateHello);
            }
            r->wasNear[i][j] = now;
        }
    ck_assert_int_eq(hello, c->helloEnd);
    ck_assert_int_eq(staying, c->stayingEnd);
    ck_assert_int_eq(goodbye, c->goodbyeEnd);
}

static void makeOrder(Run *r) {
    for (int i = 0; i < MODELS; i++) {
        int at = i;
        for (; at > 0 && r->twin[r->order[at - 1]].key > r->twin[i].key; at--)
            r->order[at] = r->order[at - 1];
        r->order[at] = i;
    }
}

static void makeRun(Run *r, unsigned long long seed) {
    memset(r, 0, sizeof *r);
    r->seed = seed;
    yardMake(&r->yard);
    r->table = McdCullingTableCreate(TABLE);
    McdCullingTableSet(r->table, 0, 1, 1);
    McdCullingTableSet(r->table, 2, 2, 1);
    for (int i = 0; i < MODELS; i++) {
        const MeReal size = (i % 10 ? .2 + randomUpTo(r, 1.5) : 5);
        yardCrate(&r->yard, size, randomUpTo(r, 8), randomUpTo(r, 8), randomUpTo(r, 8));
        McdModelSetContactTolerance(r->yard.model[i], randomUpTo(r, .05));
        r->twin[i].key = (MeI16)chance(r, 5);
        McdModelSetSortKey(r->yard.model[i], r->twin[i].key);
        insert(r, i);
    }
    makeOrder(r);
}

static void destroyRun(Run *r) {
    yardDestroy(&r->yard);
    McdCullingTableDestroy(r->table);
}

LOOP_TEST(the_same_as_all_pairs_one_by_one, 0, 6) {
    static Run r;
    int seen = 0;
    makeRun(&r, (unsigned long long)_i + 1);
    for (int step = 0; step < STEPS; step++) {
        change(&r);
        yardStep(&r.yard);
        compare(&r);
        seen += McdModelPairContainerGetHelloCount(r.yard.pairs) + McdModelPairContainerGetGoodbyeCount(r.yard.pairs);
        McdSpaceBeginChanges(r.yard.space);
    }
    ck_assert_int_gt(seen, 1000);
    ck_assert_int_gt(r.silent, 1000);
    destroyRun(&r);
}

/* Sums up what a run hands over, by the models' numbers and in order. */
static unsigned long long digest(unsigned long long seed) {
    static Run r;
    unsigned long long sum = 0;
    makeRun(&r, seed);
    for (int step = 0; step < 100; step++) {
        change(&r);
        yardStep(&r.yard);
        for (int i = 0; i < r.yard.pairs->stayingEnd; i++) {
            if (i >= r.yard.pairs->goodbyeEnd && i < r.yard.pairs->helloFirst)
                continue;
            int models[2] = {0, 0};
            for (int m = 0; m < MODELS; m++) {
                models[0] += r.yard.model[m] == r.yard.pairs->array[i]->model1 ? m : 0;
                models[1] += r.yard.model[m] == r.yard.pairs->array[i]->model2 ? m : 0;
            }
            sum = (sum ^ (unsigned long long)(models[0] * MODELS + models[1])) * 1099511628211ull;
        }
        McdSpaceBeginChanges(r.yard.space);
    }
    destroyRun(&r);
    return sum;
}

TEST(twice_the_same) {
    const unsigned long long first = digest(7);
    void *elsewhere[50]; /* other addresses */
    for (int i = 0; i < 50; i++)
        elsewhere[i] = malloc((size_t)(1000 + 77 * i));
    ck_assert(digest(7) == first);
    ck_assert(digest(8) != first);
    for (int i = 0; i < 50; i++)
        free(elsewhere[i]);
}

/* Models with sort keys of their own, created and inserted in another order: the same list. */
TEST(sort_keys_make_the_order) {
    enum { COUNT = 30 };
    static Yard y;
    static int first[COUNT * COUNT][2];
    int firstCount = 0;
    for (int round = 0; round < 3; round++) {
        static const int stride[3] = {1, 7, 23};
        yardMake(&y);
        for (int i = 0; i < COUNT; i++) {
            const int key = i * stride[round] % COUNT;
            const McdModelID m = yardCrate(&y, (MeReal)1.5, (MeReal)(key % 3), (MeReal)(key / 3 % 3), (MeReal)key / 9);
            McdModelSetSortKey(m, (MeI16)key);
            McdModelSetUserData(m, &first[key]);
        }
        for (int i = COUNT - 1; i >= 0; i--)
            McdSpaceInsertModel(y.space, y.model[(i * 11) % COUNT]);
        McdSpaceUpdateAll(y.space);
        yardStep(&y);
        const int count = McdModelPairContainerGetHelloCount(y.pairs);
        ck_assert_int_gt(count, 50);
        for (int i = 0; i < count; i++) {
            const McdModelPair *p = y.pairs->array[y.pairs->helloFirst + i];
            const int key1 = McdModelGetSortKey(p->model1), key2 = McdModelGetSortKey(p->model2);
            ck_assert_int_gt(key1, key2);
            if (round > 0) {
                ck_assert_int_eq(key1, first[i][0]);
                ck_assert_int_eq(key2, first[i][1]);
            }
            first[i][0] = key1;
            first[i][1] = key2;
        }
        ck_assert(round == 0 || count == firstCount);
        firstCount = count;
        yardDestroy(&y);
    }
}

static int allocations;
static void *(MEAPI *realCreate)(size_t);
static void *(MEAPI *realResize)(void *const, size_t);
static void *MEAPI countCreate(size_t n) {
    allocations++;
    return realCreate(n);
}
static void *MEAPI countResize(void *const p, size_t n) {
    allocations++;
    return realResize(p, n);
}

TEST(warm_steps_allocate_nothing) {
    static Yard y;
    yardMake(&y);
    for (int i = 0; i < 200; i++)
        yardPut(&y, 1, (MeReal)(i % 6), (MeReal)(i / 6 % 6), (MeReal)i / 36);
    realCreate = MeMemoryAPI.create;
    realResize = MeMemoryAPI.resize;
    for (int step = 0; step < 200; step++) {
        yardStep(&y);
        McdSpaceBeginChanges(y.space);
        if (step == 100) {
            allocations = 0;
            MeMemoryAPI.create = countCreate;
            MeMemoryAPI.resize = countResize;
        }
        for (int i = 0; i < 200; i += 7)
            yardMove(&y, i, (MeReal)(i % 6) + (MeReal)sin(.1 * step), (MeReal)(i / 6 % 6), (MeReal)i / 36);
    }
    MeMemoryAPI.create = realCreate;
    MeMemoryAPI.resize = realResize;
    ck_assert_int_eq(allocations, 0);
    yardDestroy(&y);
}

/* Boxes that come in order would make the tree a list. */
TEST(models_in_a_row) {
    static Yard y;
    yardMake(&y);
    for (int i = 0; i < CRATES; i++)
        yardPut(&y, 1, (MeReal).75 * (MeReal)i, 0, 0);
    assert_step(&y, CRATES - 1, 0, 0);
    for (int i = 0; i < CRATES; i += 2)
        yardMove(&y, i, (MeReal).75 * (MeReal)i, 5, 0);
    assert_step(&y, 0, 0, CRATES - 1);
    for (int i = CRATES - 2; i >= 0; i -= 2)
        yardMove(&y, i, (MeReal).75 * (MeReal)i, 0, 0);
    assert_step(&y, CRATES - 1, 0, 0);
    yardDestroy(&y);
}
