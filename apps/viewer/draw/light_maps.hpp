// The three images that light a picture: the key light's shadow map, the plan map (bodies seen from below the
// floor) and the floor map made from both.
#pragma once

#include "viewer/draw/render_pass.hpp"

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
    LightMaps(const LightMaps&) = delete;
    LightMaps& operator=(const LightMaps&) = delete;
    ~LightMaps();

    VkSampler comparing() const noexcept { return comparing_; }
    VkSampler nearest() const noexcept { return nearest_; }
    VkSampler smooth() const noexcept { return smooth_; }
    VkSampler stretching() const noexcept { return stretching_; } ///< as smooth(), of edges that go on

private:
    void release() noexcept;
    VkSampler makeSampler(VkFilter filter, bool isComparing, VkSamplerAddressMode beyond,
                          const std::string& name);
    const vk::Device& device_;
    VkFormat depthFormat_;

public:
    LightMap shadow, plan, floor;

private:
    VkSampler comparing_ = VK_NULL_HANDLE, nearest_ = VK_NULL_HANDLE, smooth_ = VK_NULL_HANDLE,
              stretching_ = VK_NULL_HANDLE;
};

} // namespace sinew::viewer
