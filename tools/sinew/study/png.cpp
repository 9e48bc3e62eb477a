// Starts the converter without a shell: file names are arguments and are never parsed.
#include "sinew/study/png.hpp"

#include <array>
#include <string>

#ifdef _WIN32
#include <process.h>
#else
#include <cerrno>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;
#endif

namespace sinew::tools::study {

namespace fs = std::filesystem;

namespace {

using Arguments = std::array<const char*, 6>; // the last one is null

/// Whether the program that the first argument names was found and ended well.
#ifdef _WIN32
bool runs(const Arguments& arguments) {
    return _spawnvp(_P_WAIT, arguments[0], arguments.data()) == 0;
}
#else
bool runs(const Arguments& arguments) {
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = -1;
    const bool isStarted = posix_spawnp(&child, arguments[0], &files, nullptr,
                                        const_cast<char**>(arguments.data()), environ) == 0;
    posix_spawn_file_actions_destroy(&files);
    while (isStarted && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return isStarted && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
#endif

} // namespace

bool convertToPng(const fs::path& svg, const fs::path& png) {
    const std::string partial = png.string() + ".part", input = svg.string();
    const bool isDone = runs({"rsvg-convert", "--zoom=2", "-o", partial.c_str(), input.c_str(), nullptr});
    std::error_code error;
    if (isDone) fs::rename(partial, png, error);
    if (isDone && !error) return true;
    fs::remove(partial, error);
    fs::remove(png, error);
    return false;
}

} // namespace sinew::tools::study
