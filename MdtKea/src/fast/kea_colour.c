/* Manifolds that share no body get the same colour: eight of them are solved at once, and the order within a colour
 * does not matter, so that neither the width of registers nor the number of threads does. Greedy, in the manifolds'
 * order: the lowest colour that neither body has. The world is nobody's neighbour.
 *
 * A body with more neighbours than there are colours: the rest of its manifolds are alone in their groups, one after
 * the other, in the last colour. */
#include "fast/kea_fast_i.h"
#include "MeAssert.h"
#include <string.h>

static int lowestFree(MeU64 taken) {
    int colour = 0;
    while (colour < KEA_ALONE && (taken >> colour & 1))
        colour++;
    return colour;
}

static void chooseColours(const MdtKeaSystem *s, MeU64 taken[], MeU8 colour[], int count[KEA_COLOURS][KEA_POINTS + 1]) {
    memset(taken, 0, (size_t)s->numBodies * sizeof *taken);
    for (int i = 0; i < s->numManifolds; i++) {
        const MdtKeaManifold *m = &s->manifolds[i];
        MeU64 both = 0;
        for (int k = 0; k < 2; k++)
            both |= m->body[k] >= 0 ? taken[m->body[k]] : 0;
        colour[i] = (MeU8)lowestFree(both);
        for (int k = 0; k < 2; k++)
            if (m->body[k] >= 0 && colour[i] < KEA_ALONE)
                taken[m->body[k]] |= (MeU64)1 << colour[i];
        count[colour[i]][m->numPoints]++;
    }
}

/* By colour, and in it the most points first: faces share their lanes with faces. A counting sort. */
static void sortByColour(const MdtKeaSystem *s, const MeU8 colour[], int count[KEA_COLOURS][KEA_POINTS + 1],
                         int order[]) {
    int at = 0;
    for (int c = 0; c < KEA_COLOURS; c++)
        for (int n = KEA_POINTS; n >= 0; n--) {
            const int here = count[c][n];
            count[c][n] = at;
            at += here;
        }
    for (int i = 0; i < s->numManifolds; i++)
        order[count[colour[i]][s->manifolds[i].numPoints]++] = i;
}

int kea_colour(const MdtKeaSystem *s, MeU64 taken[], MeU8 colour[], int order[], int firstGroup[KEA_COLOURS + 1]) {
    int count[KEA_COLOURS][KEA_POINTS + 1] = {{0}}, inColour[KEA_COLOURS] = {0};
    chooseColours(s, taken, colour, count);
    for (int k = 0; k < KEA_COLOURS; k++)
        for (int n = 0; n <= KEA_POINTS; n++)
            inColour[k] += count[k][n];
    firstGroup[0] = 0;
    for (int k = 0; k < KEA_COLOURS; k++)
        firstGroup[k + 1] = firstGroup[k] + (k == KEA_ALONE ? inColour[k] : (inColour[k] + KEA_LANES - 1) / KEA_LANES);
    sortByColour(s, colour, count, order);
    return firstGroup[KEA_COLOURS];
}

int kea_groupManifolds(const MdtKeaSystem *s, const MeU8 colour[], const int order[], KeaGroup groups[]) {
    int group = -1, lane = KEA_LANES;
    for (int i = 0; i < s->numManifolds; i++) {
        const MeBool isNew =
            i == 0 || lane == KEA_LANES || colour[order[i]] != colour[order[i - 1]] || colour[order[i]] == KEA_ALONE;
        if (isNew) {
            memset(&groups[++group], 0, sizeof *groups);
            for (lane = 0; lane < KEA_LANES; lane++)
                groups[group].manifold[lane] = -1;
            lane = 0;
        }
        groups[group].manifold[lane++] = order[i];
    }
    return group + 1;
}
