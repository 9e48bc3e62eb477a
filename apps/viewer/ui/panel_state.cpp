// Contents and results of a step: counts, cuts, the list of passes.
#include "viewer/ui/panel_parts.hpp"

namespace sinew::viewer::parts {

void counts(const SceneFacts& scene, const Facts& facts) {
    heading("counts");
    pair("particles", grouped(scene.particles), "links", grouped(scene.constraints),
         ImGui::GetStyleColorVec4(ImGuiCol_Text));
    if (facts.sleeping > 0) row("asleep", grouped(facts.sleeping));
    if (facts.contactRoom > 0) {
        const std::string room = grouped(facts.contactRoom) + " each, on average";
        row("contacts: room", room);
        if (facts.timesGrown > 0)
            row("contacts: grown",
                std::to_string(facts.timesGrown) + " x, needed " + grouped(facts.contactsNeeded));
        if (facts.isContactRoomShort)
            row("contacts: OVERFLOW", grouped(facts.contactsNeeded) + " needed", bad());
    }
    if (facts.stepsRepeated > 0) row("contacts: steps repeated", grouped(facts.stepsRepeated));
    if (facts.slowed > 0) row("slowed down", grouped(facts.slowed), bad());
    ImGui::Dummy({0, 2});
    if (!scene.substepsWhy.ends_with(": as asked")) wrapped(scene.substepsWhy, quiet());
}

std::string debrisText(const Facts& facts) {
    char mass[32];
    std::snprintf(mass, sizeof mass, "%.3g kg", double{facts.debrisMass});
    return grouped(facts.debris) + ": " + countText(facts.debrisParticles, "particle") + ", " + mass;
}

void cuts(const Facts& facts) {
    heading("cuts");
    pair("links cut", grouped(facts.linksCut), "pieces",
         facts.pieces.isCounted ? grouped(facts.pieces.pieces) : "not counted",
         ImGui::GetStyleColorVec4(ImGuiCol_Text));
    if (facts.pieces.fragments > 0) row("fragments", grouped(facts.pieces.fragments) + " without a surface");
    if (facts.debris > 0) row("debris removed", debrisText(facts));
    for (std::size_t i = 0; i < facts.cuts.size(); ++i) {
        const bool isUndone = i >= facts.undos;
        row(isUndone ? "undone" : "cut", facts.cuts[i],
            isUndone ? quiet() : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    }
}

void program(const SceneFacts& scene) {
    ImGui::Dummy({0, ImGui::GetStyle().ItemSpacing.y});
    const std::string name =
        "step program: " + countText(scene.dispatches, "dispatch", "dispatches") + "###program";
    ImGui::PushStyleColor(ImGuiCol_Text, quiet());
    const bool isOpen = ImGui::CollapsingHeader(name.c_str());
    ImGui::PopStyleColor();
    if (!isOpen) return;
    row("barriers", grouped(scene.barriers));
    std::string phase;
    for (const PassLine& pass : scene.passes) {
        if (pass.phase != phase) ImGui::TextColored(accent(), "%s", (phase = pass.phase).c_str());
        const std::string label = pass.label + (pass.isOfCut ? " (with a blade)" : "");
        row(label.c_str(), (pass.times > 1 ? std::to_string(pass.times) + " x " : "") +
                               (pass.items > 0 ? grouped(pass.items) : "copy"));
    }
    if (scene.skipped.empty()) return;
    ImGui::TextColored(accent(), "skipped, as the scene has none");
    std::string all;
    for (const std::string& feature : scene.skipped) all += (all.empty() ? "" : ", ") + feature;
    wrapped(all, quiet());
}

} // namespace sinew::viewer::parts
