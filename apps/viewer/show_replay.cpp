// Saves and replays input logs in the window, and saves states.
#include "viewer/panels/knob_keys.hpp"
#include "viewer/show.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sim/compile.hpp"
#include "viewer/window/preferences.hpp"
#include "vk/check.hpp"
#include "vk/queue.hpp"

#include <cstdio>
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

// Saves the log; waits, which is acceptable for a rare action.
void Show::saveInput() {
    settleAll();
    if (isBroken_) return screen_.tell("not saved: the input no longer leads to this state");
    if (from_ && from_->file.empty())
        return screen_.tell("not saved: a log cannot hold the path of the loaded state");
    InputFile file = inputFile();
    vk::Queue queue(device_);
    file.hash = stateHash(device_, stage_, queue);
    try {
        const std::filesystem::path name = freeName(nameAt(stage_.steps()), ".input");
        mesh::writeWhole(name, [&](std::ostream& stream) { stream << toText(file); });
        inputSaved_ = file.events.size();
        std::printf("input: %s, %s\n", name.c_str(), hashText(*file.hash, stage_.steps()).c_str());
        std::fflush(stdout);
        screen_.tell("input: " + name.string() + "; --replay plays it again");
    } catch (const mesh::ExportError& error) {
        screen_.warn(error.what());
    }
}

InputFile Show::inputFile() const {
    return {.scene = sceneName(),
            .from = from_,
            .solver = sim::solverName(begun_.solver),
            .substeps = begun_.substeps,
            .room = stage_.contactRoom().room,
            .surface = stage_.settings().cutSurfaceRoom,
            .events = tools_.log().events()};
}

// Writes no state hash: steps may be in flight.
std::string Show::keepInput(const std::filesystem::path& otherwise) const {
    if (replay_ || (from_ && from_->file.empty()) || !tools_.log().hasDeeds(inputSaved_)) return {};
    const std::string text = toText(inputFile());
    std::string why;
    for (const std::filesystem::path& folder : {std::filesystem::path(), otherwise}) {
        try {
            if (!folder.empty()) std::filesystem::create_directories(folder);
            const std::filesystem::path name = freeName(nameAt(stage_.steps()), ".input", folder);
            mesh::writeWhole(name, [&](std::ostream& stream) { stream << text; });
            return ": --replay " + std::filesystem::absolute(name).string() + " replays the input";
        } catch (const std::exception& error) { // mesh::ExportError, std::filesystem::filesystem_error
            why = error.what();
        }
    }
    return ": the input is lost: " + why;
}

std::string Show::sceneName() const {
    const Options& options = library_.shown();
    return opening_.run ? opening_.run->scene : rememberedScene(options.scene, options.builtIn);
}

// Saves the state; waits.
void Show::saveState() {
    settleAll();
    if (isDiverged_) return screen_.tell("not saved: the simulation has diverged");
    if (stage_.lacksContactRoom())
        return screen_.tell("not saved: steps wait for more room; try again in a moment");
    vk::Queue queue(device_);
    try {
        app::SavedRun run = stage_.save(device_, queue);
        run.scene = sceneName();
        run.view = viewOf(controller_.camera);
        const std::filesystem::path name = freeName(nameAt(stage_.played()), ".state");
        app::writeRun(name, run);
        std::printf("state: %s\n", name.c_str());
        std::fflush(stdout);
        screen_.tell("state: " + name.string() + "; open it or drop it here to continue");
    } catch (const mesh::ExportError& error) {
        screen_.warn(error.what());
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        screen_.warn(error.what());
    }
}

// Plays the log before the next step; false if there is no step.
bool Show::playInput(const Presenter::Frame& frame) {
    for (;;) {
        const Replay::Due due = replay_->next(tools_, controller_.camera, stage_);
        if (due == Replay::Due::step) return true;
        if (due == Replay::Due::nothing) break;
        if (due == Replay::Due::shape) return false; // handled before the next picture
        if (!tools_.recordHistory(frame.commands, stage_)) continue;
        forgetFlights();
        isBesideOut_ = true; // it must take over the restored state
    }
    endReplay();
    return false;
}

// Ends the replay and pauses at its last state.
void Show::endReplay() {
    replayed_ = replay_->file();
    inputSaved_ = tools_.log().events().size();
    replay_.reset();
    controller_.playback.pause();
}

// Compares the hash once all frames have finished.
void Show::compareReplay() {
    const InputFile file = *std::exchange(replayed_, std::nullopt);
    settleAll();
    vk::Queue queue(device_);
    const std::string text = hashText(stateHash(device_, stage_, queue), stage_.steps(), file);
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
    screen_.tell("the replay is over: " + text);
}

// Ends the replay, unless a simulation is about to be replaced.
void Show::dropReplay() {
    if (!isDropped_ || stage_.wantsShape()) return;
    isDropped_ = false;
    if (!replay_) return;
    replay_.reset();
    tools_.clear();
    screen_.tell("the replay was ended");
}

// During a replay most actions come from the log.
bool Show::isOfReplay(Action action) {
    if (!replay_) return false;
    if (turnedBy(action, knobs_)) { // the log controls the scene
        screen_.tell("a replay is running: " + std::string(keyOf(Action::drop)) + " ends it");
        return true;
    }
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
        screen_.tell("a replay is running: " + std::string(keyOf(Action::drop)) + " ends it");
        return true;
    default:
        return false;
    }
}

} // namespace sinew::viewer
