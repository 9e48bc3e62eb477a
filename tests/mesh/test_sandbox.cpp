// Tests of the child process for importers: the parent survives any child, waits no longer than the limit,
// and keeps no resource of the child.
#include "mesh/sandbox.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace sinew::mesh;

namespace {

std::string failureOf(const std::function<std::string()>& work, const ChildLimits& limits = {}) {
    try {
        runInChild(work, limits);
    } catch (const ChildFailure& failure) {
        return failure.what();
    }
    return "no failure";
}

std::size_t openDescriptors() {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

std::string hang() {
    for (;;) pause();
}

std::string crash() {
    raise(SIGSEGV);
    return "";
}

void countSignal(int) {}

} // namespace

TEST(Sandbox, ReturnsWhatTheWorkReturned) {
    EXPECT_EQ(runInChild([] { return std::string(); }, {}), "");
    EXPECT_EQ(runInChild([] { return std::string("a\0b", 3); }, {}), std::string("a\0b", 3));
    const std::string large = runInChild([] { return std::string(20'000'000, 'x') + "end"; }, {});
    EXPECT_EQ(large.size(), 20'000'003u);
    EXPECT_TRUE(large.ends_with("xend"));
}

TEST(Sandbox, ReportsACrash) {
    EXPECT_EQ(failureOf(crash), "it crashed (signal 11)");
    EXPECT_EQ(failureOf([]() -> std::string { std::abort(); }), "it crashed (signal 6)");
    EXPECT_EQ(failureOf([]() -> std::string { throw std::runtime_error("no"); }),
              "it ended without an answer (status 13)");
    EXPECT_EQ(failureOf([]() -> std::string { _exit(0); }), "it ended without an answer (status 0)");
    EXPECT_EQ(failureOf([]() -> std::string { throw std::bad_alloc(); }),
              "it needs more than 1024 MiB of memory");
}

TEST(Sandbox, KillsAChildThatHangs) {
    EXPECT_EQ(failureOf(hang, {.wallSeconds = 0.05}), "it took longer than 0.05 s");
    EXPECT_EQ(failureOf(
                  [] {
                      close(3); // looks like the end, but the child continues
                      return hang();
                  },
                  {.wallSeconds = 0.05}),
              "it took longer than 0.05 s");
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
    EXPECT_EQ(errno, ECHILD);
}

TEST(Sandbox, KillsAChildThatBurnsTime) {
    const auto burn = []() -> std::string {
        for (std::atomic<unsigned> i = 0;; ++i) {
        }
    };
    EXPECT_EQ(failureOf(burn, {.cpuSeconds = 1, .wallSeconds = 60}), "it took more than 1 s of CPU time");
}

TEST(Sandbox, LimitsMemoryBeyondWhatTheParentHolds) {
    const auto map = [](std::size_t bytes) {
        return runInChild(
            [bytes]() -> std::string {
                return mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED
                           ? "refused"
                           : "given";
            },
            {.addressSpaceBytes = 64 << 20});
    };
    EXPECT_EQ(map(32 << 20), "given");
    EXPECT_EQ(map(128 << 20), "refused");
}

TEST(Sandbox, GivesTheChildNoFiles) {
    const int file = open("/proc/self/status", O_RDONLY), secret = fcntl(file, F_DUPFD, 20);
    close(file);
    ASSERT_GE(secret, 20);
    const std::string answer = runInChild(
        [secret]() -> std::string {
            char byte = 0;
            const bool isInherited = read(secret, &byte, 1) >= 0;
            const bool opens = open("/dev/null", O_RDONLY) >= 0 || open("/proc/self/status", O_RDONLY) >= 0;
            return std::string(isInherited ? "inherited " : "") + (opens ? "opened" : "nothing");
        },
        {});
    close(secret);
    EXPECT_EQ(answer, "nothing");
}

TEST(Sandbox, RefusesAnAnswerThatIsTooLong) {
    EXPECT_EQ(failureOf([] { return std::string(5'000'000, 'x'); }, {.answerBytes = 1'000'000}),
              "its answer of 5000000 bytes is too long");
    const auto lie = []() -> std::string { // announces a long answer, sends a short one
        const std::uint64_t size = 1'000'000;
        const bool isWritten = write(3, &size, sizeof size) == sizeof size && write(3, "short", 5) == 5;
        _exit(isWritten ? 0 : 1);
    };
    EXPECT_EQ(failureOf(lie), "it ended without an answer (status 0)");
}

TEST(Sandbox, LeavesNoDescriptorAndNoZombie) {
    const std::size_t before = openDescriptors();
    for (int i = 0; i < 10; ++i) {
        failureOf(crash);
        failureOf(hang, {.wallSeconds = 0.001});
        runInChild([] { return std::string("x"); }, {});
    }
    EXPECT_EQ(openDescriptors(), before);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(Sandbox, RunsWithoutTheParentsSignalHandlers) {
    struct sigaction action {
    }, before{};
    action.sa_handler = countSignal;
    sigaction(SIGTERM, &action, &before);
    const auto terminate = []() -> std::string {
        raise(SIGTERM);
        return "survived";
    };
    EXPECT_EQ(failureOf(terminate), "it crashed (signal 15)");
    sigaction(SIGTERM, &before, nullptr);
}

TEST(Sandbox, AnswersWhereTheHostIgnoresItsChildren) {
    struct sigaction action {
    }, before{};
    action.sa_handler = SIG_IGN; // the system reaps the children
    sigaction(SIGCHLD, &action, &before);
    EXPECT_EQ(runInChild([] { return std::string("x"); }, {}), "x");
    EXPECT_NE(failureOf(crash), "no failure");
    sigaction(SIGCHLD, &before, nullptr);
}

TEST(Sandbox, ServesManyThreadsAtOnce) {
    std::atomic<int> right = 0;
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&right, thread] {
            for (int i = 0; i < 5; ++i) {
                const std::string expected(1000 * (thread + 1), static_cast<char>('a' + thread));
                right += runInChild([&] { return expected; }, {}) == expected ? 1 : 0;
            }
        });
    threads.clear();
    EXPECT_EQ(right, 20);
}
