// Tests of file paths and file contents, independent of the scene's keys.
#include "scenes/load_fixture.hpp"

#include <clocale>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

using namespace sinew;
namespace fs = std::filesystem;
using test::smallCloth;
using test::tetrahedron;

namespace {

class Load : public test::LoadFixture {};

} // namespace

TEST_F(Load, PointsAtTheLineOfASyntaxError) {
    expectError("name = \"n\"\ndt = = 3\n", "scene.toml:2: ");
    expectError("name = \"open\n", "scene.toml:1: ");
    expectError("dt = 0.01\ndt = 0.02\n", "scene.toml:2: ");
    expectError("dt = 0,01\n", "scene.toml:1: ");
    expectError("\xff\xfe\n", "scene.toml:1: ");
    expectError("name = \"\xc3\x28\"\n", "scene.toml:1: ");
    expectError(std::string("\0\0\0\0", 4), "scene.toml:1: ");
}

TEST_F(Load, ReadsByteOrderMarksAndAllLineEnds) {
    std::string windows = "\xef\xbb\xbf" + smallCloth;
    for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2)
        windows.insert(at, 1, '\r');
    EXPECT_EQ(load(windows).scene.particles.size(), 12u);
}

TEST_F(Load, ReadsNumbersAlikeInALocaleWithDecimalCommas) {
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) GTEST_SKIP() << "this machine has no German locale";
    const float spacing = load("[[cloth]]\nsize = [2, 2]\nspacing = 0.25\n").scene.particles[1].position.x;
    const std::string error = errorOfText("dt = -0.5\n" + smallCloth);
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(spacing, 0.25f);
    EXPECT_EQ(error.find("scene.toml:1: dt is -0.5 s"), 0u) << error;
}

TEST_F(Load, SurvivesDeepNestingOnASmallStack) {
    // With a stack of 256 KiB, recursion over 10,000 brackets or dots would overflow.
    const pid_t child = ::fork();
    if (child == 0) {
        rlimit limit{256 << 10, 256 << 10};
        ::setrlimit(RLIMIT_STACK, &limit);
        const std::string brackets = "a = " + std::string(10'000, '[') + std::string(10'000, ']') + "\n";
        std::string dots = "a";
        for (int i = 0; i < 10'000; ++i) dots += ".a";
        std::string both = "a";
        for (int i = 0; i < 190; ++i) both += ".a";
        std::string nested;
        for (int i = 0; i < 40; ++i) nested += both + " = [{ ";
        const bool isRefused = errorOfText(brackets).starts_with("scene.toml:1: ") &&
                               errorOfText(dots + " = 1\n").starts_with("scene.toml:1: more than 200 dots") &&
                               !errorOfText(nested).empty();
        ::_exit(isRefused ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
}

TEST_F(Load, RefusesWhatIsNoRegularFile) {
    EXPECT_EQ(errorOf(folder_ / "none.toml"), "none.toml: no such file: check the path");
    EXPECT_EQ(errorOf("/"), "cannot read scene: /: is a folder: name a file in it");
    EXPECT_EQ(errorOf("/dev/zero"),
              "cannot read scene: /dev/zero: is not a regular file: name a scene or mesh file");
    const fs::path fifo = folder_ / "fifo.toml";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    EXPECT_EQ(errorOf(fifo), "fifo.toml: is not a regular file: name a scene or mesh file");
    fs::create_symlink(folder_ / "loop.toml", folder_ / "loop.toml");
    EXPECT_EQ(errorOf(folder_ / "loop.toml").find("loop.toml: "), 0u);
}

TEST_F(Load, NamesTheFileThatIsSpelledMostLikeOneThatIsMissing) {
    for (const char* name : {"cube.toml", "cube_load.toml", "organ.toml"}) write(name, smallCloth);
    fs::create_directory(folder_ / "cubes.toml");
    const auto meant = [&](const char* name) { return "did you mean " + (folder_ / name).string() + "?"; };
    for (const auto& [typed, file] : {std::pair{"cub.toml", "cube.toml"},
                                      {"cube", "cube.toml"},
                                      {"cubeload.toml", "cube_load.toml"},
                                      {"orgna.toml", "organ.toml"}}) {
        const std::string error = errorOf(folder_ / typed);
        EXPECT_TRUE(error.ends_with(": no such file: " + meant(file))) << error;
    }
    for (const fs::path& far : {folder_ / "sphere.toml", folder_ / "none" / "cube.toml"}) {
        const std::string error = errorOf(far);
        EXPECT_TRUE(error.ends_with(": no such file: check the path")) << error;
    }
}

TEST_F(Load, RefusesHugeSceneFiles) {
    const fs::path file = write("scene.toml", smallCloth);
    fs::resize_file(file, (16u << 20) + 1);
    EXPECT_EQ(errorOf(file), "scene.toml: is larger than 16 MiB: name a scene file");
}

TEST_F(Load, PutsNoControlCharactersIntoMessages) {
    const std::string error = errorOfText("\"evil\\n\\u001b[31m\" = 1\n");
    EXPECT_EQ(error.find("scene.toml:1: unknown key evil??[31m: possible are "), 0u) << error;
}

TEST_F(Load, TellsScenesFromMeshesByContent) {
    EXPECT_EQ(scenes::load(write("cloth.txt", smallCloth)).scene.particles.size(), 12u);
    mesh::exportObj(folder_ / "tetrahedron.obj", tetrahedron(1));
    EXPECT_EQ(scenes::load(folder_ / "tetrahedron.obj").scene.name, "tetrahedron.obj");
    EXPECT_NE(errorOf(write("comment.obj", "# nothing\n")).find("cannot read mesh"), std::string::npos);
    EXPECT_NE(errorOf(write("empty.obj", "")).find("cannot read mesh"), std::string::npos);
    EXPECT_NE(errorOf(write("broken.toml", "v 0 0 0\n")).find("broken.toml:1: "), std::string::npos);
}
