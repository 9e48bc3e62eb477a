// Runs the built program `sinew` in a folder of its own and says what came of it.
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

/// Added to the environment of the program; an empty value removes the variable.
using Environment = std::map<std::string, std::string>;

class Program : public testing::Test {
protected:
    Program();
    ~Program() override;

    /// Waits for the end. Sends SIGINT a moment after the file `signalWhen` exists, where one is named;
    /// errorFile() exists as soon as something is in it.
    Outcome run(const std::vector<std::string>& arguments, const Environment& environment = {},
                const std::filesystem::path& signalWhen = {}) const;
    /// `run SCENE --json -` and more; fails the test unless it ends with `code`.
    nlohmann::json report(std::vector<std::string> arguments, const Environment& environment = {},
                          int code = 0) const;

    std::filesystem::path write(const std::string& name, const std::string& text) const;
    /// Names of all files below the folder, without the folder.
    std::vector<std::string> files() const;

    /// The program's standard error: its progress, every 5 s.
    std::filesystem::path errorFile() const { return folder_.string() + ".error"; }

    std::filesystem::path folder_;
};

/// One line "error: ..." and nothing of the kind beside it.
void expectOneError(const Outcome& outcome, int code, const std::string& part);

inline std::string shippedScene(const std::string& name) {
    return SINEW_SOURCE_FOLDER "/scenes/" + name + ".toml";
}

} // namespace sinew::test
