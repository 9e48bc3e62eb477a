// Balls that show particles of bodies without a skin (loose particles, chains): which particles, their radii,
// and the mesh of one ball, drawn at the positions that the simulation holds.
#pragma once

#include "sinew/holds.hpp"
#include "sinew/vk/buffer.hpp"

namespace sinew::viewer {

/// The balls of one body, in the order of the scene.
struct BallRange {
    std::uint32_t first = 0, count = 0; ///< particles
    sim::Vec3 color;                    ///< linear RGB
};

struct BallList {
    std::vector<BallRange> ranges; ///< empty = every body has a skin
    std::vector<float> radii;      ///< of every particle of the scene [m]
};

/// A ball has the contact radius of its particle; if the particle has none, balls of linked particles nearly
/// touch. Those of short links overlap, so that a long chain is a tube that can be seen.
BallList ballsOf(const sim::Scene& scene);
/// Also includes bodies with a skin, in the colour of the skin; smaller, so that balls inside can be told
/// apart.
BallList allBallsOf(const sim::Scene& scene);

/// Particles of bodies with a skin, for their values in a section: icosahedra around balls that reach as far
/// as the mean of the particle's links.
BallList insidesOf(const sim::Scene& scene);

/// Marks of held particles, and of those of moving bodies that never move: balls of `radius` [m], smaller
/// where two of them are linked, so that they stay apart. Particles beside the skin of a mesh body have a
/// mark only if it dips into the skin. One draw covers a run of them; gaps of a few particles, whose balls
/// have size 0, join two runs.
BallList marksOf(const sim::Scene& scene, std::span<const sim::NamedHold> holds, float radius);

/// A triangle mesh of a ball of radius 1, counter-clockwise seen from outside: an icosahedron whose triangles
/// are split in four, `cuts` times.
struct BallMesh {
    std::vector<std::array<float, 4>> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};
BallMesh makeBall(std::uint32_t cuts);

/// The buffers of a BallList; a list without ranges has none. Must not outlive its Device.
class Balls {
public:
    Balls(const vk::Device& device, const BallList& list);
    /// Draws each ball as the mesh makeBall(cuts).
    Balls(const vk::Device& device, const BallList& list, std::uint32_t cuts);

    const std::vector<BallRange>& ranges() const noexcept { return ranges_; }
    /// Binds vertices (binding 0), positions (1), removedParticles() (2), radii (3), the indices and, unless
    /// empty, values of particles (4). Only if there are ranges().
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
