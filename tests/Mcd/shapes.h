/* One of each solid, at a place, and what is inside of it by its definition: the reference for tests of geometries. */
#ifndef SHAPES_H
#define SHAPES_H

#include "frame.h"
#include "random_numbers.h"

enum { BALL, BOX, CYLINDER, SPHYL, CONE, CUT_CONE, TURNED_CONE, OCTAHEDRON, FAT_BOX, SOLIDS };

static inline McdFrameworkID framework(void) {
    McdFrameworkID f = frame_make(0, 100, 0, 1);
    McdPrimitivesRegisterTypes(f);
    McdNullRegisterType(f);
    McdConeRegisterType(f);
    McdConvexMeshRegisterType(f);
    McdSphereLineSegmentRegisterInteraction(f);
    McdBoxLineSegmentRegisterInteraction(f);
    McdPlaneLineSegmentRegisterInteraction(f);
    McdCylinderLineSegmentRegisterInteraction(f);
    McdSphylLineSegmentRegisterInteraction(f);
    McdConeLineSegmentRegisterInteraction(f);
    McdConvexMeshLineSegmentRegisterInteraction(f);
    return f;
}

/* Sizes, for a solid of about size 1. */
static const double boxSize[3] = {.7, .3, .5}, octahedronSize[3] = {.8, .4, .6}, fatSize[3] = {.4, .2, .3}, fat = .25;

static inline McdGeometryID boxMesh(McdFrameworkID f, const double half[3], double size, double fatness) {
    MeVector3 v[8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            v[i][k] = (MeReal)(size * ((i >> k & 1) ? half[k] : -half[k]));
    return McdConvexMeshCreateHull(f, (const MeVector3 *)v, 8, fatness * size);
}

static inline McdGeometryID octahedron(McdFrameworkID f, double size) {
    MeVector3 v[6] = {{0}};
    for (int i = 0; i < 6; i++)
        v[i][i / 2] = (MeReal)((i % 2 ? size : -size) * octahedronSize[i / 2]);
    return McdConvexMeshCreateHull(f, (const MeVector3 *)v, 6, 0);
}

static inline McdGeometryID cutCone(McdFrameworkID f, double length, double low, double high) {
    McdGeometryID g = McdConeCreate(f, 1, 1);
    McdConeSetGeometricalParameters(g, length, low, high);
    return g;
}

static inline McdGeometryID solid(McdFrameworkID f, int kind, double s) {
    switch (kind) {
    case BALL:
        return McdSphereCreate(f, .6 * s);
    case BOX:
        return McdBoxCreate(f, 2 * boxSize[0] * s, 2 * boxSize[1] * s, 2 * boxSize[2] * s);
    case CYLINDER:
        return McdCylinderCreate(f, .5 * s, 1.4 * s);
    case SPHYL:
        return McdSphylCreate(f, .3 * s, .8 * s);
    case CONE:
        return McdConeCreate(f, 1.5 * s, .7 * s);
    case CUT_CONE:
        return cutCone(f, 1.2 * s, .7 * s, .3 * s);
    case TURNED_CONE:
        return cutCone(f, .9 * s, .2 * s, .8 * s);
    case OCTAHEDRON:
        return octahedron(f, s);
    default:
        return boxMesh(f, fatSize, s, fat);
    }
}

static inline double coneExcess(const double p[3], double length, double low, double high) {
    const double base =
        -length / 4 * (low * low + 2 * low * high + 3 * high * high) / (low * low + low * high + high * high);
    const double up = (p[2] - base) / length, slope = (high - low) / length;
    const double side = (sqrt(p[0] * p[0] + p[1] * p[1]) - low - (high - low) * up) / sqrt(1 + slope * slope);
    return fmax(side, fmax(-up, up - 1) * length);
}

/* How far p is outside of the solid of size 1, or a lower bound; negative inside. */
static inline double excess(int kind, const double p[3]) {
    const double across = sqrt(p[0] * p[0] + p[1] * p[1]);
    double d = 0;
    switch (kind) {
    case BALL:
        return sqrt(across * across + p[2] * p[2]) - .6;
    case BOX:
        return fmax(fabs(p[0]) - boxSize[0], fmax(fabs(p[1]) - boxSize[1], fabs(p[2]) - boxSize[2]));
    case CYLINDER:
        return fmax(across - .5, fabs(p[2]) - .7);
    case SPHYL:
        d = fmax(fabs(p[2]) - .4, 0);
        return sqrt(across * across + d * d) - .3;
    case CONE:
        return coneExcess(p, 1.5, .7, 0);
    case CUT_CONE:
        return coneExcess(p, 1.2, .7, .3);
    case TURNED_CONE:
        return coneExcess(p, .9, .2, .8);
    case OCTAHEDRON:
        for (int k = 0; k < 3; k++)
            d += fabs(p[k]) / octahedronSize[k];
        return (d - 1) * .3; /* the slope is 1/.31 */
    default:
        for (int k = 0; k < 3; k++)
            d += pow(fmax(fabs(p[k]) - fatSize[k], 0), 2);
        return sqrt(d) - fat;
    }
}

/* A random turn and place. */
static inline void randomPlace(MeMatrix4 tm, double size) {
    MeVector4 q;
    for (int k = 0; k < 4; k++)
        q[k] = (MeReal)uniform(-1, 1);
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetRotationFromQuaternion(tm, q);
    for (int k = 0; k < 3; k++)
        tm[3][k] = (MeReal)(size * uniform(-2, 2));
}

/* A world point, in the solid's frame, as if the solid had the size 1. */
static inline void toShape(const MeVector4 *tm, const double p[3], double size, double out[3]) {
    for (int j = 0; j < 3; j++) {
        out[j] = 0;
        for (int i = 0; i < 3; i++)
            out[j] += (double)tm[j][i] * (p[i] - (double)tm[3][i]) / size;
    }
}

#endif
