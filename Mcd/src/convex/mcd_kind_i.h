/* Inside Mcd: the interface of a geometry type to the rest of the library: one constant table of functions per type,
 * in the type's own file.
 *
 * The narrow phase, the queries and the framework use the table, never the type's number: a new geometry brings its
 * table, and no existing code changes (docs/collision.md, "How to add a geometry"). Functions that a type does not
 * support are null. */
#ifndef MCD_KIND_H
#define MCD_KIND_H

#include "convex/mcd_nearfield_i.h"

/* The order of two convex shapes in a pair: the manifold is computed with the lower rank as first shape. The first
 * ranks have closed forms with each other (mcd_grid.c); a new type has rank MCD_RANK_OTHER. */
typedef enum McdRank {
    MCD_RANK_SPHERE,
    MCD_RANK_SPHYL,
    MCD_RANK_BOX,
    MCD_RANK_CYLINDER,
    MCD_RANK_CONE,
    MCD_RANK_HULL,
    MCD_RANK_TRIANGLE,
    MCD_RANK_OTHER
} McdRank;

typedef void (*McdEdgeVisit)(void *context, const double from[3], const double to[3]);

typedef struct McdMeshQuery McdMeshQuery; /* mcd_mesh_i.h */

/* Adds the triangles that may be near the query's box. */
typedef void (*McdMeshGather)(McdMeshQuery *q);
/* The element at a point of the surface, to `slack` along each axis, in its frame, for a patch
 * (McdMeshTriangle.isPatch); `element`: if there is none. */
typedef McdElementData (*McdMeshElementAt)(const McdGeometry *g, const double place[3], const double slack[3],
                                           McdElementData element);

/* The first hits of up to MCD_SEGMENTS line segments with a model, each with the answer of McdLineSegIntersect, but for
 * the result's model and instance; a bit for each that hits. */
enum { MCD_SEGMENTS = 4 };
typedef struct McdSegment {
    MeVector3 from, to;
} McdSegment;
typedef MeU32 (*McdSegmentsFn)(McdModelID cm, const McdSegment segment[], int count, McdLineSegIntersectResult hit[]);

struct McdKind {
    int type; /* kMcdGeometryType...; not set for shapes that are no geometries, such as triangles */
    char *(MEAPI *name)(const McdGeometryID);
    size_t
        size; /* bytes of its record, which holds all inputs of its tests but triangles (mcd_tested.c); 0: it may not */

    /* Any type: the arguments of McdFrameworkRegisterGeometryType. */
    McdGeometryDestroyFnPtr destroy;
    McdGeometryGetAABBFnPtr box;
    McdGeometryGetBSphereFnPtr sphere;
    McdGeometryMaximumPointFnPtr farthest;
    McdGeometryGetMassPropertiesFnPtr mass;
    McdGeometryDebugDrawFnPtr draw;

    /* Convex types. setShape: sets size, rounding and extent of a shape whose place is set. support: the core's
     * support point in a direction of any length. face: the core's supporting face in a direction
     * (mcd_nearfield_i.h); f is empty before. */
    void (*setShape)(const McdGeometry *g, McdShape *s);
    void (*support)(const McdShape *s, const double direction[3], double point[3]);
    void (*face)(const McdShape *s, const double direction[3], McdFace *f);
    void (*bounds)(const McdShape *s, double low[3], double high[3]); /* mcd_shapeBounds; null: by `support` */
    double (*radius)(const McdShape *s, const double outward[3], const double point[3]); /* null: the rounding */
    /* The radius of the circle about the shape's z axis that the contact point lies on (McdContactGetRim); 0: none.
     * May be null. */
    double (*rim)(const McdShape *s, const double outward[3], const double point[3]);
    McdRank rank;
    MeU32 flatAxes; /* bits 1, 2, 4: local axis x, y, z is the normal of a flat face, tried first as separating axis */
    MeBool isSampled; /* known by a support function of the program alone (mcd_sampled_i.h) */
    /* Visits the edges of the solid in the geometry's frame, for cross-sections; `sides` edges stand for a round
     * side. */
    void (*edges)(const McdGeometry *g, int sides, McdEdgeVisit visit, void *context);

    /* Surfaces of triangles: adds the triangles near a query's box. */
    McdMeshGather gather;
    McdMeshElementAt elementAt;     /* of types that gather patches */
    MeBool callsProgram;            /* `gather` calls a function of the program */
    void (*update)(McdGeometry *g); /* for McdGeometryUpdate: reads the program's array again. May be null */
    MeBool isStored;                /* triangles change only by `update`, which changes the record */

    /* Line segments side by side, used while the type's function for one is `segment`. May be null. */
    McdSegmentsFn segments;
    McdLineSegIntersectFnPtr segment;

    /* The material of an element; -1: the instance's. If element 0 has none, none has. May be null. */
    int (*material)(const McdGeometry *g, int element);

    MeBool isHalfSpace; /* the half-space below z = 0 of its frame */
    MeBool isStatic;    /* usually fixed: no warning for two such types without an interaction */
    MeBool isEmpty;     /* touches nothing (McdNull): pairs without an interaction are no mistake */
};

/* The entries that all built-in types have: the functions of their headers. */
#define MCD_KIND_FUNCTIONS(Type, release)                                                                              \
    .type = kMcdGeometryType##Type, .name = Mcd##Type##GetTypeName, .destroy = (release),                              \
    .box = Mcd##Type##UpdateAABB, .sphere = Mcd##Type##GetBSphere, .farthest = Mcd##Type##MaximumPoint,                \
    .mass = Mcd##Type##GetMassProperties, .draw = Mcd##Type##DebugDraw

/* Shapes whose core is a point: spheres, and points used alone (mcd_shape.c). */
void mcd_pointSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_pointFace(const McdShape *s, const double direction[3], McdFace *f);

/* Solids of revolution between two discs about z, whose radii may differ: cylinders and cones (mcd_discs.c). */
void mcd_discsShape(McdShape *s, double lowerRadius, double upperRadius, double length, double low);
void mcd_discsSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_discsBounds(const McdShape *s, double low[3], double high[3]);
void mcd_discsFace(const McdShape *s, const double direction[3], McdFace *f);
/* The face of a disc about the shape's z axis, in a direction d of own axes, counter-clockwise seen from the side of
 * z = side. */
void mcd_discFace(const McdShape *s, const double d[3], double radius, double height, double side, McdFace *f);
double mcd_discsRadius(const McdShape *s, const double outward[3], const double point[3]);
double mcd_discsRim(const McdShape *s, const double outward[3], const double point[3]);

#endif
