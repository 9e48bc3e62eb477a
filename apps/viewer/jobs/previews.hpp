// Previews of scenes: small pictures, made in the background.
#pragma once

#include "sinew/vk/device.hpp"
#include "viewer/jobs/options.hpp"
#include "viewer/render/png.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace sinew::viewer {

/// Draws the start of a scene with the camera that opening it would use, of PictureSheet::extent. Prints
/// nothing. Throws as open(), sim::Simulation and vk::Error. Returns early without a picture when asked to
/// stop.
std::optional<Picture> drawPreview(const vk::Device& device, const Options& options,
                                   const std::stop_token& stop = {});

/// Makes previews one after another in a thread of low priority.
class Previews {
public:
    /// Called in that thread; a scene whose call throws has no preview.
    using Draw = std::function<std::optional<Picture>(std::size_t scene, const std::stop_token& stop)>;

    explicit Previews(Draw draw);
    ~Previews(); ///< asks the drawing in progress to stop, and waits
    Previews(const Previews&) = delete;
    Previews& operator=(const Previews&) = delete;

    /// Sets the previews to make, in this order, and no others; previews that were made, or failed, are not
    /// made again.
    void want(std::vector<std::size_t> scenes);

    /// Takes the next preview that was made, in order of making.
    std::optional<std::pair<std::size_t, Picture>> take();

private:
    void work(const std::stop_token& stop);

    Draw draw_;
    std::mutex mutex_; // guards the next three
    std::condition_variable_any isWanted_;
    std::vector<std::size_t> wanted_, begun_;
    std::vector<std::pair<std::size_t, Picture>> made_;
    std::jthread thread_; // starts at the first want()
};

} // namespace sinew::viewer
