// Tests of repair reports: for a part of a mesh, and for seams wider than the joining tolerance.
#include "mesh/components.hpp"
#include "mesh/generate.hpp"
#include "mesh/repair.hpp"

#include "broken_meshes.hpp"

using namespace sinew::mesh;
using namespace sinew::mesh::test;

TEST(Repair, OfAPartIsWhatWasDoneInItsTriangles) {
    const TriangleMesh sphere = generate("sphere", 24), nearby = moved(sphere, {1, 0, 0});
    struct Case {
        TriangleMesh mesh; // a part of it is repaired
        std::string sentence;
    };
    const std::vector<Case> cases{
        {soup(moved(sphere, {2, 0, 0}), 1e-7), " were joined with another one nearer than "},
        {without(moved(sphere, {3, 0, 0}), {7}), "1 hole was closed: 3 edges, 1 new triangle"},
        {inverted(moved(sphere, {4, 0, 0})), "1 closed part was inside out and reversed"},
        {withFlipped(moved(sphere, {5, 0, 0}), 7), " were reversed to agree with their neighbours"},
        {[&] {
             TriangleMesh mesh = moved(sphere, {6, 0, 0});
             addJunction(mesh, 3, 0, 0.5);
             return mesh;
         }(),
         "1 edge was split at T-junctions"},
        {[&] {
             TriangleMesh mesh = moved(sphere, {7, 0, 0}); // with a fin
             const auto [a, b, c] = mesh.triangles[0];
             mesh.positions.push_back({8, 8, 8});
             mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
             return mesh;
         }(),
         "1 triangle was removed"},
        {sphere, ""}};
    TriangleMesh all = openedAbove(nearby, 0.05f); // the opening remains
    for (const Case& part : cases) all = joined(all, part.mesh);
    const Result whole = repaired(all);
    EXPECT_GT(whole.report.openEdges, 0u);
    const std::vector<Component> parts = components(whole.mesh);
    ASSERT_EQ(parts.size(), cases.size() + 1);
    std::size_t sentences = 0;
    for (const Component& component : parts) {
        const TriangleMesh part = extract(whole.mesh, component);
        const Repairs report = repairsOf(part, whole.report);
        const auto number = static_cast<int>(std::lround(double{inspect(part).low.x} + 0.15));
        EXPECT_EQ(report.openEdges > 0, number == 1);
        const std::vector<std::string> said = sentencesOf(report);
        sentences += said.size();
        if (number < 2) {
            EXPECT_TRUE(said.empty()) << said[0];
            continue;
        }
        ASSERT_EQ(said.size(), 1u) << number;
        EXPECT_NE(said[0].find(cases.at(static_cast<std::size_t>(number - 2)).sentence), std::string::npos)
            << number << ": " << said[0];
    }
    EXPECT_EQ(sentences, 6u);
    EXPECT_EQ(sentencesOf(repairsOf(whole.mesh, whole.report)), sentencesOf(whole.report));
}

// A later step may join vertices that an earlier step reported, or remove their triangles.
TEST(Repair, IsPlacedAtVerticesOfTheResult) {
    TriangleMesh flap = generate("sphere", 24); // a free sliver, with a fin
    const auto n = static_cast<std::uint32_t>(flap.positions.size());
    flap.positions.insert(flap.positions.end(), {{3, 0, 0}, {3.000001f, 0, 0}, {3, 1e-6f, 0}, {8, 8, 8}});
    flap.triangles.push_back({n, n + 1, n + 2});
    flap.triangles.push_back({flap.triangles[0][0], flap.triangles[0][1], n + 3});
    TriangleMesh junctions = soup(generate("sphere", 24), 1e-7);
    addJunction(junctions, 3, 0, 0.5);
    addJunction(junctions, 9, 1, 0.25);
    for (const TriangleMesh& mesh : {flap, junctions, soup(flap, 1e-7), without(junctions, {7, 50})}) {
        const Result result = repaired(mesh);
        ASSERT_TRUE(result.report.isAny());
        const auto isVertex = [&](const Vec3& place) {
            return std::ranges::any_of(result.mesh.positions, [&](const Vec3& x) {
                return x.x == place.x && x.y == place.y && x.z == place.z;
            });
        };
        const RepairPlaces& places = result.report.places;
        for (const Places& kind : {places.joined, places.split, places.removed, places.turnedTriangles})
            for (const Vec3& place : kind) EXPECT_TRUE(isVertex(place)) << place.x << ' ' << place.y;
        for (const ClosedHole& hole : places.holes) EXPECT_TRUE(isVertex(hole.place));
    }
}

TEST(Repair, OfManyPartsAddsUpToThatOfTheWhole) {
    const TriangleMesh holed = without(generate("sphere", 8), {7});
    TriangleMesh all;
    constexpr int count = 300;
    for (int part = 0; part < count; ++part)
        all = joined(all, moved(holed, {2 * static_cast<float>(part), 0, 0}));
    const Result whole = repaired(all);
    std::size_t holes = 0;
    for (const Component& component : components(whole.mesh))
        holes += repairsOf(extract(whole.mesh, component), whole.report).closedHoles;
    EXPECT_EQ(holes, std::size_t{count});
}

namespace {

/// Splits a sphere at `height`: triangles with their middle above it are lifted by `gap`.
TriangleMesh halves(float height, float gap) {
    const TriangleMesh sphere = generate("sphere", 24);
    std::vector<bool> isBelow;
    for (const auto& [a, b, c] : sphere.triangles)
        isBelow.push_back((sphere.positions[a].y + sphere.positions[b].y + sphere.positions[c].y) / 3 <
                          height);
    const TriangleMesh low = keep(sphere, isBelow);
    isBelow.flip();
    return joined(low, moved(keep(sphere, isBelow), {0, gap, 0}));
}

} // namespace

TEST(Repair, SaysWhichToleranceJoinsTwoHalves) {
    const double volume = inspect(generate("sphere", 24)).volume;
    EXPECT_EQ(repaired(halves(0, 1e-6f)).report.seam.weld, 0) << "that is joined anyway";
    for (const float gap : {3e-5f, 2e-4f, 1.5e-3f})
        for (const float height : {0.0f, 0.14f}) { // at one height, a lid closes one of two caps
            const TriangleMesh mesh = halves(height, gap);
            const Repairs report = repaired(mesh).report;
            EXPECT_GE(report.seam.weld, double{gap}) << height;
            EXPECT_LE(report.seam.weld, std::max(20 * double{gap}, 4e-5)) << height;
            EXPECT_GT(report.seam.edges, 0u);
            Result cured;
            cured.mesh = repair(weld(mesh, cured.defects), Repair::close, cured.defects, cured.report,
                                report.seam.weld);
            expectClosed(cured, volume, 0.03);
            EXPECT_EQ(components(cured.mesh).size(), 1u);
            EXPECT_EQ(cured.report.seam.weld, 0);
        }
}

// Each half gets a lid, so that neither remains open.
TEST(Repair, SaysTheSeamOfAChoiceThatLidsClosed) {
    const auto isOnTheRight = [](const std::array<std::uint32_t, 3>& triangle) {
        return std::ranges::all_of(triangle, [](std::uint32_t i) { return unitBox.positions[i].x == 1; });
    };
    const auto lid = std::ranges::find_if(unitBox.triangles, isOnTheRight) - unitBox.triangles.begin();
    const TriangleMesh half = without(unitBox, {static_cast<std::size_t>(lid)});
    TriangleMesh other = inverted(half);
    for (Vec3& x : other.positions) x.x = 2.0002f - x.x;
    const Result whole = repaired(joined(half, other));
    ASSERT_GT(whole.report.seam.weld, 0);
    ASSERT_EQ(whole.defects.boundaryEdges, 0u);
    std::string unknown;
    const auto seamOf = [&](const std::vector<std::string>& names) {
        return repairsOf(*choose(whole.mesh, names, unknown), whole.report).seam;
    };
    EXPECT_EQ(seamOf({"part 1", "part 2"}).weld, whole.report.seam.weld);
    EXPECT_EQ(seamOf({"part 1", "part 2"}).edges, whole.report.seam.edges);
    EXPECT_EQ(seamOf({"part 1"}).weld, 0) << "the other half is left out";
}

TEST(Repair, FindsNoSeamWhereNoneIs) {
    EXPECT_EQ(repaired(generate("organ", 24)).report.seam.weld, 0);
    EXPECT_EQ(repaired(generate("cloth", 64)).report.seam.weld, 0) << "a rim alone";
    EXPECT_EQ(repaired(halves(0, 0.02f)).report.seam.weld, 0) << "far apart";
    EXPECT_EQ(repaired(openedAbove(generate("sphere", 24), 0.05f)).report.seam.weld, 0);
    EXPECT_EQ(repaired(joined(box({0, 0, 0}, {1, 1, 1}), box({1.001f, 0, 0}, {2, 1, 1}))).report.seam.weld, 0)
        << "closed parts have no seam";
    EXPECT_EQ(repaired(halves(0, 2e-4f), Repair::none).report.seam.weld, 0) << "nothing is asked for";
}
