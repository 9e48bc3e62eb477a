// Locks with flock, or on Windows by a file that only one process may open. The system releases both when a
// process dies, so that no stale lock remains.
#include "sinew/outputs.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <ostream>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef _WIN32
#include <io.h>
#include <share.h>
#else
#include <sys/file.h>
#endif

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

/// Writes to a device or FIFO, which has no final name, without renaming.
void writeSpecial(const std::string& file, const std::string& text) {
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (!stream) fail(file, std::strerror(errno), "choose another file");
    const auto close = [](std::FILE* open) { std::fclose(open); };
    const std::unique_ptr<std::FILE, decltype(close)> owner(stream, close);
    writeTo(stream, text, file);
}

/// Length in bytes of the first UTF-8 character of `text` if a file name may contain it, else 0. Allows ASCII
/// letters, digits and '-', and other characters except controls and U+2000 to U+206F, which are invisible or
/// change the direction of text.
std::size_t lengthOfLetter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) {
        const char c = text[0];
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ? 1 : 0;
    }
    const std::size_t length = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
    if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < length) return 0;
    std::uint32_t code = byte(0) & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool isEncoded = code >= least[length] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    const bool isMark = code < 0xA1 || (code >= 0x2000 && code <= 0x206F) || code == 0xFEFF || code == 0x3000;
    return isEncoded && !isMark ? length : 0;
}

#ifdef _WIN32
bool mayWriteInto(const fs::path& folder) {
    return ::_waccess(folder.c_str(), W_OK) == 0;
}

int openLock(const fs::path& file) {
    int lock = -1;
    ::_wsopen_s(&lock, file.c_str(), _O_CREAT | _O_RDWR | _O_NOINHERIT | _O_TEMPORARY, _SH_DENYRW,
                _S_IREAD | _S_IWRITE);
    return lock;
}

bool isHeld(int error) {
    return error == EACCES;
}

bool isOurs(int) {
    return true;
}
#else
bool mayWriteInto(const fs::path& folder) {
    return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

int openLock(const fs::path& file) {
    return ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
}

bool isHeld(int) {
    return false;
}

// An unlinked file belonged to a run that has just ended; a third run may hold a new one.
bool isOurs(int lock) {
    struct stat status {};
    return ::flock(lock, LOCK_EX | LOCK_NB) == 0 && ::fstat(lock, &status) == 0 && status.st_nlink != 0;
}
#endif

} // namespace

TextOutput::TextOutput(std::string target) : target_(std::move(target)) {
    if (target_ == "-" || isSpecial(target_)) return;
    const fs::path file(target_);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code error;
    if (fs::is_directory(file, error)) fail(target_, "is a folder", "name a file");
    if (!fs::is_directory(folder, error)) fail(target_, "its folder does not exist", "make the folder first");
    if (!mayWriteInto(folder)) fail(target_, std::strerror(errno), "choose another folder");
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
    lock_ = openLock(lockFile_);
    if (lock_ < 0 && !isHeld(errno)) fail(folder_.string(), std::strerror(errno), "choose another folder");
    if (lock_ < 0 || !isOurs(lock_)) {
        if (lock_ >= 0) ::close(lock_);
        fail(folder_.string(), "another run writes there", "wait for it or choose another folder");
    }
}

OutputFolder::~OutputFolder() {
    std::error_code error;
    fs::remove(lockFile_, error); // not on Windows, which removes it when it is closed
    ::close(lock_);
}

std::string fileName(const std::string& name) {
    constexpr std::size_t mostBytes = 64;
    std::string result;
    for (std::string_view rest = name; !rest.empty();) {
        const std::size_t bytes = lengthOfLetter(rest);
        const std::string_view kept = bytes > 0 ? rest.substr(0, bytes) : std::string_view("_");
        if (result.size() + kept.size() > mostBytes) break;
        result += kept;
        rest.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    return result.empty() ? "body" : result;
}

} // namespace sinew::tools
