// Where bodies touch, as marks to be drawn: found on the device in the state that is shown, from the solver's
// own lists of what may touch.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/hand_mesh.hpp"
#include "viewer/values.h"
#include "vk/commands.hpp"
#include "vk/kernel_store.hpp"

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the simulation.
class ContactMarks {
public:
    /// For marks to be drawn, or to count only.
    enum class Room { many, none };

    /// As ValueMaps. Throws vk::Error.
    ContactMarks(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                 const sim::Simulation& simulation, std::uint32_t slots, Room room = Room::many);

    void record(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    /// What one particle touches, alone.
    void recordOf(VkCommandBuffer commands, std::uint32_t slot, std::uint32_t particle) const noexcept;
    /// Of a slot that has finished: how many there are, whether drawn or not.
    std::uint32_t found(std::uint32_t slot) const noexcept;

    const HandMesh& mesh() const noexcept { return mesh_; }
    vk::BufferView marks() const noexcept { return marks_.view(); }
    vk::BufferView draw() const noexcept { return draw_.view(); }

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
    std::shared_ptr<const vk::Kernel> kernel_, ofEdges_; // of the device's store
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
