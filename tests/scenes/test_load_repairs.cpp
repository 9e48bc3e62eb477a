// Tests of notes and warnings about mesh repairs in scenes, and of the key that joins a wide seam.
#include "mesh/generate.hpp"
#include "scenes/load_fixture.hpp"

using namespace sinew;
using test::smallCloth;

namespace {

class Load : public test::LoadFixture {};

/// Number of lines that contain a text.
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
        smallCloth + "collides = true\n[[mesh_collider]]\nfile = \"sheet.obj\"\ncenter = [0, -2, 0]\n";
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

TEST_F(Load, NotesAWeldThatJoinsNothing) {
    mesh::exportObj(folder_ / "s.obj", mesh::generate("sphere", 12));
    const std::string scene = "[[mesh]]\nfile = \"s.obj\"\nresolution = 8\n";
    EXPECT_EQ(
        count(load(scene + "weld = 0.01\n").notes, "mesh s.obj has no open edges that weld = 0.01 joins"), 1);
    EXPECT_EQ(count(load(scene).notes, "weld"), 0);
    EXPECT_EQ(count(load(smallCloth + "[[hold]]\nshape = \"mesh\"\nwithin = 5\nname = \"grip\"\nfile = "
                                      "\"s.obj\"\nweld = 0.01\n")
                        .notes,
                    "hold \"grip\", s.obj has no open edges that weld = 0.01 joins"),
              1);
}

namespace {

/// Spheres of these sizes along x at 0, 2, 4, ...
mesh::TriangleMesh spheres(const std::vector<float>& sizes) {
    const mesh::TriangleMesh one = mesh::generate("sphere", 12);
    mesh::TriangleMesh all;
    for (const float size : sizes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        const float x = 2 * static_cast<float>(first / one.positions.size());
        for (const sim::Vec3& p : one.positions)
            all.positions.push_back({size * p.x + x, size * p.y, size * p.z});
        for (const auto& [a, b, c] : one.triangles)
            all.triangles.push_back({a + first, b + first, c + first});
    }
    return all;
}

} // namespace

// A weld changes the meaning of a component's number. A note gives the new one, and the advice announces it
// before.
TEST_F(Load, SaysWhichPartAnObjectIs) {
    mesh::TriangleMesh mesh = spheres({1, 0.5f});
    mesh.positions.insert(mesh.positions.end(),
                          {{9, 0, 0}, {10, 0, 0}, {10, 1, 0}, {10.0005f, 1, 0}, {9, 1, 0}, {9, 0, 5e-4f}});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() - 6);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 3, first + 4, first + 5});
    mesh::exportObj(folder_ / "m.obj", mesh);
    const std::string scene = "[[mesh]]\nfile = \"m.obj\"\nresolution = 8\nobject = ";
    EXPECT_EQ(count(load(scene + "\"part 2\"\n").notes, "mesh m.obj: object takes "), 1);
    EXPECT_EQ(count(load(scene + "\"part 2\"\n").notes, " around (2, 0, 0) in units of the file"), 1);
    EXPECT_EQ(count(load(scene + "\"part 1\"\n").notes, " around (0, 0, 0) in units of the file"), 1);
    EXPECT_EQ(count(load(scene + "[\"part 3\", \"part 4\"]\n").warnings,
                    " of its open edges, and may give its parts other numbers"),
              1);
    expectError(scene + "\"part 2, piece 2\"\n",
                "scene.toml:4: mesh[0].object names \"part 2, piece 2\", which only numbers a piece that a "
                "choice left of \"part 2\": choose as before, and have its pieces as bodies by parts = "
                "\"apart\"");
}

TEST_F(Load, NamesMeshesOfOneFileByTheirBodies) {
    mesh::exportObj(folder_ / "s.obj", spheres({1}));
    const std::string mesh = "[[mesh]]\nfile = \"s.obj\"\nresolution = 8\ncenter = [0, 0, 0]\n";
    const std::vector<std::string> notes =
        load(mesh + "name = \"left\"\n" + mesh + "name = \"right\"\n" + mesh + mesh).notes;
    for (const char* called :
         {"mesh \"left\" (s.obj): ", "mesh \"right\" (s.obj): ", "mesh[2] (s.obj): ", "mesh[3] (s.obj): "})
        EXPECT_EQ(count(notes, called), 1) << called;
    EXPECT_EQ(count(load(mesh).notes, "mesh s.obj: "), 1);
}

// An inverted sphere within an open one is left out. Within a closed one it is a cavity, and beside it, it is
// turned.
TEST_F(Load, WarnsOfAComponentThatIsInsideOut) {
    const auto warned = [&](bool isOpen, bool isNested) {
        mesh::TriangleMesh mesh = spheres({1, 0.3f});
        const std::size_t half = mesh.positions.size() / 2;
        for (std::size_t i = half; i < 2 * half && isNested; ++i) mesh.positions[i].x -= 2;
        for (std::size_t t = mesh.triangles.size() / 2; t < mesh.triangles.size(); ++t)
            std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
        const float top = std::ranges::max(mesh.positions, {}, &sim::Vec3::y).y;
        std::erase_if(mesh.triangles, [&](const std::array<std::uint32_t, 3>& triangle) {
            return isOpen && std::ranges::all_of(triangle, [&](std::uint32_t corner) {
                       return mesh.positions[corner].y > 0.5f * top;
                   });
        });
        mesh::exportObj(folder_ / "m.obj", mesh);
        const scenes::LoadedScene loaded = load("[[mesh]]\nfile = \"m.obj\"\nresolution = 24\n");
        EXPECT_EQ(count(loaded.notes, ", inside out"), isOpen && isNested);
        return count(loaded.warnings, "mesh m.obj has 1 component inside out, \"part 2\": where it lies in ");
    };
    EXPECT_EQ(warned(true, true), 1);
    EXPECT_EQ(warned(false, true), 0);
    EXPECT_EQ(warned(true, false), 0);
    EXPECT_EQ(warned(false, false), 0);
    const std::string turned =
        "reverse its triangles (repair = \"close\" reverses closed parts that lie in no other), or";
    EXPECT_EQ(
        count(load("[[mesh]]\nfile = \"m.obj\"\nresolution = 24\nrepair = \"weld\"\n").warnings, turned), 1);
}
