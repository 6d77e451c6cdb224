/* Models with bodies: who belongs to whom. A body knows its first model, a model the next one of its body. */
#include "MstModelDynamics.h"
#include "MeMessage.h"

static MeBool isModel(McdModelID m, const char *function) {
    if (McdModelIsValid(m))
        return METRUE;
    MeWarning(1, "%s: %p is no model", function, (void *)m);
    return MEFALSE;
}

/* Takes the model out of its body's list. */
static void MEAPI leave(McdModel *m) {
    const MdtBodyID b = m->mBody;
    McdModelID first = MdtBodyGetModel(b);
    if (first == m)
        MdtBodySetModel(b, m->mOfBody);
    for (McdModelID other = first; other; other = other->mOfBody)
        if (other->mOfBody == m)
            other->mOfBody = m->mOfBody;
    m->mOfBody = 0;
    m->mLeave = 0;
    m->mBody = 0;
}

static void part(McdModelID m) {
    const MdtBodyID b = m->mBody;
    if (McdModelGetTransformPtr(m) == MdtBodyGetTransformPtr(b))
        McdModelSetTransformPtr(m, 0);
    McdModelSetLinearVelocityPtr(m, 0);
    McdModelSetAngularVelocityPtr(m, 0);
    leave(m);
}

void MEAPI McdModelSetBody(const McdModelID m, const MdtBodyID b) {
    if (!isModel(m, "McdModelSetBody"))
        return;
    if (m->mLeave)
        part(m);
    McdModelSetBodyData(m, b);
    if (!b)
        return;
    m->mOfBody = MdtBodyGetModel(b);
    m->mLeave = leave;
    MdtBodySetModel(b, m);
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
