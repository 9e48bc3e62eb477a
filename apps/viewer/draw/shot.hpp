// A picture that goes to the host: the image it is drawn into and its way back.
#pragma once

#include "viewer/draw/png.hpp"
#include "viewer/draw/renderer.hpp"

namespace sinew::viewer {

/// Drawn with a renderer's pipelines, whatever that draws for: it makes none. Must not outlive the renderer
/// and the Device, which must not move.
class Shot {
public:
    /// Throws vk::Error. `scale` as in Renderer::makeCopiedCanvas.
    Shot(const vk::Device& device, Renderer& renderer, VkExtent2D extent, float scale = 1);

    /// Records picture and copy, with layers that the renderer has. As Renderer::record, whose slot it takes;
    /// the previous picture must be finished. Throws vk::Error.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                const sim::Simulation& simulation, const Overlay& overlay = {});

    /// Two simulations beside each other, each with its overlay: in `slots`, one each.
    struct Side {
        const sim::Simulation& simulation;
        const Overlay& overlay;
    };
    void recordHalves(VkCommandBuffer commands, std::array<std::uint32_t, 2> slots, const Camera& camera,
                      const std::array<Side, 2>& sides);

    /// The same in two, for what draws over the picture in between: it finds and leaves view() in
    /// TRANSFER_SRC_OPTIMAL layout.
    void recordPicture(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                       const sim::Simulation& simulation, const Overlay& overlay = {});
    void recordCopy(VkCommandBuffer commands) const noexcept;
    VkImageView view() const noexcept { return image_.view(); }

    /// The picture of the newest finished record(), red first.
    Picture read() const;

private:
    const vk::Device& device_;
    Renderer& renderer_;
    Image image_;
    vk::Buffer readback_;
    Canvas canvas_;
    std::optional<Halves> halves_; // made when they are first wanted
};

} // namespace sinew::viewer
