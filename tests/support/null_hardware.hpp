// A GPU that is not there, with the compiler of one that is: Mesa's RADV makes pipelines for any family of
// AMD GPUs on any machine. Nothing can be submitted, and no buffer can be made.
#pragma once

#include "vk/device.hpp"
#include "vk/loader.hpp"
#include "vk/shader_code.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::test {

/// Figures that the driver gives about a shader of a pipeline.
struct PipelineFacts {
    std::string kernel;                              ///< the debug name that Sinew gave it
    std::string shader;                              ///< the driver's name of it, such as "Fragment Shader"
    std::vector<std::uint32_t> constants;            ///< values of its specialisation constants
    std::map<std::string, std::uint64_t> statistics; ///< by the driver's names, such as "VGPRs"

    /// 0 where the driver has no such statistic.
    std::uint64_t operator[](const std::string& statistic) const;
};

/// One at a time, since the driver reads its family from the environment, which is put back.
class NullHardware {
public:
    /// `family` as RADV_FORCE_FAMILY has it, such as "NAVI21". Empty where the driver is not installed or
    /// does not know the family.
    static std::unique_ptr<NullHardware> make(const std::string& family);
    NullHardware(const NullHardware&) = delete;
    NullHardware& operator=(const NullHardware&) = delete;
    ~NullHardware();

    const vk::Device& device() const { return *device_; }
    /// Whether a shader module was made of this code as it is: of kernels modules are made of copies.
    bool hasModuleOf(const vk::ShaderCode& code) const;
    /// The shaders of all pipelines that were made on the device so far.
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
