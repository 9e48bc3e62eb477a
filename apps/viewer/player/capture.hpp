// Pictures (PNG) and films of a scene on show, and the messages about their files.
#pragma once

#include "viewer/capture/picture_writer.hpp"
#include "viewer/capture/recording.hpp"
#include "viewer/player/comparison.hpp"
#include "viewer/player/player_context.hpp"
#include "viewer/render/shot.hpp"

namespace sinew::viewer {

/// Draws with the pipelines of the window in full quality, which are there and were used: files show what the
/// window shows when it is still. A failure costs the picture or the film, and nothing else. Main thread
/// only.
class Capture {
public:
    Capture(const PlayerContext& player, const Comparison& comparison)
        : player_(player), comparison_(comparison) {}

    void wantPicture() noexcept { wantsPicture_ = true; }
    bool wantsPicture() const noexcept { return wantsPicture_; }
    bool isFilming() const noexcept { return film_.has_value(); }
    /// Length of the pictures that the film has [s]; empty without a film.
    std::optional<double> filmSeconds() const;

    /// Begins a film: a picture of every step.
    void beginFilm();
    /// Ends it with the pictures that it has. Asks nothing of device and window.
    void endFilm();
    /// Frees the images of a film that has ended. No picture is on its way.
    void freeCameras() noexcept;

    /// Records the picture that is wanted, if any.
    void recordPicture(const Presenter::Frame& frame, const Overlay& overlay);
    /// Records a picture of the film.
    void recordFilm(const Presenter::Frame& frame, const Overlay& overlay);
    /// Writes the pictures of a slot that has finished. `isUndone`: a step before it was undone, and the film
    /// does not show it.
    void settle(std::uint32_t slot, bool isUndone);
    /// Adds the pictures on their way to the film. Their steps are kept, although the state is an earlier
    /// one.
    void keepAll();
    /// Leaves the pictures on their way out of the film: their steps were undone.
    void leaveOut() noexcept;

    /// Says which files have been written. With Wait::yes, waits for all.
    void reportFiles(PictureWriter::Wait wait);

private:
    struct Pending {
        std::unique_ptr<Shot> picture;
        std::uint64_t pictureStep = 0;
        std::optional<std::uint64_t> filmStep; // picture of the film, in cameras_
    };
    Renderer& renderer();
    void recordShot(Shot& shot, VkCommandBuffer commands, std::uint32_t slot, const Overlay& overlay);
    void addToFilm(std::uint32_t slot, std::uint64_t step);
    void fail(const std::exception& error);

    const PlayerContext& player_;
    const Comparison& comparison_;
    bool wantsPicture_ = false;
    std::optional<Recording> film_;
    std::array<std::unique_ptr<Shot>, Presenter::framesInFlight> cameras_; // of the film
    std::array<Pending, Presenter::framesInFlight> pending_;
    PictureWriter writer_{1};
};

} // namespace sinew::viewer
