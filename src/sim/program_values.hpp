// What two programs of one shape differ in: numbers in buffers and push constants. A scene whose material is
// turned compiles to such a program, mostly; the executor then takes over the numbers and nothing is built.
#pragma once

#include "sim/program.hpp"

#include <optional>

namespace sinew::sim {

/// The numbers of the other program, where they are not those of the first.
struct ProgramValues {
    struct Contents {
        BufferId buffer;
        std::vector<std::byte> initial; ///< as BufferSpec::initial
        bool isOfState = false; ///< steps write it, and StepProgram::settle what of it follows from the scene
    };
    struct Push {
        std::size_t pass = 0; ///< of the list
        std::vector<std::byte> bytes;
    };
    std::vector<Contents> buffers;
    std::vector<Push> step, skin, wholeSkin, mixedSkin, settle;
};

/// Nothing where `to` has other buffers, kernels or passes than `from`, or begins with another state: only a
/// simulation of its own makes steps of it.
std::optional<ProgramValues> valuesOf(const StepProgram& from, const StepProgram& to);

/// Puts them into `program`, which they were made from: what it begins with and pushes from now on.
void take(StepProgram& program, ProgramValues values) noexcept;

/// A change leaves the state where it is. Throws std::invalid_argument where `to` begins with other particles
/// than `from`.
void requireSameParticles(const StepProgram& from, const StepProgram& to);

/// All that passes of a step write: the state between steps is among it.
std::vector<BufferId> writtenByStep(const StepProgram& program);

/// By buffer: whether passes of a step, of the skins or of settling write it.
std::vector<bool> areWritten(const StepProgram& program);

} // namespace sinew::sim
