/* Inside Mcd: interactions of pairs, and whether their last tests are still valid. */
#ifndef MCD_PAIR_I_H
#define MCD_PAIR_I_H

#include "surface/mcd_mesh_i.h"

/* McdIntersect and McdLineSegIntersect without a stage of their own: for callers that guard the models, or for
 * models that call no function of the program; these may be tested by several threads. */
MeBool mcd_intersect(McdModelPair *p, McdIntersectResult *result);
MeBool mcd_lineSegIntersect(McdModelID cm, MeReal *inOrig, MeReal *inDest, McdLineSegIntersectResult *outOverlap);
/* mcd_lineSegIntersect for up to MCD_SEGMENTS segments; a bit for each that hits. */
MeU32 mcd_lineSegsIntersect(McdModelID cm, McdSegment segment[], int count, McdLineSegIntersectResult hit[]);
/* Whether hit a comes before hit b: by distance, then by the models' order. */
MeBool mcd_isHitNearer(const McdLineSegIntersectResult *a, const McdLineSegIntersectResult *b);

/* Whether two types, or a pair's models, interact by the library's functions, not the program's. */
MeBool mcd_typesAreBuiltIn(McdFramework *frame, int type1, int type2);
MeBool mcd_interactionIsBuiltIn(const McdModelPair *p);
/* The types of an instance and its parts, as bits. False if a part has its own material, or is a surface whose
 * triangles a function of the program makes, or if a type is the program's or has no bit. */
MeBool mcd_instanceTypes(const McdGeometryInstance *ins, MeU64 *types);
/* Whether each of the first types interacts with each of the second ones by the library's functions. */
MeBool mcd_typesInteractAsBuiltIn(McdFramework *frame, MeU64 types1, MeU64 types2);

/* Registers the interactions of a convex type with all types that the framework has now: convex types, half-spaces,
 * surfaces of triangles. Existing registrations stay. (Aggregates: McdAggregateGenericRegisterInteractions, to be
 * called after it.) */
void mcd_kindRegisterInteractions(McdFramework *frame, const McdKind *kind, const char *function);

/* Find the contacts of a pair whose types have been checked: two convex shapes (mcd_convexContacts), or a convex
 * shape and a half-space in either order (mcd_planeContacts). Warnings name the function. Return 1 if there are
 * contacts. */
int mcd_convexContacts(McdModelPair *p, McdIntersectResult *result, const char *function);
/* Adds the contacts of two convex instances, and sets result->apart; false: one has no valid transform. */
MeBool mcd_convexInstances(McdGeometryInstance *ins1, McdGeometryInstance *ins2, McdReach reach,
                           McdIntersectResult *result);
/* mcd_convexInstances for two models that are convex and have been compared in this round (mcd_shapeInRound); false
 * for others. */
MeBool mcd_convexModels(McdModelRecord *m1, McdModelRecord *m2, McdReach reach, McdIntersectResult *result);
int mcd_planeContacts(McdModelPair *p, McdIntersectResult *result, const char *function);

/* ---- times of impact (McdInteractions.c) ---- */

/* Checks pair and time, and sets the result to that of a pair that does not touch before maxTime. False, with a
 * warning that names the function, for bad arguments. */
MeBool mcd_safeTimeBegin(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result, const char *function);
/* Whether both models have valid transforms and finite velocities; warns if not. */
MeBool mcd_safeTimeInputsAreValid(const McdModelPair *p, const char *function);

/* ---- change detection (mcd_tested.c) ---- */

/* Compares a model with its last inputs. Returns its stamp, a version that changes with any input of the model's box
 * and tests; 0: the inputs cannot be compared. */
MeU64 mcd_modelCompare(McdModelRecord *m);
/* The model's stamp; compares it first, unless it has been compared in this round. */
MeU64 mcd_modelCompareInRound(McdModelRecord *m);
/* Makes a stamp that no model has had. */
MeU64 mcd_modelNewStamp(McdModelRecord *m);

#endif
