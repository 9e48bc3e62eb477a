// Prints how long it takes to record a step by the C++ interface and by the C interface. Not a test: tests
// assert no times.
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/sinew.h"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>

namespace {

using namespace sinew;

void require(SinewResult result) {
    if (result == SINEW_OK) return;
    std::fprintf(stderr, "%s\n", sinewLastError());
    std::exit(1);
}

/// Processor time of this thread [us].
double usedByThread() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Processor time to record `steps` steps into one command buffer [us a step].
double recorded(vk::Queue& queue, std::uint32_t steps, std::uint64_t& frame,
                const std::function<void(VkCommandBuffer, std::uint64_t)>& record) {
    const VkCommandBuffer commands = queue.begin();
    const double start = usedByThread();
    for (std::uint32_t i = 0; i < steps; ++i) record(commands, frame++);
    const double time = usedByThread() - start;
    queue.wait(queue.submit(commands)); // the ring of statuses must come round
    return time / steps;
}

/// The fastest of its recordings so far: others use the machine too.
struct Fastest {
    double time = 1e9; ///< [us a step]
    void add(double value) { time = std::min(time, value); }
};

/// A simulation of a small cube by each interface, of the same device. One is made before the other, which
/// may be faster because of where it lies in memory.
class Pair {
public:
    Pair(vk::Queue& queue, const vk::Device& device, SinewDevice same, std::uint32_t substeps, bool isCFirst)
        : queue_(queue), steps_(64 / substeps) {
        if (isCFirst) makeC(same, substeps);
        sim::Scene scene;
        sim::addLattice(scene, {.cells = {1, 1, 1}});
        scene.planes.push_back({});
        direct_ = std::make_unique<sim::Simulation>(
            device, scene, sim::Settings{.substeps = substeps, .grabs = 1, .framesInFlight = 64});
        if (!isCFirst) makeC(same, substeps);
        const VkCommandBuffer commands = queue.begin();
        direct_->recordReset(commands);
        require(sinewRecordReset(simulation_, commands));
        queue.wait(queue.submit(commands));
    }
    ~Pair() { require(sinewDestroySimulation(simulation_)); }
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;

    double recordCpp() {
        return recorded(queue_, steps_, frameOfCpp_, [&](VkCommandBuffer commands, std::uint64_t frame) {
            direct_->record(commands, {.frame = frame});
        });
    }
    double recordC() {
        return recorded(queue_, steps_, frameOfC_, [&](VkCommandBuffer commands, std::uint64_t frame) {
            SinewStep step = sinewDefaultStep();
            step.frame = frame;
            require(sinewRecordStep(simulation_, commands, &step));
        });
    }

private:
    void makeC(SinewDevice device, std::uint32_t substeps) {
        SinewScene scene{};
        require(sinewCreateScene(&scene));
        const SinewLattice lattice = sinewDefaultLattice();
        require(sinewAddLattice(scene, &lattice, nullptr));
        const SinewPlane plane = sinewDefaultPlane();
        require(sinewAddPlane(scene, &plane));
        SinewSettings settings = sinewDefaultSettings();
        settings.substeps = substeps;
        settings.grabs = 1;
        settings.framesInFlight = 64;
        require(sinewCreateSimulation(device, scene, &settings, &simulation_));
        require(sinewDestroyScene(scene));
    }

    vk::Queue& queue_;
    std::uint32_t steps_; // in a command buffer, few enough that the driver needs no new memory for it
    std::unique_ptr<sim::Simulation> direct_;
    SinewSimulation simulation_{};
    std::uint64_t frameOfCpp_ = 0, frameOfC_ = 0;
};

} // namespace

int main() {
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    SinewHostDevice host = sinewDefaultHostDevice();
    host.getInstanceProcAddr = loader.getInstanceProcAddr();
    host.instance = device.instance();
    host.physicalDevice = device.physical();
    host.device = device.handle();
    host.queueFamily = device.queueFamily();
    SinewDevice borrowed{};
    require(sinewBorrowDevice(&host, &borrowed));
    const vk::Device borrowedByCpp = vk::Device::borrow({.getInstanceProcAddr = host.getInstanceProcAddr,
                                                         .instance = host.instance,
                                                         .physicalDevice = host.physicalDevice,
                                                         .device = host.device,
                                                         .queueFamily = host.queueFamily});
    for (const std::uint32_t substeps : {1u, 4u, 16u, 64u}) {
        std::array<Fastest, 2> cpp, c; // by the order in which the two were made
        for (int round = 0; round < 12; ++round) {
            const std::size_t order = round % 2;
            Pair pair(queue, borrowedByCpp, borrowed, substeps, order == 1);
            for (int i = 0; i < 60; ++i) {
                cpp[order].add(pair.recordCpp());
                c[order].add(pair.recordC());
            }
        }
        const double byCpp = std::min(cpp[0].time, cpp[1].time), byC = std::min(c[0].time, c[1].time);
        std::printf(
            "%3u substeps: C++ %7.2f us a step (%.2f, %.2f), C %7.2f us (%.2f, %.2f): %+.2f us, %+.1f %%\n",
            substeps, byCpp, cpp[0].time, cpp[1].time, byC, c[0].time, c[1].time, byC - byCpp,
            100 * (byC / byCpp - 1));
    }
    require(sinewDestroyDevice(borrowed));
    return 0;
}
