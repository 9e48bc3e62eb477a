// One table of keys serves reading and writing.
#include "viewer/ui/preferences.hpp"

#include "mesh/export.hpp"
#include "viewer/render/legend.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace sinew::viewer {

namespace {

bool truthIn(const std::string& value) {
    if (value != "true" && value != "false") throw std::runtime_error(value + " is neither true nor false");
    return value == "true";
}

template <typename Number> Number numberIn(const std::string& value, Number low, Number high) {
    Number number{};
    const char* end = value.data() + value.size();
    const auto [after, error] = std::from_chars(value.data(), end, number);
    if (error == std::errc() && after == end && number >= low && number <= high) return number;
    std::ostringstream why;
    why << value << " is not a number from " << low << " to " << high;
    throw std::runtime_error(why.str());
}

std::uint32_t sideIn(const std::string& value) {
    return numberIn(value, Preferences::smallest, Preferences::largest);
}

const char* text(bool truth) {
    return truth ? "true" : "false";
}

std::string text(float number) {
    std::array<char, 32> digits{};
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    return {digits.data(), written.ptr};
}

// Values of a key that may stand in several lines.
std::string lines(const std::string& key, const std::vector<std::string>& values) {
    std::string all;
    for (const std::string& value : values) all.append(all.empty() ? "" : "\n" + key + " = ").append(value);
    return all;
}

struct Key {
    std::string_view name;
    void (*read)(Preferences&, const std::string& value);
    std::string (*write)(const Preferences&); // empty = not chosen
};

const std::array keys{
    Key{"scene", [](Preferences& to, const std::string& value) { to.scene = value; },
        [](const Preferences& of) { return of.scene; }},
    Key{"recent",
        [](Preferences& to, const std::string& value) {
            if (to.recent.size() < Preferences::mostRecent) to.recent.push_back(value);
        },
        [](const Preferences& of) { return lines("recent", of.recent); }},
    Key{"width", [](Preferences& to, const std::string& value) { to.width = sideIn(value); },
        [](const Preferences& of) { return of.width > 0 ? std::to_string(of.width) : ""; }},
    Key{"height", [](Preferences& to, const std::string& value) { to.height = sideIn(value); },
        [](const Preferences& of) { return of.height > 0 ? std::to_string(of.height) : ""; }},
    Key{"panels", [](Preferences& to, const std::string& value) { to.arePanelsShown = truthIn(value); },
        [](const Preferences& of) { return std::string(of.arePanelsShown ? text(*of.arePanelsShown) : ""); }},
    Key{"folded", [](Preferences& to, const std::string& value) { to.folded = foldsIn(value); },
        [](const Preferences& of) { return toText(of.folded); }},
    Key{"scale",
        [](Preferences& to, const std::string& value) {
            to.scale = numberIn(value, Preferences::leastScale, Preferences::mostScale);
        },
        [](const Preferences& of) { return text(of.scale); }},
    Key{"vsync", [](Preferences& to, const std::string& value) { to.isVsync = truthIn(value); },
        [](const Preferences& of) { return std::string(text(of.isVsync)); }}};

std::string trimmed(const std::string& text) {
    constexpr const char* blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

void readLine(const std::string& line, Preferences& preferences) {
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') return;
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw std::runtime_error("this is not key = value");
    const std::string name = trimmed(text.substr(0, equals));
    const auto* key = std::ranges::find(keys, name, &Key::name);
    if (key == keys.end()) throw std::runtime_error("there is no setting of this name");
    key->read(preferences, trimmed(text.substr(equals + 1)));
}

// Warns on stderr; replaces control bytes, which a terminal should not get, by question marks.
void warn(const std::filesystem::path& file, const std::string& why) {
    std::string line = "warning: settings in " + file.string() + ": " + why;
    std::ranges::replace_if(
        line, [](char one) { return static_cast<unsigned char>(one) < 0x20; }, '?');
    std::fprintf(stderr, "%s\n", line.c_str());
}

std::string readWhole(const std::filesystem::path& file) {
    constexpr std::uintmax_t most = 64 * 1024; // a larger file is not ours
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) > most)
        throw std::runtime_error("this is not a settings file: it is ignored");
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream && !stream.eof()) throw std::runtime_error("it cannot be read");
    return text.str();
}

} // namespace

std::string toText(const Preferences& preferences) {
    std::string text = "# Preferences of sinew-viewer, which writes this file when it ends.\n";
    for (const Key& key : keys)
        if (const std::string value = key.write(preferences); !value.empty())
            text.append(key.name).append(" = ").append(value).append("\n");
    return text;
}

Preferences parsePreferences(const std::string& text, std::vector<std::string>& complaints) {
    Preferences preferences;
    std::istringstream lines(text);
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
        try {
            readLine(line, preferences);
        } catch (const std::runtime_error& error) {
            complaints.push_back("line " + std::to_string(number) + ": " + error.what());
        }
    }
    return preferences;
}

std::filesystem::path preferencesFile(const char* xdgConfigHome, const char* home) {
    const auto isAbsolute = [](const char* path) { return path != nullptr && path[0] == '/'; };
    std::filesystem::path folder;
    if (isAbsolute(xdgConfigHome))
        folder = xdgConfigHome;
    else if (isAbsolute(home))
        folder = std::filesystem::path(home) / ".config";
    return folder.empty() ? folder : folder / "sinew" / "viewer.conf";
}

std::filesystem::path preferencesFile() {
    return preferencesFile(std::getenv("XDG_CONFIG_HOME"), std::getenv("HOME"));
}

Preferences loadPreferences(const std::filesystem::path& file) {
    std::error_code error;
    if (file.empty() || !std::filesystem::exists(file, error)) return {};
    try {
        std::vector<std::string> complaints;
        const Preferences preferences = parsePreferences(readWhole(file), complaints);
        if (complaints.size() == 1) warn(file, complaints.front() + ": the line is ignored");
        if (complaints.size() > 1)
            warn(file, complaints.front() + ": this and " + countText(complaints.size() - 1, "more line") +
                           " are ignored");
        return preferences;
    } catch (const std::runtime_error& why) {
        warn(file, why.what());
        return {};
    }
}

void savePreferences(const std::filesystem::path& file, const Preferences& preferences) {
    if (file.empty()) return;
    try {
        std::filesystem::create_directories(file.parent_path());
        mesh::writeWhole(file, [&](std::ostream& stream) { stream << toText(preferences); });
    } catch (const std::exception& error) { // mesh::ExportError, std::filesystem::filesystem_error
        warn(file, std::string("they are not kept: ") + error.what());
    }
}

// Skips names that do not fit into a line.
std::string rememberedScene(const std::string& file, const std::string& builtIn) {
    if (file.empty()) return builtIn;
    std::error_code error;
    const std::string path = std::filesystem::absolute(file, error).lexically_normal().string();
    const bool isLine = std::ranges::none_of(path, [](char one) { return one == '\n' || one == '\r'; });
    return error || !isLine || trimmed(path) != path ? "" : path;
}

} // namespace sinew::viewer
