// Scenes of the C interface: arrays, bodies, files, and what is refused.
#include "capi/support.hpp"
#include "sinew/sinew_motions.h"

#include <cmath>
#include <fstream>
#include <string>

#include <unistd.h>

namespace sinew::test {
namespace {

// In a folder that other tests use at the same time.
std::string scratchFile(const char* name) {
    return ::testing::TempDir() + "sinew_capi_" + std::to_string(::getpid()) + "_" + name;
}

SinewSceneCounts countsOf(SinewScene scene) {
    SinewSceneCounts counts{};
    counts.size = sizeof counts;
    EXPECT_TRUE(isOk(sinewGetSceneCounts(scene, &counts)));
    return counts;
}

TEST(CApiScene, KeepsArraysAsTheyWereGiven) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    std::vector<SinewParticle> particles(3);
    for (std::uint32_t i = 0; i < 3; ++i)
        particles[i] = {.position = {0.1f * static_cast<float>(i), 1, 0}, .inverseMass = 2, .radius = 0.01f};
    const SinewLink links[] = {{0, 1, 0.1f, 1e-4f}, {1, 2, 0.1f, 1e-4f}};
    const SinewBend bend{0, 1, 2, 1e-3f};
    const SinewTether tether{2, 0, 0.2f};
    const std::uint32_t fixed = 0;
    const SinewAttachment attachment{.particle = 1, .anchor = {0.1f, 1, 0}, .compliance = 1e-3f};
    const SinewFace face{.particles = {0, 1, 2}, .thickness = 0.01f};
    std::uint32_t first = 9, body = 9;
    ASSERT_TRUE(isOk(sinewAddParticles(scene, 3, particles.data(), &first)));
    EXPECT_EQ(first, 0u);
    EXPECT_TRUE(isOk(sinewAddLinks(scene, 2, links)));
    EXPECT_TRUE(isOk(sinewAddBends(scene, 1, &bend)));
    EXPECT_TRUE(isOk(sinewAddTethers(scene, 1, &tether)));
    EXPECT_TRUE(isOk(sinewAddFixed(scene, 1, &fixed)));
    EXPECT_TRUE(isOk(sinewAddAttachments(scene, 1, &attachment, &first)));
    EXPECT_TRUE(isOk(sinewAddFaces(scene, 1, &face)));
    EXPECT_TRUE(isOk(sinewAddBody(scene, "row", 0, 3, &body)));
    EXPECT_EQ(body, 0u);
    const SinewKeyframe path[] = {{0, {{0, 0, 0}, {0, 0, 0, 1}}}, {1, {{1, 0, 0}, {0, 0, 0, 1}}}};
    SinewCollider collider = sinewDefaultCollider();
    collider.radius = 0.1f;
    collider.keyframes = path;
    collider.keyframeCount = 2;
    EXPECT_TRUE(isOk(sinewAddCollider(scene, &collider)));
    SinewSettings settings = sinewDefaultSettings();
    EXPECT_TRUE(isOk(sinewValidate(scene, &settings)));

    const SinewSceneCounts counts = countsOf(scene);
    EXPECT_EQ(counts.particles, 3u);
    EXPECT_EQ(counts.links, 2u);
    EXPECT_EQ(counts.bends + counts.tethers + counts.fixed + counts.attachments + counts.faces, 5u);
    EXPECT_EQ(counts.colliders + counts.bodies, 2u);
    std::vector<SinewParticle> read(2);
    ASSERT_TRUE(isOk(sinewGetParticles(scene, 1, 2, read.data())));
    EXPECT_EQ(read[1].position.x, 0.2f);
    EXPECT_EQ(read[1].inverseMass, 2);
    EXPECT_EQ(read[1].radius, 0.01f);
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "there are 3", sinewGetParticles(scene, 2, 2, read.data())));
    SinewBody row{};
    row.size = sizeof row;
    ASSERT_TRUE(isOk(sinewGetBody(scene, 0, &row)));
    EXPECT_STREQ(row.name, "row");
    EXPECT_EQ(row.particleCount, 3u);
    EXPECT_EQ(sinewGetBody(scene, 1, &row), SINEW_END);
}

TEST(CApiScene, ComplaintsAreSentencesOnTheScene) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    const SinewParticle particle{.position = {0, NAN, 0}, .inverseMass = 1};
    const SinewLink link{0, 7, 0.1f, 0};
    ASSERT_TRUE(isOk(sinewAddParticles(scene, 1, &particle, nullptr)));
    ASSERT_TRUE(isOk(sinewAddLinks(scene, 1, &link)));
    SinewSettings settings = sinewDefaultSettings();
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "must be finite", sinewValidate(scene, &settings)));
    EXPECT_NE(std::string(sinewLastError()).find("distance[0]"), std::string::npos) << sinewLastError();
    settings.solver = 3;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "solver 3", sinewValidate(scene, &settings)));
}

TEST(CApiScene, RefusesWrongBodiesAndStaysAsItWas) {
    Scene scene;
    makeCube(scene);
    const SinewSceneCounts before = countsOf(scene);
    SinewLattice lattice = sinewDefaultLattice();
    const float fill[] = {1, 1};
    lattice.fill = fill;
    lattice.fillCount = 2;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "fillCount is 2", sinewAddLattice(scene, &lattice, nullptr)));
    lattice = sinewDefaultLattice();
    lattice.cells[0] = lattice.cells[1] = lattice.cells[2] = 0xffffffff;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "nodes", sinewAddLattice(scene, &lattice, nullptr)));
    lattice = sinewDefaultLattice();
    lattice.poissonRatio = 0.6f;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "", sinewAddLattice(scene, &lattice, nullptr)));
    lattice = sinewDefaultLattice();
    lattice.origin.x = 1e6f; // positions are rounded too coarsely for a grid
    lattice.isCuttable = 1;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "", sinewAddLattice(scene, &lattice, nullptr)));
    lattice = sinewDefaultLattice();
    lattice.hasFaces = 1;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "radius", sinewAddLattice(scene, &lattice, nullptr)));
    SinewCloth cloth = sinewDefaultCloth();
    cloth.columns = 1;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "2 columns", sinewAddCloth(scene, &cloth, nullptr)));
    cloth = sinewDefaultCloth();
    const std::uint32_t pinned = 64 * 64;
    cloth.pinned = &pinned;
    cloth.pinnedCount = 1;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "pinned[0]", sinewAddCloth(scene, &cloth, nullptr)));
    const SinewVec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::uint32_t triangle[] = {0, 1, 3};
    SinewMesh mesh = sinewDefaultMesh();
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "no triangle", sinewAddMesh(scene, &mesh, nullptr)));
    mesh.vertices = corners;
    mesh.vertexCount = 3;
    mesh.triangles = triangle;
    mesh.triangleCount = 1;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "names vertex 3", sinewAddMesh(scene, &mesh, nullptr)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "links is null", sinewAddLinks(scene, 2, nullptr)));
    SinewCollider collider = sinewDefaultCollider();
    collider.shape = 3;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "shape 3", sinewAddCollider(scene, &collider)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "body 5",
                          sinewSetMotion(scene, 5, {0, 0, 0}, {0, 0, 0}, {0, 0, 0, 1})));

    const SinewSceneCounts after = countsOf(scene);
    EXPECT_EQ(after.particles, before.particles);
    EXPECT_EQ(after.links, before.links);
    EXPECT_EQ(after.bodies, before.bodies);
    EXPECT_EQ(after.grids, before.grids);
    const SinewSettings settings = sinewDefaultSettings();
    EXPECT_TRUE(isOk(sinewValidate(scene, &settings)));
}

TEST(CApiScene, MakesAVoxelBodyOfAMesh) {
    const SinewVec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; // of a tetrahedron
    const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    SinewMesh mesh = sinewDefaultMesh();
    mesh.vertices = corners;
    mesh.vertexCount = 4;
    mesh.triangles = triangles;
    mesh.triangleCount = 4;
    mesh.resolution = 8;
    mesh.name = "a name of more than sixty-four bytes, which is cut short in the description";
    std::uint32_t index = 9;
    ASSERT_TRUE(isOk(sinewAddMesh(scene, &mesh, &index)));
    SinewBody body{};
    body.size = sizeof body;
    ASSERT_TRUE(isOk(sinewGetBody(scene, index, &body)));
    EXPECT_GT(body.particleCount, 100u);
    EXPECT_NEAR(body.restVolume, 1.0f / 6, 1e-3f);
    EXPECT_EQ(std::string(body.name), std::string(mesh.name).substr(0, 63));
    EXPECT_EQ(countsOf(scene).skins, 1u);
}

TEST(CApiScene, LetsABodyBeAbsent) {
    Scene scene;
    makeCube(scene);
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "body 5 is asked for", sinewSetAbsent(scene, 5, 1)));
    EXPECT_TRUE(isOk(sinewSetAbsent(scene, 0, 1)));
}

TEST(CApiScene, SetsTheMotionOfOneBody) {
    Scene scene;
    makeCube(scene);
    SinewLattice lattice = sinewDefaultLattice();
    std::uint32_t second = 0;
    ASSERT_TRUE(isOk(sinewAddLattice(scene, &lattice, &second)));
    ASSERT_EQ(second, 1u);
    ASSERT_TRUE(isOk(sinewSetMotion(scene, second, {1, 2, 3}, {0, 0, 0}, {0, 0, 0, 1})));
    std::vector<SinewParticle> particles(27 + 8);
    ASSERT_TRUE(isOk(sinewGetParticles(scene, 0, 27 + 8, particles.data())));
    EXPECT_EQ(particles[26].velocity.y, 0);
    EXPECT_EQ(particles[27].velocity.y, 2);
    EXPECT_EQ(particles[34].velocity.z, 3);
}

TEST(CApiScene, DescribesAStep) {
    Scene scene;
    makeCube(scene);
    SinewSettings settings = sinewDefaultSettings();
    std::size_t size = 0;
    ASSERT_TRUE(isOk(sinewDescribe(scene, &settings, &size, nullptr)));
    std::string text(size, 'x');
    ASSERT_TRUE(isOk(sinewDescribe(scene, &settings, &size, text.data())));
    EXPECT_EQ(text.find('\0'), size - 1);
    EXPECT_NE(text.find("gather_lattice"), std::string::npos) << text;
    settings.levels = SINEW_AUTO_LEVELS; // none for a body so small
    std::string again(size, 'x');
    ASSERT_TRUE(isOk(sinewDescribe(scene, &settings, &size, again.data())));
    EXPECT_EQ(again, text);
    settings.levels = 7;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_SCENE, "levels", sinewDescribe(scene, &settings, &size, nullptr)));
    settings = sinewDefaultSettings();
    settings.substeps = 2000;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_SCENE, "substeps", sinewDescribe(scene, &settings, &size, nullptr)));
}

TEST(CApiFiles, ScenesAndMeshesAreRead) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewLoadScene(SINEW_SOURCE_FOLDER "/scenes/cube.toml", &scene)));
    EXPECT_GT(countsOf(scene).particles, 100u);
    SinewSettings settings{};
    settings.size = sizeof settings;
    ASSERT_TRUE(isOk(sinewGetSceneSettings(scene, &settings)));
    EXPECT_GT(settings.substeps, 0u); // the number that the scene needs
    EXPECT_TRUE(isOk(sinewValidate(scene, &settings)));

    const std::string file = scratchFile("tetrahedron.obj");
    std::ofstream(file)
        << "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    SinewMesh mesh = sinewDefaultMesh();
    mesh.resolution = 8;
    std::uint32_t body = 0;
    ASSERT_TRUE(isOk(sinewAddMeshFile(scene, file.c_str(), 1e-3f, &mesh, &body)));
    SinewBody added{};
    added.size = sizeof added;
    ASSERT_TRUE(isOk(sinewGetBody(scene, body, &added)));
    EXPECT_NEAR(added.restVolume, 1.0f / 6, 1e-3f);
    std::remove(file.c_str());
}

TEST(CApiFiles, FaultsHaveTheirLine) {
    SinewScene scene{};
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_FILE, "no such file.toml", sinewLoadScene("no such file.toml", &scene)));
    const std::string file = scratchFile("fault.toml");
    std::ofstream(file) << "name = \"fault\"\n[[box]]\nspacign = 1\n";
    EXPECT_TRUE(failsWith(SINEW_ERROR_FILE, ":3", sinewLoadScene(file.c_str(), &scene)));
    std::remove(file.c_str());
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "path is null", sinewLoadScene(nullptr, &scene)));
    EXPECT_EQ(scene.id, 0u);
}

} // namespace
} // namespace sinew::test
