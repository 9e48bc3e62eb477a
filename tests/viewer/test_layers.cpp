// Tests of layers: their names and colors, the tables behind color maps, and the results on the device, under
// validation.
#include "viewer/document/document.hpp"
#include "viewer/layers/hash_cells.hpp"
#include "viewer/layers/inspection.hpp"
#include "viewer/layers/value_maps.hpp"

#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>

namespace sinew::viewer {
namespace {

TEST(Layers, AreAllReachedByTheirNames) {
    Layers layers;
    for (const std::string& name : layerNames()) {
        const Layers before = layers;
        EXPECT_TRUE(addLayer(name, layers)) << name;
        EXPECT_NE(layers, before) << name;
    }
    EXPECT_FALSE(addLayer("x-rays", layers));
}

TEST(Layers, GoRoundThroughAllTheirLooksAndOff) {
    for (std::size_t i = 0; i < layerTable().size(); ++i) {
        const Layer& layer = *layerTable()[i];
        EXPECT_EQ(indexOf(layer), i);
        Layers layers;
        for (const Layer::Look& look : layer.looks) {
            layers.turn(i);
            EXPECT_TRUE(layers.has(layer)) << look.name;
            EXPECT_EQ(layers, shown({look.name}));
        }
        layers.turn(i);
        EXPECT_EQ(layers, Layers{}) << layer.key;
    }
    EXPECT_EQ(shown({"hidden"}).skin(), SkinLook::hidden);
    EXPECT_EQ(shown({"sleep"}).map(), ColorMap::sleep);
}

// A row with a key or a name of another one would never be reached.
TEST(Layers, HaveKeysAndNamesOfTheirOwn) {
    std::set<char> keys;
    for (const Layer* layer : layerTable()) {
        EXPECT_TRUE(keys.insert(layer->key).second) << layer->key;
        EXPECT_FALSE(layer->help.empty()) << layer->key;
        EXPECT_FALSE(layer->looks.empty()) << layer->key;
        EXPECT_EQ(layer->pipeline != nullptr, layer->opened != nullptr) << layer->key;
    }
    const std::vector<std::string> names = layerNames();
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
}

// CIE 1976 L*, a, b of a color. The color map was designed by another measure.
std::array<double, 3> cieLab(const std::array<float, 3>& c) {
    const auto root = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    const double r = double{c[0]}, g = double{c[1]}, b = double{c[2]};
    const double x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505),
                 y = root(0.2126 * r + 0.7152 * g + 0.0722 * b),
                 z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(MapColors, StayOnTheScreenAndGetEvenlyLighter) {
    const auto colors = mapColors();
    for (const auto& color : colors)
        for (const float part : color) {
            EXPECT_GE(part, 0);
            EXPECT_LE(part, 1);
        }
    const double all = cieLab(colors.back())[0] - cieLab(colors.front())[0];
    EXPECT_GT(all, 60);
    for (std::size_t i = 0; i + 1 < mapColorCount; ++i) {
        const double step = cieLab(colors[i + 1])[0] - cieLab(colors[i])[0];
        EXPECT_NEAR(step * (mapColorCount - 1) / all, 1, 0.25) << "from color " << i;
    }
}

// Adds `count` particles with a value in this bin.
void put(layout::ValueSpread& spread, std::size_t bin, std::uint32_t count) {
    spread.counts[bin] += count;
}

TEST(MapReading, LeavesOnePercentBeyondItsRange) {
    layout::ValueSpread spread{};
    EXPECT_EQ(readingOf(spread).range, 0) << "nobody has a value";
    put(spread, 15, 980); // up to 0.01
    put(spread, 17, 11);  // up to 0.05
    put(spread, 20, 9);   // up to 0.5
    const float largest = 0.4f;
    std::memcpy(&spread.largest, &largest, sizeof largest);
    const MapReading reading = readingOf(spread);
    EXPECT_FLOAT_EQ(reading.range, 0.05f);
    EXPECT_FLOAT_EQ(reading.beyond, 0.009f);
    EXPECT_FLOAT_EQ(reading.largest, largest);
}

// Reads the same value several times.
float readTimes(MapRange& range, float reading, int times) {
    for (int i = 0; i < times; ++i) range.read({.range = reading});
    return range.range();
}

TEST(MapRange, RisesAtOnceAndFallsWithinADozenPictures) {
    MapRange range;
    EXPECT_FLOAT_EQ(readTimes(range, 0.02f, 1), 0.02f);
    EXPECT_FLOAT_EQ(readTimes(range, 1, 1), 1) << "a blow";
    EXPECT_FLOAT_EQ(readTimes(range, 0.05f, 11), 1);
    EXPECT_FLOAT_EQ(readTimes(range, 0.02f, 1), 0.05f) << "the largest of those after it";
    EXPECT_FLOAT_EQ(readTimes(range, 0.02f, 12), 0.02f);
    range.read({});
    EXPECT_EQ(range.range(), 0);
}

TEST(MapRange, DoesNotFlickerBetweenTwo) {
    MapRange range;
    range.read({.range = 0.1f});
    for (int i = 0; i < 50; ++i) EXPECT_FLOAT_EQ(readTimes(range, i % 2 == 0 ? 0.05f : 0.1f, 1), 0.1f);
}

sim::Scene cuttableBlock() {
    sim::Scene scene;
    sim::Lattice lattice{.origin = {0, 0, 0}, .cells = {4, 4, 4}, .spacing = 0.1f};
    lattice.isCuttable = true;
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    sim::addLatticeSkin(scene, lattice, corners, {0.7f, 0.1f, 0.1f});
    scene.gravity = {0, 0, 0};
    return scene;
}

TEST(LinkTable, HasEveryLinkAtBothEnds) {
    const sim::Scene scene = cuttableBlock();
    std::vector<std::uint32_t> slots;
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) slots.push_back(1000 + i);
    const LinkTable table = linkTable(scene, slots);
    ASSERT_EQ(table.links.size(), 2 * scene.distances.size());
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const layout::ValueLinks& own = table.linksOf[i];
        EXPECT_EQ(own.slot, 1000 + i);
        for (std::uint32_t l = own.first; l < own.first + own.count; ++l) {
            const layout::ValueLink& link = table.links[l];
            const layout::ValueLinks& far = table.linksOf[link.other];
            const auto back =
                std::find_if(table.links.begin() + far.first, table.links.begin() + far.first + far.count,
                             [&](const layout::ValueLink& other) { return other.other == i; });
            ASSERT_NE(back, table.links.begin() + far.first + far.count);
            const int bit = std::countr_zero(link.bit), other = std::countr_zero(back->bit);
            EXPECT_EQ(bit + other, 25) << "both ends name the same link";
        }
    }
}

// A document with a layer's buffers after some steps.
struct Inspected {
    Inspected(const sim::Scene& scene, const Layers& on, const sim::Settings& settings = {.substeps = 8})
        : layers(on), document(test::device(), scene, settings), inspection(test::device(), document, 1) {
        inspection.prepare(layers);
    }
    void step(int steps, const sim::Blade& blade = {}) {
        VkCommandBuffer commands = test::queue().begin();
        if (document.steps() == 0) document.recordReset(commands);
        for (int i = 0; i < steps; ++i)
            document.recordStep(commands, nullptr, {}, i == 0 ? blade : sim::Blade{});
        document.recordSkin(commands);
        inspection.record(commands, layers, 0);
        test::queue().wait(test::queue().submit(commands));
    }

    // Range of the color map.
    MapReading values() const { return inspection.reading(indexOf(layer::colors), 0).values; }

    Layers layers;
    Document document;
    Inspection inspection;
};

TEST(StrainMap, SaysHowFarABodyIsStretched) {
    sim::Scene scene = cuttableBlock();
    for (sim::DistanceConstraint& link : scene.distances) link.restLength /= 1.1f;
    scene.grids[0].restLength = {0.1f / 1.1f, 0.1f * std::sqrt(2.0f) / 1.1f, 0.1f * std::sqrt(3.0f) / 1.1f};
    Inspected stretched(scene, shown({"strain"}));
    stretched.step(0);
    const MapReading reading = stretched.values();
    EXPECT_NEAR(reading.largest, 0.1f, 1e-4f);
    EXPECT_FLOAT_EQ(reading.range, reading.largest > 0.1f ? 0.2f : 0.1f);
    Inspected resting(cuttableBlock(), shown({"strain"}));
    resting.step(0);
    EXPECT_LT(resting.values().largest, 1e-5f);
}

// The halves of a block separate: the links cut by a blade get long, the others do not.
TEST(StrainMap, LeavesOutWhatWasCut) {
    sim::Scene scene = cuttableBlock();
    for (sim::Particle& particle : scene.particles)
        particle.velocity = {particle.position.x < 0.19f ? -2.0f : 2.0f, 0, 0};
    const std::array<sim::Vec3, 2> from{{{0.17f, 1, -1}, {0.17f, 1, 1}}},
        to{{{0.17f, -1, -1}, {0.17f, -1, 1}}};
    Inspected cut(scene, shown({"strain"})), whole(scene, shown({"strain"}));
    cut.step(20, {.from = from, .to = to});
    whole.step(20);
    EXPECT_GT(whole.values().largest, 0.05f);
    EXPECT_LT(cut.values().largest, 0.02f);
}

TEST(SpeedMap, SaysHowFastParticlesAre) {
    sim::Scene scene = cuttableBlock();
    for (sim::Particle& particle : scene.particles) particle.velocity = {0, 2.4f, 3.2f};
    Inspected flying(scene, shown({"speed"}));
    flying.step(3);
    EXPECT_NEAR(flying.values().largest, 4, 1e-3f);
    EXPECT_FLOAT_EQ(flying.values().range, 5);
}

TEST(SleepMap, KnowsWhoSleepsAndWhoNeverMoves) {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {0, 0.1f, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    sim::addParticles(scene, {.center = {2, 50, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    sim::addParticles(scene, {.center = {4, 0.1f, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    scene.particles[2].inverseMass = 0;
    scene.planes.push_back({});
    Inspected resting(scene, shown({"sleep"}), {.substeps = 8, .sleeps = true});
    const vk::BufferView values = resting.inspection.buffers(resting.layers).particles;
    std::array<float, 3> read{};
    for (int i = 0; i < 90; ++i) resting.step(1);
    test::queue().download(values, read.data(), sizeof read);
    EXPECT_EQ(read[0], 0) << "asleep";
    EXPECT_EQ(read[1], 1) << "falls";
    EXPECT_LT(read[2], 0) << "fixed";
    EXPECT_EQ(resting.inspection.buffers(resting.layers, mapRange(0.1f)).range, 1) << "from asleep to awake";
}

// Loose balls at rest, so that the grid fits their positions.
sim::Scene scattered(std::uint32_t count, float size) {
    sim::Scene scene;
    scene.gravity = {0, 0, 0};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(0, size);
    for (std::uint32_t i = 0; i < count; ++i)
        scene.particles.push_back(
            {.position = {place(random), place(random), place(random)}, .radius = 0.01f});
    return scene;
}

struct Cells {
    GridFacts facts;
    std::vector<layout::CellMark> marks;
};

Cells cellsOf(const sim::Scene& scene) {
    Inspected still(scene, shown({"cells"}));
    still.step(1);
    const std::vector<GridFacts> grids = still.inspection.part<HashCells>(layer::cells).grids(0);
    if (grids.size() != 1) return {};
    const HashCells& cells = still.inspection.part<HashCells>(layer::cells);
    auto marks = test::queue().download<layout::CellMark>(cells.marks());
    marks.resize(grids[0].cells);
    return {grids[0], marks};
}

// Compares with the positions of the balls, without a kernel.
void expectEachBallInOneCell(const Cells& cells, const sim::Scene& scene) {
    std::vector<int> times(scene.particles.size());
    std::uint32_t most = 0, shared = 0;
    for (const layout::CellMark& mark : cells.marks) {
        const float edge = mark.low.w, rounding = 1e-5f * edge;
        std::uint32_t held = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            const sim::Vec3& x = scene.particles[i].position;
            const auto isWithin = [&](float at, float low) {
                return at >= low - rounding && at < low + edge + rounding;
            };
            if (!isWithin(x.x, mark.low.x) || !isWithin(x.y, mark.low.y) || !isWithin(x.z, mark.low.z))
                continue;
            ++times[i];
            ++held;
        }
        EXPECT_EQ(mark.held.x, static_cast<float>(held));
        most = std::max(most, held);
        shared += mark.held.y > 0 ? 1 : 0;
    }
    EXPECT_EQ(std::ranges::count(times, 1), static_cast<std::ptrdiff_t>(times.size()));
    EXPECT_EQ(cells.facts.held, times.size());
    EXPECT_EQ(cells.facts.most, most);
    EXPECT_EQ(cells.facts.shared, shared);
}

// Balls as dense as possible without contact forces.
sim::Scene packed() {
    sim::Scene scene = scattered(343, 0.008f);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        sim::Vec3& x = scene.particles[i].position;
        x.x += 0.03f * static_cast<float>(i % 7);
        x.y += 0.03f * static_cast<float>(i / 7 % 7);
        x.z += 0.03f * static_cast<float>(i / 49);
    }
    return scene;
}

TEST(HashCells, HoldEachBallOnceWhereTheGridIsDense) {
    const sim::Scene scene = packed();
    const Cells cells = cellsOf(scene);
    ASSERT_GT(cells.marks.size(), 50u);
    expectEachBallInOneCell(cells, scene);
    EXPECT_EQ(cells.facts.shared, 0u);
    EXPECT_GT(cells.facts.most, 1u);
    EXPECT_NEAR(cells.facts.edge, 0.0254f, 0.0005f) << "what two touch at, and a margin of half a radius";
}

TEST(HashCells, SayWhoSharesASlotWhereTheTableIsTooSmallForTheBox) {
    const sim::Scene scene = scattered(700, 5);
    const Cells cells = cellsOf(scene);
    expectEachBallInOneCell(cells, scene);
    EXPECT_GT(cells.facts.shared, 20u);
    EXPECT_LT(cells.facts.shared, 400u);
}

TEST(HashCells, AreOfEveryGridThatTheSolverHas) {
    sim::Scene scene = scattered(40, 0.3f);
    Inspected before(scene, shown({"cells"}));
    before.step(0);
    ASSERT_EQ(before.inspection.part<HashCells>(layer::cells).grids(0).size(), 1u);
    EXPECT_EQ(before.inspection.part<HashCells>(layer::cells).grids(0)[0].cells, 0u)
        << "no step has built it";
    Inspected block(cuttableBlock(), shown({"cells"}));
    block.step(2);
    EXPECT_TRUE(block.inspection.part<HashCells>(layer::cells).grids(0).empty()) << "nothing can meet";
    for (const sim::Vec3& x : {sim::Vec3{0, 0, 0}, sim::Vec3{0.1f, 0, 0}, sim::Vec3{0, 0.1f, 0}})
        scene.particles.push_back({.position = x, .radius = 0.01f});
    scene.faces = {{{40, 41, 42}, 0.01f}};
    const auto cellsSay = [](const Inspected& of) { return of.inspection.reading(indexOf(layer::cells), 0); };
    EXPECT_EQ(cellsSay(before).legend.at(0).name, "no step has been taken yet: the grids are empty");
    EXPECT_EQ(cellsSay(before).note, "");
    EXPECT_EQ(cellsSay(block).legend.at(0).name, "no hash grid: the scene has no contacts that need one");
    EXPECT_NE(cellsSay(block).note, "");
    Inspected faces(scene, shown({"cells"}));
    faces.step(1);
    const std::vector<GridFacts> grids = faces.inspection.part<HashCells>(layer::cells).grids(0);
    ASSERT_GE(grids.size(), 2u);
    for (const GridFacts& grid : grids) {
        EXPECT_GT(grid.cells, 0u) << grid.name;
        EXPECT_GE(grid.held, grid.cells) << grid.name;
    }
}

TEST(ContactMarks, AreWhereBallsLieOnTheFloorAndOnEachOther) {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {0, 0.1f, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    sim::addParticles(scene, {.center = {0, 0.3f, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    sim::addParticles(scene, {.center = {1, 0.5f, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    scene.planes.push_back({});
    scene.gravity = {0, 0, 0};
    Inspected heap(scene, shown({"contacts"}));
    heap.step(2);
    EXPECT_EQ(heap.inspection.part<ContactMarks>(layer::contacts).found(0), 2u)
        << "one on the floor, one on that, one in the air";
}

// Two triangles whose edges cross at a distance of both thicknesses.
TEST(ContactMarks, AreWhereTwoEdgesCross) {
    constexpr float thickness = 0.01f;
    sim::Scene scene;
    scene.gravity = {0, 0, 0};
    for (const sim::Vec3& x :
         {sim::Vec3{-0.9f, 0, 0.02f}, sim::Vec3{1.1f, 0, -0.03f}, sim::Vec3{0, -2, 0.1f},
          sim::Vec3{0.1f, 0.0201f, -1}, sim::Vec3{-0.05f, 0.0201f, 0.8f}, sim::Vec3{0, 2, 0}})
        scene.particles.push_back({.position = x, .radius = thickness});
    scene.faces = {{{0, 1, 2}, thickness}, {{3, 4, 5}, thickness}};
    Inspected crossed(scene, shown({"contacts"}));
    crossed.step(1);
    EXPECT_EQ(crossed.inspection.part<ContactMarks>(layer::contacts).found(0), 1u);
    const ContactMarks counter(test::device(), scene, crossed.document.settings(),
                               crossed.document.simulation(), 2, ContactMarks::Room::none);
    VkCommandBuffer commands = test::queue().begin();
    counter.recordOf(commands, 0, 4);
    counter.recordOf(commands, 1, 5);
    test::queue().wait(test::queue().submit(commands));
    EXPECT_EQ(counter.found(0), 1u) << "an end of the edge";
    EXPECT_EQ(counter.found(1), 0u) << "the other corner";
}

TEST(ContactMarks, CountWhatOneParticleTouches) {
    sim::Scene scene;
    for (const float height : {0.1f, 0.3f, 0.5f})
        sim::addParticles(scene, {.center = {0, height, 0}, .count = {1, 1, 1}, .radius = 0.1f});
    scene.planes.push_back({});
    scene.gravity = {0, 0, 0};
    Inspected heap(scene, {});
    heap.step(2);
    const ContactMarks counter(test::device(), scene, heap.document.settings(), heap.document.simulation(), 3,
                               ContactMarks::Room::none);
    VkCommandBuffer commands = test::queue().begin();
    for (std::uint32_t particle = 0; particle < 3; ++particle) {
        counter.recordOf(commands, particle, particle);
    }
    test::queue().wait(test::queue().submit(commands));
    EXPECT_EQ(counter.found(0), 2u) << "the floor and the one above";
    EXPECT_EQ(counter.found(1), 2u) << "those below and above";
    EXPECT_EQ(counter.found(2), 1u);
}

TEST(ContactMarks, AreWhereABallLiesOnATriangle) {
    sim::Scene scene;
    sim::addParticles(scene, {.center = {-0.4f, 0.1f, -0.4f}, .count = {1, 1, 1}, .radius = 0.1f});
    sim::addMeshCollider(scene, {.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, -1}, {1, 0, 1}},
                                 .triangles = {{{0, 1, 2}}, {{2, 1, 3}}}});
    scene.gravity = {0, 0, 0};
    Inspected lying(scene, shown({"contacts"}));
    lying.step(2);
    EXPECT_EQ(lying.inspection.part<ContactMarks>(layer::contacts).found(0), 1u);
}

TEST(ContactMarks, AreWhereABodyTouchesACollider) {
    sim::Scene scene = cuttableBlock();
    scene.colliders = {{.shape = sim::ColliderShape::box,
                        .halfExtents = {1, 0.1f, 1},
                        .pose = {.position = {0.2f, -0.1f, 0.2f}, .rotation = {}}}};
    Inspected lying(scene, shown({"contacts"}));
    lying.step(1);
    EXPECT_EQ(lying.inspection.part<ContactMarks>(layer::contacts).found(0), 25u) << "the lowest layer";
}

} // namespace
} // namespace sinew::viewer
