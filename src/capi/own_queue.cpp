// Steps, copies and saved states for programs without an engine, on the queue of their device.
#include "capi/sizes.hpp"
#include "capi/stepper.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::capi {

namespace {

/// Continues in a simulation with these settings; all steps have finished.
void continueWith(SimulationObject& object, Submitting& queue, const sim::Settings& settings) {
    const vk::Device& device = object.device.device;
    auto next = std::make_unique<sim::Simulation>(device, *object.scene, settings);
    if (object.isMapped) object.predecessors.reserve(object.predecessors.size() + 1);
    queue.run(device, [&](VkCommandBuffer commands) { next->recordTakeOver(commands, *object.simulation); });
    std::swap(object.owned, next);
    object.simulation = object.owned.get();
    ++object.replacements;
    if (object.isMapped) object.predecessors.push_back(std::move(next));
    object.isMapped = false;
    object.settings = settings;
    object.rooms.adopt(settings);
}

void growContacts(SimulationObject& object, Submitting& queue, std::uint32_t needed) {
    const std::optional<sim::Settings> settings = object.rooms.forContacts(object.settings, needed);
    if (!settings)
        throw Failed{SINEW_ERROR_DIVERGED, "there are more than " +
                                               std::to_string(sim::ranges::mostContactRoom) +
                                               " contact candidates for a particle on average: move bodies "
                                               "apart, or take a smaller contactMargin"};
    continueWith(object, queue, *settings);
}

void growSurface(SimulationObject& object, Submitting& queue, std::uint32_t needed) {
    if (!object.rooms.lackSurface(needed)) return;
    const std::optional<sim::Settings> settings = object.rooms.forSurface(object.settings, needed);
    if (!settings) return;
    try {
        continueWith(object, queue, *settings);
    } catch (const vk::Error& error) { // the surface is then drawn as far as it fits
        if (error.failure() == vk::Failure::deviceLost) throw;
        object.rooms.refuseSurface();
        log(SINEW_LOG_WARNING, error.what());
    }
}

/// Steps of a simulation that is replaced when it needs more room.
class OwnStepper final : public Stepper {
public:
    using Stepper::Stepper;

private:
    void growContacts(const sim::StepStatus& status) override {
        capi::growContacts(object_, queue_, status.contactRoom);
    }
    void growSurface(const sim::StepStatus& status) override {
        capi::growSurface(object_, queue_, status.cutSurfaceMissing);
    }
};

vk::Buffer bufferFor(const vk::Device& device, std::uint64_t size, vk::MemoryKind kind) {
    return {device, {.name = "saved state", .count = size / 4, .stride = 4, .kind = kind}};
}

vk::BufferView rangeOf(const SinewBufferView* view, std::size_t size) {
    requireNotNull(view, "view");
    if (view->buffer == VK_NULL_HANDLE) invalidArgument("the view has no buffer: there is no such output");
    if (size > view->size || size % 4 != 0)
        invalidArgument("size is " + std::to_string(size) + ", must be a multiple of 4 and at most the " +
                        std::to_string(view->size) + " bytes of the view");
    return {view->buffer, view->offset, size, view->stride};
}

vk::BufferView stateRange(const SimulationObject& object, const SinewBufferView* view) {
    const std::uint64_t size = object.simulation->stateSize();
    requireNotNull(view, "view");
    if (view->size < size)
        throw Failed{SINEW_ERROR_MISMATCH, "the view has " + std::to_string(view->size) +
                                               " bytes, and a state has " + std::to_string(size)};
    return rangeOf(view, size);
}

void requireFit(const SimulationObject& object, const StateObject& state) {
    if (state.key != object.simulation->stateKey() || state.size != object.simulation->stateSize())
        throw Failed{SINEW_ERROR_MISMATCH,
                     "the state is that of another scene or of other settings than the simulation has"};
}

} // namespace

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewStep(SinewSimulation simulation, const SinewStep* step, uint32_t count) {
    return call(__func__, [&] {
        const SinewStep given = described(step, "SinewStep", defaultStep);
        const Use<SimulationObject> object(simulation.id, Access::write);
        if (!object->owned)
            throw Failed{SINEW_ERROR_UNSUPPORTED, "the simulation belongs to a world: use sinewStepWorld"};
        const sim::Step taken = stepOf(given, *object);
        Submitting queue(object->device);
        resetOnce(*object, queue);
        OwnStepper(*object, queue, taken).take(count);
    });
}

SinewResult sinewReset(SinewSimulation simulation) {
    return call(__func__, [&] {
        const Use<SimulationObject> object(simulation.id, Access::write);
        Submitting queue(object->device);
        queue.run(object->device.device,
                  [&](VkCommandBuffer commands) { object->simulation->recordReset(commands); });
        object->isReset = true;
        object->stepsDone = 0;
    });
}

SinewResult sinewUpdateSkin(SinewSimulation simulation) {
    return call(__func__, [&] {
        const Use<SimulationObject> object(simulation.id, Access::write);
        Submitting queue(object->device);
        resetOnce(*object, queue);
        queue.run(object->device.device,
                  [&](VkCommandBuffer commands) { object->simulation->recordSkin(commands); });
    });
}

SinewResult sinewSaveState(SinewSimulation simulation, SinewState* state) {
    return call(__func__, [&] {
        requireNotNull(state, "state");
        const Use<SimulationObject> object(simulation.id, Access::write);
        Submitting queue(object->device);
        resetOnce(*object, queue);
        const vk::Device& device = object->device.device;
        auto saved = std::make_unique<StateObject>();
        saved->key = object->simulation->stateKey();
        saved->size = object->simulation->stateSize();
        const vk::Buffer copy = bufferFor(device, saved->size, vk::MemoryKind::readback);
        queue.run(device, [&](VkCommandBuffer commands) {
            saved->host = object->simulation->recordSaveState(commands, copy.view());
        });
        copy.invalidate();
        saved->bytes.assign(copy.mapped(), copy.mapped() + saved->size);
        state->id = addObject(std::move(saved));
    });
}

SinewResult sinewLoadState(SinewSimulation simulation, SinewState state) {
    return call(__func__, [&] {
        const Use<SimulationObject> object(simulation.id, Access::write);
        const Use<StateObject> saved(state.id, Access::read);
        Submitting queue(object->device);
        requireFit(*object, *saved);
        if (saved->bytes.empty())
            throw Failed{SINEW_ERROR_MISMATCH, "the bytes of the state are in a buffer of the host: use "
                                               "sinewRecordLoadState"};
        resetOnce(*object, queue);
        const vk::Device& device = object->device.device;
        const vk::Buffer copy = bufferFor(device, saved->size, vk::MemoryKind::upload);
        std::memcpy(copy.mapped(), saved->bytes.data(), saved->bytes.size());
        copy.flush();
        queue.run(device, [&](VkCommandBuffer commands) {
            object->simulation->recordLoadState(commands, copy.view(), saved->host);
        });
    });
}

SinewResult sinewRecordSaveState(SinewSimulation simulation, VkCommandBuffer commands,
                                 const SinewBufferView* to, SinewState* state) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        requireNotNull(state, "state");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const vk::BufferView range = stateRange(*object, to);
        auto saved = std::make_unique<StateObject>();
        saved->key = object->simulation->stateKey();
        saved->size = object->simulation->stateSize();
        StateObject& filled = *saved;
        const std::uint64_t id = addObject(std::move(saved)); // first: recording cannot be taken back
        try {
            filled.host = object->simulation->recordSaveState(commands, range);
        } catch (...) {
            destroyObject(id, Kind::state);
            throw;
        }
        state->id = id;
    });
}

SinewResult sinewRecordLoadState(SinewSimulation simulation, VkCommandBuffer commands,
                                 const SinewBufferView* from, SinewState state) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const Use<StateObject> saved(state.id, Access::read);
        requireFit(*object, *saved);
        object->simulation->recordLoadState(commands, stateRange(*object, from), saved->host);
    });
}

SinewResult sinewDestroyState(SinewState state) {
    return call(__func__, [&] { destroyObject(state.id, Kind::state); });
}

SinewResult sinewDownload(SinewDevice device, const SinewBufferView* view, size_t size, void* bytes) {
    return call(__func__, [&] {
        requireArray(bytes, size, "bytes");
        const Use<DeviceObject> object(device.id, Access::read);
        Submitting queue(*object);
        const vk::BufferView range = rangeOf(view, size);
        if (size > 0) queue->download(range, bytes, size);
    });
}

SinewResult sinewUpload(SinewDevice device, const SinewBufferView* view, size_t size, const void* bytes) {
    return call(__func__, [&] {
        requireArray(bytes, size, "bytes");
        const Use<DeviceObject> object(device.id, Access::read);
        Submitting queue(*object);
        const vk::BufferView range = rangeOf(view, size);
        if (size > 0) queue->upload(range, bytes, size);
    });
}

SinewResult sinewMap(SinewSimulation simulation, uint32_t output, const void** bytes, size_t* size) {
    return call(__func__, [&] {
        requireNotNull(bytes, "bytes");
        requireNotNull(size, "size");
        const Use<SimulationObject> object(simulation.id, Access::write);
        queueOf(object->device);
        const vk::BufferView view = viewOf(*object, output);
        const std::byte* address = view.size > 0 ? object->simulation->mapped(view) : nullptr;
        if (address == nullptr)
            throw Failed{SINEW_ERROR_UNSUPPORTED,
                         view.size == 0
                             ? "the simulation has no such output"
                             : "the host does not see the memory of this device: use sinewDownload"};
        object->isMapped = true;
        *bytes = address;
        *size = view.size;
    });
}

} // extern "C"
