// The results of a study as data: curves, fronts and the headline figure. docs/report.md describes the JSON.
#pragma once

#include "sinew/study/analysis.hpp"
#include "sinew/study/scene_study.hpp"

#include <array>

namespace sinew::tools::study {

/// A price of a point.
struct Price {
    const char* name; ///< in file names and JSON
    const char* label;
    double (*of)(const Trial&);
};
extern const std::array<Price, 3> prices; ///< time, sweeps, barriers

/// The length that an error is divided by.
enum class Scale {
    body,   ///< the body's size
    motion, ///< the error of a body that stays where it started
};

struct CurvePoint {
    const Trial* trial = nullptr;
    std::optional<TrialError> error; ///< empty = diverged
};

struct Curve {
    std::string solver;   ///< one of curveNames()
    std::size_t slot = 0; ///< index in curveNames(), which chooses the colour
    std::vector<CurvePoint> points;

    std::vector<Offer> offers(const Price& price, Scale scale = Scale::body) const;
    /// Points that no other point of this solver undercuts, by rising price.
    std::vector<std::size_t> front(const Price& price) const;
    std::optional<double> costOf(double error, const Price& price, Scale scale = Scale::body) const;
};

/// One for each of curveNames() that ran. Points into `result`.
std::vector<Curve> curvesOf(const SceneResult& result);

/// The speed-up of a solver over jacobi at the target error. If jacobi never reaches it, its best point's
/// time is used, and the ratio is a lower bound. Empty if the solver never reaches it, or if jacobi did not
/// run.
struct Advantage {
    double ratio = 0;
    bool isBound = false;
};
std::optional<Advantage> advantageOf(const Curve& curve, const std::vector<Curve>& curves);

struct StudyRecord {
    const vk::DeviceDescription& device;
    std::vector<SceneResult> scenes;
    bool isComplete = true;
};

std::string toJson(const StudyRecord& record);
std::string toCsv(const StudyRecord& record);
/// The headline as text for a terminal.
std::string toText(const StudyRecord& record);

} // namespace sinew::tools::study
