// Prints the cost of recording one pass without validation: bind, descriptor set, dispatch without push
// constants, barrier.
#include "measured_kernels.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

int main() {
    using namespace sinew;
    constexpr int passes = 1000, repeats = 50;
    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    const vk::Buffer first(device, {.name = "first", .count = 64, .stride = 4});
    const vk::Buffer second(device, {.name = "second", .count = 64, .stride = 4});
    const vk::Kernel kernel(device, test::kernels::copyValues, {});
    const vk::BindingRequest requests[] = {{&kernel, {first.view(), second.view()}},
                                           {&kernel, {second.view(), first.view()}}};
    const vk::BindingSets sets(device, requests);
    double best = 1e9, sum = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        VkCommandBuffer handle = queue.begin();
        vk::Commands commands(device, handle);
        const auto start = std::chrono::steady_clock::now();
        for (int pass = 0; pass < passes; ++pass) {
            commands.bind(kernel, sets[pass % 2]);
            commands.dispatch(1);
            commands.barrier();
        }
        const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
        best = std::min(best, spent.count() / passes);
        sum += spent.count() / passes;
        queue.wait(queue.submit(handle));
    }
    std::printf("%s: recording one dispatch with its set and a barrier: %.3f us best, %.3f us mean\n",
                device.description().name.c_str(), best, sum / repeats);
}
