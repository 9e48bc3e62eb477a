// The three images that light a picture: the key light's shadow map, the plan map (bodies seen from below the
// floor) and the floor map, made from the other two.
#pragma once

#include "viewer/render/render_pass.hpp"
#include "viewer/render/sampler.hpp"

namespace sinew::viewer {

/// One of the maps: image, pass and framebuffer.
struct LightMap {
    Image image;
    RenderPass pass;
    Framebuffer framebuffer;
};

/// Owns maps and samplers. Must not outlive its Device.
class LightMaps {
public:
    /// `shadowSize` and `floorSize` in pixels a side; the plan map is as large as the floor map.
    LightMaps(const vk::Device& device, std::uint32_t shadowSize, std::uint32_t floorSize);

    VkSampler comparing() const noexcept { return comparing_.handle(); }
    VkSampler nearest() const noexcept { return nearest_.handle(); }
    VkSampler smooth() const noexcept { return smooth_.handle(); }
    /// Like smooth(), but clamps to the edge instead of a border.
    VkSampler stretching() const noexcept { return stretching_.handle(); }

private:
    VkFormat depthFormat_;

public:
    LightMap shadow, plan, floor;

private:
    Sampler comparing_, nearest_, smooth_, stretching_;
};

} // namespace sinew::viewer
