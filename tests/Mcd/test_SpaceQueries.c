/* Line segments through a space, against every model one by one. */
#include "crates.h"
#include "random_numbers.h"

enum { COUNT = 300 };
static Yard yard, *const y = &yard;
static void makeYard(void) {
    yardMake(y);
    for (int i = 0; i < COUNT; i++)
        yardPut(y, (.2 + uniform(0, i % 20 ? 1.5 : 6)), uniform(0, 15), uniform(0, 15), uniform(0, 15));
    yardPut(y, 1e12, 7, 7, (MeReal)-5e11 - 40); /* a floor without bounds, far below */
    McdSpaceEndChanges(y->space);
}

static int MEAPI everyThird(McdModelID m, void *data) {
    ck_assert_ptr_eq(data, y);
    for (int i = 0; i < y->count; i += 3)
        if (y->model[i] == m)
            return 1;
    return 0;
}

/* By distance, then creation; returns how many. */
static int oneByOne(MeReal *from, MeReal *to, int isFiltered, McdLineSegIntersectResult *list) {
    int n = 0;
    for (int i = 0; i < y->count; i++) {
        McdLineSegIntersectResult hit;
        if ((isFiltered && i % 3) || !McdLineSegIntersect(y->model[i], from, to, &hit))
            continue;
        int at = n++;
        for (; at > 0 && list[at - 1].distance > hit.distance; at--)
            list[at] = list[at - 1];
        list[at] = hit;
    }
    return n;
}

TEST(as_every_model_one_by_one) {
    static McdLineSegIntersectResult expected[COUNT + 1], got[COUNT + 1], first;
    int all = 0;
    makeYard();
    for (int n = 0; n < 2000; n++) {
        MeVector3 from, to;
        for (int k = 0; k < 3; k++) {
            from[k] = (MeReal)(uniform(0, 30) - 7);
            to[k] = n % 5 == k ? from[k] : (MeReal)(uniform(0, 30) - 7);
        }
        if (n % 50 == 0)
            to[2] = -1000;
        const int count = oneByOne(from, to, 0, expected);
        all += count;
        for (int max = 1; max <= COUNT + 1; max += COUNT / 3) {
            const int found = McdSpaceGetLineSegIntersections(y->space, from, to, got, max);
            ck_assert_int_eq(found, count < max ? count : max);
            for (int i = 0; i < found; i++) {
                ck_assert_ptr_eq(got[i].model, expected[i].model);
                ck_assert(got[i].distance == expected[i].distance);
            }
        }
        ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, from, to, &first), count > 0);
        ck_assert(!count || first.model == expected[0].model);
        const int filtered = oneByOne(from, to, 1, expected);
        ck_assert_int_eq(McdSpaceGetLineSegFirstEnabledIntersection(y->space, from, to, everyThird, y, &first),
                         filtered > 0);
        ck_assert(!filtered || first.model == expected[0].model);
    }
    ck_assert_int_gt(all, 2000);
    yardDestroy(y);
}

TEST(starts_inside_a_model) {
    MeVector3 from = {0, 0, 0}, to = {5, 0, 0};
    McdLineSegIntersectResult hit[2];
    yardMake(y);
    const McdModelID a = yardPut(y, 1, 0, 0, 0), b = yardPut(y, 1, 3, 0, 0);
    McdSpaceEndChanges(y->space);
    ck_assert_int_eq(McdSpaceGetLineSegIntersections(y->space, from, to, hit, 2), 2);
    ck_assert_ptr_eq(hit[0].model, a);
    ck_assert(hit[0].distance == 0);
    assert_vec3_near(hit[0].position, 0, 0, 0, 0);
    ck_assert_ptr_eq(hit[1].model, b);
    assert_near(hit[1].distance, 2.5, TOL(1e-6, 3e-15));
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, to, to, hit), 0); /* of no length */
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, from, from, hit), 1);
    yardDestroy(y);
}

TEST(bad_input) {
    MeVector3 from = {0, 0, 0}, to = {5, 0, 0}, wrong = {0, NAN, 0};
    McdLineSegIntersectResult hit;
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    McdSpaceEndChanges(y->space);
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, from, wrong, &hit), 0);
    assert_warned("finite");
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, 0, to, &hit), 0);
    assert_warned("null");
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, from, to, 0), 0);
    assert_warned("result");
    ck_assert_int_eq(McdSpaceGetLineSegIntersections(y->space, from, to, &hit, 0), 0);
    assert_warned("result");
    ck_assert_int_eq(McdSpaceGetLineSegIntersections(0, from, to, &hit, 1), 0);
    assert_warned("no space");
    ck_assert_int_eq(McdSpaceGetLineSegFirstIntersection(y->space, from, to, &hit), 1);
    yardDestroy(y);
}

/* ---- ready filters ---- */

/* The rule of pairs, for models of several categories, masks and groups. */
static int isExpected(const McdQueryFilter *q, int category, int mask, int group) {
    if (q->group != 0 && q->group == group)
        return group > 0;
    return (q->category & (MeU32)mask) && (q->mask & (MeU32)category);
}

TEST(queries_have_categories_masks_and_groups_as_pairs_have) {
    static const int filters[][3] = {{1, -1, 0}, {2, -1, 0}, {4, 1, 0}, {1, 2, 5}, {1, 1, -5}, {8, 15, 5}};
    static const McdQueryFilter queries[] = {{1, 0xffffffffu, 0}, {1, 2, 0}, {2, 13, 0}, {1, 1, 5},
                                             {1, 15, -5},         {0, 0, 0}, {0, 0, 5}};
    enum { MODELS = sizeof filters / sizeof *filters };
    const MeVector3 from = {-10, 0, 0}, by = {100, 0, 0}, low = {-100, -1, -1}, high = {100, 1, 1};
    McdModelID list[MODELS];
    yardMake(y);
    for (int i = 0; i < MODELS; i++) {
        yardPut(y, 1, (MeReal)(3 * i), 0, 0);
        McdModelSetFilter(y->model[i], (MeU32)filters[i][0], (MeU32)filters[i][1]);
        McdModelSetFilterGroup(y->model[i], filters[i][2]);
    }
    McdSpaceEndChanges(y->space);
    for (int k = 0; k < (int)(sizeof queries / sizeof *queries); k++) {
        McdQueryFilter q = queries[k];
        McdCastResult hit;
        int expected = 0, first = -1;
        for (int i = MODELS; i--;)
            if (isExpected(&q, filters[i][0], filters[i][1], filters[i][2]))
                expected++, first = i;
        ck_assert_int_eq(McdSpaceOverlapBox(y->space, low, high, McdQueryByFilter, &q, list, MODELS), expected);
        ck_assert_int_eq(McdSpaceCastRay(y->space, from, by, McdQueryByFilter, &q, &hit), expected > 0);
        ck_assert(!expected || (hit.model == y->model[first] && list[0] == hit.model));
    }
    yardDestroy(y);
}

/* What may collide with a model: the same as McdSpacePairIsEnabled, disabled pairs and the culling table included. */
TEST(queries_may_find_what_a_model_would_collide_with) {
    const MeVector3 low = {-100, -1, -1}, high = {100, 1, 1};
    McdModelID list[6];
    McdCullingTable *table = McdCullingTableCreate(2);
    yardMake(y);
    for (int i = 0; i < 6; i++)
        yardPut(y, 1, (MeReal)(3 * i), 0, 0);
    McdModelSetFilter(y->model[1], 2, 2);
    McdSpaceDisablePair(y->model[0], y->model[2]);
    McdCullingTableSet(table, 0, 1, 1);
    McdSpaceSetModelCullingParameters(y->space, y->model[0], table, 0, 7);
    McdSpaceSetModelCullingParameters(y->space, y->model[3], table, 1, 7);
    McdSpaceSetModelCullingParameters(y->space, y->model[4], table, 1, 8);
    McdSpaceEndChanges(y->space);
    ck_assert_int_eq(McdSpaceOverlapBox(y->space, low, high, McdQueryByPairs, y->model[0], list, 6), 2);
    ck_assert(list[0] == y->model[4] && list[1] == y->model[5]);
    McdSpaceBeginChanges(y->space);
    yardDestroy(y);
    McdCullingTableDestroy(table);
}

TEST(ready_filters_need_their_data) {
    McdQueryFilter q = {1, 1, 0};
    yardMake(y);
    yardPut(y, 1, 0, 0, 0);
    assert_none(McdQueryByFilter, y->model[0], NULL);
    assert_none(McdQueryByFilter, NULL, &q);
    assert_none(McdQueryByPairs, y->model[0], NULL);
    yardDestroy(y);
}
