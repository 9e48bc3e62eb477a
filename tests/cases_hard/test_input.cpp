// Hard case 12: validate() rejects negative, infinite and NaN values by name before anything runs.
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "sinew/validate.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace sinew;
using namespace sinew::sim;

namespace {

// A number of a scene or of its settings, and whether it may be negative.
struct Number {
    const char* name;
    std::function<float&(Scene&, Settings&)> of;
    bool maybeNegative = false;
};

const Number numbers[] = {
    {"scene.dt", [](Scene& s, Settings&) -> float& { return s.dt; }},
    {"scene.damping", [](Scene& s, Settings&) -> float& { return s.damping; }},
    {"scene.dampingTime", [](Scene& s, Settings&) -> float& { return s.dampingTime; }},
    {"scene.gravity", [](Scene& s, Settings&) -> float& { return s.gravity.y; }, true},
    {"particle[3].position", [](Scene& s, Settings&) -> float& { return s.particles[3].position.z; }, true},
    {"particle[3].velocity", [](Scene& s, Settings&) -> float& { return s.particles[3].velocity.x; }, true},
    {"particle[3].inverseMass", [](Scene& s, Settings&) -> float& { return s.particles[3].inverseMass; }},
    {"particle[3].contactOffset", [](Scene& s, Settings&) -> float& { return s.particles[3].contactOffset; },
     true},
    {"distance[2].restLength", [](Scene& s, Settings&) -> float& { return s.distances[2].restLength; }},
    {"distance[2].compliance", [](Scene& s, Settings&) -> float& { return s.distances[2].compliance; }},
    {"bend[0].compliance", [](Scene& s, Settings&) -> float& { return s.bends[0].compliance; }},
    {"attachment[0].anchor", [](Scene& s, Settings&) -> float& { return s.attachments[0].anchor.x; }, true},
    {"attachment[0].compliance", [](Scene& s, Settings&) -> float& { return s.attachments[0].compliance; }},
    {"attachment[0].maxForce", [](Scene& s, Settings&) -> float& { return s.attachments[0].maxForce; }},
    {"attachment[0].maxSpeed", [](Scene& s, Settings&) -> float& { return s.attachments[0].maxSpeed; }},
    {"particle[3].radius", [](Scene& s, Settings&) -> float& { return s.particles[3].radius; }},
    {"scene.contacts.friction", [](Scene& s, Settings&) -> float& { return s.contacts.friction; }},
    {"scene.contacts.staticFriction",
     [](Scene& s, Settings&) -> float& { return s.contacts.staticFriction; }},
    {"tether[0].length", [](Scene& s, Settings&) -> float& { return s.tethers[0].length; }},
    {"plane[0].normal", [](Scene& s, Settings&) -> float& { return s.planes[0].normal.y; }, true},
    {"plane[0].offset", [](Scene& s, Settings&) -> float& { return s.planes[0].offset; }, true},
    {"plane[0].friction", [](Scene& s, Settings&) -> float& { return s.planes[0].friction; }},
    {"plane[0].restitution", [](Scene& s, Settings&) -> float& { return s.planes[0].restitution; }},
    {"plane[0].staticFriction", [](Scene& s, Settings&) -> float& { return s.planes[0].staticFriction; }},
    {"body[0] \"cube\".restVolume", [](Scene& s, Settings&) -> float& { return s.bodies[0].restVolume; }},
    {"grid[0] \"cube\".compliance", [](Scene& s, Settings&) -> float& { return s.grids[0].compliance[1]; }},
    {"grid[0] \"cube\".restLength", [](Scene& s, Settings&) -> float& { return s.grids[0].restLength[0]; }},
    {"grid[0] \"cube\".volumeStiffness",
     [](Scene& s, Settings&) -> float& { return s.grids[0].volumeStiffness; }},
    {"grid[0] \"cube\".recoveryPressure",
     [](Scene& s, Settings&) -> float& { return s.grids[0].recoveryPressure; }},
    {"skin[0].cells[0].weights", [](Scene& s, Settings&) -> float& { return s.skins[0].cells[0].weights.y; }},
    {"skin[0].color", [](Scene& s, Settings&) -> float& { return s.skins[0].color.z; }},
    {"settings.tolerance", [](Scene&, Settings& s) -> float& { return s.tolerance; }},
    {"settings.omega", [](Scene&, Settings& s) -> float& { return s.omega; }},
    {"settings.theta", [](Scene&, Settings& s) -> float& { return s.theta; }},
    {"settings.weight", [](Scene&, Settings& s) -> float& { return s.weight; }},
    {"settings.overRelaxation", [](Scene&, Settings& s) -> float& { return s.overRelaxation; }},
    {"settings.warmStart", [](Scene&, Settings& s) -> float& { return s.warmStart; }},
    {"settings.contactMargin", [](Scene&, Settings& s) -> float& { return s.contactMargin; }},
};

// A setting that counts something, with the values just below and above its range.
struct Count {
    const char* name;
    std::uint32_t& (*of)(Settings&);
    std::vector<std::uint32_t> bad;
};

const Count counts[] = {
    {"settings.substeps", [](Settings& s) -> std::uint32_t& { return s.substeps; }, {1001}}, // 0: automatic
    {"settings.iterations", [](Settings& s) -> std::uint32_t& { return s.iterations; }, {0, 1001}},
    {"settings.contactRoom", [](Settings& s) -> std::uint32_t& { return s.contactRoom; }, {0, 1025}},
    {"settings.forms.columns",
     [](Settings& s) -> std::uint32_t& { return s.forms.columns; },
     {3}}, // 0: by device
    {"settings.forms.chunk", [](Settings& s) -> std::uint32_t& { return s.forms.chunk; }, {65536}},
};

Scene sceneOfAll() {
    Scene scene = test::chain(5, {1e-4f});
    scene.fixed = {{0}};
    scene.bends = {{0, 1, 2, 1}};
    scene.attachments = {{.particle = 4}};
    scene.tethers = {{2, 0, 1}};
    scene.planes = {{}};
    const LatticeCorners corners = addLattice(scene, {.name = "cube", .origin = {0, 1, 0}});
    CellEmbedding middle{.particles = {}, .weights = {0.5f, 0.5f, 0.5f}};
    std::ranges::copy(corners.particle, middle.particles.begin());
    scene.skins = {{.name = "skin", .cells = {middle}}};
    return scene;
}

void expectRefusal(const Scene& scene, const Settings& settings, const std::string& name) {
    const std::vector<std::string> complaints = validate(scene, settings);
    ASSERT_FALSE(complaints.empty()) << name;
    EXPECT_EQ(complaints.front().find(name), 0u) << complaints.front();
    EXPECT_EQ(test::refusal([&] { const Simulation simulation(test::device(), scene, settings); }).find(name),
              0u)
        << name;
}

} // namespace

TEST(HardInput, Case12WhatIsNoNumberInfiniteOrNegativeIsNamed) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    ASSERT_EQ(validate(sceneOfAll(), {}), std::vector<std::string>{});
    for (const Number& number : numbers) {
        for (const float value : {std::nanf(""), infinity, -infinity, -1.0f}) {
            if (value == -1.0f && number.maybeNegative) continue;
            SCOPED_TRACE(value);
            Scene scene = sceneOfAll();
            Settings settings;
            number.of(scene, settings) = value;
            expectRefusal(scene, settings, number.name);
        }
    }
}

TEST(HardInput, Case12TooFewAndTooManyAreNamed) {
    for (const Count& count : counts) {
        for (const std::uint32_t value : count.bad) {
            SCOPED_TRACE(value);
            Settings settings;
            count.of(settings) = value;
            expectRefusal(sceneOfAll(), settings, count.name);
        }
    }
}

// Energies are divided by the rest volume of a cell.
TEST(HardInput, Case12CellsOfNoVolumeCannotResistItsChange) {
    Scene scene;
    addLattice(scene, {.name = "cube", .poissonRatio = 0.4f});
    ASSERT_EQ(validate(scene, {}), std::vector<std::string>{});
    for (DistanceConstraint& link : scene.distances) link.restLength = 0;
    scene.grids[0].restLength = {};
    expectRefusal(scene, {}, "grid[0] \"cube\".restLength");
}
