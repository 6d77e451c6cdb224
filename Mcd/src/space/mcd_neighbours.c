/* Internal edges between fixed models: a body slides over a floor of several fixed models as over a single model
 * (mcd_seam.c). The pieces are the convex geometries and parts of the fixed models near the moving model. */
#include "McdInternal.h"
#include "convex/mcd_seam_i.h"
#include "pair/mcd_compound_i.h"
#include "space/mcd_space_i.h"
#include <string.h>

/* A manifold (contacts of the same instances along one normal), and the fixed models near it. */
typedef struct Surroundings {
    const McdModelPair *pair;
    int side; /* which of the pair's models is the fixed one */
    McdGeometryInstance *fixed, *moving;
    double origin[3];
    McdShape body;
} Surroundings;

static MeBool isFixed(const McdModelRecord *m) {
    return m && !m->linearVelocity && !m->isSensor && !m->isGone;
}

/* Iterates over the fixed models that the moving model has pairs with. `at` is the link of the last result, MCD_NONE
 * before the first call. Returns null at the end. */
static McdModelRecord *nextFixed(const McdModelRecord *moving, int *at) {
    const McdSpace *space = moving->space;
    const int own = space ? mcd_proxyIndex(space, moving->proxy) : MCD_NONE;
    while (space) {
        *at = *at == MCD_NONE ? space->proxy[own].firstLink : space->link[*at].next[space->link[*at].proxy[1] == own];
        if (*at == MCD_NONE)
            break;
        const McdLink *link = &space->link[*at];
        McdModelRecord *other = space->proxy[link->proxy[link->proxy[0] == own]].model;
        if (link->record && isFixed(other))
            return other;
    }
    return 0;
}

static void *findPiece(const McdSeam *seam, const double point[3], double reach, McdSeamVisit visit,
                       const void *context) {
    const Surroundings *s = seam->pieces;
    int at = MCD_NONE;
    void *found = 0;
    for (McdModelRecord *m = 0; !found && (m = nextFixed(mcd_record(s->moving->model), &at)) != 0;)
        found = mcd_childAt(&m->instance, s->fixed, s->origin, point, reach, visit, context);
    return found;
}

/* Whether the body has a pair with a fixed plane or surface of triangles. */
static MeBool isOnSurface(const Surroundings *s) {
    int at = MCD_NONE;
    for (const McdModelRecord *m = 0; (m = nextFixed(mcd_record(s->moving->model), &at)) != 0;)
        if (mcd_isHalfSpace(&m->instance) || mcd_isSurface(&m->instance))
            return METRUE;
    return MEFALSE;
}

/* Whether the body rests on a plane or a surface of triangles that is flush with a face of the fixed model, and the
 * contact is not with this face: the models are separated, or the normals differ by more than 60 degrees. Then the
 * body will pass over the face. Planes and surfaces need this rule because they are not pieces with faces. Writes the
 * face's normal. */
static MeBool isFlush(const Surroundings *s, const McdSeam *seam, double face[3]) {
    for (int i = 0; i < mcd_shapeFaces(&seam->shape); i++)
        if (mcd_shapeFaceNormal(&seam->shape, i, face) &&
            (seam->separation > seam->skin || 2 * fabs(mcd_dot(seam->normal, face)) < 1) &&
            fabs(mcd_separationAlong(&s->body, &seam->shape, face) - s->body.rounding - seam->shape.rounding) <=
                seam->skin)
            return isOnSurface(s);
    return MEFALSE;
}

/* Sets the seam except for the contact's point and separation. False if one of the shapes is not convex and rigid. */
static MeBool beginSeam(Surroundings *s, const McdContact *contact, McdSeam *seam) {
    McdGeometryInstance *const instance[2] = {contact->instance1, contact->instance2};
    s->fixed = instance[s->side];
    s->moving = instance[!s->side];
    mcd_copy(s->origin, contact->exactPosition);
    seam->side = 0;
    seam->find = findPiece;
    seam->pieces = s;
    if (!mcd_shapeOf(s->fixed, s->origin, &seam->shape) || !mcd_shapeOf(s->moving, s->origin, &s->body) ||
        !mcd_shapeIsRigid(&seam->shape) || !mcd_shapeIsRigid(&s->body))
        return MEFALSE;
    seam->skin = mcd_seamSkinAt(&seam->shape, &s->body, s->origin);
    seam->gap = mcd_seamGap(&s->body);
    mcd_fromReal(seam->normal, contact->normal);
    mcd_scale(seam->normal, seam->normal, s->side ? 1 : -1);
    return METRUE;
}

static void setSeamContact(const Surroundings *s, const McdContact *contact, McdSeam *seam) {
    mcd_sub(seam->point, contact->exactPosition, s->origin);
    mcd_mad(seam->point, seam->point, -contact->exactSeparation / 2, seam->normal);
    seam->separation = contact->exactSeparation;
}

/* Whether all contacts of a manifold are near an edge. A manifold that is not is kept, whatever its neighbours are. */
static MeBool areNearEdge(const Surroundings *s, const McdContact *contact, int count, McdSeam *seam) {
    for (int i = 0; i < count; i++) {
        setSeamContact(s, &contact[i], seam);
        if (!mcd_seamIsNear(seam))
            return MEFALSE;
    }
    return METRUE;
}

/* Whether all contacts of a manifold are at an internal edge. Writes the face's normal. */
static MeBool areInternal(const Surroundings *s, const McdContact *contact, int count, McdSeam *seam, double face[3]) {
    for (int i = 0; i < count; i++) {
        setSeamContact(s, &contact[i], seam);
        if (!mcd_seamPieceBeyond(seam, face))
            return MEFALSE;
    }
    return METRUE;
}

/* Appends the contacts along the face's normal; none if the body is not above the face. */
static void addAlongFace(const Surroundings *s, const McdSeam *seam, const double face[3], McdIntersectResult *result) {
    const McdShape *a = s->side ? &s->body : &seam->shape, *b = s->side ? &seam->shape : &s->body;
    McdGeometryInstance *first = s->side ? s->moving : s->fixed, *second = s->side ? s->fixed : s->moving;
    const int count = result->contactCount;
    double normal[3];
    McdManifold m;
    mcd_scale(normal, face, s->side ? 1 : -1);
    if (count == result->contactMaxCount || !mcd_manifoldAlong(a, b, normal, mcd_separationAlong(a, b, normal),
                                                               mcd_childMargin(s->pair, first, second), &m))
        return;
    mcd_resultAdd(result, &m, s->origin, first, second);
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
        if (mayBeInternal && (areInternal(&s, &contact[i], n, &seam, face) || isFlush(&s, &seam, face))) {
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
