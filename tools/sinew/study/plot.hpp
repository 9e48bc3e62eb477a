// A work-precision diagram as SVG: error over a price, both logarithmic, one colour and marker per solver,
// labels at the curves instead of a legend. Readable at the width of a phone; light and dark by the reader's
// preference.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sinew::tools::study {

struct PlotPoint {
    double x = 0;            ///< > 0
    std::optional<double> y; ///< > 0; empty = diverged: drawn at the top edge
    bool isOnFront = false;  ///< of its curve
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
    std::string name{}; ///< in file names, where the scene's and a price's are not enough
    std::vector<PlotCurve> curves;
};

/// The rules that every plot's classes mean; stands in each file that draw() makes with Style::own, and once
/// in a page that holds several plots.
std::string plotStyle();

enum class Style { own, fromPage };
std::string draw(const Plot& plot, Style style);

/// Text with what XML keeps for itself replaced.
std::string escaped(const std::string& text);

} // namespace sinew::tools::study
