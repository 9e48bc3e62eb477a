// Which physical device and queue family to use, and why not the others. Private to src/vk.
#pragma once

#include "vk/instance.hpp"

namespace sinew::vk {

struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    DeviceDescription description;
};

bool hasExtension(const InstanceFunctions& functions, VkPhysicalDevice physical, const std::string& wanted);

/// Index 0 and nothing missing.
DeviceDescription describeDevice(const InstanceFunctions& functions, VkPhysicalDevice physical);

/// Every device with what it lacks for this request. Throws Error(noDevice) when there is none at all.
std::vector<Candidate> findCandidates(const Instance& instance, const DeviceRequest& request);

/// The best usable device that `wanted` (DeviceRequest::device) names, or null.
const Candidate* findBest(std::span<const Candidate> candidates, const std::string& wanted);

/// The same; throws Error(noDevice) listing what there is.
const Candidate& choose(std::span<const Candidate> candidates, const std::string& wanted);

} // namespace sinew::vk
