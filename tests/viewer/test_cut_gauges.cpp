// Tests of statistics after a cut: strain of the live links, and pieces counted as in reports and meshes.
#include "played.hpp"

#include "app/drawn.hpp"
#include "sinew/bodies.hpp"
#include "viewer/input/inspector.hpp"
#include "viewer/input/piece_probe.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/ui/status_line.hpp"

#include <map>

namespace sinew::viewer {
namespace {

// A scene with its own blade.
struct Cut : Scene {
    explicit Cut(const std::string& text) : Scene(text) {
        document.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    }
    void play(int steps) {
        run([&](VkCommandBuffer commands) {
            for (int i = 0; i < steps; ++i) step(commands);
            document.recordSkin(commands);
            probe.record(commands);
            counter.record(commands);
        });
    }
    sim::Status status() const { return document.simulation().status(document.steps()); }
    app::PieceCount reported() {
        const sim::Scene& scene = document.scene();
        return app::countPieces(
            scene, app::downloadDrawn(test::queue(), document.simulation(), scene, document.settings()),
            status().pieces);
    }
    PieceProbe counter{test::device(), document};
};

std::string bladeAt(const std::string& x, const std::string& end) {
    return "[[blade]]\ntimes = [0, " + end + "]\nedges = [[[" + x + ", 2, -2], [" + x + ", 2, 2]], [[" + x +
           ", -2, -2], [" + x + ", -2, 2]]]\n";
}

const std::map<std::string, std::string> bodies{
    {"box", "[[box]]\nparticles = [6, 5, 5]\nspacing = 0.1\ncenter = [0, 0.1, 0]\nyoung_modulus = 1e6\n"},
    {"mesh", "[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\nsize = 0.5\nresolution = 8\n"
             "center = [0, 0.1, 0]\nyoung_modulus = 1e6\n"},
    {"cloth", "[[cloth]]\nsize = [14, 10]\nspacing = 0.05\norigin = [-0.3, 0.1, -0.2]\n"
              "skip_stiffness = 10\n"}};

// Two slopes separate the halves, so that cut links would be long.
std::string parted(const std::string& body) {
    return "dt = 0.01\n[solver]\nsubsteps = 16\n[[plane]]\nfriction = 0\nnormal = [0.6, 0.8, 0]\n"
           "offset = -0.3\n[[plane]]\nfriction = 0\nnormal = [-0.6, 0.8, 0]\noffset = -0.3\n" +
           body + "cuttable = true\n" + bladeAt("0.06", "0.01");
}

// The modulus is read off links and volumes of cells.
TEST(SceneFacts, HaveTheYoungModulusOfVoxelBodies) {
    for (const float poisson : {0.25f, 0.3f, 0.45f, 0.49f})
        for (const bool hasBodyDiagonals : {false, true}) {
            sim::Scene scene;
            sim::addLattice(scene, {.cells = {3, 2, 2},
                                    .spacing = 0.07f,
                                    .youngModulus = 4.2e4f,
                                    .poissonRatio = poisson,
                                    .hasBodyDiagonals = hasBodyDiagonals});
            EXPECT_NEAR(youngModulusOf(scene.grids.at(0)), 4.2e4f, 42) << poisson << hasBodyDiagonals;
        }
    const Scene box(
        std::string("[[box]]\nname = \"a\"\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 1, 0]\n"
                    "young_modulus = 7e3\n[[cloth]]\nsize = [4, 4]\nspacing = 0.05\norigin = [0, 2, 0]\n"));
    const SceneFacts facts = sceneFacts(box.opening, box.document, test::device());
    ASSERT_EQ(facts.youngModuli.size(), facts.bodies.size());
    for (std::size_t i = 0; i < facts.bodies.size(); ++i)
        EXPECT_NEAR(facts.youngModuli[i], facts.bodies[i] == "a" ? 7e3f : 0, 7) << facts.bodies[i];
}

TEST(SceneFacts, SayThatMostLinksOfABodyAreSofterThanAsked) {
    sim::BodyStiffness body;
    body.elastic = 100;
    const auto factsOf = [&body](std::size_t clamped, std::size_t soft, double softest,
                                 std::uint32_t needed) {
        body.soft = soft;
        SceneFacts facts;
        setStiffness(facts, {.elastic = 100,
                             .clamped = clamped,
                             .soft = soft,
                             .softest = softest,
                             .bodies = {body},
                             .neededSubsteps = needed});
        return facts;
    };
    EXPECT_EQ(factsOf(3, 0, 0.97, 37).stiffness, "") << "within the tolerance";
    EXPECT_EQ(factsOf(3, 0, 0.97, 37).neededSubsteps, 0u);
    EXPECT_EQ(factsOf(60, 50, 0.5, 60).stiffness, "") << "some links alone";
    EXPECT_EQ(factsOf(0, 80, 0.5, 60).stiffness, "") << "of a solver without a clamp";
    const SceneFacts soft = factsOf(90, 80, 0.0213, 331), hardly = factsOf(90, 80, 0.001, 4000);
    EXPECT_EQ(soft.stiffness, "Softer than asked: the softest link has 2 % of its stiffness.");
    EXPECT_EQ(soft.neededSubsteps, 331u);
    EXPECT_EQ(hardly.stiffness, "Softer than asked: the softest link has less than 1 % of its stiffness.");
    EXPECT_EQ(hardly.neededSubsteps, 0u) << "more than the panel allows";
}

TEST(CutGauges, ShowTheStrainOfLinksThatHold) {
    for (const auto& [name, body] : bodies) {
        Cut cut(parted(body));
        cut.play(25);
        ASSERT_GT(cut.status().linksCutInAll, 0u) << name;
        const Strain strain = measureStrain(cut.document.scene(), cut.probe);
        EXPECT_GT(strain.rms, 0) << name;
        EXPECT_LT(strain.rms, 0.02) << name << "; with links that are cut 0.03 to 0.35";
        Gauges gauges(cut.document, 0.01);
        gauges.strainMeasured(strain);
        gauges.stepFinished(cut.status());
        EXPECT_EQ(gauges.facts(cut.document).strainRms.count(), 1u) << name << ": a cut clears no curve";
    }
}

TEST(CutGauges, ShowTheStrainOfAllLinksWhileNothingIsCut) {
    Cut cut(parted(bodies.at("box")));
    cut.document.setBlades({});
    cut.play(25);
    const auto all = [](std::size_t) { return true; };
    const std::span<const float> places(&cut.probe.positions().front().x, 4 * cut.probe.positions().size());
    EXPECT_EQ(measureStrain(cut.document.scene(), cut.probe).rms,
              app::strainOf(cut.document.scene(), places, all).rms);
}

TEST(CutGauges, SayTheStrainOfLinksThatHoldUnderThePointer) {
    Cut cut(parted(bodies.at("box")));
    cut.play(25);
    std::size_t whole = 0, parts = 0;
    const auto all = [](std::size_t) { return true; };
    for (std::uint32_t i = 0; i < cut.document.scene().particles.size(); ++i) {
        const Found found =
            foundAt(cut.document.scene(), i, cut.probe.positions(), {}, cut.probe.liveLinks());
        const Found uncut = foundAt(cut.document.scene(), i, cut.probe.positions(), {}, all);
        (found.links == uncut.links ? whole : parts) += 1;
        ASSERT_TRUE(found.strain) << i;
        EXPECT_LT(found.strain->largest, 0.2) << i;
    }
    EXPECT_EQ(parts, 50u) << "those of the two layers beside the blade";
    EXPECT_EQ(whole, 100u);
}

TEST(CutGauges, CountPiecesAsReportsDo) {
    for (const char* at : {"0.1055", "-0.13", "0.142"})
        for (const char* resolution : {"8", "13"}) {
            Cut cut(std::string("gravity = [0, 0, 0]\n[[mesh]]\ngenerate = \"sphere\"\ndetail = 32\n"
                                "size = 0.3\ncenter = [0, 0, 0]\ncuttable = true\nresolution = ") +
                    resolution + "\n" + bladeAt(at, "0.0166667"));
            cut.play(4);
            const std::uint32_t all = cut.status().pieces;
            const app::PieceCount count = cut.counter.count(all);
            EXPECT_EQ(count, (app::PieceCount{2, all - 2})) << at << ", " << resolution;
            EXPECT_EQ(count, cut.reported()) << at << ", " << resolution;
        }
    EXPECT_EQ(app::toText({2, 0}), "2 pieces");
    EXPECT_EQ(app::toText({2, 6}), "2 pieces and 6 fragments without a surface");
}

TEST(CutGauges, CountPiecesOfEveryKindOfBody) {
    for (const auto& [name, body] : bodies) {
        Cut cut(parted(body));
        cut.play(4);
        EXPECT_EQ(cut.counter.count(cut.status().pieces), cut.reported()) << name;
        EXPECT_EQ(cut.counter.count(cut.status().pieces).pieces, 2u) << name;
    }
}

TEST(CutGauges, SayThatNothingWasCountedWhereThereIsNoCopy) {
    Cut cut(parted(bodies.at("box")));
    cut.play(4);
    const PieceProbe withoutCopies(test::device(), cut.document);
    const app::PieceCount count = withoutCopies.count(cut.status().pieces);
    EXPECT_FALSE(count.isCounted);
    EXPECT_EQ(app::toText(count), "pieces were not counted");
    EXPECT_TRUE(cut.counter.count(cut.status().pieces).isCounted);
    StatusLine line(cut.document.scene(), test::device());
    line.setPieces(count);
    const auto title = line.title(false, false);
    ASSERT_TRUE(title);
    EXPECT_NE(title->find(" - ? pieces - "), std::string::npos) << *title;
}

TEST(CutGauges, KeepTheCountUntilTheNextOne) {
    Cut cut(parted(bodies.at("box")));
    Gauges gauges(cut.document, 0.01);
    sim::Status status{.pieces = 1};
    gauges.stepFinished(status);
    EXPECT_EQ(gauges.pieces(), (app::PieceCount{1, 0}));
    status.linksCutInAll = 7;
    status.pieces = 8;
    gauges.stepFinished(status);
    EXPECT_EQ(gauges.pieces(), (app::PieceCount{1, 0})) << "which of them have a surface nobody knows yet";
    gauges.piecesCounted({2, 6});
    gauges.stepFinished(status);
    EXPECT_EQ(gauges.pieces(), (app::PieceCount{2, 6}));
    gauges.restart();
    EXPECT_EQ(gauges.pieces(), app::PieceCount());
}

} // namespace
} // namespace sinew::viewer
