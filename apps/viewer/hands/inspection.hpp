// What layers are drawn from, of the stage's simulation: made when a layer is first on, so that what nobody
// looks at costs nothing.
#pragma once

#include "viewer/draw/balls.hpp"
#include "viewer/draw/contact_marks.hpp"
#include "viewer/draw/hash_cells.hpp"
#include "viewer/draw/link_lines.hpp"
#include "viewer/draw/value_maps.hpp"

#include <memory>
#include <optional>

namespace sinew::viewer {

class Stage;

/// What is looked at: layers, and whether contacts of a particle under the pointer are counted.
struct Watched {
    Layers layers;
    bool isCounting = false;
};

/// Must not outlive its Device, which must not move, nor the stage.
class Inspection {
public:
    /// What it may have of a simulation.
    struct Parts {
        std::unique_ptr<const ValueMaps> values;
        std::unique_ptr<const Balls> balls; // pictures refer to it
        std::unique_ptr<const LinkLines> links;
        std::unique_ptr<const ContactMarks> contacts, counter;
        std::unique_ptr<const HashCells> cells;
        bool areNone() const { return !values && !balls && !links && !contacts && !counter && !cells; }
        /// The kernels of what there is, once: a driver that compiles what is first used does so then.
        void recordRehearsal(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    };

    /// Makes nothing yet. `slots` pictures, and a rehearsal, may be under way at a time.
    Inspection(const vk::Device& device, const Stage& stage, std::uint32_t slots);

    bool has(const Watched& watched) const noexcept;
    /// Makes what is not there yet, of the simulation that the stage has and of `scene`, a copy of the
    /// stage's. Any thread, while that lasts and nothing is added. Throws vk::Error.
    Parts make(const Watched& watched, const sim::Scene& scene) const;
    void add(Parts parts) noexcept;
    /// Makes it at once. Throws vk::Error.
    void prepare(const Layers& layers);
    /// After the stage has another simulation: nothing is there. Kernels are kept for what is made next.
    void restart() noexcept;

    /// Their kernels, of the state that recordSkin() was recorded for, where they have some. `layers` must be
    /// there. `slot` < slots; what was recorded into it must have finished.
    void record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept;

    /// How the values of a map spread, of a slot with one that has finished.
    MapReading reading(std::uint32_t slot) const noexcept { return parts_.values->reading(slot); }

    /// How many places where bodies touch were found, likewise.
    std::uint32_t contacts(std::uint32_t slot) const noexcept { return parts_.contacts->found(slot); }

    /// The grids with their cells, likewise.
    std::vector<GridFacts> grids(std::uint32_t slot) const { return parts_.cells->reading(slot); }

    /// Of layers with links that are there.
    LinkFacts links() const { return parts_.links->facts(); }

    /// Null where it is not there.
    const ContactMarks* counter() const noexcept { return parts_.counter.get(); }

    /// For a picture with `layers` that are there, the colors of a map and of cells up to these.
    LayerBuffers buffers(const Layers& layers, float range, float cellRange = 0) const noexcept;

private:
    const vk::Device& device_;
    const Stage& stage_;
    std::uint32_t slots_;
    Parts parts_, before_; // before_: of the simulation before
};

/// Most that are in a cell of any of them, whose color is the last of the map.
float cellRangeOf(std::span<const GridFacts> grids);

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
