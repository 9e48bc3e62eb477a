// Picking on the device: a kernel casts a ray at everything that is drawn of bodies, another one chooses the
// particle. 32 bytes a ray come back, with the frame that they were recorded into; nothing waits.
#pragma once

#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/input/pick.hpp"
#include "viewer/pick.h"
#include "viewer/render/scene_light.hpp"

#include <array>
#include <memory>
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
    /// Dispatches of a ray, by index of their binding sets.
    enum Part : std::uint32_t { ofSkins, ofBalls, ofCuts, ofAll, parts = ofAll };
    vk::BindingSets bindingSets(const vk::BufferView& indices) const;
    layout::PickPush pushOf(const Cast& cast, std::uint32_t ray,
                            const std::optional<Section>& section) const noexcept;
    std::uint32_t recordCast(vk::Commands& commands, const vk::BindingSets& sets,
                             layout::PickPush push) const noexcept;

    const vk::Device& device_;
    const Document& document_;
    std::shared_ptr<const vk::Kernel> skinCaster_, ballCaster_, cutCaster_,
        resolver_; // from the device's store
    // Tables of the scene.
    vk::Buffer holders_, sheetIndices_, skins_, radii_, inverseMasses_;
    layout::PickPush push_{};
    vk::Buffer nothing_; // stands for buffers that a scene lacks
    vk::Buffer windings_, hits_, found_, answers_;
    std::optional<vk::BindingSets> sets_, wholeSets_; // the second: while nothing is cut
};

} // namespace sinew::viewer
