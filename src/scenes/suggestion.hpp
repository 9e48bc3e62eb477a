// Suggests the option or command that a misspelt one resembles, for the programs.
#pragma once

#include "scenes/schema.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace sinew::scenes {

/// ": did you mean X?" for the first argument that nothing takes, if a command or option is spelled much like
/// it, else empty. CLI11 stops at an unknown command before it looks at options.
inline std::string suggestion(const CLI::App& app) {
    const auto parsed = app.get_subcommands();
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    for (const std::string& given : command.remaining(true)) {
        std::string nearest;
        std::size_t least = std::max<std::size_t>(given.size() / 3, 1); // edits
        const auto consider = [&](const std::string& known) {
            const std::size_t edits = editDistance(given.substr(0, 64), known);
            if (edits < least || (edits == least && nearest.empty())) {
                least = edits;
                nearest = known;
            }
        };
        for (const CLI::App* one : command.get_subcommands({})) consider(one->get_name());
        for (const CLI::Option* option : command.get_options())
            for (const std::string& name : option->get_lnames()) consider("--" + name);
        if (!nearest.empty()) return ": did you mean " + nearest + "?";
    }
    return {};
}

} // namespace sinew::scenes
