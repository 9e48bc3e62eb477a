// Cuts of links and bends in the lists of `split`, for cuttable sheets that it does not compute: those of a
// scene with bends, internal damping or links over two spacings. These depend on the links of the masks
// between neighbours: a link or a bend over two such links dies with either. A dead one has stiffness 0.
#pragma once

#include "sim/model/feature.hpp"

#include <string>

namespace sinew::sim::cutting {

/// Whether grid `g` is such a sheet, of a solver with the computed grids `computed`: its particles are
/// consecutive among the listed ones.
bool isListed(const Scene& scene, const Settings& settings, std::uint32_t g,
              std::span<const std::uint32_t> computed);

/// The first link of the scene that belongs to such a sheet but follows no link of the mask: it leads out of
/// the sheet or over more than one node, and would hold cut pieces together. "distance[3]", or empty.
std::string tiedPast(const Scene& scene, const Grid& sheet);

/// Whether the links of the first `listed` slots can be cut. Call it after cutting::addOpening.
bool haveLists(const StepProgram& program, std::uint32_t listed);

/// A link or bend in a list, with the two or three consecutive slots that it spans.
struct Listed {
    std::uint32_t element = 0; ///< of the list
    std::array<std::uint32_t, 3> slots{};
    std::uint32_t count = 2; ///< number of slots
    float stiffness = 0;     ///< [N/m]
};

/// Appends, before the substeps, the update of a list of layout::SplitLink, or of layout::SplitBend, and
/// keeps it for addListFilters(). Nothing if no element can be cut. Call it after cutting::addOpening.
void addListFilter(Build& build, BufferId list, std::span<const Listed> all, bool areBends);
/// Appends these updates again, after links were restored.
void addListFilters(Build& build);

} // namespace sinew::sim::cutting
