// A program that uses the installed package. It opens a device, which stands for that of an engine, lends it
// to the README's example and verifies that the body falls.
#include "x11_macros.hpp"

#include "soft_bodies.hpp"

#include "sinew/vk/check.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <cmath>
#include <cstdio>

int framesInFlight(); // host.cpp

int main() {
    try {
        const sinew::vk::Loader loader;
        const sinew::vk::Device engine = sinew::vk::Device::create(loader.getInstanceProcAddr(), {});
        sinew::vk::Queue queue(engine);
        SoftBodies bodies({.getInstanceProcAddr = engine.getInstanceProcAddr(),
                           .instance = engine.instance(),
                           .physicalDevice = engine.physical(),
                           .device = engine.handle(),
                           .queueFamily = engine.queueFamily()});
        const sinew::vk::Drain drain(queue);
        for (std::uint64_t frame = 0; frame < 10; ++frame) {
            const VkCommandBuffer commands = queue.begin();
            bodies.recordFrame(commands, frame);
            queue.wait(queue.submit(commands));
        }
        const auto positions = queue.download<std::array<float, 4>>(bodies.simulation.positions());
        // Ten steps of 1/60 s from rest: -g t^2 / 2 = -0.136 m, from 0.24 m.
        const float height = positions.back()[1];
        std::printf("%zu particles on %s, the highest at %.3f m, %d frames in flight\n", positions.size(),
                    engine.description().name.c_str(), static_cast<double>(height), framesInFlight());
        return positions.size() == 13 * 13 * 13 && std::abs(height - 0.104f) < 0.02f ? 0 : 1;
    } catch (const sinew::vk::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
