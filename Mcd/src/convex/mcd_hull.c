/* The convex hull of points, by Qhull: faces, edges, and the neighbours of each vertex.
 *
 * Qhull gets points that are centred and scaled to unit size, so that a hull of 1 mm is made like one of 1 km. Its
 * result is simplified with a tolerance well below the resolution of collision: equal points are merged, coplanar
 * facets become one polygon, and vertices within a face or an edge are removed. Finally everything is sorted into an
 * order that depends only on the order of the points. */
#define _POSIX_C_SOURCE 200809L /* fmemopen */
#include "convex/mcd_shape_i.h"
#include "convex/mcd_vector_i.h"

#include <float.h>
#include <limits.h>
#include <setjmp.h>
#include <stdio.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#endif
#include "libqhull_r/qhull_ra.h"
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

/* Lengths relative to half the longest side of the bounding box. Single precision leaves about 1e-7 of noise in the
 * coordinates of a face's corners. */
static const double flatness = 3e-7; /* points nearer than this to a plane or a line count as lying in it */

/* ---- temporary memory ------------------------------------------------------------------------------------------ */

typedef struct Block {
    struct Block *next;
    double contents[];
} Block;

typedef struct Work {
    const char *function; /* for messages */
    Block *blocks;
    MeBool isExhausted;
} Work;

static void *allocate(Work *w, size_t count, size_t size) {
    Block *b = MeMemoryTake(1, sizeof(Block) + count * size, w->function, "making the hull");
    if (!b) {
        w->isExhausted = 1;
        return NULL;
    }
    b->next = w->blocks;
    w->blocks = b;
    return b->contents;
}

static int *allocateInts(Work *w, int count) {
    return allocate(w, (size_t)count, sizeof(int));
}

static void freeBlocks(Work *w) {
    while (w->blocks) {
        Block *b = w->blocks;
        w->blocks = b->next;
        MeMemoryGive(b);
    }
}

/* ---- vectors --------------------------------------------------------------------------------------------------- */

static double distance(const double a[3], const double b[3]) {
    return sqrt(mcd_distanceSquared(a, b));
}

/* The distance of p from the line through a and b, which differ. */
static double distanceToLine(const double p[3], const double a[3], const double b[3]) {
    double along[3], r[3];
    mcd_sub(along, b, a);
    mcd_sub(r, p, a);
    mcd_mad(r, r, -(mcd_dot(r, along) / mcd_dot(along, along)), along);
    return mcd_length(r);
}

/* ---- the points: checked, scaled, duplicates removed ------------------------------------------------------------- */

typedef struct Cloud {
    int count;
    double (*point)[3]; /* centred and scaled */
    int *source;        /* its index among the given points */
    double centre[3], scale;
} Cloud;

static MeBool arePointsInRange(const double (*point)[3], int count, const char *function) {
    for (int i = 0; i < count; i++)
        if (!mcd_isInRange3(point[i])) {
            MeWarning(0, "%s: vertex %d is not finite, or beyond %g", function, i, (double)FLT_MAX);
            return MEFALSE;
        }
    return METRUE;
}

static MeBool findScale(Cloud *c, const double (*point)[3], int count, const char *function) {
    c->scale = 0;
    for (int k = 0; k < 3; k++) {
        double low = point[0][k], high = low;
        for (int i = 1; i < count; i++) {
            low = fmin(low, point[i][k]);
            high = fmax(high, point[i][k]);
        }
        c->centre[k] = low / 2 + high / 2;
        c->scale = fmax(c->scale, high / 2 - low / 2);
    }
    if (c->scale > 1e-30 && c->scale < 1e30)
        return METRUE;
    MeWarning(0, c->scale > 1 ? "%s: the vertices are too far apart" : "%s: all vertices are in one place", function);
    return MEFALSE;
}

typedef struct Sortable {
    double x;
    int index;
} Sortable;

static int compareX(const void *a, const void *b) {
    const Sortable *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* What identifies an edge or a face, its vertices and more, and in the last number what it belongs to. */
typedef struct Key {
    int number[4];
} Key;

/* Compares the first three numbers, which are different in any two keys. */
static int compareNumbers(const void *a, const void *b) {
    const int *p = ((const Key *)a)->number, *q = ((const Key *)b)->number;
    int i = 0;
    while (i < 2 && p[i] == q[i])
        i++;
    return (p[i] > q[i]) - (p[i] < q[i]);
}

/* Marks each point that is the same as an earlier one to within `flatness`. */
static void markCopies(const double (*p)[3], Sortable *order, int count, char *isCopy) {
    for (int i = 0; i < count; i++) {
        order[i] = (Sortable){p[i][0], i};
        isCopy[i] = 0;
    }
    qsort(order, (size_t)count, sizeof *order, compareX);
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count && order[j].x - order[i].x <= flatness; j++) {
            const int a = order[i].index, b = order[j].index;
            if (!isCopy[a] && !isCopy[b] && distance(p[a], p[b]) <= flatness)
                isCopy[a > b ? a : b] = 1;
        }
}

static MeBool makeCloud(Work *w, Cloud *c, const double (*point)[3], int count) {
    if (!findScale(c, point, count, w->function))
        return MEFALSE;
    c->point = allocate(w, (size_t)count, sizeof *c->point);
    c->source = allocate(w, (size_t)count, sizeof *c->source);
    Sortable *order = allocate(w, (size_t)count, sizeof *order);
    char *isCopy = allocate(w, (size_t)count, 1);
    if (w->isExhausted)
        return MEFALSE;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            c->point[i][k] = (point[i][k] - c->centre[k]) / c->scale;
    markCopies(mcd_constRows(c->point), order, count, isCopy);
    c->count = 0;
    MEASSERT(!isCopy[0]); /* of duplicates the first point is kept */
    for (int i = 0; i < count; i++)
        if (!isCopy[i]) {
            memcpy(c->point[c->count], c->point[i], sizeof c->point[i]);
            c->source[c->count++] = i;
        }
    return METRUE;
}

/* ---- Qhull's facets --------------------------------------------------------------------------------------------- */

/* Polygons that form a closed surface, counter-clockwise seen from outside. */
typedef struct Facets {
    int count, cornerCount;
    int faceMax, cornerMax;
    int *first;  /* count + 1 indices into the corners */
    int *vertex; /* of each corner: a point of the cloud */
    int *face;   /* of each corner */
    int *twin;   /* of each corner: the half-edge twin, in the next face, of the edge that begins here */
    double (*normal)[3];
    double *area;
} Facets;

static int nextCorner(const Facets *f, int corner) {
    const int face = f->face[corner];
    return corner + 1 < f->first[face + 1] ? corner + 1 : f->first[face];
}

/* A convex surface on n points has at most 2 n - 4 faces and 3 n - 6 edges. */
static MeBool allocateFacets(Work *w, Facets *f, int points) {
    f->faceMax = 2 * points;
    f->cornerMax = 6 * points;
    f->first = allocateInts(w, f->faceMax + 1);
    f->normal = allocate(w, (size_t)f->faceMax, sizeof *f->normal);
    f->area = allocate(w, (size_t)f->faceMax, sizeof(double));
    f->vertex = allocateInts(w, f->cornerMax);
    f->face = allocateInts(w, f->cornerMax);
    f->twin = allocateInts(w, f->cornerMax);
    return !w->isExhausted;
}

/* Twice the area of a polygon, as a vector along its normal (Newell). */
static void areaVector(const double (*point)[3], const int *vertex, int count, double out[3]) {
    const double *first = point[vertex[0]]; /* the origin, which keeps small faces accurate */
    mcd_set(out, 0, 0, 0);
    for (int i = 0; i < count; i++) {
        double a[3], b[3], n[3];
        mcd_sub(a, point[vertex[i]], first);
        mcd_sub(b, point[vertex[(i + 1) % count]], first);
        mcd_cross(n, a, b);
        mcd_mad(out, out, 1, n);
    }
}

static void reverse(int *v, int count) {
    for (int i = 0, j = count - 1; i < j; i++, j--) {
        const int t = v[i];
        v[i] = v[j];
        v[j] = t;
    }
}

/* Copies one facet of Qhull's; false if it does not fit: then Qhull's result is broken. */
static MeBool addFacet(Facets *f, const Cloud *c, qhT *qh, facetT *facet) {
    setT *corners = qh_facet3vertex(qh, facet);
    const int size = qh_setsize(qh, corners);
    MeBool fits = f->count < f->faceMax && f->cornerCount + size <= f->cornerMax && size >= 3;
    if (fits) {
        int *v = f->vertex + f->cornerCount;
        for (int i = 0; i < size; i++)
            v[i] = qh_pointid(qh, ((vertexT *)corners->e[i].p)->point);
        double area[3];
        areaVector(mcd_constRows(c->point), v, size, area);
        if (mcd_dot(area, facet->normal) < 0)
            reverse(v, size);
        for (int i = 0; i < size; i++)
            f->face[f->cornerCount + i] = f->count;
        memcpy(f->normal[f->count], facet->normal, sizeof f->normal[0]);
        f->area[f->count] = mcd_length(area) / 2;
        f->cornerCount += size;
        f->first[++f->count] = f->cornerCount;
    }
    qh_settempfree(qh, &corners);
    return fits;
}

/* Copies all facets. Qhull reports errors by longjmp, so a target is set while its result is read. */
static MeBool readFacets(Facets *f, const Cloud *c, qhT *qh) {
    f->count = f->cornerCount = 0;
    f->first[0] = 0;
    if (setjmp(qh->errexit))
        return MEFALSE;
    qh->NOerrexit = False;
    facetT *facet;
    FORALLfacets if (!addFacet(f, c, qh, facet)) return MEFALSE;
    return METRUE;
}

static MeBool runQhull(Work *w, Facets *f, const Cloud *c, char *options) {
    char text[1024]; /* receives Qhull's messages, which are dropped */
    FILE *sink = fmemopen(text, sizeof text, "w");
    qhT *qh = MeMemoryTake(1, sizeof *qh, w->function, "Qhull");
    MeBool works = 0;
    w->isExhausted = w->isExhausted || !qh || !sink;
    if (!sink)
        MeFatalError(0, "%s: no memory for Qhull's messages", w->function);
    if (sink && qh) {
        int curlong, totlong;
        qh_zero(qh, sink);
        works = qh_new_qhull(qh, 3, c->count, c->point[0], False, options, NULL, sink) == 0 && readFacets(f, c, qh);
        qh->NOerrexit = True;
        qh_freeqhull(qh, !qh_ALL);
        qh_memfreeshort(qh, &curlong, &totlong);
    }
    MeMemoryGive(qh);
    if (sink)
        fclose(sink);
    return works;
}

/* ---- facets on either side of each edge -------------------------------------------------------------------------- */

static MeBool isSameEdge(const Key *a, const Key *b) {
    return a->number[0] == b->number[0] && a->number[1] == b->number[1];
}

/* Finds the twin of each corner; false if the surface is not closed. */
static MeBool joinFacets(Work *w, Facets *f) {
    Key *key = allocate(w, (size_t)f->cornerCount, sizeof *key); /* both vertices, the corner */
    if (!key || f->cornerCount % 2)
        return MEFALSE;
    for (int i = 0; i < f->cornerCount; i++) {
        const int a = f->vertex[i], b = f->vertex[nextCorner(f, i)];
        key[i] = (Key){{MeMIN(a, b), MeMAX(a, b), i}};
    }
    qsort(key, (size_t)f->cornerCount, sizeof *key, compareNumbers);
    for (int i = 0; i < f->cornerCount; i += 2) {
        const int a = key[i].number[2], b = key[i + 1].number[2];
        if (!isSameEdge(&key[i], &key[i + 1]) || f->vertex[a] == f->vertex[b] ||
            (i > 0 && isSameEdge(&key[i], &key[i - 1])))
            return MEFALSE;
        f->twin[a] = b;
        f->twin[b] = a;
        MEASSERT(f->face[a] != f->face[b]);
    }
    return METRUE;
}

/* ---- coplanar facets are merged into faces ----------------------------------------------------------------------- */

typedef struct Regions {
    int *of; /* of each facet: the facet that its region grew from */
    int *stack;
} Regions;

static MeBool isWithin(const Facets *f, const Cloud *c, int face, int seed) {
    const double *n = f->normal[seed], *origin = c->point[f->vertex[f->first[seed]]];
    for (int i = f->first[face]; i < f->first[face + 1]; i++)
        if (fabs(mcd_dot(n, c->point[f->vertex[i]]) - mcd_dot(n, origin)) > flatness)
            return MEFALSE;
    return mcd_dot(f->normal[face], n) > 0;
}

static void growRegion(const Facets *f, const Cloud *c, Regions *r, int seed) {
    int top = 0;
    r->of[seed] = seed;
    r->stack[top++] = seed;
    while (top > 0) {
        const int face = r->stack[--top];
        for (int i = f->first[face]; i < f->first[face + 1]; i++) {
            const int other = f->face[f->twin[i]];
            if (r->of[other] < 0 && isWithin(f, c, other, seed)) {
                r->of[other] = seed;
                r->stack[top++] = other;
            }
        }
    }
}

/* Grows regions of coplanar facets, from the largest facets first: their planes are the most exact. */
static MeBool makeRegions(Work *w, const Facets *f, const Cloud *c, Regions *r) {
    Sortable *order = allocate(w, (size_t)f->count, sizeof *order);
    r->of = allocateInts(w, f->count);
    r->stack = allocateInts(w, f->count);
    if (w->isExhausted)
        return MEFALSE;
    for (int i = 0; i < f->count; i++) {
        r->of[i] = -1;
        order[i] = (Sortable){-f->area[i], i};
    }
    qsort(order, (size_t)f->count, sizeof *order, compareX);
    for (int i = 0; i < f->count; i++)
        if (r->of[order[i].index] < 0)
            growRegion(f, c, r, order[i].index);
    return METRUE;
}

/* The border of each region as a linked list of corners. */
typedef struct Loops {
    int *next, *previous; /* of a facet's corner: the next corner of the region's border; -1: not on a border */
    int *start;           /* of a region: one corner of its border; -1: no region */
    int *size;
    int *degree; /* of a vertex: how many loops it is in */
} Loops;

static MeBool isBorder(const Facets *f, const Regions *r, int corner) {
    return r->of[f->face[corner]] != r->of[f->face[f->twin[corner]]];
}

static int nextBorder(const Facets *f, const Regions *r, int corner) {
    int next = nextCorner(f, corner);
    while (!isBorder(f, r, next))
        next = nextCorner(f, f->twin[next]);
    return next;
}

/* Links the border through a corner; returns its length. */
static int linkLoop(const Facets *f, const Regions *r, Loops *l, int start) {
    int corner = start, size = 0;
    do {
        const int next = nextBorder(f, r, corner);
        l->next[corner] = next;
        l->previous[next] = corner;
        corner = next;
        size++;
        MEASSERT(size <= f->cornerCount); /* the border is closed */
    } while (corner != start);
    return size;
}

/* Links the borders of all regions. A region whose border is not one simple loop, passing each vertex once, is
 * marked to be split into its facets: returns false then. */
static MeBool linkLoops(const Facets *f, Regions *r, Loops *l, int *seen, int pointCount) {
    MeBool isSound = 1;
    for (int i = 0; i < f->count; i++)
        l->start[i] = -1;
    for (int i = 0; i < f->cornerCount; i++)
        l->next[i] = -1;
    for (int i = 0; i < pointCount; i++)
        seen[i] = -1;
    for (int i = 0; i < f->cornerCount; i++) {
        const int region = r->of[f->face[i]];
        if (!isBorder(f, r, i) || l->next[i] >= 0 || region < 0)
            continue;
        MeBool isSimple = l->start[region] < 0;
        l->start[region] = i;
        l->size[region] = linkLoop(f, r, l, i);
        for (int k = 0, corner = i; k < l->size[region]; k++, corner = l->next[corner]) {
            isSimple = isSimple && seen[f->vertex[corner]] != region;
            seen[f->vertex[corner]] = region;
        }
        if (!isSimple) {
            isSound = 0;
            for (int k = 0; k < f->count; k++)
                if (r->of[k] == region)
                    r->stack[k] = 1;
        }
    }
    return isSound;
}

static MeBool makeLoops(Work *w, const Facets *f, const Cloud *c, Regions *r, Loops *l) {
    int *seen = allocateInts(w, c->count);
    l->next = allocateInts(w, f->cornerCount);
    l->previous = allocateInts(w, f->cornerCount);
    l->start = allocateInts(w, f->count);
    l->size = allocateInts(w, f->count);
    l->degree = allocateInts(w, c->count);
    if (w->isExhausted)
        return MEFALSE;
    memset(r->stack, 0, (size_t)f->count * sizeof(int)); /* from here on: whether a facet's region is to be split */
    if (linkLoops(f, r, l, seen, c->count))
        return METRUE;
    for (int i = 0; i < f->count; i++)
        if (r->stack[i])
            r->of[i] = i;
    return linkLoops(f, r, l, seen, c->count); /* a facet without a simple border: Qhull's hull is broken */
}

/* ---- vertices within edges are removed --------------------------------------------------------------------------- */

static void countDegrees(const Facets *f, const Cloud *c, Loops *l) {
    memset(l->degree, 0, (size_t)c->count * sizeof(int));
    for (int i = 0; i < f->count; i++)
        for (int k = 0, corner = l->start[i]; l->start[i] >= 0 && k < l->size[i]; k++, corner = l->next[corner])
            l->degree[f->vertex[corner]]++;
}

static MeBool isWithinEdge(const Facets *f, const Cloud *c, const Loops *l, int corner) {
    const double *a = c->point[f->vertex[l->previous[corner]]], *b = c->point[f->vertex[l->next[corner]]];
    return l->degree[f->vertex[corner]] == 2 && distanceToLine(c->point[f->vertex[corner]], a, b) <= flatness;
}

static void unlinkCorner(const Facets *f, const Regions *r, Loops *l, int corner) {
    const int region = r->of[f->face[corner]];
    l->next[l->previous[corner]] = l->next[corner];
    l->previous[l->next[corner]] = l->previous[corner];
    if (l->start[region] == corner)
        l->start[region] = l->next[corner];
    l->size[region]--;
}

/* For each vertex: its corners in (up to) two loops, or -1. */
static void findCorners(const Facets *f, const Loops *l, int (*corner)[2], int pointCount) {
    for (int i = 0; i < pointCount; i++)
        corner[i][0] = corner[i][1] = -1;
    for (int i = 0; i < f->count; i++)
        for (int k = 0, at = l->start[i]; l->start[i] >= 0 && k < l->size[i]; k++, at = l->next[at]) {
            int *of = corner[f->vertex[at]];
            of[of[0] >= 0] = at;
        }
}

static MeBool straightenEdges(Work *w, const Facets *f, const Cloud *c, const Regions *r, Loops *l) {
    int(*corner)[2] = allocate(w, (size_t)c->count, sizeof *corner);
    if (!corner)
        return MEFALSE;
    countDegrees(f, c, l);
    findCorners(f, l, corner, c->count);
    for (int v = 0; v < c->count; v++) {
        const int a = corner[v][0], b = corner[v][1];
        if (l->degree[v] != 2 || l->size[r->of[f->face[a]]] <= 3 || l->size[r->of[f->face[b]]] <= 3)
            continue;
        if (isWithinEdge(f, c, l, a)) {
            unlinkCorner(f, r, l, a);
            unlinkCorner(f, r, l, b);
            l->degree[v] = 0;
        }
    }
    return METRUE;
}

/* ---- the hull, in canonical order -------------------------------------------------------------------------------- */

/* One block of memory: the hull, then its arrays, arrays of doubles first. */
static McdHull *allocateHull(Work *w, int vertices, int faces, int corners) {
    const size_t v = (size_t)vertices, n = (size_t)faces, e = (size_t)corners / 2;
    const size_t bytes = sizeof(McdHull) + v * sizeof(double[3]) + n * sizeof(McdHullFace) +
                         (2 * e + 4 * e + v + 1 + 2 * e) * sizeof(int);
    McdHull *h = MeMemoryTake(1, bytes, w->function, "the hull");
    if (!h) {
        w->isExhausted = 1;
        return NULL;
    }
    h->vertexCount = vertices;
    h->faceCount = faces;
    h->edgeCount = corners / 2;
    h->vertex = (double(*)[3])(h + 1);
    h->face = (McdHullFace *)(h->vertex + v);
    h->faceVertex = (int *)(h->face + n);
    h->edge = (int(*)[2])(h->faceVertex + 2 * e);
    h->edgeFace = h->edge + e;
    h->neighbourFirst = (int *)(h->edgeFace + e);
    h->neighbour = h->neighbourFirst + v + 1;
    return h;
}

/* Sizes and order of the hull: which vertices are used, their new indices, and the faces in order. */
typedef struct Plan {
    int vertices, faces, corners;
    int *number; /* of a point of the cloud: its vertex in the hull; -1: none */
    int *region; /* of a face: its region */
} Plan;

/* Makes the loop begin at its vertex with the lowest index. */
static void beginAtFirstVertex(const Facets *f, Loops *l, int region) {
    int best = l->start[region];
    for (int k = 0, corner = best; k < l->size[region]; k++, corner = l->next[corner])
        if (f->vertex[corner] < f->vertex[best])
            best = corner;
    l->start[region] = best;
}

static MeBool planHull(Work *w, const Facets *f, const Cloud *c, Loops *l, Plan *p) {
    /* three vertices, which identify a face, since two faces share at most one edge; the region */
    Key *key = allocate(w, (size_t)f->count, sizeof *key);
    p->number = allocateInts(w, c->count);
    p->region = allocateInts(w, f->count);
    if (w->isExhausted)
        return MEFALSE;
    p->vertices = p->faces = p->corners = 0;
    for (int i = 0; i < f->count; i++)
        if (l->start[i] >= 0) {
            beginAtFirstVertex(f, l, i);
            const int a = l->start[i], b = l->next[a];
            key[p->faces++] = (Key){{f->vertex[a], f->vertex[b], f->vertex[l->next[b]], i}};
            p->corners += l->size[i];
        }
    qsort(key, (size_t)p->faces, sizeof *key, compareNumbers);
    for (int i = 0; i < p->faces; i++)
        p->region[i] = key[i].number[3];
    countDegrees(f, c, l);
    for (int i = 0; i < c->count; i++)
        p->number[i] = l->degree[i] > 0 ? p->vertices++ : -1;
    return METRUE;
}

static void fillVertices(McdHull *h, const Plan *p, const Cloud *c, const double (*point)[3]) {
    for (int i = 0; i < c->count; i++)
        if (p->number[i] >= 0)
            memcpy(h->vertex[p->number[i]], point[c->source[i]], sizeof h->vertex[0]);
    for (int k = 0; k < 3; k++) {
        h->centre[k] = 0;
        for (int i = 0; i < h->vertexCount; i++)
            h->centre[k] += (h->vertex[i][k] - c->centre[k]) / h->vertexCount;
        h->centre[k] += c->centre[k];
    }
    h->extent = 0;
    for (int i = 0; i < h->vertexCount; i++)
        h->extent = fmax(h->extent, distance(h->vertex[i], h->centre));
}

static void fillNormal(McdHullFace *face, const McdHull *h, const Cloud *c, const double spare[3]) {
    areaVector(mcd_constRows(h->vertex), h->faceVertex + face->first, face->count, face->normal);
    const double size = mcd_length(face->normal);
    for (int k = 0; k < 3; k++) /* the area of a sliver is mostly rounding: Qhull's normal is used */
        face->normal[k] = size > 1e-12 * c->scale * c->scale ? face->normal[k] / size : spare[k];
}

/* Each face's plane passes through the outermost vertex of its facets, including removed vertices, so that every
 * point lies on or behind it. */
static void fillOffsets(McdHull *h, const Facets *f, const Cloud *c, const Regions *r, const int *faceOf) {
    for (int i = 0; i < h->faceCount; i++)
        h->face[i].offset = -DBL_MAX;
    for (int i = 0; i < f->cornerCount; i++) {
        McdHullFace *face = &h->face[faceOf[r->of[f->face[i]]]];
        face->offset = fmax(face->offset, mcd_dot(face->normal, c->point[f->vertex[i]]));
    }
    for (int i = 0; i < h->faceCount; i++) {
        McdHullFace *face = &h->face[i];
        face->offset = mcd_dot(face->normal, c->centre) + c->scale * face->offset;
        for (int k = 0; k < face->count; k++)
            face->offset = fmax(face->offset, mcd_dot(face->normal, h->vertex[h->faceVertex[face->first + k]]));
    }
}

static void fillFaces(McdHull *h, const Plan *p, const Facets *f, const Cloud *c, const Regions *r, const Loops *l) {
    int corners = 0, *faceOf = r->stack; /* of a region: its face. The array is no longer needed for splitting */
    for (int i = 0; i < p->faces; i++) {
        const int region = p->region[i];
        McdHullFace *face = &h->face[i];
        faceOf[region] = i;
        face->first = corners;
        face->count = l->size[region];
        for (int k = 0, corner = l->start[region]; k < face->count; k++, corner = l->next[corner])
            h->faceVertex[corners++] = p->number[f->vertex[corner]];
        fillNormal(face, h, c, f->normal[region]);
    }
    fillOffsets(h, f, c, r, faceOf);
}

/* Fills the edges in the order of their vertices. The face whose border runs in the edge's direction is on its left. */
static MeBool fillEdges(Work *w, McdHull *h) {
    /* both vertices; 1 unless the face's border runs from the lower to the higher; the face */
    Key *half = allocate(w, 2 * (size_t)h->edgeCount, sizeof *half);
    if (!half)
        return MEFALSE;
    int n = 0;
    for (int i = 0; i < h->faceCount; i++)
        for (int k = 0; k < h->face[i].count; k++) {
            const int *v = h->faceVertex + h->face[i].first, a = v[k], b = v[(k + 1) % h->face[i].count];
            half[n++] = (Key){{MeMIN(a, b), MeMAX(a, b), a > b, i}};
        }
    qsort(half, (size_t)n, sizeof *half, compareNumbers);
    for (int i = 0; i < h->edgeCount; i++) {
        const Key *p = &half[2 * i], *q = p + 1;
        if (!isSameEdge(p, q) || p->number[2] || !q->number[2])
            return MEFALSE;
        h->edge[i][0] = p->number[0];
        h->edge[i][1] = p->number[1];
        h->edgeFace[i][0] = p->number[3];
        h->edgeFace[i][1] = q->number[3];
    }
    return METRUE;
}

static void fillNeighbours(McdHull *h) {
    int *first = h->neighbourFirst;
    memset(first, 0, ((size_t)h->vertexCount + 1) * sizeof *first);
    for (int i = 0; i < h->edgeCount; i++) {
        first[h->edge[i][0]]++;
        first[h->edge[i][1]]++;
    }
    for (int i = 0; i < h->vertexCount; i++)
        first[i + 1] += first[i];
    for (int i = h->edgeCount - 1; i >= 0; i--) { /* backwards from the ends, which leaves the first indices */
        h->neighbour[--first[h->edge[i][0]]] = h->edge[i][1];
        h->neighbour[--first[h->edge[i][1]]] = h->edge[i][0];
    }
    MEASSERT(first[0] == 0 && first[h->vertexCount] == 2 * h->edgeCount);
}

static McdHull *buildHull(Work *w, const Facets *f, const Cloud *c, const Regions *r, Loops *l,
                          const double (*point)[3]) {
    Plan p;
    if (!planHull(w, f, c, l, &p) || p.faces < 4)
        return NULL;
    McdHull *h = allocateHull(w, p.vertices, p.faces, p.corners);
    if (!h)
        return NULL;
    fillVertices(h, &p, c, point);
    fillFaces(h, &p, f, c, r, l);
    if (!fillEdges(w, h) || h->vertexCount - h->edgeCount + h->faceCount != 2) {
        mcd_hullDestroy(h);
        return NULL;
    }
    fillNeighbours(h);
    return h;
}

/* ---- public functions -------------------------------------------------------------------------------------------- */

/* Whether the hull is thick enough: thinner ones are refused as flat. The smallest width is across a face or between
 * two edges; widths across faces are exact enough here. */
static MeBool isThick(const McdHull *h, const Cloud *c) {
    const double min = 1e-6 * c->scale;
    for (int i = 0; i < h->faceCount; i++) {
        double width = 0;
        for (int k = 0; k < h->vertexCount && width < min; k++)
            width = fmax(width, h->face[i].offset - mcd_dot(h->face[i].normal, h->vertex[k]));
        if (width < min)
            return MEFALSE;
    }
    return METRUE;
}

/* For checks: all vertices are behind each face's plane, normals have length 1, and the centre is inside. */
static MeBool isConvex(const McdHull *h) {
    const double slack = 4 * flatness * h->extent;
    for (int i = 0; i < h->faceCount; i++) {
        const McdHullFace *face = &h->face[i];
        if (!mcd_isUnit(face->normal) || !(mcd_dot(face->normal, h->centre) < face->offset))
            return MEFALSE;
        for (int k = 0; k < h->vertexCount; k++)
            if (mcd_dot(face->normal, h->vertex[k]) > face->offset + slack)
                return MEFALSE;
    }
    return METRUE;
}

/* For checks: neighbours are mutual, no vertex is its own neighbour, and each edge joins two faces. */
static MeBool areNeighboursGood(const McdHull *h) {
    for (int v = 0; v < h->vertexCount; v++)
        for (int i = h->neighbourFirst[v]; i < h->neighbourFirst[v + 1]; i++) {
            const int other = h->neighbour[i];
            MeBool isMutual = 0;
            for (int k = h->neighbourFirst[other]; k < h->neighbourFirst[other + 1]; k++)
                isMutual = isMutual || h->neighbour[k] == v;
            if (other == v || !isMutual)
                return MEFALSE;
        }
    for (int i = 0; i < h->edgeCount; i++)
        if (h->edgeFace[i][0] == h->edgeFace[i][1] || h->edge[i][0] >= h->edge[i][1])
            return MEFALSE;
    return METRUE;
}

static McdHull *hullOfCloud(Work *w, const Cloud *c, const double (*point)[3], char *options) {
    Facets f;
    Regions r;
    Loops l;
    if (!allocateFacets(w, &f, c->count) || !runQhull(w, &f, c, options) || !joinFacets(w, &f) ||
        !makeRegions(w, &f, c, &r) || !makeLoops(w, &f, c, &r, &l) || !straightenEdges(w, &f, c, &r, &l))
        return NULL;
    McdHull *h = buildHull(w, &f, c, &r, &l, point);
    if (h && !isThick(h, c)) {
        mcd_hullDestroy(h);
        h = NULL;
    }
    return h;
}

McdHull *mcd_hullCreate(const double (*point)[3], int count, const char *function) {
    if (!point || count < 4 || count > INT_MAX / 64) {
        MeWarning(0, "%s: a hull has at least 4 vertices, not %d", function, point ? count : 0);
        return NULL;
    }
    if (!arePointsInRange(point, count, function))
        return NULL;
    Work w = {function, NULL, 0};
    Cloud c;
    McdHull *h = NULL;
    if (makeCloud(&w, &c, point, count)) {
        char plain[] = "qhull Pp", joggled[] = "qhull QJ Pp"; /* joggling gives triangles only */
        if (c.count >= 4)
            h = hullOfCloud(&w, &c, point, plain);
        if (c.count >= 4 && !h && !w.isExhausted)
            h = hullOfCloud(&w, &c, point, joggled);
        if (!h && !w.isExhausted)
            MeWarning(0, "%s: the vertices span no volume", function);
    }
    MEASSERT(!h || (h->faceCount >= 4 && h->vertexCount >= 4 && h->extent > 0));
    MEVALIDATE(!h || (isConvex(h) && areNeighboursGood(h)));
    freeBlocks(&w);
    return h;
}

void mcd_hullDestroy(McdHull *hull) {
    MeMemoryGive(hull);
}
