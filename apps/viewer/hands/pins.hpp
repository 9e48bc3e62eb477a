// Pins of the pointer: hands that stay where they were put, and hold what they held then.
#pragma once

#include "sim/ranges.hpp"
#include "sim/simulation.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/hand_mesh.hpp"

#include <array>
#include <vector>

namespace sinew::viewer {

class Pins {
public:
    static constexpr std::size_t most = sim::ranges::mostGrabs - 1; ///< one hand is the pointer's

    Pins() { clear(); }

    /// Holds what is around the particle of `hand` where that hand is, from the next step on. `radius` as
    /// holdRadius(). False where all pins are in use.
    bool add(const Hand& hand, float radius);
    /// Takes out the one nearest to the eye that the ray passes within `reach` [m]; false where it passes
    /// none.
    bool takeOut(const Ray& ray, float reach);
    void clear();

    std::size_t count() const { return shown_.size(); }
    /// For sim::Step::grabs; a pin keeps its place, and those that are not in let go.
    const std::array<sim::Grab, most>& grabs() const { return grabs_; }
    /// To be drawn.
    std::span<const Hand> shown() const { return shown_; }

private:
    void show();

    std::array<sim::Grab, most> grabs_;
    std::array<std::optional<Hand>, most> hands_;
    std::vector<Hand> shown_;
};

/// A hand that holds nothing: for the places of Step::grabs before one that does.
sim::Grab emptyHand();

} // namespace sinew::viewer
