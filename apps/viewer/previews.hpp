// What scenes look like before anybody opens them: small pictures, made while other things go on.
#pragma once

#include "viewer/draw/png.hpp"
#include "viewer/options.hpp"
#include "vk/device.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace sinew::viewer {

/// A scene as it begins, seen as when it is opened; of PictureSheet::extent. Says nothing on stderr. Throws
/// as open(), sim::Simulation and vk::Error. Ends early, without one, if it is asked to stop.
std::optional<Picture> drawPreview(const vk::Device& device, const Options& options,
                                   const std::stop_token& stop = {});

/// Pictures of numbered scenes, made one after another in a thread of its own, which gives way to others.
class Previews {
public:
    /// Called in that thread; of what throws there is no picture.
    using Draw = std::function<std::optional<Picture>(std::size_t scene, const std::stop_token& stop)>;

    explicit Previews(Draw draw);
    ~Previews(); ///< asks what is being made to stop, and waits for that
    Previews(const Previews&) = delete;
    Previews& operator=(const Previews&) = delete;

    /// These are wanted now, the first first, and no others; what has been made already, or failed, is not
    /// made again.
    void want(std::vector<std::size_t> scenes);

    /// A picture that was made since, in order.
    std::optional<std::pair<std::size_t, Picture>> take();

private:
    void work(const std::stop_token& stop);

    Draw draw_;
    std::mutex mutex_; // of the next three
    std::condition_variable_any isWanted_;
    std::vector<std::size_t> wanted_, begun_;
    std::vector<std::pair<std::size_t, Picture>> made_;
    std::jthread thread_; // begins with the first wish
};

} // namespace sinew::viewer
