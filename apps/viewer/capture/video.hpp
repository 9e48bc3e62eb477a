// An MP4 file made by ffmpeg, which gets raw pictures through a pipe.
#pragma once

#include "viewer/render/png.hpp"

#include <sys/types.h>

namespace sinew::viewer {

/// Whether ffmpeg is on the PATH.
bool hasFfmpeg();

/// ffmpeg runs during the object's lifetime. The file gets its name only after finish() has succeeded.
class Video {
public:
    /// Pictures are `width` x `height`; an odd column or row is left out. Throws app::Failure (outputFailed)
    /// if ffmpeg is not on the PATH or cannot be started, or if the file's folder is missing.
    Video(std::filesystem::path file, std::uint32_t width, std::uint32_t height, double picturesPerSecond);
    ~Video(); ///< without finish(): stops ffmpeg and leaves no file
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    /// Throws app::Failure (outputFailed) if ffmpeg has ended.
    void add(const Picture& picture);
    void finish();

private:
    [[noreturn]] void fail(const std::string& why) const;
    void start(const std::string& program, const std::vector<std::string>& arguments);
    int waitForEnd();
    std::filesystem::path file_, partial_;
    pid_t process_ = -1;
    int pipe_ = -1;
};

} // namespace sinew::viewer
