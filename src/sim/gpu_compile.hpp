// A scene compiled for a device.
#pragma once

#include "sim/compile.hpp"
#include "vk/device.hpp"

namespace sinew::sim {

/// Every device that is not a software one counts as a GPU.
DeviceKind kindOf(const vk::Device& device);

/// Compiles with the forms of the settings, with the forms that they leave open as suits the device, but with
/// no more shared memory and no longer texel buffers than the device has. Throws as compile().
StepProgram compileFor(const vk::Device& device, const Scene& scene, Settings settings);

} // namespace sinew::sim
