/* Inside Kea: the graph that rows make of bodies. Its edges are numbered as they come up, each once.
 *
 * What is connected is found by union-find instead, without edges: parent[i] = i to begin with. */
#ifndef KEA_GRAPH_I_H
#define KEA_GRAPH_I_H

#include "MePrecision.h"
#include "common/kea_arena_i.h"

typedef struct KeaGraph {
    int numEdges;
    int (*edges)[2]; /* lower end first */
    int *table;      /* hash of edges, with open addressing: as many slots as */
    unsigned int slots;
} KeaGraph;

/* Room for as many edges as there are rows. */
void kea_graphLayOut(KeaGraph *g, size_t maxRows, KeaArena *arena);
/* No edges; there will be at most so many rows. */
void kea_graphBegin(KeaGraph *g, int maxRows);
/* The number of the edge between two nodes, which is appended if it is new. */
int kea_graphEdge(KeaGraph *g, int a, int b);

/* Union-find: what stands for all that i is connected with; the lowest of them. */
static inline int kea_rootOf(int parent[], int i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

/* Connects two. False: they were. */
static inline MeBool kea_unite(int parent[], int a, int b) {
    const int i = kea_rootOf(parent, a), j = kea_rootOf(parent, b);
    parent[i > j ? i : j] = i > j ? j : i;
    return i != j;
}

#endif
