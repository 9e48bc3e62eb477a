// Uses one task per file.
#include "viewer/capture/picture_writer.hpp"

#include <chrono>

namespace sinew::viewer {

PictureWriter::PictureWriter(std::size_t mostAtOnce) : mostAtOnce_(mostAtOnce) {}

void PictureWriter::add(const std::filesystem::path& file, Picture picture, PictureText text) {
    while (pending_.size() >= mostAtOnce_) take(Wait::yes);
    pending_.push_back(
        {file, std::async(std::launch::async, [file, picture = std::move(picture), text = std::move(text)] {
             writePng(file, picture, text);
         })});
}

std::optional<std::filesystem::path> PictureWriter::take(Wait wait) {
    constexpr auto atOnce = std::chrono::seconds(0);
    if (pending_.empty() ||
        (wait == Wait::no && pending_.front().done.wait_for(atOnce) != std::future_status::ready))
        return std::nullopt;
    Pending oldest = std::move(pending_.front());
    pending_.pop_front();
    oldest.done.get();
    return oldest.file;
}

} // namespace sinew::viewer
