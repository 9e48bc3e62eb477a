// Log of a host's mistakes during recording; each kind is reported once. Recording may neither throw nor
// allocate: it notes numbers, and the sentences are made when the host asks for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew::sim {

enum class Misuse {
    noReset,              ///< a step or a skin before recordReset() or recordTakeOver()
    tooManyInFlight,      ///< `frame` took the slot of step `given`, which had not finished
    tooManyGrabs,         ///< `given` listed, `allowed` by Settings
    tooManyHostColliders, ///< `given` listed, `allowed` by Settings
    tooManyFields,        ///< `given` listed, `allowed` by Settings
    tooManyMotions,       ///< `given` listed, `allowed` by Settings
    badMotion,            ///< motion `given` has no effect, by its fault `allowed` (motions::Fault)
    tooManyAnchors,       ///< more than the scene's attachments
    badBlade,             ///< `given` points in `from` and `allowed` points in `to`, or not finite
    nothingToCut,         ///< a blade or a ray, but no cuttable body
    contactRoom,          ///< undone: `given` candidates a particle need room, `allowed` have it
    notRepeated,          ///< recorded after step `given`, which lacked lists and was not repeated
    mayBeRepeated,        ///< in flight while the topology or the material changed
    count
};

class MisuseLog {
public:
    /// Keeps the first note of each kind.
    void note(Misuse kind, std::uint64_t frame, std::uint64_t given = 0, std::uint64_t allowed = 0) noexcept;
    bool isNoted(Misuse kind) const noexcept { return notes_[static_cast<std::size_t>(kind)].isNoted; }
    /// Returns a sentence for each kind noted since the last call and never before.
    std::vector<std::string> take();

private:
    struct Note {
        bool isNoted = false, isTold = false;
        std::uint64_t frame = 0, given = 0, allowed = 0;
    };
    std::array<Note, static_cast<std::size_t>(Misuse::count)> notes_{};
};

} // namespace sinew::sim
