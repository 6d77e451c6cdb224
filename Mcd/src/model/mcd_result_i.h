/* Inside Mcd: world-space shapes of models, results of pairs, margins. */
#ifndef MCD_RESULT_I_H
#define MCD_RESULT_I_H

#include "model/mcd_frame_i.h"

/* ---- shapes (mcd_placed.c) ---- */

/* The common origin of a pair's coordinates: the middle of the intersection of their boxes. */
void mcd_pairOrigin(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3]);
/* The half-space below z = 0 of tm: normal . x <= offset, with x relative to origin. The normal is tm's z axis, of any
 * length. */
void mcd_halfSpaceAt(const MeVector4 *tm, const double origin[3], double normal[3], double *offset);
/* Makes the convex shape of an instance, relative to origin; false if its geometry is not convex (plane, surfaces of
 * triangles, aggregate, null) or its transform not valid. */
MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape);
/* mcd_shapeOf for both instances of a pair, relative to their mcd_pairOrigin. */
MeBool mcd_shapesOf(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3], McdShape *a, McdShape *b);
/* Makes the convex shape of a geometry at a given transform. */
MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape);
/* Makes the convex shape of a model that has been compared in this round (mcd_modelCompare), without reading its
 * geometry; false if it has not, or is not convex. */
MeBool mcd_shapeInRound(McdModelRecord *m, const double origin[3], McdShape *shape);
/* Sets kind, sizes, rounding and extent from the geometry. False: it is not convex. */
MeBool mcd_shapeSizes(McdGeometryID g, McdShape *shape);

/* ---- contacts ------------------------------------------------------------------------------------------------- */

/* An interaction fills a result by begin, add, end. */
MeBool mcd_resultHasRoom(const McdIntersectResult *result, const char *function); /* warns if not */
void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p);
/* Adds a manifold whose points are relative to origin; returns its first contact, null if there is none. If there is
 * not room for all points, mcd_spread chooses. */
McdContact *mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3],
                          McdGeometryInstanceID ins1, McdGeometryInstanceID ins2);
/* The dimension, 0 to 2, of the region spanned by that many points of a manifold. */
static inline int mcd_regionDims(int pointCount) {
    return MeMIN(pointCount, 3) - 1;
}
/* Combines a feature number with a component's number (an aggregate's part, a triangle) by hashing. */
MeU32 mcd_featureMix(MeU32 feature, MeU32 component);
/* McdContact.feature for the features of two shapes: both numbers if the shapes have at most 256 faces each, else a
 * hash. */
MeU32 mcd_featureNumber(MeU64 feature);
int mcd_resultEnd(McdIntersectResult *result); /* sets the mean normal; 1 if there are contacts */
/* Whether two models may form a pair: different live models of one framework; warns if not. */
MeBool mcd_modelsMakeAPair(McdModelID m1, McdModelID m2, const char *function);
/* Whether both models have valid transforms; warns if not. */
MeBool mcd_pairIsPlaced(const McdModelPair *p, const char *function);
int mcd_warnNotPlaced(const char *function); /* gives that warning; returns 0 */
/* m: a model's share of the speculative margin: its tolerance, and its largest displacement before the next test. */
static inline MeReal mcd_modelMargin(const McdModelRecord *m) {
    return m->tolerance + m->travel;
}
/* McdContactSimplify in given memory of mcd_simplifyBytes(count) bytes; faceNormal may be null. */
size_t mcd_simplifyBytes(int count);
int mcd_simplify(const McdContact *from, int count, McdContact *to, int maxCount, const MeReal *faceNormal, double same,
                 void *memory);
/* Mixes bytes into a 128-bit hash. A change within one group of eight bytes always changes the hash; changes of
 * several groups could only cancel by chance. */
void mcd_hashAdd(MeU64 hash[2], const void *data, size_t bytes);
/* The speculative margin, the gap up to which a pair gets contacts: the sum of the tolerances, and an upper bound of
 * the models' approach before the next test. */
McdReach mcd_pairReach(const McdModelPair *p);
McdReach mcd_pairReachInRound(const McdModelPair *p); /* for models that have been compared in this round */
/* mcd_pairReach for two parts of aggregates: their origins also move because the models rotate. */
McdReach mcd_childReach(const McdModelPair *p, const McdGeometryInstance *child1, const McdGeometryInstance *child2);
/* m: the displacement of model1 relative to model2, which turns about its own place, until the next test, at their
 * current velocities; 0 for fast models, which get contacts of the current overlap only. arm: from there to model1. */
void mcd_pairDisplacement(const McdModelPair *p, const double arm[3], double displacement[3]);

#endif
