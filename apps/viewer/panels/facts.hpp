// What the panels show, and what hands ask for in them: plain data. Panels know no simulation and no device,
// and whoever fills this in knows no panels.
#pragma once

#include "app/piece_count.hpp"
#include "viewer/draw/layers.hpp"
#include "viewer/hands/bindings.hpp"
#include "viewer/hands/found.hpp"
#include "vk/device.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

/// The last values of something, the newest last.
class Curve {
public:
    static constexpr std::size_t length = 120;

    void add(float value) {
        values_[next_] = value;
        next_ = (next_ + 1) % length;
        count_ = count_ < length ? count_ + 1 : length;
    }
    void clear() { next_ = count_ = 0; }
    std::size_t count() const { return count_; }
    /// 0 = the oldest.
    float at(std::size_t i) const { return values_[(next_ + length - count_ + i) % length]; }
    float newest() const { return count_ > 0 ? at(count_ - 1) : 0; }
    float mean() const {
        float sum = 0;
        for (std::size_t i = 0; i < count_; ++i) sum += at(i);
        return count_ > 0 ? sum / static_cast<float>(count_) : 0;
    }

    /// What half of them are below; 0 of none.
    float median() const { return quantile(0.5f); }
    float quantile(float share) const {
        if (count_ == 0) return 0;
        std::array<float, length> sorted = values_;
        std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count_));
        return sorted[static_cast<std::size_t>(share * static_cast<float>(count_ - 1))];
    }

private:
    std::array<float, length> values_{};
    std::size_t next_ = 0, count_ = 0;
};

/// A curve a phase of the step, equally long [ms].
struct PhaseCurve {
    std::string name;
    Curve ms;
};

/// A line of the step program: equal passes in a row, or in substeps, are one.
struct PassLine {
    std::string phase, label;
    std::uint32_t times = 1;
    std::uint32_t items = 0; ///< invocations of one; 0 = a fill, a copy or an update
    bool isOfCut = false;    ///< only in steps with a blade
};

/// What can be turned while the scene plays.
struct Knobs {
    float gravity = 9.81f; ///< downwards [m/s^2]; acts in the next step
    float pace = 1;        ///< seconds of the scene in a second of the clock; likewise
    int substeps = 1;      ///< 0 = as many as the scene needs; acts when another simulation is there
    int solver = 0;        ///< of SceneFacts::solvers; likewise
    float stiffness = 1;   ///< factor on Young's modulus of all bodies; these act as soon as it is worked out
    float damping = 0;     ///< [1/s]
    float friction = 0;    ///< of planes, colliders and bodies
    std::vector<float> bodies;       ///< further factors on the stiffness of each, of SceneFacts::bodies
    std::optional<float> bladeDepth; ///< below the surface [m]; nothing = through; acts at once
    int body = -1;                   ///< that the panel shows the factor of; -1 = all
    bool operator==(const Knobs&) const = default;
};

/// The solver that plays beside the one on show.
struct BesideKnobs {
    int solver = 0;   ///< of SceneFacts::solvers
    int substeps = 0; ///< 0 = as many as the scene needs
    bool operator==(const BesideKnobs&) const = default;
};
constexpr int mostSubsteps = 1000;

struct BesideFacts {
    bool isOn = false, isMaking = false;
    BesideKnobs knobs;                ///< where it is on
    std::array<std::string, 2> names; ///< of the first and of this; empty while it is not there
    std::vector<PhaseCurve> phases;   ///< as Facts::phases
    Curve strainRms, strainMax;       ///< as those of Facts
};

/// What stays as it is while a scene is shown.
struct SceneFacts {
    std::string name, device, driver;
    std::uint32_t deviceIndex = 0; ///< among all
    bool isSoftware = false;
    std::size_t particles = 0, constraints = 0;
    std::string substepsWhy; ///< "64 substeps: so that no link is more than 5 % softer than asked"
    std::string stiffness; ///< how many links are clamped, and how soft the softest is; empty = all as asked
    std::vector<PassLine> passes;
    std::size_t dispatches = 0, barriers = 0; ///< of a step without a blade
    std::vector<std::string> skipped;         ///< features that the scene does not need
    bool canCut = false;
    std::vector<std::string> solvers, bodies;
    Knobs fromFile; ///< as the file has them
};

/// What changes.
struct Facts {
    bool isPaused = false, isDiverged = false, isVsync = true, isBladeOn = false, isPokeOn = false,
         isHolding = false, isRecording = false;
    /// Scale of the sides of a picture with plain shadows and no antialiasing, on a software device while
    /// things move; of full quality: none.
    std::optional<float> reduced;
    std::size_t pins = 0; ///< that hold something where it is
    double framesPerSecond = 0;
    double pace = 1;     ///< seconds of the scene in a second of the clock, as asked
    double keptPace = 1; ///< as the machine could
    std::uint64_t steps = 0;
    double time = 0;                ///< of the scene [s]
    std::vector<PhaseCurve> phases; ///< of one step; empty where the device has no clock
    Curve frameMs;
    Curve strainRms, strainMax; ///< of links that hold; empty where nothing was measured
    std::uint32_t contactRoom = 0, contactsNeeded = 0, timesGrown = 0, slowed = 0;
    bool isContactRoomShort = false;
    std::uint64_t stepsRepeated = 0; ///< that lacked lists of contacts
    std::uint32_t sleeping = 0, linksCut = 0;
    app::PieceCount pieces;
    std::uint32_t crumbs = 0, crumbParticles = 0; ///< pieces that were removed, and theirs
    float crumbMass = 0;                          ///< [kg]
    std::vector<std::string> cuts;                ///< that can be undone, then those that can be redone
    std::size_t undos = 0;                        ///< how many of them the former are
    std::vector<std::string> scenes;
    std::size_t scene = static_cast<std::size_t>(-1); ///< of `scenes`; none of them = -1
    std::vector<bool> previews; ///< which of the first of them have a picture in the sheet
    bool isOpening = false;
    std::vector<vk::DeviceDescription> devices; ///< that there are; empty until they were looked for
    Knobs knobs;
    Layers layers;
    std::array<float, 2> bladeDepths{};  ///< least and most of a blade that does not go through [m]
    std::array<float, 2> sectionReach{}; ///< lowest and highest offset of its plane, where there is one [m]
    MapReading map;                      ///< of the map that is on, if one is
    float mapRange = 0;                  ///< which value has the last color; 0 = not known yet
    std::uint32_t contactsFound = 0;     ///< where they are shown
    LinkFacts links;                     ///< likewise
    std::vector<GridFacts> grids;        ///< likewise; none where the solver has none
    bool isPreparing = false;            ///< layers that are on and not drawn yet
    BesideFacts beside;
    bool isInspecting = false;
    std::optional<Found> found; ///< while inspecting
    std::string notice;         ///< the newest message; empty = none
    bool isNoticeBad = false;
};

/// What hands asked for since the last picture.
struct Wishes {
    std::vector<Action> actions;
    std::optional<std::size_t> scene;  ///< of Facts::scenes
    std::optional<std::string> file;   ///< to be opened
    std::optional<std::size_t> device; ///< of Facts::devices
    std::optional<Knobs> knobs;
    std::optional<float> sectionOffset; ///< [m]
    std::optional<BesideKnobs> beside;
    /// Of Facts::scenes whose names are seen without a picture; nothing = no panel has been drawn.
    std::optional<std::vector<std::size_t>> previews;
    bool isEmpty() const {
        return actions.empty() && !scene && !file && !device && !knobs && !sectionOffset && !beside;
    }
};

} // namespace sinew::viewer
