/* What tests of surfaces share: a framework with all convex types, triangles in a list, and the contacts of one
 * model. */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "frame.h"

enum { TERRAIN_TRIANGLES = 40000, TERRAIN_FOUND = 4000, TERRAIN_CONTACTS = 64 };

typedef struct Terrain {
    MeVector3 vertex[TERRAIN_TRIANGLES];
    int triangle[TERRAIN_TRIANGLES][3];
    McdTriangleFlags flags[TERRAIN_TRIANGLES];
    int vertexCount, triangleCount;
    int backwards; /* hands the triangles over in the reverse order */
    int asked;
} Terrain;

static inline int terrain_isNear(const Terrain *t, int i, const MeReal *pos, MeReal radius) {
    for (int k = 0; k < 3; k++) {
        MeReal low = t->vertex[t->triangle[i][0]][k], high = low;
        for (int c = 1; c < 3; c++) {
            low = MeMIN(low, t->vertex[t->triangle[i][c]][k]);
            high = MeMAX(high, t->vertex[t->triangle[i][c]][k]);
        }
        if (low > pos[k] + radius || high < pos[k] - radius)
            return 0;
    }
    return 1;
}

static inline int MEAPI terrain_find(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius,
                                     int max) {
    Terrain *t = McdTriangleListGetUserData(McdModelGetGeometry(pair->model2));
    int count = 0;
    t->asked++;
    for (int n = 0; n < t->triangleCount && count < max; n++) {
        const int i = t->backwards ? t->triangleCount - 1 - n : n;
        if (!terrain_isNear(t, i, pos, radius))
            continue;
        for (int c = 0; c < 3; c++)
            triangle[count].vertices[c] = &t->vertex[t->triangle[i][c]];
        triangle[count].normal = 0;
        triangle[count].flags = t->flags[i];
        triangle[count].triangleData.ptr = t->triangle[i];
        count++;
    }
    return count;
}

/* Is it the triangleData of one of the triangles? */
static inline MeBool terrain_owns(const Terrain *t, const void *data) {
    for (int i = 0; i < t->triangleCount; i++)
        if (data == t->triangle[i])
            return METRUE;
    return MEFALSE;
}

static inline int terrain_vertex(Terrain *t, double x, double y, double z) {
    MeVector3Set(t->vertex[t->vertexCount], x, y, z);
    return t->vertexCount++;
}

static inline void terrain_triangle(Terrain *t, int a, int b, int c, int flags) {
    int *corner = t->triangle[t->triangleCount];
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    t->flags[t->triangleCount++] = (McdTriangleFlags)flags;
}

/* A grid of n x n cells of that size around the origin, its diagonals in alternating directions. */
static inline void terrain_grid(Terrain *t, int n, double cell, double (*height)(double x, double y), int flags) {
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            const double x = (i - n / 2) * cell, y = (j - n / 2) * cell;
            terrain_vertex(t, x, y, height ? height(x, y) : 0);
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            if ((i + j) % 2) {
                terrain_triangle(t, a, b, d, flags);
                terrain_triangle(t, a, d, c, flags);
            } else {
                terrain_triangle(t, a, b, c, flags);
                terrain_triangle(t, b, d, c, flags);
            }
        }
}

/* All convex types, lists, fields and meshes, and their interactions. */
static inline McdFrameworkID terrain_framework(void) {
    McdFrameworkID f = frame_make(0, 64, 256, 1);
    McdSphereRegisterType(f);
    McdBoxRegisterType(f);
    McdCylinderRegisterType(f);
    McdSphylRegisterType(f);
    McdConeRegisterType(f);
    McdConvexMeshRegisterType(f);
    McdTriangleListRegisterType(f);
    McdRGHeightFieldRegisterType(f);
    McdMeshRegisterType(f);
    ck_assert(McdSphereTriangleListRegisterInteraction(f) && McdBoxTriangleListRegisterInteraction(f));
    ck_assert(McdCylinderTriangleListRegisterInteraction(f) && McdSphylTriangleListRegisterInteraction(f));
    ck_assert(McdConvexMeshTriangleListRegisterInteraction(f) && McdConeTriangleListRegisterInteraction(f));
    ck_assert(McdSphereRGHeightFieldRegisterInteraction(f) && McdBoxRGHeightFieldRegisterInteraction(f));
    ck_assert(McdCylinderRGHeightFieldRegisterInteraction(f) && McdSphylRGHeightFieldRegisterInteraction(f));
    ck_assert(McdConvexMeshRGHeightFieldRegisterInteraction(f) && McdConeRGHeightFieldRegisterInteraction(f));
    ck_assert(McdMeshRegisterInteractions(f));
    return f;
}

static inline McdTriangleListID terrain_list(McdFrameworkID f, Terrain *t) {
    MeVector3 min = {0, 0, 0}, max = {0, 0, 0};
    for (int i = 0; i < t->vertexCount; i++) {
        MeVector3Min(min, min, t->vertex[i]);
        MeVector3Max(max, max, t->vertex[i]);
    }
    McdTriangleListID list = McdTriangleListCreate(f, min, max, TERRAIN_FOUND, terrain_find);
    McdTriangleListSetUserData(list, t);
    return list;
}

/* A mesh of the same triangles, on one side. */
static inline McdMeshID terrain_mesh(McdFrameworkID f, const Terrain *t) {
    return McdMeshCreate(f, (const MeVector3 *)t->vertex, t->vertexCount, &t->triangle[0][0], t->triangleCount, 0);
}

/* A model at a place, and what it is tested against. */
typedef struct Probe {
    McdModelID model, ground;
    MeMatrix4 tm, groundTM;
    McdModelPair made;
    McdModelPairID pair; /* made */
    McdContact contact[TERRAIN_CONTACTS];
    McdIntersectResult result;
} Probe;

static inline void probe_init(Probe *p, McdGeometryID g, McdGeometryID ground) {
    p->model = McdModelCreate(g);
    p->ground = McdModelCreate(ground);
    MeMatrix4TMMakeIdentity(p->tm);
    MeMatrix4TMMakeIdentity(p->groundTM);
    McdModelSetTransformPtr(p->model, p->tm);
    McdModelSetTransformPtr(p->ground, p->groundTM);
    memset(&p->made, 0, sizeof p->made);
    p->made.model1 = p->model;
    p->made.model2 = p->ground;
    p->pair = &p->made;
    McdHello(p->pair);
    p->result.contacts = p->contact;
    p->result.contactMaxCount = TERRAIN_CONTACTS;
}

static inline int probe_test(Probe *p) {
    McdModelUpdate(p->model);
    McdModelUpdate(p->ground);
    ck_assert(McdIntersect(p->pair, &p->result));
    return p->result.contactCount;
}

static inline int probe_at(Probe *p, double x, double y, double z) {
    MeMatrix4TMSetPosition(p->tm, x, y, z);
    return probe_test(p);
}

static inline void probe_term(Probe *p) {
    McdGoodbye(p->pair);
    McdModelDestroy(p->model);
    McdModelDestroy(p->ground);
}

#endif
