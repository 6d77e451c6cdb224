/* Containers of pairs, by hand and as spaces fill them; culling tables. */
#include "crates.h"

TEST(by_hand) {
    McdModelPairContainer *c = McdModelPairContainerCreate(6);
    McdModelPair pair[8];
    McdModelPairContainerIterator it;
    int count;
    for (int i = 0; i < 2; i++)
        ck_assert(McdModelPairContainerInsertGoodbyePair(c, &pair[i]));
    ck_assert(McdModelPairContainerInsertHelloPair(c, &pair[2]));
    ck_assert(!McdModelPairContainerInsertHelloPair(c, &pair[3])); /* goodbye and hello share three places */
    ck_assert(!McdModelPairContainerInsertGoodbyePair(c, &pair[3]));
    for (int i = 4; i < 7; i++)
        ck_assert(McdModelPairContainerInsertStayingPair(c, &pair[i]));
    ck_assert(!McdModelPairContainerInsertStayingPair(c, &pair[7]));
    ck_assert_ptr_eq(McdModelPairContainerGetGoodbyeArray(c, &count)[1], &pair[1]);
    ck_assert_int_eq(count, 2);
    ck_assert_ptr_eq(McdModelPairContainerGetHelloArray(c, &count)[0], &pair[2]);
    ck_assert_int_eq(count, 1);
    ck_assert_ptr_eq(McdModelPairContainerGetStayingArray(c, &count)[2], &pair[6]);
    ck_assert_int_eq(count, 3);
    McdModelPairContainerIteratorInit(&it, c);
    ck_assert_int_eq(it.next, c->helloFirst);
    McdModelPairContainerRemovePair(c, &c->array[c->stayingFirst]);
    McdModelPairContainerRemovePair(c, &c->array[0]);
    McdModelPairContainerRemovePair(c, &c->array[c->helloFirst]);
    ck_assert_int_eq(McdModelPairContainerGetHelloCount(c), 0);
    ck_assert_ptr_eq(McdModelPairContainerGetStayingArray(c, &count)[0], &pair[5]);
    ck_assert_int_eq(count, 2);
    ck_assert_ptr_eq(McdModelPairContainerGetGoodbyeArray(c, &count)[0], &pair[1]);
    ck_assert_int_eq(count, 1);
    McdModelPairContainerReset(c);
    ck_assert_int_eq(McdModelPairContainerGetHelloCount(c) + McdModelPairContainerGetStayingCount(c) +
                         McdModelPairContainerGetGoodbyeCount(c),
                     0);
    McdModelPairContainerDestroy(c);
}

/* Every size hands over the same pairs in the same order, and ends. */
TEST(overflow_hands_over_everything) {
    static Yard y;
    static McdModelPair *all[3][2000];
    int count[3] = {0, 0, 0};
    yardMake(&y);
    for (int i = 0; i < 12; i++)
        yardPut(&y, 1, 0, 0, 0);
    for (int i = 0; i < 6; i++)
        yardPut(&y, 1, 20, 0, 0);
    yardStep(&y);
    McdSpaceBeginChanges(y.space);
    for (int i = 0; i < 4; i++)
        yardMove(&y, i, 20, 0, 0);
    yardStep(&y);
    assert_pairs(&y, 24, 49, 32);
    McdModelPair **part[3] = {McdModelPairContainerGetGoodbyeArray(y.pairs, &count[0]),
                              McdModelPairContainerGetHelloArray(y.pairs, &count[1]),
                              McdModelPairContainerGetStayingArray(y.pairs, &count[2])};
    for (int k = 0; k < 3; k++)
        memcpy(all[k], part[k], (size_t)count[k] * sizeof *part[k]);
    for (int size = 1; size < 120; size += size < 5 ? 1 : 7) {
        McdModelPairContainer *c = McdModelPairContainerCreate(size);
        for (int transitions = 0; transitions < 2; transitions++) {
            McdSpacePairIterator it;
            int at[3] = {0, 0, 0}, isMore = 1, calls = 0;
            McdSpacePairIteratorBegin(y.space, &it);
            while (isMore) {
                isMore = transitions ? McdSpaceGetTransitions(y.space, &it, c) : McdSpaceGetPairs(y.space, &it, c);
                ck_assert_int_lt(calls++, 200);
                int n[3];
                McdModelPair **got[3] = {McdModelPairContainerGetGoodbyeArray(c, &n[0]),
                                         McdModelPairContainerGetHelloArray(c, &n[1]),
                                         McdModelPairContainerGetStayingArray(c, &n[2])};
                ck_assert(n[0] == 0 || at[1] == 0); /* goodbye pairs come first */
                for (int k = 0; k < 3; k++)
                    for (int i = 0; i < n[k]; i++)
                        ck_assert_ptr_eq(got[k][i], all[k][at[k]++]);
                ck_assert(!isMore || n[0] + n[1] + n[2] == size || transitions || at[2] == count[2]);
            }
            for (int k = 0; k < 3; k++)
                ck_assert_int_eq(at[k], k == 2 && transitions ? 0 : count[k]);
        }
        ck_assert(size < 105 || McdSpaceGetNextPairs(y.space, c) == 0); /* 105 pairs fit into 105 places */
        McdModelPairContainerDestroy(c);
    }
    yardDestroy(&y);
}

TEST(the_form_without_an_iterator) {
    static Yard y;
    yardMake(&y);
    for (int i = 0; i < 5; i++)
        yardPut(&y, 1, 0, 0, 0);
    McdSpaceEndChanges(y.space);
    McdModelPairContainer *c = McdModelPairContainerCreate(4);
    int calls = 0, pairs = 0, isMore = 1;
    for (; isMore; calls++) {
        isMore = McdSpaceGetPairs(y.space, c);
        pairs += McdModelPairContainerGetHelloCount(c);
    }
    ck_assert_int_eq(pairs, 10);
    ck_assert_int_eq(calls, 3);
    ck_assert_int_eq(McdSpaceGetTransitions(y.space, y.pairs), 0); /* from the first on again */
    assert_pairs(&y, 10, 0, 0);
    McdModelPairContainerDestroy(c);
    yardDestroy(&y);
}

/* As in the guide's sample: a pair of a program's own, in a container that a space filled and that was reset, at the
 * place below the first hello pair. */
TEST(pairs_of_a_programs_own) {
    static const int size[] = {1, 2, 3, 10};
    for (int n = 0; n < 4; n++) {
        static Yard y;
        McdSpacePairIterator it;
        int count;
        yardMake(&y);
        for (int i = 0; i < 3; i++)
            yardPut(&y, 1, 0, 0, 0);
        const McdModelID mine = yardCrate(&y, 1, 0, 0, 0); /* in no space */
        McdModelPairContainer *c = McdModelPairContainerCreate(size[n]);
        McdSpaceEndChanges(y.space);
        McdSpacePairIteratorBegin(y.space, &it);
        while (McdSpaceGetPairs(y.space, &it, c))
            ;
        McdModelPairContainerReset(c);
        const McdModelPairID pair = McdModelPairCreate(mine, y.model[0]);
        c->helloFirst = c->helloFirst - 1;
        ck_assert_int_ge(c->helloFirst, c->goodbyeEnd);
        c->array[c->helloFirst] = pair;
        ck_assert_ptr_eq(McdModelPairContainerGetHelloArray(c, &count)[0], pair);
        ck_assert_int_eq(count, 1);
        ck_assert_int_eq(McdModelPairContainerGetStayingCount(c) + McdModelPairContainerGetGoodbyeCount(c), 0);
        McdModelPairDestroy(pair);
        McdSpaceBeginChanges(y.space); /* which knows nothing of it */
        McdSpaceEndChanges(y.space);
        McdSpacePairIteratorBegin(y.space, &it);
        int staying = 0;
        for (int isMore = 1; isMore; staying += McdModelPairContainerGetStayingCount(c))
            isMore = McdSpaceGetPairs(y.space, &it, c);
        ck_assert_int_eq(staying, 3);
        McdModelPairContainerDestroy(c);
        yardDestroy(&y);
    }
}

TEST(bad_input) {
    static Yard y;
    McdModelPairContainer c;
    McdModelPair *array[2];
    McdSpacePairIterator it;
    yardMake(&y);
    yardStep(&y);
    ck_assert_ptr_null(McdModelPairContainerCreate(0));
    assert_warned("size");
    McdModelPairContainerInit(&c, array, 0);
    assert_warned("size");
    McdSpacePairIteratorBegin(y.space, &it);
    ck_assert_int_eq(McdSpaceGetPairs(y.space, &it, &c), 0);
    assert_warned("container");
    ck_assert_int_eq(McdSpaceGetPairs(y.space, &it, 0), 0);
    assert_warned("container");
    McdModelPairContainerInit(&c, array, 2);
    McdSpaceBeginChanges(y.space);
    McdSpaceEndChanges(y.space);
    assert_silent();
    ck_assert_int_eq(McdSpaceGetPairs(y.space, &it, &c), 0);
    assert_warned("another step");
    McdModelPairContainerRemovePair(&c, array);
    assert_warned("no place");
    McdModelPairContainerReset(0);
    assert_warned("no container");
    ck_assert_int_eq(McdModelPairContainerGetHelloCount(0), 0);
    assert_warned("no container");
    yardDestroy(&y);
}

TEST(culling_tables_are_symmetric) {
    McdCullingTable *t = McdCullingTableCreate(20);
    MeBool expected[20][20] = {{0}};
    unsigned seed = 1;
    for (int n = 0; n < 500; n++) {
        seed = seed * 1664525u + 1013904223u;
        const MeU32 a = seed >> 8 & 15, b = (seed >> 16 & 15) + 4;
        const MeBool flag = (MeBool)(seed >> 30 & 1);
        McdCullingTableSet(t, a, b, flag);
        expected[a][b] = expected[b][a] = flag;
    }
    for (MeU32 a = 0; a < 20; a++)
        for (MeU32 b = 0; b < 20; b++)
            ck_assert_int_eq(McdCullingTableGet(t, a, b), expected[a][b]);
    ck_assert(!McdCullingTableGet(t, 20, 0));
    assert_warned("indices");
    McdCullingTableSet(t, 0, 99, 1);
    assert_warned("indices");
    ck_assert_ptr_null(McdCullingTableCreate(0));
    assert_warned("size");
    McdCullingTableSet(0, 0, 0, 1);
    assert_warned("no table");
    McdCullingTableDestroy(t);
}
