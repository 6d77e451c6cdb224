/* Links between models and bodies: each body points to its first model, each model to the next one of the same body. */
#include "MstModelDynamics.h"
#include "McdInternal.h"
#include "MdtInternal.h"
#include "MeAssert.h"
#include "MeInternal.h"
#include "MeMessage.h"

static MeBool isModel(McdModelID m, const char *function) {
    if (McdModelIsValid(m))
        return METRUE;
    MeWarning(1, "%s: %p is no model", function, (void *)m);
    return MEFALSE;
}

/* Whether the list of the body's models has this model once, and only models of this body. */
static MeBool isOfBody(const McdModel *m, MdtBodyID b) {
    int found = 0;
    for (McdModelID other = MdtBodyGetModel(b); other; other = other->mOfBody) {
        if (other->mBody != b)
            return MEFALSE;
        found += other == m;
    }
    return found == 1;
}

/* ---- callbacks of bodies (MdtBodyUser) --------------------------------------------------------------------------- */

static void detachModel(McdModelID m);

static MeStage *MEAPI guardStageOf(const MdtBodyID b) {
    MeStage *stage = 0;
    for (McdModelID m = MdtBodyGetModel(b); m && !stage; m = m->mOfBody)
        stage = McdModelGetGuardStage(m);
    return stage;
}

static void MEAPI markModelsGone(const MdtBodyID b) {
    for (McdModelID m = MdtBodyGetModel(b); m; m = m->mOfBody)
        McdModelSetGone(m, METRUE);
}

/* Detaches all models of a body that is destroyed. Those placed by it have no transform until one is set, and are
 * marked unfrozen, so that the space notices. */
static void MEAPI detachModels(const MdtBodyID b) {
    for (McdModelID m = MdtBodyGetModel(b); m; m = MdtBodyGetModel(b)) {
        detachModel(m);
        McdModelSetGone(m, MEFALSE);
        if (!McdModelGetTransformPtr(m))
            McdModelDropBox(m);
    }
}

static void MEAPI markModelsChanged(const MdtBodyID b) {
    for (McdModelID m = MdtBodyGetModel(b); m; m = m->mOfBody)
        McdModelMarkChanged(m);
}

static const MdtBodyUser modelCallbacks = {guardStageOf, markModelsGone, detachModels, markModelsChanged};

static void setModels(MdtBodyID b, McdModelID first) {
    MdtBodySetUser(b, first, first ? &modelCallbacks : 0);
}

/* ---- links ------------------------------------------------------------------------------------------------------- */

/* Removes the model from its body's list. Its pairs lose their contacts, which belong to the body. */
static void MEAPI unlinkModel(McdModel *m) {
    const MdtBodyID b = m->mBody;
    McdModelID first = MdtBodyGetModel(b);
    MEASSERT(isOfBody(m, b));
    if (first == m)
        setModels(b, m->mOfBody);
    for (McdModelID other = first; other; other = other->mOfBody)
        if (other->mOfBody == m)
            other->mOfBody = m->mOfBody;
    McdModelForgetPairs(m);
    m->mOfBody = 0;
    m->mLeave = 0;
    m->mBody = 0;
}

/* Whether the model's transform is the body's, or relative to it. */
static MeBool isPlacedBy(McdModelID m, MdtBodyID b) {
    MeMatrix4Ptr relative, reference;
    McdModelGetRelativeTransformPtrs(m, &relative, &reference);
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(b);
    return McdModelGetTransformPtr(m) == tm || reference == tm;
}

static void detachModel(McdModelID m) {
    if (isPlacedBy(m, m->mBody))
        McdModelSetTransformPtr(m, 0);
    McdModelSetLinearVelocityPtr(m, 0);
    McdModelSetAngularVelocityPtr(m, 0);
    unlinkModel(m);
}

static MeBool isBody(MdtBodyID b, const char *function) {
    if (!b || MdtBodyIsValid(b))
        return METRUE;
    MeWarning(1, "%s: the body has been destroyed, or never was one; nothing is changed", function);
    return MEFALSE;
}

void MEAPI McdModelSetBody(const McdModelID m, const MdtBodyID b) {
    static const char function[] = "McdModelSetBody";
    if (!isModel(m, function) || !isBody(b, function) || !MeProgramMayChange(function) ||
        !McdModelMayBePlaced(m, function))
        return;
    if (m->mBody && MdtBodyIsHidden(m->mBody))
        m->mLeave(m);
    else if (m->mLeave)
        detachModel(m);
    McdModelForgetPairs(m);
    McdModelSetBodyData(m, b);
    if (!b)
        return;
    m->mOfBody = MdtBodyHasUser(b) ? MdtBodyGetModel(b) : 0;
    m->mLeave = unlinkModel;
    setModels(b, m);
    MEVALIDATE(isOfBody(m, b));
    McdModelSetTransformPtr(m, MdtBodyGetTransformPtr(b));
    McdModelSetLinearVelocityPtr(m, MdtBodyGetLinearVelocityPtr(b));
    McdModelSetAngularVelocityPtr(m, MdtBodyGetAngularVelocityPtr(b));
}

MdtBodyID MEAPI McdModelGetBody(const McdModelID m) {
    const MdtBodyID b = isModel(m, "McdModelGetBody") ? m->mBody : 0;
    return b && !MdtBodyIsHidden(b) ? b : 0;
}

void MEAPI McdModelDynamicsReset(const McdModelID m) {
    const MdtBodyID b = isModel(m, "McdModelDynamicsReset") ? McdModelGetBody(m) : 0;
    if (!b)
        return;
    MdtBodySetPosition(b, 0, 0, 0);
    MdtBodySetQuaternion(b, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
}

/* ---- the body's properties ---- */

/* The model's body; null, with a warning, if it has none. */
static MdtBodyID bodyOf(McdModelID m, const char *function) {
    if (!isModel(m, function))
        return 0;
    if (!m->mBody || MdtBodyIsHidden(m->mBody))
        MeWarning(1,
                  "%s: the model has no body, or its body was destroyed; a fixed model is moved by its transform: "
                  "McdModelSetTransformPtr",
                  function);
    return m->mBody && !MdtBodyIsHidden(m->mBody) ? m->mBody : 0;
}

void MEAPI McdModelDynamicsEnable(const McdModelID m) {
    const MdtBodyID b = bodyOf(m, __func__);
    if (b)
        MdtBodyEnable(b);
}

void MEAPI McdModelDynamicsDisable(const McdModelID m) {
    const MdtBodyID b = bodyOf(m, __func__);
    if (b)
        MdtBodyDisable(b);
}

MeBool MEAPI McdModelDynamicsIsEnabled(const McdModelID m) {
    const MdtBodyID b = bodyOf(m, __func__);
    return b && MdtBodyIsEnabled(b);
}

void MEAPI McdModelDynamicsGetPosition(const McdModelID m, MeVector3 p) {
    ME_UNDER_OWN_NAME(MdtBodyGetPosition(bodyOf(m, __func__), p));
}

void MEAPI McdModelDynamicsSetPosition(const McdModelID m, const MeReal x, const MeReal y, const MeReal z) {
    ME_UNDER_OWN_NAME(MdtBodySetPosition(bodyOf(m, __func__), x, y, z));
}

void MEAPI McdModelDynamicsGetQuaternion(const McdModelID m, MeVector4 q) {
    ME_UNDER_OWN_NAME(MdtBodyGetQuaternion(bodyOf(m, __func__), q));
}

void MEAPI McdModelDynamicsSetQuaternion(const McdModelID m, const MeReal qw, const MeReal qx, const MeReal qy,
                                         const MeReal qz) {
    ME_UNDER_OWN_NAME(MdtBodySetQuaternion(bodyOf(m, __func__), qw, qx, qy, qz));
}

void MEAPI McdModelDynamicsSetTransform(const McdModelID m, const MeMatrix4 t) {
    ME_UNDER_OWN_NAME(MdtBodySetTransform(bodyOf(m, __func__), t));
}

void MEAPI McdModelDynamicsGetLinearVelocity(const McdModelID m, MeVector3 v) {
    ME_UNDER_OWN_NAME(MdtBodyGetLinearVelocity(bodyOf(m, __func__), v));
}

void MEAPI McdModelDynamicsSetLinearVelocity(const McdModelID m, const MeReal x, const MeReal y, const MeReal z) {
    ME_UNDER_OWN_NAME(MdtBodySetLinearVelocity(bodyOf(m, __func__), x, y, z));
}

void MEAPI McdModelDynamicsGetAngularVelocity(const McdModelID m, MeVector3 v) {
    ME_UNDER_OWN_NAME(MdtBodyGetAngularVelocity(bodyOf(m, __func__), v));
}

void MEAPI McdModelDynamicsSetAngularVelocity(const McdModelID m, const MeReal x, const MeReal y, const MeReal z) {
    ME_UNDER_OWN_NAME(MdtBodySetAngularVelocity(bodyOf(m, __func__), x, y, z));
}

void MEAPI McdModelDynamicsGetForce(const McdModelID m, MeVector3 f) {
    ME_UNDER_OWN_NAME(MdtBodyGetForce(bodyOf(m, __func__), f));
}

void MEAPI McdModelDynamicsGetTorque(const McdModelID m, MeVector3 t) {
    ME_UNDER_OWN_NAME(MdtBodyGetTorque(bodyOf(m, __func__), t));
}

void MEAPI McdModelDynamicsAddForce(const McdModelID m, const MeReal fx, const MeReal fy, const MeReal fz) {
    ME_UNDER_OWN_NAME(MdtBodyAddForce(bodyOf(m, __func__), fx, fy, fz));
}

void MEAPI McdModelDynamicsAddTorque(const McdModelID m, const MeReal tx, const MeReal ty, const MeReal tz) {
    ME_UNDER_OWN_NAME(MdtBodyAddTorque(bodyOf(m, __func__), tx, ty, tz));
}

void MEAPI McdModelDynamicsSetDamping(const McdModelID m, const MeReal lvd, const MeReal avd) {
    ME_UNDER_OWN_NAME({
        const MdtBodyID b = bodyOf(m, __func__);
        MdtBodySetLinearVelocityDamping(b, lvd);
        MdtBodySetAngularVelocityDamping(b, avd);
    });
}
