// An off-screen renderer of single pictures.
#pragma once

#include "viewer/render/shot.hpp"

namespace sinew::viewer {

/// Owns a renderer and one picture, of full quality unless other quality is requested. `scale`: see
/// Renderer::makeCanvas. Must not outlive its Device, which must not move.
class Offscreen {
public:
    Offscreen(const vk::Device& device, VkExtent2D extent, const SceneLight& light,
              const Quality& quality = {}, float scale = 1)
        : renderer_(device, {.color = VK_FORMAT_R8G8B8A8_SRGB}, quality, light), // every device can copy it
          shot_(device, renderer_, extent, scale) {}

    /// Makes the pipelines and images for these layers. Throws vk::Error.
    void prepare(const Layers& layers) { renderer_.add(renderer_.make(layers)); }

    /// These functions: see Shot.
    void record(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                const Overlay& overlay = {}) {
        shot_.record(commands, 0, camera, simulation, overlay);
    }
    void recordPicture(VkCommandBuffer commands, const Camera& camera, const sim::Simulation& simulation,
                       const Overlay& overlay = {}) {
        shot_.recordPicture(commands, 0, camera, simulation, overlay);
    }
    void recordHalves(VkCommandBuffer commands, const Camera& camera,
                      const std::array<Shot::Side, 2>& sides) {
        shot_.recordHalves(commands, {0, 1}, camera, sides);
    }
    void recordCopy(VkCommandBuffer commands) const noexcept { shot_.recordCopy(commands); }
    VkImageView view() const noexcept { return shot_.view(); }
    Picture read() const { return shot_.read(); }

private:
    Renderer renderer_;
    Shot shot_;
};

} // namespace sinew::viewer
