/* Inside Mcd: a dynamic box tree, on top of FCL's. The only interface between C and C++: nothing of FCL is visible,
 * and nothing is thrown.
 *
 * Boxes are float, rounded outward (mcd_treeBox). An item is the caller's number. Which items a query visits does
 * not depend on the tree's shape, but their order does: callers sort their results. */
#ifndef MCD_TREE_H
#define MCD_TREE_H

#include "MeCall.h"
#include "MePrecision.h"
#include <stddef.h>

ME_BEGIN_C

typedef struct McdTree McdTree;
typedef struct McdTreeLeaf McdTreeLeaf;
typedef struct McdTreeBox {
    float min[3], max[3];
} McdTreeBox;

/* Coordinates are clamped to this, so that sums and products do not overflow. */
#define MCD_TREE_REACH 1e15

McdTree *mcd_treeCreate(void); /* null if there is no memory */
void mcd_treeDestroy(McdTree *tree);
McdTreeLeaf *mcd_treeInsert(McdTree *tree, const McdTreeBox *box, int item); /* null if there is no memory */
void mcd_treeMove(McdTree *tree, McdTreeLeaf *leaf, const McdTreeBox *box);
void mcd_treeRemove(McdTree *tree, McdTreeLeaf *leaf);
/* Rebuilds the tree from the top down: for use after many insertions. */
void mcd_treeRebuild(McdTree *tree);
/* Rebuilds the tree if it has become too deep; to be called before queries. */
void mcd_treeRebuildIfDeep(McdTree *tree);
size_t mcd_treeBytesPerItem(void); /* memory per item: its leaf and an inner node */

/* Calls visit for each item whose box overlaps the box, until it returns false. */
typedef MeBool (*McdTreeVisit)(void *context, int item);
void mcd_treeQuery(const McdTree *tree, const McdTreeBox *box, McdTreeVisit visit, void *context);
/* Casts a box with half extents `half` (0: a point) from `from` by `by`: calls visit for each item that it may hit
 * before the current fraction of the motion, initially `fraction`, then what visit returns. The order is roughly
 * from near to far. */
typedef double (*McdTreeCastVisit)(void *context, int item, double fraction);
void mcd_treeCast(const McdTree *tree, const double from[3], const double by[3], const double half[3], double fraction,
                  McdTreeCastVisit visit, void *context);
/* Whether that motion hits the box within [0, fraction]. */
MeBool mcd_treeCastBox(const McdTreeBox *box, const double from[3], const double by[3], const double half[3],
                       double fraction);

ME_END_C

#endif
