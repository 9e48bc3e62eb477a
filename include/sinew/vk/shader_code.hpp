// A compiled kernel. In a header of its own, because hundreds of generated files include it.
#pragma once

#include "sinew/export.hpp"

#include <cstdint>
#include <span>

namespace sinew::vk {

/// A compiled kernel, as SPIR-V or packed. Those that the build embeds (cmake/Shaders.cmake) are packed,
/// which takes a third of the space, and have static storage. `wordsOf` (spirv.hpp) gives the SPIR-V of both
/// kinds.
struct SINEW_API ShaderCode {
    const char* name;                       ///< file stem, such as "solve_distance"
    std::span<const std::uint32_t> words{}; ///< SPIR-V; empty = it is packed
    std::span<const std::uint8_t> packed{}; ///< bytes of the SPIR-V as a stream of deflate (RFC 1951)
    std::uint32_t wordCount = 0;            ///< words of the SPIR-V in `packed`

    /// An address that no other code has.
    const void* identity() const noexcept {
        return packed.empty() ? static_cast<const void*>(words.data()) : packed.data();
    }
};

} // namespace sinew::vk
