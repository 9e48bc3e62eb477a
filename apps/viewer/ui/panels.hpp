// The panels of the window, with Dear ImGui: layout, style, pointer handling and the list of parts, which are
// in panel_*.cpp. Makes triangles and requests from facts; touches no device and no window.
#pragma once

#include "viewer/input/panel_input.hpp"
#include "viewer/ui/facts.hpp"
#include "viewer/ui/file_browser.hpp"
#include "viewer/ui/folds.hpp"
#include "viewer/ui/panel_painter.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>

struct ImGuiContext;

namespace sinew::viewer {

/// The list of files to open, and the text field over it.
struct FileField {
    bool isShown = false, wantsKeys = false;
    bool wantsFolder = false; ///< its folder is read anew
    int pictures = 0;         ///< pictures since it began to wait for keys
    std::array<char, 1024> text{};
    FileBrowser browser{};
};

/// The gallery opens in the picture after it is wanted.
struct GalleryState {
    bool wants = false, closes = false, isOpen = false;
};

/// Parts of the section of the scene that stay between pictures.
struct SceneFields {
    FileField files;
    GalleryState gallery;
};

/// The text in the field for a number that has the keys. Dear ImGui forgets it when another control takes a
/// press.
struct TypedNumber {
    unsigned field = 0;      ///< its ID
    int picture = 0;         ///< the last one in which it had the keys
    std::string first, text; ///< when it got the keys, and in that picture
};

/// Text that is typed while the help is open.
struct HelpSearch {
    std::string text;
    float height = 0; ///< of the help without a search [pixels]

    /// Adds characters; Backspace removes the last.
    void type(const PanelInput& input);
};

/// Only one may exist (Dear ImGui's context is global); one thread.
class Panels {
public:
    /// `scale` 1 = 96 pixels per inch.
    explicit Panels(float scale);
    ~Panels();
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    const GlyphAtlas& atlas() const { return atlas_; }

    /// Lays out everything for a picture of `extent`, `seconds` after the last one.
    Wishes build(const SceneFacts& scene, const Facts& facts, const PanelInput& input, VkExtent2D extent,
                 double seconds);
    /// Lays out a text alone, in the middle of the picture.
    void buildText(const std::string& text, VkExtent2D extent);
    /// Triangles of the last build() or buildText(); valid until the next.
    const ImDrawData& drawn() const;

    /// Whether a place (pixels) belongs to a panel of the last build(), which then gets presses there.
    bool covers(const Vector2& pixels) const;
    /// Whether a panel takes keys, or will: from toggleFiles() on.
    bool takesKeys() const;
    /// Whether keys that type a letter belong to the search of the help; all others act as always.
    bool takesLetters() const { return isHelpShown_ && !takesKeys(); }

    /// Opens a list of files (Wishes::file) with a text field for a path, or closes it. `paste` provides the
    /// text to paste.
    void toggleFiles();
    void setPaste(std::function<std::string()> paste) { paste_ = std::move(paste); }
    /// `copy` receives text that is copied or cut from a field.
    void setCopy(std::function<void(const std::string&)> copy) { copy_ = std::move(copy); }

    /// Opens the gallery of scenes, or closes it.
    void toggleGallery();
    bool isGalleryShown() const { return fields_.gallery.isOpen || fields_.gallery.wants; }

    /// Sets the scale (see the constructor). The atlas changes.
    void rescale(float scale);

    /// The user's choice whether panels are shown; empty = no choice yet.
    const std::optional<bool>& choice() const { return isShown_; }
    void choose(std::optional<bool> isShown) { isShown_ = isShown; }
    /// The sections that are folded: the user's choice.
    const Folds& folds() const { return folds_; }
    void fold(const Folds& folds) { folds_ = folds; }
    void toggle() { isShown_ = !isShown(lastExtent_); }
    void toggleHelp() {
        isHelpShown_ = !isHelpShown_;
        search_.text.clear();
    }
    void closeHelp() { isHelpShown_ = false; }
    /// Closes the help, or else the gallery; false if neither is open.
    bool closeTop();
    /// Closes all that was open for a moment, as a press beside it asks: help, gallery, list of files, open
    /// boxes, fields.
    void closeAll();
    bool isHelpShown() const { return isHelpShown_; }
    /// Without a choice, panels are shown if the window is large enough.
    bool isShown(VkExtent2D extent) const;
    /// Width that panels cover at the right of a picture [pixels].
    std::uint32_t sideWidth(VkExtent2D extent) const;

private:
    void feed(const PanelInput& input, VkExtent2D extent, double seconds);
    void feedButton(const PanelInput& input, std::size_t button);
    void feedTyped(const PanelInput& input);
    void feedKeys(const PanelInput& input);
    bool isAsking() const;
    float toolbarSide(VkExtent2D extent) const;
    float toolbarWidth(VkExtent2D extent) const;
    void buildToolbar(const Facts& facts, VkExtent2D extent, Wishes& wishes);
    void buildSide(const SceneFacts& scene, const Facts& facts, VkExtent2D extent, Wishes& wishes);
    void buildSections(const SceneFacts& scene, const Facts& facts, VkExtent2D extent, Wishes& wishes);
    void buildPerformance(const SceneFacts& scene, const Facts& facts, Wishes& wishes);
    void keepHeight();
    float buildScaleBar(const Facts& facts, VkExtent2D extent);
    void buildHint(const Facts& facts, VkExtent2D extent, float taken);
    bool isLegendApart(VkExtent2D extent) const;
    void buildLegend(const SceneFacts& scene, const Facts& facts, VkExtent2D extent);
    void buildNotice(const Facts& facts, VkExtent2D extent);
    void buildFiles(const Facts& facts, VkExtent2D extent, Wishes& wishes);
    void buildRecording(const Facts& facts, VkExtent2D extent);
    float freeWidth(VkExtent2D extent) const;
    void remember();

    struct Rectangle {
        Vector2 from, to;
    };
    ImGuiContext* context_;
    GlyphAtlas atlas_;
    float scale_;
    std::optional<bool> isShown_;
    Folds folds_ = foldedAtFirst;
    Reveal reveal_;
    bool isHelpShown_ = false;
    HelpSearch search_;
    float sideHeight_ = 0;   // of what the panel at the side holds [pixels]
    float legendHeight_ = 0; // [pixels]
    SceneFields fields_;
    TypedNumber typed_;
    std::function<std::string()> paste_;
    std::string pasted_;
    std::function<void(const std::string&)> copy_;
    std::vector<int> released_; // keys to release in the next picture
    PanelInput early_;          // characters typed before the field of files opens
    bool closesAll_ = false;    // in the next picture
    std::array<int, 3> owed_{}; // presses not yet passed to a picture
    VkExtent2D lastExtent_{};
    std::vector<Rectangle> covered_;
};

} // namespace sinew::viewer
