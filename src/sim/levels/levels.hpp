// Coarse levels of `split` (blocks.hpp): the passes that place the blocks of all bodies on grids and compute
// their kicks at the start of a substep. The gathers add the kick of its block to each particle. Level 1 has
// passes of its own; one work group a body solves the levels above.
#pragma once

#include "sim/core/complaints.hpp"
#include "sim/model/feature.hpp"
#include "sim/stiffness/shares.hpp"

#include <optional>

namespace sinew::sim::levels {

/// The buffers of all levels.
class Levels {
public:
    /// Appends the passes to a substep that starts with `particles`.
    void addPasses(ProgramBuilder& program, const ParticleBuffers& particles, bool isFirst) const;

    /// By slot: its block of level 1, and its share of the kick.
    BufferId blockOf() const { return blockOf_; }
    /// By block [m/s].
    BufferId kicks() const { return kicks_; }

private:
    friend std::optional<Levels> add(Build& build, const stiffness::Shares& shares);
    std::uint32_t blocks_ = 0; // of level 1
    std::uint32_t bodies_ = 0, levels_ = 0;
    BufferId blockOf_, ranges_, info_, children_, links_, positions_, kicks_;
};

/// Complains if Settings::levels is out of range, or if `split` cannot have levels in this scene.
void check(const Scene& scene, const Settings& settings, Complaints& complaints);

/// Uploads the levels of a scene; nothing if it has none: Settings::levels is 0, or no link lacks stiffness.
/// Call it after cutting::addOpening, before the substeps: block links that cuts disable are found here.
std::optional<Levels> add(Build& build, const stiffness::Shares& shares);
/// Appends the search for these block links again, after links of bodies were restored.
void addCuts(Build& build);

} // namespace sinew::sim::levels
