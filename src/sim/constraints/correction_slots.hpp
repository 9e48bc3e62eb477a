// The layout of the correction buffer of `jacobi`: every end of a constraint owns one slot, every particle
// has the list of its slots.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"

#include <cstdint>
#include <vector>

namespace sinew::sim::constraints {

/// Filled by one constraint type after another, then converted to the lists of the particle pass.
class CorrectionSlots {
public:
    explicit CorrectionSlots(std::size_t particles) : counts_(particles, 0) {}

    /// Assigns the next slot to `particle`.
    void add(std::uint32_t particle) {
        owners_.push_back(particle);
        ++counts_[particle];
    }
    std::uint32_t size() const { return static_cast<std::uint32_t>(owners_.size()); }

    /// The factor of each particle's sum: over-relaxation x (1 / count, or the constant weight).
    std::vector<float> weights(const Settings& settings) const;

    /// Slots by particle, in ascending order.
    struct Lists {
        std::vector<layout::Incidence> incidences;
        std::vector<std::uint32_t> slots;
    };
    Lists lists(const std::vector<float>& weights) const;

private:
    std::vector<std::uint32_t> owners_, counts_;
};

} // namespace sinew::sim::constraints
