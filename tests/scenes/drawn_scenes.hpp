// Small random scenes that together use every feature of a scene, for tests that need every kernel and not
// its results.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::test {

struct DrawnScene {
    sim::Scene scene;
    sim::Settings settings;
};

/// The scene for a number, equal on all machines. Some scenes are invalid, because their solver lacks a
/// feature.
DrawnScene drawScene(std::uint32_t seed);

} // namespace sinew::test
