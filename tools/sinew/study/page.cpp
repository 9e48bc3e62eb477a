// A table that answers the question at once, then a diagram per scene, then all figures.
#include "sinew/study/page.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/study/plot_axes.hpp"
#include "sinew/study/rest_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::tools::study {

namespace {

constexpr const char* pageStyle = R"(:root{color-scheme:light dark}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.2rem 1rem 4rem;max-width:68rem;font:1rem/1.5 system-ui,"DejaVu Sans",sans-serif;
background:#f5f6f8;color:#16191d}
h1{font-size:1.7rem;line-height:1.2;margin:.4rem 0 .2rem}h2{font-size:1.25rem;margin:2.6rem 0 .2rem}
p{margin:.35rem 0;max-width:44rem}.quiet{color:#565d66}
.wide,.headline{overflow-x:auto;margin:1rem 0}
table{border-collapse:collapse;background:#fff;font-variant-numeric:tabular-nums}
th,td{padding:.45rem .8rem;text-align:right;border-bottom:1px solid #e4e7eb;white-space:nowrap;vertical-align:top}
th:first-child,td:first-child{text-align:left}
thead th{font-size:.85rem;border-bottom:2px solid #9aa1ab}
td b{font-size:1.1rem}td small{display:block;color:#565d66}
.won{background:#eaf3fb}
@media (max-width:40rem){.headline table,.headline tbody,.headline tr,.headline td{display:block;width:100%}
.headline thead{display:none}.headline tr{padding:.5rem 0;border-bottom:1px solid #9aa1ab}
.headline td{display:grid;grid-template-columns:1fr auto;text-align:right;border:0;padding:.25rem .8rem}
.headline td:first-child{font-weight:700;font-size:1.05rem;text-align:left}
.headline td[data-solver]:before{content:attr(data-solver);text-align:left}
.headline td small{grid-column:1/-1}}
figure{margin:1rem 0 0;background:#fff;border-radius:.5rem;overflow:hidden}
figure svg{display:block;width:100%;height:auto}
.plots{display:grid;gap:1rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,25rem),1fr))}
.plots figure:first-child{grid-column:1/-1;max-width:44rem;width:100%}
h3{font-size:1.05rem;margin:1.6rem 0 .2rem}
.pair{display:grid;gap:1rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,25rem),1fr))}
a{color:#0067a8}details{margin:1rem 0}summary{cursor:pointer;color:#0067a8}
details table{font-size:.85rem}details th,details td{padding:.2rem .6rem}
@media (prefers-color-scheme:dark){body{background:#0d0f12;color:#eceff3}.quiet,td small{color:#a9b1bb}
table,figure{background:#14171b}th,td{border-color:#282d34}.won{background:#172a3a}a,summary{color:#5ab4ee}}
)";

std::string cell(const Curve& curve, const std::vector<Curve>& curves) {
    const std::optional<double> ms = curve.costOf(targetError, prices[0]);
    const std::vector<std::size_t> front = curve.front(prices[0]);
    if (!ms) {
        const std::string best = front.empty() ? "diverged everywhere"
                                               : fmt::format("best {:.2g} % in {:.3g} ms",
                                                             100 * curve.points[front.back()].error->rms,
                                                             curve.points[front.back()].trial->medianMs());
        return fmt::format("<td data-solver=\"{}\"><span>not reached</span><small>{}</small></td>",
                           escaped(curve.solver), best);
    }
    const bool isBest = std::ranges::all_of(curves, [&](const Curve& other) {
        return *ms <= other.costOf(targetError, prices[0]).value_or(*ms);
    });
    std::string below;
    if (const auto ofMotion = curve.costOf(targetError, prices[0], Scale::motion))
        below = fmt::format("<small>{:.3g} ms to 1 % of the motion</small>", *ofMotion);
    if (const auto advantage = advantageOf(curve, curves); advantage && curve.solver != "jacobi")
        below += fmt::format("<small>{}{:.3g} × jacobi's speed</small>",
                             advantage->isBound ? "more than " : "", advantage->ratio);
    return fmt::format("<td data-solver=\"{}\"{}><span><b>{:.3g}</b> ms</span>{}</td>", escaped(curve.solver),
                       isBest ? " class=\"won\"" : "", *ms, below);
}

std::string headline(const StudyRecord& record) {
    const std::vector<std::string> solvers = curveNames();
    std::string html = "<div class=\"headline\"><table>\n<thead><tr><th>to 1 % error</th>";
    for (const std::string& solver : solvers) html += "<th>" + escaped(solver) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const SceneResult& scene : record.scenes) {
        const std::vector<Curve> curves = curvesOf(scene);
        html += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td>", escaped(scene.name));
        for (const std::string& solver : solvers) {
            const auto curve = std::ranges::find(curves, solver, &Curve::solver);
            html += curve == curves.end() ? "<td>–</td>" : cell(*curve, curves);
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string percent(double error) {
    return fmt::format("{:.3g} %", 100 * error);
}

/// Text of the tuning besides substeps and iterations.
std::string tuningText(const sim::Settings& s) {
    if (s.solver == sim::Solver::split)
        return fmt::format("theta {:g}", s.theta) +
               (s.levels > 0 ? fmt::format(", levels {}", s.levels) : "") +
               (isWithSum(s) ? ", clamp by the sum" : "");
    if (s.solver == sim::Solver::gaussSeidel)
        return s.warmStart > 0 ? fmt::format("warm {:g}", s.warmStart) : "cold";
    return s.weight > 0 ? fmt::format("weight {:g}", s.weight) : fmt::format("omega {:g}", s.overRelaxation);
}

/// The spread of the times of whole motions, and the load during them.
std::string spreadText(const Trial& trial) {
    const std::vector<double> ms = trial.repeatMs();
    if (ms.size() < 2) return "once";
    const auto [least, most] = std::ranges::minmax_element(ms);
    const double load = std::ranges::max_element(trial.repeats, {}, &Repeat::load)->load;
    return fmt::format("{:.3g} to {:.3g} in {}, load {:.1f}", *least, *most, ms.size(), load);
}

std::string pointRow(const Curve& curve, const CurvePoint& point) {
    const Trial& trial = *point.trial;
    const sim::Settings& s = trial.settings;
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.3g}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(curve.solver), s.substeps, s.iterations, tuningText(s), trial.sweeps, trial.barriers,
        trial.clamped ? percent(*trial.clamped) : "–", trial.medianMs(), spreadText(trial),
        point.error ? percent(point.error->rms) : "diverged", point.error ? percent(point.error->max) : "–",
        point.error && point.error->ofMotion ? percent(*point.error->ofMotion) : "–");
}

std::string details(const std::vector<Curve>& curves) {
    std::string rows;
    for (const Curve& curve : curves)
        for (const CurvePoint& point : curve.points) rows += pointRow(curve, point);
    return "<details><summary>every run</summary><div class=\"wide\"><table>\n<thead><tr><th>solver</th>"
           "<th>substeps</th><th>iterations</th><th>tuning</th><th>sweeps</th><th>barriers</th><th>clamped</"
           "th>"
           "<th>ms a frame</th><th>of repeats</th><th>RMS error</th><th>largest</th><th>of the "
           "motion</th></tr></thead>\n<tbody>\n" +
           rows + "</tbody></table></div></details>\n";
}

std::string restSection(const SceneResult& scene) {
    std::string html = fmt::format("<h3>{}, coming to rest</h3>\n", escaped(scene.name)) + restTable(scene);
    html += "<div class=\"pair\">\n";
    for (const Plot& plot : restPlots(scene))
        html += "<figure>" + draw(plot, Style::fromPage) + "</figure>\n";
    return html + "</div>\n";
}

std::string truthText(const SceneResult& scene) {
    const std::string known =
        fmt::format("the truth is known to {:.1g} of body size", scene.truth.selfDifference);
    if (!scene.isOfContacts) return known;
    return fmt::format(
        "the truth is split with {} substeps; by half as many, and by a disturbance, an error of 1 % "
        "is comparable over {} frames",
        truthSubsteps, framesAtTarget(scene.truth));
}

std::string section(const SceneResult& scene) {
    const std::vector<Curve> curves = curvesOf(scene);
    std::string html = fmt::format("<section id=\"{0}\">\n<h2>{0}</h2>\n", escaped(scene.name));
    html += fmt::format("<p class=\"quiet\">{} particles, {} springs, {} frames of {:.4g} ms; {}</p>\n",
                        scene.particles, scene.constraints, scene.frames, 1000 * scene.dt, truthText(scene));
    html +=
        fmt::format("<p class=\"quiet\">A body that stays where it started is {} off: that is 100 % of the "
                    "motion.</p>\n",
                    percent(scene.truth.standingStill()));
    for (const std::string& note : scene.notes) html += "<p class=\"quiet\">" + escaped(note) + "</p>\n";
    html += "<div class=\"plots\">\n";
    for (const Price& price : prices)
        html += "<figure>" + draw(plotOf(scene, price), Style::fromPage) + "</figure>\n";
    html += "</div>\n" + details(curves);
    if (!scene.rest.empty()) html += restSection(scene);
    return html + "</section>\n";
}

} // namespace

Plot plotOf(const SceneResult& scene, const Price& price) {
    Plot plot{.title = scene.name + ": error over " + price.name,
              .xLabel = price.label,
              .target = targetError,
              .standing = scene.truth.standingStill()};
    for (const Curve& curve : curvesOf(scene)) {
        PlotCurve drawn{
            .label = curve.solver, .slot = curve.slot, .xAtTarget = curve.costOf(targetError, price)};
        const std::vector<std::size_t> front = curve.front(price);
        const std::vector<Offer> offers = curve.offers(price);
        for (std::size_t i = 0; i < offers.size(); ++i)
            if (std::ranges::find(front, i) == front.end())
                drawn.points.push_back({offers[i].cost, offers[i].error, false});
        for (const std::size_t i : front) {
            PlotPoint& point = drawn.points.emplace_back(offers[i].cost, offers[i].error, true);
            const std::vector<double> ms = curve.points[i].trial->repeatMs();
            if (&price != prices.data() || ms.size() < 2) continue;
            const auto [least, most] = std::ranges::minmax_element(ms);
            point.least = *least;
            point.most = *most;
        }
        plot.curves.push_back(std::move(drawn));
    }
    return plot;
}

std::string toHtml(const StudyRecord& record) {
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
                       "<title>Sinew: speed against error</title>\n<style>\n";
    html += pageStyle + plotStyle() + "</style></head><body>\n<h1>Speed against error</h1>\n";
    html += fmt::format(
        "<p>Time of a frame of a soft body for a motion with an error of 1 % of the body's size, on "
        "<b>{}</b>.</p>\n<p class=\"quiet\">{}, {}; sinew {}{}</p>\n",
        escaped(record.device.name), escaped(record.device.driver), escaped(record.device.type),
        SINEW_VERSION, record.isComplete ? "" : "; <b>interrupted: some runs are missing</b>");
    html += headline(record);
    html +=
        "<p class=\"quiet\">Error: root mean square over all frames and particles of the distance to the "
        "true motion (velocity Verlet in double precision, with a step halved until the result converges), "
        "divided by the diagonal of the body. A solid mark is a choice of substeps and iterations that no "
        "other choice of its solver undercuts; a faint one is undercut; a wedge at the top edge has "
        "diverged. A whisker spans the times of whole motions, least to greatest: equal work at different "
        "loads. The dotted line is the error of a body that stays where it started; an error of the motion "
        "is divided by that. The grey band joins the best of all solvers; rings mark where a curve meets 1 "
        "%. "
        "Comparison stops where a disturbance of the truth by 1e-7 grows to a tenth of an error; growth "
        "below 1e-6 is ignored, so an error below 1e-5 (0.001 %) may be due to chaos as much as to the "
        "solver. With contacts, the truth is the limit of split for short substeps, and comparison also "
        "stops where half as many substeps differ by a tenth of an error. Penetration is that of the "
        "deepest particle in another, in a plane or in a collider; bodies are at rest when the kinetic "
        "energy stays below a thousandth of its peak.</p>\n";
    for (const SceneResult& scene : record.scenes) html += section(scene);
    return html + "</body></html>\n";
}

} // namespace sinew::tools::study
