// Weights and slot lists of the particle pass.
#include "sim/constraints/correction_slots.hpp"

namespace sinew::sim::constraints {

std::vector<float> CorrectionSlots::weights(const Settings& settings) const {
    std::vector<float> result;
    result.reserve(counts_.size());
    for (const std::uint32_t count : counts_) {
        const float average = count > 0 ? 1 / static_cast<float>(count) : 0;
        result.push_back(settings.overRelaxation * (settings.weight > 0 ? settings.weight : average));
    }
    return result;
}

CorrectionSlots::Lists CorrectionSlots::lists(const std::vector<float>& weights) const {
    Lists result;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        result.incidences.push_back({first, 0, weights[i]});
        first += counts_[i];
    }
    result.slots.resize(owners_.size());
    for (std::uint32_t slot = 0; slot < owners_.size(); ++slot) {
        layout::Incidence& incidence = result.incidences[owners_[slot]];
        result.slots[incidence.first + incidence.count++] = slot;
    }
    return result;
}

} // namespace sinew::sim::constraints
