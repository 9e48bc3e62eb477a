// Names of the folded sections.
#include "viewer/ui/folds.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>
#include <utility>

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

void Reveal::begin(const Before& before, const Vector2& pointer) {
    before_ = before;
    pointer_ = pointer;
}

std::optional<Reveal::Before> Reveal::take(PanelInput& input, float slack) {
    constexpr float away = -1e6f;
    std::optional<Before> back;
    if (before_ && ((input.pointer - pointer_).norm() > slack || input.notches != 0)) before_.reset();
    if (before_ && input.presses[0] > 0) {
        back = std::exchange(before_, std::nullopt);
        isPressed_ = true;
    }
    if (isPressed_) {
        isPressed_ = input.isDown[0];
        input.isDown[0] = false;
        input.presses[0] = 0;
    }
    if (before_) input.pointer = {away, away};
    return back;
}

} // namespace sinew::viewer
