/* Inside Kea: the order of elimination of a graph, and the resulting fill-in (symbolic factorization). */
#ifndef KEA_ORDER_I_H
#define KEA_ORDER_I_H

#include "MePrecision.h"
#include "common/kea_arena_i.h"

/* An ordering; initially all zero. Graphs are ordered one after the other in the same memory. */
typedef struct KeaOrder {
    int numNodes;
    int *node;  /* by turn */
    int *turn;  /* by node */
    int *start; /* by turn, and one more: */
    int *row;   /* row[start[t] .. start[t + 1]), ascending: the neighbours that node[t] has when it is eliminated */
    KeaBlock work, rows;
} KeaOrder;

/* Orders a graph; size: unknowns by node. The result is valid until the next call. False: no memory. */
MeBool kea_orderFind(KeaOrder *o, int numNodes, const int size[], int numEdges, const int (*edges)[2]);
void kea_orderFree(KeaOrder *o);

#endif
