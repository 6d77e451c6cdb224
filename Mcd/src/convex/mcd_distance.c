/* The signed distance of two convex cores by their Minkowski difference M = { x - y : x in A, y in B }, a convex set
 * that contains the origin if and only if the cores overlap.
 *
 * Separated cores: the distance is that of the origin from M, by GJK (Gilbert, Johnson and Keerthi: A fast procedure
 * for computing the distance between complex objects in three-dimensional space, 1988). Overlapping cores: the depth
 * is the distance from the origin to the nearest point of M's surface, by EPA (van den Bergen: Proximity queries and
 * penetration depth computation on 3D game objects, 2001): a polytope within M is expanded by M's support point
 * along the normal of the facet nearest to the origin, until no facet can be nearer than the one found. The nearest
 * facet bounds the depth from below, a supporting plane of M from above. For polyhedra both bounds become equal, on
 * a facet of M; round shapes stop at `tolerance`. EPA also serves cores that touch to within rounding: it finds a
 * face's normal, while GJK's direction is undefined at so small a distance (between the stones of an arch it was
 * wrong by 2.5e-5).
 *
 * libccd has the same algorithms, but its EPA finds no normal for exactly aligned cubes, and wrong depths for a
 * quarter of nearly aligned ones. Here the result is always measured by a support point, never by a facet's plane
 * alone. */
#include "convex/mcd_kind_i.h"

#include <string.h>

/* Tolerance of distances, relative to the smaller shape; rounding of coordinates, relative to the larger shape. */
static const double tolerance = 1e-9, resolution = 1e-14;
/* Tolerance of the search for shapes whose normal is made exact afterwards (mcd_polish.c): depths are documented to
 * 1e-6. */
static const double rough = 2e-7;

/* A point w = a - b of M, with its points a of A and b of B. */
typedef struct Corner {
    double w[3], a[3], b[3];
} Corner;

typedef struct Pair {
    const McdShape *a, *b;
    double tolerance, guessTolerance; /* m */
} Pair;

static Pair makePair(const McdShape *a, const McdShape *b) {
    const double small = mcd_pairSize(a, b), large = MeMAX(a->extent, b->extent);
    const double noise = 4 * (mcd_shapeNoise(a) + mcd_shapeNoise(b));
    return (Pair){a, b, MeMAX3(tolerance * small, resolution * large, noise), mcd_guessTolerance(a, b)};
}

/* The support point of M in a direction. */
static void minkowskiSupport(const Pair *p, const double direction[3], Corner *c) {
    double back[3];
    mcd_scale(back, direction, -1);
    mcd_coreSupport(p->a, direction, c->a);
    mcd_coreSupport(p->b, back, c->b);
    mcd_sub(c->w, c->a, c->b);
}

double mcd_separationAlong(const McdShape *a, const McdShape *b, const double n[3]) {
    double back[3];
    double x[3], y[3];
    mcd_scale(back, n, -1);
    mcd_coreSupport(a, back, x);
    mcd_coreSupport(b, n, y);
    return mcd_heightOver(x, y, n);
}

/* ---- separated ------------------------------------------------------------------------------------------- */

typedef struct Simplex {
    int count;
    Corner corner[4];
    double weight[4]; /* of each corner in the point nearest to the origin */
    double nearest[3];
    double squared; /* distance of `nearest` from the origin, squared */
    MeBool inside;  /* the tetrahedron contains the origin */
} Simplex;

/* The nearest point of the convex hull of some of the simplex's corners. */
typedef struct Candidate {
    int count, corner[3];
    double weight[3], point[3], squared;
} Candidate;

static void keepIfNearer(Candidate *best, const Candidate *c) {
    if (c->squared < best->squared)
        *best = *c;
}

static void tryCorner(const Simplex *s, int i, Candidate *best) {
    Candidate c = {.count = 1, .corner = {i}, .weight = {1}};
    mcd_copy(c.point, s->corner[i].w);
    c.squared = mcd_dot(c.point, c.point);
    keepIfNearer(best, &c);
}

static void tryEdge(const Simplex *s, int i, int j, Candidate *best) {
    const double *p = s->corner[i].w, *q = s->corner[j].w;
    double along[3];
    mcd_sub(along, q, p);
    const double squared = mcd_dot(along, along), t = -mcd_dot(p, along) / squared;
    if (!(squared > 0) || !(t > 0 && t < 1))
        return;
    Candidate c = {.count = 2, .corner = {i, j}, .weight = {1 - t, t}};
    mcd_mad(c.point, p, t, along);
    c.squared = mcd_dot(c.point, c.point);
    keepIfNearer(best, &c);
}

/* The projection of the origin on the triangle's plane is inside the triangle if the areas of the three
 * sub-triangles have the same sign. */
static void tryFacet(const Simplex *s, int i, int j, int k, Candidate *best) {
    const double *w[3] = {s->corner[i].w, s->corner[j].w, s->corner[k].w};
    double pq[3], pr[3], n[3], x[3], coordinate[3];
    mcd_sub(pq, w[1], w[0]);
    mcd_sub(pr, w[2], w[0]);
    mcd_cross(n, pq, pr);
    for (int l = 0; l < 3; l++) {
        mcd_cross(x, w[(l + 1) % 3], w[(l + 2) % 3]);
        coordinate[l] = mcd_dot(n, x);
    }
    const double all = coordinate[0] + coordinate[1] + coordinate[2], squared = mcd_dot(n, n);
    if (!(coordinate[0] > 0 && coordinate[1] > 0 && coordinate[2] > 0) || !(squared > 0))
        return;
    Candidate c = {.count = 3, .corner = {i, j, k}};
    for (int l = 0; l < 3; l++)
        c.weight[l] = coordinate[l] / all;
    mcd_scale(c.point, n, mcd_dot(n, w[0]) / squared);
    c.squared = mcd_dot(c.point, c.point);
    keepIfNearer(best, &c);
}

/* Whether the origin is on the same side of each face as the opposite corner. */
static MeBool containsOrigin(const Simplex *s) {
    const double *p = s->corner[0].w, *q = s->corner[1].w, *r = s->corner[2].w, *t = s->corner[3].w;
    double qr[3], rt[3], tq[3], coordinate[4];
    mcd_cross(qr, q, r);
    mcd_cross(rt, r, t);
    mcd_cross(tq, t, q);
    coordinate[0] = mcd_dot(q, rt);
    coordinate[1] = -mcd_dot(p, rt);
    coordinate[2] = -mcd_dot(p, tq);
    coordinate[3] = -mcd_dot(p, qr);
    const double sign = coordinate[0] + coordinate[1] + coordinate[2] + coordinate[3] < 0 ? -1 : 1;
    return coordinate[0] * sign > 0 && coordinate[1] * sign > 0 && coordinate[2] * sign > 0 && coordinate[3] * sign > 0;
}

/* The point nearest to the origin among all faces of the simplex that contain its newest (last) corner. Faces
 * without it are farther away than the previous nearest point, whose direction gave the newest corner. */
static Candidate nearestSubSimplex(const Simplex *s) {
    const int last = s->count - 1;
    Candidate best = {.squared = INFINITY};
    tryCorner(s, last, &best);
    for (int i = 0; i < last; i++) {
        tryEdge(s, last, i, &best);
        for (int j = i + 1; j < last; j++)
            tryFacet(s, last, i, j, &best);
    }
    MEASSERT(best.count >= 1 && best.count <= 3 && best.squared < INFINITY);
    return best;
}

static void keepSubSimplex(Simplex *s, const Candidate *subSimplex) {
    Corner kept[3];
    for (int i = 0; i < subSimplex->count; i++) {
        kept[i] = s->corner[subSimplex->corner[i]];
        s->weight[i] = subSimplex->weight[i];
    }
    memcpy(s->corner, kept, (size_t)subSimplex->count * sizeof *kept);
    s->count = subSimplex->count;
    mcd_copy(s->nearest, subSimplex->point);
    s->squared = subSimplex->squared;
}

static MeBool isCorner(const Simplex *s, const Corner *c) {
    for (int i = 0; i < s->count; i++)
        if (mcd_distanceSquared(s->corner[i].w, c->w) == 0)
            return METRUE;
    return MEFALSE;
}

static void beginGjk(const Pair *p, Simplex *s) {
    double v[3];
    mcd_sub(v, p->b->place, p->a->place);
    if (!(mcd_dot(v, v) > 0))
        mcd_set(v, 1, 0, 0);
    minkowskiSupport(p, v, &s->corner[0]);
    s->count = 1;
    s->inside = MEFALSE;
    const Candidate subSimplex = nearestSubSimplex(s);
    keepSubSimplex(s, &subSimplex);
}

typedef enum { BEYOND_LIMIT, SEPARATED, OVERLAPPING } GjkResult;

/* Iterates until the plane through the nearest point supports M, so that no point of M is nearer. For BEYOND_LIMIT,
 * `bound` is a lower bound of the distance. */
static GjkResult runGjk(const Pair *p, double limit, Simplex *s, double *bound) {
    enum { STEPS = 96 };
    beginGjk(p, s);
    for (int step = 0; step < STEPS; step++) {
        const double distance = sqrt(s->squared);
        if (!(distance > p->tolerance))
            return OVERLAPPING;
        Corner *c = &s->corner[s->count];
        double d[3];
        mcd_scale(d, s->nearest, -1);
        minkowskiSupport(p, d, c);
        *bound = -mcd_dot(d, c->w) / distance; /* lower bound of the distance of M */
        if (*bound > limit)
            return BEYOND_LIMIT;
        if (distance - *bound <= .1 * p->tolerance || isCorner(s, c))
            return SEPARATED;
        s->count++;
        s->inside = s->count == 4 && containsOrigin(s);
        if (s->inside)
            return OVERLAPPING;
        const Candidate subSimplex = nearestSubSimplex(s);
        if (subSimplex.squared >= s->squared) { /* no progress, because of rounding */
            s->count--;
            return distance > p->guessTolerance ? SEPARATED : OVERLAPPING;
        }
        keepSubSimplex(s, &subSimplex);
    }
    return SEPARATED;
}

static MeBool areWeights(const double *weight, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += weight[i] >= 0 ? weight[i] : INFINITY;
    return fabs(sum - 1) < 1e-9;
}

static void setWitnesses(const Corner *const corner[], const double *weight, int count, McdProximity *p) {
    MEASSERT(areWeights(weight, count));
    mcd_set(p->onA, 0, 0, 0);
    mcd_set(p->onB, 0, 0, 0);
    for (int i = 0; i < count; i++) {
        mcd_mad(p->onA, p->onA, weight[i], corner[i]->a);
        mcd_mad(p->onB, p->onB, weight[i], corner[i]->b);
    }
}

/* Makes the difference of the witness points the separation along the normal: moves each of the two by half of the
 * error. Weighted sums lose digits in a thin simplex, and facets of EPA lie within M. */
static void correctWitnesses(McdProximity *p) {
    double deficit[3];
    mcd_sub(deficit, p->onB, p->onA);
    mcd_mad(deficit, deficit, p->separation, p->normal);
    mcd_mad(p->onA, p->onA, .5, deficit);
    mcd_mad(p->onB, p->onB, -.5, deficit);
}

static void reportSeparated(const Simplex *s, McdProximity *p) {
    MEASSERT(s->count >= 1 && s->count <= 3 && s->squared > 0);
    const Corner *corner[3] = {&s->corner[0], &s->corner[1], &s->corner[2]};
    setWitnesses(corner, s->weight, s->count, p);
    p->separation = sqrt(s->squared);
    mcd_scale(p->normal, s->nearest, 1 / p->separation);
    correctWitnesses(p);
}

/* ---- overlapping: EPA's polytope within M ------------------------------------------------------------------------ */

enum { MAX_CORNERS = 200, MAX_FACETS = 2 * MAX_CORNERS };

typedef struct Facet {
    int corner[3];    /* counter-clockwise from outside */
    int neighbour[3]; /* facet across the edge from corner i to i + 1 */
    double normal[3]; /* outward, length 1 */
    double offset;    /* distance of its plane from the origin along the normal; negative if the origin is outside */
    int seen;         /* the round in which the new corner was above this facet */
} Facet;

typedef struct Polytope {
    Corner corner[MAX_CORNERS];
    Facet facet[MAX_FACETS];
    double offset[MAX_FACETS]; /* of live facets, INFINITY of others: searched for its minimum in every round */
    int cornerCount, facetCount, freeCount, freeFacet[MAX_FACETS];
    int facetFrom[MAX_CORNERS]; /* of each corner: the new facet whose first corner it is; -1: none */
    double epsilon;
    double normal[3], support; /* the best direction so far, and M's support along it: an upper bound of the depth */
    double error;              /* m, of the depth */
} Polytope;

/* Computes the facet's plane; false if its corners are collinear. */
static MeBool makePlane(Polytope *t, int index) {
    Facet *f = &t->facet[index];
    const double *p = t->corner[f->corner[0]].w, *q = t->corner[f->corner[1]].w, *r = t->corner[f->corner[2]].w;
    double pq[3], pr[3], qr[3];
    mcd_sub(pq, q, p);
    mcd_sub(pr, r, p);
    mcd_sub(qr, r, q);
    /* The cross product of the two edges at the corner opposite to the longest edge. */
    const double a = mcd_dot(pq, pq), b = mcd_dot(qr, qr), c = mcd_dot(pr, pr);
    if (c >= a && c >= b)
        mcd_cross(f->normal, pq, qr);
    else if (b >= a)
        mcd_cross(f->normal, pq, pr);
    else
        mcd_cross(f->normal, pr, qr);
    const double length = mcd_length(f->normal);
    if (!(length > 1e-30 * MeMAX(a, MeMAX(b, c))) || !(length > 0))
        return MEFALSE;
    mcd_scale(f->normal, f->normal, 1 / length);
    f->offset = (mcd_dot(f->normal, p) + mcd_dot(f->normal, q) + mcd_dot(f->normal, r)) / 3;
    t->offset[index] = f->offset;
    return METRUE;
}

static int newFacet(Polytope *t, int i, int j, int k) {
    if (!t->freeCount && t->facetCount == MAX_FACETS)
        return -1;
    const int index = t->freeCount ? t->freeFacet[--t->freeCount] : t->facetCount++;
    MEASSERT(index >= 0 && index < t->facetCount && i < t->cornerCount + 1 && j < t->cornerCount + 1 && i != j);
    t->facet[index] = (Facet){.corner = {i, j, k}, .seen = -1};
    return index;
}

static void linkFacets(Polytope *t, int f, int edge, int g) {
    const int from = t->facet[f].corner[edge], to = t->facet[f].corner[(edge + 1) % 3];
    for (int i = 0; i < 3; i++)
        if (t->facet[g].corner[i] == to && t->facet[g].corner[(i + 1) % 3] == from) {
            t->facet[f].neighbour[edge] = g;
            t->facet[g].neighbour[i] = f;
        }
}

/* Whether facet g has the edge `from` -> `to` and facet f as its neighbour across that edge. */
static MeBool isLinkedBack(const Polytope *t, int g, int from, int to, int f) {
    for (int i = 0; i < 3; i++)
        if (t->facet[g].corner[i] == from && t->facet[g].corner[(i + 1) % 3] == to)
            return t->facet[g].neighbour[i] == f;
    return MEFALSE;
}

/* For checks: each edge of a live facet is also its neighbour's, in the opposite direction, and links are mutual. */
static MeBool isClosed(const Polytope *t) {
    for (int i = 0; i < t->facetCount; i++)
        for (int edge = 0; edge < 3 && t->offset[i] < INFINITY; edge++) {
            const Facet *f = &t->facet[i];
            const int g = f->neighbour[edge];
            if (g < 0 || g >= t->facetCount || !(t->offset[g] < INFINITY) || !mcd_isUnit(f->normal) ||
                !isLinkedBack(t, g, f->corner[(edge + 1) % 3], f->corner[edge], i))
                return MEFALSE;
        }
    return METRUE;
}

/* Makes the facets of the tetrahedron of the first four corners, ordered so that all normals point outward. */
static MeBool makeTetrahedron(Polytope *t) {
    static const int corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    double x[3], y[3], z[3], n[3];
    mcd_sub(x, t->corner[1].w, t->corner[0].w);
    mcd_sub(y, t->corner[2].w, t->corner[0].w);
    mcd_sub(z, t->corner[3].w, t->corner[0].w);
    mcd_cross(n, x, y);
    if (mcd_dot(n, z) > 0) {
        const Corner swap = t->corner[1];
        t->corner[1] = t->corner[2];
        t->corner[2] = swap;
    }
    for (int i = 0; i < 4; i++)
        if (!makePlane(t, newFacet(t, corners[i][0], corners[i][1], corners[i][2])))
            return MEFALSE;
    for (int i = 0; i < 4; i++)
        for (int edge = 0; edge < 3; edge++)
            for (int j = 0; j < 4; j++)
                if (j != i)
                    linkFacets(t, i, edge, j);
    MEVALIDATE(isClosed(t));
    return METRUE;
}

/* Marks the facets visible from the new corner, by a flood fill from `first`. Returns their number. */
static int findVisible(Polytope *t, int first, int round, const double w[3], int *seen) {
    int count = 0;
    seen[count++] = first;
    t->facet[first].seen = round;
    for (int i = 0; i < count; i++)
        for (int edge = 0; edge < 3; edge++) {
            const int g = t->facet[seen[i]].neighbour[edge];
            if (t->facet[g].seen != round && mcd_dot(t->facet[g].normal, w) - t->facet[g].offset > t->epsilon) {
                t->facet[g].seen = round;
                seen[count++] = g;
            }
        }
    MEASSERT(count <= t->facetCount);
    return count;
}

/* Connects the new corner to the horizon of the visible facets. Returns false if the horizon is not one simple loop,
 * or a new facet is degenerate. */
static MeBool closeHorizon(Polytope *t, const int *seen, int count, int round, int corner) {
    int made = 0, first = -1;
    for (int i = 0; i < t->cornerCount; i++)
        t->facetFrom[i] = -1;
    for (int i = 0; i < count; i++)
        for (int edge = 0; edge < 3; edge++) {
            const Facet *f = &t->facet[seen[i]];
            const int outside = f->neighbour[edge], from = f->corner[edge], to = f->corner[(edge + 1) % 3];
            if (t->facet[outside].seen == round)
                continue;
            const int g = newFacet(t, from, to, corner);
            if (g < 0 || t->facetFrom[from] >= 0 || !makePlane(t, g))
                return MEFALSE;
            linkFacets(t, g, 0, outside);
            t->facetFrom[from] = g;
            first = g;
            made++;
        }
    int g = first, walked = 0;
    do {
        const int next = g < 0 ? -1 : t->facetFrom[t->facet[g].corner[1]];
        if (next < 0)
            return MEFALSE;
        t->facet[g].neighbour[1] = next;
        t->facet[next].neighbour[2] = g;
        g = next;
        walked++;
    } while (g != first && walked <= made);
    return walked == made;
}

static void removeVisible(Polytope *t, const int *seen, int count) {
    for (int i = 0; i < count; i++) {
        t->offset[seen[i]] = INFINITY;
        t->freeFacet[t->freeCount++] = seen[i];
    }
}

static int nearestFacet(const Polytope *t) {
    int best = -1;
    double min = INFINITY;
    for (int i = 0; i < t->facetCount; i++)
        if (t->offset[i] < min) {
            min = t->offset[i];
            best = i;
        }
    return best;
}

static void keepDirection(Polytope *t, const Facet *f, double support) {
    t->support = support;
    mcd_copy(t->normal, f->normal);
}

/* Expands the polytope until the plane of its nearest facet supports M. If rounding makes the polytope degenerate,
 * the result is the best plane so far: an upper bound of the depth, not the minimum. */
static void runEpa(const Pair *p, const McdProximity *guess, Polytope *t) {
    int seen[MAX_FACETS];
    t->support = t->error = INFINITY;
    for (int round = 0; t->cornerCount < MAX_CORNERS; round++) {
        const int nearest = nearestFacet(t);
        if (nearest < 0)
            return;
        const Facet f = t->facet[nearest];
        if (-guess->separation - f.offset <= p->guessTolerance && mcd_dot(guess->normal, f.normal) < -.99) {
            t->support = -guess->separation;
            mcd_scale(t->normal, guess->normal, -1);
            t->error = 0;
            return;
        }
        const int corner = t->cornerCount;
        minkowskiSupport(p, f.normal, &t->corner[corner]);
        const double *w = t->corner[corner].w, support = mcd_dot(f.normal, w);
        MEASSERT(support >= f.offset - p->tolerance ||
                 !mcd_areResolved(p->a, p->b)); /* M contains the facet's corners */
        if (support - f.offset <= p->tolerance) {
            keepDirection(t, &f, support);
            t->error = support - f.offset;
            return;
        }
        if (support < t->support)
            keepDirection(t, &f, support);
        const int count = findVisible(t, nearest, round, w, seen);
        t->cornerCount++;
        if (!closeHorizon(t, seen, count, round, corner))
            return;
        removeVisible(t, seen, count);
        MEVALIDATE(isClosed(t));
    }
}

/* ---- overlapping: the first tetrahedron ---------------------------------------------------------------------- */

/* The distance of w from the point, line or plane through the corners so far (1, 2 or 3). */
static double distanceFromHull(const Polytope *t, const double w[3]) {
    const double *p = t->corner[0].w;
    double x[3], y[3], z[3], n[3];
    mcd_sub(x, w, p);
    if (t->cornerCount == 1)
        return mcd_length(x);
    mcd_sub(y, t->corner[1].w, p);
    mcd_cross(n, y, x);
    if (t->cornerCount == 2)
        return mcd_length(n) / mcd_length(y);
    mcd_sub(z, t->corner[2].w, p);
    mcd_cross(n, y, z);
    return fabs(mcd_dot(n, x)) / mcd_length(n);
}

/* Directions orthogonal to the affine hull of the corners so far: of a point all six, of a line four, of a plane
 * two. Returns their number. */
static int orthogonalDirections(const Polytope *t, double d[6][3]) {
    double x[3], y[3], u[3], w[3];
    mcd_set(u, 1, 0, 0);
    mcd_set(w, 0, 1, 0);
    mcd_set(x, 0, 0, 1);
    int count = 3;
    if (t->cornerCount > 1) {
        mcd_sub(x, t->corner[1].w, t->corner[0].w);
        mcd_scale(x, x, 1 / mcd_length(x));
        mcd_basis(x, u, w);
        count = 2;
    }
    if (t->cornerCount > 2) {
        mcd_sub(y, t->corner[2].w, t->corner[0].w);
        mcd_cross(u, x, y);
        mcd_scale(u, u, 1 / mcd_length(u));
        count = 1;
    }
    const double *base[3] = {u, w, x};
    for (int i = 0; i < count; i++) {
        mcd_copy(d[2 * i], base[i]);
        mcd_scale(d[2 * i + 1], base[i], -1);
    }
    return 2 * count;
}

/* Adds the support point farthest from the affine hull of the corners so far; false if M has no extent in the
 * orthogonal directions. */
static MeBool addFarthestSupport(const Pair *p, Polytope *t) {
    double d[6][3], max = 0;
    const int count = orthogonalDirections(t, d);
    for (int i = 0; i < count; i++) {
        Corner c;
        minkowskiSupport(p, d[i], &c);
        const double away = distanceFromHull(t, c.w);
        if (away > max) {
            max = away;
            t->corner[t->cornerCount] = c;
        }
    }
    if (!(max > 2 * p->tolerance))
        return MEFALSE;
    MEASSERT(t->cornerCount < 4);
    t->cornerCount++;
    return METRUE;
}

/* The point of the tetrahedron's four facets nearest to the origin, with its weights. */
static Simplex nearestOfFacets(const Simplex *s) {
    Simplex best = {.squared = INFINITY};
    for (int omitted = 0; omitted < 4; omitted++)
        for (int turn = 1; turn < 4; turn++) { /* nearestSubSimplex() looks only at faces with the last corner */
            Simplex subSimplex = {.count = 0};
            for (int i = 0; i < 4; i++)
                if (i != omitted && i != (omitted + turn) % 4)
                    subSimplex.corner[subSimplex.count++] = s->corner[i];
            subSimplex.corner[subSimplex.count++] = s->corner[(omitted + turn) % 4];
            const Candidate nearest = nearestSubSimplex(&subSimplex);
            keepSubSimplex(&subSimplex, &nearest);
            if (subSimplex.squared < best.squared)
                best = subSimplex;
        }
    return best;
}

/* M is flat to within the tolerance (a point, line or planar polygon) and contains the origin: the depth is 0 and
 * each direction orthogonal to M is a normal. Convention for a plane: the normal with the larger separation; if
 * these are equal, the side from which its corners are counter-clockwise. For a line or a point: the first
 * orthogonal axis. The witness points are those of GJK's last simplex. */
static void reportFlat(const Pair *p, const Simplex *s, const Polytope *t, McdProximity *out) {
    double d[6][3];
    const int count = orthogonalDirections(t, d);
    for (int i = 0; i < count; i++) {
        const double along = mcd_separationAlong(p->a, p->b, d[i]);
        if (i == 0 || along > out->separation + p->tolerance) {
            out->separation = along;
            mcd_copy(out->normal, d[i]);
        }
    }
    const Simplex end = s->inside ? nearestOfFacets(s) : *s;
    const Corner *corner[3] = {&end.corner[0], &end.corner[1], &end.corner[2]};
    setWitnesses(corner, end.weight, end.count, out);
}

/* Makes the first tetrahedron: from those corners of GJK's last simplex that are well separated, completed by
 * support points. False if M is flat. */
static MeBool startPolytope(const Pair *p, const Simplex *s, Polytope *t) {
    t->cornerCount = t->facetCount = t->freeCount = 0;
    t->epsilon = .1 * p->tolerance;
    for (int i = 0; i < s->count; i++)
        if (!t->cornerCount || distanceFromHull(t, s->corner[i].w) > .02 * mcd_pairSize(p->a, p->b))
            t->corner[t->cornerCount++] = s->corner[i];
    while (t->cornerCount < 4)
        if (!addFarthestSupport(p, t))
            return MEFALSE;
    return makeTetrahedron(t);
}

/* The barycentric weights of a facet's corners where the line from the origin along d crosses its plane outward.
 * Returns the smallest weight: negative if the line passes outside the facet, -INFINITY if it does not cross the
 * plane outward. */
static double weightsOnLine(const Polytope *t, const Facet *f, const double d[3], double weight[3]) {
    double sum = 0, min = INFINITY, x[3];
    for (int i = 0; i < 3; i++) {
        mcd_cross(x, t->corner[f->corner[(i + 1) % 3]].w, t->corner[f->corner[(i + 2) % 3]].w);
        weight[i] = mcd_dot(x, d);
        sum += weight[i];
    }
    if (!(sum > 0))
        return -INFINITY;
    for (int i = 0; i < 3; i++) {
        weight[i] /= sum;
        min = MeMIN(min, weight[i]);
    }
    return min;
}

/* Finds the facet through which the line from the origin along the result's normal leaves the polytope, and the
 * weights of its corners there. One face of M is many coplanar facets, and the one that gave the result need not be
 * the one on this line. Facets farther out than the result are not on the line. If rounding leaves none: the centre
 * of the nearest facet. */
static int facetUnderOrigin(const Polytope *t, double weight[3]) {
    int best = MeMAX(nearestFacet(t), 0);
    double max = -INFINITY;
    mcd_set(weight, 1. / 3, 1. / 3, 1. / 3);
    for (int i = 0; i < t->facetCount; i++) {
        double here[3];
        if (t->offset[i] > t->support + t->epsilon)
            continue;
        const double min = weightsOnLine(t, &t->facet[i], t->normal, here);
        if (min > max) {
            max = min;
            best = i;
            mcd_copy(weight, here);
        }
    }
    return best;
}

/* Reports the result of EPA. Witness points: the points of the cores whose difference is the point of M's boundary
 * nearest to the origin. */
static void reportPenetration(const Polytope *t, McdProximity *out) {
    double weight[3], sum = 0;
    const int facet = facetUnderOrigin(t, weight);
    MEASSERT(t->facetCount > facet && t->support < INFINITY);
    for (int i = 0; i < 3; i++) {
        weight[i] = MeMAX(weight[i], 0);
        sum += weight[i];
    }
    mcd_scale(weight, weight, 1 / sum);
    const int *from = t->facet[facet].corner;
    const Corner *corner[3] = {&t->corner[from[0]], &t->corner[from[1]], &t->corner[from[2]]};
    setWitnesses(corner, weight, 3, out);
    mcd_scale(out->normal, t->normal, -1);
    out->separation = -t->support;
    correctWitnesses(out);
}

static void findPenetration(const Pair *p, const Simplex *s, const McdProximity *guess, McdProximity *out) {
    Polytope t;
    out->error = 0;
    if (!startPolytope(p, s, &t)) {
        reportFlat(p, s, &t, out);
        return;
    }
    runEpa(p, guess, &t);
    reportPenetration(&t, out);
    out->error = t.error;
}

/* GJK, and EPA if the cores overlap. Sets the error of the separation. */
static MeBool searchCores(const Pair *pair, double limit, const McdProximity *guess, McdProximity *p) {
    Simplex s = {.count = 0};
    double bound = p->separation;
    switch (runGjk(pair, limit, &s, &bound)) {
    case BEYOND_LIMIT:
        p->separation = bound;
        return MEFALSE;
    case SEPARATED:
        reportSeparated(&s, p);
        p->error = p->separation - bound;
        break;
    case OVERLAPPING:
        findPenetration(pair, &s, guess, p);
        break;
    }
    return p->separation <= limit;
}

/* A search with a larger tolerance, from which the polish makes the normal exact. False: beyond the limit. */
static MeBool findRoughly(Pair pair, double limit, const McdProximity *guess, McdProximity *p, MeBool *isExact) {
    const double exact = pair.tolerance;
    pair.tolerance = MeMAX(exact, rough * mcd_pairSize(pair.a, pair.b));
    const MeBool isFound = searchCores(&pair, limit, guess, p);
    *isExact = isFound && (mcd_polishNormal(pair.a, pair.b, p) || p->error <= exact);
    return isFound;
}

MeBool mcd_coreProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    const Pair pair = makePair(a, b);
    const MeBool isSampled = a->kind->isSampled || b->kind->isSampled;
    McdProximity guess;
    MeBool isExact = MEFALSE;
    mcd_guessFaces(a, b, &guess);
    mcd_guessSides(a, b, &guess);
    p->isGuess = 0;
    p->separation = guess.separation;
    if (guess.separation > limit)
        return MEFALSE;
    if (isSampled && !findRoughly(pair, limit, &guess, p, &isExact))
        return MEFALSE;
    if (!isExact && !searchCores(&pair, limit, &guess, p))
        return MEFALSE;
    if (isSampled && !isExact)
        mcd_polishNormal(a, b, p);
    return p->separation <= limit;
}
