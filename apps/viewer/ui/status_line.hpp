// The title of the window: scene, device and speed.
#pragma once

#include "app/piece_count.hpp"
#include "viewer/document/document.hpp"

#include <chrono>

namespace sinew::viewer {

class StatusLine {
public:
    StatusLine(const sim::Scene& scene, const vk::Device& device);

    void frameDrawn() { ++frames_; }
    /// GPU time of one step [ms].
    void stepTimed(double milliseconds);

    /// Number of sleeping particles.
    void setSleeping(std::uint32_t sleeping) { sleeping_ = sleeping; }
    /// Number of pieces of cut bodies with a surface.
    void setPieces(const app::PieceCount& pieces);
    /// Sets the text for the tool in hand, such as " - holding".
    void setTool(std::string tool) { tool_ = std::move(tool); }

    /// A new title, twice a second or when the state of playing has changed; otherwise empty.
    std::optional<std::string> title(bool isPaused, bool isDiverged);

private:
    using Clock = std::chrono::steady_clock;
    std::string head_;
    Clock::time_point since_ = Clock::now();
    std::uint64_t frames_ = 0;
    double framesPerSecond_ = 0, stepMs_ = 0; ///< stepMs_: smoothed; 0 = not measured
    std::uint32_t sleeping_ = 0;
    app::PieceCount pieces_;
    bool isFresh_ = false; // the number of pieces
    std::string tool_, lastTool_;
    bool wasPaused_ = false, wasDiverged_ = false, isFirst_ = true;
};

} // namespace sinew::viewer
