/* Inside Kea: the order of elimination of a graph, and the fill-in that follows (symbolic factorization). */
#ifndef KEA_ORDER_I_H
#define KEA_ORDER_I_H

#include "MePrecision.h"
#include "common/kea_arena_i.h"

/* All zero to begin with; one graph after the other is ordered in the same memory. */
typedef struct KeaOrder {
    int numNodes;
    int *node;  /* by turn */
    int *turn;  /* by node */
    int *start; /* by turn, and one more: */
    int *row;   /* row[start[t] .. start[t + 1]), ascending: the neighbours that node[t] has left when its turn comes */
    KeaBlock work, rows;
} KeaOrder;

/* size: unknowns of a node. The result holds until the next call. False: no memory. */
MeBool kea_orderFind(KeaOrder *o, int numNodes, const int size[], int numEdges, const int (*edges)[2]);
void kea_orderFree(KeaOrder *o);

#endif
