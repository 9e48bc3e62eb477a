// The sequential program of the benchmark: coordinates in float, one CPU thread, compiled for the building
// machine (sequentialFlags). Gauss-Seidel on position constraints, with the half-kick of gravity (g h^2 / 2
// in the prediction), boundary planes and damping: the same steps as sim/reference/GaussSeidel in double, in
// the order of the scene or sorted by colour.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::tools {

/// `natural` is the order of the scene, in which each constraint waits for its neighbour's result. In `color`
/// order, consecutive constraints share no particles, so that a processor can overlap them.
enum class ConstraintOrder { natural, color };

class Sequential {
public:
    Sequential(const sim::Scene& scene, const sim::Settings& settings, ConstraintOrder order);

    /// Takes one step of the scene's length.
    void step();

    using Vec4 = std::array<float, 4>;
    const std::vector<Vec4>& positions() const { return x_; }  ///< w = inverse mass [1/kg]
    const std::vector<Vec4>& velocities() const { return v_; } ///< w = inverse mass [1/kg]

private:
    // A constraint in the layout of the inner loop, half a cache line.
    struct Row {
        std::uint32_t a = 0, b = 0;
        float restLength = 0, alpha = 0; // [m], compliance / h^2 [1/kg]
        float inverseDenominator = 0, lambda = 0;
        float inverseMassA = 0, inverseMassB = 0;
    };
    void predict();
    void sweep();
    void projectPlanes();
    void finish();

    std::vector<Row> rows_;
    std::vector<Vec4> x_, v_, before_, predicted_;
    std::vector<float> contactOffset_;
    std::vector<std::uint32_t> touched_; // bit k = plane k
    std::vector<sim::Plane> planes_;
    sim::Vec3 gravity_;
    float h_ = 0, kept_ = 1;
    std::uint32_t substeps_ = 1, iterations_ = 1;
};

/// The compiler flags, such as "-O3 -march=native".
const char* sequentialFlags();

} // namespace sinew::tools
