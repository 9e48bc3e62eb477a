// Picking: rays at everything that is drawn of bodies (sinew/picking.hpp). Answers come back with the frame
// that they were recorded into.
#pragma once

#include "sinew/picking.hpp"
#include "viewer/input/pick.hpp"
#include "viewer/render/scene_light.hpp"

#include <array>
#include <optional>

namespace sinew::viewer {

class Document;

/// Must not outlive its Device, which must not move, nor the document.
class Picker {
public:
    /// Rays of one recording.
    static constexpr std::size_t rays = 3;
    struct Cast {
        Ray ray;
        Among among = Among::moving;
    };
    using Casts = std::array<std::optional<Cast>, rays>;

    /// `light`: balls and closed skins of the document's scene. At most `slots` recordings may be in flight
    /// at a time. Throws vk::Error.
    Picker(const vk::Device& device, const Document& document, const SceneLight& light, std::uint32_t slots);
    /// Call after the document changed its simulation. Throws vk::Error.
    void restart();

    /// Casts rays at the state for which recordSkin() was recorded. With a section, they pass the hidden side
    /// and meet the opened inside. `slot` < slots; the slot's previous commands must have finished.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Casts& casts,
                const std::optional<Section>& section = {}) const noexcept;
    /// The result of a ray of a slot, once its commands have finished; empty if it met no body, or only
    /// particles not asked for. The particle is the nearest to the point of those that hold what is met
    /// there, on its side of a cut. Removed fragments are not met.
    std::optional<Pick> answer(std::uint32_t slot, std::size_t ray) const noexcept;

private:
    const Document& document_;
    sim::RayCaster caster_;
};

} // namespace sinew::viewer
