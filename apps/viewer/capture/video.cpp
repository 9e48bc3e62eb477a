// Starts ffmpeg without a shell, so that no file name needs quoting.
#include "viewer/capture/video.hpp"

#include "app/guard.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

extern char** environ;

namespace sinew::viewer {

namespace {

std::string findOnPath(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path candidate =
            std::filesystem::path(folder) / program; // empty: the current folder
        if (::access(candidate.c_str(), X_OK) == 0 && !std::filesystem::is_directory(candidate))
            return candidate.string();
    }
    return {};
}

std::vector<std::string> ffmpegArguments(std::uint32_t width, std::uint32_t height, double rate,
                                         const std::string& output) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    // yuv420p with even sides plays everywhere.
    const std::string even =
        "crop=" + std::to_string(width / 2 * 2) + ":" + std::to_string(height / 2 * 2) + ":0:0";
    return {"ffmpeg",
            "-hide_banner",
            "-loglevel",
            "error",
            "-nostdin",
            "-y",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgba",
            "-video_size",
            size,
            "-framerate",
            std::to_string(rate),
            "-i",
            "pipe:0",
            "-vf",
            even,
            "-pix_fmt",
            "yuv420p",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
            "file:" + output};
}

} // namespace

bool hasFfmpeg() {
    return !findOnPath("ffmpeg").empty();
}

Video::Video(std::filesystem::path file, std::uint32_t width, std::uint32_t height, double picturesPerSecond)
    : file_(std::move(file)) {
    const std::string program = findOnPath("ffmpeg");
    if (program.empty()) fail("ffmpeg is not on the PATH: install ffmpeg, or use --out DIR for pictures");
    if (file_.has_parent_path() && !std::filesystem::is_directory(file_.parent_path()))
        fail("its folder does not exist: make it first");
    if (std::filesystem::is_directory(file_)) fail("it is a folder: name a file");
    partial_ = file_;
    partial_ += std::to_string(::getpid()).append(".part");
    start(program, ffmpegArguments(width, height, picturesPerSecond, partial_.string()));
}

void Video::fail(const std::string& why) const {
    throw app::Failure(app::outputFailed, "cannot write video: " + file_.string() + ": " + why);
}

void Video::start(const std::string& program, const std::vector<std::string>& arguments) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(std::string(std::strerror(errno)) + ": close other programs");
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawnattr_t
        attributes; // a process group of its own: Ctrl + C stops only this program, which then ends the video
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    const int error = ::posix_spawn(&process_, program.c_str(), &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    pipe_ = ends[1];
    if (error != 0) {
        process_ = -1;
        ::close(std::exchange(pipe_, -1));
        fail("cannot start " + program + ": " + std::strerror(error) + ": reinstall ffmpeg");
    }
}

namespace {

// Writes without SIGPIPE, which would end the program if an encoder has failed, for example on a full disk.
ssize_t writeQuietly(int pipe, const void* bytes, std::size_t size) {
    sigset_t broken, before;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &broken, &before);
    const ssize_t written = ::write(pipe, bytes, size);
    const int error = errno;
    const timespec atOnce{};
    if (written != static_cast<ssize_t>(size)) // a partial write may have raised it, too
        ::sigtimedwait(&broken, nullptr, &atOnce);
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    errno = error;
    return written;
}

} // namespace

void Video::add(const Picture& picture) {
    const std::uint8_t* bytes = picture.pixels.data();
    for (std::size_t left = picture.pixels.size(); left > 0;) {
        const ssize_t written = writeQuietly(pipe_, bytes, left);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail("ffmpeg has stopped: see its message above");
        bytes += written;
        left -= static_cast<std::size_t>(written);
    }
}

int Video::waitForEnd() {
    if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void Video::finish() {
    if (waitForEnd() != 0) fail("ffmpeg has failed: see its message above");
    std::error_code error;
    std::filesystem::rename(partial_, file_, error);
    if (error) fail(error.message() + ": choose another file");
}

Video::~Video() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        waitForEnd();
    }
    std::error_code ignored; // nothing to remove after the rename
    if (!partial_.empty()) std::filesystem::remove(partial_, ignored);
}

} // namespace sinew::viewer
