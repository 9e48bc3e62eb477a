// Tests of mesh import: every format is read back as written, and a faulty file gives a one-line error.
#include "mesh/import.hpp"

#include "mesh/export.hpp"
#include "mesh/generate.hpp"
#include "mesh_files.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fcntl.h>
#include <map>
#include <set>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace fs = std::filesystem;

namespace {

TriangleMesh import(const fs::path& file, const ImportLimits& limits = {}) {
    MeshDefects defects;
    return importMesh(file, defects, limits);
}

/// Text of the ImportError without "cannot read mesh: <folder>/".
std::string complaint(const fs::path& file, const ImportLimits& limits = {}) {
    try {
        import(file, limits);
    } catch (const ImportError& error) {
        const std::string head = "cannot read mesh: " + file.parent_path().string() + "/",
                          text = error.what();
        return text.starts_with(head) ? text.substr(head.size()) : text;
    }
    return "no error";
}

void expectSame(const TriangleMesh& read, const TriangleMesh& mesh, const std::string& what) {
    const MeshReport a = inspect(read), b = inspect(mesh);
    EXPECT_EQ(read.positions.size(), mesh.positions.size()) << what;
    EXPECT_EQ(read.triangles.size(), mesh.triangles.size()) << what;
    EXPECT_EQ(a.defects.boundaryEdges, b.defects.boundaryEdges) << what;
    EXPECT_NEAR(a.volume, b.volume, 1e-6 * std::abs(b.volume)) << what;
    EXPECT_NEAR(a.area, b.area, 1e-6 * b.area) << what;
    EXPECT_LT((toVector(a.low) - toVector(b.low)).norm() + (toVector(a.high) - toVector(b.high)).norm(),
              1e-6 * (toVector(b.high) - toVector(b.low)).norm())
        << what;
}

/// A named pipe with some bytes in it. A reader of the pipe would leave fewer bytes.
class Canary {
public:
    explicit Canary(const fs::path& path) {
        mkfifo(path.c_str(), 0600);
        descriptor_ = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (write(descriptor_, "newmtl red\n", 11) != 11) throw std::runtime_error("no canary");
    }
    Canary(const Canary&) = delete;
    Canary& operator=(const Canary&) = delete;
    ~Canary() { close(descriptor_); }
    bool isUnread() const {
        int left = 0;
        return ioctl(descriptor_, FIONREAD, &left) == 0 && left == 11;
    }

private:
    int descriptor_ = -1;
};

/// Exists only where Debian's assimp-testmodels is installed.
const fs::path models = "/usr/share/assimp/models";

} // namespace

TEST(Import, ReadsEveryFormat) {
    const Folder folder;
    const TriangleMesh organ = generate("organ", 14);
    for (const Sample& sample : samplesOf(organ))
        expectSame(import(folder.write(sample.name, sample.bytes)), organ, sample.name);
}

TEST(Import, ReadsNumbersAsCDoes) {
    const Folder folder;
    for (const std::string number :
         {"-.5", ".5", "+.5", "5.e-1", "-5.E-1", "-.5e0", "+0.5", "-50e-2", "1e-7"}) {
        SCOPED_TRACE(number);
        const float value = std::strtof(number.c_str(), nullptr);
        const std::string x = number + " " + number + " " + number + "\n";
        const auto expectValue = [&](const std::string& name, const std::string& bytes) {
            const TriangleMesh mesh = import(folder.write(name, bytes));
            ASSERT_EQ(mesh.positions.size(), 4u) << name;
            EXPECT_EQ(std::ranges::count_if(
                          mesh.positions, [&](const auto& one) { return one.x == value && one.z == value; }),
                      1)
                << name;
        };
        expectValue("a.obj", "v " + x + "v 3 0 0\nv 0 3 0\nv 0 0 3\nf 1 2 3\nf 2 3 4\n");
        expectValue("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                             "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                             "end_header\n" +
                                 x + "3 0 0\n0 3 0\n0 0 3\n3 0 1 2\n3 1 2 3\n");
        const std::string rest = "vertex 3 0 0\nvertex 0 3 0\n";
        expectValue("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex " + x + rest +
                                 "endloop\nendfacet\nfacet normal 0 0 0\nouter loop\nvertex 0 0 3\n" + rest +
                                 "endloop\nendfacet\nendsolid a\n");
    }
}

TEST(Import, ReadsATextStlThatEndsInTwoWords) {
    const Folder folder;
    const TriangleMesh organ = generate("organ", 8);
    std::string text = stlText(organ);
    const std::size_t end = text.rfind("endsolid");
    ASSERT_NE(end, text.npos);
    text.replace(end, 8, "end solid");
    expectSame(import(folder.write("a.stl", text)), organ, "end solid");
    text.resize(text.rfind("end solid")); // the file must still be told from a truncated one
    EXPECT_NE(complaint(folder.write("a.stl", text)).find("ends too early"), std::string::npos);
}

// A tetrahedron as one strip around all of it, as a strip with a bridge of zero area, and as two strips of a
// list.
TEST(Import, ReadsTriangleStrips) {
    const Folder folder;
    const auto strips = [](const std::string& list) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n0 1 0\n0 0 1\n" +
               list + "\n";
    };
    for (const std::string list : {"6 0 1 2 3 0 1", "7 0 1 2 3 3 1 0", "9 0 1 2 3 -1 2 3 0 1"}) {
        SCOPED_TRACE(list);
        const MeshReport report = inspect(import(folder.write("a.ply", strips(list))));
        EXPECT_EQ(report.defects.nonManifoldEdges, 0u);
        if (list[0] == '7') continue; // this list leaves one face open
        EXPECT_EQ(report.defects.boundaryEdges, 0u);
        EXPECT_NEAR(std::abs(report.volume), 1.0 / 6, 1e-6) << "all faces are turned the same way";
    }
    EXPECT_EQ(import(folder.write("a.ply", strips("6 0 1 2 3 0 1"))).triangles.size(), 4u);
    EXPECT_NE(complaint(folder.write("a.ply", strips("4 0 1 2 4"))).find("does not exist"),
              std::string::npos);
    EXPECT_NE(complaint(folder.write("a.ply", strips("4 0 1 2 -2"))).find("does not exist"),
              std::string::npos);
    EXPECT_NE(complaint(folder.write("a.ply", strips("2 0 1"))).find("no faces"), std::string::npos);
}

TEST(Import, ReadsWhatWasExported) {
    const Folder folder;
    const TriangleMesh knot = generate("torus_knot", 12);
    exportObj(folder / "knot.obj", knot);
    exportPly(folder / "knot.ply", knot);
    expectSame(import(folder / "knot.obj"), knot, "obj");
    expectSame(import(folder / "knot.ply"), knot, "ply");
    EXPECT_EQ(import(folder / "knot.ply").name, "knot");
}

TEST(Import, GoesByContentNotByName) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
    for (const Sample& sample : samplesOf(mesh))
        for (const std::string_view name :
             {"wrong.obj", "wrong.stl", "wrong.ply", "wrong.glb", "wrong.3ds", "wrong"})
            expectSame(import(folder.write(name, sample.bytes)), mesh,
                       sample.name + " as " + std::string(name));
}

TEST(Import, KeepsTinyAndHugeMeshesWhole) {
    const Folder folder;
    for (const float scale : {1e-7f, 1e-5f, 1e-3f, 1e3f, 1e9f})
        for (const Sample& sample : samplesOf(scaled(generate("sphere", 16), scale)))
            expectSame(import(folder.write(sample.name, sample.bytes)), scaled(generate("sphere", 16), scale),
                       sample.name + " scaled by " + std::to_string(scale));
}

TEST(Import, AppliesNodeTransforms) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
    // The parent moves and turns x to y. The first child mirrors and doubles; the second has no transform.
    const std::string_view nodes = R"([{"children":[1,2],"translation":[10,0,0],
        "rotation":[0,0,0.70710678118654757,0.70710678118654757]},
        {"mesh":0,"scale":[-2,2,2]},{"mesh":0,"translation":[5,0,0]}])";
    for (const std::string& bytes : {glb(mesh, nodes), gltf(mesh, nodes)}) {
        const MeshReport report = inspect(import(folder.write("nodes", bytes)));
        EXPECT_NEAR(report.volume, 48 + 6, 1e-3) << "the mirrored part must not be inside out";
        EXPECT_NEAR(report.low.x, 6, 1e-4);
        EXPECT_NEAR(report.high.x, 10, 1e-4);
        EXPECT_NEAR(report.low.y, -2, 1e-4);
        EXPECT_NEAR(report.high.y, 6, 1e-4);
    }
}

TEST(Import, ReadsObjAsPeopleWriteIt) {
    const Folder folder;
    const std::string text = "\xef\xbb\xbf# written by hand\r\n"
                             "v 0 0 0\r\nv +1.0 0 0 0.5 0.5 0.5\r\nv 1 \\\r\n 1 0\r\nv 0 1 0\r\n"
                             "vt 0 0\r\nvn 0 0 1\r\nl 1 2\r\np 1\r\n\r\n"
                             "g a\r\nusemtl none\r\nf 1/1/1 2/1/1 3/1/1 4/1/1\r\nf -4//1 -3//1 \\\r\n -2//1";
    MeshDefects defects;
    const TriangleMesh mesh = importMesh(folder.write("a.obj", text), defects);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_NEAR(inspect(mesh).area, 1, 1e-6);
    EXPECT_EQ(defects.duplicateTriangles, 1u);
    EXPECT_EQ(defects.boundaryEdges, 4u);
}

TEST(Import, SkipsAByteOrderMark) {
    const Folder folder;
    const std::string mark = "\xef\xbb\xbf", triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(import(folder.write("a.obj", mark + triangle)).positions.size(), 3u);
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    expectSame(import(folder.write("a.gltf", mark + gltf(mesh))), mesh, "gltf");
}

TEST(Import, SaysItInOneLineWhateverTheNameOfTheFile) {
    const Folder folder;
    EXPECT_EQ(complaint(folder.write("two\nlines", "")),
              "two lines: the file is empty: export the mesh again");
}

TEST(Import, TriangulatesConcavePolygons) {
    const Folder folder;
    const std::string arrow = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 0.5 1 0\nf 1 2 3 4\n";
    const MeshReport report = inspect(import(folder.write("a.obj", arrow)));
    EXPECT_NEAR(report.area, 1.5, 1e-6);
    EXPECT_EQ(report.defects.flippedEdges, 0u);
}

TEST(Import, ReadsStlWithSeveralSolidsOrBytesBehindTheTriangles) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 2, 3});
    expectSame(import(folder.write("a.stl", "solid empty\nendsolid empty\n" + stlText(mesh))), mesh,
               "empty solid");
    EXPECT_NEAR(
        inspect(import(folder.write("b.stl", stlText(mesh) + stlText(moved(mesh, {5, 0, 0}))))).volume, 12,
        1e-5);
    expectSame(import(folder.write("c.stl", stlBinary(mesh) + "made with care")), mesh, "bytes behind");
}

TEST(Import, CountsDefectsAndReadsTheMeshAllTheSame) {
    const Folder folder;
    const TriangleMesh sphere = generate("sphere", 16);
    MeshDefects defects;
    importMesh(folder.write("open.obj", objText(openedAbove(sphere, 0.1f))), defects);
    EXPECT_GT(defects.boundaryEdges, 0u);
    EXPECT_EQ(defects.boundaryEdges, inspect(openedAbove(sphere, 0.1f)).defects.boundaryEdges);

    TriangleMesh bad = sphere;
    bad.triangles.push_back({0, 0, 1});
    bad.triangles.push_back(bad.triangles.front());
    bad.triangles.push_back({0, 1, 200});
    importMesh(folder.write("bad.ply", plyText(bad)), defects, {}, Repair::none);
    EXPECT_EQ(defects.degenerateTriangles, 1u);
    EXPECT_EQ(defects.duplicateTriangles, 1u);
    EXPECT_GT(defects.nonManifoldEdges + defects.boundaryEdges, 0u);
    importMesh(folder.write("good.ply", plyText(sphere)), defects);
    EXPECT_TRUE(defects.isClosed()) << "defects of the file before are counted again";
}

TEST(Import, NeverOpensASecondFile) {
    const Folder folder;
    const Canary canary(folder / "canary");
    fs::create_directory(folder / "inner");
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    expectSame(import(folder.write("a.obj", "mtllib canary\nmtllib ./canary\n" + objText(mesh))), mesh,
               "mtllib");
    expectSame(import(folder.write("inner/a.obj", "mtllib ../canary\n" + objText(mesh))), mesh, "mtllib ../");
    expectSame(import(folder.write("b.obj", "mtllib " + (folder / "canary").string() + "\n" + objText(mesh))),
               mesh, "mtllib with a whole path");
    expectSame(import(folder.write("c.obj", "mtllib c.obj\nmtllib mesh.obj\nmap_Kd x\n" + objText(mesh))),
               mesh, "itself");
    for (const std::string uri : {"canary", "../canary", "file:canary", "/etc/passwd"}) {
        std::string text = gltf(mesh);
        const std::size_t start = text.find("data:"), end = text.find('"', start);
        text.replace(start, end - start, uri);
        EXPECT_EQ(
            complaint(folder.write("a.gltf", text)),
            "a.gltf:buffers.uri: the mesh is kept in a second file, which is never opened: export it as GLB, "
            "or as glTF with embedded buffers");
    }
    std::string picture = gltf(mesh);
    picture.insert(
        1, R"("images":[{"uri":"canary"},{"uri":"../../../../etc/passwd"}],"textures":[{"source":0}],)");
    expectSame(import(folder.write("b.gltf", picture)), mesh, "a picture that is not needed");
    EXPECT_TRUE(canary.isUnread());
}

TEST(Import, SurvivesMaterialsThatCrashAssimp) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    folder.write("bad.mtl", "map_Kd picture.png\nKd 1 0 0\nNs 10\n");
    expectSame(import(folder.write("a.obj", "mtllib bad.mtl\n" + objText(mesh))), mesh,
               "map_Kd before newmtl");
}

TEST(Import, SaysWhatIsWrongWithTheFile) {
    const Folder folder;
    EXPECT_EQ(complaint(folder / "none.obj"),
              "none.obj: No such file or directory: check the path and its permissions");
    EXPECT_EQ(complaint(folder.write("empty.obj", "")),
              "empty.obj: the file is empty: export the mesh again");
    EXPECT_EQ(
        complaint(folder.write("a.txt", "hello")),
        "a.txt: its content is neither OBJ, STL, PLY, glTF nor GLB: export the mesh in one of these formats");
    EXPECT_EQ(complaint(folder.write("points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n")),
              "points.obj: it holds no faces: export a surface, not points or lines");
    EXPECT_EQ(complaint(folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
              "line.obj: all its faces have zero area: check the scale it was exported with");
}

TEST(Import, NamesTheLineOrElement) {
    const Folder folder;
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\nv nan 0 0\nv 1 1 1\nf 1 2 3\n")),
              "a.obj:2: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\nv 0 0 inf\nv 1 1 1\nf 1 2 3\n")),
              "a.obj:2: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\n\nv 0 1e39 0\nv 1 1 1\nf 1 2 3\n")),
              "a.obj:3: a coordinate lies beyond 1e9 m: check the unit of the mesh");
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 4\n")),
              "a.obj:4: a face names a vertex that does not exist: export the mesh again");
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 -4\n")),
              "a.obj:4: a face names a vertex that does not exist: export the mesh again");
    EXPECT_EQ(complaint(folder.write("a.obj", "v 0 0 0\nv 0 one 0\nv 1 1 1\nf 1 2 3\n")),
              "a.obj:2: a coordinate is not a number: export the mesh again");

    TriangleMesh bad = box({0, 0, 0}, {1, 1, 1});
    bad.positions[5].y = std::nanf("");
    EXPECT_EQ(complaint(folder.write("a.ply", plyBinary(bad, ByteOrder::big))),
              "a.ply:vertex 5: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.ply", plyText(bad))),
              "a.ply:16: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.glb", glb(bad))),
              "a.glb:vertex 5: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.gltf", gltf(bad))),
              "a.gltf:vertex 5: a coordinate is not a finite number: repair the mesh");
    EXPECT_EQ(complaint(folder.write("a.stl", stlText(bad))),
              "a.stl:19: a coordinate is not a finite number: repair the mesh");
    EXPECT_NE(complaint(folder.write("b.stl", stlBinary(bad))).find("a coordinate is not a finite number"),
              std::string::npos);

    bad = box({0, 0, 0}, {1, 1, 1});
    bad.triangles[3][1] = 8;
    EXPECT_EQ(complaint(folder.write("a.ply", plyText(bad))),
              "a.ply:22: a face names a vertex that does not exist: export the mesh again");
    EXPECT_EQ(complaint(folder.write("a.ply", plyBinary(bad, ByteOrder::little))),
              "a.ply:face 3: a face names a vertex that does not exist: export the mesh again");
    EXPECT_EQ(complaint(folder.write("a.glb", glb(bad))),
              "a.glb: a face names a vertex that does not exist: export the mesh again");
}

TEST(Import, RefusesClaimsThatTheFileCannotHold) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    std::string ply = plyText(mesh);
    ply.replace(ply.find("vertex 8"), 8, "vertex 4000000000");
    const std::size_t body = ply.size() - ply.find("end_header") - 11;
    EXPECT_EQ(complaint(folder.write("a.ply", ply)), "a.ply:4: 4000000000 of \"vertex\" do not fit in " +
                                                         std::to_string(body) + " bytes: check the header");
    ply = plyBinary(mesh, ByteOrder::little);
    ply.replace(ply.find("face 12"), 7, "face 4000000000");
    EXPECT_NE(complaint(folder.write("a.ply", ply)).find("4000000000 of \"face\" do not fit"),
              std::string::npos);
    ply = plyBinary(mesh, ByteOrder::little);
    ply.replace(ply.find("face 12"), 7, "face 18446744073709551617");
    EXPECT_NE(complaint(folder.write("a.ply", ply)).find("no count"), std::string::npos);

    std::string stl = stlBinary(mesh);
    stl.replace(80, 4, "\xff\xff\xff\xee");
    EXPECT_EQ(complaint(folder.write("a.stl", stl)),
              "a.stl: it claims 4009754623 triangles, which do not fit in " + std::to_string(stl.size()) +
                  " bytes: export the mesh again");
    std::string binary = glb(mesh);
    binary.replace(12, 4, "\x00\x00\x00\xbe", 4);
    EXPECT_EQ(complaint(folder.write("a.glb", binary)),
              "a.glb:chunk 0: it claims 3187671040 bytes, the file has " + std::to_string(binary.size()) +
                  ": export the mesh again");
    for (const std::string_view key : {R"("count":)", R"("byteLength":)", R"("byteOffset":)"}) {
        std::string text = gltf(mesh);
        text.insert(text.find(key) + key.size(), "99999999");
        EXPECT_NE(complaint(folder.write("a.gltf", text)).find("does not fit in a file of"),
                  std::string::npos)
            << key;
    }
}

TEST(Import, RefusesWhatIsNoRegularFile) {
    const Folder folder;
    EXPECT_NE(complaint(folder.path()).find("it is a folder: give the name of a mesh file"),
              std::string::npos);
    mkfifo((folder / "pipe").c_str(), 0600);
    EXPECT_EQ(complaint(folder / "pipe"), "pipe: it is not a regular file: give the name of a mesh file");
    EXPECT_NE(complaint("/dev/zero").find("it is not a regular file"), std::string::npos);
}

TEST(Import, KeepsToItsLimits) {
    const Folder folder;
    const TriangleMesh organ = generate("organ", 32);
    for (const Sample& sample : samplesOf(organ)) {
        const fs::path file = folder.write(sample.name, sample.bytes);
        EXPECT_NE(complaint(file, {.triangles = 1000}).find("exceed the limit of 1000: simplify"),
                  std::string::npos)
            << sample.name;
        EXPECT_NE(complaint(file, {.fileBytes = 1000}).find("bytes exceed the limit of 1000"),
                  std::string::npos);
        EXPECT_NE(complaint(file, {.wallSeconds = 0}).find("it took longer than 0 s"), std::string::npos)
            << sample.name;
    }
}

TEST(Import, KeepsToItsMemory) {
    const Folder folder;
    const fs::path file = folder.write("a.stl", stlBinary(generate("sphere", 256))); // 6.5 MB
    EXPECT_EQ(complaint(file), "no error");
    EXPECT_NE(complaint(file, {.addressSpaceBytes = 4 << 20}).find("a.stl: "), std::string::npos);
}

TEST(Import, CountsTheTrianglesOfRepeatedNodes) {
    const Folder folder;
    std::string nodes = R"([{"children":[1)", rest = R"(,{"mesh":0})";
    for (int i = 2; i <= 100; ++i) {
        nodes.append(",").append(std::to_string(i));
        rest += R"(,{"mesh":0})";
    }
    const fs::path file = folder.write("a.glb", glb(box({0, 0, 0}, {1, 1, 1}), nodes + "]}" + rest + "]"));
    EXPECT_EQ(complaint(file, {.triangles = 1200}), "no error");
    EXPECT_NE(complaint(file, {.triangles = 1199}).find("1200 triangles exceed the limit"),
              std::string::npos);
}

TEST(Import, ReadsTheSpiderOfAssimpsTestModels) {
    if (!fs::exists(models)) GTEST_SKIP() << "assimp-testmodels is not installed: real files are NOT tested";
    for (const std::string name : {"OBJ/spider.obj", "STL/Spider_ascii.stl", "STL/Spider_binary.stl"}) {
        MeshDefects defects;
        const TriangleMesh spider = importMesh(models / name, defects, {}, Repair::none);
        EXPECT_EQ(spider.positions.size(), 722u)
            << name; // counted by a separate script, in the text of the OBJ file
        EXPECT_EQ(spider.triangles.size(), 1312u) << name;
        EXPECT_EQ(defects.boundaryEdges, 72u) << name;
        EXPECT_EQ(defects.degenerateTriangles, 56u) << name;
        EXPECT_EQ(defects.flippedEdges, 10u) << name;
    }
}

TEST(Import, ReadsOrRefusesEachOfAssimpsTestModels) {
    if (!fs::exists(models)) GTEST_SKIP() << "assimp-testmodels is not installed: real files are NOT tested";
    std::size_t read = 0;
    for (const std::string folder : {"OBJ", "PLY", "STL", "glTF", "glTF2", "invalid"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(models / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string text = complaint(entry.path());
            read += text == "no error" ? 1 : 0;
            EXPECT_EQ(text.find("the importer failed"), std::string::npos) << entry.path() << ": " << text;
        }
    EXPECT_GE(read, 25u);
}

namespace {

/// Report of each named object; triangles without an object are under "".
std::map<std::string, MeshReport> objectsOf(const TriangleMesh& mesh) {
    std::map<std::string, MeshReport> result;
    if (mesh.objects.size() != mesh.triangles.size()) return result;
    std::set<std::uint32_t> numbers(mesh.objects.begin(), mesh.objects.end());
    for (const std::uint32_t number : numbers) {
        std::vector<bool> isOf;
        for (const std::uint32_t object : mesh.objects) isOf.push_back(object == number);
        result[number == noObject ? "" : mesh.objectNames.at(number)] = inspect(keep(mesh, isOf));
    }
    return result;
}

/// Lines of an OBJ file: `head`, then a box whose first vertex has the index `first`.
std::string objBox(const std::string& head, int first, float x) {
    TriangleMesh mesh = box({x, 0, 0}, {x + 1, 1, 1});
    std::string text = head;
    for (const auto& [px, py, pz] : mesh.positions)
        text += "v " + std::to_string(px) + " " + std::to_string(py) + " " + std::to_string(pz) + "\n";
    for (const auto& [a, b, c] : mesh.triangles)
        text += "f " + std::to_string(a + first) + " " + std::to_string(b + first) + " " +
                std::to_string(c + first) + "\n";
    return text;
}

} // namespace

TEST(ImportObjects, KeepTheirNamesInAnObj) {
    const Folder folder;
    const std::string text = objBox("", 1, 0) + objBox("o liver  \n", 9, 2) +
                             objBox("g ignored\no gall bladder\n", 17, 4) + "o liver\n" + objBox("", 25, 6) +
                             "o alone\n";
    const auto found = objectsOf(import(folder.write("a.obj", text)));
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found.at("").high.x, 1);
    EXPECT_EQ(found.at("liver").low.x, 2);
    EXPECT_EQ(found.at("liver").high.x, 7) << "goes on after another";
    EXPECT_NEAR(found.at("liver").volume, 2, 1e-5);
    EXPECT_EQ(found.at("gall bladder").low.x, 4);
    EXPECT_NEAR(found.at("gall bladder").volume, 1, 1e-5);

    const auto groups =
        objectsOf(import(folder.write("a.obj", objBox("g a b\n", 1, 0) + objBox("g\n", 9, 2))));
    ASSERT_EQ(groups.size(), 2u) << "groups are objects where there are no others";
    EXPECT_EQ(groups.at("a b").low.x, 0);
    EXPECT_EQ(groups.at("").low.x, 2);
    EXPECT_TRUE(import(folder.write("a.obj", objBox("", 1, 0))).objects.empty());
}

TEST(ImportObjects, KeepTheOrderOfTriangles) {
    const Folder folder;
    const std::string plain = objBox("", 1, 0) + objBox("", 9, 2), quad = "f 1 2 3 4 5\n";
    const TriangleMesh without = import(folder.write("a.obj", plain + quad + quad)),
                       with = import(folder.write("b.obj", objBox("o a\n", 1, 0) + objBox("o b\n", 9, 2) +
                                                               "o a\n" + quad + "o b\n" + quad));
    EXPECT_EQ(with.triangles, without.triangles);
    EXPECT_EQ(with.objects.size(), with.triangles.size());
}

TEST(ImportObjects, KeepTheirNamesInStlAndGltf) {
    const Folder folder;
    const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    std::string first = stlText(mesh), second = stlText(moved(mesh, {3, 0, 0}));
    first.replace(0, first.find('\n'), "solid bone of the leg");
    second.replace(0, second.find('\n'), "solid");
    const auto solids = objectsOf(import(folder.write("a.stl", "solid empty\nendsolid\n" + first + second)));
    ASSERT_EQ(solids.size(), 2u);
    EXPECT_EQ(solids.at("bone of the leg").high.x, 1);
    EXPECT_EQ(solids.at("").low.x, 3);

    const std::string_view nodes = R"([{"children":[1,2,3]},{"mesh":0,"name":"liver"},
        {"mesh":0,"translation":[3,0,0],"name":"gall"},{"mesh":0,"translation":[6,0,0]}])";
    for (const std::string& bytes : {glb(mesh, nodes), gltf(mesh, nodes)}) {
        const auto found = objectsOf(import(folder.write("nodes", bytes)));
        ASSERT_EQ(found.size(), 3u);
        EXPECT_EQ(found.at("liver").high.x, 1);
        EXPECT_EQ(found.at("gall").low.x, 3);
        EXPECT_EQ(found.at("").low.x, 6) << "names that the importer makes up are none";
    }
}

TEST(ImportObjects, HaveNamesThatCanBePrintedAndAreNotTooMany) {
    const Folder folder;
    const auto names = [&](const std::string& text) {
        return import(folder.write("a.obj", text)).objectNames;
    };
    EXPECT_EQ(names(objBox("o a\x1b[31m\tb\x7f\r\n", 1, 0)), std::vector<std::string>{"a [31m b"});
    const std::string name = names(objBox("o " + std::string(63, 'x') + "\u00e9t\n", 1, 0)).at(0);
    EXPECT_EQ(name, std::string(63, 'x')) << "cut before a letter, not within";
    std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    for (int i = 0; i < 20'000; ++i)
        many += "o n" + std::to_string(i) + "\nf 1 2 3\nf 1 3 4\nf 2 3 4\nf 1 2 4\n";
    EXPECT_EQ(names(many).size(), 4096u);
}
