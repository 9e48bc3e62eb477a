// Descriptor sets with one layout, and the pipeline layout that they fit.
#pragma once

#include "sinew/vk/device.hpp"

#include <span>
#include <string>
#include <vector>

namespace sinew::viewer {

/// The stages that see push constants.
inline constexpr VkShaderStageFlags drawingStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Set 0 of a pipeline, `count` times, and push constants of the drawing stages. Must not outlive its Device,
/// which must not move.
class SetLayout {
public:
    /// Bindings of one descriptor each. `pushSize` [B]. Throws vk::Error.
    SetLayout(const vk::Device& device, const std::string& name,
              std::span<const VkDescriptorSetLayoutBinding> bindings, std::uint32_t pushSize,
              std::uint32_t count);
    SetLayout(const SetLayout&) = delete;
    SetLayout& operator=(const SetLayout&) = delete;
    ~SetLayout();

    VkPipelineLayout handle() const noexcept { return layout_; }
    /// A set must be written before it is bound.
    VkDescriptorSet set(std::uint32_t index) const noexcept { return sets_[index]; }
    void bind(VkCommandBuffer commands, std::uint32_t index) const noexcept;

private:
    explicit SetLayout(const vk::Device& device) : device_(device) {}
    void createLayouts(const std::string& name, std::span<const VkDescriptorSetLayoutBinding> bindings,
                       std::uint32_t pushSize);
    void createSets(const std::string& name, std::span<const VkDescriptorSetLayoutBinding> bindings,
                    std::uint32_t count);

    const vk::Device& device_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> sets_;
};

} // namespace sinew::viewer
