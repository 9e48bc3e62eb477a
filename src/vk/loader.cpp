// dlopen of the Vulkan loader.
#include "vk/loader.hpp"

#include "vk/check.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <utility>

namespace sinew::vk {

Loader::Loader(const std::string& library) : library_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) {
        const char* reason = dlerror();
        throw Error(Failure::noDevice,
                    "cannot open the Vulkan loader " + library + ": " +
                        (reason != nullptr ? reason : "unknown reason") +
                        ": install libvulkan1 and mesa-vulkan-drivers or your GPU's driver");
    }
    getInstanceProcAddr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    if (getInstanceProcAddr_ == nullptr) {
        dlclose(std::exchange(library_, nullptr));
        throw Error(Failure::noDevice, library + " is no Vulkan loader: it lacks vkGetInstanceProcAddr");
    }
}

Loader::~Loader() {
    dlclose(library_);
}

void enableQueueSubmitValidation() {
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 1);
}

} // namespace sinew::vk
