// Small scenes drawn at random, which have between them everything that a scene can have: for tests that need
// every kernel, not what it computes.
#pragma once

#include "sim/scene.hpp"

namespace sinew::test {

struct DrawnScene {
    sim::Scene scene;
    sim::Settings settings;
};

/// A scene for a number, the same on every machine. Not every one is valid: some have what their solver has
/// no form for.
DrawnScene drawScene(std::uint32_t seed);

} // namespace sinew::test
