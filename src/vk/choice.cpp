// Device choice: GPUs before software devices; an index or a part of a name overrides.
#include "vk/choice.hpp"

#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace sinew::vk {

namespace {

std::string typeName(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "software";
    default:
        return "other";
    }
}

/// Preference of a device; lower is better.
int rankOf(const DeviceDescription& description) {
    static constexpr const char* order[] = {"discrete GPU", "integrated GPU", "virtual GPU", "other",
                                            "software"};
    return static_cast<int>(std::find(std::begin(order), std::end(order), description.type) -
                            std::begin(order));
}

std::vector<VkPhysicalDevice> physicalDevices(const Instance& instance) {
    std::uint32_t count = 0;
    constexpr const char* call = "vkEnumeratePhysicalDevices";
    VkResult result = instance.functions().vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result != VK_ERROR_INITIALIZATION_FAILED) { // the loader returns this when every driver fails
        check(result, call, "the instance");
        result = instance.functions().vkEnumeratePhysicalDevices(instance.handle(), &count, devices.data());
        check(result, call, "the instance");
    }
    if (devices.empty())
        throw Error(Failure::noDevice,
                    "cannot use Vulkan: no driver finds a device: install mesa-vulkan-drivers, which "
                    "has a software device, or your GPU's driver");
    return devices;
}

/// A queue family with graphics and compute if there is one; without a window compute alone is enough.
std::optional<std::uint32_t> findQueueFamily(const Instance& instance, VkPhysicalDevice physical,
                                             const DeviceRequest& request) {
    std::uint32_t count = 0;
    instance.functions().vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.functions().vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const bool needsGraphics = request.canUseFamily || !request.deviceExtensions.empty();
    std::optional<std::uint32_t> computeOnly;
    for (std::uint32_t family = 0; family < count; ++family) {
        if ((families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0 || families[family].queueCount == 0)
            continue;
        if (request.canUseFamily && !request.canUseFamily(instance.handle(), physical, family)) continue;
        if ((families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return family;
        if (!needsGraphics && !computeOnly) computeOnly = family;
    }
    return computeOnly;
}

// Required because programs map buffers without flush or invalidate (Device::create).
bool hasCoherentMemory(const InstanceFunctions& functions, VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory;
    functions.vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    return !suitableMemoryTypes(memory, ~0u, MemoryKind::upload).empty();
}

std::string tooOld(std::uint32_t version) {
    return std::string("it has Vulkan ")
        .append(std::to_string(VK_API_VERSION_MAJOR(version)))
        .append(".")
        .append(std::to_string(VK_API_VERSION_MINOR(version)))
        .append(", Sinew needs 1.2");
}

Candidate examine(const Instance& instance, VkPhysicalDevice physical, std::uint32_t index,
                  const DeviceRequest& request) {
    Candidate candidate{.physical = physical, .description = describeDevice(instance.functions(), physical)};
    candidate.description.index = index;
    std::vector<std::string>& missing = candidate.description.missing;
    if (candidate.description.apiVersion < VK_API_VERSION_1_2) {
        missing.push_back(tooOld(candidate.description.apiVersion));
        return candidate; // its features of 1.2 cannot be queried
    }
    VkPhysicalDeviceVulkan12Features features12{.sType =
                                                    VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                       .pNext = &features12};
    instance.functions().vkGetPhysicalDeviceFeatures2(physical, &features);
    if (features12.timelineSemaphore == VK_FALSE)
        missing.push_back("it lacks timeline semaphores, which Vulkan 1.2 requires");
    if (!hasCoherentMemory(instance.functions(), physical))
        missing.push_back("none of its memory is host visible and host coherent, which Vulkan requires");
    for (const std::string& extension : request.deviceExtensions)
        if (!hasExtension(instance.functions(), physical, extension))
            missing.push_back("it lacks the extension " + extension);
    if (const auto family = findQueueFamily(instance, physical, request))
        candidate.queueFamily = *family;
    else if (request.canUseFamily)
        missing.push_back("it has no queue that computes, draws and presents to the window");
    else
        missing.push_back("it has no queue that computes");
    return candidate;
}

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

bool isNamedBy(const DeviceDescription& description, const std::string& wanted) {
    const bool isIndex = !wanted.empty() && std::all_of(wanted.begin(), wanted.end(),
                                                        [](unsigned char c) { return std::isdigit(c); });
    if (isIndex) return std::to_string(description.index) == wanted;
    return lowered(description.name).find(lowered(wanted)) != std::string::npos;
}

std::string listOf(std::span<const Candidate> candidates) {
    std::string list;
    for (const Candidate& candidate : candidates) {
        list.append(list.empty() ? "" : "; ").append(std::to_string(candidate.description.index));
        list.append(" ").append(candidate.description.name);
        for (const std::string& sentence : candidate.description.missing)
            list.append(" (").append(sentence).append(")");
    }
    return list;
}

} // namespace

bool hasExtension(const InstanceFunctions& functions, VkPhysicalDevice physical, const std::string& wanted) {
    constexpr const char* call = "vkEnumerateDeviceExtensionProperties";
    std::uint32_t count = 0;
    check(functions.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), call, wanted);
    std::vector<VkExtensionProperties> extensions(count);
    check(functions.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()), call,
          wanted);
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return wanted == extension.extensionName;
    });
}

namespace {

void appendHex(std::string& text, std::span<const std::uint8_t> bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (const std::uint8_t byte : bytes) (text += digits[byte >> 4]) += digits[byte & 15];
}

} // namespace

DeviceDescription describeDevice(const InstanceFunctions& functions, VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties;
    functions.vkGetPhysicalDeviceProperties(physical, &properties);
    DeviceDescription description{.name = properties.deviceName,
                                  .driver = "unknown",
                                  .type = typeName(properties.deviceType),
                                  .apiVersion = properties.apiVersion,
                                  .storageBuffers =
                                      std::min(properties.limits.maxPerStageDescriptorStorageBuffers,
                                               properties.limits.maxDescriptorSetStorageBuffers)};
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        VkPhysicalDeviceIDProperties ids{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
        VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                                .pNext = &ids};
        VkPhysicalDeviceProperties2 extended{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                             .pNext = &driver};
        functions.vkGetPhysicalDeviceProperties2(physical, &extended);
        description.driver = std::string(driver.driverName) + " " + driver.driverInfo;
        appendHex(description.identity, ids.deviceUUID);
        appendHex(description.identity, ids.driverUUID);
        appendHex(description.identity, properties.pipelineCacheUUID);
        const std::uint32_t version = properties.driverVersion;
        for (const unsigned shift : {24u, 16u, 8u, 0u})
            appendHex(description.identity, std::array{static_cast<std::uint8_t>(version >> shift)});
    }
    return description;
}

std::vector<Candidate> findCandidates(const Instance& instance, const DeviceRequest& request) {
    std::vector<Candidate> candidates;
    for (VkPhysicalDevice physical : physicalDevices(instance))
        candidates.push_back(
            examine(instance, physical, static_cast<std::uint32_t>(candidates.size()), request));
    return candidates;
}

const Candidate* findBest(std::span<const Candidate> candidates, const std::string& wanted) {
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates) {
        if (!candidate.description.missing.empty() || !isNamedBy(candidate.description, wanted)) continue;
        if (best == nullptr || rankOf(candidate.description) < rankOf(best->description)) best = &candidate;
    }
    return best;
}

const Candidate& choose(std::span<const Candidate> candidates, const std::string& wanted) {
    if (const Candidate* best = findBest(candidates, wanted)) return *best;
    const std::string list = listOf(candidates);
    if (wanted.empty())
        throw Error(Failure::noDevice, "no Vulkan device can be used: " + list +
                                           ": update the driver or install mesa-vulkan-drivers");
    throw Error(Failure::noDevice, "no usable Vulkan device is called \"" + wanted + "\": there is " + list +
                                       ": give one of these indices or a part of a name");
}

} // namespace sinew::vk
