// What a study says about coming to rest: JSON, CSV, lines for a terminal, and the part of the page.
#pragma once

#include "sinew/study/plot.hpp"
#include "sinew/study/report.hpp"

#include "sinew/json.hpp"

namespace sinew::tools::study {

/// Of the largest kinetic energy of a run: below it things are said to rest.
inline constexpr double restShare = 1e-3;

Json restJson(const SceneResult& scene);
/// A line per run and sample.
std::string restCsv(const StudyRecord& record);
std::string restText(const SceneResult& scene);

/// Deepest penetration and kinetic energy over time; empty where the scene has no such run.
std::vector<Plot> restPlots(const SceneResult& scene);
/// The table; empty where the scene has none.
std::string restTable(const SceneResult& scene);

} // namespace sinew::tools::study
