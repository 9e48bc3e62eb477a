// Opens the Vulkan loader with dlopen or LoadLibrary.
#include "sinew/vk/loader.hpp"

#include "sinew/vk/check.hpp"
#include "vk/environment.hpp"

#include <utility>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace sinew::vk {

namespace {

#ifdef _WIN32
constexpr const char* usualNames[] = {"vulkan-1.dll"};
constexpr const char* howToInstall = ": install your GPU's driver";

void* openLibrary(const char* name) {
    return LoadLibraryA(name);
}

std::string reasonOfFailure() {
    return "error " + std::to_string(GetLastError()) + " of LoadLibrary";
}

void* findFunction(void* library, const char* name) {
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

void closeLibrary(void* library) {
    FreeLibrary(static_cast<HMODULE>(library));
}
#else
constexpr const char* usualNames[] = {"libvulkan.so.1", "libvulkan.so", "libvulkan.1.dylib",
                                      "libMoltenVK.dylib"};
constexpr const char* howToInstall = ": install libvulkan1 and mesa-vulkan-drivers or your GPU's driver";

void* openLibrary(const char* name) {
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

std::string reasonOfFailure() {
    const char* reason = dlerror();
    return reason != nullptr ? reason : "unknown reason";
}

void* findFunction(void* library, const char* name) {
    return dlsym(library, name);
}

void closeLibrary(void* library) {
    dlclose(library);
}
#endif

struct Opened {
    void* library;
    std::string name;
};

// Opens the library, or the first usual name that exists. Throws with the reason for the first name.
Opened open(const std::string& library) {
    std::string complaint;
    for (const char* usual : usualNames) {
        const std::string name = library.empty() ? usual : library;
        if (void* opened = openLibrary(name.c_str())) return {opened, name};
        const std::string reason = reasonOfFailure();
        if (complaint.empty()) complaint = name + ": " + reason;
        if (!library.empty()) break;
    }
    throw Error(Failure::noDevice, "cannot open the Vulkan loader " + complaint + howToInstall);
}

} // namespace

Loader::Loader(const std::string& library) {
    const Opened opened = open(library);
    library_ = opened.library;
    getInstanceProcAddr_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(findFunction(library_, "vkGetInstanceProcAddr"));
    if (getInstanceProcAddr_ == nullptr) {
        closeLibrary(std::exchange(library_, nullptr));
        throw Error(Failure::noDevice, opened.name + " is no Vulkan loader: it lacks vkGetInstanceProcAddr");
    }
}

Loader::~Loader() {
    closeLibrary(library_);
}

void enableQueueSubmitValidation() {
    setVariable("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT");
}

} // namespace sinew::vk
