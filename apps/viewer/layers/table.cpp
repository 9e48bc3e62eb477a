// The table of layers, and those that need no file of their own.
#include "viewer/render/balls.hpp"
#include "viewer/render/layer.hpp"

#include <array>

namespace sinew::viewer {

namespace layer {
extern const Layer links, contacts, cells;
} // namespace layer

namespace {

// Balls of all particles; the renderer draws them.
class AllBalls : public LayerPart {
public:
    explicit AllBalls(const LayerContext& of) : balls_(of.device, allBallsOf(of.scene)) {}
    void addTo(LayerBuffers& buffers, std::size_t) const noexcept override { buffers.balls = &balls_; }

private:
    Balls balls_;
};

constexpr std::array<Layer::Look, 2> skinLooks{{{"glass", "Glass"}, {"hidden", "No skin"}}}; // SkinLook
constexpr std::array<Layer::Look, 1> wiresLooks{{{"wires", "Wires"}}};
constexpr std::array<Layer::Look, 1> particlesLooks{{{"particles", "Particles"}}};

} // namespace

constinit const Layer layer::skin{
    .key = '1', .help = "skin: solid, translucent, hidden", .button = "Skin", .looks = skinLooks};

constinit const Layer layer::wires{
    .key = '2', .help = "wireframe: edges of the drawn triangles", .button = "Wires", .looks = wiresLooks};

constinit const Layer layer::particles{
    .key = '3',
    .help = "a ball for every particle",
    .button = "Particles",
    .looks = particlesLooks,
    .make = [](const LayerContext& of) -> std::unique_ptr<const LayerPart> {
        return std::make_unique<const AllBalls>(of);
    },
    .isOfScene = true};

std::span<const Layer* const> layerTable() {
    static constexpr std::array all{&layer::skin,     &layer::wires, &layer::particles, &layer::links,
                                    &layer::contacts, &layer::cells, &layer::colors};
    static_assert(all.size() <= mostLayers);
    return all;
}

} // namespace sinew::viewer
