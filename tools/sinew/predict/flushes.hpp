// Flushes of the barriers of a step on two drivers, by their public rules: no figure is measured.
#pragma once

#include "sim/program/program.hpp"

#include <span>
#include <string>

namespace sinew::tools {

/// The work of a driver at a barrier that orders this.
struct Flush {
    const char* name;
    bool (*isDone)(const vk::BarrierScope&);
};

/// Mesa's rules for a global memory barrier, of RADV for GPUs of AMD up to GFX10.3, and of ANV for those of
/// Intel from Tiger Lake on (docs/performance/drivers.md, "Barriers", has the sources).
std::span<const Flush> radvFlushes();
std::span<const Flush> anvFlushes();

/// Barriers of a recording of the step, and what they do in all.
struct FlushCount {
    std::size_t barriers = 0, afterTransfers = 0, beforeTransfers = 0, beforeArguments = 0;
    std::size_t radv = 0, anv = 0;
};
FlushCount countFlushes(const sim::StepProgram& program, sim::Recording recording);

/// The barriers of a step by the pass that they precede, and by driver what they do how often, as a table.
std::string flushText(const sim::StepProgram& program);

} // namespace sinew::tools
