// Tests of blades through sheets whose links and bends are listed in `split`: sheets with bending stiffness,
// folding and strain rates.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::CutPlane;
using test::sweepOf;

namespace {

constexpr float spacing = 0.05f;

struct Material {
    float skip = 0, bending = 0, damping = 0;
    bool isCuttable = true;
};

constexpr Material materials[] = {{.skip = 50}, {.bending = 1e-4f}, {.damping = 1e-4f}, {30, 1e-4f, 1e-4f}};

Scene sheet(const Material& material) {
    Scene scene{.name = "sheet", .gravity = {0, 0, 0}, .dampingTime = material.damping};
    scene.particles.push_back({.position = {5, 5, 5}, .inverseMass = 1}); // in front of the sheet's slots
    addCloth(scene, {.origin = {0, 0.2f, 0},
                     .size = {14, 9},
                     .spacing = spacing,
                     .membraneStiffness = 100,
                     .skipStiffness = material.skip,
                     .bendingStiffness = material.bending,
                     .isCuttable = material.isCuttable});
    return scene;
}

CutPlane upright(const CutBody& body, double x, double z, double angle) {
    return {0.5 * (body.at(1) + body.at(14 * 9)) + double{spacing} * Vector3d(x, 0, z),
            Vector3d(std::cos(angle), 0, std::sin(angle))};
}

BufferId bufferOf(const Simulation& simulation, const std::string& label) {
    const auto& buffers = simulation.program().buffers;
    const auto found = std::ranges::find(buffers, label, &BufferSpec::label);
    return found == buffers.end() ? BufferId{}
                                  : BufferId{static_cast<std::uint32_t>(found - buffers.begin())};
}

template <typename T> std::vector<T> listOf(CutBody& body, const std::string& label) {
    const BufferId buffer = bufferOf(body.runner().simulation(), label);
    if (buffer == BufferId{}) return {};
    return test::queue().download<T>(body.runner().simulation().view(buffer));
}

// Number of constraints with stiffness: in all, and across the plane.
struct Count {
    std::size_t live = 0, across = 0;
};

Count bendsAcross(CutBody& body, const CutPlane& plane) {
    const auto isAbove = [&](std::uint32_t i) { return body.isAbove(body.at(i), plane); };
    Count count;
    for (const layout::SplitBend& bend : listOf<layout::SplitBend>(body, "bends")) {
        if (bend.stiffness == 0) continue;
        ++count.live;
        count.across += isAbove(bend.a) == isAbove(bend.b) && isAbove(bend.b) == isAbove(bend.c) ? 0 : 1;
    }
    return count;
}

// Uses slots, which have the order of the scene here.
Count linksAcross(CutBody& body, const CutPlane& plane, bool isRanged) {
    const auto links = listOf<layout::SplitLink>(body, "distance.links");
    const auto first = listOf<std::uint32_t>(body, "distance.first_links");
    const auto particles = static_cast<std::uint32_t>(body.scene().particles.size());
    const auto isAbove = [&](std::uint32_t i) { return body.isAbove(body.at(i), plane); };
    Count count;
    const auto add = [&](std::uint32_t i, const layout::SplitLink& link) {
        if (link.stiffness == 0 || link.other == i) return;
        ++count.live;
        count.across += isAbove(i) != isAbove(link.other) ? 1 : 0;
    };
    if (isRanged) {
        for (std::uint32_t i = 0; i < particles; ++i)
            for (std::uint32_t e = first[i]; e < first[i + 1]; ++e) add(i, links[e]);
        return count;
    }
    const std::size_t degree = links.size() / paddedCount(particles);
    for (std::uint32_t i = 0; i < particles; ++i)
        for (std::size_t s = 0; s < degree; ++s)
            add(i, links[(i / LINK_BLOCK * degree + s) * LINK_BLOCK + i % LINK_BLOCK]);
    return count;
}

bool isRanged(CutBody& body) {
    return bufferOf(body.runner().simulation(), "distance.first_links") != BufferId{};
}

} // namespace

TEST(CutSheet, ThatIsListedKeepsNoLinkAndNoBendAcrossTheBlade) {
    const std::array<double, 3> cuts[] = {
        {0.5, 0, 0}, {0, 0, 0}, {0.2, 0.1, 0.7854}, {0.1, 0.4, 0.3}, {0, 0.3, 1.5}};
    for (const Material& material : materials) {
        CutBody body(sheet(material));
        for (const auto& [x, z, angle] : cuts) {
            body.runner().reset();
            body.runner().run(1);
            const CutPlane plane = upright(body, x, z, angle);
            const Count links = linksAcross(body, plane, isRanged(body)), bends = bendsAcross(body, plane);
            EXPECT_EQ(body.cut(sweepOf(plane, 2, 3)).pieces, 2u) << angle;
            EXPECT_EQ(body.bridges(plane), 0u);
            EXPECT_EQ(body.pieces(), body.expectedPieces());
            const Count left = linksAcross(body, plane, isRanged(body)), bent = bendsAcross(body, plane);
            EXPECT_EQ(left.across, 0u) << material.skip << ", " << angle;
            EXPECT_EQ(bent.across, 0u);
            EXPECT_GT(links.across, 20u);
            EXPECT_GE(left.live, links.live - links.across) << "and no other died";
            EXPECT_GE(bent.live, bends.live - bends.across);
            EXPECT_EQ(bends.live > 0, material.bending > 0);
        }
    }
}

TEST(CutSheet, ThatIsListedFallsApartAndKeepsMassAndMomentum) {
    for (const Material& material : materials) {
        Scene scene = sheet(material);
        const Vector3d point(6.2 * double{spacing}, 0.2, 4.3 * double{spacing}), normal(0.8, 0, 0.6);
        for (Particle& particle : scene.particles) {
            const double side = normal.dot(test::toVector(particle.position) - point) >= 0 ? 1 : -1;
            particle.velocity = test::toFloats(Vector3d(0.1, 0.2, 0) + 0.5 * side * normal);
        }
        CutBody body(scene, {.substeps = 8});
        ASSERT_EQ(body.cut(sweepOf({point, normal}, 2, 2)).pieces, 2u);
        body.runner().run(29);
        const auto x = body.runner().positions(), v = body.runner().velocities();
        Vector3d momentum = Vector3d::Zero(), expected = Vector3d::Zero();
        for (std::uint32_t i = 0; i < x.size(); ++i) {
            const double mass = 1 / double{scene.particles[i].inverseMass};
            momentum += mass * v[i];
            expected += mass * test::toVector(scene.particles[i].velocity);
            EXPECT_LE((x[i] - body.at(i) - 0.5 * test::toVector(scene.particles[i].velocity)).norm(), 2e-4)
                << "particle " << i;
        }
        EXPECT_LE((momentum - expected).norm(), 1e-5 * test::massOf(scene));
    }
}

TEST(CutSheet, ThatIsListedMovesAsOneThatMayNotBeCutWhileItIsWhole) {
    for (const Material& material : {materials[1], materials[2]}) { // both use one form of the kernels
        Material plain = material;
        plain.isCuttable = false;
        Scene cuttable = sheet(material), other = sheet(plain);
        for (Scene* scene : {&cuttable, &other})
            for (Particle& particle : scene->particles) particle.velocity.y = particle.position.x;
        EXPECT_EQ(test::hashOfRun(cuttable, {.substeps = 5}), test::hashOfRun(other, {.substeps = 5}));
    }
}

TEST(CutSheet, ThatIsListedEndsInTheSameBitsInReversedOrder) {
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        CutBody body(sheet(materials[3]), {.substeps = 6, .isReversed = isReversed});
        body.cut(sweepOf(upright(body, 0.3, 0.2, 0.5), 2));
        body.runner().run(4);
        body.cut(sweepOf(upright(body, 0.1, -0.7, -0.9), 0.3));
        body.runner().run(8);
        hashes.push_back(body.runner().stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(CutSheet, ThatIsListedComesBackWithAnUndoneStepAndWithTheTopology) {
    CutBody body(sheet(materials[3]));
    const std::string links = "distance.links", bends = "bends";
    body.cut(sweepOf(upright(body, 0.3, 0.2, 0.5), 2));
    const auto cutLinks = listOf<std::uint32_t>(body, links), cutBends = listOf<std::uint32_t>(body, bends);
    const vk::Buffer topology = body.runner().saveTopology();
    const auto second = sweepOf(upright(body, 0.1, -0.7, -0.9), 2);
    body.runner().writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(second).nonFinite, 0u);
    EXPECT_EQ(listOf<std::uint32_t>(body, links), cutLinks);
    EXPECT_EQ(listOf<std::uint32_t>(body, bends), cutBends);
    EXPECT_EQ(body.cut(second).pieces, 4u);
    EXPECT_NE(listOf<std::uint32_t>(body, links), cutLinks);
    EXPECT_NE(listOf<std::uint32_t>(body, bends), cutBends);
    body.runner().loadTopology(topology);
    EXPECT_EQ(listOf<std::uint32_t>(body, links), cutLinks);
    EXPECT_EQ(listOf<std::uint32_t>(body, bends), cutBends);
}

TEST(CutSheet, IsRefusedForOtherSolversAndTearingForWhatMayNotBeCut) {
    const auto complaint = [](const Scene& scene, const Settings& settings = {}) {
        const auto complaints = validate(scene, settings);
        return complaints.empty() ? std::string("none") : complaints.front();
    };
    Scene scene = sheet(materials[3]);
    EXPECT_EQ(complaint(scene), "none");
    Scene sewn = scene; // no mask has the link to this extra particle
    sewn.particles.push_back({.position = {9, 9, 9}});
    sewn.distances.push_back(
        {sewn.grids[0].firstParticle, static_cast<std::uint32_t>(sewn.particles.size() - 1), 1});
    EXPECT_NE(complaint(sewn).find("leads out of it"), std::string::npos) << complaint(sewn);
    scene.dampingTime = 0;
    EXPECT_NE(complaint(scene, {.solver = Solver::gaussSeidel}).find("may be cut, which solver"),
              std::string::npos);
    scene.grids[0].tearStrain = -0.1f;
    EXPECT_NE(complaint(scene).find(".tearStrain: is"), std::string::npos);
    scene.grids[0].tearStrain = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(complaint(scene).find(".tearStrain: is"), std::string::npos);
    scene.grids[0].tearStrain = 0.1f;
    EXPECT_EQ(complaint(scene), "none");
    scene.grids[0].tearsPerStep = 0;
    EXPECT_NE(complaint(scene).find(".tearsPerStep: is"), std::string::npos);
    scene.grids[0].tearsPerStep = 1;
    scene.grids[0].isCuttable = false;
    EXPECT_NE(complaint(scene).find("which only a body with isCuttable can"), std::string::npos);
}

// A removed edge lies in the grid of edges at its own place with no extent; a wide one would slow every
// search of edges.
TEST(CutSheet, ThatIsCoarseHasNoWiderEdgesForACut) {
    Scene scene;
    addCloth(scene, {.size = {14, 9},
                     .spacing = spacing,
                     .membraneStiffness = 100,
                     .thickness = spacing / 10,
                     .isCuttable = true});
    constexpr std::uint32_t substeps = 4;
    CutBody body(scene, {.substeps = substeps});
    const CutPlane plane{0.5 * (body.at(0) + body.at(14 * 9 - 1)) + Vector3d(0.01, 0, 0), {1, 0, 0}};
    const auto dead = [&] { // includes padding
        const auto edges = listOf<layout::ContactEdge>(body, "edges");
        return std::ranges::count_if(edges, [](const layout::ContactEdge& edge) { return edge.radius < 0; });
    };
    const auto padding = dead();
    ASSERT_GT(body.cut(sweepOf(plane, 1)).linksCut, 8u);
    ASSERT_GT(dead(), padding + 8);
    const float h = scene.dt / substeps;
    double widest = 0;
    for (const layout::vec4& speed : listOf<layout::vec4>(body, "edges.speeds"))
        widest = std::max(widest, double{speed.x} * double{h});
    EXPECT_GT(widest, 0) << "it falls";
    EXPECT_LT(widest, 0.5 * double{spacing});
}
