// A picture without a window: the renderer's target image and its way back to the host.
#pragma once

#include "viewer/png.hpp"
#include "viewer/renderer.hpp"

namespace sinew::viewer {

/// Owns a renderer of full quality and one picture. Must not outlive its Device, which must not move.
class Offscreen {
public:
    Offscreen(const vk::Device& device, VkExtent2D extent, const StageLight& light,
              const Quality& quality = {});

    /// Records picture and copy. As Renderer::record; the previous picture must be finished.
    void record(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                const Overlay& overlay = {}) const noexcept;

    /// The picture of the newest finished record().
    Picture read() const;

private:
    const vk::Device& device_;
    Image image_;
    vk::Buffer readback_;
    Renderer renderer_;
    Canvas canvas_;
};

} // namespace sinew::viewer
