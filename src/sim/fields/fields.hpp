// Force fields of the host: the passes that kick particles, and the fields of a step as the device reads
// them. A step without a field runs none of these passes; one without wind measures no areas.
#pragma once

#include "sim/model/feature.hpp"
#include "sinew/step.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace sinew::sim::fields {

/// Adds the buffers, and the pass at the start of a step that measures surfaces. Nothing unless
/// Settings::fields; the functions below then add nothing either.
void add(Build& build);
/// Appends the kick at the start of a substep of `split` or `jacobi`.
void addPass(Build& build, const Substep& substep);
/// Appends the kick at the end of a substep of `gauss_seidel`.
void addOpenPass(Build& build, const Substep& substep);

/// The fields of the newest step.
class FieldRequests {
public:
    /// For at most `count` fields in a scene of `bodies` bodies; the passes have so many groups.
    FieldRequests(std::uint32_t count, std::size_t bodies, FieldGroups groups)
        : count_(count), bodies_(bodies), groups_(groups) {}

    void reset() noexcept { requests_ = {}; }
    /// Advances by a step.
    void advance(std::span<const ForceField> fields) noexcept;
    /// A hash of the fields, as a number that is 0 without any. Bodies that sleep wake where it changes.
    float key() const noexcept;
    /// The largest acceleration of a particle, without wind [m/s^2].
    float acceleration() const noexcept;
    std::span<const layout::FieldRequest> values() const noexcept {
        return std::span(requests_).first(count_);
    }
    /// Dispatch arguments of the passes: 0 groups if no field needs them.
    std::span<const layout::DispatchArguments> arguments() const noexcept {
        return std::span(arguments_).first(count_ > 0 ? FIELD_ARGUMENTS : 0);
    }

private:
    std::uint32_t count_;
    std::size_t bodies_;
    FieldGroups groups_;
    std::array<layout::FieldRequest, MOST_FIELDS> requests_{};
    std::array<layout::DispatchArguments, FIELD_ARGUMENTS> arguments_{};
};

} // namespace sinew::sim::fields
