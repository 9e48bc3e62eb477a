// An option of a command line: a whole number in a range, or "auto".
#pragma once

#include "sinew/ranges.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

namespace sinew::app {

/// A number of decimal digits alone.
inline std::optional<std::uint32_t> wholeNumber(const std::string& text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Adds an option that sets `value`; "auto" sets it to `chosen`. `value` must live until the command line is
/// parsed.
inline void addCountOrAuto(CLI::App& command, const std::string& name, std::optional<std::uint32_t>& value,
                           const sim::Range& range, std::uint32_t chosen, const std::string& help) {
    command
        .add_option_function<std::string>(
            name,
            [&value, chosen](const std::string& text) {
                value = text == "auto" ? chosen : wholeNumber(text).value();
            },
            help)
        ->check([range](const std::string& text) -> std::string {
            const std::optional<std::uint32_t> number = wholeNumber(text);
            if (text == "auto" || (number && *number >= range.low && *number <= range.high)) return {};
            return "is " + text + ", must be " + toText(range) + ", or auto";
        });
}

} // namespace sinew::app
