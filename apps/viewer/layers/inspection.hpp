// Buffers from which layers are drawn, made when a layer is first turned on, so that layers that are off cost
// nothing.
#pragma once

#include "viewer/layers/contact_marks.hpp"

#include <memory>
#include <optional>

namespace sinew::viewer {

class Document;

/// Active layers, and whether contacts of the particle under the pointer are counted.
struct WantedLayers {
    Layers layers;
    bool isCounting = false;
};

/// Must not outlive its Device, which must not move, nor the document.
class Inspection {
public:
    /// The parts that layers need of one simulation.
    struct Parts {
        std::array<std::unique_ptr<const LayerPart>, mostLayers> of; // pictures refer to them
        std::unique_ptr<const ContactMarks> counter;
        bool areNone() const;
        /// Runs the kernels of these parts once: drivers that compile at the first use compile here.
        void recordRehearsal(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    };

    /// Makes no parts yet. At most `slots` pictures, and one rehearsal, may be in flight at a time.
    Inspection(const vk::Device& device, const Document& document, std::uint32_t slots);

    bool has(const WantedLayers& watched) const noexcept;
    /// Makes the missing parts for the document's simulation and `scene`, a copy of the document's. Any
    /// thread, during which nothing may be added. Throws vk::Error.
    Parts make(const WantedLayers& watched, const sim::Scene& scene) const;
    void add(Parts parts) noexcept;
    /// Makes and adds the missing parts. Throws vk::Error.
    void prepare(const Layers& layers);
    /// Call after the document changed its simulation: drops all parts, but keeps kernels for the next ones.
    void restart() noexcept;

    /// Runs the kernels of `layers`, which must be ready, on the state for which recordSkin() was recorded.
    /// `slot` < slots; the slot's previous commands must have finished.
    void record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept;

    /// The statements of a layer that is ready about the state of that slot, whose commands have finished.
    LayerReading reading(std::size_t layer, std::uint32_t slot) const {
        return parts_.of[layer]->reading(slot);
    }

    /// The part of a layer that is ready, as what it is.
    template <typename Part> const Part& part(const Layer& layer) const {
        return static_cast<const Part&>(*parts_.of[indexOf(layer)]);
    }

    /// Null if it does not exist.
    const ContactMarks* counter() const noexcept { return parts_.counter.get(); }

    /// Buffers for a picture with `layers`, which are ready.
    LayerBuffers buffers(const Layers& layers, const LayerRanges& ranges = {}) const noexcept;

private:
    const vk::Device& device_;
    const Document& document_;
    std::uint32_t slots_;
    Parts parts_, before_; // before_: for the simulation before
};

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
