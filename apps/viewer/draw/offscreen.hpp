// A picture without a window: the renderer's target image and its way back to the host.
#pragma once

#include "viewer/draw/png.hpp"
#include "viewer/draw/renderer.hpp"

namespace sinew::viewer {

/// Owns a renderer and one picture, of full quality unless others are asked for. `scale` as in
/// Renderer::makeCanvas. Must not outlive its Device, which must not move.
class Offscreen {
public:
    Offscreen(const vk::Device& device, VkExtent2D extent, const StageLight& light,
              const Quality& quality = {}, float scale = 1);

    /// As Renderer::prepare.
    void prepare(const Layers& layers) { renderer_.prepare(layers, canvas_); }

    /// Records picture and copy. As Renderer::record; the previous picture must be finished.
    void record(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                const Overlay& overlay = {}) noexcept;

    /// The same in two, for what draws over the picture in between: it finds and leaves view() in
    /// TRANSFER_SRC_OPTIMAL layout.
    void recordPicture(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                       const Overlay& overlay = {}) noexcept;
    void recordCopy(VkCommandBuffer commands) const noexcept;
    VkImageView view() const noexcept { return image_.view(); }

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
