// Preferences of the window, kept between runs in $XDG_CONFIG_HOME/sinew/viewer.conf. A missing file or an
// unreadable line only loses its own values.
#pragma once

#include "viewer/ui/folds.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Preferences {
    static constexpr std::uint32_t smallest = 64, largest = 8192; ///< sides of a window [pixels]
    static constexpr float leastScale = 0.5f, mostScale = 4;
    std::uint32_t width = 0, height = 0; ///< of the window; 0 = not chosen
    std::optional<bool> arePanelsShown;
    Folds folded = foldedAtFirst; ///< sections of the panel
    float scale = 1;              ///< of texts and panels, times the scale of the screen
    bool isVsync = true;
    std::string scene; ///< the last scene on show: absolute path of a file, or name of a built-in scene
    static constexpr std::size_t mostRecent = 6;
    std::vector<std::string> recent; ///< absolute paths of files opened last, newest first
    bool operator==(const Preferences&) const = default;
};

/// One "key = value" per line.
std::string toText(const Preferences& preferences);
/// Values that the text omits, or gives invalid, keep their defaults; `complaints` gets "line 3: ..." for
/// each invalid line.
Preferences parsePreferences(const std::string& text, std::vector<std::string>& complaints);

/// Path by the XDG base directory specification, or below `home`; empty if neither is an absolute path. Null
/// = not set.
std::filesystem::path preferencesFile(const char* xdgConfigHome, const char* home);
/// Path for the environment of this process.
std::filesystem::path preferencesFile();

/// Errors in the file cost a line on stderr.
Preferences loadPreferences(const std::filesystem::path& file);
/// Writes the whole file or none; an error costs a line on stderr. Does nothing for an empty path.
void savePreferences(const std::filesystem::path& file, const Preferences& preferences);

/// Name of a file in Preferences::scene, or of a built-in scene if `file` is empty; empty if it does not fit
/// into a line.
std::string rememberedScene(const std::string& file, const std::string& builtIn);

} // namespace sinew::viewer
