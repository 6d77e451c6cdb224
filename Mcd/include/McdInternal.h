/** @file McdInternal.h
 *  For Mst, which makes frameworks and spaces of its universes' sizes, and knows no geometry types. Not installed.
 */
#ifndef MCDINTERNAL_H
#define MCDINTERNAL_H

#include "McdCTypes.h"
#include "MeTeam.h"

ME_BEGIN_C

/** @name Names of limits
 *  What a message tells the program to raise where there is no room for more, instead of the arguments of McdInit and
 *  McdSpaceAxisSortCreate. Strings that stay. Each limit is spoken of once then.
 *  @{ */
MEPUBLIC void MEAPI McdFrameworkRenameLimits(McdFrameworkID frame, const char *types, const char *models,
                                             const char *instances);
MEPUBLIC void MEAPI McdSpaceRenameLimits(McdSpaceID s, const char *models, const char *pairs);
/** @} */

/** Pairs that come, stay and go: outside of change blocks. */
MEPUBLIC int MEAPI McdSpaceGetPairCount(McdSpaceID s);

/** @name Workers
 *  @{ */
/** Whose workers update the boxes of models from now on; null: nobody's. */
MEPUBLIC void MEAPI McdSpaceSetTeam(McdSpaceID s, MeTeam *team);
/** Looks at all models that are not frozen (McdModelPairLookAtModels), by the space's workers. */
MEPUBLIC void MEAPI McdSpaceLookAtModels(McdSpaceID s);
/** @} */

/** @name Tests that need not be made again
 *  @{ */
/** The framework's models stay as they are while pairs are asked, until this is called again. */
MEPUBLIC void MEAPI McdFrameworkBeginRound(McdFrameworkID frame);
/** Whether a test would find what was found before. */
typedef enum McdPairChange {
    McdPairHasChanged,  /**< who knows */
    McdPairHasMoved,    /**< by little since the last test: what was found moves with the models */
    McdPairIsUnchanged, /**< to the last bit since the pair was looked at last */
} McdPairChange;
/** Looks at both models, if nobody has in this round: then looks at pairs of them write to the pairs alone, and may be
 *  taken by several threads at once. */
MEPUBLIC void MEAPI McdModelPairLookAtModels(const McdModelPair *p);
/** Has somebody looked at both models in this round? */
MEPUBLIC MeBool MEAPI McdModelPairHasSeenModels(const McdModelPair *p);
/** Looks at a pair of two convex models or planes, under the library's own interaction and without a callback, whose
 *  sizes and margins have not changed. By little: since the last test that was noted, no point of the smaller model has
 *  moved against the other by more than @a part of its size, or a quarter of the pair's margin; or, whatever the part,
 *  by as much as they were apart then (McdModelPairNoteApart), so that a test would find nothing; and only models that
 *  @a mayMove have moved since the pair was looked at last. */
MEPUBLIC McdPairChange MEAPI McdModelPairLook(McdModelPair *p, MeReal part, const MeBool mayMove[2]);
/** Is the pair two convex models or planes, under the library's own interaction and without a callback? Then no
 *  function of the program runs in its test. */
MEPUBLIC MeBool MEAPI McdModelPairIsPlain(const McdModelPair *p);
/** The pair is about to be tested. */
MEPUBLIC void MEAPI McdModelPairNoteTest(McdModelPair *p);
/** That test has found them so far apart at least, m (McdIntersectResult.apart). 0: it is not known, or they were not. */
MEPUBLIC void MEAPI McdModelPairNoteApart(McdModelPair *p, MeReal apart);
/** What was found has been given away: the next answer is false. */
MEPUBLIC void MEAPI McdModelPairForgetTest(McdModelPair *p);
/** @} */

/** @name What a model's geometry is
 *  MEFALSE, with a warning, for what is no model.
 *  @{ */
/** Is it one convex shape, which can be cast (McdSpaceCastGeometry)? */
MEPUBLIC MeBool MEAPI McdModelIsConvex(McdModelID cm);
/** Is it a surface of triangles, of which McdSafeTime knows nothing? */
MEPUBLIC MeBool MEAPI McdModelIsSurface(McdModelID cm);
/** @} */

ME_END_C

#endif
