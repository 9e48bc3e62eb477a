// Reads folders and keeps the choice.
#include "viewer/ui/file_browser.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace sinew::viewer {

namespace fs = std::filesystem;

namespace {

using Kind = FileEntry::Kind;

constexpr std::size_t mostEntries = 20'000; // of a folder: more take too long to read

std::string lowered(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// Folders first, both in the order of their names.
bool isBefore(const FileEntry& a, const FileEntry& b) {
    const bool isFolder = a.kind == Kind::folder;
    if (isFolder != (b.kind == Kind::folder)) return isFolder;
    return std::pair(lowered(a.name), a.name) < std::pair(lowered(b.name), b.name);
}

std::optional<FileEntry> entryOf(const fs::directory_entry& file) {
    std::error_code error;
    const fs::path& path = file.path();
    const std::string name = path.filename().string();
    if (name.starts_with(".")) return std::nullopt;
    if (file.is_directory(error)) return FileEntry{Kind::folder, name + "/", path};
    const std::optional<Kind> kind = kindOfFile(path);
    if (!kind || !file.is_regular_file(error)) return std::nullopt;
    return FileEntry{*kind, name, path};
}

} // namespace

std::optional<Kind> kindOfFile(const fs::path& file) {
    constexpr std::array<std::pair<const char*, Kind>, 7> kinds{{{".toml", Kind::scene},
                                                                 {".state", Kind::state},
                                                                 {".obj", Kind::mesh},
                                                                 {".stl", Kind::mesh},
                                                                 {".ply", Kind::mesh},
                                                                 {".glb", Kind::mesh},
                                                                 {".gltf", Kind::mesh}}};
    const std::string end = lowered(file.extension().string());
    for (const auto& [extension, kind] : kinds)
        if (end == extension) return kind;
    return std::nullopt;
}

std::string expanded(const std::string& path) {
    const char* home = std::getenv("HOME");
    return path.starts_with("~/") && home != nullptr ? home + path.substr(1) : path;
}

void FileBrowser::open(const fs::path& folder, const std::vector<std::string>& recent) {
    recent_.clear();
    for (const std::string& file : recent)
        recent_.push_back(
            {kindOfFile(file).value_or(Kind::mesh), fs::path(file).filename().string(), file, true});
    home_ = folder;
    folder_.clear();
    filter("");
}

void FileBrowser::enter(const fs::path& folder) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(folder, error);
    folder_ = error ? folder : whole;
    all_.clear();
    complaint_.clear();
    fs::directory_iterator files(folder_, fs::directory_options::skip_permission_denied, error);
    for (; !error && files != fs::directory_iterator() && all_.size() < mostEntries; files.increment(error))
        if (std::optional<FileEntry> entry = entryOf(*files)) all_.push_back(std::move(*entry));
    if (error) complaint_ = "cannot read this folder: " + error.message();
    std::ranges::sort(all_, isBefore);
    if (folder_.has_relative_path()) all_.insert(all_.begin(), {Kind::folder, "../", folder_.parent_path()});
}

void FileBrowser::filter(const std::string& text) {
    text_ = text;
    isMoved_ = false;
    const std::size_t slash = text.rfind('/');
    const bool isPath = slash != std::string::npos;
    const fs::path wanted = isPath ? home_ / expanded(text.substr(0, slash + 1)) : home_;
    std::error_code error;
    if (folder_.empty() || !fs::equivalent(wanted, folder_, error)) enter(wanted);
    const std::string part = isPath ? text.substr(slash + 1) : text;
    choose(part);
    chosen_.reset();
    if (part.empty() || shown_.empty()) return;
    const auto same = std::ranges::find_if(
        shown_, [&](const FileEntry& entry) { return !entry.isRecent && entry.path.filename() == part; });
    chosen_ = same == shown_.end() ? 0 : static_cast<std::size_t>(same - shown_.begin());
}

void FileBrowser::choose(const std::string& part) {
    const std::string sought = lowered(part);
    shown_.clear();
    const auto add = [&](const std::vector<FileEntry>& entries) {
        for (const FileEntry& entry : entries)
            if (lowered(entry.name).find(sought) != std::string::npos) shown_.push_back(entry);
    };
    if (text_.find('/') == std::string::npos) add(recent_);
    add(all_);
}

void FileBrowser::move(int by) {
    const auto count = static_cast<int>(shown_.size());
    if (count == 0) return;
    const int from = chosen_ ? static_cast<int>(*chosen_) : by > 0 ? -1 : count;
    chosen_ = static_cast<std::size_t>(((from + by) % count + count) % count);
    isMoved_ = true;
}

std::optional<std::string> FileBrowser::take(std::size_t entry) {
    const FileEntry taken = shown_.at(entry);
    if (taken.kind != Kind::folder) return taken.path.string();
    home_ = taken.path;
    filter("");
    return std::nullopt;
}

std::optional<std::string> FileBrowser::takeTyped() {
    if (text_.empty()) return chosen_ ? take(*chosen_) : std::nullopt;
    const fs::path typed = home_ / expanded(text_);
    std::error_code error;
    const bool isFile = text_.find('/') != std::string::npos && fs::is_regular_file(typed, error);
    if (chosen_ && (isMoved_ || !isFile)) return take(*chosen_);
    if (!fs::is_directory(typed, error)) return text_.find('/') == std::string::npos ? text_ : typed.string();
    home_ = typed;
    filter("");
    return std::nullopt;
}

fs::path startFolder(const std::vector<std::string>& recent) {
    std::error_code error;
    if (!recent.empty())
        if (const auto folder = fs::path(recent.front()).parent_path(); fs::is_directory(folder, error))
            return folder;
    const fs::path here = fs::current_path(error);
    return error ? fs::path("/") : here;
}

} // namespace sinew::viewer
