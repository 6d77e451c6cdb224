/* Graph colouring of the manifolds of a node: manifolds of one colour share no body. Eight of them are solved at once,
 * and their order does not matter, so that results do not depend on the width of registers. The colouring is greedy, in
 * the manifolds' order: each gets the lowest colour that neither of its bodies has yet. The world is not considered.
 *
 * If a body has more manifolds than there are colours, the remaining ones get the last colour, in which each manifold
 * has a group of its own, and groups are solved one after the other. */
#include "fast/kea_regions_i.h"
#include "MeAssert.h"
#include <string.h>

enum { COLOURS = 64, ALONE = COLOURS - 1 };

static int lowestFreeColour(MeU64 usedColours) {
    int colour = 0;
    while (colour < ALONE && (usedColours >> colour & 1))
        colour++;
    return colour;
}

/* The colours that body k of a manifold has already (KeaRegions.usedColours); null: the world. */
static MeU64 *usedColoursOf(const KeaRegions *r, const MdtKeaManifold *m, int k) {
    return m->body[k] >= 0 ? &r->usedColours[r->place[m->body[k]]] : NULL;
}

/* Clears the used colours of all bodies of a node's manifolds. */
static void clearColours(const KeaRegions *r, const KeaNode *node) {
    for (int i = 0; i < node->numManifolds; i++)
        for (int k = 0; k < 2; k++) {
            MeU64 *usedColours = usedColoursOf(r, &r->s->manifolds[r->manifold[node->firstManifold + i]], k);
            if (usedColours)
                *usedColours = 0;
        }
}

/* Chooses the colours of a node's manifolds, and counts these by colour and number of points. */
static void chooseColours(const KeaRegions *r, const KeaNode *node, int count[COLOURS][KEA_POINTS + 1]) {
    for (int i = 0; i < node->numManifolds; i++) {
        const int index = r->manifold[node->firstManifold + i];
        const MdtKeaManifold *m = &r->s->manifolds[index];
        MeU64 *usedColours[2], both = 0;
        for (int k = 0; k < 2; k++) {
            usedColours[k] = usedColoursOf(r, m, k);
            both |= usedColours[k] ? *usedColours[k] : 0;
        }
        const int colour = lowestFreeColour(both);
        MEASSERT(colour < COLOURS && m->numPoints >= 0 && m->numPoints <= KEA_POINTS);
        for (int k = 0; k < 2; k++)
            if (usedColours[k] && colour < ALONE)
                *usedColours[k] |= (MeU64)1 << colour;
        r->colour[index] = (MeU8)colour;
        count[colour][m->numPoints]++;
    }
}

/* Sorts the manifolds of a node by colour, then by descending number of points, so that groups have equal numbers: a
 * counting sort. */
static void sortByColour(const KeaRegions *r, const KeaNode *node, int count[COLOURS][KEA_POINTS + 1]) {
    int at = node->firstManifold;
    for (int colour = 0; colour < COLOURS; colour++)
        for (int n = KEA_POINTS; n >= 0; n--) {
            const int here = count[colour][n];
            count[colour][n] = at;
            at += here;
        }
    MEASSERT(at == node->firstManifold + node->numManifolds);
    for (int i = node->firstManifold; i < node->firstManifold + node->numManifolds; i++) {
        const int index = r->manifold[i];
        r->sorted[count[r->colour[index]][r->s->manifolds[index].numPoints]++] = index;
    }
}

/* The number of groups of eight: a group has one colour; in the last colour, one manifold. */
static int countGroups(int count[COLOURS][KEA_POINTS + 1]) {
    int groups = 0;
    for (int colour = 0; colour < COLOURS; colour++) {
        int here = 0;
        for (int n = 0; n <= KEA_POINTS; n++)
            here += count[colour][n];
        groups += colour == ALONE ? here : (here + KEA_LANES - 1) / KEA_LANES;
    }
    return groups;
}

static void colourNode(void *context, KeaNode *node) {
    const KeaRegions *r = context;
    int count[COLOURS][KEA_POINTS + 1] = {{0}};
    clearColours(r, node);
    chooseColours(r, node, count);
    node->numGroups = countGroups(count);
    sortByColour(r, node, count);
}

int kea_colourManifolds(KeaRegions *r) {
    int groups = 0;
    kea_visitNodesByDepth(r, colourNode, r);
    for (int n = 1; n < 2 * r->count; n++) {
        r->node[n].firstGroup = groups;
        groups += r->node[n].numGroups;
    }
    return groups;
}

static void clearGroup(KeaGroup *g) {
    memset(g, 0, sizeof *g);
    for (int lane = 0; lane < KEA_LANES; lane++)
        g->manifold[lane] = -1;
}

static MeBool shareBody(const MdtKeaManifold *a, const MdtKeaManifold *b) {
    return (a->body[0] >= 0 && (a->body[0] == b->body[0] || a->body[0] == b->body[1])) ||
           (a->body[1] >= 0 && (a->body[1] == b->body[0] || a->body[1] == b->body[1]));
}

/* Lanes of a group are solved at once: no two have a body in common. */
static MeBool areLanesIndependent(const MdtKeaSystem *s, const KeaGroup *g) {
    for (int a = 0; a < KEA_LANES; a++)
        for (int b = 0; b < a && g->manifold[a] >= 0; b++)
            if (shareBody(&s->manifolds[g->manifold[a]], &s->manifolds[g->manifold[b]]))
                return MEFALSE;
    return METRUE;
}

static MeBool areGroupsIndependent(const MdtKeaSystem *s, const KeaGroup groups[], int count) {
    for (int i = 0; i < count; i++)
        if (!areLanesIndependent(s, &groups[i]))
            return MEFALSE;
    return METRUE;
}

void kea_groupManifolds(const KeaRegions *r, const KeaNode *node, KeaGroup groups[]) {
    const int *sorted = r->sorted + node->firstManifold;
    int group = node->firstGroup - 1, lane = KEA_LANES;
    for (int i = 0; i < node->numManifolds; i++) {
        const int colour = r->colour[sorted[i]];
        if (lane == KEA_LANES || colour == ALONE || colour != r->colour[sorted[i - 1]]) {
            clearGroup(&groups[++group]);
            lane = 0;
        }
        if (lane == 0) /* the first manifold of a group has the most points */
            groups[group].points = r->s->manifolds[sorted[i]].numPoints;
        MEASSERT(lane < KEA_LANES);
        groups[group].manifold[lane++] = sorted[i];
    }
    MEASSERT(group == node->firstGroup + node->numGroups - 1);
    MEVALIDATE(areGroupsIndependent(r->s, groups + node->firstGroup, node->numGroups));
}
