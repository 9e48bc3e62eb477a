#include "app/thread_advice.hpp"

#include "app/driver_threads.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"
#include "vk/environment.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>

namespace sinew::app {

namespace {

constexpr int rounds = 5;
constexpr double worthSaying = 0.9; // of the time with threads
constexpr std::size_t mostParticles = 50'000;
constexpr std::uint32_t mostSubsteps = 8;

// Set by prepareThreadAdvice(), unless the user decides; taken by the first measurement.
std::atomic<bool> mayAdvise = false;

vk::Device singleDevice(const vk::Loader& loader) {
    const WithoutDriverThreads scope;
    return vk::Device::create(loader.getInstanceProcAddr(), {.device = "llvmpipe"});
}

/// Steps of a scene on one device.
class Trial {
public:
    Trial(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings)
        : scene_(scene), queue_(device), simulation_(device, scene, settings), drain_(queue_) {
        const VkCommandBuffer commands = queue_.begin();
        simulation_.recordReset(commands);
        queue_.wait(queue_.submit(commands));
        step(); // the driver compiles at the first use
    }

    /// The wall-clock time of a step, with submission and wait [ms].
    double step() {
        const auto start = std::chrono::steady_clock::now();
        const VkCommandBuffer commands = queue_.begin();
        simulation_.record(commands, {.dt = scene_.dt, .gravity = scene_.gravity, .frame = frame_++});
        queue_.wait(queue_.submit(commands));
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

private:
    const sim::Scene& scene_;
    vk::Queue queue_;
    sim::Simulation simulation_;
    std::uint64_t frame_ = 0;
    vk::Drain drain_;
};

} // namespace

void prepareThreadAdvice() {
    if (std::getenv(driverThreadsVariable)) return;
    const unsigned processors = std::thread::hardware_concurrency();
    if (processors < 2) return; // lavapipe has no threads then
    vk::setVariable(driverThreadsVariable, std::to_string(processors).c_str());
    mayAdvise = true;
}

ThreadTimes compareThreads(const std::function<double()>& threaded, const std::function<double()>& single) {
    constexpr double none = std::numeric_limits<double>::infinity();
    ThreadTimes times{none, none};
    for (int round = 0; round < rounds; ++round) {
        times.threaded = std::min(times.threaded, threaded());
        times.single = std::min(times.single, single());
    }
    return times;
}

std::optional<std::string> threadAdvice(const ThreadTimes& times) {
    if (!(times.single < worthSaying * times.threaded)) return {};
    char text[256];
    std::snprintf(
        text, sizeof text,
        "steps of this scene are about %.1f times as fast with %s=0 in the environment: measured just "
        "now, a trial step took %.3g ms with the driver's threads and %.3g ms without",
        times.threaded / times.single, driverThreadsVariable, times.threaded, times.single);
    return text;
}

std::optional<std::string> adviseOnThreads(const vk::Device& device, const sim::Scene& scene,
                                           const sim::Settings& settings) {
    const bool isLavapipe = device.description().name.find("llvmpipe") != std::string::npos;
    if (!isLavapipe || scene.particles.size() > mostParticles || !mayAdvise.exchange(false)) return {};
    sim::Settings tried = settings;
    tried.substeps = std::min(tried.substeps, mostSubsteps);
    const vk::Loader loader;
    const vk::Device other = singleDevice(loader);
    Trial threaded(device, scene, tried), single(other, scene, tried);
    return threadAdvice(compareThreads([&] { return threaded.step(); }, [&] { return single.step(); }));
}

} // namespace sinew::app
