// Contact points as marks to be drawn. The device finds them in the shown state, from the solver's own
// contact lists.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/render/hand_mesh.hpp"
#include "viewer/render/layer.hpp"
#include "viewer/values.h"

namespace sinew::viewer {

namespace layer {
extern const Layer contacts;
} // namespace layer

/// Must not outlive its Device, which must not move, nor the simulation.
class ContactMarks : public LayerPart {
public:
    /// Marks can be drawn, or only counted.
    enum class Room { many, none };

    /// Parameters as in ValueMaps. Throws vk::Error.
    ContactMarks(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                 const sim::Simulation& simulation, std::uint32_t slots, Room room = Room::many);

    void record(VkCommandBuffer commands, std::size_t look, std::uint32_t slot) const noexcept override;
    LayerReading reading(std::uint32_t slot) const override;
    void draw(const LayerDrawing& to) const noexcept override;
    /// Records only the contacts of one particle.
    void recordOf(VkCommandBuffer commands, std::uint32_t slot, std::uint32_t particle) const noexcept;
    /// Number of contacts, drawn or not, once the commands of that slot have finished.
    std::uint32_t found(std::uint32_t slot) const noexcept;

private:
    vk::BindingSets bindingSets() const;
    void dispatch(vk::Commands& commands, const vk::Kernel& kernel, std::size_t set,
                  const layout::MarkPush& push, std::uint32_t items) const noexcept;
    void record(VkCommandBuffer commands, std::uint32_t slot, layout::MarkPush push,
                std::uint32_t items) const noexcept;
    void writeWalls(std::uint32_t slot) const noexcept;

    const vk::Device& device_;
    std::vector<sim::Plane> planes_;
    std::vector<sim::Collider> colliders_;
    const sim::Simulation& simulation_;
    layout::MarkPush push_{};
    HandMesh mesh_;
    vk::Buffer particles_, bySlot_, walls_, nothing_;
    vk::Buffer marks_, draw_, draws_;
    std::shared_ptr<const vk::Kernel> kernel_, ofEdges_; // shared with the device's kernel store
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
