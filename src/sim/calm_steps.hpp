// Chooses how steps are recorded whose host repeats them where they lacked lists of contacts.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sinew::sim {

/// A calm step is recorded without the passes that make lists after its first substep. That costs less while
/// lists last, and a step more where one does not. No result depends on the choice.
class CalmSteps {
public:
    /// Steps in a row that needed no such pass before steps are calm, at first and at most.
    static constexpr std::uint32_t fewest = 8, most = 512;

    bool areCalm() const noexcept { return quiet_ >= needed_; }

    /// A step came to its end and needed passes after its first substep `laterLists` times: none, if it was
    /// calm.
    void finished(std::uint32_t laterLists, bool wasCalm) noexcept {
        quiet_ = laterLists > 0 ? 0 : std::min(quiet_ + 1, most);
        calm_ = wasCalm ? calm_ + 1 : 0;
        if (calm_ < needed_) return;
        needed_ = std::max(fewest, needed_ / 2);
        calm_ = 0;
    }
    /// A calm step lacked lists: twice as many others must need none until one is calm again.
    void lacked() noexcept {
        needed_ = std::min(2 * needed_, most);
        quiet_ = calm_ = 0;
    }

private:
    std::uint32_t quiet_ = 0, calm_ = 0; // in a row
    std::uint32_t needed_ = fewest;
};

} // namespace sinew::sim
