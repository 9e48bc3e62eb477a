// The command line: parses it, then runs the command under a guard that maps failures to exit codes.
#include "app/guard.hpp"
#include "app/thread_advice.hpp"
#include "scenes/suggestion.hpp"
#include "sinew/commands.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace {

using namespace sinew;

constexpr const char* description =
    R"(Soft bodies on any Vulkan device. Lengths in metres, times in seconds, masses in
kilograms; scenes are TOML (docs/scene-files.md), reports are JSON (docs/report.md).)";

constexpr const char* footer = R"(
Exit codes: 0 done, 2 wrong usage, 3 bad scene or mesh, 4 no usable device, 5 device lost or out of memory, 6 output
could not be written, 7 the simulation diverged, 70 a fault of ours, 130 interrupted (outputs are whole).
Run `sinew COMMAND --help` for the options of a command.)";

/// The name of the command that was mistyped, for the help.
std::string commandName(const CLI::App& app) {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? "sinew" : "sinew " + parsed.front()->get_name();
}

/// The sentence for arguments that cannot be taken.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    if (!app.get_subcommands().empty()) return error.what() + scenes::suggestion(app);
    const auto given = app.remaining(true);
    if (!given.empty())
        return (given.front().starts_with('-') ? "no option \"" : "no command \"") + given.front() + "\"" +
               scenes::suggestion(app);
    std::string names;
    for (const CLI::App* one : app.get_subcommands({}))
        names += (names.empty() ? "" : ", ") + one->get_name();
    return "name a command: " + names;
}

int parseAndRun(int argc, char** argv) {
    CLI::App app(description, "sinew");
    app.footer(footer);
    app.set_version_flag("--version", "sinew " SINEW_VERSION);
    app.require_subcommand(1);
    tools::Chosen chosen;
    for (const auto add : {tools::addRun, tools::addDescribe, tools::addMesh, tools::addDevices,
                           tools::addBench, tools::addStudy})
        add(app, chosen);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        throw app::Failure(app::wrongUsage, "wrong usage: " + complaint(app, error) + ": see `" +
                                                commandName(app) + " --help`");
    }
    return chosen();
}

} // namespace

int main(int argc, char** argv) {
    sinew::app::prepareThreadAdvice();
    return sinew::app::guarded([&] { return parseAndRun(argc, argv); });
}
