// Opens the Vulkan loader with dlopen.
#include "sinew/vk/loader.hpp"

#include "sinew/vk/check.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <utility>

namespace sinew::vk {

namespace {

constexpr const char* usualNames[] = {"libvulkan.so.1", "libvulkan.so", "libvulkan.1.dylib",
                                      "libMoltenVK.dylib"};

struct Opened {
    void* library;
    std::string name;
};

// Opens the library, or the first usual name that exists. Throws with the reason for the first name.
Opened open(const std::string& library) {
    std::string complaint;
    for (const char* usual : usualNames) {
        const std::string name = library.empty() ? usual : library;
        if (void* opened = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) return {opened, name};
        const char* reason = dlerror();
        if (complaint.empty()) complaint = name + ": " + (reason != nullptr ? reason : "unknown reason");
        if (!library.empty()) break;
    }
    throw Error(Failure::noDevice, "cannot open the Vulkan loader " + complaint +
                                       ": install libvulkan1 and mesa-vulkan-drivers or your GPU's driver");
}

} // namespace

Loader::Loader(const std::string& library) {
    const Opened opened = open(library);
    library_ = opened.library;
    getInstanceProcAddr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    if (getInstanceProcAddr_ == nullptr) {
        dlclose(std::exchange(library_, nullptr));
        throw Error(Failure::noDevice, opened.name + " is no Vulkan loader: it lacks vkGetInstanceProcAddr");
    }
}

Loader::~Loader() {
    dlclose(library_);
}

void enableQueueSubmitValidation() {
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 1);
}

} // namespace sinew::vk
