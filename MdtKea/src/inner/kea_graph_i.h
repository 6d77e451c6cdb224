/* Inside Kea: the graph of bodies, with one edge for each pair of bodies that rows join. Edges are numbered in the
 * order in which they first occur.
 *
 * Connected components are found by union-find, without edges; the caller initializes parent[i] = i. */
#ifndef KEA_GRAPH_I_H
#define KEA_GRAPH_I_H

#include "MePrecision.h"
#include "common/kea_arena_i.h"

typedef struct KeaGraph {
    int numEdges;
    int (*edges)[2];    /* the lower node first */
    int *table;         /* hash table of edges, with open addressing */
    unsigned int slots; /* its size, a power of two */
} KeaGraph;

/* Carves memory for as many edges as rows. */
void kea_graphLayOut(KeaGraph *g, size_t maxRows, KeaArena *arena);
/* Removes all edges; at most maxRows rows will follow. */
void kea_graphBegin(KeaGraph *g, int maxRows);
/* The index of the edge between two nodes, which is appended if it is new. */
int kea_graphEdge(KeaGraph *g, int a, int b);

/* Union-find: the root of the set of i, which is its lowest member. Compresses the path. */
static inline int kea_rootOf(int parent[], int i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Unites the sets of a and b. False: they were one set already. */
static inline MeBool kea_unite(int parent[], int a, int b) {
    const int i = kea_rootOf(parent, a), j = kea_rootOf(parent, b);
    parent[i > j ? i : j] = i > j ? j : i;
    return i != j;
}

#endif
