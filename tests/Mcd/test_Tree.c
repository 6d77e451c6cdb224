/* The tree of boxes, against every box one by one: what only touches overlaps, and what a float's last place is away
 * from it does not. */
#include "karma_test.h"
#include "space/mcd_space_i.h"
#include "space/mcd_tree_i.h"
#include <float.h>

enum { MANY = 3000, SIDE = 10 };

typedef struct Seen {
    int count, last, first, max; /* most: it returns false then */
    int times[MANY];
} Seen;

static MeBool see(void *context, int item) {
    Seen *seen = context;
    seen->first = seen->count ? seen->first : item;
    seen->last = item;
    seen->times[item]++;
    return ++seen->count < seen->max;
}

static Seen query(const McdTree *tree, const McdTreeBox *box) {
    Seen seen = {.max = MANY + 1};
    mcd_treeQuery(tree, box, see, &seen);
    return seen;
}

/* A unit box with its least corner there. */
static McdTreeBox boxAt(double x, double y, double z) {
    return (McdTreeBox){{(float)x, (float)y, (float)z}, {(float)(x + 1), (float)(y + 1), (float)(z + 1)}};
}

/* The box beside another one across its side: 0 to 2 beyond its greatest corner, 3 to 5 before its least. */
static McdTreeBox beside(const McdTreeBox *box, int side) {
    McdTreeBox other = *box;
    const int i = side % 3;
    other.min[i] = side < 3 ? box->max[i] : box->min[i] - 1;
    other.max[i] = side < 3 ? box->max[i] + 1 : box->min[i];
    return other;
}

/* The same, away from it by the least that a float tells. */
static McdTreeBox nextTo(const McdTreeBox *box, int side) {
    McdTreeBox other = beside(box, side);
    const int i = side % 3;
    if (side < 3)
        other.min[i] = nextafterf(box->max[i], FLT_MAX);
    else
        other.max[i] = nextafterf(box->min[i], -FLT_MAX);
    return other;
}

/* A grid of unit boxes, three apart. */
static McdTreeBox boxOfGrid(int i) {
    return boxAt(3 * (i % SIDE), 3 * (i / SIDE % SIDE), 3 * (i / SIDE / SIDE));
}

static McdTree *makeGrid(int count, McdTreeLeaf **leaf) {
    McdTree *tree = mcd_treeCreate();
    for (int i = 0; i < count; i++) {
        const McdTreeBox box = boxOfGrid(i);
        leaf[i] = mcd_treeInsert(tree, &box, i);
        ck_assert_ptr_nonnull(leaf[i]);
    }
    return tree;
}

static McdTreeLeaf *leaves[MANY];

/* The nodes above the leaves end where these do, so that they are only touched too. */
TEST(boxes_that_touch_overlap_and_those_beside_them_do_not) {
    for (int count = 1; count <= SIDE * SIDE * SIDE; count *= SIDE) {
        McdTree *tree = makeGrid(count, leaves);
        for (int i = 0; i < count; i++)
            for (int side = 0; side < 6; side++) {
                const McdTreeBox box = boxOfGrid(i), touching = beside(&box, side), apart = nextTo(&box, side);
                const Seen seen = query(tree, &touching);
                ck_assert_int_eq(seen.count, 1);
                ck_assert_int_eq(seen.last, i);
                ck_assert_int_eq(query(tree, &apart).count, 0);
            }
        mcd_treeDestroy(tree);
    }
}

TEST(boxes_are_found_wherever_they_went) {
    McdTree *tree = makeGrid(MANY, leaves);
    const McdTreeBox everywhere = {{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}};
    for (int i = 0; i < MANY; i += 3)
        mcd_treeRemove(tree, leaves[i]);
    for (int i = 1; i < MANY; i += 3) {
        const McdTreeBox there = boxAt(-3 * i, 1000, 0);
        mcd_treeMove(tree, leaves[i], &there);
    }
    for (int isBalanced = 0; isBalanced < 2; isBalanced++) {
        const Seen all = query(tree, &everywhere);
        for (int i = 0; i < MANY; i++)
            ck_assert_int_eq(all.times[i], i % 3 != 0);
        for (int i = 0; i < MANY; i += 10) {
            const McdTreeBox before = boxOfGrid(i), after = boxAt(-3 * i, 1000, 0);
            ck_assert_int_eq(query(tree, &before).count, i % 3 == 2);
            ck_assert_int_eq(query(tree, &after).count, i % 3 == 1);
        }
        mcd_treeRebuild(tree);
    }
    mcd_treeDestroy(tree);
}

TEST(a_query_ends_where_its_visitor_has_enough) {
    McdTree *tree = makeGrid(100, leaves);
    const McdTreeBox everywhere = {{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}};
    for (int max = 1; max <= 100; max += 33) {
        Seen seen = {.max = max};
        mcd_treeQuery(tree, &everywhere, see, &seen);
        ck_assert_int_eq(seen.count, max);
    }
    mcd_treeDestroy(tree);
}

/* ---- casts ---- */

static double seeAll(void *context, int item, double fraction) {
    see(context, item);
    return fraction;
}

/* The first is enough. */
static double seeFirst(void *context, int item, double fraction) {
    see(context, item);
    return -fraction;
}

static const double point[3] = {0, 0, 0};

static MeBool meets(const double from[3], const double by[3], const double half[3], double fraction) {
    const McdTreeBox box = boxAt(0, 0, 0);
    return mcd_treeCastBox(&box, from, by, half, fraction);
}

/* From 3 m before each face of a unit box to the face, by a way that ends in it: at a fraction of one exactly. */
TEST(a_cast_that_ends_on_a_face_meets_the_box) {
    const double half[3] = {.5, .25, .125};
    for (int side = 0; side < 6; side++)
        for (int isPoint = 0; isPoint < 2; isPoint++) {
            const int i = side % 3, isBelow = side >= 3;
            const double *size = isPoint ? point : half;
            double from[3] = {.5, .5, .5}, by[3] = {0, 0, 0};
            from[i] = isBelow ? -3 - size[i] : 4 + size[i];
            by[i] = isBelow ? 3 : -3;
            ck_assert(meets(from, by, size, 1));
            ck_assert(!meets(from, by, size, 1 - 1e-15));
            by[i] *= 2;
            ck_assert(meets(from, by, size, .5));
            ck_assert(!meets(from, by, size, .5 - 1e-15));
            by[i] *= -1;
            ck_assert(!meets(from, by, size, 1));
        }
}

/* Along a face, and beyond it by the last place of a double; also where it does not move at all. */
TEST(a_cast_along_a_face_meets_the_box) {
    const double half[3] = {.5, .25, .125};
    for (int side = 0; side < 6; side++)
        for (int way = 0; way < 3; way++) {
            const int i = side % 3, isBelow = side >= 3;
            double from[3] = {.5, .5, .5}, by[3] = {0, 0, 0};
            from[i] = isBelow ? -half[i] : 1 + half[i];
            from[(i + way) % 3] -= way ? 4 : 0;
            by[(i + way) % 3] = way ? 8 : 0;
            ck_assert(meets(from, by, half, 1));
            from[i] = nextafter(from[i], isBelow ? -9 : 9);
            ck_assert(!meets(from, by, half, 1));
        }
}

TEST(a_cast_that_passes_a_corner_misses_it) {
    const double by[3] = {4, -4, 0};
    const double inside[3] = {.5, .5, .5}, through[3] = {-1, 2, .5}, past[3] = {-1, 3.001, .5};
    const double at[3] = {-1, 3, .5}; /* the edge is at (1, 1), half of the way */
    ck_assert(meets(inside, by, point, 0));
    ck_assert(!meets(through, by, point, 0));
    ck_assert(meets(through, by, point, 1));
    ck_assert(meets(at, by, point, 1));
    ck_assert(meets(at, by, point, .5));
    ck_assert(!meets(at, by, point, .499));
    ck_assert(!meets(past, by, point, 1));
}

/* A row of boxes: forwards the first is met first, backwards the last; the one that is met ends it. */
TEST(casts_meet_what_is_near_before_what_is_far) {
    for (int axis = 0; axis < 3; axis++) {
        McdTree *tree = mcd_treeCreate();
        for (int i = 0; i < 64; i++) {
            const McdTreeBox box = boxAt(axis == 0 ? 3 * i : 0, axis == 1 ? 3 * i : 0, axis == 2 ? 3 * i : 0);
            mcd_treeInsert(tree, &box, i);
        }
        mcd_treeRebuild(tree);
        for (int isBack = 0; isBack < 2; isBack++) {
            double from[3] = {.5, .5, .5}, by[3] = {0, 0, 0};
            from[axis] = isBack ? 200 : -10;
            by[axis] = isBack ? -300 : 300;
            Seen all = {.max = MANY}, first = {.max = MANY};
            mcd_treeCast(tree, from, by, point, 1, seeAll, &all);
            ck_assert_int_eq(all.count, 64);
            ck_assert_int_eq(all.first, isBack ? 63 : 0);
            ck_assert_int_eq(all.last, isBack ? 0 : 63);
            mcd_treeCast(tree, from, by, point, 1, seeFirst, &first);
            ck_assert_int_eq(first.count, 1);
            ck_assert_int_eq(first.last, isBack ? 63 : 0);
        }
        mcd_treeDestroy(tree);
    }
}

/* ---- boxes ---- */

/* Rounded outward, by no more than a place; cut off where products could overflow. */
TEST(a_box_is_rounded_outward) {
    unsigned long long state = 9;
    for (int n = 0; n < 10000; n++) {
        double min[3], max[3];
        McdTreeBox box;
        for (int k = 0; k < 3; k++) {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            min[k] = ldexp((double)(state >> 11) / 9007199254740992.0 - .5, n % 40 - 20);
            max[k] = min[k] + ldexp(1, n % 30 - 25);
        }
        mcd_treeBox(min, max, &box);
        for (int k = 0; k < 3; k++) {
            ck_assert((double)box.min[k] <= min[k] && max[k] <= (double)box.max[k]);
            ck_assert_double_ge(box.min[k], min[k] - 2 * (double)FLT_EPSILON * fabs(min[k]));
            ck_assert_double_le(box.max[k], max[k] + 2 * (double)FLT_EPSILON * fabs(max[k]));
        }
    }
    const double low[3] = {-INFINITY, -1e300, -2e15}, high[3] = {INFINITY, 1e300, 2e15};
    McdTreeBox box;
    mcd_treeBox(low, high, &box);
    for (int k = 0; k < 3; k++) {
        assert_near_rel(box.min[k], -MCD_TREE_REACH, 2 * (double)FLT_EPSILON);
        assert_near_rel(box.max[k], MCD_TREE_REACH, 2 * (double)FLT_EPSILON);
    }
}
