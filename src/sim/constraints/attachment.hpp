// Attachments on the device: one pass after the links of a substep, the same for every solver. A scene
// without them has no such pass.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <algorithm>

namespace sinew::sim::constraints::attachment {

struct Attachments {
    std::uint32_t count = 0;
    BufferId particles, anchors;
};

/// Adds the passes that write the anchors of a step, too: call it once, before the substeps.
Attachments add(ProgramBuilder& program, const Scene& scene, const StateLayout& layout);

/// `substep` counts from 0.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Attachments& attachments,
             std::uint32_t substep, std::uint32_t substeps);
/// The same in a substep of `gauss_seidel`, which is still open: what moves are the `corrections`.
void addOpenPass(ProgramBuilder& program, const ParticleBuffers& particles, BufferId corrections,
                 const Attachments& attachments, std::uint32_t substep, std::uint32_t substeps);

/// Where the points go, on the host: what the anchors buffer of a step holds.
class Anchors {
public:
    explicit Anchors(const std::vector<Attachment>& attachments);

    /// Back to the places of the scene.
    void reset() noexcept;
    /// The points start where they ended and go towards `targets` (one an attachment; others stay) as fast as
    /// they may within `dt` [s]. A target that is not finite is none. Never allocates.
    void advance(std::span<const Vec3> targets, float dt) noexcept;
    /// Where the points are.
    std::vector<Vec3> places() const;
    /// One an attachment; at once.
    void moveTo(std::span<const Vec3> places) noexcept;
    /// Puts back values() of another time.
    void restore(std::span<const layout::vec4> values) noexcept {
        std::copy(values.begin(), values.end(), values_.begin());
    }
    std::size_t count() const noexcept { return attachments_.size(); }
    /// From and to of every attachment.
    std::span<const layout::vec4> values() const noexcept { return values_; }

private:
    std::vector<Attachment> attachments_;
    std::vector<layout::vec4> values_;
};

} // namespace sinew::sim::constraints::attachment
