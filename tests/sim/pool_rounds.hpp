// Bodies that come, touch a sheet and each other, are cut, and go, in rounds without end; and the counts on
// the device that must not drift.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace sinew::test {

/// Counts between two rounds, while all bodies of the pool are absent.
struct PoolCounts {
    std::uint32_t groups = 0, chunks = 0; ///< that run: work groups of particles; chunks of lattices
    std::uint32_t pieces = 0, deadLinks = 0, fragments = 0;
    bool operator==(const PoolCounts&) const = default;
};

class PoolRounds {
public:
    /// Refers to both.
    PoolRounds(const vk::Device& device, vk::Queue& queue)
        : queue_(queue),
          simulation_(device, scene(), {.substeps = 2, .contactRoom = 128, .sleeps = false, .motions = 4}) {}

    /// Spawns two of the bodies, cuts what may be cut of them, and despawns them: three steps. Returns the
    /// number of links cut.
    std::uint32_t play(std::uint32_t round) {
        const std::uint32_t a = 1 + round % bodies, b = 1 + (round + 1) % bodies;
        const float turned = 0.3f * static_cast<float>(round % 7);
        const sim::Quaternion turn{0, std::sin(turned), 0, std::cos(turned)};
        using sim::MotionKind;
        const std::array<sim::Motion, 4> come{
            {{.kind = MotionKind::spawn, .body = a, .rotation = turn},
             {.kind = MotionKind::spawn, .body = b, .linear = {0.02f, 0.17f, 0}},
             {.kind = MotionKind::setVelocity, .body = a, .linear = {0, -1, 0}},
             {.kind = MotionKind::setVelocity, .body = b, .linear = {0, -2, 0}}}};
        const std::array<sim::Motion, 2> go{
            {{.kind = MotionKind::despawn, .body = a}, {.kind = MotionKind::despawn, .body = b}}};
        const std::array<sim::Vec3, 2> from{{{-1, 0, 0.012f}, {-1, 1, 0.012f}}},
            to{{{1, 0, 0.012f}, {1, 1, 0.012f}}};
        step({.motions = come});
        const std::uint32_t cut = step({.blade = {.from = from, .to = to}}).linksCut;
        last_ = step({.motions = go});
        return cut;
    }
    PoolCounts counts() {
        return {word("sleep.state", 6), word("pool.chunks[0].arguments", 0), last_.pieces,
                last_.linksCutInAll, last_.debris};
    }
    std::uint32_t stepsUndone() const { return undone_; }

private:
    static constexpr std::uint32_t bodies = 4;

    static sim::Scene scene() {
        sim::Scene scene;
        sim::addCloth(scene, {.origin = {-0.25f, 0.2f, -0.25f},
                              .right = {1, 0, 0},
                              .down = {0, 0, 1},
                              .size = {11, 11},
                              .spacing = 0.05f,
                              .areaDensity = 1,
                              .membraneStiffness = 5000,
                              .thickness = 0.02f,
                              .pinned = {0, 10, 110, 120}});
        for (std::uint32_t b = 0; b < bodies; ++b) {
            sim::addLattice(scene, {.origin = {-0.07f, 0.24f, -0.07f},
                                    .cells = {2, 2, 2},
                                    .spacing = 0.05f,
                                    .youngModulus = 2e4f,
                                    .radius = 0.02f,
                                    .isCuttable = b % 2 == 0});
            sim::addSurfaceFaces(scene, scene.grids.back());
            scene.bodies.back().isAbsent = true;
        }
        scene.planes.push_back({.friction = 0.5f});
        scene.damping = 1;
        scene.debris = 3;
        return scene;
    }

    sim::Status step(sim::Step step) {
        const VkCommandBuffer commands = queue_.begin();
        if (frame_ == 0) simulation_.recordReset(commands);
        step.frame = frame_;
        simulation_.record(commands, step);
        queue_.wait(queue_.submit(commands));
        const sim::Status status = simulation_.status(frame_++);
        undone_ += status.isUndone ? 1 : 0;
        return status;
    }

    std::uint32_t word(std::string_view label, std::size_t index) {
        const sim::StepProgram& program = simulation_.program();
        for (std::uint32_t b = 0; b < program.buffers.size(); ++b)
            if (program.buffers[b].label == label)
                return queue_.download<std::uint32_t>(simulation_.view(sim::BufferId{b})).at(index);
        return 0;
    }

    vk::Queue& queue_;
    sim::Simulation simulation_;
    sim::Status last_;
    std::uint64_t frame_ = 0;
    std::uint32_t undone_ = 0;
};

} // namespace sinew::test
