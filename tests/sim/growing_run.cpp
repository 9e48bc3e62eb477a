// Makes a new runner for each capacity.
#include "sim/growing_run.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace sinew::test {

GrowingRun runGrowing(const sim::Scene& scene, sim::Settings settings, int steps,
                      const std::function<void(Runner&)>& afterStep) {
    settings.contactRoom = 1;
    auto runner = std::make_unique<Runner>(scene, settings);
    GrowingRun run;
    for (int step = 0; step < steps;) {
        const std::uint64_t before = runner->stateHash();
        const sim::Status status = runner->run(1);
        if (status.contactRoom == 0) {
            if (afterStep) afterStep(*runner);
            ++step;
            continue;
        }
        EXPECT_EQ(runner->stateHash(), before) << "undone";
        if (status.contactRoom <= settings.contactRoom) {
            ADD_FAILURE() << "needs " << status.contactRoom << " and has " << settings.contactRoom;
            break;
        }
        settings.contactRoom = status.contactRoom;
        auto larger = std::make_unique<Runner>(scene, settings);
        larger->takeOver(*runner);
        EXPECT_EQ(larger->stateHash(), before);
        runner = std::move(larger);
        ++run.growths;
    }
    run.hash = runner->stateHash();
    return run;
}

} // namespace sinew::test
