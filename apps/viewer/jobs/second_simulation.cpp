// Runs a document with gauges of its own, and formats settings as text.
#include "viewer/jobs/second_simulation.hpp"

#include "scenes/recovery.hpp"
#include "sinew/ranges.hpp"
#include "sinew/solver_names.hpp"
#include "sinew/substeps.hpp"
#include "viewer/render/legend.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sinew::viewer {

namespace {

// Settings of the first with another solver; kernel forms timed for the first solver do not apply here.
sim::Settings settingsOf(sim::Settings settings, const BesideShape& shape) {
    settings.solver = shape.solver;
    settings.substeps = shape.substeps;
    return settings;
}

sim::Settings chosenFor(const sim::Scene& scene, const sim::Settings& settings) {
    return settings.substeps == 0 ? sim::withSubsteps(scene, settings) : settings;
}

sim::Scene sceneFor(const scenes::LoadedScene& loaded, const sim::Settings& settings) {
    return scenes::withoutDefaults(loaded.scene, loaded.defaults, settings);
}

BesideShape shapeOf(const sim::Settings& settings) {
    return {settings.solver, settings.substeps};
}

} // namespace

std::optional<BesideShape> shapeInstead(const sim::Settings& first) {
    constexpr std::uint32_t few = 8;
    if (first.substeps < 2) return std::nullopt;
    return BesideShape{first.solver, first.substeps > few ? few : first.substeps / 2};
}

std::optional<BesideShape> parseBeside(const std::string& text) {
    const std::size_t colon = text.find(':');
    BesideShape shape;
    if (!sim::parseSolver(text.substr(0, colon), shape.solver)) return std::nullopt;
    if (colon == std::string::npos) return shape;
    const char *from = text.data() + colon + 1, *end = text.data() + text.size();
    const auto [last, error] = std::from_chars(from, end, shape.substeps);
    const bool isNumber = error == std::errc() && last == end;
    if (!isNumber || !sim::ranges::substeps.holds(shape.substeps)) return std::nullopt;
    return shape;
}

BesideKnobs knobsOf(const BesideShape& shape) {
    const std::vector<std::string> names = sim::solverNames();
    const auto found = std::ranges::find(names, sim::solverName(shape.solver));
    return {static_cast<int>(found - names.begin()), static_cast<int>(shape.substeps)};
}

BesideShape shapeOf(const BesideKnobs& knobs) {
    BesideShape shape{.substeps = static_cast<std::uint32_t>(knobs.substeps)};
    sim::parseSolver(sim::solverNames().at(static_cast<std::size_t>(knobs.solver)), shape.solver);
    return shape;
}

std::string toText(const BesideShape& shape) {
    const std::string solver = sim::solverName(shape.solver);
    return shape.substeps == 0 ? solver : solver + ", " + countText(shape.substeps, "substep");
}

SecondSimulation::SecondSimulation(const vk::Device& device, const scenes::LoadedScene& loaded,
                                   const sim::Settings& settings, const sim::Material& material,
                                   const BesideShape& shape, std::uint32_t slots)
    : shape_(shapeOf(chosenFor(sim::withMaterial(sceneFor(loaded, settingsOf(settings, shape)), material),
                               settingsOf(settings, shape)))),
      document_(device, sceneFor(loaded, settingsOf(settings, shape_)), settingsOf(settings, shape_),
                material),
      warnings_(scenes::newWarnings(loaded, document_.settings())),
      notes_(scenes::recoveryLeftOut(loaded, document_.settings())), gauges_(document_, loaded.scene.dt),
      probe_(device, document_.scene(), document_.settings(), document_.simulation()), flights_(slots) {
    document_.setBlades({loaded.blades, loaded.scene.dt});
    const auto spans = static_cast<std::uint32_t>(document_.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < slots; ++slot) times_.emplace_back(device, spans);
}

void SecondSimulation::restart() noexcept {
    gauges_.restart();
    apart_.reset();
    for (Flight& flight : flights_) flight = {};
}

void SecondSimulation::recordReset(VkCommandBuffer commands) noexcept {
    document_.recordReset(commands);
    restart();
}

void SecondSimulation::recordTakeOver(VkCommandBuffer commands, const Document& first) {
    document_.recordTakeOver(commands, first);
    restart();
}

void SecondSimulation::recordStep(VkCommandBuffer commands, const Document& first, const StepHands& hands,
                                  std::uint32_t slot, bool isTimed) noexcept {
    Flight& flight = flights_[slot];
    if (flight.steps++ == 0) flight.firstStep = document_.steps() + 1;
    flight.isTimed = flight.isTimed || isTimed;
    document_.setGravity(first.gravity());
    viewer::recordStep(commands, document_, hands, isTimed ? &times_[slot] : nullptr);
}

void SecondSimulation::recordPicture(VkCommandBuffer commands, std::uint32_t slot, bool isMeasured) noexcept {
    document_.recordSkin(commands);
    flights_[slot].isMeasured = isMeasured;
    if (isMeasured) probe_.record(commands);
}

std::optional<SecondSimulation::Trouble> SecondSimulation::settle(std::uint32_t slot,
                                                                  const StateProbe* first) {
    const Flight flight = std::exchange(flights_[slot], {});
    for (std::uint32_t i = 0; i < flight.steps; ++i) {
        const std::uint64_t step = flight.firstStep + i;
        if (const std::uint32_t needed = document_.neededRoom(step); needed > 0) {
            const sim::Settings& settings = document_.settings();
            const auto roomy = sim::Rooms(settings).forContacts(settings, needed);
            if (!roomy) return Trouble{app::tooCrowded(step)};
            return Trouble{"its contacts need more room", roomy->contactRoom};
        }
        if (const std::optional<Divergence> divergence = document_.check(step))
            return Trouble{divergence->sentence()};
        const sim::Status status = document_.simulation().status(step);
        gauges_.stepFinished(status);
    }
    if (flight.isTimed) gauges_.stepTimed(times_[slot].milliseconds());
    if (flight.isMeasured) gauges_.strainMeasured(measureStrain(document_.scene(), probe_));
    if (flight.isMeasured && first) apart_ = measureDistance(*first, probe_);
    return std::nullopt;
}

} // namespace sinew::viewer
