// Locks with flock, which the kernel drops when a process dies, so that no stale lock stays behind.
#include "sinew/outputs.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <ostream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sinew::tools {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& why, const char* whatToDo) {
    throw app::Failure(app::outputFailed, "cannot write: " + file + ": " + why + ": " + whatToDo);
}

bool isSpecial(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void writeTo(std::FILE* stream, const std::string& text, const std::string& name) {
    const bool isWritten =
        std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
    if (!isWritten) fail(name, std::strerror(errno), "free some space or choose another target");
}

/// A device or FIFO has no final name to protect: nothing to rename.
void writeSpecial(const std::string& file, const std::string& text) {
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (!stream) fail(file, std::strerror(errno), "choose another file");
    const auto close = [](std::FILE* open) { std::fclose(open); };
    const std::unique_ptr<std::FILE, decltype(close)> owner(stream, close);
    writeTo(stream, text, file);
}

} // namespace

TextOutput::TextOutput(std::string target) : target_(std::move(target)) {
    if (target_ == "-" || isSpecial(target_)) return;
    const fs::path file(target_);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code error;
    if (fs::is_directory(file, error)) fail(target_, "is a folder", "name a file");
    if (!fs::is_directory(folder, error)) fail(target_, "its folder does not exist", "make the folder first");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        fail(target_, std::strerror(errno), "choose another folder");
}

void TextOutput::write(const std::string& text) const {
    if (target_ == "-")
        writeTo(stdout, text, "the standard output");
    else if (isSpecial(target_))
        writeSpecial(target_, text);
    else
        mesh::writeWhole(target_, [&](std::ostream& stream) { stream << text; });
}

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)), lockFile_(folder_ / ".sinew-lock") {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) fail(folder_.string(), error.message(), "choose another folder");
    lock_ = ::open(lockFile_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (lock_ < 0) fail(folder_.string(), std::strerror(errno), "choose another folder");
    struct stat status {};
    const bool isLocked = ::flock(lock_, LOCK_EX | LOCK_NB) == 0;
    // Without a link the file was removed by a run that ended just now, and a third run may hold a new one.
    if (!isLocked || ::fstat(lock_, &status) != 0 || status.st_nlink == 0) {
        ::close(lock_);
        fail(folder_.string(), "another run writes there", "wait for it or choose another folder");
    }
}

OutputFolder::~OutputFolder() {
    std::error_code error;
    fs::remove(lockFile_, error);
    ::close(lock_);
}

std::string fileName(const std::string& name) {
    std::string result = name.substr(0, 64);
    for (char& c : result) {
        const bool isPlain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!isPlain) c = '_';
    }
    return result.empty() ? "body" : result;
}

} // namespace sinew::tools
