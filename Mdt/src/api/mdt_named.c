/* Functions of all constraints, under the name MdtConstraint and under that of each joint as listed in
 * tests/structure/check_joints.py. Each passes its own name on, for messages. */
#include "Mdt.h"
#include "api/mdt_api_i.h"

#define COMMON(Joint)                                                                                                  \
    void MEAPI Mdt##Joint##Destroy(const Mdt##Joint##ID j) {                                                           \
        mdt_constraintDestroy((MdtConstraintID)j, __func__);                                                           \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##Enable(const Mdt##Joint##ID j) {                                                            \
        mdt_constraintEnable((MdtConstraintID)j, __func__);                                                            \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##Disable(const Mdt##Joint##ID j) {                                                           \
        mdt_constraintDisable((MdtConstraintID)j, __func__);                                                           \
    }                                                                                                                  \
    MeBool MEAPI Mdt##Joint##IsEnabled(const Mdt##Joint##ID j) {                                                       \
        return mdt_constraintIsEnabled((MdtConstraintID)j, __func__);                                                  \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##SetBodies(const Mdt##Joint##ID j, const MdtBodyID b1, const MdtBodyID b2) {                 \
        mdt_constraintSetBodies((MdtConstraintID)j, b1, b2, __func__);                                                 \
    }                                                                                                                  \
    MdtBodyID MEAPI Mdt##Joint##GetBody(const Mdt##Joint##ID j, const unsigned int bodyindex) {                        \
        return mdt_constraintGetBody((MdtConstraintID)j, bodyindex, __func__);                                         \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##GetForce(const Mdt##Joint##ID j, const unsigned int bodyindex, MeVector3 force) {           \
        mdt_constraintGetForce((MdtConstraintID)j, bodyindex, force, __func__);                                        \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##GetTorque(const Mdt##Joint##ID j, const unsigned int bodyindex, MeVector3 torque) {         \
        mdt_constraintGetTorque((MdtConstraintID)j, bodyindex, torque, __func__);                                      \
    }                                                                                                                  \
    MdtWorldID MEAPI Mdt##Joint##GetWorld(const Mdt##Joint##ID j) {                                                    \
        return mdt_constraintGetWorld((MdtConstraintID)j, __func__);                                                   \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##SetUserData(const Mdt##Joint##ID j, void *data) {                                           \
        mdt_constraintSetUserData((MdtConstraintID)j, data, __func__);                                                 \
    }                                                                                                                  \
    void *MEAPI Mdt##Joint##GetUserData(const Mdt##Joint##ID j) {                                                      \
        return mdt_constraintGetUserData((MdtConstraintID)j, __func__);                                                \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##SetSortKey(const Mdt##Joint##ID j, const MeI32 key) {                                       \
        mdt_constraintSetSortKey((MdtConstraintID)j, key, __func__);                                                   \
    }                                                                                                                  \
    MeI32 MEAPI Mdt##Joint##GetSortKey(const Mdt##Joint##ID j) {                                                       \
        return mdt_constraintGetSortKey((MdtConstraintID)j, __func__);                                                 \
    }

#define POSITION(Joint)                                                                                                \
    void MEAPI Mdt##Joint##SetPosition(const Mdt##Joint##ID j, const MeReal x, const MeReal y, const MeReal z) {       \
        mdt_constraintSetPosition((MdtConstraintID)j, x, y, z, __func__);                                              \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##GetPosition(const Mdt##Joint##ID j, MeVector3 position) {                                   \
        mdt_constraintGetPosition((MdtConstraintID)j, position, __func__);                                             \
    }

#define AXIS(Joint)                                                                                                    \
    void MEAPI Mdt##Joint##SetAxis(const Mdt##Joint##ID j, const MeReal x, const MeReal y, const MeReal z) {           \
        mdt_constraintSetAxis((MdtConstraintID)j, x, y, z, __func__);                                                  \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##GetAxis(const Mdt##Joint##ID j, MeVector3 axis) {                                           \
        mdt_constraintGetAxes((MdtConstraintID)j, axis, NULL, __func__);                                               \
    }

#define AXES(Joint)                                                                                                    \
    void MEAPI Mdt##Joint##SetAxes(const Mdt##Joint##ID j, const MeReal px, const MeReal py, const MeReal pz,          \
                                   const MeReal ox, const MeReal oy, const MeReal oz) {                                \
        mdt_constraintSetAxes((MdtConstraintID)j, px, py, pz, ox, oy, oz, __func__);                                   \
    }

#define BODY_AXES(Joint)                                                                                               \
    void MEAPI Mdt##Joint##BodySetAxes(const Mdt##Joint##ID j, const unsigned int bodyindex, const MeReal px,          \
                                       const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,             \
                                       const MeReal oz) {                                                              \
        mdt_constraintBodySetAxes((MdtConstraintID)j, bodyindex, px, py, pz, ox, oy, oz, __func__);                    \
    }                                                                                                                  \
    void MEAPI Mdt##Joint##BodyGetAxes(const Mdt##Joint##ID j, const unsigned int bodyindex, MeVector3 primary,        \
                                       MeVector3 ortho) {                                                              \
        mdt_constraintBodyGetAxes((MdtConstraintID)j, bodyindex, primary, ortho, __func__);                            \
    }

#define GET_AXES(Joint)                                                                                                \
    void MEAPI Mdt##Joint##GetAxes(const Mdt##Joint##ID j, MeVector3 primary, MeVector3 ortho) {                       \
        mdt_constraintGetAxes((MdtConstraintID)j, primary, ortho, __func__);                                           \
    }

#define BODY_AXES_REL(Joint)                                                                                           \
    void MEAPI Mdt##Joint##BodySetAxesRel(const Mdt##Joint##ID j, const unsigned int bodyindex, const MeReal px,       \
                                          const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,          \
                                          const MeReal oz) {                                                           \
        mdt_constraintBodySetAxesRel((MdtConstraintID)j, bodyindex, px, py, pz, ox, oy, oz, __func__);                 \
    }

#define BODY_AXIS(Joint)                                                                                               \
    void MEAPI Mdt##Joint##BodyGetAxis(const Mdt##Joint##ID j, const unsigned int bodyindex, MeVector3 axis) {         \
        mdt_constraintBodyGetAxes((MdtConstraintID)j, bodyindex, axis, NULL, __func__);                                \
    }

COMMON(Constraint)
POSITION(Constraint)
AXIS(Constraint)
AXES(Constraint)
BODY_AXES(Constraint)
GET_AXES(Constraint)
BODY_AXES_REL(Constraint)
BODY_AXIS(Constraint)

COMMON(Angular3)
AXIS(Angular3)

COMMON(BSJoint)
POSITION(BSJoint)

COMMON(CarWheel)
POSITION(CarWheel)

COMMON(ConeLimit)
POSITION(ConeLimit)
AXIS(ConeLimit)
AXES(ConeLimit)
BODY_AXES(ConeLimit)
GET_AXES(ConeLimit)
BODY_AXES_REL(ConeLimit)

COMMON(Contact)

COMMON(ContactGroup)

COMMON(FPFOJoint)

COMMON(FixedPath)

COMMON(Gear)
AXIS(Gear)
BODY_AXIS(Gear)

COMMON(Hinge)
POSITION(Hinge)
AXIS(Hinge)

COMMON(Linear1)
POSITION(Linear1)
AXIS(Linear1)

COMMON(Linear2)
POSITION(Linear2)

COMMON(Mimic)

COMMON(Prismatic)
AXIS(Prismatic)

COMMON(Pulley)

COMMON(RPROJoint)

COMMON(Skeletal)
POSITION(Skeletal)
AXES(Skeletal)
BODY_AXES(Skeletal)
BODY_AXIS(Skeletal)

COMMON(Spring)

COMMON(Spring6)
POSITION(Spring6)
AXES(Spring6)
GET_AXES(Spring6)

COMMON(Universal)
POSITION(Universal)
AXES(Universal)

COMMON(UserConstraint)

/* ---- single functions ---- */

void MEAPI MdtConstraintBodySetPosition(const MdtConstraintID c, const unsigned int bodyindex, const MeReal x,
                                        const MeReal y, const MeReal z) {
    mdt_constraintBodySetPosition(c, bodyindex, x, y, z, __func__);
}

void MEAPI MdtConstraintBodyGetPosition(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p) {
    mdt_constraintBodyGetPosition(c, bodyindex, p, __func__);
}

void MEAPI MdtConstraintSetBothAxis(const MdtConstraintID c, const MeReal px, const MeReal py, const MeReal pz,
                                    const MeReal ox, const MeReal oy, const MeReal oz) {
    mdt_constraintSetAxes(c, px, py, pz, ox, oy, oz, __func__);
}

void MEAPI MdtConstraintGetBothAxes(const MdtConstraintID c, MeVector3 p, MeVector3 o) {
    mdt_constraintGetAxes(c, p, o, __func__);
}

void MEAPI MdtConstraintBodyGetBothAxes(const MdtConstraintID c, const unsigned int bodyindex, MeVector3 p,
                                        MeVector3 o) {
    mdt_constraintBodyGetAxes(c, bodyindex, p, o, __func__);
}

void MEAPI MdtConstraintBodySetBothAxis(const MdtConstraintID c, const unsigned int bodyindex, const MeReal px,
                                        const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy,
                                        const MeReal oz) {
    mdt_constraintBodySetAxes(c, bodyindex, px, py, pz, ox, oy, oz, __func__);
}

void MEAPI MdtCarWheelSetSteeringAndHingeAxes(const MdtCarWheelID j, const MeReal px, const MeReal py, const MeReal pz,
                                              const MeReal ox, const MeReal oy, const MeReal oz) {
    mdt_constraintSetAxes((MdtConstraintID)j, px, py, pz, ox, oy, oz, __func__);
}

void MEAPI MdtCarWheelGetSteeringAndHingeAxes(const MdtCarWheelID j, const unsigned int bodyindex, MeVector3 primary,
                                              MeVector3 ortho) {
    mdt_constraintBodyGetAxes((MdtConstraintID)j, bodyindex, primary, ortho, __func__);
}

void MEAPI MdtUniversalGetAxes(const MdtUniversalID j, const unsigned int bodyindex, MeVector3 primary,
                               MeVector3 ortho) {
    mdt_constraintBodyGetAxes((MdtConstraintID)j, bodyindex, primary, ortho, __func__);
}

void MEAPI MdtContactGroupTorque(const MdtContactGroupID j, const unsigned int bodyindex, MeVector3 torque) {
    mdt_constraintGetTorque((MdtConstraintID)j, bodyindex, torque, __func__);
}

void MEAPI MdtRPROSetSortKey(const MdtRPROJointID j, const MeI32 key) {
    mdt_constraintSetSortKey((MdtConstraintID)j, key, __func__);
}

MeI32 MEAPI MdtRPROGetSortKey(const MdtRPROJointID j) {
    return mdt_constraintGetSortKey((MdtConstraintID)j, __func__);
}
