// Writes PNG files beside the simulation: encoding one takes longer than many steps.
#pragma once

#include "viewer/draw/png.hpp"

#include <deque>
#include <future>
#include <optional>

namespace sinew::viewer {

/// One thread uses it. The destructor waits for what is not yet written.
class PictureWriter {
public:
    explicit PictureWriter(std::size_t mostAtOnce);

    /// Waits while as many files as allowed are being written; those are then not taken any more. Throws
    /// mesh::ExportError of an earlier file.
    void add(const std::filesystem::path& file, Picture picture, PictureText text);

    enum class Wait { no, yes };
    /// The oldest file not yet taken, written; empty where there is none, or where it is not done and `wait`
    /// says no. Throws mesh::ExportError if it failed.
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
