// Balls and closed skins are those that are drawn.
#include "viewer/input/picker.hpp"

#include "viewer/document/document.hpp"

#include <algorithm>

namespace sinew::viewer {

namespace {

sim::Vec3 vec3(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

sim::RayTargets targetsOf(const sim::Scene& scene, const SceneLight& light) {
    sim::RayTargets targets{.radii = std::vector<float>(scene.particles.size(), -1.0f),
                            .isClosed = light.isClosed};
    for (const BallRange& range : light.balls.ranges)
        std::copy_n(light.balls.radii.begin() + range.first, range.count,
                    targets.radii.begin() + range.first);
    return targets;
}

} // namespace

Picker::Picker(const vk::Device& device, const Document& document, const SceneLight& light,
               std::uint32_t slots)
    : document_(document),
      caster_(device, document.scene(), targetsOf(document.scene(), light), rays, slots) {
    restart();
}

void Picker::restart() {
    caster_.watch(document_.simulation());
}

void Picker::record(VkCommandBuffer commands, std::uint32_t slot, const Casts& casts,
                    const std::optional<Section>& section) const noexcept {
    std::array<std::optional<sim::RayQuery>, rays> queries;
    for (std::size_t i = 0; i < rays; ++i)
        if (casts[i])
            queries[i] = sim::RayQuery{.origin = vec3(casts[i]->ray.origin),
                                       .direction = vec3(casts[i]->ray.direction),
                                       .meetsFixed = casts[i]->among == Among::all};
    std::optional<sim::HiddenSide> hidden;
    if (section) hidden = {vec3(section->normal), section->offset};
    caster_.record(commands, slot, queries, hidden);
}

std::optional<Pick> Picker::answer(std::uint32_t slot, std::size_t ray) const noexcept {
    const std::optional<sim::RayHit> hit = caster_.hit(slot, ray);
    if (!hit) return std::nullopt;
    const auto vector = [](const sim::Vec3& v) { return Vector3(v.x, v.y, v.z); };
    return Pick{hit->particle, vector(hit->point), vector(hit->point) - vector(hit->place), hit->distance};
}

} // namespace sinew::viewer
