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
#include <cstdint>
#include <cstring>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <limits>
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

/* FCL has a node's numbers behind calls into its library. */
inline bool isLeaf(const Node *n) {
    return n->first_child < 0;
}
inline int triangleOf(const Node *n) {
    return -n->first_child - 1;
}

/* Vectors of two doubles and of four coordinates, by extensions of GCC and Clang: registers of SSE2, or scalars. */
using Two = double __attribute__((vector_size(2 * sizeof(double))));
using Four = MeReal __attribute__((vector_size(4 * sizeof(MeReal))));

inline Two minOf(Two a, Two b) {
    return a < b ? a : b;
}
inline Two maxOf(Two a, Two b) {
    return a > b ? a : b;
}
/* Whether all elements of a comparison's result are true, -1. */
template <typename Flags> inline bool areAll(Flags is) {
    std::int64_t half[sizeof is / sizeof(std::int64_t)], all = -1;
    std::memcpy(half, &is, sizeof is);
    for (const std::int64_t h : half)
        all &= h;
    return all == -1;
}

/* The smallest coordinate that is not below x. Bits of positive floats are in their order, those of negative ones in
 * the opposite; the sign is that of x. */
inline MeReal roundedUp(double x) {
    MeReal r = static_cast<MeReal>(x);
    if constexpr (sizeof r == sizeof(std::int32_t)) {
        std::int32_t bits;
        std::memcpy(&bits, &r, sizeof r);
        bits += static_cast<double>(r) < x ? (bits >= 0 ? 1 : -1) : 0;
        std::memcpy(&r, &bits, sizeof r);
    }
    return r;
}

/* The box of a search, rounded outward to the boxes' precision: the same boxes overlap it. */
struct Around {
    Four low, high; /* -oo, low; high, oo */
    Around(const double min[3], const double max[3]) {
        const MeReal none = std::numeric_limits<MeReal>::infinity();
        low[0] = -none;
        high[3] = none;
        for (int i = 0; i < 3; i++) {
            low[i + 1] = roundedUp(min[i]);
            high[i] = -roundedUp(-max[i]);
        }
    }
    /* Compares all axes without branches: the separating axis is unpredictable. A box is six coordinates in a row, so
     * that four from the first on are its minimum and one that is below oo, four to the last its maximum and one that
     * is above -oo. */
    bool overlaps(const Box &b) const {
        static_assert(sizeof(Box) == 6 * sizeof(MeReal), "a box is its coordinates");
        const char *coordinates = reinterpret_cast<const char *>(&b);
        Four min, max;
        std::memcpy(&min, coordinates, sizeof min);
        std::memcpy(&max, coordinates + 2 * sizeof(MeReal), sizeof max);
        return areAll((min <= high) & (low <= max));
    }
};

struct Query {
    const Model &model;
    Around around;
    McdBvhVisit visit;
    void *context;

    /* Visits the leaves below n, whose box overlaps. */
    bool walk(const Node *n) const {
        while (!isLeaf(n)) {
            const Node *first = &model.getBV(n->first_child), *second = first + 1;
            const bool isFirst = around.overlaps(first->bv), isSecond = around.overlaps(second->bv);
            if (!isFirst && !isSecond)
                return true;
            if (isFirst && isSecond && !walk(first))
                return false;
            n = isSecond ? second : first;
        }
        return visit(context, triangleOf(n)) != 0;
    }
};

/* Finite, and so large for 0 that any distance is beyond the segment; a product with 0 stays 0. */
double inverseOf(double x) {
    const double max = 1e200;
    return std::fabs(x) * max > 1 ? 1 / x : max;
}

struct Cast {
    const Model &model;
    Two from, inverse; /* along x and y; inverse: of the displacement */
    double fromZ, inverseZ;
    double fraction;
    int ray; /* its number */
    McdBvhCastVisit visit;
    void *context;

    /* The fraction at which the segment enters the box; infinite if it does not before `fraction`. The end of the
     * interval is enlarged by the rounding of both ends, so that nothing slips between boxes. */
    double enters(const Box &b) const {
        const Two low = {static_cast<double>(b.min_[0]), static_cast<double>(b.min_[1])};
        const Two high = {static_cast<double>(b.max_[0]), static_cast<double>(b.max_[1])};
        const Two one = (low - from) * inverse, two = (high - from) * inverse;
        const Two near = minOf(one, two), far = maxOf(one, two);
        const double oneZ = (static_cast<double>(b.min_[2]) - fromZ) * inverseZ;
        const double twoZ = (static_cast<double>(b.max_[2]) - fromZ) * inverseZ;
        const double first = std::max(std::max(near[0], near[1]), std::max(std::min(oneZ, twoZ), 0.));
        const double last = std::min(std::min(far[0], far[1]), std::max(oneZ, twoZ));
        return first <= std::min(fraction, last * (1 + 4 * DBL_EPSILON)) ? first : INFINITY;
    }
    void walk(const Node *n) {
        while (!isLeaf(n)) {
            const Node *near = &model.getBV(n->first_child), *far = near + 1;
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
        fraction = visit(context, ray, triangleOf(n), last);
        MEASSERT(!(fraction > last)); /* nothing is cast farther than it may go */
    }
};

/* The lowest node below which are all triangles whose boxes overlap that of a search; null: there are none. */
const Node *lowestAround(const Model &model, const Around &around) {
    const Node *n = &model.getBV(0);
    if (!around.overlaps(n->bv))
        return nullptr;
    while (!isLeaf(n)) {
        const Node *first = &model.getBV(n->first_child), *second = first + 1;
        const bool isFirst = around.overlaps(first->bv), isSecond = around.overlaps(second->bv);
        if (isFirst && isSecond)
            return n;
        if (!isFirst && !isSecond)
            return nullptr;
        n = isFirst ? first : second;
    }
    return n;
}

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
    const Query query{bvh->model, Around(low, high), visit, context};
    if (query.around.overlaps(bvh->model.getBV(0).bv))
        query.walk(&bvh->model.getBV(0));
}

/* Segments side by side, as of the wheels of a car, have most of the way down in common: it is walked once, by the box
 * of all. */
void mcd_bvhCast(const McdBvh *bvh, int count, const double from[][3], const double by[][3], McdBvhCastVisit visit,
                 void *context) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int ray = 0; ray < count; ray++)
        for (int i = 0; i < 3; i++) {
            const double end = from[ray][i] + by[ray][i];
            const double rounding = 8 * DBL_EPSILON * (std::fabs(from[ray][i]) + std::fabs(end));
            low[i] = std::min(low[i], std::min(from[ray][i], end) - rounding);
            high[i] = std::max(high[i], std::max(from[ray][i], end) + rounding);
        }
    const Node *start = lowestAround(bvh->model, Around(low, high));
    for (int ray = 0; start && ray < count; ray++) {
        const double *f = from[ray], *d = by[ray];
        Cast cast{bvh->model, {f[0], f[1]}, {inverseOf(d[0]), inverseOf(d[1])}, f[2], inverseOf(d[2]), 1, ray,
                  visit,      context};
        if (cast.enters(start->bv) <= 1)
            cast.walk(start);
    }
}
