// Pins: grabs that stay where they were placed, and the tool that places and removes them.
#pragma once

#include "viewer/input/tool.hpp"

#include <array>
#include <utility>
#include <vector>

namespace sinew::viewer {

namespace tool {
extern const Tool pins;
} // namespace tool

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

/// Pins the held particle, or the one under the pointer; on a pin it removes it.
class PinTool final : public ToolState {
public:
    /// `reach`: largest distance of the pointer's ray from a pin [m].
    PinTool(const sim::Scene& scene, std::vector<sim::NamedHold> holds, float reach);

    std::unique_ptr<ToolState> clone() const override { return std::make_unique<PinTool>(*this); }
    bool use(const Ray& ray, const std::optional<Held>& held) override;
    const std::optional<Ray>& question() const override { return question_; }
    void answer(const std::optional<Pick>& pick, float radius) override;
    void clear() override;
    void addTo(StepHands& hands) override;
    void addTo(Overlay& overlay) const override { overlay.pins = pins_.shown(); }
    bool isShownOn() const override { return pins_.count() > 0; }
    std::string takeNote() override { return std::exchange(note_, {}); }

private:
    void pin(const Hand& hand, float radius);
    std::string heldText(std::uint32_t particle) const;

    Pins pins_;
    std::vector<sim::NamedHold> holds_; // of the scene
    std::vector<bool> isFixed_;         // for every particle
    float reach_;
    std::optional<Ray> question_;
    std::string note_;
};

} // namespace sinew::viewer
