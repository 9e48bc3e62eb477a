// Atomic file writes, so that a file is the old or the new one, never half of it: temporary file in the same
// folder, flush, fsync, rename, fsync of the folder. Devices and pipes (/dev/stdout) cannot be replaced by a
// rename and are written directly.
#include "mesh/export.hpp"
#include "mesh/file_stream.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <ostream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace sinew::mesh {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
    const char* advice = "check the folder and its permissions";
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        advice = "free some space or choose another folder";
    else if (error == EISDIR)
        advice = "give the name of a file";
    throw ExportError("cannot write " + file.string() + ": " + std::strerror(error) + ": " + advice);
}

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (value_ >= 0) close(value_);
    }
    int get() const { return value_; }
    /// Closes with a result: some file systems report a full disk only here.
    int closeNow() { return close(std::exchange(value_, -1)); }

private:
    int value_;
};

/// A temporary file that is removed unless it was renamed to its final name.
class Temporary {
public:
    explicit Temporary(const fs::path& file) : descriptor_(create(file)) {}
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        if (!isRenamed_) unlink(path_.c_str());
    }
    Descriptor& descriptor() { return descriptor_; }
    void renameTo(const fs::path& file) {
        if (std::rename(path_.c_str(), file.c_str()) != 0) fail(file, errno);
        isRenamed_ = true;
    }

private:
    Descriptor create(const fs::path& file) {
        for (int attempt = 0;; ++attempt) {
            const std::string name = file.filename().string().substr(0, 200); // names have at most 255 bytes
            const std::string number = std::to_string(getpid()) + "-" + std::to_string(attempt);
            path_ = file.parent_path() / std::string(1, '.').append(name).append("." + number + ".tmp");
            const int descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor >= 0) return Descriptor(descriptor);
            if (errno != EEXIST || attempt == 100) fail(file, errno);
        }
    }

    fs::path path_;
    bool isRenamed_ = false;
    Descriptor descriptor_;
};

void writeTo(Descriptor& descriptor, const fs::path& file, const std::function<void(std::ostream&)>& write) {
    DescriptorBuffer buffer(descriptor.get());
    std::ostream stream(&buffer);
    write(stream);
    stream.flush();
    if (buffer.error() != 0) fail(file, buffer.error());
    if (!stream)
        throw ExportError("cannot write " + file.string() + ": its contents could not be made: report this");
}

void syncFolder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const Descriptor descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // A folder that may be written but not read cannot be synced; the file itself is safe already.
    if (descriptor.get() >= 0 && fsync(descriptor.get()) != 0 && errno != EINVAL) fail(file, errno);
}

} // namespace

void writeWhole(const fs::path& file, const std::function<void(std::ostream&)>& write) {
    std::error_code ignored;
    const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
    struct stat status {};
    const bool exists = stat(target.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail(file, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        Descriptor device(open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
        if (device.get() < 0) fail(file, errno);
        writeTo(device, file, write);
        return;
    }
    Temporary temporary(target);
    writeTo(temporary.descriptor(), file, write);
    if (fsync(temporary.descriptor().get()) != 0 || temporary.descriptor().closeNow() != 0) fail(file, errno);
    temporary.renameTo(target);
    syncFolder(target);
}

} // namespace sinew::mesh
