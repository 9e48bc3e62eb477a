// Creates the instance of our own programs: extensions, validation layer, messenger.
#include "vk/instance.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <string_view>

namespace sinew::vk {

namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* howToInstall =
    ": install mesa-vulkan-drivers, which has a software device, or your GPU's driver";

/// Functions that can be called without an instance.
struct GlobalFunctions {
    PFN_vkCreateInstance vkCreateInstance = nullptr;
    PFN_vkEnumerateInstanceVersion vkEnumerateInstanceVersion = nullptr;
    PFN_vkEnumerateInstanceLayerProperties vkEnumerateInstanceLayerProperties = nullptr;
    PFN_vkEnumerateInstanceExtensionProperties vkEnumerateInstanceExtensionProperties = nullptr;
};

GlobalFunctions loadGlobalFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
    if (getInstanceProcAddr == nullptr)
        throw Error(Failure::noDevice, std::string("cannot use Vulkan: there is no loader") + howToInstall);
    GlobalFunctions functions;
    const auto load = [&]<typename Function>(Function& function, const char* name) {
        function = reinterpret_cast<Function>(getInstanceProcAddr(nullptr, name));
        if (function == nullptr) // vkEnumerateInstanceVersion came with 1.1
            throw Error(Failure::noDevice, std::string("cannot use Vulkan: the loader lacks ") + name +
                                               " and is too old: install libvulkan1 1.2 or newer");
    };
    load(functions.vkCreateInstance, "vkCreateInstance");
    load(functions.vkEnumerateInstanceVersion, "vkEnumerateInstanceVersion");
    load(functions.vkEnumerateInstanceLayerProperties, "vkEnumerateInstanceLayerProperties");
    load(functions.vkEnumerateInstanceExtensionProperties, "vkEnumerateInstanceExtensionProperties");
    std::uint32_t version = VK_API_VERSION_1_0;
    check(functions.vkEnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion", "the loader");
    if (version < VK_API_VERSION_1_2)
        throw Error(Failure::noDevice,
                    "cannot use Vulkan: the loader is older than 1.2: install a newer libvulkan1");
    return functions;
}

bool hasLayer(const GlobalFunctions& functions, const std::string& wanted) {
    std::uint32_t count = 0;
    check(functions.vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties",
          wanted);
    std::vector<VkLayerProperties> layers(count);
    check(functions.vkEnumerateInstanceLayerProperties(&count, layers.data()),
          "vkEnumerateInstanceLayerProperties", wanted);
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& layer) { return wanted == layer.layerName; });
}

bool hasExtension(const GlobalFunctions& functions, const std::string& wanted) {
    constexpr const char* call = "vkEnumerateInstanceExtensionProperties";
    std::uint32_t count = 0;
    check(functions.vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), call, wanted);
    std::vector<VkExtensionProperties> extensions(count);
    check(functions.vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()), call, wanted);
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return wanted == extension.extensionName;
    });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* message, void* messages) {
    static_cast<Messages*>(messages)->add(message->pMessage);
    return VK_FALSE;
}

// General messages are excluded: in these the loader complains about drivers that are not in use.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo(Messages& messages) noexcept {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = collect,
            .pUserData = &messages};
}

// Devices that lack parts of Vulkan, such as those of MoltenVK, are listed only if an instance requests them.
VkInstanceCreateFlags flagsWith(const std::vector<const char*>& extensions) {
    const bool asks = std::ranges::any_of(extensions, [](const char* extension) {
        return std::string_view(extension) == VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME;
    });
    return asks ? VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR : 0;
}

VkInstance createInstance(const GlobalFunctions& functions, const std::vector<const char*>& extensions,
                          bool hasValidation, const VkAllocationCallbacks* allocation, Messages& messages) {
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(messages);
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "sinew",
                                        .pEngineName = "sinew",
                                        .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = hasValidation ? &features : nullptr,
                                    .flags = flagsWith(extensions),
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = hasValidation ? 1u : 0u,
                                    .ppEnabledLayerNames = &validationLayer,
                                    .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = functions.vkCreateInstance(&info, allocation, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(Failure::noDevice, std::string("cannot use Vulkan: no driver found") + howToInstall);
    check(result, "vkCreateInstance", "the program");
    return instance;
}

} // namespace

void Messages::add(const std::string& message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
    if (callback_) callback_(message);
}

std::vector<std::string> Messages::all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

Instance::Instance(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const DeviceRequest& request)
    : messages_(request.onValidationMessage) {
    if (request.allocation != nullptr) callbacks_ = *request.allocation;
    const GlobalFunctions global = loadGlobalFunctions(getInstanceProcAddr);
    std::vector<const char*> extensions;
    for (const std::string& extension : request.instanceExtensions) {
        if (!hasExtension(global, extension))
            throw Error(Failure::noDevice, "cannot use Vulkan: the instance extension " + extension +
                                               " is missing: update the driver");
        extensions.push_back(extension.c_str());
    }
    hasDebugUtils_ = hasExtension(global, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (hasDebugUtils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (hasExtension(global, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME))
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    const bool hasValidation = request.hasValidation;
    if (hasValidation && (!hasLayer(global, validationLayer) || !hasDebugUtils_))
        throw Error(Failure::noDevice, std::string("cannot validate: ") + validationLayer +
                                           " is missing: install vulkan-validationlayers");
    if (hasValidation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME); // layer's own
    instance_ = createInstance(global, extensions, hasValidation, allocation(), messages_);
    try {
        functions_ = loadInstanceFunctions(getInstanceProcAddr, instance_);
        const VkDebugUtilsMessengerCreateInfoEXT info = messengerInfo(messages_);
        if (hasValidation)
            check(functions_.vkCreateDebugUtilsMessengerEXT(instance_, &info, allocation(), &messenger_),
                  "vkCreateDebugUtilsMessengerEXT", "the program");
    } catch (...) {
        const auto destroy =
            reinterpret_cast<PFN_vkDestroyInstance>(getInstanceProcAddr(instance_, "vkDestroyInstance"));
        destroy(instance_, allocation());
        throw;
    }
}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE)
        functions_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, allocation());
    functions_.vkDestroyInstance(instance_, allocation());
}

} // namespace sinew::vk
