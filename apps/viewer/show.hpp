// Scene player: a scene that plays in a window, with input, steps in real time, and one submission per frame.
// A paused picture is drawn once and kept; on a software device that last one has full quality. The loop is
// in show.cpp, the rest in show_input, show_flights, show_pictures, show_replay, show_shape, show_beside.
#pragma once

#include "viewer/backstage.hpp"
#include "viewer/devices.hpp"
#include "viewer/draw/shot.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/gauges.hpp"
#include "viewer/hands/controller.hpp"
#include "viewer/hands/inspector.hpp"
#include "viewer/hands/picture_budget.hpp"
#include "viewer/hands/piece_probe.hpp"
#include "viewer/hands/state_probe.hpp"
#include "viewer/library.hpp"
#include "viewer/opening.hpp"
#include "viewer/pictures/picture_writer.hpp"
#include "viewer/pictures/recording.hpp"
#include "viewer/prepared_show.hpp"
#include "viewer/replay.hpp"
#include "viewer/screen.hpp"
#include "viewer/tools.hpp"
#include "viewer/window/status_line.hpp"
#include "vk/timestamps.hpp"

#include <chrono>
#include <memory>

namespace sinew::viewer {

/// Main thread only. Screen, library, devices and the device that `opening` was prepared on must outlive it;
/// the screen must use that device's place before run().
class Show {
public:
    /// Throws vk::Error.
    Show(Screen& screen, Library& library, const Devices& devices, const vk::Device& device,
         std::unique_ptr<Opening> opening);
    ~Show(); ///< waits for the screen's queue
    Show(const Show&) = delete;
    Show& operator=(const Show&) = delete;

    /// Continues from `before`, which shows the same scene and does not run, with its tools and log. Instead
    /// of the reset of a new player. Throws vk::Error; `before` is then unchanged.
    void takeOver(const Show& before);

    /// Runs until the window is closed or the program is interrupted, or until another scene is loaded, which
    /// it returns; it may then be called again. Throws vk::Error.
    std::unique_ptr<Opening> run();

    /// The present view.
    const Camera& camera() const { return controller_.camera; }

    /// Saves the input when the program or a scene ends unexpectedly: writes the log since the reset, if no
    /// file has it, to the current folder or else to `otherwise`. Returns the end of a line that says how to
    /// replay it, or an empty text if there is nothing to save. Uses neither device nor window.
    std::string keepInput(const std::filesystem::path& otherwise) const;
    /// Ends a film in progress with the pictures that it has. Uses neither device nor window.
    void finishFilm();

private:
    using Clock = std::chrono::steady_clock;

    // A pending camera move: the target depends on a pick.
    struct Look {
        enum class At { body, point } at;
        Ray ray;
    };

    // Work of a frame in flight, handled when it has finished.
    struct InFlight {
        std::uint64_t firstStep = 0;
        std::uint32_t steps = 0;
        std::vector<Sweep> sweeps; // of its first steps
        bool isTimed = false;      // drawingTimes_ times it
        bool isProbed = false;     // copies positions for the bounds
        std::optional<Look> look;
        bool isMeasured = false;          // copies positions for the strain
        bool isCounted = false;           // pieceProbe_ copies it
        bool isRecorded = false;          // cameras_ copies it
        ColorMap map = ColorMap::none;    // its distribution is read
        bool hasContacts = false;         // contacts are counted
        bool hasCells = false;            // cells are counted
        bool isInspected = false;         // copies the state for the inspector
        std::optional<Question> question; // asked by the tools
        std::unique_ptr<Shot> screenshot;
        std::uint64_t screenshotStep = 0;
        /// Whether it copies the state.
        bool isAsked() const {
            return isProbed || look || question || isMeasured || isInspected || isCounted;
        }
    };

    enum class Shown { nothing, moving, still };

    void turn();
    Plan plan(double elapsed);
    void handle(const Input& input);
    void grant(const Wishes& wishes, Input& input);
    void turnKnobs(const Knobs& knobs);
    Knobs shownKnobs() const;
    void turnMaterial(const Knobs& knobs);
    void takeTurn();
    void takeGrowth();
    void endGrowth();
    void play();
    void changeDevice(std::size_t index);
    Knobs madeKnobs() const;
    Again again() const;
    void reopenWhereTurned();
    void keepAsItWas();
    void reshape();
    void restartViews();
    void goOn(const app::SavedRun& run);
    float pictureAspect() const;
    std::unique_ptr<Opening> takeOpened();
    bool mayOpen();
    std::string nameAt(std::uint64_t step) const;
    void saveInput();
    InputFile inputFile() const;
    void saveState();
    std::string sceneName() const;
    bool playInput(const Presenter::Frame& frame);
    void endReplay();
    void dropReplay();
    void compareReplay();
    bool isOfReplay(Action action);
    void toggleRecording();
    void stopRecording();
    void recordCamera(const Presenter::Frame& frame, const Overlay& overlay);
    void settleCamera(std::uint32_t slot, const InFlight& flight);
    void handle(Action action);
    void switchLayer(Action action);
    void lookAt(Look::At at);
    void settleLook(const Look& look);
    void changeSection(Action action);
    std::optional<Opened> opened() const;
    bool prepareSwapchain();
    void draw(Plan plan, View& view);
    void drawPicture(const Presenter::Frame& frame, const Overlay& overlay, View& view);
    /// `reduced`: see Facts::reduced.
    void drawPanels(const Presenter::Frame& frame, std::optional<float> reduced);
    bool isOfCut(bool isCutting);
    std::size_t picturesOnTheirWay();
    void settleTimes(std::uint32_t slot, const InFlight& flight);
    Facts facts(std::optional<float> reduced) const;
    void recordSteps(const Presenter::Frame& frame, Plan& plan);
    void forgetFlights();
    void makeSurfaceRoom();
    void warnOfSurface();
    bool isStrainDue(std::uint32_t steps);
    bool isCountDue();
    void settleCount();
    void showCounts(const sim::Status& status);
    bool askProbe(InFlight& flight);
    void recordProbe(const Presenter::Frame& frame);
    void inspect(const Presenter::Frame& frame, const Ray& ray);
    Overlay recordLayers(const Presenter::Frame& frame);
    void goOn();
    void countPipelines();
    Renderer& wholeQuality();
    void recordScreenshot(const Presenter::Frame& frame, const Overlay& overlay);
    void settleScreenshot(const InFlight& flight);
    void settle(std::uint32_t slot);
    void settleProbe(InFlight& flight);
    void settleMap(std::uint32_t slot, const InFlight& flight);
    void settleCells(std::uint32_t slot);
    void toggleWires();
    void toggleBeside();
    void tendBeside();
    bool isBesideFit() const;
    void makeBeside(const BesideShape& shape, const sim::Settings& room);
    void takeBeside();
    void dropBeside();
    void settleBeside(std::uint32_t slot);
    void foldPointer(Input& input);
    void drawHalves(const Presenter::Frame& frame, const Overlay& overlay, View& view);
    void recordShot(Shot& shot, VkCommandBuffer commands, std::uint32_t slot, const Overlay& overlay);
    BesideFacts besideFacts() const;
    float wholeAspect() const;
    std::uint32_t halvesWidth() const;
    void stop(const std::string& why);
    void makeRoom(std::uint64_t step, const InFlight& undone);
    void repeatFrom(std::uint64_t step, const InFlight& undone);
    std::vector<Sweep> forgetUndone(const InFlight& undone);
    void settleAll();
    void settleNext(const Plan& plan);
    void warnOfMistakes();
    void reportFiles(PictureWriter::Wait wait);

    Screen& screen_;
    Library& library_;
    const Devices& devices_;
    const vk::Device& device_;
    std::unique_ptr<const Opening> ownOpening_;
    const Opening& opening_;
    PreparedShow& prepared_;
    Controller controller_;
    Stage& stage_;
    std::optional<StateProbe> probe_; // for the stage's simulation
    PieceProbe pieceProbe_;
    Backstage backstage_;
    Watched drawn_; // layers of the newest picture
    Inspector inspector_;
    std::unique_ptr<Beside> beside_;
    std::optional<BesideShape> besideAsked_; // settings of the comparison, made or in the making
    std::future<std::unique_ptr<Beside>> besideMaking_;
    Vector2 pointer_ = Vector2::Zero(); // see Input::pointer
    float fold_ = 0;                    // middle of the pointer's half, from the window's, in its heights
    std::optional<Look> wantsLook_;
    std::optional<Look::At> armed_; // set by a button: the next press points there
    MapRange mapRange_;
    std::uint32_t contactsFound_ = 0;
    std::vector<GridFacts> grids_; // of the newest picture with cells
    Tools tools_;
    std::optional<Replay> replay_;
    std::optional<InputFile> replayed_;        // has just ended
    std::vector<vk::Timestamps> times_;        // of a step, one per slot
    std::vector<vk::Timestamps> drawingTimes_; // of picture and panels, one per slot
    SceneFacts& sceneFacts_;
    Gauges gauges_;
    PictureBudget budget_;
    Wishes wishes_;              // of the newest picture
    Knobs knobs_;                // values requested, including those still in preparation
    std::optional<Knobs> asked_; // requested from the library
    Shaped begun_;               // the stage's settings at the reset
    std::optional<Recording> recording_;
    std::array<std::unique_ptr<Shot>, Presenter::framesInFlight> cameras_; // for the recording
    std::array<InFlight, Presenter::framesInFlight> inFlight_;
    PictureWriter writer_{1};
    StatusLine status_;
    Clock::time_point lastTurn_ = Clock::now(), lastChange_ = lastTurn_, lastStrain_ = lastTurn_,
                      lastCount_ = lastTurn_;
    Shown shown_ = Shown::nothing;
    std::size_t inputSaved_ = 0;                   // events of the log that are in a file, or made by a reset
    std::uint32_t linksCut_ = 0;                   // Status::linksCutInAll of the newest settled step
    std::uint32_t allPieces_ = 0;                  // Status::pieces of the newest settled step
    std::uint32_t surfaceMissing_ = 0;             // Status::cutSurfaceMissing of the newest settled step
    std::uint32_t panelsDue_ = 0;                  // pictures until panels must be drawn anew
    bool arePanelsDue_ = true;                     // for the picture being recorded
    std::uint32_t cutFrames_ = 0;                  // pictures that may still wait for a cut
    std::optional<Clock::time_point> makingSince_; // start of the present wait for layers
    std::size_t pipelines_ = 0;                    // pipelines of the device that were counted
    std::optional<SavedOrigin> from_;              // until the reset
    bool isDropped_ = false;                       // the replay was ended by the user
    bool isBroken_ = false;                        // has diverged or failed: no longer repeatable
    bool isHidden_ = false, isDiverged_ = false, isSurfaceMissing_ = false, wantsCount_ = false,
         isRefused_ = false, wantsScreenshot_ = false, wantsProbe_ = false, isInputDue_ = false,
         isMakingSaid_ = false, isBesideOut_ = false, isButtonDown_ = false;
};

} // namespace sinew::viewer
