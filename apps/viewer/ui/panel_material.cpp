// Material and parameters of the scene, and of its solver: sliders with numbers that can be typed.
#include "viewer/ui/knob_keys.hpp"
#include "viewer/ui/panel_numbers.hpp"
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/presets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace sinew::viewer::parts {

namespace {

constexpr float nameShare = 0.31f, sliderShare = 0.37f; // of the width of the panel
constexpr std::size_t presetsInARow = 4;

// Writes a name in quiet text and leaves the right side for a control.
void knob(const char* name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(quiet(), "%s", name);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMin().x + nameShare * contentWidth());
    ImGui::SetNextItemWidth((1 - nameShare) * contentWidth());
}

// A slider without a text, and its number beside it. True if the value has changed.
bool slider(TypedNumber& typed, const char* name, float& value, const Range& range, const Format& format,
            const std::string& text) {
    knob(name);
    ImGui::PushID(name);
    ImGui::SetNextItemWidth(sliderShare * contentWidth());
    bool isTurned = ImGui::SliderFloat("##slider", &value, range.low, range.high, "",
                                       range.flags | ImGuiSliderFlags_NoInput);
    tip(text);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX());
    isTurned |= number(typed, value, range, format);
    tip("click to type a number, with a unit or without; Enter or a click elsewhere sets it, Esc does not");
    ImGui::PopID();
    return isTurned;
}

// Selects the body whose stiffness the slider changes.
void bodyCombo(const SceneFacts& scene, int& body) {
    const auto nameOf = [&](int i) {
        return i < 0 ? "all bodies" : scene.bodies[static_cast<std::size_t>(i)].c_str();
    };
    if (!ImGui::BeginCombo("##body", nameOf(body))) return;
    for (int i = -1; i < static_cast<int>(scene.bodies.size()); ++i) {
        ImGui::PushID(i);
        if (ImGui::Selectable(nameOf(i), i == body)) body = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

// "5.5 kPa", "1.7 MPa".
std::string modulusText(float pascals) {
    char text[40];
    const bool isLarge = pascals >= 1e6f;
    std::snprintf(text, sizeof text, isLarge ? "%.3g MPa" : "%.3g kPa",
                  double{pascals} / (isLarge ? 1e6 : 1e3));
    return text;
}

// A button for each material; the last one is that of the scene file.
bool presets(const SceneFacts& scene, Knobs& turned) {
    if (!hasYoungModulus(scene)) return false;
    const float width = buttonWidth(presetsInARow);
    const std::optional<float> now = youngModulusOf(scene, turned);
    std::size_t count = 0;
    bool isTurned = false;
    const auto presetButton = [&](const std::string& name, bool isOn, const std::string& text) {
        if (count++ % presetsInARow != 0) ImGui::SameLine();
        if (isOn) ImGui::PushStyleColor(ImGuiCol_Button, lit());
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, ImGui::GetStyle().FramePadding.y});
        const bool isPressed = ImGui::Button((name + "##preset").c_str(), {width, 0});
        ImGui::PopStyleVar();
        if (isOn) ImGui::PopStyleColor();
        tip(text);
        isTurned |= isPressed;
        return isPressed;
    };
    for (const MaterialPreset& preset : materialPresets()) {
        const bool isOn = now && std::abs(*now / preset.youngModulus - 1) < 0.005f;
        const std::string text = modulusText(preset.youngModulus) + ": " + std::string(preset.source);
        if (presetButton(std::string(preset.name), isOn, text))
            turned = withYoungModulus(scene, turned, preset.youngModulus);
    }
    const bool isFile =
        turned.stiffness == scene.fromFile.stiffness && turned.bodies == scene.fromFile.bodies;
    if (presetButton("As loaded", isFile, "stiffness of the scene file")) {
        turned.stiffness = scene.fromFile.stiffness;
        turned.bodies = scene.fromFile.bodies;
    }
    return isTurned;
}

// In kPa if the modulus is known, else relative to the scene file, which is in the middle of the slider.
bool stiffness(TypedNumber& typed, const SceneFacts& scene, Knobs& turned) {
    const bool isOne = turned.body >= 0 && static_cast<std::size_t>(turned.body) < turned.bodies.size();
    float& factor = isOne ? turned.bodies[static_cast<std::size_t>(turned.body)] : turned.stiffness;
    const std::optional<float> modulus = youngModulusOf(scene, turned);
    const float unit = modulus ? *modulus / (1000 * factor) : 1; // of factor 1 [kPa]
    float shown = unit * factor;
    const Format format = !modulus        ? Format{"x %.3g", "x"}
                          : shown >= 1000 ? Format{"%.0f kPa", "kPa"}
                                          : Format{"%.3g kPa", "kPa"};
    const bool isTurned = slider(
        typed, "stiffness", shown, {0.01f * unit, 100 * unit, ImGuiSliderFlags_Logarithmic}, format,
        modulus ? "Young's modulus; acts at once" : "stiffness relative to the scene file; acts at once");
    if (isTurned) factor = shown / unit;
    return isTurned;
}

bool materialKnobs(TypedNumber& typed, const SceneFacts& scene, Knobs& turned) {
    bool isTurned = presets(scene, turned);
    isTurned |= stiffness(typed, scene, turned);
    if (scene.bodies.size() > 1) {
        knob("  of");
        const int before = turned.body;
        bodyCombo(scene, turned.body);
        isTurned |= turned.body != before;
    }
    isTurned |= slider(typed, "damping", turned.damping, {0, 20}, {"%.2f 1/s", "1/s"},
                       "damping of all motion; acts at once");
    isTurned |= slider(typed, "friction", turned.friction, {0, 2}, {"%.2f", ""},
                       "friction of planes, colliders and bodies; acts at once");
    if (isTurned) limitMaterial(turned);
    return isTurned;
}

// The slider's right end means through.
bool bladeKnob(TypedNumber& typed, const Facts& facts, Knobs& turned) {
    const auto [least, most] = facts.bladeDepths;
    const float through = 1.05f * most;
    // In centimeters, so that a number that is typed has the unit on show.
    float shown = 100 * turned.bladeDepth.value_or(through);
    const bool isTurned = slider(
        typed, "blade depth", shown, {100 * least, 100 * through, ImGuiSliderFlags_Logarithmic, "through"},
        {turned.bladeDepth ? "%.3g cm" : "through", "cm"},
        "depth below the surface under the pointer; right end: through; acts at once");
    const float depth = shown / 100;
    if (isTurned) turned.bladeDepth = depth > most ? std::nullopt : std::optional(std::max(depth, least));
    return isTurned;
}

void take(Knobs turned, const Facts& facts, Wishes& wishes) {
    turned.substeps = std::clamp(turned.substeps, 0, mostSubsteps);
    limitGravity(turned); // typed values have no limits
    turned.pace = std::clamp(turned.pace, 0.01f, 1.0f);
    if (turned != facts.knobs) wishes.knobs = turned;
}

// A warning that bodies are softer than asked, and the cure. True if the cure was taken. It is the last
// control, so that none moves when it appears.
bool softness(const SceneFacts& scene, Knobs& turned) {
    if (scene.stiffness.empty()) return false;
    wrapped(scene.stiffness, warning());
    if (scene.neededSubsteps == 0) return false;
    const auto needed = static_cast<int>(scene.neededSubsteps);
    const std::string text = "Use " + countText(scene.neededSubsteps, "substep");
    const bool isTaken = turned.substeps != needed && ImGui::Button(text.c_str(), {contentWidth(), 0});
    if (isTaken) turned.substeps = needed;
    return isTaken;
}

} // namespace

void parameters(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes) {
    Knobs turned = facts.knobs;
    bool isTurned = materialKnobs(typed, scene, turned);
    isTurned |=
        slider(typed, "gravity", turned.gravity, {0, 20}, {"%.2f m/s\u00b2", "m/s\u00b2"}, "acts at once");
    isTurned |= slider(typed, "speed", turned.pace, {0.05f, 1}, {"x %.2f", "x"},
                       "speed of the scene relative to real time; acts at once");
    if (scene.canCut) isTurned |= bladeKnob(typed, facts, turned);
    Knobs shown = facts.knobs;
    shown.body = scene.fromFile.body; // the selected body is not a change
    ImGui::BeginDisabled(shown == scene.fromFile);
    if (ImGui::Button("Reset parameters", {contentWidth(), 0})) {
        turned = scene.fromFile;
        isTurned = true;
    }
    ImGui::EndDisabled();
    if (isTurned) take(turned, facts, wishes);
}

void solver(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes) {
    Knobs turned = facts.knobs;
    knob("substeps");
    ImGui::PushID("substeps");
    bool isTurned = substeps(typed, turned.substeps, (1 - nameShare) * contentWidth());
    ImGui::PopID();
    tip("More substeps: stiffer but slower. 0 = automatic. Takes effect in a moment.");
    knob("solver");
    const auto solver = static_cast<std::size_t>(turned.solver);
    if (ImGui::BeginCombo("##solver", solver < scene.solvers.size() ? scene.solvers[solver].c_str() : "")) {
        for (std::size_t i = 0; i < scene.solvers.size(); ++i)
            if (ImGui::Selectable(scene.solvers[i].c_str(), i == solver)) {
                turned.solver = static_cast<int>(i);
                isTurned = true;
            }
        ImGui::EndCombo();
    }
    tip("acts once prepared");
    isTurned |= softness(scene, turned);
    if (isTurned) take(turned, facts, wishes);
}

} // namespace sinew::viewer::parts
