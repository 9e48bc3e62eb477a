// The study as one self-contained HTML page: no script, no network, no second file.
#pragma once

#include "sinew/study/plot.hpp"
#include "sinew/study/report.hpp"

namespace sinew::tools::study {

/// The diagram of a scene's error over one price.
Plot plotOf(const SceneResult& scene, const Price& price);

std::string toHtml(const StudyRecord& record);

} // namespace sinew::tools::study
