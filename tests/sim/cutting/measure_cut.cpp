// Prints processor times [ms] of a step without a blade, in bodies that may and may not be cut; the added
// time of a blade, through the body and beside it; and the time for the cut surface. Also prints the device
// time of the passes that open a cut step (positions, test of links, masks, rule K), which is the cost of
// links. LP_NUM_THREADS=0 makes a software device compute on one thread, with steadier results.
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float spacing = 0.02f;

Scene cube(std::uint32_t side, bool hasBodyDiagonals, bool isCuttable, bool hasSkin = false) {
    Scene scene{.name = "cube"};
    const Lattice lattice{.cells = {side - 1, side - 1, side - 1},
                          .spacing = spacing,
                          .youngModulus = 1e5f,
                          .hasBodyDiagonals = hasBodyDiagonals,
                          .isCuttable = isCuttable};
    const LatticeCorners corners = addLattice(scene, lattice);
    if (hasSkin) addLatticeSkin(scene, lattice, corners, {1, 1, 1});
    return scene;
}

struct Costs {
    double step = 1e9;                                        ///< processor time [ms]
    double opening = std::numeric_limits<double>::infinity(); ///< device time [ms]; infinite
                                                              ///< if unknown
};

// Costs of the shortest of some steps; each starts from the scene's state.
Costs shortest(const vk::Device& device, vk::Queue& queue, const Scene& scene, std::uint32_t substeps,
               const Blade& blade) {
    Simulation simulation(device, scene, {.substeps = substeps, .publishesVelocities = false});
    const std::vector<std::string> phases = simulation.phases();
    const auto cut = static_cast<std::size_t>(std::ranges::find(phases, "cut") - phases.begin());
    vk::Timestamps times(device, static_cast<std::uint32_t>(phases.size()));
    Costs best;
    for (int run = 0; run < 9; ++run) {
        VkCommandBuffer commands = queue.begin();
        simulation.recordReset(commands);
        queue.wait(queue.submit(commands));
        commands = queue.begin();
        simulation.record(commands, {.blade = blade}, &times);
        const std::clock_t start = std::clock();
        queue.wait(queue.submit(commands));
        best.step = std::min(best.step, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        const std::vector<double> spans = times.milliseconds();
        if (cut < spans.size()) best.opening = std::min(best.opening, spans[cut]);
    }
    return best;
}

} // namespace

int main() {
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    for (const std::uint32_t side : {16u, 32u})
        for (const bool hasBodyDiagonals : {false, true}) {
            const Scene plain = cube(side, hasBodyDiagonals, false),
                        scene = cube(side, hasBodyDiagonals, true),
                        skinned = cube(side, hasBodyDiagonals, true, true);
            const auto links = static_cast<double>(scene.distances.size());
            const float x = 0.4871f * spacing * static_cast<float>(side);
            const Vec3 from[] = {{x, -1, -1}, {x, -1, 2}}, to[] = {{x + 0.01f, 2, -1}, {x, 2, 2}},
                       fromBeside[] = {{-x, -1, -1}, {-x, -1, 2}}, toBeside[] = {{-x, 2, -1}, {-x, 2, 2}};
            const Costs one = shortest(device, queue, scene, 1, {}),
                        many = shortest(device, queue, scene, 33, {}),
                        onePlain = shortest(device, queue, plain, 1, {}),
                        manyPlain = shortest(device, queue, plain, 33, {}),
                        through = shortest(device, queue, scene, 1, {.from = from, .to = to}),
                        beside = shortest(device, queue, scene, 1, {.from = fromBeside, .to = toBeside}),
                        surface = shortest(device, queue, skinned, 1, {.from = from, .to = to});
            std::printf("%2u^3, %d neighbours, %.0f links: substep %.3f ms, uncuttable %.3f ms; a blade "
                        "through it adds %.3f ms = %.2f ns a link, beside it %.3f ms = %.2f ns; its surface "
                        "%.3f ms; links and masks by the clock %.2f ns a link, beside it %.2f\n",
                        side, hasBodyDiagonals ? 26 : 18, links, (many.step - one.step) / 32,
                        (manyPlain.step - onePlain.step) / 32, through.step - one.step,
                        1e6 * (through.step - one.step) / links, beside.step - one.step,
                        1e6 * (beside.step - one.step) / links, surface.step - through.step,
                        1e6 * through.opening / links, 1e6 * beside.opening / links);
        }
}
