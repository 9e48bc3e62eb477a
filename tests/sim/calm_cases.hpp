// Scenes for tests of repeated steps: bodies meet after a flight, so that a calm step needs contact lists.
#pragma once

#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/start.hpp"

#include <array>
#include <cstdint>
#include <functional>

namespace sinew::sim {

inline constexpr float spacing = 0.05f;

inline void addBox(Scene& scene, Vec3 origin, std::array<std::uint32_t, 3> cells, const Start& how = {},
                   bool isCuttable = false) {
    const std::size_t first = scene.bodies.size();
    addLattice(scene, {.origin = origin,
                       .cells = cells,
                       .spacing = spacing,
                       .youngModulus = 2e5f,
                       .radius = 0.45f * spacing,
                       .isCuttable = isCuttable});
    start(scene, first, how);
}

// Fills in the host's part of a step, by its frame number.
using Input = std::function<void(Step&)>;

struct Case {
    const char* name;
    Scene scene;
    Settings settings;
    std::uint64_t steps = 40;
    Input input = {};
    bool isBroken = false; // some calm step needs lists
};

inline Scene onFloor() {
    Scene scene;
    scene.planes = {{.friction = 0.4f}};
    return scene;
}

// A box that falls onto a floor.
inline Case landing() {
    Case one{"a box that lands", onFloor(), {.substeps = 16, .contactRoom = 64}, 30, {}, true};
    addBox(one.scene, {0, 0.6f, 0}, {4, 4, 4});
    return one;
}

// Two boxes that fly until they collide.
inline Case collision() {
    Case one{"boxes that collide", {}, {.substeps = 12, .contactRoom = 64, .hostColliders = 1}, 30, {}, true};
    one.scene.gravity = {0, 0, 0};
    one.scene.contacts = {.friction = 0.3f, .restitution = 0.4f};
    addBox(one.scene, {0, 0, 0}, {3, 3, 3}, {.velocity = {1.5f, 0, 0}});
    addBox(one.scene, {1, 0.05f, 0}, {3, 3, 3}, {.velocity = {-1.5f, 0, 0}, .spin = {0, 1, 2}});
    return one;
}

// The state has a part that the host controls. While two boxes collide, a grab with a bounded speed leads a
// third box, and a collider on a path and a host collider move beside it.
inline Case ledByTheHost() {
    Case one = collision();
    one.name = "a box that is led";
    addBox(one.scene, {0, 1, 0}, {3, 3, 3});
    const auto last = static_cast<std::uint32_t>(one.scene.particles.size() - 1);
    const Vec3 place = one.scene.particles[last].position;
    one.scene.attachments = {{.particle = last, .anchor = place, .maxSpeed = 0.04f}};
    one.scene.colliders = {{.radius = 0.1f,
                            .path = {{.time = 0, .pose = {.position = {0.28f, 1.1f, 0.1f}}},
                                     {.time = 1, .pose = {.position = {0.2f, 1.1f, 0.1f}}}}}};
    one.input = [place](Step& step) {
        static std::array<Vec3, 1> anchors;
        static std::array<HostCollider, 1> hostColliders;
        const auto frame = static_cast<float>(step.frame);
        anchors = {{{place.x + 0.01f * frame, place.y, place.z}}};
        hostColliders = {{{.radius = 0.08f,
                           .pose = {.position = {0.1f, 0.905f + 0.002f * frame, 0.1f}},
                           .maxSpeed = 0.05f}}};
        step.anchors = anchors;
        step.hostColliders = hostColliders;
    };
    return one;
}

} // namespace sinew::sim
