/* The order in which the nodes of a graph are eliminated: minimum degree.
 *
 * Eliminating a node connects all its neighbours with one another; the fewer it has, the less fill-in arises. Chains
 * and trees are eliminated from their leaves, without fill-in. The neighbours that a node has when it is eliminated are
 * the structure of its column in the factor. The `turn' of a node is its index in the order of elimination.
 *
 * The remaining graph is stored as a quotient graph (George and Liu 1981, ch. 5): an eliminated node becomes an
 * element, which represents all edges between the nodes of its column. The neighbours of a node are the ends of its
 * remaining edges and the nodes of its elements; an element whose nodes are all in a later one is dropped. So the lists
 * of a node never exceed the memory of its original edges, and each turn writes only a column. Degrees are exact: the
 * nodes that an element has in addition to the new one are counted once for all nodes of the column (Amestoy, Davis and
 * Duff 1996); only if two or more elements add nodes are these visited one by one.
 */
#include "inner/kea_order_i.h"
#include "MeAssert.h"
#include <string.h>

typedef struct Degree {
    int nodes, unknowns;
} Degree;

typedef struct Node {
    int first, last;    /* its range of `slots`: edges from the front, elements from the back */
    int edges;          /* number of edges: slots[first .. first + edges), ascending */
    int elements;       /* number of elements: slots[last - elements .. last) */
    Degree degree;      /* numbers of its neighbours and of their unknowns */
    int weight;         /* its key in the queue */
    int next, previous; /* links of the list of nodes with this weight */
    int column;         /* the last turn whose column contains it */
    int lastVisit;      /* the last visit that has counted it */
} Node;

/* An eliminated node in the quotient graph. */
typedef struct Element {
    int start, end; /* its nodes: row[start .. end); empty: the element was dropped */
    Degree whole;   /* of all its nodes */
    Degree outside; /* of its nodes that are not in the column of turn `seen` */
    int seen;       /* the last turn that `outside` was computed for */
} Element;

typedef struct Elimination {
    KeaOrder *order;
    const int *size;
    int *slots;
    Node *node;
    Element *element; /* by node */
    int *first;       /* by weight: the first node of its list in the queue */
    int min;          /* lower bound of the weights in the queue */
    int *merged[2];   /* scratch, numNodes each */
    int visits;
} Elimination;

/* ---- the queue: last in, first out among nodes of equal weight ---- */

static void enqueue(Elimination *g, int i) {
    Node *node = g->node;
    const int w = node[i].weight;
    node[i].previous = -1;
    node[i].next = g->first[w];
    if (node[i].next >= 0)
        node[node[i].next].previous = i;
    g->first[w] = i;
    g->min = w < g->min ? w : g->min;
}

static void dequeue(Elimination *g, int i) {
    Node *node = g->node;
    if (node[i].next >= 0)
        node[node[i].next].previous = node[i].previous;
    if (node[i].previous >= 0)
        node[node[i].previous].next = node[i].next;
    else
        g->first[node[i].weight] = node[i].next;
}

/* The key of a node in the queue: the number of unknowns of its neighbours; 1 for a leaf, which causes no fill-in. */
static int weightOf(Degree d) {
    return d.nodes == 1 ? 1 : d.unknowns;
}

/* Removes and returns the first node of least weight. */
static int popMin(Elimination *g) {
    while (g->first[g->min] < 0)
        g->min++;
    const int v = g->first[g->min];
    dequeue(g, v);
    return v;
}

/* ---- the graph ---- */

/* Sets each node's range of `slots`, which is as large as its number of edges. */
static void divideSlots(Elimination *g, int numNodes, int numEdges, const int (*edges)[2]) {
    int at = 0;
    for (int e = 0; e < numEdges; e++) {
        MEASSERT(edges[e][0] >= 0 && edges[e][0] < numNodes && edges[e][1] >= 0 && edges[e][1] < numNodes);
        MEASSERT(edges[e][0] != edges[e][1]);
        for (int k = 0; k < 2; k++)
            g->node[edges[e][k]].degree.nodes++;
    }
    for (int i = 0; i < numNodes; i++) {
        g->node[i].first = at;
        g->node[i].last = at += g->node[i].degree.nodes;
    }
    MEASSERT(at == 2 * numEdges);
}

/* Lists the neighbours of each node in ascending order: first in any order in `unsorted`; then each node, in ascending
 * order, is appended to the lists of its neighbours. */
static void readEdges(Elimination *g, int *unsorted, int numNodes, int numEdges, const int (*edges)[2]) {
    for (int e = 0; e < numEdges; e++)
        for (int k = 0; k < 2; k++) {
            Node *n = &g->node[edges[e][k]];
            unsorted[n->first + n->elements++] = edges[e][!k];
        }
    for (int i = 0; i < numNodes; i++) {
        g->node[i].elements = 0;
        for (int k = g->node[i].first; k < g->node[i].last; k++) {
            Node *n = &g->node[unsorted[k]];
            g->slots[n->first + n->edges++] = i;
            n->degree.unknowns += g->size[i];
        }
    }
}

/* ---- one turn ---- */

/* Writes the union of two ascending lists, without v, to r. Returns its length. */
static int mergeSorted(int *r, const int *a, int numA, const int *b, int numB, int v) {
    int n = 0, s = 0, t = 0;
    while (s < numA && t < numB) {
        const int min = a[s] < b[t] ? a[s] : b[t];
        s += a[s] == min;
        t += b[t] == min;
        r[n] = min;
        n += min != v;
    }
    for (; s < numA; s++)
        if (a[s] != v)
            r[n++] = a[s];
    for (; t < numB; t++)
        if (b[t] != v)
            r[n++] = b[t];
    return n;
}

/* Writes the column of turn t, the neighbours of v, which becomes an element. The elements of v are dropped. */
static void writeColumn(Elimination *g, int t, int v) {
    KeaOrder *o = g->order;
    const Node *n = &g->node[v];
    const int *column = g->slots + n->first;
    int count = n->edges;
    for (int k = n->last - n->elements; k < n->last; k++) {
        Element *e = &g->element[g->slots[k]];
        int *merged = g->merged[column == g->merged[0]];
        count = mergeSorted(merged, column, count, o->row + e->start, e->end - e->start, v);
        column = merged;
        e->end = e->start;
    }
    MEASSERT(count == n->degree.nodes);
    memcpy(o->row + o->start[t], column, (size_t)count * sizeof *column);
    o->start[t + 1] = o->start[t] + count;
    g->element[v] = (Element){o->start[t], o->start[t + 1], n->degree, {0, 0}, -1};
}

/* Marks the nodes of the column, and computes `outside` of all other elements that contain one of them. */
static void compareElements(Elimination *g, int t, int v) {
    const KeaOrder *o = g->order;
    g->node[v].column = t;
    for (int c = o->start[t]; c < o->start[t + 1]; c++) {
        const int i = o->row[c];
        Node *n = &g->node[i];
        n->column = t;
        for (int k = n->last - n->elements; k < n->last; k++) {
            Element *e = &g->element[g->slots[k]];
            if (e->start == e->end)
                continue;
            if (e->seen != t)
                e->outside = e->whole;
            e->seen = t;
            e->outside.nodes--;
            e->outside.unknowns -= g->size[i];
        }
    }
}

/* Updates the lists of node i of the column: adds the new element v; removes edges to nodes of the column, which v
 * represents, and elements that lie within it. */
static void updateNode(Elimination *g, int i, int t, int v) {
    Node *n = &g->node[i];
    int edges = n->first, elements = n->last;
    for (int k = n->first; k < n->first + n->edges; k++)
        if (g->node[g->slots[k]].column != t)
            g->slots[edges++] = g->slots[k];
    for (int k = n->last - 1; k >= n->last - n->elements; k--) {
        const Element *e = &g->element[g->slots[k]];
        if (e->start < e->end && e->outside.nodes > 0)
            g->slots[--elements] = g->slots[k];
    }
    MEASSERT(elements > edges);
    g->slots[--elements] = v;
    n->edges = edges - n->first;
    n->elements = n->last - elements;
}

/* Counts a neighbour with this number of unknowns. */
static void addNeighbour(Degree *d, int unknowns) {
    d->nodes++;
    d->unknowns += unknowns;
}

/* Adds the nodes that two or more elements of n have in addition to the column, each once. */
static void addElements(Elimination *g, Degree *d, const Node *n, int t) {
    g->visits++;
    for (int k = n->last - n->elements + 1; k < n->last; k++) {
        const Element *e = &g->element[g->slots[k]];
        for (int r = e->start; r < e->end; r++) {
            Node *other = &g->node[g->order->row[r]];
            if (other->column != t && other->lastVisit != g->visits)
                addNeighbour(d, g->size[g->order->row[r]]);
            other->lastVisit = g->visits;
        }
    }
}

/* The degree of node i. The nodes that its edges lead to are in none of its elements, so that only elements have nodes
 * in common. Its first element is the new one, v. */
static Degree degreeOf(Elimination *g, int i, int t, int v) {
    const Node *n = &g->node[i];
    Degree d = {g->element[v].whole.nodes - 1, g->element[v].whole.unknowns - g->size[i]};
    for (int k = n->first; k < n->first + n->edges; k++)
        addNeighbour(&d, g->size[g->slots[k]]);
    if (n->elements == 2) {
        const Degree *outside = &g->element[g->slots[n->last - 1]].outside;
        d.nodes += outside->nodes;
        d.unknowns += outside->unknowns;
    } else if (n->elements > 2) {
        addElements(g, &d, n, t);
    }
    MEASSERT(d.nodes >= 0 && d.unknowns >= 0);
    return d;
}

/* Eliminates node v in turn t: writes its column, and updates its neighbours. */
static void eliminateNode(Elimination *g, int t, int v) {
    const KeaOrder *o = g->order;
    writeColumn(g, t, v);
    compareElements(g, t, v);
    for (int c = o->start[t]; c < o->start[t + 1]; c++) {
        const int i = o->row[c];
        dequeue(g, i);
        updateNode(g, i, t, v);
        g->node[i].degree = degreeOf(g, i, t, v);
        g->node[i].weight = weightOf(g->node[i].degree);
        enqueue(g, i);
    }
}

/* ---- all turns ---- */

static void layOutElimination(Elimination *g, size_t n, size_t edges, size_t weights, KeaArena *a) {
    KeaOrder *o = g->order;
    KEA_CARVE(a, o->node, n);
    KEA_CARVE(a, o->turn, n);
    KEA_CARVE(a, o->start, n + 1);
    KEA_CARVE(a, g->slots, 2 * edges);
    KEA_CARVE(a, g->node, n);
    KEA_CARVE(a, g->element, n);
    KEA_CARVE(a, g->first, weights);
    for (int k = 0; k < 2; k++)
        KEA_CARVE(a, g->merged[k], n);
}

/* Reserves memory for `more` rows behind the first `used`. False: no memory. */
static MeBool makeRoomForRows(KeaOrder *o, int used, int more) {
    const size_t kept = (size_t)used * sizeof *o->row, bytes = kept + (size_t)more * sizeof *o->row;
    if (!kea_blockReserve(&o->rows, kept, bytes, "the columns of a factor"))
        return MEFALSE;
    o->row = (int *)(void *)o->rows.memory;
    return METRUE;
}

/* Initializes all nodes, and an empty queue. */
static void initializeNodes(Elimination *g, int numNodes, int numWeights) {
    for (int i = 0; i < numNodes; i++)
        g->node[i] = (Node){.column = -1};
    for (int w = 0; w < numWeights; w++)
        g->first[w] = -1;
    g->min = numWeights - 1;
}

/* Eliminates all nodes. False: no memory for a column. */
static MeBool eliminateAll(Elimination *g) {
    KeaOrder *o = g->order;
    for (int i = o->numNodes - 1; i >= 0; i--) {
        g->node[i].weight = weightOf(g->node[i].degree);
        enqueue(g, i);
    }
    o->start[0] = 0;
    for (int t = 0; t < o->numNodes; t++) {
        const int v = popMin(g);
        if (!makeRoomForRows(o, o->start[t], g->node[v].degree.nodes))
            return MEFALSE;
        o->node[t] = v;
        o->turn[v] = t;
        eliminateNode(g, t, v);
    }
    return METRUE;
}

/* Whether every node has exactly one turn. */
static inline MeBool isPermutation(const KeaOrder *o) {
    for (int t = 0; t < o->numNodes; t++)
        if (o->node[t] < 0 || o->node[t] >= o->numNodes || o->turn[o->node[t]] != t)
            return MEFALSE;
    return METRUE;
}

MeBool kea_orderFind(KeaOrder *o, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    Elimination g = {.order = o, .size = size};
    KeaArena arena = {NULL, 0};
    int numWeights = 1;
    for (int i = 0; i < numNodes; i++)
        numWeights += size[i];
    layOutElimination(&g, (size_t)numNodes, (size_t)numEdges, (size_t)numWeights, &arena);
    if (!kea_blockReserve(&o->work, 0, arena.used, "the order of elimination") || !makeRoomForRows(o, 0, 2 * numEdges))
        return MEFALSE;
    arena = (KeaArena){o->work.memory, 0};
    layOutElimination(&g, (size_t)numNodes, (size_t)numEdges, (size_t)numWeights, &arena);
    o->numNodes = numNodes;
    initializeNodes(&g, numNodes, numWeights);
    divideSlots(&g, numNodes, numEdges, edges);
    readEdges(&g, o->row, numNodes, numEdges, edges);
    if (!eliminateAll(&g))
        return MEFALSE;
    MEASSERT(isPermutation(o));
    return METRUE;
}

void kea_orderFree(KeaOrder *o) {
    kea_blockFree(&o->work);
    kea_blockFree(&o->rows);
    *o = (KeaOrder){.numNodes = 0};
}
