// Chooses between a video and a folder.
#include "viewer/capture/recording.hpp"

#include "app/guard.hpp"

#include <cinttypes>
#include <cstdio>

namespace sinew::viewer {

namespace fs = std::filesystem;

std::string nameAt(const std::string& scene, std::uint64_t step) {
    char stem[40];
    std::snprintf(stem, sizeof stem, "-%06" PRIu64, step);
    return scene + stem;
}

fs::path freeName(std::string name, const std::string& extension, const fs::path& folder) {
    for (char& c : name)
        if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 32) c = '_';
    fs::path file = folder / (name + extension);
    std::error_code error; // an inaccessible folder fails later, at writing
    for (int copy = 2; fs::exists(file, error); ++copy)
        file = folder / (name + "-" + std::to_string(copy) + extension);
    return file;
}

Recording::Recording(const std::string& scene, std::uint32_t width, std::uint32_t height,
                     double picturesPerSecond) {
    if (hasFfmpeg()) {
        target_ = freeName(scene, ".mp4");
        video_ = std::make_unique<Video>(target_, width, height, picturesPerSecond);
        return;
    }
    target_ = freeName(scene, "");
    std::error_code error;
    fs::create_directory(target_, error);
    if (error)
        throw app::Failure(app::outputFailed, "cannot record: " + target_.string() + ": " + error.message() +
                                                  ": start in another folder");
}

void Recording::add(Picture picture, PictureText text) {
    if (video_) {
        video_->add(picture);
    } else {
        char name[40];
        std::snprintf(name, sizeof name, "frame_%04zu.png", count_);
        writer_.add(target_ / name, std::move(picture), std::move(text));
    }
    ++count_;
}

void Recording::finish() {
    std::error_code ignored;
    if (count_ == 0) {
        if (!video_) fs::remove(target_, ignored); // only if empty
        return video_.reset();
    }
    if (video_) return video_->finish();
    while (writer_.take(PictureWriter::Wait::yes)) {
    }
}

} // namespace sinew::viewer
