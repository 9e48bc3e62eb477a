// Sources of the presets, and factors that lead to a modulus.
#include "viewer/ui/presets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew::viewer {

namespace {

// Tissues differ between people and methods by a factor of two and more: these are means of one study each.
// The last two are derived: a neo-Hookean rod at twice its length has a stress of 7 E / 12, here 69 kPa.
constexpr std::array presets{
    MaterialPreset{"Jelly", 4.3e3f, "gelatine in 20 parts of water, compressed (Bonavia et al. 2025)"},
    MaterialPreset{"Brain", 1.9e3f, "white matter of cattle, indented (Budday et al. 2015)"},
    MaterialPreset{"Fat", 3.3e3f, "normal fat of the breast (Samani et al. 2007)"},
    MaterialPreset{"Liver", 5.5e3f, "healthy liver by elastography (Roulot et al. 2008)"},
    MaterialPreset{"Muscle", 12e3f, "relaxed skeletal muscle (Engler et al. 2004)"},
    MaterialPreset{"Silicone", 118e3f, "Ecoflex 00-30, from its stress at twice its length (data sheet)"},
    MaterialPreset{"Rubber", 1.7e6f, "Shore A 40 by the formula of Gent (1958)"},
};

bool isOne(const SceneFacts& scene, const Knobs& knobs) {
    return knobs.body >= 0 &&
           static_cast<std::size_t>(knobs.body) < std::min(scene.youngModuli.size(), knobs.bodies.size());
}

float factorOf(const Knobs& knobs, std::size_t body) {
    return knobs.stiffness * (body < knobs.bodies.size() ? knobs.bodies[body] : 1);
}

bool areEqual(float a, float b) {
    return std::abs(a - b) <= 1e-4f * std::max(a, b);
}

} // namespace

std::span<const MaterialPreset> materialPresets() {
    return presets;
}

bool hasYoungModulus(const SceneFacts& scene) {
    return std::ranges::any_of(scene.youngModuli, [](float modulus) { return modulus > 0; });
}

std::optional<float> youngModulusOf(const SceneFacts& scene, const Knobs& knobs) {
    const std::vector<float>& moduli = scene.youngModuli;
    if (moduli.empty()) return std::nullopt;
    const std::size_t first = isOne(scene, knobs) ? static_cast<std::size_t>(knobs.body) : 0;
    const std::size_t end = isOne(scene, knobs) ? first + 1 : moduli.size();
    const float modulus = moduli[first] * factorOf(knobs, first);
    for (std::size_t i = first; i < end; ++i)
        if (moduli[i] <= 0 || !areEqual(moduli[i] * factorOf(knobs, i), modulus)) return std::nullopt;
    return modulus;
}

Knobs withYoungModulus(const SceneFacts& scene, Knobs knobs, float modulus) {
    const std::vector<float>& moduli = scene.youngModuli;
    if (isOne(scene, knobs)) {
        const auto body = static_cast<std::size_t>(knobs.body);
        if (moduli[body] > 0) knobs.bodies[body] = modulus / (knobs.stiffness * moduli[body]);
        return knobs;
    }
    if (moduli.empty()) return knobs;
    const bool areAlike =
        std::ranges::all_of(moduli, [&](float one) { return one > 0 && one == moduli.front(); });
    knobs.bodies.resize(std::max(knobs.bodies.size(), moduli.size()), 1);
    const float before = knobs.stiffness;
    knobs.stiffness = areAlike ? modulus / moduli.front() : 1;
    for (std::size_t i = 0; i < knobs.bodies.size(); ++i) {
        const bool isKnown = i < moduli.size() && moduli[i] > 0;
        knobs.bodies[i] = areAlike ? 1 : isKnown ? modulus / moduli[i] : knobs.bodies[i] * before;
    }
    return knobs;
}

} // namespace sinew::viewer
