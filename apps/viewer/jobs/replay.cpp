// Plays one event after another.
#include "viewer/jobs/replay.hpp"

#include "app/guard.hpp"
#include "sim/core/counted.hpp"
#include "sim/core/hash.hpp"
#include "viewer/document/document.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/tools/tools.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

namespace sinew::viewer {

namespace {

// Passes events to the tools, like the window's input.
struct Player {
    Tools& tools;
    Camera& camera;
    Document& document;

    void operator()(const Camera& event) const {
        camera = event;
        tools.look(event);
    }
    void operator()(const Pointed& event) const { tools.move(camera, event.at); }
    void operator()(const Pressed& event) const { tools.press(camera, event.isDown, event.at); }
    void operator()(Action event) const { tools.act(event); }
    void operator()(const Pulled& event) const { tools.pull(document, event.gravity); }
    void operator()(const Turned& event) const { tools.turn(document, event.material); }
    void operator()(const Shaped& event) const { tools.shape(document, event); }
    void operator()(const ToolSet& event) const { tools.set(*toolTable()[event.tool], event.setting); }
    void operator()(const Forgot& event) const { event.areOfSteps ? tools.forgetSteps() : tools.forget(); }
    void operator()(const Answered& event) const {
        if (event.pick && event.pick->particle >= document.scene().particles.size())
            throw app::Failure(app::badInput,
                               "cannot play input: particle " + std::to_string(event.pick->particle) +
                                   ": the scene has no such particle: open the scene of the log");
        const std::optional<Question> question = tools.question();
        if (question && question->tool == event.tool && !question->isPreview)
            tools.answer(*question, event.pick, event.radius);
    }
    void operator()(const Stepped&) const {}
};

} // namespace

Replay::Due Replay::next(Tools& tools, Camera& camera, Document& document) {
    for (; at_ < file_.events.size(); ++at_) {
        const InputEvent& event = file_.events[at_];
        // Uses the material set before it.
        if (document.wantsShape() && !std::holds_alternative<Shaped>(event)) return Due::shape;
        if (const auto* stepped = std::get_if<Stepped>(&event)) {
            if (tools.wantsHistory()) return Due::history;
            if (taken_ < stepped->count) {
                ++taken_;
                return Due::step;
            }
            taken_ = 0;
        }
        std::visit(Player{tools, camera, document}, event);
    }
    if (document.wantsShape()) return Due::shape;
    return tools.wantsHistory() ? Due::history : Due::nothing;
}

std::uint64_t stateHash(const vk::Device& device, const Document& document, vk::Queue& queue) {
    StateProbe probe(device, document.scene(), document.settings(), document.simulation());
    VkCommandBuffer commands = queue.begin();
    probe.record(commands);
    probe.recordVelocities(commands);
    queue.wait(queue.submit(commands));
    return sim::fnv1a(std::as_bytes(probe.velocities()), sim::fnv1a(std::as_bytes(probe.positions())));
}

namespace {

// The saved state's file, or one of that name beside the log if both were moved.
std::string stateOf(const SavedOrigin& from, const std::filesystem::path& log) {
    std::error_code error;
    const std::filesystem::path beside = log.parent_path() / std::filesystem::path(from.file).filename();
    const bool hasMoved =
        !std::filesystem::exists(from.file, error) && std::filesystem::exists(beside, error);
    return hasMoved ? beside.string() : from.file;
}

} // namespace

Options withReplay(Options options, const InputFile& file) {
    if (options.scene.empty() && file.from) options.scene = stateOf(*file.from, options.replay);
    if (options.scene.empty() && !file.scene.empty())
        (file.scene.front() == '/' ? options.scene : options.builtIn) = file.scene;
    if (!options.overrides.solver && !file.solver.empty()) options.overrides.solver = file.solver;
    if (!options.overrides.substeps && file.substeps > 0) options.overrides.substeps = file.substeps;
    if (!options.overrides.levels) options.overrides.levels = file.levels;
    if (file.substeps > 0) options.overrides.takeClamp(file.hasSharpClamp);
    if (!options.hasFrames) options.frames = file.steps();
    return options;
}

void prepareForReplay(OpenedScene& opening, const InputFile& file) {
    if (file.from && (!opening.run || opening.run->fileHash != file.from->hash))
        throw app::Failure(app::badInput, "cannot play input: it begins from a state: " + file.from->file +
                                              ": the opened state is another one: open the file that was "
                                              "loaded then");
    sim::Settings& settings = opening.loaded.settings;
    app::addRoomForUser(settings);
    if (!file.from) settings = sim::withRoomsOf(settings, roomOf(file));
    if (!file.from && file.forms) settings.forms = *file.forms;
    opening.bladeDepth.reset(); // the log has its own
}

sim::Settings roomOf(const InputFile& file) {
    sim::Settings room;
    room.contactRoom = std::min(file.room, sim::ranges::mostContactRoom);
    room.cutSurfaceRoom = std::min(file.surface, sim::ranges::mostCutSurfaceRoom);
    return room;
}

std::string hashText(std::uint64_t hash, std::uint64_t steps) {
    char text[80];
    std::snprintf(text, sizeof text, "state hash %016" PRIx64 " after ", hash);
    return text + sim::counted(steps, "step");
}

std::string hashText(std::uint64_t hash, std::uint64_t steps, const InputFile& recorded) {
    const std::string text = hashText(hash, steps);
    if (!recorded.hash) return text;
    if (steps != recorded.steps()) return text + ", recorded was " + std::to_string(recorded.steps());
    return text +
           (*recorded.hash == hash ? ", as recorded" : ", not as recorded: another device or version?");
}

} // namespace sinew::viewer
