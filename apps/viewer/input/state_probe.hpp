// Positions of particles and live links, copied from the device without waiting: recorded into a frame, read
// when that frame has finished.
#pragma once

#include "app/cut_links.hpp"
#include "common/layout.h"
#include "sinew/simulation.hpp"
#include "sinew/vk/buffer.hpp"
#include "viewer/render/camera.hpp"

#include <functional>
#include <optional>
#include <span>

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the scene and the simulation.
class StateProbe {
public:
    /// Reads from `simulation`, which must be one of `scene` with `settings`.
    StateProbe(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
               const sim::Simulation& simulation);

    /// Copies velocities too, if the simulation has any; in the same commands as record().
    void recordVelocities(VkCommandBuffer commands) const noexcept;
    /// Records the copies.
    void record(VkCommandBuffer commands) noexcept;

    /// The box around all finite positions of the scene [m]; empty if there are none. Here and below, the
    /// recorded frame must have finished.
    Box bounds() const;
    /// The box of one body.
    Box bounds(const sim::Body& body) const;
    /// Whether a particle is to be seen: its body is present, it is in no removed fragment, and its position
    /// is finite.
    bool isShown(std::uint32_t particle) const noexcept;
    /// Position of every particle [m].
    std::span<const sim::layout::vec4> positions() const noexcept;
    /// Velocity of every particle [m/s]; empty if the simulation has none.
    std::span<const sim::layout::vec4> velocities() const noexcept;
    /// For every particle (see sim::Simulation::pieces()); empty if nothing can be cut.
    std::span<const std::uint32_t> pieces() const noexcept;
    /// Whether a link of the scene (index into Scene::distances) is live: it is not cut, and neither end is
    /// in a removed fragment or an absent body. Valid until the next recording.
    std::function<bool(std::size_t)> liveLinks();

private:
    struct Copy {
        vk::BufferView from;
        vk::Buffer to;
    };
    const vk::Device& device_;
    const sim::Scene& scene_;
    sim::Settings settings_;
    const sim::Simulation& simulation_;
    std::size_t particles_;
    bool isWhole_ = false; // in the last recording
    Copy positions_;
    std::optional<Copy> velocities_, pieces_, links_;
    std::optional<app::CutLinks> cutLinks_; // made at the first cut
};

} // namespace sinew::viewer
