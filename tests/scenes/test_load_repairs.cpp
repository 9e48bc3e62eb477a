// Notes and warnings about repairs of meshes in scenes, and the key that joins a wide seam.
#include "mesh/generate.hpp"
#include "scenes/load_fixture.hpp"

using namespace sinew;
using test::smallCloth;

namespace {

class Load : public test::LoadFixture {};

/// How many lines hold a text.
std::ptrdiff_t count(const std::vector<std::string>& lines, const std::string& text) {
    return std::ranges::count_if(lines,
                                 [&](const std::string& line) { return line.find(text) != line.npos; });
}

} // namespace

TEST_F(Load, SaysWhatJoinsAWideSeam) {
    mesh::TriangleMesh sheet{.name = "sheet", // two quads, 1 mm apart along x = 1
                             .positions = {{0, 0, 0},
                                           {1, 0, 0},
                                           {1, 1, 0},
                                           {0, 1, 0},
                                           {1.001f, 0, 0},
                                           {2, 0, 0},
                                           {2, 1, 0},
                                           {1.001f, 1, 0}},
                             .triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
    mesh::exportObj(folder_ / "sheet.obj", sheet);
    const std::string collider =
        smallCloth + "[[mesh_collider]]\nfile = \"sheet.obj\"\ncenter = [0, -2, 0]\n";
    EXPECT_EQ(
        load(collider).warnings,
        std::vector<std::string>{"mesh collider sheet.obj has a seam that is wider than the tolerance of "
                                 "2e-05 (units of the file): weld = 0.002 joins 2 of its open edges"});
    EXPECT_TRUE(load(collider + "repair = \"none\"\n").warnings.empty());
    const scenes::LoadedScene welded = load(collider + "weld = 0.002\n");
    EXPECT_TRUE(welded.warnings.empty());
    EXPECT_EQ(count(welded.notes, "2 vertices were joined with another one nearer than 0.002"), 1);
    expectError(
        "[[mesh]]\nfile = \"sheet.obj\"\nrepair = \"none\"\nweld = 1\n",
        "scene.toml:4: mesh[0].weld is given, but repair = \"none\" joins nothing: remove one of them");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nweld = 1\n",
                "scene.toml:3: mesh[0].weld is given, but a generated shape has no seams: remove it");
    expectError("[[mesh]]\nfile = \"sheet.obj\"\nweld = 0\n", "scene.toml:3: mesh[0].weld is 0: ");
}

TEST_F(Load, NotesTheRepairsOfThePartThatIsUsed) {
    mesh::TriangleMesh holed = mesh::generate("sphere", 12), mesh = holed;
    holed.triangles.pop_back();
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (sim::Vec3 position : holed.positions)
        mesh.positions.push_back({position.x / 2 + 1, position.y / 2, position.z / 2});
    for (const auto& [a, b, c] : holed.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
    mesh::exportObj(folder_ / "two.obj", mesh);
    const std::string scene = "[[mesh]]\nfile = \"two.obj\"\nresolution = 8\n";
    const auto notes = [&](const std::string& keys) {
        return count(load(scene + keys).notes, "1 hole was closed");
    };
    EXPECT_EQ(notes("parts = \"joined\"\n"), 1);
    EXPECT_EQ(notes("object = \"part 1\"\n"), 0) << "it had none";
    EXPECT_EQ(notes("object = \"part 2\"\n"), 1);
    const scenes::LoadedScene apart = load(scene + "parts = \"apart\"\n");
    EXPECT_EQ(apart.meshes.at(0).repairs.closedHoles, 0u);
    EXPECT_EQ(apart.meshes.at(1).repairs.closedHoles, 1u);
}
