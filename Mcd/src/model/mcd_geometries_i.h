/* Inside Mcd: what the built-in geometries are made of. */
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
    MeVector3 radii; /* half of its size along each axis */
};

struct McdPlane { /* z = 0 of its frame; below it is inside */
    McdGeometry head;
};

struct McdCylinder { /* about z, its middle at the origin */
    McdGeometry head;
    MeReal radius, halfHeight;
};

struct McdSphyl { /* a cylinder about z between two half balls */
    McdGeometry head;
    MeReal radius, halfHeight; /* of the cylinder, without the balls */
};

struct McdCone { /* about z, maybe cut off at the top; its centre of mass at the origin */
    McdGeometry head;
    MeReal length, lowerRadius, upperRadius;
    MeReal lowerHeight; /* from the base up to the centre of mass */
};

struct McdConvexMesh {
    McdGeometry head;
    McdHull *hull;
    MeReal fatness;   /* all points within it of the hull belong to the shape */
    MeVector3 *shown; /* the hull's vertices as programs see them */
};

typedef struct McdTriangleListRecord {
    McdTriangleList list; /* what programs see: first */
    MeVector3 min, max;
    int room; /* of list.list */
    McdTriangleListFnPtr generate;
    atomic_int hasWarned; /* that there is too little */
    atomic_int isInUse;   /* list.list, by a query: others take an array of their own */
} McdTriangleListRecord;

struct McdRGHeightField { /* a grid along x and y, two triangles a cell, outside is up */
    McdGeometry head;
    const MeReal *height; /* the program's: row after row of x */
    int xCount, yCount;
    MeReal xStep, yStep, x0, y0;
    MeReal low, high; /* of all heights, as of the last look */
    MeU64 version;    /* counts the looks */
};

typedef struct McdAggregateElement {
    McdGeometryID geometry;
    MeMatrix4 relTM; /* in the aggregate's frame */
} McdAggregateElement;

struct McdAggregate {
    McdGeometry head;
    int count, max;
    McdAggregateElement *element;
};

/* The aggregate that a geometry is, whose instances have children; null for all others. */
static inline const McdAggregate *mcd_childrenOf(const McdGeometry *g) {
    return g->type == kMcdGeometryTypeAggregate ? (const McdAggregate *)g : 0;
}

#endif
