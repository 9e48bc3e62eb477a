// Two tables: scenes and tunings.
#include "sinew/study/plan.hpp"

#include "scenes/recovery.hpp"
#include "sim/compile/compile.hpp"
#include "sim/model/touching.hpp"
#include "sinew/outputs.hpp"
#include "sinew/ranges.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sinew::tools::study {

namespace {

struct Shipped {
    const char* name;
    std::uint32_t frames; // of 1/60 s each
    std::uint32_t points = mostPoints;
};
// For scenes of contacts, enough frames to include the first contacts; their trials end well beyond an error
// of 1 %. Excludes cloth_links_on_sphere: it creases at the first touch, after which a disturbance of 1e-7
// grows to 1e-3 within a frame.
constexpr Shipped shipped[] = {{"beam", 18},     {"beam_stiff", 18}, {"cloth_study", 30},
                               {"chain", 30},    {"cube_load", 30},  {"clutter", 30, 6},
                               {"stack", 30, 7}, {"incline", 30, 6}, {"cube", 30, 5}};

constexpr std::uint32_t wholeFrame = 0; // all sweeps of a frame in one substep

using Variation = void (*)(sim::Settings&);

struct Tuning {
    const char* solver;
    std::vector<std::uint32_t> iterations; // per substep
    std::vector<Variation> variations;
    bool isFine; // also uses sweep counts between the powers of two
};

const Tuning& tuningOf(const std::string& solver) {
    static const Tuning tunings[] = {
        // The baseline gets a search of all its tunings: claims against it must not rest on a bad choice. A
        // weight replaces the average; 1 applies the sum, which is best for elastic links wherever it is
        // stable.
        {"jacobi",
         {1, 4, 16, wholeFrame},
         {[](sim::Settings& s) { s.overRelaxation = 1; }, [](sim::Settings& s) { s.overRelaxation = 1.3f; },
          [](sim::Settings& s) { s.overRelaxation = 1.6f; }, [](sim::Settings& s) { s.weight = 0.5f; },
          [](sim::Settings& s) { s.weight = 1; }},
         false},
        {"split",
         {1},
         {[](sim::Settings&) {}, [](sim::Settings& s) { s.theta = 0; },
          [](sim::Settings& s) { s.levels = 1; }, [](sim::Settings& s) { s.levels = 3; },
          [](sim::Settings& s) { s.hasSharpClamp = false; }},
         true},
        {"gauss_seidel",
         {1, 2, 4, wholeFrame},
         {[](sim::Settings&) {}, [](sim::Settings& s) { s.warmStart = 0; }},
         true},
    };
    static const Tuning plain{"", {1}, {[](sim::Settings&) {}}, true};
    const auto found = std::ranges::find(tunings, solver, &Tuning::solver);
    return found == std::end(tunings) ? plain : *found;
}

struct SweepCount {
    std::uint32_t sweeps;
    bool isBetween; // between two powers of two
};

/// `fewest`, doubled again and again. With `isFine`, one count more between any two: errors may fall by a
/// factor of a thousand from one to the next.
std::vector<SweepCount> sweepCounts(std::uint32_t points, std::uint32_t fewest, bool isFine) {
    const auto mostSubsteps = static_cast<std::uint32_t>(sim::ranges::substeps.high);
    std::vector<SweepCount> counts;
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::uint32_t sweeps = fewest << i;
        if (isFine && i > 0)
            counts.push_back({static_cast<std::uint32_t>(std::lround(sweeps / std::sqrt(2.0))), true});
        counts.push_back({std::min(sweeps, mostSubsteps), false});
    }
    return counts;
}

constexpr const char* weighted = "jacobi_weighted";
constexpr const char* withLevels = "split_levels";
constexpr const char* withSum = "split_sum";

std::string withName(const std::string& names, const std::string& name) {
    return names + (names.empty() ? "\"" : ", \"") + name + "\"";
}

/// See studyScenes().
StudyScene forEverySolver(StudyScene study) {
    const sim::Settings other = settingsOfContacts(study, {.solver = sim::Solver::jacobi, .substeps = 1});
    const scenes::Defaults& defaults = study.loaded.defaults;
    sim::Scene common = scenes::withoutDefaults(study.loaded.scene, defaults, other);
    for (sim::Grid& grid : common.grids)
        if (grid.tearStrain == 0) {
            grid.isCuttable = false;
            grid.toughness = 0;
        }
    std::string names, untouched;
    for (const std::uint32_t body : defaults.contacts)
        untouched = withName(untouched, common.bodies[body].name);
    if (!sim::validate(common, other).empty()) return study; // another feature requires split
    for (const std::uint32_t grid : defaults.recovery) names = withName(names, common.grids[grid].name);
    if (!names.empty())
        study.notes.push_back("studied without the recovery that " + names +
                              " would have by default: jacobi and gauss_seidel do not support it");
    if (!untouched.empty())
        study.notes.push_back("studied without the contacts that " + untouched +
                              " would have by default: jacobi and gauss_seidel have none");
    study.loaded.scene = std::move(common);
    return study;
}

} // namespace

bool isWithSum(const sim::Settings& settings) {
    return settings.solver == sim::Solver::split && settings.levels == 0 && !settings.hasSharpClamp;
}

std::string curveOf(const sim::Settings& settings) {
    if (settings.solver == sim::Solver::jacobi && settings.weight > 0) return weighted;
    if (settings.solver == sim::Solver::split && settings.levels > 0) return withLevels;
    if (isWithSum(settings)) return withSum;
    return sim::solverName(settings.solver);
}

std::vector<std::string> curveNames() {
    std::vector<std::string> names = sim::solverNames();
    names.emplace_back(weighted);
    names.emplace_back(withLevels);
    names.emplace_back(withSum);
    return names;
}

std::optional<Shard> parseShard(const std::string& text) {
    const char* const end = text.data() + text.size();
    Shard shard;
    const auto [slash, first] = std::from_chars(text.data(), end, shard.index);
    if (first != std::errc{} || slash == end || *slash != '/') return {};
    const auto [last, second] = std::from_chars(slash + 1, end, shard.count);
    if (second != std::errc{} || last != end || shard.index < 1 || shard.index > shard.count) return {};
    --shard.index;
    return shard;
}

std::vector<std::string> studySceneNames() {
    std::vector<std::string> names;
    for (const Shipped& scene : shipped) names.emplace_back(scene.name);
    return names;
}

std::vector<StudyScene> studyScenes(const std::string& which, std::optional<std::uint32_t> frames) {
    std::vector<StudyScene> scenes;
    for (const Shipped& scene : shipped)
        if (which == "all" || which == scene.name)
            scenes.push_back(forEverySolver(
                {scene.name, frames.value_or(scene.frames), scene.points, scenes::loadBuiltIn(scene.name)}));
    if (!scenes.empty()) return scenes;
    scenes::LoadedScene loaded = scenes::load(which);
    const std::string name = fileName(loaded.scene.name);
    scenes.push_back(forEverySolver({name, frames.value_or(defaultFrames), mostPoints, std::move(loaded)}));
    return scenes;
}

bool isOfContacts(const sim::Scene& scene) {
    return !scene.planes.empty() || !scene.colliders.empty() || !scene.faces.empty() ||
           sim::particlesTouch(scene);
}

sim::Settings settingsOfContacts(const StudyScene& scene, sim::Settings settings) {
    settings.contactMargin = scene.loaded.settings.contactMargin;
    settings.contactRoom = scene.loaded.settings.contactRoom;
    return settings;
}

std::vector<sim::Settings> settingsAt(sim::Solver solver, std::uint32_t sweeps) {
    const Tuning& tuning = tuningOf(sim::solverName(solver));
    std::vector<sim::Settings> list;
    for (const std::uint32_t iterations : tuning.iterations) {
        if (iterations > 1 && iterations >= sweeps) continue; // one substep per frame, tried anyway
        for (const Variation vary : tuning.variations) {
            sim::Settings settings{.solver = solver, .hasSharpClamp = solver == sim::Solver::split};
            settings.iterations = iterations == wholeFrame ? sweeps : iterations;
            settings.substeps = sweeps / settings.iterations;
            vary(settings);
            list.push_back(settings);
        }
    }
    return list;
}

std::vector<sim::Settings> settingsToTry(sim::Solver solver, std::uint32_t points, std::uint32_t fewest) {
    std::vector<sim::Settings> list;
    for (const SweepCount& count : sweepCounts(points, fewest, tuningOf(sim::solverName(solver)).isFine))
        for (const sim::Settings& settings : settingsAt(solver, count.sweeps))
            if (!count.isBetween || settings.iterations == 1) list.push_back(settings);
    return list;
}

} // namespace sinew::tools::study
