// Frame time statistics: the times of pictures, collected while they are drawn, and the table that --timing
// and a key print.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sinew::viewer {

/// The newest `most` values of each kind. One thread.
class FrameTimes {
public:
    static constexpr std::size_t most = 1u << 17; ///< half an hour at 60 pictures a second
    static constexpr double tooLong = 100;        ///< [ms]

    enum class Kind {
        frame,          ///< from one picture's submission to the next, in an unbroken series [ms]
        frameOfCut,     ///< the same, only pictures with a cut
        thread,         ///< processor time of the input thread between two polls [ms]
        step,           ///< GPU time of a step [ms]
        drawing,        ///< GPU time of skins, maps and picture [ms]
        panels,         ///< GPU time of panels [ms]
        inputToPicture, ///< from the earliest possible time of an event until its picture is finished [ms]
        picturesBefore, ///< pictures finished between an event and the picture that shows it
        count
    };

    void add(Kind kind, double value);
    /// Adds a picture that came `ms` after the last.
    void addFrame(double ms, bool isOfCut);
    /// Counts pipelines that the input thread made, which delays input.
    void addPipelines(std::size_t count) { pipelines_ += count; }
    void clear();

    std::size_t count(Kind kind) const { return of(kind).total; }
    /// The smallest value that at least `share` of the newest do not exceed; 0 without values.
    double quantile(Kind kind, double share) const;
    std::size_t slowFrames() const { return slow_; }           ///< longer than tooLong
    std::size_t slowFramesOfCut() const { return slowOfCut_; } ///< of these, pictures with a cut
    double framesPerSecond() const;

    /// Lines of text: pictures per second, one line for each kind with values, and slow pictures.
    std::string table() const;
    /// "24.1 pictures a second, 41 ms each (p50), 120 ms at most".
    std::string summary() const;

private:
    struct Values {
        std::vector<float> newest; // a ring of `most`
        std::size_t total = 0;     // since the start
        double largest = 0, sum = 0;
    };
    const Values& of(Kind kind) const { return values_[static_cast<std::size_t>(kind)]; }
    std::string line(Kind kind) const;

    std::array<Values, static_cast<std::size_t>(Kind::count)> values_;
    std::size_t slow_ = 0, slowOfCut_ = 0, pipelines_ = 0;
};

} // namespace sinew::viewer
