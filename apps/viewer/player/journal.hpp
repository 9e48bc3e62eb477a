// The log of a scene on show: saves it and states, and plays a log that was saved.
#pragma once

#include "viewer/jobs/replay.hpp"
#include "viewer/jobs/scene_loader.hpp"
#include "viewer/player/player_context.hpp"

namespace sinew::viewer {

/// Main thread only. All references must outlive it.
class Journal {
public:
    Journal(const PlayerContext& player, const SceneLoader& sceneLoader);

    /// Writes the log, or the state, to the current folder. Waits. `isDiverged`: there is no state to save.
    void saveInput();
    void saveState(bool isDiverged);
    /// Implements ScenePlayer::keepInput.
    std::string keepInput(const std::filesystem::path& otherwise) const;
    /// Notes that the log does not lead to the state any more.
    void breakOff() noexcept { isBroken_ = true; }

    /// Null while nothing is replayed.
    const InputFile* replayed() const noexcept { return replay_ ? &replay_->file() : nullptr; }
    bool isReplaying() const noexcept { return replay_.has_value(); }
    /// True if a reset has to load the state that the log begins from.
    bool beginsFromState() const noexcept { return replay_ && from_; }
    /// Does what the log has before the next step. False if no step follows now.
    bool playUntilStep(const Presenter::Frame& frame);
    /// Compares the result of a replay that has just ended with the recorded one. Waits.
    void compareReplay();
    /// Ends a replay that was dropped by hand, once no simulation is about to be replaced.
    void dropReplay();
    /// Says why a change was refused, and ends the replay if there is one.
    void endReplay(const std::string& why);
    /// Sentence for hands that want the tools while a replay plays.
    static std::string howToEnd();
    /// Takes an action while a replay plays: tools and knobs are those of the log. False if it is for others.
    bool takes(Action action);

    /// Begins from a state that was saved.
    void begin(const app::SavedRun& run);
    /// Begins anew after a reset of the document: tools, log and replay. `gravity` as it was turned [m/s^2].
    void reset(float gravity);
    void takeOver(const Journal& before);

private:
    InputFile inputFile() const;
    std::string sceneName() const;
    std::string stem(std::uint64_t step) const;

    const PlayerContext& player_;
    const SceneLoader& sceneLoader_;
    std::optional<Replay> replay_;
    std::optional<InputFile> ended_;  // replay that has just come to its end
    Shaped begun_;                    // shape of the document at the reset
    std::optional<SavedOrigin> from_; // until the reset
    std::size_t saved_ = 0;           // events of the log that some file has, or a reset has made
    bool isDropped_ = false;          // the replay, by hand
    bool isBroken_ = false;
};

} // namespace sinew::viewer
