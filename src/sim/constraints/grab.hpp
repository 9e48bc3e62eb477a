// Hands that hold and pull, on the device: temporary constraints that the host asks for step by step. A step
// in which a hand takes hold or lets go finds out what is held (open_grabs, hold_particles, the second for no
// groups otherwise); a pass after the links of a substep pulls it (pull_held, for as many as are held), the
// same for every solver. A program without hands (Settings::grabs) has none of it.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"
#include "sim/simulation.hpp"

#include <array>

namespace sinew::sim::constraints::grab {

struct Grabs {
    layout::GrabPush push{};
    BufferId hands, states, bodies, grips, held, holding, pulling;
};

/// Adds what opens a step: call it before the substeps. None without Settings::grabs.
std::shared_ptr<Grabs> add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                           const StateLayout& layout);

/// Pulls at the end of a substep, counted from 0. Nothing where particles.grabs is none.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, std::uint32_t substep,
             std::uint32_t substeps, Kick kick);
/// The same in a substep of `gauss_seidel`, which is still open: what moves are the `corrections`.
void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 std::uint32_t substep, std::uint32_t substeps);

/// What the hands buffer of a step holds, on the host.
class Hands {
public:
    /// `count` of them, for a scene of that many particles.
    Hands(std::uint32_t count, std::size_t particles) : count_(count), particles_(particles) {}

    /// Those of another time. A grab that begins later differs from all that there ever were.
    void restore(const Hands& before) noexcept { hands_ = before.hands_; }
    /// All let go.
    void reset() noexcept { hands_ = {}; }
    /// A step of `dt` [s].
    void advance(std::span<const Grab> grabs, float dt) noexcept;
    bool areFree() const noexcept; ///< none holds anything
    std::span<const layout::GrabHand> values() const noexcept { return std::span(hands_).first(count_); }

private:
    std::uint32_t count_;
    std::size_t particles_;
    std::uint32_t serial_ = 0; // of the newest grab
    std::array<layout::GrabHand, GRAB_HANDS> hands_{};
};

} // namespace sinew::sim::constraints::grab
