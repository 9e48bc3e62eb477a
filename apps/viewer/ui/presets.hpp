// Materials to choose from, with Young's moduli that were measured, or derived from measurements, and the
// arithmetic between moduli and the factors of Knobs.
#pragma once

#include "viewer/ui/facts.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace sinew::viewer {

struct MaterialPreset {
    std::string_view name;
    float youngModulus = 0; ///< [Pa]
    std::string_view source;
};

std::span<const MaterialPreset> materialPresets();

/// Whether any body is made of a material with a known Young's modulus.
bool hasYoungModulus(const SceneFacts& scene);
/// Young's modulus of the body that the knobs mean [Pa]; of all, if theirs are equal and no body is without
/// one. Empty if there is no such number.
std::optional<float> youngModulusOf(const SceneFacts& scene, const Knobs& knobs);
/// Knobs with which that body has a modulus [Pa], or every body that has one. Bodies without one keep their
/// stiffness.
Knobs withYoungModulus(const SceneFacts& scene, Knobs knobs, float modulus);

} // namespace sinew::viewer
