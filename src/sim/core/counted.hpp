// Counts with nouns in sentences.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::sim {

/// "1 piece", "2 pieces": `many` is the plural, also used for 0; if empty, the plural is `one` with an s.
inline std::string counted(std::uint64_t count, std::string_view one, std::string_view many = {}) {
    std::string text = std::to_string(count) + " ";
    if (count == 1) return text.append(one);
    return many.empty() ? text.append(one) + "s" : text.append(many);
}

} // namespace sinew::sim
