/* Inside Kea: a large partition's bodies in regions, and the fast solver's loops over them, on the workers of the
 * system's team (MeTeam.h).
 *
 * The bodies are halved across their longest side, and the halves again: recursive coordinate bisection (Berger and
 * Bokhari 1987, "A partitioning strategy for nonuniform problems on multiprocessors"). Nodes of a binary tree: 1 is all
 * bodies, 2 n and 2 n + 1 are the halves of n, the leaves are the regions. A manifold belongs to the lowest node that
 * has both its bodies: nearly all to regions, the others to the cuts between them. One worker visits the manifolds of a
 * region, colour after colour, and keeps what it reads and writes in its cache, from pass to pass.
 *
 * The rule for order. Nodes of one depth share no body: they are visited in any order, the regions first, and depth
 * after depth up to node 1. What a node adds up stays in its record, and is summed in the nodes' order. How many
 * regions there are, and which bodies are in them, depends on the partition alone. So the answer has the same bits for
 * every number of workers, one included.
 */
#ifndef KEA_REGIONS_I_H
#define KEA_REGIONS_I_H

#include "common/kea_arena_i.h"
#include "fast/kea_fast_i.h"
#include "MeTeam.h"

enum { KEA_MAX_REGIONS = MeTaskMaxWorkers, KEA_MAX_NODES = 2 * KEA_MAX_REGIONS };

typedef struct KeaNode {
    /* kea_regions.c */
    _Alignas(64) int firstPlace, numPlaces; /* of bodies; none but of regions */
    int firstManifold, numManifolds;        /* of KeaRegions.manifold */
    /* kea_colour.c */
    int firstGroup, numGroups;
    /* the loop at hand */
    float lanes[KEA_LANES];
    KeaMeasure measure;
    double sum[5];
} KeaNode;

typedef struct KeaRegions {
    MeTeam *team;
    int count;                    /* of regions, a power of two: nodes count .. 2 count - 1 */
    int *body, *place;            /* by place, and back: bodies of a region lie together */
    int *manifold;                /* by node; */
    int *sorted;                  /* by node, colour, and number of points: kea_colour.c */
    MeU8 *leaf, *home, *colour;   /* by body, the region; by manifold, the node; by manifold */
    MeU64 *usedColours;           /* by place: scratch of kea_colour.c */
    struct KeaBisected *bisected; /* by place: scratch */
    KeaNode *node;                /* the caller's KEA_MAX_NODES, from 1 on; only 2 count are touched */
} KeaRegions;

typedef void (*KeaNodeWork)(void *context, KeaNode *node);

/* Carves the arrays. */
void kea_regionsLayOut(const MdtKeaSystem *s, KeaRegions *r, KeaArena *arena);
/* Puts bodies into regions, and manifolds into nodes. */
void kea_regionsDivide(const MdtKeaSystem *s, KeaRegions *r);

/* Nodes that share no body at once, the regions first, and depth after depth. */
void kea_inOrder(KeaRegions *r, KeaNodeWork work, void *context);
/* All nodes at once: they read no more of each other than bodies. */
void kea_overNodes(KeaRegions *r, KeaNodeWork work, void *context);
/* All regions at once. */
void kea_overRegions(KeaRegions *r, KeaNodeWork work, void *context);

/* ---- kea_colour.c ---- */

/* Gives the manifolds of each node their colours, sorts them by these, and counts the groups that makes: returns how
 * many there are in all. */
int kea_colour(const MdtKeaSystem *s, KeaRegions *r);
/* Empties the groups of a node, and writes which manifolds are in them. */
void kea_groupManifolds(const MdtKeaSystem *s, const KeaRegions *r, const KeaNode *node, KeaGroup groups[]);

#endif
