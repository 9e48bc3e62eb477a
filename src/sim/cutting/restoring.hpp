// Bodies that may be cut and come or go by motions (Body::isAbsent, motions/pool.hpp): they are whole in the
// step in which they do. A step with such a motion is recorded with the passes of a cut: links come back
// before the blade cuts, and all that follows from links is found anew near those that were dead, as in a
// step with a blade that is undone.
//
//   cut      restore_links
//   publish  restore_skin, close_restored
#pragma once

#include "sim/cutting/cut_plan.hpp"
#include "sim/model/feature.hpp"

namespace sinew::sim::cutting {

/// Appends the pass that puts links in, after marks of the step before were cleared, and before the links are
/// saved. Nothing if no body that may be absent may be cut; the functions below then add nothing either.
void addRestoring(Build& build, const Cut& cut);
/// Appends the pass over skins, before those of the blade.
void addSkinRestoring(Build& build, const Cut& cut);
/// Appends the pass that ends this, after links of an undone step were put back.
void addRestored(Build& build, const Cut& cut);

} // namespace sinew::sim::cutting
