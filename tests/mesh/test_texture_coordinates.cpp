// Texture coordinates through import, repair and addMesh: kept at every corner, with seams in a closed
// surface.
#include "mesh/import.hpp"
#include "mesh/to_scene.hpp"
#include "mesh_files.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <sstream>

using namespace sinew;
using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

// Coordinates of a place on the face of a cube that is normal to an axis, on its low or high side: another
// island of the texture for each face.
sim::TexturePoint pointAt(const Vec3& x, std::size_t axis, bool isHigh) {
    const float along[3]{x.x, x.y, x.z};
    const float island = 2.0f * static_cast<float>(axis) + (isHigh ? 1 : 0);
    return {island + 0.25f * along[(axis + 1) % 3], 0.5f * along[(axis + 2) % 3] - island};
}

// A vertex of a cube of 1 m on one of its faces, and so in the texture.
struct Corner {
    Vec3 place;
    sim::TexturePoint at;
};

// Two triangles a face, with vertices of their own.
std::vector<Corner> cube() {
    std::vector<Corner> corners;
    for (std::size_t face = 0; face < 6; ++face) {
        const std::size_t axis = face / 2;
        const bool isHigh = face % 2 == 1;
        std::array<std::array<float, 2>, 6> places{{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};
        if (!isHigh) { // seen from outside
            std::swap(places[1], places[2]);
            std::swap(places[4], places[5]);
        }
        for (const auto& [right, up] : places) {
            float x[3]{};
            x[axis] = isHigh ? 1 : 0;
            x[(axis + 1) % 3] = right;
            x[(axis + 2) % 3] = up;
            const Vec3 place{x[0], x[1], x[2]};
            corners.push_back({place, pointAt(place, axis, isHigh)});
        }
    }
    return corners;
}

TriangleMesh meshOf(const std::vector<Corner>& corners) {
    TriangleMesh mesh{.name = "cube", .positions = {}, .triangles = {}};
    for (std::uint32_t i = 0; i < corners.size(); i += 3) {
        for (std::uint32_t n = 0; n < 3; ++n) mesh.positions.push_back(corners[i + n].place);
        mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.textureCoordinates.push_back({corners[i].at, corners[i + 1].at, corners[i + 2].at});
    }
    return mesh;
}

// Checks every corner of every triangle, on the face that the triangle lies in.
void expectTextured(const TriangleMesh& mesh, const std::string& what, float tolerance = 1e-6f) {
    ASSERT_EQ(mesh.textureCoordinates.size(), mesh.triangles.size()) << what;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Vec3, 3> x;
        for (std::size_t n = 0; n < 3; ++n) x[n] = mesh.positions[mesh.triangles[t][n]];
        const auto value = [&](std::size_t n, std::size_t axis) {
            return axis == 0 ? x[n].x : axis == 1 ? x[n].y : x[n].z;
        };
        std::size_t axis = 0;
        while (value(0, axis) != value(1, axis) || value(1, axis) != value(2, axis)) ++axis;
        for (std::size_t n = 0; n < 3; ++n) {
            const sim::TexturePoint expected = pointAt(x[n], axis, value(0, axis) > 0.5f);
            EXPECT_NEAR(mesh.textureCoordinates[t][n].u, expected.u, tolerance) << what << " " << t;
            EXPECT_NEAR(mesh.textureCoordinates[t][n].v, expected.v, tolerance) << what << " " << t;
        }
    }
}

// Texture coordinates in reverse order, so that their indices differ from those of vertices.
std::string objOf(const std::vector<Corner>& corners) {
    std::ostringstream text;
    for (const Corner& c : corners) text << "v " << c.place.x << ' ' << c.place.y << ' ' << c.place.z << '\n';
    for (auto c = corners.rbegin(); c != corners.rend(); ++c)
        text << "vt " << c->at.u << ' ' << c->at.v << " 0\n";
    text << "vn 0 0 1\n";
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; i += 3)
        text << "f " << i + 1 << '/' << count - i << "/1 " << i + 2 << '/' << count - i - 1 << "/1 " << i + 3
             << "/-" << i + 3 << "/1\n";
    return text.str();
}

std::string plyHead(const char* format, std::size_t count) {
    std::ostringstream text;
    text << "ply\nformat " << format << " 1.0\nelement vertex " << count
         << "\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float "
            "t\nelement face "
         << count / 3 << "\nproperty list uchar int vertex_indices\nend_header\n";
    return text.str();
}

std::string plyTextOf(const std::vector<Corner>& corners) {
    std::ostringstream text;
    text << plyHead("ascii", corners.size());
    for (const auto& [x, at] : corners)
        text << x.x << ' ' << x.y << ' ' << x.z << ' ' << at.u << ' ' << at.v << '\n';
    for (std::size_t i = 0; i < corners.size(); i += 3)
        text << "3 " << i << ' ' << i + 1 << ' ' << i + 2 << '\n';
    return text.str();
}

template <typename T> void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string plyBinaryOf(const std::vector<Corner>& corners) {
    std::string bytes = plyHead("binary_little_endian", corners.size());
    for (const auto& [x, at] : corners)
        for (const float value : {x.x, x.y, x.z, at.u, at.v}) append(bytes, value);
    for (std::int32_t i = 0; i < std::ssize(corners); i += 3) {
        bytes += '\3';
        for (const std::int32_t index : {i, i + 1, i + 2}) append(bytes, index);
    }
    return bytes;
}

// Coordinates of glTF grow downwards.
std::string glbOf(const std::vector<Corner>& corners, const char* type = "5126") {
    std::string body;
    for (const Corner& c : corners)
        for (const float value : {c.place.x, c.place.y, c.place.z}) append(body, value);
    for (const Corner& c : corners)
        for (const float value : {c.at.u, 1 - c.at.v}) append(body, value);
    const std::string count = std::to_string(corners.size()), places = std::to_string(12 * corners.size()),
                      points = std::to_string(8 * corners.size());
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)"
        R"("attributes":{"POSITION":0,"TEXCOORD_0":1}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
        count + R"(,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":)" +
        std::string(type) + R"(,"count":)" + count +
        R"(,"type":"VEC2"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + places +
        R"(},{"buffer":0,"byteOffset":)" + places + R"(,"byteLength":)" + points +
        R"(}],"buffers":[{"byteLength":)" + std::to_string(body.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(28 + json.size() + body.size()));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append(bytes, static_cast<std::uint32_t>(body.size()));
    bytes += std::string("BIN\0", 4) + body;
    return bytes;
}

TriangleMesh import(const Folder& folder, const std::string& name, const std::string& bytes,
                    MeshDefects& defects) {
    return importMesh(folder.write(name, bytes), defects);
}

} // namespace

// The importer takes whole numbers for the bits of floats.
TEST(TexturedFile, HasNoCoordinatesWhereTheyAreWholeNumbers) {
    const Folder folder;
    MeshDefects defects;
    EXPECT_FALSE(import(folder, "floats.glb", glbOf(cube()), defects).textureCoordinates.empty());
    EXPECT_TRUE(import(folder, "shorts.glb", glbOf(cube(), "5123"), defects).textureCoordinates.empty());
}

// One texel for all of an object, as of models that take their colors from a palette.
TEST(TexturedFile, KeepsCoordinatesThatAreAllAlike) {
    const Folder folder;
    std::vector<Corner> corners = cube();
    for (Corner& corner : corners) corner.at = {0.25f, 0.75f};
    MeshDefects defects;
    for (const auto& [name, bytes] :
         {std::pair{"cube.obj", objOf(corners)}, std::pair{"cube.glb", glbOf(corners)}})
        for (const sim::TextureCorners& triangle : import(folder, name, bytes, defects).textureCoordinates)
            for (const sim::TexturePoint& at : triangle) {
                EXPECT_NEAR(at.u, 0.25f, 1e-6) << name;
                EXPECT_NEAR(at.v, 0.75f, 1e-6) << name;
            }
    EXPECT_FALSE(import(folder, "cube.obj", objOf(corners), defects).textureCoordinates.empty());
}

TEST(TexturedFile, KeepsTheCoordinatesOfEachCornerAndIsClosedAtSeams) {
    const Folder folder;
    const std::vector<Corner> corners = cube();
    const std::vector<std::pair<std::string, std::string>> files{{"cube.obj", objOf(corners)},
                                                                 {"text.ply", plyTextOf(corners)},
                                                                 {"binary.ply", plyBinaryOf(corners)},
                                                                 {"cube.glb", glbOf(corners)}};
    for (const auto& [name, bytes] : files) {
        MeshDefects defects;
        const TriangleMesh mesh = import(folder, name, bytes, defects);
        EXPECT_EQ(mesh.positions.size(), 8u) << name;
        EXPECT_EQ(mesh.triangles.size(), 12u) << name;
        EXPECT_TRUE(defects.isClosed()) << name;
        expectTextured(mesh, name);
    }
}

TEST(TexturedFile, IsReadWithoutCoordinatesThatAreInvalid) {
    const Folder folder;
    const std::string sound = objOf(cube());
    std::string beyond = sound, word = sound, some = sound;
    beyond.replace(beyond.rfind("/-"), 2, "/9");
    word.replace(word.find("vt "), 3, "vt x");
    some.replace(some.rfind('f'), std::string::npos, "f 34 35 36\n"); // (0, 0) there, and no complaint
    for (const std::string& bytes : {beyond, word}) {
        MeshDefects defects;
        const TriangleMesh mesh = import(folder, "faulty.obj", bytes, defects);
        EXPECT_EQ(mesh.triangles.size(), 12u);
        EXPECT_TRUE(mesh.textureCoordinates.empty());
    }
    MeshDefects defects;
    const TriangleMesh mesh = import(folder, "some.obj", some, defects);
    ASSERT_EQ(mesh.textureCoordinates.size(), 12u);
    EXPECT_EQ(mesh.textureCoordinates.back()[1], sim::TexturePoint{});
    EXPECT_EQ(mesh.textureCoordinates.front()[0].u, cube().front().at.u);
}

TEST(TexturedMesh, StaysTexturedWhenItIsTurnedSplitAndSelected) {
    TriangleMesh mesh = meshOf(cube());
    for (std::size_t t = 0; t < 6; ++t) flip(mesh, t);
    expectTextured(mesh, "flipped");
    MeshDefects defects;
    mesh = orient(weld(mesh, defects));
    expectTextured(mesh, "oriented");
    EXPECT_NEAR(measure(mesh).volume, 1, 1e-6);
    std::vector<bool> isKept(12, true);
    isKept[3] = isKept[7] = false;
    const TriangleMesh some = keep(mesh, isKept);
    EXPECT_EQ(some.triangles.size(), 10u);
    expectTextured(some, "selected");
}

TEST(TexturedMesh, HasLinearCoordinatesAtTJunctions) {
    std::vector<Corner> corners = cube(); // one triangle of a face becomes two, beside an edge that is whole
    const Corner a = corners[30], b = corners[31], c = corners[32];
    Corner middle{{(a.place.x + b.place.x) / 2, (a.place.y + b.place.y) / 2, (a.place.z + b.place.z) / 2},
                  {(a.at.u + b.at.u) / 2, (a.at.v + b.at.v) / 2}};
    corners[31] = middle;
    corners.insert(corners.end(), {middle, b, c});
    MeshDefects defects;
    Repairs repairs;
    TriangleMesh mesh = weld(meshOf(corners), defects);
    EXPECT_FALSE(defects.isClosed());
    mesh = repair(std::move(mesh), Repair::close, defects, repairs);
    EXPECT_EQ(repairs.splitEdges, 1u);
    EXPECT_TRUE(defects.isClosed());
    EXPECT_EQ(mesh.triangles.size(), 14u);
    expectTextured(mesh, "split");
}

TEST(TexturedMesh, HasCoordinatesWhereAHoleIsClosed) {
    std::vector<Corner> corners = cube();
    corners.resize(corners.size() - 3);
    MeshDefects defects;
    Repairs repairs;
    TriangleMesh mesh = repair(weld(meshOf(corners), defects), Repair::close, defects, repairs);
    EXPECT_EQ(repairs.closedHoles, 1u);
    ASSERT_EQ(mesh.textureCoordinates.size(), 12u);
    for (const sim::TexturePoint& at : mesh.textureCoordinates.back()) {
        const auto isSame = [&](const Corner& corner) { return corner.at == at; };
        EXPECT_TRUE(std::ranges::any_of(corners, isSame)) << at.u << " " << at.v;
    }
}

TEST(TexturedMesh, GivesItsCoordinatesToASkinWholeOrSplit) {
    for (const bool isCuttable : {false, true}) {
        sim::Scene scene;
        MeshBody body{.isCuttable = isCuttable};
        body.voxels.resolution = 5;
        addMesh(scene, meshOf(cube()), body);
        const sim::Skin& skin = scene.skins.at(0);
        EXPECT_EQ(skin.textureCoordinates.size(), skin.triangles.size());
        EXPECT_EQ(skin.wholeTextureCoordinates.size(), isCuttable ? 12u : 0u);
        EXPECT_EQ(skin.textureCoordinates.size() > 12, isCuttable);
    }
}
