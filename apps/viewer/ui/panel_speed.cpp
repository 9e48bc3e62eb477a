// Speed and error: the time of a step by phase, and the strain of links.
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

std::string number(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

// The smallest of 1, 2 and 5 times a power of ten that is at least `value`.
float roundUp(float value) {
    const float power = std::pow(10.0f, std::floor(std::log10(std::max(value, 1e-6f))));
    for (const float step : {1.0f, 2.0f, 5.0f})
        if (value <= step * power * 1.0001f) return step * power;
    return 10 * power;
}

// A plot area with its scale in the upper left corner.
struct Field {
    ImVec2 from, to;
    float most = 1;
    float y(float value) const { return to.y - std::min(value / most, 1.0f) * (to.y - from.y); }
    float x(std::size_t i) const {
        return from.x + (to.x - from.x) * static_cast<float>(i) / static_cast<float>(Curve::length);
    }
};

Field makeField(float height, float most) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = contentWidth();
    ImGui::Dummy({width, height});
    const Field field{from, {from.x + width, from.y + height}, roundUp(most)};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(field.from, field.to, IM_COL32(255, 255, 255, 10));
    const float middle = std::round((field.from.y + field.to.y) / 2);
    list.AddRectFilled({field.from.x, middle}, {field.to.x, middle + 1}, IM_COL32(255, 255, 255, 20));
    return field;
}

void label(const Field& field, const std::string& text) {
    const ImVec2 pad = ImGui::GetStyle().ItemInnerSpacing;
    ImGui::GetWindowDrawList()->AddText(
        {std::floor(field.from.x + pad.x), std::floor(field.from.y + pad.y / 2)}, ImGui::GetColorU32(quiet()),
        text.c_str());
}

// A plot of stacked phases, the newest step on the right.
void phasePlot(const std::vector<PhaseCurve>& phases) {
    const std::size_t count = phases.front().ms.count();
    Curve sums;
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        for (const PhaseCurve& phase : phases) sum += phase.ms.at(i);
        sums.add(sum);
    }
    // The scale clips outliers, such as a step in which a driver compiles.
    const Field field =
        makeField(5 * ImGui::GetTextLineHeight(), std::max(1.2f * sums.quantile(0.9f), 0.01f));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place = i + Curve::length - count;
        float below = 0;
        for (std::size_t p = 0; p < phases.size(); ++p) {
            const float above = below + phases[p].ms.at(i);
            const float top = field.y(above), bottom = field.y(below);
            if (bottom - top > 0.25f)
                list.AddRectFilled({field.x(place), top}, {field.x(place + 1), bottom},
                                   phaseColor(phases[p].name));
            below = above;
        }
    }
    label(field, number("%g ms", double{field.most}));
}

// A coloured square before a line of text.
void swatch(ImU32 color) {
    const float side = std::round(0.6f * ImGui::GetTextLineHeight());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float drop = std::round((ImGui::GetTextLineHeight() - side) / 2);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + drop}, {at.x + side, at.y + drop + side}, color,
                                              2);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.8f * side);
}

void legend(const std::vector<PhaseCurve>& phases) {
    for (std::size_t p = 0; p < phases.size(); ++p) {
        swatch(phaseColor(phases[p].name));
        row(phases[p].name.c_str(), number("%.2f ms", double{phases[p].ms.median()}));
    }
}

// Draws a curve of the newest values, which ends at the right.
void line(const Field& field, const Curve& curve, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::size_t first = Curve::length - curve.count();
    for (std::size_t i = 0; i < curve.count(); ++i)
        list.PathLineTo({field.x(first + i) + 0.5f, field.y(curve.at(i))});
    list.PathStroke(color, 0, 1.5f);
}

void strainPlot(const Facts& facts) {
    heading("strain of links");
    float most = 1e-4f;
    for (std::size_t i = 0; i < facts.strainMax.count(); ++i) most = std::max(most, facts.strainMax.at(i));
    const Field field = makeField(4 * ImGui::GetTextLineHeight(), most);
    line(field, facts.strainMax, curveColor(1));
    line(field, facts.strainRms, curveColor(0));
    label(field, number("%g %%", 100.0 * double{field.most}));
    const double rms = double{facts.strainRms.newest()}, largest = double{facts.strainMax.newest()};
    swatch(curveColor(0));
    pair("rms", number("%.2f %%", 100 * rms), "largest", number("%.1f %%", 100 * largest),
         ImGui::ColorConvertU32ToFloat4(curveColor(1)));
}

} // namespace

std::string stepText(const Facts& facts) {
    float sum = 0;
    for (const PhaseCurve& phase : facts.phases) sum += phase.ms.median();
    return sum > 0 ? number("%.3g ms a step", double{sum}) : "";
}

void speed(const Facts& facts) {
    heading("time of one step");
    if (!facts.phases.empty() && facts.phases.front().ms.count() > 0) {
        phasePlot(facts.phases);
        legend(facts.phases);
    } else {
        wrapped(facts.phases.empty() ? "This device has no timestamps." : "No step yet.", quiet());
    }
    const bool isBehind = !facts.isPaused && facts.keptPace < 0.95 * facts.pace;
    pair("frame", number("%.0f ms", double{facts.frameMs.median()}), "speed",
         facts.isPaused ? "paused" : number("%.2f x real", facts.keptPace),
         isBehind ? warning() : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    if (facts.strainMax.count() > 0) strainPlot(facts);
}

} // namespace sinew::viewer::parts
