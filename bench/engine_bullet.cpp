/* Bullet, single precision, with its defaults but for the iterations of its sequential-impulse solver (10 is the
 * default). Friction and restitution of a pair are the larger ones, by its own callbacks. */
#include "engine.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace {

const int iterations[] = {10, 50};
const char *const settings[] = {"SI 10", "SI 50", nullptr};

btVector3 vector(const double v[3]) {
    return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])};
}

btScalar largerFriction(const btCollisionObject *a, const btCollisionObject *b) {
    return std::max(a->getFriction(), b->getFriction());
}

btScalar largerRestitution(const btCollisionObject *a, const btCollisionObject *b) {
    return std::max(a->getRestitution(), b->getRestitution());
}

} // namespace

/* Destroyed from the end: what uses something stands behind it. */
struct EngineWorld {
    bool collides = false;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    std::vector<SceneBody> from;
    double time = 0; /* s */
    struct Motor {
        btHingeConstraint *hinge;
        const SceneJoint *joint;
    };
    std::vector<Motor> motors;
    std::vector<std::unique_ptr<btTypedConstraint>> joints;
    std::vector<float> heights; /* of the terrain */
    std::unique_ptr<btRigidBody> ground;

    void add(btRigidBody *body) {
        world.addRigidBody(body, btBroadphaseProxy::DefaultFilter, collides ? btBroadphaseProxy::AllFilter : 0);
    }
};

namespace {

EngineWorld *create(int setting, const double gravity[3], bool collides) {
    gCalculateCombinedFrictionCallback = largerFriction;
    gCalculateCombinedRestitutionCallback = largerRestitution;
    auto *w = new EngineWorld;
    w->collides = collides;
    w->world.setGravity(vector(gravity));
    w->world.getSolverInfo().m_numIterations = iterations[setting];
    return w;
}

void addFixed(EngineWorld *w, std::unique_ptr<btCollisionShape> shape, const btVector3 &place) {
    w->shapes.push_back(std::move(shape));
    w->ground = std::make_unique<btRigidBody>(btScalar(0), nullptr, w->shapes.back().get());
    w->ground->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
    w->ground->setFriction(0);
    w->add(w->ground.get());
}

void addGround(EngineWorld *w) {
    addFixed(w, std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), btVector3(0, 0, 0));
}

/* Its origin is the middle of its box. */
void addTerrain(EngineWorld *w, const SceneTerrain *t) {
    w->heights.assign(t->heights, t->heights + t->xCount * t->zCount);
    const auto ends = std::minmax_element(w->heights.begin(), w->heights.end());
    const btScalar low = *ends.first, high = *ends.second, step = btScalar(t->step);
    auto shape =
        std::make_unique<btHeightfieldTerrainShape>(t->xCount, t->zCount, w->heights.data(), low, high, 1, false);
    shape->setLocalScaling(btVector3(step, 1, step));
    const double x = t->x0 + (t->xCount - 1) * t->step / 2, z = t->z0 + (t->zCount - 1) * t->step / 2;
    addFixed(w, std::move(shape), btVector3(btScalar(x), (low + high) / 2, btScalar(z)));
}

/* A compound does not own its parts. */
std::unique_ptr<btCollisionShape> compoundOf(EngineWorld *w, const SceneBody *b) {
    auto whole = std::make_unique<btCompoundShape>();
    for (int i = 0; i < b->numParts; i++) {
        const ScenePart &p = b->parts[i];
        const double *q = p.quaternion;
        w->shapes.push_back(std::make_unique<btBoxShape>(vector(p.half)));
        const btQuaternion turned{btScalar(q[1]), btScalar(q[2]), btScalar(q[3]), btScalar(q[0])};
        whole->addChildShape(btTransform(turned, vector(p.position)), w->shapes.back().get());
    }
    return whole;
}

std::unique_ptr<btCollisionShape> shapeOf(EngineWorld *w, const SceneBody *b) {
    if (b->shape == SCENE_COMPOUND)
        return compoundOf(w, b);
    if (b->shape == SCENE_SPHERE)
        return std::make_unique<btSphereShape>(btScalar(b->half[0]));
    if (b->shape == SCENE_CAPSULE)
        return std::make_unique<btCapsuleShapeZ>(btScalar(b->half[0]), btScalar(2 * (b->half[2] - b->half[0])));
    if (b->shape == SCENE_CYLINDER)
        return std::make_unique<btCylinderShapeZ>(vector(b->half));
    return std::make_unique<btBoxShape>(vector(b->half));
}

void place(btRigidBody *body, const SceneState *s) {
    const double *q = s->quaternion;
    const btQuaternion turned{btScalar(q[1]), btScalar(q[2]), btScalar(q[3]), btScalar(q[0])};
    body->setWorldTransform(btTransform(turned, vector(s->position)));
    body->setInterpolationWorldTransform(body->getWorldTransform());
    body->setLinearVelocity(vector(s->velocity));
    body->setAngularVelocity(vector(s->spin));
    body->updateInertiaTensor();
}

void addBody(EngineWorld *w, const SceneBody *b) {
    double inertia[3];
    scene_inertia(b, inertia);
    w->shapes.push_back(shapeOf(w, b));
    w->bodies.push_back(
        std::make_unique<btRigidBody>(btScalar(b->mass), nullptr, w->shapes.back().get(), vector(inertia)));
    w->from.push_back(*b);
    btRigidBody *body = w->bodies.back().get();
    place(body, &b->start);
    body->setFriction(btScalar(b->friction));
    body->setRestitution(btScalar(b->restitution));
    body->setActivationState(DISABLE_DEACTIVATION);
    w->add(body);
}

btVector3 localPoint(const btRigidBody &body, const double point[3]) {
    return body.getCenterOfMassTransform().inverse() * vector(point);
}

btVector3 localAxis(const btRigidBody &body, const double axis[3]) {
    return body.getCenterOfMassTransform().getBasis().transpose() * vector(axis);
}

std::unique_ptr<btTypedConstraint> makeJoint(const SceneJoint *j, btRigidBody &child, btRigidBody *parent) {
    const btVector3 point = localPoint(child, j->point), axis = localAxis(child, j->axis);
    if (j->kind == SCENE_HINGE && parent)
        return std::make_unique<btHingeConstraint>(child, *parent, point, localPoint(*parent, j->point), axis,
                                                   localAxis(*parent, j->axis));
    if (j->kind == SCENE_HINGE)
        return std::make_unique<btHingeConstraint>(child, point, axis);
    if (parent)
        return std::make_unique<btPoint2PointConstraint>(child, *parent, point, localPoint(*parent, j->point));
    return std::make_unique<btPoint2PointConstraint>(child, point);
}

/* A hinge with a spring: a joint of six directions, whose turn about the frame's x-axis alone is free. */
std::unique_ptr<btTypedConstraint> makeSpring(const SceneJoint *j, btRigidBody &child, btRigidBody *parent) {
    const btVector3 axis = vector(j->axis), across = axis.cross(btVector3(0, 1, 0)), up = across.cross(axis);
    const btMatrix3x3 turn(axis[0], up[0], across[0], axis[1], up[1], across[1], axis[2], up[2], across[2]);
    const btTransform frame(turn, vector(j->point));
    const btTransform inChild = child.getCenterOfMassTransform().inverse() * frame;
    auto spring = parent ? std::make_unique<btGeneric6DofSpring2Constraint>(
                               *parent, child, parent->getCenterOfMassTransform().inverse() * frame, inChild)
                         : std::make_unique<btGeneric6DofSpring2Constraint>(child, inChild);
    spring->setLinearLowerLimit(btVector3(0, 0, 0));
    spring->setLinearUpperLimit(btVector3(0, 0, 0));
    spring->setAngularLowerLimit(btVector3(1, 0, 0)); /* lower above upper: free */
    spring->setAngularUpperLimit(btVector3(-1, 0, 0));
    spring->enableSpring(3, true);
    spring->setStiffness(3, btScalar(j->stiffness));
    spring->setDamping(3, btScalar(j->damping));
    spring->setEquilibriumPoint(3, btScalar(-j->rest));
    return spring;
}

/* Its angle is that of the second body against the first, its largest impulse that of one step. */
void setHinge(EngineWorld *w, const SceneJoint *j, btHingeConstraint *hinge) {
    if (j->stops[0] < j->stops[1])
        hinge->setLimit(btScalar(j->stops[0]), btScalar(j->stops[1]));
    if (j->torque > 0)
        w->motors.push_back({hinge, j});
}

void addJoint(EngineWorld *w, const SceneJoint *j) {
    btRigidBody *parent = j->parent == SCENE_WORLD ? nullptr : w->bodies[size_t(j->parent)].get();
    btRigidBody &child = *w->bodies[size_t(j->child)];
    w->joints.push_back(j->stiffness > 0 ? makeSpring(j, child, parent) : makeJoint(j, child, parent));
    if (j->kind == SCENE_HINGE && j->stiffness <= 0)
        setHinge(w, j, static_cast<btHingeConstraint *>(w->joints.back().get()));
    w->world.addConstraint(w->joints.back().get(), true);
}

void step(EngineWorld *w, double h) {
    for (size_t i = 0; i < w->bodies.size(); i++)
        if (scene_isPushed(&w->from[i], w->time)) /* the last step has taken it away */
            w->bodies[i]->applyCentralForce(vector(w->from[i].force));
    for (const EngineWorld::Motor &motor : w->motors)
        motor.hinge->enableAngularMotor(true, btScalar(scene_motorSpeed(motor.joint, w->time, h)),
                                        btScalar(motor.joint->torque * h));
    w->time += h;
    w->world.stepSimulation(btScalar(h), 0);
}

void getState(EngineWorld *w, int index, SceneState *s) {
    const btRigidBody &body = *w->bodies[size_t(index)];
    const btQuaternion q = body.getCenterOfMassTransform().getRotation();
    s->quaternion[0] = double(q.w());
    for (int i = 0; i < 3; i++) {
        s->position[i] = double(body.getCenterOfMassPosition()[i]);
        s->quaternion[i + 1] = double(q[i]);
        s->velocity[i] = double(body.getLinearVelocity()[i]);
        s->spin[i] = double(body.getAngularVelocity()[i]);
    }
}

void destroy(EngineWorld *w) {
    for (auto &joint : w->joints)
        w->world.removeConstraint(joint.get());
    for (auto &body : w->bodies)
        w->world.removeRigidBody(body.get());
    if (w->ground)
        w->world.removeRigidBody(w->ground.get());
    delete w;
}

Engine makeEngine() {
    Engine e = {};
    e.name = "Bullet";
    e.version = PEER_VERSION;
    e.about = "single precision; its defaults: sequential impulses, split impulse; 10 iterations are the default";
    e.settings = settings;
    e.bounces = true;
    e.create = create;
    e.addGround = addGround;
    e.addTerrain = addTerrain;
    e.addBody = addBody;
    e.addJoint = addJoint;
    e.step = step;
    e.getState = getState;
    e.destroy = destroy;
    return e;
}

} // namespace

extern "C" const Engine engine_bullet = makeEngine();
