// Prints what colliders cost: processor time [ms] of a step of a voxel body without gravity and up to 256
// capsules of the host, near and far. The least of several runs that take turns. Meant for a software device;
// LP_NUM_THREADS=0 makes it compute on one thread, with steadier results.
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr int warmUp = 4, steps = 12, runs = 5;

Scene body(std::uint32_t cells) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    const float spacing = 1.0f / static_cast<float>(cells);
    addLattice(scene, {.cells = {cells, cells, cells}, .spacing = spacing, .youngModulus = 3e4f});
    return scene;
}

// Capsules over the lower face of the body, or 20 m away; they turn and touch nothing.
std::vector<HostCollider> capsules(std::uint32_t count, bool areNear, int step) {
    std::vector<HostCollider> list;
    for (std::uint32_t c = 0; c < count; ++c) {
        const auto x = static_cast<float>(c % 16) / 16, z = static_cast<float>(c / 16) / 16;
        const float height = areNear ? -0.04f : -20;
        list.push_back({.shape = ColliderShape::capsule,
                        .radius = 0.02f,
                        .halfLength = 0.01f,
                        .pose = {.position = {x, height - 0.0001f * static_cast<float>(step % 7), z}}});
    }
    return list;
}

struct Case {
    const char* place;
    std::uint32_t room, count;
    bool areNear;
    double ms = 1e9;
    std::unique_ptr<Simulation> simulation;
    std::uint64_t frame = 0;
};

} // namespace

int main(int argc, char** argv) {
    const auto cells = static_cast<std::uint32_t>(argc > 1 ? std::atoi(argv[1]) : 22);
    const std::uint32_t mostOfFew = argc > 2 ? 8 : 256; // with a second argument no case has more than 8
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    const Scene scene = body(cells);
    std::vector<Case> cases;
    cases.push_back({"none", 0, 0, false});
    for (const std::uint32_t count : {1u, 4u, 8u, 50u, 256u})
        for (const bool areNear : {false, true})
            if (count <= mostOfFew) cases.push_back({areNear ? "near" : "far", count, count, areNear});
    if (mostOfFew > 8) cases.push_back({"absent", 256, 0, false});
    for (Case& one : cases)
        one.simulation =
            std::make_unique<Simulation>(device, scene, Settings{.substeps = 16, .hostColliders = one.room});
    for (int run = 0; run < runs; ++run)
        for (Case& one : cases) {
            std::clock_t start = 0;
            for (int s = 0; s < warmUp + steps; ++s) {
                if (s == warmUp) start = std::clock();
                const auto list = capsules(one.count, one.areNear, s);
                const VkCommandBuffer commands = queue.begin();
                if (one.frame == 0) one.simulation->recordReset(commands);
                one.simulation->record(commands,
                                       {.gravity = {}, .frame = one.frame++, .hostColliders = list});
                queue.wait(queue.submit(commands));
            }
            const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            one.ms = std::min(one.ms, ms / steps);
        }
    std::printf("%zu particles, 16 substeps, processor time of a step [ms]\n", scene.particles.size());
    for (const Case& one : cases)
        std::printf("%3u of %3u %-6s %8.3f  %.3f of none\n", one.count, one.room, one.place, one.ms,
                    one.ms / cases[0].ms);
}
