// The foldable sections of the side panel, and their names in the file of preferences.
#pragma once

#include "viewer/input/panel_input.hpp"

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::viewer {

/// In the order of the panel.
enum class Fold : std::size_t { scene, material, view, record, compare, performance, window };

/// Headings of the sections, by Fold.
inline constexpr std::array<std::string_view, 7> foldTitles{"Scene",   "Material",    "View",  "Record",
                                                            "Compare", "Performance", "Window"};

/// The sections that are folded: a set bit hides everything of a section but its heading.
using Folds = std::bitset<foldTitles.size()>;

constexpr std::size_t indexOf(Fold fold) {
    return static_cast<std::size_t>(fold);
}

/// Sections that most people do not need are folded until somebody opens them.
inline const Folds foldedAtFirst = Folds().set(indexOf(Fold::compare)).set(indexOf(Fold::performance));

/// Titles of the folded sections in lower case, separated by blanks; "none" if there is none.
std::string toText(const Folds& folds);
/// The inverse of toText(). Throws std::runtime_error, which names a word that is no section.
Folds foldsIn(const std::string& text);

/// A section that a click has opened below the window, so that the panel has scrolled. Something else is
/// under the pointer then: until the pointer moves, that neither lights up nor takes a press.
class Reveal {
public:
    struct Before {
        Folds folds;
        float scroll = 0; ///< [pixels]
    };
    void begin(const Before& before, const Vector2& pointer);
    bool isHeld() const { return before_.has_value(); }
    /// Hides the pointer and its press from the panels. A press folds the section again: it returns what was
    /// before. A pointer that moves by more than `slack` [pixels], or the wheel, ends it.
    std::optional<Before> take(PanelInput& input, float slack);

private:
    std::optional<Before> before_;
    Vector2 pointer_ = Vector2::Zero();
    bool isPressed_ = false; // until the button is released
};

} // namespace sinew::viewer
