// Reads numbers with units, in any locale.
#include "viewer/ui/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace sinew::viewer {

namespace {

struct Unit {
    std::string_view name;
    char of;     // what it measures
    double size; // [SI units]
};
constexpr std::array<Unit, 7> knownUnits{{{"mm", 'l', 1e-3},
                                          {"cm", 'l', 1e-2},
                                          {"m", 'l', 1},
                                          {"Pa", 'p', 1},
                                          {"kPa", 'p', 1e3},
                                          {"MPa", 'p', 1e6},
                                          {"GPa", 'p', 1e9}}};

std::string_view withoutSpaces(std::string_view text) {
    const std::size_t from = text.find_first_not_of(' ');
    if (from == std::string_view::npos) return {};
    return text.substr(from, text.find_last_not_of(' ') - from + 1);
}

// The factor from one unit to another.
std::optional<double> unitFactor(std::string_view from, std::string_view to) {
    if (from.empty() || from == to) return 1;
    const auto* const known = std::ranges::find(knownUnits, from, &Unit::name);
    const auto* const wanted = std::ranges::find(knownUnits, to, &Unit::name);
    if (known == knownUnits.end() || wanted == knownUnits.end() || known->of != wanted->of)
        return std::nullopt;
    return known->size / wanted->size;
}

} // namespace

std::optional<float> numberOf(std::string_view text, std::string_view unit) {
    std::string_view left = withoutSpaces(text);
    if (unit == "x" && left.starts_with('x')) left = withoutSpaces(left.substr(1));
    std::string digits(left);
    std::ranges::replace(digits, ',', '.');
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    const std::optional<double> scale =
        unitFactor(withoutSpaces(left.substr(static_cast<std::size_t>(end - digits.data()))), unit);
    return scale ? std::optional(static_cast<float>(number * *scale)) : std::nullopt;
}

} // namespace sinew::viewer
