// An off-screen picture and its copy to the host.
#pragma once

#include "viewer/render/png.hpp"
#include "viewer/render/renderer.hpp"

namespace sinew::viewer {

/// Draws with the pipelines of a renderer, and makes none. Must not outlive the renderer and the Device,
/// which must not move.
class Shot {
public:
    /// Throws vk::Error. `scale`: see Renderer::makeCopiedCanvas.
    Shot(const vk::Device& device, Renderer& renderer, VkExtent2D extent, float scale = 1);

    /// Records the picture and the copy, with layers that the renderer has. Parameters as for
    /// Renderer::record, whose slot it uses; the previous picture must be finished. Throws vk::Error.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                const sim::Simulation& simulation, const Overlay& overlay = {});

    /// Two simulations side by side, each with its overlay, in one slot each.
    struct Side {
        const sim::Simulation& simulation;
        const Overlay& overlay;
    };
    void recordHalves(VkCommandBuffer commands, std::array<std::uint32_t, 2> slots, const Camera& camera,
                      const std::array<Side, 2>& sides);

    /// Records picture and copy separately, so that a caller can draw over the picture in between: view() is
    /// then in TRANSFER_SRC_OPTIMAL layout, before and after.
    void recordPicture(VkCommandBuffer commands, std::uint32_t slot, const Camera& camera,
                       const sim::Simulation& simulation, const Overlay& overlay = {});
    void recordCopy(VkCommandBuffer commands) const noexcept;
    VkImageView view() const noexcept { return image_.view(); }

    /// Reads the picture of the newest finished record(), RGBA.
    Picture read() const;

private:
    const vk::Device& device_;
    Renderer& renderer_;
    Image image_;
    vk::Buffer readback_;
    Canvas canvas_;
    std::optional<Halves> halves_; // made at the first use
};

} // namespace sinew::viewer
