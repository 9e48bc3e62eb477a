// Reads and parses under limits, so that no file can hang the process or overflow its stack.
#include "scenes/source_file.hpp"

#include "scenes/schema.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace sinew::scenes {

namespace {

constexpr std::uintmax_t mostBytes = 16u << 20;

// Every dot of a key opens a table, and tables are parsed and freed recursively. toml++ bounds the nesting of
// brackets (TOML_MAX_NESTED_VALUES, 32 here) but not that of keys, which cannot run over the end of a line.
constexpr std::ptrdiff_t mostDotsInLine = 200;

void checkDots(const std::string& text, const std::string& file) {
    std::size_t number = 1;
    for (auto begin = text.begin(); begin != text.end(); ++number) {
        auto end = std::find(begin, text.end(), '\n');
        if (std::count(begin, end, '.') > mostDotsInLine)
            fail(file + ":" + std::to_string(number),
                 "more than " + std::to_string(mostDotsInLine) + " dots in one line", "split the line");
        begin = end == text.end() ? end : end + 1;
    }
}

// The advice on a file that is not there: names the file beside it that is spelled most like it, with its
// extension or without.
std::string cureOfMissing(const std::filesystem::path& path) {
    constexpr std::size_t mostFiles = 10'000; // of a folder: more take too long to read
    namespace fs = std::filesystem;
    const std::string name = path.filename().string().substr(0, 64);
    const fs::path folder = path.parent_path();
    std::string nearest;
    std::size_t least = std::max<std::size_t>(name.size() / 4, 1) + 1, read = 0; // edits
    std::error_code error;
    fs::directory_iterator files(folder.empty() ? "." : folder, error);
    for (; !error && files != fs::directory_iterator() && read < mostFiles; files.increment(error), ++read) {
        const fs::path file = files->path().filename();
        const std::size_t edits =
            std::min(editDistance(name, file.string().substr(0, 64)),
                     std::max<std::size_t>(editDistance(name, file.stem().string().substr(0, 64)), 1));
        std::error_code unread;
        if (edits > least || (edits == least && (nearest.empty() || file.string() > nearest))) continue;
        if (!fs::is_regular_file(files->path(), unread)) continue;
        least = edits;
        nearest = file.string();
    }
    return nearest.empty() ? "check the path" : "did you mean " + (folder / nearest).string() + "?";
}

} // namespace

void fail(const std::string& where, const std::string& why, const std::string& whatToDo) {
    std::string message = "cannot read scene: " + where + ": " + why + ": " + whatToDo;
    std::ranges::replace_if(
        message, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, '?');
    throw SceneError(message);
}

std::string lineOf(const std::string& file, const toml::source_region& region) {
    return file + ":" + std::to_string(region.begin.line);
}

void requireRegularFile(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    const std::string name = path.string();
    if (status.type() == std::filesystem::file_type::not_found)
        fail(name, "no such file", cureOfMissing(path));
    if (status.type() == std::filesystem::file_type::none) fail(name, error.message(), "check the path");
    if (status.type() == std::filesystem::file_type::directory)
        fail(name, "is a folder", "name a file in it");
    if (status.type() != std::filesystem::file_type::regular)
        fail(name, "is not a regular file", "name a scene or mesh file");
}

std::string readText(const std::filesystem::path& path) {
    requireRegularFile(path);
    std::ifstream stream(path, std::ios::binary);
    if (!stream) fail(path.string(), std::strerror(errno), "check its permissions");
    // Read to the limit instead of trusting the size: files below /proc have none.
    std::string text(mostBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) fail(path.string(), "reading failed", "check the disk");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > mostBytes) fail(path.string(), "is larger than 16 MiB", "name a scene file");
    return text;
}

toml::table parse(const std::string& text, const std::string& file) {
    checkDots(text, file);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        fail(lineOf(file, error.source()), std::string(error.description()), "correct the line");
    }
}

} // namespace sinew::scenes
