/** @file McdGeometryTypes.h
 *  The built-in geometry types, and the triangles that programs supply.
 */
#ifndef MCDGEOMETRYTYPES_H
#define MCDGEOMETRYTYPES_H

#include "McdCTypes.h"

ME_BEGIN_C

/** The built-in types. The first numbers are Karma's. */
enum {
    kMcdGeometryTypeNull = 0,
    kMcdGeometryTypeSphere = 1,
    kMcdGeometryTypeBox = 2,
    kMcdGeometryTypePlane = 3,
    kMcdGeometryTypeCylinder = 4,
    kMcdGeometryTypeSphyl = 5,
    kMcdGeometryTypeTriangleList = 6,
    kMcdGeometryTypeConvexMesh = 7,
    kMcdGeometryTypeAggregate = 8,
    kMcdGeometryBuiltInTypes = 9 /**< Number of types of Karma 1.2; later ones are additions. */
};
enum {
    kMcdGeometryTypeCone = 9,
    kMcdGeometryTypeRGHeightField = 10,
    kMcdGeometryTypeMesh = 11,
    kMcdGeometryFirstUserType = 16 /**< A program's own types are numbered from here. */
};

typedef McdGeometryID McdNullID;
typedef McdGeometryID McdSphereID;
typedef McdGeometryID McdBoxID;
typedef McdGeometryID McdPlaneID;
typedef McdGeometryID McdCylinderID;
typedef McdGeometryID McdSphylID;
typedef McdGeometryID McdConeID;
typedef McdGeometryID McdConvexMeshID;
typedef McdGeometryID McdTriangleListID;
typedef McdGeometryID McdRGHeightFieldID;
typedef McdGeometryID McdMeshID;
typedef McdGeometryID McdAggregateID;

typedef struct McdNull McdNull;
typedef struct McdSphere McdSphere;
typedef struct McdBox McdBox;
typedef struct McdPlane McdPlane;
typedef struct McdCylinder McdCylinder;
typedef struct McdSphyl McdSphyl;
typedef struct McdCone McdCone;
typedef struct McdConvexMesh McdConvexMesh;
typedef struct McdTriangleList McdTriangleList;
typedef struct McdRGHeightField McdRGHeightField;
typedef struct McdAggregate McdAggregate;

/** How contacts with a triangle are made (User Guide ch. 4, "Triangle List"). */
typedef enum McdTriangleFlags {
    kMcdTriangleUseSmallestPenetration = 1, /**< The normal is that of the smallest penetration; else the triangle's. */
    kMcdTriangleTwoSided = 2,               /**< Both sides are outside; else only the side of the given normal. */
    kMcdTriangleUseEdge0 = 4,               /**< The edge from vertex 0 to 1 is sharp: it may have contacts. */
    kMcdTriangleUseEdge1 = 8,               /**< The edge from vertex 1 to 2. */
    kMcdTriangleUseEdge2 = 16,              /**< The edge from vertex 2 to 0. */
    kMcdTriangleUseEdges = 28,              /**< All edges. */
    kMcdTriangleStandard = 31               /**< All of these. */
} McdTriangleFlags;

/** A triangle as returned by a triangle list's callback. All in the list's own frame. */
typedef struct _McdUserTriangle McdUserTriangle;
struct _McdUserTriangle {
    MeVector3 *vertices[3]; /**< Corners; must remain valid during the query. */
    MeVector3 *normal;      /**< Outward, length 1. Null: computed from the corners by the right-hand rule. */
    McdTriangleFlags flags; /**< A sum of McdTriangleFlags. */
    /** The program's data; contacts with the triangle refer to it (McdContact.element1 or element2). A null ptr
     *  unless it is set. */
    McdElementData triangleData;
};

/** A triangle list: the part that programs may access (User Guide ch. 8). */
struct McdTriangleList {
    McdGeometry head;     /**< Not for programs. */
    int triangleMaxCount; /**< As McdTriangleListSetMaxTriangles sets it; applied at the next call of the callback. */
    /** The list's array, which the callback fills; its last triangles stay there. In a query from within another
     *  query's callback, or at the same time in another thread, the callback fills another array. */
    McdUserTriangle *list;
    void *userData; /**< The program's data: see McdTriangleListSetUserData. */
};

/**
 * Callback of a triangle list: writes at most maxTriangles triangles that are within radius of pos (in the list's
 * frame) and returns their number. The pair's second model has the triangle list; if the list is a child of an
 * aggregate, that model stands for the child. The first model is the one near it; for line segments, and for queries by
 * geometries without a model (McdQuery.h), it is the same as the second. When contacts are computed, the pair's phase
 * and data are those of the models' pair; else they are zero. The callback must not move models or change their
 * geometries; objects that it destroys are destroyed later (docs/simulation.md, "Callbacks").
 */
typedef int(MEAPI *McdTriangleListFnPtr)(McdModelPair *modelTriListPair, McdUserTriangle *triangle, MeVector3 pos,
                                         MeReal radius, int maxTriangles);

ME_END_C

#endif
