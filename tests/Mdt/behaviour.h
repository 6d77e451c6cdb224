/* What the tests of documented behaviours say often: where a body is, how it moves, what a joint does. */
#ifndef BEHAVIOUR_H
#define BEHAVIOUR_H

#include "scene.h"

#define PI 3.14159265358979323846

static inline double coordinate(MdtBodyID b, int axis) {
    return (double)MdtBodyGetTransformPtr(b)[3][axis];
}

static inline double velocity(MdtBodyID b, int axis) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    return v[axis];
}

static inline double spin(MdtBodyID b, int axis) {
    MeVector3 v;
    MdtBodyGetAngularVelocity(b, v);
    return v[axis];
}

static inline double distance(const MeVector3 a, const MeVector3 b) {
    return sqrt(pow((double)a[0] - b[0], 2) + pow((double)a[1] - b[1], 2) + pow((double)a[2] - b[2], 2));
}

/* How far apart a joint's two attachments are. */
static inline double gapOf(MdtConstraintID c) {
    MeVector3 p, q;
    MdtConstraintBodyGetPosition(c, 0, p);
    MdtConstraintBodyGetPosition(c, 1, q);
    return distance(p, q);
}

static inline double forceOn(MdtConstraintID c, unsigned int body, int axis) {
    MeVector3 f;
    MdtConstraintGetForce(c, body, f);
    return f[axis];
}

#define assert_position(b, x, y, z, tolerance)                                                                         \
    do {                                                                                                               \
        MeVector3 at_;                                                                                                 \
        MdtBodyGetPosition(b, at_);                                                                                    \
        assert_vec3_near(at_, x, y, z, tolerance);                                                                     \
    } while (0)

#define assert_velocity(b, x, y, z, tolerance)                                                                         \
    do {                                                                                                               \
        MeVector3 v_;                                                                                                  \
        MdtBodyGetLinearVelocity(b, v_);                                                                               \
        assert_vec3_near(v_, x, y, z, tolerance);                                                                      \
    } while (0)

#define assert_spin(b, x, y, z, tolerance)                                                                             \
    do {                                                                                                               \
        MeVector3 w_;                                                                                                  \
        MdtBodyGetAngularVelocity(b, w_);                                                                              \
        assert_vec3_near(w_, x, y, z, tolerance);                                                                      \
    } while (0)

/* An enabled contact of a body with the floor, or with another body, the normal up. */
static inline MdtContactID scene_contact(MdtWorldID w, MdtBodyID upper, MdtBodyID lower, double x, double y, double z) {
    MdtContactID c = MdtContactCreate(w);
    MdtContactSetBodies(c, upper, lower);
    MdtContactSetPosition(c, x, y, z);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactEnable(c);
    return c;
}

#endif
