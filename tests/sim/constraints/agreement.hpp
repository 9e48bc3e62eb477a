// Steps on the device against the same steps in double.
#pragma once

#include "sim/reference/reference.hpp"
#include "sim/runner.hpp"

#include <vector>

namespace sinew::test {

/// A step of the settings' solver in double (reference R3). `gauss_seidel` starts it cold.
void stepReference(const sim::Scene& scene, const sim::Settings& settings, float dt,
                   sim::reference::State& state);

/// The largest difference of positions, and of velocities times `dt`, relative to the scene's size; infinite
/// where the device's state is not finite.
double differenceOf(const Runner& runner, const sim::reference::State& state, const sim::Scene& scene,
                    float dt);

/// The largest difference of positions (and of velocities times a frame) after steps of the scene's dt, one
/// for each list of targets of its attachments, relative to the scene's size; infinite where the state is not
/// finite.
double differenceFromDouble(const sim::Scene& scene, const sim::Settings& settings,
                            const std::vector<std::vector<sim::Vec3>>& targets = {{}});

/// Expects one step within 1e-5 of double, and equal bits in reversed invocation order, at several settings.
void expectAgreement(const sim::Scene& scene, sim::Solver solver,
                     const std::vector<std::vector<sim::Vec3>>& targets = {{}});

} // namespace sinew::test
