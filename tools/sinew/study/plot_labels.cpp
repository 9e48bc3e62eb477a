// Tries places around every point of a front, near ones first, and takes the one with the most room.
#include "sinew/study/plot_labels.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::tools::study {

namespace {

constexpr double letterWidth = 8.3, letterHeight = 13, gap = 9;

double distanceTo(const Box& box, Spot spot) {
    const double dx = std::max({box.left - spot.x, 0.0, spot.x - box.right});
    const double dy = std::max({box.top - spot.y, 0.0, spot.y - box.bottom});
    return std::hypot(dx, dy);
}

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

} // namespace

void LabelPlacer::avoid(const std::vector<Spot>& line, std::size_t slot) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        obstacles_.push_back({line[i], slot});
        if (i == 0) continue;
        const Spot &a = line[i - 1], &b = line[i];
        const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 6) + 1;
        for (int k = 1; k < steps; ++k)
            obstacles_.push_back({{a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps}, slot});
    }
}

double LabelPlacer::roomAround(const Box& text, std::size_t slot) const {
    double room = 40; // more room is not better
    for (const Obstacle& obstacle : obstacles_) {
        const double distance = distanceTo(text, obstacle.spot);
        // A label may be near its own line, but must stay 3 units off.
        if (obstacle.slot == slot && distance > 3) continue;
        room = std::min(room, obstacle.slot == slot ? distance - 20 : distance);
        if (distance == 0) room -= 5; // the more of a line is covered, the worse
    }
    for (const Mark& mark : marks_)
        if (const double distance = distanceTo(text, mark.spot) - mark.radius; distance < 2) room -= 20;
    for (const Box& label : labels_)
        if (overlap(text, label)) room -= 100;
    return room;
}

void LabelPlacer::avoidText(const std::string& text, Label label) {
    const double width = letterWidth * static_cast<double>(text.size());
    labels_.push_back({label.x, label.y - letterHeight + 2, label.x + width, label.y + 3});
}

Label LabelPlacer::place(const std::string& text, const std::vector<Spot>& front, std::size_t slot) {
    const double width = letterWidth * static_cast<double>(text.size());
    Box best;
    double bestScore = -INFINITY;
    for (std::size_t i = 0; i < front.size(); ++i)
        for (const double dx : {gap, -gap - width, -width / 2})
            for (const double dy : {-gap / 2, gap + letterHeight / 2, -2.5 * gap, 2 * gap + letterHeight,
                                    -4.5 * gap, 4 * gap + letterHeight, -7 * gap, 6.5 * gap + letterHeight}) {
                const double left = std::clamp(front[i].x + dx, box_.left + 4, box_.right - width - 2);
                const double base = std::clamp(front[i].y + dy, box_.top + letterHeight, box_.bottom - 5);
                const Box candidate{left, base - letterHeight + 2, left + width, base + 3};
                // Prefers the end of a curve, where readers look first.
                const double score = roomAround(candidate, slot) - std::abs(dy) / 4 +
                                     6 * static_cast<double>(i + 1) / static_cast<double>(front.size());
                if (score > bestScore) bestScore = score, best = candidate;
            }
    labels_.push_back(best);
    return {best.left, best.bottom - 3};
}

} // namespace sinew::tools::study
