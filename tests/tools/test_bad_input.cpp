// Tests bad input, devices and outputs: each gives one line and the right exit code, and leaves no file
// behind.
#include "tools/program.hpp"

#include <sys/stat.h>

using sinew::test::expectOneError;
using sinew::test::shippedScene;

namespace {

class BadInput : public sinew::test::Program {
protected:
    /// Expects this error from `run` on a file with this content, and no new files.
    void expectBad(const std::string& name, const std::string& text, const std::string& part) const {
        write(name, text);
        expectOneError(run({"run", name, "--frames", "1"}), 3, part);
        EXPECT_EQ(files(), std::vector<std::string>{name});
        std::filesystem::remove(folder_ / name);
    }
};

const std::string cloth = "[[cloth]]\nsize = [3, 3]\nspacing = 0.1\n";

std::string plyHead(const std::string& vertices) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
           "vertex_indices\n"
           "end_header\n";
}

} // namespace

TEST_F(BadInput, MissingFile) {
    expectOneError(run({"run", "none.toml"}), 3, "none.toml: no such file");
}

TEST_F(BadInput, UnknownFile) {
    expectBad("picture.bin", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11), "picture.bin: ");
}

TEST_F(BadInput, Directory) {
    expectOneError(run({"run", "/"}), 3, "/: is a folder");
}

TEST_F(BadInput, Device) {
    expectOneError(run({"run", "/dev/zero"}), 3, "/dev/zero: is not a regular file");
}

TEST_F(BadInput, Fifo) {
    ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
    expectOneError(run({"run", "fifo"}), 3, "fifo: is not a regular file");
}

TEST_F(BadInput, UnknownKey) {
    expectBad("scene.toml", cloth + "spacign = 2\n",
              "scene.toml:4: unknown key cloth[0].spacign: did you mean spacing?");
}

TEST_F(BadInput, WrongUnit) {
    expectBad("scene.toml", "[[cloth]]\nspacing = \"5 cm\"\n",
              "scene.toml:2: cloth[0].spacing is text \"5 cm\": write a number in m");
}

TEST_F(BadInput, WrongSign) {
    expectBad("scene.toml", cloth + "area_density = -1\n",
              "scene.toml:4: cloth[0].area_density is -1 kg/m^2: must be above 0");
}

TEST_F(BadInput, NaN) {
    expectBad("scene.toml", "dt = nan\n" + cloth, "scene.toml:1: dt is nan s: must be from 1e-06");
}

TEST_F(BadInput, DeepNesting) {
    expectBad("scene.toml", "a = " + std::string(10'000, '[') + "\n", "scene.toml:1: ");
}

TEST_F(BadInput, EmptyMesh) {
    expectBad("empty.obj", "", "empty.obj: ");
    expectBad("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj: ");
}

TEST_F(BadInput, MeshWithNaN) {
    expectBad("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj");
}

TEST_F(BadInput, MeshIndexOutOfRange) {
    expectBad("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "index.obj");
}

TEST_F(BadInput, TruncatedMesh) {
    expectBad("short.ply", plyHead("3") + std::string(20, '\0'), "short.ply");
}

TEST_F(BadInput, TwoGigabyteHeaderClaim) {
    expectBad("claim.ply", plyHead("180000000"), "claim.ply:3: ");
}

TEST_F(BadInput, MeshBesideTheSceneIsBad) {
    write("scene.toml", "[[mesh]]\nfile = \"m.obj\"\n");
    expectOneError(run({"run", "scene.toml"}), 3, "scene.toml:2: mesh[0].file names no regular file");
    write("m.obj", "f 1 2 3\n");
    expectOneError(run({"run", "scene.toml"}), 3, "m.obj");
}

TEST_F(BadInput, NoVulkanDriver) {
    const sinew::test::Environment none{{"VK_ICD_FILENAMES", "/nonexistent.json"},
                                        {"VK_DRIVER_FILES", "/nonexistent.json"}};
    expectOneError(run({"run", shippedScene("cloth"), "--frames", "1", "--out", "out"}, none), 4, "driver");
    expectOneError(run({"devices"}, none), 4, "driver");
    for (const std::string& file : files()) ADD_FAILURE() << file << " was left behind";
}

TEST_F(BadInput, NoSuchDevice) {
    expectOneError(run({"run", shippedScene("cloth"), "--frames", "1", "--device", "none of them"}), 4,
                   "none of them");
}

TEST_F(BadInput, UnwritableOutputIsFoundBeforeSimulating) {
    const std::vector<std::string> endless{"run", shippedScene("cloth"), "--frames", "1000000000"};
    const auto with = [&](const std::string& option, const std::string& value) {
        std::vector<std::string> arguments = endless;
        arguments.insert(arguments.end(), {option, value});
        return run(arguments);
    };
    write("file", "");
    expectOneError(with("--out", "file"), 6, "file: ");
    expectOneError(with("--out", "file/below"), 6, "file/below: ");
    expectOneError(with("--out", "/proc/sinew"), 6, "/proc/sinew: ");
    expectOneError(with("--json", "none/report.json"), 6, "none/report.json: its folder does not exist");
    expectOneError(with("--json", "/"), 6, "/: is a folder");
}

TEST_F(BadInput, FullOutput) {
    write("scene.toml", cloth);
    expectOneError(run({"run", "scene.toml", "--frames", "1", "--json", "/dev/full"}), 6,
                   "/dev/full: No space left");
}
