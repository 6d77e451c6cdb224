/* Inside Mcd: the interface of a geometry type to the rest of the library: one constant table of functions per type, in
 * the type's own file.
 *
 * The nearfield, the queries and the framework ask the table, never the type's number: a new geometry brings its table,
 * and no existing code changes (docs/collision.md, "How to add a geometry"). Functions that a type does not support are
 * null. */
#ifndef MCD_KIND_H
#define MCD_KIND_H

#include "convex/mcd_nearfield_i.h"

/* The order of two convex shapes in a pair: manifolds are found with the lower one first. The first ones have closed
 * forms with each other (mcd_grid.c); a new type is among the others. */
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

/* Adds the triangles that may be near the box. */
typedef void (*McdMeshGather)(McdMeshQuery *q);

struct McdKind {
    int type; /* kMcdGeometryType..., or MCD_SHAPE_TRIANGLE */
    char *(MEAPI *name)(const McdGeometryID);
    size_t size; /* bytes of its record, which has all that its tests depend on but for a surface's triangles
                    (mcd_tested.c); 0: maybe not all */

    /* Any type: what McdFrameworkRegisterGeometryType takes. */
    McdGeometryDestroyFnPtr destroy;
    McdGeometryGetAABBFnPtr box;
    McdGeometryGetBSphereFnPtr sphere;
    McdGeometryMaximumPointFnPtr farthest;
    McdGeometryGetMassPropertiesFnPtr mass;
    McdGeometryDebugDrawFnPtr draw;

    /* Convex types: the shape of a geometry, which has been placed (its size, rounding and extent); the core's farthest
     * point in a direction of any length; the face that looks in a direction (mcd_nearfield_i.h), which comes empty. */
    void (*setShape)(const McdGeometry *g, McdShape *s);
    void (*support)(const McdShape *s, const double direction[3], double point[3]);
    void (*face)(const McdShape *s, const double direction[3], McdFace *f);
    double (*radius)(const McdShape *s, const double outward[3], const double point[3]); /* null: the rounding */
    /* The radius of the circle about its own z axis that it touches with at a point; 0: with none. May be null. */
    double (*rim)(const McdShape *s, const double outward[3], const double point[3]);
    McdRank rank;
    MeU32 flatAxes; /* bits 1, 2, 4: local axis x, y, z is the normal of a flat face, tried first as separating axis */
    /* The edges of the solid in the geometry's frame, for cross-sections; of round sides, so many. */
    void (*edges)(const McdGeometry *g, int sides, McdEdgeVisit visit, void *context);

    /* Surfaces of triangles: adds those near a query's box. */
    McdMeshGather gather;
    MeBool callsProgram;            /* which calls a function of the program */
    void (*update)(McdGeometry *g); /* McdGeometryUpdate: writes to its record, so that it differs. May be null */

    MeBool isHalfSpace; /* all below z = 0 of its frame */
    MeBool isStatic;    /* usually fixed: no warning where two of them have no interaction */
    MeBool isEmpty;     /* no warning where it has no interaction with any type */
};

/* The entries that all built-in types have, from the functions of their headers. */
#define MCD_KIND_FUNCTIONS(Type, release)                                                                              \
    .type = kMcdGeometryType##Type, .name = Mcd##Type##GetTypeName, .destroy = (release),                              \
    .box = Mcd##Type##UpdateAABB, .sphere = Mcd##Type##GetBSphere, .farthest = Mcd##Type##MaximumPoint,                \
    .mass = Mcd##Type##GetMassProperties, .draw = Mcd##Type##DebugDraw

/* Cores that are a point: spheres, and points of their own (mcd_shape.c). */
void mcd_pointSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_pointFace(const McdShape *s, const double direction[3], McdFace *f);

/* Solids between two discs about z, of radii that may differ: cylinders and cones (mcd_discs.c). */
void mcd_discsShape(McdShape *s, double lowerRadius, double upperRadius, double length, double low);
void mcd_discsSupport(const McdShape *s, const double direction[3], double point[3]);
void mcd_discsFace(const McdShape *s, const double direction[3], McdFace *f);
double mcd_discsRadius(const McdShape *s, const double outward[3], const double point[3]);
double mcd_discsRim(const McdShape *s, const double outward[3], const double point[3]);

#endif
