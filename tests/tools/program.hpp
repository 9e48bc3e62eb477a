// Runs the built program `sinew` in a folder of its own and returns the outcome.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sinew::test {

struct Outcome {
    int code = -1; ///< exit code, or 128 + signal
    std::string out, error;
};

/// Variables added to the program's environment; an empty value removes a variable.
using Environment = std::map<std::string, std::string>;

class Program : public testing::Test {
protected:
    Program();
    ~Program() override;

    /// Waits for the end of the program. Sends SIGINT shortly after the file `signalWhen` exists, if one is
    /// named; errorFile() exists as soon as it has contents.
    Outcome run(const std::vector<std::string>& arguments, const Environment& environment = {},
                const std::filesystem::path& signalWhen = {}) const;
    /// Runs `run SCENE --json -` and further arguments; fails the test unless the exit code is `code`.
    nlohmann::json report(std::vector<std::string> arguments, const Environment& environment = {},
                          int code = 0) const;

    std::filesystem::path write(const std::string& name, const std::string& text) const;
    /// Names of all files below the folder, relative to it.
    std::vector<std::string> files() const;

    /// The program's standard error, with its progress every 5 s.
    std::filesystem::path errorFile() const { return folder_.string() + ".error"; }

    std::filesystem::path folder_;
};

/// Expects exactly one line "error: ..." that contains `part`, and the exit code.
void expectOneError(const Outcome& outcome, int code, const std::string& part);

inline std::string shippedScene(const std::string& name) {
    return SINEW_SOURCE_FOLDER "/scenes/" + name + ".toml";
}

} // namespace sinew::test
