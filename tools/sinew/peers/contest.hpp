// The programs of `sinew bench --peers` on one scene: their errors, and their times.
#pragma once

#include "sinew/peers/search.hpp"
#include "sinew/study/report.hpp"

#include <map>

namespace sinew::tools::peers {

/// One program with a number of threads: a row of the table.
struct Row {
    std::string program;       ///< "verlet", "bullet", "jolt", or one of our solvers
    std::uint32_t threads = 1; ///< 0: of a device that is not software
};

/// The error of a run, over the frames before chaos.
struct RunError {
    double ofBody = 0;
    std::optional<double> ofMotion; ///< empty if nothing moves
    double by(study::Scale scale) const;
};

/// One thread. `scene`, `truth` and the sessions outlive the object.
class Contest {
public:
    /// `single`: a session whose software device computes on one thread; null if there is none beside
    /// `session`.
    Contest(Session& session, Session* single, const sim::Scene& scene, const study::Truth& truth);

    std::vector<Row> rows() const;
    /// The settings of a program to search over; those that the scene does not support are left out.
    std::vector<Variant> variantsOf(const std::string& program) const;

    /// Runs the motion. Empty if it diverges; if `enough` is given, also as soon as the error must exceed it.
    std::optional<RunError> errorOf(const std::string& program, const sim::Settings& settings,
                                    std::optional<double> enough = {},
                                    study::Scale scale = study::Scale::body);
    /// Wall-clock times of the frames of one motion [ms], with submission and wait.
    std::vector<double> time(const Row& row, const sim::Settings& settings);

private:
    using OnFrame = std::function<bool()>; // false: enough
    std::vector<double> runDevice(Session& session, sim::Settings settings,
                                  const std::function<bool(Runner&)>& onFrame);
    Session& quicker();
    sim::Forms formsOf(Session& session, const sim::Settings& settings);

    Session& session_;
    Session* single_;
    const sim::Scene& scene_;
    const study::Truth& truth_;
    std::uint32_t threads_ = 1;
    Session* quicker_ = nullptr;
    std::map<std::pair<const Session*, sim::Solver>, sim::Forms> forms_;
};

} // namespace sinew::tools::peers
