/* Inside Mcd: the records of the built-in geometries. */
#ifndef MCD_GEOMETRIES_H
#define MCD_GEOMETRIES_H

#include "model/mcd_frame_i.h"

struct McdNull {
    McdGeometry head;
};

struct McdSphere {
    McdGeometry head;
    MeReal radius;
};

struct McdBox {
    McdGeometry head;
    MeVector3 radii; /* half extents */
};

struct McdPlane { /* z = 0 of its frame; below is inside */
    McdGeometry head;
};

struct McdCylinder { /* about z, centred at the origin */
    McdGeometry head;
    MeReal radius, halfHeight;
};

struct McdSphyl { /* about z, centred at the origin */
    McdGeometry head;
    MeReal radius, halfHeight; /* of the cylinder, without the half spheres */
};

struct McdCone { /* about z, possibly truncated; the centre of mass is at the origin */
    McdGeometry head;
    MeReal length, lowerRadius, upperRadius;
    MeReal lowerHeight; /* from the base up to the centre of mass */
};

struct McdConvexMesh {
    McdGeometry head;
    McdHull *hull;
    MeReal fatness;          /* all points within this distance of the hull belong to the shape */
    MeVector3 *publicVertex; /* the hull's vertices in MeReal, for programs */
};

typedef struct McdTriangleListRecord {
    McdTriangleList list; /* the public part: first */
    MeVector3 min, max;
    int room; /* capacity of list.list */
    McdTriangleListFnPtr generate;
    atomic_int hasWarned; /* about too small an array */
    atomic_int isInUse;   /* list.list is used by a query: other queries allocate their own array */
} McdTriangleListRecord;

struct McdRGHeightField { /* a grid along x and y with two triangles per cell; up is outside */
    McdGeometry head;
    const MeReal *height; /* the program's array: row after row of x */
    int xCount, yCount;
    MeReal xStep, yStep, x0, y0;
    MeReal low, high; /* of all heights, at the last update */
    MeU64 version;    /* counts updates */
};

typedef struct McdMeshRecord {
    McdGeometry head;
    struct McdMeshData *data; /* triangles and tree, which scaled copies share (mcd_mesh_data_i.h) */
    MeVector3 scale;
    MeVector3 low, high; /* of all triangles, scaled, at the last update */
    MeU64 version;       /* counts updates */
} McdMeshRecord;

typedef struct McdAggregateElement {
    McdGeometryID geometry;
    MeMatrix4 relTM; /* relative to the aggregate */
} McdAggregateElement;

struct McdAggregate {
    McdGeometry head;
    int count, max;
    McdAggregateElement *element;
};

/* A geometry as an aggregate, whose instances have children; null for other geometries. */
static inline const McdAggregate *mcd_asAggregate(const McdGeometry *g) {
    return g->type == kMcdGeometryTypeAggregate ? (const McdAggregate *)g : 0;
}

#endif
