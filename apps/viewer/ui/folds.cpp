// Names of the folded sections.
#include "viewer/ui/folds.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace sinew::viewer {

namespace {

constexpr std::string_view noFold = "none";

std::string nameOf(std::string_view title) {
    std::string name(title);
    std::ranges::transform(name, name.begin(), [](unsigned char one) { return std::tolower(one); });
    return name;
}

} // namespace

std::string toText(const Folds& folds) {
    std::string text;
    for (std::size_t i = 0; i < foldTitles.size(); ++i)
        if (folds[i]) text.append(text.empty() ? "" : " ").append(nameOf(foldTitles[i]));
    return text.empty() ? std::string(noFold) : text;
}

Folds foldsIn(const std::string& text) {
    Folds folds;
    if (text == noFold) return folds;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const auto title = std::ranges::find(foldTitles, word, nameOf);
        if (title == foldTitles.end()) throw std::runtime_error(word + " is no section of the panel");
        folds.set(static_cast<std::size_t>(title - foldTitles.begin()));
    }
    return folds;
}

} // namespace sinew::viewer
