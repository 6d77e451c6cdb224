/* Internal edges between fixed models: a body slides over a floor of several fixed models as over a single model
 * (mcd_seam.c, mcd_pieces.c). */
#include "McdInternal.h"
#include "convex/mcd_seam_i.h"
#include "pair/mcd_compound_i.h"
#include "surface/mcd_pieces_i.h"
#include <string.h>

/* A manifold (contacts of the same instances along one normal), and the fixed models near it. */
typedef struct Surroundings {
    const McdModelPair *pair;
    int side; /* which of the pair's models is the fixed one */
    McdGeometryInstance *fixed, *moving;
    McdPieces pieces;
    McdShape body;
} Surroundings;

/* Sets the seam except for the contact's point and separation. False if one of the shapes is not convex and rigid. */
static MeBool beginSeam(Surroundings *s, const McdContact *contact, McdSeam *seam) {
    McdGeometryInstance *const instance[2] = {contact->instance1, contact->instance2};
    s->fixed = instance[s->side];
    s->moving = instance[!s->side];
    mcd_piecesBegin(&s->pieces, s->fixed, s->moving, contact->exactPosition);
    seam->body = &s->body;
    seam->side = 0;
    seam->find = mcd_piecesFind;
    seam->pieces = &s->pieces;
    if (!mcd_shapeOf(s->fixed, s->pieces.origin, &seam->shape) || !mcd_shapeOf(s->moving, s->pieces.origin, &s->body) ||
        !mcd_shapeIsRigid(&seam->shape) || !mcd_shapeIsRigid(&s->body))
        return MEFALSE;
    seam->skin = mcd_seamSkin(&seam->shape, &s->body, s->pieces.origin);
    seam->gap = mcd_seamGap(&s->body);
    mcd_fromReal(seam->normal, contact->normal);
    mcd_scale(seam->normal, seam->normal, s->side ? 1 : -1);
    return METRUE;
}

static void setSeamContact(const Surroundings *s, const McdContact *contact, MeBool isBeside, McdSeam *seam) {
    seam->isBeside = isBeside;
    mcd_sub(seam->point, contact->exactPosition, s->pieces.origin);
    mcd_mad(seam->point, seam->point, -contact->exactSeparation / 2, seam->normal);
    seam->separation = contact->exactSeparation;
}

/* Whether all contacts of a manifold are near an edge. A manifold that is not is kept, whatever its neighbours are. */
static MeBool areNearEdge(const Surroundings *s, const McdContact *contact, int count, McdSeam *seam) {
    for (int i = 0; i < count; i++) {
        setSeamContact(s, &contact[i], MEFALSE, seam);
        if (!mcd_seamIsNear(seam))
            return MEFALSE;
    }
    return METRUE;
}

static int nearestOf(const McdContact *contact, int count) {
    int nearest = 0;
    for (int i = 1; i < count; i++)
        if (contact[i].exactSeparation < contact[nearest].exactSeparation)
            nearest = i;
    return nearest;
}

/* Whether all contacts of a manifold are at an internal edge. Writes the face's normal. */
static MeBool areInternal(const Surroundings *s, const McdContact *contact, int count, McdSeam *seam, double face[3]) {
    const int nearest = nearestOf(contact, count);
    for (int i = 0; i < count; i++) {
        setSeamContact(s, &contact[i], i != nearest, seam);
        if (!mcd_seamPieceBeyond(seam, face))
            return MEFALSE;
    }
    return METRUE;
}

/* Finds the contacts along the face's normal, of the body moved by a shift; none if the body is not above the face. */
static int manifoldOverFace(const Surroundings *s, const McdSeam *seam, const double face[3], const double shift[3],
                            McdReach reach, McdManifold *m) {
    McdShape body = s->body;
    const McdShape *a = s->side ? &body : &seam->shape, *b = s->side ? &seam->shape : &body;
    double normal[3];
    mcd_scale(normal, face, s->side ? 1 : -1);
    mcd_mad(body.place, body.place, 1, shift);
    const int count = mcd_manifoldAlong(a, b, normal, mcd_separationAlong(a, b, normal), reach, m);
    for (int i = 0; i < count; i++)
        mcd_mad(m->point[i].position, m->point[i].position, -1, shift);
    return count;
}

/* Appends the contacts along the face's normal, if the body is above the face or the gap beside it. */
static void addAlongFace(const Surroundings *s, const McdSeam *seam, const double face[3], McdIntersectResult *result) {
    static const double none[3] = {0, 0, 0};
    McdGeometryInstance *first = s->side ? s->moving : s->fixed, *second = s->side ? s->fixed : s->moving;
    const McdReach reach = mcd_childReach(s->pair, first, second);
    const int count = result->contactCount;
    double shift[3];
    McdManifold m;
    if (count == result->contactMaxCount)
        return;
    if (!manifoldOverFace(s, seam, face, none, reach, &m) &&
        !(mcd_seamGapShift(seam, &s->body, face, shift) && manifoldOverFace(s, seam, face, shift, reach, &m)))
        return;
    mcd_resultAdd(result, &m, s->pieces.origin, first, second);
    if (first->parent || second->parent)
        mcd_mixChildPaths(result, count, first, second);
}

/* The number of contacts, from the first on, that have its instances and its normal. */
static int countManifold(const McdContact *contact, int count) {
    int i = 1;
    while (i < count && contact[i].instance1 == contact->instance1 && contact[i].instance2 == contact->instance2 &&
           memcmp(contact[i].normal, contact->normal, sizeof contact->normal) == 0)
        i++;
    return i;
}

MeBool MEAPI McdModelPairReplaceInternal(const McdModelPair *p, const MeBool mayMove[2], McdIntersectResult *result) {
    Surroundings s = {.pair = p, .side = mayMove[0]};
    McdContact *contact = result->contacts;
    const int count = result->contactCount;
    MeBool isNear = MEFALSE;
    int kept = 0;
    if (count == 0 || mayMove[0] == mayMove[1])
        return MEFALSE;
    for (int i = 0, n; i < count; i += n) {
        McdSeam seam;
        double face[3];
        n = countManifold(&contact[i], count - i);
        const MeBool mayBeInternal = beginSeam(&s, &contact[i], &seam) && areNearEdge(&s, &contact[i], n, &seam);
        isNear = isNear || mayBeInternal;
        if (mayBeInternal && areInternal(&s, &contact[i], n, &seam, face)) {
            addAlongFace(&s, &seam, face, result);
            continue;
        }
        if (kept < i)
            memmove(&contact[kept], &contact[i], (size_t)n * sizeof *contact);
        kept += n;
    }
    const int added = result->contactCount - count;
    if (kept < count)
        memmove(&contact[kept], &contact[count], (size_t)added * sizeof *contact);
    result->contactCount = kept + added;
    return isNear;
}
