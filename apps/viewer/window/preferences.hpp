// What a user has chosen in the window, kept from one run to the next in $XDG_CONFIG_HOME/sinew/viewer.conf.
// Never needed: of a file that is missing, or that nobody understands, all that is lost is what it said.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Preferences {
    static constexpr std::uint32_t smallest = 64, largest = 8192; ///< sides of a window [pixels]
    static constexpr float leastScale = 0.5f, mostScale = 4;
    std::uint32_t width = 0, height = 0; ///< of the window; 0 = nobody has chosen
    std::optional<bool> arePanelsShown;
    float scale = 1; ///< of texts and panels, on top of what the screen asks for
    bool isVsync = true;
    std::string scene; ///< the last one on show: a file's path from the root, or the name of a built-in one
    bool operator==(const Preferences&) const = default;
};

/// "key = value" a line.
std::string toText(const Preferences& preferences);
/// What the text leaves out is as it was without; so is what a line says that makes no sense, and
/// `complaints` has "line 3: ..." of each.
Preferences parsePreferences(const std::string& text, std::vector<std::string>& complaints);

/// As the XDG base directory specification says, or where `home` is; empty where neither is an absolute path.
/// Null = not set.
std::filesystem::path preferencesFile(const char* xdgConfigHome, const char* home);
/// Of this process's environment.
std::filesystem::path preferencesFile();

/// What is wrong with the file costs a line on stderr.
Preferences loadPreferences(const std::filesystem::path& file);
/// Whole or not at all; what goes wrong costs a line on stderr. Nothing for an empty path.
void savePreferences(const std::filesystem::path& file, const Preferences& preferences);

/// How Preferences::scene names a file, or one built in where `file` is empty; empty where no line can hold
/// it.
std::string rememberedScene(const std::string& file, const std::string& builtIn);

} // namespace sinew::viewer
