// The search for the cheapest settings of a program that reach given errors: doubling, then bisection. Pure
// functions: whoever calls measures the errors.
#pragma once

#include "sinew/scene.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace sinew::tools::peers {

/// A family of settings of one program, with a count that grows: substeps of `iterations` sweeps each, or the
/// sweeps of a single substep.
struct Variant {
    sim::Settings tuning; ///< substeps and iterations are set by at()
    std::uint32_t iterations = 1;
    bool isWholeFrame = false; ///< one substep a frame; `iterations` has no meaning

    sim::Settings at(std::uint32_t count) const;
    std::uint64_t sweeps(std::uint32_t count) const;
};

/// One error that was measured.
struct Probe {
    std::size_t variant = 0;
    std::uint32_t count = 0;
    std::uint64_t sweeps = 0;
    std::optional<double> error; ///< empty: diverged, or stopped early because it exceeds the target
};

struct Search {
    std::vector<Variant> variants;
    std::vector<double> targets; ///< errors to reach, falling
    std::uint32_t mostSweeps = 1000;
    /// The error with these settings. It may stop and return nothing once it is sure that the error exceeds
    /// `enough`; nothing is also the answer of a run that diverges.
    std::function<std::optional<double>(const sim::Settings& settings, double enough)> errorOf;
    std::function<bool()> isOver; ///< true: no time is left
};

/// Settings that reach a target, to be timed.
struct Candidate {
    std::size_t target = 0; ///< index of Search::targets
    sim::Settings settings;
    double error = 0;
};

struct SearchResult {
    std::vector<Probe> probes;
    std::vector<Candidate> candidates; ///< at most two for each target, of two variants
    bool isComplete = true;            ///< false: time was over before every target had its answer
};

/// Doubles the sweeps until a variant reaches every target. After each doubling only the better half of the
/// variants goes on, four at least. Then bisects the count of the two variants that need the fewest sweeps
/// for each target, until the count is known to a part in 24. Assumes that an error does not rise with the
/// count.
SearchResult findCheapest(const Search& search);

} // namespace sinew::tools::peers
