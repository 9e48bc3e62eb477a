// Tests of links drawn in the colors of their classes: the classes that the solver corrects together, and the
// drawing on the device, under validation.
#include "viewer/document/document.hpp"
#include "viewer/layers/inspection.hpp"
#include "viewer/layers/link_lines.hpp"
#include "viewer/render/offscreen.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sinew::viewer {
namespace {

// A block of links whose lowest layer is fixed.
sim::Scene block(bool isCuttable) {
    sim::Scene scene;
    sim::Lattice lattice{.origin = {0, 0, 0}, .cells = {4, 4, 4}, .spacing = 0.1f};
    lattice.isCuttable = isCuttable;
    sim::addLattice(scene, lattice);
    for (sim::Particle& particle : scene.particles)
        if (particle.position.y < 0.01f) particle.inverseMass = 0;
    scene.gravity = {0, 0, 0};
    return scene;
}

bool moves(const sim::Scene& scene, std::uint32_t particle) {
    return scene.particles[particle].inverseMass > 0;
}

TEST(LinkClasses, AreThoseOfTheColoredSolver) {
    const sim::Scene scene = block(false);
    const LinkClasses classes = linkClasses(scene, sim::Solver::gaussSeidel);
    std::uint32_t first = 0;
    std::set<std::uint32_t> listed;
    for (const std::uint32_t end : classes.ends) {
        std::set<std::uint32_t> touched;
        for (; first < end; ++first) {
            const sim::DistanceConstraint& link = scene.distances[classes.order[first]];
            for (const std::uint32_t particle : {link.a, link.b})
                EXPECT_TRUE(!moves(scene, particle) || touched.insert(particle).second) << particle;
            EXPECT_TRUE(listed.insert(classes.order[first]).second);
        }
    }
    for (std::uint32_t d = 0; d < scene.distances.size(); ++d)
        EXPECT_EQ(listed.contains(d),
                  moves(scene, scene.distances[d].a) || moves(scene, scene.distances[d].b));

    sim::Settings settings{.solver = sim::Solver::gaussSeidel, .substeps = 1};
    std::set<std::string> passes;
    for (const sim::Pass& pass : sim::compile(scene, settings)[sim::List::step])
        if (pass.label.starts_with("solve_distance_color")) passes.insert(pass.label);
    EXPECT_EQ(classes.count(), passes.size()) << "a pass of the step each";
    EXPECT_NE(classes.note.find(std::to_string(passes.size()) + " classes"), std::string::npos);
}

TEST(LinkClasses, AreSaidToBeMissingWhereAllLinksAreCorrectedAtOnce) {
    const sim::Scene scene = block(false);
    for (const sim::Solver solver : {sim::Solver::split, sim::Solver::jacobi}) {
        const LinkClasses classes = linkClasses(scene, solver);
        EXPECT_EQ(classes.count(), 1u);
        EXPECT_LT(classes.order.size(), scene.distances.size()) << "those of the fixed layer are nobody's";
        EXPECT_NE(classes.note.find("no color classes"), std::string::npos) << classes.note;
    }
}

TEST(LinkClasses, HaveColorsThatNeighboursInTurnTellApart) {
    for (std::size_t i = 0; i < 40; ++i) {
        double between = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const float here = classColor(i)[c], next = classColor(i + 1)[c];
            EXPECT_GE(here, 0);
            EXPECT_LE(here, 1);
            between += std::pow(std::sqrt(double{here}) - std::sqrt(double{next}), 2); // about as displayed
        }
        EXPECT_GT(std::sqrt(between), 0.25) << i;
    }
}

// A document with its links, ready for drawing.
struct Lines {
    explicit Lines(const sim::Scene& scene, sim::Solver solver)
        : document(test::device(), scene, {.solver = solver, .substeps = 8}),
          inspection(test::device(), document, 1) {
        inspection.prepare(layers);
        const VkCommandBuffer commands = test::queue().begin();
        document.recordReset(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    void step(const sim::Blade& blade = {}) {
        const VkCommandBuffer commands = test::queue().begin();
        document.recordStep(commands, nullptr, {}, blade);
        document.recordSkin(commands);
        inspection.record(commands, layers, 0);
        test::queue().wait(test::queue().submit(commands));
    }
    std::size_t leftOut() {
        const LinkLines& links = inspection.part<LinkLines>(layer::links);
        const auto ends = test::queue().download<std::uint32_t>(links.indices());
        std::size_t count = 0;
        for (std::size_t i = 0; i < ends.size(); i += 2) count += ends[i] == ends[i + 1] ? 1 : 0;
        return count;
    }

    Layers layers = shown({"hidden", "links"});
    Document document;
    Inspection inspection;
};

TEST(LinkLines, LeaveOutWhatABladeHasCut) {
    Lines lines(block(true), sim::Solver::split);
    lines.step();
    EXPECT_EQ(lines.leftOut(), 0u);
    const std::array<sim::Vec3, 2> from{{{0.17f, 1, -1}, {0.17f, 1, 1}}},
        to{{{0.17f, -1, -1}, {0.17f, -1, 1}}};
    lines.step({.from = from, .to = to});
    EXPECT_GT(lines.leftOut(), 100u);
    EXPECT_EQ(lines.leftOut(), lines.document.simulation().status(lines.document.steps()).linksCutInAll);
}

// A cut across a sheet that resists folding, where one additional link spans a node.
TEST(LinkLines, LeaveOutWhatLeadsOverACut) {
    sim::Scene scene{.name = "sheet", .gravity = {0, 0, 0}};
    sim::addCloth(
        scene,
        {.size = {9, 7}, .spacing = 0.1f, .membraneStiffness = 100, .skipStiffness = 50, .isCuttable = true});
    const auto own = static_cast<std::uint32_t>(scene.distances.size());
    scene.distances.push_back({.a = 9 * 2 + 3, .b = 9 * 4 + 5, .restLength = 0.2f * std::sqrt(2.0f)});
    Lines lines(scene, sim::Solver::split);
    lines.step();
    EXPECT_EQ(lines.leftOut(), 0u);
    const std::array<sim::Vec3, 2> from{{{0.37f, 1, -1}, {0.37f, 1, 2}}},
        to{{{0.37f, -1, -1}, {0.37f, -1, 2}}};
    lines.step({.from = from, .to = to});
    std::size_t across = 0;
    for (const sim::DistanceConstraint& link : scene.distances)
        across += (scene.particles[link.a].position.x < 0.37f) != (scene.particles[link.b].position.x < 0.37f)
                      ? 1
                      : 0;
    EXPECT_EQ(across, 7u + 2 * 6 + 2 * 7 + 1) << "rows, diagonals, two skips a row, and one over a corner";
    EXPECT_EQ(lines.leftOut(), across);
    EXPECT_TRUE((scene.particles[scene.distances[own].a].position.x < 0.37f) !=
                (scene.particles[scene.distances[own].b].position.x < 0.37f));
}

// Number of pixels that nearly have the color of a class.
std::size_t pixelsOf(const Picture& picture, const std::array<float, 3>& linear) {
    const auto shown = [](float x) {
        return 255 * (x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f);
    };
    std::size_t count = 0;
    for (std::size_t at = 0; at < picture.pixels.size(); at += 4) {
        bool isSame = true;
        for (std::size_t c = 0; c < 3; ++c)
            isSame = isSame && std::abs(static_cast<float>(picture.pixels[at + c]) - shown(linear[c])) < 4;
        count += isSame ? 1 : 0;
    }
    return count;
}

TEST(LinkLines, AreDrawnInTheColorsOfTheirClasses) {
    sim::Scene scene; // a star, in which every link is a class of its own
    scene.gravity = {0, 0, 0};
    scene.particles.push_back({.position = {0, 0.5f, 0}});
    for (std::uint32_t i = 1; i <= 6; ++i) {
        const float turn = static_cast<float>(i);
        scene.particles.push_back({.position = {std::cos(turn), 0.5f + std::sin(turn), 0}});
        scene.distances.push_back({.a = 0, .b = i, .restLength = 1});
    }
    Lines lines(scene, sim::Solver::gaussSeidel);
    Camera camera;
    camera = framing(camera, sceneBounds(scene), 1.6f);
    Offscreen offscreen(test::device(), {640, 400}, lightFor(scene, camera),
                        {.shadowSize = 512,
                         .floorSize = 256,
                         .shadowTaps = 4,
                         .skyTaps = 4,
                         .samples = VK_SAMPLE_COUNT_1_BIT});
    const auto take = [&](const Overlay& overlay) {
        offscreen.prepare(overlay.layers);
        const VkCommandBuffer commands = test::queue().begin();
        lines.document.recordSkin(commands);
        offscreen.record(commands, camera, lines.document.simulation(), overlay);
        test::queue().wait(test::queue().submit(commands));
        return offscreen.read();
    };
    lines.step();
    Overlay overlay;
    overlay.layers = lines.layers;
    overlay.buffers = lines.inspection.buffers(lines.layers);
    const Picture with = take(overlay), without = take({.layers = shown({"hidden"})});
    const std::size_t classes = lines.inspection.part<LinkLines>(layer::links).facts().classes.size();
    ASSERT_EQ(classes, 6u);
    for (std::size_t k = 0; k < classes; ++k)
        EXPECT_GT(pixelsOf(with, classColor(k)), pixelsOf(without, classColor(k)) + 10) << "class " << k;
}

} // namespace
} // namespace sinew::viewer
