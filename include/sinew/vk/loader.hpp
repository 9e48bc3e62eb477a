// Opens the system's Vulkan loader at run time. Part of the standalone target: the core never opens or links
// one.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/functions.hpp"

#include <string>

namespace sinew::vk {

/// Keeps libvulkan open; must outlive every Device made through it.
class SINEW_API Loader {
public:
    /// Opens `library` with dlopen; without a name the first existing one of libvulkan.so.1, libvulkan.so,
    /// libvulkan.1.dylib and libMoltenVK.dylib. On Windows with LoadLibrary, and vulkan-1.dll. Throws
    /// Error(noDevice) with the library and the reason.
    explicit Loader(const std::string& library = "");
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    PFN_vkGetInstanceProcAddr getInstanceProcAddr() const noexcept { return getInstanceProcAddr_; }

private:
    void* library_ = nullptr;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr_ = nullptr;
};

/// Sets VK_LAYER_ENABLES so that synchronisation validation also works across submissions. The layer reads
/// the variable when an instance is made and has no other switch for this, so a program must call this before
/// Device::create and before it starts threads; a library must not change its host's environment.
SINEW_API void enableQueueSubmitValidation();

} // namespace sinew::vk
