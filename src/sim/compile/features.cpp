// A row has a function for each stage at which the feature takes part (sim/model/feature.hpp). The order of
// the rows is that of the passes within a stage.
#include "sim/compile/features.hpp"

#include "sim/constraints/attachment.hpp"
#include "sim/constraints/tether.hpp"
#include "sim/cutting/cut.hpp"
#include "sim/cutting/cut_lists.hpp"
#include "sim/events/events.hpp"
#include "sim/fields/fields.hpp"
#include "sim/forces/forces.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/levels/levels.hpp"
#include "sim/motions/motions.hpp"
#include "sim/motions/pool.hpp"
#include "sim/rigid/colliders.hpp"
#include "sim/rigid/driven.hpp"
#include "sim/sleep/sleep.hpp"
#include "sim/solvers/touching.hpp"

namespace sinew::sim {

namespace {

constexpr Feature rows[] = {
    {.name = "cuts",
     .cutBuffers = cutting::addBuffersOfCuts,
     .cut = cutting::addOpening,
     .cutEnd = cutting::addClosing,
     .rewrite = cutting::addRewriting,
     .skinNormals = cutting::addSkinNormals,
     .skinEnd = cutting::addSkinEnd},
    {.name = "motions", .move = motions::add, .open = motions::addForgetting, .end = motions::addPrevious},
    {.name = "fields",
     .begin = fields::add,
     .substepBegin = fields::addPass,
     .afterContacts = fields::addOpenPass},
    {.name = "attachments",
     .open = constraints::attachment::add,
     .afterContacts = constraints::attachment::addPass},
    {.name = "grabs", .begin = grabs::add, .afterContacts = grabs::addPass},
    {.name = "bodies that come and go", .begin = motions::addComing},
    {.name = "choice of grabs", .begin = grabs::addChoice},
    {.name = "contacts",
     .cutEnd = solvers::addCutFilters,
     .end = solvers::addContactMemory,
     .rewrite = solvers::addCutFilters},
    {.name = "cuts of listed links", .cutEnd = cutting::addListFilters},
    {.name = "cuts of levels", .cutEnd = levels::addCuts, .rewrite = levels::addCuts},
    {.name = "tethers",
     .open = constraints::tether::add,
     .afterContacts = constraints::tether::addPass,
     .cutEnd = constraints::tether::addCutPass,
     .rewrite = constraints::tether::addCutPass},
    {.name = "forces", .begin = forces::add, .afterLinks = forces::addPulls, .end = forces::addSums},
    {.name = "colliders",
     .open = rigid::colliders::add,
     .substepBegin = rigid::colliders::addSaving,
     .substepEnd = rigid::colliders::addPass},
    {.name = "driven bodies", .open = rigid::driven::add, .afterLinks = rigid::driven::addPass},
    {.name = "events",
     .buffers = events::add,
     .begin = events::addClearing,
     .substepEnd = events::addSupports,
     .end = events::addListing},
    {.name = "sleep",
     .buffers = sleep::add,
     .open = sleep::addOpening,
     .check = sleep::addDetection,
     .finish = sleep::finish},
    {.name = "lists of what is in the world",
     .open = motions::addPoolGroups,
     .check = motions::endPoolGroups},
};

} // namespace

std::span<const Feature> features() {
    return rows;
}

} // namespace sinew::sim
