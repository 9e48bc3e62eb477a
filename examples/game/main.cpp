// A game-like loop without a window: capsules of the host walk about and push soft bodies, of which one
// leaves and another one arrives every 12 frames. Prints frame times, the process's memory and the bytes of
// device memory at the start, in the middle and at the end; exit code 1 if device memory grew in the second
// half, or, in a game of at least 5,000 frames, the process by more than 5 %.
//   game [FRAMES]    10,000 by default
#include "game/hosted_device.hpp"

#include "sinew/bodies.hpp"
#include "sinew/vk/queue.hpp"
#include "sinew/world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <vector>

namespace {

using namespace sinew;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t walkers = 50;
constexpr std::size_t mostBodies = 6;
constexpr std::uint64_t framesBetweenChanges = 12;

sim::Scene ground() {
    sim::Scene scene{.name = "ground"};
    scene.planes.push_back({.friction = 0.5f});
    scene.contacts.friction = 0.4f;
    return scene;
}

// A cube of 64 particles above the ground, at one of 36 places.
sim::Scene cube(std::uint64_t number) {
    sim::Scene scene;
    const auto place = static_cast<float>(number * 7 % 36);
    sim::addLattice(scene, {.origin = {std::fmod(place, 6.0f) - 2.5f, 1.5f, std::floor(place / 6) - 2.5f},
                            .cells = {3, 3, 3},
                            .spacing = 0.12f,
                            .youngModulus = 2e4f,
                            .radius = 0.06f});
    return scene;
}

// Upright capsules on circles around the middle.
void walk(std::vector<sim::HostCollider>& capsules, double seconds) {
    capsules.resize(walkers);
    for (std::uint32_t i = 0; i < walkers; ++i) {
        const double radius = 0.4 + 2.6 * (i + 0.5) / walkers, angle = 2.4 * i + 0.6 * seconds / radius;
        capsules[i] = {.shape = sim::ColliderShape::capsule,
                       .radius = 0.1f,
                       .halfLength = 0.5f,
                       .pose = {.position = {static_cast<float>(radius * std::cos(angle)), 0.6f,
                                             static_cast<float>(radius * std::sin(angle))}}};
    }
}

// Memory of this process [MiB]; 0 where the system has no /proc.
double residentMib() {
    std::ifstream stream("/proc/self/status");
    for (std::string word; stream >> word;)
        if (double kib = 0; word == "VmRSS:" && stream >> kib) return kib / 1024;
    return 0;
}

// The least in some frames: of those in which no simulation is made beside the one that runs.
struct Memory {
    double residentMib = 1e9;
    std::uint64_t deviceBytes = ~std::uint64_t{0};
};

} // namespace

int main(int argc, char** argv) try {
    const std::uint64_t frames = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000;
    HostedDevice hosted;
    vk::Queue queue(hosted.device);
    sim::World world(hosted.device, ground(),
                     {.substeps = 4, .contactRoom = 64, .sleeps = true, .hostColliders = walkers});
    vk::Drain drain(queue);
    std::deque<sim::PartId> bodies;
    for (std::size_t i = 0; i < mostBodies; ++i) bodies.push_back(world.add(cube(i)));
    std::vector<sim::HostCollider> capsules;
    std::vector<double> times;
    std::uint64_t added = mostBodies, changes = 0, undone = 0;
    Memory start, middle, end; // in the second, fifth and last tenth of the frames
    // The first bodies arrive before the first frame: their kernels are made now.
    const VkCommandBuffer first = queue.begin();
    world.simulation().recordReset(first);
    queue.wait(queue.submit(first));
    while (world.isChanging()) {
        const VkCommandBuffer commands = queue.begin();
        world.recordChanges(commands);
        queue.wait(queue.submit(commands));
    }
    world.release();
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        const Clock::time_point begin = Clock::now();
        if (frame % framesBetweenChanges == 0 && !world.isChanging()) {
            world.remove(bodies.front());
            bodies.pop_front();
            bodies.push_back(world.add(cube(added++)));
        }
        const VkCommandBuffer commands = queue.begin();
        const bool isChanged = world.recordChanges(commands);
        walk(capsules, static_cast<double>(frame) / 60);
        world.simulation().record(commands, {.dt = 1.0f / 60, .frame = frame, .hostColliders = capsules});
        queue.wait(queue.submit(commands));
        const sim::Status status = world.status(frame);
        world.observe(status);
        undone += status.isUndone ? 1 : 0;
        if (isChanged) {
            world.release();
            ++changes;
        }
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        const std::uint64_t tenth = frame * 10 / frames;
        for (auto [when, memory] : {std::pair(std::uint64_t{1}, &start), {4, &middle}, {9, &end}})
            if (tenth == when && !world.isChanging()) {
                memory->residentMib = std::min(memory->residentMib, residentMib());
                memory->deviceBytes = std::min(memory->deviceBytes, hosted.bytes());
            }
    }
    std::ranges::sort(times);
    std::printf("%s: %llu frames, %u capsules, %llu bodies came, %llu take-overs, %llu steps undone\n",
                hosted.device.description().name.c_str(), static_cast<unsigned long long>(frames), walkers,
                static_cast<unsigned long long>(added), static_cast<unsigned long long>(changes),
                static_cast<unsigned long long>(undone));
    std::printf("frame: median %.2f ms, 99 of 100 within %.2f ms, longest %.2f ms\n", times[times.size() / 2],
                times[times.size() * 99 / 100], times.back());
    for (const auto& [name, memory] :
         {std::pair("start", start), std::pair("middle", middle), std::pair("end", end)})
        std::printf("%-6s resident %.1f MiB, device %.3f MiB\n", name, memory.residentMib,
                    static_cast<double>(memory.deviceBytes) / (1024 * 1024));
    for (const std::string& complaint : world.simulation().complaints())
        std::printf("complaint: %s\n", complaint.c_str());
    // The first frames of a process make kernels and blocks of memory that later ones use again.
    const bool grew = frames >= 5000 && end.residentMib > 1.05 * middle.residentMib;
    return end.deviceBytes > middle.deviceBytes || grew ? 1 : 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
}
