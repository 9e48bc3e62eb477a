// Comparison of two solvers: time of a step, and error.
#include "viewer/render/length_text.hpp"
#include "viewer/ui/panel_numbers.hpp"
#include "viewer/ui/panel_parts.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace sinew::viewer::parts {

namespace {

std::string figure(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

Curve sumOfPhases(const std::vector<PhaseCurve>& phases) {
    Curve sums;
    const std::size_t count = phases.empty() ? 0 : phases.front().ms.count();
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        for (const PhaseCurve& phase : phases) sum += phase.ms.at(i);
        sums.add(sum);
    }
    return sums;
}

// Plots two curves on one scale, for which `largest` is shown; outliers are clipped.
void bothPlot(const Curve& left, const Curve& right, const char* format, double factor) {
    const float most = std::max({1.2f * left.quantile(0.9f), 1.2f * right.quantile(0.9f), 1e-9f});
    ImGui::Spacing();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = contentWidth(), height = 3 * ImGui::GetTextLineHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + width, from.y + height}, IM_COL32(255, 255, 255, 10));
    for (const Curve* curve : {&left, &right}) {
        const std::size_t first = Curve::length - curve->count();
        for (std::size_t i = 0; i < curve->count(); ++i)
            list.PathLineTo(
                {from.x + width * static_cast<float>(first + i) / static_cast<float>(Curve::length),
                 from.y + height * (1 - std::min(curve->at(i) / most, 1.0f))});
        list.PathStroke(curveColor(curve == &left ? 0 : 1), 0, 1.5f);
    }
    if (left.count() + right.count() > 0)
        list.AddText(from, ImGui::GetColorU32(quiet()), figure(format, factor * double{most}).c_str());
    ImGui::Dummy({width, height});
}

void lineOf(const std::string& name, std::size_t color, const Curve& ms, const Curve& rms,
            const Curve& largest) {
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(curveColor(color)), "%s", name.c_str());
    const std::string cost = ms.count() > 0 ? figure("%.2f ms", double{ms.median()}) : "";
    row(cost.c_str(), rms.count() == 0 ? ""
                                       : figure("rms %.2f %%", 100.0 * double{rms.newest()}) +
                                             figure(", max %.1f %%", 100.0 * double{largest.newest()}));
}

void shapeKnobs(const SceneFacts& scene, const BesideKnobs& knobs, TypedNumber& typed, Wishes& wishes) {
    BesideKnobs turned = knobs;
    const auto solver = static_cast<std::size_t>(knobs.solver);
    ImGui::SetNextItemWidth(0.55f * contentWidth());
    if (ImGui::BeginCombo("##beside", solver < scene.solvers.size() ? scene.solvers[solver].c_str() : "")) {
        for (std::size_t i = 0; i < scene.solvers.size(); ++i)
            if (ImGui::Selectable(scene.solvers[i].c_str(), i == solver)) turned.solver = static_cast<int>(i);
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::PushID("beside substeps");
    substeps(typed, turned.substeps, ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX());
    ImGui::PopID();
    tip("More substeps: stiffer but slower. 0 = automatic. Takes effect in a moment.");
    if (turned != knobs) wishes.beside = turned;
}

// Two lines high, with or without text.
void result(const std::string& text) {
    const float from = ImGui::GetCursorPosY(), lines = 2 * ImGui::GetTextLineHeightWithSpacing();
    wrapped(fitted(text, contentWidth(), 2), ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::SetCursorPosY(from + lines);
}

constexpr std::array<const char*, 2> sides{"left", "right"};

// "left: split, 24 substeps"
std::string nameOf(const BesideFacts& other, std::size_t side) {
    const std::string what = !other.names[side].empty() ? other.names[side]
                             : other.isMaking           ? "preparing ..."
                                                        : "";
    return sides[side] + (what.empty() ? "" : ": " + what);
}

} // namespace

std::string comparisonText(const Curve& left, const Curve& right, const std::optional<Distance>& apart) {
    std::string text;
    if (left.median() > 0 && right.median() > 0) {
        const double ratio = double{right.median() / left.median()};
        const char* const format =
            ratio < 10 ? "The right one takes %.2g times as long" : "The right one takes %.0f times as long";
        text = figure(format, ratio);
    }
    if (!apart) return text.empty() ? text : text + ".";
    text += text.empty() ? "Particles are " : "; particles are ";
    if (apart->largest == 0) return text + "in the same places.";
    return text + lengthText(apart->rms) + " apart (rms), at most " + lengthText(apart->largest) + ".";
}

// Off and on have the same height, also while the second simulation is made: nothing below moves.
void beside(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes) {
    const BesideFacts& other = facts.beside;
    button(Action::beside, wishes, contentWidth(), other.isOn,
           other.isMaking ? "Compare: preparing ..." : nullptr);
    wrapped("Left: this scene. Right: the same scene and input, solved with:", quiet());
    ImGui::BeginDisabled(!other.isOn);
    shapeKnobs(scene, other.knobs, typed, wishes);
    ImGui::EndDisabled();
    const Curve none, left = other.isOn ? sumOfPhases(facts.phases) : none, right = sumOfPhases(other.phases);
    lineOf(nameOf(other, 0), 0, left, other.isOn ? facts.strainRms : none, facts.strainMax);
    lineOf(nameOf(other, 1), 1, right, other.strainRms, other.strainMax);
    result(comparisonText(left, right, other.apart));
    bothPlot(left, right, "%.3g ms a step", 1);
    bothPlot(other.isOn ? facts.strainRms : none, other.strainRms, "%.3g %% strain", 100);
}

void halves(const Facts& facts, float scale, std::uint32_t width) {
    if (facts.beside.names[1].empty()) return;
    for (std::size_t side = 0; side < sides.size(); ++side) {
        const float middle = (side == 0 ? 0.25f : 0.75f) * static_cast<float>(width);
        ImGui::SetNextWindowPos({middle, 12 * scale}, ImGuiCond_Always, {0.5f, 0});
        ImGui::SetNextWindowBgAlpha(0.85f);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * scale, 6 * scale});
        ImGui::Begin(sides[side], nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav |
                         ImGuiWindowFlags_NoInputs);
        const Curve ms = sumOfPhases(side == 0 ? facts.phases : facts.beside.phases);
        std::string text = nameOf(facts.beside, side);
        if (ms.count() > 0) text += figure(", %.3g ms a step", double{ms.median()});
        if (side == 1 && facts.beside.apart) text += ", " + lengthText(facts.beside.apart->rms) + " apart";
        ImGui::TextUnformatted(text.c_str());
        ImGui::End();
        ImGui::PopStyleVar();
    }
}

} // namespace sinew::viewer::parts
