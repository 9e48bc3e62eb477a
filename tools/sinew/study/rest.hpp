// What a scene of contacts does after the time in which its motion can be compared: how deep things are in
// each other, and how much still moves, as they come to rest.
#pragma once

#include "sinew/study/store.hpp"

namespace sinew::tools::study {

/// A rest is as many times longer than the motion that is compared with the truth.
inline constexpr std::uint32_t restLength = 8;

/// Of every solver that can do the scene: substeps of one sweep, with its default tunings.
std::vector<sim::Settings> restSettings(const StudyScene& scene);

/// Runs what is not kept. After an interruption the rest is missing.
std::vector<RestRun> studyRest(Session& session, const StudyScene& scene, const Store& store);

/// Over the samples from `from` [s] on; empty where they have no such figure, or the run diverged.
std::optional<double> deepest(const RestRun& run, double from = 0);

/// The first time after which the kinetic energy stays below that share of its largest value [s]; empty where
/// it never does.
std::optional<double> timeToRest(const RestRun& run, double share);

} // namespace sinew::tools::study
