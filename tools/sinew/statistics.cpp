// Uses nearest ranks, so that every figure is a measured value.
#include "sinew/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::tools {

std::optional<Statistics> summarise(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto count = static_cast<double>(values.size());
    const auto percentile = [&](double share) {
        return values[static_cast<std::size_t>(std::max(1.0, std::ceil(share * count))) - 1];
    };
    Statistics result{.min = values.front(), .p50 = percentile(0.5), .p99 = percentile(0.99)};
    result.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const double value : values) squares += (value - result.mean) * (value - result.mean);
    if (values.size() > 1) result.stddev = std::sqrt(squares / (count - 1));
    return result;
}

} // namespace sinew::tools
