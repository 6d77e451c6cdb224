/* What Karma's engines have in common: the states of bodies, the forces on them, and joints. */
#ifndef BENCH_KARMA_BODY_H
#define BENCH_KARMA_BODY_H

#include "engine.h"
#include "scene.h"

#include "Mdt.h"
#include "MdtReport.h"

#ifdef _ME_API_DOUBLE
#define KARMA_NAME      "Karma double"
#define KARMA_PRECISION "double precision"
#else
#define KARMA_NAME      "Karma single"
#define KARMA_PRECISION "single precision"
#endif

static inline void karma_setState(MdtBodyID body, const SceneState *s) {
    MdtBodySetPosition(body, (MeReal)s->position[0], (MeReal)s->position[1], (MeReal)s->position[2]);
    MdtBodySetQuaternion(body, (MeReal)s->quaternion[0], (MeReal)s->quaternion[1], (MeReal)s->quaternion[2],
                         (MeReal)s->quaternion[3]);
    MdtBodySetLinearVelocity(body, (MeReal)s->velocity[0], (MeReal)s->velocity[1], (MeReal)s->velocity[2]);
    MdtBodySetAngularVelocity(body, (MeReal)s->spin[0], (MeReal)s->spin[1], (MeReal)s->spin[2]);
    MdtBodyEnable(body);
}

static inline void karma_getState(MdtBodyID body, SceneState *s) {
    MeVector3 position, velocity, spin;
    MeVector4 quaternion;
    MdtBodyGetPosition(body, position);
    MdtBodyGetQuaternion(body, quaternion);
    MdtBodyGetLinearVelocity(body, velocity);
    MdtBodyGetAngularVelocity(body, spin);
    s->quaternion[0] = (double)quaternion[0];
    for (int i = 0; i < 3; i++) {
        s->position[i] = (double)position[i];
        s->quaternion[i + 1] = (double)quaternion[i + 1];
        s->velocity[i] = (double)velocity[i];
        s->spin[i] = (double)spin[i];
    }
}

static inline void karma_push(MdtBodyID body, const SceneBody *b, double time) {
    if (scene_isPushed(b, time))
        MdtBodyAddForce(body, (MeReal)b->force[0], (MeReal)b->force[1], (MeReal)b->force[2]);
}

/* By its own report of the last step: a step that is not exact, or joints that contradict each other. */
static inline bool karma_isInexact(MdtWorldID world) {
    MdtReport report;
    MdtWorldGetReport(world, &report);
    return report.fallbacks > 0 || report.conflicts > 0;
}

/* Nothing comes to rest. */
static inline void karma_setWorld(MdtWorldID world, int setting, const double gravity[3]) {
    MdtWorldSetAutoDisable(world, 0);
    if (setting != ENGINE_DEFAULTS)
        MdtWorldSetEpsilon(world, 0);
    MdtWorldSetGravity(world, (MeReal)gravity[0], (MeReal)gravity[1], (MeReal)gravity[2]);
}

static inline void karma_setLimit(MdtLimitID limit, const SceneJoint *j) {
    if (j->stops[0] < j->stops[1]) {
        MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), (MeReal)j->stops[0]);
        MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), (MeReal)j->stops[1]);
        MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
        MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), 0);
        MdtLimitActivateLimits(limit, METRUE);
    }
    if (j->stiffness > 0) {
        const MdtSingleLimitID stops[2] = {MdtLimitGetLowerLimit(limit), MdtLimitGetUpperLimit(limit)};
        MdtLimitSetStiffnessThreshold(limit, MEINFINITY);
        for (int i = 0; i < 2; i++) {
            MdtSingleLimitSetStop(stops[i], (MeReal)j->rest);
            MdtSingleLimitSetStiffness(stops[i], (MeReal)j->stiffness);
            MdtSingleLimitSetDamping(stops[i], (MeReal)j->damping);
        }
        MdtLimitActivateLimits(limit, METRUE);
    }
    if (j->torque > 0) {
        MdtLimitSetLimitedForceMotor(limit, (MeReal)j->speed, (MeReal)j->torque);
        MdtLimitActivateMotor(limit, METRUE);
    }
}

static inline MdtConstraintID karma_join(MdtWorldID world, MdtBodyID child, MdtBodyID parent, const SceneJoint *j) {
    const MdtConstraintID c = j->kind == SCENE_HINGE ? MdtHingeQuaConstraint(MdtHingeCreate(world))
                                                     : MdtBSJointQuaConstraint(MdtBSJointCreate(world));
    MdtConstraintSetBodies(c, child, parent);
    MdtConstraintSetPosition(c, (MeReal)j->point[0], (MeReal)j->point[1], (MeReal)j->point[2]);
    if (j->kind == SCENE_HINGE) {
        MdtConstraintSetAxis(c, (MeReal)j->axis[0], (MeReal)j->axis[1], (MeReal)j->axis[2]);
        karma_setLimit(MdtHingeGetLimit(MdtConstraintDCastHinge(c)), j);
    }
    MdtConstraintEnable(c);
    return c;
}

/* A motor that leads along a path follows it by the angle, not by the speed at the end of the step. */
static inline void karma_lead(MdtConstraintID c, const SceneJoint *j, double time, double h) {
    const MdtLimitID limit = MdtHingeGetLimit(MdtConstraintDCastHinge(c));
    MdtLimitSetMotorTracking(limit, METRUE);
    MdtLimitSetLimitedForceMotor(limit, (MeReal)scene_motorSpeed(j, time, h), (MeReal)j->torque);
}

/* The friction cone, and how much it bounces. */
static inline void karma_setSurface(MdtContactParamsID p, double friction, double restitution) {
    if (friction > 0) {
        MdtContactParamsSetType(p, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(p, (MeReal)friction);
    }
    MdtContactParamsSetRestitution(p, (MeReal)restitution);
}

#endif
