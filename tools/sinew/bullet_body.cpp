// The only file that includes Bullet.
#include "sinew/bullet_body.hpp"

#include <BulletSoftBody/btSoftBody.h>

#include <cmath>

namespace sinew::tools {

namespace {

std::vector<btScalar> massesOf(const sim::Scene& scene) {
    std::vector<btScalar> masses;
    for (const sim::Particle& particle : scene.particles)
        masses.push_back(particle.inverseMass > 0 ? 1 / particle.inverseMass
                                                  : 0); // 0 = fixed, as in our scenes
    for (const sim::FixedConstraint& fixed : scene.fixed) masses[fixed.particle] = 0;
    return masses;
}

std::vector<btVector3> positionsOf(const sim::Scene& scene) {
    std::vector<btVector3> positions;
    for (const sim::Particle& p : scene.particles)
        positions.emplace_back(p.position.x, p.position.y, p.position.z);
    return positions;
}

} // namespace

struct BulletBody::Parts {
    btSoftBodyWorldInfo world;
    std::unique_ptr<btSoftBody> body;
    btScalar h = 0; // [s]
    std::uint32_t substeps = 1;
};

BulletBody::BulletBody(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations)
    : parts_(std::make_unique<Parts>()) {
    const double h = double{scene.dt} / substeps;
    parts_->h = static_cast<btScalar>(h);
    parts_->substeps = substeps;
    parts_->world.m_gravity = {scene.gravity.x, scene.gravity.y, scene.gravity.z};
    parts_->world.air_density = 0;
    const std::vector<btScalar> masses = massesOf(scene);
    const std::vector<btVector3> positions = positionsOf(scene);
    parts_->body = std::make_unique<btSoftBody>(&parts_->world, static_cast<int>(masses.size()),
                                                positions.data(), masses.data());
    btSoftBody& body = *parts_->body;
    body.m_cfg.piterations = static_cast<int>(iterations);
    for (const sim::DistanceConstraint& c : scene.distances) {
        body.appendLink(static_cast<int>(c.a), static_cast<int>(c.b));
        body.m_links[body.m_links.size() - 1].m_rl = c.restLength;
    }
    body.updateConstants();
    body.m_bUpdateRtCst = false; // otherwise the next step undoes what follows
    for (int i = 0; i < body.m_links.size(); ++i) {
        btSoftBody::Link& link = body.m_links[i];
        const double w = double{link.m_n[0]->m_im} + double{link.m_n[1]->m_im};
        const double alpha = double{scene.distances[static_cast<std::size_t>(i)].compliance} / (h * h);
        const double k = w > 0 ? 1 - std::pow(alpha / (w + alpha), 1.0 / iterations) : 0;
        link.m_c0 = k > 0 ? static_cast<btScalar>(w / k) : 0; // Bullet skips links whose c0 is 0
    }
}

BulletBody::~BulletBody() = default;

void BulletBody::step() {
    for (std::uint32_t substep = 0; substep < parts_->substeps; ++substep) {
        parts_->body->predictMotion(parts_->h);
        parts_->body->solveConstraints();
    }
}

std::vector<Eigen::Vector3d> BulletBody::positions() const {
    std::vector<Eigen::Vector3d> result;
    for (int i = 0; i < parts_->body->m_nodes.size(); ++i) {
        const btVector3& x = parts_->body->m_nodes[i].m_x;
        result.emplace_back(double{x.x()}, double{x.y()}, double{x.z()});
    }
    return result;
}

} // namespace sinew::tools
