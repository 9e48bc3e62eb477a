// Scene player: a scene that plays in a window, with input, steps in real time, and one submission per frame.
// A paused picture is drawn once and kept; on a software device that last one has full quality.
#pragma once

#include "app/step_parts.hpp"
#include "viewer/player/capture.hpp"
#include "viewer/player/succession.hpp"
#include "viewer/render/picture_budget.hpp"
#include "viewer/ui/status_line.hpp"

namespace sinew::viewer {

/// Main thread only. Session, scene loader, devices and the device that `opening` was prepared on must
/// outlive it; the screen must use that device's place before run().
class ScenePlayer {
public:
    /// Throws vk::Error.
    ScenePlayer(Session& session, SceneLoader& sceneLoader, const Devices& devices, const vk::Device& device,
                std::unique_ptr<OpenedScene> opening);
    ~ScenePlayer(); ///< waits for the screen's queue
    ScenePlayer(const ScenePlayer&) = delete;
    ScenePlayer& operator=(const ScenePlayer&) = delete;

    /// Continues from `before`, which shows the same scene and does not run, with its tools and log. Instead
    /// of the reset of a new player. Throws vk::Error; `before` is then unchanged.
    void takeOver(const ScenePlayer& before);

    /// Runs until the window is closed or the program is interrupted, or until another scene is loaded, which
    /// it returns; it may then be called again. Throws vk::Error.
    std::unique_ptr<OpenedScene> run();

    const Document& document() const { return document_; }
    /// The view of the scene.
    const Camera& camera() const { return controller_.camera; }

    /// Saves the input when the program or a scene ends unexpectedly: writes the log since the reset, if no
    /// file has it, to the current folder or else to `otherwise`. Returns the end of a line that says how to
    /// replay it, or an empty text if there is nothing to save. Uses neither device nor window.
    std::string keepInput(const std::filesystem::path& otherwise) const {
        return journal_.keepInput(otherwise);
    }
    /// Ends a film that is being made with the pictures that it has. Asks nothing of device and window.
    void finishFilm() { capture_.endFilm(); }

private:
    using Clock = std::chrono::steady_clock;

    // Steps that were recorded into a frame in flight; their results come when it has finished.
    struct InFlight {
        std::uint64_t firstStep = 0;
        std::uint32_t steps = 0;
        std::vector<Sweep> sweeps; // of its first steps
    };
    enum class Shown { nothing, moving, still };

    void turn();
    void grant(const Wishes& wishes, Input& input);
    void handle(Input& input);
    void act(Action action);
    void play();
    Plan plan(double elapsed);
    bool prepareSwapchain();
    void draw(Plan plan, View& view);
    void recordReset(VkCommandBuffer commands);
    bool recordHistory(VkCommandBuffer commands);
    void recordSteps(Presenter::Frame& frame, Plan& plan);
    void drawPicture(const Presenter::Frame& frame, const Overlay& overlay, View& view);
    Facts facts(std::optional<float> reduced) const;
    void settle(std::uint32_t slot);
    bool settleSteps(const InFlight& flight);
    void settleNext(const Plan& plan);
    void settleAll();
    void makeRoom(std::uint64_t step, const InFlight& undone);
    void repeatFrom(std::uint64_t step, const InFlight& undone);
    std::vector<Sweep> forgetUndone(const InFlight& undone);
    void forgetFlights();
    void stop(const std::string& why);
    void endFilm();
    bool isAwaited() const;
    void sayWhatIsMade();

    Session& session_;
    SceneLoader& sceneLoader_;
    const Devices& devices_;
    const std::unique_ptr<const OpenedScene> ownOpening_;
    const OpenedScene& opening_;
    PreparedPlayer& prepared_;
    Controller controller_;
    Document& document_;
    app::StepParts parts_; // of the steps of its simulation
    Tools tools_;
    const PlayerContext context_;
    Comparison comparison_; // outlives its rehearsals in layerLoader_
    LayerLoader layerLoader_;
    Gauges gauges_;
    LayerView layers_;
    Capture capture_;
    Observer observer_;
    Adjustments adjustments_;
    Journal journal_;
    PictureTimes times_;
    Succession succession_;
    PictureBudget budget_;
    StatusLine status_;
    Wishes wishes_; // of the newest picture
    std::array<InFlight, Presenter::framesInFlight> inFlight_;
    Clock::time_point lastTurn_ = Clock::now(), lastChange_ = lastTurn_;
    Shown shown_ = Shown::nothing;
    std::uint32_t panelsDue_ = 0; // pictures until the panels look as they should
    bool arePanelsDue_ = true;    // in the picture that is recorded
    std::optional<Clock::time_point> makingSince_;
    bool isMakingSaid_ = false, isHidden_ = false, isDiverged_ = false, isInputDue_ = false;
};

} // namespace sinew::viewer
