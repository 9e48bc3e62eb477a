// A body cut stroke by stroke, with all invariants checked after each stroke. Shared by the fuzz test and the
// test of the shipped scenes.
#pragma once

#include "sim/surface/closed_surface.hpp"

namespace sinew::test {

/// Result of a stroke. `volume` and the values from the surface are set only for bodies with one.
struct StrokeResult {
    sim::Status status;
    std::size_t live = 0; ///< links
    std::size_t openEdges = 0, crowdedEdges = 0, triangles = 0, parts = 0;
    double volumeError = 0;   ///< of all parts together, against the uncut body
    double momentumError = 0; ///< change within the step, over the sum of all |m v| at its start
    double milliseconds = 0;  ///< of the step alone, on the host's clock
};

class StrokeCheck {
public:
    /// The scene must have exactly one grid. With `isFree` no outside force acts on it, and momentum is
    /// checked.
    StrokeCheck(const sim::Scene& scene, const sim::Settings& settings, bool isFree);

    CutBody& body() { return body_; }
    /// Makes one step with a blade and all checks that need no surface, as expectations of the test. `what`
    /// names the stroke in failures.
    StrokeResult stroke(const sim::Blade& blade, const std::string& what);
    /// Makes steps without a blade.
    void run(int steps);
    /// Checks the drawn surface: closed, finite, and of the uncut body's volume.
    void checkSurface(StrokeResult& result, const std::string& what);

    /// Number of live links that cross the area swept in this step, by more than a small part of the spacing
    /// inside its outline, at the positions that the blade saw. Not for carried blades.
    std::size_t crossings(const sim::Blade& blade) const;

private:
    Eigen::Vector3d momentum(double& scale);
    void checkLinks(const std::string& what, StrokeResult& result);

    CutBody body_;
    std::vector<float> inverseMasses_;
    std::vector<double> masses_; // 0 = never moves
    bool isFree_;
    double uncutVolume_ = 0; // 0 = no surface
};

} // namespace sinew::test
