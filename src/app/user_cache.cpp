// A title, the key, the bytes, and a hash over all of it. The name of a file is a hash of its key.
#include "app/user_cache.hpp"

#include "mesh/export.hpp"
#include "sim/core/hash.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>

namespace sinew::app {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view title = "sinew cache 1\n", ending = ".cache";

std::string headOf(const std::string& key) {
    return std::string(title) + key + "\n";
}

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint64_t hashOf(std::string_view head, std::span<const std::byte> bytes) {
    return sim::fnv1a(bytes, sim::fnv1a(std::as_bytes(std::span(head))));
}

bool isAbsolute(const char* path) {
    return path != nullptr && fs::path(path).is_absolute();
}

// Only files that keep() has written: the folder may be shared with other programs.
bool isOurs(const fs::directory_entry& entry) {
    std::error_code error;
    if (entry.path().extension() != ending || !entry.is_regular_file(error) || error) return false;
    std::string first(title.size(), '\0');
    std::ifstream stream(entry.path(), std::ios::binary);
    return stream.read(first.data(), static_cast<std::streamsize>(first.size())) && first == title;
}

} // namespace

fs::path cacheFolder(const char* own, const char* xdg, const char* home) {
    if (own != nullptr && std::string_view(own) == "off") return {};
    if (isAbsolute(own)) return own;
    if (isAbsolute(xdg)) return fs::path(xdg) / "sinew";
    if (isAbsolute(home)) return fs::path(home) / ".cache" / "sinew";
    return {};
}

UserCache::UserCache() {
    // Read once: other threads may change the environment later.
    static const fs::path folder =
        cacheFolder(std::getenv(cacheVariable), std::getenv("XDG_CACHE_HOME"), std::getenv("HOME"));
    folder_ = folder;
}

fs::path UserCache::fileOf(const std::string& kind, const std::string& key) const {
    char number[20];
    std::snprintf(number, sizeof number, "%016llx",
                  static_cast<unsigned long long>(sim::fnv1a(std::as_bytes(std::span(key)))));
    return folder_ / (kind + "-" + number + std::string(ending));
}

std::vector<std::byte> UserCache::find(const std::string& kind, const std::string& key) const {
    if (folder_.empty()) return {};
    const fs::path file = fileOf(kind, key);
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > mostBytes) return {};
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string head = headOf(key);
    std::uint64_t hash = 0;
    if (text.size() < head.size() + sizeof(hash) || !text.starts_with(head)) return {};
    std::memcpy(&hash, text.data() + text.size() - sizeof(hash), sizeof(hash));
    const auto bytes =
        std::as_bytes(std::span(text)).subspan(head.size(), text.size() - head.size() - sizeof(hash));
    if (hashOf(head, bytes) != hash) return {};
    return {bytes.begin(), bytes.end()};
}

void UserCache::keep(const std::string& kind, const std::string& key,
                     std::span<const std::byte> bytes) const noexcept {
    try {
        const std::string head = headOf(key);
        if (folder_.empty() || head.size() + bytes.size() + sizeof(std::uint64_t) > mostBytes ||
            std::ranges::equal(find(kind, key), bytes))
            return;
        if (fs::create_directories(folder_)) fs::permissions(folder_, fs::perms::owner_all);
        mesh::writeWhole(fileOf(kind, key), [&](std::ostream& stream) {
            const std::uint64_t hash = hashOf(head, bytes);
            stream << head << textOf(bytes);
            stream.write(reinterpret_cast<const char*>(&hash), sizeof(hash));
        });
        deleteOldest();
    } catch (const std::exception&) { // a full disk or a folder of others: the results are made again
    }
}

void UserCache::deleteOldest() const {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
        std::error_code error;
        const fs::file_time_type time = entry.last_write_time(error);
        if (!error && isOurs(entry)) files.emplace_back(time, entry.path());
    }
    std::ranges::sort(files);
    for (std::size_t f = 0; f + mostFiles < files.size(); ++f) {
        std::error_code error; // another process may have deleted it
        fs::remove(files[f].second, error);
    }
}

} // namespace sinew::app
