// Tests that every complaint about a scene names the item, the value and the allowed range.
#include "sim/compile/compile.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A scene with one of everything: two particles, a link, a plane, a body and a skin of each kind.
Scene validScene() {
    Scene scene;
    for (int i = 0; i < 8; ++i)
        scene.particles.push_back(
            {{static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)}});
    scene.distances.push_back({0, 1, 1, 0});
    scene.fixed = {{3}, {3}}; // a duplicate is allowed
    scene.bends.push_back({0, 1, 2, 1});
    scene.attachments.push_back({.particle = 2});
    scene.tethers.push_back({0, 3, 1});
    scene.planes.push_back({});
    scene.colliders.push_back({.radius = 1});
    scene.colliders.push_back({.shape = ColliderShape::capsule, .radius = 1});
    scene.colliders.push_back({.shape = ColliderShape::box,
                               .halfExtents = {1, 1, 1},
                               .path = {{0, {}}, {1, {.position = {1, 0, 0}}}, {2, {}}},
                               .pathEnd = PathEnd::loop});
    scene.bodies.push_back({"cell", 0, 8, 1});
    scene.skins.push_back({.name = "on particles", .triangles = {{0, 1, 2}}, .particles = {0, 1, 2}});
    scene.skins.push_back(
        {.name = "in a cell", .triangles = {{0, 0, 0}}, .cells = {{{0, 1, 2, 3, 4, 5, 6, 7}, {0, 0.5f, 1}}}});
    return scene;
}

std::string firstComplaint(const Scene& scene, const Settings& settings = {}) {
    const std::vector<std::string> complaints = validate(scene, settings);
    return complaints.empty() ? "" : complaints.front();
}

struct Fault {
    const char* complaint;
    std::function<void(Scene&, Settings&)> make;
};

const Fault faults[] =
    {
        {"scene.dt: is 0, must be from 1e-06 to 0.1", [](Scene& s, Settings&) { s.dt = 0; }},
        {"scene.dt: is 0.11", [](Scene& s, Settings&) { s.dt = 0.11f; }},
        {"scene.dt: is nan", [](Scene& s, Settings&) { s.dt = notANumber; }},
        {"scene.damping: is -1, must be at least 0", [](Scene& s, Settings&) { s.damping = -1; }},
        {"scene.damping: is inf", [](Scene& s, Settings&) { s.damping = infinity; }},
        {"scene.gravity: is (0, nan, 0), must be finite",
         [](Scene& s, Settings&) { s.gravity.y = notANumber; }},
        {"scene.dt: is 9e-07", [](Scene& s, Settings&) { s.dt = 9e-7f; }},
        {"scene.dampingTime: is -1, must be from 0 to 1", [](Scene& s, Settings&) { s.dampingTime = -1; }},
        {"scene.dampingTime: is nan", [](Scene& s, Settings&) { s.dampingTime = notANumber; }},
        {"settings.substeps: is 1001, must be from 1 to 1000, or 0 for as many as it takes",
         [](Scene&, Settings& s) { s.substeps = 1001; }},
        {"settings.substeps: is 1000000000", [](Scene&, Settings& s) { s.substeps = 1'000'000'000; }},
        {"settings.tolerance: is 0, must be above 0 and below 1",
         [](Scene&, Settings& s) { s.tolerance = 0; }},
        {"settings.tolerance: is 1", [](Scene&, Settings& s) { s.tolerance = 1; }},
        {"settings.tolerance: is nan", [](Scene&, Settings& s) { s.tolerance = notANumber; }},
        {"bend[0]: is 8, but there are 8 particles", [](Scene& s, Settings&) { s.bends[0].c = 8; }},
        {"bend[0]: particles 0, 1 and 1 are not distinct", [](Scene& s, Settings&) { s.bends[0].c = 1; }},
        {"bend[0].compliance: is -1", [](Scene& s, Settings&) { s.bends[0].compliance = -1; }},
        {"attachment[0].particle: is 8", [](Scene& s, Settings&) { s.attachments[0].particle = 8; }},
        {"attachment[1]: particle 2 has an attachment already",
         [](Scene& s, Settings&) { s.attachments.push_back({.particle = 2}); }},
        {"attachment[0].anchor: is (nan, 0, 0), must be finite",
         [](Scene& s, Settings&) { s.attachments[0].anchor.x = notANumber; }},
        {"attachment[0].compliance: is inf",
         [](Scene& s, Settings&) { s.attachments[0].compliance = infinity; }},
        {"attachment[0].maxForce: is 0, must be above 0",
         [](Scene& s, Settings&) { s.attachments[0].maxForce = 0; }},
        {"attachment[0].maxSpeed: is nan",
         [](Scene& s, Settings&) { s.attachments[0].maxSpeed = notANumber; }},
        {"attachments: are 1025, at most 1024 are possible",
         [](Scene& s, Settings&) {
             s.particles.resize(1030);
             s.attachments.clear();
             for (std::uint32_t i = 4; i < 1029; ++i) s.attachments.push_back({.particle = i});
         }},
        {"colliders: are 1025, at most 1024 are possible",
         [](Scene& s, Settings&) { s.colliders.resize(1025, {.radius = 1}); }},
        {"collider[0].radius: is 0, must be above 0", [](Scene& s, Settings&) { s.colliders[0].radius = 0; }},
        {"collider[0].shape: is 9, which is no shape",
         [](Scene& s, Settings&) { s.colliders[0].shape = static_cast<ColliderShape>(9); }},
        {"collider[0].friction: is -1", [](Scene& s, Settings&) { s.colliders[0].friction = -1; }},
        {"collider[0].staticFriction: is nan",
         [](Scene& s, Settings&) { s.colliders[0].staticFriction = notANumber; }},
        {"collider[0].restitution: is 1.1, must be from 0 to 1",
         [](Scene& s, Settings&) { s.colliders[0].restitution = 1.1f; }},
        {"collider[0].margin: is -0.1", [](Scene& s, Settings&) { s.colliders[0].margin = -0.1f; }},
        {"collider[0].pose.position: is (nan, 0, 0), must be finite",
         [](Scene& s, Settings&) { s.colliders[0].pose.position.x = notANumber; }},
        {"collider[0].pose.rotation: is no unit quaternion",
         [](Scene& s, Settings&) { s.colliders[0].pose.rotation.w = 1.01f; }},
        {"collider[0].color: is 2", [](Scene& s, Settings&) { s.colliders[0].color.x = 2; }},
        {"collider[1].halfLength: is -1", [](Scene& s, Settings&) { s.colliders[1].halfLength = -1; }},
        {"collider[2].halfExtents: is 0, must be above 0",
         [](Scene& s, Settings&) { s.colliders[2].halfExtents.y = 0; }},
        {"collider[2].path[1].time: is 0, must be above 0, that of the keyframe before",
         [](Scene& s, Settings&) { s.colliders[2].path[1].time = 0; }},
        {"collider[2].path[0].time: is -1", [](Scene& s, Settings&) { s.colliders[2].path[0].time = -1; }},
        {"collider[2].path[1].rotation: is no unit quaternion",
         [](Scene& s, Settings&) {
             s.colliders[2].path[1].pose.rotation = {0, 0, 0, notANumber};
         }},
        {"collider[2].path: loops, but its last keyframe is not where its first one is",
         [](Scene& s, Settings&) { s.colliders[2].path.pop_back(); }},
        {"tether[0].particle: is 9", [](Scene& s, Settings&) { s.tethers[0].particle = 9; }},
        {"tether[0].anchor: is particle 4, which moves: fix it",
         [](Scene& s, Settings&) { s.tethers[0].anchor = 4; }},
        {"tether[0].length: is -1, must be at least 0",
         [](Scene& s, Settings&) { s.tethers[0].length = -1; }},
        {"settings.iterations: is 0", [](Scene&, Settings& s) { s.iterations = 0; }},
        {"settings.omega: is 0, must be above 0 and below 10", [](Scene&, Settings& s) { s.omega = 0; }},
        {"settings.omega: is 10", [](Scene&, Settings& s) { s.omega = 10; }},
        {"settings.omega: is nan", [](Scene&, Settings& s) { s.omega = notANumber; }},
        {"settings.omega: is 3.5, but split is stable only below 4 / (1 + 2 theta) = 3.33",
         [](Scene&, Settings& s) { s.omega = 3.5f; }},
        {"settings.theta: is -0.5, must be from 0 to 1", [](Scene&, Settings& s) { s.theta = -0.5f; }},
        {"settings.weight: is 2, must be from 0 to 1", [](Scene&, Settings& s) { s.weight = 2; }},
        {"settings.overRelaxation: is 2, must be above 0 and below 2",
         [](Scene&, Settings& s) { s.overRelaxation = 2; }},
        {"settings.warmStart: is -0.1, must be from 0 to 1",
         [](Scene&, Settings& s) { s.warmStart = -0.1f; }},
        {"settings.warmStart: is 1.01", [](Scene&, Settings& s) { s.warmStart = 1.01f; }},
        {"settings.warmStart: is nan", [](Scene&, Settings& s) { s.warmStart = notANumber; }},
        {"settings.forms.columns: is 3, must be from 0 to 2",
         [](Scene&, Settings& s) { s.forms.columns = 3; }},
        {"settings.forms.chunk: is 65536, must be from 0 to 65535",
         [](Scene&, Settings& s) { s.forms.chunk = 65536; }},
        {"settings.forms.chunk: is 4294967295", [](Scene&, Settings& s) { s.forms.chunk = 0xffffffff; }},
        {"settings.solver: is 7, which is no solver",
         [](Scene&, Settings& s) { s.solver = static_cast<Solver>(7); }},
        {"settings: substeps x iterations is 21000, must be at most 20000",
         [](Scene&, Settings& s) { s = {.solver = Solver::jacobi, .substeps = 1000, .iterations = 21}; }},
        {"grids: have 1073750016 nodes, at most 1073741824 are possible",
         [](Scene& s, Settings&) {
             s.grids.resize(2);
             s.grids[0].nodes = {1 << 15, 1, 1 << 15};
             s.grids[1].nodes = {1 << 12, 1, 2};
         }},
        {"particle[5].position: is (nan, 0, 1), must be finite",
         [](Scene& s, Settings&) { s.particles[5].position.x = notANumber; }},
        {"particle[2].velocity: is (0, 0, -inf)",
         [](Scene& s, Settings&) { s.particles[2].velocity.z = -infinity; }},
        {"particle[1].inverseMass: is -1, must be at least 0",
         [](Scene& s, Settings&) { s.particles[1].inverseMass = -1; }},
        {"particle[1].inverseMass: is inf",
         [](Scene& s, Settings&) { s.particles[1].inverseMass = infinity; }},
        {"particle[0].contactOffset: is nan",
         [](Scene& s, Settings&) { s.particles[0].contactOffset = notANumber; }},
        {"distance[0].a: is 8, but there are 8 particles", [](Scene& s, Settings&) { s.distances[0].a = 8; }},
        {"distance[0].b: is 4000000000", [](Scene& s, Settings&) { s.distances[0].b = 4'000'000'000; }},
        {"distance[0]: particles 1 and 1 are the same", [](Scene& s, Settings&) { s.distances[0].a = 1; }},
        {"distance[0].restLength: is -1", [](Scene& s, Settings&) { s.distances[0].restLength = -1; }},
        {"distance[0].compliance: is -1e-06",
         [](Scene& s, Settings&) { s.distances[0].compliance = -1e-6f; }},
        {"fixed[1].particle: is 8", [](Scene& s, Settings&) { s.fixed[1].particle = 8; }},
        {"plane[0].normal: length: is 2, must be from 0.999 to 1.001",
         [](Scene& s, Settings&) { s.planes[0].normal = {0, 2, 0}; }},
        {"plane[0].normal: length: is nan", [](Scene& s, Settings&) { s.planes[0].normal.x = notANumber; }},
        {"plane[0].offset: is inf", [](Scene& s, Settings&) { s.planes[0].offset = infinity; }},
        {"particle[0].radius: is -0.1, must be at least 0",
         [](Scene& s, Settings&) { s.particles[0].radius = -0.1f; }},
        {"scene.contacts.friction: is -1", [](Scene& s, Settings&) { s.contacts.friction = -1; }},
        {"scene.contacts.restitution: is 1.25, must be from 0 to 1",
         [](Scene& s, Settings&) { s.contacts.restitution = 1.25f; }},
        {"scene.contacts.recoverySpeed: is 0, must be above 0",
         [](Scene& s, Settings&) { s.contacts.recoverySpeed = 0; }},
        {"scene.contacts.recoverySpeed: is nan",
         [](Scene& s, Settings&) { s.contacts.recoverySpeed = notANumber; }},
        {"scene.contacts.surfaces[1].friction: is nan",
         [](Scene& s, Settings&) { s.contacts.surfaces = {{}, {.friction = notANumber}}; }},
        {"scene.contacts.surfaces[0].restitution: is -0.5",
         [](Scene& s, Settings&) { s.contacts.surfaces = {{.restitution = -0.5f}}; }},
        {"scene.contacts.surfaces: are 65, at most 64 are possible",
         [](Scene& s, Settings&) { s.contacts.surfaces.resize(65); }},
        {"particle[3].surface: is 2, but there are 2 surfaces, with the scene's own",
         [](Scene& s, Settings&) {
             s.contacts.surfaces = {{}};
             s.particles[3].surface = 2;
         }},
        {"settings.contactMargin: is 0, must be above 0", [](Scene&, Settings& s) { s.contactMargin = 0; }},
        {"settings.contactRoom: is 1025, must be from 1 to 1024",
         [](Scene&, Settings& s) { s.contactRoom = 1025; }},
        {"settings.contactRoom: is 0", [](Scene&, Settings& s) { s.contactRoom = 0; }},
        {"plane[0].friction: is -0.5", [](Scene& s, Settings&) { s.planes[0].friction = -0.5f; }},
        {"plane[0].restitution: is 1.5, must be from 0 to 1",
         [](Scene& s, Settings&) { s.planes[0].restitution = 1.5f; }},
        {"planes: are 33, at most 32 are possible", [](Scene& s, Settings&) { s.planes.resize(33); }},
        {"body[0] \"cell\": ends at particle 9, but there are 8",
         [](Scene& s, Settings&) { s.bodies[0].firstParticle = 1; }},
        {"body[0] \"cell\": ends at particle 4294967303",
         [](Scene& s, Settings&) { s.bodies[0].firstParticle = 0xffffffff; }},
        {"body[0] \"cell\".color: is 2", [](Scene& s, Settings&) { s.bodies[0].color.y = 2; }},
        {"body[0] \"cell\".restVolume: is -1", [](Scene& s, Settings&) { s.bodies[0].restVolume = -1; }},
        {"skin[0]: has no vertices", [](Scene& s, Settings&) { s.skins[0].particles.clear(); }},
        {"skin[0]: has both particles and cells", [](Scene& s, Settings&) { s.skins[0].cells.resize(3); }},
        {"skin[0].particles[1]: is 8", [](Scene& s, Settings&) { s.skins[0].particles[1] = 8; }},
        {"skin[0].triangles[0]: is 3, but there are 3 vertices",
         [](Scene& s, Settings&) { s.skins[0].triangles[0][2] = 3; }},
        {"skin[0].wholeOf[0]: is 1, but there are 1 whole triangles",
         [](Scene& s, Settings&) {
             s.skins[0].wholeTriangles = {{0, 1, 2}};
             s.skins[0].wholeOf = {1};
         }},
        {"skin[0]: has wholeOf for 2 of 1 triangles",
         [](Scene& s, Settings&) {
             s.skins[0].wholeTriangles = {{0, 1, 2}};
             s.skins[0].wholeOf = {0, 0};
         }},
        {"skin[0].wholeTriangles[0]: is 3, but there are 3 vertices",
         [](Scene& s, Settings&) { s.skins[0].wholeTriangles = {{0, 1, 3}}; }},
        {"skin[0].color: is 1.5", [](Scene& s, Settings&) { s.skins[0].color.y = 1.5f; }},
        {"skin[1].cells[0].particles: is 9",
         [](Scene& s, Settings&) { s.skins[1].cells[0].particles[7] = 9; }},
        {"skin[1].cells[0].weights: is 1.5",
         [](Scene& s, Settings&) { s.skins[1].cells[0].weights.z = 1.5f; }},
        {"skin[1].cells[0].weights: is nan",
         [](Scene& s, Settings&) { s.skins[1].cells[0].weights.x = notANumber; }},
};

} // namespace

TEST(Validate, FindsNothingWrongWithOneOfEverything) {
    EXPECT_EQ(firstComplaint(validScene()), "");
}

TEST(Validate, AcceptsTheEndsOfEveryClosedRange) {
    Scene scene = validScene();
    scene.dt = 0.1f;
    scene.damping = 0;
    scene.planes[0].restitution = 1;
    scene.planes.resize(32);
    scene.particles[0].inverseMass = 0;
    Settings settings{.substeps = 1000,
                      .iterations = 1000,
                      .omega = 1.3f,
                      .theta = 1,
                      .weight = 1,
                      .overRelaxation = 1.99f,
                      .warmStart = 1};
    EXPECT_EQ(firstComplaint(scene, settings), "");
}

TEST(Validate, NamesItemValueAndRangeOfEachFault) {
    for (const Fault& fault : faults) {
        Scene scene = validScene();
        Settings settings;
        fault.make(scene, settings);
        const std::vector<std::string> complaints = validate(scene, settings);
        ASSERT_FALSE(complaints.empty()) << fault.complaint;
        EXPECT_EQ(complaints.front().substr(0, std::string(fault.complaint).size()), fault.complaint);
        EXPECT_LE(complaints.size(), 2u) << fault.complaint; // one fault gives few complaints
    }
}

TEST(Compile, RefusesSettingsInTheSameSentence) {
    std::size_t refused = 0;
    for (const Fault& fault : faults) {
        if (std::string_view(fault.complaint).substr(0, 8) != "settings") continue;
        Scene scene = validScene();
        Settings settings;
        fault.make(scene, settings);
        try {
            compile(scene, settings);
            ADD_FAILURE() << fault.complaint;
        } catch (const std::invalid_argument& refusal) {
            EXPECT_EQ(std::string(refusal.what()).find(fault.complaint), 0u) << refusal.what();
            ++refused;
        }
    }
    EXPECT_GE(refused, 20u);
}

TEST(Validate, LeavesTheStabilityBoundOfSplitToSplit) {
    EXPECT_EQ(firstComplaint(validScene(), {.solver = Solver::jacobi, .omega = 3.5f}), "");
}

TEST(Validate, BoundsTheSweepsOfOneStep) {
    EXPECT_EQ(firstComplaint(validScene(), {.solver = Solver::jacobi, .substeps = 1000, .iterations = 20}),
              "");
    EXPECT_EQ(firstComplaint(validScene(), {.solver = Solver::jacobi, .substeps = 1000, .iterations = 21}),
              "settings: substeps x iterations is 21000, must be at most 20000");
    EXPECT_EQ(firstComplaint(validScene(), {.solver = Solver::split, .substeps = 1000, .iterations = 1000}),
              "");
}

TEST(Validate, BoundsTheLinksOfOneParticle) {
    Scene hub;
    hub.particles.resize(60'002);
    for (std::uint32_t spoke = 1; spoke < 60'001; ++spoke) hub.distances.push_back({0, spoke, 1, 0});
    EXPECT_EQ(firstComplaint(hub), "");
    hub.distances.push_back({0, 60'001, 1, 0});
    for (const Solver solver : {Solver::split, Solver::jacobi})
        EXPECT_EQ(firstComplaint(hub, {.solver = solver}),
                  "particle[0]: has more than 60000 distance constraints, the most this solver takes");
    hub.particles.resize(130);
    hub.distances.resize(129);
    EXPECT_EQ(firstComplaint(hub, {.solver = Solver::gaussSeidel, .substeps = 1}),
              "particle[0]: has more than 128 distance constraints, the most this solver takes with a warm "
              "start");
    const Settings cold{.solver = Solver::gaussSeidel, .substeps = 1, .warmStart = 0};
    EXPECT_EQ(firstComplaint(hub, cold), "");
    hub.fixed = {{0}}; // a fixed particle gathers nothing
    EXPECT_EQ(firstComplaint(hub, {.solver = Solver::gaussSeidel, .substeps = 1}), "");
}

// Uses the chosen number of substeps, not the largest possible one.
TEST(Validate, BoundsTheSweepsOfOneStepOfAsManySubstepsAsItTakes) {
    Scene scene = test::hangingChain(3, 0.1f, 0.01f, 1e-3f);
    Settings settings{.solver = Solver::jacobi, .iterations = 250};
    const std::uint32_t chosen = chooseSubsteps(scene, settings).substeps;
    ASSERT_GT(250u * 256, ranges::mostSweeps);
    ASSERT_LE(250u * chosen, ranges::mostSweeps);
    EXPECT_EQ(firstComplaint(scene, settings), "");
    EXPECT_EQ(compile(scene, settings).sweeps, 250u * chosen);
    for (DistanceConstraint& link : scene.distances) link.compliance = 1e-7f;
    const std::uint32_t many = chooseSubsteps(scene, settings).substeps;
    ASSERT_GT(250u * many, ranges::mostSweeps);
    ASSERT_LT(many, ranges::mostChosen);
    const std::string refusal =
        "settings: substeps x iterations is " + std::to_string(250 * many) + ", must be at most 20000";
    EXPECT_EQ(firstComplaint(scene, settings), refusal);
    EXPECT_THROW(compile(scene, settings), std::invalid_argument);
    settings.solver = Solver::split; // has no iterations
    EXPECT_EQ(firstComplaint(scene, settings), "");
}

TEST(Validate, BoundsTheBendsOfOneParticle) {
    Scene hub;
    hub.particles.resize(10'001);
    for (std::uint32_t k = 0; k < 128; ++k) hub.bends.push_back({2 * k + 1, 0, 2 * k + 2, 1});
    const Solver solvers[] = {Solver::split, Solver::jacobi, Solver::gaussSeidel};
    for (const Solver solver : solvers) EXPECT_EQ(firstComplaint(hub, {.solver = solver}), "");
    for (std::uint32_t k = 128; k < 5000; ++k) hub.bends.push_back({2 * k + 1, 0, 2 * k + 2, 1});
    for (const Solver solver : solvers)
        EXPECT_EQ(validate(hub, {.solver = solver}),
                  std::vector<std::string>{
                      "particle[0]: has more than 128 bends, the most that a particle may have"});
}

// Slots are counted by grid. Particles of two grids would be written past the end.
TEST(Validate, RefusesGridsThatShareParticlesOrConstraints) {
    Scene scene;
    addLattice(scene, {.name = "a", .cells = {9, 9, 9}});
    addLattice(scene, {.name = "b", .origin = {2, 0, 0}, .cells = {2, 2, 2}});
    scene.particles.resize(scene.particles.size() + 2000);
    EXPECT_EQ(firstComplaint(scene), "");
    scene.grids.push_back(scene.grids[0]);
    const std::string particles = "grid[2] \"a\": shares particles with grid[0] \"a\", must have its own",
                      links =
                          "grid[2] \"a\": shares distance constraints with grid[0] \"a\", must have its own";
    EXPECT_EQ(validate(scene, {}), (std::vector{particles, links}));
    std::swap(scene.grids[0], scene.grids[1]); // for any order of the two
    scene.grids[1].name = "c";
    EXPECT_EQ(firstComplaint(scene), "grid[2] \"a\": shares particles with grid[1] \"c\", must have its own");
}

// Each spoke of a moving hub is a color of its own.
TEST(Validate, BoundsThePassesOfOneStep) {
    Scene hub;
    hub.particles.resize(62);
    for (std::uint32_t spoke = 1; spoke < 61; ++spoke) hub.distances.push_back({0, spoke, 1, 0});
    const Settings settings{.solver = Solver::gaussSeidel, .substeps = 500, .iterations = 2};
    EXPECT_EQ(firstComplaint(hub, settings), "");
    hub.distances.push_back({0, 61, 1, 0});
    EXPECT_EQ(firstComplaint(hub, settings),
              "settings: substeps x iterations x 61 colors of constraints is 61000 passes of gauss_seidel, "
              "must be at most 60000");
    EXPECT_EQ(firstComplaint(hub, {.solver = Solver::jacobi, .substeps = 500, .iterations = 2}), "");
    hub.fixed = {{0}};
    EXPECT_EQ(firstComplaint(hub, settings), "");
    EXPECT_EQ(firstComplaint(hub, {.solver = Solver::gaussSeidel, .substeps = 201, .iterations = 100}),
              "settings: substeps x iterations is 20100, must be at most 20000");
}

TEST(Validate, TakesEveryConstraintWithEverySolver) {
    Scene scene = test::chain(4);
    scene.fixed = {{0}};
    scene.bends = {{0, 1, 2, 1}};
    scene.attachments = {{.particle = 2}};
    scene.tethers = {{.particle = 3, .anchor = 0, .length = 1}};
    scene.dampingTime = 0.001f;
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel})
        EXPECT_EQ(firstComplaint(scene, {.solver = solver}), "");
}

// The number of passes follows from the number of substeps that the stiffness requires.
TEST(Validate, BoundsThePassesOfOneStepOfAsManySubstepsAsItTakes) {
    Scene hub;
    hub.particles.resize(62);
    for (std::uint32_t spoke = 1; spoke < 62; ++spoke) hub.distances.push_back({0, spoke, 1, 1e-9f});
    Settings settings{.solver = Solver::gaussSeidel, .substeps = 0, .iterations = 4};
    EXPECT_EQ(firstComplaint(hub, settings),
              "settings: substeps x iterations x 61 colors of constraints is 62464 passes of gauss_seidel, "
              "must be at most 60000");
    for (DistanceConstraint& spoke : hub.distances) spoke.compliance = 1e-3f;
    EXPECT_EQ(firstComplaint(hub, settings), "");
}

// A coloring would read past the end.
TEST(Validate, FindsABadIndexWithEverySolver) {
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        Scene scene = validScene();
        scene.distances[0].b = 4'000'000'000;
        EXPECT_EQ(firstComplaint(scene, {.solver = solver}),
                  "distance[0].b: is 4000000000, but there are 8 particles");
    }
}

TEST(Validate, CountsWhatItDoesNotSpellOut) {
    Scene scene = validScene();
    scene.distances.assign(100, {2, 2, 1, 0});
    const std::vector<std::string> complaints = validate(scene, {});
    ASSERT_EQ(complaints.size(), 21u);
    EXPECT_EQ(complaints[19], "distance[19]: particles 2 and 2 are the same");
    EXPECT_EQ(complaints[20], "and 80 more complaints");
}

TEST(Ranges, ReadLikeTheEndOfASentence) {
    EXPECT_EQ(toText(ranges::tolerance), "above 0 and below 1");
    EXPECT_EQ(toText(ranges::substeps), "from 1 to 1000");
    EXPECT_EQ(toText(ranges::damping), "at least 0");
    EXPECT_EQ(toText(ranges::finite), "a finite number");
}

TEST(Ranges, HoldNeitherNaNNorInfinity) {
    for (const float value : {notANumber, infinity, -infinity}) {
        EXPECT_FALSE(ranges::finite.holds(double{value}));
        EXPECT_FALSE(ranges::compliance.holds(double{value}));
    }
}
