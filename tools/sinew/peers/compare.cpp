// First every program's settings are searched for, then all rows are timed in turns (A B A B), so that other
// load on the machine affects all alike.
#include "sinew/peers/compare.hpp"

#include "app/guard.hpp"
#include "sinew/clutter/bullet.hpp"
#include "sinew/peers/contest.hpp"
#include "sinew/peers/scenes.hpp"
#include "sinew/solver_names.hpp"
#include "sinew/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace sinew::tools {

namespace {

using Clock = std::chrono::steady_clock;
using namespace peers;

const std::vector<double> targets{0.1, 0.01, 0.001};
constexpr const char* targetNames[] = {"10_percent", "1_percent", "0.1_percent"};
constexpr double searchShare = 0.65; // of a scene's time
constexpr std::uint32_t mostSweeps = 1000, mostRounds = 7;

/// One row with one choice of settings, which reaches a target.
struct Entry {
    Row row;
    sim::Settings settings;
    RunError error;
    std::vector<double> ms; // of frames, all rounds
};

/// The search of one program.
struct Searched {
    std::string program;
    SearchResult result;
    std::vector<std::pair<sim::Settings, RunError>> errors;
};

Clock::time_point after(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool isSame(const sim::Settings& a, const sim::Settings& b) {
    return a.substeps == b.substeps && a.iterations == b.iterations && a.theta == b.theta &&
           a.levels == b.levels && a.hasSharpClamp == b.hasSharpClamp && a.weight == b.weight &&
           a.overRelaxation == b.overRelaxation && a.warmStart == b.warmStart;
}

Searched searchFor(Contest& contest, const std::string& program, study::Scale scale, Clock::time_point end) {
    Searched searched{.program = program, .result = {}, .errors = {}};
    const Search search{
        .variants = contest.variantsOf(program),
        .targets = targets,
        .mostSweeps = mostSweeps,
        .errorOf = [&](const sim::Settings& settings, double enough) -> std::optional<double> {
            const auto error = contest.errorOf(program, settings, enough, scale);
            if (!error) return {};
            searched.errors.emplace_back(settings, *error);
            return error->by(scale);
        },
        .isOver = [&] { return Clock::now() > end || app::isInterrupted(); }};
    searched.result = findCheapest(search);
    return searched;
}

RunError errorOf(const Searched& searched, const sim::Settings& settings) {
    for (const auto& [tried, error] : searched.errors)
        if (isSame(tried, settings)) return error;
    return {};
}

/// In the order of the search, with shares of its time: what one leaves is for the next ones.
constexpr std::pair<const char*, double> searchOrder[] = {{"verlet", 1}, {"split", 3},        {"bullet", 3},
                                                          {"jolt", 2},   {"gauss_seidel", 2}, {"jacobi", 2}};

std::vector<Searched> searchAll(Contest& contest, const sim::Scene& scene, study::Scale scale,
                                Clock::time_point end) {
    std::vector<Searched> result;
    const std::vector<Row> rows = contest.rows();
    std::vector<std::pair<const char*, double>> order;
    for (const auto& entry : searchOrder)
        if (std::ranges::find(rows, entry.first, &Row::program) != rows.end()) order.push_back(entry);
    double shares = 0;
    for (const auto& [program, share] : order) shares += share;
    for (const auto& [program, share] : order) {
        const double left = std::chrono::duration<double>(end - Clock::now()).count();
        fmt::print(stderr, "{}: searching {}\n", scene.name, program);
        result.push_back(searchFor(contest, program, scale, after(left * share / shares)));
        shares -= share;
    }
    return result;
}

/// Each candidate once for every row of its program.
std::vector<Entry> entriesOf(const Contest& contest, const std::vector<Searched>& searches) {
    std::vector<Entry> entries;
    for (const Row& row : contest.rows()) {
        const auto searched = std::ranges::find(searches, row.program, &Searched::program);
        const std::size_t first = entries.size();
        for (const Candidate& candidate : searched->result.candidates)
            if (std::none_of(entries.begin() + static_cast<std::ptrdiff_t>(first), entries.end(),
                             [&](const Entry& e) { return isSame(e.settings, candidate.settings); }))
                entries.push_back({row, candidate.settings, errorOf(*searched, candidate.settings), {}});
    }
    return entries;
}

void timeAll(Contest& contest, const sim::Scene& scene, std::vector<Entry>& entries, Clock::time_point end) {
    fmt::print(stderr, "{}: timing {} runs in turns\n", scene.name, entries.size());
    for (std::uint32_t round = 0; round < mostRounds && (round < 2 || Clock::now() < end); ++round)
        for (Entry& entry : entries) {
            if (app::isInterrupted()) return;
            const std::vector<double> ms = contest.time(entry.row, entry.settings);
            entry.ms.insert(entry.ms.end(), ms.begin(), ms.end());
        }
}

/// The row's fastest entry that reaches the target; null if there is none.
const Entry* fastest(const std::vector<Entry>& entries, const Row& row, double target, study::Scale scale) {
    const Entry* best = nullptr;
    for (const Entry& entry : entries) {
        if (entry.row.program != row.program || entry.row.threads != row.threads || entry.ms.empty() ||
            entry.error.by(scale) > target)
            continue;
        if (!best || summarise(entry.ms)->p50 < summarise(best->ms)->p50) best = &entry;
    }
    return best;
}

Json settingsJson(const std::string& program, const sim::Settings& settings) {
    Json json{{"substeps", settings.substeps}, {"iterations", settings.iterations}};
    if (sim::Solver solver{}; !sim::parseSolver(program, solver)) return json;
    json["theta"] = settings.theta;
    json["levels"] = settings.levels;
    json["sharp_clamp"] = settings.hasSharpClamp;
    json["weight"] = settings.weight;
    json["over_relaxation"] = settings.overRelaxation;
    json["warm_start"] = settings.warmStart;
    return json;
}

Json reachedJson(const Entry& entry, double bestMs) {
    const Statistics ms = *summarise(entry.ms);
    Json json = settingsJson(entry.row.program, entry.settings);
    json["ms"] = ms.p50;
    json["ms_least"] = ms.min;
    json["ms_p99"] = ms.p99;
    json["frames_timed"] = entry.ms.size();
    json["times_the_best"] = ms.p50 / bestMs;
    json["error_rms"] = entry.error.ofBody;
    json["error_of_motion"] = orNull(entry.error.ofMotion);
    return json;
}

Json rowsJson(const Contest& contest, const std::vector<Entry>& entries,
              const std::vector<Searched>& searches, study::Scale scale) {
    Json rows = Json::array();
    for (const Row& row : contest.rows()) {
        const auto searched = std::ranges::find(searches, row.program, &Searched::program);
        rows.push_back({{"program", row.program},
                        {"threads", row.threads > 0 ? Json(row.threads) : Json(nullptr)},
                        {"searched_all", searched->result.isComplete},
                        {"reached", Json::object()}});
    }
    for (std::size_t t = 0; t < targets.size(); ++t) {
        double best = HUGE_VAL;
        for (const Row& row : contest.rows())
            if (const Entry* entry = fastest(entries, row, targets[t], scale))
                best = std::min(best, summarise(entry->ms)->p50);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const Entry* entry = fastest(entries, contest.rows()[r], targets[t], scale);
            rows[r]["reached"][targetNames[t]] = entry ? reachedJson(*entry, best) : Json(nullptr);
        }
    }
    return rows;
}

Json pointsJson(const std::vector<Searched>& searches) {
    Json points = Json::array();
    for (const Searched& searched : searches)
        for (const auto& [settings, error] : searched.errors) {
            Json point = settingsJson(searched.program, settings);
            point["program"] = searched.program;
            point["error_rms"] = error.ofBody;
            point["error_of_motion"] = orNull(error.ofMotion);
            points.push_back(std::move(point));
        }
    return points;
}

Json compare(const PeerOptions& options, Session& session, Session* single, const PeerScene& peer) {
    const sim::Scene scene = peer.make();
    fmt::print(stderr, "{}: computing the true motion\n", scene.name);
    const study::Truth truth = truthOf(scene, peer.frames);
    Contest contest(session, single, scene, truth);
    const double seconds = peer.share * options.seconds;
    const Clock::time_point end = after(seconds);
    const std::vector<Searched> searches =
        searchAll(contest, scene, options.scale, after(searchShare * seconds));
    std::vector<Entry> entries = entriesOf(contest, searches);
    timeAll(contest, scene, entries, end);
    return {{"scene", scene.name},
            {"particles", scene.particles.size()},
            {"constraints", scene.distances.size()},
            {"frames", peer.frames},
            {"device", session.device.description().name},
            {"scale", options.scale == study::Scale::motion ? "motion" : "body"},
            {"body_size", truth.bodySize},
            {"standing_still", truth.standingStill()},
            {"truth", {{"h", truth.h}, {"self_difference", truth.selfDifference}}},
            {"rows", rowsJson(contest, entries, searches, options.scale)},
            {"points", pointsJson(searches)}};
}

std::string cell(const Json& row, const char* target) {
    const Json& reached = row["reached"][target];
    if (reached.is_null()) return row["searched_all"].get<bool>() ? "never" : "no time";
    const auto iterations = reached["iterations"].get<std::uint32_t>();
    return fmt::format("{:.3g} ms {:>6} {:>6}", reached["ms"].get<double>(),
                       fmt::format("({}{})", reached["substeps"].get<std::uint32_t>(),
                                   iterations > 1 ? fmt::format("x{}", iterations) : ""),
                       fmt::format("{:.2f}x", reached["times_the_best"].get<double>()));
}

std::string sceneTable(const Json& comparison) {
    const bool isOfMotion = comparison["scale"] == "motion";
    std::string text = fmt::format(
        "\n{}: {} particles, {} links, {} frames; a body that stands still is {:.3g} % of its size off\n",
        comparison["scene"].get<std::string>(), comparison["particles"].get<std::size_t>(),
        comparison["constraints"].get<std::size_t>(), comparison["frames"].get<std::uint32_t>(),
        100 * comparison["standing_still"].get<double>());
    text += fmt::format("{:<13} {:<7} {:>24} {:>24} {:>24}  of {}\n", "program", "threads", "10 %", "1 %",
                        "0.1 %", isOfMotion ? "the motion" : "the body's size");
    for (const Json& row : comparison["rows"]) {
        const Json& threads = row["threads"];
        text += fmt::format("{:<13} {:<7}", row["program"].get<std::string>(),
                            threads.is_null() ? "-" : fmt::format("{}", threads.get<std::uint32_t>()));
        for (const char* target : targetNames) text += fmt::format(" {:>24}", cell(row, target));
        text += '\n';
    }
    return text;
}

} // namespace

void requirePeers() {}

ClutterEntrant bulletClutter(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations) {
    return onCpu("bullet", std::make_shared<clutter::Bullet>(clutter::ballsOf(scene, substeps, iterations)),
                 substeps, iterations);
}

Json comparePeers(const PeerOptions& options, Session& session) {
    std::unique_ptr<Session> single;
    if (session.device.description().type == "software" && driverThreads() > 1)
        single = oneThreadSession(options.device);
    Json comparisons = Json::array();
    for (const PeerScene& peer : peerScenes())
        if ((options.scene == "all" || options.scene == peer.group) && !app::isInterrupted())
            comparisons.push_back(compare(options, session, single.get(), peer));
    return comparisons;
}

std::string peersTable(const Json& comparisons) {
    std::string text = "\nms of a frame to equal error (substeps x iterations), times the best of all rows\n";
    for (const Json& comparison : comparisons) text += sceneTable(comparison);
    return text;
}

} // namespace sinew::tools
