// Atomic file writes, so that a file is the old or the new one, never half of it: temporary file in the same
// folder, flush, fsync, rename, fsync of the folder (not on Windows, whose folders cannot be flushed).
// Devices and pipes (/dev/stdout) cannot be replaced by a rename and are written directly.
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

#ifdef _WIN32
#include <io.h>
#endif

namespace sinew::mesh {
namespace {

namespace fs = std::filesystem;

#ifdef _WIN32
constexpr int outOfQuota = ENOSPC;
constexpr int toNewFile = _O_WRONLY | _O_CREAT | _O_EXCL, toDevice = _O_WRONLY;

int openFile(const fs::path& file, int flags) {
    return _wopen(file.c_str(), flags | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

int flushToDisk(int descriptor) {
    return _commit(descriptor);
}
#else
constexpr int outOfQuota = EDQUOT;
constexpr int toNewFile = O_WRONLY | O_CREAT | O_EXCL, toDevice = O_WRONLY | O_NOCTTY;

int openFile(const fs::path& file, int flags) {
    return open(file.c_str(), flags | O_CLOEXEC, 0666);
}

int flushToDisk(int descriptor) {
    return fsync(descriptor);
}
#endif

[[noreturn]] void fail(const fs::path& file, int error) {
    const char* advice = "check the folder and its permissions";
    if (error == ENOSPC || error == outOfQuota || error == EFBIG)
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
        std::error_code ignored;
        if (!isRenamed_) fs::remove(path_, ignored);
    }
    Descriptor& descriptor() { return descriptor_; }
    void renameTo(const fs::path& file) {
        std::error_code error;
        fs::rename(path_, file, error); // over a file that exists, also on Windows
        if (error) fail(file, error.default_error_condition().value());
        isRenamed_ = true;
    }

private:
    Descriptor create(const fs::path& file) {
        for (int attempt = 0;; ++attempt) {
            const std::string name = file.filename().string().substr(0, 200); // names have at most 255 bytes
            const std::string number = std::to_string(getpid()) + "-" + std::to_string(attempt);
            path_ = file.parent_path() / std::string(1, '.').append(name).append("." + number + ".tmp");
            const int descriptor = openFile(path_, toNewFile);
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

#ifdef _WIN32
void syncFolder(const fs::path&) {}
#else
void syncFolder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const Descriptor descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // A folder that may be written but not read cannot be synced; the file itself is safe already.
    if (descriptor.get() >= 0 && fsync(descriptor.get()) != 0 && errno != EINVAL) fail(file, errno);
}
#endif

} // namespace

void writeWhole(const fs::path& file, const std::function<void(std::ostream&)>& write) {
    std::error_code ignored;
    const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) fail(file, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        Descriptor device(openFile(target, toDevice));
        if (device.get() < 0) fail(file, errno);
        writeTo(device, file, write);
        return;
    }
    Temporary temporary(target);
    writeTo(temporary.descriptor(), file, write);
    if (flushToDisk(temporary.descriptor().get()) != 0 || temporary.descriptor().closeNow() != 0)
        fail(file, errno);
    temporary.renameTo(target);
    syncFolder(target);
}

} // namespace sinew::mesh
