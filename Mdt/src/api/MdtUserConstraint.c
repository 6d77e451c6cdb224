/* API of the user constraint. Memory for its rows is allocated at its creation. */
#include "api/mdt_api_i.h"

/* The functions of MDT_JOINT_BASICS; creation also allocates the rows. */
MdtUserConstraintID MEAPI MdtUserConstraintCreate(const MdtWorldID w) {
    MdtJoint *c = mdt_jointCreate(w, MdtBclUSER, __func__);
    if (!c)
        return NULL;
    c->bcl.of.user.owner = c;
    c->bcl.of.user.rows = MeMemoryTake(MdtBclGETMAXROWSUSER, sizeof(MdtKeaRow), __func__, "rows");
    if (c->bcl.of.user.rows)
        return (MdtUserConstraintID)c;
    MdtConstraintDestroy(&c->base);
    return NULL;
}

MDT_JOINT_CASTS(UserConstraint, MdtBclUSER)
MDT_JOINT_DATA(UserConstraint, MdtBclUSER, MdtBclUser, user)

void MEAPI MdtUserConstraintSetFunction(const MdtUserConstraintID j, MdtBclAddConstraintFn f) {
    Data *user = dataOf(j, __func__);
    if (user)
        user->function = f;
}

MdtBclAddConstraintFn MEAPI MdtUserConstraintGetFunction(const MdtUserConstraintID j) {
    const Data *user = dataOf(j, __func__);
    return user ? user->function : NULL;
}

void MEAPI MdtUserConstraintSetConstraintData(const MdtUserConstraintID j, void *d) {
    Data *user = dataOf(j, __func__);
    if (user)
        user->owner = d;
}

void *MEAPI MdtUserConstraintGetConstraintData(const MdtUserConstraintID j) {
    const Data *user = dataOf(j, __func__);
    return user ? user->owner : NULL;
}
