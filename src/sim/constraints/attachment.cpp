// The lists of the attachment pass, and the motion of its points.
#include "sim/constraints/attachment.hpp"

#include "kernels.hpp"
#include "sim/constraints/moving_point.hpp"
#include "sim/forces/forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew::sim::constraints::attachment {

namespace {

bool isFinite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

void add(Build& build) {
    const Scene& scene = build.model.scene;
    if (scene.attachments.empty()) return;
    std::vector<layout::AttachedParticle> items;
    for (const Attachment& a : scene.attachments)
        items.push_back({build.model.layout.slot[a.particle], a.compliance, a.maxForce, 0});
    const Attachments& added = build.keep(
        Attachments{.count = static_cast<std::uint32_t>(items.size()),
                    .particles = build.program.upload("attachments", items),
                    .anchors = build.program.scratch<layout::vec4>("attachments.anchors", 2 * items.size())});
    build.program.updateAnchors(added.anchors);
}

void addPass(Build& build, const Substep& substep) {
    const Attachments* attachments = build.find<Attachments>();
    if (!attachments) return;
    const ParticleBuffers& particles = substep.particles;
    std::vector<BufferId> buffers{attachments->particles, attachments->anchors, particles.positions,
                                  substep.changed(), particles.step};
    ProgramBuilder::Constants constants;
    forces::bindTo(particles, &forces::Forces::ofAttachments, buffers, constants);
    const auto substeps = static_cast<float>(build.model.settings.substeps);
    const layout::AttachmentPush push{attachments->count, static_cast<float>(substep.index + 1) / substeps};
    build.program.dispatch(substep.isOpen() ? kernels::solveAttachmentsOpen : kernels::solveAttachments,
                           attachments->count, buffers, push, constants);
}

Anchors::Anchors(const std::vector<Attachment>& attachments)
    : attachments_(attachments), values_(2 * attachments.size()) {
    reset();
}

void Anchors::reset() noexcept {
    for (std::size_t a = 0; a < attachments_.size(); ++a) {
        const Vec3& at = attachments_[a].anchor;
        values_[2 * a] = values_[2 * a + 1] = {at.x, at.y, at.z, 0};
    }
}

std::vector<Vec3> Anchors::places() const {
    std::vector<Vec3> result;
    for (std::size_t a = 0; a < attachments_.size(); ++a) {
        const layout::vec4& at = values_[2 * a + 1];
        result.push_back({at.x, at.y, at.z});
    }
    return result;
}

void Anchors::moveTo(std::span<const Vec3> places) noexcept {
    for (std::size_t a = 0; a < std::min(places.size(), attachments_.size()); ++a)
        values_[2 * a] = values_[2 * a + 1] = {places[a].x, places[a].y, places[a].z, 0};
}

void Anchors::advance(std::span<const Vec3> targets, float dt) noexcept {
    for (std::size_t a = 0; a < attachments_.size(); ++a) {
        values_[2 * a] = values_[2 * a + 1];
        if (a >= targets.size() || !isFinite(targets[a])) continue;
        const bool isUnlimited = attachments_[a].maxSpeed == Attachment::unlimited;
        const double reach = isUnlimited ? std::numeric_limits<double>::infinity()
                                         : double{attachments_[a].maxSpeed} * double{dt};
        values_[2 * a + 1] = movedTowards(values_[2 * a], targets[a], reach);
    }
}

} // namespace sinew::sim::constraints::attachment
