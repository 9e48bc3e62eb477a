// Tests of what passes of contacts visit: what touches in a substep, and nothing else.
#include "collision/touched.h"
#include "common/layout.h"
#include "sim/collision/face_scenes.hpp"
#include "sim/runner.hpp"
#include "sinew/bodies.hpp"
#include "sinew/simulation.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

using namespace sinew;
using namespace sinew::sim;

namespace {

template <typename T> std::vector<T> read(test::Runner& runner, const std::string& label) {
    const auto& buffers = runner.simulation().program().buffers;
    for (std::uint32_t b = 0; b < buffers.size(); ++b)
        if (buffers[b].label == label) return test::queue().download<T>(runner.simulation().view({b}));
    ADD_FAILURE() << "no buffer " << label;
    return {};
}

// Lists of what touches in the last substep, of one kind of contacts, and the same by its candidates and
// contacts.
struct Visited {
    std::size_t candidates = 0;
    std::vector<std::uint32_t> particles, rows, points;
    std::set<std::uint32_t> inContact, touching;

    void setListed(const std::vector<std::uint32_t>& words, std::size_t slots) {
        const auto list = [&](std::uint32_t which, std::size_t section) {
            const auto first = words.begin() + static_cast<std::ptrdiff_t>(TOUCHED_MARKS + section * slots);
            return std::vector<std::uint32_t>(first, first + words[which]);
        };
        particles = list(TOUCHED_PARTICLES, 1);
        rows = list(TOUCHED_ROWS, 3);
        points = list(TOUCHED_POINTS, 2);
    }
};

Visited facesVisitedBy(test::Runner& runner) {
    const auto lists = read<layout::ListRange>(runner, "faces.lists");
    const auto faces = read<layout::ContactFace>(runner, "faces");
    const auto contacts = read<layout::ContactCandidate>(runner, "faces.contacts");
    const auto directions = read<layout::vec4>(runner, "faces.directions");
    Visited visited;
    visited.setListed(read<std::uint32_t>(runner, "faces.touched"), lists.size());
    for (std::uint32_t i = 0; i < lists.size(); ++i)
        for (std::uint32_t row = lists[i].first; row < lists[i].first + lists[i].count; ++row) {
            ++visited.candidates;
            if (directions[row].w == 0) continue;
            const layout::ContactFace& face = faces[contacts[row].other];
            visited.touching.insert(row);
            visited.inContact.insert({i, face.a, face.b, face.c});
        }
    return visited;
}

Visited edgesVisitedBy(test::Runner& runner) {
    const auto lists = read<layout::ListRange>(runner, "edges.lists");
    const auto edges = read<layout::ContactEdge>(runner, "edges");
    const auto contacts = read<layout::ContactCandidate>(runner, "edges.contacts");
    const auto directions = read<layout::vec4>(runner, "edges.directions");
    Visited visited;
    visited.setListed(read<std::uint32_t>(runner, "edges.touched"),
                      read<layout::ListRange>(runner, "faces.lists").size());
    for (std::uint32_t e = 0; e < lists.size(); ++e)
        for (std::uint32_t row = lists[e].first; row < lists[e].first + lists[e].count; ++row) {
            ++visited.candidates;
            if (directions[row].w == 0) continue;
            const layout::ContactEdge &own = edges[e], &other = edges[contacts[row].other];
            visited.touching.insert(row);
            visited.inContact.insert({own.a, own.b, other.a, other.b});
        }
    return visited;
}

} // namespace

// Cloth that swings and waves, but does not fold, has no candidates: its patches are alone
// (sheet_patches.hpp). A substep without a contact gives the passes behind the search nothing to do.
TEST(Touched, IsNothingInClothThatSwings) {
    Scene scene;
    addCloth(scene, {.size = {24, 24}, .spacing = 0.02f, .areaDensity = 0.2f, .thickness = 0.0115f});
    for (const std::uint32_t corner : {0u, 23u}) scene.particles[corner].inverseMass = 0;
    test::Runner runner(scene, {.substeps = 32});
    for (int step = 0; step < 10; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const Visited visited = facesVisitedBy(runner);
        EXPECT_EQ(visited.candidates, 0u) << step;
        EXPECT_TRUE(visited.points.empty()) << step;
        EXPECT_TRUE(visited.particles.empty()) << step;
        EXPECT_TRUE(visited.rows.empty()) << step;
    }
}

// The lists of a substep have each particle of a contact once, and all contacts, whatever is between them.
TEST(Touched, HasEachContactAndItsParticlesOnce) {
    const Scene scene = test::fallingFold();
    test::Runner runner(scene, {.substeps = 48, .contactRoom = 200});
    std::size_t contacts = 0;
    for (int step = 0; step < 40; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u);
        if (step % 4 != 3) continue;
        const Visited visited = facesVisitedBy(runner);
        contacts += visited.touching.size();
        const std::set<std::uint32_t> particles(visited.particles.begin(), visited.particles.end());
        EXPECT_EQ(particles.size(), visited.particles.size()) << "no particle twice";
        EXPECT_EQ(particles, visited.inContact) << "step " << step;
        const std::set<std::uint32_t> rows(visited.rows.begin(), visited.rows.end());
        EXPECT_EQ(rows.size(), visited.rows.size());
        EXPECT_TRUE(std::ranges::includes(rows, visited.touching)) << "step " << step;
        EXPECT_LT(rows.size(), visited.candidates);
    }
    EXPECT_GE(contacts, 100u);
}

// Contacts of particles of bodies are solved for particles with a candidate alone: the list has each once.
TEST(Touched, ParticlesWithACandidateAreListedOnce) {
    Scene scene;
    for (const float y : {0.0f, 0.45f})
        addLattice(scene, {.origin = {0.02f * y, y, 0},
                           .cells = {5, 3, 4},
                           .spacing = 0.1f,
                           .youngModulus = 1e5f,
                           .radius = 0.05f});
    scene.planes.push_back({.normal = {0, 1, 0}, .offset = -0.05f});
    test::Runner runner(scene, {.substeps = 16});
    std::size_t candidates = 0;
    for (int step = 0; step < 30; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const auto lists = read<layout::ListRange>(runner, "pairs.lists");
        const auto owners = read<std::uint32_t>(runner, "contacts.owners");
        const layout::GridBounds bounds = read<layout::GridBounds>(runner, "grid.bounds").front();
        std::vector<std::uint32_t> expected, listed(owners.begin(), owners.begin() + bounds.listed);
        for (std::uint32_t i = 0; i < lists.size(); ++i)
            if (lists[i].count > 0) expected.push_back(i);
        std::ranges::sort(listed);
        EXPECT_EQ(listed, expected) << step;
        candidates += expected.size();
    }
    EXPECT_GE(candidates, 100u);
}

// Slots without a particle stray from nowhere, also where passes run over awake work groups.
TEST(Touched, EmptySlotsMakeNoLists) {
    Scene scene;
    for (const float x : {0.0f, 0.6f})
        addLattice(scene, {.origin = {x, 0, 0},
                           .cells = {3, 3, 3},
                           .spacing = 0.1f,
                           .youngModulus = 1e5f,
                           .radius = 0.05f});
    for (const bool sleeps : {false, true}) {
        test::Runner runner(scene, {.substeps = 16, .sleeps = sleeps});
        ASSERT_EQ(runner.run(10).nonFinite, 0u);
        EXPECT_LE(read<layout::GridBounds>(runner, "grid.bounds").front().builds, 3u) << sleeps;
    }
}

// Few candidates of edges are listed, among them all that touch, and their ends.
TEST(Touched, HasEachContactBetweenEdgesAndItsEndsOnce) {
    const Scene scene = test::clothOnBox(0.15f);
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 200});
    std::size_t contacts = 0, rows = 0, candidates = 0;
    for (int step = 0; step < 40; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite + status.contactRoom, 0u);
        const Visited visited = edgesVisitedBy(runner);
        contacts += visited.touching.size();
        rows += visited.rows.size();
        candidates += visited.candidates;
        const std::set<std::uint32_t> particles(visited.particles.begin(), visited.particles.end());
        EXPECT_EQ(particles.size(), visited.particles.size()) << "no particle twice";
        EXPECT_TRUE(std::ranges::includes(particles, visited.inContact)) << "step " << step;
        const std::set<std::uint32_t> listed(visited.rows.begin(), visited.rows.end());
        EXPECT_EQ(listed.size(), visited.rows.size());
        EXPECT_TRUE(std::ranges::includes(listed, visited.touching)) << "step " << step;
    }
    EXPECT_GE(contacts, 100u);
    EXPECT_LT(2 * rows, candidates);
}
