// What a list of measured points says: fronts, the time to a given error, and how far a motion can be
// compared before it becomes chaotic (cases: 1 to 3). Pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sinew::tools::study {

/// A price (milliseconds, sweeps or barriers, > 0) and the error it buys, by body size; empty = diverged.
struct Offer {
    double cost = 0;
    std::optional<double> error;
};

/// Indices of the offers that no other undercuts in both cost and error, by rising cost. Diverged ones are
/// never among them.
std::vector<std::size_t> paretoFront(std::span<const Offer> offers);

/// The cost at which a front (rising cost, falling error) reaches `error`, interpolated between its points in
/// the logarithms of both; the cost of its first point where that one is better already, empty where none is.
std::optional<double> costOfError(std::span<const Offer> front, double error);

/// Root mean square over the first `frames` frames of values that are each the RMS over one frame.
double rmsOver(std::span<const double> frameRms, std::size_t frames);

/// How many frames of a run can be told from chaos: those before a perturbation of the truth by
/// `perturbation` (of body size) has grown, in `growth` (RMS of each frame, by body size), to a tenth of the
/// error of the frames compared. Growth below ten times the perturbation is none. At least 1, at most all.
std::size_t comparableFrames(std::span<const double> frameRms, std::span<const double> growth,
                             double perturbation);

} // namespace sinew::tools::study
