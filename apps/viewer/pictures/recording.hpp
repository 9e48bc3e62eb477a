// Pictures of steps, one after another, to a file beside the program: MP4 where ffmpeg is installed, or else
// a folder of PNG files. Stepped, not timed: the film has the scene's own pace whatever the machine's.
#pragma once

#include "viewer/pictures/picture_writer.hpp"
#include "viewer/pictures/video.hpp"

#include <memory>

namespace sinew::viewer {

/// One thread. Without finish() a video is not there, and pictures are as far as they came.
class Recording {
public:
    /// Named after the scene; what exists is never written over. Throws app::Failure (outputFailed).
    Recording(const std::string& scene, std::uint32_t width, std::uint32_t height, double picturesPerSecond);

    /// Throws app::Failure or mesh::ExportError where it cannot be written.
    void add(Picture picture, PictureText text);
    /// Waits until all is written; without a picture nothing is kept. Throws likewise.
    void finish();

    const std::filesystem::path& target() const { return target_; }
    std::size_t count() const { return count_; }

private:
    std::filesystem::path target_;
    std::unique_ptr<Video> video_; // none: pictures
    PictureWriter writer_{2};
    std::size_t count_ = 0;
};

/// `name` and `extension` with what makes a file or folder of `folder`, or of the current one, out of them
/// that is not there yet.
std::filesystem::path freeName(std::string name, const std::string& extension,
                               const std::filesystem::path& folder = {});

} // namespace sinew::viewer
