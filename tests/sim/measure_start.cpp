// Prints how long the first simulation of a device takes when the pipelines of an earlier run are at hand,
// and how long unpacking the kernels of the core takes. Not a test: tests assert no times.
#include "all_kernels.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/loader.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

using namespace sinew;
using namespace sinew::sim;
using Clock = std::chrono::steady_clock;

// Processor time of this thread [ms]: others use the machine too.
double usedByThread() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

Scene cube() {
    Scene scene;
    addLattice(scene, {.cells = {8, 8, 8}});
    scene.planes.push_back({});
    return scene;
}

Scene cloth() {
    Scene scene;
    addCloth(scene, {});
    scene.planes.push_back({});
    return scene;
}

// Bodies with skins that touch each other and may be cut.
Scene organs() {
    Scene scene;
    for (const float height : {0.1f, 0.5f}) {
        const Lattice lattice{
            .origin = {0, height, 0}, .cells = {10, 10, 10}, .spacing = 0.02f, .radius = 0.009f};
        addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.7f, 0.4f, 0.3f});
    }
    scene.planes.push_back({.friction = 0.5f});
    return scene;
}

void measure(const vk::Loader& loader, unsigned threads, const char* name, const Scene& scene) {
    std::vector<std::byte> kept;
    std::vector<double> elapsed, processor;
    std::size_t pipelines = 0;
    for (int round = 0; round < 21; ++round) {
        const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {.pipelineCache = kept});
        device.kernels().useThreads(threads);
        const auto start = Clock::now();
        const double used = usedByThread();
        const Simulation simulation(device, scene, {.substeps = 8, .grabs = 1});
        elapsed.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        processor.push_back(usedByThread() - used);
        pipelines = device.kernels().pipelinesMade();
        if (round > 0) continue;
        kept = device.pipelineCacheData();
        elapsed.clear(); // the first device had no pipelines
        processor.clear();
    }
    std::printf("%-8s %3zu pipelines: median %6.1f ms, least %6.1f; processor %6.1f, %6.1f\n", name,
                pipelines, median(elapsed), std::ranges::min(elapsed), median(processor),
                std::ranges::min(processor));
}

} // namespace

int main(int argc, char** argv) {
    const unsigned threads = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 1; // that make pipelines
    const vk::Loader loader;
    measure(loader, threads, "cube", cube());
    measure(loader, threads, "cloth", cloth());
    measure(loader, threads, "organs", organs());
    std::vector<double> times;
    std::size_t bytes = 0, packed = 0;
    for (int round = 0; round < 21; ++round) {
        const double used = usedByThread();
        for (const vk::ShaderCode* code : kernels::all)
            bytes += vk::wordsOf(*code).size() * sizeof(std::uint32_t), packed += code->packed.size();
        times.push_back(usedByThread() - used);
    }
    std::printf("%zu kernels: %zu bytes, packed %zu; unpacked in %.1f ms, least %.1f\n",
                std::size(kernels::all), bytes / times.size(), packed / times.size(), median(times),
                std::ranges::min(times));
}
