/* Inside Mcd: a tree of boxes, over FCL's. The one door between C and C++: nothing of FCL shows, nothing is thrown.
 *
 * Boxes are float, rounded outward (mcd_treeBox). An item is any number that the caller knows. Which items a query
 * meets does not depend on the tree's form; in which order does, so callers sort what they show. */
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

/* Coordinates are cut off here, so that no sum or product of them overflows. */
#define MCD_TREE_REACH 1e15

McdTree *mcd_treeCreate(void); /* null if there is no memory */
void mcd_treeDestroy(McdTree *tree);
McdTreeLeaf *mcd_treeInsert(McdTree *tree, const McdTreeBox *box, int item); /* null if there is no memory */
void mcd_treeMove(McdTree *tree, McdTreeLeaf *leaf, const McdTreeBox *box);
void mcd_treeRemove(McdTree *tree, McdTreeLeaf *leaf);
/* Makes the tree anew from the top down: after many insertions. */
void mcd_treeBalance(McdTree *tree);
/* The same if it got too deep; before queries. */
void mcd_treeSettle(McdTree *tree);
size_t mcd_treeBytesPerItem(void); /* what an item takes: its leaf and the node above */

/* Calls visit for each item whose box overlaps, until it returns false. */
typedef MeBool (*McdTreeVisit)(void *context, int item);
void mcd_treeQuery(const McdTree *tree, const McdTreeBox *box, McdTreeVisit visit, void *context);
/* Calls visit for each item that a box with these half sizes (0: a point), moving from `from` by `by`, may meet before
 * the fraction that visit last returned, at first `fraction`; roughly from near to far. */
typedef double (*McdTreeCastVisit)(void *context, int item, double fraction);
void mcd_treeCast(const McdTree *tree, const double from[3], const double by[3], const double half[3], double fraction,
                  McdTreeCastVisit visit, void *context);
/* The part of that motion that is in the box: false if there is none in [0, fraction]. */
MeBool mcd_treeCastBox(const McdTreeBox *box, const double from[3], const double by[3], const double half[3],
                       double fraction);

ME_END_C

#endif
