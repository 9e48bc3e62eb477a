// Files are named after scene and step.
#include "viewer/player/journal.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sinew/solver_names.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/capture/recording.hpp"
#include "viewer/render/renderer.hpp"
#include "viewer/ui/knob_keys.hpp"
#include "viewer/ui/preferences.hpp"

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

Journal::Journal(const PlayerContext& player, const SceneLoader& sceneLoader)
    : player_(player), sceneLoader_(sceneLoader), begun_{player.document.settings().solver,
                                                         player.document.settings().substeps} {
    if (player.opening.input) replay_.emplace(*player.opening.input);
}

std::string Journal::stem(std::uint64_t step) const {
    return nameAt(player_.opening.loaded.scene.name, step);
}

void Journal::saveInput() {
    player_.settleAll();
    Session& session = player_.session;
    if (isBroken_) return session.tell("not saved: the input no longer leads to this state");
    if (from_ && from_->file.empty())
        return session.tell("not saved: a log cannot hold the path of the loaded state");
    InputFile file = inputFile();
    vk::Queue queue(player_.device);
    file.hash = stateHash(player_.device, player_.document, queue);
    try {
        const std::filesystem::path name = freeName(stem(player_.document.steps()), ".input");
        mesh::writeWhole(name, [&](std::ostream& stream) { stream << toText(file); });
        saved_ = file.events.size();
        printLine("input: " + name.string() + ", " + hashText(*file.hash, player_.document.steps()));
        session.tell("input: " + name.string() + "; --replay plays it again");
    } catch (const mesh::ExportError& error) {
        session.warn(error.what());
    }
}

InputFile Journal::inputFile() const {
    return {.scene = sceneName(),
            .from = from_,
            .solver = sim::solverName(begun_.solver),
            .substeps = begun_.substeps,
            .levels = player_.document.settings().levels,
            .hasSharpClamp = player_.document.settings().hasSharpClamp,
            .room = player_.document.contactRoom().room,
            .surface = player_.document.settings().cutSurfaceRoom,
            .forms =
                sim::completed(player_.document.settings().forms,
                               isSoftware(player_.device) ? sim::DeviceKind::software : sim::DeviceKind::gpu),
            .events = player_.tools.log().events()};
}

// Writes no state hash: steps may be in flight.
std::string Journal::keepInput(const std::filesystem::path& otherwise) const {
    if (replay_ || (from_ && from_->file.empty()) || !player_.tools.log().hasDeeds(saved_)) return {};
    const std::string text = toText(inputFile());
    std::string why;
    for (const std::filesystem::path& folder : {std::filesystem::path(), otherwise}) {
        try {
            if (!folder.empty()) std::filesystem::create_directories(folder);
            const std::filesystem::path name = freeName(stem(player_.document.steps()), ".input", folder);
            mesh::writeWhole(name, [&](std::ostream& stream) { stream << text; });
            return ": --replay " + std::filesystem::absolute(name).string() + " replays the input";
        } catch (const std::exception& error) { // mesh::ExportError, std::filesystem::filesystem_error
            why = error.what();
        }
    }
    return ": the input is lost: " + why;
}

std::string Journal::sceneName() const {
    const Options& options = sceneLoader_.shown();
    const std::optional<app::SavedRun>& run = player_.opening.run;
    return run ? run->scene : rememberedScene(options.scene, options.builtIn);
}

void Journal::saveState(bool isDiverged) {
    player_.settleAll();
    Session& session = player_.session;
    if (isDiverged) return session.tell("not saved: the simulation became unstable");
    if (player_.document.lacksContactRoom())
        return session.tell("not saved: steps wait for more room; try again in a moment");
    vk::Queue queue(player_.device);
    try {
        app::SavedRun run = player_.document.save(player_.device, queue);
        run.scene = sceneName();
        run.view = viewOf(player_.controller.camera);
        const std::filesystem::path name = freeName(stem(player_.document.played()), ".state");
        app::writeRun(name, run);
        printLine("state: " + name.string());
        session.tell("state: " + name.string() + "; open it or drop it here to continue");
    } catch (const mesh::ExportError& error) {
        session.warn(error.what());
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        session.warn(error.what());
    }
}

bool Journal::playUntilStep(const Presenter::Frame& frame) {
    for (;;) {
        const Replay::Due due = replay_->next(player_.tools, player_.controller.camera, player_.document);
        if (due == Replay::Due::step) return true;
        if (due == Replay::Due::nothing) break;
        if (due == Replay::Due::shape) return false; // handled before the next picture
        if (player_.tools.recordHistory(frame.commands, player_.document)) player_.wentBack();
    }
    ended_ = replay_->file();
    saved_ = player_.tools.log().events().size();
    replay_.reset();
    player_.controller.playback.pause(); // the state at its end is there to be looked at
    return false;
}

// Hands must not reach a simulation that is about to be replaced.
void Journal::dropReplay() {
    if (!isDropped_ || player_.document.wantsShape()) return;
    isDropped_ = false;
    if (!replay_) return;
    replay_.reset();
    player_.tools.clear();
    player_.session.tell("the replay was ended");
}

void Journal::compareReplay() {
    if (!ended_) return;
    const InputFile file = *std::exchange(ended_, std::nullopt);
    player_.settleAll();
    vk::Queue queue(player_.device);
    const std::string text =
        hashText(stateHash(player_.device, player_.document, queue), player_.document.steps(), file);
    printLine(text);
    player_.session.tell("the replay is over: " + text);
}

void Journal::endReplay(const std::string& why) {
    const bool isReplay = std::exchange(replay_, std::nullopt).has_value();
    player_.session.warn((isReplay ? "the replay ends here: " : "not changed: ") + why);
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
    case Action::undo:
    case Action::redo:
    case Action::stepBack:
        break;
    default:
        if (!toolOf(action) && !turnedBy(action, {})) return false;
    }
    player_.session.tell(howToEnd());
    return true;
}

void Journal::begin(const app::SavedRun& run) {
    player_.tools.begin(player_.document);
    from_ = {rememberedScene(sceneLoader_.shown().scene, {}), run.fileHash};
}

void Journal::reset(float gravity) {
    Tools& tools = player_.tools;
    if (replay_) tools.putAway(player_.document);
    tools.reset();
    saved_ = tools.log().events().size();
    const sim::Settings& begun = replay_ ? player_.document.madeWith() : player_.document.settings();
    begun_ = {begun.solver, begun.substeps};
    if (replay_) replay_->restart();
    if (std::exchange(from_, std::nullopt)) tools.pull(player_.document, gravity); // from now on in the log
    isBroken_ = false;
}

void Journal::takeOver(const Journal& before) {
    saved_ = before.saved_;
    begun_ = before.begun_;
    from_ = before.from_;
    isBroken_ = before.isBroken_;
}

} // namespace sinew::viewer
