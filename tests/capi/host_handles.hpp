// Handles of a host's device in the form of the C interface.
#pragma once

#include "sinew/sinew.h"
#include "support/host_device.hpp"

namespace sinew::test {

/// `host` must outlive the result: its names of extensions are referred to.
inline SinewHostDevice handlesOf(const HostDevice& host) {
    const vk::HostDevice given = host.handles();
    SinewHostDevice handles = sinewDefaultHostDevice();
    handles.getInstanceProcAddr = given.getInstanceProcAddr;
    handles.instance = given.instance;
    handles.physicalDevice = given.physicalDevice;
    handles.device = given.device;
    handles.queueFamily = given.queueFamily;
    handles.instanceExtensions = given.enabledInstanceExtensions.data();
    handles.instanceExtensionCount = static_cast<std::uint32_t>(given.enabledInstanceExtensions.size());
    return handles;
}

} // namespace sinew::test
