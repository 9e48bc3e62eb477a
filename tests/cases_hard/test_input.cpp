// Hard case 12: what is negative, infinite or no number is rejected by name, before anything runs.
#include "sim/scenes.hpp"
#include "sim/simulation.hpp"
#include "sim/validate.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Every number of a scene, and whether it may be negative.
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
    {"tether[0].length", [](Scene& s, Settings&) -> float& { return s.tethers[0].length; }},
    {"plane[0].normal", [](Scene& s, Settings&) -> float& { return s.planes[0].normal.y; }, true},
    {"plane[0].offset", [](Scene& s, Settings&) -> float& { return s.planes[0].offset; }, true},
    {"plane[0].friction", [](Scene& s, Settings&) -> float& { return s.planes[0].friction; }},
    {"plane[0].restitution", [](Scene& s, Settings&) -> float& { return s.planes[0].restitution; }},
    {"settings.tolerance", [](Scene&, Settings& s) -> float& { return s.tolerance; }},
    {"settings.omega", [](Scene&, Settings& s) -> float& { return s.omega; }},
    {"settings.theta", [](Scene&, Settings& s) -> float& { return s.theta; }},
    {"settings.weight", [](Scene&, Settings& s) -> float& { return s.weight; }},
    {"settings.overRelaxation", [](Scene&, Settings& s) -> float& { return s.overRelaxation; }},
};

Scene sceneOfAll() {
    Scene scene = test::chain(5, {1e-4f});
    scene.fixed = {{0}};
    scene.bends = {{0, 1, 2, 1}};
    scene.attachments = {{.particle = 4}};
    scene.tethers = {{2, 0, 1}};
    scene.planes = {{}};
    return scene;
}

} // namespace

TEST(HardInput, Case12WhatIsNoNumberInfiniteOrNegativeIsNamed) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const Number& number : numbers) {
        for (const float value : {std::nanf(""), infinity, -infinity, -1.0f}) {
            if (value == -1.0f && number.maybeNegative) continue;
            Scene scene = sceneOfAll();
            Settings settings;
            ASSERT_TRUE(validate(scene, settings).empty()) << validate(scene, settings).front();
            number.of(scene, settings) = value;
            const std::vector<std::string> complaints = validate(scene, settings);
            ASSERT_FALSE(complaints.empty()) << number.name << " = " << value;
            EXPECT_EQ(complaints.front().find(number.name), 0u) << complaints.front();
            try {
                const Simulation simulation(test::device(), scene, settings);
                ADD_FAILURE() << number.name << " = " << value << " was taken";
            } catch (const std::invalid_argument& error) {
                EXPECT_EQ(std::string(error.what()).find(number.name), 0u);
            }
        }
    }
}
