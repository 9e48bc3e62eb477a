// Tests of meshes in scenes: their sources, their placement, and the messages about them.
#include "mesh/generate.hpp"
#include "scenes/load_fixture.hpp"
#include "scenes/mesh_notes.hpp"

using namespace sinew;
namespace fs = std::filesystem;
using test::smallCloth;
using test::tetrahedron;

namespace {

class Load : public test::LoadFixture {};

constexpr auto tetrahedronScene = "[[mesh]]\nfile = \"m.obj\"\nresolution = 4\n";

double width(const scenes::LoadedScene& loaded) {
    const mesh::MeshReport& surface = loaded.meshes.at(0).surface;
    return double{surface.high.x} - double{surface.low.x};
}

/// Number of lines that contain a text.
std::ptrdiff_t count(const std::vector<std::string>& lines, const std::string& text) {
    return std::ranges::count_if(lines,
                                 [&](const std::string& line) { return line.find(text) != line.npos; });
}

} // namespace

TEST_F(Load, DropsTheMeshOfTheCommandLine) {
    mesh::exportObj(folder_ / "tetrahedron.obj", tetrahedron(7)); // in any unit: the scene scales it
    const scenes::LoadedScene loaded = scenes::load(folder_ / "tetrahedron.obj");
    ASSERT_EQ(loaded.meshes.size(), 1u);
    EXPECT_EQ(loaded.meshes[0].file, "tetrahedron.obj");
    EXPECT_TRUE(loaded.meshes[0].surface.defects.isClosed());
    EXPECT_NEAR(double{loaded.meshes[0].surface.high.x - loaded.meshes[0].surface.low.x}, 0.4, 1e-6);
    EXPECT_EQ(loaded.scene.planes.size(), 1u);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(errorOf(SINEW_SOURCE_FOLDER "/scenes/drop_mesh.toml").find("is the mesh of the command line") ==
                  std::string::npos,
              false);
}

TEST_F(Load, TurnsScalesAndMovesAMesh) {
    mesh::exportObj(folder_ / "m.obj", tetrahedron(2));
    const scenes::LoadedScene loaded = load("[[mesh]]\nfile = \"m.obj\"\nsize = 0.5\ncenter = [1, 2, "
                                            "3]\nrotation = [0, 0, 90]\nresolution = 4\n");
    const mesh::MeshReport& surface = loaded.meshes[0].surface;
    EXPECT_NEAR(double{surface.low.x}, 0.75, 1e-6);
    EXPECT_NEAR(double{surface.high.y}, 2.25, 1e-6);
    EXPECT_NEAR(surface.volume, 0.125 / 6, 1e-8);
    EXPECT_EQ(loaded.meshes[0].voxels.cells[0], 4u);
}

TEST_F(Load, OffersADroppedMeshForCutting) {
    mesh::exportObj(folder_ / "closed.obj", mesh::generate("sphere", 12));
    const scenes::LoadedScene split = scenes::load(folder_ / "closed.obj");
    EXPECT_TRUE(split.scene.grids.at(0).isCuttable);
    EXPECT_EQ(split.warnings, std::vector<std::string>{});
}

TEST_F(Load, LeavesWholeWhatOnlyMayBeCutWithASolverThatCannot) {
    const std::string offered =
        "[[box]]\ncenter = [0, 1, 0]\nparticles = [3, 3, 3]\nspacing = 0.1\nyoung_modulus = 1e5\n"
        "cuttable = true\n";
    for (const char* solver : {"jacobi", "gauss_seidel"}) {
        const scenes::LoadedScene loaded = scenes::load(write("scene.toml", offered), {.solver = solver});
        EXPECT_FALSE(loaded.scene.grids.at(0).isCuttable);
        ASSERT_FALSE(loaded.warnings.empty());
        EXPECT_EQ(loaded.warnings[0],
                  std::string("nothing can be cut with solver ") + solver + ": use split");
    }
    EXPECT_TRUE(scenes::load(write("scene.toml", offered), {.solver = "split"}).scene.grids.at(0).isCuttable);

    const std::string blade = "[[blade]]\ntimes = [0.5, 0.7]\n"
                              "edges = [[[0, 1, -1], [0, 1, 1]], [[0, -1, -1], [0, -1, 1]]]\n";
    const auto refusal = [&](const std::string& text) {
        return errorOf(write("scene.toml", text), {.solver = "jacobi"});
    };
    const std::string refused = "may be cut, which solver jacobi does not support: use split";
    EXPECT_NE(refusal(offered + "tear = 0.5\n").find(refused), std::string::npos);
    EXPECT_NE(refusal(offered + blade).find(refused), std::string::npos);
    EXPECT_NE(errorOfText("[solver]\nname = \"jacobi\"\n" + offered).find(refused), std::string::npos)
        << "a file that asks for both is wrong";
}

TEST_F(Load, CountsTheEdgesOfAnOpenMesh) {
    mesh::TriangleMesh open = tetrahedron(1);
    open.triangles.pop_back();
    mesh::exportObj(folder_ / "open.obj", open);
    const scenes::LoadedScene loaded = scenes::load(folder_ / "open.obj");
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_EQ(loaded.warnings[0].find("mesh open.obj is open: 3 boundary edges"), 0u) << loaded.warnings[0];
}

TEST_F(Load, CountsNoMoreDoubtfulCellsThanItLookedAt) {
    mesh::TriangleMesh corner = tetrahedron(1);
    corner.triangles.resize(2);
    mesh::exportObj(folder_ / "corner.obj", corner);
    const scenes::LoadedScene loaded = scenes::load(folder_ / "corner.obj");
    const mesh::VoxelGrid& grid = loaded.meshes.at(0).voxels;
    ASSERT_GT(grid.doubtful, grid.hullCount + grid.coreCount) << "empty cells are doubtful too";
    const std::string count = std::to_string(grid.doubtful) + " of " + std::to_string(grid.voxels.size()) +
                              " cells of its grid are doubtful";
    EXPECT_EQ(std::ranges::count_if(loaded.warnings,
                                    [&](const std::string& text) { return text.find(count) != text.npos; }),
              1);
    EXPECT_LE(grid.doubtful, grid.voxels.size());
}

TEST_F(Load, CountsTheEdgesOfAMeshThatIsNotManifold) {
    mesh::TriangleMesh fin = tetrahedron(1);
    fin.positions.push_back({-1, -1, 0.5f});
    fin.triangles.push_back({0, 3, 4});
    mesh::exportObj(folder_ / "fin.obj", fin);
    const std::string scene = "[[mesh]]\nfile = \"fin.obj\"\nresolution = 24\n";
    EXPECT_EQ(count(load(scene).notes, "mesh fin.obj: 1 triangle was removed"), 1);
    const std::vector<std::string> warnings = load(scene + "repair = \"none\"\n").warnings;
    ASSERT_GE(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].find("mesh fin.obj is open: 2 boundary edges"), 0u) << warnings[0];
    EXPECT_EQ(warnings[1].find("mesh fin.obj is not manifold: 1 edge with"), 0u) << warnings[1];
}

TEST_F(Load, RepairsAMeshAndNotesIt) {
    mesh::TriangleMesh mesh = mesh::generate("sphere", 12);
    mesh.triangles.pop_back();
    mesh::exportObj(folder_ / "m.obj", mesh);
    const std::string note = "mesh m.obj: 1 hole was closed: 3 edges, 1 new triangle";
    const scenes::LoadedScene closed = load("[[mesh]]\nfile = \"m.obj\"\nresolution = 4\n");
    EXPECT_TRUE(closed.meshes[0].surface.defects.isClosed());
    EXPECT_EQ(closed.meshes[0].repairs.closedHoles, 1u);
    EXPECT_EQ(std::ranges::count(closed.notes, note), 1);
    EXPECT_EQ(count(closed.warnings, "is open"), 0);
    for (const std::string how : {"none", "weld"}) {
        const scenes::LoadedScene left =
            load("[[mesh]]\nfile = \"m.obj\"\nresolution = 4\nrepair = \"" + how + "\"\n");
        EXPECT_EQ(left.meshes[0].surface.defects.boundaryEdges, 3u) << how;
        EXPECT_EQ(count(left.notes, "closed"), 0);
        EXPECT_EQ(count(left.warnings,
                        "mesh m.obj is open: 3 boundary edges around 1 hole, the largest with 3 "
                        "edges and a rim of "),
                  1);
        EXPECT_EQ(count(left.warnings, "inside, and repair = \"close\" closes small holes"), 1);
    }
    const scenes::LoadedScene collider = load(smallCloth + "[[mesh_collider]]\nfile = \"m.obj\"\n");
    EXPECT_EQ(count(collider.notes, "mesh collider m.obj: 1 hole was closed"), 1);
    EXPECT_EQ(
        count(load(smallCloth + "[[mesh_collider]]\nfile = \"m.obj\"\nrepair = \"weld\"\n").notes, "closed"),
        0);
    expectError(
        "[[mesh]]\nfile = \"m.obj\"\nrepair = \"all\"\n",
        "scene.toml:3: mesh[0].repair is no repair: \"all\": possible are \"none\", \"weld\" and \"close\"");
}

TEST_F(Load, FitsAMeshIntoABudgetOfParticles) {
    const std::string sphere = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\n";
    const std::size_t particles = load(sphere + "particles = 700\n").scene.particles.size();
    EXPECT_LE(particles, 700u);
    EXPECT_GT(particles, 500u);
    const scenes::LoadedScene finer =
        scenes::load(write("scene.toml", sphere + "particles = 700\n"), {.voxel = 0.01f});
    EXPECT_EQ(finer.meshes[0].voxels.spacing, 0.01f) << "the command line decides";
}

TEST_F(Load, KeepsMeshFilesInTheFolderOfTheScene) {
    fs::create_directories(folder_ / "inner" / "deep");
    mesh::exportObj(folder_ / "out.obj", tetrahedron(1));
    mesh::exportObj(folder_ / "inner" / "deep" / "in.obj", tetrahedron(1));
    fs::create_symlink(folder_ / "out.obj", folder_ / "inner" / "link.obj");
    const auto error = [&](const std::string& name) {
        return errorOf(write("inner/scene.toml", "[[mesh]]\nfile = \"" + name + "\"\nresolution = 4\n"));
    };
    EXPECT_EQ(error("deep/in.obj"), "");
    EXPECT_EQ(error("deep/../deep/in.obj"), "");
    const std::string leaves =
        "inner/scene.toml:2: mesh[0].file leaves the scene's folder: put the mesh beside the scene";
    EXPECT_EQ(error("../out.obj"), leaves);
    EXPECT_EQ(error("deep/../../out.obj"), leaves);
    EXPECT_EQ(error((folder_ / "out.obj").string()), leaves);
    EXPECT_EQ(error("link.obj"), leaves);
    EXPECT_EQ(error("/etc/passwd"), leaves);
    EXPECT_EQ(error("none.obj"), "inner/scene.toml:2: mesh[0].file names no regular file: check the path");
    EXPECT_EQ(error("deep"), "inner/scene.toml:2: mesh[0].file names no regular file: check the path");
}

TEST_F(Load, GeneratesShapesByName) {
    const scenes::LoadedScene loaded =
        load("[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\nsize = 0.2\nresolution = 6\n");
    EXPECT_EQ(loaded.meshes[0].body, "sphere");
    EXPECT_GT(loaded.scene.particles.size(), 100u);
    expectError("[[mesh]]\ngenerate = \"spehre\"\n",
                "scene.toml:2: mesh[0].generate names no shape: \"spehre\": possible are ");
    expectError("[[mesh]]\n", "scene.toml:1: mesh[0].file is missing: give file or generate");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nvoxel = 0.1\nresolution = 3\n",
                "scene.toml:4: mesh[0].resolution is given beside voxel");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nvoxel = 0.1\nparticles = 300\n",
                "scene.toml:4: mesh[0].particles is given beside voxel");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nparticles = 300\nresolution = 3\n",
                "scene.toml:3: mesh[0].particles is given beside resolution");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nparticles = 7\n", "scene.toml:3: mesh[0].particles");
    expectError("[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 1e-4\n",
                "scene.toml:5: mesh[0].voxel is too small");
}

// A mesh in millimetres that is read as metres, with a voxel size in metres.
TEST_F(Load, NamesTheUnitWhereVoxelsAreTooSmallForIt) {
    mesh::exportObj(folder_ / "m.obj", tetrahedron(200));
    const std::string error = errorOfText("[[mesh]]\nfile = \"m.obj\"\nvoxel = 0.01\n");
    EXPECT_NE(error.find("scene.toml:3: mesh[0].voxel is too small for this mesh ("), std::string::npos)
        << error;
    EXPECT_NE(error.find("), which is 200 m long: if the file is in millimetres, say unit = \"mm\", or give "
                         "larger voxels"),
              std::string::npos)
        << error;
    EXPECT_EQ(errorOfText("[[mesh]]\nfile = \"m.obj\"\nvoxel = 0.01\nunit = \"mm\"\n"), "");
}

TEST_F(Load, ReadsAMeshInItsUnit) {
    mesh::exportObj(folder_ / "m.obj", tetrahedron(200));
    const std::string scene = tetrahedronScene;
    struct Unit {
        const char* keys;
        double metres;
    };
    for (const auto& [keys, metres] :
         {Unit{"", 1}, Unit{"unit = \"m\"\n", 1}, Unit{"unit = \"um\"\n", 1e-6},
          Unit{"unit = \"mm\"\n", 1e-3}, Unit{"unit = \"cm\"\n", 1e-2}, Unit{"unit = \"in\"\n", 0.0254},
          Unit{"unit = \"ft\"\n", 0.3048}, Unit{"scale = 0.005\n", 0.005},
          Unit{"unit = \"mm\"\nscale = 2.5\n", 2.5e-3}}) {
        SCOPED_TRACE(keys);
        const scenes::LoadedScene loaded = load(scene + keys);
        EXPECT_NEAR(width(loaded), 200 * metres, 2e-6 * 200 * metres);
        EXPECT_NEAR(double{loaded.meshes[0].surface.low.y}, 0, 1e-6 * 200 * metres) << "its origin stays";
        EXPECT_NEAR(double{loaded.scene.bodies[0].restVolume}, std::pow(200 * metres, 3) / 6,
                    1e-4 * std::pow(200 * metres, 3));
    }
    const scenes::LoadedScene centered = load(scene + "unit = \"mm\"\ncenter = [1, 2, 3]\n");
    EXPECT_NEAR(double{centered.meshes[0].surface.high.y}, 2.1, 1e-6);
    EXPECT_NEAR(width(centered), 0.2, 1e-6);
}

// Two organs in millimetres whose corners touch at (30, 40, 50) of their file.
TEST_F(Load, KeepsMeshesOfOneFileSystemTogether) {
    mesh::TriangleMesh first = tetrahedron(100), second = tetrahedron(60);
    for (sim::Vec3& x : first.positions) x = {30 + x.x, 40 + x.y, 50 + x.z};
    for (sim::Vec3& x : second.positions) x = {30 - x.x, 40 - x.y, 50 - x.z};
    mesh::exportObj(folder_ / "a.obj", first);
    mesh::exportObj(folder_ / "b.obj", second);
    const std::string where =
        "unit = \"mm\"\nresolution = 4\nrotation = [0, 0, 90]\ntranslation = [0.5, 0.25, -0.05]\n";
    const scenes::LoadedScene loaded =
        load("[[mesh]]\nfile = \"a.obj\"\n" + where + "[[mesh]]\nfile = \"b.obj\"\n" + where +
             "[[mesh_collider]]\nfile = \"b.obj\"\nunit = \"mm\"\nrotation = [0, 0, 90]\n"
             "translation = [0.5, 0.25, -0.05]\n");
    ASSERT_EQ(loaded.meshes.size(), 2u);
    const mesh::MeshReport &a = loaded.meshes[0].surface, &b = loaded.meshes[1].surface;
    // (x, y, z) becomes (-y, x, z), and is then translated.
    EXPECT_NEAR(double{a.high.x}, 0.5 - 0.04, 1e-6);
    EXPECT_NEAR(double{a.low.y}, 0.25 + 0.03, 1e-6);
    EXPECT_NEAR(double{a.low.z}, 0, 1e-6);
    EXPECT_NEAR(double{b.low.x}, 0.5 - 0.04, 1e-6);
    EXPECT_NEAR(double{b.high.y}, 0.25 + 0.03, 1e-6);
    EXPECT_NEAR(double{b.high.z}, 0, 1e-6);
    sim::Vec3 low{9, 9, 9};
    for (std::size_t i = loaded.scene.bodies[2].firstParticle; i < loaded.scene.particles.size(); ++i)
        low.x = std::min(low.x, loaded.scene.particles[i].position.x);
    EXPECT_NEAR(double{low.x}, double{b.low.x}, 1e-6) << "a collider goes to the same place";
}

TEST_F(Load, RefusesAMeshThatIsPlacedTwice) {
    mesh::exportObj(folder_ / "m.obj", tetrahedron(1));
    const std::string scene = tetrahedronScene;
    expectError(scene + "unit = \"parsec\"\n",
                "scene.toml:4: mesh[0].unit is no unit: \"parsec\": possible are um, mm, cm, m, in, ft");
    expectError(scene + "unit = 3\n",
                "scene.toml:4: mesh[0].unit is the whole number 3: write text in quotes");
    expectError(scene + "unit = \"mm\"\nsize = 1\n",
                "scene.toml:4: mesh[0].unit is given beside size: give size, or unit and scale");
    expectError(scene + "size = 1\nscale = 2\n",
                "scene.toml:5: mesh[0].scale is given beside size: give size, or unit and scale");
    expectError(scene + "center = [0, 0, 0]\ntranslation = [0, 0, 0]\n",
                "scene.toml:5: mesh[0].translation is given beside center: give one of them");
    for (const char* scale : {"0", "-1", "1e9"})
        expectError(scene + "scale = " + scale + "\n", "scene.toml:4: mesh[0].scale is ");
    expectError(
        "[[mesh]]\ngenerate = \"sphere\"\nunit = \"mm\"\n",
        "scene.toml:3: mesh[0].unit is given, but a generated shape has none: remove it, or give scale");
    EXPECT_NEAR(width(load("[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\nresolution = 4\nscale = 0.01\n")),
                0.01 * width(load("[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\nresolution = 4\n")), 1e-6);
    expectError(smallCloth + "[[mesh_collider]]\nfile = \"m.obj\"\nunit = \"miles\"\n",
                "scene.toml:6: mesh_collider[0].unit is no unit");
}

TEST_F(Load, NotesHowLargeAMeshIsAndWarnsOfAnotherUnit) {
    mesh::exportObj(folder_ / "m.obj", tetrahedron(190));
    const std::string scene = tetrahedronScene;
    const scenes::LoadedScene right = load(scene + "unit = \"mm\"\ndensity = 1000\n");
    EXPECT_EQ(right.warnings, std::vector<std::string>{});
    ASSERT_EQ(right.notes.size(), 1u);
    EXPECT_EQ(right.notes[0], "mesh m.obj: 0.19 x 0.19 x 0.19 m, 1.14 kg, 4 x 4 x 4 voxels of 48 mm");
    const auto warned = [&](const std::string& keys) { return load(scene + keys).warnings; };
    EXPECT_EQ(count(warned(""), "mesh m.obj is 190 m long: if the file is in millimetres, say unit = \"mm\""),
              1);
    EXPECT_EQ(count(warned("scale = 0.1\n"), "mesh m.obj is 19 m long: if"), 1);
    EXPECT_EQ(count(warned("unit = \"um\"\n"),
                    "mesh m.obj is 0.19 mm long: if the file is in millimetres, say unit = \"mm\""),
              1);
    EXPECT_EQ(count(warned("unit = \"mm\"\nscale = 1e-3\n"), "is 0.19 mm long: if the file is in metres"), 1);
    EXPECT_EQ(count(warned("scale = 1e-6\n"), "is 0.19 mm long: check its unit and scale"), 1);
    EXPECT_EQ(count(warned("size = 12\n"), "long"), 0) << "in metres, as the scene says";
    for (const char* keys : {"scale = 0.0526\n", "unit = \"mm\"\nscale = 0.00527\n"}) // 9.99 m, 1.001 mm
        EXPECT_EQ(count(warned(keys), "long"), 0) << keys;

    const scenes::LoadedScene wall = load(smallCloth + "[[mesh_collider]]\nfile = \"m.obj\"\n");
    EXPECT_EQ(count(wall.notes, "mesh collider m.obj: 190 x 190 x 190 m, 4 triangles"), 1);
    EXPECT_EQ(count(wall.warnings, "mesh collider m.obj is 190 m long: if the file is in millimetres"), 1);
}

namespace {

/// Lines of an OBJ file: `head`, then a cube of `size` with a corner at `low`, whose first vertex has index
/// `first`.
std::string objCube(const std::string& head, int first, sim::Vec3 low, float size) {
    std::string text = head;
    for (int corner = 0; corner < 8; ++corner)
        text += "v " + std::to_string(low.x + size * static_cast<float>(corner & 1)) + " " +
                std::to_string(low.y + size * static_cast<float>(corner >> 1 & 1)) + " " +
                std::to_string(low.z + size * static_cast<float>(corner >> 2)) + "\n";
    constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces) {
        text += "f";
        for (const int corner : face) text += " " + std::to_string(first + corner);
        text += "\n";
    }
    return text;
}

const std::string organs = objCube("o liver\n", 1, {0, 0, 0}, 1) +
                           objCube("o gall bladder\n", 9, {1.1f, 0, 0}, 0.5f) +
                           objCube("o vessels\n", 17, {0, 2, 0}, 0.25f) + objCube("", 25, {1, 2, 0}, 0.3f);

} // namespace

TEST_F(Load, NotesTheComponentsOfAMesh) {
    write("organs.obj", organs);
    const scenes::LoadedScene loaded = load("[[mesh]]\nfile = \"organs.obj\"\nvoxel = 0.025\n");
    EXPECT_EQ(loaded.warnings, std::vector<std::string>{}) << "they are four voxels apart";
    ASSERT_EQ(loaded.notes.size(), 6u);
    EXPECT_EQ(loaded.notes[1], "mesh organs.obj has 4 components");
    EXPECT_EQ(loaded.notes[2], "mesh organs.obj, \"liver\": 12 triangles, 1 m^3");
    EXPECT_EQ(loaded.notes[3], "mesh organs.obj, \"gall bladder\": 12 triangles, 0.125 m^3");
    EXPECT_EQ(loaded.notes[4], "mesh organs.obj, \"part 3\": 12 triangles, 0.027 m^3");
    std::string many;
    for (int i = 0; i < 14; ++i) many += objCube("", 8 * i + 1, {2.0f * static_cast<float>(i), 0, 0}, 1);
    write("many.obj", many);
    const std::vector<std::string> notes =
        load("[[mesh]]\nfile = \"many.obj\"\nsize = 1\nresolution = 60\n").notes;
    ASSERT_EQ(notes.size(), 13u);
    EXPECT_EQ(notes[12], "mesh many.obj, and 4 smaller components");
}

TEST_F(Load, ChoosesObjectsOfAMesh) {
    write("organs.obj", organs);
    const std::string scene = "[[mesh]]\nfile = \"organs.obj\"\nvoxel = 0.1\nobject = ";
    const auto volume = [&](const std::string& object) {
        return load(scene + object + "\n").meshes.at(0).surface.volume;
    };
    EXPECT_NEAR(volume("\"liver\""), 1, 1e-6);
    EXPECT_NEAR(volume("\"gall bladder\""), 0.125, 1e-6);
    EXPECT_NEAR(volume("[\"liver\", \"part 3\"]"), 1.027, 1e-6);
    EXPECT_NEAR(volume("\"vessels\""), 0.015625 + 0.027, 1e-6);
    const scenes::LoadedScene sized =
        load("[[mesh]]\nfile = \"organs.obj\"\nobject = \"gall bladder\"\nsize = 2\ncenter = [0, 0, 0]\n"
             "resolution = 4\n[[mesh_collider]]\nfile = \"organs.obj\"\nobject = \"part 4\"\n");
    EXPECT_NEAR(width(sized), 2, 1e-6) << "the size is that of what was chosen";
    EXPECT_EQ(sized.scene.bodies.at(1).particleCount, 8u);

    const std::string list =
        "\"liver\", \"gall bladder\", \"vessels\", \"part 1\", \"part 2\", \"part 3\", \"part 4\"";
    expectError(scene + "\"lievr\"\n",
                "scene.toml:4: mesh[0].object names \"lievr\", which no object of organs.obj "
                "is called: did you mean \"liver\"? There are " +
                    list);
    expectError(scene + "[\"liver\", \"part 5\"]\n",
                "scene.toml:4: mesh[0].object names \"part 5\", which no");
    expectError(scene + "[]\n", "scene.toml:4: mesh[0].object names none: name some, or leave the key out");
    expectError(
        scene + "3\n",
        "scene.toml:4: mesh[0].object is the whole number 3: write a name or a list of names in quotes");
    expectError(scene + "[\"liver\", 3]\n", "scene.toml:4: mesh[0].object is a list of 2: write a name or");
    expectError("[[mesh]]\ngenerate = \"sphere\"\nobject = \"part 1\"\n",
                "scene.toml:3: mesh[0].object is given, but a generated shape has none: remove it");
    expectError(smallCloth + "[[mesh_collider]]\nfile = \"organs.obj\"\nobject = \"x\"\n",
                "scene.toml:6: mesh_collider[0].object names \"x\"");
}

// Voxels of 0.2 m bridge a gap of 0.1 m, voxels of 0.025 m do not.
TEST_F(Load, SaysWhereVoxelsJoinWhatIsApart) {
    write("gap.obj", objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {1.1f, 0, 0}, 1));
    const std::string scene = "[[mesh]]\nfile = \"gap.obj\"\nvoxel = ";
    EXPECT_EQ(
        load(scene + "0.2\n").warnings,
        std::vector<std::string>{
            "mesh gap.obj has 2 components, 0.1 m apart at the nearest (\"part 1\" and \"part 2\"), that "
            "voxels of 0.2 m join: "
            "parts = \"apart\" keeps them apart, parts = \"joined\" says that it is meant"});
    EXPECT_EQ(load(scene + "0.025\n").warnings, std::vector<std::string>{});
    EXPECT_EQ(load(scene + "0.2\nparts = \"joined\"\n").warnings, std::vector<std::string>{});
    EXPECT_EQ(load(scene + "0.2\nparts = \"joined\"\n").scene.bodies.size(), 1u);

    const auto joined = [&](const std::string& text) {
        write("gap.obj", text);
        return count(load(scene + "0.2\n").warnings, "that voxels of");
    };
    EXPECT_EQ(joined(objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {0.5f, 0.1f, 0.1f}, 1)), 0)
        << "they overlap";
    EXPECT_EQ(joined(objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {0.25f, 0.25f, 0.25f}, 0.5f)), 0)
        << "one is inside of the other";
    EXPECT_EQ(joined(objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {1.1f, 1.1f, 1.1f}, 1)), 1)
        << "voxels that share a corner are joined";
    EXPECT_EQ(joined(objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {1.7f, 0, 0}, 1)), 0);
}

// No vertex of crossed bars lies inside the other bar, and their vertices are far apart.
TEST_F(Load, SaysThatCrossedBarsOverlapAndHowFarCoarseOnesAreApart) {
    const auto bars = [](const std::string& low, const std::string& high) {
        const std::string faces[] = {"f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n",
                                     "f 9 11 12 10\nf 13 14 16 15\nf 9 10 14 13\nf 11 15 16 12\n"
                                     "f 9 13 15 11\nf 10 12 16 14\n"};
        std::string text;
        for (const char* z : {" -0.05\n", " 0.05\n"})
            for (const char* y : {" -0.05", " 0.05"})
                for (const char* x : {"-0.5", "0.5"}) text += "v " + std::string(x) + y + z;
        for (const std::string& z : {low, high})
            for (const char* y : {" -0.5 ", " 0.5 "})
                for (const char* x : {"-0.05", "0.05"}) text += "v " + std::string(x) + y + z + "\n";
        return text + faces[0] + faces[1];
    };
    const std::string scene = "[[mesh]]\nfile = \"bars.obj\"\nvoxel = 0.04\n";
    write("bars.obj", bars("-0.04", "0.04"));
    const scenes::LoadedScene crossed = load(scene);
    EXPECT_EQ(count(crossed.warnings, "that voxels of"), 0);
    EXPECT_EQ(count(crossed.notes, "mesh bars.obj: \"part 1\" and \"part 2\" touch or overlap"), 1);
    write("bars.obj", bars("0.06", "0.16"));
    const scenes::LoadedScene apart = load(scene);
    EXPECT_EQ(count(apart.warnings, "10 mm apart at the nearest (\"part 1\" and \"part 2\")"), 1);
    EXPECT_EQ(count(apart.notes, "overlap"), 0);
}

TEST_F(Load, RefusesAMeshThatFloatsCannotHold) {
    write("cube.obj", objCube("", 1, {0, 0, 0}, 1));
    const std::string mesh = "[[mesh]]\nfile = \"cube.obj\"\n";
    expectError(
        "[[box]]\nspacing = 0.5\norigin = [0, 0, 0]\n" + mesh + "unit = \"um\"\ncenter = [0, 100, 0]\n",
        "scene.toml:6: mesh[0].unit makes the mesh 1e-06 m long, too small for float32 coordinates that "
        "are 100 m from 0: check unit and scale");
    expectError(mesh + "scale = 1e-12\n",
                "scene.toml:3: mesh[0].scale makes the mesh 1e-12 m long, and 1e-9 to 1e9 m are possible");
}

TEST_F(Load, SaysThatAMeshHasNoThickness) {
    for (const double thickness : {0.0, 1e-17}) {
        const std::string text = scenes::thinText(thickness, 1, 0.04, false);
        EXPECT_EQ(text,
                  "has no thickness at the thinnest 5 % of its surface: give it a wall in a mesh editor");
    }
}

TEST_F(Load, KeepsComponentsApart) {
    write("organs.obj", organs);
    const std::string scene = "[[mesh]]\nfile = \"organs.obj\"\nparts = \"apart\"\nresolution = 20\n";
    const scenes::LoadedScene loaded = load(scene + "velocity = [1, 0, 0]\n");
    EXPECT_EQ(loaded.warnings, std::vector<std::string>{});
    ASSERT_EQ(loaded.scene.bodies.size(), 4u);
    ASSERT_EQ(loaded.meshes.size(), 4u);
    const char* names[] = {"organs.liver", "organs.gall bladder", "organs.part 3", "organs.part 4"};
    const double volumes[] = {1, 0.125, 0.027, 0.015625};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(loaded.scene.bodies[i].name, names[i]);
        EXPECT_NEAR(double{loaded.scene.bodies[i].restVolume}, volumes[i], 1e-5);
        EXPECT_NEAR(double{loaded.meshes[i].voxels.spacing}, double{loaded.meshes[0].voxels.spacing}, 1e-7);
        EXPECT_EQ(loaded.scene.particles[loaded.scene.bodies[i].firstParticle].velocity.x, 1);
    }
    for (const sim::DistanceConstraint& link : loaded.scene.distances) {
        const auto bodyOf = [&](std::uint32_t particle) {
            return std::ranges::find_if(loaded.scene.bodies,
                                        [&](const sim::Body& body) {
                                            return particle < body.firstParticle + body.particleCount;
                                        }) -
                   loaded.scene.bodies.begin();
        };
        ASSERT_EQ(bodyOf(link.a), bodyOf(link.b));
    }
    EXPECT_NEAR(double{loaded.meshes[0].voxels.spacing},
                double{load("[[mesh]]\nfile = \"organs.obj\"\nresolution = 20\n").meshes[0].voxels.spacing},
                1e-7)
        << "as fine as the whole mesh would be";

    const std::string hold = "[[hold]]\nshape = \"sphere\"\nradius = 9\nbodies = [\"organs";
    EXPECT_EQ(load(scene + hold + "\"]\n").scene.fixed.size(), loaded.scene.particles.size());
    EXPECT_EQ(load(scene + hold + ".liver\"]\n").scene.fixed.size(), loaded.scene.bodies[0].particleCount);
    EXPECT_EQ(load(scene + "object = \"liver\"\n").scene.bodies.at(0).name, "organs")
        << "one alone is not apart";
    const scenes::LoadedScene chosen = load(scene + "object = [\"part 4\", \"part 2\", \"part 3\"]\n");
    ASSERT_EQ(chosen.scene.bodies.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(chosen.scene.bodies[i].name, names[i + 1]) << "a part keeps its number";
}

TEST_F(Load, KeepsACavityWithWhatIsAroundIt) {
    write("hollow.obj", objCube("", 1, {0, 0, 0}, 1) + objCube("", 9, {0.25f, 0.25f, 0.25f}, 0.5f));
    mesh::MeshDefects defects;
    mesh::TriangleMesh hollow = mesh::importMesh(folder_ / "hollow.obj", defects);
    for (std::size_t i = 12; i < 24; ++i) std::swap(hollow.triangles[i][1], hollow.triangles[i][2]);
    mesh::exportObj(folder_ / "hollow.obj", hollow);
    const scenes::LoadedScene loaded =
        load("[[mesh]]\nfile = \"hollow.obj\"\nparts = \"apart\"\nvoxel = 0.1\n");
    ASSERT_EQ(loaded.scene.bodies.size(), 1u);
    EXPECT_NEAR(double{loaded.scene.bodies[0].restVolume}, 1 - 0.125, 1e-4);
}

TEST_F(Load, RefusesPartsThatCannotBe) {
    write("organs.obj", organs);
    const std::string scene = "[[mesh]]\nfile = \"organs.obj\"\n";
    expectError(scene + "parts = \"alone\"\n",
                "scene.toml:3: mesh[0].parts is \"alone\": possible are joined, apart");
    expectError(
        scene + "parts = \"apart\"\nparticles = 900\n",
        "scene.toml:4: mesh[0].particles is given, but bodies apart have one size of voxels: give voxel or "
        "resolution");
    std::string many;
    for (int i = 0; i < 257; ++i) many += objCube("", 8 * i + 1, {2.0f * static_cast<float>(i), 0, 0}, 1);
    write("organs.obj", many);
    expectError(
        scene + "parts = \"apart\"\nsize = 1\n",
        "scene.toml:3: mesh[0].parts makes 257 bodies of the components of organs.obj, more than 256: choose "
        "some of them by object");
}

// A plate of 6 mm, 0.4 m long: 2 x 0.4 / 0.006 = 134 voxels give two across its thickness.
TEST_F(Load, WarnsOfAWallThinnerThanTwoVoxels) {
    write("plate.obj", "v -0.2 0 -0.2\nv 0.2 0 -0.2\nv 0.2 0 0.2\nv -0.2 0 0.2\n"
                       "v -0.2 0.006 -0.2\nv 0.2 0.006 -0.2\nv 0.2 0.006 0.2\nv -0.2 0.006 0.2\n"
                       "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    const std::string scene = "[[mesh]]\nfile = \"plate.obj\"\n";
    const auto warned = [&](const std::string& keys) { return load(scene + keys).warnings; };
    const std::string thin =
        "mesh plate.obj is 6 mm thin at the thinnest 5 % of its surface, less than 2 voxels of ";
    EXPECT_EQ(warned("resolution = 24\n"),
              std::vector<std::string>{thin + "16.7 mm: resolution = 134 gives two"});
    EXPECT_EQ(count(warned("rotation = [17, 0, 23]\n"), "resolution = 1"), 1) << "turned, too";
    EXPECT_EQ(count(warned("voxel = 0.02\n"), thin + "20 mm: voxel = 0.003 gives two"), 1);
    EXPECT_EQ(count(warned("particles = 2000\n"), "voxel = 0.003 gives two"), 1);
    EXPECT_EQ(count(warned("scale = 0.7\nvoxel = 0.02\n"), "voxel = 0.0021 gives two"), 1);
    EXPECT_EQ(warned("resolution = 134\n"), std::vector<std::string>{}) << "as it was told";
    EXPECT_EQ(warned("voxel = 0.003\n"), std::vector<std::string>{});

    write("foil.obj",
          "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 0.001 0\nv 1 0.001 0\nv 1 0.001 1\nv 0 0.001 1\n"
          "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    EXPECT_EQ(count(load("[[mesh]]\nfile = \"foil.obj\"\n").warnings,
                    "is 1 mm thin at the thinnest 5 % of its surface, less than 2 voxels of 41.7 mm: two "
                    "would be 2001 "
                    "along its longest side, more than the 512 that are possible"),
              1);
    for (const char* shape : {"organ", "sphere", "tube", "torus_knot", "slab_with_hole"})
        EXPECT_EQ(count(load("[[mesh]]\ngenerate = \"" + std::string(shape) + "\"\ndetail = 24\n").warnings,
                        "thin"),
                  0)
            << shape << " at the default resolution";
}

TEST_F(Load, SaysWhyAMeshDoesNotRecover) {
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n";
    const std::string reasons[][2] = {
        {"[solver]\nname = \"jacobi\"\n", "it needs solver split, the scene is solved by jacobi"},
        {"damping_time = 0.01\n", "it needs a scene without damping_time"},
        {smallCloth + "bending_stiffness = 1\n", "it needs a scene without bends"},
        {"[solver]\nomega = 3.7\ntheta = 0\n", "it needs solver.omega below 3.6, which is 3.7"},
        {"[solver]\nomega = 3.2\n", "it needs solver.omega below 3, which is 3.2"}};
    for (const auto& [before, why] : reasons) {
        const scenes::LoadedScene loaded = load(before + mesh);
        EXPECT_EQ(
            std::ranges::count(loaded.notes, "mesh sphere: no recovery, cells that fold may stay so: " + why),
            1)
            << before;
        EXPECT_TRUE(loaded.defaults.recovery.empty()) << before;
    }
}

TEST_F(Load, KnowsWhichMeshesRecoverByDefault) {
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n",
                      asks = mesh + "center = [5, 0, 0]\nrecovery = 2\n";
    using Grids = std::vector<std::uint32_t>;
    EXPECT_EQ(load(mesh).defaults.recovery, Grids{0});
    EXPECT_EQ(load(asks + mesh).defaults.recovery, Grids{1});
    EXPECT_EQ(load(smallCloth + mesh + asks).defaults.recovery, Grids{1});
    EXPECT_EQ(load(asks).defaults.recovery, Grids{});
}
