/* The graph of bodies (kea_graph_i.h). */
#include "inner/kea_graph_i.h"
#include "MeAssert.h"
#include <string.h>

void kea_graphLayOut(KeaGraph *g, size_t maxRows, KeaArena *arena) {
    KEA_CARVE(arena, g->edges, maxRows);
    KEA_CARVE(arena, g->table, 4 * maxRows + 4);
}

void kea_graphBegin(KeaGraph *g, int maxRows) {
    g->numEdges = 0;
    for (g->slots = 1; g->slots <= 2 * (unsigned int)maxRows;)
        g->slots *= 2;
    memset(g->table, 0xff, g->slots * sizeof *g->table);
}

int kea_graphEdge(KeaGraph *g, int a, int b) {
    const int low = a < b ? a : b, high = a < b ? b : a;
    MEASSERT(low >= 0 && low < high);
    const unsigned int mask = g->slots - 1;
    unsigned int at = ((unsigned int)low * 2654435761u) ^ ((unsigned int)high * 40503u);
    for (at = (at ^ (at >> 15)) & mask; g->table[at] >= 0; at = (at + 1) & mask) {
        const int e = g->table[at];
        if (g->edges[e][0] == low && g->edges[e][1] == high)
            return e;
    }
    MEASSERT(2 * (unsigned int)g->numEdges < g->slots);
    g->table[at] = g->numEdges;
    g->edges[g->numEdges][0] = low;
    g->edges[g->numEdges][1] = high;
    return g->numEdges++;
}
