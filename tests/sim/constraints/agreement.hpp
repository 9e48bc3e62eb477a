// Compares steps on the device with the same steps in double.
#pragma once

#include "sim/reference/reference.hpp"
#include "sim/runner.hpp"

#include <vector>

namespace sinew::test {

/// Makes a step of the settings' solver in double (reference R3). `gauss_seidel` has a cold start.
void stepReference(const sim::Scene& scene, const sim::Settings& settings, float dt,
                   sim::reference::State& state);

/// Largest difference of positions, and of velocities times `dt`, relative to the scene's size; infinite if
/// the device's state is not finite.
double differenceOf(const Runner& runner, const sim::reference::State& state, const sim::Scene& scene,
                    float dt);

/// Largest difference of positions, and of velocities times dt, relative to the scene's size; infinite if the
/// state is not finite. Each entry of `targets` is one step, with one target for each attachment.
double differenceFromDouble(const sim::Scene& scene, const sim::Settings& settings,
                            const std::vector<std::vector<sim::Vec3>>& targets = {{}});

/// Expects one step within 1e-5 of double and equal bits in reversed invocation order, for several settings.
void expectAgreement(const sim::Scene& scene, sim::Solver solver,
                     const std::vector<std::vector<sim::Vec3>>& targets = {{}});

} // namespace sinew::test
