/* Inside Kea: domain decomposition of a large partition into regions of bodies, and the fast solver's loops over them,
 * on the workers of the system's team (MeTeam.h).
 *
 * The bodies are halved across their longest side, and the halves again: recursive coordinate bisection (Berger and
 * Bokhari 1987, "A partitioning strategy for nonuniform problems on multiprocessors"). This gives a binary tree: node 1
 * has all bodies, nodes 2 n and 2 n + 1 are the halves of node n, the leaves are the regions. A manifold belongs to the
 * lowest node that contains both its bodies: nearly all to regions, the others to the cuts between them. One worker
 * visits the manifolds of a region, colour after colour, so that their data stay in its cache from pass to pass.
 *
 * The rule for order: nodes of one depth share no body and may be visited in any order; depths are visited one after
 * the other, from the regions up to node 1. Sums over a node are stored in its record and added in the order of nodes.
 * The number of regions and their bodies depend only on the partition. So the answer has the same bits for any number
 * of workers.
 */
#ifndef KEA_REGIONS_I_H
#define KEA_REGIONS_I_H

#include "common/kea_arena_i.h"
#include "fast/kea_fast_i.h"
#include "MeTeam.h"

enum { KEA_MAX_REGIONS = MeTaskMaxWorkers, KEA_MAX_NODES = 2 * KEA_MAX_REGIONS };

_Static_assert((KEA_MAX_REGIONS & (KEA_MAX_REGIONS - 1)) == 0, "regions are halved");

typedef struct KeaNode {
    /* kea_regions.c */
    _Alignas(ME_CACHE_LINE) int firstPlace, numPlaces; /* its bodies' places; only regions have any */
    int firstManifold, numManifolds;                   /* range of KeaRegions.manifold */
    /* kea_colour.c */
    int firstGroup, numGroups;
    /* results of the last loop */
    float lanes[KEA_LANES];
    KeaMeasure measure;
    double sum[5];
} KeaNode;

typedef struct KeaRegions {
    const MdtKeaSystem *s;
    MeTeam *team;
    int count;                    /* number of regions, a power of two: they are nodes count .. 2 count - 1 */
    int *body, *place;            /* body by place, and place by body: bodies of a region have adjacent places */
    int *manifold;                /* manifolds sorted by node */
    int *sorted;                  /* manifolds sorted by node, colour, and number of points (kea_colour.c) */
    MeU8 *leaf, *home, *colour;   /* by body: its region; by manifold: its node; by manifold */
    MeU64 *usedColours;           /* by place: set of colours; scratch of kea_colour.c */
    struct KeaBisected *bisected; /* by place: scratch */
    KeaNode *node;                /* the caller's array of KEA_MAX_NODES, from index 1 on; the first 2 count are used */
} KeaRegions;

typedef void (*KeaNodeWork)(void *context, KeaNode *node);

/* Carves the arrays for the system `s` from the arena. */
void kea_regionsLayOut(KeaRegions *r, KeaArena *arena);
/* Divides the bodies of the system `s` into regions, and assigns manifolds to nodes. */
void kea_regionsDivide(KeaRegions *r);

/* Parallel loops that call `work` for nodes. kea_visitNodesByDepth: depth after depth from the regions up, so that
 * nodes visited at the same time share no body. */
void kea_visitNodesByDepth(KeaRegions *r, KeaNodeWork work, void *context);
/* Visits all nodes at the same time: `work` may read bodies of other nodes, but not change them. */
void kea_visitNodes(KeaRegions *r, KeaNodeWork work, void *context);
/* Visits all regions at the same time. */
void kea_visitRegions(KeaRegions *r, KeaNodeWork work, void *context);

/* ---- kea_colour.c ---- */

/* Colours the manifolds of each node, sorts them by colour, and counts their groups. Returns the number of all
 * groups. */
int kea_colourManifolds(KeaRegions *r);
/* Clears the groups of a node, and assigns manifolds to their lanes. */
void kea_groupManifolds(const KeaRegions *r, const KeaNode *node, KeaGroup groups[]);

#endif
