// The frame of a diagram: scales, grid and tick labels.
#pragma once

#include "sinew/study/plot.hpp"

namespace sinew::tools::study {

inline constexpr double plotWidth = 440, plotHeight = 420;

/// The words beside the line of a body that does not move.
inline constexpr const char* standingText = "standing still";

struct Spot {
    double x = 0, y = 0; ///< in the drawing, y down
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Scales from values to the drawing: logarithmic, except for time.
struct Axes {
    Box box;
    PlotKind kind = PlotKind::precision;
    double xLow = 1, xHigh = 10, yLow = 1e-3, yHigh = 1, target = 0.01, standing = 0;

    double x(double value) const;
    double y(double value) const; ///< clamped to the box
    bool holdsX(double value) const { return value >= xLow && value <= xHigh; }
};

/// Error axes span whole decades that hold every point and the target; over time at most nine below the
/// largest.
Axes axesFor(const Plot& plot);

std::string drawAxes(const Axes& axes, const std::string& xLabel);

/// Tick values between two positive numbers: 1, 2, 5 in each decade for few decades, else only decades.
std::vector<double> ticks(double low, double high);

/// "100 %", "0.01 %", and powers of ten for many zeros.
std::string percentText(double share);

/// 0, 1, 2 ..., or steps of 2 or 5 times a power of ten: four to ten of them from 0 to `high`.
std::vector<double> linearTicks(double high);

} // namespace sinew::tools::study
