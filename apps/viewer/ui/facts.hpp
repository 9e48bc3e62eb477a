// Input and output of the panels as plain data: facts to show, and requests of the user. Panels know no
// simulation and no device; the code that fills in facts knows no panels.
#pragma once

#include "app/piece_count.hpp"
#include "scenes/gallery.hpp"
#include "sinew/vk/device.hpp"
#include "viewer/input/bindings.hpp"
#include "viewer/input/found.hpp"
#include "viewer/render/layers.hpp"
#include "viewer/render/legend.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

/// The newest values of a quantity, oldest first.
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

    /// The median; 0 without values.
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

/// Time curves of the phases of a step, equally long [ms].
struct PhaseCurve {
    std::string name;
    Curve ms;
};

/// A line of the step program; consecutive equal passes, or equal passes in substeps, share a line.
struct PassLine {
    std::string phase, label;
    std::uint32_t times = 1;
    std::uint32_t items = 0; ///< invocations of one pass; 0 = a fill, a copy or an update
    bool isOfCut = false;    ///< only in steps with a blade
};

/// Parameters that can be adjusted while the scene plays.
struct Knobs {
    float gravity = 9.81f;     ///< downwards [m/s^2]; acts from the next step on
    float pace = 1;            ///< seconds of the scene per second of the clock; acts from the next step on
    int substeps = 1;          ///< 0 = as many as the scene needs; acts once another simulation is ready
    int solver = 0;            ///< index into SceneFacts::solvers; acts once another simulation is ready
    float stiffness = 1;       ///< factor on all Young's moduli; this and the next two act once prepared
    float damping = 0;         ///< [1/s]
    float friction = 0;        ///< of planes, colliders and bodies
    std::vector<float> bodies; ///< further factors on stiffness, one for each of SceneFacts::bodies
    std::optional<float> bladeDepth; ///< below the surface [m]; empty = through; acts at once
    int body = -1;                   ///< body whose factor the panel shows; -1 = all
    bool operator==(const Knobs&) const = default;
};

/// The solver of the second simulation in a comparison.
struct BesideKnobs {
    int solver = 0;   ///< index into SceneFacts::solvers
    int substeps = 0; ///< 0 = as many as the scene needs
    bool operator==(const BesideKnobs&) const = default;
};
constexpr int mostSubsteps = 1000;

/// A distance between two states [m]: the root mean square over particles, and the largest.
struct Distance {
    float rms = 0, largest = 0;
};

struct BesideFacts {
    bool isOn = false, isMaking = false;
    BesideKnobs knobs;                ///< of the comparison, or of the next one
    std::array<std::string, 2> names; ///< of the first and the second; empty until the second is ready
    std::vector<PhaseCurve> phases;   ///< like Facts::phases
    Curve strainRms, strainMax;       ///< like those of Facts
    std::optional<Distance> apart;    ///< between the two; empty until it is measured
};

/// Said before a film begins on a software device, which takes long for each picture in full quality.
inline constexpr std::string_view slowRecording =
    "The film will play at real speed, but recording is slow without a GPU. F8 instead saves what you do; "
    "--headless --replay FILE --video FILM.mp4 draws it later in the same quality.";

/// Facts that stay constant while a scene is shown.
struct SceneFacts {
    std::string name, device, driver;
    std::uint32_t deviceIndex = 0; ///< index in the list of all devices
    bool isSoftware = false;
    std::size_t particles = 0, constraints = 0;
    std::string substepsWhy;          ///< "64 substeps: so that no link is more than 5 % softer than asked"
    std::string stiffness;            ///< how soft the softest link is; empty = all are within the tolerance
    std::uint32_t neededSubsteps = 0; ///< with which all were; 0 = no such number, or all are
    std::vector<PassLine> passes;
    std::size_t dispatches = 0, barriers = 0; ///< in a step without a blade
    std::vector<std::string> skipped;         ///< features that the scene does not need
    bool canCut = false;
    std::vector<std::string> solvers, bodies;
    std::vector<float> youngModuli; ///< in the scene file, one for each of `bodies` [Pa]; 0 = none
    Knobs fromFile;                 ///< values in the scene file
};

/// Facts that change.
struct Facts {
    bool isPaused = false, isDiverged = false, isVsync = true;
    std::optional<double> recorded;        ///< length of the film that is being recorded [s]; empty = none
    std::array<bool, mostTools> toolsOn{}; ///< whose buttons are lit, by index into toolTable()
    HintFacts hint;
    float metersPerPixel = 0; ///< at the depth of the point that the camera orbits; 0 = not known
    /// Set if pictures have plain shadows and no antialiasing, on a software device while something moves:
    /// the ratio of sides of the drawn image. Empty = full quality.
    std::optional<float> reduced;
    double framesPerSecond = 0;
    double pace = 1;                ///< requested seconds of the scene per second of the clock
    double keptPace = 1;            ///< achieved pace
    std::uint64_t steps = 0;        ///< of the scene: also those before a saved state
    double time = 0;                ///< of the scene [s]
    std::vector<PhaseCurve> phases; ///< of one step; empty if the device has no timestamps
    Curve frameMs;
    Curve strainRms, strainMax; ///< of live links; empty if not measured
    std::uint32_t contactRoom = 0, contactsNeeded = 0, timesGrown = 0, slowed = 0;
    bool isContactRoomShort = false;
    std::uint64_t stepsRepeated = 0; ///< steps that were repeated because contact lists were incomplete
    std::uint32_t sleeping = 0, linksCut = 0;
    app::PieceCount pieces;
    std::uint32_t debris = 0, debrisParticles = 0; ///< removed fragments and their particles
    float debrisMass = 0;                          ///< of removed fragments [kg]
    std::vector<std::string> cuts;                 ///< cuts to undo, then cuts to redo
    std::size_t undos = 0;                         ///< number of cuts to undo
    std::vector<std::string> scenes, sentences;    ///< names, and what happens in each
    std::vector<scenes::Gallery> marks;            ///< of each of `scenes`: the first ones, others, studies
    std::vector<std::string> recent; ///< absolute paths of files opened last, newest first; none of `scenes`
    std::size_t scene = static_cast<std::size_t>(-1); ///< index into `scenes`; -1 = none
    std::vector<bool> previews; ///< which of the first scenes have a preview in the sheet
    bool isOpening = false;
    std::vector<vk::DeviceDescription> devices; ///< all devices; empty until the search ends
    Knobs knobs;
    Layers layers;
    std::array<float, 2> bladeDepths{};  ///< least and largest depth of a blade that does not go through [m]
    std::array<float, 2> sectionReach{}; ///< lowest and highest offset of the section plane [m]
    MapReading map;                      ///< of the active map, if any
    float mapRange = 0;                  ///< value of the last colour; 0 = not known yet
    std::array<std::vector<LegendLine>, mostLayers> legends; ///< of layers that are drawn
    bool isPreparing = false;                                ///< some active layers are not ready to be drawn
    BesideFacts beside;
    bool isInspecting = false;
    std::optional<Found> found; ///< while inspecting
    std::string notice;         ///< the newest message; empty = none
    bool isNoticeBad = false;
};

/// Requests of the user since the last picture.
struct Wishes {
    std::vector<Action> actions;
    std::optional<std::size_t> scene;  ///< index into Facts::scenes
    std::optional<std::string> file;   ///< file to open
    std::optional<std::size_t> device; ///< index into Facts::devices
    std::optional<Knobs> knobs;
    std::optional<float> sectionOffset; ///< [m]
    std::optional<BesideKnobs> beside;
    /// Visible entries of Facts::scenes without a preview; empty = no panel has been drawn.
    std::optional<std::vector<std::size_t>> previews;
    bool isEmpty() const {
        return actions.empty() && !scene && !file && !device && !knobs && !sectionOffset && !beside;
    }
};

} // namespace sinew::viewer
