// Analysis of measured points: fronts, the time to a given error, and the number of frames before the motion
// becomes chaotic. Pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sinew::tools::study {

/// A price (milliseconds, sweeps or barriers, > 0) and its error, relative to the body size; empty =
/// diverged.
struct Offer {
    double cost = 0;
    std::optional<double> error;
};

/// Indices of the offers that no other offer undercuts in both cost and error, by rising cost. Never includes
/// diverged ones.
std::vector<std::size_t> paretoFront(std::span<const Offer> offers);

/// The cost at which a front (rising cost, falling error) reaches `error`, interpolated between its points in
/// the logarithms of both; the cost of the first point if that is already better, empty if none is.
std::optional<double> costOfError(std::span<const Offer> front, double error);

/// Root mean square over the first `frames` frames of values that are each the RMS over one frame.
double rmsOver(std::span<const double> frameRms, std::size_t frames);

/// Number of frames of a run that can be compared: those before a perturbation of the truth by `perturbation`
/// (relative to the body size) has grown, in `growth` (RMS of each frame, by body size), to a tenth of the
/// error of these frames. Growth below ten times the perturbation is ignored. At least 1, at most all.
std::size_t comparableFrames(std::span<const double> frameRms, std::span<const double> growth,
                             double perturbation);

} // namespace sinew::tools::study
