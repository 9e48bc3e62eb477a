// A compiled kernel. Alone in its header, because hundreds of generated files include it.
#pragma once

#include <cstdint>
#include <span>

namespace sinew::vk {

/// A compiled kernel as the build embeds it (cmake/Shaders.cmake). Static storage.
struct ShaderCode {
    const char* name;                     ///< file stem, such as "solve_distance"
    std::span<const std::uint32_t> words; ///< SPIR-V, validated at build time
};

} // namespace sinew::vk
