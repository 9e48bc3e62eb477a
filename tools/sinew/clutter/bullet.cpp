// Bodies must not sleep here: a sleeping body would be timed as if it were solved.
#include "sinew/clutter/bullet.hpp"

#include <btBulletDynamicsCommon.h>

#include <cmath>

namespace sinew::tools::clutter {

namespace {

constexpr btScalar wide = 1000, thick = 1; // [m]

// The body behind a plane. An axis-aligned plane becomes a slab: Bullet pairs an infinite plane with every
// ball, but a slab only with near ones.
struct Wall {
    std::unique_ptr<btCollisionShape> shape;
    btVector3 at{0, 0, 0};
};

Wall wallOf(const sim::Plane& plane) {
    const btVector3 normal(plane.normal.x, plane.normal.y, plane.normal.z);
    const int axis = normal.absolute().maxAxis();
    if (btFabs(normal[axis]) < 1)
        return {std::make_unique<btStaticPlaneShape>(normal, btScalar(plane.offset))};
    btVector3 half(wide, wide, wide);
    half[axis] = thick / 2;
    return {std::make_unique<btBoxShape>(half), (btScalar(plane.offset) - thick / 2) * normal};
}

} // namespace

struct Bullet::Parts {
    Balls start;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    btSphereShape ball;
    std::vector<Wall> walls;
    std::vector<std::unique_ptr<btRigidBody>> bodies;

    explicit Parts(const Balls& balls) : start(balls), ball(btScalar(balls.radius)) {}
    ~Parts() {
        for (const auto& body : bodies) world.removeRigidBody(body.get());
    }
    void add(btScalar mass, btCollisionShape& shape, const btVector3& at, const btVector3& velocity,
             float friction) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape.calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
        info.m_startWorldTransform.setIdentity();
        info.m_startWorldTransform.setOrigin(at);
        // Bullet multiplies the coefficients of two bodies.
        info.m_friction = btScalar(std::sqrt(friction));
        bodies.push_back(std::make_unique<btRigidBody>(info));
        bodies.back()->setLinearVelocity(velocity);
        bodies.back()->setActivationState(DISABLE_DEACTIVATION);
        world.addRigidBody(bodies.back().get());
    }
};

Bullet::Bullet(const Balls& balls) : parts_(std::make_unique<Parts>(balls)) {
    parts_->world.setGravity({balls.gravity.x, balls.gravity.y, balls.gravity.z});
    parts_->world.getSolverInfo().m_numIterations = static_cast<int>(balls.iterations);
    for (std::size_t i = 0; i < balls.x.size(); ++i) {
        const Vec4 &x = balls.x[i], &v = balls.v[i];
        parts_->add(btScalar(1 / x[3]), parts_->ball, {x[0], x[1], x[2]}, {v[0], v[1], v[2]}, balls.friction);
    }
    for (const sim::Plane& plane : balls.planes) {
        const Wall& wall = parts_->walls.emplace_back(wallOf(plane));
        const float own = balls.friction > 0 ? plane.friction * plane.friction / balls.friction : 0;
        parts_->add(0, *wall.shape, wall.at, {0, 0, 0}, own);
    }
}

Bullet::~Bullet() = default;

void Bullet::step() {
    const auto substeps = static_cast<int>(parts_->start.substeps);
    const btScalar h = btScalar(parts_->start.dt) / substeps;
    for (int i = 0; i < substeps; ++i) parts_->world.stepSimulation(h, 0); // 0: exactly this long
}

Balls Bullet::balls() const {
    Balls balls = parts_->start;
    for (std::size_t i = 0; i < balls.x.size(); ++i) {
        const btVector3 x = parts_->bodies[i]->getWorldTransform().getOrigin();
        const btVector3 v = parts_->bodies[i]->getLinearVelocity();
        for (int axis = 0; axis < 3; ++axis) {
            balls.x[i][static_cast<std::size_t>(axis)] = static_cast<float>(x[axis]);
            balls.v[i][static_cast<std::size_t>(axis)] = static_cast<float>(v[axis]);
        }
    }
    return balls;
}

} // namespace sinew::tools::clutter
