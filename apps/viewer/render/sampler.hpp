// A sampler: how shaders read an image.
#pragma once

#include "sinew/vk/device.hpp"

#include <string>

namespace sinew::viewer {

/// A VkSampler without mip levels. Movable. Must not outlive its Device.
class Sampler {
public:
    struct Request {
        std::string name;
        VkFilter filter = VK_FILTER_NEAREST;
        VkSamplerAddressMode beyond = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER; ///< the border is 1
        bool isComparing = false; ///< returns 1 if the reference is at most the texel
    };
    Sampler(const vk::Device& device, const Request& request);
    Sampler(Sampler&& other) noexcept;
    Sampler& operator=(Sampler&&) = delete;
    ~Sampler();

    VkSampler handle() const noexcept { return sampler_; }

private:
    const vk::Device* device_ = nullptr;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

} // namespace sinew::viewer
