// Submits what Simulation::recordTakeOver records.
#include "app/take_over.hpp"

#include "sinew/ranges.hpp"

#include <cstring>

namespace sinew::app {

namespace {

vk::Buffer bufferFor(const vk::Device& device, std::uint64_t size, vk::MemoryKind kind) {
    return {device, {.name = "handed over", .count = size / 4, .stride = 4, .kind = kind}};
}

} // namespace

void takeOver(sim::Simulation& to, const sim::Simulation& from, vk::Queue& queue, const Bring& bring) {
    queue.waitIdle();
    to.checkTakeOver(from);
    if (bring) bring(from, queue, to, queue);
    const VkCommandBuffer commands = queue.begin();
    to.recordTakeOver(commands, from);
    queue.wait(queue.submit(commands));
}

void takeOverByHost(const vk::Device& toDevice, sim::Simulation& to, const vk::Device& fromDevice,
                    const sim::Simulation& from, const Bring& bring) {
    to.checkTakeOver(from);
    const std::uint64_t size = from.handOverSize();
    const vk::Buffer given = bufferFor(fromDevice, size, vk::MemoryKind::readback),
                     taken = bufferFor(toDevice, size, vk::MemoryKind::upload);
    vk::Queue giving(fromDevice), taking(toDevice);
    if (bring) bring(from, giving, to, taking);
    VkCommandBuffer commands = giving.begin();
    from.recordHandOver(commands, given.view());
    giving.wait(giving.submit(commands));
    std::memcpy(taken.mapped(), given.mapped(), size);
    commands = taking.begin();
    to.recordTakeOver(commands, from, taken.view());
    taking.wait(taking.submit(commands));
}

std::string tooCrowded(std::uint64_t step) {
    return "the simulation is too crowded: step " + std::to_string(step) + ": more than " +
           std::to_string(sim::ranges::mostContactRoom) +
           " contact candidates for a particle on average, or too many for a single one: the last "
           "state was kept: move bodies apart, or use a smaller contacts.margin";
}

} // namespace sinew::app
