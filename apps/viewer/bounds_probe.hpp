// Where the particles are now, asked of the device without waiting: recorded into a frame, read when it has
// finished.
#pragma once

#include "viewer/geometry.hpp"
#include "vk/buffer.hpp"

namespace sinew::viewer {

/// Must not outlive its Device, which must not move.
class BoundsProbe {
public:
    /// `positions` as sim::Simulation::positions().
    BoundsProbe(const vk::Device& device, const vk::BufferView& positions);

    void record(VkCommandBuffer commands) const noexcept;

    /// The box around all finite positions [m]; empty where there is none. The recorded frame must have
    /// finished.
    Box read() const;

private:
    const vk::Device& device_;
    vk::BufferView positions_;
    vk::Buffer readback_;
};

} // namespace sinew::viewer
