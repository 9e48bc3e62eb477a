// One step on the device against the same step in double, for scenes with constraints beyond links.
#pragma once

#include "sim/scene.hpp"

#include <vector>

namespace sinew::test {

/// The largest difference of positions (and of velocities times a frame) after steps of the scene's dt, one
/// for each list of targets of its attachments, relative to the scene's size; infinite where the state is not
/// finite.
double differenceFromDouble(const sim::Scene& scene, const sim::Settings& settings,
                            const std::vector<std::vector<sim::Vec3>>& targets = {{}});

/// Expects one step within 1e-5 of double, and equal bits in reversed invocation order, at several settings.
void expectAgreement(const sim::Scene& scene, sim::Solver solver,
                     const std::vector<std::vector<sim::Vec3>>& targets = {{}});

} // namespace sinew::test
