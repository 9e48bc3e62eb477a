// The parts of the side panel and their shared functions. Each part reads facts and adds to the requests; all
// are called between ImGui::NewFrame and Render.
#pragma once

#include "viewer/ui/facts.hpp"
#include "viewer/ui/folds.hpp"

#include <imgui.h>

#include <functional>

namespace sinew::viewer {
struct HelpSearch;
struct FileField;
struct GalleryState;
struct SceneFields;
struct TypedNumber;
} // namespace sinew::viewer

namespace sinew::viewer::parts {

/// Colour of a curve by its index; distinct for most colour-blind eyes (Okabe and Ito 2008).
ImU32 curveColor(std::size_t curve);
/// Colour of a phase of a step: it is the same in every scene.
ImU32 phaseColor(std::string_view name);

/// Text colours: quiet text; the next two stand out, the second more.
ImVec4 quiet();
ImVec4 warning();
ImVec4 bad();
ImVec4 accent();
/// Background of a button that is on.
ImVec4 lit();

/// Text on removed fragments.
std::string debrisText(const Facts& facts);

/// Width between the margins of the panel [pixels].
float contentWidth();
/// Draws a thin line of that width.
void rule();
/// Writes quiet text above a line, with room above.
void heading(const char* name);
/// A triangle in a line of text: it points down if what belongs to it is open, else to the right.
void foldMark(const ImVec2& at, float height, bool isOpen, ImU32 color);
/// A section with a heading, which folds or opens it when it is clicked and has a short text on its right.
/// `content` draws an open one. The window scrolls to one that opens below what is in view.
void section(Fold fold, Folds& folds, const std::string& text, const std::function<void()>& content,
             const ImVec4& color = quiet());
/// As much of a text as fits in `lines` lines of `width` pixels, with dots in place of the words left out.
std::string fitted(const std::string& text, float width, float lines);
/// Writes text with line breaks at the panel's width.
void wrapped(const std::string& text, const ImVec4& color);

/// Writes a name on the left and its value on the right.
void row(const char* name, const std::string& value);
void row(const char* name, const std::string& value, const ImVec4& color);
/// Writes two rows in one line.
void pair(const char* name, const std::string& value, const char* other, const std::string& otherValue,
          const ImVec4& otherColor);

/// Shows a text while the pointer is on the last item: left or right of its window in its row, so that it
/// covers no other row, and below the pointer where there is no room. Also for a disabled item.
void tip(const std::string& text);

/// Width of each of `inARow` buttons that fill a line [pixels].
float buttonWidth(std::size_t inARow);
/// A button of an action, `width` pixels wide, with its key in a tooltip. The label is from the table of
/// bindings unless `name` is given. `isOn`: drawn as pressed. `more`: further line of the tooltip.
void button(Action action, Wishes& wishes, float width, bool isOn = false, const char* name = nullptr,
            std::string_view more = {});

/// Numbers of buttons and of groups of the toolbar, for its size.
std::size_t toolbarButtons();
std::size_t toolbarGroups();
/// Icons, each in a square of `side` pixels.
void toolbar(const Facts& facts, float side, Wishes& wishes);

/// One line on the present device.
void deviceLine(const SceneFacts& scene, const Facts& facts);
/// The present device, and the list of all devices.
void device(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
/// "Scenes: organ".
std::string galleryLabel(const std::string& scene);
void scenes(const SceneFacts& scene, const Facts& facts, SceneFields& fields, Wishes& wishes);
/// Cards of all scenes over the picture, while it is open.
void gallery(const Facts& facts, GalleryState& state, Wishes& wishes);
/// The list of files, while it is shown.
void open(FileField& files, Wishes& wishes);
void play(const Facts& facts, Wishes& wishes);
void parameters(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes);
void look(const Facts& facts, Wishes& wishes);
/// Legends of the layers that are on; hasLegend(): whether there are any.
bool hasLegend(const Facts& facts);
void legend(const SceneFacts& scene, const Facts& facts);
void camera(Wishes& wishes);
void files(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
/// "The right one takes 0.46 times as long; particles are 1.2 mm apart (rms), at most 4.7 mm.", as far as it
/// is known. `left`, `right`: times of steps [ms].
std::string comparisonText(const Curve& left, const Curve& right, const std::optional<Distance>& apart);
void beside(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes);
void cuts(const Facts& facts);
void window(const Facts& facts, Wishes& wishes);
void solver(const SceneFacts& scene, const Facts& facts, TypedNumber& typed, Wishes& wishes);
void speed(const Facts& facts);
/// "12.3 ms a step"; empty if it is not measured.
std::string stepText(const Facts& facts);
void counts(const SceneFacts& scene, const Facts& facts);
void program(const SceneFacts& scene);

/// While two simulations are compared, writes over each half what plays there; both are `width` pixels wide.
void halves(const Facts& facts, float scale, std::uint32_t width);

/// Draws a small window beside the pointer; `free` pixels from the left are not covered by the panel.
void probe(const Facts& facts, float scale, float free);

/// Draws the table of keys over everything: the lines that contain the text of the search.
void help(HelpSearch& search, float scale);

} // namespace sinew::viewer::parts
