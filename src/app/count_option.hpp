// An option of a command line: a whole number in a range, or "auto".
#pragma once

#include "sinew/ranges.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace sinew::app {

/// Adds an option that sets `value`; "auto" sets it to `chosen`. `value` must live until the command line is
/// parsed.
inline void addCountOrAuto(CLI::App& command, const std::string& name, std::optional<std::uint32_t>& value,
                           const sim::Range& range, std::uint32_t chosen, const std::string& help) {
    command
        .add_option_function<std::string>(
            name,
            [&value, chosen](const std::string& text) {
                value = text == "auto" ? chosen : static_cast<std::uint32_t>(std::stoul(text));
            },
            help)
        ->check([range](const std::string& text) -> std::string {
            const CLI::Range within(static_cast<std::uint32_t>(range.low),
                                    static_cast<std::uint32_t>(range.high));
            if (text == "auto" || within(text).empty()) return {};
            return "is " + text + ", must be " + toText(range) + ", or auto";
        });
}

} // namespace sinew::app
