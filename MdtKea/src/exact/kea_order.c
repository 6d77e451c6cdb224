/* The order in which the nodes of a graph are eliminated: minimum degree.
 *
 * Eliminating a node joins all its neighbours with one another; the fewer it has, the fewer blocks come into being.
 * Chains and trees are eliminated from their leaves, without any. The neighbours that a node has when its turn comes
 * are the structure of its column in the factor.
 */
#include "exact/kea_order_i.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include <stdlib.h>
#include <string.h>

typedef struct Node {
    int *neighbour; /* sorted */
    int degree, room;
    int weight;         /* unknowns of the neighbours; of a leaf 1 */
    int next, previous; /* among the nodes of one weight */
} Node;

typedef struct Queue {
    int *first; /* by weight */
    int least, most;
} Queue;

static void enqueue(Queue *q, Node node[], int i) {
    const int w = node[i].weight;
    node[i].previous = -1;
    node[i].next = q->first[w];
    if (node[i].next >= 0)
        node[node[i].next].previous = i;
    q->first[w] = i;
    q->least = w < q->least ? w : q->least;
}

static void dequeue(Queue *q, Node node[], int i) {
    if (node[i].next >= 0)
        node[node[i].next].previous = node[i].previous;
    if (node[i].previous >= 0)
        node[node[i].previous].next = node[i].next;
    else
        q->first[node[i].weight] = node[i].next;
}

static MeBool reserve(Node *n, int degree) {
    if (degree <= n->room)
        return METRUE;
    if (!MeMemoryGrow(&n->neighbour, (size_t)n->degree, (size_t)(2 * degree), sizeof *n->neighbour, "MdtKeaSolve",
                      "the neighbours in a graph"))
        return MEFALSE;
    n->room = 2 * degree;
    return METRUE;
}

static int compare(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static MeBool readGraph(Node node[], int numNodes, int numEdges, const int (*edges)[2]) {
    for (int e = 0; e < numEdges; e++) {
        MEASSERT(edges[e][0] >= 0 && edges[e][0] < numNodes && edges[e][1] >= 0 && edges[e][1] < numNodes);
        MEASSERT(edges[e][0] != edges[e][1]);
        for (int k = 0; k < 2; k++)
            node[edges[e][k]].room++;
    }
    for (int i = 0; i < numNodes; i++) {
        const int room = node[i].room;
        node[i].room = 0;
        if (!reserve(&node[i], room > 0 ? room : 1))
            return MEFALSE;
    }
    for (int e = 0; e < numEdges; e++)
        for (int k = 0; k < 2; k++)
            node[edges[e][k]].neighbour[node[edges[e][k]].degree++] = edges[e][!k];
    for (int i = 0; i < numNodes; i++)
        qsort(node[i].neighbour, (size_t)node[i].degree, sizeof(int), compare);
    return METRUE;
}

/* The neighbours of i become those of i and of the eliminated node v, without the two. */
static MeBool absorb(Node node[], int i, int v, int *scratch) {
    const Node *a = &node[i], *b = &node[v];
    int n = 0, s = 0, t = 0;
    while (s < a->degree || t < b->degree) {
        const int x = s < a->degree ? a->neighbour[s] : b->neighbour[t];
        const int y = t < b->degree ? b->neighbour[t] : x;
        const int least = x < y ? x : y;
        s += s < a->degree && x == least;
        t += t < b->degree && y == least;
        if (least != i && least != v)
            scratch[n++] = least;
    }
    if (!reserve(&node[i], n > 0 ? n : 1))
        return MEFALSE;
    memcpy(node[i].neighbour, scratch, (size_t)n * sizeof(int));
    node[i].degree = n;
    return METRUE;
}

/* A leaf joins nothing: it comes before all that do, however large its neighbour is. */
static int weigh(const Node *n, const int size[]) {
    int sum = 0;
    if (n->degree == 1)
        return 1;
    for (int k = 0; k < n->degree; k++)
        sum += size[n->neighbour[k]];
    return sum;
}

static MeBool eliminate(Node node[], Queue *q, int v, const int size[], int *scratch) {
    dequeue(q, node, v);
    for (int k = 0; k < node[v].degree; k++) {
        const int i = node[v].neighbour[k];
        dequeue(q, node, i);
        if (!absorb(node, i, v, scratch))
            return MEFALSE;
        node[i].weight = weigh(&node[i], size);
        enqueue(q, node, i);
    }
    return METRUE;
}

static MeBool orderNodes(KeaOrder *o, Node node[], Queue *q, const int size[], int *scratch) {
    for (int i = o->numNodes - 1; i >= 0; i--) {
        node[i].weight = weigh(&node[i], size);
        enqueue(q, node, i);
    }
    for (int k = 0; k < o->numNodes; k++) {
        while (q->first[q->least] < 0)
            q->least++;
        const int v = q->first[q->least];
        o->node[k] = v;
        if (!eliminate(node, q, v, size, scratch))
            return MEFALSE;
        o->structure[v] = node[v].neighbour;
        o->degree[v] = node[v].degree;
        node[v].neighbour = NULL;
    }
    return METRUE;
}

/* Every node has its turn once. */
static inline MeBool isPermutation(const KeaOrder *o) {
    double sum = 0, squares = 0, n = o->numNodes;
    for (int k = 0; k < o->numNodes; k++) {
        if (o->node[k] < 0 || o->node[k] >= o->numNodes || !o->structure[o->node[k]])
            return MEFALSE;
        sum += o->node[k];
        squares += (double)o->node[k] * o->node[k];
    }
    return sum == n * (n - 1) / 2 && (n > 1e4 || squares == (n - 1) * n * (2 * n - 1) / 6);
}

static int sumOf(int n, const int size[]) {
    int sum = 0;
    for (int i = 0; i < n; i++)
        sum += size[i];
    return sum;
}

static void *take(size_t count, size_t size) {
    return MeMemoryTakeZeroed(count, size, "MdtKeaSolve", "the order of elimination");
}

MeBool kea_orderCreate(KeaOrder *o, int numNodes, const int size[], int numEdges, const int (*edges)[2]) {
    const size_t n = (size_t)numNodes, weights = (size_t)sumOf(numNodes, size) + 1;
    MeBool isDone = MEFALSE;
    memset(o, 0, sizeof *o);
    o->numNodes = numNodes;
    o->node = take(n, sizeof *o->node);
    o->degree = take(n, sizeof *o->degree);
    o->structure = take(n, sizeof *o->structure);
    Node *node = take(n, sizeof *node);
    Queue q = {.first = take(weights, sizeof *q.first), .least = (int)weights - 1};
    int *scratch = take(n + 1, sizeof *scratch);
    if (o->node && o->degree && o->structure && node && q.first && scratch) {
        for (size_t w = 0; w < weights; w++)
            q.first[w] = -1;
        isDone = readGraph(node, numNodes, numEdges, edges) && orderNodes(o, node, &q, size, scratch);
    }
    for (int i = 0; node && i < numNodes; i++)
        MeMemoryGive(node[i].neighbour);
    MeMemoryGive(node);
    MeMemoryGive(q.first);
    MeMemoryGive(scratch);
    MEASSERT(!isDone || isPermutation(o));
    if (!isDone)
        kea_orderDestroy(o);
    return isDone;
}

void kea_orderDestroy(KeaOrder *o) {
    for (int i = 0; o->structure && i < o->numNodes; i++)
        MeMemoryGive(o->structure[i]);
    MeMemoryGive(o->structure);
    MeMemoryGive(o->node);
    MeMemoryGive(o->degree);
    memset(o, 0, sizeof *o);
}
