// The text of a scene file and the errors that point into it.
#pragma once

#include "scenes/load.hpp"

#include <toml++/toml.h>

namespace sinew::scenes {

/// Throws SceneError with "cannot read scene: <where>: <why>: <what to do>". Control characters, which a
/// hostile file could put into a message, become '?'.
[[noreturn]] void fail(const std::string& where, const std::string& why, const std::string& whatToDo);

/// "<file>:<line>".
std::string lineOf(const std::string& file, const toml::source_region& region);

/// Throws SceneError unless `path` is a regular file: no folder, FIFO or device.
void requireRegularFile(const std::filesystem::path& path);

/// The whole text of a regular file of at most 16 MiB.
std::string readText(const std::filesystem::path& path);

/// `file` is the name that errors show. Refuses what would make the parser recurse too deeply.
toml::table parse(const std::string& text, const std::string& file);

} // namespace sinew::scenes
