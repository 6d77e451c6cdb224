/* A dynamic box tree on top of FCL's: fcl::detail::HierarchyTree stores the nodes; the traversals are our own.
 *
 * FCL inserts a new box next to the box with the nearest centre, without balancing. So the tree is rebuilt when a
 * leaf gets much deeper than it would be in a balanced tree. Nothing here depends on addresses.
 */
#include "space/mcd_tree_i.h"
#include "MeAssert.h"
#include <algorithm>
#include <cstdint>
#include <fcl/broadphase/detail/hierarchy_tree.h>
#include <fcl/math/bv/AABB.h>
#include <new>
#include <vector>

using Box = fcl::AABB<float>;
using Nodes = fcl::detail::HierarchyTree<Box>;
using Node = Nodes::NodeType;

struct McdTree {
    Nodes nodes;
    bool isDeep = false; /* some leaf is too deep: to be rebuilt */
};

namespace {

Node *nodeOf(McdTreeLeaf *leaf) {
    return reinterpret_cast<Node *>(leaf);
}

int itemOf(const Node *leaf) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(leaf->data));
}

Box boxOf(const McdTreeBox &b) {
    return Box(fcl::Vector3<float>(b.min[0], b.min[1], b.min[2]), fcl::Vector3<float>(b.max[0], b.max[1], b.max[2]));
}

/* Rebuilds a tree top-down in place, reusing its nodes; splits the leaves in half along the longest axis. FCL's
 * balanceTopdown frees all nodes and allocates new ones: if an allocation failed, the tree would be lost. */
class TopDownRebuild {
    std::vector<Node *> leaf, inner;
    std::size_t used = 0; /* number of inner nodes used */

    /* Builds the subtree of leaves first .. last - 1. */
    Node *make(std::size_t first, std::size_t last) {
        if (last - first == 1)
            return leaf[first];
        MEASSERT(used < inner.size());
        Node *n = inner[used++];
        n->bv = leaf[first]->bv;
        for (std::size_t i = first + 1; i < last; i++)
            n->bv += leaf[i]->bv;
        const Box &b = n->bv;
        const int longest = b.width() >= b.height() && b.width() >= b.depth() ? 0 : b.height() >= b.depth() ? 1 : 2;
        const std::size_t middle = first + (last - first) / 2;
        const auto at = [&](std::size_t i) { return leaf.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(first), at(middle), at(last), [longest](const Node *x, const Node *y) {
            return x->bv.min_[longest] + x->bv.max_[longest] < y->bv.min_[longest] + y->bv.max_[longest];
        });
        n->children[0] = make(first, middle);
        n->children[1] = make(middle, last);
        n->children[0]->parent = n->children[1]->parent = n;
        return n;
    }

  public:
    /* Allocates all memory that is needed; throws before anything is changed. */
    explicit TopDownRebuild(std::size_t leaves) {
        leaf.reserve(leaves);
        inner.reserve(leaves);
    }
    void run(Node *root) {
        inner.push_back(root);
        for (std::size_t i = 0; i < inner.size(); i++)
            for (Node *child : inner[i]->children)
                (child->isLeaf() ? leaf : inner).push_back(child);
        MEASSERT(leaf.size() == inner.size() + 1);
        make(0, leaf.size()); /* uses inner nodes in their order, so the root stays the root */
        MEASSERT(used == inner.size());
    }
};

/* For checks: whether each inner node's box contains its children's boxes, and their parent pointers are right. */
bool isSound(const Node *n) {
    for (int k = 0; !n->isLeaf() && k < 2; k++) {
        const Node *child = n->children[k];
        if (child->parent != n || !n->bv.contain(child->bv) || !isSound(child))
            return false;
    }
    return true;
}

void rebuildTopDown(McdTree &tree) noexcept {
    tree.isDeep = false;
    if (tree.nodes.size() < 3)
        return;
    try {
        TopDownRebuild(tree.nodes.size()).run(tree.nodes.getRoot());
    } catch (...) { /* no memory: slower, but correct */
    }
    MEVALIDATE(isSound(tree.nodes.getRoot()));
}

/* Has the tree rebuilt if a leaf lies deeper than twice the depth of a balanced tree and some spare levels: before the
 * next query or, if it is far deeper, immediately, since boxes inserted in sorted order would make the tree a list. */
void checkDepth(McdTree &tree, const Node *leaf) noexcept {
    const int spare = 40, maxSpare = 1000;
    int depth = 0, balanced = 0;
    for (const Node *n = leaf->parent; n; n = n->parent) {
        MEASSERT(n->bv.contain(leaf->bv));
        depth++;
    }
    for (std::size_t size = tree.nodes.size(); size > 1; size /= 2)
        balanced++;
    if (depth > 2 * balanced + maxSpare)
        rebuildTopDown(tree);
    else
        tree.isDeep = tree.isDeep || depth > 2 * balanced + spare;
}

/* Compares all axes without branches: the separating axis is unpredictable. */
bool overlaps(const Box &a, const McdTreeBox &b) {
    int is = 1;
    for (int i = 0; i < 3; i++) {
        is &= a.min_[i] <= b.max[i];
        is &= b.min[i] <= a.max_[i];
    }
    return is != 0;
}

struct Query {
    const McdTreeBox &box;
    McdTreeVisit visit;
    void *context;

    /* Visits the leaves below n, whose box overlaps. */
    bool walk(const Node *n) const {
        while (!n->isLeaf()) {
            const Node *first = n->children[0], *second = n->children[1];
            const bool isFirst = overlaps(first->bv, box), isSecond = overlaps(second->bv, box);
            if (!isFirst && !isSecond)
                return true;
            if (isFirst && isSecond && !walk(first))
                return false;
            n = isSecond ? second : first;
        }
        return visit(context, itemOf(n)) != 0;
    }
    bool run(const Node *root) const {
        return !overlaps(root->bv, box) || walk(root);
    }
};

/* Whether the moving box overlaps the box from min to max at some fraction of the motion in [0, last]. */
bool overlaps(const float *min, const float *max, const double *from, const double *by, const double *half,
              double last) {
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
        while (overlaps(n->bv.min_.data(), n->bv.max_.data(), from, by, half, fraction)) {
            if (n->isLeaf()) {
                const double last = fraction;
                fraction = visit(context, itemOf(n), last);
                MEASSERT(!(fraction > last)); /* nothing is cast farther than it may go */
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
    MEASSERT(item >= 0);
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
    MEASSERT(node->isLeaf());
    node->bv = boxOf(*box);
    try {
        tree->nodes.update(node); /* removes and reinserts the leaf, reusing its parent: no allocation */
    } catch (...) {
    }
    checkDepth(*tree, node);
}

void mcd_treeRemove(McdTree *tree, McdTreeLeaf *leaf) {
    MEASSERT(nodeOf(leaf)->isLeaf());
    tree->nodes.remove(nodeOf(leaf));
}

void mcd_treeRebuild(McdTree *tree) {
    rebuildTopDown(*tree);
}

void mcd_treeRebuildIfDeep(McdTree *tree) {
    if (tree->isDeep)
        rebuildTopDown(*tree);
}

size_t mcd_treeBytesPerItem(void) {
    return 2 * sizeof(Node);
}

void mcd_treeQuery(const McdTree *tree, const McdTreeBox *box, McdTreeVisit visit, void *context) {
    if (tree->nodes.getRoot())
        Query{*box, visit, context}.run(tree->nodes.getRoot());
}

void mcd_treeCast(const McdTree *tree, const double from[3], const double by[3], const double half[3], double fraction,
                  McdTreeCastVisit visit, void *context) {
    if (tree->nodes.getRoot())
        Cast{from, by, half, fraction, visit, context}.walk(tree->nodes.getRoot());
}

MeBool mcd_treeCastBox(const McdTreeBox *box, const double from[3], const double by[3], const double half[3],
                       double fraction) {
    return overlaps(box->min, box->max, from, by, half, fraction);
}
