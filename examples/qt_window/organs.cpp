#include "qt_window/organs.hpp"

#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sinew/bodies.hpp"

#include <span>

namespace {

using namespace sinew;

constexpr float dt = 1.0f / 60, reach = 3; // of a blade [m]

sim::Scene table() {
    sim::Scene scene{.name = "table", .damping = 2};
    scene.planes.push_back({.friction = 0.5f});
    scene.contacts.friction = 0.3f;
    return scene;
}

sim::Scene organ(float x, float z) {
    mesh::TriangleMesh shape = mesh::generate("organ", 40);
    for (auto& vertex : shape.positions) {
        vertex.x += x;
        vertex.y += 0.3f;
        vertex.z += z;
    }
    sim::Scene scene;
    mesh::addMesh(scene, shape,
                  {.name = "organ",
                   .mostParticles = 900,
                   .youngModulus = 3e4f,
                   .touchesParticles = true,
                   .isCuttable = true});
    return scene;
}

sim::Vec3 along(const Ray& ray, float distance) {
    return {ray.from.x + distance * ray.direction.x, ray.from.y + distance * ray.direction.y,
            ray.from.z + distance * ray.direction.z};
}

} // namespace

Organs::Organs(const vk::HostDevice& engine)
    : device_(vk::Device::borrow(engine)),
      world_(device_, table(),
             {.substeps = 12, .contactRoom = 64, .grabs = 1, .framesInFlight = 2 * mostFramesInFlight}) {}

void Organs::spawn(float x, float z) {
    parts_.push_back(world_.add(organ(x, z)));
}

void Organs::removeOldest() {
    if (parts_.empty()) return;
    release(); // indices of particles are about to change
    world_.remove(parts_.front());
    parts_.pop_front();
}

void Organs::grab(const Ray& ray) {
    asked_ = ray;
    pointer_ = ray;
    isGrabbing_ = true;
}

void Organs::pull(const Ray& ray) {
    pointer_ = ray;
}

void Organs::release() {
    isGrabbing_ = false;
    grab_.reset();
    asked_.reset();
    isAsked_ = {};
}

void Organs::cut(const Ray& from, const Ray& to) {
    bladeFrom_ = {from.from, along(from, reach)};
    bladeTo_ = {to.from, along(to, reach)};
    hasBlade_ = true;
    isCarried_ = isStroke_;
    isStroke_ = true;
}

void Organs::readPick(std::uint32_t slot) {
    if (!isAsked_[slot]) return;
    isAsked_[slot] = false;
    const std::optional<sim::RayHit> hit = caster_->rays.hit(slot, 0);
    if (!hit || !isGrabbing_) return;
    distance_ = hit->distance;
    grab_ = sim::Grab{.particle = hit->particle, .radius = 0.06f, .target = hit->point};
}

void Organs::record(VkCommandBuffer commands, std::uint32_t slot) {
    if (caster_) readPick(slot);
    if (hasReplaced_ && frame_ >= changedAt_ + mostFramesInFlight) {
        world_.release();
        replaced_.reset();
        hasReplaced_ = false;
    }
    if (frame_ == 0) world_.simulation().recordReset(commands);
    if (!hasReplaced_ && world_.recordChanges(commands)) {
        release();
        hasReplaced_ = true;
        changedAt_ = frame_;
        replaced_ = std::move(caster_);
        caster_ = std::make_unique<Caster>(device_, world_);
    }
    if (grab_) grab_->target = along(*pointer_, distance_);
    sim::Step step{.dt = dt, .frame = frame_};
    if (grab_) step.grabs = std::span(&*grab_, 1);
    if (hasBlade_) step.blade = {.from = bladeFrom_, .to = bladeTo_, .isCarried = isCarried_};
    world_.simulation().record(commands, step);
    hasBlade_ = false;
    world_.simulation().recordSkin(commands);
    if (asked_ && caster_) {
        const std::array<std::optional<sim::RayQuery>, 1> rays{
            sim::RayQuery{.origin = asked_->from, .direction = asked_->direction}};
        caster_->rays.record(commands, slot, rays);
        isAsked_[slot] = true;
        asked_.reset();
    }
    if (frame_ >= mostFramesInFlight) {
        const sim::Status status = world_.status(frame_ - mostFramesInFlight);
        if (status.isFinished) {
            world_.observe(status);
            pieces_ = status.pieces;
        }
    }
    ++frame_;
}
