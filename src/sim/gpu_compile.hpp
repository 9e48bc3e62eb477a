// A scene compiled for a device.
#pragma once

#include "sim/compile.hpp"
#include "vk/device.hpp"

namespace sinew::sim {

/// As the settings say, but with no more shared memory and no longer texel buffers than the device has.
/// Throws as compile().
StepProgram compileFor(const vk::Device& device, const Scene& scene, Settings settings);

} // namespace sinew::sim
