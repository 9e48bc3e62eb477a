// Files with results that can be made again, in the user's cache folder. A missing, damaged, foreign or
// oversized file counts as none, and a folder that cannot be written as one that keeps nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sinew::app {

/// Variable with another folder (an absolute path), or "off": nothing is read or written.
inline constexpr const char* cacheVariable = "SINEW_CACHE";

/// Folder that the values of SINEW_CACHE, XDG_CACHE_HOME and HOME lead to; null: not set. Relative paths do
/// not count, as the XDG base directory specification requires. Empty if nothing is kept.
std::filesystem::path cacheFolder(const char* own, const char* xdg, const char* home);

/// Any thread and any number of processes.
class UserCache {
public:
    UserCache(); ///< cacheFolder() of the environment
    explicit UserCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    static constexpr std::uintmax_t mostBytes = std::uintmax_t{64} << 20; ///< of a file
    static constexpr std::size_t mostFiles = 16; ///< of the folder; keep() deletes the oldest others

    /// The bytes that were kept of this kind, a word, under this key, a line of text; empty if there is none.
    std::vector<std::byte> find(const std::string& kind, const std::string& key) const;
    /// Keeps `bytes` instead of what was kept before. Writes nothing if these are the same, or too many.
    void keep(const std::string& kind, const std::string& key,
              std::span<const std::byte> bytes) const noexcept;

private:
    std::filesystem::path fileOf(const std::string& kind, const std::string& key) const;
    void deleteOldest() const;
    std::filesystem::path folder_;
};

} // namespace sinew::app
