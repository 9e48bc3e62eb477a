// The panels of the window, by Dear ImGui: layout and style, what the pointer does in them, which parts there
// are. Makes triangles and wishes out of facts; touches no device and no window. What a part shows stands in
// panel_*.cpp.
#pragma once

#include "viewer/panels/facts.hpp"
#include "viewer/panels/panel_input.hpp"
#include "viewer/panels/panel_painter.hpp"

#include <array>
#include <functional>
#include <memory>
#include <utility>

struct ImGuiContext;

namespace sinew::viewer {

/// A path that is being typed.
struct PathField {
    bool isShown = false, wantsKeys = false;
    int pictures = 0; ///< in which it has been waiting for keys
    std::array<char, 1024> text{};
};

/// One at a time (Dear ImGui's context is global); one thread.
class Panels {
public:
    /// `scale` of one = 96 pixels an inch.
    explicit Panels(float scale);
    ~Panels();
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    const GlyphAtlas& atlas() const { return atlas_; }

    /// Lays out everything for a picture of `extent`, `seconds` after the last one.
    Wishes build(const SceneFacts& scene, const Facts& facts, const PanelInput& input, VkExtent2D extent,
                 double seconds);
    /// What the last build() made; valid until the next.
    const ImDrawData& drawn() const;

    /// Whether a place (pixels) belongs to a panel of the last build(): what is pressed there is not the
    /// scene's.
    bool covers(const Vector2& pixels) const;
    /// Whether keys are being typed into a panel, or will be: from askForFile() on.
    bool takesKeys() const;

    /// A line to type a path into, where there was none: Wishes::file. What is pasted there comes from
    /// `paste`.
    void askForFile();
    void setPaste(std::function<std::string()> paste) { paste_ = std::move(paste); }
    /// What is copied or cut out of a line goes to `copy`.
    void setCopy(std::function<void(const std::string&)> copy) { copy_ = std::move(copy); }

    /// As the constructor does. The atlas is another one then.
    void rescale(float scale);

    /// What somebody has said about whether panels are shown; nothing = nobody has.
    const std::optional<bool>& choice() const { return isShown_; }
    void choose(std::optional<bool> isShown) { isShown_ = isShown; }
    void toggle() { isShown_ = !isShown(lastExtent_); }
    void toggleHelp() { isHelpShown_ = !isHelpShown_; }
    void closeHelp() { isHelpShown_ = false; }
    bool isHelpShown() const { return isHelpShown_; }
    /// Before anybody has said otherwise, in windows that leave room beside them.
    bool isShown(VkExtent2D extent) const;
    /// How much of a picture they stand in at the right [pixels].
    std::uint32_t sideWidth(VkExtent2D extent) const;

private:
    void feed(const PanelInput& input, VkExtent2D extent, double seconds);
    void feedButton(const PanelInput& input, std::size_t button);
    void feedTyped(const PanelInput& input);
    void feedKeys(const PanelInput& input);
    bool isAsking() const;
    void buildSide(const SceneFacts& scene, const Facts& facts, VkExtent2D extent, Wishes& wishes);
    void buildHint(const SceneFacts& scene, const Facts& facts, VkExtent2D extent);
    void buildNotice(const Facts& facts, VkExtent2D extent);
    void remember();

    struct Rectangle {
        Vector2 from, to;
    };
    ImGuiContext* context_;
    GlyphAtlas atlas_;
    float scale_;
    std::optional<bool> isShown_;
    bool isHelpShown_ = false;
    PathField path_;
    std::function<std::string()> paste_;
    std::string pasted_;
    std::function<void(const std::string&)> copy_;
    std::vector<int> released_; // keys, in the next picture
    PanelInput early_;          // typed, by what path_ waits for
    std::array<int, 3> owed_{}; // presses that no picture has seen yet
    VkExtent2D lastExtent_{};
    std::vector<Rectangle> covered_;
};

} // namespace sinew::viewer
