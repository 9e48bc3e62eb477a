// The README's embedding example, compiled and run by the tests. README.md quotes the text below the pragma.
#pragma once

#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"

struct SoftBodies {
    sinew::vk::Device device;
    sinew::sim::Simulation simulation;

    explicit SoftBodies(const sinew::vk::HostDevice& engine) // your handles and your vkGetInstanceProcAddr
        : device(sinew::vk::Device::borrow(engine)), simulation(device, makeScene(), {.substeps = 32}) {}

    static sinew::sim::Scene makeScene() {
        sinew::sim::Scene scene;
        sinew::sim::addLattice(scene, {.cells = {12, 12, 12}, .spacing = 0.02f, .youngModulus = 3e4f});
        scene.planes.push_back({.normal = {0, 1, 0}, .offset = -0.1f, .friction = 0.5f});
        return scene;
    }

    void recordFrame(VkCommandBuffer commands, std::uint64_t frame) { // recording, outside a render pass
        if (frame == 0) simulation.recordReset(commands);
        simulation.record(commands, {.dt = 1.0f / 60, .frame = frame});
    } // then draw simulation.positions().buffer: a vec4 a particle, w = inverse mass
};
