/* The boxes over the triangles of a mesh: FCL builds the tree from the top down, splitting at the mean of the centres
 * along the longest side; the walks are our own.
 *
 * Boxes have the vertices' precision, so they are exact. Both children of a node lie side by side, after their parent.
 */
#include "surface/mcd_bvh_i.h"
#include "MeAssert.h"
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <memory>

using Box = fcl::AABB<MeReal>;
using Model = fcl::BVHModel<Box>;
using Node = fcl::BVNode<Box>;

struct McdBvh {
    Model model;
};

namespace {

/* FCL's copies of vertices and indices, which only the build reads. */
bool fillModel(Model &model, const McdBvhTriangles &t) {
    if (model.beginModel(t.count, t.vertexCount) != fcl::BVH_OK)
        return false;
    for (int i = 0; i < t.vertexCount; i++)
        model.vertices[i] = fcl::Vector3<MeReal>(t.vertex[i][0], t.vertex[i][1], t.vertex[i][2]);
    const auto number = [&](int corner) { return static_cast<std::size_t>(t.index[corner]); };
    for (int i = 0; i < t.count; i++)
        model.tri_indices[i] = fcl::Triangle(number(3 * i), number(3 * i + 1), number(3 * i + 2));
    model.num_vertices = t.vertexCount;
    model.num_tris = t.count;
    return true;
}

void dropCopies(Model &model) {
    delete[] model.vertices;
    delete[] model.tri_indices;
    model.vertices = nullptr;
    model.tri_indices = nullptr;
}

/* For checks: whether each inner node's box contains its children's boxes, which come after it. */
bool isSound(const Model &model) {
    for (int i = 0; i < model.getNumBVs(); i++) {
        const Node &n = model.getBV(i);
        if (!n.isLeaf() && (n.leftChild() <= i || !n.bv.contain(model.getBV(n.leftChild()).bv) ||
                            !n.bv.contain(model.getBV(n.rightChild()).bv)))
            return false;
    }
    return true;
}

/* Empty if no corner is finite: it overlaps nothing. */
Box boxOf(const McdBvhTriangles &t, int triangle) {
    Box box;
    for (int k = 0; k < 3; k++) {
        const MeReal *v = t.vertex[t.index[3 * triangle + k]];
        if (MeRealIsValid(v[0]) && MeRealIsValid(v[1]) && MeRealIsValid(v[2]))
            box += fcl::Vector3<MeReal>(v[0], v[1], v[2]);
    }
    return box;
}

struct Query {
    const Model &model;
    const double *low, *high;
    McdBvhVisit visit;
    void *context;

    /* Compares all axes without branches: the separating axis is unpredictable. */
    bool overlaps(const Box &b) const {
        int is = 1;
        for (int i = 0; i < 3; i++) {
            is &= static_cast<double>(b.min_[i]) <= high[i];
            is &= low[i] <= static_cast<double>(b.max_[i]);
        }
        return is != 0;
    }
    /* Visits the leaves below n, whose box overlaps. */
    bool walk(const Node *n) const {
        while (!n->isLeaf()) {
            const Node *first = &model.getBV(n->leftChild()), *second = &model.getBV(n->rightChild());
            const bool isFirst = overlaps(first->bv), isSecond = overlaps(second->bv);
            if (!isFirst && !isSecond)
                return true;
            if (isFirst && isSecond && !walk(first))
                return false;
            n = isSecond ? second : first;
        }
        return visit(context, n->primitiveId()) != 0;
    }
};

/* Finite, and so large for 0 that any distance is beyond the segment; a product with 0 stays 0. */
double inverseOf(double x) {
    const double max = 1e200;
    return std::fabs(x) * max > 1 ? 1 / x : max;
}

struct Cast {
    const Model &model;
    const double *from;
    double inverse[3]; /* of the displacement */
    double fraction;
    McdBvhCastVisit visit;
    void *context;

    /* The fraction at which the segment enters the box; infinite if it does not before `fraction`. The end of the
     * interval is enlarged by the rounding of both ends, so that nothing slips between boxes. */
    double enters(const Box &b) const {
        double first = 0, last = INFINITY;
        for (int i = 0; i < 3; i++) {
            const double low = (static_cast<double>(b.min_[i]) - from[i]) * inverse[i];
            const double high = (static_cast<double>(b.max_[i]) - from[i]) * inverse[i];
            first = std::max(first, std::min(low, high));
            last = std::min(last, std::max(low, high));
        }
        return first <= std::min(fraction, last * (1 + 4 * DBL_EPSILON)) ? first : INFINITY;
    }
    void walk(const Node *n) {
        while (!n->isLeaf()) {
            const Node *near = &model.getBV(n->leftChild()), *far = &model.getBV(n->rightChild());
            double nearAt = enters(near->bv), farAt = enters(far->bv);
            if (farAt < nearAt) {
                std::swap(near, far);
                std::swap(nearAt, farAt);
            }
            if (!(nearAt <= fraction))
                return;
            if (farAt <= fraction) {
                walk(near);
                if (!(farAt <= fraction))
                    return;
                near = far;
            }
            n = near;
        }
        const double last = fraction;
        fraction = visit(context, n->primitiveId(), last);
        MEASSERT(!(fraction > last)); /* nothing is cast farther than it may go */
    }
};

} // namespace

McdBvh *mcd_bvhCreate(const McdBvhTriangles *triangles) {
    MEASSERT(triangles->count >= 1 && triangles->vertexCount >= 1);
    try {
        std::unique_ptr<McdBvh> bvh(new McdBvh);
        if (!fillModel(bvh->model, *triangles) || bvh->model.endModel() != fcl::BVH_OK)
            return nullptr;
        dropCopies(bvh->model);
        MEASSERT(bvh->model.getNumBVs() == 2 * triangles->count - 1);
        MEVALIDATE(isSound(bvh->model));
        return bvh.release();
    } catch (...) {
        return nullptr;
    }
}

void mcd_bvhDestroy(McdBvh *bvh) {
    delete bvh;
}

void mcd_bvhRefit(McdBvh *bvh, const McdBvhTriangles *triangles) {
    Model &model = bvh->model;
    for (int i = model.getNumBVs() - 1; i >= 0; i--) {
        Node &n = model.getBV(i);
        n.bv = n.isLeaf() ? boxOf(*triangles, n.primitiveId())
                          : model.getBV(n.leftChild()).bv + model.getBV(n.rightChild()).bv;
    }
    MEVALIDATE(isSound(model));
}

void mcd_bvhBounds(const McdBvh *bvh, MeVector3 min, MeVector3 max) {
    const Box &b = bvh->model.getBV(0).bv;
    for (int i = 0; i < 3; i++) {
        min[i] = b.min_[i];
        max[i] = b.max_[i];
    }
}

void mcd_bvhQuery(const McdBvh *bvh, const double low[3], const double high[3], McdBvhVisit visit, void *context) {
    const Query query{bvh->model, low, high, visit, context};
    if (query.overlaps(bvh->model.getBV(0).bv))
        query.walk(&bvh->model.getBV(0));
}

void mcd_bvhCast(const McdBvh *bvh, const double from[3], const double by[3], McdBvhCastVisit visit, void *context) {
    Cast cast{bvh->model, from, {inverseOf(by[0]), inverseOf(by[1]), inverseOf(by[2])}, 1, visit, context};
    if (cast.enters(bvh->model.getBV(0).bv) <= 1)
        cast.walk(&bvh->model.getBV(0));
}
