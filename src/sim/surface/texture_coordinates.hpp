// Texture coordinates of skins: one buffer with those of every index, which a cut changes beside it, and one
// with those of the vertices of pieces. A scene without them gets no buffer and no pass.
#pragma once

#include "sim/surface/cut_surface.hpp"
#include "sim/surface/skin_complex.hpp"

namespace sinew::sim::surface {

/// Whether any skin has texture coordinates.
bool areTextured(const std::vector<Skin>& skins);

/// Adds the texture coordinates of all skin indices, unless the program has them: (0, 0) for skins without,
/// and for indices up to `count` behind those of all skins. With `areCut` a cut changes them: they are part
/// of the topology.
enum class Coordinates { fixed, changing };
void addTextureCoordinates(ProgramBuilder& program, const std::vector<Skin>& skins, Coordinates are,
                           std::size_t count = 0);
/// The same of the indices of whole triangles.
void addWholeTextureCoordinates(ProgramBuilder& program, const std::vector<Skin>& skins);

/// Adds entries for the prisms of a body to `bodies`, before its prisms and vertices are appended there.
void addTexturedPrisms(CutBodies& bodies, const Skin& skin, const SkinComplex& complex,
                       std::uint32_t firstTriangle);
/// Adds the faces of a body, and their range. `push` has the strides of the body.
void addTexturedFaces(CutBodies& bodies, const Skin& skin, const Grid& grid,
                      std::span<const layout::SkinFace> faces, layout::TexturedFacePush push);

/// Adds the buffers of clipped skins.
void addTextureBuffers(ProgramBuilder& program, const std::vector<Skin>& skins, CutSurface& surface,
                       const CutBodies& bodies);
/// Appends the passes, after the surface of cuts was written.
void addTexturePasses(ProgramBuilder& program, const CutSurface& surface);

} // namespace sinew::sim::surface
