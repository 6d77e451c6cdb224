/* Functions of all constraints, which programs call as MdtConstraint... or under the name of each joint. `caller` is
 * that name, for messages (mdt_named.c). */
#ifndef MDT_NAMED_I_H
#define MDT_NAMED_I_H

#include "base/mdt_base_i.h"

void mdt_constraintDestroy(MdtConstraintID c, const char *caller);
void mdt_constraintEnable(MdtConstraintID handle, const char *caller);
void mdt_constraintDisable(MdtConstraintID handle, const char *caller);
MeBool mdt_constraintIsEnabled(MdtConstraintID c, const char *caller);
void mdt_constraintSetBodies(MdtConstraintID c, MdtBodyID b1, MdtBodyID b2, const char *caller);
MdtBodyID mdt_constraintGetBody(MdtConstraintID c, unsigned int bodyindex, const char *caller);
void mdt_constraintGetForce(MdtConstraintID c, unsigned int bodyindex, MeVector3 f, const char *caller);
void mdt_constraintGetTorque(MdtConstraintID c, unsigned int bodyindex, MeVector3 t, const char *caller);
MdtWorldID mdt_constraintGetWorld(MdtConstraintID c, const char *caller);
void mdt_constraintSetUserData(MdtConstraintID c, void *d, const char *caller);
void *mdt_constraintGetUserData(MdtConstraintID c, const char *caller);
void mdt_constraintSetSortKey(MdtConstraintID c, MeI32 key, const char *caller);
MeI32 mdt_constraintGetSortKey(MdtConstraintID c, const char *caller);
void mdt_constraintGetPosition(MdtConstraintID c, MeVector3 p, const char *caller);
void mdt_constraintBodyGetPosition(MdtConstraintID c, unsigned int bodyindex, MeVector3 p, const char *caller);
void mdt_constraintBodySetPosition(MdtConstraintID c, unsigned int bodyindex, MeReal x, MeReal y, MeReal z,
                                   const char *caller);
void mdt_constraintSetPosition(MdtConstraintID c, MeReal x, MeReal y, MeReal z, const char *caller);
void mdt_constraintSetAxis(MdtConstraintID c, MeReal px, MeReal py, MeReal pz, const char *caller);
void mdt_constraintSetAxes(MdtConstraintID c, MeReal px, MeReal py, MeReal pz, MeReal ox, MeReal oy, MeReal oz,
                           const char *caller);
void mdt_constraintBodySetAxes(MdtConstraintID c, unsigned int bodyindex, MeReal px, MeReal py, MeReal pz, MeReal ox,
                               MeReal oy, MeReal oz, const char *caller);
void mdt_constraintBodySetAxesRel(MdtConstraintID c, unsigned int bodyindex, MeReal px, MeReal py, MeReal pz, MeReal ox,
                                  MeReal oy, MeReal oz, const char *caller);
void mdt_constraintGetAxes(MdtConstraintID c, MeVector3 p, MeVector3 o, const char *caller);
void mdt_constraintBodyGetAxes(MdtConstraintID c, unsigned int bodyindex, MeVector3 p, MeVector3 o, const char *caller);

#endif
