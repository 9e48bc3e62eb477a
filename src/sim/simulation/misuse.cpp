// Sentences of misuse, one for each kind: what, where, value, remedy.
#include "sim/simulation/misuse.hpp"

#include "sim/motions/motions.hpp"
#include "sinew/ranges.hpp"

namespace sinew::sim {

namespace {

std::string number(std::uint64_t value) {
    return std::to_string(value);
}

std::string listed(std::uint64_t given, const char* what, std::uint64_t allowed, const char* setting,
                   std::uint64_t most) {
    return number(given) + " " + what + " are given, settings." + setting + " is " + number(allowed) +
           ": the further ones are ignored: set settings." + setting + " to as many, at most " + number(most);
}

std::string sentenceOf(Misuse kind, std::uint64_t given, std::uint64_t allowed) {
    switch (kind) {
    case Misuse::noReset:
        return "recorded before the simulation has a state: record recordReset() or recordTakeOver() first";
    case Misuse::tooManyInFlight:
        return "recorded while step " + number(given) + " has not finished, settings.framesInFlight is " +
               number(allowed) +
               ": its status is lost: wait for that step first, or set settings.framesInFlight to the steps "
               "that are in flight at a time";
    case Misuse::tooManyGrabs:
        return listed(given, "grabs", allowed, "grabs", ranges::mostGrabs);
    case Misuse::tooManyHostColliders:
        return listed(given, "host colliders", allowed, "hostColliders", ranges::mostHostColliders);
    case Misuse::tooManyFields:
        return listed(given, "force fields", allowed, "fields", ranges::mostFields);
    case Misuse::tooManyMotions:
        return listed(given, "motions", allowed, "motions", ranges::mostMotions);
    case Misuse::badMotion:
        return "motion " + number(given) + " has no effect: it " +
               motions::textOf(static_cast<motions::Fault>(allowed)) + ": ask Simulation::faultOf() before";
    case Misuse::tooManyAnchors:
        return number(given) + " anchors are given, the scene has " + number(allowed) +
               " attachments: the further ones are ignored: give one for each attachment, in their order";
    case Misuse::badBlade:
        return "a blade from " + number(given) + " to " + number(allowed) +
               " points cuts nothing: give equally many, 2 to " + number(ranges::mostBladePoints) +
               ", all finite";
    case Misuse::nothingToCut:
        return "a blade or a ray is given, but no body may be cut: set Grid::isCuttable of a body";
    case Misuse::contactRoom:
        return "undone, and so is every later step: " + number(given) +
               " candidates for a particle on average, settings.contactRoom is " + number(allowed) +
               ": make a simulation with more room and let it take over (recordTakeOver)";
    case Misuse::notRepeated:
        return "recorded, but step " + number(given) +
               " lacked lists of contacts and was not repeated: all later steps with repeats are undone: "
               "look at Status::lacksLists of every step, and record that frame again, or leave out "
               "Step::repeats";
    case Misuse::mayBeRepeated:
        return "in flight with Step::repeats while a change or a topology is recorded after it: if it lacks "
               "lists, its repeat includes that: wait for it first, and repeat it if it lacked lists";
    case Misuse::count:
        break;
    }
    return {};
}

} // namespace

void MisuseLog::note(Misuse kind, std::uint64_t frame, std::uint64_t given, std::uint64_t allowed) noexcept {
    Note& note = notes_[static_cast<std::size_t>(kind)];
    if (!note.isNoted) note = {true, false, frame, given, allowed};
}

std::vector<std::string> MisuseLog::take() {
    std::vector<std::string> sentences;
    for (std::size_t kind = 0; kind < notes_.size(); ++kind) {
        Note& note = notes_[kind];
        if (!note.isNoted || note.isTold) continue;
        note.isTold = true;
        sentences.push_back("step " + number(note.frame) + ": " +
                            sentenceOf(static_cast<Misuse>(kind), note.given, note.allowed));
    }
    return sentences;
}

} // namespace sinew::sim
