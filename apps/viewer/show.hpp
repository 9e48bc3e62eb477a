// A scene playing in a window: input, steps in real time, one submission a frame. A paused picture is drawn
// once and then left alone; on a software device that last one has full quality. The loop stands in show.cpp,
// the rest beside it: show_input, show_flights, show_pictures, show_replay, show_shape, show_beside.
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
/// the screen must be in that device's place before run().
class Show {
public:
    /// Throws vk::Error.
    Show(Screen& screen, Library& library, const Devices& devices, const vk::Device& device,
         std::unique_ptr<Opening> opening);
    ~Show(); ///< waits for the screen's queue
    Show(const Show&) = delete;
    Show& operator=(const Show&) = delete;

    /// Goes on where `before` stands, which shows the same scene and does not play: with all that hands do
    /// there. Instead of the reset that a new show begins with. Throws vk::Error; `before` is then as it was.
    void takeOver(const Show& before);

    /// Plays until the window is closed or the program is interrupted, or until another scene is there, which
    /// it returns; it may then be called again. Throws vk::Error.
    std::unique_ptr<Opening> run();

    /// Where it is looked at from.
    const Camera& camera() const { return controller_.camera; }

    /// For when the program, or what hands did, ends before its user wants it to: writes what hands did since
    /// the reset, as far as no file has it, to the current folder or else to `otherwise`, and says how to
    /// have it again, for the end of a line. Empty where there is nothing to keep. Asks nothing of device and
    /// window.
    std::string keepInput(const std::filesystem::path& otherwise) const;
    /// Likewise: a film that is being made ends with the pictures that it has.
    void finishFilm();

private:
    using Clock = std::chrono::steady_clock;

    // Where the camera is to look, once it is known what lies there.
    struct Look {
        enum class At { body, point } at;
        Ray ray;
    };

    // What was recorded into a frame in flight and is looked at when it has finished.
    struct InFlight {
        std::uint64_t firstStep = 0;
        std::uint32_t steps = 0;
        std::vector<Sweep> sweeps; // of its first steps
        bool isTimed = false;      // by drawingTimes_
        bool isProbed = false;     // for the bounds
        std::optional<Look> look;
        bool isMeasured = false;          // for the strain
        bool isCounted = false;           // by pieceProbe_
        bool isRecorded = false;          // by cameras_
        ColorMap map = ColorMap::none;    // of what is inspected
        bool hasContacts = false;         // likewise
        bool hasCells = false;            // likewise
        bool isInspected = false;         // for the inspector
        std::optional<Question> question; // of the tools
        std::unique_ptr<Shot> screenshot;
        std::uint64_t screenshotStep = 0;
        /// Whether it brings a copy of the state.
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
    /// `reduced` as Facts::reduced.
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
    std::optional<StateProbe> probe_; // of the stage's simulation
    PieceProbe pieceProbe_;
    Backstage backstage_;
    Watched drawn_; // of what is wanted, what the newest picture has
    Inspector inspector_;
    std::unique_ptr<Beside> beside_;
    std::optional<BesideShape> besideAsked_; // that it is, or is being made as
    std::future<std::unique_ptr<Beside>> besideMaking_;
    Vector2 pointer_ = Vector2::Zero(); // as Input::pointer
    float fold_ = 0;                    // from its middle to that of the half that it is in, likewise
    std::optional<Look> wantsLook_;
    std::optional<Look::At> armed_; // by a button: the next press says where
    MapRange mapRange_;
    std::uint32_t contactsFound_ = 0;
    std::vector<GridFacts> grids_; // of the newest picture with cells
    Tools tools_;
    std::optional<Replay> replay_;
    std::optional<InputFile> replayed_;        // that has just come to its end
    std::vector<vk::Timestamps> times_;        // of a step, one a slot
    std::vector<vk::Timestamps> drawingTimes_; // of picture and panels, likewise
    SceneFacts& sceneFacts_;
    Gauges gauges_;
    PictureBudget budget_;
    Wishes wishes_;              // of the newest picture
    Knobs knobs_;                // as they were turned, also where that is still being worked out
    std::optional<Knobs> asked_; // of the library
    Shaped begun_;               // as the stage was at the reset
    std::optional<Recording> recording_;
    std::array<std::unique_ptr<Shot>, Presenter::framesInFlight> cameras_; // of the recording
    std::array<InFlight, Presenter::framesInFlight> inFlight_;
    PictureWriter writer_{1};
    StatusLine status_;
    Clock::time_point lastTurn_ = Clock::now(), lastChange_ = lastTurn_, lastStrain_ = lastTurn_,
                      lastCount_ = lastTurn_;
    Shown shown_ = Shown::nothing;
    std::size_t inputSaved_ = 0;       // events of the log that some file has, or a reset has made
    std::uint32_t linksCut_ = 0;       // Status::linksCutInAll, likewise
    std::uint32_t allPieces_ = 0;      // Status::pieces, likewise
    std::uint32_t surfaceMissing_ = 0; // Status::cutSurfaceMissing of the newest settled step
    std::uint32_t panelsDue_ = 0;      // pictures until the panels look as they should
    bool arePanelsDue_ = true;         // in the picture that is recorded
    std::uint32_t cutFrames_ = 0;      // pictures that may still wait for a cut
    std::optional<Clock::time_point> makingSince_; // nobody has been told
    std::size_t pipelines_ = 0;                    // of this thread, that were counted
    std::optional<SavedOrigin> from_;              // until the reset
    bool isDropped_ = false;                       // the replay, by hand
    bool isBroken_ = false;                        // has diverged, likewise
    bool isHidden_ = false, isDiverged_ = false, isSurfaceMissing_ = false, wantsCount_ = false,
         isRefused_ = false, wantsScreenshot_ = false, wantsProbe_ = false, isInputDue_ = false,
         isMakingSaid_ = false, isSurfaceGrowing_ = false, isBesideOut_ = false, isButtonDown_ = false;
};

} // namespace sinew::viewer
