/* Cross-sections: the points where a plane cuts the edges of a convex solid, sorted by angle around their centre. */
#include "McdPlaneIntersect.h"

#include "convex/mcd_kind_i.h"
#include "pair/mcd_pair_i.h"
#include <stdlib.h>
#include <string.h>

typedef struct Corner {
    double position[3], angle;
} Corner;

typedef struct Slice {
    double normal[3], dist; /* the plane, in the instance's frame */
    Corner *corner;
    int count, room;
    MeBool isOutOfMemory; /* no more corners are added */
    const char *function; /* called by the program; for messages */
} Slice;

/* ---- collecting corners ---------------------------------------------------------------------- */

static void addCorner(Slice *s, const double position[3]) {
    if (s->isOutOfMemory)
        return;
    if (s->count == s->room) {
        const int room = MeMAX(2 * s->room, 32);
        if (!MeMemoryGrow(&s->corner, (size_t)s->count, (size_t)room, sizeof *s->corner, s->function, "corners")) {
            s->isOutOfMemory = METRUE;
            return;
        }
        s->room = room;
    }
    mcd_copy(s->corner[s->count++].position, position);
}

/* Adds the point where an edge crosses the plane; an end in the plane counts. */
static void cutEdge(void *context, const double from[3], const double to[3]) {
    Slice *s = context;
    const double a = mcd_dot(s->normal, from) - s->dist, b = mcd_dot(s->normal, to) - s->dist;
    if ((a > 0 && b > 0) || (a < 0 && b < 0))
        return;
    if (a == b) { /* both ends are in the plane */
        addCorner(s, from);
        addCorner(s, to);
        return;
    }
    double along[3], cut[3];
    mcd_sub(along, to, from);
    mcd_mad(cut, from, a / (a - b), along);
    MEASSERT(a / (a - b) >= 0 && a / (a - b) <= 1);
    addCorner(s, cut);
}

/* ---- sorting corners ------------------------------------------------------------------------- */

static int compareAngles(const void *p, const void *q) {
    const Corner *a = p, *b = q;
    return (a->angle > b->angle) - (a->angle < b->angle);
}

/* Removes duplicate corners. */
static void mergeCorners(Slice *s) {
    double largest = 0;
    int kept = 0;
    for (int i = 1; i < s->count; i++)
        largest = fmax(largest, mcd_distanceSquared(s->corner[i].position, s->corner[0].position));
    const double near = 1e-12 * largest; /* squared: a millionth of the largest distance */
    for (int i = 0; i < s->count; i++) {
        MeBool isNew = METRUE;
        for (int k = 0; k < kept && isNew; k++)
            isNew = mcd_distanceSquared(s->corner[i].position, s->corner[k].position) > near;
        if (isNew)
            s->corner[kept++] = s->corner[i];
    }
    s->count = kept;
}

static void sortCorners(Slice *s) {
    MeVector3 n, x, y;
    double middle[3] = {0, 0, 0};
    mcd_toReal(n, s->normal);
    MeVector3PlaneSpace(n, x, y);
    for (int i = 0; i < s->count; i++)
        mcd_mad(middle, middle, 1. / s->count, s->corner[i].position);
    for (int i = 0; i < s->count; i++) {
        double d[3], across = 0, up = 0;
        mcd_sub(d, s->corner[i].position, middle);
        for (int k = 0; k < 3; k++) {
            across += d[k] * (double)x[k];
            up += d[k] * (double)y[k];
        }
        s->corner[i].angle = atan2(up, across);
    }
    qsort(s->corner, (size_t)s->count, sizeof *s->corner, compareAngles);
}

/* ---- public functions ------------------------------------------------------------------------ */

static MeBool isValidQuery(McdGeometryInstanceID ins, const MeReal *normal, MeReal dist, int maxVert,
                           const int *numVert, MeVector3 *outVert, const char *function) {
    MeBool isFine = ins && normal && maxVert >= 3 && numVert && outVert && MeRealIsValid(dist);
    for (int i = 0; isFine && i < 3; i++)
        isFine = MeRealIsValid(normal[i]);
    if (!isFine || fabs((double)MeVector3Magnitude(normal) - 1) > 1e-3) {
        MeWarning(1, "%s: an argument is null or not finite, the normal has not length 1, or maxVert is %d (3 or more)",
                  function, maxVert);
        return MEFALSE;
    }
    if (!mcd_instanceTM(ins))
        MeWarning(1, "%s: the instance has no transform", function);
    return mcd_instanceTM(ins) != NULL;
}

/* normal . (R x + X) = dist  =>  (R^T normal) . x = dist - normal . X */
static void placePlane(Slice *s, const MeMatrix4Ptr tm, const MeReal *normal, MeReal dist) {
    s->dist = (double)dist;
    for (int i = 0; i < 3; i++) {
        s->normal[i] = 0;
        for (int k = 0; k < 3; k++)
            s->normal[i] += (double)tm[i][k] * (double)normal[k];
        s->dist -= (double)normal[i] * (double)tm[3][i];
    }
}

static void writeCorners(const Slice *s, const MeMatrix4Ptr tm, int maxVert, int *numVert, MeVector3 *outVert) {
    const int count = s->count < 3 ? 0 : MeMIN(s->count, maxVert); /* two corners: the plane only touches an edge */
    for (int i = 0; i < count; i++) {
        const double *p = s->corner[(int)((long long)i * s->count / count)].position;
        for (int k = 0; k < 3; k++)
            outVert[i][k] = (MeReal)((double)tm[3][k] + p[0] * (double)tm[0][k] + p[1] * (double)tm[1][k] +
                                     p[2] * (double)tm[2][k]);
    }
    *numVert = count;
}

static void computeSlice(McdGeometryInstanceID ins, const MeReal *normal, MeReal dist, int maxVert, int *numVert,
                         MeVector3 *outVert, const char *function) {
    Slice s = {.function = function};
    const McdGeometryID g = McdGeometryInstanceGetGeometry(ins);
    placePlane(&s, mcd_instanceTM(ins), normal, dist);
    const McdKind *kind = mcd_kindOf(g);
    if (kind && kind->edges)
        kind->edges(g, MeCLAMP(maxVert - 2, 3, 32), cutEdge, &s); /* of a cylinder: 3 to 32 sides */
    else
        MeWarning(1, "%s: the instance is no box, cylinder or convex mesh", function);
    if (s.count) {
        mergeCorners(&s);
        sortCorners(&s);
        writeCorners(&s, mcd_instanceTM(ins), maxVert, numVert, outVert);
    }
    MeMemoryGive(s.corner);
}

static void sliceOfType(McdGeometryInstanceID ins, int type, const MeReal *normal, MeReal dist, int maxVert,
                        int *numVert, MeVector3 *outVert, const char *function) {
    if (numVert)
        *numVert = 0;
    if (isValidQuery(ins, normal, dist, maxVert, numVert, outVert, function) &&
        (type < 0 || mcd_geometryIs(McdGeometryInstanceGetGeometry(ins), (McdGeometryType)type, function)))
        computeSlice(ins, normal, dist, maxVert, numVert, outVert, function);
}

void MEAPI McdBoxGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert, int *numVert,
                          MeVector3 *outVert) {
    sliceOfType(ins, kMcdGeometryTypeBox, normal, dist, maxVert, numVert, outVert, "McdBoxGetSlice");
}

void MEAPI McdCylinderGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                               int *numVert, MeVector3 *outVert) {
    sliceOfType(ins, kMcdGeometryTypeCylinder, normal, dist, maxVert, numVert, outVert, "McdCylinderGetSlice");
}

void MEAPI McdConvexMeshGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                 int *numVert, MeVector3 *outVert) {
    sliceOfType(ins, kMcdGeometryTypeConvexMesh, normal, dist, maxVert, numVert, outVert, "McdConvexMeshGetSlice");
}

void MEAPI McdGeometryInstanceGetSlice(McdGeometryInstanceID ins, const MeVector3 normal, MeReal dist, int maxVert,
                                       int *numVert, MeVector3 *outVert) {
    sliceOfType(ins, -1, normal, dist, maxVert, numVert, outVert, "McdGeometryInstanceGetSlice");
}
