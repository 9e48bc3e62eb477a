// The shipped scene files, embedded when the programs are built: what drops a mesh, and what benchmarks run.
#pragma once

#include <string_view>
#include <vector>

namespace sinew::scenes {

/// The text of scenes/<name>.toml; empty for a name that is none.
std::string_view builtInText(std::string_view name);

/// The names it knows, in alphabetical order.
std::vector<std::string_view> builtInNames();

} // namespace sinew::scenes
