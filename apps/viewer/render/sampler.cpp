// Uses the same filter for magnification and minification.
#include "viewer/render/sampler.hpp"

#include "sinew/vk/check.hpp"

#include <utility>

namespace sinew::viewer {

Sampler::Sampler(const vk::Device& device, const Request& request) : device_(&device) {
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = request.filter,
                                   .minFilter = request.filter,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = request.beyond,
                                   .addressModeV = request.beyond,
                                   .addressModeW = request.beyond,
                                   .compareEnable = request.isComparing,
                                   .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
                                   .borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
    vk::check(device.functions().vkCreateSampler(device.handle(), &info, nullptr, &sampler_),
              "vkCreateSampler", request.name);
    device.name(VK_OBJECT_TYPE_SAMPLER, vk::handleValue(sampler_), request.name);
}

Sampler::Sampler(Sampler&& other) noexcept
    : device_(other.device_), sampler_(std::exchange(other.sampler_, VK_NULL_HANDLE)) {}

Sampler::~Sampler() {
    device_->functions().vkDestroySampler(device_->handle(), sampler_, nullptr);
}

} // namespace sinew::viewer
