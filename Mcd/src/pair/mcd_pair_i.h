/* Inside Mcd: interactions of pairs, and which of their tests still hold. */
#ifndef MCD_PAIR_I_H
#define MCD_PAIR_I_H

#include "surface/mcd_mesh_i.h"

/* McdIntersect, McdLineSegIntersect by a function that holds the models, or of models that involve no function of the
 * program: several threads may call them then. */
MeBool mcd_intersect(McdModelPair *p, McdIntersectResult *result);
MeBool mcd_lineSegIntersect(McdModelID cm, MeReal *inOrig, MeReal *inDest, McdLineSegIntersectResult *outOverlap);

/* Do two types, or the pair's models, interact as the library has it, not by a function of the program's? */
MeBool mcd_typesAreBuiltIn(McdFramework *frame, int type1, int type2);
MeBool mcd_interactionIsBuiltIn(const McdModelPair *p);
/* The types of an instance and its parts, as bits. False: a part has a material of its own, or is a surface that a
 * function of the program makes; or a type is the program's, or has no bit. */
MeBool mcd_instanceTypes(const McdGeometryInstance *ins, MeU64 *types);
/* Does each of these types interact with each of those as the library has it? */
MeBool mcd_typesInteractAsBuiltIn(McdFramework *frame, MeU64 types1, MeU64 types2);

/* Registers how a convex type interacts with each type that the framework knows by now, where nothing is registered:
 * convex ones, half-spaces, surfaces of triangles. (Aggregates: McdAggregateGenericRegisterInteractions, after it.) */
void mcd_kindRegisterInteractions(McdFramework *frame, const McdKind *kind, const char *function);

/* Interactions of convex types, with pairs whose types have been checked: two of them; one and a half-space, in either
 * order. The function is named in messages. */
int mcd_convexContacts(McdModelPair *p, McdIntersectResult *result, const char *function);
/* Adds the contacts of two convex instances, and sets result->apart; false: one has no valid transform. */
MeBool mcd_convexInstances(McdGeometryInstance *ins1, McdGeometryInstance *ins2, double margin,
                           McdIntersectResult *result);
/* The same of models, if both are convex shapes that have been compared in this round (mcd_shapeInRound). */
MeBool mcd_convexModels(McdModelRecord *m1, McdModelRecord *m2, double margin, McdIntersectResult *result);
int mcd_planeContacts(McdModelPair *p, McdIntersectResult *result, const char *function);

/* ---- times of impact (McdInteractions.c) ---- */

/* Sets the result of a pair that does not touch until maxTime, and checks the pair and the time; false, with a
 * warning that names the function. */
MeBool mcd_safeTimeBegin(McdModelPair *p, MeReal maxTime, McdSafeTimeResult *result, const char *function);
/* Are both models somewhere, with velocities that are numbers? Warns if not. */
MeBool mcd_safeTimeIsToBeHad(const McdModelPair *p, const char *function);

/* ---- change detection (mcd_tested.c) ---- */

/* A version that changes with every input of the model's box and tests; 0: its inputs cannot be compared. */
MeU64 mcd_modelStamp(McdModelRecord *m);
/* The same, unless it has a stamp of this round. */
MeU64 mcd_modelStampInRound(McdModelRecord *m);
/* A stamp that no model has had. */
MeU64 mcd_modelNewStamp(McdModelRecord *m);

#endif
