// The foldable sections of the side panel, and their names in the file of preferences.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
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

} // namespace sinew::viewer
