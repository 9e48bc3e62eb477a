// The properties of the particle under the pointer, in a window beside it.
#include "viewer/render/length_text.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

void rows(const Found& found) {
    char text[80];
    row(found.body.c_str(), "particle " + grouped(found.particle));
    row("position", pointText(found.position));
    row("speed", stateText(found));
    if (found.strain) {
        std::snprintf(text, sizeof text, "%.2g %%, at most %.2g %%", 100 * found.strain->rms,
                      100 * found.strain->largest);
        row("strain", text);
    }
    row("links", grouped(found.links));
    row("touches", found.contacts ? grouped(*found.contacts) : "...");
}

} // namespace

// Places the window on the side of the pointer that has room.
void probe(const Facts& facts, float scale, float free) {
    if (!facts.isInspecting) return;
    const ImVec2 all = ImGui::GetIO().DisplaySize, pointer = ImGui::GetIO().MousePos;
    const float away = 18 * scale, width = std::min(250 * scale, all.x);
    const float height = (facts.found ? 6.0f : 1.0f) * ImGui::GetTextLineHeightWithSpacing() + 18 * scale;
    const auto beside = [&](float at, float size, float most) {
        const float after = at + away + size <= most ? at + away : at - away - size;
        return std::clamp(after, 0.0f, std::max(most - size, 0.0f));
    };
    const float right = pointer.x < free && width + away < free ? free : all.x;
    ImGui::SetNextWindowPos({beside(pointer.x, width, right), beside(pointer.y, height, all.y)});
    ImGui::SetNextWindowSize({width, std::min(height, all.y)});
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoFocusOnAppearing;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * scale, 8 * scale});
    ImGui::Begin("probe", nullptr, flags);
    if (facts.found)
        rows(*facts.found);
    else
        ImGui::TextColored(quiet(), "no body under the pointer");
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace sinew::viewer::parts
