// Refusals of what a solver cannot do, in the words of scene files.
#pragma once

#include "scenes/load.hpp"

namespace sinew::scenes {

/// Fails where the scene has contacts, paths or sleep that its solver has no form for. sim::validate says the
/// same in the words of the API.
void requireForms(const LoadedScene& loaded, const std::string& file);

/// Fails with the first of what sim::validate complains about.
void requireValid(const LoadedScene& loaded, const std::string& file);

} // namespace sinew::scenes
