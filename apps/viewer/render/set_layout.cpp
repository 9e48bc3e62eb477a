// The public constructor delegates, so that the destructor frees what was made before an exception.
#include "viewer/render/set_layout.hpp"

#include "sinew/vk/check.hpp"

namespace sinew::viewer {

SetLayout::SetLayout(const vk::Device& device, const std::string& name,
                     std::span<const VkDescriptorSetLayoutBinding> bindings, std::uint32_t pushSize,
                     std::uint32_t count)
    : SetLayout(device) {
    createLayouts(name, bindings, pushSize);
    createSets(name, bindings, count);
}

SetLayout::~SetLayout() {
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    functions.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    functions.vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void SetLayout::createLayouts(const std::string& name, std::span<const VkDescriptorSetLayoutBinding> bindings,
                              std::uint32_t pushSize) {
    const VkDescriptorSetLayoutCreateInfo setInfo{.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                  .pBindings = bindings.data()};
    vk::check(
        device_.functions().vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout", name);
    const VkPushConstantRange push{drawingStages, 0, pushSize};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &setLayout_,
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &push};
    vk::check(device_.functions().vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_),
              "vkCreatePipelineLayout", name);
}

void SetLayout::createSets(const std::string& name, std::span<const VkDescriptorSetLayoutBinding> bindings,
                           std::uint32_t count) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorSetLayoutBinding& binding : bindings)
        sizes.push_back({binding.descriptorType, count});
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = count,
                                              .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                              .pPoolSizes = sizes.data()};
    vk::check(device_.functions().vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_),
              "vkCreateDescriptorPool", name);
    const std::vector layouts(count, setLayout_);
    sets_.resize(count);
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = count,
                                           .pSetLayouts = layouts.data()};
    vk::check(device_.functions().vkAllocateDescriptorSets(device_.handle(), &info, sets_.data()),
              "vkAllocateDescriptorSets", name);
}

void SetLayout::bind(VkCommandBuffer commands, std::uint32_t index) const noexcept {
    device_.functions().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1,
                                                &sets_[index], 0, nullptr);
}

} // namespace sinew::viewer
