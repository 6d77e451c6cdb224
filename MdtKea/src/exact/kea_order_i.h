/* Inside Kea: the order of elimination of a graph, and what it makes of it. */
#ifndef KEA_ORDER_I_H
#define KEA_ORDER_I_H

#include "MePrecision.h"

typedef struct KeaOrder {
    int numNodes;
    int *node;       /* by turn */
    int **structure; /* by node: the neighbours that are left when its turn comes, */
    int *degree;     /* and how many */
} KeaOrder;

/* size: unknowns of a node. False: no memory. */
MeBool kea_orderCreate(KeaOrder *o, int numNodes, const int size[], int numEdges, const int (*edges)[2]);
void kea_orderDestroy(KeaOrder *o);

#endif
