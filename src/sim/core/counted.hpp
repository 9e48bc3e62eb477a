// Counts with nouns in sentences.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::sim {

/// The noun of a count: `many` is the plural, also used for 0; if empty, the plural is `one` with an s.
inline std::string nounFor(std::uint64_t count, std::string_view one, std::string_view many = {}) {
    if (count == 1) return std::string(one);
    return many.empty() ? std::string(one) + "s" : std::string(many);
}

/// "1 piece", "2 pieces".
inline std::string counted(std::uint64_t count, std::string_view one, std::string_view many = {}) {
    return std::to_string(count) + " " + nounFor(count, one, many);
}

} // namespace sinew::sim
