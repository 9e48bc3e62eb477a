// A body that is cut stroke by stroke, with all that must hold after each of them looked at: what a fuzzer
// and the walk through the shipped scenes have in common.
#pragma once

#include "sim/surface/closed_surface.hpp"

namespace sinew::test {

/// What a stroke left. `volume` and what follows from the surface only where the body has one.
struct StrokeResult {
    sim::Status status;
    std::size_t live = 0; ///< links
    std::size_t openEdges = 0, crowdedEdges = 0, triangles = 0, parts = 0;
    double volumeError = 0;   ///< of the sum of all parts, against the uncut body
    double momentumError = 0; ///< change within the step, against the sum of all |m v| as it began
    double milliseconds = 0;  ///< of the step alone, as the host sees it
};

class StrokeCheck {
public:
    /// The only grid of `scene`. With `isFree` nothing from outside acts on it: momentum is then looked at.
    StrokeCheck(const sim::Scene& scene, const sim::Settings& settings, bool isFree);

    CutBody& body() { return body_; }
    /// One step with a blade, then all checks that need no surface, as expectations of the test; `what` names
    /// the stroke in them.
    StrokeResult stroke(const sim::Blade& blade, const std::string& what);
    /// Steps without one.
    void run(int steps);
    /// What is drawn: closed, finite, and as large as the uncut body.
    void checkSurface(StrokeResult& result, const std::string& what);

    /// Live links that lead through what the blade of this step swept, by more than a hair of the spacing
    /// inside its outline; where the blade saw them. Not for blades that are carried.
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
