// A compiled kernel. In a header of its own, because hundreds of generated files include it.
#pragma once

#include "sinew/export.hpp"

#include <cstdint>
#include <span>

namespace sinew::vk {

/// A compiled kernel embedded by the build (cmake/Shaders.cmake). Static storage.
struct SINEW_API ShaderCode {
    const char* name;                     ///< file stem, such as "solve_distance"
    std::span<const std::uint32_t> words; ///< SPIR-V, validated at build time
};

} // namespace sinew::vk
