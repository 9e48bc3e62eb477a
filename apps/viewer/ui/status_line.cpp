// Builds the title.
#include "viewer/ui/status_line.hpp"

#include "viewer/render/legend.hpp"
#include "viewer/render/renderer.hpp"

#include <cstdio>
#include <utility>

namespace sinew::viewer {

StatusLine::StatusLine(const sim::Scene& scene, const vk::Device& device)
    : head_("Sinew - " + scene.name + " - " + (isSoftware(device) ? "SOFTWARE: " : "") +
            device.description().name + " - " + countText(scene.particles.size(), "particle")) {}

void StatusLine::setPieces(const app::PieceCount& pieces) {
    isFresh_ = isFresh_ || pieces != pieces_;
    pieces_ = pieces;
}

void StatusLine::stepTimed(double milliseconds) {
    stepMs_ = stepMs_ == 0 ? milliseconds : 0.9 * stepMs_ + 0.1 * milliseconds;
}

std::optional<std::string> StatusLine::title(bool isPaused, bool isDiverged) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - since_).count();
    const bool isSame =
        isPaused == wasPaused_ && isDiverged == wasDiverged_ && tool_ == lastTool_ && !isFresh_ && !isFirst_;
    if (isSame && seconds < 0.5) return std::nullopt;
    if (seconds >= 0.5) {
        framesPerSecond_ = static_cast<double>(std::exchange(frames_, 0)) / seconds;
        since_ = now;
    }
    wasPaused_ = isPaused;
    wasDiverged_ = isDiverged;
    lastTool_ = tool_;
    isFirst_ = isFresh_ = false;
    char numbers[80] = "";
    if (stepMs_ > 0) std::snprintf(numbers, sizeof numbers, " - %.2f ms/step", stepMs_);
    std::string title = head_ + numbers;
    std::snprintf(numbers, sizeof numbers, " - %.0f fps", framesPerSecond_);
    if (sleeping_ > 0) title += " - " + grouped(sleeping_) + " asleep";
    if (!pieces_.isCounted) title += " - ? pieces";
    if (pieces_.isCounted && pieces_.pieces > 1) title += " - " + countText(pieces_.pieces, "piece");
    title += tool_;
    title += isDiverged ? " - unstable, R resets" : isPaused ? " - paused" : numbers;
    return title;
}

} // namespace sinew::viewer
