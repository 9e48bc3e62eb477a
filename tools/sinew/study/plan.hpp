// What a study runs: its scenes, and the settings tried for each solver. Every solver of the core takes part;
// one that is tuned by more than its substeps has its tunings in the table of plan.cpp.
#pragma once

#include "scenes/load.hpp"

#include <string>
#include <vector>

namespace sinew::tools::study {

inline constexpr std::uint32_t mostPoints = 8;
/// Sweeps of a frame that curves start with; of contacts, which bear fewer, another.
inline constexpr std::uint32_t fewestSweeps = 8, fewestSweepsOfContacts = 2;

struct StudyScene {
    std::string name; ///< unique in a study; a file name too
    std::uint32_t frames = 0;
    std::uint32_t points = mostPoints; ///< sweep counts it is worth, at most
    scenes::LoadedScene loaded;
    std::vector<std::string> notes = {}; ///< sentences: how it differs from its file
};

/// Whether anything in it may touch: particles, faces, planes or colliders. Its true motion is another then.
bool isOfContacts(const sim::Scene& scene);

/// With the margin and the room that the scene's file says.
sim::Settings settingsOfContacts(const StudyScene& scene, sim::Settings settings);

inline constexpr std::uint32_t defaultFrames = 30; ///< of a scene that is not one of ours

/// Names of the shipped scenes that a study of "all" runs.
std::vector<std::string> studySceneNames();

/// "all", the name of a shipped study scene, or a scene file. Every solver gets the same problem: where that
/// lets others than `split` take part, meshes go without the recovery that they have by default, which a note
/// says, and bodies that may be cut are whole, since nothing cuts in a study. `frames` overrides the length
/// of each. Throws scenes::SceneError.
std::vector<StudyScene> studyScenes(const std::string& which, std::optional<std::uint32_t> frames);

/// On which curve settings stand: a solver's name; `jacobi` as published averages a particle's corrections,
/// and with a weight instead it is another method, stable in fewer scenes.
std::string curveOf(const sim::Settings& settings);
std::vector<std::string> curveNames();

/// One number of sweeps a frame in every split into substeps and iterations and with every tuning of the
/// solver.
std::vector<sim::Settings> settingsAt(sim::Solver solver, std::uint32_t sweeps);

/// All of settingsAt() at `points` sweep counts from `fewest`, each twice the one before. But for `jacobi`
/// there is one count more between any two, in substeps of one sweep alone.
std::vector<sim::Settings> settingsToTry(sim::Solver solver, std::uint32_t points,
                                         std::uint32_t fewest = fewestSweeps);

} // namespace sinew::tools::study
