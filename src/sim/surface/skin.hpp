// Skins on the device: vertices from particles or lattice cells, then smooth normals. Recorded only when the
// scene is drawn.
#pragma once

#include "sim/program/program.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::surface {

/// Triangles of all skins, three indices each, skin after skin.
std::vector<std::uint32_t> joinIndices(const std::vector<Skin>& skins);

/// The triangles around each of the first `vertexCount` vertices, for skin_normals.
struct VertexFans {
    BufferId fans, triangles;
};
VertexFans uploadFans(ProgramBuilder& program, const std::vector<std::uint32_t>& indices,
                      std::uint32_t vertexCount, const std::string& name);

/// Appends the skin passes, and those of whole skins if some were split, and sets the program's skin buffers;
/// nothing if `skins` is empty. Skins are consecutive in one vertex and one index buffer, in the order of the
/// scene. `usesTexels` is Forms::usesTexels.
void addSkins(ProgramBuilder& program, const std::vector<Skin>& skins, bool usesTexels);

/// Appends smooth normals of the vertices of one variant of skin_normals.comp, with texels or loads. `more`
/// are the additional buffers of the variant.
struct NormalForm {
    const vk::ShaderCode *texels, *loads;
};
template <typename Push>
void addNormals(ProgramBuilder& program, const NormalForm& form, bool usesTexels, BufferId indices,
                const VertexFans& fans, std::initializer_list<BufferId> more, const Push& push) {
    const BufferId vertices = program.program().skinVertices;
    std::vector<BufferId> buffers{vertices, indices, fans.fans, fans.triangles};
    if (usesTexels) buffers.push_back(vertices);
    buffers.insert(buffers.end(), more);
    program.dispatch(usesTexels ? *form.texels : *form.loads, push.count, buffers, push);
}

} // namespace sinew::sim::surface
