// Chooses between calm and plain recordings of steps, for a host that repeats steps which lacked contact
// lists.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sinew::sim {

/// A calm step is recorded without the passes that rebuild contact lists after its first substep. It costs
/// less while lists stay valid, and must be repeated if they do not. Results do not depend on the choice.
class CalmSteps {
public:
    /// Steps in a row without a rebuild after the first substep before calm steps begin: initial and largest
    /// number.
    static constexpr std::uint32_t fewest = 8, most = 512;

    bool areCalm() const noexcept { return quiet_ >= needed_; }

    /// Records the end of a step that rebuilt lists `laterLists` times after its first substep (0 for a calm
    /// step).
    void finished(std::uint32_t laterLists, bool wasCalm) noexcept {
        quiet_ = laterLists > 0 ? 0 : std::min(quiet_ + 1, most);
        calm_ = wasCalm ? calm_ + 1 : 0;
        if (calm_ < needed_) return;
        needed_ = std::max(fewest, needed_ / 2);
        calm_ = 0;
    }
    /// A calm step lacked lists: doubles the number of steps without a rebuild before the next calm step.
    void lacked() noexcept {
        needed_ = std::min(2 * needed_, most);
        quiet_ = calm_ = 0;
    }

private:
    std::uint32_t quiet_ = 0, calm_ = 0; // in a row
    std::uint32_t needed_ = fewest;
};

} // namespace sinew::sim
