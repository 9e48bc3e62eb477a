// Attachments on the device: one pass after the links of a substep, the same for every solver. A scene
// without attachments has no such pass.
#pragma once

#include "common/layout.h"
#include "sim/model/feature.hpp"

#include <algorithm>

namespace sinew::sim::constraints::attachment {

struct Attachments {
    std::uint32_t count = 0;
    BufferId particles, anchors;
};

/// Keeps Attachments, and appends the passes that write the anchors of a step.
void add(Build& build);
/// Appends the pass of a substep.
void addPass(Build& build, const Substep& substep);

/// The moving points of attachments on the host: contents of the anchors buffer of a step.
class Anchors {
public:
    explicit Anchors(const std::vector<Attachment>& attachments);

    /// Resets the points to their positions in the scene.
    void reset() noexcept;
    /// Moves the points from their last positions towards `targets` (one an attachment; the others stay),
    /// limited by their speed within `dt` [s]. A target that is not finite is ignored. Never allocates.
    void advance(std::span<const Vec3> targets, float dt) noexcept;
    /// Positions of the points.
    std::vector<Vec3> places() const;
    /// Sets the points, one an attachment, without motion.
    void moveTo(std::span<const Vec3> places) noexcept;
    /// Restores earlier values().
    void restore(std::span<const layout::vec4> values) noexcept {
        std::copy(values.begin(), values.end(), values_.begin());
    }
    /// Continues the points of `other`; `origins` by attachment: its index there, or NO_ELEMENT.
    void carry(const Anchors& other, std::span<const std::uint32_t> origins) noexcept {
        for (std::size_t a = 0; a < origins.size(); ++a)
            if (origins[a] != NO_ELEMENT)
                for (std::size_t end = 0; end < 2; ++end)
                    values_[2 * a + end] = other.values_[2 * origins[a] + end];
    }
    std::size_t count() const noexcept { return attachments_.size(); }
    /// Start and end of the point of every attachment.
    std::span<const layout::vec4> values() const noexcept { return values_; }

private:
    std::vector<Attachment> attachments_;
    std::vector<layout::vec4> values_;
};

} // namespace sinew::sim::constraints::attachment
