// Files are named after scene and step.
#include "viewer/journal.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/panels/knob_keys.hpp"
#include "viewer/pictures/recording.hpp"
#include "viewer/window/preferences.hpp"

#include <ostream>
#include <utility>

namespace sinew::viewer {

namespace {

app::SavedView viewOf(const Camera& camera) {
    return {.target = {camera.target.x(), camera.target.y(), camera.target.z()},
            .distance = camera.distance,
            .azimuth = camera.azimuth,
            .elevation = camera.elevation,
            .fieldOfView = camera.fieldOfView};
}

} // namespace

Journal::Journal(const ShowContext& show, const Library& library)
    : show_(show), library_(library), begun_{show.stage.settings().solver, show.stage.settings().substeps} {
    if (show.opening.input) replay_.emplace(*show.opening.input);
}

std::string Journal::stem(std::uint64_t step) const {
    return nameAt(show_.opening.loaded.scene.name, step);
}

void Journal::saveInput() {
    show_.settleAll();
    Screen& screen = show_.screen;
    if (isBroken_) return screen.tell("not saved: the input no longer leads to this state");
    if (from_ && from_->file.empty())
        return screen.tell("not saved: a log cannot hold the path of the loaded state");
    InputFile file = inputFile();
    vk::Queue queue(show_.device);
    file.hash = stateHash(show_.device, show_.stage, queue);
    try {
        const std::filesystem::path name = freeName(stem(show_.stage.steps()), ".input");
        mesh::writeWhole(name, [&](std::ostream& stream) { stream << toText(file); });
        saved_ = file.events.size();
        printLine("input: " + name.string() + ", " + hashText(*file.hash, show_.stage.steps()));
        screen.tell("input: " + name.string() + "; --replay plays it again");
    } catch (const mesh::ExportError& error) {
        screen.warn(error.what());
    }
}

InputFile Journal::inputFile() const {
    return {.scene = sceneName(),
            .from = from_,
            .solver = sim::solverName(begun_.solver),
            .substeps = begun_.substeps,
            .room = show_.stage.contactRoom().room,
            .surface = show_.stage.settings().cutSurfaceRoom,
            .events = show_.tools.log().events()};
}

// Writes no state hash: steps may be in flight.
std::string Journal::keepInput(const std::filesystem::path& otherwise) const {
    if (replay_ || (from_ && from_->file.empty()) || !show_.tools.log().hasDeeds(saved_)) return {};
    const std::string text = toText(inputFile());
    std::string why;
    for (const std::filesystem::path& folder : {std::filesystem::path(), otherwise}) {
        try {
            if (!folder.empty()) std::filesystem::create_directories(folder);
            const std::filesystem::path name = freeName(stem(show_.stage.steps()), ".input", folder);
            mesh::writeWhole(name, [&](std::ostream& stream) { stream << text; });
            return ": --replay " + std::filesystem::absolute(name).string() + " replays the input";
        } catch (const std::exception& error) { // mesh::ExportError, std::filesystem::filesystem_error
            why = error.what();
        }
    }
    return ": the input is lost: " + why;
}

std::string Journal::sceneName() const {
    const Options& options = library_.shown();
    const std::optional<app::SavedRun>& run = show_.opening.run;
    return run ? run->scene : rememberedScene(options.scene, options.builtIn);
}

void Journal::saveState(bool isDiverged) {
    show_.settleAll();
    Screen& screen = show_.screen;
    if (isDiverged) return screen.tell("not saved: the simulation has diverged");
    if (show_.stage.lacksContactRoom())
        return screen.tell("not saved: steps wait for more room; try again in a moment");
    vk::Queue queue(show_.device);
    try {
        app::SavedRun run = show_.stage.save(show_.device, queue);
        run.scene = sceneName();
        run.view = viewOf(show_.controller.camera);
        const std::filesystem::path name = freeName(stem(show_.stage.played()), ".state");
        app::writeRun(name, run);
        printLine("state: " + name.string());
        screen.tell("state: " + name.string() + "; open it or drop it here to continue");
    } catch (const mesh::ExportError& error) {
        screen.warn(error.what());
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        screen.warn(error.what());
    }
}

bool Journal::playUntilStep(const Presenter::Frame& frame) {
    for (;;) {
        const Replay::Due due = replay_->next(show_.tools, show_.controller.camera, show_.stage);
        if (due == Replay::Due::step) return true;
        if (due == Replay::Due::nothing) break;
        if (due == Replay::Due::shape) return false; // handled before the next picture
        if (show_.tools.recordHistory(frame.commands, show_.stage)) show_.wentBack();
    }
    ended_ = replay_->file();
    saved_ = show_.tools.log().events().size();
    replay_.reset();
    show_.controller.playback.pause(); // the state at its end is there to be looked at
    return false;
}

// Hands must not reach a simulation that is about to be replaced.
void Journal::dropReplay() {
    if (!isDropped_ || show_.stage.wantsShape()) return;
    isDropped_ = false;
    if (!replay_) return;
    replay_.reset();
    show_.tools.clear();
    show_.screen.tell("the replay was ended");
}

void Journal::compareReplay() {
    if (!ended_) return;
    const InputFile file = *std::exchange(ended_, std::nullopt);
    show_.settleAll();
    vk::Queue queue(show_.device);
    const std::string text = hashText(stateHash(show_.device, show_.stage, queue), show_.stage.steps(), file);
    printLine(text);
    show_.screen.tell("the replay is over: " + text);
}

void Journal::endReplay(const std::string& why) {
    const bool isReplay = std::exchange(replay_, std::nullopt).has_value();
    show_.screen.warn((isReplay ? "the replay ends here: " : "not changed: ") + why);
}

std::string Journal::howToEnd() {
    return "a replay is running: " + std::string(keyOf(Action::drop)) + " ends it";
}

bool Journal::takes(Action action) {
    if (!replay_) return false;
    switch (action) {
    case Action::drop:
        isDropped_ = true;
        return true;
    case Action::blade:
    case Action::poke:
    case Action::pin:
    case Action::undo:
    case Action::redo:
    case Action::stepBack:
        break;
    default:
        if (!turnedBy(action, {})) return false;
    }
    show_.screen.tell(howToEnd());
    return true;
}

void Journal::begin(const app::SavedRun& run) {
    show_.tools.begin(show_.stage);
    from_ = {rememberedScene(library_.shown().scene, {}), run.fileHash};
}

void Journal::reset(float gravity) {
    Tools& tools = show_.tools;
    if (replay_) tools.putAway(show_.stage);
    tools.reset();
    saved_ = tools.log().events().size();
    const sim::Settings& begun = replay_ ? show_.stage.madeWith() : show_.stage.settings();
    begun_ = {begun.solver, begun.substeps};
    if (replay_) replay_->restart();
    if (std::exchange(from_, std::nullopt)) tools.pull(show_.stage, gravity); // from now on in the log
    isBroken_ = false;
}

void Journal::takeOver(const Journal& before) {
    saved_ = before.saved_;
    begun_ = before.begun_;
    from_ = before.from_;
    isBroken_ = before.isBroken_;
}

} // namespace sinew::viewer
