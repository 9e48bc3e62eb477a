// What layers are drawn from, of one simulation: made when a layer is first on, so that what nobody looks at
// costs nothing.
#pragma once

#include "viewer/draw/balls.hpp"
#include "viewer/draw/contact_marks.hpp"
#include "viewer/draw/link_lines.hpp"
#include "viewer/draw/value_maps.hpp"

#include <memory>
#include <optional>

namespace sinew::viewer {

class Stage;

/// Must not outlive its Device, which must not move, nor the stage, nor the simulation that this has now.
class Inspection {
public:
    /// Makes nothing yet. `slots` pictures may be under way at a time.
    Inspection(const vk::Device& device, const Stage& stage, std::uint32_t slots);

    /// Makes what `layers` need and is not there yet. Throws vk::Error.
    void prepare(const Layers& layers);

    /// Their kernels, of the state that recordSkin() was recorded for, where they have some. `layers` must be
    /// prepared. `slot` < slots; what was recorded into it must have finished.
    void record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept;

    /// How the values of a map spread, of a slot with one that has finished.
    MapReading reading(std::uint32_t slot) const noexcept { return values_->reading(slot); }

    /// How many places where bodies touch were found, likewise.
    std::uint32_t contacts(std::uint32_t slot) const noexcept { return contacts_->found(slot); }

    /// Of prepared layers with links.
    LinkFacts links() const { return links_->facts(); }

    /// For a picture with prepared `layers`, a map's colors up to `range`.
    LayerBuffers buffers(const Layers& layers, float range) const noexcept;

private:
    const vk::Device& device_;
    const Stage& stage_;
    std::uint32_t slots_;
    std::optional<ValueMaps> values_;
    std::unique_ptr<const Balls> balls_; // pictures refer to it
    std::unique_ptr<const LinkLines> links_;
    std::unique_ptr<const ContactMarks> contacts_;
};

/// The range of a map's colors from picture to picture: up at once, down to what was read last where a dozen
/// readings in a row are below. It is a quantile of 99 % already: in a blow the bulk of a body has its peak,
/// which no other quantile would leave out, but which must not darken the seconds that follow.
class MapRange {
public:
    void read(const MapReading& reading);
    float range() const { return newest_.range > 0 ? range_ : 0; }
    const MapReading& newest() const { return newest_; }

private:
    static constexpr int patience = 12; // pictures: a fraction of a second, and no flicker
    MapReading newest_;
    float range_ = 0, below_ = 0; // below_: largest of those readings
    int count_ = 0;               // of them
};

} // namespace sinew::viewer
