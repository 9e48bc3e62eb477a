// Where particles and skins are now, asked of the device without waiting: recorded into a frame, read when
// it has finished.
#pragma once

#include "app/cut_links.hpp"
#include "layout.h"
#include "sim/simulation.hpp"
#include "viewer/hands/cut_probe.hpp"
#include "vk/buffer.hpp"

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

    /// Velocities too, in the same commands as record(), where the simulation has some.
    void recordVelocities(VkCommandBuffer commands) const noexcept;
    /// After recordSkin() of the simulation with Overlap::none, if there are skins and what is asked is what
    /// a ray meets.
    void record(VkCommandBuffer commands) noexcept;

    /// The box around all finite positions of what is there [m]; empty where there is none. Of this and what
    /// follows, the recorded frame must have finished.
    Box bounds() const;
    /// The same of one body.
    Box bounds(const sim::Body& body) const;
    /// Of every particle [m].
    std::span<const sim::layout::vec4> positions() const noexcept;
    /// Of every particle [m/s]; empty where there are none.
    std::span<const sim::layout::vec4> velocities() const noexcept;
    /// Of every particle, sim::Simulation::pieces(); empty where nothing can be cut.
    std::span<const std::uint32_t> pieces() const noexcept;
    /// Whether a link of the scene, an index into Scene::distances, holds: it is not cut, and no end of it is
    /// a crumb that was removed. Valid until the next recording.
    std::function<bool(std::size_t)> liveLinks();
    /// What a ray can meet: those, vertices as they were drawn, and what cuts have laid open.
    SeenState seen() const noexcept;
    /// False where more has been cut since than was copied: what is asked has to be asked again.
    bool isComplete() const noexcept { return !cuts_ || cuts_->isComplete(); }

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
    bool isWhole_ = false; // what was recorded
    Copy positions_;
    std::optional<Copy> velocities_, vertices_, pieces_, links_;
    std::optional<app::CutLinks> cutLinks_; // made when something is cut first
    std::optional<CutProbe> cuts_;
};

} // namespace sinew::viewer
