// Uses fork and exec, because a shell would hide signals and require quoted arguments.
#include "tools/program.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sinew::test {

namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

[[noreturn]] void become(const std::vector<std::string>& arguments, const Environment& environment,
                         const fs::path& folder, const fs::path& out, const fs::path& error) {
    for (const auto& [name, value] : environment)
        value.empty() ? ::unsetenv(name.c_str()) : ::setenv(name.c_str(), value.c_str(), 1);
    const bool isReady =
        ::chdir(folder.c_str()) == 0 &&
        ::dup2(::open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO) >= 0 &&
        ::dup2(::open(error.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO) >= 0;
    std::vector<char*> pointers{const_cast<char*>(SINEW_PROGRAM)};
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    if (isReady) ::execv(SINEW_PROGRAM, pointers.data());
    ::_exit(126);
}

} // namespace

Program::Program() {
    std::string name = (fs::temp_directory_path() / "sinew-program-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
}

Program::~Program() {
    fs::remove_all(folder_);
    for (const char* stream : {".out", ".error"}) fs::remove(folder_.string() + stream);
}

Outcome Program::run(const std::vector<std::string>& arguments, const Environment& environment,
                     const fs::path& signalWhen) const {
    const fs::path out = folder_.string() + ".out", error = errorFile();
    fs::remove(error);
    const auto isThere = [&](const fs::path& file) {
        std::error_code none;
        return fs::exists(file, none) && (file != error || fs::file_size(file, none) > 0);
    };
    const pid_t child = ::fork();
    if (child == 0) become(arguments, environment, folder_, out, error);
    int status = 0;
    pid_t ended = 0;
    if (!signalWhen.empty()) {
        while (!isThere(folder_ / signalWhen) && ended == 0) {
            ::usleep(10'000);
            ended = ::waitpid(child, &status, WNOHANG);
        }
        ::usleep(500'000);
        if (ended == 0) ::kill(child, SIGINT);
    }
    if (ended == 0) ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(error)};
}

nlohmann::json Program::report(std::vector<std::string> arguments, const Environment& environment,
                               int code) const {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = run(arguments, environment);
    EXPECT_EQ(outcome.code, code) << outcome.error;
    return nlohmann::json::parse(outcome.out, nullptr, false);
}

fs::path Program::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
}

std::vector<std::string> Program::files() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
        if (!entry.is_directory()) names.push_back(fs::relative(entry.path(), folder_).string());
    std::ranges::sort(names);
    return names;
}

void expectOneError(const Outcome& outcome, int code, const std::string& part) {
    EXPECT_EQ(outcome.code, code) << outcome.error;
    const std::size_t begin = outcome.error.find("error: ");
    ASSERT_NE(begin, std::string::npos) << outcome.error;
    EXPECT_TRUE(begin == 0 || outcome.error[begin - 1] == '\n') << outcome.error;
    EXPECT_EQ(outcome.error.find('\n', begin), outcome.error.size() - 1)
        << "more than one line: " << outcome.error;
    EXPECT_NE(outcome.error.find(part, begin), std::string::npos)
        << "lacks \"" << part << "\": " << outcome.error;
}

} // namespace sinew::test
