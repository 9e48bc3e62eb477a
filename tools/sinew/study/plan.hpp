// What a study runs: its scenes, and the settings tried for each solver. Every solver of the core takes part;
// one that is tuned by more than its substeps has its tunings in the table of plan.cpp.
#pragma once

#include "scenes/load.hpp"

#include <string>
#include <vector>

namespace sinew::tools::study {

struct StudyScene {
    std::string name; ///< unique in a study; a file name too
    std::uint32_t frames = 0;
    scenes::LoadedScene loaded;
};

inline constexpr std::uint32_t mostPoints = 8;
inline constexpr std::uint32_t defaultFrames = 30; ///< of a scene that is not one of ours

/// Names of the shipped scenes that a study of "all" runs.
std::vector<std::string> studySceneNames();

/// "all", the name of a shipped study scene, or a scene file. `frames` overrides the length of each. Throws
/// scenes::SceneError.
std::vector<StudyScene> studyScenes(const std::string& which, std::optional<std::uint32_t> frames);

/// On which curve settings stand: a solver's name; `jacobi` as published averages a particle's corrections,
/// and with a weight instead it is another method, stable in fewer scenes.
std::string curveOf(const sim::Settings& settings);
std::vector<std::string> curveNames();

/// One number of sweeps a frame in every split into substeps and iterations and with every tuning of the
/// solver.
std::vector<sim::Settings> settingsAt(sim::Solver solver, std::uint32_t sweeps);

/// All of settingsAt() at `points` sweep counts from 8, each twice the one before. But for `jacobi` there is
/// one count more between any two, in substeps of one sweep alone.
std::vector<sim::Settings> settingsToTry(sim::Solver solver, std::uint32_t points);

} // namespace sinew::tools::study
