/* A geometry type of a program's own, for tests of what does not depend on shapes: a ball, with an interaction. */
#ifndef BLOB_H
#define BLOB_H

#include "McdFrame.h"
#include <string.h>

enum { BLOB = kMcdGeometryFirstUserType, OTHER_BLOB };

typedef struct Blob {
    McdGeometry head;
    MeReal radius;
    int *destroyed; /* counts; may be null */
} Blob;

static inline MeReal blobRadius(McdGeometryInstanceID ins) {
    return ((const Blob *)McdGeometryInstanceGetGeometry(ins))->radius;
}

static void MEAPI blobDestroy(McdGeometryID g) {
    if (((Blob *)g)->destroyed)
        ++*((Blob *)g)->destroyed;
    MeMemoryAPI.destroy(g);
}

static void MEAPI blobAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    const MeMatrix4Ptr tm = McdGeometryInstanceGetTransformPtr(ins);
    MeVector3 low, high;
    (void)tight;
    for (int i = 0; i < 3; i++) {
        const MeReal to = finalTM ? finalTM[3][i] : tm[3][i];
        low[i] = MeMIN(tm[3][i], to) - blobRadius(ins);
        high[i] = MeMAX(tm[3][i], to) + blobRadius(ins);
    }
    McdGeometryInstanceSetAABB(ins, low, high);
}

static void MEAPI blobBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius) {
    MeVector3Set(center, 0, 0, 0);
    *radius = ((const Blob *)g)->radius;
}

static inline void blobRegister(McdFrameworkID frame, McdGeometryType type) {
    static char blobName[] = "blob";
    McdFrameworkRegisterGeometryType(frame, type, blobName, blobDestroy, blobAABB, blobBSphere, 0, 0, 0);
}

static inline McdGeometryID blobCreate(McdFrameworkID frame, McdGeometryType type, MeReal radius, int *destroyed) {
    Blob *blob = MeMemoryAPI.create(sizeof *blob);
    McdGeometryInit(&blob->head, frame, type);
    blob->radius = radius;
    blob->destroyed = destroyed;
    return &blob->head;
}

/* One contact where two blobs overlap. The first must be a BLOB, whatever the second is. */
static inline int MEAPI blobIntersect(McdModelPair *p, McdIntersectResult *result) {
    const MeMatrix4Ptr a = McdModelGetTransformPtr(p->model1), b = McdModelGetTransformPtr(p->model2);
    McdContact *c = result->contacts;
    MeVector3 apart;
    MeVector3Subtract(apart, a[3], b[3]);
    const MeReal distance = MeVector3Magnitude(apart);
    const MeReal radius1 = blobRadius(McdModelGetGeometryInstance(p->model1));
    const MeReal gap = distance - radius1 - blobRadius(McdModelGetGeometryInstance(p->model2));
    result->contactCount = result->touch = gap <= 0;
    if (gap > 0)
        return 0;
    memset(c, 0, sizeof *c);
    MeVector3MultiplyScalar(c->normal, apart, 1 / distance);
    for (int i = 0; i < 3; i++)
        c->position[i] = a[3][i] - (radius1 + gap / 2) * c->normal[i];
    c->separation = gap;
    c->instance1 = McdModelGetGeometryInstance(p->model1);
    c->instance2 = McdModelGetGeometryInstance(p->model2);
    c->element1.tag = 1;
    c->element2.tag = 2;
    MeVector3Copy(result->normal, c->normal);
    return 1;
}

#endif
