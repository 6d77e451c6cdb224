/* Links between models and bodies. A body knows its first model, a model the next one of its body. */
#include "MstModelDynamics.h"
#include "MeAssert.h"
#include "MeMessage.h"

static MeBool isModel(McdModelID m, const char *function) {
    if (McdModelIsValid(m))
        return METRUE;
    MeWarning(1, "%s: %p is no model", function, (void *)m);
    return MEFALSE;
}

/* Is the model once in the body's list, and do all models there say that it is their body? */
static MeBool isOfBody(const McdModel *m, MdtBodyID b) {
    int found = 0;
    for (McdModelID other = MdtBodyGetModel(b); other; other = other->mOfBody) {
        if (other->mBody != b)
            return MEFALSE;
        found += other == m;
    }
    return found == 1;
}

/* Takes the model out of its body's list. */
static void MEAPI unlinkModel(McdModel *m) {
    const MdtBodyID b = m->mBody;
    const MeBool isLive = MdtBodyIsValid(b); /* it may have gone with its world */
    McdModelID first = isLive ? MdtBodyGetModel(b) : 0;
    MEASSERT(!isLive || isOfBody(m, b));
    if (isLive && first == m)
        MdtBodySetModel(b, m->mOfBody);
    for (McdModelID other = first; other; other = other->mOfBody)
        if (other->mOfBody == m)
            other->mOfBody = m->mOfBody;
    m->mOfBody = 0;
    m->mLeave = 0;
    m->mBody = 0;
}

static void detachModel(McdModelID m) {
    const MdtBodyID b = m->mBody;
    if (McdModelGetTransformPtr(m) == MdtBodyGetTransformPtr(b))
        McdModelSetTransformPtr(m, 0);
    McdModelSetLinearVelocityPtr(m, 0);
    McdModelSetAngularVelocityPtr(m, 0);
    unlinkModel(m);
}

void MEAPI McdModelSetBody(const McdModelID m, const MdtBodyID b) {
    if (!isModel(m, "McdModelSetBody"))
        return;
    if (m->mLeave)
        detachModel(m);
    McdModelSetBodyData(m, b);
    if (!b)
        return;
    m->mOfBody = MdtBodyGetModel(b);
    m->mLeave = unlinkModel;
    MdtBodySetModel(b, m);
    MEVALIDATE(isOfBody(m, b));
    McdModelSetTransformPtr(m, MdtBodyGetTransformPtr(b));
    McdModelSetLinearVelocityPtr(m, MdtBodyGetLinearVelocityPtr(b));
    McdModelSetAngularVelocityPtr(m, MdtBodyGetAngularVelocityPtr(b));
}

MdtBodyID MEAPI McdModelGetBody(const McdModelID m) {
    return isModel(m, "McdModelGetBody") ? m->mBody : 0;
}

void MEAPI McdModelDynamicsReset(const McdModelID m) {
    const MdtBodyID b = McdModelGetBody(m);
    if (!b)
        return;
    MdtBodySetPosition(b, 0, 0, 0);
    MdtBodySetQuaternion(b, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
}
