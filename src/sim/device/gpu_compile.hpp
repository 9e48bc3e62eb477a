// Compilation of a scene for a device.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/scene.hpp"
#include "sinew/vk/device.hpp"

namespace sinew::sim {

/// The kind of a device; every device that is not a software one counts as a GPU.
DeviceKind kindOf(const vk::Device& device);

/// Compiles with the forms of the settings; open ones are chosen for the device, within its limits of shared
/// memory and of texel buffers. Throws as compile().
StepProgram compileFor(const vk::Device& device, const Scene& scene, Settings settings);

} // namespace sinew::sim
