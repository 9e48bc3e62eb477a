// Tests of app/guard: each kind of failure has its exit code and writes one line to stderr.
#include "app/guard.hpp"

#include "mesh/export.hpp"
#include "scenes/load.hpp"
#include "sinew/vk/check.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <new>

using namespace sinew;

namespace {

struct Outcome {
    int code;
    std::string error;
};

Outcome outcomeOf(const std::function<int()>& body) {
    testing::internal::CaptureStderr();
    const int code = app::guarded(body);
    return {code, testing::internal::GetCapturedStderr()};
}

template <typename Error> Outcome outcomeOf(const Error& error) {
    return outcomeOf(std::function<int()>([&]() -> int { throw error; }));
}

void expect(const Outcome& outcome, int code, const std::string& error) {
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(outcome.error, error);
}

} // namespace

TEST(Guard, PassesAResultOn) {
    expect(outcomeOf(std::function<int()>([] { return 0; })), 0, "");
    expect(outcomeOf(std::function<int()>([] { return 130; })), 130, "");
}

TEST(Guard, GivesEveryFailureItsCodeAndOneLine) {
    expect(outcomeOf(app::Failure(app::wrongUsage, "a: b")), 2, "error: a: b\n");
    expect(outcomeOf(scenes::SceneError("a")), 3, "error: a\n");
    expect(outcomeOf(mesh::ImportError("a")), 3, "error: a\n");
    expect(outcomeOf(vk::Error(vk::Failure::noDevice, "a")), 4, "error: a\n");
    expect(outcomeOf(vk::Error(vk::Failure::outOfMemory, "a")), 5, "error: a\n");
    expect(outcomeOf(vk::Error(vk::Failure::deviceLost, "a")), 5, "error: a\n");
    expect(outcomeOf(std::bad_alloc()), 5, "error: out of memory: make the scene smaller\n");
    expect(outcomeOf(mesh::ExportError("a")), 6, "error: a\n");
    expect(outcomeOf(app::Failure(app::diverged, "a")), 7, "error: a\n");
    expect(outcomeOf(vk::Error(vk::Failure::misuse, "a")), 70, "error: a\n");
    expect(outcomeOf(std::logic_error("a")), 70, "error: internal fault: a: please report it\n");
    expect(outcomeOf(5), 70, "error: internal fault: an unknown exception: please report it\n");
}

TEST(Guard, KeepsAMessageOnOneLine) {
    expect(outcomeOf(app::Failure(app::badInput, "a\nb\r\033[1mc\x7f")), 3, "error: a b  [1mc \n");
}

TEST(Signals, SetAFlagAndLetTheProcessGoOn) {
    auto* const before = std::signal(SIGHUP, SIG_DFL); // nohup, which may run the tests, ignores it
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        app::catchSignals();
        EXPECT_FALSE(app::isInterrupted());
        std::raise(signal);
        EXPECT_TRUE(app::isInterrupted());
    }
    app::catchSignals(); // or the next signal would end this process
    std::signal(SIGHUP, before);
}

// nohup ignores SIGHUP in the same way.
TEST(Signals, OfATerminalThatGoesAreIgnoredWhereTheyWere) {
    auto* const before = std::signal(SIGHUP, SIG_IGN);
    app::catchSignals();
    std::raise(SIGHUP);
    EXPECT_FALSE(app::isInterrupted());
    std::signal(SIGHUP, before);
}

TEST(Signals, EndTheProcessTheSecondTime) {
    EXPECT_EXIT(
        {
            app::catchSignals();
            std::raise(SIGINT);
            std::raise(SIGINT);
        },
        testing::KilledBySignal(SIGINT), "");
}

namespace {

// Works for `seconds` without checking for signals.
void workFor(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
    }
}

} // namespace

TEST(Signals, EndWhatDoesNotComeToAnEndWithinTwoSeconds) {
    EXPECT_EXIT(
        {
            app::catchSignals();
            std::raise(SIGTERM);
            workFor(2);
            std::_Exit(7); // the handler did not end the process within 2 s
        },
        testing::ExitedWithCode(130), "error: interrupted: .* did not end within 2 s");
}

// The exit code is that of a fault if the validation layer reported anything, as at the end of a program.
TEST(Signals, SayThatTheValidationLayerHasComplained) {
    static std::atomic<std::size_t> messages = 0;
    app::watchMessages(&messages);
    EXPECT_EXIT(app::leaveInterrupted("interrupted: a"), testing::ExitedWithCode(130),
                "^error: interrupted: a\n$");
    messages = 3;
    EXPECT_EXIT(app::leaveInterrupted("interrupted: a"), testing::ExitedWithCode(70),
                "^error: interrupted: a\nerror: the validation layer complained: 3 messages above: ");
    EXPECT_EXIT(
        {
            app::catchSignals();
            std::raise(SIGTERM);
            workFor(30);
        },
        testing::ExitedWithCode(70), "did not end within 2 s.*\nerror: the validation layer complained: ");
    app::watchMessages(nullptr);
}

TEST(Signals, LetOutputsBeWrittenForAsLongAsTheyTake) {
    EXPECT_EXIT(
        {
            app::catchSignals();
            const app::Writing writing;
            std::raise(SIGTERM);
            workFor(2.5);
            std::_Exit(7);
        },
        testing::ExitedWithCode(7), "^$");
}

TEST(Signals, EndWhatTakesLongOnceOutputsAreWritten) {
    EXPECT_EXIT(
        {
            app::catchSignals();
            {
                const app::Writing writing;
                std::raise(SIGTERM);
            }
            workFor(30);
        },
        testing::ExitedWithCode(130), "did not end within 2 s");
}
