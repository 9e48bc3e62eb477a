// Writes PNG files in other threads: encoding one takes longer than many steps.
#pragma once

#include "viewer/render/png.hpp"

#include <deque>
#include <future>
#include <optional>

namespace sinew::viewer {

/// Used by one thread. The destructor waits for unwritten files.
class PictureWriter {
public:
    explicit PictureWriter(std::size_t mostAtOnce);

    /// Waits while `mostAtOnce` files are being written; take() does not return those. Throws
    /// mesh::ExportError of an earlier file.
    void add(const std::filesystem::path& file, Picture picture, PictureText text);

    enum class Wait { no, yes };
    /// Returns the oldest written file not yet taken; empty if there is none, or if it is not done and `wait`
    /// is no. Throws mesh::ExportError if it failed.
    std::optional<std::filesystem::path> take(Wait wait);

private:
    struct Pending {
        std::filesystem::path file;
        std::future<void> done;
    };
    std::deque<Pending> pending_;
    std::size_t mostAtOnce_;
};

} // namespace sinew::viewer
