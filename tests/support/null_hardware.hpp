// A GPU that is not present, with its real compiler: Mesa's RADV makes pipelines for any family of AMD GPUs
// on any machine. Nothing can be submitted, and no buffer can be made.
#pragma once

#include "sinew/vk/device.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/shader_code.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::test {

/// Statistics of one shader of a pipeline.
struct PipelineFacts {
    std::string kernel;                              ///< the debug name given by Sinew
    std::string shader;                              ///< the driver's name of it, such as "Fragment Shader"
    std::vector<std::uint32_t> constants;            ///< values of its specialisation constants
    std::map<std::string, std::uint64_t> statistics; ///< by the driver's names, such as "VGPRs"

    /// Value of a statistic; 0 if the driver does not provide it.
    std::uint64_t operator[](const std::string& statistic) const;
};

/// One object at a time, because the driver reads its family from an environment variable, which is restored.
class NullHardware {
public:
    /// `family` is a value of RADV_FORCE_FAMILY, such as "NAVI21". Null if the driver is not installed or
    /// does not know the family.
    static std::unique_ptr<NullHardware> make(const std::string& family);
    NullHardware(const NullHardware&) = delete;
    NullHardware& operator=(const NullHardware&) = delete;
    ~NullHardware();

    const vk::Device& device() const { return *device_; }
    /// Whether a shader module was made from this code itself. Modules of kernels are made from copies.
    bool hasModuleOf(const vk::ShaderCode& code) const;
    /// The shaders of all pipelines made on the device so far.
    const std::vector<PipelineFacts>& pipelines() const;

private:
    NullHardware();
    bool makeInstance();
    bool makeDevice();
    void borrow();

    vk::Loader loader_;
    vk::InstanceFunctions functions_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice handle_ = VK_NULL_HANDLE;
    std::optional<vk::Device> device_;
};

} // namespace sinew::test
