/* Inside Mdt: declarations that the files of the API share. */
#ifndef MDT_API_I_H
#define MDT_API_I_H

#include "record/mdt_point_i.h"
#include "record/mdt_named_i.h"

/* The four functions that every joint has. A joint's handle is a constraint's handle, so that they convert by a cast.
 * */
#define MDT_JOINT_BASICS(Joint, TYPE)                                                                                  \
    Mdt##Joint##ID MEAPI Mdt##Joint##Create(const MdtWorldID w) {                                                      \
        return (Mdt##Joint##ID)mdt_jointCreate(w, TYPE, __func__);                                                     \
    }                                                                                                                  \
    MDT_JOINT_CASTS(Joint, TYPE)
#define MDT_JOINT_CASTS(Joint, TYPE)                                                                                   \
    void MEAPI Mdt##Joint##Reset(const Mdt##Joint##ID j) {                                                             \
        MdtJoint *c = mdt_jointOfType(j, TYPE, __func__);                                                              \
        if (c)                                                                                                         \
            c->type->reset(&c->bcl);                                                                                   \
    }                                                                                                                  \
    MdtConstraintID MEAPI Mdt##Joint##QuaConstraint(const Mdt##Joint##ID j) {                                          \
        return (MdtConstraintID)j;                                                                                     \
    }                                                                                                                  \
    Mdt##Joint##ID MEAPI MdtConstraintDCast##Joint(const MdtConstraintID c) {                                          \
        return mdt_jointCast(c, TYPE, __func__);                                                                       \
    }

/* Position and depth of a contact now: moved along with its bodies since the step began. */
void mdt_pointGetCurrent(const MdtPoint *p, double position[3], double *depth);

#endif
