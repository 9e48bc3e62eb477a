// The driver tells by itself whether pipelines fit a kernel. A hash of all kernels is part of the key so that
// a file does not grow from one build to the next.
#include "app/kept_pipelines.hpp"

#include "all_kernels.hpp"
#include "sim/core/hash.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <algorithm>
#include <exception>
#include <span>
#include <thread>

namespace sinew::app {

namespace {

constexpr const char* kind = "pipelines";

std::uint64_t kernelHash() {
    static const std::uint64_t hash = [] {
        std::uint64_t all = 0;
        for (const vk::ShaderCode* code : sim::kernels::all)
            all = sim::fnv1a(std::as_bytes(code->packed), all);
        return all;
    }();
    return hash;
}

} // namespace

std::string deviceKey(const vk::DeviceDescription& device) {
    return device.identity + " " + std::to_string(kernelHash());
}

vk::Device createDevice(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request,
                        const UserCache& cache) {
    vk::Device device = vk::Device::create(getInstanceProcAddr, request);
    const std::vector<std::byte> kept = cache.find(kind, deviceKey(device.description()));
    if (!kept.empty()) device.usePipelines(kept);
    constexpr unsigned most = 8; // more threads only wait for memory
    device.kernels().useThreads(std::clamp(std::thread::hardware_concurrency(), 1u, most));
    return device;
}

void keepPipelines(const vk::Device& device, const UserCache& cache) noexcept {
    try {
        cache.keep(kind, deviceKey(device.description()), device.pipelineCacheData());
    } catch (const std::exception&) { // of a lost device, or without memory: they are made again
    }
}

} // namespace sinew::app
