// One program of `sinew bench --scene clutter` with one choice of settings.
#pragma once

#include "sinew/measure.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace sinew::tools {

struct ClutterEntrant {
    std::string solver, device = "CPU, one thread";
    std::uint32_t substeps = 1, iterations = 1;
    /// Takes `count` steps and leaves the times of all steps so far in the list [ms].
    std::function<void(std::uint64_t, std::vector<double>&)> advance;
    std::function<State()> state;
    std::vector<double> stepMs;
};

/// Wraps a CPU program that has step() and balls(); times each step.
template <typename Program>
ClutterEntrant onCpu(std::string name, std::shared_ptr<Program> program, std::uint32_t substeps,
                     std::uint32_t iterations) {
    using Clock = std::chrono::steady_clock;
    ClutterEntrant entrant{.solver = std::move(name), .substeps = substeps, .iterations = iterations};
    entrant.advance = [program](std::uint64_t count, std::vector<double>& ms) {
        for (std::uint64_t i = 0; i < count; ++i) {
            const Clock::time_point start = Clock::now();
            program->step();
            ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        }
    };
    entrant.state = [program] { return State{program->balls().x, program->balls().v}; };
    return entrant;
}

} // namespace sinew::tools
