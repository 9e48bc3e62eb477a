// Two simulations exist while the state goes from one to the other.
#include "app/growing_simulation.hpp"

#include "sim/ranges.hpp"
#include "sim/validate.hpp"
#include "vk/check.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::app {

namespace {

constexpr std::uint32_t granule = 8;

// Half as much again: a scene that fills up would else grow every few steps, each time with all its pipelines
// anew.
std::uint32_t roomFor(std::uint32_t needed) {
    const std::uint32_t roomy = needed + needed / 2;
    return std::min((roomy + granule - 1) / granule * granule, sim::ranges::mostContactRoom);
}

vk::Buffer bufferFor(const vk::Device& device, std::uint64_t size, vk::MemoryKind kind) {
    return {device, {.name = "handed over", .count = size / 4, .stride = 4, .kind = kind}};
}

} // namespace

GrowingSimulation::GrowingSimulation(const vk::Device& device, const sim::Scene& scene,
                                     const sim::Settings& settings)
    : device_(device.anchored()), scene_(scene), settings_(settings),
      simulation_(std::make_unique<sim::Simulation>(device, scene, settings)),
      room_{.room = settings.contactRoom} {}

std::vector<std::string> GrowingSimulation::complaints() {
    std::vector<std::string> complaints = simulation_->complaints();
    if (complaints.empty()) return complaints;
    const std::vector<std::string> ofScene = sim::warnings(scene_);
    std::erase_if(complaints, [&](const std::string& complaint) {
        return std::ranges::find(ofScene, complaint) != ofScene.end();
    });
    return complaints;
}

std::optional<sim::Settings> GrowingSimulation::roomForContacts(std::uint32_t needed) {
    room_.needed = std::max(room_.needed, needed);
    if (needed > sim::ranges::mostContactRoom) return std::nullopt;
    sim::Settings settings = settings_;
    settings.contactRoom = roomFor(needed);
    return settings;
}

bool GrowingSimulation::grow(std::uint32_t needed, vk::Queue& queue, const Bring& bring) {
    const std::optional<sim::Settings> settings = roomForContacts(needed);
    if (settings) replace(*settings, queue, bring);
    return settings.has_value();
}

bool GrowingSimulation::lacksSurface(std::uint32_t needed) const noexcept {
    return needed > 0 && !surface_.isShort;
}

std::optional<sim::Settings> GrowingSimulation::roomForSurface(std::uint32_t needed) {
    surface_.needed = std::max(surface_.needed, needed);
    sim::Settings settings = settings_;
    settings.cutSurfaceRoom = std::min(needed + needed / 2, sim::ranges::mostCutSurfaceRoom);
    surface_.isShort = settings.cutSurfaceRoom < needed;
    return surface_.isShort ? std::nullopt : std::optional(settings);
}

bool GrowingSimulation::growSurface(std::uint32_t needed, vk::Queue& queue, const Bring& bring) {
    const std::optional<sim::Settings> settings = roomForSurface(needed);
    if (!settings) return false;
    try {
        replace(*settings, queue, bring);
    } catch (const vk::Error&) { // of memory, or a longer buffer than the device has
        lackSurface();
        return false;
    }
    return true;
}

void GrowingSimulation::goOnIn(std::unique_ptr<sim::Simulation> next, const sim::Settings& settings) {
    room_.grown += settings.contactRoom > settings_.contactRoom ? 1 : 0;
    surface_.grown += settings.cutSurfaceRoom > settings_.cutSurfaceRoom ? 1 : 0;
    room_.room = settings.contactRoom;
    simulation_ = std::move(next);
    settings_ = settings;
}

void GrowingSimulation::replace(const sim::Settings& settings, vk::Queue& queue, const Bring& bring) {
    replaceBy(std::make_unique<sim::Simulation>(device_, scene_, settings), settings, queue, bring);
}

void GrowingSimulation::replaceBy(std::unique_ptr<sim::Simulation> next, const sim::Settings& settings,
                                  vk::Queue& queue, const Bring& bring) {
    queue.waitIdle();
    if (bring) bring(*simulation_, queue, *next, queue);
    const VkCommandBuffer commands = queue.begin();
    next->recordTakeOver(commands, *simulation_);
    queue.wait(queue.submit(commands));
    goOnIn(std::move(next), settings);
}

void GrowingSimulation::widen(const sim::Settings& roomy, vk::Queue& queue) {
    const sim::Settings settings = withRoomOf(settings_, roomy);
    if (settings.contactRoom == settings_.contactRoom && settings.cutSurfaceRoom == settings_.cutSurfaceRoom)
        return;
    replace(settings, queue);
}

// Only as far as it was not made with it: pipelines take their time.
void GrowingSimulation::makeRoomOf(const GrowingSimulation& other) {
    const sim::Settings roomy = withRoomOf(settings_, other.settings_);
    if (roomy.contactRoom > settings_.contactRoom || roomy.cutSurfaceRoom > settings_.cutSurfaceRoom)
        simulation_ = std::make_unique<sim::Simulation>(device_, scene_, roomy);
    settings_ = roomy;
    room_ = other.room_;
    room_.room = roomy.contactRoom;
    surface_ = other.surface_;
    surface_.isShort = false; // another device may have the memory
}

void GrowingSimulation::takeOver(const GrowingSimulation& from, const Bring& bring) {
    makeRoomOf(from);
    const std::uint64_t size = from.simulation_->handOverSize();
    const vk::Buffer given = bufferFor(from.device_, size, vk::MemoryKind::readback),
                     taken = bufferFor(device_, size, vk::MemoryKind::upload);
    vk::Queue giving(from.device_), taking(device_);
    if (bring) bring(*from.simulation_, giving, *simulation_, taking);
    VkCommandBuffer commands = giving.begin();
    from.simulation_->recordHandOver(commands, given.view());
    giving.wait(giving.submit(commands));
    std::memcpy(taken.mapped(), given.mapped(), size);
    commands = taking.begin();
    simulation_->recordTakeOver(commands, *from.simulation_, taken.view());
    taking.wait(taking.submit(commands));
}

sim::Settings withRoomOf(sim::Settings settings, const sim::Settings& other) {
    settings.contactRoom = std::max(settings.contactRoom, other.contactRoom);
    settings.cutSurfaceRoom = std::max(settings.cutSurfaceRoom, other.cutSurfaceRoom);
    return settings;
}

std::string tooCrowded(std::uint64_t step) {
    return "the simulation is too crowded: step " + std::to_string(step) + ": more than " +
           std::to_string(sim::ranges::mostContactRoom) +
           " contact candidates for a particle on average, or too many for a single one: the last "
           "state was kept: move bodies apart, or use a smaller contacts.margin";
}

} // namespace sinew::app
