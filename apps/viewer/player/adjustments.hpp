// Knobs of a scene on show: gravity, pace, material, solver, substeps, device. Keeps them as they were turned
// until they act, which may need another simulation. Asks the scene loader for all scenes, since one is
// opened at a time.
#pragma once

#include "viewer/jobs/devices.hpp"
#include "viewer/jobs/scene_loader.hpp"
#include "viewer/player/comparison.hpp"
#include "viewer/player/player_context.hpp"

namespace sinew::viewer {

/// Main thread only. All references must outlive it.
class Adjustments {
public:
    Adjustments(const PlayerContext& player, SceneLoader& sceneLoader, const Devices& devices,
                const Comparison& comparison);

    /// Knobs as the panels show them: with what tools and playback have of them.
    Knobs shown() const;
    /// Acts at once, or as soon as it is worked out.
    void turn(const Knobs& knobs);
    /// Turns a knob by a key; false for an action that is for no knob.
    bool act(Action action);
    /// Downwards, as it was turned [m/s^2].
    float gravity() const noexcept { return knobs_.gravity; }

    /// Takes a material that is worked out, and asks for what needs another simulation; for that not while
    /// `isReplaying`. To be called for every picture.
    void tend(bool isReplaying);
    /// Moves to another device, by its index in Devices.
    void changeDevice(std::size_t index);

    /// False while a scene is being opened, and says so.
    bool mayOpen();
    /// Opens the scene that a wish or an action asks for.
    void open(const Wishes& wishes);
    void openNext(int by);
    void openFile(const std::string& file);
    /// Begins the replay of a state anew.
    void playAgain(const InputFile& input);
    /// The scene that was asked for, once it is there. A failure to open it leaves all as it is.
    std::unique_ptr<OpenedScene> takeOpened();
    /// Turns the knobs back: what was asked for cannot be had.
    void keepAsItWas();

    /// Shows what the document was turned to, which another run has saved.
    void begin(const app::SavedRun& run);
    /// The document has another shape: its knobs, and the facts about it.
    void reshaped();
    /// Goes on with the knobs of `before`, and asks for those that were turned meanwhile.
    void takeOver(const Adjustments& before);

private:
    Knobs made() const;
    ReloadRequest reloadRequest() const;
    void turnMaterial(const Knobs& knobs);
    void takeMaterial();
    void reopen();

    const PlayerContext& player_;
    SceneLoader& sceneLoader_;
    const Devices& devices_;
    const Comparison& comparison_;
    SceneFacts& facts_;
    Knobs knobs_;                // as they were turned, also while that is being worked out
    std::optional<Knobs> asked_; // requested from the scene loader
    bool isRefused_ = false;     // a material that needs other passes
};

} // namespace sinew::viewer
