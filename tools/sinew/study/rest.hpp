// Runs of contact scenes beyond the frames that can be compared: overlap and motion as bodies come to rest.
#pragma once

#include "sinew/study/store.hpp"

namespace sinew::tools::study {

/// length of such a run / length of the compared motion
inline constexpr std::uint32_t restLength = 8;

/// Settings for every solver that supports the scene: substeps of one sweep, with default tunings.
std::vector<sim::Settings> restSettings(const StudyScene& scene);

/// Runs what is not stored. After an interruption some runs are missing.
std::vector<RestRun> studyRest(Session& session, const StudyScene& scene, const Store& store,
                               const Shard& shard = {});

/// Largest penetration over the samples from `from` [s] on; empty without such a figure, or if the run
/// diverged.
std::optional<double> deepest(const RestRun& run, double from = 0);

/// The first time after which the kinetic energy stays below `share` of its largest value [s]; empty if there
/// is none.
std::optional<double> timeToRest(const RestRun& run, double share);

} // namespace sinew::tools::study
