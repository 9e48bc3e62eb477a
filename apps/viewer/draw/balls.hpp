// Bodies without a skin (loose particles, chains) are shown as a ball a particle: which ones, how large, and
// the mesh of one ball, which is drawn where the simulation has the particles.
#pragma once

#include "sim/holds.hpp"
#include "vk/buffer.hpp"

namespace sinew::viewer {

/// Of one body, in the order of the scene.
struct BallRange {
    std::uint32_t first = 0, count = 0; ///< particles
    sim::Vec3 color;                    ///< linear RGB
};

struct BallList {
    std::vector<BallRange> ranges; ///< empty = every body has a skin
    std::vector<float> radii;      ///< of every particle of the scene [m]
};

/// A particle is as large as where it touches others; where it touches none, balls of linked ones nearly
/// meet.
BallList ballsOf(const sim::Scene& scene);
/// The same for bodies with a skin too, in its color; smaller, so that it is seen.
BallList allBallsOf(const sim::Scene& scene);

/// Marks of particles that are held: balls of `radius` [m], smaller where links are short, so that
/// those of a lattice stay apart. A draw takes a run of them: gaps of a few particles, whose balls have no
/// size, join two runs.
BallList marksOf(const sim::Scene& scene, std::span<const sim::NamedHold> holds, float radius);

/// A ball of radius 1 in triangles, counter-clockwise seen from outside: an icosahedron of which every
/// triangle was cut in four `cuts` times.
struct BallMesh {
    std::vector<std::array<float, 4>> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};
BallMesh makeBall(std::uint32_t cuts);

/// The buffers of a BallList; without ranges it has none. Must not outlive its Device.
class Balls {
public:
    Balls(const vk::Device& device, const BallList& list);
    /// Draws each ball as the mesh makeBall(cuts).
    Balls(const vk::Device& device, const BallList& list, std::uint32_t cuts);

    const std::vector<BallRange>& ranges() const noexcept { return ranges_; }
    /// Binds vertices (binding 0), positions (1), removedParticles() (2) and radii (3), and indices; values
    /// of particles (4) unless that is empty. Only where there are ranges().
    void bind(VkCommandBuffer commands, const vk::BufferView& positions, const vk::BufferView& removed,
              const vk::BufferView& values = {}) const noexcept;
    void draw(VkCommandBuffer commands, const BallRange& range) const noexcept;

private:
    const vk::Device& device_;
    std::vector<BallRange> ranges_;
    std::vector<vk::Buffer> buffers_; // corners, radii, triangles
    std::uint32_t indexCount_ = 0;
};

} // namespace sinew::viewer
