/* Regions of a large partition, and loops over them (kea_regions_i.h). */
#include "fast/kea_regions_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

/* A body, with its coordinate along the axis that its node is divided across. */
typedef struct KeaBisected {
    double at; /* m */
    int body;
} KeaBisected;

void kea_regionsLayOut(KeaRegions *r, KeaArena *arena) {
    const size_t n = (size_t)r->s->numBodies, m = (size_t)r->s->numManifolds;
    KEA_CARVE(arena, r->body, n);
    KEA_CARVE(arena, r->place, n);
    KEA_CARVE(arena, r->manifold, m);
    KEA_CARVE(arena, r->sorted, m);
    KEA_CARVE(arena, r->leaf, n);
    KEA_CARVE(arena, r->home, m);
    KEA_CARVE(arena, r->colour, m);
    KEA_CARVE(arena, r->usedColours, n);
    KEA_CARVE(arena, r->bisected, n);
}

/* ---- loops ---- */

typedef struct Visit {
    KeaRegions *regions;
    KeaNodeWork work;
    void *context;
    int first; /* node */
} Visit;

static void MEAPI visitNode(void *context, int item, int worker) {
    const Visit *v = context;
    (void)worker;
    v->work(v->context, &v->regions->node[v->first + item]);
}

/* Visits region `item`, and one of the other nodes, so that each worker visits the same regions in all loops. */
static void MEAPI visitRegionAndNode(void *context, int item, int worker) {
    const Visit *v = context;
    visitNode(context, item, worker);
    if (item > 0)
        v->work(v->context, &v->regions->node[item]);
}

/* Visits the nodes of one depth, which are as many as the index of the first one. */
static void visitDepth(KeaRegions *r, int nodes, KeaNodeWork work, void *context) {
    Visit v = {r, work, context, nodes};
    MeTeamRun(r->team, nodes, visitNode, &v);
}

void kea_visitNodesByDepth(KeaRegions *r, KeaNodeWork work, void *context) {
    for (int nodes = r->count; nodes >= 1; nodes /= 2)
        visitDepth(r, nodes, work, context);
}

void kea_visitRegions(KeaRegions *r, KeaNodeWork work, void *context) {
    visitDepth(r, r->count, work, context);
}

void kea_visitNodes(KeaRegions *r, KeaNodeWork work, void *context) {
    Visit v = {r, work, context, r->count};
    MeTeamRun(r->team, r->count, visitRegionAndNode, &v);
}

/* ---- bodies ---- */

/* The number of regions: a power of two, with at least KEA_REGION_MANIFOLDS manifolds each on average. */
static int numRegionsOf(const MdtKeaSystem *s) {
    int count = 1;
    while (count < KEA_MAX_REGIONS && s->numManifolds >= 2 * count * KEA_REGION_MANIFOLDS)
        count *= 2;
    return count;
}

/* The range of places of a node's bodies, found from the root down: the first or the second half of each node. */
static void placesOfNode(int node, int numBodies, int *first, int *end) {
    int depth = 0;
    while (node >> (depth + 1) > 0)
        depth++;
    *first = 0;
    *end = numBodies;
    while (depth-- > 0) {
        const int middle = *first + (*end - *first) / 2;
        *(node >> depth & 1 ? first : end) = middle;
    }
}

/* The axis along which the bodies' positions have the largest extent. */
static int longestSide(const MdtKeaSystem *s, const int body[], int count) {
    double low[3], high[3];
    int longest = 0;
    for (int k = 0; k < 3; k++)
        low[k] = high[k] = s->pose[body[0]].pos[k];
    for (int i = 1; i < count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = keaMin(low[k], s->pose[body[i]].pos[k]);
            high[k] = keaMax(high[k], s->pose[body[i]].pos[k]);
        }
    for (int k = 1; k < 3; k++)
        if (high[k] - low[k] > high[longest] - low[longest])
            longest = k;
    return longest;
}

/* Whether body a precedes b along the axis; of bodies with equal coordinates, the one with the smaller index does. */
static MeBool isBefore(KeaBisected a, KeaBisected b) {
    return a.at < b.at || (a.at == b.at && a.body < b.body);
}

static void swap(KeaBisected *a, KeaBisected *b) {
    const KeaBisected c = *a;
    *a = *b;
    *b = c;
}

/* Median of three. */
static KeaBisected pivotOf(const KeaBisected b[], int first, int last) {
    const KeaBisected x = b[first], y = b[first + (last - first) / 2], z = b[last];
    if (isBefore(x, y))
        return isBefore(y, z) ? y : isBefore(x, z) ? z : x;
    return isBefore(x, z) ? x : isBefore(y, z) ? z : y;
}

/* Quickselect: reorders the bodies so that none of the first `middle` comes after any of the others (Hoare 1961,
 * "Algorithm 65: find"). */
static void selectLowest(KeaBisected b[], int count, int middle) {
    int first = 0, last = count - 1;
    while (first < last) {
        const KeaBisected pivot = pivotOf(b, first, last);
        int i = first, j = last;
        while (i <= j) {
            while (isBefore(b[i], pivot))
                i++;
            while (isBefore(pivot, b[j]))
                j--;
            if (i <= j)
                swap(&b[i++], &b[j--]);
        }
        if (middle <= j)
            last = j;
        else if (middle >= i)
            first = i;
        else
            return;
    }
}

/* Divides the bodies of a node into two halves across its longest side. */
static void halveNode(void *context, KeaNode *node) {
    KeaRegions *r = context;
    int first, end;
    placesOfNode((int)(node - r->node), r->s->numBodies, &first, &end);
    const int count = end - first;
    if (count < 2)
        return;
    KeaBisected *b = r->bisected + first;
    const int side = longestSide(r->s, r->body + first, count);
    for (int i = 0; i < count; i++)
        b[i] = (KeaBisected){r->s->pose[r->body[first + i]].pos[side], r->body[first + i]};
    selectLowest(b, count, count / 2);
    for (int i = 0; i < count; i++)
        r->body[first + i] = b[i].body;
}

/* Sets places and regions of the bodies of a region. */
static void setPlaces(void *context, KeaNode *node) {
    KeaRegions *r = context;
    int end;
    placesOfNode((int)(node - r->node), r->s->numBodies, &node->firstPlace, &end);
    node->numPlaces = end - node->firstPlace;
    for (int i = node->firstPlace; i < end; i++) {
        r->place[r->body[i]] = i;
        r->leaf[r->body[i]] = (MeU8)(node - r->node);
    }
}

static void divideBodies(KeaRegions *r) {
    memset(r->node, 0, 2 * (size_t)r->count * sizeof *r->node);
    for (int i = 0; i < r->s->numBodies; i++)
        r->body[i] = i;
    for (int nodes = 1; nodes < r->count; nodes *= 2)
        visitDepth(r, nodes, halveNode, r);
    kea_visitRegions(r, setPlaces, r);
}

/* ---- manifolds ---- */

/* The lowest common ancestor of two leaves. */
static int commonNode(int a, int b) {
    while (a != b) {
        a /= 2;
        b /= 2;
    }
    MEASSERT(a >= 1);
    return a;
}

/* Finds the node of each manifold. */
static void MEAPI assignManifolds(void *context, int first, int end, int worker) {
    KeaRegions *r = context;
    (void)worker;
    for (int i = first; i < end; i++) {
        const int *body = r->s->manifolds[i].body;
        const int leaf[2] = {body[0] >= 0 ? r->leaf[body[0]] : r->leaf[body[1]],
                             body[1] >= 0 ? r->leaf[body[1]] : r->leaf[body[0]]};
        r->home[i] = (MeU8)commonNode(leaf[0], leaf[1]);
    }
}

/* Sorts manifolds by node, keeping their order: a counting sort. */
static void sortByNode(KeaRegions *r) {
    const MdtKeaSystem *s = r->s;
    int at = 0;
    for (int i = 0; i < s->numManifolds; i++)
        r->node[r->home[i]].numManifolds++;
    for (int n = 1; n < 2 * r->count; n++) {
        r->node[n].firstManifold = at;
        at += r->node[n].numManifolds;
        r->node[n].numManifolds = 0;
    }
    MEASSERT(at == s->numManifolds);
    for (int i = 0; i < s->numManifolds; i++) {
        KeaNode *node = &r->node[r->home[i]];
        r->manifold[node->firstManifold + node->numManifolds++] = i;
    }
}

static MeBool isDescendant(int node, int above) {
    while (node > above)
        node /= 2;
    return node == above;
}

/* Checks that each body has one place, in the region given by `leaf`, and that the node of each manifold is an ancestor
 * of both its bodies' regions. */
static MeBool areRegionsValid(const KeaRegions *r) {
    const MdtKeaSystem *s = r->s;
    int places = 0, manifolds = 0;
    for (int n = r->count; n < 2 * r->count; n++) {
        const KeaNode *node = &r->node[n];
        for (int i = node->firstPlace; i < node->firstPlace + node->numPlaces; i++, places++)
            if (i != places || r->place[r->body[i]] != i || r->leaf[r->body[i]] != n)
                return MEFALSE;
    }
    for (int n = 1; n < 2 * r->count; n++)
        for (int i = 0; i < r->node[n].numManifolds; i++, manifolds++) {
            const int *body = s->manifolds[r->manifold[manifolds]].body;
            for (int k = 0; k < 2; k++)
                if (body[k] >= 0 && !isDescendant(r->leaf[body[k]], n))
                    return MEFALSE;
        }
    return places == s->numBodies && manifolds == s->numManifolds;
}

void kea_regionsDivide(KeaRegions *r) {
    r->count = numRegionsOf(r->s);
    divideBodies(r);
    MeTeamRunRanges(r->team, r->s->numManifolds, KEA_REGION_MANIFOLDS, assignManifolds, r);
    sortByNode(r);
    MEVALIDATE(areRegionsValid(r));
}
