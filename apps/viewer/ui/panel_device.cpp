// The present device, and the other devices to choose from.
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer::parts {

namespace {

bool isUsable(const vk::DeviceDescription& device) {
    return device.missing.empty();
}

// Draws two lines for a device: name, then type and driver, or why it cannot be used. True if chosen.
bool entry(const vk::DeviceDescription& device, bool isCurrent) {
    const bool isSoftware = device.type == "software";
    const ImVec2 at = ImGui::GetCursorPos();
    const float line = ImGui::GetTextLineHeight(), gap = ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginDisabled(!isUsable(device));
    const std::string id = "##device" + std::to_string(device.index);
    const bool isChosen = ImGui::Selectable(id.c_str(), isCurrent, 0, {0, 2 * line + gap});
    ImGui::EndDisabled();
    if (!isUsable(device)) tip(device.missing.front());
    const ImVec2 after = ImGui::GetCursorPos();
    ImGui::SetCursorPos(at);
    ImGui::TextColored(isCurrent ? accent() : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s",
                       device.name.c_str());
    ImGui::TextColored(isSoftware ? warning() : quiet(), "%s", isSoftware ? "SOFTWARE" : device.type.c_str());
    ImGui::SameLine();
    ImGui::TextColored(quiet(), "%s", isUsable(device) ? device.driver.c_str() : "cannot be used");
    ImGui::SetCursorPos(after);
    return isChosen && isUsable(device);
}

void picker(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    ImGui::SetNextItemWidth(contentWidth());
    if (ImGui::BeginCombo("##devices", scene.device.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (std::size_t i = 0; i < facts.devices.size(); ++i) {
            const bool isCurrent = facts.devices[i].index == scene.deviceIndex;
            if (entry(facts.devices[i], isCurrent) && !isCurrent) wishes.device = i;
        }
        ImGui::EndCombo();
    }
    tip("the Vulkan devices; the scene continues on the chosen one");
}

} // namespace

void deviceLine(const SceneFacts& scene, const Facts& facts) {
    if (!scene.isSoftware) {
        ImGui::TextColored(quiet(), "%s", fitted(scene.device, contentWidth(), 1).c_str());
        return tip(scene.device + "; see Performance");
    }
    ImGui::TextColored(warning(), "SOFTWARE DEVICE");
    const std::string name = scene.device + ": ";
    if (facts.reduced)
        tip(name + "during motion small shadow maps, one sample per pixel, drawn at " +
            std::to_string(std::lround(100 * *facts.reduced)) +
            " % of the size and enlarged; full quality when paused");
    else
        tip(name + "no GPU; see Performance");
    ImGui::SameLine();
    const bool isEnlarged = facts.reduced && *facts.reduced < 1;
    ImGui::TextColored(quiet(), "%s",
                       isEnlarged      ? "no GPU, fewer pixels"
                       : facts.reduced ? "no GPU, plain shadows"
                                       : "no GPU");
}

void device(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    if (facts.devices.empty()) // not known yet
        wrapped(scene.device, ImGui::GetStyleColorVec4(ImGuiCol_Text));
    else
        picker(scene, facts, wishes);
    wrapped(scene.driver, quiet());
}

} // namespace sinew::viewer::parts
