// One dispatch over all particles.
#include "kernels.hpp"
#include "sim/simulation/picking_tables.hpp"
#include "simulation/pick.h"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/picking.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <algorithm>

namespace sinew::sim {

struct RegionFinder::State {
    const vk::Device& device;
    std::uint32_t room;
    std::shared_ptr<const vk::Kernel> kernel;
    vk::Buffer inverseMasses, found, answers;
    std::uint32_t particles;
    std::optional<vk::BindingSets> sets{};

    State(const vk::Device& on, const Scene& scene, std::uint32_t most, std::uint32_t slots)
        : device(on.anchored()), room(most), kernel(device.kernels().get(device, kernels::findWithin, {})),
          inverseMasses(tableOf(device, "region.inverse_masses", sim::inverseMasses(scene))),
          found(device, {.name = "region.found", .count = VkDeviceSize{room} + 1, .stride = 4}),
          answers(device, {.name = "region.answers",
                           .count = slots * (VkDeviceSize{room} + 1),
                           .stride = 4,
                           .kind = vk::MemoryKind::readback}),
          particles(static_cast<std::uint32_t>(scene.particles.size())) {}
};

RegionFinder::RegionFinder(const vk::Device& device, const Scene& scene, std::uint32_t room,
                           std::uint32_t slots)
    : state_(std::make_unique<State>(device, scene, room, slots)) {}
RegionFinder::~RegionFinder() = default;

void RegionFinder::watch(const Simulation& simulation) {
    const vk::BindingRequest request{state_->kernel.get(),
                                     {simulation.positions(), removedParticles(simulation),
                                      state_->inverseMasses.view(), state_->found.view()}};
    state_->sets.emplace(state_->device, std::span(&request, 1));
}

void RegionFinder::record(VkCommandBuffer handle, std::uint32_t slot,
                          const RegionQuery& region) const noexcept {
    const auto& [x, y, z] = region.center;
    const auto& [a, b, c] = region.halfExtents;
    const layout::WithinPush push{.center = {x, y, z, region.radius},
                                  .halfExtents = {a, b, c, 0},
                                  .count = state_->particles,
                                  .room = state_->room,
                                  .isMoving = region.findsFixed ? 0u : 1u};
    const vk::BufferView found = state_->found.view();
    vk::BufferView read = state_->answers.view(), count = found;
    read.offset += slot * found.size;
    read.size = found.size;
    count.size = sizeof(std::uint32_t);
    vk::Commands commands(state_->device, handle);
    commands.beginStep();
    commands.fill(count, 0);
    commands.barrier();
    if (push.count > 0) {
        const vk::Kernel& kernel = *state_->kernel;
        commands.bind(kernel, (*state_->sets)[0]);
        commands.push(kernel, &push, sizeof push);
        commands.dispatch((push.count - 1) / kernel.interface().groupSize[0] + 1);
        commands.barrier();
    }
    commands.copy(found, read);
    commands.endStep();
    commands.hostBarrier();
}

RegionFinder::Found RegionFinder::found(std::uint32_t slot) const {
    state_->answers.invalidate();
    const VkDeviceSize size = state_->found.view().size;
    const std::byte* words = state_->answers.mapped() + slot * size;
    Found result;
    std::memcpy(&result.count, words, sizeof result.count);
    result.particles.resize(std::min(result.count, state_->room));
    std::memcpy(result.particles.data(), words + sizeof result.count,
                result.particles.size() * sizeof result.count);
    std::ranges::sort(result.particles);
    return result;
}

} // namespace sinew::sim
