// Reads step programs and status words.
#include "viewer/jobs/gauges.hpp"

#include "sim/compile/compile.hpp"
#include "viewer/render/renderer.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

Knobs knobsOf(const scenes::LoadedScene& loaded) {
    const std::vector<std::string> solvers = sim::solverNames();
    const auto solver = std::ranges::find(solvers, sim::solverName(loaded.settings.solver));
    const sim::Vec3& g = loaded.scene.gravity;
    const sim::Scene& scene = loaded.scene;
    const bool hasColliders = scene.planes.empty() && !scene.colliders.empty();
    return {.gravity = std::hypot(g.x, g.y, g.z),
            .substeps = static_cast<int>(loaded.settings.substeps),
            .solver = static_cast<int>(solver - solvers.begin()),
            .damping = scene.damping,
            .friction = !scene.planes.empty() ? scene.planes.front().friction
                        : hasColliders        ? scene.colliders.front().friction
                                              : scene.contacts.friction,
            .bodies = std::vector<float>(scene.bodies.size(), 1),
            .bladeDepth = loaded.bladeDepth};
}

// Removes the index: passes such as "solve_distance[3]" differ only in their range.
std::string withoutNumber(const std::string& label) {
    return label.substr(0, label.find('['));
}

void add(std::vector<PassLine>& lines, const sim::StepProgram& program, const sim::Pass& pass) {
    const bool isDispatch = pass.kind == sim::PassKind::dispatch;
    PassLine line{.phase = program.phases[pass.phase],
                  .label = withoutNumber(pass.label),
                  .items = isDispatch ? pass.items : 0,
                  .isOfCut = pass.isOfCut()};
    const auto same = [&](const PassLine& other) {
        return other.phase == line.phase && other.label == line.label && other.isOfCut == line.isOfCut &&
               (other.items == 0) == (line.items == 0);
    };
    const auto found = std::ranges::find_if(lines, same);
    if (found == lines.end()) return lines.push_back(std::move(line));
    ++found->times;
    found->items = std::max(found->items, line.items);
}

void addProgram(SceneFacts& facts, const sim::StepProgram& program) {
    for (const sim::Pass& pass : program[sim::List::step]) add(facts.passes, program, pass);
    const sim::PassCounts counts = sim::countPasses(program, sim::plainStep);
    facts.dispatches += counts.dispatches;
    facts.barriers += counts.barriers;
    facts.skipped = program.skipped;
}

} // namespace

void setStiffness(SceneFacts& facts, const sim::StiffnessReport& report) {
    facts.stiffness.clear();
    facts.neededSubsteps = 0;
    // As in the warning of a scene file: a few clamped links are no news, and other solvers clamp none.
    const auto isSoft = [](const sim::BodyStiffness& body) { return 2 * body.soft > body.elastic; };
    if (report.clamped == 0 || std::ranges::none_of(report.bodies, isSoft)) return;
    const long percent = std::lround(100 * report.softest);
    facts.stiffness = "Softer than asked: the softest link has " +
                      (percent > 0 ? std::to_string(percent) : "less than 1") + " % of its stiffness.";
    if (report.neededSubsteps <= static_cast<std::uint32_t>(mostSubsteps))
        facts.neededSubsteps = report.neededSubsteps;
}

sim::Material materialOf(const Knobs& knobs, const Knobs& fromFile) {
    sim::Material material{.stiffness = knobs.stiffness, .bodies = knobs.bodies};
    if (std::ranges::all_of(knobs.bodies, [](float factor) { return factor == 1; })) material.bodies.clear();
    if (knobs.damping != fromFile.damping) material.damping = knobs.damping;
    if (knobs.friction != fromFile.friction) material.friction = knobs.friction;
    return material;
}

Knobs turnedTo(const sim::Material& material, Knobs knobs, const Knobs& fromFile) {
    knobs.stiffness = material.stiffness;
    knobs.bodies = material.bodies.empty() ? fromFile.bodies : material.bodies;
    knobs.damping = material.damping.value_or(fromFile.damping);
    knobs.friction = material.friction.value_or(fromFile.friction);
    return knobs;
}

// The links alone are an isotropic material with the shear modulus mu and a Poisson ratio of 1/4. Volumes of
// cells add to lambda = 2 mu nu / (1 - 2 nu), of which the links have mu.
float youngModulusOf(const sim::Grid& grid) {
    if (grid.nodes[1] <= 1 || !(grid.compliance[0] > 0)) return 0;
    const double edgeShare = grid.kinds == 3 ? 22.0 / 35 : 0.4; // of an edge's stiffness in E a
    const double ofLinks = 1 / (double{grid.compliance[0]} * double{grid.restLength[0]} * edgeShare);
    const double shear = ofLinks / 2.5, ratio = 1 + double{grid.volumeStiffness} / shear;
    const double poisson = ratio / (2 * (1 + ratio));
    return static_cast<float>(2 * shear * (1 + poisson));
}

SceneFacts sceneFacts(const OpenedScene& opening, const Document& document, const vk::Device& device) {
    const sim::Scene& scene = document.scene();
    const scenes::LoadedScene& loaded = opening.loaded;
    SceneFacts facts{.name = scene.name,
                     .device = device.description().name,
                     .driver = device.description().driver,
                     .deviceIndex = device.description().index,
                     .isSoftware = isSoftware(device),
                     .particles = scene.particles.size(),
                     .constraints = document.simulation().program().constraintCount,
                     .substepsWhy = sim::toText(loaded.substeps, loaded.settings),
                     .canCut = std::ranges::any_of(scene.grids, &sim::Grid::isCuttable),
                     .solvers = sim::solverNames(),
                     .fromFile = knobsOf(loaded)};
    for (const sim::Body& body : loaded.scene.bodies) {
        facts.bodies.push_back(body.name);
        const auto grid =
            std::ranges::find(loaded.scene.grids, body.firstParticle, &sim::Grid::firstParticle);
        facts.youngModuli.push_back(grid != loaded.scene.grids.end() ? youngModulusOf(*grid) : 0);
    }
    setStiffness(facts, document.stiffness());
    addProgram(facts, document.simulation().program());
    return facts;
}

Strain measureStrain(const sim::Scene& scene, StateProbe& probe) {
    if (probe.positions().empty()) return {};
    const std::span<const float> places(&probe.positions().front().x, 4 * probe.positions().size());
    const app::LinkStrain strain = app::strainOf(scene, places, probe.liveLinks());
    return {strain.rms, strain.largest};
}

std::optional<Distance> measureDistance(const StateProbe& first, const StateProbe& second) {
    double squares = 0, most = 0;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < first.positions().size(); ++i) {
        if (!first.isShown(i) || !second.isShown(i)) continue;
        const sim::layout::vec4 &a = first.positions()[i], &b = second.positions()[i];
        const double distance =
            std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
        squares += distance * distance;
        most = std::max(most, distance);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return Distance{static_cast<float>(std::sqrt(squares / static_cast<double>(count))),
                    static_cast<float>(most)};
}

Gauges::Gauges(const Document& document, double dt) : dt_(dt) {
    for (const std::string& phase : document.simulation().phases()) facts_.phases.push_back({phase, {}});
}

void Gauges::frame(double seconds, std::uint32_t steps) {
    facts_.frameMs.add(static_cast<float>(1000 * seconds));
    seconds_ += seconds;
    shown_ += steps * dt_;
    ++frames_;
    if (seconds_ < 0.5) return;
    facts_.framesPerSecond = frames_ / seconds_;
    facts_.keptPace = shown_ / seconds_;
    seconds_ = shown_ = 0;
    frames_ = 0;
}

void Gauges::stepTimed(std::span<const double> milliseconds) {
    for (std::size_t p = 0; p < std::min(facts_.phases.size(), milliseconds.size()); ++p)
        facts_.phases[p].ms.add(static_cast<float>(milliseconds[p]));
}

void Gauges::stepFinished(const sim::Status& status) {
    facts_.slowed = status.slowed;
    facts_.sleeping = status.sleeping;
    facts_.linksCut = status.linksCutInAll;
    facts_.debris = status.debris;
    facts_.debrisParticles = status.debrisParticles;
    facts_.debrisMass = status.debrisMass;
    if (status.linksCutInAll == 0) facts_.pieces = {.pieces = status.pieces};
}

Gauges::Cuts Gauges::cuts() const {
    return {facts_.pieces, facts_.linksCut, facts_.debris, facts_.debrisParticles, facts_.debrisMass};
}

void Gauges::keepCuts(const std::vector<std::uint64_t>& times) {
    std::erase_if(cutsAt_, [&](const auto& kept) { return std::ranges::count(times, kept.first) == 0; });
    for (const std::uint64_t time : times) cutsAt_.try_emplace(time, cuts());
}

void Gauges::returnTo(std::uint64_t played) {
    const auto kept = cutsAt_.lower_bound(played);
    if (kept == cutsAt_.end()) return;
    facts_.pieces = kept->second.pieces;
    facts_.linksCut = kept->second.linksCut;
    facts_.debris = kept->second.debris;
    facts_.debrisParticles = kept->second.debrisParticles;
    facts_.debrisMass = kept->second.debrisMass;
}

void Gauges::strainMeasured(const Strain& strain) {
    facts_.strainRms.add(static_cast<float>(strain.rms));
    facts_.strainMax.add(static_cast<float>(strain.largest));
}

void Gauges::restart() {
    facts_.strainRms.clear();
    facts_.strainMax.clear();
    facts_.slowed = facts_.sleeping = facts_.linksCut = 0;
    facts_.stepsRepeated = 0;
    facts_.pieces = {};
    cutsAt_.clear();
    facts_.debris = facts_.debrisParticles = 0;
    facts_.debrisMass = 0;
}

void Gauges::goOn(const Gauges& before) {
    std::vector<PhaseCurve> phases = std::move(facts_.phases);
    facts_ = before.facts_;
    cutsAt_ = before.cutsAt_;
    facts_.phases = std::move(phases);
}

Facts Gauges::facts(const Document& document) const {
    Facts facts = facts_;
    facts.steps = document.played();
    facts.time = static_cast<double>(document.played()) * dt_;
    const auto& skipped = document.simulation().program().skipped;
    if (std::ranges::find(skipped, "contacts") == skipped.end()) {
        const sim::ContactRoom& room = document.contactRoom();
        facts.contactRoom = room.room;
        facts.contactsNeeded = room.needed;
        facts.timesGrown = room.grown;
        facts.isContactRoomShort = room.needed > room.room;
    }
    return facts;
}

} // namespace sinew::viewer
