// A material is worked out by the document; what needs other passes, by the scene loader.
#include "viewer/player/adjustments.hpp"

#include "sinew/solver_names.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/tools/cut_tool.hpp"
#include "viewer/ui/knob_keys.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::viewer {

namespace {

bool areOfOneShape(const Knobs& a, const Knobs& b) {
    return a.solver == b.solver && a.substeps == b.substeps;
}

} // namespace

Adjustments::Adjustments(const PlayerContext& player, SceneLoader& sceneLoader, const Devices& devices,
                         const Comparison& comparison)
    : player_(player), sceneLoader_(sceneLoader), devices_(devices), comparison_(comparison),
      facts_(player.prepared.facts), knobs_(facts_.fromFile) {}

Knobs Adjustments::shown() const {
    Knobs knobs = knobs_;
    knobs.bladeDepth = player_.tools.setting(tool::blade);
    knobs.pace = static_cast<float>(player_.controller.playback.pace());
    return knobs;
}

// The knobs of the document as it was made, whatever was turned since.
Knobs Adjustments::made() const {
    const sim::Settings& settings = player_.document.settings();
    const std::vector<std::string>& solvers = facts_.solvers;
    Knobs knobs = knobs_;
    knobs.substeps = static_cast<int>(settings.substeps);
    knobs.solver =
        static_cast<int>(std::ranges::find(solvers, sim::solverName(settings.solver)) - solvers.begin());
    return knobs;
}

ReloadRequest Adjustments::reloadRequest() const {
    return {materialOf(knobs_, facts_.fromFile), player_.document.settings()};
}

void Adjustments::turn(const Knobs& knobs) {
    if (knobs.gravity != knobs_.gravity) player_.tools.pull(player_.document, knobs.gravity);
    player_.controller.playback.setPace(double{knobs.pace});
    if (knobs.bladeDepth != player_.tools.setting(tool::blade))
        player_.tools.set(tool::blade, knobs.bladeDepth);
    knobs_.gravity = knobs.gravity;
    knobs_.pace = knobs.pace;
    knobs_.substeps = knobs.substeps;
    knobs_.solver = knobs.solver;
    turnMaterial(knobs);
}

bool Adjustments::act(Action action) {
    const auto turned = turnedBy(action, shown());
    if (!turned) return false;
    turn(turned->knobs);
    player_.session.tell(turned->said);
    return true;
}

void Adjustments::turnMaterial(const Knobs& knobs) {
    const sim::Material before = materialOf(knobs_, facts_.fromFile);
    knobs_.stiffness = knobs.stiffness;
    knobs_.damping = knobs.damping;
    knobs_.friction = knobs.friction;
    knobs_.bodies = knobs.bodies;
    knobs_.body = knobs.body;
    const sim::Material material = materialOf(knobs_, facts_.fromFile);
    if (material != before) player_.document.turn(material);
}

void Adjustments::tend(bool isReplaying) {
    takeMaterial();
    if (!isReplaying) reopen();
}

// A material that cannot be had leaves all as it is.
void Adjustments::takeMaterial() {
    try {
        const Document::Turn turn = player_.document.takeTurn(player_.controller.playback.isPaused());
        if (turn == Document::Turn::refused) isRefused_ = true;
    } catch (const std::exception& error) {
        player_.session.warn(error.what());
    }
}

// Knobs that are turned while another simulation is being made are asked for when that is there.
void Adjustments::reopen() {
    const bool isTurned = !areOfOneShape(knobs_, made());
    if ((!isTurned && !isRefused_) || sceneLoader_.isOpening()) return;
    isRefused_ = false;
    scenes::Overrides overrides;
    if (isTurned) {
        overrides.solver = facts_.solvers[static_cast<std::size_t>(knobs_.solver)];
        overrides.substeps = static_cast<std::uint32_t>(knobs_.substeps);
    }
    asked_ = knobs_;
    sceneLoader_.reopen(overrides, reloadRequest(), comparison_.pictureAspect());
}

void Adjustments::changeDevice(std::size_t index) {
    asked_ = made();
    sceneLoader_.reopenOn(requestFor(devices_.list(), index), reloadRequest(), comparison_.pictureAspect());
}

bool Adjustments::mayOpen() {
    if (sceneLoader_.isOpening()) player_.session.tell("another scene is still being opened");
    return !sceneLoader_.isOpening();
}

void Adjustments::open(const Wishes& wishes) {
    if (wishes.previews) sceneLoader_.previews().want(*wishes.previews);
    if (wishes.scene && mayOpen()) sceneLoader_.open(*wishes.scene, comparison_.pictureAspect());
    if (wishes.file) openFile(*wishes.file);
}

void Adjustments::openNext(int by) {
    if (mayOpen()) sceneLoader_.openNext(by, comparison_.pictureAspect());
}

void Adjustments::openFile(const std::string& file) {
    if (mayOpen()) sceneLoader_.openFile(file, comparison_.pictureAspect());
}

void Adjustments::playAgain(const InputFile& input) {
    if (mayOpen()) sceneLoader_.playAgain(input, comparison_.pictureAspect());
}

// An opening with less room than there is by now would have to make more in this thread: it is asked for
// again.
std::unique_ptr<OpenedScene> Adjustments::takeOpened() {
    try {
        std::unique_ptr<OpenedScene> opened = sceneLoader_.take();
        const sim::Settings& room = player_.document.settings();
        if (!opened || !opened->reload || sim::haveRoomsOf(opened->reload->settings, room)) return opened;
        sceneLoader_.askAgain({opened->reload->material, room}, comparison_.pictureAspect());
    } catch (const std::exception& error) {
        player_.session.warn(error.what());
        keepAsItWas();
    }
    return nullptr;
}

void Adjustments::keepAsItWas() {
    if (!std::exchange(asked_, std::nullopt)) return;
    knobs_ = turnedTo(player_.document.material(), made(), facts_.fromFile);
}

void Adjustments::begin(const app::SavedRun& run) {
    const auto [x, y, z] = run.gravity;
    knobs_ = turnedTo(run.material, knobs_, facts_.fromFile);
    knobs_.gravity = std::hypot(x, y, z);
    setStiffness(facts_, player_.document.stiffness());
}

void Adjustments::reshaped() {
    const Knobs fromFile = facts_.fromFile;
    facts_ = sceneFacts(player_.opening, player_.document, player_.device);
    facts_.fromFile = fromFile;
    knobs_ = turnedTo(player_.document.material(), made(), fromFile);
}

void Adjustments::takeOver(const Adjustments& before) {
    facts_.fromFile = before.facts_.fromFile;
    knobs_ = before.knobs_;
    if (!before.asked_ || areOfOneShape(knobs_, *before.asked_)) knobs_ = made(); // 0 is a number now
    const sim::Material material = materialOf(knobs_, facts_.fromFile);
    if (material != player_.document.material()) player_.document.turn(material); // turned meanwhile
}

} // namespace sinew::viewer
