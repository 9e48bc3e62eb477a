// Prints the wall time and processor time [ms] of building the grid, finding candidates and sorting them, for
// particles on a lattice and in random places. All particles move farther than the margin between updates, so
// that each update makes new lists. LP_NUM_THREADS=0 makes a software device compute on one thread, with
// steadier results.
#include "common/layout.h"
#include "sim/collision/contact_lists.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float spacing = 0.1f;

std::vector<layout::vec4> cloud(std::uint32_t side, bool isRandom, float shift) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> anywhere(0, static_cast<float>(side) * spacing);
    std::vector<layout::vec4> x;
    for (std::uint32_t i = 0; i < side * side * side; ++i) {
        const auto at = [](std::uint32_t index) { return static_cast<float>(index) * spacing; };
        x.push_back({at(i % side), at(i / side % side), at(i / side / side), 0});
        if (isRandom) x.back() = {anywhere(random), anywhere(random), anywhere(random), 0};
        x.back().x += shift;
    }
    x.resize(paddedCount(x.size()));
    return x;
}

enum class Part { build, find, all };

// [ms]
struct Duration {
    double clock = 1e9, processor = 1e9;
};

Duration operator-(Duration a, Duration b) {
    return {a.clock - b.clock, a.processor - b.processor};
}

Duration shortest(const vk::Device& device, vk::Queue& queue, std::uint32_t side, bool isRandom, Part part) {
    ProgramBuilder builder(false);
    builder.program().status = builder.scratch<layout::StatusWords>("status", 1);
    constexpr float radius = 0.4f * spacing, margin = 0.2f * spacing; // grid cells of one spacing
    const auto a = cloud(side, isRandom, 0), b = cloud(side, isRandom, 2 * margin);
    std::vector<float> radii(a.size(), -1);
    std::fill_n(radii.begin(), side * side * side, radius);
    const BufferId here = builder.upload("here", a), there = builder.upload("there", b);
    const auto lists =
        collision::contact_lists::add(builder, {.radii = radii, .margin = margin, .capacity = 24});
    const layout::StepParams step{};
    const BufferId velocities = builder.scratch<layout::vec4>("velocities", a.size()),
                   parameters = builder.upload("step", std::span(&step, 1));
    builder.beginPhase("lists");
    for (const BufferId positions : {here, there}) {
        const collision::hash_grid::Moved moved{positions, velocities, parameters};
        collision::hash_grid::addListCheck(builder, lists.grid, moved);
        collision::contact_lists::addBuild(builder, lists, moved);
        if (part == Part::find) builder.fill(lists.pooled.chains, 0); // sorting clears them, too
        if (part != Part::build) collision::contact_lists::addLists(builder, lists, moved);
    }
    StepProgram program = builder.finish();
    if (part == Part::find)
        std::erase_if(program[List::step], [](const Pass& p) { return p.label == "sort_lists"; });
    GpuExecutor executor(device, program);
    const auto submit = [&](const auto& record) {
        const VkCommandBuffer buffer = queue.begin();
        vk::Commands commands(device, buffer);
        record(commands);
        const std::clock_t start = std::clock();
        const auto time = std::chrono::steady_clock::now();
        queue.wait(queue.submit(buffer));
        return Duration{
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - time).count(),
            1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
    };
    submit([&](vk::Commands& commands) { executor.upload(commands); });
    Duration best;
    for (int run = 0; run < 12; ++run) {
        const Duration both = submit([&](vk::Commands& c) { executor.step(c, {}, {}, nullptr); });
        best = {std::min(best.clock, both.clock / 2), std::min(best.processor, both.processor / 2)};
    }
    return best;
}

} // namespace

int main() {
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    for (const std::uint32_t side : {10u, 22u, 47u})
        for (const bool isRandom : {false, true}) {
            const Duration build = shortest(device, queue, side, isRandom, Part::build);
            const Duration find = shortest(device, queue, side, isRandom, Part::find);
            const Duration all = shortest(device, queue, side, isRandom, Part::all);
            std::printf("%7u particles, %s [ms, of processors]:", side * side * side,
                        isRandom ? "random " : "lattice");
            const auto print = [](const char* what, Duration d) {
                std::printf(" %s %6.3f (%6.3f)", what, d.clock, d.processor);
            };
            print("grid", build);
            print("find", find - build);
            print("sort", all - find);
            print("together", all);
            std::printf("\n");
        }
}
