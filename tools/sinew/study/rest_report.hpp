// Reports of runs to rest: JSON, CSV, lines for a terminal, and a part of the page.
#pragma once

#include "sinew/study/plot.hpp"
#include "sinew/study/report.hpp"

#include "sinew/json.hpp"

namespace sinew::tools::study {

/// Share of a run's largest kinetic energy below which bodies count as resting.
inline constexpr double restShare = 1e-3;

Json restJson(const SceneResult& scene);
/// One line per run and sample.
std::string restCsv(const StudyRecord& record);
std::string restText(const SceneResult& scene);

/// Plots of penetration and kinetic energy over time; empty without such runs.
std::vector<Plot> restPlots(const SceneResult& scene);
/// The table; empty without such runs.
std::string restTable(const SceneResult& scene);

} // namespace sinew::tools::study
