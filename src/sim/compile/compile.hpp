// Scene + Settings -> StepProgram. compile.cpp lists the features of a step, one line each.
#pragma once

#include "sim/model/state.hpp"
#include "sim/program/program.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/scene.hpp"
#include "sinew/solver_names.hpp"

namespace sinew::sim {

/// Compiles a valid scene (validate() returned nothing). Forms that the settings leave open are those of a
/// software device. Throws std::invalid_argument for invalid settings, and std::logic_error for an internal
/// error.
StepProgram compile(const Scene& scene, const Settings& settings);

/// Order of the particles in the solver of `settings`, in any program compiled from both.
StateLayout stateLayout(const Scene& scene, const Settings& settings);

} // namespace sinew::sim
