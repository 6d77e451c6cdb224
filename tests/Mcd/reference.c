#include "reference.h"

#include <math.h>
#include <string.h>

#include "convex/mcd_vector_i.h"

static const double pi = 3.14159265358979323846;

const char *const shape_name[SHAPE_KINDS] = {"sphere", "sphyl", "box",      "cylinder",
                                             "cone",   "hull",  "fat hull", "triangle"};

/* ---- random ------------------------------------------------------------------------------------------ */

double random_unit(Random *r) {
    if (!r->state)
        r->state = 88172645463325252ull;
    r->state ^= r->state >> 12;
    r->state ^= r->state << 25;
    r->state ^= r->state >> 27;
    return (double)((r->state * 2685821657736338717ull) >> 11) / 9007199254740992.0;
}

double random_between(Random *r, double low, double high) {
    return low + (high - low) * random_unit(r);
}

void random_direction(Random *r, double out[3]) {
    const double z = random_between(r, -1, 1), angle = random_between(r, -pi, pi), k = sqrt(1 - z * z);
    mcd_set(out, k * cos(angle), k * sin(angle), z);
}

/* ---- hulls --------------------------------------------------------------------------------------------- */

enum {
    STORE = 2048,
    MAX_SIDES = 24,
    MAX_VERTICES = 2 * MAX_SIDES,
    MAX_FACES = 2 * MAX_SIDES,
    MAX_EDGES = 3 * MAX_SIDES
};

typedef struct StoredHull {
    McdHull hull;
    double vertex[MAX_VERTICES][3];
    McdHullFace face[MAX_FACES];
    int faceVertex[6 * MAX_SIDES], edge[MAX_EDGES][2], edgeFace[MAX_EDGES][2];
    int neighbourFirst[MAX_VERTICES + 1], neighbour[2 * MAX_EDGES];
} StoredHull;

static StoredHull store[STORE];
static int nextStored;

static StoredHull *newHull(void) {
    StoredHull *s = &store[nextStored++ % STORE];
    memset(s, 0, sizeof *s);
    s->hull.vertex = s->vertex;
    s->hull.face = s->face;
    s->hull.faceVertex = s->faceVertex;
    s->hull.edge = s->edge;
    s->hull.edgeFace = s->edgeFace;
    s->hull.neighbourFirst = s->neighbourFirst;
    s->hull.neighbour = s->neighbour;
    return s;
}

static void addVertex(McdHull *h, double x, double y, double z) {
    mcd_set(h->vertex[h->vertexCount++], x, y, z);
}

static void addFace(McdHull *h, const int *corner, int count) {
    McdHullFace *f = &h->face[h->faceCount];
    f->first = h->faceCount ? f[-1].first + f[-1].count : 0;
    f->count = count;
    memcpy(h->faceVertex + f->first, corner, (size_t)count * sizeof *corner);
    h->faceCount++;
}

static void addEdge(McdHull *h, int from, int to, int face) {
    for (int i = 0; i < h->edgeCount; i++)
        if (h->edge[i][0] == to && h->edge[i][1] == from) {
            h->edgeFace[i][1] = face;
            return;
        }
    h->edge[h->edgeCount][0] = from;
    h->edge[h->edgeCount][1] = to;
    h->edgeFace[h->edgeCount++][0] = face;
}

/* What follows from vertices and faces. */
static const McdHull *finish(McdHull *h) {
    for (int i = 0; i < h->faceCount; i++) {
        McdHullFace *f = &h->face[i];
        const int *v = h->faceVertex + f->first;
        double x[3], y[3];
        mcd_sub(x, h->vertex[v[1]], h->vertex[v[0]]);
        mcd_sub(y, h->vertex[v[2]], h->vertex[v[0]]);
        mcd_cross(f->normal, x, y);
        mcd_scale(f->normal, f->normal, 1 / mcd_length(f->normal));
        f->offset = mcd_dot(f->normal, h->vertex[v[0]]);
        for (int k = 0; k < f->count; k++)
            addEdge(h, v[k], v[(k + 1) % f->count], i);
    }
    int count = 0;
    for (int i = 0; i < h->vertexCount; i++) {
        h->neighbourFirst[i] = count;
        for (int e = 0; e < h->edgeCount; e++)
            for (int k = 0; k < 2; k++)
                if (h->edge[e][k] == i)
                    h->neighbour[count++] = h->edge[e][1 - k];
        for (int k = 0; k < 3; k++)
            h->centre[k] += h->vertex[i][k] / h->vertexCount;
    }
    h->neighbourFirst[h->vertexCount] = count;
    for (int i = 0; i < h->vertexCount; i++)
        h->extent = fmax(h->extent, sqrt(mcd_distanceSquared(h->vertex[i], h->centre)));
    return h;
}

const McdHull *hull_prism(int sides, double radius, double halfHeight) {
    McdHull *h = &newHull()->hull;
    int top[MAX_SIDES], bottom[MAX_SIDES];
    for (int i = 0; i < sides; i++) {
        const double angle = 2 * pi * i / sides;
        addVertex(h, radius * cos(angle), radius * sin(angle), -halfHeight);
        addVertex(h, radius * cos(angle), radius * sin(angle), halfHeight);
        top[i] = 2 * i + 1;
        bottom[sides - 1 - i] = 2 * i;
    }
    addFace(h, top, sides);
    addFace(h, bottom, sides);
    for (int i = 0; i < sides; i++) {
        const int j = (i + 1) % sides, side[4] = {2 * i, 2 * j, 2 * j + 1, 2 * i + 1};
        addFace(h, side, 4);
    }
    return finish(h);
}

const McdHull *hull_pyramids(int sides, double radius, double halfHeight) {
    McdHull *h = &newHull()->hull;
    for (int i = 0; i < sides; i++)
        addVertex(h, radius * cos(2 * pi * i / sides), radius * sin(2 * pi * i / sides), 0);
    addVertex(h, 0, 0, halfHeight);
    addVertex(h, 0, 0, -halfHeight);
    for (int i = 0; i < sides; i++) {
        const int j = (i + 1) % sides, up[3] = {i, j, sides}, down[3] = {j, i, sides + 1};
        addFace(h, up, 3);
        addFace(h, down, 3);
    }
    return finish(h);
}

const McdHull *hull_points(int count, const double radii[3], Random *r) {
    static McdHull *made[STORE];
    static int next;
    double point[MAX_SIDES][3];
    for (int i = 0; i < count; i++) {
        random_direction(r, point[i]);
        for (int k = 0; k < 3; k++)
            point[i][k] *= radii[k];
    }
    if (made[next % STORE])
        mcd_hullDestroy(made[next % STORE]);
    return made[next++ % STORE] = mcd_hullCreate((const double(*)[3])point, count, "hull_points");
}

/* ---- shapes -------------------------------------------------------------------------------------------- */

/* The table of a type, which a framework knows. */
static const McdKind *kindOf(int type) {
    static McdFrameworkID frame;
    if (!frame) {
        frame = McdInit(0, 1, 1, 1);
        McdAllRegisterTypes(frame);
    }
    return frame->types[type].kind;
}

static void start(McdShape *s, int type) {
    memset(s, 0, sizeof *s);
    s->kind = kindOf(type);
    for (int i = 0; i < 3; i++)
        s->axis[i][i] = 1;
}

void shape_box(McdShape *s, double x, double y, double z) {
    start(s, kMcdGeometryTypeBox);
    mcd_set(s->size, x, y, z);
    s->extent = mcd_length(s->size);
}

void shape_cylinder(McdShape *s, double radius, double halfHeight) {
    start(s, kMcdGeometryTypeCylinder);
    mcd_set(s->size, radius, radius, 2 * halfHeight);
    s->low = halfHeight;
    s->extent = hypot(radius, halfHeight);
}

void shape_cone(McdShape *s, double lower, double upper, double length) {
    start(s, kMcdGeometryTypeCone);
    mcd_set(s->size, lower, upper, length);
    s->low = length / 3;
    s->extent = fmax(hypot(lower, length / 3), hypot(upper, length * 2 / 3));
}

void shape_sphyl(McdShape *s, double radius, double halfHeight) {
    start(s, kMcdGeometryTypeSphyl);
    s->low = halfHeight;
    s->rounding = radius;
    s->extent = radius + halfHeight;
}

void shape_sphere(McdShape *s, double radius) {
    start(s, kMcdGeometryTypeSphere);
    s->rounding = s->extent = radius;
}

void shape_hull(McdShape *s, const McdHull *hull, double fatness) {
    start(s, kMcdGeometryTypeConvexMesh);
    s->hull = hull;
    s->rounding = fatness;
    s->extent = mcd_length(hull->centre) + hull->extent + fatness;
}

void shape_random(McdShape *s, int kind, double scale, MeBool slab, Random *r) {
    double x[3];
    for (int i = 0; i < 3; i++)
        x[i] = scale * random_between(r, .3, 1);
    if (slab)
        x[2] = fmax(x[0], x[1]) / 50;
    const int sides = 3 + (int)((MAX_SIDES - 2) * random_unit(r));
    const MeBool isPrism = random_unit(r) < .5;
    switch (kind) {
    case SHAPE_SPHERE:
        shape_sphere(s, x[0]);
        break;
    case SHAPE_SPHYL:
        shape_sphyl(s, slab ? x[2] : x[0], x[1]);
        break;
    case SHAPE_BOX:
        shape_box(s, x[0], x[1], x[2]);
        break;
    case SHAPE_CYLINDER:
        shape_cylinder(s, x[0], x[2]);
        break;
    case SHAPE_CONE:
        shape_cone(s, x[0], isPrism ? 0 : x[0] / 2, x[2]);
        break;
    case SHAPE_TRIANGLE: {
        double corners[3][3];
        for (int i = 0; i < 3; i++)
            mcd_set(corners[i], x[0] * cos(2 * i + x[1]), x[1] * sin(2 * i + x[1]), 0);
        mcd_triangleShape((const double(*)[3])corners, s);
        break;
    }
    default: {
        const McdHull *hull = sides > 16 ? hull_points(sides, x, r)
                              : isPrism  ? hull_prism(sides, x[0], x[2])
                                         : hull_pyramids(sides, x[0], x[2]);
        shape_hull(s, hull, kind == SHAPE_FAT_HULL ? .1 * x[2] : 0);
    }
    }
}

static void rotateVector(double v[3], const double axis[3], double angle) {
    /* Rodrigues; 1 - cos as 2 sin^2, for angles that are very small. */
    double x[3], y[3];
    const double half = sin(angle / 2);
    mcd_cross(x, axis, v);
    mcd_cross(y, axis, x);
    mcd_mad(v, v, sin(angle), x);
    mcd_mad(v, v, 2 * half * half, y);
}

void shape_rotate(McdShape *s, const double axis[3], double angle) {
    for (int i = 0; i < 3; i++) {
        rotateVector(s->axis[i], axis, angle);
        rotateVector(s->corner[i], axis, angle);
    }
    rotateVector(s->place, axis, angle);
}

void shape_rotateRandomly(McdShape *s, Random *r) {
    for (int i = 0; i < 2; i++) {
        double axis[3];
        random_direction(r, axis);
        shape_rotate(s, axis, random_between(r, -pi, pi));
    }
}

void shape_move(McdShape *s, double x, double y, double z) {
    const double d[3] = {x, y, z};
    mcd_mad(s->place, s->place, 1, d);
    for (int i = 0; i < 3; i++)
        mcd_mad(s->corner[i], s->corner[i], 1, d);
}

/* ---- polyhedra: corners, face normals, edges ------------------------------------------------------------- */

typedef struct Solid {
    int corners, normals, edges;
    double corner[MAX_VERTICES][3], normal[MAX_FACES + 6][3], edge[MAX_EDGES + 3][3];
} Solid;

static void toWorld(const McdShape *s, const double own[3], MeBool isPlace, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (isPlace ? s->place[i] : 0) + s->axis[0][i] * own[0] + s->axis[1][i] * own[1] + s->axis[2][i] * own[2];
}

/* The corners of round shapes are none, and their own axes stand for normals and edges. */
static void makeSolid(const McdShape *s, Solid *x) {
    memset(x, 0, sizeof *x);
    if (s->kind->rank == MCD_RANK_TRIANGLE) {
        for (int i = 0; i < 3; i++) {
            mcd_copy(x->corner[x->corners++], s->corner[i]);
            mcd_sub(x->edge[x->edges++], s->corner[(i + 1) % 3], s->corner[i]);
        }
        mcd_cross(x->normal[x->normals++], x->edge[0], x->edge[1]);
        for (int i = 0; i < 3; i++) /* also the sides, for what lies in its plane */
            mcd_cross(x->normal[x->normals++], x->edge[i], x->normal[0]);
    } else if (s->hull) {
        const McdHull *h = s->hull;
        for (int i = 0; i < h->vertexCount; i++)
            toWorld(s, h->vertex[i], 1, x->corner[x->corners++]);
        for (int i = 0; i < h->faceCount; i++)
            toWorld(s, h->face[i].normal, 0, x->normal[x->normals++]);
        for (int i = 0; i < h->edgeCount; i++)
            mcd_sub(x->edge[x->edges++], x->corner[h->edge[i][1]], x->corner[h->edge[i][0]]);
    } else {
        for (int i = 0; i < 3; i++) {
            mcd_copy(x->normal[x->normals++], s->axis[i]);
            mcd_copy(x->edge[x->edges++], s->axis[i]);
        }
        for (int i = 0; i < 8 && s->kind->type == kMcdGeometryTypeBox; i++) {
            const double own[3] = {i & 1 ? s->size[0] : -s->size[0], i & 2 ? s->size[1] : -s->size[1],
                                   i & 4 ? s->size[2] : -s->size[2]};
            toWorld(s, own, 1, x->corner[x->corners++]);
        }
    }
}

static void support(const McdShape *s, const Solid *x, const double n[3], double out[3]) {
    double d[3], best = -INFINITY;
    for (int i = 0; i < x->corners; i++)
        if (mcd_dot(x->corner[i], n) > best) {
            best = mcd_dot(x->corner[i], n);
            mcd_copy(out, x->corner[i]);
        }
    for (int i = 0; i < 3; i++)
        d[i] = mcd_dot(s->axis[i], n);
    const double across = hypot(d[0], d[1]);
    double radius[2] = {0, 0}, height[2] = {0, 0};
    if (s->kind->type == kMcdGeometryTypeCylinder || s->kind->type == kMcdGeometryTypeCone) {
        radius[0] = s->size[0];
        radius[1] = s->size[1];
        height[0] = -s->low;
        height[1] = s->size[2] - s->low;
    } else if (s->kind->type == kMcdGeometryTypeSphyl) {
        height[1] = s->low;
        height[0] = -height[1];
    }
    for (int i = 0; i < 2 && !x->corners; i++) {
        const double own[3] = {across > 0 ? radius[i] * d[0] / across : 0, across > 0 ? radius[i] * d[1] / across : 0,
                               height[i]};
        double p[3];
        toWorld(s, own, 1, p);
        if (mcd_dot(p, n) > best) {
            best = mcd_dot(p, n);
            mcd_copy(out, p);
        }
    }
    mcd_mad(out, out, s->rounding, n);
}

void reference_support(const McdShape *s, const double n[3], double out[3]) {
    Solid x;
    makeSolid(s, &x);
    support(s, &x, n, out);
}

/* Two shapes, made ready for many questions. */
typedef struct Both {
    const McdShape *a, *b;
    Solid x, y;
} Both;

static void makeBoth(const McdShape *a, const McdShape *b, Both *both) {
    both->a = a;
    both->b = b;
    makeSolid(a, &both->x);
    makeSolid(b, &both->y);
}

static double along(const Both *both, const double n[3]) {
    const double back[3] = {-n[0], -n[1], -n[2]};
    double x[3], y[3];
    support(both->a, &both->x, back, x);
    support(both->b, &both->y, n, y);
    return mcd_dot(x, n) - mcd_dot(y, n);
}

double reference_along(const McdShape *a, const McdShape *b, const double n[3]) {
    Both both;
    makeBoth(a, b, &both);
    return along(&both, n);
}

/* ---- directions ---------------------------------------------------------------------------------------- */

static void tryDirection(const Both *both, const double d[3], double *best, double normal[3]) {
    const double length = mcd_length(d);
    if (!(length > 1e-12))
        return;
    for (int sign = -1; sign < 2; sign += 2) {
        double n[3];
        mcd_scale(n, d, sign / length);
        const double s = along(both, n);
        if (s > *best) {
            *best = s;
            mcd_copy(normal, n);
        }
    }
}

/* The same for polyhedra, whose corners are at hand. */
static void trySolids(const Solid *x, const Solid *y, const double d[3], double shortest, double *best,
                      double normal[3]) {
    const double length = mcd_length(d);
    if (!(length > shortest))
        return;
    double lowX = INFINITY, highX = -INFINITY, lowY = INFINITY, highY = -INFINITY;
    for (int i = 0; i < x->corners; i++) {
        const double t = mcd_dot(x->corner[i], d) / length;
        lowX = fmin(lowX, t);
        highX = fmax(highX, t);
    }
    for (int i = 0; i < y->corners; i++) {
        const double t = mcd_dot(y->corner[i], d) / length;
        lowY = fmin(lowY, t);
        highY = fmax(highY, t);
    }
    if (lowX - highY > *best) {
        *best = lowX - highY;
        mcd_scale(normal, d, 1 / length);
    }
    if (lowY - highX > *best) {
        *best = lowY - highX;
        mcd_scale(normal, d, -1 / length);
    }
}

double reference_axes(const McdShape *a, const McdShape *b, double normal[3]) {
    Solid x, y;
    double best = -INFINITY, d[3];
    makeSolid(a, &x);
    makeSolid(b, &y);
    for (int i = 0; i < x.normals + y.normals; i++)
        trySolids(&x, &y, i < x.normals ? x.normal[i] : y.normal[i - x.normals], 0, &best, normal);
    for (int i = 0; i < x.edges; i++)
        for (int j = 0; j < y.edges; j++) {
            mcd_cross(d, x.edge[i], y.edge[j]);
            trySolids(&x, &y, d, 1e-11 * mcd_length(x.edge[i]) * mcd_length(y.edge[j]), &best, normal);
        }
    return best - a->rounding - b->rounding;
}

/* Moves a direction to better ones around it, ever nearer, looking along other lines before it comes nearer: what it
 * climbs has sharp ridges. */
static void search(const Both *both, double reach, double *best, double normal[3]) {
    int failures = 0;
    for (double r = reach, turn = 0; r > 1e-9; turn += .07) {
        double u[3], w[3], n[3];
        const double before = *best;
        mcd_basis(normal, u, w);
        double next[3];
        mcd_copy(next, normal);
        for (int i = 0; i < 16; i++) {
            mcd_mad(n, normal, r * cos(i * pi / 8 + turn), u);
            mcd_mad(n, n, r * sin(i * pi / 8 + turn), w);
            mcd_scale(n, n, 1 / mcd_length(n));
            const double s = along(both, n);
            if (s > *best) {
                *best = s;
                mcd_copy(next, n);
            }
        }
        mcd_copy(normal, next);
        if (*best > before + 1e-12 * both->a->extent) {
            failures = 0;
        } else if (++failures == 5) {
            failures = 0;
            r *= .5;
        }
    }
}

double reference_distance(const McdShape *a, const McdShape *b, int directions, double normal[3]) {
    enum { BEST = 4 };
    Both pair;
    const Both *both = &pair;
    const Solid *x = &pair.x, *y = &pair.y;
    double d[3], best = -INFINITY;
    double top[BEST], topNormal[BEST][3];
    makeBoth(a, b, &pair);
    for (int i = 0; i < BEST; i++)
        top[i] = -INFINITY;
    mcd_sub(d, a->place, b->place);
    tryDirection(both, d, &best, normal);
    for (int i = 0; i < x->normals + y->normals; i++)
        tryDirection(both, i < x->normals ? x->normal[i] : y->normal[i - x->normals], &best, normal);
    for (int i = 0; i < x->edges; i++)
        for (int j = 0; j < y->edges && x->edges * y->edges < 200; j++) {
            mcd_cross(d, x->edge[i], y->edge[j]);
            tryDirection(both, d, &best, normal);
        }
    for (int i = 0; i < directions; i++) {
        const double z = 1 - (2 * i + 1.) / directions, k = sqrt(1 - z * z), angle = i * 2.39996322972865332;
        mcd_set(d, k * cos(angle), k * sin(angle), z);
        const double s = along(both, d);
        int place = -1;
        for (int j = 0; j < BEST; j++) /* near one of the best: instead of it; else instead of the worst */
            if (top[j] > -INFINITY && mcd_dot(topNormal[j], d) > .9)
                place = j;
        if (place < 0) {
            place = 0;
            for (int j = 1; j < BEST; j++)
                if (top[j] < top[place])
                    place = j;
        }
        if (s > top[place]) {
            top[place] = s;
            mcd_copy(topNormal[place], d);
        }
    }
    for (int j = 0; j < BEST; j++) {
        search(both, .1, &top[j], topNormal[j]);
        if (top[j] > best) {
            best = top[j];
            mcd_copy(normal, topNormal[j]);
        }
    }
    search(both, .01, &best, normal);
    return best;
}

double reference_outside(const McdShape *s, const double point[3]) {
    Solid x;
    double max = -INFINITY;
    makeSolid(s, &x);
    for (int i = 0; i < x.normals; i++)
        for (int sign = -1; sign < 2; sign += 2) {
            double n[3], top[3];
            mcd_scale(n, x.normal[i], sign / mcd_length(x.normal[i]));
            reference_support(s, n, top);
            max = fmax(max, mcd_dot(point, n) - mcd_dot(top, n));
        }
    return max;
}
