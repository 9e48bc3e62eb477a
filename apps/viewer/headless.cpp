// The loop of a headless run. Submits steps ahead and waits only for pictures and for the status of steps
// that are about to be overwritten.
#include "viewer/headless.hpp"

#include "app/drawn.hpp"
#include "app/guard.hpp"
#include "app/kept_pipelines.hpp"
#include "app/progress.hpp"
#include "app/step_parts.hpp"
#include "scenes/recovery.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/capture/picture_writer.hpp"
#include "viewer/capture/video.hpp"
#include "viewer/document/document.hpp"
#include "viewer/headless_times.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/jobs/replay.hpp"
#include "viewer/jobs/second_simulation.hpp"
#include "viewer/layers/inspection.hpp"
#include "viewer/render/legend.hpp"
#include "viewer/render/length_text.hpp"
#include "viewer/render/offscreen.hpp"
#include "viewer/tools/tools.hpp"

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <deque>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::size_t filesAtOnce = 2;

std::filesystem::path pictureFile(const std::filesystem::path& folder, std::uint64_t frame) {
    char name[40];
    std::snprintf(name, sizeof name, "frame_%04" PRIu64 ".png", frame);
    return folder / name;
}

void print(const char* before, const std::vector<std::string>& warnings,
           const std::vector<std::string>& notes) {
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "warning: %s%s\n", before, warning.c_str());
    for (const std::string& note : notes) std::fprintf(stderr, "note: %s%s\n", before, note.c_str());
}

void makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && !std::filesystem::is_directory(folder))
        error = std::make_error_code(std::errc::not_a_directory);
    if (error)
        throw app::Failure(app::outputFailed, "cannot write pictures: " + folder.string() + ": " +
                                                  error.message() + ": choose another folder");
}

void checkSize(const vk::Device& device, VkExtent2D size) {
    VkPhysicalDeviceProperties properties;
    device.instanceFunctions().vkGetPhysicalDeviceProperties(device.physical(), &properties);
    const std::uint32_t most = properties.limits.maxImageDimension2D;
    if (size.width > most || size.height > most)
        throw app::Failure(app::wrongUsage, "wrong usage: --size: the device draws at most " +
                                                std::to_string(most) + " pixels a side: choose less");
}

// Writers of the frames: PNG files, a video, or both.
class Outputs {
public:
    Outputs(const Options& options, float dt) : options_(options), writer_(filesAtOnce) {
        if (!options.folder.empty()) makeFolder(options.folder);
        if (!options.video.empty())
            video_.emplace(options.video, options.size.width, options.size.height,
                           1.0 / (double{dt} * static_cast<double>(options.every)));
    }

    void add(std::uint64_t frame, Picture picture, PictureText text) {
        ++count_;
        if (video_) video_->add(picture);
        if (!options_.folder.empty())
            writer_.add(pictureFile(options_.folder, frame), std::move(picture), std::move(text));
    }

    /// False for a replay without files.
    bool isAny() const { return video_ || !options_.folder.empty(); }

    void finish() {
        while (writer_.take(PictureWriter::Wait::yes)) {
        }
        if (video_) video_->finish();
        if (!options_.folder.empty()) printCount(options_.folder);
        if (video_) printCount(options_.video);
    }

private:
    void printCount(const std::string& where) const {
        std::printf("%s in %s\n", countText(count_, "picture").c_str(), where.c_str());
    }

    const Options& options_;
    PictureWriter writer_;
    std::optional<Video> video_;
    std::size_t count_ = 0;
};

// Steps and draws; a frame is a step of the simulation, frame 0 the state before the first.
class Recorder {
public:
    Recorder(const Options& options, const OpenedScene& opening, const vk::Device& device,
             std::optional<InputFile> input)
        : opening_(opening), device_(device), camera_(opening.camera),
          document_(device, opening.loaded.scene, opening.loaded.settings, firstMaterial(opening)),
          offscreen_(device, options.size, opening.light), layers_(options.layers),
          parts_(isSoftware(device)), queue_(device) {
        document_.setDefaults(opening.loaded.defaults);
        document_.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
        document_.setRepeats(!input);
        if (options.isTimed) times_.emplace(device, document_);
        if (input) {
            replay_.emplace(std::move(*input));
            tools_.emplace(device, toolContext(opening));
        }
        if (opening.run) load();
        besideShape_ = parseBeside(options.beside);
        if (!besideShape_) return;
        beside_ = makeBeside(document_.settings());
        print("beside: ", beside_->warnings(), beside_->notes());
    }

    /// Submits a frame; if `isPictured`, waits for its picture.
    std::optional<Picture> advance(std::uint64_t frame, bool isPictured) {
        while (submissions_.size() >= sim::Simulation::framesInFlight) settleOldest();
        if (beside_ && beside_->document().material() != document_.material()) { // changed by the replay
            settle();
            goOnBeside();
        }
        if (frame > 0 && replay_ && playHistory() == Replay::Due::nothing) compareReplay();
        submit(frame);
        if (!isPictured) return std::nullopt;
        settle(); // first: a repeated step would be in no picture
        VkCommandBuffer commands = queue_.begin();
        document_.recordSkin(commands);
        const Overlay overlay = recordLayers(commands);
        if (times_) times_->beginDrawing(commands);
        if (beside_)
            recordHalves(commands, overlay);
        else
            offscreen_.record(commands, camera_, document_.simulation(), overlay);
        if (times_) times_->endDrawing(commands);
        queue_.wait(queue_.submit(commands));
        if (times_) times_->pictureFinished();
        return offscreen_.read();
    }

    /// Waits for every frame and checks it. Throws app::Failure (diverged).
    void settle() {
        while (!submissions_.empty()) settleOldest();
        if (!document_.makeSurfaceRoom(std::exchange(surfaceMissing_, 0), queue_, bring())) return;
        inspection_.reset();
        if (tools_) tools_->moveOn();
    }

    /// Prints complaints of the simulation on stderr. Requires that all steps have finished.
    void printComplaints() {
        for (const std::string& complaint : document_.complaints())
            std::fprintf(stderr, "warning: %s\n", complaint.c_str());
    }

    /// After a replay, or a run from a saved state: plays the rest of the log and prints the hash of the last
    /// state.
    void finishReplay() {
        if (!replay_ && !opening_.run) return;
        const bool isWhole = playHistory() == Replay::Due::nothing;
        if (replay_ && isWhole && !isCompared_) return compareReplay();
        settle();
        std::printf("%s\n", hashText(stateHash(device_, document_, queue_), document_.steps()).c_str());
    }

    /// Prints the errors of the two solvers of a comparison, and their distance.
    void printBeside() {
        if (!beside_) return;
        StateProbe probe(device_, document_.scene(), document_.settings(), document_.simulation());
        const VkCommandBuffer commands = queue_.begin();
        document_.recordSkin(commands);
        probe.record(commands);
        beside_->recordPicture(commands, 0, true);
        queue_.wait(queue_.submit(commands));
        checkBeside(0, &probe);
        const Strain strain = measureStrain(document_.scene(), probe);
        const Facts other = beside_->facts();
        const sim::Settings& settings = document_.settings();
        std::printf("%s: strain of links rms %.3f %%, largest %.2f %%\n",
                    toText(BesideShape{settings.solver, settings.substeps}).c_str(), 100 * strain.rms,
                    100 * strain.largest);
        std::printf("%s: strain of links rms %.3f %%, largest %.2f %%\n", toText(beside_->shape()).c_str(),
                    100 * double{other.strainRms.newest()}, 100 * double{other.strainMax.newest()});
        if (const std::optional<Distance>& apart = beside_->apart())
            std::printf("distance of particles rms %s, largest %s\n", lengthText(apart->rms).c_str(),
                        lengthText(apart->largest).c_str());
    }

    /// After a cut, prints the number of cut links and of pieces.
    void printCuts() {
        if (document_.steps() == 0) return;
        const sim::Status status = document_.simulation().status(document_.steps());
        if (status.linksCutInAll == 0) return;
        const VkCommandBuffer commands = queue_.begin();
        document_.recordSkin(commands);
        queue_.wait(queue_.submit(commands));
        const sim::Scene& scene = document_.scene();
        const app::Drawn drawn =
            app::downloadDrawn(queue_, document_.simulation(), scene, document_.settings());
        std::printf("cut: %u links, %s\n", status.linksCutInAll,
                    app::toText(app::countPieces(scene, drawn, status.pieces)).c_str());
    }

    /// Prints the times, if requested; does not wait.
    void printTimes() const {
        if (times_) std::fputs(times_->table().c_str(), stdout);
    }

    PictureText text(std::uint64_t frame) const { return pictureText(opening_, device_, frame); }

private:
    // Makes the second simulation with the first one's present settings and capacities of at least `room`.
    std::unique_ptr<SecondSimulation> makeBeside(const sim::Settings& room) const {
        try {
            return std::make_unique<SecondSimulation>(
                device_, opening_.loaded, sim::withRoomsOf(document_.settings(), room), document_.material(),
                *besideShape_, sim::Simulation::framesInFlight);
        } catch (const std::invalid_argument& error) {
            const std::string why = error.what();
            throw app::Failure(app::badInput, "cannot play " + toText(*besideShape_) +
                                                  " beside: " + why.substr(0, why.find('\n')));
        }
    }

    // Moves the second simulation to the present state of the first, with capacity for at least `contactRoom`
    // contacts; all steps of both must have finished.
    void goOnBeside(std::uint32_t contactRoom = 0) {
        if (!beside_) return;
        const Document& now = beside_->document();
        sim::Settings room = now.settings();
        const bool isRoomy = room.contactRoom >= contactRoom && now.hasRoomOf(document_);
        room.contactRoom = std::max(room.contactRoom, contactRoom);
        if (!isRoomy || now.material() != document_.material()) beside_ = makeBeside(room);
        VkCommandBuffer commands = queue_.begin();
        beside_->recordTakeOver(commands, document_);
        queue_.wait(queue_.submit(commands));
    }

    void recordHalves(VkCommandBuffer commands, const Overlay& overlay) {
        beside_->recordPicture(commands, 0, false);
        const Overlay other = overlayBeside(overlay);
        offscreen_.recordHalves(commands, camera_,
                                {{{document_.simulation(), overlay}, {beside_->simulation(), other}}});
    }

    // If contacts need more room, the second simulation is made anew and continues from the first.
    void checkBeside(std::uint32_t slot, const StateProbe* first = nullptr) {
        const auto trouble = beside_->settle(slot, first);
        if (!trouble) return;
        if (trouble->room == 0) throw app::Failure(app::diverged, "beside: " + trouble->why);
        queue_.waitIdle();
        goOnBeside(trouble->room);
        std::fprintf(stderr, "note: beside: %s: it continues from the first solver's state\n",
                     trouble->why.c_str());
    }

    // A map's range is computed for each picture alone, so that it does not depend on which others are drawn.
    Overlay recordLayers(VkCommandBuffer& commands) {
        Overlay overlay = tools_ ? tools_->overlay() : Overlay{};
        overlay.layers = layers_;
        offscreen_.prepare(layers_);
        if (!layers_.needsBuffers()) return overlay;
        if (!inspection_) inspection_.emplace(device_, document_, 1);
        inspection_->prepare(layers_);
        inspection_->record(commands, layers_, 0);
        LayerRanges ranges{};
        const auto hasRange = [&](const Layer* layer) { return layer->hasRange && layers_.has(*layer); };
        if (std::ranges::any_of(layerTable(), hasRange)) {
            queue_.wait(queue_.submit(commands));
            for (std::size_t i = 0; i < layerTable().size(); ++i)
                if (hasRange(layerTable()[i])) ranges[i] = rangeOf(i);
            commands = queue_.begin();
        }
        overlay.buffers = inspection_->buffers(layers_, ranges);
        return overlay;
    }

    // Reads the range of a layer; notes once why nothing is drawn.
    float rangeOf(std::size_t layer) {
        const LayerReading reading = inspection_->reading(layer, 0);
        if (!reading.note.empty() && !std::exchange(isNoted_[layer], true))
            std::fprintf(stderr, "note: %s\n", reading.note.c_str());
        return reading.values.range;
    }

    struct Submission {
        std::uint64_t frame, value;
        StepHands hands;
        sim::Vec3 gravity;
    };

    // Compares the state at the end of the log, even if more steps follow.
    void compareReplay() {
        if (std::exchange(isCompared_, true)) return;
        settle();
        std::printf(
            "%s\n",
            hashText(stateHash(device_, document_, queue_), document_.steps(), replay_->file()).c_str());
    }

    // Plays the log up to the next step or the end. Finishes all steps before an earlier state is restored.
    Replay::Due playHistory() {
        if (!replay_) return Replay::Due::nothing;
        for (;;) {
            const Replay::Due due = replay_->next(*tools_, camera_, document_);
            if (due == Replay::Due::step || due == Replay::Due::nothing) return due;
            settle();
            if (due == Replay::Due::shape)
                reshape();
            else
                goBack();
        }
    }

    void goBack() {
        VkCommandBuffer commands = queue_.begin();
        tools_->recordHistory(commands, document_);
        queue_.wait(queue_.submit(commands));
        goOnBeside();
    }

    // Continues in another simulation.
    void reshape() {
        try {
            document_.reshape(queue_, bring());
        } catch (const std::invalid_argument& error) {
            throw app::Failure(app::badInput, std::string("cannot play input: ") + error.what());
        }
        print("", scenes::newWarnings(opening_.loaded, document_.settings()),
              scenes::recoveryLeftOut(opening_.loaded, document_.settings()));
        tools_->reshaped();
        inspection_.reset();
        if (times_) times_->restart(document_);
    }

    void submit(std::uint64_t frame) {
        const VkCommandBuffer commands = queue_.begin();
        Submission next{.frame = frame, .value = 0, .hands = {}, .gravity = document_.gravity()};
        if (tools_ && frame > 0) next.hands = tools_->takeStep(commands, document_);
        if (frame == 0 && beside_) {
            if (opening_.run)
                beside_->recordTakeOver(commands, document_);
            else
                beside_->recordReset(commands);
        }
        if (frame == 0 && !opening_.run) document_.recordReset(commands);
        next.value = frame > 0 ? submitStep(commands, next) : queue_.submit(commands);
        if (times_ && frame > 0) times_->submitted();
        submissions_.push_back(next);
    }

    void load() {
        document_.load(device_, *opening_.run, queue_);
        if (!replay_) return;
        document_.widen(roomOf(replay_->file()), queue_);
        tools_->begin(document_);
    }

    // Records a step behind what `first` has, and submits both; returns the timeline value.
    std::uint64_t submitStep(VkCommandBuffer first, const Submission& next) {
        std::vector<VkCommandBuffer> parts{first};
        while (parts.size() < parts_.count()) parts.push_back(queue_.begin());
        record(parts, next);
        std::uint64_t value = 0;
        for (const VkCommandBuffer part : parts) value = queue_.submit(part);
        return value;
    }

    void record(std::span<const VkCommandBuffer> parts, const Submission& next) {
        vk::Timestamps* timestamps = times_ ? times_->ofStep(next.frame) : nullptr;
        if (tools_)
            recordStep(parts, document_, next.hands, timestamps);
        else
            document_.recordStep(parts, timestamps);
        if (beside_) beside_->recordStep(parts.back(), document_, next.hands, slotOf(next.frame), false);
    }

    static std::uint32_t slotOf(std::uint64_t frame) {
        return static_cast<std::uint32_t>(frame % sim::Simulation::framesInFlight);
    }

    app::Bring bring() { return tools_ ? tools_->bring() : app::Bring(); }

    void forgetUndone(const std::deque<Submission>& undone) {
        std::vector<Sweep> sweeps;
        for (const Submission& one : undone)
            if (one.hands.sweep) sweeps.push_back(*one.hands.sweep);
        tools_->moveOn();
        tools_->forgetUndone(document_, sweeps);
    }

    // Repeats all steps from `first` on, which were undone, with the same input.
    void redoFrom(const Submission& first) {
        std::deque<Submission> undone = std::exchange(submissions_, {});
        undone.push_front(first);
        if (document_.lacksLists(first.frame)) { // then there are no tools
            queue_.waitIdle();
            document_.goBackBefore(first.frame);
        } else {
            if (!document_.makeRoom(first.frame, queue_, bring()))
                throw app::Failure(app::diverged, app::tooCrowded(first.frame));
            inspection_.reset(); // made for the old simulation
            if (tools_) forgetUndone(undone);
        }
        goOnBeside(); // it has taken those steps
        for (Submission& again : undone) {
            VkCommandBuffer commands = queue_.begin();
            if (again.hands.sweep && !again.hands.sweep->isCarried) tools_->remember(commands, document_);
            document_.setGravity(again.gravity);
            again.value = submitStep(commands, again);
            submissions_.push_back(again);
        }
    }

    // Waits for a submission; a step may take a software device minutes. Throws app::Failure (interrupted).
    void waitFor(std::uint64_t value) {
        const VkSemaphore timeline = queue_.timeline();
        const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                       .semaphoreCount = 1,
                                       .pSemaphores = &timeline,
                                       .pValues = &value};
        app::waitUntil([&](std::chrono::nanoseconds most) {
            const VkResult result = device_.functions().vkWaitSemaphores(
                device_.handle(), &info, static_cast<std::uint64_t>(most.count()));
            vk::check(result, "vkWaitSemaphores", "a step");
            return result != VK_TIMEOUT;
        });
    }

    void settleOldest() {
        const Submission oldest = submissions_.front();
        submissions_.pop_front();
        waitFor(oldest.value);
        if (oldest.frame == 0) return;
        if (document_.neededRoom(oldest.frame) > 0 || document_.lacksLists(oldest.frame))
            return redoFrom(oldest);
        if (times_) times_->stepFinished(oldest.frame);
        if (const std::optional<Divergence> divergence = document_.check(oldest.frame))
            throw app::Failure(app::diverged, divergence->report());
        if (beside_) checkBeside(slotOf(oldest.frame));
        surfaceMissing_ = document_.simulation().status(oldest.frame).cutSurfaceMissing;
    }

    const OpenedScene& opening_;
    const vk::Device& device_;
    Camera camera_;
    Document document_;
    Offscreen offscreen_;
    Layers layers_;
    std::optional<Inspection> inspection_;
    std::optional<Replay> replay_;
    bool isCompared_ = false;                // with the recorded hash
    std::array<bool, mostLayers> isNoted_{}; // by layer
    std::optional<Tools> tools_;             // of the replay
    std::optional<BesideShape> besideShape_;
    std::unique_ptr<SecondSimulation> beside_;
    std::optional<HeadlessTimes> times_;
    app::StepParts parts_;
    vk::Queue queue_; // last: its destructor waits for work that uses the members above
    std::deque<Submission> submissions_;
    std::uint32_t surfaceMissing_ = 0; // Status::cutSurfaceMissing of the newest settled step
};

} // namespace

int runHeadless(const Options& asked, std::atomic<std::size_t>& messages) {
    std::optional<InputFile> input;
    if (!asked.replay.empty()) input = loadInput(asked.replay);
    const Options options = input ? withReplay(asked, *input) : asked;
    const float halves = options.beside.empty() ? 1 : 0.5f;
    const float aspect =
        halves * static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
    OpenedScene opening = open(options, aspect);
    if (input) prepareForReplay(opening, *input);
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    const vk::Loader loader;
    const vk::Device device =
        app::createDevice(loader.getInstanceProcAddr(), deviceRequest(options, messages));
    checkSize(device, options.size);
    std::printf("%s\n", headline(opening, device).c_str());
    std::fflush(stdout);

    Outputs outputs(options, opening.loaded.scene.dt);
    Recorder recorder(options, opening, device, std::move(input));
    app::keepPipelines(device);
    try {
        app::Progress progress(options.frames, stderr);
        for (std::uint64_t frame = 0; frame <= options.frames && !app::isInterrupted(); ++frame) {
            const bool isPictured = outputs.isAny() && options.wantsPicture(frame);
            if (std::optional<Picture> picture = recorder.advance(frame, isPictured))
                outputs.add(frame, std::move(*picture), recorder.text(frame));
            progress.update(frame);
        }
        recorder.settle();
        progress.finish();
        recorder.printComplaints();
        recorder.finishReplay();
        recorder.printCuts();
        recorder.printTimes();
        recorder.printBeside();
    } catch (const app::Failure& failure) {
        const app::Writing writing;
        const bool isInterrupted = failure.code() == app::interrupted;
        if (failure.code() == app::diverged || isInterrupted) // earlier pictures are complete and stay
            outputs.finish();
        if (isInterrupted) app::leaveInterrupted(failure.what());
        throw;
    } catch (const vk::Error&) { // encoders and files need no device
        const app::Writing writing;
        outputs.finish();
        throw;
    }
    const app::Writing writing;
    outputs.finish();
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace sinew::viewer
