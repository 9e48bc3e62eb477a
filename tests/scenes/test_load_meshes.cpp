// Meshes in scenes: where they may come from, how they are placed, what is said about them.
#include "mesh/generate.hpp"
#include "scenes/load_fixture.hpp"

using namespace sinew;
namespace fs = std::filesystem;
using test::smallCloth;
using test::tetrahedron;

namespace {

class Load : public test::LoadFixture {};

} // namespace

TEST_F(Load, DropsTheMeshOfTheCommandLine) {
    mesh::exportObj(folder_ / "tetrahedron.obj", tetrahedron(7)); // millimetres, metres: the scene scales it
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
    const std::string refused = "may be cut, which solver jacobi has no form for: use split";
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
    const std::vector<std::string> warnings = scenes::load(folder_ / "fin.obj").warnings;
    ASSERT_GE(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].find("mesh fin.obj is open: 2 boundary edges"), 0u) << warnings[0];
    EXPECT_EQ(warnings[1].find("mesh fin.obj is not manifold: 1 edges"), 0u) << warnings[1];
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
