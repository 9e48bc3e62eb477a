// Tests that PNG files are read back as written, with their text, and that videos need ffmpeg and leave no
// partial files.
#include "viewer/capture/picture_writer.hpp"
#include "viewer/capture/video.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace sinew::viewer {
namespace {

namespace fs = std::filesystem;

Picture somePicture(std::uint32_t width, std::uint32_t height) {
    Picture picture{.width = width, .height = height, .pixels = {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
        for (const std::uint32_t channel : {7 * i, 13 * i + 5, i * i, 255u})
            picture.pixels.push_back(static_cast<std::uint8_t>(channel));
    return picture;
}

class Files : public testing::Test {
protected:
    void SetUp() override {
        folder = fs::temp_directory_path() /
                 (std::string("sinew_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder);
        fs::create_directory(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    std::size_t count() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }
    fs::path folder;
};

class Png : public Files {};
class VideoFile : public Files {};

TEST_F(Png, ComesBackAsItWentOut) {
    const Picture picture = somePicture(37, 19);
    const std::vector<std::uint8_t> bytes = encodePng(picture, {{"Scene", "a test"}});
    int width = 0, height = 0, channels = 0;
    std::uint8_t* decoded =
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4);
    ASSERT_NE(decoded, nullptr) << stbi_failure_reason();
    EXPECT_EQ(width, 37);
    EXPECT_EQ(height, 19);
    EXPECT_TRUE(std::equal(picture.pixels.begin(), picture.pixels.end(), decoded));
    stbi_image_free(decoded);
}

TEST_F(Png, HoldsItsTextWithTheChecksumOfTheSpecification) {
    const std::vector<std::uint8_t> bytes = encodePng(somePicture(2, 2), {{"Title", "PngSuite"}});
    // Length 14, then type, keyword, 0, text, and the CRC-32 that zlib computes for them.
    const std::vector<std::uint8_t> chunk{0, 0,   0,   14,  't', 'E', 'X', 't', 'T', 'i',  't',  'l',  'e',
                                          0, 'P', 'n', 'g', 'S', 'u', 'i', 't', 'e', 0x4f, 0x55, 0xcf, 0x4c};
    const auto found = std::search(bytes.begin(), bytes.end(), chunk.begin(), chunk.end() - 4);
    ASSERT_EQ(found - bytes.begin(), 33) << "behind signature and header";
    EXPECT_TRUE(std::equal(chunk.end() - 4, chunk.end(), found + 22)) << "checksum";
}

TEST_F(Png, WriterWritesAllItWasGiven) {
    PictureWriter writer(2);
    for (int i = 0; i < 5; ++i) writer.add(folder / (std::to_string(i) + ".png"), somePicture(16, 16), {});
    while (writer.take(PictureWriter::Wait::yes)) {
    }
    EXPECT_EQ(count(), 5u);
}

TEST_F(Png, WriterReportsWhatCannotBeWritten) {
    PictureWriter writer(1);
    writer.add(folder / "missing" / "a.png", somePicture(16, 16), {});
    EXPECT_THROW(writer.take(PictureWriter::Wait::yes), mesh::ExportError);
    EXPECT_EQ(count(), 0u);
}

// Replaces ffmpeg by a program that counts the bytes into its last argument, or fails.
void installProgram(const fs::path& folder, const std::string& body) {
    fs::create_directory(folder);
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << body;
    fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
}

class PathOf { // prepends to the PATH of the process for its lifetime
public:
    explicit PathOf(const std::string& path) : old_(std::getenv("PATH")) {
        ::setenv("PATH", path.c_str(), 1);
    }
    ~PathOf() { ::setenv("PATH", old_.c_str(), 1); }
    PathOf(const PathOf&) = delete;
    PathOf& operator=(const PathOf&) = delete;

private:
    std::string old_;
};

TEST_F(VideoFile, GetsEveryPictureAndItsNameAtTheEnd) {
    installProgram(folder / "bin", "for last; do :; done\nwc -c > \"${last#file:}\"\n");
    const PathOf path((folder / "bin").string() + ":" + std::getenv("PATH"));
    const fs::path file = folder / "it's a film.mp4";
    Video video(file, 32, 16, 30);
    for (int i = 0; i < 3; ++i) video.add(somePicture(32, 16));
    EXPECT_FALSE(fs::exists(file));
    video.finish();
    std::size_t bytes = 0;
    std::ifstream(file) >> bytes;
    EXPECT_EQ(bytes, 3u * 32 * 16 * 4);
    EXPECT_EQ(count(), 2u) << "the program's folder and the film";
}

TEST_F(VideoFile, IsNotLeftHalfDone) {
    installProgram(folder / "bin", "for last; do :; done\ncat > \"${last#file:}\"\nexit 3\n");
    const PathOf path((folder / "bin").string() + ":" + std::getenv("PATH"));
    {
        Video video(folder / "failed.mp4", 32, 16, 30);
        video.add(somePicture(32, 16));
        EXPECT_THROW(video.finish(), app::Failure);
    }
    { const Video dropped(folder / "dropped.mp4", 32, 16, 30); }
    EXPECT_EQ(count(), 1u);
}

TEST_F(VideoFile, NeedsFfmpegOnThePath) {
    const PathOf path(folder.string());
    try {
        const Video video(folder / "a.mp4", 32, 16, 30);
        ADD_FAILURE() << "started without a program";
    } catch (const app::Failure& failure) {
        EXPECT_EQ(failure.code(), app::outputFailed);
        EXPECT_NE(std::string(failure.what()).find("install ffmpeg"), std::string::npos);
    }
}

} // namespace
} // namespace sinew::viewer
