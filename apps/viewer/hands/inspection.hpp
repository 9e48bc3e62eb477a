// Buffers from which layers are drawn, made when a layer is first turned on, so that layers that are off cost
// nothing.
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

/// Active layers, and whether contacts of the particle under the pointer are counted.
struct Watched {
    Layers layers;
    bool isCounting = false;
};

/// Must not outlive its Device, which must not move, nor the stage.
class Inspection {
public:
    /// The parts that layers need of one simulation.
    struct Parts {
        std::unique_ptr<const ValueMaps> values;
        std::unique_ptr<const Balls> balls; // pictures refer to it
        std::unique_ptr<const LinkLines> links;
        std::unique_ptr<const ContactMarks> contacts, counter;
        std::unique_ptr<const HashCells> cells;
        bool areNone() const { return !values && !balls && !links && !contacts && !counter && !cells; }
        /// Runs the kernels of these parts once: drivers that compile at the first use compile here.
        void recordRehearsal(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    };

    /// Makes no parts yet. At most `slots` pictures, and one rehearsal, may be in flight at a time.
    Inspection(const vk::Device& device, const Stage& stage, std::uint32_t slots);

    bool has(const Watched& watched) const noexcept;
    /// Makes the missing parts for the stage's simulation and `scene`, a copy of the stage's. Any thread,
    /// during which nothing may be added. Throws vk::Error.
    Parts make(const Watched& watched, const sim::Scene& scene) const;
    void add(Parts parts) noexcept;
    /// Makes and adds the missing parts. Throws vk::Error.
    void prepare(const Layers& layers);
    /// Call after the stage changed its simulation: drops all parts, but keeps kernels for the next ones.
    void restart() noexcept;

    /// Runs the kernels of `layers`, which must be ready, on the state for which recordSkin() was recorded.
    /// `slot` < slots; the slot's previous commands must have finished.
    void record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept;

    /// Distribution of a map's values, once the commands of that slot have finished.
    MapReading reading(std::uint32_t slot) const noexcept { return parts_.values->reading(slot); }

    /// Number of contacts, once the commands of that slot have finished.
    std::uint32_t contacts(std::uint32_t slot) const noexcept { return parts_.contacts->found(slot); }

    /// The grids with their cells, once the commands of that slot have finished.
    std::vector<GridFacts> grids(std::uint32_t slot) const { return parts_.cells->reading(slot); }

    /// Requires a ready layer of links.
    LinkFacts links() const { return parts_.links->facts(); }

    /// Null if it does not exist.
    const ContactMarks* counter() const noexcept { return parts_.counter.get(); }

    /// Buffers for a picture with `layers`, which are ready; the last colours of the map and of cells stand
    /// for `range` and `cellRange`.
    LayerBuffers buffers(const Layers& layers, float range, float cellRange = 0) const noexcept;

private:
    const vk::Device& device_;
    const Stage& stage_;
    std::uint32_t slots_;
    Parts parts_, before_; // before_: for the simulation before
};

/// The largest number of items in a cell of any grid, for the last colour of the map.
float cellRangeOf(std::span<const GridFacts> grids);

/// The range of a map's colours over time: it rises at once, and falls to the last reading after a dozen
/// lower readings in a row. A reading is already a quantile of 99 %; in an impact the bulk of a body has its
/// peak, which no other quantile would leave out, but which must not darken the seconds that follow.
class MapRange {
public:
    void read(const MapReading& reading);
    float range() const { return newest_.range > 0 ? range_ : 0; }
    const MapReading& newest() const { return newest_; }

private:
    static constexpr int patience = 12; // pictures: a fraction of a second, and no flicker
    MapReading newest_;
    float range_ = 0, below_ = 0; // below_: largest of the lower readings
    int count_ = 0;               // number of lower readings
};

} // namespace sinew::viewer
