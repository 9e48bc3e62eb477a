// Prints the time of frames in which bodies of 1,000 particles enter or leave a world of 30,000 by motions
// (Body::isAbsent), and the time of a step of that world beside bodies that are absent. One step a frame,
// submitted and awaited, by the clock and by the time of all cores, which other programs do not lengthen as
// much. With the argument "touching" particles touch each other. With "rounds" it prints instead the memory
// of the process, and counts on the device, in 10,000 rounds in which bodies come, touch, are cut and go.
#include "sim/pool_rounds.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <string_view>
#include <vector>

namespace {

using namespace sinew;
using namespace sinew::sim;
using Clock = std::chrono::steady_clock;

void addBlock(Scene& scene, const Vec3& origin, std::uint32_t cells, float radius) {
    addLattice(scene, {.origin = origin,
                       .cells = {cells, cells, cells},
                       .spacing = 0.02f,
                       .youngModulus = 2e4f,
                       .radius = radius});
}

// A block of 30,000 particles, and bodies that are absent.
Scene worldWith(std::uint32_t absent, float radius) {
    Scene scene;
    addBlock(scene, {0, 1, 0}, 30, radius); // falls, and stays awake
    for (std::uint32_t b = 0; b < absent; ++b) {
        addBlock(scene, {1 + 0.5f * static_cast<float>(b), 0.2f, 0}, 9, radius);
        scene.bodies.back().isAbsent = true;
    }
    scene.planes.push_back({.friction = 0.5f});
    return scene;
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

// Milliseconds of a frame.
struct Time {
    double clock = 0, cores = 0;
};

class Host {
public:
    Host(const vk::Device& device, const Scene& scene, bool sleeps = false)
        : queue_(device), simulation_(device, scene, {.substeps = 8, .sleeps = sleeps, .motions = 4}) {}

    Time play(std::span<const Motion> motions = {}) {
        const auto start = Clock::now();
        const std::clock_t used = std::clock(); // of all threads
        const VkCommandBuffer commands = queue_.begin();
        if (frame_ == 0) simulation_.recordReset(commands);
        simulation_.record(commands, {.frame = frame_++, .motions = motions});
        queue_.wait(queue_.submit(commands));
        return {std::chrono::duration<double, std::milli>(Clock::now() - start).count(),
                1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC};
    }

private:
    vk::Queue queue_;
    Simulation simulation_;
    std::uint64_t frame_ = 0;
};

// Frames of one kind.
struct Frames {
    std::vector<double> clock, cores;
    void add(const Time& time) {
        clock.push_back(time.clock);
        cores.push_back(time.cores);
    }
};

void print(const char* name, const Frames& frames) {
    std::printf("%-24s clock %6.2f ms (median) %6.2f (longest); cores %6.2f ms (median) %6.2f (longest)\n",
                name, median(frames.clock), *std::ranges::max_element(frames.clock), median(frames.cores),
                *std::ranges::max_element(frames.cores));
}

void printFrames(const vk::Device& device, float radius) {
    Host host(device, worldWith(1, radius));
    Frames quiet, coming, going;
    for (int i = 0; i < 10; ++i) host.play();
    for (int change = 0; change < 40; ++change) {
        const bool comes = change % 2 == 0;
        const Motion motion{.kind = comes ? MotionKind::spawn : MotionKind::despawn, .body = 1};
        (comes ? coming : going).add(host.play({&motion, 1}));
        for (int i = 0; i < 4; ++i) quiet.add(host.play());
    }
    print("frames without a change", quiet);
    print("frames with a spawn", coming);
    print("frames with a despawn", going);
}

void printCosts(const vk::Device& device, float radius) {
    constexpr std::uint32_t counts[] = {0, 10, 50};
    for (const bool sleeps : {false, true}) {
        std::vector<std::unique_ptr<Host>> hosts;
        for (const std::uint32_t count : counts)
            hosts.push_back(std::make_unique<Host>(device, worldWith(count, radius), sleeps));
        std::vector<Frames> times(hosts.size());
        for (int round = 0; round < 30; ++round) // in turn: noise of the machine meets all
            for (std::size_t h = 0; h < hosts.size(); ++h) {
                const Time time = hosts[h]->play();
                if (round >= 5) times[h].add(time);
            }
        for (std::size_t h = 0; h < hosts.size(); ++h)
            std::printf(
                "%s, %2u absent: clock %.2f ms a step (least), %.2f (median); cores %.2f ms (median)\n",
                sleeps ? "bodies may sleep" : "none sleeps", counts[h],
                *std::ranges::min_element(times[h].clock), median(times[h].clock), median(times[h].cores));
    }
}

// Resident memory of the process [MiB].
double residentMemory() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t all = 0, resident = 0;
    file >> all >> resident;
    return static_cast<double>(resident) * 4096 / (1 << 20);
}

void printRounds(const vk::Device& device) {
    vk::Queue queue(device);
    test::PoolRounds rounds(device, queue);
    std::uint64_t cut = 0;
    for (std::uint32_t round = 1; round <= 10000; ++round) {
        cut += rounds.play(round);
        if (round != 100 && round != 1000 && round != 10000) continue;
        const test::PoolCounts counts = rounds.counts();
        std::printf("after %5u rounds: %.2f MiB; %u groups, %u groups of chunks, %u pieces, %u dead links, "
                    "%u fragments; %llu links cut, %u steps undone\n",
                    round, residentMemory(), counts.groups, counts.chunks, counts.pieces, counts.deadLinks,
                    counts.fragments, static_cast<unsigned long long>(cut), rounds.stepsUndone());
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::string_view what = argc > 1 ? argv[1] : "";
    const float radius = what == "touching" ? 0.009f : 0;
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    if (what == "rounds") {
        printRounds(device);
        return 0;
    }
    printFrames(device, radius);
    printCosts(device, radius);
}
