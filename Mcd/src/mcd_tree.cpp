/* A tree of boxes over FCL's dynamic tree: fcl::detail::HierarchyTree keeps the nodes, the walks are ours.
 *
 * FCL puts a new box next to the box whose centre is nearest, without balancing; so the tree is made anew where a leaf
 * gets much deeper than it would be in a balanced tree. Nothing here depends on addresses.
 */
#include "mcd_tree.h"
#include <algorithm>
#include <cstdint>
#include <fcl/broadphase/detail/hierarchy_tree.h>
#include <fcl/math/bv/AABB.h>
#include <new>

using Box = fcl::AABB<float>;
using Nodes = fcl::detail::HierarchyTree<Box>;
using Node = Nodes::NodeType;

struct McdTree {
    Nodes nodes;
    bool isDeep = false; /* some leaf is */
};

namespace {

/* Levels beyond twice those of a balanced tree: from here on the tree is to be made anew, before it is asked; and at
 * the latest here, as boxes that come in order make it a list. */
const int spareDepth = 40, mostSpareDepth = 1000;

Node *nodeOf(McdTreeLeaf *leaf) {
    return reinterpret_cast<Node *>(leaf);
}

int itemOf(const Node *leaf) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(leaf->data));
}

Box boxOf(const McdTreeBox &b) {
    return Box(fcl::Vector3<float>(b.min[0], b.min[1], b.min[2]), fcl::Vector3<float>(b.max[0], b.max[1], b.max[2]));
}

void balance(McdTree &tree) noexcept {
    tree.isDeep = false;
    try {
        tree.nodes.balanceTopdown();
    } catch (...) { /* no memory for the list of leaves: nothing was changed then; the nodes are those it had */
    }
}

void checkDepth(McdTree &tree, const Node *leaf) noexcept {
    int depth = 0, balanced = 0;
    for (const Node *n = leaf->parent; n; n = n->parent)
        depth++;
    for (std::size_t size = tree.nodes.size(); size > 1; size /= 2)
        balanced++;
    if (depth > 2 * balanced + mostSpareDepth)
        balance(tree);
    else
        tree.isDeep = tree.isDeep || depth > 2 * balanced + spareDepth;
}

bool overlaps(const Box &a, const McdTreeBox &b) {
    return a.min_[0] <= b.max[0] && b.min[0] <= a.max_[0] && a.min_[1] <= b.max[1] && b.min[1] <= a.max_[1] &&
           a.min_[2] <= b.max[2] && b.min[2] <= a.max_[2];
}

struct Query {
    const McdTreeBox &box;
    McdTreeVisit visit;
    void *context;

    bool walk(const Node *n) const {
        while (overlaps(n->bv, box)) {
            if (n->isLeaf())
                return visit(context, itemOf(n)) != 0;
            if (!walk(n->children[0]))
                return false;
            n = n->children[1];
        }
        return true;
    }
};

/* Is there a fraction in [0, last] at which the moving box overlaps the one from min to max? */
bool meets(const float *min, const float *max, const double *from, const double *by, const double *half, double last) {
    double first = 0;
    for (int i = 0; i < 3; i++) {
        const double low = static_cast<double>(min[i]) - half[i] - from[i];
        const double high = static_cast<double>(max[i]) + half[i] - from[i];
        if (by[i] == 0) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        const double a = low / by[i], b = high / by[i];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
        if (first > last)
            return false;
    }
    return true;
}

struct Cast {
    const double *from, *by, *half;
    double fraction;
    McdTreeCastVisit visit;
    void *context;

    double along(const Node *n) const {
        double sum = 0;
        for (int i = 0; i < 3; i++)
            sum += (static_cast<double>(n->bv.min_[i]) + static_cast<double>(n->bv.max_[i])) * by[i];
        return sum;
    }
    void walk(const Node *n) {
        while (meets(n->bv.min_.data(), n->bv.max_.data(), from, by, half, fraction)) {
            if (n->isLeaf()) {
                fraction = visit(context, itemOf(n), fraction);
                return;
            }
            const int near = along(n->children[1]) < along(n->children[0]);
            walk(n->children[near]);
            n = n->children[1 - near];
        }
    }
};

} // namespace

McdTree *mcd_treeCreate(void) {
    try {
        return new McdTree;
    } catch (...) {
        return nullptr;
    }
}

void mcd_treeDestroy(McdTree *tree) {
    delete tree;
}

McdTreeLeaf *mcd_treeInsert(McdTree *tree, const McdTreeBox *box, int item) {
    try {
        Node *leaf = tree->nodes.insert(boxOf(*box), reinterpret_cast<void *>(static_cast<std::intptr_t>(item)));
        checkDepth(*tree, leaf);
        return reinterpret_cast<McdTreeLeaf *>(leaf);
    } catch (...) {
        return nullptr;
    }
}

void mcd_treeMove(McdTree *tree, McdTreeLeaf *leaf, const McdTreeBox *box) {
    Node *node = nodeOf(leaf);
    node->bv = boxOf(*box);
    try {
        tree->nodes.update(node); /* out and in again; reuses the node above, so there is nothing to allocate */
    } catch (...) {
    }
    checkDepth(*tree, node);
}

void mcd_treeRemove(McdTree *tree, McdTreeLeaf *leaf) {
    tree->nodes.remove(nodeOf(leaf));
}

void mcd_treeBalance(McdTree *tree) {
    balance(*tree);
}

void mcd_treeSettle(McdTree *tree) {
    if (tree->isDeep)
        balance(*tree);
}

size_t mcd_treeBytesPerItem(void) {
    return 2 * sizeof(Node);
}

void mcd_treeQuery(const McdTree *tree, const McdTreeBox *box, McdTreeVisit visit, void *context) {
    if (tree->nodes.getRoot())
        Query{*box, visit, context}.walk(tree->nodes.getRoot());
}

void mcd_treeCast(const McdTree *tree, const double from[3], const double by[3], const double half[3], double fraction,
                  McdTreeCastVisit visit, void *context) {
    if (tree->nodes.getRoot())
        Cast{from, by, half, fraction, visit, context}.walk(tree->nodes.getRoot());
}

MeBool mcd_treeCastBox(const McdTreeBox *box, const double from[3], const double by[3], const double half[3],
                       double fraction) {
    return meets(box->min, box->max, from, by, half, fraction);
}
