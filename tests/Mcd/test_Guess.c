/* Guesses of the normal between round sides: how often they save the search; none that is wrong is verified. */
#include "karma_test.h"
#include "convex/mcd_vector_i.h"
#include "reference.h"

static double sizeOf(const McdShape *a, const McdShape *b) {
    return fmin(a->extent, b->extent);
}

/* b moved until the surfaces of both cores overlap by so much, or are apart by as much if it is negative; any way. */
static void placePair(McdShape *a, McdShape *b, double overlap, Random *r) {
    double n[3];
    McdProximity p;
    const double roundings[2] = {a->rounding, b->rounding};
    shape_rotateRandomly(a, r);
    shape_rotateRandomly(b, r);
    random_direction(r, n);
    a->rounding = b->rounding = 0;
    const double far = -reference_along(a, b, n) + .1 * sizeOf(a, b);
    shape_move(a, far * n[0], far * n[1], far * n[2]);
    ck_assert(mcd_coreProximity(a, b, INFINITY, &p));
    const double in = p.separation + overlap;
    shape_move(a, -in * p.normal[0], -in * p.normal[1], -in * p.normal[2]);
    a->rounding = roundings[0];
    b->rounding = roundings[1];
}

/* As the narrow phase does it. */
static MeBool isVerified(const McdShape *a, const McdShape *b, const McdProximity *guess) {
    const double back[3] = {-guess->normal[0], -guess->normal[1], -guess->normal[2]};
    McdFace faceA, faceB;
    McdManifold m;
    if (guess->separation <= 0 && !mcd_isMinDepth(a, b, guess) && !mcd_isMinDepthOfRound(a, b, guess))
        return MEFALSE;
    mcd_faceToward(a, back, &faceA);
    mcd_faceToward(b, guess->normal, &faceB);
    return mcd_facesManifold(a, b, &faceA, &faceB, guess, (McdReach){.margin = INFINITY}, &m) > 0;
}

typedef struct Tally {
    int pairs, right, verified;
} Tally;

/* Of depths, relative to the smaller shape: mcd_guessTolerance, the slack of clipping, and rims as polygons. */
static const double allowed = 1e-7 + 2e-7 + 2e-7;

/* Guessed: the separation that the search finds. Verified: it is known to be right without the search. */
static Tally tallyOf(int kindA, int kindB, double overlap, Random *r) {
    enum { PAIRS = 2000 };
    Tally t = {.pairs = PAIRS};
    for (int i = 0; i < PAIRS; i++) {
        McdShape a, b;
        McdProximity guess, found;
        shape_random(&a, kindA, 1, 0, r);
        shape_random(&b, kindB, 1, 0, r);
        const double size = sizeOf(&a, &b);
        placePair(&a, &b, overlap * size, r);
        mcd_guessFaces(&a, &b, &guess);
        mcd_guessSides(&a, &b, &guess);
        ck_assert(mcd_coreProximity(&a, &b, INFINITY, &found));
        const double off = (found.separation - guess.separation) / size;
        ck_assert_double_ge(off, -1e-8); /* no direction is better than the nearest points */
        t.right += off <= 1.1e-7;
        if (isVerified(&a, &b, &guess)) {
            ck_assert_msg(off <= allowed, "%s, %s: a separation of %g is verified, and %g found", shape_name[kindA],
                          shape_name[kindB], guess.separation, found.separation);
            t.verified++;
        }
    }
    printf("%s, %s, overlap %g: guessed %.1f %%, verified %.1f %%\n", shape_name[kindA], shape_name[kindB], overlap,
           100. * t.right / t.pairs, 100. * t.verified / t.pairs);
    return t;
}

TEST(round_sides_are_not_searched) {
    static const struct {
        int kind[2];
        double apart, deep, verified; /* shares, at least: guessed apart, guessed and verified overlapping */
    } pairs[] = {{{SHAPE_CYLINDER, SHAPE_CYLINDER}, .88, .89, .86},
                 {{SHAPE_SPHYL, SHAPE_CYLINDER}, .90, .98, .81},
                 {{SHAPE_BOX, SHAPE_CYLINDER}, .94, .97, .88}};
    Random r = {88172645463325252ull};
    for (int i = 0; i < 3; i++) {
        const Tally apart = tallyOf(pairs[i].kind[0], pairs[i].kind[1], -1e-3, &r);
        const Tally deep = tallyOf(pairs[i].kind[0], pairs[i].kind[1], 1e-4, &r);
        ck_assert_double_ge(apart.right, pairs[i].apart * apart.pairs);
        ck_assert_double_ge(deep.right, pairs[i].deep * deep.pairs);
        ck_assert_double_ge(deep.verified, pairs[i].verified * deep.pairs);
    }
}

/* Deep ones as well, where several directions may be as good. */
TEST(nothing_wrong_is_verified) {
    Random r = {6364136223846793005ull};
    for (double overlap = 1e-6; overlap < 1; overlap *= 4)
        for (int a = SHAPE_SPHYL; a <= SHAPE_CYLINDER; a++)
            tallyOf(a, SHAPE_CYLINDER, overlap, &r);
}
