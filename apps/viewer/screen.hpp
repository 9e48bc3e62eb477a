// The window as scenes find it and leave it to each other: panels, messages, and what was chosen for all
// scenes. Each scene brings its own place to draw in.
#pragma once

#include "viewer/beside.hpp"
#include "viewer/panels/panels.hpp"
#include "viewer/prepared_show.hpp"
#include "viewer/window/notices.hpp"
#include "viewer/window/preferences.hpp"
#include "viewer/window/timing.hpp"

#include <chrono>

namespace sinew::viewer {

/// Main thread only. The window and the device of the place must outlive it.
class Screen {
public:
    /// Throws vk::Error.
    Screen(Window& window, std::unique_ptr<Place> place, const Timing& timing,
           const Preferences& preferences = {});
    ~Screen(); ///< the window gets its events back
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    Window& window() { return window_; }
    Presenter& presenter() { return place_->presenter; }
    Panels& panels() { return panels_; }
    Timing& timing() { return timing_; }

    /// Draws in another place from now on and returns the one before, which has no swapchain any more.
    /// Throws vk::Error where the other one does not get the window; then all is as before, but for the
    /// swapchain, which is due.
    std::unique_ptr<Place> moveTo(std::unique_ptr<Place> place);

    /// Makes a swapchain where one is due. `beforehand` is called when the old views are about to go, and
    /// nothing is in flight. False while the window has no size.
    bool prepare(const std::function<void()>& beforehand);
    /// What is on, of every scene.
    Layers& layers() { return layers_; }
    const Layers& layers() const { return layers_; }

    /// What is to play beside every scene; nothing = none.
    std::optional<BesideShape>& beside() { return beside_; }
    const std::optional<BesideShape>& beside() const { return beside_; }

    /// Of the window and the panels, as they are now.
    Preferences preferences() const;
    /// Texts and panels by so many steps larger, or smaller.
    void changeScale(int steps);

    bool isVsync() const { return isVsync_; }
    void toggleVsync();

    /// Pictures that panels show, of so many scenes.
    void expectPreviews(std::size_t count);
    void addPreview(std::size_t scene, const Picture& picture);

    /// Input for the next drawPanels(), with what earlier pictures have not seen.
    void feed(const PanelInput& input);
    /// Lays the panels out and draws them over the frame's picture, which must be in PRESENT_SRC_KHR layout.
    /// What they say of the window and its messages is filled in. Unless they are due they may look as in
    /// the picture before: figures change ten times a second at most, which is as fast as they can be read,
    /// and in one picture of five. Throws vk::Error.
    Wishes drawPanels(const Presenter::Frame& frame, const SceneFacts& scene, Facts facts, bool areDue);

    /// Says something in the window for a while, and in a line on stderr: "warning: <text>".
    void warn(const std::string& text);
    /// Says "note: <text>" in both places, for less long.
    void note(const std::string& text);
    /// Says it in the window alone.
    void tell(const std::string& text);
    /// Says them in the window, one after the other, in place of those of the scene before.
    void announce(const std::vector<std::string>& texts);
    /// True once when a message or a preview has come, or a message has gone.
    bool hasNewNotice();

private:
    void rescale();
    using Clock = std::chrono::steady_clock;

    Window& window_;
    std::unique_ptr<Place> place_;
    Timing timing_;
    Panels panels_;
    PictureSheet sheet_{0};
    PanelInput input_;
    Notices notices_;
    Layers layers_;
    std::optional<BesideShape> beside_;
    float ownScale_, windowScale_; // of texts: as chosen, and as the display wants them
    Clock::time_point lastPicture_ = Clock::now(), panelsDrawn_{};
    std::uint32_t picturesOfPanels_ = 0; // since then
    VkExtent2D pixels_{};
    bool isVsync_;
};

} // namespace sinew::viewer
