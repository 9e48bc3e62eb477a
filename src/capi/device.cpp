// Devices: of programs without an engine, and borrowed from a host.
#include "capi/convert.hpp"
#include "capi/objects.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>

namespace sinew::capi {

namespace {

std::span<const std::byte> bytesOf(const void* bytes, std::size_t size) {
    requireArray(bytes, size, "pipelineCache");
    return {static_cast<const std::byte*>(bytes), size};
}

/// The index of the first usable software device.
std::string softwareDevice(const vk::Loader& loader) {
    const auto devices = vk::listDevices(loader.getInstanceProcAddr(), {});
    const auto found = std::ranges::find_if(devices, [](const vk::DeviceDescription& device) {
        return device.type == "software" && device.missing.empty();
    });
    if (found == devices.end())
        throw vk::Error(vk::Failure::noDevice,
                        "there is no usable software device: install mesa-vulkan-drivers");
    return std::to_string(found->index);
}

vk::BufferHook hookOf(const SinewHostDevice& host) {
    if ((host.createBuffer == nullptr) != (host.destroyBuffer == nullptr))
        invalidArgument("of createBuffer and destroyBuffer one is null: set both or none");
    if (host.createBuffer == nullptr) return {};
    const auto create = [make = host.createBuffer, user = host.bufferUser](
                            const VkBufferCreateInfo& info, vk::MemoryKind kind, const char* name) {
        SinewBuffer made{};
        const SinewResult result = make(user, &info, static_cast<std::uint32_t>(kind), name, &made);
        if (result != SINEW_OK)
            throw vk::Error(
                result == SINEW_ERROR_DEVICE_LOST ? vk::Failure::deviceLost : vk::Failure::outOfMemory,
                std::string("buffer ") + name + ": the host's hook returned " + sinewResultName(result));
        return vk::BufferAllocation{.buffer = made.buffer,
                                    .mapped = static_cast<std::byte*>(made.mapped),
                                    .token = made.token,
                                    .memory = made.memory,
                                    .memoryOffset = made.memoryOffset,
                                    .memorySize = made.memorySize};
    };
    const auto destroy = [free = host.destroyBuffer,
                          user = host.bufferUser](const vk::BufferAllocation& allocation) {
        const SinewBuffer buffer{.buffer = allocation.buffer,
                                 .mapped = allocation.mapped,
                                 .token = allocation.token,
                                 .memory = allocation.memory,
                                 .memoryOffset = allocation.memoryOffset,
                                 .memorySize = allocation.memorySize};
        free(user, &buffer);
    };
    return {create, destroy};
}

void give(std::unique_ptr<vk::Loader> loader, vk::Device made, SinewDevice* device) {
    const std::string chosen = "device: " + made.description().name + ", " + made.description().driver;
    device->id = addObject(std::make_unique<DeviceObject>(std::move(loader), std::move(made)));
    log(SINEW_LOG_INFO, chosen);
}

} // namespace

vk::Queue& queueOf(DeviceObject& device) {
    if (!device.queue)
        throw Failed{SINEW_ERROR_UNSUPPORTED,
                     "the device is borrowed: record into command buffers of its host instead"};
    return *device.queue;
}

SinewDeviceRequest defaultDeviceRequest() {
    SinewDeviceRequest request{};
    request.size = sizeof request;
    return request;
}

SinewHostDevice defaultHostDevice() {
    SinewHostDevice host{};
    host.size = sizeof host;
    host.apiVersion = VK_API_VERSION_1_2;
    return host;
}

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewCreateDevice(const SinewDeviceRequest* request, SinewDevice* device) {
    return call(__func__, [&] {
        const SinewDeviceRequest given = described(request, "SinewDeviceRequest", defaultDeviceRequest);
        requireNotNull(device, "device");
        if (given.isSoftware != 0 && given.device != nullptr)
            invalidArgument("device names one, and isSoftware asks for any software device: set one of both");
        auto loader = std::make_unique<vk::Loader>();
        vk::DeviceRequest wanted{.device = nameOr(given.device, ""),
                                 .hasValidation = given.hasValidation != 0,
                                 .pipelineCache = bytesOf(given.pipelineCache, given.pipelineCacheSize)};
        if (given.isSoftware != 0) wanted.device = softwareDevice(*loader);
        wanted.onValidationMessage = [](const std::string& message) { log(SINEW_LOG_WARNING, message); };
        vk::Device made = vk::Device::create(loader->getInstanceProcAddr(), wanted);
        give(std::move(loader), std::move(made), device);
    });
}

SinewResult sinewBorrowDevice(const SinewHostDevice* host, SinewDevice* device) {
    return call(__func__, [&] {
        const SinewHostDevice given = described(host, "SinewHostDevice", defaultHostDevice);
        requireNotNull(device, "device");
        requireArray(given.instanceExtensions, given.instanceExtensionCount, "instanceExtensions");
        give(nullptr,
             vk::Device::borrow(
                 {.getInstanceProcAddr = given.getInstanceProcAddr,
                  .instance = given.instance,
                  .physicalDevice = given.physicalDevice,
                  .device = given.device,
                  .apiVersion = given.apiVersion,
                  .queueFamily = given.queueFamily,
                  .enabledInstanceExtensions = {given.instanceExtensions, given.instanceExtensionCount},
                  .buffers = hookOf(given),
                  .pipelineCache = bytesOf(given.pipelineCache, given.pipelineCacheSize),
                  .allocation = given.allocation}),
             device);
    });
}

SinewResult sinewDestroyDevice(SinewDevice device) {
    return call(__func__, [&] { destroyObject(device.id, Kind::device); });
}

SinewResult sinewGetDeviceInfo(SinewDevice device, SinewDeviceInfo* info) {
    return call(__func__, [&] {
        const Result<SinewDeviceInfo> result(info, "SinewDeviceInfo");
        const Use<DeviceObject> object(device.id, Access::read);
        const vk::Device& made = object->device;
        SinewDeviceInfo found{.size = sizeof found,
                              .queueFamily = made.queueFamily(),
                              .isSoftware = made.description().type == "software" ? 1u : 0u,
                              .hasQueue = object->queue ? 1u : 0u,
                              .getInstanceProcAddr = made.getInstanceProcAddr(),
                              .instance = made.instance(),
                              .physicalDevice = made.physical(),
                              .device = made.handle(),
                              .name = {},
                              .driver = {}};
        copyText(made.description().name, found.name);
        copyText(made.description().driver, found.driver);
        result.give(found);
    });
}

SinewResult sinewGetPipelineCache(SinewDevice device, size_t* size, void* bytes) {
    return call(__func__, [&] {
        const Use<DeviceObject> object(device.id, Access::read);
        copyOut(object->device.pipelineCacheData(), size, bytes);
    });
}

} // extern "C"
