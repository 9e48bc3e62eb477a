// The layers of the bodies, and the legends of their colours.
#include "viewer/panels/panel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

constexpr std::array skinNames{"Skin", "Glass", "No skin"};
constexpr std::array<float, 3> sharedColor{0.79f, 0.0f, 0.21f}; // cell.vert
constexpr std::array mapNames{"Colors", "Strain", "Speed", "Sleep"};

// A value with its unit: "2 %", "0.5 m/s".
std::string valueText(ColorMap map, float value) {
    char text[32];
    std::snprintf(text, sizeof text, map == ColorMap::strain ? "%.3g %%" : "%.3g m/s",
                  map == ColorMap::strain ? 100 * double{value} : double{value});
    return text;
}

// Converts linear RGB to sRGB.
ImU32 shown(const std::array<float, 3>& linear) {
    const auto encoded = [](float x) {
        return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    };
    return ImGui::ColorConvertFloat4ToU32({encoded(linear[0]), encoded(linear[1]), encoded(linear[2]), 1});
}

void colorBar() {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = 0.7f * ImGui::GetTextLineHeight(), width = contentWidth();
    const auto colors = mapColors();
    for (std::size_t i = 0; i + 1 < mapColorCount; ++i) {
        const auto place = [&](std::size_t color) {
            return at.x + width * static_cast<float>(color) / static_cast<float>(mapColorCount - 1);
        };
        const ImU32 low = shown(colors[i]), high = shown(colors[i + 1]);
        ImGui::GetWindowDrawList()->AddRectFilledMultiColor({place(i), at.y}, {place(i + 1), at.y + height},
                                                            low, high, high, low);
    }
    ImGui::Dummy({width, height});
}

void colorSwatch(const std::array<float, 3>& color, const char* name) {
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, shown(color));
    ImGui::Dummy({side, side});
    ImGui::SameLine();
    ImGui::TextUnformatted(name);
}

// Legend of two colours with the number of particles of each.
void sleepLegend(const Facts& facts, std::size_t particles) {
    const auto colors = mapColors();
    colorSwatch(colors.back(), "awake");
    ImGui::SameLine();
    colorSwatch(colors.front(), "asleep");
    row("asleep", grouped(facts.sleeping) + " of " + grouped(particles));
}

void legend(const Facts& facts, std::size_t particles) {
    const ColorMap map = facts.layers.map;
    if (map == ColorMap::sleep) return sleepLegend(facts, particles);
    if (facts.mapRange <= 0) return wrapped("no particle has a value", quiet());
    colorBar();
    const std::string middle = valueText(map, facts.mapRange / 2), end = valueText(map, facts.mapRange);
    const float left = ImGui::GetWindowContentRegionMin().x;
    const auto textAt = [&](const std::string& text, float share) {
        ImGui::SetCursorPosX(left + share * (contentWidth() - ImGui::CalcTextSize(text.c_str()).x));
        ImGui::TextColored(quiet(), "%s", text.c_str());
    };
    textAt("0", 0);
    ImGui::SameLine();
    textAt(middle, 0.5f);
    ImGui::SameLine();
    textAt(end, 1);
    char beyond[48];
    std::snprintf(beyond, sizeof beyond, "%.2g %%, up to ", 100 * double{facts.map.beyond});
    const std::string limit = std::string(map == ColorMap::strain ? "strain beyond " : "faster than ") +
                              valueText(map, facts.map.range); // of this state, not the colours' range
    row(limit.c_str(), beyond + valueText(map, facts.map.largest));
}

// Legend with a square per class, in the order of solving; link counts in a tooltip.
void linkLegend(const LinkFacts& links) {
    const float side = 0.8f * ImGui::GetTextLineHeight(), between = 0.5f * ImGui::GetStyle().ItemSpacing.x;
    if (links.classes.size() > 1) {
        const ImVec2 from = ImGui::GetCursorScreenPos();
        const auto inARow =
            std::max(static_cast<std::size_t>(contentWidth() / (side + between)), std::size_t{1});
        for (std::size_t i = 0; i < links.classes.size(); ++i) {
            const ImVec2 at{from.x + static_cast<float>(i % inARow) * (side + between),
                            from.y + static_cast<float>(i / inARow) * (side + between)};
            const ImVec2 end{at.x + side, at.y + side};
            ImGui::GetWindowDrawList()->AddRectFilled(at, end, shown(classColor(i)));
            if (ImGui::IsMouseHoveringRect(at, end))
                ImGui::SetTooltip("class %zu: %s links", i + 1, grouped(links.classes[i]).c_str());
        }
        const auto rows = static_cast<float>((links.classes.size() + inARow - 1) / inARow);
        ImGui::Dummy({contentWidth(), rows * (side + between)});
    }
    wrapped(links.note, quiet());
    if (links.fixed > 0) row("links between fixed particles", grouped(links.fixed));
}

// Legend of cells: a bar of colours from one item to the fullest cell, for all grids, and their counts.
void cellLegend(const std::vector<GridFacts>& grids) {
    if (grids.empty()) return wrapped("no hash grid: the scene has no contacts that need one", quiet());
    std::uint32_t most = 0, shared = 0;
    for (const GridFacts& grid : grids) {
        most = std::max(most, grid.most);
        shared += grid.shared;
    }
    if (most == 0) return wrapped("no step has been taken yet: the grids are empty", quiet());
    colorBar();
    row("items in a cell, from 0", grouped(most));
    for (const GridFacts& grid : grids) {
        char text[64];
        std::snprintf(text, sizeof text, "%s, cells of %.3g m", grid.name.c_str(), double{grid.edge});
        row(text, grouped(grid.cells));
        row("  items / slots", grouped(grid.held) + " / " + grouped(grid.slots));
    }
    if (shared == 0) return;
    colorSwatch(sharedColor, "cells that share a slot");
    row("", grouped(shared));
}

// Buttons and offset of the section plane.
void section(const Facts& facts, Wishes& wishes) {
    const std::optional<Section>& section = facts.layers.section;
    const float width = buttonWidth(3);
    button(Action::section, wishes, width, section.has_value());
    ImGui::SameLine();
    button(Action::turnSection, wishes, width);
    ImGui::SameLine();
    button(Action::faceSection, wishes, width);
    if (!section) return;
    float offset = section->offset;
    const auto [low, high] = facts.sectionReach;
    ImGui::SetNextItemWidth(contentWidth());
    if (ImGui::SliderFloat("##section", &offset, low, high, "plane at %.3f m")) wishes.sectionOffset = offset;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(keyOf(Action::moveSection)).c_str());
}

} // namespace

void look(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    const Layers& layers = facts.layers;
    const float width = buttonWidth(4);
    button(Action::skinLook, wishes, width, layers.skin != SkinLook::solid,
           skinNames[static_cast<std::size_t>(layers.skin)]);
    ImGui::SameLine();
    button(Action::wires, wishes, width, layers.hasWires);
    ImGui::SameLine();
    button(Action::balls, wishes, width, layers.hasBalls);
    ImGui::SameLine();
    button(Action::links, wishes, width, layers.hasLinks);
    button(Action::contacts, wishes, width, layers.hasContacts);
    ImGui::SameLine();
    button(Action::cells, wishes, width, layers.hasCells);
    ImGui::SameLine();
    button(Action::colorMap, wishes, width, layers.map != ColorMap::none,
           mapNames[static_cast<std::size_t>(layers.map)]);
    ImGui::SameLine();
    button(Action::inspect, wishes, width, facts.isInspecting);
    section(facts, wishes);
    if (facts.isPreparing) return wrapped("being prepared ...", quiet());
    if (layers.hasContacts) row("contacts", grouped(facts.contactsFound));
    if (layers.hasCells) cellLegend(facts.grids);
    if (layers.hasLinks) linkLegend(facts.links);
    if (layers.map != ColorMap::none) legend(facts, scene.particles);
}

} // namespace sinew::viewer::parts
