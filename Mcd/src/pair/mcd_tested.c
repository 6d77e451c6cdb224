/* Change detection: whether a model's box, and the result of a pair's test, are still valid.
 *
 * For convex shapes, planes, and aggregates of these, both depend only on transform, size, velocity and margin. A
 * model gets a new stamp (version) when a comparison finds any bit of these changed. A pair keeps the stamps of its
 * models at its last test, and their relative pose.
 *
 * Lists and height fields are arrays and callbacks of the program, which may change without a call. So a pair with one
 * is tested in each step while one of its models that may move is awake: 12 us for a box on a height field.
 * While all of them sleep, only the stamps count; McdGeometryUpdate changes the stamp of a height field.
 *
 * Parts and triangles with their own material, and a program's own types, may depend on more: these are always tested.
 * So are triangle lists, and only by the thread that steps, since their callbacks are called.
 */
#include "McdInternal.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "space/mcd_space_i.h"
#include "surface/mcd_pieces_i.h"
#include "convex/mcd_vector_i.h"
#include <string.h>

/* Copies a vector bit by bit; if there is none, leaves the destination. */
static void copyUnlessNull(MeVector3 to, const MeReal *from) {
    if (from)
        memcpy(to, from, sizeof(MeVector3));
}

/* Reads the parameters of a shape, apart from a program's arrays: its members, or a hash of them. False: its tests
 * may depend on more than that, or its contacts have several materials. */
static MeBool readParameters(const McdGeometry *g, MeU64 parameters[MCD_SHAPE_PARAMETERS]) {
    const McdKind *kind = mcd_kindOf(g);
    if (!kind || kind->size == 0 || mcd_hasMaterials(g))
        return MEFALSE;
    const char *members = (const char *)g + sizeof *g;
    const size_t bytes = kind->size - sizeof *g;
    if (bytes <= MCD_SHAPE_PARAMETERS * sizeof *parameters)
        memcpy(parameters, members, bytes);
    else
        mcd_hashAdd(parameters, members, bytes);
    return METRUE;
}

/* Hashes all parts of an aggregate: their transforms in it, their shapes, and the program's pointers to their
 * transforms. False as of readParameters, or if a part has its own material. */
static MeBool hashChildren(const McdGeometryInstance *ins, MeU64 hash[2]) {
    const McdAggregate *aggregate = mcd_asAggregate(ins->geometry);
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling) {
        struct {
            const McdGeometry *geometry;
            const MeVector4 *tm;
            MeU64 parameters[MCD_SHAPE_PARAMETERS];
            MeMatrix4 relTM;
        } all;
        memset(&all, 0, sizeof all);
        all.geometry = child->geometry;
        all.tm = mcd_const(child->tm);
        memcpy(all.relTM, aggregate->element[child->element].relTM, sizeof all.relTM);
        const MeBool isKnown = mcd_asAggregate(child->geometry) ? hashChildren(child, hash)
                                                                : readParameters(child->geometry, all.parameters);
        if (!isKnown || child->material >= 0)
            return MEFALSE;
        mcd_hashAdd(hash, &all, sizeof all);
    }
    return METRUE;
}

/* Reads all inputs of a model's tests, except the space's look-ahead. False: they cannot be compared. */
static MeBool readInputs(const McdModelRecord *m, McdModelInputs *inputs) {
    const McdGeometry *g = m->instance.geometry;
    if (m->intersect || !m->instance.tm)
        return MEFALSE;
    memset(inputs, 0, sizeof *inputs);
    inputs->shape.geometry = g;
    if (!(mcd_asAggregate(g) ? hashChildren(&m->instance, inputs->shape.parameters)
                             : readParameters(g, inputs->shape.parameters)))
        return MEFALSE;
    for (int i = 0; i < 3; i++)
        memcpy(inputs->axis[i], m->instance.tm[i], sizeof inputs->axis[i]);
    memcpy(inputs->place, m->instance.tm[3], sizeof inputs->place);
    copyUnlessNull(inputs->velocity, m->linearVelocity);
    copyUnlessNull(inputs->spin, m->angularVelocity);
    inputs->shape.tolerance = m->tolerance;
    inputs->shape.isSwept = mcd_isSwept(m);
    return METRUE;
}

/* Each model has its own range of stamps, so models can be compared in any order and by several threads. */
MeU64 mcd_modelNewStamp(McdModelRecord *m) {
    return ++m->lastStamp;
}

/* Whether the model or a part is a surface that may change without a call. */
static MeBool hasSurface(const McdGeometryInstance *ins) {
    for (const McdGeometryInstance *child = ins->firstChild; child; child = child->nextSibling)
        if (hasSurface(child))
            return METRUE;
    return mcd_isSurface(ins) && !mcd_kindOf(ins->geometry)->isStored;
}

/* Stores changed inputs: makes new stamps, and updates the members of the record that are derived from the inputs. */
static void storeInputs(McdModelRecord *m, const McdModelInputs *now) {
    const MeBool isOtherShape = m->shapeStamp == 0 || memcmp(&now->shape, &m->inputs.shape, sizeof now->shape) != 0;
    MeVector3 centre;
    if (m->stamp != 0 && (memcmp(now->axis, m->inputs.axis, sizeof now->axis) != 0 ||
                          memcmp(now->place, m->inputs.place, sizeof now->place) != 0)) {
        memcpy(m->past.axis, m->inputs.axis, sizeof m->past.axis);
        memcpy(m->past.place, m->inputs.place, sizeof m->past.place);
        m->past.block = m->space ? m->space->step : 0;
        m->past.isSet = m->space != 0;
    }
    m->inputs = *now;
    m->stamp = mcd_modelNewStamp(m);
    m->isPlaced = mcd_isValidTransform(mcd_const(m->instance.tm));
    if (m->isPlaced)
        mcd_shapeAxes(mcd_const(m->instance.tm), m->shape.axis);
    mcd_fromReal(m->shape.place, now->place);
    if (!isOtherShape)
        return;
    mcd_shapeSizes(m->instance.geometry, &m->shape);
    m->shapeStamp = m->stamp | (hasSurface(&m->instance) ? MCD_HAS_SURFACE : 0);
    m->types = 0;
    const MeBool areTypesKnown = mcd_instanceTypes(&m->instance, &m->types);
    MEASSERT(areTypesKnown); /* inputs that can be compared are those of built-in types without parts' materials */
    (void)areTypesKnown;
    McdGeometryGetBSphere(m->instance.geometry, centre, &m->radius);
    m->reach = m->radius + MeVector3Magnitude(centre);
}

MeU64 mcd_modelCompare(McdModelRecord *m) {
    McdModelInputs now;
    m->comparedIn = m->frame->round;
    if (!readInputs(m, &now))
        m->stamp = m->shapeStamp = 0;
    else if (m->stamp == 0 || memcmp(&now, &m->inputs, sizeof now) != 0)
        storeInputs(m, &now);
    return m->stamp;
}

static MeBool isComparedInRound(const McdModelRecord *m) {
    return m->comparedIn == m->frame->round;
}

/* The children of a frozen model, which is not updated, may be where a query placed them, or where it was when it was
 * frozen. */
MeU64 mcd_modelCompareInRound(McdModelRecord *m) {
    if (isComparedInRound(m))
        return m->stamp;
    if (!mcd_areChildrenPlaced(&m->instance))
        mcd_modelRefresh(m);
    return mcd_modelCompare(m);
}

void MEAPI McdFrameworkBeginRound(McdFrameworkID frame) {
    MEASSERT(frame);
    frame->round++;
}

/* The pose of the first model relative to the second; both have been compared in this round. */
static McdStand relativePose(const McdModelPair *p) {
    const McdModelInputs *a = &mcd_record(p->model1)->inputs, *b = &mcd_record(p->model2)->inputs;
    McdStand s;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            s.axes[i][j] =
                a->axis[i][0] * b->axis[j][0] + a->axis[i][1] * b->axis[j][1] + a->axis[i][2] * b->axis[j][2];
    const MeReal between[3] = {a->place[0] - b->place[0], a->place[1] - b->place[1], a->place[2] - b->place[2]};
    for (int j = 0; j < 3; j++)
        s.place[j] = between[0] * b->axis[j][0] + between[1] * b->axis[j][1] + between[2] * b->axis[j][2];
    s.size = s.apart = 0;
    return s;
}

/* m: an upper bound of the displacement, relative to the second model, of all points of the first one within `reach`
 * of its origin: the 1-norm of the relative position's change, plus ||R' - R|| times the reach. The difference of
 * two rotations has the spectral norm ||.||_F / sqrt(2), at most 3 / sqrt(2) times its largest entry. */
static MeReal relativeDisplacement(const McdStand *before, const McdStand *now, MeReal reach) {
    MeReal turn = 0, distance = 0;
    for (int i = 0; i < 3; i++) {
        distance += MeFabs(now->place[i] - before->place[i]);
        for (int j = 0; j < 3; j++)
            turn = MeMAX(turn, MeFabs(now->axes[i][j] - before->axes[i][j]));
    }
    return distance + (MeReal)2.1214 * turn * reach;
}

static MeReal sumOfCoordinates(const MeReal v[3]) {
    return MeFabs(v[0]) + MeFabs(v[1]) + MeFabs(v[2]);
}

/* Whether the gap at the last test exceeds the sum of the relative displacement since then and the current
 * speculative margin. */
static MeBool isStillSeparated(const McdModelPair *p, const McdStand *now) {
    const McdModelRecord *m1 = mcd_record(p->model1), *m2 = mcd_record(p->model2);
    /* about four roundings each of positions, which are sums of three products, and of axes times the reach */
    const MeReal rounding =
        8 * ME_EPSILON * (sumOfCoordinates(p->stand.place) + sumOfCoordinates(now->place) + m1->reach);
    return p->stand.apart > 0 && !mcd_areFast(m1, m2) &&
           relativeDisplacement(&p->stand, now, m1->reach) + (MeReal)mcd_pairReachInRound(p).margin + rounding <
               p->stand.apart;
}

/* Whether no point of the smaller model has moved by more than a fraction of its size, so that the contacts may be
 * moved along. If the first model is the larger one, only its points near the second one count. */
static MeBool hasMovedLittle(const McdModelPair *p, const McdStand *now, MeReal share) {
    const McdModelRecord *m1 = mcd_record(p->model1), *m2 = mcd_record(p->model2);
    const MeReal margin = m1->tolerance + m2->tolerance, size = p->stand.size;
    const MeReal reach = m1->radius > m2->radius ? size + sumOfCoordinates(p->stand.place) : size;
    return relativeDisplacement(&p->stand, now, reach) < MeMIN(share * size, margin / 4);
}

/* Whether the last test can be used for another pose. */
static MeBool mayReuseTest(const McdModelPair *p, MeReal share) {
    return p->stand.size > 0 && (p->stand.apart > 0 || share > 0);
}

static void storePose(McdModelPair *p, const McdStand *now) {
    p->stand = *now;
    p->stand.size = MeMIN(mcd_record(p->model1)->radius, mcd_record(p->model2)->radius);
}

/* Whether all inputs of the test are unchanged, apart from poses and velocities of models that may move. */
static MeBool areInputsUnchanged(const McdTest *now, const McdTest *before, const MeBool mayMove[2]) {
    return (now->stamp1 == before->stamp1 || mayMove[0]) && (now->stamp2 == before->stamp2 || mayMove[1]) &&
           now->shape1 == before->shape1 && now->shape2 == before->shape2 &&
           now->contactMaxCount == before->contactMaxCount && now->faceNormalsFirst == before->faceNormalsFirst;
}

static MeBool hasChildren(const McdModelRecord *m) {
    return mcd_asAggregate(m->instance.geometry) != 0;
}

/* Whether each interaction of the models' shapes, or of their parts, is the library's. Both models have stamps. */
static MeBool isBuiltIn(const McdModelPair *p) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    return hasChildren(a) || hasChildren(b) ? mcd_typesInteractAsBuiltIn(a->frame, a->types, b->types)
                                            : mcd_interactionIsBuiltIn(p);
}

static MeBool isFrozen(const McdModelRecord *m) {
    return m->space && ((const McdProxy *)m->proxy)->isFrozen;
}

/* Whether a model, or a part of it, is a surface whose triangles the program may have changed. */
static MeBool hasSurfaces(const McdModelPair *p) {
    return ((p->test.shape1 | p->test.shape2) & MCD_HAS_SURFACE) != 0;
}

/* Whether all models that may move are frozen. */
static MeBool areMoversFrozen(const McdModelPair *p, const MeBool mayMove[2]) {
    return (!mayMove[0] || isFrozen(mcd_record(p->model1))) && (!mayMove[1] || isFrozen(mcd_record(p->model2)));
}

/* Sets the inputs of the pair's test to the current ones. Member by member, since they are read soon: a copy of the
 * whole struct would stall until all members are stored. */
static void storeTestInputs(McdModelPair *p, McdModelRecord *m1, McdModelRecord *m2) {
    const McdRequest *request = p->request ? p->request : m1->frame->defaultRequest;
    McdTest *t = &p->test;
    t->stamp1 = mcd_modelCompareInRound(m1);
    t->stamp2 = mcd_modelCompareInRound(m2);
    t->contactMaxCount = request->contactMaxCount;
    t->faceNormalsFirst = request->faceNormalsFirst;
    t->shape1 = m1->shapeStamp;
    t->shape2 = m2->shapeStamp;
}

/* ---- pairs ------------------------------------------------------------------------------------------------------- */

void MEAPI McdModelPairCompareModels(const McdModelPair *p) {
    mcd_modelCompareInRound(mcd_record(p->model1));
    mcd_modelCompareInRound(mcd_record(p->model2));
}

MeBool MEAPI McdModelPairHasComparedModels(const McdModelPair *p) {
    return isComparedInRound(mcd_record(p->model1)) && isComparedInRound(mcd_record(p->model2));
}

McdPairChange MEAPI McdModelPairCompare(McdModelPair *p, MeReal share, const MeBool mayMove[2]) {
    static const MeBool neither[2] = {MEFALSE, MEFALSE};
    MEASSERT(p && p->model1 && p->model2 && mayMove);
    McdModelRecord *m1 = mcd_record(p->model1), *m2 = mcd_record(p->model2);
    const McdTest before = p->test, *now = &p->test;
    storeTestInputs(p, m1, m2);
    const MeBool isComparable = now->stamp1 != 0 && now->stamp2 != 0 && before.stamp1 != 0 && before.stamp2 != 0 &&
                                (!hasSurfaces(p) || areMoversFrozen(p, mayMove)) && isBuiltIn(p);
    if (isComparable && areInputsUnchanged(now, &before, neither))
        return McdPairIsUnchanged;
    if (isComparable && areInputsUnchanged(now, &before, mayMove) && mayReuseTest(p, share)) {
        const McdStand stand = relativePose(p);
        if (isStillSeparated(p, &stand))
            return McdPairIsSeparated;
        if (share > 0 && hasMovedLittle(p, &stand, share))
            return McdPairHasMoved;
        storePose(p, &stand);
    } else {
        McdModelPairStoreTest(p);
    }
    return McdPairHasChanged;
}

MeU32 MEAPI McdModelPairGetTraits(const McdModelPair *p, MeU32 material[2]) {
    const McdModelRecord *a = mcd_modelCheck(p->model1, __func__), *b = mcd_modelCheck(p->model2, __func__);
    material[0] = a ? a->material : 0;
    material[1] = b ? b->material : 0;
    if (!a || !b)
        return 0;
    return (isFrozen(a) && isFrozen(b) ? McdPairIsAsleep : 0) | (a->isSensor || b->isSensor ? McdPairHasSensor : 0) |
           (mcd_areFast(a, b) ? McdPairIsFast : 0) | (a->isGone || b->isGone ? McdPairIsGone : 0);
}

/* Whether the model is one convex shape or a plane: the kinds with a size that are not surfaces. */
static MeBool isConvexOrPlane(const McdModelRecord *m) {
    const McdKind *kind = mcd_kindOf(m->instance.geometry);
    return kind && kind->size > 0 && !kind->gather;
}

/* The types of a model as by mcd_instanceTypes, from the record if it has been compared in this round. */
static MeBool typesOfModel(const McdModelRecord *m, MeU64 *types) {
    if (m->stamp == 0 || !isComparedInRound(m))
        return mcd_instanceTypes(&m->instance, types);
    *types = m->types;
    return METRUE;
}

MeBool MEAPI McdModelPairIsPlain(const McdModelPair *p) {
    const McdModelRecord *a = mcd_record(p->model1), *b = mcd_record(p->model2);
    if (a->intersect || b->intersect || mcd_piecesCallProgram(a, b) || mcd_piecesCallProgram(b, a))
        return MEFALSE;
    if (isConvexOrPlane(a) && isConvexOrPlane(b))
        return mcd_interactionIsBuiltIn(p);
    MeU64 types[2] = {0, 0};
    return !mcd_areFast(a, b) && typesOfModel(a, &types[0]) && typesOfModel(b, &types[1]) &&
           mcd_typesInteractAsBuiltIn(a->frame, types[0], types[1]);
}

void MEAPI McdModelPairStoreTest(McdModelPair *p) {
    if (p->test.stamp1 == 0 || p->test.stamp2 == 0) {
        p->stand.size = p->stand.apart = 0;
        return;
    }
    const McdStand now = relativePose(p);
    storePose(p, &now);
}

void MEAPI McdModelPairStoreGap(McdModelPair *p, MeReal apart) {
    MEASSERT(p && apart >= 0);
    p->stand.apart = apart;
}

void MEAPI McdModelPairForgetTest(McdModelPair *p) {
    MEASSERT(p);
    memset(&p->test, 0, sizeof p->test);
    p->stand.size = p->stand.apart = 0;
}
