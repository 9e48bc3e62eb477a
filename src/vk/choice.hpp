// Choice of a physical device and a queue family, with the reasons against the others. Private to src/vk.
#pragma once

#include "vk/instance.hpp"

namespace sinew::vk {

struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    DeviceDescription description;
};

bool hasExtension(const InstanceFunctions& functions, VkPhysicalDevice physical, const std::string& wanted);

/// Description of a device, with index 0 and nothing missing.
DeviceDescription describeDevice(const InstanceFunctions& functions, VkPhysicalDevice physical);

/// Every device with what it lacks for this request. Throws Error(noDevice) if there is no device.
std::vector<Candidate> findCandidates(const Instance& instance, const DeviceRequest& request);

/// The best usable device that `wanted` (DeviceRequest::device) names, or null.
const Candidate* findBest(std::span<const Candidate> candidates, const std::string& wanted);

/// The device of findBest(); throws Error(noDevice) with a list of the devices if there is none.
const Candidate& choose(std::span<const Candidate> candidates, const std::string& wanted);

} // namespace sinew::vk
