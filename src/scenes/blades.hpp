// Scripted blades: the [[blade]] and [[strokes]] tables of a scene file, and what they do in a step. A cut is
// then the same in every run, with nobody at a pointer.
#pragma once

#include "scenes/load.hpp"
#include "scenes/section.hpp"
#include "sinew/simulation.hpp"

namespace sinew::scenes {

/// Nine digits of a time and of dt leave 1e-6 of a step: so much is none.
constexpr double hairOfStep = 1e-4;

void addBlade(LoadedScene& loaded, const Section& blade);

/// The blades of a [[strokes]] table.
void addStrokes(LoadedScene& loaded, const Section& strokes);

/// Fails where blades have nothing to cut, or two of them cut in one step. After all tables are read.
void checkBlades(const LoadedScene& loaded, const Section& top);

/// The steps that a blade is on its way in.
struct BladeTurn {
    std::uint64_t first = 0, end = 0;
    std::size_t motion = 0;
};

/// Plays blades step by step. Keeps the points that a step refers to.
class ScriptedBlades {
public:
    ScriptedBlades() = default;
    ScriptedBlades(std::vector<BladeMotion> motions, float dt);

    bool areAny() const noexcept { return !motions_.empty(); }
    /// What cuts in step `frame`, counted from 0: a blade that cuts nothing where none is on its way. Good
    /// until the next call. Never allocates.
    sim::Blade at(std::uint64_t frame) noexcept;

private:
    std::vector<BladeMotion> motions_;
    std::vector<BladeTurn> turns_;
    double dt_ = 1;
    std::vector<sim::Vec3> from_, to_;
};

} // namespace sinew::scenes
