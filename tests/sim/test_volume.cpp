// Tests of cell volumes in `split`: equal bits in every form of the kernel, momentum, one step against double
// precision, and the double precision against its own energy. Scenes that cannot be computed are refused.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/reference/elasticity.hpp"
#include "sim/reference/implicit_step.hpp"
#include "sim/reference/potential.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60, spacing = 0.1f;

struct Material {
    float poissonRatio = 0.25f, recovery = 0;
};

Scene body(std::array<std::uint32_t, 3> cells, Material material, std::vector<float> fill = {},
           bool hasBodyDiagonals = false) {
    Scene scene{.name = "voxels"};
    addLattice(scene, {.origin = {0.1f, 0.5f, 0.2f},
                       .cells = cells,
                       .spacing = spacing,
                       .fill = std::move(fill),
                       .youngModulus = 2e5f,
                       .poissonRatio = material.poissonRatio,
                       .recovery = material.recovery,
                       .hasBodyDiagonals = hasBodyDiagonals});
    return scene;
}

// One body with volumes, one with recovery, one with neither, and a cloth.
Scene mixture() {
    Scene scene = test::sheet(5, 1e-4f);
    for (const Material material : {Material{0.45f, 0}, Material{0.25f, 1}, Material{}})
        addLattice(scene, {.origin = {scene.grids.back().restLength[0], 0.5f, 0},
                           .cells = {2, 3, 4},
                           .spacing = spacing,
                           .youngModulus = 2e5f,
                           .poissonRatio = material.poissonRatio,
                           .recovery = material.recovery});
    return scene;
}

Scene disturbed(Scene scene, float distance, float speed) {
    test::disturb(scene, distance, speed);
    return scene;
}

// The scene with positions scaled by `factor` along x, y, z.
Scene scaled(Scene scene, Vec3 factor) {
    for (Particle& particle : scene.particles)
        particle.position = {factor.x * particle.position.x, factor.y * particle.position.y,
                             factor.z * particle.position.z};
    return scene;
}

std::vector<std::pair<const char*, Scene>> scenes() {
    const Material volume{0.45f, 0}, stiff{0.49f, 1}, recovery{0.25f, 1};
    const auto shaken = [](Scene scene) { return disturbed(std::move(scene), 0.01f, 1); };
    return {{"one cell", shaken(body({1, 1, 1}, volume))},
            {"rod", shaken(body({1, 1, 40}, stiff))},
            {"flat", shaken(body({9, 1, 4}, recovery))},
            {"odd block", shaken(body({4, 6, 8}, volume))},
            {"even block", shaken(body({5, 5, 19}, stiff))},
            {"ragged", shaken(body({7, 6, 9}, stiff, test::raggedFill(7 * 6 * 9)))},
            {"26 neighbours", shaken(body({4, 5, 6}, stiff, test::raggedFill(4 * 5 * 6), true))},
            {"mixture", shaken(mixture())},
            {"stretched", shaken(scaled(body({3, 3, 3}, volume), {3, 2, 0.5f}))},
            {"mirrored", shaken(scaled(body({3, 3, 3}, volume), {-1, 1, 1}))},
            {"recovering", shaken(scaled(body({3, 3, 3}, recovery), {-1, 1, 1}))},
            {"flattened", shaken(scaled(body({3, 3, 3}, recovery), {1, 1, 0.01f}))},
            {"tangled", disturbed(body({3, 3, 3}, volume), 0.15f, 1)}};
}

std::string complaintAbout(const Scene& scene, const Settings& settings = {}) {
    const auto complaints = validate(scene, settings);
    return complaints.empty() ? "none" : complaints.front();
}

} // namespace

TEST(CellVolume, AddsNothingToABodyThatDoesNotAsk) {
    EXPECT_TRUE(test::usesKernel(body({3, 3, 3}, {}), "gather_lattice"));
    EXPECT_FALSE(test::usesKernel(body({3, 3, 3}, {}), "gather_lattice_volume"));
    EXPECT_TRUE(test::usesKernel(body({3, 3, 3}, {0.3f, 0}), "gather_lattice_volume"));
    EXPECT_FALSE(test::usesKernel(body({3, 3, 3}, {0.3f, 0}), "gather_lattice"));
    const StepProgram with = compile(body({3, 3, 3}, {0.3f, 0}), {}),
                      without = compile(body({3, 3, 3}, {}), {});
    EXPECT_EQ(with[List::step].size(), without[List::step].size()) << "still one pass a substep";
    EXPECT_EQ(with.buffers.size(), without.buffers.size());
}

TEST(CellVolume, FormsGiveTheSameBits) {
    const Forms forms[] = {{.chunk = 3},
                           {.columns = 1, .chunk = 5},
                           {.usesTexels = false, .chunk = 64},
                           {.usesTexels = false, .columns = 1, .chunk = 2},
                           {.columns = 1, .chunk = 1},
                           {.residentBytes = 32768},
                           {.columns = 1, .chunk = 1, .residentBytes = 32768}}; // if the bodies fit
    ASSERT_TRUE(test::usesKernel(body({3, 3, 3}, {0.3f, 0}), "gather_node_volume", {.forms = forms[4]}));
    bool isInRoom = false;
    for (auto& [name, scene] : scenes()) {
        isInRoom = !isInRoom;
        if (isInRoom) test::addRoom(scene);
        const std::uint64_t expected = test::hashOfRun(scene, {.substeps = 5});
        EXPECT_EQ(test::hashOfRun(scene, {.substeps = 5, .isReversed = true}), expected)
            << name << ", reversed";
        for (const Forms& form : forms)
            EXPECT_EQ(test::hashOfRun(scene, {.substeps = 5, .forms = form}), expected)
                << name << ", texels " << form.usesTexels << ", columns " << form.columns << ", chunk "
                << form.chunk;
    }
}

// Mirrored cells fly apart. In 16 substeps a frame, the motion amplifies rounding of the start 180 times
// (measured in double), so a step is an eighth of a frame there.
TEST(CellVolume, AgreesWithDoubleAfterAStep) {
    for (auto& [name, scene] : scenes())
        for (const std::uint32_t substeps : {1u, 2u, 16u}) {
            const bool isViolent = std::string(name) == "mirrored" && substeps == 16;
            const float dt = isViolent ? frame / 8 : frame;
            const Settings settings{.substeps = substeps};
            test::Runner runner(scene, settings);
            runner.step(dt);
            reference::State state = reference::initialState(scene);
            test::stepReference(scene, settings, dt, state);
            const double difference = test::differenceOf(runner, state, scene, dt);
            EXPECT_LE(difference, 1e-5) << name << ", " << substeps << " substeps";
            RecordProperty(std::string(name) + " " + std::to_string(substeps),
                           std::to_string(1e6 * difference) + "e-6");
        }
}

TEST(CellVolume, KeepsMomentumToRounding) {
    for (const Material material : {Material{0.49f, 0}, Material{0.25f, 1}})
        for (const float distance : {0.01f, 0.15f}) {
            Scene scene = disturbed(body({5, 4, 6}, material, test::raggedFill(5 * 4 * 6)), distance, 1);
            scene.gravity = {0, 0, 0};
            const auto momentum = [&](const std::vector<Vector3d>& v) {
                Vector3d sum = Vector3d::Zero();
                for (std::size_t i = 0; i < v.size(); ++i)
                    sum += v[i] / double{scene.particles[i].inverseMass};
                return sum;
            };
            const Vector3d before = momentum(reference::initialState(scene).v);
            test::Runner runner(scene, {.substeps = 10});
            EXPECT_EQ(runner.run(20).nonFinite, 0u);
            EXPECT_LE((momentum(runner.velocities()) - before).norm(), 1e-6 * test::massOf(scene))
                << "Poisson ratio " << material.poissonRatio << ", " << distance << " m";
        }
}

TEST(CellVolume, FeedsNoEnergyIntoAnyState) {
    for (auto& [name, scene] : scenes())
        for (const std::uint32_t substeps : {2u, 16u}) {
            if (!scene.fixed.empty()) continue; // the mixture is held
            scene.gravity = {0, 0, 0};
            test::Runner runner(scene, {.substeps = substeps});
            reference::State state = reference::initialState(scene);
            const double start = reference::energy(scene, state).total();
            for (int step = 0; step < 15; ++step) {
                ASSERT_EQ(runner.run(step < 5 ? 1 : 3).nonFinite, 0u);
                state.x = runner.positions();
                state.v = runner.velocities();
                ASSERT_LE(reference::energy(scene, state).kinetic, 1.01 * start)
                    << name << ", " << substeps << " substeps, step " << step;
            }
            EXPECT_LE(reference::energy(scene, state).total(), start) << name << ", " << substeps;
        }
}

TEST(CellVolume, WorksOnAFallingAndOnAFixedBody) {
    Scene scene = body({3, 3, 3}, {0.49f, 1});
    scene.fixed = {{0}, {1}, {5}};
    const auto before = reference::initialState(scene).x;
    test::Runner runner(scene, {});
    ASSERT_EQ(runner.run(30).nonFinite, 0u);
    for (const std::size_t i : {0, 1, 5}) EXPECT_EQ(runner.positions()[i], before[i]);
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) scene.fixed.push_back({i});
    test::Runner allFixed(scene, {});
    ASSERT_EQ(allFixed.run(3).nonFinite, 0u);
    EXPECT_EQ(allFixed.positions(), before);
}

TEST(CellVolume, IsResidentWhereABodyFits) {
    const auto program = [](std::uint32_t bytes) {
        return compile(body({3, 3, 3}, {0.45f, 0}), {.substeps = 8, .forms = {.residentBytes = bytes}});
    };
    const auto has = [](const StepProgram& built, const char* label) {
        return std::ranges::any_of(built[List::step], [&](const Pass& pass) { return pass.label == label; });
    };
    EXPECT_TRUE(has(program(32768), "resident_lattice_volume"));
    EXPECT_FALSE(has(program(0), "resident_lattice_volume"));
}

TEST(CellVolume, AsksForTheSubstepsItsStiffnessNeeds) {
    const auto needed = [](float poissonRatio) {
        return chooseSubsteps(body({4, 4, 4}, {poissonRatio, 0}), {.substeps = 0, .tolerance = 0.05f}).wanted;
    };
    const double links = needed(0.25f);
    // At constant Young's modulus, links soften by 1.25 / (1 + nu), and cells add lambda_v / mu / 3 to the
    // links' share.
    EXPECT_NEAR(needed(0.45f) / links, std::sqrt(1.25 / 1.45 * (1 + 8 / 3.0)), 0.2);
    EXPECT_NEAR(needed(0.49f) / links, std::sqrt(1.25 / 1.49 * (1 + 48 / 3.0)), 0.5);
    const Scene scene = body({4, 4, 4}, {0.49f, 0});
    Settings settings{.substeps = static_cast<std::uint32_t>(needed(0.49f))};
    EXPECT_EQ(inspectStiffness(scene, settings).soft, 0u);
    settings.substeps /= 2;
    EXPECT_GT(inspectStiffness(scene, settings).soft, 0u);
    EXPECT_EQ(inspectStiffness(scene, settings).elastic, scene.distances.size() + 64);
}

TEST(CellVolume, MovesOnlyTheCornersOfCollapsedCellsAtTheStart) {
    Scene scene = body({3, 3, 3}, {0.45f, 0});
    const std::vector<float> masses = inverseMasses(scene);
    const auto moved = [&](const Scene& start, std::span<const float> inverseMass) {
        std::size_t count = 0;
        const std::vector<Vec3> positions = lattice::startingPositions(start, inverseMass);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const double distance =
                (test::toVector(positions[i]) - test::toVector(start.particles[i].position)).norm();
            EXPECT_LE(distance, 2e-3 * spacing);
            count += distance > 0;
        }
        return count;
    };
    EXPECT_EQ(moved(scene, masses), 0u);
    EXPECT_EQ(moved(scaled(scene, {1, 1, 0}), masses), 0u) << "a plane has a side to leave to";
    EXPECT_EQ(moved(scaled(scene, {1, 0, 0}), masses), 64u);
    EXPECT_EQ(moved(scaled(scene, {0, 0, 0}), masses), 64u);
    EXPECT_EQ(moved(scaled(scene, {0, 0, 0}), std::vector<float>(64, 0)), 0u) << "what is fixed";
    EXPECT_EQ(moved(scaled(body({3, 3, 3}, {}), {0, 0, 0}), masses), 0u) << "no volumes";
}

TEST(CellVolume, IsRefusedInASentenceWhereItWouldBeLost) {
    Scene scene = body({2, 2, 2}, {0.45f, 0});
    EXPECT_EQ(complaintAbout(scene), "none");
    const std::string has = "grid[0] \"lattice\": has cell volumes (a Poisson ratio above 1/4 or recovery), ";
    EXPECT_EQ(complaintAbout(scene, {.solver = Solver::jacobi}),
              has + "which solver jacobi does not support: use split");
    EXPECT_EQ(complaintAbout(scene, {.forms = {.usesGrids = false}}),
              has + "which need settings.forms.usesGrids");
    Scene tied = scene;
    tied.particles.push_back({.position = {1, 1, 1}});
    tied.distances.push_back({0, static_cast<std::uint32_t>(tied.particles.size() - 1), 1, 1e-3f});
    EXPECT_EQ(complaintAbout(tied), has + "but distance[" + std::to_string(tied.distances.size() - 1) +
                                        "] holds it beside its own links: leave that out");
    Scene damped = scene;
    damped.dampingTime = 0.01f;
    EXPECT_EQ(complaintAbout(damped), has + "but the scene has a damping time (internal damping), beside "
                                            "which split does not support that: make it 0");
    const Scene recovering = body({2, 2, 2}, {0.25f, 1});
    EXPECT_EQ(complaintAbout(recovering), "none");
    EXPECT_EQ(complaintAbout(recovering, {.omega = 3.1f}),
              "settings.omega: is 3.1, but recovery needs it below 3");
    const std::pair<std::function<void(Grid&)>, const char*> cases[] = {
        {[](Grid& grid) { grid.volumeStiffness = -1; }, ".volumeStiffness: is -1, must be at least 0"},
        {[](Grid& grid) { grid.volumeStiffness = NAN; }, ".volumeStiffness: is nan, must be at least 0"},
        {[](Grid& grid) { grid.recoveryPressure = INFINITY; },
         ".recoveryPressure: is inf, must be at least 0"}};
    for (const auto& [damage, complaint] : cases) {
        Scene damaged = scene;
        damage(damaged.grids[0]);
        EXPECT_NE(complaintAbout(damaged).find(complaint), std::string::npos) << complaintAbout(damaged);
    }
    Scene sheet = test::sheet(4);
    sheet.grids[0].volumeStiffness = 1;
    EXPECT_NE(complaintAbout(sheet).find("is a sheet, whose cells have no volume"), std::string::npos);
}

TEST(CellVolume, RefusesPoissonRatiosOutOfRangeAndBodiesFarAway) {
    Scene scene;
    for (const float ratio : {0.2f, 0.495f, 0.5f, -1.0f, NAN})
        EXPECT_THROW(addLattice(scene, {.poissonRatio = ratio}), std::invalid_argument) << ratio;
    for (const float recovery : {-1.0f, 11.0f, NAN})
        EXPECT_THROW(addLattice(scene, {.recovery = recovery}), std::invalid_argument) << recovery;
    EXPECT_NO_THROW(addLattice(scene, {.poissonRatio = 0.49f, .recovery = 10}));
    EXPECT_THROW(addLattice(scene, {.origin = {1e6f, 0, 0}, .poissonRatio = 0.3f}), std::domain_error);
    EXPECT_NO_THROW(addLattice(scene, {.origin = {1e6f, 0, 0}}));
}

TEST(CellVolumeReference, ForceIsTheSlopeOfItsEnergyAndTheHessianThatOfForce) {
    for (auto& [name, scene] : scenes()) {
        scene.distances.clear(); // only cells remain
        for (Grid& grid : scene.grids) grid.distanceCount = 0;
        const reference::Problem problem(scene);
        const auto x = reference::initialState(scene).x;
        const reference::Potential potential(problem);
        const auto hessian = potential.hessian(x, reference::Potential::Hessian::exact);
        Eigen::VectorXd step(potential.size());
        for (Eigen::Index i = 0; i < step.size(); ++i) step[i] = std::sin(1.0 + 7.0 * static_cast<double>(i));
        const double size = 1e-6;
        const auto ahead = potential.moved(x, size, step), behind = potential.moved(x, -size, step);
        const double slope = (potential.value(ahead) - potential.value(behind)) / (2 * size),
                     expected = potential.gradient(x).dot(step);
        EXPECT_NEAR(slope, expected, 1e-5 * (std::abs(expected) + potential.gradient(x).norm())) << name;
        const Eigen::VectorXd change = (potential.gradient(ahead) - potential.gradient(behind)) / (2 * size),
                              product = hessian * step;
        EXPECT_LE((change - product).norm(), 1e-4 * product.norm()) << name;
    }
}

TEST(CellVolumeReference, SmallStrainsStoreHalfOfLambdaTimesTheDilatationSquared) {
    const Scene scene = body({2, 3, 2}, {0.4f, 0});
    const double strain[] = {1e-4, -3e-4, 5e-4}, dilatation = 3e-4;
    const Scene strained = [&] {
        Scene links = scene; // without its links
        links.distances.clear();
        links.grids[0].distanceCount = 0;
        return links;
    }();
    auto x = reference::initialState(strained).x;
    for (Vector3d& position : x)
        for (Eigen::Index axis = 0; axis < 3; ++axis) position[axis] *= 1 + strain[axis];
    const double mu = 2e5 / 2.8, lambda = mu * (0.8 / 0.2 - 1), volume = 12 * std::pow(0.1, 3);
    const double expected = lambda / 2 * dilatation * dilatation * volume;
    EXPECT_NEAR(reference::elasticEnergy(reference::Problem(strained), x) / expected, 1, 2e-3);
}

TEST(CellVolumeReference, TrajectoryTruthKeepsItsEnergyAndAnImplicitStepConverges) {
    Scene scene = disturbed(body({2, 2, 2}, {0.45f, 1}), 0.005f, 0.5f);
    scene.gravity = {0, 0, 0};
    reference::State state = reference::initialState(scene);
    const double start = reference::energy(scene, state).total();
    reference::stepVerlet(scene, 1e-5, 2000, state);
    EXPECT_NEAR(reference::energy(scene, state).total() / start, 1, 1e-4);
    EXPECT_LE(reference::trueTrajectory(scene, {.frames = 2}).selfDifference, 1e-6);
    EXPECT_LE(reference::stepImplicitEuler(scene, double{frame}, state).residual(), 1e-9);
    EXPECT_THROW(reference::stepJacobi(scene, {}, double{frame}, state), std::invalid_argument);
    EXPECT_THROW(reference::stepGaussSeidel(scene, {}, double{frame}, state), std::invalid_argument);
}
