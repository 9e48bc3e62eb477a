// What a repair says: of a part of a mesh, and of seams that are wider than what is joined.
#include "mesh/components.hpp"
#include "mesh/generate.hpp"
#include "mesh/repair.hpp"

#include "broken_meshes.hpp"

using namespace sinew::mesh;
using namespace sinew::mesh::test;

TEST(Repair, OfAPartIsWhatWasDoneInItsTriangles) {
    const TriangleMesh sphere = generate("sphere", 24), nearby = moved(sphere, {1, 0, 0});
    struct Case {
        TriangleMesh mesh; // of a part
        std::string sentence;
    };
    const std::vector<Case> cases{
        {soup(moved(sphere, {2, 0, 0}), 1e-7), " were joined with another one nearer than "},
        {without(moved(sphere, {3, 0, 0}), {7}), "1 hole was closed: 3 edges, 1 new triangle"},
        {inverted(moved(sphere, {4, 0, 0})), "1 closed part was inside out and turned"},
        {withFlipped(moved(sphere, {5, 0, 0}), 7), " were turned to face as the neighbours do"},
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
    TriangleMesh all = openedAbove(nearby, 0.05f); // stays open
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
