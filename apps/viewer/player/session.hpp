// Window state that scenes share: panels, messages, and choices for all scenes. Each scene brings its own
// place to draw in.
#pragma once

#include "viewer/jobs/prepared_player.hpp"
#include "viewer/jobs/second_simulation.hpp"
#include "viewer/ui/notices.hpp"
#include "viewer/ui/panels.hpp"
#include "viewer/ui/preferences.hpp"
#include "viewer/ui/timing.hpp"

#include <chrono>

namespace sinew::viewer {

/// Main thread only. The window and the device of the place must outlive it.
class Session {
public:
    /// Throws vk::Error.
    Session(Window& window, std::unique_ptr<WindowOutput> output, const Timing& timing,
            const Preferences& preferences = {});
    ~Session(); ///< returns the window's events
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    Window& window() { return window_; }
    Presenter& presenter() { return output_->presenter; }
    Panels& panels() { return panels_; }
    Timing& timing() { return timing_; }

    /// Changes the place to draw in and returns the old one, which then has no swapchain. Throws vk::Error if
    /// the new one cannot get the window; everything is then as before, but a swapchain is due.
    std::unique_ptr<WindowOutput> moveTo(std::unique_ptr<WindowOutput> output);

    /// Makes a swapchain if one is due. Calls `beforehand` before it destroys the old views, when nothing is
    /// in flight. False while the window has no size.
    bool prepare(const std::function<void()>& beforehand);
    /// Shows a text on a plain ground until the first picture. Throws vk::Error.
    void showText(const vk::Device& device, const std::string& text);
    /// Active layers, shared by all scenes.
    Layers& layers() { return layers_; }
    const Layers& layers() const { return layers_; }

    /// Settings of the comparison, shared by all scenes; empty = none.
    std::optional<BesideShape>& beside() { return beside_; }
    const std::optional<BesideShape>& beside() const { return beside_; }
    /// Whether the key B has chosen them: another scene may then have others.
    bool& isBesideDefault() { return isBesideDefault_; }

    /// Present preferences of the window and the panels.
    Preferences preferences() const;
    bool isVsync() const { return isVsync_; }

    /// Does an action about the window, its texts and panels, or its times; nothing for any other.
    void act(Action action);

    /// Sets the number of scenes with previews.
    void expectPreviews(std::size_t count);
    void addPreview(std::size_t scene, const Picture& picture);

    /// Input for the next drawPanels(), with the events that earlier pictures have not seen.
    void feed(const PanelInput& input);
    /// Lays out the panels and draws them over the frame's picture, which must be in PRESENT_SRC_KHR layout.
    /// Fills in the facts on the window and its messages. Unless `areDue`, panels may look as in the picture
    /// before: figures change at most ten times a second, which is as fast as one can read, and in one
    /// picture of five. Throws vk::Error.
    Wishes drawPanels(const Presenter::Frame& frame, const SceneFacts& scene, Facts facts, bool areDue);

    /// Shows a text in the window for a while, and prints "warning: <text>" on stderr.
    void warn(const std::string& text);
    /// Shows and prints "note: <text>", for a shorter time.
    void note(const std::string& text);
    /// Shows a text only in the window.
    void tell(const std::string& text);
    /// Shows texts in the window, one after the other, in place of those of the scene before.
    void announce(const std::vector<std::string>& texts);
    /// True once after a message or a preview has come, or a message has gone.
    bool hasNewNotice();

private:
    void toggleVsync();
    /// Makes texts and panels larger by so many steps, or smaller.
    void changeScale(int steps);
    void rescale();
    using Clock = std::chrono::steady_clock;

    Window& window_;
    std::unique_ptr<WindowOutput> output_;
    Timing timing_;
    Panels panels_;
    PictureSheet sheet_{0};
    PanelInput input_;
    Notices notices_;
    Layers layers_;
    std::optional<BesideShape> beside_;
    bool isBesideDefault_ = false;
    float ownScale_, windowScale_; // of texts: the user's choice, and the display's request
    Clock::time_point lastPicture_ = Clock::now(), panelsDrawn_{};
    std::uint32_t picturesOfPanels_ = 0; // since then
    VkExtent2D pixels_{};
    bool isVsync_;
};

} // namespace sinew::viewer
