// Differences between two programs of equal structure: numbers in buffers and push constants. A scene with
// changed material usually compiles to such a program; the executor then takes the numbers over and builds
// nothing.
#pragma once

#include "sim/program/program.hpp"

#include <optional>

namespace sinew::sim {

/// Values of the second program that differ from those of the first.
struct ProgramValues {
    struct Contents {
        BufferId buffer;
        std::vector<std::byte> initial; ///< as BufferSpec::initial
        bool isOfState = false;         ///< steps write it; `refresh` recomputes what follows from the scene
    };
    struct Push {
        List list = List::step;
        std::size_t pass = 0; ///< index in the list
        std::vector<std::byte> bytes;
    };
    std::vector<Contents> buffers;
    std::vector<Push> pushes;
};

/// The differences from `from` to `to`. Empty if the programs have different buffers, kernels or passes, or
/// start in different states: then only a new simulation can run `to`.
std::optional<ProgramValues> valuesOf(const StepProgram& from, const StepProgram& to);

/// Puts the differences into the first program, `program`: initial contents and push constants.
void take(StepProgram& program, ProgramValues values) noexcept;

/// Throws std::invalid_argument if `to` starts with other particles than `from`: a change of material keeps
/// the state.
void requireSameParticles(const StepProgram& from, const StepProgram& to);

/// All buffers that passes of a step write, without StepProgram::ofStep; these contain the state between
/// steps.
std::vector<BufferId> writtenByStep(const StepProgram& program);

/// By buffer: whether passes of any list write it.
std::vector<bool> areWritten(const StepProgram& program);

} // namespace sinew::sim
