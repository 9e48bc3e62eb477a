// The child sends its answer as a length in 8 bytes, then the bytes; anything else is a failure. Signals are
// blocked over the fork so that no handler of the parent ever runs in the child.
#include "mesh/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace sinew::mesh {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int answerDescriptor = 3; ///< in the child
constexpr int exitOutOfMemory = 12, exitException = 13, exitSetUp = 14;

/// Values for the child, gathered before the fork.
struct Preparation {
    int answerPipe = -1;
    pid_t parent = 0;
    rlim_t addressSpace = 0, cpuSeconds = 0;
};

bool limitTo(int resource, rlim_t soft, rlim_t hard) {
    const rlimit limit{soft, hard};
    return setrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) == 0;
}

/// Closes all descriptors except the answer pipe: no file, device or socket of the parent reaches the
/// importer.
bool closeDescriptors(int answerPipe) {
    const int pipe = fcntl(answerPipe, F_DUPFD, 10); // above the numbers used below
    const int null = open("/dev/null", O_RDWR);
    if (pipe < 0 || null < 0) return false;
    for (int descriptor = 0; descriptor < answerDescriptor; ++descriptor)
        if (dup2(null, descriptor) < 0) return false;
    return dup2(pipe, answerDescriptor) >= 0 && close_range(answerDescriptor + 1, ~0u, 0) == 0;
}

void resetSignals() {
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    for (int signal = 1; signal < NSIG; ++signal)
        sigaction(signal, &action, nullptr); // fails for SIGKILL and SIGSTOP, harmlessly
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

bool confine(const Preparation& preparation) {
    resetSignals();
    return prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == preparation.parent &&
           closeDescriptors(preparation.answerPipe) &&
           limitTo(RLIMIT_AS, preparation.addressSpace, preparation.addressSpace) &&
           limitTo(RLIMIT_CPU, preparation.cpuSeconds, preparation.cpuSeconds + 1) &&
           limitTo(RLIMIT_CORE, 0, 0) && limitTo(RLIMIT_FSIZE, 0, 0) && limitTo(RLIMIT_NOFILE, 0, 0);
}

bool writeAll(const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t written = write(answerDescriptor, bytes, size);
        if (written < 0 && errno != EINTR) return false;
        bytes += std::max<ssize_t>(written, 0);
        size -= static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    }
    return true;
}

[[noreturn]] void runChild(const Preparation& preparation,
                           const std::function<std::string()>& work) noexcept {
    if (!confine(preparation)) _exit(exitSetUp);
    try {
        const std::string answer = work();
        std::array<char, 8> length{};
        const std::uint64_t size = answer.size();
        std::memcpy(length.data(), &size, length.size());
        _exit(writeAll(length.data(), length.size()) && writeAll(answer.data(), answer.size()) ? 0
                                                                                               : exitSetUp);
    } catch (const std::bad_alloc&) {
        _exit(exitOutOfMemory);
    } catch (...) {
        _exit(exitException);
    }
}

std::string toText(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + " s";
}

/// Owns a child process and the pipe from it; kills the child and closes the pipe.
class Child {
public:
    Child(pid_t process, int pipe, Clock::time_point deadline)
        : process_(process), pipe_(pipe), deadline_(deadline) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        close(pipe_);
        if (process_ > 0) {
            kill(process_, SIGKILL);
            reap(0);
        }
    }

    /// Reads up to `size` bytes; fewer only at the end of the pipe.
    std::size_t read(char* bytes, std::size_t size, const ChildLimits& limits) {
        std::size_t done = 0;
        while (done < size) {
            waitForBytes(limits);
            const ssize_t count = ::read(pipe_, bytes + done, size - done);
            if (count == 0) break;
            if (count > 0)
                done += static_cast<std::size_t>(count);
            else if (errno != EINTR && errno != EAGAIN)
                throw ChildFailure(std::string("its answer cannot be read (") + std::strerror(errno) + ")");
        }
        return done;
    }

    /// Throws the reason for which the answer was cut short.
    [[noreturn]] void fail(const ChildLimits& limits) {
        while (!reap(WNOHANG)) {
            checkDeadline(limits);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (WIFSIGNALED(status_) && WTERMSIG(status_) == SIGXCPU)
            throw ChildFailure("it took more than " + toText(limits.cpuSeconds) + " of CPU time");
        if (WIFSIGNALED(status_))
            throw ChildFailure("it crashed (signal " + std::to_string(WTERMSIG(status_)) + ")");
        if (WEXITSTATUS(status_) == exitOutOfMemory)
            throw ChildFailure("it needs more than " + std::to_string(limits.addressSpaceBytes >> 20) +
                               " MiB of memory");
        throw ChildFailure("it ended without an answer (status " + std::to_string(WEXITSTATUS(status_)) +
                           ")");
    }

private:
    void checkDeadline(const ChildLimits& limits) const {
        if (Clock::now() >= deadline_)
            throw ChildFailure("it took longer than " + toText(limits.wallSeconds));
    }

    void waitForBytes(const ChildLimits& limits) {
        for (;;) {
            checkDeadline(limits);
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
            pollfd descriptor{pipe_, POLLIN, 0};
            if (poll(&descriptor, 1, static_cast<int>(std::clamp<long long>(left, 0, 1'000'000))) > 0) return;
        }
    }

    /// True if the child has ended, also if the host reaps all children itself.
    bool reap(int options) {
        pid_t result = 0;
        do result = waitpid(process_, &status_, options);
        while (result < 0 && errno == EINTR);
        if (result != 0) process_ = 0;
        return result != 0;
    }

    pid_t process_;
    int pipe_;
    Clock::time_point deadline_;
    int status_ = 0;
};

std::uint64_t mappedBytes() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    if (pages == 0) throw ChildFailure("its memory cannot be limited (/proc is not mounted)");
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

pid_t forkWithSignalsBlocked(Preparation& preparation, const std::function<std::string()>& work) {
    sigset_t all, before;
    sigfillset(&all);
    preparation.parent = getpid();
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t process = fork();
    if (process == 0) runChild(preparation, work);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return process;
}

} // namespace

std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits) {
    Preparation preparation{.addressSpace = mappedBytes() + limits.addressSpaceBytes,
                            .cpuSeconds = static_cast<rlim_t>(std::max(1.0, std::ceil(limits.cpuSeconds)))};
    std::array<int, 2> pipe{};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0)
        throw ChildFailure(std::string("no pipe can be opened (") + std::strerror(errno) + ")");
    preparation.answerPipe = pipe[1];
    const auto wall = std::chrono::duration<double>(std::clamp(limits.wallSeconds, 0.0, 1e6));
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(wall);
    const pid_t process = forkWithSignalsBlocked(preparation, work);
    const int forkError = errno;
    close(pipe[1]);
    if (process < 0) {
        close(pipe[0]);
        throw ChildFailure(std::string("no process can be started (") + std::strerror(forkError) + ")");
    }

    Child child(process, pipe[0], deadline);
    std::uint64_t size = 0;
    std::array<char, 8> length{};
    if (child.read(length.data(), length.size(), limits) < length.size()) child.fail(limits);
    std::memcpy(&size, length.data(), length.size());
    if (size > limits.answerBytes)
        throw ChildFailure("its answer of " + std::to_string(size) + " bytes is too long");
    std::string answer(size, '\0');
    if (child.read(answer.data(), size, limits) < size) child.fail(limits);
    return answer;
}

} // namespace sinew::mesh
