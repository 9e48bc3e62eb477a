// Worlds that are stepped and read back one step at a time, and parts for them.
#pragma once

#include "common/layout.h"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/world.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

namespace sinew::test {

using namespace sim;

/// A cuttable box of 2^3 cells of 0.1 m with a skin, 0.3 m above a floor.
inline Scene fallingBox() {
    Scene scene;
    const Lattice lattice{.origin = {0, 0.3f, 0}, .cells = {2, 2, 2}, .spacing = 0.1f, .isCuttable = true};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {});
    scene.planes = {{}};
    return scene;
}

using Words = std::vector<std::uint32_t>;

inline Words wordsOf(const vk::BufferView& view, vk::Queue& queue = queue()) {
    if (view.size == 0) return {};
    vk::BufferView words = view;
    words.stride = sizeof(std::uint32_t);
    return queue.download<std::uint32_t>(words);
}

// A world that is stepped and read back one step at a time; `isValidated`: with the validation layer.
class Play {
public:
    explicit Play(const Scene& base, const Settings& settings, bool isValidated = false)
        : queue_(isValidated ? validatedQueue() : queue()),
          world_(isValidated ? validatedDevice() : device(), base, settings) {
        submit([&](VkCommandBuffer commands) { world_.simulation().recordReset(commands); });
    }

    World& world() { return world_; }

    // Waits until all changes have arrived.
    void settle() {
        while (world_.isChanging()) {
            bool isTaken = false;
            submit([&](VkCommandBuffer commands) { isTaken = world_.recordChanges(commands); });
            if (isTaken) world_.release(); // submit() waits
            if (!isTaken) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    PartId add(const Scene& part) {
        const PartId id = world_.add(part);
        settle();
        return id;
    }
    void remove(PartId part) {
        world_.remove(part);
        settle();
    }

    Status step(Step step = {}) {
        step.dt = world_.scene().dt;
        step.gravity = world_.scene().gravity;
        const Status status = tryStep(step);
        EXPECT_FALSE(status.isUndone) << "step " << status.frame;
        return status;
    }
    // The step may be undone.
    Status tryStep(Step step) {
        step.frame = frame_++;
        submit([&](VkCommandBuffer commands) { world_.simulation().record(commands, step); });
        return world_.simulation().status(step.frame);
    }
    Status run(int steps, const Step& given = {}) {
        Status status;
        for (int s = 0; s < steps; ++s) status = step(given);
        return status;
    }

    std::uint64_t steps() const { return frame_; }
    // False if something is awake after 10 s.
    bool fallsAsleep() {
        for (int s = 0; s < 600; ++s)
            if (step().sleeping == world_.scene().particles.size()) return true;
        return false;
    }

    PartRange at(PartId part) const { return world_.find(part).value(); }
    std::uint32_t particle(PartId part, std::uint32_t index) const {
        return at(part).first.particles + index;
    }
    // Bits of the public positions, velocities and pieces of a part.
    Words bits(PartId part) const {
        const PartRange range = at(part);
        Words result;
        for (const vk::BufferView& view :
             {world_.simulation().positions(), world_.simulation().velocities()}) {
            const Words words = wordsOf(view, queue_);
            const auto first = words.begin() + std::ptrdiff_t{4} * range.first.particles;
            result.insert(result.end(), first, first + std::ptrdiff_t{4} * range.count.particles);
        }
        const Words pieces = wordsOf(world_.simulation().pieces(), queue_);
        for (std::uint32_t i = 0; i < range.count.particles && !pieces.empty(); ++i) {
            const std::uint32_t piece = pieces[range.first.particles + i];
            result.push_back(piece < REMOVED_PIECE ? piece - range.first.particles : piece);
        }
        return result;
    }
    std::vector<Vec3> positions(PartId part) const {
        const PartRange range = at(part);
        const Words words = wordsOf(world_.simulation().positions(), queue_);
        std::vector<Vec3> result(range.count.particles);
        for (std::size_t i = 0; i < result.size(); ++i)
            std::memcpy(static_cast<void*>(&result[i]), &words[4 * (range.first.particles + i)],
                        sizeof(Vec3));
        return result;
    }
    // Positions and normals of what is drawn of cuts, and the numbers of triangles.
    Words surface() {
        submit([&](VkCommandBuffer commands) { world_.simulation().recordSkin(commands); });
        const CutSurface surface = world_.simulation().cutSurface();
        const Words counts = wordsOf(surface.counts, queue_);
        if (counts.empty()) return {};
        Words result(counts.begin(), counts.begin() + 4);
        const Words vertices = wordsOf(surface.vertices, queue_), indices = wordsOf(surface.indices, queue_);
        result.insert(result.end(), vertices.begin(), vertices.begin() + std::ptrdiff_t{8} * counts[0]);
        result.insert(result.end(), indices.begin(),
                      indices.begin() + std::ptrdiff_t{3} * (counts[1] + counts[2]));
        return result;
    }

private:
    template <typename Record> void submit(const Record& record) {
        const VkCommandBuffer commands = queue_.begin();
        record(commands);
        queue_.wait(queue_.submit(commands));
    }
    vk::Queue& queue_;
    World world_;
    std::uint64_t frame_ = 0;
};

inline Scene ground() {
    Scene scene{.name = "ground"};
    scene.planes.push_back({.friction = 0.4f});
    scene.contacts.friction = 0.4f;
    return scene;
}

inline Scene dampedGround() {
    Scene scene = ground();
    scene.damping = 4;
    return scene;
}

inline const Settings sleeping{.substeps = 8, .contactRoom = 64, .sleeps = true};

inline Scene box(const Vec3& origin, std::array<std::uint32_t, 3> cells, float radius = 0.02f) {
    Scene scene;
    const Lattice lattice{
        .origin = origin, .cells = cells, .spacing = 0.05f, .youngModulus = 5e4f, .radius = radius};
    const LatticeCorners corners = addLattice(scene, lattice);
    addLatticeSkin(scene, lattice, corners, {0.5f, 0.5f, 0.5f});
    return scene;
}

// Far from everything else.
inline Scene stranger(float x = 40) {
    return box({x, 0.3f, 0}, {3, 2, 4});
}

// Two boxes that slide down upon each other, with particles and faces as surfaces.
inline Scene slidingBoxes() {
    Scene scene = box({0, 0.03f, 0}, {4, 2, 4});
    append(scene, box({0.06f, 0.17f, 0.04f}, {3, 3, 3}));
    for (std::uint32_t g = 0; g < 2; ++g) addSurfaceFaces(scene, scene.grids[g]);
    for (Particle& particle : scene.particles) particle.velocity = {0.3f, 0, 0.1f};
    return scene;
}

} // namespace sinew::test
