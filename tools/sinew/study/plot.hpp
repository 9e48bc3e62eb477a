// A work-precision diagram as SVG: error over a price, both logarithmic, one colour and marker per solver,
// labels at the curves instead of a legend, whiskers for the spread of a time. Readable on a phone; light or
// dark as the reader prefers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sinew::tools::study {

struct PlotPoint {
    double x = 0;               ///< > 0
    std::optional<double> y;    ///< > 0; empty = diverged: drawn at the top edge
    bool isOnFront = false;     ///< on its curve's front
    double least = 0, most = 0; ///< ends of a whisker along x, around x; both 0: none
};

struct PlotCurve {
    std::string label;
    std::size_t slot = 0;          ///< chooses colour and marker
    std::vector<PlotPoint> points; ///< front points by rising x
    std::optional<double> xAtTarget;
};

enum class PlotKind {
    precision, ///< error as percent over a price, both logarithmic, with a target
    overTime,  ///< lines of a positive figure, logarithmic, over a linear x from 0
};

struct Plot {
    std::string title, xLabel;
    double target = 0.01;
    PlotKind kind = PlotKind::precision;
    double standing = 0; ///< the error of a body that stays where it started: a line; 0: none
    std::string name{};  ///< part of file names that need more than scene and price
    std::vector<PlotCurve> curves;
};

/// Style rules of all plots; included in each file by draw() with Style::own, and once in a page with several
/// plots.
std::string plotStyle();

enum class Style { own, fromPage };
std::string draw(const Plot& plot, Style style);

/// Text with XML's special characters escaped.
std::string escaped(const std::string& text);

} // namespace sinew::tools::study
