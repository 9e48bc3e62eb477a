// Records pictures of steps to a file: MP4 if ffmpeg is installed, else a folder of PNG files. Pictures
// follow steps, not the clock: a film has the scene's own pace on any machine.
#pragma once

#include "viewer/capture/picture_writer.hpp"
#include "viewer/capture/video.hpp"

#include <memory>

namespace sinew::viewer {

/// One thread. Without finish() there is no video; PNG files written so far stay.
class Recording {
public:
    /// Named after the scene; never overwrites a file. Throws app::Failure (outputFailed).
    Recording(const std::string& scene, std::uint32_t width, std::uint32_t height, double picturesPerSecond);

    /// Throws app::Failure or mesh::ExportError if writing fails.
    void add(Picture picture, PictureText text);
    /// Waits until everything is written; without pictures no file is kept. Throws like add().
    void finish();

    const std::filesystem::path& target() const { return target_; }
    std::size_t count() const { return count_; }

private:
    std::filesystem::path target_;
    std::unique_ptr<Video> video_; // null: PNG files
    PictureWriter writer_{2};
    std::size_t count_ = 0;
};

/// Stem of files about a step of a scene: "organ-000120".
std::string nameAt(const std::string& scene, std::uint64_t step);

/// A name for a file or folder in `folder`, or in the current folder, that does not exist yet: `name`, a
/// suffix if needed, and `extension`.
std::filesystem::path freeName(std::string name, const std::string& extension,
                               const std::filesystem::path& folder = {});

} // namespace sinew::viewer
