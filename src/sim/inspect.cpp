// Looks for the passes that use them; which use is which stands with the kernel's bindings.
#include "sim/inspect.hpp"

#include "layout.h"

#include <algorithm>
#include <cstring>

namespace sinew::sim {

namespace {

// The first that a kernel of that name, or a form of it, is dispatched by.
const Pass* findPass(const std::vector<Pass>& passes, std::string_view kernel) {
    const auto found = std::ranges::find_if(passes, [&](const Pass& pass) {
        return pass.kind == PassKind::dispatch && pass.label.starts_with(kernel);
    });
    return found == passes.end() ? nullptr : &*found;
}

template <typename Push> Push pushOf(const Pass& pass) {
    Push push;
    std::memcpy(&push, pass.push.data(), std::min(sizeof push, pass.push.size()));
    return push;
}

} // namespace

ContactListBuffers contactLists(const StepProgram& program) {
    ContactListBuffers lists;
    if (const Pass* pass = findPass(program.step, "count_contacts")) { // count_contacts.comp
        lists.pairs = pass->uses[1].buffer;
        lists.pairCounts = pass->uses[2].buffer;
        lists.pairRow = pushOf<layout::ContactPush>(*pass).row;
    }
    if (const Pass* pass = findPass(program.step, "touch_faces")) { // touch_faces.comp
        lists.faces = pass->uses[2].buffer;
        lists.facePairs = pass->uses[3].buffer;
        lists.faceCounts = pass->uses[4].buffer;
        lists.faceRow = pushOf<layout::FacePush>(*pass).row;
    }
    return lists;
}

std::vector<PieceVertices> piecesOfSheets(const StepProgram& program) {
    std::vector<PieceVertices> all;
    for (const Pass& pass : program.skin)
        if (pass.kind == PassKind::dispatch && pass.label.starts_with("skin_sheet")) // skin_sheet.comp
            all.push_back({pass.uses[1].buffer, pushOf<layout::SheetSkinPush>(pass).firstVertex});
    return all;
}

} // namespace sinew::sim
