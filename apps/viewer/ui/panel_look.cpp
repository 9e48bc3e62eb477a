// The layers of the bodies, and the legends of their colours.
#include "viewer/ui/panel_parts.hpp"

#include "viewer/render/layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

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

void mapLegend(const Facts& facts, std::size_t particles) {
    const ColorMap map = facts.layers.map();
    if (map == ColorMap::sleep) return sleepLegend(facts, particles);
    if (facts.mapRange <= 0) return wrapped("No data yet.", quiet());
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
    char beyond[32];
    std::snprintf(beyond, sizeof beyond, "%.2g %% of particles", 100 * double{facts.map.beyond});
    const std::string limit =
        "above " + valueText(map, facts.map.range); // of this state, not the colours' range
    row(limit.c_str(), beyond);
    row("largest", valueText(map, facts.map.largest));
}

// A square for each color, as many in a line as fit.
void squares(const LegendLine& line) {
    const float side = 0.8f * ImGui::GetTextLineHeight(), between = 0.5f * ImGui::GetStyle().ItemSpacing.x;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const auto inARow = std::max(static_cast<std::size_t>(contentWidth() / (side + between)), std::size_t{1});
    for (std::size_t i = 0; i < line.colors.size(); ++i) {
        const ImVec2 at{from.x + static_cast<float>(i % inARow) * (side + between),
                        from.y + static_cast<float>(i / inARow) * (side + between)};
        const ImVec2 end{at.x + side, at.y + side};
        ImGui::GetWindowDrawList()->AddRectFilled(at, end, shown(line.colors[i]));
        if (ImGui::IsMouseHoveringRect(at, end)) ImGui::SetTooltip("%s", line.tips[i].c_str());
    }
    const auto rows = static_cast<float>((line.colors.size() + inARow - 1) / inARow);
    ImGui::Dummy({contentWidth(), rows * (side + between)});
}

void legendOf(const std::vector<LegendLine>& lines) {
    for (const LegendLine& line : lines) switch (line.kind) {
        case LegendLine::Kind::text:
            wrapped(line.name, quiet());
            break;
        case LegendLine::Kind::row:
            row(line.name.c_str(), line.value);
            break;
        case LegendLine::Kind::bar:
            colorBar();
            break;
        case LegendLine::Kind::swatch:
            colorSwatch(line.colors.front(), line.name.c_str());
            row("", line.value);
            break;
        case LegendLine::Kind::squares:
            squares(line);
            break;
        }
}

// A button for each layer, four in a line; `facts.isInspecting` has the last one.
void layerButtons(const Facts& facts, Wishes& wishes) {
    constexpr std::size_t inARow = 4;
    const float width = buttonWidth(inARow);
    const std::span table = layerTable();
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::size_t look = facts.layers.looks[i];
        const std::string name(look > 0 ? table[i]->looks[look - 1].button : table[i]->button);
        button(actionOfLayer(i), wishes, width, look > 0, name.c_str());
        if (i % inARow + 1 < inARow) ImGui::SameLine();
    }
    button(Action::inspect, wishes, width, facts.isInspecting);
}

// Direction and offset of the section plane, which the toolbar turns on.
void section(const Facts& facts, Wishes& wishes) {
    const std::optional<Section>& section = facts.layers.section;
    const float width = buttonWidth(2);
    button(Action::turnSection, wishes, width);
    ImGui::SameLine();
    button(Action::faceSection, wishes, width);
    if (!section) return;
    // In centimeters, so that a number that is typed has the unit on show; + 0 makes -0 a 0.
    float shown = std::round(1e4f * section->offset) / 100 + 0.0f;
    const auto [low, high] = facts.sectionReach;
    ImGui::SetNextItemWidth(contentWidth());
    if (ImGui::SliderFloat("##section", &shown, 100 * low, 100 * high, "plane at %.4g cm"))
        wishes.sectionOffset = shown / 100;
    tip(std::string(keyOf(Action::moveSection)));
}

} // namespace

void look(const Facts& facts, Wishes& wishes) {
    layerButtons(facts, wishes);
    section(facts, wishes);
}

bool hasLegend(const Facts& facts) {
    return facts.isPreparing || facts.layers.map() != ColorMap::none ||
           std::ranges::any_of(facts.legends, [](const auto& lines) { return !lines.empty(); });
}

void legend(const SceneFacts& scene, const Facts& facts) {
    if (facts.isPreparing) return wrapped("Preparing the view ...", quiet());
    for (const std::vector<LegendLine>& lines : facts.legends) legendOf(lines);
    if (facts.layers.map() != ColorMap::none) mapLegend(facts, scene.particles);
}

} // namespace sinew::viewer::parts
