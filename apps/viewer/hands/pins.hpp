// Pins: grabs that stay where they were placed.
#pragma once

#include "sinew/ranges.hpp"
#include "sinew/simulation.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/hand_mesh.hpp"

#include <array>
#include <vector>

namespace sinew::viewer {

class Pins {
public:
    static constexpr std::size_t most = sim::ranges::mostGrabs - 1; ///< the pointer needs one grab

    Pins() { clear(); }

    /// Pins the particles around that of `hand` at the hand's place, from the next step on. `radius`: see
    /// holdRadius(). False if all pins are in use.
    bool add(const Hand& hand, float radius);
    /// Removes the pin nearest to the eye that the ray passes within `reach` [m]; false if there is none.
    bool takeOut(const Ray& ray, float reach);
    void clear();

    std::size_t count() const { return shown_.size(); }
    /// For sim::Step::grabs; a pin keeps its index, and unused entries hold nothing.
    const std::array<sim::Grab, most>& grabs() const { return grabs_; }
    /// The pins to draw.
    std::span<const Hand> shown() const { return shown_; }

private:
    void show();

    std::array<sim::Grab, most> grabs_;
    std::array<std::optional<Hand>, most> hands_;
    std::vector<Hand> shown_;
};

/// A grab that holds nothing: for entries of Step::grabs before one that holds.
sim::Grab emptyHand();

} // namespace sinew::viewer
