/* Inside Mcd: shapes of models, results of pairs, margins. */
#ifndef MCD_RESULT_I_H
#define MCD_RESULT_I_H

#include "model/mcd_frame_i.h"

/* ---- shapes (mcd_placed.c) ---- */

/* The common origin of a pair's coordinates: the middle of the overlap of their boxes. */
void mcd_pairOrigin(McdGeometryInstanceID ins1, McdGeometryInstanceID ins2, double origin[3]);
/* The convex shape of an instance; false for geometries that are none (plane, lists, aggregates, null). */
MeBool mcd_shapeOf(McdGeometryInstanceID ins, const double origin[3], McdShape *shape);
/* The same, at another transform than the instance's present one. */
MeBool mcd_shapeAt(McdGeometryID g, const MeMatrix4 tm, const double origin[3], McdShape *shape);
/* The same of a model that has been compared in this round (mcd_modelStamp), without reading its geometry anew. */
MeBool mcd_shapeInRound(McdModelRecord *m, const double origin[3], McdShape *shape);
/* Its kind, sizes and extent, as its geometry has them now. False: it is none. */
MeBool mcd_shapeSizes(McdGeometryID g, McdShape *shape);

/* ---- contacts ------------------------------------------------------------------------------------------------- */

/* How interactions fill a result: begin, add, end. */
MeBool mcd_resultHasRoom(const McdIntersectResult *result, const char *function); /* warns if not */
void mcd_resultBegin(McdIntersectResult *result, McdModelPair *p);
/* Adds a manifold whose points are relative to origin, and returns its first contact, null for none. If there is place
 * for some of them only, those that mcd_spread chooses. */
McdContact *mcd_resultAdd(McdIntersectResult *result, const McdManifold *m, const double origin[3],
                          McdGeometryInstanceID ins1, McdGeometryInstanceID ins2);
/* The dimension of a region that so many points of one manifold span: 0 .. 2. */
static inline int mcd_regionDims(int pointCount) {
    return MeMIN(pointCount, 3) - 1;
}
/* A hash of a feature's number and of what it is a part of. */
MeU32 mcd_featureMix(MeU32 feature, MeU32 component);
/* McdContact.feature of two shapes' features: of shapes with at most 256 faces as it is, of others a hash. */
MeU32 mcd_featureNumber(MeU64 feature);
int mcd_resultEnd(McdIntersectResult *result); /* the mean normal; 1 if there are contacts */
/* May these be a pair: two models of one framework? Warns if not. */
MeBool mcd_modelsMakeAPair(McdModelID m1, McdModelID m2, const char *function);
/* m: a model's share of the speculative margin: its tolerance, and how far it may move before the next test. */
static inline MeReal mcd_modelReach(const McdModelRecord *m) {
    return m->tolerance + m->travel;
}
/* Mixes bytes into a hash of 128 bits: eight of them, or fewer at the end, always change it; all together may leave it
 * as it was by chance only. */
void mcd_hashAdd(MeU64 hash[2], const void *data, size_t bytes);
/* m: the gap up to which a pair gets contacts (speculative margin): its tolerances, and the distance by which the two
 * may approach before the next test. */
double mcd_pairMargin(const McdModelPair *p);
double mcd_pairMarginInRound(const McdModelPair *p); /* of models that have a stamp of this round */
/* The same of two parts, whose origins move with the models that turn. */
double mcd_childMargin(const McdModelPair *p, const McdGeometryInstance *child1, const McdGeometryInstance *child2);
/* m: by how much model1 moves against model2 until the next test, with the velocities that they have; 0 of fast models,
 * whose contacts are those of now. */
void mcd_pairDisplacement(const McdModelPair *p, double displacement[3]);

#endif
