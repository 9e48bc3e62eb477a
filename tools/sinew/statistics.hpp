// Mean, spread and percentiles of a list of times.
#pragma once

#include <optional>
#include <vector>

namespace sinew::tools {

struct Statistics {
    double min = 0, p50 = 0, p99 = 0, mean = 0;
    double stddev = 0; ///< of the sample (n - 1); 0 for a single value
};

/// Percentiles by nearest rank: the smallest value that at least that share of values does not exceed. Empty
/// without values.
std::optional<Statistics> summarise(std::vector<double> values);

} // namespace sinew::tools
