// Tests of bodies with computed neighbours: all forms of the kernel give the same bits, one step agrees with
// double precision, and a grid that contradicts the lists is refused.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/lattice/placement.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

using namespace sinew;
using namespace sinew::sim;

namespace {

constexpr float frame = 1.0f / 60;

void addBody(Scene& scene, std::array<std::uint32_t, 3> cells, std::vector<float> fill = {},
             bool hasBodyDiagonals = false) {
    addLattice(scene, {.origin = {0.1f, 0.5f, 0.2f},
                       .cells = cells,
                       .spacing = 0.1f,
                       .fill = std::move(fill),
                       .youngModulus = 2e5f,
                       .hasBodyDiagonals = hasBodyDiagonals});
}

Scene body(std::array<std::uint32_t, 3> cells, std::vector<float> fill = {}, bool hasBodyDiagonals = false) {
    Scene scene{.name = "lattice"};
    addBody(scene, cells, std::move(fill), hasBodyDiagonals);
    return scene;
}

void addSheet(Scene& scene, std::array<std::uint32_t, 2> size) {
    addCloth(scene, {.origin = {0, 0.2f, 0},
                     .size = size,
                     .spacing = 0.05f,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-3f,
                     .pinned = {0, size[0] - 1}});
}

Scene sheet(std::array<std::uint32_t, 2> size) {
    Scene scene{.name = "sheet"};
    addSheet(scene, size);
    return scene;
}

// Bodies of two shapes, two of them equal, with free particles and a chain between them.
Scene mixture() {
    Scene scene = sheet({7, 5});
    addLattice(scene, {.origin = {0, 0.5f, 0}, .cells = {2, 3, 4}, .spacing = 0.1f, .youngModulus = 2e5f});
    for (float x : {1.0f, 2.0f})
        addLattice(scene,
                   {.origin = {x, 0.5f, 0}, .cells = {3, 3, 3}, .spacing = 0.1f, .youngModulus = 1e5f});
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    for (std::uint32_t i = 0; i < 5; ++i) {
        scene.particles.push_back({.position = {3, 1, 0.1f * static_cast<float>(i)}, .inverseMass = 2});
        if (i > 1) scene.distances.push_back({first + i - 1, first + i, 0.1f, 1e-4f});
    }
    return scene;
}

Scene disturbed(Scene scene) {
    test::disturb(scene, 0.01f, 1);
    return scene;
}

std::vector<std::pair<const char*, Scene>> scenes() {
    return {{"one cell", disturbed(body({1, 1, 1}))},
            {"rod", disturbed(body({1, 1, 40}))},
            {"flat", disturbed(body({9, 1, 4}))},
            {"odd block", disturbed(body({4, 6, 8}))},
            {"even block", disturbed(body({5, 5, 19}))},
            {"ragged", disturbed(body({7, 6, 9}, test::raggedFill(7 * 6 * 9)))},
            {"26 neighbours", disturbed(body({4, 5, 6}, test::raggedFill(4 * 5 * 6), true))},
            {"sheet", disturbed(sheet({13, 37}))},
            {"narrow sheet", disturbed(sheet({2, 3}))},
            {"mixture", disturbed(mixture())}};
}

// All of those bodies except the mixture in one scene. Each fits into small shared memory, and they do not
// touch.
Scene bodies() {
    Scene scene{.name = "bodies"};
    for (const std::array<std::uint32_t, 3> cells :
         {std::array{1u, 1u, 1u}, std::array{1u, 1u, 40u}, std::array{9u, 1u, 4u}, std::array{4u, 6u, 8u},
          std::array{5u, 5u, 19u}})
        addBody(scene, cells);
    addBody(scene, {7, 6, 9}, test::raggedFill(7 * 6 * 9));
    addBody(scene, {4, 5, 6}, test::raggedFill(4 * 5 * 6), true);
    addSheet(scene, {13, 37});
    addSheet(scene, {2, 3});
    return disturbed(std::move(scene));
}

} // namespace

TEST(Grid, IsComputedForEveryRegularBody) {
    EXPECT_TRUE(test::usesKernel(body({3, 3, 3}), "gather_lattice"));
    EXPECT_TRUE(test::usesKernel(sheet({9, 9}), "gather_sheet"));
    EXPECT_FALSE(test::usesKernel(body({3, 3, 3}), "gather_split_packed"));
    Scene tied = body({3, 3, 3});
    tied.particles.push_back({.position = {1, 1, 1}});
    tied.distances.push_back({0, static_cast<std::uint32_t>(tied.particles.size() - 1), 1, 1e-3f});
    EXPECT_FALSE(test::usesKernel(tied, "gather_lattice"))
        << "a link that the grid does not have must not be lost";
}

// Scenes share their pipelines, which cost more than their steps. Bodies of all kinds fly side by side; some
// may be resident, others have free particles and a chain among them.
TEST(Grid, FormsGiveTheSameBits) {
    const Forms forms[] = {{.chunk = 3},
                           {.columns = 1, .chunk = 5},
                           {.usesTexels = false, .chunk = 64},
                           {.usesTexels = false, .columns = 1, .chunk = 2},
                           {.columns = 1, .chunk = 1},
                           {.residentBytes = 32768},
                           {.columns = 1, .chunk = 1, .residentBytes = 32768}};
    ASSERT_TRUE(test::usesKernel(bodies(), "gather_node", {.substeps = 5, .forms = forms[4]}));
    ASSERT_TRUE(test::usesKernel(bodies(), "gather_node_sheet", {.substeps = 5, .forms = forms[4]}));
    ASSERT_TRUE(test::usesKernel(bodies(), "resident_sheet", {.substeps = 5, .forms = forms[5]}));
    ASSERT_TRUE(test::usesKernel(bodies(), "resident_node", {.substeps = 5, .forms = forms[6]}));
    for (auto& [name, scene] : {std::pair{"bodies", bodies()}, std::pair{"mixture", disturbed(mixture())}})
        for (const bool isInRoom : {false, true}) {
            Scene each = scene;
            if (isInRoom) test::addRoom(each);
            const std::uint64_t expected = test::hashOfRun(each, {.substeps = 5});
            EXPECT_EQ(test::hashOfRun(each, {.substeps = 5, .isReversed = true}), expected)
                << name << ", reversed";
            for (const Forms& form : forms)
                EXPECT_EQ(test::hashOfRun(each, {.substeps = 5, .forms = form}), expected)
                    << name << ", room " << isInRoom << ", texels " << form.usesTexels << ", columns "
                    << form.columns << ", chunk " << form.chunk << ", resident " << form.residentBytes;
        }
}

// 12 x 13 x 13 slots of 32 bytes exceed the 32 KiB of most devices.
TEST(Grid, IsKeptResidentOnlyWithinTheSharedMemoryOfTheDevice) {
    const Scene scene = body({11, 12, 12});
    Settings settings{.substeps = 1};
    const std::uint64_t expected = test::hashOfRun(scene, settings);
    settings.forms.residentBytes = 0xffffffff;
    EXPECT_EQ(test::hashOfRun(scene, settings), expected);
}

// The body has 49 blocks of columns, more than a work group of the march has invocations.
TEST(Grid, IsNotResidentWhereContactsFollow) {
    Scene scene = disturbed(body({12, 12, 3}));
    for (Particle& particle : scene.particles) particle.radius = 0.01f;
    const std::uint64_t expected = test::hashOfRun(scene, {.substeps = 5});
    for (const Forms& forms :
         {Forms{.residentBytes = 32768}, Forms{.columns = 1, .chunk = 1, .residentBytes = 32768}})
        EXPECT_EQ(test::hashOfRun(scene, {.substeps = 5, .forms = forms}), expected);
}

TEST(Grid, AgreesWithDoubleAfterAStep) {
    for (auto& [name, scene] : scenes())
        for (const std::uint32_t substeps : {1u, 2u, 16u}) {
            const Settings settings{.substeps = substeps};
            test::Runner runner(scene, settings);
            runner.step(frame);
            reference::State state = reference::initialState(scene);
            test::stepReference(scene, settings, frame, state);
            EXPECT_LE(test::differenceOf(runner, state, scene, frame), 1e-5)
                << name << ", " << substeps << " substeps";
        }
}

TEST(Grid, AgreesWithListedLinks) {
    for (auto& [name, scene] : scenes()) {
        Settings computed{.substeps = 8}, listed = computed;
        listed.forms.usesGrids = false;
        test::Runner a(scene, computed), b(scene, listed);
        a.run(2);
        b.run(2);
        const auto x = a.positions(), y = b.positions();
        for (std::size_t i = 0; i < x.size(); ++i)
            ASSERT_LE((x[i] - y[i]).norm(), 1e-5 * test::sizeOf(scene)) << name << ", particle " << i;
    }
}

TEST(Grid, MarchesEveryNodeOnceAndNoEmptySpace) {
    const Scene scene = body({7, 6, 9}, test::raggedFill(7 * 6 * 9));
    const Grid& grid = scene.grids[0];
    const lattice::Box box = lattice::place(grid, 0);
    for (const std::uint32_t columns : {1u, 2u}) {
        std::vector<int> visits(box.end);
        std::size_t visited = 0;
        for (const auto& chunk : lattice::chunksOf(grid, box, columns, columns, 4)) {
            EXPECT_LE(chunk.layers, 4u);
            for (std::uint32_t z = 0; z < chunk.layers; ++z)
                for (std::uint32_t y = 0; y < columns; ++y)
                    for (std::uint32_t x = 0; x < columns; ++x, ++visited)
                        ++visits[chunk.origin + x + y * box.rowStride + z * box.sliceStride];
        }
        EXPECT_LE(*std::ranges::max_element(visits), 1);
        for (const std::uint32_t node : grid.node) {
            const auto at = lattice::coordinates(grid, node);
            EXPECT_EQ(visits[box.slot(at[0], at[1], at[2])], 1);
        }
        if (columns == 1) {
            EXPECT_EQ(visited, grid.node.size());
        }
    }
}

TEST(Grid, BodyTakesAtMost72BytesAParticleAnd16MoreForPublicVelocities) {
    const Scene scene = body({31, 31, 31});
    const auto bytes = [&](bool publishesVelocities) {
        const StepProgram program = compile(scene, {.publishesVelocities = publishesVelocities});
        std::uint64_t sum = 0;
        for (const BufferSpec& buffer : program.buffers) sum += buffer.bytes();
        return static_cast<double>(sum) / static_cast<double>(scene.particles.size());
    };
    EXPECT_LE(bytes(false), 72);
    EXPECT_LE(bytes(true), 88);
}

// Computed slots: bodies in a row, with even and odd extents, and bodies that break the rule.
TEST(Grid, SlotsOfEqualFullBodiesFollowTheRuleThatKernelsCompute) {
    Scene row, ragged = body({4, 3, 5}, test::raggedFill(60)), unequal = body({2, 2, 2});
    for (const float x : {0.0f, 2.0f, 4.0f})
        addLattice(row, {.origin = {x, 0, 0}, .cells = {2, 3, 4}, .spacing = 0.1f, .youngModulus = 1e5f});
    addLattice(unequal, {.origin = {3, 0, 0}, .cells = {2, 2, 3}, .spacing = 0.1f, .youngModulus = 1e5f});
    for (const Scene& scene : {row, body({4, 4, 4}), sheet({7, 5}), sheet({8, 3})}) {
        const StateLayout layout = stateLayout(scene, {});
        ASSERT_TRUE(layout.boxes.has_value());
        const EqualBoxes& b = *layout.boxes;
        for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
            const std::uint32_t node = i % b.particles, z = node / b.nodesX / b.nodesY;
            EXPECT_EQ(layout.slot[i], b.origin + i / b.particles * b.boxStride + z * b.sliceStride +
                                          node / b.nodesX % b.nodesY * b.rowStride + node % b.nodesX);
        }
    }
    for (const Scene& scene : {ragged, unequal, mixture(), test::chain(5)})
        EXPECT_FALSE(stateLayout(scene, {}).boxes.has_value());
}

// Bodies with few particles in their box of slots: kernels that may run over a list run over these particles.
TEST(Grid, PassesRunOverParticlesWhereSlotsAreMostlyEmpty) {
    EXPECT_TRUE(compactSlots(orderedLayout(1000)).empty());
    StateLayout sparse{.slot = {5, 130, 700}, .count = 6 * paddedCount(1)};
    const std::vector<std::uint32_t> slots = compactSlots(sparse);
    ASSERT_EQ(slots.size(), paddedCount(1)) << "whole work groups";
    EXPECT_TRUE(std::ranges::equal(std::span(slots).first(3), sparse.slot));
    std::set<std::uint32_t> all(slots.begin(), slots.end());
    EXPECT_EQ(all.size(), slots.size()) << "no slot twice";
    EXPECT_LT(*all.rbegin(), sparse.count);
    sparse.count = paddedCount(1);
    EXPECT_TRUE(compactSlots(sparse).empty()) << "as many groups as without a list";
}

TEST(Grid, ThatContradictsTheListsIsRefusedInASentence) {
    const auto complaintAfter = [](const std::function<void(Scene&)>& damage) {
        Scene scene = body({2, 2, 2});
        damage(scene);
        const auto complaints = validate(scene, {});
        return complaints.empty() ? std::string("none") : complaints.front();
    };
    EXPECT_EQ(complaintAfter([](Scene&) {}), "none");
    const std::pair<std::function<void(Scene&)>, const char*> cases[] = {
        {[](Scene& s) { s.distances[7].restLength *= 1.01f; }, "grid[0]: distance[7] is not the link"},
        {[](Scene& s) { s.distances[7].compliance *= 1.01f; }, "grid[0]: distance[7] is not the link"},
        {[](Scene& s) { std::swap(s.distances[7].a, s.distances[20].a); }, "is not the link"},
        {[](Scene& s) { --s.grids[0].distanceCount; }, "names 125 distance constraints"},
        {[](Scene& s) { s.grids[0].distanceCount = 1000; }, "distance constraints that do not exist"},
        {[](Scene& s) { s.grids[0].firstParticle = 1; }, "particles that do not exist"},
        {[](Scene& s) { s.grids[0].fill[3] = 16; }, "fill above 15"},
        {[](Scene& s) { s.grids[0].fill.pop_back(); }, "one fill for each cell"},
        {[](Scene& s) { s.grids[0].node[3] = 2; }, "ascending nodes"},
        {[](Scene& s) { s.grids[0].nodes[0] = 1; }, "at least 2 x 1 x 2 nodes"},
        {[](Scene& s) { s.grids[0].kinds = 4; }, "2 or 3 kinds"},
        {[](Scene& s) { s.distances[7] = s.distances[6]; }, "distance[7] is not the link"},
        {[](Scene& s) {
             s.distances[7] = s.distances[6];
             std::swap(s.distances[7].a, s.distances[7].b);
         },
         "distance[7] is not the link"},
        {[](Scene& s) {
             // A second cell, away from all particles.
             Grid& grid = s.grids[0];
             grid.nodes = {3, 3, 6};
             grid.fill.resize(20);
             grid.fill[16] = 15;
         },
         "filled cell with a corner that is no particle"},
    };
    for (const auto& [damage, complaint] : cases) {
        const std::string message = complaintAfter(damage);
        EXPECT_NE(message.find(complaint), std::string::npos) << message << " instead of " << complaint;
    }
}
