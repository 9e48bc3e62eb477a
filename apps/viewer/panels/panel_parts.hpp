// The parts of the side panel and what they share. Each reads facts and adds to wishes; all are called
// between ImGui::NewFrame and Render.
#pragma once

#include "viewer/panels/facts.hpp"

#include <imgui.h>

namespace sinew::viewer {
struct PathField;
}

namespace sinew::viewer::parts {

/// Colors that stay apart for most colour-blind eyes (Okabe and Ito 2008), of the phases in their order.
ImU32 phaseColor(std::size_t phase);

/// Quiet text; the next two stand out, the second more.
ImVec4 quiet();
ImVec4 warning();
ImVec4 bad();
ImVec4 accent();

/// "12,345".
std::string grouped(std::uint64_t number);
/// Of pieces that were removed.
std::string crumbsText(const Facts& facts);

/// Between the margins of the panel [pixels].
float contentWidth();
/// A fine line as wide.
void rule();
/// Quiet words over a line, with room above.
void heading(const char* name);
/// As many lines as the panel's width asks for.
void wrapped(const std::string& text, const ImVec4& color);

/// A name on the left, what it is on the right.
void row(const char* name, const std::string& value);
void row(const char* name, const std::string& value, const ImVec4& color);
/// Two of them in a line.
void pair(const char* name, const std::string& value, const char* other, const std::string& otherValue,
          const ImVec4& otherColor);

/// Of each of so many buttons that fill a line [pixels].
float buttonWidth(std::size_t inARow);
/// The button of an action with its key in a tip, as wide as said [pixels]; its name from the table of
/// bindings unless `name` says otherwise. `isOn` buttons are lit.
void button(Action action, Wishes& wishes, float width, bool isOn = false, const char* name = nullptr);

void device(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
void play(const Facts& facts, Wishes& wishes);
void look(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
void speed(const Facts& facts);
void beside(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
void counts(const SceneFacts& scene, const Facts& facts);
void cuts(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
void program(const SceneFacts& scene);
void scenes(const SceneFacts& scene, const Facts& facts, PathField& path, Wishes& wishes);
void knobs(const SceneFacts& scene, const Facts& facts, Wishes& wishes);

/// A little window beside the pointer; `free` pixels from the left are beside the panel.
void probe(const Facts& facts, float scale, float free);

/// The table of keys over everything.
void help(float scale);

} // namespace sinew::viewer::parts
