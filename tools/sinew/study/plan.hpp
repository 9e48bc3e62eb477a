// The plan of a study: its scenes, and the settings to try for each solver. Every solver of the core takes
// part; the table in plan.cpp has the tunings of solvers with more parameters than substeps.
#pragma once

#include "scenes/load.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sinew::tools::study {

inline constexpr std::uint32_t mostPoints = 8;
/// Sweeps per frame at which curves start; scenes of contacts need fewer.
inline constexpr std::uint32_t fewestSweeps = 8, fewestSweepsOfContacts = 2;

struct StudyScene {
    std::string name; ///< unique in a study; also a file name
    std::uint32_t frames = 0;
    std::uint32_t points = mostPoints; ///< most sweep counts to try
    scenes::LoadedScene loaded;
    std::vector<std::string> notes = {}; ///< sentences: how it differs from its file
};

/// Whether anything in it may touch: particles, faces, planes or colliders. Its truth is then another one.
bool isOfContacts(const sim::Scene& scene);

/// `settings` with the margin and capacities of the scene's file.
sim::Settings settingsOfContacts(const StudyScene& scene, sim::Settings settings);

/// A part of the runs of each scene: one of `count` parts that together are all of them.
struct Shard {
    std::uint32_t index = 0, count = 1;
    /// Whether the run at this place of the whole plan is part of it.
    bool has(std::size_t run) const { return run % count == index; }
};
/// The part "I/N", I from 1 to N; empty if that is none.
std::optional<Shard> parseShard(const std::string& text);

inline constexpr std::uint32_t defaultFrames = 30; ///< for scenes that are not shipped

/// Names of the shipped scenes that a study of "all" runs.
std::vector<std::string> studySceneNames();

/// Scenes for "all", the name of a shipped study scene, or a scene file. Every solver gets the same problem:
/// if that allows solvers other than `split`, meshes lose their default recovery, which a note says, and
/// bodies are not cuttable, since nothing cuts in a study. `frames` overrides the length of each. Throws
/// scenes::SceneError.
std::vector<StudyScene> studyScenes(const std::string& which, std::optional<std::uint32_t> frames);

/// The curve of some settings: a solver's name. `jacobi` as published averages a particle's corrections; with
/// a weight instead it is another method, stable in fewer scenes, with a curve of its own, as `split` with
/// coarse levels has, and `split` with the clamp by the sum.
std::string curveOf(const sim::Settings& settings);
std::vector<std::string> curveNames();

/// Whether links are clamped as if all were parallel, by the sum of their stiffness (docs/clamp.md).
bool isWithSum(const sim::Settings& settings);

/// All settings with this number of sweeps per frame: every split into substeps and iterations, and every
/// tuning of the solver.
std::vector<sim::Settings> settingsAt(sim::Solver solver, std::uint32_t sweeps);

/// All of settingsAt() at `points` sweep counts from `fewest`, each twice the one before. For solvers other
/// than `jacobi` there is one count more between any two, only in substeps of one sweep.
std::vector<sim::Settings> settingsToTry(sim::Solver solver, std::uint32_t points,
                                         std::uint32_t fewest = fewestSweeps);

} // namespace sinew::tools::study
