// Links and bends that `split` lists, of sheets that may be cut and that it does not compute: those whose
// scene has bends, internal damping or links two apart. What they hang on are the links of the masks between
// neighbours: a link or a bend over two of them dies with either. A dead one has no stiffness.
#pragma once

#include "sim/compile.hpp"

#include <string>

namespace sinew::sim::cutting {

/// Whether grid `g` is such a sheet: its particles lie in a row among the listed ones.
bool isListed(const Scene& scene, const Settings& settings, std::uint32_t g);

/// The first distance constraint or bend of the scene that such a sheet has and no mask: it leads out of the
/// sheet or past other nodes than one, and would hold cut pieces together. "distance[3]", or empty.
std::string tiedPast(const Scene& scene, const Grid& sheet);

/// Whether the links of the first `listed` slots may be cut. After cutting::add.
bool haveLists(const StepProgram& program, std::uint32_t listed);

/// A link or bend in a list, by the slots that it leads over in a row: two or three.
struct Listed {
    std::uint32_t element = 0; ///< of the list
    std::array<std::uint32_t, 3> slots{};
    std::uint32_t count = 2; ///< of slots
    float stiffness = 0;     ///< [N/m]
};

/// Before the substeps: what of a list is left, which is of layout::SplitLink, or of layout::SplitBend.
/// Nothing where none of it may be cut. After cutting::add.
void addListFilter(ProgramBuilder& program, BufferId list, std::span<const Listed> all, bool areBends);

} // namespace sinew::sim::cutting
