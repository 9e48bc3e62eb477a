// Prints the time of frames while bodies of about 1,000 particles join and leave a world of 30,000: one step
// a frame, submitted and awaited, as by a host that has nothing else to do. Then prints the processor time of
// the parts of a change, one after another: a frame without one, the making, the frame that takes over.
#include "sinew/bodies.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"
#include "sinew/world.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace sinew;
using namespace sinew::sim;
using Clock = std::chrono::steady_clock;

Scene block(const Vec3& origin, std::uint32_t cells, float radius) {
    Scene scene;
    const Lattice lattice{.origin = origin,
                          .cells = {cells, cells, cells},
                          .spacing = 0.02f,
                          .youngModulus = 2e4f,
                          .radius = radius};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.4f, 0.3f});
    return scene;
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Processor time of all threads of this process [ms].
double processorTime() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

} // namespace

int main(int argc, char**) {
    const float radius = argc > 1 ? 0.009f : 0;
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    Scene base = block({0, 0.01f, 0}, 30, radius);
    base.planes.push_back({.friction = 0.5f});
    World world(device, base, {.substeps = 8});
    std::uint64_t frame = 0;
    const auto play = [&](double pauseMs) {
        const auto start = Clock::now();
        const VkCommandBuffer commands = queue.begin();
        if (frame == 0) world.simulation().recordReset(commands);
        const bool isTaken = world.recordChanges(commands);
        world.simulation().record(commands, {.dt = base.dt, .frame = frame++});
        queue.wait(queue.submit(commands));
        if (isTaken) world.release();
        const double ms = millisecondsSince(start);
        if (pauseMs > ms)
            std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(pauseMs - ms));
        return std::pair(ms, isTaken);
    };
    for (const double period : {0.0, 1000.0 / 60}) { // as fast as possible; at 60 frames a second
        std::vector<double> quiet, worst, frames;
        for (int i = 0; i < 30; ++i) quiet.push_back(play(period).first);
        std::vector<PartId> parts;
        for (int change = 0; change < 12; ++change) {
            const auto start = Clock::now();
            if (change % 2 == 0)
                parts.push_back(
                    world.add(block({1.0f + 0.5f * static_cast<float>(change), 0.2f, 0}, 9, radius)));
            else
                world.remove(parts.back());
            const double asking = millisecondsSince(start);
            double longest = 0;
            int waited = 0;
            for (bool isTaken = false; !isTaken; ++waited) {
                const auto [ms, taken] = play(period);
                longest = std::max(longest, waited == 0 ? ms + asking : ms);
                isTaken = taken;
            }
            for (int i = 0; i < 5; ++i) longest = std::max(longest, play(period).first);
            if (change < 2) continue; // kernels are warm now
            worst.push_back(longest);
            frames.push_back(waited);
        }
        const double usual = median(quiet);
        std::printf(
            "%s, %s: median frame %.2f ms; longest around a change %.2f ms (median of %zu), %.2f times; "
            "frames until it arrives: %.0f (median), %.0f (most)\n",
            device.description().name.c_str(), period > 0 ? "60 frames a second" : "no pause", usual,
            median(worst), worst.size(), median(worst) / usual, median(frames),
            *std::ranges::max_element(frames));
    }
    std::vector<double> usual, making, takingOver;
    std::optional<PartId> part;
    for (int change = 0; change < 12; ++change) {
        const auto timed = [](std::vector<double>& times, const auto& work) {
            const double start = processorTime();
            work();
            times.push_back(processorTime() - start);
        };
        for (int i = 0; i < 5; ++i) timed(usual, [&] { play(0); });
        if (part)
            world.remove(*std::exchange(part, std::nullopt));
        else
            part = world.add(block({1, 0.2f, 0}, 9, radius));
        timed(making, [&] {
            play(0); // begins to make
            while (!world.isReady()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
        timed(takingOver, [&] { play(0); });
    }
    const double frameMs = median(usual);
    std::printf("processor time, medians: a frame %.2f ms; the making %.2f ms; the frame that takes over "
                "%.2f ms, %.2f times\n",
                frameMs, median(making) - frameMs, median(takingOver), median(takingOver) / frameMs);
}
